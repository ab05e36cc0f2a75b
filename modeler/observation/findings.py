"""All that contradicts in the data of a fit or of a prediction, the gravest first."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

import numpy as np

from modeler.numerics.least_squares import scaled_least_squares
from modeler.observation.channel_shift import faults_of_fit
from modeler.observation.channels import Fault, faults
from modeler.observation.observation import Observation
from modeler.observation.thinned import ThinnedRows, thinned

if TYPE_CHECKING:
    from modeler.runtime.model import CompiledModel

LONGEST = 0.15
"""s, the largest delay that is looked for: beyond it, channels do not look late but wrong."""

HALF = 0.5
"""Share of the error of the robot that a shift leaves, to be believed: physics that a model lacks
(elasticity, friction that lags) looks like a shift of a part of the torque only."""

_STARTS = (-0.1, -0.05, 0.05, 0.1)  # s; a step along the slope goes astray from farther away
_LEAST = 0.02  # relative error of the robot below which nothing is looked for
_FOR_EACH = 3  # rows for every parameter, at least
_STEPS = 4  # of Gauss and Newton
Columns = Callable[[float], np.ndarray]
"""(m, n, c) columns with a channel taken some seconds later."""


def findings_of_fit(
    compiled: "CompiledModel", observation: Observation, beta: np.ndarray
) -> tuple[Fault, ...]:
    """Doubts about the channels and the samples of logs that a model was fitted to.

    Args:
        compiled: the robot.
        observation: that was fitted.
        beta: (c,) base parameters of the fit.
    """
    found = faults_of_fit(compiled, observation, beta)
    if not found:
        found = tuple(Fault(line, False) for line in late_channels(compiled, observation))
    return (*found, *_of_logs(observation))


def findings_of_prediction(
    compiled: "CompiledModel", observation: Observation, beta: np.ndarray
) -> tuple[Fault, ...]:
    """Doubts about the channels and the samples of logs whose torque a model predicts.

    Args:
        compiled: the robot.
        observation: of the logs.
        beta: (c,) base parameters of the model.
    """
    return (*faults(compiled, observation, beta), *_of_logs(observation))


def _of_logs(observation: Observation) -> tuple[Fault, ...]:
    return tuple(Fault(line, False) for line in observation.report.doubts())


@dataclass(frozen=True)
class _Shift:
    what: str
    other: str
    late: float  # s by which the channel `what` comes late
    error: float


def late_channels(compiled: "CompiledModel", observation: Observation) -> tuple[str, ...]:
    """A sentence on the channel that fits far better at another time; none where none does.

    W(t + d) beta = tau(t) is fitted for a shift d of the motion of all joints, for the rows of
    each joint alone (its torque is late), and of the motion of each joint alone (its position is
    late), by Gauss and Newton; what halves the error of the robot, the root of the sum of
    e_j**2 with e_j = ||tau_j - W_j beta|| / ||tau_j||, is told.

    Args:
        compiled: the robot.
        observation: that was fitted.
    """
    rows = thinned(compiled, observation)
    joints = [j for j, joint in enumerate(observation.joints) if joint.actuated]
    joints = [j for j in joints if rows.tau[rows.used[:, j], j].any()]
    if not joints or rows.used[:, joints].sum() < _FOR_EACH * rows.W.shape[2]:
        return ()
    fit = _Fit(rows, joints, observation)
    before, _ = fit.left(rows.W)
    if before < _LEAST:
        return ()
    found = [
        fit.best(what, other, sign, columns, before)
        for what, other, sign, columns in _channels(compiled, observation, rows, joints)
    ]
    best = min(found, key=lambda shift: shift.error)
    if best.error > HALF * before:
        return ()
    way, back = ("late", "early") if best.late > 0.0 else ("early", "late")
    return (
        f"{best.what} {1e3 * abs(best.late):.0f} ms {way}, by a fit at other times (or "
        f"{best.other} {back}); check the clocks of the channels, and shift the column",
    )


def _channels(
    compiled: "CompiledModel", observation: Observation, rows: ThinnedRows, joints: Sequence[int]
) -> list[tuple[str, str, float, Columns]]:
    """What may be late, what would then be early, the sign of its lateness, and its columns."""
    n = rows.tau.shape[1]
    names = [joint.name for joint in observation.joints]

    @cache
    def all_later(shift: float) -> np.ndarray:
        return rows.shifted(compiled, np.full(n, shift))

    def torque_earlier(j: int) -> Columns:
        def columns(shift: float) -> np.ndarray:
            W = rows.W.copy()
            W[:, j] = all_later(shift)[:, j]
            return W

        return columns

    def one_later(j: int) -> Columns:
        return lambda shift: rows.shifted(compiled, shift * np.eye(n)[j])

    found: list[tuple[str, str, float, Columns]] = [
        ("all torques come", "the positions", -1.0, all_later)
    ]
    if compiled.spec.closure is not None or len(joints) == 1:
        return found  # positions that are not of one time do not close the loops
    for j in joints:
        name = f"joint {names[j]}:"
        found.append((f"{name} its torque comes", "all the others", -1.0, torque_earlier(j)))
        found.append((f"{name} its position comes", "all the others", 1.0, one_later(j)))
    return found


class _Fit:
    """Fits in which every joint weighs the same."""

    def __init__(self, rows: ThinnedRows, joints: Sequence[int], observation: Observation) -> None:
        self._rows, self._joints = rows, joints
        self._sizes = {
            j: max(float(np.linalg.norm(rows.tau[rows.used[:, j], j])), 1e-300) for j in joints
        }
        self._step = float(np.median([part.segment.step for part in observation.stretches]))

    def _stacked(self, values: np.ndarray) -> np.ndarray:
        used = self._rows.used
        return np.concatenate([values[used[:, j], j] / self._sizes[j] for j in self._joints])

    def left(self, W: np.ndarray) -> tuple[float, np.ndarray]:
        """The error that a fit leaves, and its solution."""
        X, y = self._stacked(W), self._stacked(self._rows.tau)
        beta = scaled_least_squares(X, y, 1e-6)
        return float(np.linalg.norm(y - X @ beta)), beta

    def best(self, what: str, other: str, sign: float, columns: Columns, before: float) -> _Shift:
        """The shift of a channel that leaves least."""
        tried = [(before, 0.0, self._rows.W)]
        for start in _STARTS:
            W = columns(start)
            tried.append((self.left(W)[0], start, W))
        error, shift, W = min(tried, key=lambda one: one[0])
        for _ in range(_STEPS):
            _, beta = self.left(W)
            slope = (columns(shift + self._step) - W) @ beta / self._step
            _, found = self.left(np.concatenate([W, slope[..., None]], axis=2))
            further = float(np.clip(shift + found[-1], -LONGEST, LONGEST))
            closer = columns(further)
            reached, _ = self.left(closer)
            if reached >= error:
                break
            shift, W, error = further, closer, reached
        return _Shift(what, other, sign * shift, error)
