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
  const xs = Object.keys(layout).filter((key) => /^xaxis/.test(key)), count = xs.length;
  const y = (key) => key.replace("x", "y");
  const middle = (key) => (layout[key].domain[0] + layout[key].domain[1]) / 2;
  const beside = xs.every((key) => middle(y(key)) === middle(y(xs[0])));
  if (window.innerWidth > NARROW || count < 2 || !beside) return false;
  const titles = (layout.annotations || []).filter((title) => title.xref === "paper");
  const owners = titles.map((title) => xs.findIndex((key) => Math.abs(title.x - middle(key)) < 1e-6));
  layout.margin = { ...layout.margin, l: 52, t: 86 };
  layout.height = 270 * count + 134;
  const gap = 74 / (270 * count), each = (1 - (count - 1) * gap) / count;
  xs.forEach((key, i) => {
    const top = 1 - i * (each + gap);
    layout[y(key)].domain = [Math.max(0, top - each), top];
    layout[key].domain = [0, 1];
  });
  titles.forEach((title, k) => {
    if (owners[k] >= 0) Object.assign(title, { x: 0.5, y: layout[y(xs[owners[k]])].domain[1] });
  });
  place.style.height = `${layout.height}px`;
  place.classList.add("stacked");
  return true;
};
const draw = (place) => {
  const picture = JSON.parse(place.nextElementSibling.textContent);
  const small = stack(place, picture.layout);
  Plotly.newPlot(place, picture.data, picture.layout, small ? { ...options, displayModeBar: false } : options);
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
