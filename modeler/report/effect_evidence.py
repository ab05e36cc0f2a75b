"""An effect on the joint that shows it: what was left without it, with it, and to any rival."""

from dataclasses import dataclass

import numpy as np

from modeler.core.table import WORDS, percent
from modeler.diagnosis import Base, Search, State, Step, columns_of, rival, state_of
from modeler.report.evidence_axes import Axis, Bins, axis_of, bins_of, calm_rows


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
        own_sigma: (b,) standard deviations of the means of `own`; None where that is None.
    """

    step: Step
    without: State
    full: State
    j: int
    axis: Axis
    rival: np.ndarray | None
    own: np.ndarray | None
    calm: np.ndarray
    bins: Bins
    own_sigma: np.ndarray | None = None

    @property
    def before(self) -> np.ndarray:
        """(rows_j,) residual without the effect, N m or N."""
        return self.without.residual[self.j]

    @property
    def adds(self) -> np.ndarray:
        """(rows_j,) what the effect takes out of the residual."""
        return self.before - self.after

    @property
    def after(self) -> np.ndarray:
        """(rows_j,) residual with it."""
        return self.full.residual[self.j]

    def errors(self) -> np.ndarray:
        """(b,) half widths of 95 % intervals of the bins' means about the effect."""
        return self.bins.errors(self.axis.turned(self.after), self.block)

    @property
    def block(self) -> np.ndarray:
        """(rows_j,) block of time."""
        return self.without.base.block[self.j]

    @property
    def unit(self) -> str:
        """Of the residual."""
        return self.without.data.compiled.spec.joints[self.j].effort_unit


def evidence_of(found: Search, step: Step) -> Evidence:
    """What there is to draw of an effect.

    Args:
        found: the search.
        step: of the effect.
    """
    full, others = found.end, [s.pick for s in found.steps if s is not step]
    start = found.start
    without = state_of(start.data, others, full.beta) if others else start
    j = _joint(step, without, full)
    adds = without.residual[j] - full.residual[j]
    axis = axis_of(full, step.pick, j, adds)
    calm = calm_rows(full.residual[j], full.base.block[j])
    own = None if axis.shows == "itself" else _own(found, step, j)
    bins = bins_of(axis.x, adds if own is None else own, without.base.block[j], calm)
    return Evidence(
        step=step, without=without, full=full, j=j, axis=axis,
        rival=rival(without, j, without.residual[j]).prediction, own=own, calm=calm,
        bins=bins, own_sigma=None if own is None else law_sigma(found, step, j, axis, bins),
    )  # fmt: skip


def _joint(step: Step, without: State, full: State) -> int:
    """The effect's own joint, or where it explains most."""
    if step.judged.alone:
        return step.pick.index
    falls = [
        float(np.sum(before**2) - np.sum(after**2)) / size**2 if size > 0.0 else 0.0
        for before, after, size in zip(
            without.residual, full.residual, without.base.sigma, strict=True
        )
    ]
    return int(np.argmax(falls))


def _own(found: Search, step: Step, j: int) -> np.ndarray | None:
    """(rows_j,) torque of the effect on joint j, whether or not the model could imitate it."""
    place = next(i for i, s in enumerate(found.steps) if s is step)
    columns = columns_of(found.end.rows, step.pick)[j]
    return None if columns is None else columns @ found.end.values[place]


def figures(item: Evidence) -> str:
    """What is left on blocks of time that were left out of the fit, N m or N, and in percent."""
    size = float(np.sqrt(np.mean(item.without.rows.y[item.j] ** 2)))

    def rms_left(left: np.ndarray) -> str:
        rms = float(np.sqrt(np.mean(left**2)))
        return f"{rms:.3g} {item.unit} ({percent(rms / size if size > 0.0 else None)})"

    before, after = (crossed(state, item.j) for state in (item.without, item.full))
    joint = item.without.data.compiled.spec.joints[item.j].name
    text = (
        f"Rms residual of joint {joint} on left-out blocks of the training logs: "
        f"{rms_left(before)} without the effect, {rms_left(after)} with it"
    )
    if item.rival is None:
        return f"{text}."
    return (
        f"{text}, {rms_left(before - item.rival)} with the flexible rival, which stands for any "
        f"smooth law of what was measured. Percent of the joint's rms {WORDS[item.unit]}, "
        f"{size:.3g} {item.unit}."
    )


def crossed(state: State, j: int) -> np.ndarray:
    """(rows_j,) residual of joint j, every row by the fit to all other folds, N m or N."""
    base = state.base
    beta = base.crossed.beta[base.crossed.place[base.block[j]]]
    return np.asarray(base.sigma[j] * (base.y[j] - np.einsum("ij,ij->i", base.columns[j], beta)))


def law_sigma(found: Search, step: Step, j: int, axis: Axis, bins: Bins) -> np.ndarray | None:
    """(b,) standard deviations of the mean torque of an effect in each bin, N m or N.

    The torque is m beta_e with the means m of the effect's columns, so its variance is m C m^T.
    C is the part of the effect in the covariance of all parameters of the model with all effects,

        C = G^-1 (B / (B - 1) sum_b s_b s_b^T) G^-1,  s_b = sum_{i in b} w_i e_i,

    G the Gram matrix of the weighted rows w_i, e_i their residuals, summed over the B blocks of
    time: rows of one block share their noise. Shapes are taken as known.

    Args:
        found: the search.
        step: of the effect.
        j: index of the joint that is drawn.
        axis: on which it is drawn.
        bins: of the axis.
    """
    place = next(i for i, s in enumerate(found.steps) if s is step)
    columns = columns_of(found.end.rows, step.pick)[j]
    if columns is None:
        return None
    covariance = covariance_of(found.end.base)
    first = covariance.shape[0] - sum(len(values) for values in found.end.values[place:])
    own = slice(first, first + len(found.end.values[place]))
    means = np.column_stack([bins.means(axis.turned(column)) for column in columns.T])
    variance = np.einsum("bi,ij,bj->b", means, covariance[own, own], means)
    return np.asarray(np.sqrt(np.maximum(variance, 0.0)))


def covariance_of(base: Base) -> np.ndarray:
    """(f + extra, f + extra) C of all parameters of a state, as `law_sigma` states it."""
    G, u = base.G.sum(axis=0), base.u.sum(axis=0)
    inverse = np.linalg.pinv(G)
    theta, scores = inverse @ u, np.zeros((base.blocks, len(u)))
    for columns, y, block in zip(base.columns, base.y, base.block, strict=True):
        np.add.at(scores, block, columns * (y - columns @ theta)[:, None])
    meat = scores.T @ scores * base.blocks / max(1, base.blocks - 1)
    return np.asarray(base.turn @ inverse @ meat @ inverse @ base.turn.T)
