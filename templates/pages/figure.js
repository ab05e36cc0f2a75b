// A picture (modeler/views/figure_page.py) as data and layout of plotly.js. `numbers` are its arrays,
// `width` the pixels that there are. Panels stand on the grid that the picture states; below one
// another where that leaves them too narrow.
const NARROW = 280, GRID = "#e4e4e4", TEXT = "#222";
const LEFT = 62, RIGHT = 14, TOP = 34, BAR = 18, BOTTOM = 46, BETWEEN = 74, BESIDE = 72, SHARED = 34;

// Names of joints and effects are text: nothing in them is a tag.
const plain = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/\n/g, "<br>");

const wrapped = (text, width) => {
  const most = Math.max(12, Math.floor(width / 7.2)), lines = [""];
  for (const word of text.split(" ")) {
    const last = lines[lines.length - 1];
    if (last && last.length + 1 + word.length > most) lines.push(word);
    else lines[lines.length - 1] = last ? `${last} ${word}` : word;
  }
  return lines.join("\n");
};

// Where each panel stands: [panel, left, right, top, bottom], pixels; and the height of it all.
const places = (picture, width) => {
  const names = picture.rows.flat().flatMap((panel) => panel.series.flatMap((s) => s.names || []));
  const extra = 15 * (Math.max(1, ...names.map((name) => name.split("\n").length)) - 1);
  const columns = picture.rows[0].length, room = width - RIGHT;
  const whole = picture.widths.reduce((a, b) => a + b), gaps = LEFT + (columns - 1) * BESIDE;
  const wide = picture.widths.map((share) => (room - gaps) * share / whole);
  const found = [];
  if (columns > 1 && Math.min(...wide) < NARROW) {
    const order = picture.shared
      ? picture.rows[0].flatMap((_, j) => picture.rows.map((row) => row[j]))
      : picture.rows.flat();
    let top = TOP;
    for (const panel of order.filter((each) => each.series.length)) {
      const tall = Math.max(190, Math.min(260, picture.height * 0.55));
      const lines = wrapped(panel.title, room - LEFT).split("\n").length;
      top += 16 * (lines - 1);
      found.push([panel, LEFT, room, top, top + tall]);
      top += tall + BETWEEN + extra;
    }
    return { found, height: top - BETWEEN + BOTTOM, apart: true };
  }
  const between = picture.shared ? SHARED : BETWEEN + extra, rows = picture.rows.length;
  const inner = picture.height - TOP - BAR - BOTTOM - extra - (rows - 1) * between;
  const sum = picture.heights.reduce((a, b) => a + b);
  let top = TOP + BAR; // the buttons of plotly.js stand above the titles
  picture.rows.forEach((row, i) => {
    const tall = inner * picture.heights[i] / sum;
    let left = LEFT;
    row.forEach((panel, j) => {
      found.push([panel, left, left + wide[j], top, top + tall, i, j]);
      left += wide[j] + BESIDE;
    });
    top += tall + between;
  });
  return { found, height: picture.height, apart: false };
};

// The outline of what lies between two curves, one closed piece for each run without a gap.
const outline = (x, low, high) => {
  const found = { x: [], y: [] };
  for (let start = 0, k = 0; k <= x.length; k++) {
    if (k < x.length && Number.isFinite(low[k]) && Number.isFinite(high[k])) continue;
    for (let i = start; i < k; i++) { found.x.push(x[i]); found.y.push(high[i]); }
    for (let i = k - 1; i >= start; i--) { found.x.push(x[i]); found.y.push(low[i]); }
    if (k > start) { found.x.push(null); found.y.push(null); }
    start = k + 1;
  }
  return found;
};

const trace = (series, numbers, axis) => {
  const common = { name: plain(series.label), showlegend: false, legendgroup: series.label,
    xaxis: `x${axis}`, yaxis: `y${axis}`, opacity: series.opacity };
  if (series.kind === "band")
    return { ...common, ...outline(numbers[series.x], numbers[series.low], numbers[series.high]),
      type: "scatter", mode: "lines", line: { width: 0 }, fill: "toself", hoverinfo: "skip",
      fillcolor: series.color };
  const y = numbers[series.y], line = { color: series.color, width: series.width };
  if (series.kind === "bars") {
    const base = series.base === null ? undefined : numbers[series.base];
    return { ...common, type: "bar", x: series.names.map(plain), y, text: series.texts, base,
      textposition: base ? "inside" : "outside", cliponaxis: false, textangle: 0,
      constraintext: "none", marker: { color: series.color } };
  }
  const drawn = { ...common, type: "scatter", x: numbers[series.x], y };
  if (series.kind === "curve")
    return { ...drawn, mode: "lines", line: { ...line, dash: series.dash ? "dash" : "solid" } };
  if (series.kind === "points")
    return { ...drawn, mode: "markers", marker: { color: series.color, size: series.width + 1 } };
  return { ...drawn, mode: series.width ? "lines+markers" : "markers", line,
    marker: { color: series.color, size: 5 },
    error_y: { array: numbers[series.error], thickness: 1, width: 2 } };
};

