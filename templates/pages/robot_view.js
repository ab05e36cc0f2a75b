// The picture: orthographic, parts painted from far to near.

const POINTED = "#ffb300", DARK = "(prefers-color-scheme: dark)";
const PAPER = { ground: "#ffffff", ink: "#1d1d1f", soft: "#5c5c62", thin: "#bbbbbb", gravity: "#6b4fa0" };
const NIGHT = { ground: "#17171a", ink: "#ececf0", soft: "#b2b2ba", thin: "#55555c", gravity: "#b39ddb" };
const FAINT = 0.22; // of what is not lit, where something is

class View {
  constructor(canvas, robot) {
    this.canvas = canvas;
    this.robot = robot;
    this.hidden = new Set(["loop names"]);
    this.pointed = null;
    this.lit = new Set(); // rows that are shown clearly, the others faintly
    this.items = [];
    this.kept = new Map(); // where labels stood: they stay there as long as they can
    this.poses = [];
    this.top = 0; // px, of what lies over the picture
    this.look(robot.view);
  }

  replace(robot) {
    this.robot = robot;
    this.pointed = null;
    this.kept.clear();
  }

  marked(row) {
    return row === this.pointed || this.lit.has(row);
  }

  // A colour for paper, as it is seen on the ground.
  ink(color, least = 0.16) {
    if (this.colors === PAPER) return color;
    let found = color;
    for (let k = 0; k < 8 && brightness(found) < least; k += 1) found = mixed(found, "#ffffff", 0.18);
    return found;
  }

  look(rotation) {
    this.rotation = rotation.map((axis) => [...axis]);
  }

  // Turn about what is up, and about the horizontal of the screen; rad.
  turn(across, along) {
    const [right] = this.rotation;
    const about = (axis, angle) => (v) => {
      const c = Math.cos(angle), s = Math.sin(angle);
      return plus(plus(times(c, v), times(s, cross(axis, v))), times((1 - c) * dot(axis, v), axis));
    };
    const lean = about(right, -along), swing = about(this.robot.up, -across);
    this.rotation = this.rotation.map((axis) => swing(lean(axis)));
  }

  point(at) {
    return placed(frameOf(this.poses, at[0]), at.slice(1));
  }

  flat(p) {
    const [right, up, towards] = this.rotation, d = minus(p, this.centre);
    return {
      x: this.width / 2 + this.scale * dot(right, d),
      y: (this.top + this.height) / 2 - this.scale * dot(up, d),
      depth: dot(towards, d),
    };
  }

  // All of the robot, as it stands, in the window; below the boxes that lie over it, if it would
  // reach under one.
  fit(poses, boxes) {
    this.poses = poses;
    const box = this.canvas.getBoundingClientRect();
    this.width = box.width;
    this.height = box.height;
    const points = this.outline();
    const span = (axis) => {
      const along = points.map((p) => dot(axis, p));
      return [Math.min(...along), Math.max(...along)];
    };
    const spans = this.rotation.map(span);
    this.centre = spans.reduce(
      (sum, [low, high], i) => plus(sum, times((low + high) / 2, this.rotation[i])), [0, 0, 0]);
    const [[left, right], [low, high]] = spans;
    const least = 1e-3 * this.robot.size, rim = 24;
    for (const top of [0, ...boxes.map((b) => b.bottom).sort((a, b) => a - b)]) {
      this.top = top;
      this.scale = Math.min(
        (0.74 * this.width) / Math.max(right - left, least),
        (0.78 * (this.height - top)) / Math.max(high - low, least));
      const flat = points.map((p) => this.flat(p));
      const under = (b) => flat.some(({ x, y }) => x > b.left - rim && x < b.right + rim && y > b.top - rim && y < b.bottom + rim);
      if (!boxes.some(under)) break;
    }
  }

  // Share of the window that the robot fills, in its wider direction; 0 if it reaches out of it.
  filled(poses) {
    this.poses = poses;
    const points = this.outline().map((p) => this.flat(p));
    const xs = points.map((p) => p.x), ys = points.map((p) => p.y);
    const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    const inside = left > 0 && low > 0 && right < this.width && high < this.height;
    return inside ? Math.max((right - left) / this.width, (high - low) / this.height) : 0;
  }

