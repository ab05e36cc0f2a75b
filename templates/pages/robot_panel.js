// What the user moves, and what stands beside the picture.

let robot = JSON.parse(document.getElementById("content").textContent);
const element = (id) => document.getElementById(id);
const made = (tag, fields = {}, ...children) => {
  const node = Object.assign(document.createElement(tag), fields);
  node.append(...children);
  return node;
};
const rowOf = (k) => robot.rows.find((row) => row.name === robot.variables[k]);
const rounded = (x, digits) => (Math.abs(x) < 1e-12 ? "0" : String(+x.toPrecision(digits)));
const minusSign = (text) => text.replaceAll("-", "−");
const degrees = (x) => `${minusSign(((180 / Math.PI) * x).toFixed(1))}°`;
const told = (row, q) => (row.unit === "rad" ? degrees(q) : `${minusSign((1000 * q).toFixed(1))} mm`);

const page = {
  robot,
  u: [...robot.home],
  byHand: !robot.is_closed,
  view: new View(element("picture"), robot),
  sliders: [],
  poses: () => posesAt(robot, page.u),
  gaps: () => gapsAt(robot, page.u),
};
window.modelerShow = page;

const every = () => robot.variables.map((_, k) => k);
const follow = () => every().filter((k) => !robot.actuated_variables.includes(k));

let waiting = false;
function redraw() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => { waiting = false; page.view.draw(page.poses()); });
}

function say(text) {
  element("message").textContent = text;
}

// Move one joint: the loops follow, as far as they close.
page.move = (k, value) => {
  if (page.byHand || robot.loops.length === 0) {
    page.u[k] = value;
    say("");
    show();
    return true;
  }
  const values = robot.actuated_variables.map((g) => (g === k ? value : page.u[g]));
  const { u, reached } = ledTo(robot, page.u, values);
  page.u = u;
  say(reached ? "" : `cannot close there: q${robot.variables[k]} stops at ${rounded(u[k], 5)} ${rowOf(k).unit}`);
  show(reached ? null : k);
  return reached;
};

// Move joints by name at once: {joint: value}; others stay, or follow where loops tie them.
page.pose = (q) => {
  const want = (k) => (Number.isFinite(q[robot.variables[k]]) ? q[robot.variables[k]] : page.u[k]);
  if (page.byHand || robot.loops.length === 0) {
    page.u = every().map(want);
    say("");
    show();
    return true;
  }
  const values = robot.actuated_variables.map(want);
  let found = ledTo(robot, page.u, values);
  if (!found.reached) {
    const around = ledTo(robot, robot.home, values);
    if (around.reached) found = around;
  }
  page.u = found.u;
  say(found.reached ? "" : "cannot close there: the joints stop where the loops do");
  show();
  return found.reached;
};

// Another robot in the same picture: the eye stays where it is, and joints that were moved too.
page.replace = (content) => {
  const moved = page.u.some((x, k) => x !== robot.home[k]);
  const q = moved ? Object.fromEntries(robot.variables.map((name, k) => [name, page.u[k]])) : {};
  robot = page.robot = content;
  page.u = [...robot.home];
  page.byHand = !robot.is_closed;
  page.view.replace(robot);
  element("mdh")?.remove();
  element("note").textContent = robot.note;
  begin();
  if (moved) page.pose(q);
  if (page.view.filled(page.poses()) < 0.3) fit();
};

// The value of a cell of the table, as the robot stands.
function now(row, name) {
  const own = { revolute: "theta", prismatic: "r" }[row.kind];
  return row.cells[name] + (name === own ? row.rate * variable(row, page.u) : 0);
}

function slider(k) {
  const row = rowOf(k), [low, high] = robot.ranges[k], name = `q${row.name}`;
  const range = made("input", { type: "range", min: low, max: high, step: "any", ariaLabel: name });
  const number = made("input", { type: "number", step: "any", ariaLabel: name });
  const value = made("span");
  const line = made("div", { className: row.actuated ? "joint actuated" : "joint" },
    made("b", { textContent: name, title: `${row.kind}, ${row.actuated ? "actuated" : "passive"}`, onclick: () => tell("joint", { name: row.name }) }), range, number, value);
  let dragged = false;
  range.addEventListener("input", () => { dragged = true; page.move(k, +range.value); });
  range.addEventListener("change", () => { dragged = false; show(); });
  number.addEventListener("change", () => { if (Number.isFinite(number.valueAsNumber)) page.move(k, number.valueAsNumber); else show(); });
  line.addEventListener("mouseenter", () => point(robot.rows.indexOf(row)));
  line.addEventListener("mouseleave", () => point(null));
  const update = (stopped) => {
    const q = page.u[k];
    if (!dragged) {
      if (q < +range.min) range.min = q;
      if (q > +range.max) range.max = q;
      range.value = q;
    }
    if (document.activeElement !== number || !dragged) number.value = q.toFixed(5);
    value.textContent = told(row, q);
    line.classList.toggle("stopped", stopped === k);
  };
  return { line, update, k, range };
}

