"""Something pushed for a while: a burst of the residual on several joints that stands alone."""

from dataclasses import dataclass

import numpy as np
from scipy.signal import medfilt

from modeler.diagnose.state import State

_CELL = 0.1  # s
_STANDS_OUT = 8.0  # rms of the window over the largest outside its surroundings
_LONGEST = 3.0  # s
_BEGINNING = 2.0  # s of a log in which inner states of friction and cables are not known yet


@dataclass(frozen=True, eq=False)
class Window:
    """When it pushed.

    Attributes:
        log: index.
        start, end: s.
        ratio: residual there over the largest elsewhere, energies of 0.1 s.
        force: (3,) N on the last frame's origin, axes of frame 0; None without kinematics.
    """

    log: int
    start: float
    end: float
    ratio: float
    force: np.ndarray | None


def contact_window(state: State) -> Window | None:
    """The window whose residual stands out from all others; None if none does.

    Energy of the residuals of all joints, each in units of its own median size, in cells of a tenth
    of a second; the highest run of cells must exceed the highest cell elsewhere several times.
    """
    cells = _cells(state)
    if cells is None:
        return None
    run, time, raw = cells
    if len(raw) < 3:
        return None
    energy = medfilt(raw, 3)  # single cells are reversals
    top = int(np.argmax(energy))
    level = max(float(np.quantile(energy, 0.9)), 1e-300)
    first = last = top
    threshold = max(0.1 * energy[top], 2.0 * level)
    while first > 0 and _linked(run, time, first - 1, first) and energy[first - 1] > threshold:
        first -= 1
    while (
        last < len(energy) - 1 and _linked(run, time, last, last + 1)
        and energy[last + 1] > threshold
    ):  # fmt: skip
        last += 1
    near = (run == run[top]) & (time > time[first] - 1.0) & (time < time[last] + 1.0)
    elsewhere = float(energy[~near].max(initial=0.0))
    ratio = float(energy[top]) / max(elsewhere, 1e-300)
    start, end = float(time[first]), float(time[last]) + _CELL
    if start - float(time[run == run[top]].min()) < _BEGINNING:
        return None
    if ratio < _STANDS_OUT or end - start > _LONGEST or end - start < 2 * _CELL:
        return None
    window = (int(run[top]), start, end)
    return Window(*window, ratio, _force(state, *window))


def _linked(run: np.ndarray, time: np.ndarray, a: int, b: int) -> bool:
    return bool(run[a] == run[b] and time[b] - time[a] < 3.0 * _CELL)


def _cells(state: State) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Log, start and mean energy of every cell of time."""
    rows = state.rows
    parts = []
    for j in range(rows.joints):
        size = float(np.median(np.abs(state.residual[j]))) if state.residual[j].size else 0.0
        if size > 0.0:
            parts.append((rows.run[j], rows.time[j], (state.residual[j] / size) ** 2))
    if not parts:
        return None
    run, time, square = (np.concatenate(x) for x in zip(*parts, strict=True))
    cell = np.floor(time / _CELL).astype(int)
    key, place = np.unique(np.column_stack([run, cell]), axis=0, return_inverse=True)
    place = np.ravel(place)
    energy = np.bincount(place, square) / np.bincount(place)
    return key[:, 0], key[:, 1] * _CELL, energy


def _force(state: State, log: int, start: float, end: float) -> np.ndarray | None:
    """(3,) N: least squares of J^T f on the residual in the window, weighted."""
    model = state.data.compiled
    if model.spec.closure is not None:
        return None
    A, b = [], []
    for j in range(state.rows.joints):
        time = state.rows.time[j]
        own = (state.rows.run[j] == log) & (time >= start) & (time < end)
        used = np.flatnonzero(state.data.observation.used[:, j])[own]
        q = state.data.observation.q[used]
        if not len(q):
            continue
        step = np.zeros(q.shape[1])
        step[j] = 1e-6
        ahead = model.forward_kinematics(q + step)[:, -1, :, 3]
        behind = model.forward_kinematics(q - step)[:, -1, :, 3]
        A.append((ahead - behind) / 2e-6 / state.base.sigma[j])
        b.append(-state.residual[j][own] / state.base.sigma[j])
    if not A:
        return None
    return np.asarray(np.linalg.lstsq(np.vstack(A), np.concatenate(b), rcond=None)[0])
