"""What comes only once: pushes; and play in a gear, which knocks."""

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from modeler.diagnosis.judge import compare_residuals, compute_residuals
from modeler.diagnosis.score import ErrorChange
from modeler.diagnosis.state import SearchData, State
from modeler.diagnosis.thresholds import THRESHOLDS

_LENGTHS = range(2, 31)  # cells of a window; one of the longest is no push


@dataclass(frozen=True, eq=False)
class PushWindow:
    """When it pushed.

    Attributes:
        log: index.
        start, end: s.
        ratio: energy of the steady torque there over the largest in any window elsewhere.
        torque: its mean by joint, N m or N.
        change: of the error of all joints by it, over all rows of the logs; None for what comes
            only once as well, but is no steady torque: a spike, a shock.
    """

    log: int
    start: float
    end: float
    ratio: float
    torque: Mapping[str, float] = field(default_factory=dict)
    change: ErrorChange | None = None

    def merge_part(self, other: "PushWindow") -> "PushWindow | None":
        """The push together with a part of it that was found later; None if it is another push."""
        near = (
            other.start < self.end + THRESHOLDS.push_separation
            and other.end > self.start - THRESHOLDS.push_separation
        )
        if other.log != self.log or not near:
            return None
        start, end = min(self.start, other.start), max(self.end, other.end)
        return dataclasses.replace(self, start=start, end=end)


@dataclass(frozen=True, eq=False)
class _WindowEnergies:
    """All windows of some lengths within the logs.

    Attributes:
        run: (windows,) index of the log.
        start, end: (windows,) s.
        energy: (windows,) of a steady torque, in units of each joint's median residual.
    """

    run: np.ndarray
    start: np.ndarray
    end: np.ndarray
    energy: np.ndarray


def find_contact_window(state: State) -> PushWindow | None:
    """The window in which a steady torque stands out from that in any other; None if none does.

    A push gives joint j a mean residual m_j over the n_j rows of its window, of energy
    sum_j n_j m_j^2 / s_j^2 (s_j the joint's median residual): largest over the very window of the
    push. What acts more than once, as friction or a wrong model do, is as large elsewhere.
    """
    windows = _enumerate_windows(state)
    if windows is None:
        return None
    top = int(np.argmax(windows.energy))
    run, start, end = int(windows.run[top]), float(windows.start[top]), float(windows.end[top])
    same = windows.run == run
    near = (
        same
        & (windows.end > start - THRESHOLDS.push_separation)
        & (windows.start < end + THRESHOLDS.push_separation)
    )
    elsewhere = max(float(windows.energy[~near].max(initial=0.0)), 1e-300)
    ratio = float(windows.energy[top]) / elsewhere
    if ratio < THRESHOLDS.min_push_ratio or near.all():
        return None
    start, end = _extend_window(
        windows, same & (windows.energy > THRESHOLDS.min_adjoining_ratio * elsewhere), start, end
    )
    began = float(windows.start[same].min())
    if (
        start - began < THRESHOLDS.settling_time
        or end - start >= _LENGTHS[-1] * THRESHOLDS.push_cell
    ):
        return None
    return PushWindow(run, start, end, ratio)


def _extend_window(
    windows: _WindowEnergies, loud: np.ndarray, start: float, end: float
) -> tuple[float, float]:
    """The push with what adjoins it: as the robot moves, the torque of a push changes its sign."""
    while True:
        after = loud & (np.abs(windows.start - end) < THRESHOLDS.max_push_gap)
        before = loud & (np.abs(windows.end - start) < THRESHOLDS.max_push_gap)
        if not (after | before).any():
            return start, end
        best = int(np.argmax(np.where(after | before, windows.energy, 0.0)))
        start = min(start, float(windows.start[best]))
        end = max(end, float(windows.end[best]))
        loud = loud & (
            (windows.end <= start + THRESHOLDS.max_push_gap)
            | (windows.start >= end - THRESHOLDS.max_push_gap)
        )


def _enumerate_windows(state: State) -> _WindowEnergies | None:
    """The windows, from sums over cells of a tenth of a second; None where none fits."""
    run, number, total, rows = _accumulate_cells(state)
    parts = []
    for length in _LENGTHS:
        last = np.arange(length - 1, len(run))
        first = last - length + 1
        whole = (run[first] == run[last]) & (number[last] - number[first] <= length)
        first, last = first[whole], last[whole]
        count = rows[last + 1] - rows[first]
        square = (total[last + 1] - total[first]) ** 2
        energy = np.divide(square, count, out=np.zeros_like(square), where=count > 0).sum(axis=1)
        start, end = number[first] * THRESHOLDS.push_cell, (number[last] + 1) * THRESHOLDS.push_cell
        parts.append((run[first], start, end, energy))
    windows = _WindowEnergies(*(np.concatenate(part) for part in zip(*parts, strict=True)))
    return windows if len(windows.run) else None


