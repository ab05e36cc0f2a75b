"""What is wrong with the data itself, before any physics is blamed; one line each."""

import numpy as np

from modeler.diagnose.braking import has_friction, largest_friction
from modeler.scoring.state import State

SHORT = 5.0
"""s of motion in all below which nothing can be ruled out."""

_STILL = {"rad": 1e-3, "m": 1e-4}  # stroke below which a joint does not move
_ONE_WAY = 0.98  # of the moving rows
_ONE_SPEED = 1.3  # ratio of the 90 % and 10 % quantiles of the speed
_SLOW = 0.01  # of a joint's torque that inertia makes
_SMOOTH = 0.01  # of a joint's torque that friction makes
_TREMBLES = 4.0  # times the measured torque: no torque that was measured, but noise of the motion


def length(state: State) -> float:
    """s of motion in all logs."""
    observation = state.data.observation
    runs = [observation.time[observation.run == k] for k in range(len(observation.logs))]
    return sum(float(np.ptp(time)) for time in runs if time.size)


def data_lines(state: State) -> tuple[str, ...]:
    """Doubts about the logs: values that are missing, motion that shows too little.

    Args:
        state: the model as given.
    """
    observation = state.data.observation
    lines = observation.report.doubts()
    total = length(state)
    if total < SHORT:
        lines.append(f"{total:.1f} s of motion in all; expected 20 s or more: record longer")
    for j in range(len(observation.joints)):
        lines += _motion(state, j)
    return (*lines, *_slow(state), *_noisy(state), *_smooth(state))


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
        return [
            f"joint {joint.name}: no row of it can be used, so nothing can be said of its effects; "
            "move it longer, and faster than its slowest creep"
        ]
    forward = float(np.mean(v > 0.0))
    found = []
    if max(forward, 1.0 - forward) > _ONE_WAY:
        found.append(
            f"joint {joint.name} moves one way only: Coulomb friction and offset are one column; "
            "move it both ways"
        )
    speed = one_speed(state, j)
    if speed is not None:
        found.append(
            f"joint {joint.name} moves at one speed only ({speed:.2g} {joint.unit}/s): friction "
            "laws cannot be told apart; move at five speeds or more"
        )
    return found


def one_speed(state: State, j: int) -> float | None:
    """The speed of a joint that has but one between its reversals, rad/s or m/s; else None."""
    v = state.rows.filtered(j, [s.v[:, j] for s in state.rows.signals])
    if not v.size:
        return None
    low, high = np.quantile(np.abs(v), [0.1, 0.9])
    return float(high) if high < _ONE_SPEED * low else None


def _slow(state: State) -> list[str]:
    """Joints that move, but so slowly that no inertia is felt."""
    names = []
    for j, joint in enumerate(state.data.observation.joints):
        if not joint.actuated or not state.rows.y[j].size:
            continue
        moved = [s.load[:, j] - s.static[:, j] for s in state.rows.signals]
        dynamic = float(np.sqrt(np.mean(state.rows.filtered(j, moved) ** 2)))
        if dynamic < _SLOW * float(np.sqrt(np.mean(state.rows.y[j] ** 2))):
            names.append(joint.name)
    if not names:
        return []
    return [
        f"joint{'s' if len(names) > 1 else ''} {', '.join(names)}: slow motion only, inertia makes "
        "less than 1 % of the torque: effects of speed and acceleration cannot be told; move faster"
    ]


def _smooth(state: State) -> list[str]:
    """Torques of a robot none of whose joints rubs."""
    shares = []
    for j, joint in enumerate(state.data.observation.joints):
        y = state.rows.y[j]
        if joint.actuated and y.size and has_friction(state, j):
            size = float(np.sqrt(np.mean(y**2)))
            shares.append(largest_friction(state, j) / max(size, 1e-300))
    if not shares or max(shares) > _SMOOTH:
        return []
    return [
        f"no joint rubs: friction is at most {100.0 * max(shares):.2g} % of the torque; a robot "
        "with gears does: were these torques computed from the motion, and not measured?"
    ]


def _noisy(state: State) -> list[str]:
    """Joints whose model trembles from row to row, and whose torque does not."""
    found = {}
    for j, joint in enumerate(state.data.observation.joints):
        y = state.rows.y[j]
        measured, model = (_trembling(state, j, x) for x in (y, y - state.residual[j]))
        if model > _TREMBLES * measured > 0.0:
            found[joint.name] = model / measured
    if not found:
        return []
    cutoff = state.data.observation.report.processing.position_cutoff or 0.0
    return [
        f"joint{'s' if len(found) > 1 else ''} {', '.join(found)}: the model's torque trembles up "
        f"to {max(found.values()):.0f} times as much as the measured one: noise of the positions; "
        f"fit again with a --cutoff below {cutoff:g} Hz"
    ]


def _trembling(state: State, j: int, values: np.ndarray) -> float:
    """Rms of the second differences of values (rows_j,) between neighbouring rows."""
    time, segment = state.rows.time[j], state.rows.segment[j]
    if len(time) < 3:
        return 0.0
    step = np.diff(time)
    near = (step < 1.5 * np.median(step)) & (np.diff(segment) == 0)
    bends = np.diff(values, 2)[near[1:] & near[:-1]]
    return float(np.sqrt(np.mean(bends**2))) if bends.size else 0.0
