"""What is wrong with the data itself, before any physics is blamed: doubts, one line each."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from modeler.diagnosis.effect_columns import Rows
from modeler.diagnosis.events import Window
from modeler.diagnosis.plausible import has_friction, largest_friction
from modeler.diagnosis.search import Search
from modeler.diagnosis.state import Data, State
from modeler.diagnosis.timing import CONVENTION
from modeler.estimation.model_file import IdentifiedModel
from modeler.observation.channels import Fault

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


# All that may be wrong with the logs of a diagnosis, the gravest first.


MENDED = 0.25
"""Share of a joint's squared residual: with less of it left, its torque has the scale it should."""


LATE_SHARE = 0.2
"""Least share of the error variance left that the shift of one position explains."""

AHEAD = 1.5
"""Least ratio of what it explains to what the best effect of the catalogue would."""

_SURE = 4.5  # falls over their standard error


def doubts(
    model: IdentifiedModel, found: Search, other: Data | None, faults: Sequence[Fault],
    window: Window | None = None,
) -> tuple[str, ...]:  # fmt: skip
    """Sentences on the logs.

    Args:
        model: as given.
        found: of the training logs.
        other: held-out logs.
        faults: channels that contradict the model.
        window: that was left out.
    """
    lines = [fault.line for fault in faults if fault.certain or not _explained(found, fault.joint)]
    if not any(fault.certain for fault in faults):
        lines += late_lines(found)
    lines += [*_left_out(window, found.start.data), *_moved(model, found.start.data)]
    lines += data_lines(found.start)
    if other is not None:
        lines += [f"held out: {line}" for line in other.observation.report.doubts()]
        lines += [*_without_temperature(found.start, other), *_fitted_before(model, other)]
    return tuple(lines)


def _left_out(window: Window | None, data: Data) -> list[str]:
    """What comes only once and is no push."""
    if window is None or window.change is not None:
        return []
    return [
        f"{data.observation.logs[window.log]}, {window.start:.1f} to {window.end:.1f} s: torques "
        f"that come only once, {window.ratio:.0f} times the energy of any other window, and are "
        "no steady push: a shock, or a spike of the measurement; left out of everything"
    ]


def _explained(found: Search, j: int) -> bool:
    """True if the effects named explain most of what a joint's torque differs by."""
    if j < 0 or not found.start.residual[j].size:
        return False
    before, after = (float(np.mean(s.residual[j] ** 2)) for s in (found.start, found.end))
    return after < MENDED * before


def _moved(model: IdentifiedModel, data: Data) -> list[str]:
    """A delay that the diagnosis took out of the logs."""
    moved = data.observation.report.processing.delay - model.processing.delay
    if moved == 0.0:
        return []
    when = "before" if moved > 0.0 else "after"
    return [
        f"torques are logged {1e3 * abs(moved):.2g} ms {when} the motion that they belong to, "
        "about half a sample: a convention of the logger; the diagnosis has moved them back"
    ]


def _without_temperature(state: State, other: Data) -> list[str]:
    """Held-out logs without a temperature that the training logs have."""
    known = state.reference.temperature
    found = []
    for k, log in enumerate(other.observation.logs):
        extra = [s.segment.extra for s in other.rows.signals if s.segment.run == k]
        lacking = [
            joint for joint in known
            if not all({f"temperature{joint}", "temperature"} & part.keys() for part in extra)
        ]  # fmt: skip
        if lacking:
            found.append(
                f"held out: {log} has no temperature of joint {', '.join(lacking)}: taken as the "
                "mean of the training logs; log it"
            )
    return found


def _fitted_before(model: IdentifiedModel, other: Data) -> list[str]:
    """Held-out logs that the model was fitted to."""
    cost = "its errors there are too small"
    if other.kept is None:
        cost = "here it is fitted to the other logs only"
    return [
        f"held out: the model was fitted to {log.name}; {cost}"
        for log in other.observation.report.logs
        if any(
            log.content != "" and used.content == log.content
            and used.start <= log.span[1] and log.span[0] <= used.end
            for used in model.logs
        )
    ]  # fmt: skip


def late_lines(found: Search) -> list[str]:
    """A sentence on the joint whose position comes late, or early, beside all other channels.

    Nothing in the catalogue shifts one joint in time.

    With q measured T too late, the torque is that of q + T qd; its derivative with respect to T is
    a column like any other. It is believed if it explains more of what the named effects leave
    than anything in the catalogue.
    """
    state = found.end
    joints = state.spec.joints
    driven = [j for j, joint in enumerate(joints) if joint.actuated]
    columns = []
    for j in driven:
        columns.append(state.rows.spread(partial(_later, state.rows, j)))
    shown = [i for i, own in enumerate(columns) if any(c is not None for c in own)]
    if not shown:
        return []
    ranking = state.ranked([columns[i] for i in shown])
    drop = ranking.drop.sum(axis=0)
    best = int(np.argmax(drop))
    rivals = [judged.fall for judged in found.last.ranked if judged.possible]
    step = float(np.median([signals.segment.step for signals in state.rows.signals]))
    late = float(ranking.value[best][0])
    if (
        drop[best] < LATE_SHARE * float(ranking.before.sum())
        or drop[best] < AHEAD * max(rivals, default=0.0)
        or ranking.sure[best] < _SURE
        or abs(late) < CONVENTION * step
    ):
        return []
    name = joints[driven[shown[best]]].name
    return [
        f"joint {name}: its position comes {1e3 * abs(late):.2g} ms too "
        f"{'late' if late > 0.0 else 'early'} beside the other channels; check the clock or the "
        "filter of that channel"
    ]


def _later(rows: Rows, j: int, stretch: int, window: slice) -> np.ndarray:
    """(n, J, 1) torque by the delay of the position of joint j."""
    signals = rows.signals[stretch]
    return signals.moved(j, signals.v[:, [j]], True, window)
