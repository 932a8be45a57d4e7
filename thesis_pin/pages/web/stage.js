"use strict";
// The stage: renderer, camera, light, floor.
function makeStage(THREE, element, scene) {
  const viewer = new MeshCat.Viewer(element, false);  // for its renderer and camera controls
  viewer.set_3d_pane_size = () => {};
  viewer.gui.domElement.remove();
  viewer.controls.dispose();
  const camera = new THREE.PerspectiveCamera(38, 1, 0.005, 200);
  camera.up.set(0, 0, 1);
  viewer.set_camera(camera);
  const { renderer, controls } = viewer;
  renderer.outputEncoding = THREE.sRGBEncoding;
  const world = new THREE.Scene();
  world.background = new THREE.Color(0xf4f6f8);  // not encoded again
  const stage = { world, camera, controls, renderer, viewer, dirty: true, middle: null, size: 1,
    box: null, open: 1, view: null };  // view: by name, until a hand turns it
  controls.addEventListener("change", () => { stage.dirty = true; });
  controls.addEventListener("start", () => { stage.view = null; });

  stage.frame = (box) => {
    stage.box = box;
    stage.middle = box.getCenter(new THREE.Vector3());
    stage.size = Math.max(1e-4, box.getSize(new THREE.Vector3()).length());
    Object.assign(camera, { near: 2e-3 * stage.size, far: 100 * stage.size });
    camera.updateProjectionMatrix();
    const sun = new THREE.DirectionalLight(0xffffff, 0.7);
    sun.position.copy(stage.middle).add(new THREE.Vector3(0.8, 0.5, 1.6).setLength(2 * stage.size));
    sun.target.position.copy(stage.middle);
    sun.castShadow = true;
    sun.shadow.mapSize.set(1024, 1024);
    sun.shadow.bias = -0.0004;
    sun.shadow.normalBias = 0.004 * stage.size;
    const reach = 0.9 * stage.size;
    Object.assign(sun.shadow.camera, {
      left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1 * stage.size,
      far: 5 * stage.size,
    });
    world.add(sun, sun.target, new THREE.HemisphereLight(0xffffff, 0x8a939c, 0.65));
    if (scene.floor !== null) addFloor(box);
  };

  function addFloor() {
    const wide = 3 * stage.size, power = 10 ** Math.floor(Math.log10(wide / 40));
    stage.spacing = [1, 2, 5, 10].map((n) => n * power).find((n) => wide / n <= 40);
    const cells = 2 * Math.ceil(wide / stage.spacing / 2);
    const round = (x) => Math.round(x / stage.spacing) * stage.spacing;
    const grid = new THREE.GridHelper(cells * stage.spacing, cells, 0x7f8a94, 0xa9b1b9);
    grid.rotation.x = Math.PI / 2;
    const ground = new THREE.Mesh(new THREE.PlaneGeometry(6 * wide, 6 * wide),
      new THREE.ShadowMaterial({ opacity: 0.16 }));
    ground.receiveShadow = true;
    // Below what lies on the floor, so that soles and polygons don't flicker.
    for (const [k, part] of [ground, grid].entries()) {
      const drop = (2 - k) * 3e-4 * stage.size;
      part.position.set(round(stage.middle.x), round(stage.middle.y), scene.floor - drop);
      world.add(part);
    }
  }

  // Distance from the middle at which every corner of the box is in sight.
  function room(way) {
    const high = Math.tan(camera.fov * Math.PI / 360), wide = high * camera.aspect * stage.open;
    const right = new THREE.Vector3(1, 0, 0).applyQuaternion(camera.quaternion);
    const up = new THREE.Vector3(0, 1, 0).applyQuaternion(camera.quaternion);
    let distance = 0.1 * stage.size;
    for (let i = 0; i < 8; i++) {
      const corner = new THREE.Vector3(...["x", "y", "z"].map(
        (axis, bit) => stage.box[i >> bit & 1 ? "max" : "min"][axis])).sub(stage.middle);
      const needed = Math.max(Math.abs(corner.dot(right)) / wide, Math.abs(corner.dot(up)) / high);
      distance = Math.max(distance, needed + corner.dot(way));
    }
    return 1.12 * distance;
  }

  stage.look = (name) => {
    stage.view = name;
    if (name === "3d" && scene.camera) {
      camera.position.fromArray(scene.camera[0]);
      controls.target.fromArray(scene.camera[1]);
    } else {
      // How much to the right, ahead and up of the robot the camera stands.
      const [right, ahead, up] = { "3d": [1, 1.1, 0.55], front: [0, 1, 0.04], side: [1, 0, 0.04],
        top: [0, -1e-3, 1] }[name];
      const [x, y] = scene.forward;
      const way = new THREE.Vector3(right * y + ahead * x, -right * x + ahead * y, up).normalize();
      camera.position.copy(way).add(stage.middle);
      camera.lookAt(stage.middle);
      camera.position.copy(stage.middle).addScaledVector(way, room(way));
      controls.target.copy(stage.middle);
    }
    controls.update();
    stage.dirty = true;
  };

  stage.resize = () => {
    const width = element.clientWidth, height = element.clientHeight;
    if (!width || !height) return;
    camera.aspect = width / height;
    // The legend covers the left: look past it.
    const side = element.querySelector(".side[open]")?.getBoundingClientRect();
    const covered = Math.min(Math.round(side?.width || 0), width / 3);
    stage.open = 1 - covered / width;
    camera.setViewOffset(width, height, -covered / 2, 0, width, height);
    renderer.setSize(width, height);
    stage.dirty = true;
    if (stage.view) stage.look(stage.view);  // what opened in a sliver of a window is far away
  };
  // Draw some moments, seen as at first, in a size of their own, and leave all as it was.
  stage.pictures = (width, height, times, clock, take) => {
    const place = camera.position.clone(), target = controls.target.clone(), now = clock.time;
    const view = stage.view, ratio = renderer.getPixelRatio();
    renderer.setPixelRatio(1);
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.clearViewOffset();
    stage.open = 1;
    stage.look("3d");
    times.forEach((time, k) => {
      clock.time = time;
      stage.draw();
      take(renderer.domElement, k);
    });
    clock.time = now;
    stage.view = view;
    camera.position.copy(place);
    controls.target.copy(target);
    controls.update();
    renderer.setPixelRatio(ratio);
    stage.resize();
  };
  stage.draw = () => { renderer.render(world, camera); stage.dirty = false; };
  return stage;
}
