"""A diagnosis in plain words."""

import dataclasses

from modeler.core.table import format_error_pair, format_percent
from modeler.diagnosis.cross_checks import Key
from modeler.diagnosis.orders import compute_burst_share
from modeler.diagnosis.result import Diagnosis, Finding
from modeler.diagnosis.search import SearchStep
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import Effect, Requirement, find_effect
from modeler.estimation import format_spread

NOT_JUDGED = "the machine differs between the training and the held-out logs"
"""Why no effect is judged where parameters have changed."""


_ONLY_HERE = "of these logs' error, but that of motion left out does not surely fall with it"
_PART = "it explains only part of what is systematic"

_ONLY_TIMING = (
    "of the error, but so do errors of timing: it is not seen once encoder noise is smoothed out "
    "of the motion"
)


def format_location(joint: str | None) -> str:
    """The joint, or the whole robot."""
    return f"joint {joint}" if joint is not None else "the whole robot"


def describe_undetectable(diagnosis: Diagnosis) -> list[tuple[str, str]]:
    """What the logs cannot show, and why: (effect and joint, sentence).

    A joint of which no row can be used stands there once, for all its effects.
    """
    reasons = {}
    for name, joint in diagnosis.blind_spots:
        effect = _find_effect(name, diagnosis)
        if joint is not None and joint in diagnosis.unmoved:
            reasons[f"any effect of joint {joint}"] = "no row of it can be used; move it"
        else:
            reasons[f"{name}@{joint}" if joint else name] = effect.look_alikes
    return list(reasons.items())


def describe_evidence(step: SearchStep, before: float, after: float) -> str:
    """Why this effect, in one or two sentences.

    Args:
        step: that put it in.
        before: the error that is printed for it.
        after: that with it.
    """
    candidate_score = step.score
    text = (
        f"{candidate_score.candidate.effect.title}: error "
        f"{' -> '.join(format_error_pair(before, after))} on motion "
        "that was held out"
    )
    rivals = [
        r
        for r in step.alternatives
        if r.is_possible and r.is_confirmed and r.candidate.key != candidate_score.candidate.key
    ]
    if (
        rivals
        and rivals[0].total_variance_reduction > 0.0
        and candidate_score.total_variance_reduction > 0.0
    ):
        other = rivals[0]
        share = other.total_variance_reduction / candidate_score.total_variance_reduction
        text += (
            f". Runner-up: {other.candidate.effect.title} "
            f"({format_location(other.candidate.joint)}), which "
            f"explains {format_percent(share)} of what it does within these logs"
        )
    return text


def add_sentences(diagnosis: Diagnosis) -> Diagnosis:
    """The diagnosis with its sentences."""
    lines = [
        _write_headline(diagnosis),
        *(_describe_effect(f, diagnosis) for f in diagnosis.effects),
    ]
    lines += [_describe_refinement(f, diagnosis) for f in diagnosis.refinements]
    reported_joints = (
        {} if diagnosis.contradicted or diagnosis.machine_changed else diagnosis.joints
    )
    lines += describe_rejected(diagnosis) if reported_joints else []
    for name, joint in reported_joints.items():
        if joint.is_unexplained:
            left = joint.systematic + joint.noise
            lines.append(
                f"joint {name}: {format_percent(joint.systematic / left)} of the remaining error "
                "variance is systematic and not explained by the catalogue"
                f"{_describe_bursts(diagnosis, name)}"
            )
    lines += _list_changes(diagnosis) + [f"data: {line}" for line in diagnosis.data]
    if not diagnosis.held_out:
        lines.append(
            "no held-out logs: errors are cross-validated within the logs, which flatters effects "
            "that depend on the path; give other motion with --holdout"
        )
    return dataclasses.replace(diagnosis, sentences=tuple(lines))


def _list_changes(diagnosis: Diagnosis) -> list[str]:
    """The parameters in which the machine of the held-out logs differs."""
    lines = [
        f"{p.name}: {p.before:.4g} +- {p.sigma_before:.2g} -> {p.after:.4g} +- "
        f"{p.sigma_after:.2g} {p.unit} (fitted to the held-out logs alone)"
        for p in diagnosis.machine_changed[: THRESHOLDS.max_listed_changes]
    ]
    more = len(diagnosis.machine_changed) - len(lines)
    return lines + [f"{more} other parameters differ too"] * (more > 0)


def describe_rejected(diagnosis: Diagnosis) -> list[str]:
    """What explains much of these logs and is not named all the same, the best first."""
    search = diagnosis.search
    timing = [
        candidate_score
        for candidate_score in search.last.ranked
        if not candidate_score.is_confirmed
        and Requirement.LAG not in candidate_score.candidate.effect.needs
    ]
    named = {(f.effect, f.joint) for f in (*diagnosis.effects, *diagnosis.refinements)}
    dropped_scores = [step.score for step in search.steps if step.candidate.key not in named]
    lines: dict[Key, tuple[float, str]] = {}
    for refused, why in (
        ((*search.vetoed_candidates, *dropped_scores), ""),
        (timing, _ONLY_TIMING),
    ):
        for candidate_score in refused:
            because = why or (
                f"of the error, but {candidate_score.reason}"
                if candidate_score.reason
                else _ONLY_HERE
            )
            key = candidate_score.candidate.key
            if (
                key not in named
                and candidate_score.variance_reduction
                > lines.get(key, (THRESHOLDS.min_mentioned_gain, ""))[0]
            ):
                text = (
                    f"not named: {candidate_score.candidate.effect.title} ({key[0]}), "
                    f"{format_location(key[1])}, "
                )
                lines[key] = (
                    candidate_score.variance_reduction,
                    f"{text}explains {format_percent(candidate_score.variance_reduction)} "
                    f"{because}",
                )
    return [
        line for _, line in sorted(lines.values(), reverse=True)[: THRESHOLDS.max_listed_rejections]
    ]


