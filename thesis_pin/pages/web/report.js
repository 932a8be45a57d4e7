"use strict";
// Draws the report's plots and ties them to the animation's clock.

const HIGH = 380, ROW = 20, USUAL = 2;  // of a plot, of a legend's row, and rows there is room for

// Height that a legend takes besides: it has as many columns as its longest name lets.
function legendRoom(data, width) {
  const names = [...new Set(data.filter((one) => one.showlegend !== false).map((one) => one.name))];
  const longest = Math.max(...names.map((name) => name.length), 1);
  const columns = Math.max(1, Math.floor((width - 90) / (48 + 6.5 * longest)));
  return ROW * Math.max(0, Math.ceil(names.length / columns) - USUAL);
}

async function drawPlots(figures) {
  // A finger on a plot scrolls the page; a mouse draws a box to zoom, a double click resets.
  const dragmode = window.matchMedia("(pointer: coarse)").matches ? false : "zoom";
  const elements = [...document.querySelectorAll(".plot .canvas")];
  for (const [k, element] of elements.entries()) {
    element.parentElement.style.height = `${HIGH + legendRoom(figures[k].data, element.clientWidth)}px`;
    await Plotly.newPlot(element, figures[k].data, { ...figures[k].layout, dragmode },
      { responsive: true, displayModeBar: false });
  }
  return elements;
}

// A line over each plot of time; where it stands follows from the fixed margins and the axis'
// range. Plots are measured when they change, so that a frame costs one style each.
function tieToClock(player, elements, margins) {
  const plots = elements.filter((element) => element.dataset.time === "yes").map((element) => {
    const cursor = document.createElement("div");
    cursor.className = "cursor";
    element.parentElement.append(cursor);
    return { element, cursor };
  });
  const move = () => {
    const t = player.time + player.start;
    for (const { cursor, low, high, width } of plots) {
      const share = (t - low) / (high - low);
      cursor.style.visibility = share >= 0 && share <= 1 ? "visible" : "hidden";
      cursor.style.transform = `translateX(${margins.l + share * width}px)`;
    }
  };
  const measure = () => {
    for (const plot of plots) {
      [plot.low, plot.high] = plot.element.layout.xaxis.range;
      plot.width = plot.element.clientWidth - margins.l - margins.r;
      const area = plot.element.querySelector(".nsewdrag");
      if (area) plot.cursor.style.height = `${area.getBoundingClientRect().height}px`;
    }
    move();
  };
  for (const { element } of plots) {
    element.on("plotly_click", (event) => {
      player.pause();
      player.time = event.points[0].x - player.start;
    });
    element.on("plotly_afterplot", measure);
  }
  player.onTime(move);
  measure();
}

// Width of what a printed page holds, in CSS pixels: A4 or Letter, upright, without its margins.
const PAPER = 690;

// The robot at its start, middle and end, on canvases that are printed in place of the player.
function drawMoments(player) {
  const make = (tag, more, ...children) => {
    const element = Object.assign(document.createElement(tag), more);
    element.append(...children);
    return element;
  };
  const pictures = make("div", { className: "pictures" }), { duration } = player;
  const moments = duration > 0 ? [["start", 0], ["middle", duration / 2], ["end", duration]]
    : [["the pose", 0]];
  player.stage.pictures(720, 620, moments.map(([, time]) => time), player, (source, k) => {
    const [name, time] = moments[k];
    const canvas = make("canvas", { width: source.width, height: source.height });
    canvas.getContext("2d").drawImage(source, 0, 0);
    pictures.append(make("figure", {}, canvas,
      make("figcaption", { textContent: `${name}, ${time.toFixed(2)} s` })));
  });
  // What the colours mean, as the legend has it, of what is shown.
  const legend = make("ul", {});
  for (const line of document.querySelectorAll("#player .legend li")) {
    if (!line.querySelector("input").checked) continue;
    const copy = line.cloneNode(true);
    copy.querySelectorAll("input, kbd").forEach((element) => element.remove());
    legend.append(copy);
  }
  const notes = player.notes.map((textContent) => make("p", { textContent, className: "note" }));
  document.getElementById("moments").replaceChildren(pictures, legend, ...notes);
}

// Before it goes to paper: the robot as pictures, and what is wider than a page made to fit.
function prepareForPaper(player) {
  addEventListener("beforeprint", () => {
    for (const element of document.querySelectorAll(".plot, .drawing svg, .scroll table")) {
      const wide = element.getBoundingClientRect().width;
      const shrunk = element.matches("svg") ? element.parentElement : element;
      shrunk.style.setProperty("--fit", Math.min(1, PAPER / wide));
    }
    if (player) drawMoments(player);
  });
}

async function showReport(margins) {
  const stage = document.getElementById("player"), plots = document.getElementById("plots");
  let player = null;
  if (stage) {
    try {
      await loadLibrary("meshcat");
      player = makePlayer(stage, decodeScene(await unpack("scene")), { embedded: true });
    } catch (error) {
      complain(stage, error);  // the plots may still work
    }
  }
  if (plots) {
    try {
      await loadLibrary("plotly");
      const figures = JSON.parse(new TextDecoder().decode(await unpack("figures")));
      const elements = await drawPlots(figures);
      if (player) tieToClock(player, elements, margins);
    } catch (error) {
      complain(plots, error);
    }
  }
  prepareForPaper(player);
  window.player = player;
  window.ready = true;
}
