// Unpacks plotly.js and the figures, and draws a picture when it comes near the screen: a page of
// many joints opens at once. plotly.js would offer to send the chart to a server, outside what the
// page's policy can refuse: no such button, and no address.
const options = {
  responsive: false, displaylogo: false, showSendToCloud: false, plotlyServerURL: "",
  modeBarButtonsToRemove: ["lasso2d", "select2d", "sendChartToCloud"],
};
const plots = [...document.querySelectorAll(".plot")];

const unpacked = async (text) => {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
};

const draw = (place, { data, layout, narrow, below }) => {
  const width = place.clientWidth, own = structuredClone(width < below ? narrow : layout);
  place.style.height = `${own.height}px`;
  const bar = window.innerWidth < 700 ? { displayModeBar: false } : {};
  return Plotly.react(place, data, { ...own, width }, { ...options, ...bar });
};

// Keys above a picture take a series away and bring it back.
const listen = (place) => place.parentElement.querySelectorAll(".keys button").forEach((key) => {
  key.addEventListener("click", () => {
    const shown = key.getAttribute("aria-pressed") !== "true";
    key.setAttribute("aria-pressed", shown);
    if (!place.data) return;
    const own = place.data.flatMap((t, k) => (t.legendgroup === key.dataset.series ? [k] : []));
    Plotly.restyle(place, { visible: shown }, own);
  });
});

const offer = (place, figure) => {
  const link = place.closest("figure").querySelector("a[download]");
  link.hidden = false;
  link.addEventListener("click", () => {
    const file = new Blob([csv(figure)], { type: "text/csv" });
    link.href = URL.createObjectURL(file);
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  });
};

const start = async () => {
  if (typeof DecompressionStream === "undefined") {
    throw new Error("it lacks DecompressionStream, which browsers have since 2023");
  }
  const text = async (id) => new TextDecoder().decode(await unpacked(document.getElementById(id).textContent));
  const figures = JSON.parse(await text("figures"));
  const figure = (place) => figures[plots.indexOf(place)];
  const script = document.createElement("script");
  script.textContent = await text("plotly");
  document.head.append(script);
  plots.forEach((place) => { listen(place); offer(place, figure(place)); });
  const watcher = new IntersectionObserver((entries) => {
    for (const entry of entries.filter((each) => each.isIntersecting)) {
      watcher.unobserve(entry.target);
      draw(entry.target, figure(entry.target));
    }
  }, { rootMargin: "800px" });
  plots.forEach((place) => watcher.observe(place));
  const drawn = () => plots.filter((place) => place.classList.contains("js-plotly-plot"));
  let width = window.innerWidth;
  window.addEventListener("resize", () => {
    if (window.innerWidth !== width) drawn().forEach((place) => draw(place, figure(place)));
    width = window.innerWidth;
  });
  window.addEventListener("beforeprint", () => plots.forEach((place) => {
    watcher.unobserve(place);
    draw(place, figure(place));
  }));
};

start().catch((error) => plots.forEach((place) => {
  place.style.height = "auto";
  place.textContent = `This browser cannot draw the picture: ${error.message}. Tables and text are whole.`;
}));
