"""The axis on which a residual shows an effect, as the effect's definition names it."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.special import stdtrit

from modeler.diagnosis import Candidate, Signals, State
from modeler.effects import NOISE, TURN, EffectTarget, SignatureAxis
from modeler.regression import compute_travel_since_reversal


@dataclass(frozen=True, eq=False)
class Axis:
    """Of one joint.

    Attributes:
        shows: what it is.
        label: with unit.
        x: (rows_j,) by row.
        way: (rows_j,) 1 or -1 by the direction of motion, that the residual is multiplied by; None
            where the direction is no matter.
    """

    shows: SignatureAxis
    label: str
    x: np.ndarray
    direction: np.ndarray | None

    @property
    def label_suffix(self) -> str:
        """Behind the word residual."""
        return "" if self.direction is None else " x sign of velocity"

    def apply_direction(self, y: np.ndarray) -> np.ndarray:
        """(rows_j,) y, times the direction of motion where that matters."""
        return y if self.direction is None else y * self.direction


def build_axis(state: State, pick: Candidate, j: int, effect_torque: np.ndarray) -> Axis:
    """The axis of an effect on joint j.

    Args:
        state: rows and model.
        pick: the effect.
        j: index of the joint that is drawn.
        effect_torque: (rows_j,) torque of the effect there, N m or N.
    """
    shows = _choose_axis(pick, j)
    joint = state.data.compiled.spec.joints[j]
    if shows == "itself":
        return Axis(shows, f"what the effect adds [{joint.effort_unit}]", effect_torque, None)
    way = np.sign(
        state.rows.filter_samples(j, [_VALUES["v"](pick, s, j) for s in state.rows.signals])
    )
    # where the effect turns with the motion and the axis does not say which way it goes
    slips = pick.form.internal_state is not None and pick.form.internal_state.kind == "slip"
    turns = shows not in ("v", "a", "waves") and ("v" in pick.form.names or slips)
    values = [_VALUES[shows](pick, s, j) for s in state.rows.signals]
    if shows == "load" and turns:
        values = [np.abs(value) for value in values]
    label = _write_label(shows, pick, joint.unit, joint.effort_unit, turns)
    return Axis(shows, label, state.rows.filter_samples(j, values), way if turns else None)


def _choose_axis(pick: Candidate, j: int) -> SignatureAxis:
    """The axis of the effect; of a joint that it reaches only through others, its own torque."""
    shows = pick.effect.shows
    if pick.is_local and j != pick.index:
        return "itself"
    return "t" if shows == "T" and "T" not in pick.form.names else shows


def _select_shaft_motion(pick: Candidate, motion: np.ndarray, j: int) -> np.ndarray:
    """(n,) of joint j, or of the motor that turns with several joints."""
    if pick.effect.acts is not EffectTarget.MOTOR:
        return motion[:, j]
    return np.asarray(sum(factor * motion[:, k] for k, factor in pick.coupling.items()))


def _compute_load(pick: Candidate, signals: Signals, j: int) -> np.ndarray:
    """Of gravity, and of inertia as far as the effect's share w counts it."""
    share = pick.nonlinear_parameters.get("w", 1.0) if "static" in pick.form.names else 1.0
    static = signals.static[:, j]
    return np.asarray(static + share * (signals.load[:, j] - static))


def _read_temperature(pick: Candidate, signals: Signals, j: int) -> np.ndarray:
    heat = signals.compute_temperature(pick.joint or "")
    return np.zeros(len(signals.q)) if heat is None else heat


_VALUES: dict[SignatureAxis, Callable[[Candidate, Signals, int], np.ndarray]] = {
    "q": lambda pick, s, j: s.q[:, j],
    "v": lambda pick, s, j: _select_shaft_motion(pick, s.v, j),
    "a": lambda pick, s, j: _select_shaft_motion(pick, s.a, j),
    "load": _compute_load,
    "torque": lambda pick, s, j: s.torque[:, j],
    "rate": lambda pick, s, j: s.rate[:, j],
    "t": lambda pick, s, j: s.time,
    "T": _read_temperature,
    "since": lambda pick, s, j: s.compute_reversal_time(
        j, pick.nonlinear_parameters.get(TURN, NOISE)
    ),
    "travel": lambda pick, s, j: compute_travel_since_reversal(s.q[:, j]),
    "waves": lambda pick, s, j: np.degrees(
        (pick.nonlinear_parameters["m"] * s.q[:, j]) % (2.0 * np.pi)
    ),
}


def _write_label(shows: SignatureAxis, pick: Candidate, unit: str, effort: str, turns: bool) -> str:
    of = " of the motor" if pick.effect.acts is EffectTarget.MOTOR else ""
    return {
        "q": f"position [{unit}]",
        "v": f"velocity{of} [{unit}/s]",
        "a": f"acceleration{of} [{unit}/s2]",
        "load": f"|load| [{effort}]" if turns else f"load [{effort}]",
        "torque": f"predicted torque [{effort}]",
        "rate": f"rate of the predicted torque [{effort}/s]",
        "t": "time [s]",
        "T": "temperature less its mean [K]",
        "since": "time since the last reversal [s]",
        "travel": f"travel since the last reversal [{unit}]",
        "waves": "place within one wave [deg]",
        "itself": "",
    }[shows]


