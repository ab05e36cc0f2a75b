// The numbers behind a figure (modeler/views/figure_plotly.py): panel, series, x, y, error.
// A band is an outline: of each closed piece the upper curve forwards, then the lower one back.
const csv = ({ data }) => {
  const plain = (text) => String(text).replace(/<br>|\n/g, " ").replace(/&lt;/g, "<")
    .replace(/&amp;/g, "&").replace(/,/g, ";");
  const lines = ["panel,series,x,y,error"];
  for (const { meta, name, x, y, error_y: whiskers, fill } of data) {
    const head = `${plain(meta)},${plain(name)}`;
    if (!fill) y.forEach((value, k) => value !== null &&
      lines.push(`${head},${plain(x[k] ?? "")},${value},${whiskers?.array[k] ?? ""}`));
    for (let start = 0, end; fill && start < y.length; start = end + 1) {
      end = y.indexOf(null, start);
      for (let k = start; k < (start + end) / 2; k++) {
        const low = y[start + end - 1 - k];
        lines.push(`${head},${x[k]},${0.5 * (y[k] + low)},${0.5 * (y[k] - low)}`);
      }
    }
  }
  return `${lines.join("\n")}\n`;
};
