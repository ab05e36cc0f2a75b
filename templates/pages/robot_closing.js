// Loops: how far they are open, and how a closed posture follows the actuated joints.
// The same equations as in closing.py: axes are compared as vectors, lengths in robot sizes.

const CLOSED = 1e-11, ITERATIONS = 40, LONGEST = 0.3;
const STRIDE = 0.02, SMALLEST = STRIDE / 256, JUMP = 0.35;

const MEETS = {
  position: ["way"], spherical: ["way"], universal: ["way", "right angle"],
  revolute: ["way", "z"], cylindrical: ["beside", "z"], prismatic: ["beside", "z", "x"],
  planar: ["above", "z"], rigid: ["way", "z", "x"],
};

const frameOf = (poses, number) => (number < 0 ? BASE : poses[number]);

// Residuals f and, by free variable, their derivatives: [f, J], J by rows.
function equations(robot, u) {
  const poses = posesAt(robot, u), f = [], J = [];
  const still = { turn: robot.variables.map(() => [0, 0, 0]), travel: robot.variables.map(() => [0, 0, 0]) };
  for (const loop of robot.loops) {
    const a = frameOf(poses, loop.frame), b = frameOf(poses, loop.meets);
    const of = (n) => (n < 0 ? still : motions(robot, poses, n));
    const ma = of(loop.frame), mb = of(loop.meets);
    const way = times(1 / robot.size, minus(b.p, a.p));
    const rate = robot.variables.map((_, k) => times(1 / robot.size, minus(mb.travel[k], ma.travel[k])));
    const z = a.R[2], zRate = robot.variables.map((_, k) => cross(ma.turn[k], z));
    const add = (values, rates) => values.forEach((value, i) => {
      f.push(value);
      J.push(rates.map((r) => r[i]));
    });
    for (const kind of MEETS[loop.kind]) {
      if (kind === "way") add(way, rate);
      else if (kind === "beside") {
        add(cross(z, way), rate.map((r, k) => plus(cross(zRate[k], way), cross(z, r))));
      } else if (kind === "above") {
        add([dot(z, way)], rate.map((r, k) => [dot(zRate[k], way) + dot(z, r)]));
      } else if (kind === "right angle") {
        const other = b.R[2];
        add([dot(z, other)], rate.map((_, k) => [
          dot(zRate[k], other) + dot(z, cross(mb.turn[k], other)),
        ]));
      } else {
        const axis = kind === "x" ? 0 : 2;
        add(minus(a.R[axis], b.R[axis]), rate.map((_, k) =>
          minus(cross(ma.turn[k], a.R[axis]), cross(mb.turn[k], b.R[axis]))));
      }
    }
  }
  return [f, J];
}

// The part of the way from one frame to the other that the loop's joint lets free.
function letFree(loop, a, b) {
  const way = minus(b.p, a.p), along = times(dot(a.R[2], way), a.R[2]);
  if (MEETS[loop.kind].includes("beside")) return along;
  return MEETS[loop.kind].includes("above") ? minus(way, along) : [0, 0, 0];
}

// How far every loop is open: {distance [m], angle [rad]}.
function gapsAt(robot, u) {
  const poses = posesAt(robot, u);
  return robot.loops.map((loop) => {
    const a = frameOf(poses, loop.frame), b = frameOf(poses, loop.meets), kinds = MEETS[loop.kind];
    const distance = norm(minus(minus(b.p, a.p), letFree(loop, a, b))), z = a.R[2];
    const chord = Math.max(0, ...["x", "z"].filter((k) => kinds.includes(k)).map((k) =>
      norm(minus(a.R[k === "x" ? 0 : 2], b.R[k === "x" ? 0 : 2]))));
    const angle = kinds.includes("right angle")
      ? Math.abs(Math.asin(Math.max(-1, Math.min(1, dot(z, b.R[2])))))
      : 2 * Math.asin(Math.min(1, chord / 2));
    return { distance, angle };
  });
}

const largest = (values) => values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);

const scales = (robot, places) => places.map((k) => {
  const row = robot.rows.find((each) => each.name === robot.variables[k]);
  return row.unit === "rad" ? 1 : robot.size;
});

// Columns of the variables `places`, travels counted in robot sizes.
function columns(robot, J, places) {
  const scale = scales(robot, places);
  return J.map((line) => places.map((k, i) => line[k] * scale[i]));
}

