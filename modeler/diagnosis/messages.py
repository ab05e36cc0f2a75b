"""Sentences of a diagnosis: the data, the findings, the errors."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from modeler import regression
from modeler.core.manifest import JointSpec
from modeler.core.table import format_error_pair, format_joints, format_percent
from modeler.diagnosis.candidates import StatedEffects
from modeler.diagnosis.generation import compute_burst_share
from modeler.diagnosis.plausibility import is_gain, is_torque_computed
from modeler.diagnosis.result import Diagnosis, Finding, Key, PushWindow
from modeler.diagnosis.search import Search, SearchStep
from modeler.diagnosis.state import SearchData, State, build_state, is_visible
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import Effect, EffectTarget, Requirement, find_effect
from modeler.estimation import IdentifiedModel, find_log_faults, format_spread
from modeler.regression import DataWarning, Observation, compute_chatter_ratios

if TYPE_CHECKING:
    from modeler.runtime import CompiledModel


def compute_duration(state: State) -> float:
    """Computes the s of motion in all logs."""
    observation = state.data.observation
    runs = [observation.time[observation.run == k] for k in range(len(observation.logs))]
    return sum(float(np.ptp(time)) for time in runs if time.size)


def describe_data_problems(state: State) -> tuple[str, ...]:
    """Describes what the motion of the logs shows too little of.

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
    lines += _check_inertia_torque(state, used_joints)
    return (*lines, *_check_chatter(state), *_check_computed_torque(state))


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
            "laws cannot be distinguished; move at five speeds or more"
        )
    return lines


def find_single_speed(state: State, j: int) -> float | None:
    """Returns the speed of a joint that has only one, rad/s or m/s; else None."""
    v = state.rows.filter_samples(j, [s.v[:, j] for s in state.rows.signals])
    if not v.size:
        return None
    low, high = np.quantile(np.abs(v), [0.1, 0.9])
    return float(high) if high < THRESHOLDS.max_single_speed_ratio * low else None


def _check_inertia_torque(state: State, joints: Mapping[int, JointSpec]) -> list[str]:
    """Joints whose torque shows no inertia."""
    lines = []
    for j, joint in joints.items():
        moved = [s.load[:, j] - s.static[:, j] for s in state.rows.signals]
        square = np.mean(state.rows.filter_samples(j, moved) ** 2)
        if square < THRESHOLDS.min_inertia_share**2 * np.mean(state.rows.y[j] ** 2):
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
        f"no joint rubs: friction is less than {format_percent(THRESHOLDS.min_friction_share)} of "
        "the torque, which it is on no robot with gears: these torques were computed from the "
        f"motion, and not measured; only {', '.join(effect.id for effect in catalogue)} are looked "
        "for"
    ]


def _is_model_difference(effect: Effect) -> bool:
    """True for what the model that torques were computed by may have otherwise."""
    targets = (EffectTarget.TORQUE, EffectTarget.GRAVITY, EffectTarget.LINK)
    return effect.acts in targets or effect.acts_on_whole_axis or effect.id == "offset"


def exclude_friction(data: SearchData, beta: np.ndarray) -> StatedEffects | None:
    """Excludes effects that computed torques cannot have; None where friction is measured.

    No robot with gears is without friction: a torque that is was computed from the motion by some
    model, and differs from this one by delays, offsets, a tilt, a load.
    """
    if not is_torque_computed(build_state(data, (), beta)):
        return None
    effects = tuple(filter(_is_model_difference, data.stated_effects.catalogue))
    return replace(data.stated_effects, catalogue=effects)


def _check_chatter(state: State) -> list[str]:
    """Joints whose model has high-frequency content from row to row, and whose torque does not."""
    ratios = compute_chatter_ratios(state.data.observation, state.torque)
    joint_ratios = {
        state.joint_names[j]: ratio
        for j, ratio in ratios.items()
        if ratio > regression.THRESHOLDS.max_chatter_ratio
    }
    if not joint_ratios:
        return []
    cutoff = state.data.observation.report.processing.position_cutoff
    names, most = ", ".join(joint_ratios), max(joint_ratios.values())
    return [
        f"joint{'s' * (len(joint_ratios) > 1)} {names}: the predicted torque has up to "
        f"{most:.0f} times the high-frequency content of the measured one: position noise; fit "
        f"again with a --cutoff below {cutoff:.3g} Hz"
    ]


# All that may be wrong with the logs of a diagnosis, the gravest first.