  // Steps back until all of the robot is in the window.
  back(poses) {
    for (let k = 0; k < 30 && this.filled(poses) === 0; k += 1) this.scale *= 0.93;
  }

  outline() {
    return [
      ...this.robot.lines.flatMap((l) => l.ends.map((e) => this.point(e))),
      ...this.robot.faces.flatMap((f) => f.points.map((x) => placed(frameOf(this.poses, f.frame), x))),
    ];
  }

  draw(poses, colors = matchMedia(DARK).matches ? NIGHT : PAPER) {
    this.poses = poses;
    this.colors = colors;
    const box = this.canvas.getBoundingClientRect(), ratio = window.devicePixelRatio || 1;
    this.width = box.width;
    this.height = box.height;
    this.canvas.width = Math.round(box.width * ratio);
    this.canvas.height = Math.round(box.height * ratio);
    const pen = this.canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.fillStyle = colors.ground;
    pen.fillRect(0, 0, this.width, this.height);
    this.unit = Math.max(0.8, Math.min(1.5, Math.min(this.width, this.height) / 620));
    this.items = [...this.faces(), ...this.pieces(), ...this.dots()];
    this.items.sort((a, b) => a.depth - b.depth);
    for (const item of this.items) {
      pen.globalAlpha = this.faint(item.row);
      item.paint(pen);
      pen.globalAlpha = 1;
    }
    this.labels(pen);
    this.gravity(pen);
    this.ruler(pen);
  }

  faint(row) {
    return this.lit.size && !this.lit.has(row) ? FAINT : 1;
  }

  shown(part) {
    return !this.hidden.has(part.layer);
  }

  *faces() {
    const [right, up, towards] = this.rotation;
    const light = plus(plus(times(0.35, right), times(0.6, up)), times(0.72, towards));
    for (const part of this.robot.faces.filter((p) => this.shown(p))) {
      const pose = frameOf(this.poses, part.frame);
      const corners = part.points.map((x) => placed(pose, x));
      const [first] = corners, arms = corners.map((c) => minus(c, first));
      const away = arms.slice(1).reduce((sum, arm, i) => plus(sum, cross(arms[i], arm)), [0, 0, 0]);
      const normal = times(1 / Math.max(norm(away), 1e-300), away);
      const faces = dot(normal, towards);
      const solid = part.opacity === 1;
      if (solid && faces <= 0) continue;
      const points = corners.map((c) => this.flat(c));
      const bright = solid ? 0.74 + 0.42 * Math.max(0, dot(normal, light)) : 1;
      const marked = this.marked(part.row);
      yield {
        row: part.row,
        points,
        depth: points.reduce((sum, p) => sum + p.depth, 0) / points.length,
        paint: (pen) => {
          pen.beginPath();
          points.forEach((p, i) => (i ? pen.lineTo(p.x, p.y) : pen.moveTo(p.x, p.y)));
          pen.closePath();
          pen.globalAlpha *= part.opacity;
          pen.fillStyle = shade(this.ink(part.color), bright);
          pen.fill();
          pen.strokeStyle = marked ? POINTED : pen.fillStyle;
          pen.lineWidth = marked ? 2 : 0.6;
          pen.stroke();
        },
      };
    }
  }

  *pieces() {
    const least = 1e-7 * this.robot.size;
    const parts = this.robot.lines.filter((p) => this.shown(p))
      .map((part) => [part, ...part.ends.map((e) => this.point(e))]);
    for (const [part, start, end] of [...parts, ...this.gaps()]) {
      const way = minus(end, start);
      if (norm(way) < least) continue;
      const front = this.robot.size * ({ frames: 0.03, base: 0.03, gap: 1, ground: -0.03 }[part.layer] ?? 0);
      const count = part.arrow || part.dashed ? 1 : Math.max(1, Math.ceil(norm(way) / (0.06 * this.robot.size)));
      for (let i = 0; i < count; i += 1) {
        const [a, b] = [i / count, (i + 1) / count].map((s) => this.flat(plus(start, times(s, way))));
        yield {
          row: part.row, ends: [a, b], part, depth: (a.depth + b.depth) / 2 + front,
          paint: (pen) => this.paintPiece(pen, part, a, b),
        };
      }
    }
  }

