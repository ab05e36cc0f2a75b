"""What is wrong with the data itself, before any physics is blamed: doubts, one line each."""

import dataclasses
from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from modeler.core.manifest import JointSpec
from modeler.core.table import percent
from modeler.diagnosis.candidates import StatedEffects
from modeler.diagnosis.drive_gains import is_gain
from modeler.diagnosis.events import Window
from modeler.diagnosis.plausible import SMOOTH, is_computed
from modeler.diagnosis.search import Search
from modeler.diagnosis.state import SearchData, State, state_of, visible
from modeler.diagnosis.timing import CONVENTION
from modeler.effects import Acts, Effect
from modeler.estimation import IdentifiedModel, log_findings
from modeler.observation import TREMBLES, Doubt, Observation, trembling

if TYPE_CHECKING:
    from modeler.runtime import CompiledModel

SHORT = 5.0
"""s of motion in all below which nothing can be ruled out."""

_STILL = {"rad": 1e-3, "m": 1e-4}  # stroke below which a joint does not move
_ONE_WAY = 0.98  # of the moving rows
_ONE_SPEED = 1.3  # ratio of the 90 % and 10 % quantiles of the speed
_SLOW = 0.01  # of a joint's torque that inertia makes


def length(state: State) -> float:
    """s of motion in all logs."""
    observation = state.data.observation
    runs = [observation.time[observation.run == k] for k in range(len(observation.logs))]
    return sum(float(np.ptp(time)) for time in runs if time.size)


def data_lines(state: State) -> tuple[str, ...]:
    """Doubts about the motion of the logs: what it shows too little of.

    Args:
        state: the model as given.
    """
    lines, total = list[str](), length(state)
    if total < SHORT:
        lines.append(f"{total:.1f} s of motion in all; expected 20 s or more: record longer")
    driven = {j: joint for j, joint in enumerate(state.spec.joints) if joint.actuated}
    for j, joint in driven.items():
        lines += _motion(state, j, joint)
    felt = {j: joint for j, joint in driven.items() if state.rows.y[j].size}
    return (*lines, *_slow(state, felt), *_noisy(state), *_computed(state))


def _motion(state: State, j: int, joint: JointSpec) -> list[str]:
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


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _slow(state: State, joints: Mapping[int, JointSpec]) -> list[str]:
    """Joints whose torque shows no inertia."""
    found = []
    for j, joint in joints.items():
        moved = [s.load[:, j] - s.static[:, j] for s in state.rows.signals]
        if _rms(state.rows.filtered(j, moved)) < _SLOW * _rms(state.rows.y[j]):
            v = state.rows.filtered(j, [s.v[:, j] for s in state.rows.signals])
            top = float(np.max(np.abs(v), initial=0.0))
            found.append(
                f"joint {joint.name} (up to {top:.2g} {joint.unit}/s): inertia makes less than 1 % "
                "of its torque, so effects of acceleration are not identifiable; accelerate more"
            )
    return found


def _computed(state: State) -> list[str]:
    catalogue = state.data.known.catalogue
    if not all(map(_of_the_computer, catalogue)):
        return []
    return [
        "no joint rubs: friction is less than "
        f"{percent(SMOOTH)} of the torque, which it is on no robot with gears: these torques were "
        "computed from the motion, and not measured; only "
        f"{', '.join(effect.id for effect in catalogue)} are looked for"
    ]


def _of_the_computer(effect: Effect) -> bool:
    """True for what the model that torques were computed by may have otherwise."""
    whole = effect.acts in (Acts.TORQUE, Acts.GRAVITY, Acts.LINK) or effect.whole_axis
    return whole or effect.id == "offset"


def without_friction(data: SearchData, beta: np.ndarray) -> StatedEffects | None:
    """What may be missing where torques were computed, and not measured; None where they rub.

    No robot with gears is without friction: a torque that is was computed from the motion by some
    model, and differs from this one by delays, offsets, a tilt, a load.
    """
    if not is_computed(state_of(data, (), beta)):
        return None
    kept = tuple(effect for effect in data.known.catalogue if _of_the_computer(effect))
    return dataclasses.replace(data.known, catalogue=kept)


def _noisy(state: State) -> list[str]:
    """Joints whose model trembles from row to row, and whose torque does not."""
    ratios = trembling(state.data.observation, state.torque)
    found = {state.names[j]: ratio for j, ratio in ratios.items() if ratio > TREMBLES}
    if not found:
        return []
    cutoff = state.data.observation.report.processing.position_cutoff
    return [
        f"joint{'s' if len(found) > 1 else ''} {', '.join(found)}: the model's torque trembles up "
        f"to {max(found.values()):.0f} times as much as the measured one: noise of the positions; "
        f"fit again with a --cutoff below {cutoff:.3g} Hz"
    ]


# All that may be wrong with the logs of a diagnosis, the gravest first.


MENDED = 0.25
"""Share of a joint's squared residual: with less of it left, its torque has the scale it should."""