def collect_warnings(
    model: IdentifiedModel,
    search: Search,
    other: SearchData | None,
    contradictions: Sequence[DataWarning],
    window: PushWindow | None = None,
) -> tuple[str, ...]:
    """Collects the warnings about the logs.

    Args:
        model: as given.
        search: of the training logs.
        other: held-out logs.
        contradictions: channels that contradict the model.
        window: that was left out.
    """
    lines = [f.line for f in contradictions if f.is_certain or not _is_explained(search, f.joint)]
    if not any(f.is_certain or " late" in f.line for f in contradictions):
        lines += _check_position_delay(search)
    if window is not None and window.change is None:
        log = search.start.data.observation.logs[window.log]
        lines.append(
            f"{log}, {window.start:.1f} to {window.end:.1f} s: torques that come only once, "
            f"{window.ratio:.0f} times the energy of any other window, and are no steady push: a "
            "shock, or a spike of the measurement; left out of everything"
        )
    lines += _describe_delay_shift(model, search.start.data)
    lines += describe_data_problems(search.start)
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
    before, after = (np.mean(s.residual[j] ** 2) for s in (search.start, search.end))
    return bool(after < THRESHOLDS.max_explained_residual_share * before)


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
        names = {joint: {f"temperature{joint}", "temperature"} for joint in known}
        lacking = [j for j, pair in names.items() if not all(pair & x.keys() for x in extra)]
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
    logs = other.observation.report.logs
    known = [log for log in logs if any(used.has_rows_of(log) for used in model.logs)]
    return [f"held out: the model was fitted to {log.name}; {cost}" for log in known]


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
        """Computes the torque (n, J, 1) by the delay of the position of joint j."""
        signals = rows.signals[stretch]
        return signals.compute_displacement_torque(j, signals.v[:, [j]], True, window)

    every = {j: rows.filter_joints(partial(compute_delay_column, j)) for j in driven}
    columns = {j: column for j, column in every.items() if is_visible(column)}
    if not columns:
        return []
    ranking = state.rank_columns(list(columns.values()))
    drop = ranking.reductions.sum(axis=0)
    best = int(np.argmax(drop))
    rivals = [score.total_reduction for score in search.last.ranked if score.is_possible]
    step = float(np.median([s.segment.logged_step for s in rows.signals]))
    late, joint = float(ranking.value[best][0]), state.joint_names[list(columns)[best]]
    least = THRESHOLDS.min_delay_share * float(ranking.before.sum())
    least = max(least, THRESHOLDS.min_delay_lead * max(rivals, default=0.0))
    sure = ranking.t_ratios[best] >= THRESHOLDS.min_delay_t_ratio
    if drop[best] < least or not sure or abs(late) < THRESHOLDS.max_logger_delay * step:
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
    """Finds the faults of some logs, each with a prefix."""
    faults = find_log_faults(compiled, observation, model)
    return tuple(replace(fault, line=f"{which}{fault.line}") for fault in faults)


_ONLY_HERE = "of these logs' error, but that of motion left out does not fall significantly with it"
_PART = "it explains only a part of the systematic residual"

_ONLY_TIMING = (
    "of the error, but so do errors of timing: it is not seen once encoder noise is smoothed out "
    "of the motion"
)


def format_location(joint: str | None) -> str:
    """Names the joint, or the whole robot."""
    return f"joint {joint}" if joint is not None else "the whole robot"


def describe_undetectable(diagnosis: Diagnosis) -> list[tuple[str, str]]:
    """Describes what the logs cannot show, and why: (effect and joint, sentence).

    A joint of which no row can be used stands there once, for all its effects.
    """
    reasons = {}
    for name, joint in diagnosis.undetectable:
        effect = _find_effect(name, diagnosis)
        if joint is not None and joint in diagnosis.unmoved_joints:
            reasons[f"any effect of joint {joint}"] = "no row of it can be used; move it"
        else:
            reasons[f"{name}@{joint}" if joint else name] = effect.confounders
    return list(reasons.items())


def describe_evidence(step: SearchStep, before: float, after: float) -> str:
    """Describes why this effect was chosen.

    Args:
        step: that put it in.
        before: the error that is printed for it.
        after: that with it.
    """
    change = " -> ".join(format_error_pair(before, after))
    text = f"{step.candidate.effect.title}: error {change} on motion that was held out"
    rivals = [r for r in step.alternatives if r.is_possible and r.is_confirmed]
    rivals = [r for r in rivals if r.key != step.candidate.key]
    if rivals and rivals[0].total_share > 0.0 and step.score.total_share > 0.0:
        other = rivals[0]
        share = other.total_share / step.score.total_share
        name = f"{other.candidate.effect.title} ({format_location(other.candidate.joint)})"
        part = f"explains {format_percent(share)} of what it does within these logs"
        text += f". Runner-up: {name}, which {part}"
    return text


