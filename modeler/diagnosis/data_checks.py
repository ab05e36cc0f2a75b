"""What is wrong with the data itself, before any physics is blamed: doubts, one line each."""

import dataclasses
from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from modeler.core.manifest import JointSpec
from modeler.core.table import format_percent
from modeler.diagnosis.candidates import StatedEffects
from modeler.diagnosis.drive_gains import is_gain
from modeler.diagnosis.events import PushWindow
from modeler.diagnosis.plausible import is_torque_computed
from modeler.diagnosis.search import Search
from modeler.diagnosis.state import SearchData, State, build_state, is_visible
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import Effect, EffectTarget
from modeler.estimation import IdentifiedModel, find_log_faults
from modeler.regression import TREMBLES, DataWarning, Observation, compute_chatter_ratios

if TYPE_CHECKING:
    from modeler.runtime import CompiledModel


def compute_duration(state: State) -> float:
    """s of motion in all logs."""
    observation = state.data.observation
    runs = [observation.time[observation.run == k] for k in range(len(observation.logs))]
    return sum(float(np.ptp(time)) for time in runs if time.size)


def describe_data_problems(state: State) -> tuple[str, ...]:
    """Doubts about the motion of the logs: what it shows too little of.

    Args:
        state: the model as given.
    """
    lines, total = list[str](), compute_duration(state)
    if total < THRESHOLDS.min_duration:
        lines.append(f"{total:.1f} s of motion in all; expected 20 s or more: record longer")
    driven = {j: joint for j, joint in enumerate(state.spec.joints) if joint.actuated}
    for j, joint in driven.items():
        lines += _check_joint_motion(state, j, joint)
    used_joints = {j: joint for j, joint in driven.items() if state.rows.y[j].size}
    return (
        *lines,
        *_check_inertia_torque(state, used_joints),
        *_check_chatter(state),
        *_check_computed_torque(state),
    )


def _check_joint_motion(state: State, j: int, joint: JointSpec) -> list[str]:
    signals = state.rows.signals
    q = np.concatenate([s.q[:, j] for s in signals])
    if np.ptp(q) < THRESHOLDS.min_stroke[joint.unit]:
        return [f"joint {joint.name} never moves: nothing can be said of its effects; move it"]
    v = state.rows.filter_samples(j, [s.v[:, j] for s in signals])
    if not v.size:
        return [
            f"joint {joint.name}: no row of it can be used, so nothing can be said of its effects; "
            "move it longer, and faster than its slowest creep"
        ]
    forward = float(np.mean(v > 0.0))
    lines = []
    if max(forward, 1.0 - forward) > THRESHOLDS.max_one_way_share:
        lines.append(
            f"joint {joint.name} moves one way only: Coulomb friction and offset are one column; "
            "move it both ways"
        )
    speed = find_single_speed(state, j)
    if speed is not None:
        lines.append(
            f"joint {joint.name} moves at one speed only ({speed:.2g} {joint.unit}/s): friction "
            "laws cannot be told apart; move at five speeds or more"
        )
    return lines


def find_single_speed(state: State, j: int) -> float | None:
    """The speed of a joint that has but one between its reversals, rad/s or m/s; else None."""
    v = state.rows.filter_samples(j, [s.v[:, j] for s in state.rows.signals])
    if not v.size:
        return None
    low, high = np.quantile(np.abs(v), [0.1, 0.9])
    return float(high) if high < THRESHOLDS.max_single_speed_ratio * low else None


def _compute_rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _check_inertia_torque(state: State, joints: Mapping[int, JointSpec]) -> list[str]:
    """Joints whose torque shows no inertia."""
    lines = []
    for j, joint in joints.items():
        moved = [s.load[:, j] - s.static[:, j] for s in state.rows.signals]
        if _compute_rms(
            state.rows.filter_samples(j, moved)
        ) < THRESHOLDS.min_inertia_share * _compute_rms(state.rows.y[j]):
            v = state.rows.filter_samples(j, [s.v[:, j] for s in state.rows.signals])
            top = float(np.max(np.abs(v), initial=0.0))
            lines.append(
                f"joint {joint.name} (up to {top:.2g} {joint.unit}/s): inertia makes less than 1 % "
                "of its torque, so effects of acceleration are not identifiable; accelerate more"
            )
    return lines


