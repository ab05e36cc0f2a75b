"""An effect on the joint that shows it: what was left without it, with it, and to any rival."""

from dataclasses import dataclass

import numpy as np

from modeler.core.table import WORDS, format_percent
from modeler.diagnosis import (
    GramBlocks,
    Search,
    SearchStep,
    State,
    build_columns,
    build_state,
    fit_residual_baseline,
)
from modeler.views.evidence_axes import Axis, Bins, build_axis, build_bins, find_inliers


@dataclass(frozen=True, eq=False)
class Evidence:
    """All other effects that were found are in the model, with the effect and without it.

    Attributes:
        step: of the effect.
        without, full: the model without the effect and with it, parameters fitted each time.
        j: index of the joint.
        axis: on which the effect shows itself.
        rival: (rows_j,) the flexible rival's prediction of the residual without the effect, on
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
        """(rows_j,) residual without the effect, N m or N."""
        return self.without.residual[self.j]

    @property
    def contribution(self) -> np.ndarray:
        """(rows_j,) what the effect takes out of the residual."""
        return self.before - self.after

    @property
    def after(self) -> np.ndarray:
        """(rows_j,) residual with it."""
        return self.full.residual[self.j]

    def compute_errors(self) -> np.ndarray:
        """(b,) half widths of 95 % intervals of the bins' means about the effect."""
        return self.bins.compute_errors(self.axis.apply_direction(self.after), self.block)

    @property
    def block(self) -> np.ndarray:
        """(rows_j,) block of time."""
        return self.without.gram_blocks.block[self.j]

    @property
    def unit(self) -> str:
        """Of the residual."""
        return self.without.data.compiled.spec.joints[self.j].effort_unit


def collect_evidence(search: Search, step: SearchStep) -> Evidence:
    """What there is to draw of an effect.

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
    """What is left on blocks of time that were left out of the fit, N m or N, and in percent."""
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
        f"{text}, {format_rms(before - item.baseline)} with the flexible rival, which stands for "
        "any "
        f"smooth law of what was measured. Percent of the joint's rms {WORDS[item.unit]}, "
        f"{size:.3g} {item.unit}."
    )


def compute_cross_validated_residual(state: State, j: int) -> np.ndarray:
    """(rows_j,) residual of joint j, every row by the fit to all other folds, N m or N."""
    base = state.gram_blocks
    beta = base.fold_fits.beta[base.fold_fits.fold_index[base.block[j]]]
    return np.asarray(
        base.sigma[j] * (base.y[j] - np.einsum("ij,ij->i", base.whitened_columns[j], beta))
    )


def compute_law_sigma(
    search: Search, step: SearchStep, j: int, axis: Axis, bins: Bins
) -> np.ndarray | None:
    """(b,) standard deviations of the mean torque of an effect in each bin, N m or N.

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
    means = np.column_stack(
        [bins.compute_means(axis.apply_direction(column)) for column in columns.T]
    )
    variance = np.einsum("bi,ij,bj->b", means, covariance[effect_columns, effect_columns], means)
    return np.asarray(np.sqrt(np.maximum(variance, 0.0)))


def compute_covariance(base: GramBlocks) -> np.ndarray:
    """(f + extra, f + extra) C of all parameters of a state, as `compute_law_sigma` states it."""
    G, u = base.G.sum(axis=0), base.u.sum(axis=0)
    inverse = np.linalg.pinv(G)
    theta, scores = inverse @ u, np.zeros((base.block_count, len(u)))
    for columns, y, block in zip(base.whitened_columns, base.y, base.block, strict=True):
        np.add.at(scores, block, columns * (y - columns @ theta)[:, None])
    meat = scores.T @ scores * base.block_count / max(1, base.block_count - 1)
    return np.asarray(base.whitener @ inverse @ meat @ inverse @ base.whitener.T)