// A^T B of two matrices by rows.
function product(A, B) {
  const found = A[0].map(() => B[0].map(() => 0));
  A.forEach((a, m) => a.forEach((x, i) => {
    if (x !== 0) B[m].forEach((y, k) => { found[i][k] += x * y; });
  }));
  return found;
}

// Gauss with pivots: {x, sign} of M x = b; sign of the determinant, 0 where singular.
function solved(M, b) {
  const A = M.map((line, i) => [...line, b[i]]), n = M.length;
  let sign = 1;
  for (let c = 0; c < n; c += 1) {
    let best = c;
    for (let i = c + 1; i < n; i += 1) if (Math.abs(A[i][c]) > Math.abs(A[best][c])) best = i;
    if (!(Math.abs(A[best][c]) > 0)) return { x: null, sign: 0 };
    if (best !== c) { [A[best], A[c]] = [A[c], A[best]]; sign = -sign; }
    if (A[c][c] < 0) sign = -sign;
    for (let i = c + 1; i < n; i += 1) {
      const share = A[i][c] / A[c][c];
      if (share !== 0) for (let k = c; k <= n; k += 1) A[i][k] -= share * A[c][k];
    }
  }
  const x = new Array(n);
  for (let i = n - 1; i >= 0; i -= 1) {
    x[i] = (A[i][n] - A[i].slice(i + 1, n).reduce((sum, a, k) => sum + a * x[i + 1 + k], 0)) / A[i][i];
  }
  return { x, sign };
}

// The closed posture that is found from u by moving `places`; null if none is.
function closedFrom(robot, start, places) {
  const u = [...start], scale = scales(robot, places);
  for (let turn = 0; turn < ITERATIONS; turn += 1) {
    const [f, J] = equations(robot, u);
    if (largest(f) < CLOSED) return u;
    if (places.length === 0) return null;
    const C = columns(robot, J, places), M = product(C, C);
    const top = M.reduce((most, line, i) => Math.max(most, line[i]), 0);
    M.forEach((line, i) => { line[i] += 1e-13 * top; }); // redundant or idle: the shortest step
    const { x } = solved(M, product(C, f.map((value) => [-value])).map((line) => line[0]));
    if (x === null || !x.every(Number.isFinite)) return null;
    const cut = Math.min(1, LONGEST / Math.max(largest(x), 1e-300));
    places.forEach((k, i) => { u[k] += cut * scale[i] * x[i]; });
  }
  return largest(equations(robot, u)[0]) < 100 * CLOSED ? u : null;
}

// True if two near closed postures are of one assembly mode: no joint jumped, no singular posture
// lies between, det(Jold^T Jnew) > 0 in the columns of the joints that follow.
function sameMode(robot, before, after, places) {
  const scale = scales(robot, places);
  if (places.some((k, i) => Math.abs(after[k] - before[k]) > JUMP * scale[i])) return false;
  if (places.length === 0 || robot.loose_joints.length > 0) return true; // no sign to watch
  const [old, now] = [before, after].map((u) => columns(robot, equations(robot, u)[1], places));
  const M = product(old, now);
  return solved(M, M.map(() => 0)).sign > 0;
}

// From the closed posture u towards values of the actuated joints, in small steps along the loops:
// {u, reached}; u is the last closed posture on the way.
function ledTo(robot, start, values) {
  const follow = robot.variables.map((_, k) => k).filter((k) => !robot.actuated_variables.includes(k));
  const way = robot.actuated_variables.map((k, i) => values[i] - start[k]);
  const scale = scales(robot, robot.actuated_variables);
  const length = largest(way.map((x, i) => x / scale[i]));
  let u = [...start], done = 0, step = STRIDE;
  if (robot.loops.length === 0) step = length;
  while (done < length) {
    const next = Math.min(length, done + step);
    const trial = [...u];
    robot.actuated_variables.forEach((k, i) => { trial[k] = start[k] + (way[i] * next) / length; });
    const found = closedFrom(robot, trial, follow);
    if (found !== null && sameMode(robot, u, found, follow)) {
      u = found;
      done = next;
      if (step < STRIDE) step *= 2;
    } else if (step > SMALLEST) step /= 2;
    else return { u, reached: false };
  }
  return { u, reached: true };
}
