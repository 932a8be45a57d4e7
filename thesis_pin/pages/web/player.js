"use strict";
// Plays a scene (thesis_pin/pages/scene.py) with the three.js and camera controls of meshcat's bundle.

// The numbers of a scene as thesis_pin/pages/packing.py lays them.
function decodeScene(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const planes = new Uint8Array(buffer, 4 + length), count = planes.length / 4, known = new Map();
  const array = ([start, size, width]) => {
    const bits = new Uint32Array(size), rows = size / width;
    for (let column = 0, k = start; column < width; column++) {
      for (let row = 0, sum = 0; row < rows; row++, k++) {
        sum += planes[k] | planes[count + k] << 8 | planes[2 * count + k] << 16 | planes[3 * count + k] << 24;
        bits[row * width + column] = sum |= 0;
      }
    }
    return new Float32Array(bits.buffer);
  };
  const revive = (key, value) => {
    if (!value || !value.$) return value;
    const place = value.$.join();  // an array of nothing begins where the next one does
    if (!known.has(place)) known.set(place, array(value.$));
    return known.get(place);
  };
  return JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)), revive);
}

// Where a time lies among the samples: between k and k + 1, a share f of the way.
function locate(time, t) {
  let low = 0, high = time.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (time[middle] <= t) low = middle; else high = middle;
  }
  const apart = time[high] - time[low];  // none where 32 bits can't tell samples apart
  const f = apart > 0 ? Math.min(1, Math.max(0, (t - time[low]) / apart)) : 1;
  return { k: low, f, nearest: f < 0.5 ? low : high };
}

// The player: stage, items, controls, clock. Returns what a page may use. With options.still there
// is no clock: the page changes the items' samples and calls refresh.
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
    if (item.kind === "shape") continue;
    item.object.traverse((part) => {  // after translucent bodies, whose tint would change colours
      part.renderOrder = 1;
      if (part.material) part.material.transparent = true;
    });
  }

  // No "-0.000": what rounds to zero has no sign.
  const rounded = (value, digits) => (+value.toFixed(digits) || 0).toFixed(digits);

  function apply(t) {
    const at = locate(time, t);
    for (const item of items) item.object.visible = item.update(at) !== false;
    for (const [k, readout] of scene.readouts.entries()) {
      const value = readout.values[at.nearest];
      const text = readout.texts.length ? readout.texts[value]
        : Number.isFinite(value) ? `${rounded(value, readout.digits)} ${readout.unit}` : "–";
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
  const boxes = new Map(), letters = new Map();
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
    if (group.key) {
      letters.set(group.key, box);
      text.append(" ", make("kbd", { textContent: group.key }));
    }
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
  const notes = scene.notes.map((textContent) => make("p", { className: "note", textContent }));
  root.append(make("div", { className: "bar" },
    ...(options.still ? [] : [play, slider, output, rate]), views, status, ...notes));

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
    if (clock - since < 1000) return;
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
  const keys = options.still ? {} : {
    " ": () => setPlaying(!playing), ArrowRight: () => set(now + step),
    ArrowLeft: () => set(now - step), Home: () => set(start), End: () => set(end),
  };
  (options.keys || root).addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.target.matches("textarea, input[type=number]")) return;  // letters are typed there
    const native = event.target.closest("button, input, select, summary, a");
    const box = [...boxes.values()][Number(event.key) - 1]
      || letters.get(event.key.toLowerCase());
    if (box && !native?.matches("select")) {
      box.click();
    } else if (keys[event.key] && !native) {
      event.preventDefault();
      keys[event.key]();
    }
  });

  const player = {
    title: scene.title, notes: scene.notes, start: scene.start, duration: end - start, frameRate: null, stage, items, groups,
    get time() { return now - start; },
    set time(t) { set(start + t); },
    get playing() { return playing; },
    get framesDrawn() { return drawn; },
    play: () => setPlaying(true),
    pause: () => setPlaying(false),
    toggle: (name) => boxes.get(name).click(),
    look: stage.look,
    refresh: () => apply(now),
    onTime: (listener) => listeners.push(listener),
  };

  // The camera has to see the robot all along, so frame it at three times, bars among its bodies
  // too; without one, all there is.
  const box = new THREE.Box3(), bodies = items.filter(
    (item) => item.kind === "shape" && groups.get(item.group).visible);
  const own = new Set(bodies.map((item) => item.group));
  const framed = bodies.length ? items.filter((item) => own.has(item.group)) : items;
  for (const t of [start, (start + end) / 2, end]) {
    apply(t);
    stage.world.updateMatrixWorld(true);
    for (const item of framed) {
      // What is nowhere would put the camera nowhere.
      if (item.object.visible && groups.get(item.group).visible) box.expandByObject(item.object);
    }
  }
  stage.frame(box);
  new IntersectionObserver((entries) => {
    inSight = entries[entries.length - 1].isIntersecting;
    since = null;
  }).observe(pane);
  new ResizeObserver(stage.resize).observe(pane);
  stage.resize();
  stage.look(options.look || "3d");
  set(start);
  setPlaying(!options.still && !window.matchMedia("(prefers-reduced-motion: reduce)").matches);
  requestAnimationFrame(tick);
  return player;
}