LATE_SHARE = 0.2
"""Least share of the error variance left that the shift of one position explains."""

AHEAD = 1.5
"""Least ratio of what it explains to what the best effect of the catalogue would."""

_SURE = 4.5  # falls over their standard error


def doubts(
    model: IdentifiedModel, found: Search, other: SearchData | None, contradicting: Sequence[Doubt],
    window: Window | None = None,
) -> tuple[str, ...]:  # fmt: skip
    """Sentences on the logs.

    Args:
        model: as given.
        found: of the training logs.
        other: held-out logs.
        contradicting: channels that contradict the model.
        window: that was left out.
    """
    lines = [f.line for f in contradicting if f.certain or not _explained(found, f.joint)]
    lines += [] if any(f.certain or " late" in f.line for f in contradicting) else _late(found)
    if window is not None and window.change is None:
        log = found.start.data.observation.logs[window.log]
        lines.append(
            f"{log}, {window.start:.1f} to {window.end:.1f} s: torques that come only once, "
            f"{window.ratio:.0f} times the energy of any other window, and are no steady push: a "
            "shock, or a spike of the measurement; left out of everything"
        )
    lines += [*_moved(model, found.start.data), *data_lines(found.start)]
    lines += found.start.data.observation.report.notes()
    if other is not None:
        lines += other.observation.report.notes()
        lines += [*_without_temperature(found.start, other), *_fitted_before(model, other)]
    return tuple(lines)


def _explained(found: Search, j: int) -> bool:
    """True if a gain is named, or the effects explain most of what a joint's torque differs by."""
    if j < 0 or not found.start.residual[j].size:
        return False
    if any(map(is_gain, found.end.picks)):
        return True
    before, after = (float(np.mean(s.residual[j] ** 2)) for s in (found.start, found.end))
    return after < MENDED * before


def _moved(model: IdentifiedModel, data: SearchData) -> list[str]:
    """A delay that the diagnosis took out of the logs."""
    moved = data.observation.report.processing.delay - model.processing.delay
    if moved == 0.0:
        return []
    when = "before" if moved > 0.0 else "after"
    return [
        f"torques are logged {1e3 * abs(moved):.2g} ms {when} the motion that they belong to, "
        "about half a sample: a convention of the logger; the diagnosis has moved them back"
    ]


def _without_temperature(state: State, other: SearchData) -> list[str]:
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


def _fitted_before(model: IdentifiedModel, other: SearchData) -> list[str]:
    """Held-out logs that the model was fitted to."""
    cost = "its errors there are too small"
    if other.kept is None:
        cost = "here it is fitted to the other logs only"
    return [
        f"held out: the model was fitted to {log.name}; {cost}"
        for log in other.observation.report.logs
        if any(used.shares_rows(log) for used in model.logs)
    ]


def _late(found: Search) -> list[str]:
    """A sentence on the joint whose position comes late, or early, beside all other channels.

    Delays of some ms show only in the band of a diagnosis. With q measured T too late, the torque
    is that of q + T qd; its derivative with respect to T is a column like any other. It is believed
    if it explains more of what the named effects leave than anything in the catalogue: nothing
    there shifts one joint in time.
    """
    state = found.end
    rows, driven = state.rows, [j for j, joint in enumerate(state.spec.joints) if joint.actuated]

    def later(j: int, stretch: int, window: slice) -> np.ndarray:
        """(n, J, 1) torque by the delay of the position of joint j."""
        signals = rows.signals[stretch]
        return signals.moved(j, signals.v[:, [j]], True, window)

    columns = {j: own for j in driven if visible(own := rows.spread(partial(later, j)))}
    if not columns:
        return []
    ranking = state.ranked(list(columns.values()))
    drop = ranking.drop.sum(axis=0)
    best = int(np.argmax(drop))
    rivals = [judged.fall for judged in found.last.ranked if judged.possible]
    step = float(np.median([s.segment.logged_step for s in rows.signals]))
    late, joint = float(ranking.value[best][0]), state.names[list(columns)[best]]
    shown = drop[best] >= max(
        LATE_SHARE * float(ranking.before.sum()), AHEAD * max(rivals, default=0.0)
    )
    if not shown or ranking.sure[best] < _SURE or abs(late) < CONVENTION * step:
        return []
    return [
        f"joint {joint}: its position comes {1e3 * abs(late):.2g} ms too "
        f"{'late' if late > 0.0 else 'early'} beside the other channels; check the clock or the "
        "filter of that channel"
    ]


# What contradicts: what is said of these logs wherever they are read.


def faults_of(
    model: IdentifiedModel, compiled: "CompiledModel", seen: Observation, which: str = ""
) -> tuple[Doubt, ...]:
    """Of some logs; which are said before every line, if not those that are explained."""
    found = log_findings(compiled, seen, model)
    return tuple(dataclasses.replace(fault, line=f"{which}{fault.line}") for fault in found)
