"""A diagnosis in plain words."""

import dataclasses

from modeler.core.table import percent, printed
from modeler.diagnosis.orders import knocking
from modeler.diagnosis.result import Diagnosis, Finding, Key
from modeler.diagnosis.search import Step
from modeler.effects import Effect, Needs, effect_named
from modeler.estimation import spread_text

TOLD = 0.15
"""Gain from which on an effect is mentioned that was refused."""

MOST_REFUSED = 3

NOT_JUDGED = "the machine differs between the training and the held-out logs"
"""Why no effect is judged where parameters have changed."""

_MOST_MOVED = 8  # parameters that are listed

_ONLY_HERE = "of these logs' error, but that of motion left out does not surely fall with it"
_PART = "it explains only part of what is systematic"

_ONLY_TIMING = (
    "of the error, but so do errors of timing: it is not seen once encoder noise is smoothed out "
    "of the motion"
)


def where(joint: str | None) -> str:
    """The joint, or the whole robot."""
    return f"joint {joint}" if joint is not None else "the whole robot"


def blind_spots(diagnosis: Diagnosis) -> list[tuple[str, str]]:
    """What the logs cannot show, and why: (effect and joint, sentence).

    A joint of which no row can be used stands there once, for all its effects.
    """
    found = {}
    for name, joint in diagnosis.blind_spots:
        effect = _effect(name, diagnosis)
        if joint is not None and joint in diagnosis.unmoved:
            found[f"any effect of joint {joint}"] = "no row of it can be used; move it"
        else:
            found[f"{name}@{joint}" if joint else name] = effect.look_alikes
    return list(found.items())


def evidence(step: Step, before: float, after: float) -> str:
    """Why this effect, in one or two sentences.

    Args:
        step: that put it in.
        before: the error that is printed for it.
        after: that with it.
    """
    judged = step.judged
    text = (
        f"{judged.candidate.effect.title}: error {' -> '.join(printed(before, after))} on motion "
        "that was held out"
    )
    rivals = [
        r for r in step.rivals
        if r.possible and r.confirmed and r.candidate.key != judged.candidate.key
    ]  # fmt: skip
    if rivals and rivals[0].share > 0.0 and judged.share > 0.0:
        other = rivals[0]
        text += (
            f". Runner-up: {other.candidate.effect.title} ({where(other.candidate.joint)}), which "
            f"explains {percent(other.share / judged.share)} of what it does within these logs"
        )
    return text


def sentences(diagnosis: Diagnosis) -> Diagnosis:
    """The diagnosis with its sentences."""
    lines = [_headline(diagnosis), *(_effect_line(f, diagnosis) for f in diagnosis.effects)]
    lines += [_refinement(f, diagnosis) for f in diagnosis.refinements]
    judged = {} if diagnosis.contradicted or diagnosis.machine_changed else diagnosis.joints
    lines += refused_lines(diagnosis) if judged else []
    for name, joint in judged.items():
        if joint.unexplained:
            left = joint.systematic + joint.noise
            lines.append(
                f"joint {name}: {percent(joint.systematic / left)} of the remaining error "
                "variance is systematic and not explained by the catalogue"
                f"{_outbursts(diagnosis, name)}"
            )
    lines += _changes(diagnosis) + [f"data: {line}" for line in diagnosis.data]
    if not diagnosis.held_out:
        lines.append(
            "no held-out logs: errors are cross-validated within the logs, which flatters effects "
            "that depend on the path; give other motion with --holdout"
        )
    return dataclasses.replace(diagnosis, sentences=tuple(lines))


def _changes(diagnosis: Diagnosis) -> list[str]:
    """The parameters in which the machine of the held-out logs differs."""
    lines = [
        f"{p.name}: {p.before:.4g} +- {p.sigma_before:.2g} -> {p.after:.4g} +- "
        f"{p.sigma_after:.2g} {p.unit} (fitted to the held-out logs alone)"
        for p in diagnosis.machine_changed[:_MOST_MOVED]
    ]
    more = len(diagnosis.machine_changed) - len(lines)
    return lines + [f"{more} other parameters differ too"] * (more > 0)


def refused_lines(diagnosis: Diagnosis) -> list[str]:
    """What explains much of these logs and is not named all the same, the best first."""
    found = diagnosis.search
    timing = [
        judged for judged in found.last.ranked
        if not judged.confirmed and Needs.LAG not in judged.candidate.effect.needs
    ]  # fmt: skip
    named = {(f.effect, f.joint) for f in (*diagnosis.effects, *diagnosis.refinements)}
    lost = [step.judged for step in found.steps if step.pick.key not in named]
    lines: dict[Key, tuple[float, str]] = {}
    for refused, why in (((*found.vetoed, *lost), ""), (timing, _ONLY_TIMING)):
        for judged in refused:
            because = why or (f"of the error, but {judged.why}" if judged.why else _ONLY_HERE)
            key = judged.candidate.key
            if key not in named and judged.gain > lines.get(key, (TOLD, ""))[0]:
                text = f"not named: {judged.candidate.effect.title} ({key[0]}), {where(key[1])}, "
                lines[key] = judged.gain, f"{text}explains {percent(judged.gain)} {because}"
    return [line for _, line in sorted(lines.values(), reverse=True)[:MOST_REFUSED]]