  // Between the frames of every loop: the travel that its joint lets free, and in red the gap.
  *gaps() {
    for (const loop of this.robot.loops) {
      const a = frameOf(this.poses, loop.frame), b = frameOf(this.poses, loop.meets);
      const bend = plus(a.p, letFree(loop, a, b)), row = loop.frame, layer = "gap";
      yield [{ row, layer, color: "#b0508a", width: 1 }, a.p, bend];
      yield [{ row, layer, color: "#e00000", width: 2, dashed: true }, bend, b.p];
    }
  }

  paintPiece(pen, part, a, b) {
    const width = part.width * this.unit, length = Math.hypot(b.x - a.x, b.y - a.y);
    const marked = this.marked(part.row) && part.layer !== "gap", color = this.ink(part.color);
    const stroke = (color, wide, cap) => {
      pen.lineCap = cap;
      pen.strokeStyle = color;
      pen.lineWidth = wide;
      pen.beginPath();
      pen.moveTo(a.x, a.y);
      pen.lineTo(b.x, b.y);
      pen.stroke();
    };
    // What lies in a face has no white rim on it.
    if (marked || part.layer !== "platform") stroke(marked ? POINTED : this.colors.ground, width + (marked ? 5 : 2.4), "butt");
    pen.setLineDash(part.dashed ? [2.2 * width, 1.8 * width] : []);
    stroke(color, width, part.dashed ? "butt" : "round");
    pen.setLineDash([]);
    const head = 3.2 * this.unit + 2 * width;
    if (!part.arrow || length < 0.5 * head) return;
    const [x, y] = [(b.x - a.x) / length, (b.y - a.y) / length];
    const long = Math.min(head, length);
    pen.fillStyle = color;
    pen.beginPath();
    pen.moveTo(b.x + 0.3 * long * x, b.y + 0.3 * long * y);
    pen.lineTo(b.x - 0.7 * long * x - 0.36 * long * y, b.y - 0.7 * long * y + 0.36 * long * x);
    pen.lineTo(b.x - 0.7 * long * x + 0.36 * long * y, b.y - 0.7 * long * y - 0.36 * long * x);
    pen.fill();
  }

  *dots() {
    for (const part of this.robot.dots.filter((p) => this.shown(p))) {
      const p = this.flat(this.point(part.at)), radius = part.radius * this.unit;
      yield {
        row: part.row, ends: [p, p], depth: p.depth + 0.02 * this.robot.size,
        paint: (pen) => {
          pen.beginPath();
          pen.arc(p.x, p.y, radius, 0, 2 * Math.PI);
          pen.fillStyle = this.ink(part.color);
          pen.fill();
          pen.lineWidth = 1;
          pen.strokeStyle = this.marked(part.row) ? POINTED : this.colors.ground;
          pen.stroke();
          if (part.layer !== "masses") return;
          pen.fillStyle = this.colors.ground; // quarters, as engineers mark it
          for (const from of [0, Math.PI]) {
            pen.beginPath();
            pen.moveTo(p.x, p.y);
            pen.arc(p.x, p.y, 0.75 * radius, from, from + Math.PI / 2);
            pen.fill();
          }
        },
      };
    }
  }