def add_sentences(diagnosis: Diagnosis) -> Diagnosis:
    """Adds the sentences to the diagnosis."""
    lines = [*_describe_machine(diagnosis), _write_headline(diagnosis)]
    lines += [_describe_effect(finding, diagnosis) for finding in diagnosis.effects]
    lines += [_describe_refinement(f, diagnosis) for f in diagnosis.refinements]
    reported_joints = {} if diagnosis.has_contradictions else diagnosis.joints
    lines += describe_rejected(diagnosis) if reported_joints else []
    for name, joint in reported_joints.items():
        if joint.is_unexplained and name not in diagnosis.unjudged_joints:
            left = joint.systematic_share + joint.noise_share
            lines.append(
                f"joint {name}: {format_percent(joint.systematic_share / left)} of the remaining "
                "error "
                "variance is systematic and not explained by the catalogue"
                f"{_describe_bursts(diagnosis, name)}"
            )
    if reported_joints and diagnosis.unjudged_joints and diagnosis.verdict != "cannot tell":
        lines.append(
            f"{format_joints(diagnosis.unjudged_joints)} left out: their held-out motion is not "
            "predicted; record the motion of `modeler excite`"
        )
    lines += [f"data: {line}" for line in diagnosis.data_warnings]
    if not diagnosis.held_out_logs and not diagnosis.unexplained_change:
        lines.append(
            "no held-out logs: errors are cross-validated within the logs, which flatters effects "
            "that depend on the path; give other motion with --holdout"
        )
    return replace(diagnosis, sentences=tuple(lines))


def _describe_machine(diagnosis: Diagnosis) -> list[str]:
    """What changed between the training and the held-out logs, and what is made of it."""
    machine = diagnosis.machine
    if machine is None or not machine.differs:
        return []
    lines = machine.describe("the training and the held-out logs")
    if machine.unexplained:
        why = "errors are cross-validated within the training logs"
        return [*lines, f"{why}: take logs of the machine in one state"]
    return [*lines, "held-out errors are those of the torques without this change"]


def describe_rejected(diagnosis: Diagnosis) -> list[str]:
    """Describes rejected effects that explain much, the best first."""
    search = diagnosis.search
    timing = [score for score in search.last.ranked if not score.is_confirmed]
    timing = [s for s in timing if Requirement.LAG not in s.candidate.effect.needs]
    timing = [s for s in timing if not s.candidate.effect.is_oscillator]  # its column is a hint
    named = {(f.effect, f.joint) for f in (*diagnosis.effects, *diagnosis.refinements)}
    dropped_scores = [step.score for step in search.steps if step.candidate.key not in named]
    lines: dict[Key, tuple[float, str]] = {}
    every = [(score, "") for score in (*search.vetoed_candidates, *dropped_scores)]
    for score, why in [*every, *((score, _ONLY_TIMING) for score in timing)]:
        reason = f"of the error, but {score.reason}" if score.reason else _ONLY_HERE
        key, gain = score.candidate.key, score.variance_reduction
        if key not in named and gain > lines.get(key, (THRESHOLDS.min_mentioned_gain, ""))[0]:
            effect = f"{score.candidate.effect.title} ({key[0]}), {format_location(key[1])}"
            explained = f"explains {format_percent(gain)} {why or reason}"
            lines[key] = gain, f"not named: {effect}, {explained}"
    ranked = sorted(lines.values(), reverse=True)
    return [line for _, line in ranked[: THRESHOLDS.max_listed_rejections]]


def _describe_bursts(diagnosis: Diagnosis, name: str) -> str:
    state = diagnosis.search.end
    names = [joint.name for joint in state.data.compiled.spec.joints]
    share = compute_burst_share(state, names.index(name))
    if share == 0.0:
        return ""
    return (
        f"; {format_percent(share)} of its energy is concentrated in short bursts: play, a loose "
        "part, or a log that begins before the motion has settled"
    )


def _write_headline(diagnosis: Diagnosis) -> str:
    first = diagnosis.effects[0] if diagnosis.effects else None
    if diagnosis.verdict == "missing" and first is not None:
        return f"missing: {_format_effect(first, diagnosis)}{describe_equivalents(first)}"
    if diagnosis.verdict == "closest description" and first is not None:
        perhaps = "possibly " if first.warning else ""
        reason = first.warning or first.caveat or _PART
        return (
            "closest description: "
            f"{perhaps}{_format_effect(first, diagnosis)}{describe_equivalents(first)}; {reason}, "
            "so the cause may be outside the catalogue"
        )
    if diagnosis.verdict == "unexplained":
        return "unexplained: the error is systematic, and nothing in the catalogue describes it"
    if diagnosis.has_contradictions:
        return "cannot tell: channels of the logs contradict the model; mend them first"
    if diagnosis.verdict == "cannot tell":
        if diagnosis.unjudged_joints:
            where = format_joints(diagnosis.unjudged_joints)
            return (
                f"cannot tell: what is fitted to the logs says nothing of the held-out motion of "
                f"{where}; record longer motions, at many speeds and poses"
            )
        return "cannot tell: too few rows; record longer motions of all joints"
    if diagnosis.refinements:
        return "nothing to add: a law that the model has can be refined"
    return "nothing to add: no effect of the catalogue lowers the held-out error significantly"


