"""Channels that contradict the model: signs, units, exchanges, before any physics is blamed."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from modeler.observation.observation import Observation, model_torque
from modeler.runtime import CompiledModel

WRONG = 0.5
"""Relative error of a joint from which on its channels are suspected."""

ALIKE = 0.9
"""Correlation with the prediction of another joint from which on two channels look exchanged."""

SCALE = 5.0
"""A torque that is off by this factor is a matter of units, not of a drive gain or a load."""

_ROWS = 20  # least


@dataclass(frozen=True)
class Fault:
    """A doubt about a channel.

    Attributes:
        line: where, what, and what to do.
        certain: True if no physics can look like it: then nothing can be said of physics.
        joint: index of the joint whose torque has another scale; -1 for other doubts.
    """

    line: str
    certain: bool
    joint: int = -1


def faults(
    compiled: CompiledModel,
    observation: Observation,
    beta: np.ndarray,
    gains: np.ndarray | None = None,
) -> tuple[Fault, ...]:
    """Channels with a wrong sign or unit, or in the place of another, by the model's prediction.

    Only joints whose torque the model misses by more than half are suspected. A torque is tried
    with another scale, and as that of another joint; then positions are tried in other units,
    reversed and exchanged, and believed if that alone halves the error of the robot.

    Args:
        compiled: the robot.
        observation: of the logs.
        beta: (c,) base parameters of the model as it was fitted.
        gains: (J,) what the torques of the model are multiplied by, if drive gains are wrong.
    """
    predicted = model_torque(observation, compiled, beta)
    if gains is not None:
        predicted = predicted * gains
    errors = _errors(observation, predicted)
    wrong = [j for j, error in enumerate(errors) if error > WRONG]
    if not wrong:
        return ()
    found = {j: _torque(observation, predicted, j) for j in wrong}
    if any(fault is None for fault in found.values()):
        motion = _motion(compiled, observation, beta, errors)
        if motion is not None:
            return (motion,)
    return tuple(fault for fault in found.values() if fault is not None)


def suspects(compiled: CompiledModel, observation: Observation, beta: np.ndarray) -> list[int]:
    """Indices of the joints whose torque the model misses by more than half."""
    errors = _errors(observation, model_torque(observation, compiled, beta))
    return [j for j, error in enumerate(errors) if error > WRONG]


def _errors(
    observation: Observation, predicted: np.ndarray, order: np.ndarray | None = None
) -> np.ndarray:
    """(J,) relative error of every joint; 0 where there is nothing to compare.

    Args:
        observation: of the logs.
        predicted: (s, J).
        order: (J,) column in which the torque of each joint is; each in its own if not given.
    """
    errors = np.zeros(len(observation.joints))
    for j, measured in enumerate(range(len(errors)) if order is None else order):
        used = observation.used[:, measured]
        y = observation.torque[used, measured]
        size = float(np.linalg.norm(y))
        if y.size >= _ROWS and size > 0.0:
            errors[j] = float(np.linalg.norm(y - predicted[used, j])) / size
    return errors


def _torque(observation: Observation, predicted: np.ndarray, j: int) -> Fault | None:
    """What another scale, or the prediction of another joint, explains."""
    names = [joint.name for joint in observation.joints]
    used = observation.used[:, j]
    y, p = observation.torque[used, j], predicted[used, j]
    gain = float(p @ y) / max(float(p @ p), 1e-300)
    if np.linalg.norm(y - gain * p) < WRONG * np.linalg.norm(y):
        sign = "has the other sign of" if gain < 0.0 else f"is {gain:.3g} times"
        return Fault(
            f"joint {names[j]}: the measured torque {sign} the predicted one; check sign, unit "
            "and drive gain of that channel",
            not 1.0 / SCALE < gain < SCALE,
            j,
        )
    for k in range(len(names)):
        other = predicted[used, k]
        if k == j or other.std() == 0.0 or y.std() == 0.0:
            continue
        if abs(float(np.corrcoef(y, other)[0, 1])) > ALIKE:
            return Fault(
                f"joint {names[j]}: its measured torque looks like that of joint {names[k]}; are "
                "the channels exchanged?",
                True,
            )
    return None


def _motion(
    compiled: CompiledModel, observation: Observation, beta: np.ndarray, errors: np.ndarray
) -> Fault | None:
    """What positions in other units, reversed or exchanged explain."""
    if compiled.spec.closure is not None:
        return None  # positions that do not close the loops have no torque
    best, size = None, 0.5 * float(np.linalg.norm(errors))
    for turn in turns(observation):
        predicted = model_torque(observation, compiled, beta, turn.motion)
        left = _errors(observation, predicted, turn.torque)
        if float(np.linalg.norm(left)) < size and left.max() < WRONG:
            best, size = Fault(turn.line, True), float(np.linalg.norm(left))
    return best


@dataclass(frozen=True)
class Turn:
    """What may be wrong with channels, and what mends it.

    Attributes:
        line: what, and what to do.
        motion: (J, J) q = measured motion.
        torque: (J,) tau_j = measured tau[torque[j]].
    """

    line: str
    motion: np.ndarray
    torque: np.ndarray


def turns(observation: Observation) -> Iterator[Turn]:
    """Positions in other units, reversed, exchanged, and exchanged together with the torques."""
    joints = observation.joints
    names = [joint.name for joint in joints]
    small = np.array([np.pi / 180.0 if joint.unit == "rad" else 1e-3 for joint in joints])
    units = ["degrees" if joint.unit == "rad" else "mm" for joint in joints]
    expected = "expected rad and m; convert the position, and the speeds if they are logged"
    same = np.arange(len(joints))
    line = f"the positions look like {' or '.join(dict.fromkeys(units))}; {expected}"
    yield Turn(line, np.diag(small), same)
    for j in range(len(joints)):
        one = np.ones(len(joints))
        one[j] = small[j]
        line = f"joint {names[j]}: its position looks like {units[j]}; {expected}"
        yield Turn(line, np.diag(one), same)
        one = one.copy()
        one[j] = -1.0
        line = f"joint {names[j]}: its position seems to be counted the other way; check its sign"
        yield Turn(line, np.diag(one), same)
        for k in range(j):
            order = same.copy()
            order[[j, k]] = order[[k, j]]
            swap = np.eye(len(joints))[order]
            for what, torque in (("positions", same), ("columns, torques too,", order)):
                line = (
                    f"joints {names[k]} and {names[j]}: their {what} look exchanged; check the "
                    "order of the columns"
                )
                yield Turn(line, swap, torque)
