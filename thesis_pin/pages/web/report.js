"use strict";
// Draws the report's plots and ties them to the animation's clock.

async function drawPlots(figures) {
  // A finger on a plot scrolls the page; a mouse draws a box to zoom, a double click resets.
  const dragmode = window.matchMedia("(pointer: coarse)").matches ? false : "zoom";
  const elements = [...document.querySelectorAll(".plot .canvas")];
  for (const [k, element] of elements.entries()) {
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
  window.player = player;
  window.ready = true;
}