function list() {
  page.sliders = (page.byHand ? every() : robot.actuated_variables).map(slider);
  element("moved").replaceChildren(...page.sliders.map((s) => s.line));
  element("open").checked = page.byHand;
  element("close").hidden = !page.byHand;
}

function show(stopped = null) {
  page.sliders.forEach((s) => s.update(stopped));
  for (const line of document.querySelectorAll("tr[data-row]")) {
    const row = robot.rows[+line.dataset.row];
    for (const cell of line.querySelectorAll("[data-cell]")) {
      cell.dataset.text ??= cell.textContent;
      const name = cell.dataset.cell, of = robot.rows[cell.dataset.of];  // none: 0, as is written
      cell.textContent = page.numbers && of ? minusSign(rounded(now(of, name), 5)) : cell.dataset.text;
    }
    line.lastElementChild.textContent = row.kind === "fixed" ? "" : minusSign(rounded(variable(row, page.u), 5));
  }
  loops();
  redraw();
}

function loops() {
  const gaps = page.gaps();
  const lines = robot.loops.map((loop, i) => {
    const { distance, angle } = gaps[i], open = distance > 1e-6 * robot.size || angle > 1e-6;
    const meets = loop.meets < 0 ? "0" : robot.rows[loop.meets].name;
    const gap = `${distance.toExponential(1)} m${MEETS[loop.kind].length > 1 ? `, ${degrees(angle)}` : ""}`;
    return made("tr", {},
      made("td", { textContent: loop.name }),
      made("td", { textContent: `${robot.rows[loop.frame].name} – ${meets}` }),
      made("td", { textContent: loop.kind }),
      made("td", { textContent: open ? `${rounded(distance, 3)} m${angle > 1e-6 ? `, ${degrees(angle)}` : ""}` : gap, className: open ? "bad" : "" }),
      made("td", { textContent: open ? "open" : "closed", className: open ? "bad" : "good" }));
  });
  document.querySelector("#loops tbody").replaceChildren(...lines);
  const open = document.querySelectorAll("#loops td:last-child.bad").length;
  element("state").textContent = robot.loops.length === 0 ? "" : open ? ` · ${open} of ${robot.loops.length} loops open` : " · loops closed";
  element("state").className = open ? "bad" : "good";
}

function point(number) {
  if (page.view.pointed === number) return;
  page.view.pointed = number;
  tell("pointed", { name: robot.rows[number]?.name ?? null });
  document.querySelectorAll("tr.pointed").forEach((line) => line.classList.remove("pointed"));
  if (number !== null) document.querySelector(`tr[data-row="${number}"]`)?.classList.add("pointed");
  redraw();
}

function tip(number, x, y) {
  const box = element("tip");
  box.hidden = number === null || number < 0;
  if (box.hidden) return;
  const row = robot.rows[number], cells = [];
  for (const [name, text] of Object.entries(row.texts)) {
    const value = now(row, name);
    if (text === "0" && value === 0) continue;
    const unit = ["gamma", "alpha", "theta"].includes(name) ? "rad" : "m";
    const same = text === rounded(value, 6) ? "" : `= ${rounded(value, 6)} ${unit}`;
    cells.push(made("tr", {}, made("td", { textContent: row.letters[name] }), made("td", { textContent: text }),
      made("td", { textContent: same || unit }), made("td", { textContent: unit === "rad" ? degrees(value) : "" })));
  }
  const kind = row.kind === "fixed" ? "fixed frame" : `${row.kind}, ${row.actuated ? "actuated" : row.is_virtual ? "platform" : "passive"}`;
  box.replaceChildren(made("b", { textContent: `row ${row.name} · on ${row.antecedent === "0" ? "the base" : row.antecedent} · ${kind}` }), made("table", {}, ...cells));
  const room = page.view;
  box.style.left = `${Math.max(0, Math.min(x + 14, room.width - box.offsetWidth - 6))}px`;
  box.style.top = `${Math.max(0, Math.min(y + 14, room.height - box.offsetHeight - 6))}px`;
}

