// Where the frames are. A pose is {R: [x, y, z], p}: axes and origin in frame 0.

const plus = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (s, a) => [s * a[0], s * a[1], s * a[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0],
];
const norm = (a) => Math.hypot(a[0], a[1], a[2]);
const BASE = { R: [[1, 0, 0], [0, 1, 0], [0, 0, 1]], p: [0, 0, 0] };

// A point given in the coordinates of a frame, in frame 0.
function placed(pose, x) {
  const { R, p } = pose;
  return [0, 1, 2].map((i) => p[i] + R[0][i] * x[0] + R[1][i] * x[1] + R[2][i] * x[2]);
}

const turnedZ = ([x, y, z], angle) => {
  const c = Math.cos(angle), s = Math.sin(angle);
  return [plus(times(c, x), times(s, y)), minus(times(c, y), times(s, x)), z];
};
const turnedX = ([x, y, z], angle) => {
  const c = Math.cos(angle), s = Math.sin(angle);
  return [x, plus(times(c, y), times(s, z)), minus(times(c, z), times(s, y))];
};

// The variable of a row, for the free variables u.
const variable = (row, u) => row.terms.reduce((sum, [k, c]) => sum + c * u[k], row.constant);

// T(a -> j) = Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r), row after row.
function posesAt(robot, u) {
  const found = [];
  for (const row of robot.rows) {
    const from = row.parent < 0 ? BASE : found[row.parent];
    const moved = row.rate * variable(row, u), cells = row.cells;
    const theta = cells.theta + (row.kind === "revolute" ? moved : 0);
    const r = cells.r + (row.kind === "prismatic" ? moved : 0);
    const lower = turnedZ(from.R, cells.gamma);
    const tilted = turnedX(lower, cells.alpha);
    const foot = plus(plus(from.p, times(cells.b, lower[2])), times(cells.d, tilted[0]));
    found.push({ R: turnedZ(tilted, theta), p: plus(foot, times(r, tilted[2])) });
  }
  return found;
}

// How frame `number` moves with every free variable: turns and travels of its origin.
function motions(robot, poses, number) {
  const count = robot.variables.length;
  const turn = Array.from({ length: count }, () => [0, 0, 0]);
  const travel = Array.from({ length: count }, () => [0, 0, 0]);
  for (let k = number; k >= 0; k = robot.rows[k].parent) {
    const row = robot.rows[k], axis = times(row.rate, poses[k].R[2]);
    for (const [place, c] of row.terms) {
      if (row.kind === "revolute") {
        turn[place] = plus(turn[place], times(c, axis));
        const arm = minus(poses[number].p, poses[k].p);
        travel[place] = plus(travel[place], times(c, cross(axis, arm)));
      } else if (row.kind === "prismatic") {
        travel[place] = plus(travel[place], times(c, axis));
      }
    }
  }
  return { turn, travel };
}
