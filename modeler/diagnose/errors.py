"""Errors of a state on motion it was not fitted to."""

import dataclasses
from collections.abc import Callable, Sequence

import numpy as np

from modeler.diagnose.judge import Judged
from modeler.diagnose.state import Data, State, picked_columns


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


def _held_out_residuals(state: State, data: Data, later: float = 0.0) -> list[np.ndarray]:
    """(rows_j,) by joint, N m or N; with so many s added to the clock."""
    reference = dataclasses.replace(state.reference, time=state.reference.time - later)
    rows = data.about(reference)
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

CONFIRMED = 0.05
"""The same for effects that instrumental variables have confirmed already."""


def vetoing(data: Data) -> Callable[[State, State, Judged], bool]:
    """A veto by held-out logs: True if the errors do not fall there as an effect lets expect.

    The error of its joint counts for what is felt on that joint alone, else those of all joints:
    where the model imitates an effect on its own joint, it shows on others. Squared errors count
    in units of each joint's residual on the training logs. The clock of a held-out log may start
    anew: for effects that depend on time it may also go on where the training logs end, whichever
    suits them better.
    """

    def veto(before: State, after: State, judged: Judged) -> bool:
        candidate = judged.candidate
        alone = judged.alone
        own = [candidate.index] if alone else list(range(before.rows.joints))
        gain = judged.gain if alone else judged.share
        timed = "t" in candidate.form.names
        later = [0.0, float(np.ptp(before.data.observation.time))] if timed else [0.0]
        size = before.base.sigma
        old = [_weighed(before, data, own, size, shift) for shift in later]
        new = [_weighed(after, data, own, size, shift) for shift in later]
        least, best = (min(found, key=_energy) for found in (old, new))
        kept = CONFIRMED if candidate.effect.timing else KEPT
        return _energy(best) > _energy(least) * (1.0 - kept * gain)

    return veto


def _energy(parts: Sequence[np.ndarray]) -> float:
    return sum(float(part @ part) for part in parts)


def _weighed(
    state: State, data: Data, own: list[int], size: np.ndarray, later: float
) -> list[np.ndarray]:
    """(rows_j,) residuals of some joints on held-out logs, in units of a size (J,)."""
    left = _held_out_residuals(state, data, later)
    return [left[j] / size[j] for j in own]
