// A picture is drawn when it comes near the screen: a page of many joints opens at once.
// plotly.js would offer to send the chart to a server, outside what the page's policy can refuse:
// no such button, and no address.
const options = {
  responsive: true, displaylogo: false, showSendToCloud: false, plotlyServerURL: "",
  modeBarButtonsToRemove: ["lasso2d", "select2d", "sendChartToCloud"],
};
// Panels side by side stand below one another on a small screen: nothing has to be pushed aside.
const NARROW = 700;
const stack = (place, layout) => {
  const xs = Object.keys(layout).filter((key) => /^xaxis/.test(key));
  const ys = xs.map((key) => key.replace("x", "y"));
  const middle = (key) => (layout[key].domain[0] + layout[key].domain[1]) / 2;
  if (window.innerWidth > NARROW || ys.some((key) => middle(key) !== middle(ys[0]))) return;
  const height = layout.height, room = 48 / height, titles = layout.annotations || [];
  xs.forEach((key, i) => {
    const title = titles.find((t) => t.xref === "paper" && Math.abs(t.x - middle(key)) < 1e-6);
    const top = 1 - i / xs.length;
    layout[ys[i]].domain = [top - (1 - room) / xs.length, top - (i ? room / xs.length : 0)];
    if (title) Object.assign(title, { moved: true, to: layout[ys[i]].domain[1] });
  });
  xs.forEach((key) => { layout[key].domain = [0, 1]; });
  titles.filter((t) => t.moved).forEach((t) => {
    Object.assign(t, { x: 0.5, y: t.to });
    delete t.moved;
    delete t.to;
  });
  layout.margin = { ...layout.margin, l: 52, t: 110 };
  layout.height = height * xs.length * 0.8 + 60;
  place.style.height = `${layout.height}px`;
  place.classList.add("stacked");
};
const draw = (place) => {
  const picture = JSON.parse(place.nextElementSibling.textContent);
  stack(place, picture.layout);
  Plotly.newPlot(place, picture.data, picture.layout, options);
};
const watcher = new IntersectionObserver((entries) => {
  for (const entry of entries) {
    if (entry.isIntersecting) {
      watcher.unobserve(entry.target);
      draw(entry.target);
    }
  }
}, { rootMargin: "800px" });
const plots = document.querySelectorAll(".plot");
plots.forEach((place) => watcher.observe(place));
window.addEventListener("beforeprint", () => plots.forEach((place) => {
  if (!place.classList.contains("js-plotly-plot")) {
    watcher.unobserve(place);
    draw(place);
  }
}));
