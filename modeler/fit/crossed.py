"""Does the fit predict motion like that of its logs? What was left out answers."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from modeler.fit.identify import Equations
from modeler.observation import Observation

FOLDS = 8

_SEEN = 1e-8  # pivot of a scaled column below which a fold does not see a direction


@dataclass(frozen=True, eq=False)
class Crossed:
    """Errors of the fit on stretches that it was not fitted to.

    Attributes:
        errors: (n,) ||y_j - W_j beta|| / ||y_j||, each stretch predicted from the others; nan for
            a joint without rows or torque.
        swing: s, half a period of the mean motion: the length of a stretch.
        stretches: that many.
        residual: (rows,) y - W beta, each row predicted from other stretches; 0 for those left out.
    """

    errors: np.ndarray
    swing: float
    stretches: int
    residual: np.ndarray = field(default_factory=lambda: np.zeros(0))

    def on(self, equations: Equations, rows: np.ndarray) -> np.ndarray:
        """(n,) the errors on some of the rows."""
        joint, count = equations.observation.row_joint[rows], len(equations.observation.joints)
        left = np.bincount(joint, self.residual[rows] ** 2, count)
        total = np.bincount(joint, equations.y[rows] ** 2, count)
        return np.sqrt(np.where(total > 0.0, left / np.where(total > 0.0, total, 1.0), np.nan))


def crossed(
    equations: Equations,
    rows: np.ndarray,
    sigma: np.ndarray,
    refit: Callable[[np.ndarray], np.ndarray] | None = None,
) -> Crossed:
    """Cross-validation over stretches of half a swing.

    A stretch is as long as the motion needs to turn round, pi rms(qd) / rms(qdd), the median over
    joints: neighbouring samples are alike, and would answer for each other. Every eighth stretch
    is held out together, so that the motions of a log stand in all parts.

    Args:
        equations: of all logs, with the columns of loads.
        rows: (rows,) True for those to use.
        sigma: (n,) standard deviation of a row of each joint.
        refit: beta without the samples (s,) that are held out; None: least squares of the
            other rows.
    """
    observation = equations.observation
    swing = _swing(observation)
    number = _stretches(observation, swing)
    seen = np.unique(number[observation.row_sample[rows]])
    fold = np.searchsorted(seen, number[observation.row_sample]) % FOLDS
    folds = [rows & (fold == k) for k in range(min(FOLDS, len(seen)))]
    parts = [equations.compressed(own).whole(sigma) for own in folds]
    residual = np.zeros(len(equations.y))
    for k, own in enumerate(folds):
        if refit is None:
            beta = solved(np.vstack([parts[0][:0], *parts[:k], *parts[k + 1 :]]))
        else:
            beta = refit(np.searchsorted(seen, number) % FOLDS == k)
        residual[own] = equations.residual(beta, own)
    found = Crossed(np.full(len(sigma), np.nan), swing, len(seen), residual)
    return replace(found, errors=found.on(equations, rows))


def _swing(observation: Observation) -> float:
    """s; that of the joints that move."""
    speed, acceleration = (
        np.sqrt(np.mean(values**2, axis=0)) for values in (observation.qd, observation.qdd)
    )
    moving = (speed > 1e-6 * speed.max(initial=0.0)) & (acceleration > 0.0)
    return float(np.median(np.pi * speed[moving] / acceleration[moving])) if moving.any() else 0.0


def _stretches(observation: Observation, swing: float) -> np.ndarray:
    """(s,) number of the stretch of each sample, ascending over the logs."""
    number, first = np.zeros(len(observation.time), dtype=int), 0
    for run in range(len(observation.logs)):
        own = observation.run == run
        if not own.any():
            continue
        since = observation.time[own] - observation.time[own].min()
        number[own] = first + (np.floor(since / swing).astype(int) if swing > 0.0 else 0)
        first = int(number[own].max()) + 1
    return number


def solved(whole: np.ndarray) -> np.ndarray:
    """(c,) least squares of a triangle [W y]; 0 along directions that it does not see."""
    W, y = whole[:, :-1], whole[:, -1]
    length = np.linalg.norm(W, axis=0)
    length[length == 0.0] = 1.0
    return np.asarray(np.linalg.lstsq(W / length, y, rcond=_SEEN)[0] / length)