  // Names that stand at one place on the screen are written together.
  labels(pen) {
    pen.font = `600 ${Math.max(11, Math.round(11.5 * this.unit))}px system-ui, sans-serif`;
    pen.textBaseline = "middle";
    pen.textAlign = "left";
    const groups = [];
    for (const part of this.robot.labels.filter((p) => this.shown(p))) {
      const p = this.flat(this.point(part.at));
      const near = groups.find((g) => Math.hypot(g.x - p.x, g.y - p.y) < 7 * this.unit);
      if (near) near.parts.push(part);
      else groups.push({ x: p.x, y: p.y, parts: [part] });
    }
    const segments = this.items.filter((item) => item.part).map((item) => item.ends);
    const sleeves = this.robot.sleeves.map((ends) => ends.map((end) => this.flat(this.point(end))));
    const taken = [], gap = pen.measureText(" ").width, height = 14 * this.unit;
    for (const group of groups) {
      const widths = group.parts.map((part) => pen.measureText(part.text).width);
      const width = widths.reduce((sum, w) => sum + w, 0) + gap * (widths.length - 1);
      const key = group.parts.map((part) => part.text).join(" ");
      const others = groups.filter((g) => g !== group);
      const box = this.place(key, group, { width, height }, { taken, segments, sleeves, others });
      taken.push(box);
      if (Math.hypot(box.x + width / 2 - group.x, box.y + height / 2 - group.y) > width / 2 + 26 * this.unit + this.robot.bulk * this.scale) {
        pen.strokeStyle = this.colors.thin;
        pen.lineWidth = 0.8;
        pen.beginPath();
        pen.moveTo(group.x, group.y);
        pen.lineTo(Math.max(box.x, Math.min(group.x, box.x + width)), Math.max(box.y, Math.min(group.y, box.y + height)));
        pen.stroke();
      }
      let x = box.x;
      group.parts.forEach((part, i) => {
        pen.lineWidth = 3;
        pen.globalAlpha = this.faint(part.row);
        pen.strokeStyle = `${this.colors.ground}d0`;
        pen.strokeText(part.text, x, box.y + height / 2);
        pen.fillStyle = this.marked(part.row) ? this.colors.ink : this.ink(part.color, 0.3);
        pen.fillText(part.text, x, box.y + height / 2);
        pen.globalAlpha = 1;
        x += widths[i] + gap;
      });
    }
  }

  place(key, group, { width, height }, { taken, segments, sleeves, others }) {
    let best = null;
    const before = this.kept.get(key);
    const around = group.parts.some((part) => part.layer !== "base");
    const bulk = around ? Math.min(1.3 * this.robot.bulk * this.scale, 30 * this.unit) : -6 * this.unit;
    for (let ring = 0; ring < 3; ring += 1) {
      for (let k = 0; k < 12; k += 1) {
        const angle = (k * Math.PI) / 6 - Math.PI / 6, reach = (9 + 10 * ring) * this.unit + bulk;
        const x = group.x + Math.cos(angle) * (reach + width / 2) - width / 2;
        const y = group.y + Math.sin(angle) * (reach + height / 4) - height / 2;
        const box = { x, y, right: x + width, bottom: y + height };
        const inside = x > 0 && y > 0 && box.right < this.width && box.bottom < this.height;
        const thick = 0.8 * this.robot.bulk * this.scale;
        const hit = others.filter((g) => covers(box, g, thick)).length
          + sleeves.filter(([a, b]) => crosses(a, b, { x: x - thick, y: y - thick, right: box.right + thick, bottom: box.bottom + thick })).length;
        const cost = 2 * hit + 8 * taken.filter((b) => overlap(box, b)).length + (inside ? 0 : 20) + 0.7 * ring
          + Math.min(4, segments.filter(([a, b]) => crosses(a, b, box)).length)
          - (before === ring * 12 + k ? 0.9 : 0);
        if (best === null || cost < best.cost - 1e-9) best = { cost, box, choice: ring * 12 + k };
      }
    }
    this.kept.set(key, best.choice);
    return best.box;
  }

  gravity(pen) {
    const g = this.robot.gravity, size = norm(g);
    if (size === 0) return;
    const [x, y] = this.rotation.slice(0, 2).map((axis) => dot(axis, g) / size);
    const length = 46 * this.unit, flat = Math.hypot(x, y);
    const [cx, cy] = [this.width - 44 * this.unit, this.height - 50 * this.unit];
    pen.strokeStyle = pen.fillStyle = this.colors.gravity;
    pen.lineWidth = 2.2 * this.unit;
    if (flat < 0.08) { // straight at the viewer, or away
      pen.beginPath();
      pen.arc(cx, cy, 7 * this.unit, 0, 2 * Math.PI);
      pen.stroke();
      pen.font = `600 ${Math.round(12 * this.unit)}px system-ui`;
      pen.textAlign = "center";
      pen.fillText(dot(this.rotation[2], g) > 0 ? "•" : "×", cx, cy);
    } else {
      const [a, b] = [-0.5, 0.5].map((s) => ({ x: cx + s * length * x, y: cy - s * length * y }));
      this.paintPiece(pen, { width: 2, color: this.colors.gravity, arrow: true, row: -2 }, a, b);
    }
    pen.fillStyle = this.colors.gravity;
    pen.font = `italic 600 ${Math.round(14 * this.unit)}px Georgia, serif`;
    pen.fillText("g", cx + 13 * this.unit, cy);
  }