def format_equivalents(finding: Finding) -> str:
    """Formats the effects that the data do not distinguish from it; empty without any."""
    pairs = finding.equivalents
    return ", ".join(f"{effect} on {format_location(joint)}" for effect, joint in pairs)


def describe_equivalents(finding: Finding) -> str:
    """Describes these behind its name."""
    names = format_equivalents(finding)
    return f", or {names} (these data do not distinguish which)" if names else ""


def _describe_refinement(finding: Finding, diagnosis: Diagnosis) -> str:
    place, gain = format_location(finding.joint), format_percent(finding.gain)
    line = f"refinement on {place}: {finding.effect}, gain {gain}"
    effect = _find_effect(finding.effect, diagnosis)
    first = next(iter(finding.parameters.values()), 0.0)
    return f"{line}: {effect.negative_meaning}" if effect.refines_model_term(first) else line


def _format_effect(finding: Finding, diagnosis: Diagnosis) -> str:
    effect = _find_effect(finding.effect, diagnosis)
    return f"{effect.title} ({finding.effect}), {format_location(finding.joint)}"


def _find_effect(name: str, diagnosis: Diagnosis) -> Effect:
    effect = find_effect(name, diagnosis.search.catalogue)
    assert effect is not None, "it was diagnosed"
    return effect


def _describe_effect(finding: Finding, diagnosis: Diagnosis) -> str:
    if not finding.parameters:  # seen by a detector: neither value nor column
        return finding.evidence
    values = ", ".join(
        f"{name} = {value:.4g}{_format_spread(finding, name)}{format_unit(finding, name)}"
        for name, value in finding.parameters.items()
    )
    if finding.explained_fraction is None:
        return f"{format_location(finding.joint)}: {finding.effect} ({values}): {finding.evidence}"
    names = format_equivalents(finding)
    tail = f"; these data do not distinguish it from {names}" if names else ""
    for why in dict.fromkeys((finding.warning, finding.caveat)):
        tail += f"; {why}" if why else ""
    change = " -> ".join(format_error_pair(finding.error_before, finding.error_after))
    source = "held-out" if diagnosis.held_out_logs else "cross-validated"
    what = f"possibly {finding.effect}" if finding.warning else finding.effect
    return f"{format_location(finding.joint)}: {what} ({values}): {source} error {change}{tail}"


def _format_spread(finding: Finding, name: str) -> str:
    """The standard deviation or the interval behind a value, where there is one."""
    sigma, interval = finding.sigmas.get(name, 0.0), finding.intervals.get(name)
    return format_spread(finding.parameters[name], sigma, interval)


def format_unit(finding: Finding, name: str) -> str:
    """Formats the unit behind a value; empty for a plain number."""
    of = finding.units.get(name, "1")
    return f" {of}" if of != "1" else ""


# A diagnosis as text.


def format_lines(diagnosis: Diagnosis) -> list[str]:
    """Formats verdict, findings, errors of all joints, and what the logs cannot show."""
    lines = list(diagnosis.sentences)
    source = "held-out" if diagnosis.held_out_logs else "cross-validated"
    pairs = diagnosis.errors.items()
    entry = ", ".join(f"joint {name} {format_percent(error)}" for name, error in pairs)
    lines += ["", f"error of the model on these logs, up to {diagnosis.fit_band:.3g} Hz: {entry}"]
    band = f"({source} error, up to {diagnosis.band:.3g} Hz)"
    lines.append(f"{'joint':<6}{'before':>9}{'with effects':>14}  {band}")
    for name, joint in diagnosis.joints.items():
        before, after = format_error_pair(joint.error_before, joint.error_after)
        lines.append(f"{name:<6}{before:>9}{after:>14}")
    if diagnosis.discoveries is not None:
        lines += ["", "equations proposed for what has no name:"]
        lines += [line for entry in diagnosis.discoveries for line in entry.format_lines()]
    blind = [what for what, _ in describe_undetectable(diagnosis)]
    if blind:
        lines.append(f"these logs cannot show: {', '.join(blind)}")
    return lines