# Means of a residual along an axis, with errors that count what neighbouring rows share.


COUNT = 40
"""Bins at most."""

_ROWS = 8  # in a bin, at least
_BLOCKS = 4  # of time in a bin, at least: fewer say nothing of its error
_WILD = 8.0  # robust standard deviations from which on a row may be wild
_FEW = 0.05  # share of the blocks that may hold wild rows: what returns everywhere is no accident


@dataclass(frozen=True, eq=False)
class Bins:
    """Which rows stand in which bin; b bins, side by side in x.

    Attributes:
        place: (rows,) bin of each row; -1 for one that is in none.
        centre: (b,) mean of x.
        edges: indices of bins that begin a new piece, where x changes its sign.
    """

    place: np.ndarray
    centre: np.ndarray
    edges: tuple[int, ...]

    @property
    def count(self) -> int:
        """Number of bins."""
        return len(self.centre)

    def compute_means(self, y: np.ndarray) -> np.ndarray:
        """(b,) means of y (rows,)."""
        held = self.place >= 0
        total = np.bincount(self.place[held], y[held], self.count)
        return np.asarray(total / np.bincount(self.place[held], minlength=self.count))

    def compute_errors(self, y: np.ndarray, block: np.ndarray) -> np.ndarray:
        """(b,) half widths of the 95 % intervals of the means; NaN where one block fills a bin.

        Rows of one block of time share their noise: the spread between blocks counts,
        s^2 = G/(G-1) sum_g (sum_{i in g} (y_i - mean))^2 / n^2 with G blocks g, and Student's t.

        Args:
            y: (rows,).
            block: (rows,) block of time of each row.
        """
        held = self.place >= 0
        place, mean = self.place[held], self.compute_means(y)
        deviation = y[held] - mean[place]
        cell, inverse = np.unique(
            np.column_stack([place, block[held]]), axis=0, return_inverse=True
        )
        total = np.bincount(inverse.ravel(), deviation, len(cell))
        groups = np.bincount(cell[:, 0], minlength=self.count)
        spread = np.bincount(cell[:, 0], total**2, self.count)
        free = np.where(groups > 1, groups - 1, np.nan)
        error = np.sqrt(groups / free * spread) / np.bincount(place, minlength=self.count)
        return np.asarray(error * stdtrit(free, 0.975))


def build_bins(x: np.ndarray, weight: np.ndarray, block: np.ndarray, is_inlier: np.ndarray) -> Bins:
    """About 40 bins of x: half of them share the rows evenly, half the square of an effect.

    So an effect that acts in a narrow place is seen there. No bin has rows of both signs, and
    none fewer than four blocks of time: there are fewer bins then.

    Args:
        x: (rows,) the axis.
        weight: (rows,) torque of the effect.
        block: (rows,) block of time of each row.
        is_inlier: (rows,) False for rows that are left out.
    """
    square = weight**2
    total = float(square[is_inlier].sum())
    mass = np.full(len(x), 1.0 / max(1, int(is_inlier.sum())))
    mass += square / total if total > 0.0 else mass
    place = np.full(len(x), -1)
    edges, made = [0], 0
    for side in (x < 0.0, x >= 0.0):
        rows = np.flatnonzero(side & is_inlier)
        parts = _cut_bins(rows[np.argsort(x[rows], kind="stable")], mass, block)
        for part in parts:
            place[part] = made
            made += 1
        edges.append(made)
    held = place >= 0
    centre = np.bincount(place[held], x[held], made) / np.bincount(place[held], minlength=made)
    return Bins(place, centre, tuple(dict.fromkeys(e for e in edges if e < made)))


def _cut_bins(order: np.ndarray, mass: np.ndarray, block: np.ndarray) -> list[np.ndarray]:
    """The rows cut into bins, in this order; what is left over at the end joins the last."""
    full = 2.0 / COUNT
    parts: list[np.ndarray] = []
    start, held, blocks = 0, 0.0, set[int]()
    for at, row in enumerate(order.tolist()):
        held += float(mass[row])
        blocks.add(int(block[row]))
        if held >= full and at + 1 - start >= _ROWS and len(blocks) >= _BLOCKS:
            parts.append(order[start : at + 1])
            start, held, blocks = at + 1, 0.0, set()
    rest = order[start:]
    if rest.size and parts and (held < 0.5 * full or len(blocks) < _BLOCKS or rest.size < _ROWS):
        parts[-1] = np.concatenate([parts[-1], rest])
    elif rest.size >= _ROWS:
        parts.append(rest)
    return parts


def find_inliers(left: np.ndarray, block: np.ndarray) -> np.ndarray:
    """(rows,) False for the wild ones: far out with everything in the model, and in few blocks.

    Args:
        left: (rows,) residual with the effect.
        block: (rows,) block of time of each row.
    """
    away = np.abs(left - np.median(left))
    wild = away > _WILD * 1.4826 * np.median(away)
    if np.unique(block[wild]).size > max(1.0, _FEW * np.unique(block).size):
        return np.ones(len(left), dtype=bool)
    return np.asarray(~wild)