function pointers() {
  const canvas = element("picture"), down = new Map();
  let apart = 0, still = null; // where a click may be
  canvas.addEventListener("pointerdown", (e) => {
    canvas.setPointerCapture(e.pointerId);
    still = down.size ? null : { x: e.clientX, y: e.clientY };
    down.set(e.pointerId, { x: e.clientX, y: e.clientY });
    canvas.classList.add("turning");
    tip(null);
  });
  const up = (e) => { down.delete(e.pointerId); apart = 0; canvas.classList.remove("turning"); };
  canvas.addEventListener("pointerup", (e) => {
    const row = still && robot.rows[page.view.rowAt(e.offsetX, e.offsetY)];
    if (row) tell("joint", { name: row.name });
    up(e);
  });
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener("pointermove", (e) => {
    const last = down.get(e.pointerId);
    if (!last) {
      const number = page.view.rowAt(e.offsetX, e.offsetY);
      point(number);
      tip(number, e.offsetX, e.offsetY);
      return;
    }
    const [dx, dy] = [e.clientX - last.x, e.clientY - last.y];
    if (still && Math.hypot(e.clientX - still.x, e.clientY - still.y) > 3) still = null;
    down.set(e.pointerId, { x: e.clientX, y: e.clientY });
    if (down.size === 2) {
      const [a, b] = [...down.values()], now = Math.hypot(a.x - b.x, a.y - b.y);
      if (apart > 0) page.view.scale *= now / apart;
      apart = now;
    } else if (e.shiftKey || e.buttons === 2 || e.buttons === 4) {
      const [right, top] = page.view.rotation;
      page.view.centre = plus(page.view.centre, plus(times(-dx / page.view.scale, right), times(dy / page.view.scale, top)));
    } else page.view.turn(0.008 * dx, -0.008 * dy);
    redraw();
  });
  canvas.addEventListener("pointerleave", () => { point(null); tip(null); });
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener("wheel", (e) => {
    e.preventDefault();
    page.view.scale *= Math.exp(-0.0015 * e.deltaY);
    redraw();
  }, { passive: false });
  canvas.addEventListener("keydown", (e) => {
    const turn = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[e.key];
    if (turn) page.view.turn(...turn);
    else if ("+-".includes(e.key)) page.view.scale *= e.key === "+" ? 1.1 : 1 / 1.1;
    else return;
    e.preventDefault();
    redraw();
  });
}

const VIEWS = {
  xy: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  xz: [[1, 0, 0], [0, 0, 1], [0, -1, 0]],
  yz: [[0, 1, 0], [0, 0, 1], [1, 0, 0]],
};

function iso() {
  const { up } = robot, flat = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].find((a) => Math.abs(dot(a, up)) < 0.6);
  const east = minus(flat, times(dot(flat, up), up)), north = cross(up, east);
  const level = plus(times(1 / norm(east), east), times(-1 / norm(north), north));
  const sum = plus(level, up), towards = times(1 / norm(sum), sum), side = cross(up, towards);
  const right = times(1 / norm(side), side);
  return [right, cross(towards, right), towards];
}

// Where buttons and key lie over the picture, px.
function boxes() {
  const { left, top } = element("picture").getBoundingClientRect();
  return ["views", "layers", "key"].map((id) => {
    const box = element(id).getBoundingClientRect();
    return { left: box.left - left, right: box.right - left, top: box.top - top, bottom: box.bottom - top };
  });
}

function fit() {
  page.view.fit(page.poses(), boxes());
  redraw();
}