// Lines and shaded intervals of a panel; whole heights are in parts of the panel.
const shapes = (panel, n) => {
  const found = [];
  if (panel.zero) found.push({ type: "line", xref: `x${n} domain`, yref: `y${n}`, x0: 0, x1: 1,
    y0: 0, y1: 0, layer: "below", line: { color: "#666", width: 0.8 } });
  for (const [color, ends] of panel.spans) for (const [start, end] of ends)
    found.push({ type: "rect", xref: `x${n}`, yref: `y${n} domain`, x0: start, x1: end, y0: 0,
      y1: 1, layer: "below", fillcolor: color, line: { width: 0 } });
  for (const [start, end] of panel.shade ? [panel.shade] : [])
    found.push({ type: "rect", xref: `x${n}`, yref: `y${n} domain`, x0: start, x1: end, y0: 0,
      y1: 1, layer: "below", fillcolor: "#D0D0D0", line: { width: 0 } });
  for (const [at] of panel.marks) found.push({ type: "line", xref: `x${n}`, yref: `y${n} domain`,
    x0: at, x1: at, y0: 0, y1: 1, line: { color: "#888", width: 0.8, dash: "dot" } });
  return found;
};

const notes = (panel, n, title) => [
  { text: plain(title), showarrow: false, xref: `x${n} domain`, yref: `y${n} domain`, x: 0, y: 1,
    xanchor: "left", yanchor: "bottom", align: "left", yshift: 4, font: { size: 13 } },
  ...panel.marks.filter(([, text]) => text).map(([at, text]) => ({ text: plain(text),
    showarrow: false, xref: `x${n}`, yref: `y${n} domain`, x: at, y: 1, xanchor: "left",
    yanchor: "top", font: { size: 12 } })),
];

const axes = (panel, n, bars) => {
  const log = panel.log ? { type: "log", dtick: 1 } : {};
  const common = { gridcolor: GRID, zeroline: false, automargin: false };
  return {
    [`xaxis${n}`]: { ...common, ...log, ...(bars ? { type: "category" } : {}), anchor: `y${n}`,
      title: { text: plain(panel.x), standoff: 4 },
      ...(panel.xrange ? { range: panel.xrange } : {}) },
    [`yaxis${n}`]: { ...common, ...log, ...(panel.log ? { exponentformat: "e" } : {}),
      anchor: `x${n}`, title: { text: plain(panel.y), standoff: 4 },
      ...(panel.yrange ? { range: panel.yrange } : {}) },
  };
};

const figure = (picture, numbers, width) => {
  const { found, height, apart } = places(picture, width);
  const layout = { height, margin: { l: 0, r: 0, t: 0, b: 0 }, showlegend: false, shapes: [],
    annotations: [], paper_bgcolor: "#fff", plot_bgcolor: "#fff", hovermode: "closest",
    barmode: "overlay", font: { family: "system-ui, sans-serif", size: 12, color: TEXT } };
  const data = [], tops = {};
  found.forEach(([panel, left, right, top, bottom, i, j], k) => {
    if (!panel.series.length) return;
    const n = k ? k + 1 : "", bars = panel.series.some((series) => series.kind === "bars");
    Object.assign(layout, axes(panel, n, bars));
    const x = layout[`xaxis${n}`], y = layout[`yaxis${n}`];
    x.domain = [left / width, right / width];
    y.domain = [1 - bottom / height, 1 - top / height];
    if (picture.shared && !apart) {
      if (i < picture.rows.length - 1) Object.assign(x, { showticklabels: false, title: undefined });
      if (tops[j]) x.matches = tops[j];
      else tops[j] = `x${n}`;
    }
    data.push(...panel.series.map((series) => trace(series, numbers, n)));
    layout.shapes.push(...shapes(panel, n));
    layout.annotations.push(...notes(panel, n, wrapped(panel.title, right - left)));
  });
  return { data, layout };
};

// The numbers behind a picture: panel, series, x, y, error; all digits that the page holds.
const csv = (picture, numbers) => {
  const name = (text) => text.replace(/,/g, ";").replace(/\n/g, " ");
  const digits = (array, k) => {
    if (!array || !Number.isFinite(array[k])) return "";
    return String(Number(array[k].toPrecision(array instanceof Float32Array ? 8 : 15)));
  };
  const lines = ["panel,series,x,y,error"];
  for (const panel of picture.rows.flat()) for (const series of panel.series) {
    const y = numbers[series.y], error = numbers[series.error], x = numbers[series.x];
    const head = `${name(panel.title)},${name(series.label)}`;
    if (series.kind === "band") {
      const low = numbers[series.low], high = numbers[series.high];
      const middle = low.map((value, k) => 0.5 * (value + high[k]));
      const half = low.map((value, k) => 0.5 * (high[k] - value));
      x.forEach((_, k) => Number.isFinite(middle[k]) &&
        lines.push(`${head},${digits(x, k)},${digits(middle, k)},${digits(half, k)}`));
      continue;
    }
    y.forEach((value, k) => {
      const at = x ? digits(x, k) : name(series.names[k]);
      if (Number.isFinite(value)) lines.push(`${head},${at},${digits(y, k)},${digits(error, k)}`);
    });
  }
  return `${lines.join("\n")}\n`;
};
