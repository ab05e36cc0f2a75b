"""A log against its robot: what a fit says of the channels, read as they stand or as guessed."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

from modeler.api.chain import observe
from modeler.cli.console import working
from modeler.compiled import CompiledModel
from modeler.core.errors import ModelerError
from modeler.fit import identify, with_verdict
from modeler.logs import LogMap, map_from_table
from modeler.logs.look import Look
from modeler.observation.findings import findings_of_fit
from modeler.observation.read import read_log
from modeler.observation.window import window

_POOR = 0.2  # relative error of a fit that is told
_BETTER = 0.5  # of the error, that a guess must reach to be believed

Span = tuple[float | None, float | None] | None


@dataclass(frozen=True)
class Heard:
    """What a fit says: relative error, infinite without fit; doubts; if it is usable."""

    error: float
    lines: tuple[str, ...]
    usable: bool = False


def doubts_of_fit(
    compiled: CompiledModel, place: str | Path, span: Span, mapping: LogMap, seen: Look
) -> tuple[tuple[str, ...], bool]:
    """What contradicts the robot; and whether the log fits without what ranges say of positions.

    A guess by range is believed if it halves the error of the log as it stands, or alone is
    usable; what goes wrong under a guess is never told of the log.
    """
    plain = _heard(compiled, place, span, _mapped(seen.plain, mapping), seen)
    if seen.suggested == seen.plain:
        return plain.lines, False
    guessed = _heard(compiled, place, span, _mapped(seen.suggested, mapping), seen)
    better = guessed.error < _BETTER * plain.error and guessed.usable >= plain.usable
    if better or (guessed.usable and not plain.usable):
        return guessed.lines, False
    return plain.lines, plain.usable


def _mapped(text: str, mapping: LogMap) -> LogMap:
    table = tomllib.loads(text)["log"] if text else {}
    return map_from_table(table, "guessed [log]").over(mapping) if table else mapping


def _heard(
    compiled: CompiledModel, place: str | Path, span: Span, mapping: LogMap, seen: Look
) -> Heard:
    try:
        with working("fitting"):
            log = read_log(place, compiled.spec, mapping)
            log = log if span is None else window(log, *span)
            observation = observe(compiled, [log])
            result = identify(observation, "weighted", compiled)
            found = findings_of_fit(compiled, observation, result.beta)
            verdict = with_verdict(compiled, observation, result, found).verdict
    except ModelerError as error:
        line = f"as a log of {compiled.spec.robot} it cannot be fitted: {error}"
        return Heard(float("inf"), (line,))
    lines = [*log.notes, *(fault.line for fault in found)]
    if verdict is not None and not verdict.usable:
        lines += [*verdict.doubts, f"a fit of {observation.robot} is {verdict.line}"]
    elif result.relative_error > _POOR:
        lines.append(f"a fit of {observation.robot} leaves {result.relative_error:.1%} of the "
                     "torque unexplained")  # fmt: skip
    fresh = [line for line in dict.fromkeys(lines) if not line.endswith(seen.notes)]
    longer = [line for line in fresh if not any(o != line and o.endswith(line) for o in fresh)]
    return Heard(result.relative_error, tuple(longer), verdict is not None and verdict.usable)
