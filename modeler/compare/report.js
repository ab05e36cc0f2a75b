// A picture is drawn when it comes near the screen: a page of many joints opens at once.
// plotly.js would offer to send the chart to a server, outside what the page's policy can refuse:
// no such button, and no address.
const options = {
  responsive: true, displaylogo: false, showSendToCloud: false, plotlyServerURL: "",
  modeBarButtonsToRemove: ["lasso2d", "select2d", "sendChartToCloud"],
};
const draw = (place) => {
  const picture = JSON.parse(place.nextElementSibling.textContent);
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
