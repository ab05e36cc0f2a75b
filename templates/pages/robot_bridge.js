// The page in a frame of a page of the same origin: what it tells there, and what it heeds.
// Told: ready and drawn {q, frames, gaps}, joint {name}, pointed {name}.
// Heeded: posture {q}, light {rows}, robot {content}.

const bare = location.hash.startsWith("#bare"); // without title and table
document.documentElement.classList.toggle("bare", bare);
document.documentElement.classList.toggle("alone", location.hash === "#bare-alone"); // nothing but the picture

const framed = window.parent !== window && location.origin !== "null";

function tell(modeler, content = {}) {
  if (framed) window.parent.postMessage({ modeler, ...content }, location.origin);
}

// How the robot stands: variables by joint, poses by row as 4 x 4 matrices, gaps of the loops.
function standing() {
  const frames = page.poses().map(({ R, p }) => [...[0, 1, 2].map((i) => [R[0][i], R[1][i], R[2][i], p[i]]), [0, 0, 0, 1]]);
  return {
    q: Object.fromEntries(robot.variables.map((name, k) => [name, page.u[k]])),
    frames: Object.fromEntries(robot.rows.map((row, i) => [row.name, frames[i]])),
    gaps: page.gaps(),
  };
}

const HEEDED = {
  posture: ({ q }) => {
    page.pose(q);
    page.view.back(page.poses());
  },
  light: ({ rows }) => {
    page.view.lit = new Set(robot.rows.flatMap((row, i) => (rows.includes(row.name) ? [i] : [])));
    redraw();
  },
  robot: ({ content }) => {
    page.replace(content);
    tell("drawn", standing());
  },
};

// A frame that is drawn anew shows the robot as it was looked at last.
const EYE = "modeler eye";

function recall() {
  const kept = framed ? JSON.parse(sessionStorage.getItem(EYE) ?? "{}") : {};
  if (kept.name !== robot.name) return;
  page.view.rotation = kept.rotation;
  page.pose(kept.q);
  fit();
  Object.assign(page.view, { scale: kept.scale, centre: kept.centre });
  if (page.view.filled(page.poses()) < 0.3) fit();
  redraw();
}

if (framed) {
  window.addEventListener("pagehide", () => {
    const { rotation, scale, centre } = page.view;
    sessionStorage.setItem(EYE, JSON.stringify({ name: robot.name, rotation, scale, centre, q: standing().q }));
  });
  window.addEventListener("message", (event) => {
    if (event.source !== window.parent || event.origin !== location.origin) return;
    HEEDED[event.data?.modeler]?.(event.data);
  });
}
