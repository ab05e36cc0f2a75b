// The robot in its frame, and the table whose cells are edited beside it.

// Messages to the page of `modeler show` in the frame of that id; before it is ready the last of
// each kind waits.
function toRobot(id, message) {
  const frame = document.getElementById(id);
  if (!frame) return;
  frame.waiting ??= new Map();
  if (frame.ready) frame.contentWindow.postMessage(message, location.origin);
  else frame.waiting.set(message.modeler, message);
}

window.addEventListener("message", (event) => {
  if (event.origin !== location.origin || !event.data?.modeler) return;
  for (const frame of document.querySelectorAll("iframe.studio-robot")) {
    if (frame.contentWindow !== event.source) continue;
    const { modeler, ...told } = event.data;
    if (modeler === "ready" || modeler === "drawn") frame.standing = told;
    if (modeler === "ready") {
      frame.ready = true;
      for (const message of frame.waiting?.values() ?? []) frame.contentWindow.postMessage(message, location.origin);
      frame.waiting?.clear();
    }
    if (modeler === "joint" || modeler === "pointed") frame.dispatchEvent(new CustomEvent(modeler, { detail: told.name }));
  }
});

// What names rows of the robot lights them up, under the mouse and in the keyboard's focus.
function lightRows(event) {
  const named = event.target.closest?.("[data-rows]");
  const rows = named ? named.dataset.rows.split(" ").filter(Boolean) : [];
  for (const frame of document.querySelectorAll("iframe.studio-robot")) {
    if (frame.lit === rows.join(" ")) continue;
    frame.lit = rows.join(" ");
    toRobot(frame.id, { modeler: "light", rows });
  }
}
document.addEventListener("mouseover", lightRows);
document.addEventListener("focusin", lightRows);

// A table of cells. Told by events of its element: "cell" {row, column, text}, "block" {row,
// column, text} of what was pasted, "row" {row, what}, "step" "undo" or "redo".
function showCells(id, { columns, rows, wrong, line, reading, all, names, fixed }) {
  const host = document.getElementById(id);
  if (!host) return;
  const shape = JSON.stringify([columns, rows.length, reading, fixed]);
  if (host.shape !== shape) {
    host.shape = shape;
    host.replaceChildren(cellTable(host, columns, rows, reading, fixed));
  }
  rows.forEach((cells, row) => cells.forEach((text, column) => {
    const input = cellAt(host, row, column);
    if (!input || (input === document.activeElement && !all)) return;
    if (input.value !== text) input.value = text;
    roomFor(input);
  }));
  host.querySelectorAll("tbody tr").forEach((line, row) => { line.dataset.rows = (names[row] ?? []).join(" "); });
  host.querySelectorAll(".wrong").forEach((place) => place.classList.remove("wrong"));
  host.querySelectorAll("[aria-invalid]").forEach((input) => { input.removeAttribute("aria-invalid"); input.title = ""; });
  if (!wrong) return;
  const [row, column] = wrong, places = column < 0 ? [...columns.keys()] : [column];
  for (const k of places) {
    const place = row < 0 ? host.querySelectorAll("th")[k] : cellAt(host, row, k)?.parentElement;
    place?.classList.add("wrong");
    const input = place?.querySelector("input");
    input?.setAttribute("aria-invalid", "true");
    if (input) input.title = line;
  }
}

const roomFor = (input) => { input.style.minWidth = `${Math.max(5, input.value.length + 2)}ch`; };

// The cursor goes to the row of a joint.
function focusRow(id, name, tries = 20) {
  const line = [...document.querySelectorAll(`#${id} tbody tr`)].find((row) => row.dataset.rows.split(" ").includes(name));
  const input = line?.querySelector("input");
  input?.focus();
  if (input !== document.activeElement && tries > 0) setTimeout(() => focusRow(id, name, tries - 1), 50); // hidden still
}

const cellAt = (host, row, column) => host.querySelector(`input[data-row="${row}"][data-column="${column}"]`);

function cellTable(host, columns, rows, reading, fixed) {
  const node = (tag, fields = {}, ...children) => {
    const made = Object.assign(document.createElement(tag), fields);
    made.append(...children);
    return made;
  };
  const tell = (what, detail) => host.dispatchEvent(new CustomEvent(what, { detail }));
  const button = (row, what, sign, title) => node("button", { type: "button", textContent: sign, title, ariaLabel: title, tabIndex: -1, onclick: () => tell("row", { row, what }) });
  const cell = (row, column, name) => {
    const input = node("input", { type: "text", size: 4, spellcheck: false, autocomplete: "off", readOnly: reading || column < fixed, ariaLabel: `row ${row + 1}, column ${name}` });
    Object.assign(input.dataset, { row, column });
    let later = 0;
    input.addEventListener("input", () => {
      roomFor(input);
      clearTimeout(later);
      later = setTimeout(() => tell("cell", { row, column, text: input.value }), 200);
    });
    input.addEventListener("paste", (event) => {
      const text = event.clipboardData.getData("text/plain");
      if (reading || !/[\t\n]/.test(text.replace(/\n$/, ""))) return;
      event.preventDefault();
      tell("block", { row, column, text });
    });
    input.addEventListener("keydown", (event) => {
      const end = input.selectionStart === input.selectionEnd;
      const to = {
        ArrowUp: [row - 1, column], ArrowDown: [row + 1, column], Enter: [row + (event.shiftKey ? -1 : 1), column],
        ArrowLeft: end && input.selectionStart === 0 ? [row, column - 1] : null,
        ArrowRight: end && input.selectionEnd === input.value.length ? [row, column + 1] : null,
      }[event.key];
      const next = to && cellAt(host, ...to);
      if (event.ctrlKey || event.metaKey) {
        if (event.key.toLowerCase() === "z") { event.preventDefault(); tell("step", event.shiftKey ? "redo" : "undo"); }
        else if (event.key.toLowerCase() === "y") { event.preventDefault(); tell("step", "redo"); }
        else if (event.key === "Enter") { event.preventDefault(); tell("row", { row, what: "add" }); }
        else if (event.key === "Delete") { event.preventDefault(); tell("row", { row, what: "remove" }); }
      } else if (next) { event.preventDefault(); next.focus(); next.select(); }
    });
    return node("td", {}, input);
  };
  const head = node("tr", {}, ...columns.map((name) => node("th", { textContent: name, scope: "col" })), node("th"));
  const lines = rows.map((cells, row) => {
    const line = node("tr", {}, ...cells.map((_, column) => cell(row, column, columns[column] ?? "")));
    line.append(node("td", {}, ...(reading || fixed ? [] : [button(row, "add", "+", "a row below (Ctrl+Enter)"), button(row, "remove", "\u2212", "remove this row (Ctrl+Delete)")])));
    return line;
  });
  return node("table", { className: "studio-cells" }, node("thead", {}, head), node("tbody", {}, ...lines));
}