def _describe_bursts(diagnosis: Diagnosis, name: str) -> str:
    state = diagnosis.search.end
    names = [joint.name for joint in state.data.compiled.spec.joints]
    share = compute_burst_share(state, names.index(name))
    if share == 0.0:
        return ""
    return (
        f"; {format_percent(share)} of its energy comes in brief outbursts: play, a loose part, or "
        "a log "
        "that begins before the motion has settled"
    )


def _write_headline(diagnosis: Diagnosis) -> str:
    first = diagnosis.effects[0] if diagnosis.effects else None
    if diagnosis.machine_changed:
        return (
            f"cannot tell: {NOT_JUDGED}, so the diagnosis is not judged; take logs of the machine "
            "in one state"
        )
    if diagnosis.verdict == "missing" and first is not None:
        return f"missing: {_format_effect(first, diagnosis)}{describe_equivalents(first)}"
    if diagnosis.verdict == "closest description" and first is not None:
        perhaps = "perhaps " if first.doubt else ""
        reason = first.doubt or first.objection or _PART
        return (
            "closest description: "
            f"{perhaps}{_format_effect(first, diagnosis)}"
            f"{describe_equivalents(first)}; {reason}, so "
            "the cause may be outside the catalogue"
        )
    if diagnosis.verdict == "unexplained":
        return "unexplained: the error is systematic, and nothing in the catalogue describes it"
    if diagnosis.contradicted:
        return "cannot tell: channels of the logs contradict the model; mend them first"
    if diagnosis.verdict == "cannot tell":
        unpredicted_joints = [
            name for name, joint in diagnosis.joints.items() if joint.error_after > 1.0
        ]
        if unpredicted_joints:
            return (
                f"cannot tell: what is fitted to the logs says nothing of the held-out motion of "
                f"joint {', '.join(unpredicted_joints)}; record longer motions, at many speeds and "
                "poses"
            )
        return "cannot tell: too few rows; record longer motions of all joints"
    if diagnosis.refinements:
        return "nothing to add: a law that the model has can be refined"
    return "nothing to add: no effect of the catalogue surely lowers the error by more than 3 %"


def format_equivalents(finding: Finding) -> str:
    """What the data do not tell from it; empty without any."""
    return ", ".join(
        f"{effect} on {format_location(joint)}" for effect, joint in finding.equivalents
    )


def describe_equivalents(finding: Finding) -> str:
    """Behind its name: what it may be as well."""
    return (
        f", or {format_equivalents(finding)} (these data do not tell which)"
        if finding.equivalents
        else ""
    )


def _describe_refinement(finding: Finding, diagnosis: Diagnosis) -> str:
    line = (
        f"refinement on {format_location(finding.joint)}: {finding.effect}, gain "
        f"{format_percent(finding.gain)}"
    )
    effect = _find_effect(finding.effect, diagnosis)
    first = next(iter(finding.parameters.values()), 0.0)
    return f"{line}: {effect.negative}" if effect.refines_model_term(first) else line


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
    if finding.closure is None:
        return f"{format_location(finding.joint)}: {finding.effect} ({values}): {finding.evidence}"
    tail = (
        f"; these data do not tell it from {format_equivalents(finding)}"
        if finding.equivalents
        else ""
    )
    for why in dict.fromkeys((finding.doubt, finding.objection)):
        tail += f"; {why}" if why else ""
    change = " -> ".join(format_error_pair(finding.error_before, finding.error_after))
    source = "held-out" if diagnosis.held_out else "cross-validated"
    what = f"perhaps {finding.effect}" if finding.doubt else finding.effect
    return f"{format_location(finding.joint)}: {what} ({values}): {source} error {change}{tail}"


def _format_spread(finding: Finding, name: str) -> str:
    """The standard deviation or the interval behind a value, where there is one."""
    sigma, interval = finding.sigmas.get(name, 0.0), finding.intervals.get(name)
    return format_spread(finding.parameters[name], sigma, interval)


def format_unit(finding: Finding, name: str) -> str:
    """The unit behind a value; nothing for a plain number."""
    of = finding.units.get(name, "1")
    return f" {of}" if of != "1" else ""


# A diagnosis as text.


def format_lines(diagnosis: Diagnosis) -> list[str]:
    """The verdict, what was found, the errors of all joints, and what the logs cannot show."""
    lines = list(diagnosis.sentences)
    source = "held-out" if diagnosis.held_out else "cross-validated"
    entry = ", ".join(
        f"joint {name} {format_percent(error)}" for name, error in diagnosis.errors.items()
    )
    lines += ["", f"error of the model on these logs, up to {diagnosis.fit_band:.3g} Hz: {entry}"]
    lines.append(
        f"{'joint':<6}{'before':>9}{'with effects':>14}  ({source} error, up to "
        f"{diagnosis.band:.3g} Hz)"
    )
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
