"""The axis on which a residual shows an effect, as the effect's definition names it."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.special import stdtrit

from modeler.core.table import WORDS, format_percent
from modeler.diagnosis import (
    Candidate,
    GramBlocks,
    Search,
    SearchStep,
    Signals,
    State,
    build_columns,
    build_state,
    fit_residual_baseline,
)
from modeler.effects import NOISE, TURN, EffectTarget, SignatureAxis
from modeler.regression import compute_travel_since_reversal
from modeler.views.thresholds import THRESHOLDS


@dataclass(frozen=True, eq=False)
class Axis:
    """A quantity of one joint, over which a residual is drawn.

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
        """Returns what follows the word residual on an axis."""
        return "" if self.direction is None else " x sign of velocity"

    def apply_direction(self, y: np.ndarray) -> np.ndarray:
        """Returns (rows_j,) y times the direction of motion where that matters."""
        return y if self.direction is None else y * self.direction


def build_axis(state: State, pick: Candidate, j: int, effect_torque: np.ndarray) -> Axis:
    """Builds the axis of an effect on joint j.

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
    turns = shows not in ("v", "a", "waves") and ("v" in pick.form.names or bool(pick.loop))
    values = [_VALUES[shows](pick, s, j) for s in state.rows.signals]
    if shows == "load" and turns:
        values = [np.abs(value) for value in values]
    label = _write_label(shows, pick, joint.unit, joint.effort_unit, turns)
    return Axis(shows, label, state.rows.filter_samples(j, values), way if turns else None)


def _choose_axis(pick: Candidate, j: int) -> SignatureAxis:
    """The axis of the effect; of a joint that it reaches only through others, its own torque."""
    shows = pick.effect.signature_axis
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
        """Returns the number of bins."""
        return len(self.centre)

    def compute_means(self, y: np.ndarray) -> np.ndarray:
        """Computes (b,) means of y (rows,)."""
        held = self.place >= 0
        total = np.bincount(self.place[held], y[held], self.count)
        return np.asarray(total / np.bincount(self.place[held], minlength=self.count))

    def compute_errors(self, y: np.ndarray, block: np.ndarray) -> np.ndarray:
        """Returns (b,) half widths of 95 % intervals of the means; NaN for bins of one block.

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
    """Builds about 40 bins of x, half of equal rows, half of equal squared effect.

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
    full = 2.0 / THRESHOLDS.max_bins
    parts: list[np.ndarray] = []
    start, held, blocks = 0, 0.0, set[int]()
    for at, row in enumerate(order.tolist()):
        held += float(mass[row])
        blocks.add(int(block[row]))
        if (
            held >= full
            and at + 1 - start >= THRESHOLDS.min_bin_rows
            and len(blocks) >= THRESHOLDS.min_bin_blocks
        ):
            parts.append(order[start : at + 1])
            start, held, blocks = at + 1, 0.0, set()
    rest = order[start:]
    if (
        rest.size
        and parts
        and (
            held < 0.5 * full
            or len(blocks) < THRESHOLDS.min_bin_blocks
            or rest.size < THRESHOLDS.min_bin_rows
        )
    ):
        parts[-1] = np.concatenate([parts[-1], rest])
    elif rest.size >= THRESHOLDS.min_bin_rows:
        parts.append(rest)
    return parts


def find_inliers(left: np.ndarray, block: np.ndarray) -> np.ndarray:
    """Returns (rows,) False for outliers of the full model that occur in few blocks of time.

    Args:
        left: (rows,) residual with the effect.
        block: (rows,) block of time of each row.
    """
    away = np.abs(left - np.median(left))
    wild = away > THRESHOLDS.min_wild_deviations * 1.4826 * np.median(away)
    if np.unique(block[wild]).size > max(1.0, THRESHOLDS.max_wild_blocks * np.unique(block).size):
        return np.ones(len(left), dtype=bool)
    return np.asarray(~wild)


# An effect on the joint that shows it: what was left without it, with it, and to any alternative.


@dataclass(frozen=True, eq=False)
class Evidence:
    """The evidence for one effect: fits with all other found effects, without it and with it.

    Attributes:
        step: of the effect.
        without, full: the model without the effect and with it, parameters fitted each time.
        j: index of the joint.
        axis: on which the effect shows itself.
        baseline: (rows_j,) nonparametric prediction of the residual without the effect, on
            rows it was not fitted to; None for too few rows.
        own: (rows_j,) torque of the effect there, also what the model could imitate, N m or N; None
            where the axis is the effect itself.
        calm: (rows_j,) False for the few wild rows that no mean counts.
        bins: of the axis.
        own_sigma: (b,) standard deviations of the means of `effect_torque`; None where that is
            None.
    """

    step: SearchStep
    without: State
    full: State
    j: int
    axis: Axis
    baseline: np.ndarray | None
    effect_torque: np.ndarray | None
    is_inlier: np.ndarray
    bins: Bins
    effect_torque_sigma: np.ndarray | None = None

    @property
    def before(self) -> np.ndarray:
        """Returns (rows_j,) residual without the effect, N m or N."""
        return self.without.residual[self.j]

    @property
    def contribution(self) -> np.ndarray:
        """Returns (rows_j,) what the effect removes from the residual."""
        return self.before - self.after

    @property
    def after(self) -> np.ndarray:
        """Returns (rows_j,) residual with the effect, N m or N."""
        return self.full.residual[self.j]

    def compute_errors(self) -> np.ndarray:
        """Computes (b,) half widths of 95 % intervals of the bins' means about the effect."""
        return self.bins.compute_errors(self.axis.apply_direction(self.after), self.block)

    @property
    def block(self) -> np.ndarray:
        """Returns (rows_j,) block of time."""
        return self.without.gram_blocks.block[self.j]

    @property
    def unit(self) -> str:
        """Returns the unit of the residual."""
        return self.without.data.compiled.spec.joints[self.j].effort_unit


