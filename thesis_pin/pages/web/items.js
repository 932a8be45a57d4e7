"use strict";
// Items of a scene (thesis_pin/pages/items.py) as objects of the three.js in meshcat's bundle.

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

  function surface(g) {
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
      return upright(new THREE.CylinderGeometry(g.radius, g.radius, g.length, 24));
    }
    const profile = [];  // a capsule: half circles around the ends of a cylinder
    for (let i = 0; i <= 16; i++) {
      const angle = Math.PI * (i / 16 - 0.5), end = i < 8 ? -g.length / 2 : g.length / 2;
      profile.push(new THREE.Vector2(g.radius * Math.cos(angle), end + g.radius * Math.sin(angle)));
    }
    return upright(new THREE.LatheGeometry(profile, 32));
  }

  function shape(item) {
    const material = paint(item.colour, {
      ...(item.geometry.type === "mesh" ? { flatShading: true, shininess: 5 } : {}),
      transparent: item.opacity < 1, opacity: item.opacity, depthWrite: item.opacity === 1,
      // A ghost lies behind what it coincides with, or the two would flicker.
      polygonOffset: item.ghost, polygonOffsetFactor: 1, polygonOffsetUnits: 4,
    });
    const mesh = new THREE.Mesh(surface(item.geometry), material);
    mesh.castShadow = mesh.receiveShadow = !item.ghost;
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

  function bars(item) {
    const position = [], normal = [], index = [];
    for (let i = 0; i < item.ends.length; i += 6) {
      const [start, end] = points(item.ends.slice(i, i + 6));
      const one = new THREE.TubeGeometry(new THREE.LineCurve3(start, end), 1, item.radius, 6);
      const first = position.length / 3;
      position.push(...one.attributes.position.array);
      normal.push(...one.attributes.normal.array);
      for (const corner of one.index.array) index.push(first + corner);
    }
    const all = new THREE.BufferGeometry().setIndex(index);
    all.setAttribute("position", new THREE.Float32BufferAttribute(position, 3));
    all.setAttribute("normal", new THREE.Float32BufferAttribute(normal, 3));
    return { object: new THREE.Mesh(all, paint(item.colour)), update: () => true };
  }

  // A line's points by which it looks as with all of them, and how many pieces lie before each of
  // all: pieces are straight to within a quarter of the radius, and no longer than a 200th of all.
  function simplified(all, radius) {
    const length = all.slice(1).reduce((sum, point, k) => sum + point.distanceTo(all[k]), 0);
    const chord = new THREE.Line3(), near = new THREE.Vector3(), kept = [0];
    const bends = (a, b) => {
      chord.set(all[a], all[b]);
      for (let k = a + 1; k < b; k++) {
        chord.closestPointToPoint(all[k], true, near);
        if (near.distanceTo(all[k]) > 0.25 * radius) return true;
      }
      return false;
    };
    for (let k = 1; k < all.length; k++) {
      const last = kept[kept.length - 1], away = all[k - 1].distanceTo(all[last]);
      if (away > 0.1 * radius && (all[k].distanceTo(all[last]) > length / 200 || bends(last, k))) {
        kept.push(k - 1);
      }
    }
    const end = all.length - 1, last = kept[kept.length - 1];
    if (all[end].distanceTo(all[last]) > 0.1 * radius || kept.length < 2) kept.push(end);
    let piece = 0;
    const place = all.map((point, k) => {
      while (piece + 2 < kept.length && k >= kept[piece + 1]) piece += 1;
      const [from, to] = [all[kept[piece]], all[kept[piece + 1]]];
      return piece + Math.min(1, point.distanceTo(from) / (to.distanceTo(from) || 1));
    });
    return { list: kept.map((k) => all[k]), place };
  }

  function trace(item) {
    const { list, place } = simplified(points(item.samples.points), item.radius), SIDES = 5;
    const tube = (material, radius, sides) => new THREE.Mesh(
      new THREE.TubeGeometry(new Polyline(list), list.length - 1, radius, sides), material);
    const whole = tube(flatPaint(item.colour, { transparent: true, opacity: 0.3 }),
      0.45 * item.radius, 3);
    const done = tube(flatPaint(item.colour), item.radius, SIDES);
    return {
      object: new THREE.Group().add(whole, done),
      update: (at) => done.geometry.setDrawRange(0, 6 * SIDES * Math.round(place[at.nearest])),
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
    const PIECES = 48, SIDES = 5, r = item.radius, material = paint(item.colours[0]);
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

  function label(text, height) {
    const canvas = document.createElement("canvas"), pen = canvas.getContext("2d");
    const font = "28px system-ui, sans-serif";
    pen.font = font;
    canvas.width = Math.ceil(pen.measureText(text).width) + 12;
    canvas.height = 40;
    pen.font = font;
    pen.fillStyle = "rgba(255, 255, 255, .75)";
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.fillStyle = "#1a1a1a";
    pen.fillText(text, 6, 29);
    const map = new THREE.CanvasTexture(canvas);
    map.encoding = THREE.sRGBEncoding;
    map.minFilter = THREE.LinearFilter;
    const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map, depthTest: false }));
    sprite.scale.set(height * canvas.width / canvas.height, height, 1);
    sprite.center.set(-0.08, 0.5);
    return sprite;
  }

  function triad(item) {
    const object = new THREE.Group(), axes = new THREE.Group(), r = item.length;
    axes.matrixAutoUpdate = false;
    axes.matrix.fromArray(item.local).transpose();  // sent by rows
    object.add(axes);
    // Vermillion, bluish green, blue: x, y, z for colour-blind readers too.
    for (const [axis, colour] of [["x", "#D55E00"], ["y", "#009E73"], ["z", "#0072B2"]]) {
      const bar = new THREE.CylinderGeometry(0.035 * r, 0.035 * r, r, 6).translate(0, r / 2, 0);
      const one = new THREE.Mesh(bar, flatPaint(colour));
      one.rotation[axis === "x" ? "z" : "x"] = { x: -1, y: 0, z: 1 }[axis] * Math.PI / 2;
      axes.add(one);
    }
    if (item.label) axes.add(label(item.label, 0.45 * r));
    return { object, update: (at) => place(item.samples.placement, at, object) };
  }

  return { shape, ball, arrow, bars, trace, polygon, arc, triad };
}
