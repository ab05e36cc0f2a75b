// Unpacks plotly.js and the numbers, and draws a picture when it comes near the screen: a page of
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

// Of an array the bytes of one significance stand together, highest first. Two bytes are a level
// between the lowest and the highest value; the last level is no number.
const arrays = (kinds, bytes) => {
  let at = 0;
  return kinds.map(([count, size, low, step]) => {
    const own = new Uint8Array(count * size);
    for (let plane = 0; plane < size; plane++)
      for (let k = 0; k < count; k++) own[k * size + size - 1 - plane] = bytes[at++];
    if (size === 8) return new Float64Array(own.buffer);
    if (size === 4) return new Float32Array(own.buffer);
    return Float64Array.from(new Uint16Array(own.buffer), (n) => (n === 65535 ? NaN : low + n * step));
  });
};

const draw = (place, numbers) => {
  const picture = JSON.parse(place.nextElementSibling.textContent);
  const { data, layout } = figure(picture, numbers, place.clientWidth);
  place.style.height = `${layout.height}px`;
  const bar = window.innerWidth < 700 ? { displayModeBar: false } : {};
  return Plotly.react(place, data, { ...layout, width: place.clientWidth }, { ...options, ...bar });
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

const offer = (place, numbers) => {
  const link = place.closest("figure").querySelector("a[download]");
  link.hidden = false;
  link.addEventListener("click", () => {
    const picture = JSON.parse(place.nextElementSibling.textContent);
    const file = new Blob([csv(picture, numbers)], { type: "text/csv" });
    link.href = URL.createObjectURL(file);
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  });
};

const start = async () => {
  if (typeof DecompressionStream === "undefined") {
    throw new Error("it lacks DecompressionStream, which browsers have since 2023");
  }
  const read = (id) => document.getElementById(id).textContent;
  const held = JSON.parse(read("numbers"));
  const numbers = arrays(held.arrays, await unpacked(held.data));
  const script = document.createElement("script");
  script.textContent = new TextDecoder().decode(await unpacked(read("plotly")));
  document.head.append(script);
  plots.forEach((place) => { listen(place); offer(place, numbers); });
  const watcher = new IntersectionObserver((entries) => {
    for (const entry of entries.filter((each) => each.isIntersecting)) {
      watcher.unobserve(entry.target);
      draw(entry.target, numbers);
    }
  }, { rootMargin: "800px" });
  plots.forEach((place) => watcher.observe(place));
  const drawn = () => plots.filter((place) => place.classList.contains("js-plotly-plot"));
  let width = window.innerWidth;
  window.addEventListener("resize", () => {
    if (window.innerWidth !== width) drawn().forEach((place) => draw(place, numbers));
    width = window.innerWidth;
  });
  window.addEventListener("beforeprint", () => plots.forEach((place) => {
    watcher.unobserve(place);
    draw(place, numbers);
  }));
};

start().catch((error) => plots.forEach((place) => {
  place.style.height = "auto";
  place.textContent = `This browser cannot draw the picture: ${error.message}. Tables and text are whole.`;
}));
