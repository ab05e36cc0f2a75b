"use strict";
// Pictures whose layout says meta.time = NAME share one cursor and one zoom with all others of that
// name. The cursor is an event "studio-time" {time, at, by} of the window, told by whoever moves it.

(() => {
  const cursors = new Map(); // NAME -> seconds

  const name = (plot) => plot._fullLayout?.meta?.time || "";
  const plots = () => [...document.querySelectorAll(".js-plotly-plot")].filter(name);
  // The x axes of a picture; panels below each other have alike ones.
  const axes = (plot) => Object.keys(plot._fullLayout).filter((key) => /^xaxis\d*$/.test(key))
    .map((key) => plot._fullLayout[key]).filter((axis) => axis._offset !== undefined);

  // The cursor: a line over each picture, placed without drawing the picture anew.

  const show = (plot) => {
    const at = cursors.get(name(plot)), axis = axes(plot)[0];
    let line = plot.querySelector(":scope > .studio-cursor");
    const x = at === undefined || !axis ? NaN : axis._offset + axis.l2p(at);
    const inside = x >= axis?._offset && x <= axis?._offset + axis?._length;
    if (!line) {
      line = document.createElement("div");
      line.className = "studio-cursor";
      line.append(document.createElement("span"));
      plot.append(line);
    }
    line.hidden = !inside;
    if (!inside) return;
    const size = plot._fullLayout._size;
    Object.assign(line.style, { left: `${x}px`, top: `${size.t}px`, height: `${size.h}px` });
    line.firstChild.textContent = `${at.toFixed(3)} s`;
  };

  const heard = ({ detail: { time, at } }) => {
    cursors.set(time, at);
    for (const plot of plots()) if (name(plot) === time) show(plot);
  };

  const timeAt = (plot, event) => {
    const box = plot.getBoundingClientRect(), size = plot._fullLayout._size;
    const x = event.clientX - box.left, y = event.clientY - box.top;
    if (y < size.t || y > size.t + size.h) return null;
    const axis = axes(plot).find((own) => x >= own._offset && x <= own._offset + own._length);
    return axis ? axis.p2l(x - axis._offset) : null;
  };

  const pointed = (plot, event) => {
    const at = event.buttons ? null : timeAt(plot, event);
    if (at === null || cursors.get(name(plot)) === at) return;
    window.dispatchEvent(new CustomEvent("studio-time", { detail: { time: name(plot), at, by: plot } }));
  };

  // The zoom: what one picture shows of time, the others show too.

  const rangeOf = (change) => {
    for (const [key, value] of Object.entries(change)) {
      if (/^xaxis\d*\.autorange$/.test(key) && value) return "all";
      if (/^xaxis\d*\.range$/.test(key)) return value;
      const first = key.match(/^(xaxis\d*)\.range\[0\]$/);
      if (first) return [value, change[`${first[1]}.range[1]`]];
    }
    return null;
  };

  const zoomed = async (plot, change) => {
    const range = rangeOf(change);
    if (!range || plot.studioFollows) return;
    const { Plotly } = await import("nicegui-plotly");
    for (const other of plots()) {
      if (other === plot || name(other) !== name(plot)) continue;
      other.studioFollows = true; // it tells the server of its own zoom, but nobody here
      const told = Object.fromEntries(Object.keys(other._fullLayout)
        .filter((key) => /^xaxis\d*$/.test(key))
        .map((key) => (range === "all" ? [`${key}.autorange`, true] : [`${key}.range`, [...range]])));
      await Plotly.relayout(other, told);
      other.studioFollows = false;
    }
  };

  // Pictures come and go with the screens.

  const met = () => {
    for (const plot of plots()) {
      if (plot.studioMet || !plot.on) continue;
      plot.studioMet = true;
      plot.on("plotly_relayout", (change) => zoomed(plot, change));
      plot.on("plotly_afterplot", () => show(plot));
      plot.addEventListener("mousemove", (event) => pointed(plot, event));
      show(plot);
    }
  };

  // A picture that went away while it was being resized.
  window.addEventListener("unhandledrejection", (event) => {
    if (/displayed plot div/.test(event.reason?.message ?? event.reason)) event.preventDefault();
  });
  window.addEventListener("studio-time", heard);
  document.addEventListener("DOMContentLoaded", () => {
    let waiting = 0;
    const soon = () => { waiting ||= setTimeout(() => { waiting = 0; met(); }, 100); };
    new MutationObserver(soon).observe(document.body, { childList: true, subtree: true });
    soon();
  });
})();

// Back and forward of the browser.
window.addEventListener("popstate", () => location.reload());
