"use strict";
// Plays a scene (thesis_pin/scene.py) with the three.js and camera controls of meshcat's bundle.

function decodeScene(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const floats = new Float32Array(buffer, 4 + length);
  const revive = (key, value) =>
    value && value.$ ? floats.subarray(value.$[0], value.$[0] + value.$[1]) : value;
  return JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)), revive);
}

// Where a time lies among the samples: between k and k + 1, a share f of the way.
function locate(time, t) {
  let low = 0, high = time.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (time[middle] <= t) low = middle; else high = middle;
  }
  const f = Math.min(1, Math.max(0, (t - time[low]) / (time[high] - time[low])));
  return { k: low, f, nearest: f < 0.5 ? low : high };
}

// Drawing: one maker for each kind of item; each returns {object, update(at)}.
function makers(THREE) {
  const Z = new THREE.Vector3(0, 0, 1);
  // Light per vertex: half the work of per-pixel shading where there is no graphics card.
  const linear = (colour) => new THREE.Color(colour).convertSRGBToLinear();
  const paint = (colour, more) => new (more?.flatShading
    ? THREE.MeshPhongMaterial : THREE.MeshLambertMaterial)({ color: linear(colour), ...more });
  const flatPaint = (colour, more) => new THREE.MeshBasicMaterial(
    { color: linear(colour), side: THREE.DoubleSide, ...more });

  function vector(array, { k, f }, out) {
    const a = 3 * k, b = a + 3;
    return out.set(
      array[a] + f * (array[b] - array[a]),
      array[a + 1] + f * (array[b + 1] - array[a + 1]),
      array[a + 2] + f * (array[b + 2] - array[a + 2]));
  }

  const second = new THREE.Quaternion();
  function place(array, { k, f }, object) {
    const a = 7 * k, b = a + 7;
    object.position.set(
      array[a] + f * (array[b] - array[a]),
      array[a + 1] + f * (array[b + 1] - array[a + 1]),
      array[a + 2] + f * (array[b + 2] - array[a + 2]));
    object.quaternion.fromArray(array, a + 3).slerp(second.fromArray(array, b + 3), f);
  }

  function shape(g) {
    if (g.type === "box") return new THREE.BoxGeometry(...g.size);
    if (g.type === "ellipsoid") return new THREE.SphereGeometry(1, 32, 20).scale(...g.radii);
    if (g.type === "mesh") {
      const mesh = new THREE.BufferGeometry();
      mesh.setAttribute("position", new THREE.BufferAttribute(g.vertices, 3));
      mesh.setIndex(new THREE.BufferAttribute(Uint32Array.from(g.faces), 1));
      mesh.computeVertexNormals();
      return mesh;
    }
    const upright = (geometry) => geometry.rotateX(Math.PI / 2);
    if (g.type === "cone") return upright(new THREE.ConeGeometry(g.radius, g.length, 32));
    if (g.type === "cylinder") {
      return upright(new THREE.CylinderGeometry(g.radius, g.radius, g.length, 32));
    }
    const profile = [];  // a capsule: half circles around the ends of a cylinder
    for (let i = 0; i <= 16; i++) {
      const angle = Math.PI * (i / 16 - 0.5), end = i < 8 ? -g.length / 2 : g.length / 2;
      profile.push(new THREE.Vector2(g.radius * Math.cos(angle), end + g.radius * Math.sin(angle)));
    }
    return upright(new THREE.LatheGeometry(profile, 32));
  }

  function body(item) {
    const material = paint(item.colour, {
      ...(item.geometry.type === "mesh" ? { flatShading: true, shininess: 5 } : {}),
      transparent: item.opacity < 1, opacity: item.opacity, depthWrite: item.opacity === 1,
    });
    const mesh = new THREE.Mesh(shape(item.geometry), material);
    mesh.castShadow = mesh.receiveShadow = true;
    mesh.matrixAutoUpdate = false;
    mesh.matrix.fromArray(item.local).transpose();  // sent by rows
    const object = new THREE.Group().add(mesh);
    return { object, update: (at) => place(item.samples.placement, at, object) };
  }

  const levelled = (item, material) => {
    const colours = item.colours.map(linear);
    return (at) => {
      if (item.samples.level) material.color.copy(colours[item.samples.level[at.nearest]]);
    };
  };

  function ball(item) {
    const material = paint(item.colours[0]);
    const object = new THREE.Mesh(new THREE.SphereGeometry(item.radius, 18, 12), material);
    const colour = levelled(item, material);
    return {
      object,
      update(at) {
        vector(item.samples.position, at, object.position);
        colour(at);
        return Number.isFinite(object.position.x);
      },
    };
  }

  // Along +z from the origin, of length one for the shaft; the head keeps its shape.
  function arrow(item) {
    const r = item.radius, material = paint(item.colour);
    const tube = new THREE.CylinderGeometry(r, r, 1, item.head ? 14 : 6).rotateX(Math.PI / 2).translate(0, 0, 0.5);
    const tip = new THREE.ConeGeometry(2.6 * r, 7 * r, 16).rotateX(Math.PI / 2)
      .translate(0, 0, -3.5 * r);
    const shaft = new THREE.Mesh(tube, material), head = new THREE.Mesh(tip, material);
    const object = new THREE.Group().add(shaft);
    if (item.head) object.add(head);
    const value = new THREE.Vector3();
    return {
      object,
      update(at) {
        vector(item.samples.origin, at, object.position);
        const length = item.scale * vector(item.samples.vector, at, value).length();
        if (!(length > 1e-9) || !Number.isFinite(object.position.x)) return false;
        object.quaternion.setFromUnitVectors(Z, value.normalize());
        const room = item.head ? Math.min(7 * r, 0.5 * length) : 0;
        head.scale.setScalar(room / (7 * r) || 1);
        head.position.z = length;
        shaft.scale.z = length - room;
        return true;
      },
    };
  }

  function points(array) {
    const list = [];
    for (let i = 0; i < array.length; i += 3) list.push(new THREE.Vector3().fromArray(array, i));
    return list;
  }

  class Polyline extends THREE.Curve {
    constructor(list) { super(); this.list = list; }
    getPoint(u, out = new THREE.Vector3()) {
      const place = u * (this.list.length - 1);
      const k = Math.min(Math.floor(place), this.list.length - 2);
      return out.lerpVectors(this.list[k], this.list[k + 1], place - k);
    }
    getPointAt(u, out) { return this.getPoint(u, out); }  // by sample, not by length
    getTangent(u, out = new THREE.Vector3()) {
      const n = this.list.length, k = Math.min(Math.floor(u * (n - 1)), n - 2);
      // A point at rest has no direction: take the next piece that has, or the last.
      for (const step of [1, -1]) {
        for (let i = k; i >= 0 && i < n - 1; i += step) {
          out.subVectors(this.list[i + 1], this.list[i]);
          if (out.lengthSq() > 1e-14) return out.normalize();
        }
      }
      return out.set(1, 0, 0);
    }
    getTangentAt(u, out) { return this.getTangent(u, out); }
  }

  function trace(item) {
    const list = points(item.samples.points), SIDES = 5;
    const tube = (material, radius, sides) => new THREE.Mesh(
      new THREE.TubeGeometry(new Polyline(list), list.length - 1, radius, sides), material);
    const whole = tube(flatPaint(item.colour, { transparent: true, opacity: 0.3 }),
      0.45 * item.radius, 3);
    const done = tube(flatPaint(item.colour), item.radius, SIDES);
    return {
      object: new THREE.Group().add(whole, done),
      update: (at) => done.geometry.setDrawRange(0, 6 * SIDES * (at.k + (at.f > 0.5 ? 1 : 0))),
    };
  }

  function polygon(item) {
    const object = new THREE.Group();
    for (const corners of item.outlines) {
      const list = points(corners), one = new THREE.Group();
      const area = new THREE.BufferGeometry().setFromPoints(list);
      const faces = [];
      for (let i = 1; i + 1 < list.length; i++) faces.push(0, i, i + 1);
      area.setIndex(faces);
      const fill = flatPaint(item.colour, { transparent: true, opacity: 0.22, depthWrite: false });
      one.add(new THREE.Mesh(area, fill));
      list.forEach((start, i) => {
        const line = new THREE.LineCurve3(start, list[(i + 1) % list.length]);
        one.add(new THREE.Mesh(new THREE.TubeGeometry(line, 1, item.width / 2, 6),
          flatPaint(item.colour)));
      });
      object.add(one);
    }
    return {
      object,
      update: (at) => object.children.forEach((one, i) => {
        one.visible = item.samples.which[at.nearest] === i;
      }),
    };
  }

  function arc(item) {
    const PIECES = 60, SIDES = 6, r = item.radius, material = paint(item.colours[0]);
    const circle = [];
    for (let i = 0; i <= PIECES; i++) {
      const angle = 2 * Math.PI * i / PIECES;
      circle.push(new THREE.Vector3(r * Math.cos(angle), r * Math.sin(angle), 0));
    }
    const ring = new THREE.Mesh(
      new THREE.TubeGeometry(new Polyline(circle), PIECES, 0.07 * r, SIDES), material);
    const head = new THREE.Mesh(new THREE.ConeGeometry(0.2 * r, 0.5 * r, 20), material);
    const turned = new THREE.Group().add(ring, head), object = new THREE.Group().add(turned);
    const colour = levelled(item, material);
    return {
      object,
      update(at) {
        place(item.samples.placement, at, object);
        const values = item.samples.angle;
        const angle = values[at.k] + at.f * (values[at.k + 1] - values[at.k]);
        const size = Math.min(Math.abs(angle), 2 * Math.PI);
        turned.rotation.x = angle < 0 ? Math.PI : 0;  // seen from the other side
        ring.geometry.setDrawRange(0, 6 * SIDES * Math.round(PIECES * size / (2 * Math.PI)));
        head.position.set(r * Math.cos(size), r * Math.sin(size), 0);
        head.rotation.z = size;
        colour(at);
        return size > 1e-3 && Number.isFinite(object.position.x);
      },
    };
  }

  return { body, ball, arrow, trace, polygon, arc };
}

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
    box: null, open: 1 };
  controls.addEventListener("change", () => { stage.dirty = true; });

  stage.frame = (box) => {
    stage.box = box;
    stage.middle = box.getCenter(new THREE.Vector3());
    stage.size = Math.max(0.05, box.getSize(new THREE.Vector3()).length());
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
    const covered = Math.min(element.querySelector(".side[open]")?.offsetWidth || 0, width / 3);
    stage.open = 1 - covered / width;
    camera.setViewOffset(width, height, -covered / 2, 0, width, height);
    renderer.setSize(width, height);
    stage.dirty = true;
  };
  stage.draw = () => { renderer.render(world, camera); stage.dirty = false; };
  return stage;
}

