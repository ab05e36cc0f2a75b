"""A log against its robot: what a fit says of the channels, read as they stand or as guessed."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

from modeler.api.chain import file_and_span, observe, read_mapped
from modeler.api.long_logs import are_long, judged_long, too_long
from modeler.api.ways import Way, judged
from modeler.cli.console import working
from modeler.compiled import CompiledModel
from modeler.core.errors import ModelerError
from modeler.fit import FitResult, identify
from modeler.fit.streamed import stream
from modeler.logs import LogMap, map_from_table
from modeler.logs.look import Look
from modeler.observation import Observation
from modeler.observation.findings import findings_of_fit
from modeler.observation.source import source_of
from modeler.observation.survey import WholeNeeded

_POOR = 0.2  # relative error of a fit that is told
_BETTER = 0.5  # of the error, that a guess must reach to be believed


@dataclass(frozen=True)
class Heard:
    """What a fit says: relative error, infinite without fit; doubts; if it is usable."""

    error: float
    lines: tuple[str, ...]
    usable: bool = False


def doubts_of_fit(
    compiled: CompiledModel, place: str, mapping: LogMap, seen: Look
) -> tuple[tuple[str, ...], bool]:
    """What contradicts the robot; and whether the log fits without what ranges say of positions.

    A guess by range is believed if it halves the error of the log as it stands, or alone is
    usable; what goes wrong under a guess is never told of the log.
    """
    plain = _heard(compiled, place, _mapped(seen.plain, mapping), seen)
    if seen.suggested == seen.plain:
        return plain.lines, False
    guessed = _heard(compiled, place, _mapped(seen.suggested, mapping), seen)
    better = guessed.error < _BETTER * plain.error and guessed.usable >= plain.usable
    if better or (guessed.usable and not plain.usable):
        return guessed.lines, False
    return plain.lines, plain.usable


def _mapped(text: str, mapping: LogMap) -> LogMap:
    table = tomllib.loads(text)["log"] if text else {}
    return map_from_table(table, "guessed [log]").over(mapping) if table else mapping


def _heard(compiled: CompiledModel, place: str, mapping: LogMap, seen: Look) -> Heard:
    try:
        with working("fitting"):
            observation, result = _fitted(compiled, place, mapping)
            found = findings_of_fit(compiled, observation, result.beta)
    except ModelerError as error:
        line = f"as a log of {compiled.spec.robot} it cannot be fitted: {error}"
        return Heard(float("inf"), (line,))
    verdict = result.verdict
    lines = [*observation.report.logs[0].notes, *(fault.line for fault in found)]
    if verdict is not None and not verdict.usable:
        lines += [*verdict.doubts, f"a fit of {observation.robot} is {verdict.line}"]
    elif result.relative_error > _POOR:
        lines.append(f"a fit of {observation.robot} leaves {result.relative_error:.1%} of the "
                     "torque unexplained")  # fmt: skip
    fresh = [line for line in dict.fromkeys(lines) if not line.endswith(seen.notes)]
    longer = [line for line in fresh if not any(o != line and o.endswith(line) for o in fresh)]
    return Heard(result.relative_error, tuple(longer), verdict is not None and verdict.usable)


def _fitted(compiled: CompiledModel, place: str, mapping: LogMap) -> tuple[Observation, FitResult]:
    """A weighted fit with its verdict, of a long log in chunks."""
    if are_long([place]):
        try:
            source = source_of(Path(file_and_span(place)[0]), compiled.spec, mapping)
            assert source is not None  # others are not known to be long
            streamed = stream(compiled, [source])
            return streamed.observation, judged_long(compiled, streamed, "weighted")
        except WholeNeeded:
            if too_long([place]):
                raise
    observation = observe(compiled, [read_mapped(place, compiled.spec, mapping)])
    way = Way(identify(observation, "weighted", compiled))
    return observation, judged(compiled, observation, way)