def collect_evidence(search: Search, step: SearchStep) -> Evidence:
    """Collects what is drawn of an effect.

    Args:
        search: the search.
        step: of the effect.
    """
    full, others = search.end, [s.candidate for s in search.steps if s is not step]
    start = search.start
    without = build_state(start.data, others, full.beta) if others else start
    j = _choose_joint(step, without, full)
    contribution = without.residual[j] - full.residual[j]
    axis = build_axis(full, step.candidate, j, contribution)
    is_inlier = find_inliers(full.residual[j], full.gram_blocks.block[j])
    effect_torque = None if axis.shows == "itself" else _compute_effect_torque(search, step, j)
    bins = build_bins(
        axis.x,
        contribution if effect_torque is None else effect_torque,
        without.gram_blocks.block[j],
        is_inlier,
    )
    return Evidence(
        step=step,
        without=without,
        full=full,
        j=j,
        axis=axis,
        baseline=fit_residual_baseline(without, j, without.residual[j]).prediction,
        effect_torque=effect_torque,
        is_inlier=is_inlier,
        bins=bins,
        effect_torque_sigma=None
        if effect_torque is None
        else compute_law_sigma(search, step, j, axis, bins),
    )


def _choose_joint(step: SearchStep, without: State, full: State) -> int:
    """The effect's own joint, or where it explains most."""
    if step.score.is_local:
        return step.candidate.index
    falls = [
        float(np.sum(before**2) - np.sum(after**2)) / size**2 if size > 0.0 else 0.0
        for before, after, size in zip(
            without.residual, full.residual, without.gram_blocks.sigma, strict=True
        )
    ]
    return int(np.argmax(falls))


def _compute_effect_torque(search: Search, step: SearchStep, j: int) -> np.ndarray | None:
    """(rows_j,) torque of the effect on joint j, whether or not the model could imitate it."""
    place = next(i for i, s in enumerate(search.steps) if s is step)
    columns = build_columns(search.end.rows, step.candidate)[j]
    return None if columns is None else columns @ search.end.values[place]