def _outbursts(diagnosis: Diagnosis, name: str) -> str:
    state = diagnosis.search.end
    names = [joint.name for joint in state.data.compiled.spec.joints]
    share = knocking(state, names.index(name))
    if share == 0.0:
        return ""
    return (
        f"; {percent(share)} of its energy comes in brief outbursts: play, a loose part, or a log "
        "that begins before the motion has settled"
    )


def _headline(diagnosis: Diagnosis) -> str:
    first = diagnosis.effects[0] if diagnosis.effects else None
    if diagnosis.machine_changed:
        return (
            f"cannot tell: {NOT_JUDGED}, so the diagnosis is not judged; take logs of the machine "
            "in one state"
        )
    if diagnosis.verdict == "missing" and first is not None:
        return f"missing: {_named(first, diagnosis)}{tied(first)}"
    if diagnosis.verdict == "closest description" and first is not None:
        perhaps = "perhaps " if first.doubt else ""
        reason = first.doubt or first.objection or _PART
        return (
            f"closest description: {perhaps}{_named(first, diagnosis)}{tied(first)}; {reason}, so "
            "the cause may be outside the catalogue"
        )
    if diagnosis.verdict == "unexplained":
        return "unexplained: the error is systematic, and nothing in the catalogue describes it"
    if diagnosis.contradicted:
        return "cannot tell: channels of the logs contradict the model; mend them first"
    if diagnosis.verdict == "cannot tell":
        lost = [name for name, joint in diagnosis.joints.items() if joint.error_after > 1.0]
        if lost:
            return (
                f"cannot tell: what is fitted to the logs says nothing of the held-out motion of "
                f"joint {', '.join(lost)}; record longer motions, at many speeds and poses"
            )
        return "cannot tell: too few rows; record longer motions of all joints"
    if diagnosis.refinements:
        return "nothing to add: a law that the model has can be refined"
    return "nothing to add: no effect of the catalogue surely lowers the error by more than 3 %"


def tie_names(finding: Finding) -> str:
    """What the data do not tell from it; empty without any."""
    return ", ".join(f"{effect} on {where(joint)}" for effect, joint in finding.ties)


def tied(finding: Finding) -> str:
    """Behind its name: what it may be as well."""
    return f", or {tie_names(finding)} (these data do not tell which)" if finding.ties else ""


def _refinement(finding: Finding, diagnosis: Diagnosis) -> str:
    line = f"refinement on {where(finding.joint)}: {finding.effect}, gain {percent(finding.gain)}"
    effect = _effect(finding.effect, diagnosis)
    first = next(iter(finding.parameters.values()), 0.0)
    return f"{line}: {effect.negative}" if effect.mends(first) else line


def _named(finding: Finding, diagnosis: Diagnosis) -> str:
    effect = _effect(finding.effect, diagnosis)
    return f"{effect.title} ({finding.effect}), {where(finding.joint)}"


def _effect(name: str, diagnosis: Diagnosis) -> Effect:
    effect = effect_named(name, diagnosis.search.catalogue)
    assert effect is not None, "it was diagnosed"
    return effect


def _effect_line(finding: Finding, diagnosis: Diagnosis) -> str:
    if not finding.parameters:  # seen by a detector: neither value nor column
        return finding.evidence
    values = ", ".join(
        f"{name} = {value:.4g}{_spread(finding, name)}{unit(finding, name)}"
        for name, value in finding.parameters.items()
    )
    if finding.closure is None:
        return f"{where(finding.joint)}: {finding.effect} ({values}): {finding.evidence}"
    tail = f"; these data do not tell it from {tie_names(finding)}" if finding.ties else ""
    for why in dict.fromkeys((finding.doubt, finding.objection)):
        tail += f"; {why}" if why else ""
    change = " -> ".join(printed(finding.error_before, finding.error_after))
    source = "held-out" if diagnosis.held_out else "cross-validated"
    what = f"perhaps {finding.effect}" if finding.doubt else finding.effect
    return f"{where(finding.joint)}: {what} ({values}): {source} error {change}{tail}"


def _spread(finding: Finding, name: str) -> str:
    """The standard deviation or the interval behind a value, where there is one."""
    sigma, interval = finding.sigmas.get(name, 0.0), finding.intervals.get(name)
    return spread_text(finding.parameters[name], sigma, interval)


def unit(finding: Finding, name: str) -> str:
    """The unit behind a value; nothing for a plain number."""
    of = finding.units.get(name, "1")
    return f" {of}" if of != "1" else ""


# A diagnosis as text.


def lines(diagnosis: Diagnosis) -> list[str]:
    """The verdict, what was found, the errors of all joints, and what the logs cannot show."""
    found = list(diagnosis.sentences)
    source = "held-out" if diagnosis.held_out else "cross-validated"
    own = ", ".join(f"joint {name} {percent(error)}" for name, error in diagnosis.errors.items())
    found += ["", f"error of the model on these logs, up to {diagnosis.fit_band:.3g} Hz: {own}"]
    found.append(f"{'joint':<6}{'before':>9}{'with effects':>14}  ({source} error, up to "
                 f"{diagnosis.band:.3g} Hz)")  # fmt: skip
    for name, joint in diagnosis.joints.items():
        before, after = printed(joint.error_before, joint.error_after)
        found.append(f"{name:<6}{before:>9}{after:>14}")
    if diagnosis.discoveries is not None:
        found += ["", "equations proposed for what has no name:"]
        found += [line for own in diagnosis.discoveries for line in own.lines()]
    blind = [what for what, _ in blind_spots(diagnosis)]
    if blind:
        found.append(f"these logs cannot show: {', '.join(blind)}")
    return found
