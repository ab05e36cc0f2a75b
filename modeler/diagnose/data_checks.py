"""What is wrong with the data itself, before any physics is blamed; one line each."""

import numpy as np

from modeler.diagnose.state import State

_STILL = {"rad": 1e-3, "m": 1e-4}  # stroke below which a joint does not move
_ONE_WAY = 0.98  # of the moving rows
_ONE_SPEED = 1.3  # ratio of the 90 % and 10 % quantiles of the speed
_SHORT = 5.0  # s
_WRONG = 0.5  # relative error from which channels are suspected
_ALIKE = 0.9  # correlation with another channel


def data_lines(state: State, beta: np.ndarray) -> tuple[str, ...]:
    """Doubts about the logs.

    Args:
        state: the model as given.
        beta: (c,) its parameters, as they were fitted.
    """
    observation = state.data.observation
    lines = []
    length = sum(
        float(np.ptp(observation.time[observation.run == k])) for k in range(len(observation.logs))
    )
    if length < _SHORT:
        lines.append(f"{length:.1f} s of motion in all; expected 20 s or more: record longer")
    for j in range(len(observation.joints)):
        lines += _motion(state, j)
    return (*lines, *_channels(state, beta))


def _motion(state: State, j: int) -> list[str]:
    joint = state.data.observation.joints[j]
    if not joint.actuated:
        return []
    signals = state.rows.signals
    q = np.concatenate([s.q[:, j] for s in signals])
    if np.ptp(q) < _STILL[joint.unit]:
        return [f"joint {joint.name} never moves: nothing can be said of its effects; move it"]
    v = state.rows.filtered(j, [s.v[:, j] for s in signals])
    if not v.size:
        return []
    forward = float(np.mean(v > 0.0))
    found = []
    if max(forward, 1.0 - forward) > _ONE_WAY:
        found.append(
            f"joint {joint.name} moves one way only: Coulomb friction and offset are one column; "
            "move it both ways"
        )
    low, high = np.quantile(np.abs(v), [0.1, 0.9])
    if high < _ONE_SPEED * low:
        found.append(
            f"joint {joint.name} moves at one speed only ({high:.2g} {joint.unit}/s): friction "
            "laws cannot be told apart; move at five speeds or more"
        )
    return found


def _channels(state: State, beta: np.ndarray) -> list[str]:
    """Signs, scales and exchanged channels: measured torques against those of the model."""
    observation = state.data.observation
    predicted = observation.predicted(beta)
    used = observation.used
    lines = []
    for j, joint in enumerate(observation.joints):
        y, p = observation.torque[used[:, j], j], predicted[used[:, j], j]
        size = float(np.linalg.norm(y))
        if y.size < 20 or size == 0.0 or np.linalg.norm(y - p) < _WRONG * size:
            continue
        gain = float(p @ y) / max(float(p @ p), 1e-300)
        if np.linalg.norm(y - gain * p) < _WRONG * size:
            sign = "has the other sign of" if gain < 0.0 else f"is {gain:.3g} times"
            lines.append(
                f"joint {joint.name}: the measured torque {sign} the predicted one; check sign, "
                "unit and drive gain of that channel"
            )
            continue
        lines += _exchanged(state, predicted, j)
    return lines


def _exchanged(state: State, predicted: np.ndarray, j: int) -> list[str]:
    observation = state.data.observation
    names = [joint.name for joint in observation.joints]
    rows = observation.used[:, j]
    y = observation.torque[rows, j]
    for k in range(len(names)):
        p = predicted[rows, k]
        if k == j or p.std() == 0.0 or y.std() == 0.0:
            continue
        if abs(float(np.corrcoef(y, p)[0, 1])) > _ALIKE:
            return [
                f"joint {names[j]}: its measured torque looks like that of joint {names[k]}; are "
                "the channels exchanged?"
            ]
    return []