  // A bar of a round length.
  ruler(pen) {
    const most = 110 * this.unit / this.scale, ten = 10 ** Math.floor(Math.log10(most));
    const length = [5, 2, 1].map((n) => n * ten).find((n) => n <= most);
    const [x, y, w] = [16, this.height - 18, length * this.scale];
    pen.strokeStyle = pen.fillStyle = this.colors.soft;
    pen.lineWidth = 1.5;
    pen.lineCap = "butt";
    pen.beginPath();
    pen.moveTo(x, y - 4); pen.lineTo(x, y); pen.lineTo(x + w, y); pen.lineTo(x + w, y - 4);
    pen.stroke();
    pen.font = "12px system-ui, sans-serif";
    pen.textAlign = "left";
    const text = length >= 0.1 ? `${+length.toPrecision(1)} m` : `${+(1000 * length).toPrecision(1)} mm`;
    pen.fillText(text, x + w + 6, y - 3);
  }

  // The row that is drawn at a place of the window; null where nothing is.
  rowAt(x, y) {
    for (const item of [...this.items].reverse()) {
      if (item.points ? inPolygon(item.points, x, y) : toSegment(item.ends, x, y) < 6) return item.row;
    }
    return null;
  }
}

const bytes = (color) => [1, 3, 5].map((i) => parseInt(color.slice(i, i + 2), 16));

// Relative luminance, 0 to 1 (WCAG).
function brightness(color) {
  const [r, g, b] = bytes(color).map((c) => (c / 255) ** 2.2);
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function mixed(color, other, share) {
  const found = bytes(color).map((c, i) => Math.round(c + share * (bytes(other)[i] - c)));
  return `#${found.map((c) => c.toString(16).padStart(2, "0")).join("")}`;
}

function shade(color, bright) {
  const parts = bytes(color);
  const lit = parts.map((c) => Math.round(bright <= 1 ? c * bright : c + (255 - c) * (bright - 1)));
  return `rgb(${lit.join(",")})`;
}

const overlap = (a, b) => a.x < b.right + 2 && b.x < a.right + 2 && a.y < b.bottom && b.y < a.bottom;

// True if a box reaches over a disc.
const covers = (box, p, radius) => Math.hypot(
  p.x - Math.max(box.x, Math.min(p.x, box.right)), p.y - Math.max(box.y, Math.min(p.y, box.bottom))) < radius;

// True if a segment passes through a box, by steps that no name slips through.
function crosses(a, b, box) {
  const steps = Math.max(1, Math.ceil(Math.hypot(b.x - a.x, b.y - a.y) / 6));
  for (let i = 0; i <= steps; i += 1) {
    const x = a.x + ((b.x - a.x) * i) / steps, y = a.y + ((b.y - a.y) * i) / steps;
    if (x > box.x && x < box.right && y > box.y && y < box.bottom) return true;
  }
  return false;
}

function inPolygon(points, x, y) {
  let inside = false;
  points.forEach((a, i) => {
    const b = points[(i + 1) % points.length];
    if ((a.y > y) !== (b.y > y) && x < a.x + ((y - a.y) * (b.x - a.x)) / (b.y - a.y)) inside = !inside;
  });
  return inside;
}

function toSegment([a, b], x, y) {
  const dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const s = square > 0 ? Math.max(0, Math.min(1, ((x - a.x) * dx + (y - a.y) * dy) / square)) : 0;
  return Math.hypot(x - a.x - s * dx, y - a.y - s * dy);
}
