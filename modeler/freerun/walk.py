"""Robots side by side under given torques: Adams and Bashforth, and dry friction that can hold.

The smooth part goes by the rule of order 2. Dry friction is implicit, as Moreau's stepping has it
(J. J. Moreau, "Unilateral contact and dry friction in finite freedom dynamics", 1988): the torque
of a shaft at the end of a step is its bound against its speed there, or any value within the bounds
if it stands. So a shaft that friction holds stays where it is, without chatter at any step.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from modeler.freerun.plant import Forces, Plant

_SWEEPS = 60  # of the relaxation over shafts that stick or turn
_SETTLED = 1e-10  # of the speed that dry friction takes in a step


@dataclass(frozen=True, eq=False)
class Lanes:
    """What b robots are given over the same number of samples.

    Attributes:
        q, qd: (b, n) state at the start.
        tau: (samples, b, n) torque at the samples, linear between them, N m or N.
        signals: (samples, b, m) what effects read, or None.
        step: s between samples.
        far: (n,) rad or m from `around`, at which a robot is lost.
        around: (samples, b, n) positions that were logged.
    """

    q: np.ndarray
    qd: np.ndarray
    tau: np.ndarray
    signals: np.ndarray | None
    step: float
    far: np.ndarray
    around: np.ndarray


def walk(
    plant: Plant,
    lanes: Lanes,
    inner: int,
    ended: np.ndarray | None = None,
    tell: Callable[[float], None] | None = None,
) -> np.ndarray:
    """(samples, b, n) positions; NaN from where a robot is lost or its loops no longer close.

    Args:
        plant: the robot.
        lanes: what it is given.
        inner: steps between two samples.
        ended: (b,) sample after which a robot need not be followed.
        tell: called with the share done.
    """
    samples, b, n = lanes.tau.shape
    path = np.full((samples, b, n), np.nan)
    state = _State.at(plant, lanes)
    ended = np.full(b, samples - 1) if ended is None else ended
    live = np.arange(b)
    for k in range(samples):
        path[k, live] = state.q[live]
        live = live[ended[live] > k]
        if k == samples - 1 or not len(live):
            break
        if tell is not None:
            tell(k / samples)
        state.read(plant, lanes.signals, k)
        dry = None
        for m in range(inner):
            sound = _sound(plant, state, live, lanes.around[k], lanes.far)
            live, dry = live[sound], None if dry is None else dry[sound]
            if not len(live):
                return path
            share = m / inner  # the rule looks half a step ahead by itself
            tau = (1.0 - share) * lanes.tau[k, live] + share * lanes.tau[k + 1, live]
            dry = state.step(plant, live, tau, lanes.step / inner, dry)
    return path


@dataclass(eq=False)
class _State:
    """Of b robots; changed in place, those that are lost stay as they were."""

    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    smooth: np.ndarray  # the acceleration without dry friction one step before
    pull: np.ndarray  # dry friction as a share of its bounds
    s: np.ndarray | None

    @classmethod
    def at(cls, plant: Plant, lanes: Lanes) -> "_State":
        b, n = lanes.q.shape
        signals = None if lanes.signals is None else lanes.signals[0].copy()
        return cls(
            lanes.q.copy(), lanes.qd.copy(), np.zeros((b, n)), np.full((b, n), np.nan),
            np.zeros((b, plant.shafts)), signals,
        )  # fmt: skip

    def read(self, plant: Plant, signals: np.ndarray | None, k: int) -> None:
        """Signals of sample k; bristles are part of the state and stay."""
        if self.s is not None and signals is not None:
            held = self.s[:, plant.slipping].copy()
            self.s = signals[k].copy()
            self.s[:, plant.slipping] = held

    def step(
        self, plant: Plant, live: np.ndarray, tau: np.ndarray, h: float, dry: np.ndarray | None
    ) -> np.ndarray:
        """One step of h s for those that live; the bounds of their dry friction."""
        q, qd = self.q[live], self.qd[live]
        own = None if self.s is None else self.s[live]
        forces = plant.forces(q, qd, self.qdd[live], own, dry)
        smooth = np.linalg.solve(forces.M, (tau - forces.smooth)[:, :, None])[:, :, 0]
        before = self.smooth[live]
        before = np.where(np.isnan(before), smooth, before)
        free = qd + h * (1.5 * smooth - 0.5 * before)
        speed, self.pull[live] = _rubbed(forces, free, self.pull[live], h)
        moved = 0.5 * h * (qd + speed)
        self.smooth[live], self.qdd[live] = smooth, (speed - qd) / h
        self.q[live], self.qd[live] = q + moved, speed
        if self.s is not None:
            self.s[live] = plant.turned(self.s[live], moved)
        return forces.dry


def _sound(
    plant: Plant, state: _State, live: np.ndarray, around: np.ndarray, far: np.ndarray
) -> np.ndarray:
    """(live,) True where the state is one that can be gone on from."""
    q, qd = state.q[live], state.qd[live]
    kept = np.isfinite(q).all(axis=1) & np.isfinite(qd).all(axis=1)
    kept &= (np.abs(np.where(np.isfinite(q), q, np.inf) - around[live]) < far).all(axis=1)
    if kept.any():
        kept[kept] = plant.reaches(q[kept])
    return np.asarray(kept)


def _rubbed(
    forces: Forces, free: np.ndarray, pull: np.ndarray, h: float
) -> tuple[np.ndarray, np.ndarray]:
    """Speeds (b, n) after dry friction, and its share of its bound, (b, k) in -1 ... 1.

    Args:
        forces: at the beginning of the step.
        free: (b, n) speeds as they would be without it.
        pull: (b, k) the last share, to start from.
        h: s.
    """
    C, dry = forces.C, forces.dry
    if not dry.size or not dry.any():
        return free, np.zeros_like(pull)
    way = np.linalg.solve(forces.M, C.transpose(0, 2, 1)) * (h * dry)[:, None, :]  # (b, n, k)
    speeds = np.einsum("bkn,bn->bk", C, free)
    taken = np.einsum("bkn,bnl->bkl", C, way)
    sliding = np.sign(speeds) * (dry > 0.0)
    after = speeds - np.einsum("bkl,bl->bk", taken, sliding)
    turns = ((np.sign(after) != sliding) & (dry > 0.0)).any(axis=1)
    found = sliding
    if turns.any():
        found[turns] = _relaxed(speeds[turns], taken[turns], dry[turns] > 0.0, pull[turns])
    return free - np.einsum("bnk,bk->bn", way, found), found


def _relaxed(
    speeds: np.ndarray, taken: np.ndarray, rubs: np.ndarray, pull: np.ndarray
) -> np.ndarray:
    """(b, k) p in -1 ... 1: p = sign(u), or u = 0, u = speeds - taken p; one by one, repeated."""
    p = np.where(rubs, pull, 0.0)
    own = np.einsum("bkk->bk", taken)
    own = np.where(own > 0.0, own, 1.0)
    for _ in range(_SWEEPS):
        change = 0.0
        for k in range(p.shape[1]):
            left = speeds[:, k] - np.einsum("bl,bl->b", taken[:, k], p)
            new = np.where(rubs[:, k], np.clip(p[:, k] + left / own[:, k], -1.0, 1.0), 0.0)
            change = max(change, float(np.abs(new - p[:, k]).max(initial=0.0)))
            p[:, k] = new
        if change < _SETTLED:
            break
    return p
