"use strict";
// Sliders that move a robot (thesis_pin/pages/live): where everything goes is worked out by the
// server, or in a page without one by tree.js, if the robot has no loops.

function makeLive(panel, live, player, served) {
  const make = (tag, more, ...children) => {
    const element = Object.assign(document.createElement(tag), more);
    element.append(...children);
    return element;
  };
  let stand = live.stand, dragged = null, busy = false, next = null;
  const tree = live.tree ? makeTree(live.tree, live.hooks) : null, moves = served || tree !== null;

  // -- what there is to see
  const shown = (k, value = stand.values[k]) =>
    (+(value * live.sliders[k].factor).toFixed(3) || 0).toString();
  const status = make("p", { className: "status" });
  status.setAttribute("role", "status");
  const readouts = make("dl", {});
  const rows = live.sliders.map((slider, k) => {
    const id = `slider-${k}`, f = slider.factor;
    const range = make("input", { type: "range", id, min: slider.low * f, max: slider.high * f, step: "any" });
    const number = make("input", { type: "number", step: "any", min: slider.low * f, max: slider.high * f });
    number.setAttribute("aria-label", `${slider.name} in ${slider.unit || "its unit"}`);
    const mark = make("span", { className: "mark" });
    return { slider, range, number, mark, id };
  });

  function fill() {
    rows.forEach(({ slider, range, number, mark }, k) => {
      const text = shown(k);
      if (dragged !== k) range.value = stand.values[k] * slider.factor;
      range.setAttribute("aria-valuetext", `${text} ${slider.unit}${stand.marks[k] ? `, ${stand.marks[k]}` : ""}`);
      if (document.activeElement !== number) number.value = text;
      mark.textContent = stand.marks[k] ? ` ${stand.marks[k]}` : "";
    });
    status.textContent = stand.notes.join(" ");
    status.classList.toggle("stays", stand.notes.length > 0);
    readouts.replaceChildren(...stand.readouts.flatMap(([label, value]) =>
      [make("dt", { textContent: label }), make("dd", { textContent: value })]));
    if (choice) {
      choice.value = String(stand.choice);
      [...choice.options].forEach((option, k) => {
        option.textContent = live.choices[k] + (stand.possible[k] ? "" : " (not here)");
      });
    }
    toml.value = stand.toml;
    numpy.value = stand.q;
  }

  function draw() {
    player.items.forEach((item, k) => {
      for (const [name, values] of Object.entries(stand.items[k])) {
        const one = values.map((value) => (value === null ? NaN : value));
        item.samples[name] = Float32Array.from([...one, ...one]);  // a scene has two samples at least
      }
    });
    player.refresh();
  }

  // -- asking: one question at a time, of the last value alone
  async function ask(question) {
    if (tree) { answer(question); return; }
    if (busy) { next = question; return; }
    busy = true;
    try {
      const answer = await fetch("pose", {
        method: "POST", body: JSON.stringify("first" in question ? {} : { state: stand.state, ...question }),
      });
      if (!answer.ok) throw new Error(`the server answers ${answer.status}`);
      const found = await answer.json();
      if (found.error) throw new Error(found.error);
      stand = found;
      draw();
    } catch (error) {
      stand = { ...stand, notes: [error instanceof TypeError
        ? "The command that showed this page has ended: the robot stays where it is."
        : `The robot stays where it is: ${error.message}.`] };
    }
    busy = false;
    fill();
    made.answers += 1;
    if (next) { const question = next; next = null; ask(question); }
  }
  // Without a server the page works out where a robot without loops goes.
  function answer(question) {
    const { slider: k, value } = question, ends = live.sliders[k];
    stand = "first" in question ? live.stand
      : tree.moved(stand, k, Math.min(ends.high, Math.max(ends.low, value)));
    draw();
    fill();
    made.answers += 1;
  }
  const move = (k, value) => ask({ slider: k, value });

  rows.forEach(({ slider, range, number }, k) => {
    range.addEventListener("pointerdown", () => { dragged = k; });
    for (const end of ["pointerup", "pointercancel", "change"]) {
      range.addEventListener(end, () => { dragged = null; if (!busy) fill(); });
    }
    range.addEventListener("input", () => move(k, Number(range.value) / slider.factor));
    number.addEventListener("change", () => {
      const value = Number(number.value);
      if (number.value !== "" && Number.isFinite(value)) move(k, value / slider.factor);
    });
    number.addEventListener("blur", fill);
  });

  // -- what is copied out
  const toml = make("textarea", { readOnly: true, spellcheck: false });
  toml.setAttribute("aria-label", "pose as a file for --pose");
  const numpy = make("textarea", { readOnly: true, spellcheck: false });
  numpy.setAttribute("aria-label", "configuration for NumPy");
  numpy.style.height = "4.5rem";
  const copier = (text, area) => {
    const button = make("button", { type: "button", textContent: text });
    button.addEventListener("click", async () => {
      area.closest("details").open = true;
      area.select();
      try {
        await navigator.clipboard.writeText(area.value);
        status.textContent = "Copied.";
      } catch {
        status.textContent = "Selected below: copy it with Ctrl-C.";
      }
      status.classList.remove("stays");
    });
    return button;
  };
  const pose = make("details", {}, make("summary", { textContent: "the pose as text" }),
    make("p", {}, "A file ", make("code", { textContent: "pose.toml" }), " for ",
      make("code", { textContent: "--pose pose.toml" }), ":"), toml,
    make("p", { textContent: "Pinocchio's q:" }), numpy);
  const buttons = make("p", {}, copier("Copy pose", toml), " ", copier("Copy q", numpy));

  let choice = null;
  if (live.choices.length) {
    choice = make("select", { id: "choice" },
      ...live.choices.map((text, k) => make("option", { value: String(k), textContent: text })));
    choice.addEventListener("change", () => ask({ choice: Number(choice.value) }));
  }
  if (moves) {
    const first = make("button", { type: "button", textContent: "Back to the start" });
    first.addEventListener("click", () => ask({ first: true }));
    buttons.prepend(first, " ");
  }

  // -- the panel
  panel.append(make("h1", { textContent: player.title, style: "font-size: 16px; margin: 4px 0" }), status);
  if (!served && (!moves || stand.readouts.length)) {
    status.remove();
    panel.append(make("p", {}, moves ? "Values of other poses than the first are said by "
      : `A page in a file shows one pose: ${live.why}. With sliders: `,
    make("code", { textContent: live.command })), status);
  }
  panel.append(buttons);
  if (choice) panel.append(make("p", {}, make("label", { htmlFor: "choice", textContent: "branch " }), choice));
  panel.append(readouts);
  const headings = [...new Set(live.sliders.map((slider) => slider.group))];
  for (const heading of headings) {
    if (heading) panel.append(make("h2", { textContent: heading }));
    const some = rows.filter((row) => row.slider.group === heading);
    if (moves) {
      for (const { slider, range, number, mark, id } of some) {
        const unit = slider.unit ? ` ${slider.unit}` : "", f = slider.factor;
        const end = (value) => `${+(value * f).toFixed(1)}${unit}`;
        panel.append(make("div", { className: "row" },
          make("span", {}, make("label", { htmlFor: id, textContent: slider.name }), mark),
          make("span", { className: "number" }, number, unit), range,
          make("span", { className: "ends" }, make("span", { textContent: end(slider.low) }),
            make("span", { textContent: slider.note }), make("span", { textContent: end(slider.high) }))));
      }
    } else {
      panel.append(make("table", {}, ...some.map(({ slider, mark }) => {
        const k = live.sliders.indexOf(slider);
        return make("tr", {}, make("td", {}, slider.name, mark),
          make("td", { textContent: `${shown(k)} ${slider.unit}` }));
      })));
    }
  }
  if (live.notes.length) {
    panel.append(make("h2", { textContent: "what there is to say" }), make("ul", { className: "notes" },
      ...live.notes.map((note) => make("li", { textContent: note }))));
  }
  panel.append(pose);

  const made = { answers: 0, move, ask, get stand() { return stand; }, get busy() { return busy; } };
  draw();
  fill();
  return made;
}
