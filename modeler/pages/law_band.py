"""How sure the curve of an effect is."""

import numpy as np

from modeler.diagnose.search import Search, Step
from modeler.pages.axes import Axis
from modeler.pages.bins import Bins
from modeler.scoring.gram import Base
from modeler.scoring.state import columns_of


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
    columns = columns_of(found.end.rows, step.pick, found.end.cache)[j]
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