def _accumulate_cells(state: State) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Log and number of each cell (cells,); sums before it of residuals and rows (cells + 1, J)."""
    rows = state.rows
    cell_keys = [
        np.column_stack([run, np.floor(time / THRESHOLDS.push_cell).astype(int)])
        for run, time in zip(rows.run, rows.time, strict=True)
    ]
    cells, place = np.unique(np.concatenate(cell_keys), axis=0, return_inverse=True)
    total, count = np.zeros((2, len(cells) + 1, rows.joint_count))
    ends = np.cumsum([len(keys) for keys in cell_keys])[:-1]
    for j, at in enumerate(np.split(np.ravel(place), ends)):
        size = float(np.median(np.abs(state.residual[j]))) if len(at) else 0.0
        if size > 0.0:
            total[1:, j] = np.bincount(at, state.residual[j] / size, len(cells))
            count[1:, j] = np.bincount(at, minlength=len(cells))
    return cells[:, 0], cells[:, 1], np.cumsum(total, axis=0), np.cumsum(count, axis=0)


def fit_push_torque(window: PushWindow, state: State, data: SearchData) -> PushWindow:
    """The push with its torques, if these surely lower the error (`scored`).

    A torque of each joint that changes steadily is fitted to the residuals of the window, that of
    each twentieth of a second to those around.

    Args:
        window: of the push.
        state: fitted to the logs without the window.
        data: the logs with it.
    """
    left = compute_residuals(state, data)
    inside = [
        np.flatnonzero((run == window.log) & (time >= window.start) & (time < window.end))
        for run, time in zip(left.run, left.time, strict=True)
    ]
    after = [residual.copy() for residual in left.residual]
    for rest, time, rows in zip(after, left.time, inside, strict=True):
        rest[rows] -= _predict_from_neighbours(time[rows] - window.start, rest[rows])
    pushed = dataclasses.replace(left, residual=tuple(after))
    score = compare_residuals(left, pushed, range(len(after)), state, THRESHOLDS.prediction_cell)
    if not score.is_better:
        return window
    parts = zip(left.names, left.residual, inside, strict=True)
    torque = {name: float(np.mean(residual[rows])) for name, residual, rows in parts if rows.size}
    return dataclasses.replace(window, torque=torque, change=score.whole)


def _predict_from_neighbours(since: np.ndarray, values: np.ndarray) -> np.ndarray:
    """(r,) what a straight line through the values in the cells around says of those in one."""
    cell, line = np.floor(since / THRESHOLDS.prediction_cell), np.vander(since, 2)
    prediction = np.zeros(len(values))
    for c in np.unique(cell):
        out, beside = cell == c, (cell != c) & (np.abs(cell - c) <= THRESHOLDS.prediction_reach)
        prediction[out] = line[out] @ np.linalg.lstsq(line[beside], values[beside], rcond=None)[0]
    return prediction


# Play in a gear: bursts of the residual where the load changes sign, not the speed.


def compute_burst_ratio(state: State, j: int) -> float:
    """Mean squared residual within 0.1 s after sign changes of the load, over that elsewhere.

    The loudest fifth of the events, and of the rows elsewhere the loudest hundredth, are left out:
    play bursts every time. 0 where the load changes sign, far from speed reversals, less than
    `EVENTS` times.
    """
    event, events = [], 0  # of each row, 0 for none: that of the sample amid its weights
    signals = state.rows.signals
    middle = np.round(state.rows.filter_samples(j, [np.arange(len(s.q)) for s in signals])).astype(
        int
    )
    for k, (s, turns) in enumerate(zip(signals, find_load_reversals(state, j), strict=True)):
        span = max(1, round(THRESHOLDS.burst_duration / s.step))
        flags = np.zeros(len(s.q))
        for turn in turns:
            events += 1
            flags[turn : turn + span] = events
        event.append(flags[middle[state.rows.segment[j] == k].clip(0, len(flags) - 1)])
    if events < THRESHOLDS.min_load_reversals:
        return 0.0
    return _compute_energy_ratio(state.residual[j] ** 2, np.concatenate(event), events)


def find_load_reversals(state: State, j: int) -> list[np.ndarray]:
    """Samples, by stretch, where the load on joint j changes sign while the joint moves on."""
    reversals = []
    for s in state.rows.signals:
        span, least = (
            max(1, round(THRESHOLDS.burst_duration / s.step)),
            0.02 * state.joint_scales[j].speed,
        )
        turns = np.flatnonzero(np.diff(np.sign(s.load[:, j])) != 0)
        speed = np.abs(s.v[:, j])
        moving = [turn for turn in turns if speed[turn : turn + span].min() > least]
        reversals.append(np.array(moving, dtype=int))
    return reversals


def _compute_energy_ratio(square: np.ndarray, event: np.ndarray, events: int) -> float:
    loud = np.sort([square[event == k].mean() for k in range(1, events + 1) if (event == k).any()])
    quiet = np.sort(square[event == 0])
    if len(loud) < THRESHOLDS.min_load_reversals or len(quiet) < 8:
        return 0.0
    trimmed_loud = loud[: len(loud) - max(1, len(loud) // 5)]
    rest = quiet[: len(quiet) - len(quiet) // 100]
    return float(trimmed_loud.mean() / max(float(rest.mean()), 1e-300))