// The player: stage, items, controls, clock. Returns what a page may use.
function makePlayer(root, scene, options = {}) {
  const make = (tag, more, ...children) => {
    const element = Object.assign(document.createElement(tag), more);
    element.append(...children);
    return element;
  };
  const { THREE } = MeshCat, time = scene.time, start = time[0], end = time[time.length - 1];
  const pane = make("div", { className: "stage" });
  root.classList.add("player");
  root.replaceChildren(pane);
  const stage = makeStage(THREE, pane, scene);
  if (options.embedded) {
    // The wheel scrolls the page unless the reader has taken hold of the picture.
    stage.controls.enableZoom = false;
    pane.addEventListener("pointerdown", () => { stage.controls.enableZoom = true; });
    pane.addEventListener("mouseleave", () => { stage.controls.enableZoom = false; });
  }
  const canvas = stage.renderer.domElement;
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", scene.description);
  canvas.tabIndex = 0;

  // -- items
  const maker = makers(THREE), groups = new Map();
  for (const group of scene.groups) {
    const object = new THREE.Group();
    object.visible = group.visible;
    stage.world.add(object);
    groups.set(group.name, { ...group, object });
  }
  const items = scene.items.map((item) => ({ ...item, ...maker[item.kind](item) }));
  for (const item of items) {
    groups.get(item.group).object.add(item.object);
    if (item.kind === "body") continue;
    item.object.traverse((part) => {  // after translucent bodies, whose tint would change colours
      part.renderOrder = 1;
      if (part.material) part.material.transparent = true;
    });
  }

  function apply(t) {
    const at = locate(time, t);
    for (const item of items) item.object.visible = item.update(at) !== false;
    for (const [k, readout] of scene.readouts.entries()) {
      const value = readout.values[at.nearest];
      const text = readout.texts.length ? readout.texts[value]
        : Number.isFinite(value) ? `${value.toFixed(readout.digits)} ${readout.unit}` : "–";
      if (values[k].textContent !== text) values[k].textContent = text;
    }
    slider.value = t - start;
    const clock = `${(t - start).toFixed(2)} / ${(end - start).toFixed(2)} s`;
    if (output.textContent !== clock) output.textContent = clock;
    slider.setAttribute("aria-valuetext", `${(t - start).toFixed(2)} seconds`);
    stage.dirty = true;
  }

  // -- controls
  const values = scene.readouts.map(() => make("dd", {}));
  const boxes = new Map();
  const legend = make("ul", { className: "legend" });
  for (const group of groups.values()) {
    const box = make("input", { type: "checkbox", checked: group.visible });
    box.addEventListener("change", () => {
      group.object.visible = box.checked;
      stage.dirty = true;
    });
    boxes.set(group.name, box);
    const text = make("span", {});
    const swatch = (colour) => {
      const dot = make("span", { className: "swatch" });
      dot.style.background = colour;
      return dot;
    };
    for (const [colour, meaning] of group.colours) if (!meaning) text.append(swatch(colour));
    text.append(group.label);
    for (const [colour, meaning] of group.colours) {
      if (meaning) text.append(make("span", { className: "meaning" }, swatch(colour), meaning));
    }
    legend.append(make("li", {}, make("label", {}, box, text)));
  }
  const readouts = make("dl", {});
  scene.readouts.forEach((readout, k) => {
    readouts.append(make("dt", { textContent: readout.label }), values[k]);
  });
  const side = make("details", { className: "side", open: root.clientWidth > 560 },
    make("summary", { textContent: scene.title }), legend, ...(values.length ? [readouts] : []));
  pane.append(side);
  side.addEventListener("toggle", stage.resize);

  const play = make("button", { type: "button", className: "play" });
  const slider = make("input", { type: "range", min: 0, max: end - start, step: "any" });
  slider.setAttribute("aria-label", "time");
  const output = make("output", {});
  const speeds = [0.1, 0.25, 0.5, 1, 2, 4];
  if (!speeds.includes(options.speed || 1)) speeds.push(options.speed);
  const rate = make("select", {}, ...speeds.sort((a, b) => a - b).map((value) =>
    make("option", { value, textContent: `${value}×`, selected: value === (options.speed || 1) })));
  rate.setAttribute("aria-label", "speed");
  const views = make("span", { className: "views" });
  for (const name of ["3d", "front", "side", "top"]) {
    const button = make("button", { type: "button", textContent: name === "3d" ? "3-D" : name });
    button.addEventListener("click", () => stage.look(name));
    views.append(button, " ");
  }
  const status = make("p", { className: "status" });
  status.setAttribute("role", "status");
  root.append(make("div", { className: "bar" }, play, slider, output, rate, views, status));

  // -- clock
  let now = start, playing = false, last = null, frames = 0, since = null, slow = 0, drawn = 0;
  let inSight = true;
  const listeners = [];
  const set = (t) => {
    now = Math.min(end, Math.max(start, t));
    apply(now);
    listeners.forEach((listener) => listener(now - start));
  };
  const setPlaying = (on) => {
    playing = on;
    last = since = null;
    play.textContent = on ? "❚❚ pause" : "▶ play";
    play.setAttribute("aria-pressed", String(on));
  };
  play.addEventListener("click", () => setPlaying(!playing));
  slider.addEventListener("input", () => set(start + Number(slider.value)));

  function count(clock) {
    if (since === null) { since = clock; frames = 0; }
    frames += 1;
    if (clock - since < 2000) return;
    player.frameRate = 1000 * (frames - 1) / (clock - since);
    frames = 1;
    since = clock;
    slow = player.frameRate < 30 ? slow + 1 : 0;
    if (slow === 1 && stage.renderer.shadowMap.enabled) {
      stage.renderer.shadowMap.enabled = false;  // cheaper first, then coarser
      stage.world.traverse((part) => { if (part.material) part.material.needsUpdate = true; });
    } else if (slow === 2) {
      stage.renderer.setPixelRatio(Math.min(1, window.devicePixelRatio) / 1.5);
    }
    status.textContent = slow < 3 ? "" : `This browser draws ${player.frameRate.toFixed(0)} frames `
      + "a second: frames are dropped; the motion keeps its pace.";
    if (options.report && (slow === 0 || slow > 2)) options.report(player.frameRate);
  }

  function tick(clock) {
    requestAnimationFrame(tick);
    if (playing && last !== null) {
      const next = now + Number(rate.value) * (clock - last) / 1000;
      set(next <= end ? next : start + ((next - start) % (end - start)));
      if (inSight) count(clock);
    }
    last = clock;
    if (stage.dirty && inSight) { stage.draw(); drawn += 1; }
  }

  // -- keys
  const step = (end - start) / 100;
  const keys = {
    " ": () => setPlaying(!playing), ArrowRight: () => set(now + step),
    ArrowLeft: () => set(now - step), Home: () => set(start), End: () => set(end),
  };
  (options.keys || root).addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const native = event.target.closest("button, input, select, summary, a");
    const box = [...boxes.values()][Number(event.key) - 1];
    if (box && !native?.matches("select")) {
      box.click();
    } else if (keys[event.key] && !native) {
      event.preventDefault();
      keys[event.key]();
    }
  });

  const player = {
    title: scene.title, start, duration: end - start, frameRate: null, stage, items, groups,
    get time() { return now - start; },
    set time(t) { set(start + t); },
    get playing() { return playing; },
    get framesDrawn() { return drawn; },
    play: () => setPlaying(true),
    pause: () => setPlaying(false),
    toggle: (name) => boxes.get(name).click(),
    look: stage.look,
    onTime: (listener) => listeners.push(listener),
  };

  // The camera has to see the robot all along, so frame it at three times.
  const box = new THREE.Box3();
  for (const t of [start, (start + end) / 2, end]) {
    apply(t);
    stage.world.updateMatrixWorld(true);
    for (const item of items) if (item.kind === "body") box.expandByObject(item.object);
  }
  if (box.isEmpty()) box.setFromObject(stage.world);
  stage.frame(box);
  new IntersectionObserver((entries) => {
    inSight = entries[entries.length - 1].isIntersecting;
    since = null;
  }).observe(pane);
  new ResizeObserver(stage.resize).observe(pane);
  stage.resize();
  stage.look("3d");
  set(start);
  setPlaying(!window.matchMedia("(prefers-reduced-motion: reduce)").matches);
  requestAnimationFrame(tick);
  return player;
}