def _check_computed_torque(state: State) -> list[str]:
    catalogue = state.data.stated_effects.catalogue
    if not all(map(_is_model_difference, catalogue)):
        return []
    return [
        "no joint rubs: friction is less than "
        f"{format_percent(THRESHOLDS.min_friction_share)} of the torque, which it is on no robot with gears: these "
        "torques were "
        "computed from the motion, and not measured; only "
        f"{', '.join(effect.id for effect in catalogue)} are looked for"
    ]


def _is_model_difference(effect: Effect) -> bool:
    """True for what the model that torques were computed by may have otherwise."""
    whole = (
        effect.acts in (EffectTarget.TORQUE, EffectTarget.GRAVITY, EffectTarget.LINK)
        or effect.whole_axis
    )
    return whole or effect.id == "offset"


def exclude_friction(data: SearchData, beta: np.ndarray) -> StatedEffects | None:
    """What may be missing where torques were computed, and not measured; None where they rub.

    No robot with gears is without friction: a torque that is was computed from the motion by some
    model, and differs from this one by delays, offsets, a tilt, a load.
    """
    if not is_torque_computed(build_state(data, (), beta)):
        return None
    effects = tuple(
        effect for effect in data.stated_effects.catalogue if _is_model_difference(effect)
    )
    return dataclasses.replace(data.stated_effects, catalogue=effects)


def _check_chatter(state: State) -> list[str]:
    """Joints whose model trembles from row to row, and whose torque does not."""
    ratios = compute_chatter_ratios(state.data.observation, state.torque)
    joint_ratios = {state.joint_names[j]: ratio for j, ratio in ratios.items() if ratio > TREMBLES}
    if not joint_ratios:
        return []
    cutoff = state.data.observation.report.processing.position_cutoff
    return [
        f"joint{'s' if len(joint_ratios) > 1 else ''} {', '.join(joint_ratios)}: the model's "
        "torque trembles up "
        f"to {max(joint_ratios.values()):.0f} times as much as the measured one: noise of the "
        "positions; "
        f"fit again with a --cutoff below {cutoff:.3g} Hz"
    ]


# All that may be wrong with the logs of a diagnosis, the gravest first.


def collect_warnings(
    model: IdentifiedModel,
    search: Search,
    other: SearchData | None,
    contradictions: Sequence[DataWarning],
    window: PushWindow | None = None,
) -> tuple[str, ...]:
    """Sentences on the logs.

    Args:
        model: as given.
        search: of the training logs.
        other: held-out logs.
        contradictions: channels that contradict the model.
        window: that was left out.
    """
    lines = [f.line for f in contradictions if f.is_certain or not _is_explained(search, f.joint)]
    lines += (
        []
        if any(f.is_certain or " late" in f.line for f in contradictions)
        else _check_position_delay(search)
    )
    if window is not None and window.change is None:
        log = search.start.data.observation.logs[window.log]
        lines.append(
            f"{log}, {window.start:.1f} to {window.end:.1f} s: torques that come only once, "
            f"{window.ratio:.0f} times the energy of any other window, and are no steady push: a "
            "shock, or a spike of the measurement; left out of everything"
        )
    lines += [
        *_describe_delay_shift(model, search.start.data),
        *describe_data_problems(search.start),
    ]
    lines += search.start.data.observation.report.collect_notes()
    if other is not None:
        lines += other.observation.report.collect_notes()
        lines += [*_check_temperature(search.start, other), *_check_reused_logs(model, other)]
    return tuple(lines)


def _is_explained(search: Search, j: int) -> bool:
    """True if a gain is named, or the effects explain most of what a joint's torque differs by."""
    if j < 0 or not search.start.residual[j].size:
        return False
    if any(map(is_gain, search.end.picks)):
        return True
    before, after = (float(np.mean(s.residual[j] ** 2)) for s in (search.start, search.end))
    return after < THRESHOLDS.max_explained_residual_share * before


