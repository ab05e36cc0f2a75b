"""Answers as tables in Markdown."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from modeler.diagnosis.messages import format_percent
from tests.hidden_effects.table import markdown
from tests.measured_sets.answer import Answer, Key, key, named


def stability(answers: Sequence[Answer]) -> str:
    """Every diagnosis, and for each set whether what is stated stays."""
    header = ["set", "direction", "factor", "verdict", "effects", "ties", "refinements", "seconds"]
    rows = [[*_case(answer), answer.verdict, *_diagnosis(answer)] for answer in answers]
    doubted = "A `?` stands behind what is named with a warning.\n\n"
    return doubted + markdown(header, rows) + "\n" + _by_set(answers, stays)


def stays(answers: Sequence[Answer]) -> str:
    """Whether what is stated as the cause is the same wherever anything is.

    And what is named first, stated or not.
    """
    failed = sum(bool(answer.error) for answer in answers)
    stated = [answer.stated for answer in answers if answer.stated is not None]
    first = [answer.first for answer in answers if answer.first is not None]
    text = "MOVES" if len(set(stated)) > 1 else "stays"
    text += f" (of {len(answers)} stated: {_tally(stated)}; named first: {_tally(first)})"
    return f"FAILS in {failed}; {text}" if failed else text


def _tally(keys: Sequence[Key]) -> str:
    return ", ".join(f"{named(one)} {keys.count(one)}" for one in dict.fromkeys(keys)) or "nothing"


def improvement(answers: Sequence[Answer]) -> str:
    """Held-out errors before and after, then what was kept and left out."""
    header = ["set", "direction", "held-out error by joint, %", "whole", "scatter", "seconds"]
    rows = [[*_case(answer)[:2], *_change(answer)] for answer in answers]
    said = (
        "A `!` stands behind an error that rises significantly. *whole*: rms over the joints, "
        "with the effects; *scatter*: its fall in standard errors.\n\n"
    )
    steps = "\n".join(_steps(answer) for answer in answers)
    return said + markdown(header, rows) + "\n" + steps


def sanity(answers: Sequence[Answer]) -> str:
    """Values that cannot be."""
    rows = [[*_case(answer), fault] for answer in answers for fault in _wrong(answer)]
    table = markdown(["set", "direction", "factor", "what cannot be"], rows) if rows else ""
    return table + "\n" + _by_set(answers, _counted)


def wrong(answer: Answer) -> bool:
    """True if there is no answer, or one that states as a fact what cannot be."""
    return bool(answer.error) or any(fault.startswith("fact") for fault in answer.faults)


def line(answer: Answer) -> str:
    """A case in one line, as it comes."""
    said = answer.error or answer.said.get("verdict") or f"{len(answer.said['kept'])} kept"
    return f"{answer.case.name}: {said} [{_seconds(answer)}]"


def _wrong(answer: Answer) -> list[str]:
    return [answer.error] if answer.error else list(answer.faults)


def _counted(answers: Sequence[Answer]) -> str:
    lines = [fault for answer in answers for fault in _wrong(answer)]
    facts = sum(fault.startswith("fact") for fault in lines)
    return f"{facts} as facts, {len(lines) - facts} others in {len(answers)} answers"


def _case(answer: Answer) -> list[str]:
    return [answer.case.set, answer.case.direction, f"{answer.case.factor:g}"]


def _diagnosis(answer: Answer) -> list[str]:
    """Effects, ties, refinements, seconds."""
    if answer.error:
        return [answer.error, "", "", _seconds(answer)]
    effects = answer.said["effects"]
    return [
        "; ".join(map(_effect, effects)),
        ", ".join(str(len(finding["ties"])) for finding in effects),
        ", ".join(map(_label, answer.said["refinements"])),
        _seconds(answer),
    ]


def _effect(finding: Mapping[str, Any]) -> str:
    doubt = finding["caveat"] or not all(split["agrees"] for split in finding["splits"])
    change = " -> ".join(format_percent(finding[name]) for name in ("error_before", "error_after"))
    return f"{_label(finding)}{'?' if doubt else ''} {change}"


def _label(finding: Mapping[str, Any]) -> str:
    """Effect and joint, and the waves per turn that distinguish one ripple from another."""
    waves = (finding.get("parameters") or finding.get("nonlinear_parameters") or {}).get("m")
    ripple = finding["effect"].endswith("ripple") and waves is not None
    return named(key(finding)) + (f" m={waves:.3g}" if ripple else "")


def _seconds(answer: Answer) -> str:
    return " + ".join(f"{seconds:.1f} {part}" for part, seconds in answer.seconds.items())


def _change(answer: Answer) -> list[str]:
    if answer.error:
        return [answer.error, "", "", _seconds(answer)]
    said = answer.said
    joints = [
        f"{name}: {100 * before:.3g} -> {100 * after:.3g}{'!' if name in said['rises'] else ''}"
        for name, (before, after) in said["joints"].items()
    ]
    scatter = f"{said['scatter']:.1f}{', SPOILT' if said['spoilt'] else ''}"
    return ["; ".join(joints), f"{said['whole']:.3f}", scatter, _seconds(answer)]


def _steps(answer: Answer) -> str:
    """What `add auto` kept and left out, as a list."""
    rest = [_label(step) for step in answer.said.get("kept", ())]
    left = [f"  - left out: {text}" for text in answer.said.get("left_out", ())]
    title = f"- {answer.case.set}, {answer.case.direction}: kept {', '.join(rest) or 'nothing'}"
    return "\n".join([title, *left])


def _by_set(answers: Sequence[Answer], judge: Callable[[Sequence[Answer]], str]) -> str:
    names = dict.fromkeys(answer.case.set for answer in answers)
    return "\n".join(
        f"- {name}: {judge([a for a in answers if a.case.set == name])}" for name in names
    )
