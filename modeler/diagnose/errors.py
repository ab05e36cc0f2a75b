"""Errors of a state on motion it was not fitted to."""

from collections.abc import Callable, Sequence

import numpy as np

from modeler.diagnose.judge import Judged
from modeler.scoring.score import Unseen, scored
from modeler.scoring.state import Data, State, picked_columns


def relative(left: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Relative errors from mean squares of residual and torque; 0 without torque."""
    return np.sqrt(left / np.where(size > 0.0, size, np.inf))


def held_out_squares(state: State, data: Data) -> tuple[np.ndarray, np.ndarray]:
    """(J,) mean squared residual on other logs, parameters of the state; and mean squared torque.

    Args:
        state: fitted.
        data: held-out logs, in the same band.
    """
    squares, size = np.zeros(data.rows.joints), np.zeros(data.rows.joints)
    for j, left in enumerate(_held_out_residuals(state, data)):
        if left.size:
            squares[j], size[j] = np.mean(left**2), np.mean(data.rows.y[j] ** 2)
    return squares, size


def _held_out_residuals(state: State, data: Data) -> list[np.ndarray]:
    """(rows_j,) by joint, N m or N."""
    rows = data.about(state.reference)
    extra = picked_columns(rows, state.picks, data.cache)
    found = []
    for j in range(rows.joints):
        left = rows.y[j] - rows.W[j] @ state.beta
        for columns, values in zip(extra, state.values, strict=True):
            own = columns[j]
            if own is not None:
                left = left - own @ values
        found.append(left)
    return found


def crossed_errors(state: State) -> np.ndarray:
    """(J,) the same by cross-validation over the folds of the training logs."""
    size = np.array([float(np.sum((y / s) ** 2)) for y, s in
                     zip(state.rows.y, state.base.sigma, strict=True)])  # fmt: skip
    return np.sqrt(state.base.crossed.left / np.where(size > 0.0, size, 1.0))


def over(state: State, concerned: Sequence[int], errors: np.ndarray) -> float:
    """Relative error over some joints: the torque of each counts in units of what is left of it."""
    torque = zip(state.rows.y, state.base.sigma, strict=True)
    size = np.array([float(np.mean((y / s) ** 2)) if y.size else 0.0 for y, s in torque])
    own = list(concerned)
    total = float(size[own].sum())
    return float(np.sqrt(float(np.sum(size[own] * errors[own] ** 2)) / max(total, 1e-300)))


KEPT = 0.2
"""Share of the expected gain that must come true on held-out motion, which may excite it less."""

TOUCHED = 0.1
"""Least fall of a joint's squared residual, as a share of the largest, that counts as touched."""


def touched_joints(judged: Judged, before: State, after: State) -> list[int]:
    """Joints whose residuals an effect explains: its own, or all where they fall most."""
    if judged.alone:
        return [judged.candidate.index]
    sigma = before.base.sigma
    fall = np.array(
        [
            float(np.sum((b / s) ** 2) - np.sum((a / s) ** 2))
            for b, a, s in zip(before.residual, after.residual, sigma, strict=True)
        ]
    )
    if fall.max() <= 0.0:
        return [int(np.argmax(fall))]
    return [int(j) for j in np.flatnonzero(fall >= TOUCHED * fall.max())]


def vetoing(data: Data) -> Callable[[State, State, Judged], bool]:
    """A veto by held-out logs: True if a state with an effect more is not the better one there.

    The error of the joints that it touches must fall by a good part of what the effect lets expect,
    and by more than chance (`scored`).

    Args:
        data: held-out logs.
    """

    def veto(before: State, after: State, judged: Judged) -> bool:
        touched = touched_joints(judged, before, after)
        old, new = (
            over(before, touched, relative(*held_out_squares(state, data)))
            for state in (before, after)
        )
        expected = judged.gain if judged.alone else _fall(touched, before, after)
        if 1.0 - (new / max(old, 1e-300)) ** 2 < KEPT * expected:
            return True
        return not scored(*(_unseen(state, data) for state in (before, after))).better

    return veto


def _fall(joints: Sequence[int], before: State, after: State) -> float:
    """Share of the squared residual of some joints that is gone, in units of the first one."""
    sums = [
        sum(float(np.sum((s.residual[j] / before.base.sigma[j]) ** 2)) for j in joints)
        for s in (before, after)
    ]
    return 1.0 - sums[1] / max(sums[0], 1e-300)


def _unseen(state: State, data: Data) -> Unseen:
    rows = data.rows
    names = tuple(joint.name for joint in data.compiled.spec.joints)
    left = _held_out_residuals(state, data)
    return Unseen(names, tuple(left), rows.y, rows.time, rows.run)