def describe_residuals(item: Evidence) -> str:
    """Describes the rms residuals on left-out blocks of time, N m or N, and in percent."""
    size = float(np.sqrt(np.mean(item.without.rows.y[item.j] ** 2)))

    def format_rms(left: np.ndarray) -> str:
        rms = float(np.sqrt(np.mean(left**2)))
        return f"{rms:.3g} {item.unit} ({format_percent(rms / size if size > 0.0 else None)})"

    before, after = (
        compute_cross_validated_residual(state, item.j) for state in (item.without, item.full)
    )
    joint = item.without.data.compiled.spec.joints[item.j].name
    text = (
        f"Rms residual of joint {joint} on left-out blocks of the training logs: "
        f"{format_rms(before)} without the effect, {format_rms(after)} with it"
    )
    if item.baseline is None:
        return f"{text}."
    return (
        f"{text}, {format_rms(before - item.baseline)} with the nonparametric fit, which is "
        f"any smooth law of what was measured. Percent of the joint's rms {WORDS[item.unit]}, "
        f"{size:.3g} {item.unit}."
    )


def compute_cross_validated_residual(state: State, j: int) -> np.ndarray:
    """Returns (rows_j,) residual of joint j, N m or N, every row by the fit to all other folds."""
    base = state.gram_blocks
    beta = base.fold_fits.beta[base.fold_fits.fold_index[base.block[j]]]
    return np.asarray(
        base.sigma[j] * (base.y[j] - np.einsum("ij,ij->i", base.whitened_columns[j], beta))
    )


def compute_law_sigma(
    search: Search, step: SearchStep, j: int, axis: Axis, bins: Bins
) -> np.ndarray | None:
    """Computes (b,) standard deviations of an effect's mean torque in each bin, N m or N.

    The torque is m beta_e with the means m of the effect's columns, so its variance is m C m^T.
    C is the part of the effect in the covariance of all parameters of the model with all effects,

        C = G^-1 (B / (B - 1) sum_b s_b s_b^T) G^-1,  s_b = sum_{i in b} w_i e_i,

    G the Gram matrix of the weighted rows w_i, e_i their residuals, summed over the B blocks of
    time: rows of one block share their noise. Shapes are taken as known.

    Args:
        search: the search.
        step: of the effect.
        j: index of the joint that is drawn.
        axis: on which it is drawn.
        bins: of the axis.
    """
    place = next(i for i, s in enumerate(search.steps) if s is step)
    columns = build_columns(search.end.rows, step.candidate)[j]
    if columns is None:
        return None
    covariance = compute_covariance(search.end.gram_blocks)
    first = covariance.shape[0] - sum(len(values) for values in search.end.values[place:])
    effect_columns = slice(first, first + len(search.end.values[place]))
    means = np.column_stack([bins.compute_means(axis.apply_direction(c)) for c in columns.T])
    variance = np.einsum("bi,ij,bj->b", means, covariance[effect_columns, effect_columns], means)
    return np.asarray(np.sqrt(np.maximum(variance, 0.0)))


def compute_covariance(base: GramBlocks) -> np.ndarray:
    """Computes (f + extra, f + extra) C of all parameters as `compute_law_sigma` defines it."""
    G, u = base.G.sum(axis=0), base.u.sum(axis=0)
    inverse = np.linalg.pinv(G)
    theta, scores = inverse @ u, np.zeros((base.block_count, len(u)))
    for columns, y, block in zip(base.whitened_columns, base.y, base.block, strict=True):
        np.add.at(scores, block, columns * (y - columns @ theta)[:, None])
    meat = scores.T @ scores * base.block_count / max(1, base.block_count - 1)
    return np.asarray(base.whitener @ inverse @ meat @ inverse @ base.whitener.T)