function buttons() {
  document.querySelectorAll("[data-view]").forEach((button) => button.addEventListener("click", () => {
    const name = button.dataset.view;
    page.view.look(name === "first" ? robot.view : name === "iso" ? iso() : VIEWS[name]);
    fit();
  }));
  element("fit").addEventListener("click", fit);
  element("home").addEventListener("click", () => {
    page.u = [...robot.home];
    page.byHand = !robot.is_closed;
    say("");
    list();
    show();
  });
  document.querySelectorAll("[data-layers]").forEach((box) => box.addEventListener("change", () => {
    if (box.checked) page.view.hidden.delete(box.dataset.layers);
    else page.view.hidden.add(box.dataset.layers);
    redraw();
  }));
  element("save").addEventListener("click", () => {
    page.view.draw(page.poses(), PAPER);
    made("a", { href: element("picture").toDataURL("image/png"), download: `${robot.name}.png` }).click();
    redraw();
  });
  element("open").addEventListener("change", (e) => {
    if (!e.target.checked && !close()) return;
    page.byHand = e.target.checked;
    list();
    show();
  });
  element("close").addEventListener("click", () => {
    if (!close()) return;
    page.byHand = false;
    list();
    show();
  });
  element("copy").addEventListener("click", copy);
  element("numbers").addEventListener("click", () => {
    page.numbers = !page.numbers;
    element("numbers").textContent = page.numbers ? "letters" : "values";
    show();
  });
}

// Close the loops from where the joints stand: by those that follow, else by all.
function close() {
  const found = closedFrom(robot, page.u, follow()) ?? closedFrom(robot, page.u, every());
  if (found === null) {
    say("the loops do not close near here");
    element("open").checked = true;
    return false;
  }
  page.u = found;
  say("");
  return true;
}

page.homeLines = () => ["[home]", ...every().filter((k) => Math.abs(page.u[k]) > 1e-12)
  .map((k) => `q${robot.variables[k]} = ${Number.isInteger(+page.u[k].toPrecision(12)) ? page.u[k].toFixed(1) : rounded(page.u[k], 12)}`)].join("\n");

function copy() {
  const area = made("textarea", { value: `${page.homeLines()}\n` });
  document.body.append(area);
  area.select();
  const done = document.execCommand("copy");
  area.remove();
  element("copy").textContent = done ? "copied" : "not allowed here";
  setTimeout(() => { element("copy").textContent = "copy [home]"; }, 1500);
}

function key() {
  const entries = [["#d55e00", "actuated joint"], ["#a9a9a9", "passive joint"]];
  const only = (layer) => robot.faces.some((f) => f.layer === layer);
  if (robot.loops.length) entries.push(["#b0508a", "joint that closes a loop"]);
  if (only("platform")) entries.push(["#56b4e9", "platform"]);
  entries.push(["#cc2222", "x"], ["#2a8f2a", "y"], ["#1f4fd0", "z, the joint's axis"]);
  const used = robot.rows.some((row) => row.kind !== "fixed" && !row.actuated && !row.is_virtual);
  element("key").replaceChildren(...entries.filter(([, text]) => used || text !== "passive joint").map(([color, text]) => {
    const patch = made("span");
    patch.style.background = color;
    return made("li", {}, patch, text);
  }));
  for (const layer of ["masses", "fixed names", "loop names", "capsules"]) {
    const parts = [...robot.dots, ...robot.labels, ...robot.faces];
    document.querySelector(`[data-layers="${layer}"]`).parentElement.hidden = !parts.some((p) => p.layer === layer);
  }
}

document.querySelectorAll("tr[data-row]").forEach((line) => {
  line.addEventListener("mouseenter", () => point(+line.dataset.row));
  line.addEventListener("mouseleave", () => point(null));
});

// All that stands beside the picture, for the robot as it is now.
function begin() {
  element("loops").hidden = element("hand").hidden = robot.loops.length === 0;
  const home = robot.has_stated_home ? "[home]: drawn as it is stated" : "all joints at 0: drawn so";
  say(!robot.is_closed ? `the loops do not close near ${home}`
    : !robot.is_as_stated ? "the loops do not close with the actuated joints as [home] states them: drawn nearby"
    : robot.loose_joints.length ? `${robot.loose_joints.map((name) => `q${name}`).join(", ")} could move here with the actuated joints locked` : "");
  key();
  list();
  show();
}

if (bare) document.querySelector("#sliders h2").append(element("state"));
pointers();
buttons();
page.view.fit(page.poses(), boxes());
begin();
let opened = false;
new ResizeObserver(() => {
  fit();
  if (!opened) recall();
  opened = true;
}).observe(element("stage"));
matchMedia(DARK).addEventListener("change", redraw);
tell("ready", standing());