def _describe_delay_shift(model: IdentifiedModel, data: SearchData) -> list[str]:
    """A delay that the diagnosis took out of the logs."""
    shift = data.observation.report.processing.delay - model.processing.delay
    if shift == 0.0:
        return []
    when = "before" if shift > 0.0 else "after"
    return [
        f"torques are logged {1e3 * abs(shift):.2g} ms {when} the motion that they belong to, "
        "about half a sample: a convention of the logger; the diagnosis has moved them back"
    ]


def _check_temperature(state: State, other: SearchData) -> list[str]:
    """Held-out logs without a temperature that the training logs have."""
    known = state.reference.temperature
    lines = []
    for k, log in enumerate(other.observation.logs):
        extra = [s.segment.extra for s in other.rows.signals if s.segment.run == k]
        lacking = [
            joint
            for joint in known
            if not all({f"temperature{joint}", "temperature"} & part.keys() for part in extra)
        ]
        if lacking:
            lines.append(
                f"held out: {log} has no temperature of joint {', '.join(lacking)}: taken as the "
                "mean of the training logs; log it"
            )
    return lines


def _check_reused_logs(model: IdentifiedModel, other: SearchData) -> list[str]:
    """Held-out logs that the model was fitted to."""
    cost = "its errors there are too small"
    if other.fixed_parameters is None:
        cost = "here it is fitted to the other logs only"
    return [
        f"held out: the model was fitted to {log.name}; {cost}"
        for log in other.observation.report.logs
        if any(used.has_rows_of(log) for used in model.logs)
    ]


def _check_position_delay(search: Search) -> list[str]:
    """A sentence on the joint whose position comes late, or early, beside all other channels.

    Delays of some ms show only in the band of a diagnosis. With q measured T too late, the torque
    is that of q + T qd; its derivative with respect to T is a column like any other. It is believed
    if it explains more of what the named effects leave than anything in the catalogue: nothing
    there shifts one joint in time.
    """
    state = search.end
    rows, driven = state.rows, [j for j, joint in enumerate(state.spec.joints) if joint.actuated]

    def compute_delay_column(j: int, stretch: int, window: slice) -> np.ndarray:
        """(n, J, 1) torque by the delay of the position of joint j."""
        signals = rows.signals[stretch]
        return signals.compute_displacement_torque(j, signals.v[:, [j]], True, window)

    columns = {
        j: delay_columns
        for j in driven
        if is_visible(delay_columns := rows.filter_joints(partial(compute_delay_column, j)))
    }
    if not columns:
        return []
    ranking = state.rank_columns(list(columns.values()))
    drop = ranking.block_reductions.sum(axis=0)
    best = int(np.argmax(drop))
    rivals = [
        candidate_score.total_reduction
        for candidate_score in search.last.ranked
        if candidate_score.is_possible
    ]
    step = float(np.median([s.segment.logged_step for s in rows.signals]))
    late, joint = float(ranking.value[best][0]), state.joint_names[list(columns)[best]]
    shown = drop[best] >= max(
        THRESHOLDS.min_delay_share * float(ranking.before.sum()),
        THRESHOLDS.min_delay_lead * max(rivals, default=0.0),
    )
    if (
        not shown
        or ranking.t_ratios[best] < THRESHOLDS.min_delay_t_ratio
        or abs(late) < THRESHOLDS.max_logger_delay * step
    ):
        return []
    return [
        f"joint {joint}: its position comes {1e3 * abs(late):.2g} ms too "
        f"{'late' if late > 0.0 else 'early'} beside the other channels; check the clock or the "
        "filter of that channel"
    ]


# What contradicts: what is said of these logs wherever they are read.


def find_faults(
    model: IdentifiedModel, compiled: "CompiledModel", observation: Observation, which: str = ""
) -> tuple[DataWarning, ...]:
    """Of some logs; which are said before every line, if not those that are explained."""
    faults = find_log_faults(compiled, observation, model)
    return tuple(dataclasses.replace(fault, line=f"{which}{fault.line}") for fault in faults)
