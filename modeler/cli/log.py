"""`modeler log FILE`: what is in a log, before anything is fitted to it."""

import argparse
import dataclasses
from collections.abc import Sequence
from pathlib import Path

import modeler.api.workflow as workflow
from modeler.api.fitting import FitOutcome, judged
from modeler.api.log_maps import (
    Heard,
    believed,
    file_and_span,
    log_map,
    log_maps,
    look_at,
    read_mapped,
    suggested_map,
)
from modeler.api.long_logs import are_long, judged_long, too_long
from modeler.cli.console import Json, say, say_lines, working, written_pictures
from modeler.cli.lists import check_own_file, read_robot_with_notes
from modeler.core.errors import BuildError, DataError, ModelerError, on_one_line
from modeler.core.files import write_atomically
from modeler.core.json import nulled
from modeler.core.table import aligned, percent
from modeler.estimation import FitResult, identify, log_findings, stream
from modeler.logs import LogInspection, LogMap, map_from_words, marks_of, most_of
from modeler.observation import Observation, WholeLogNeeded, bands_of, noise_of_positions, source_of
from modeler.report import channel_rows, clock_line, log_page, log_pictures, write_page
from modeler.robot import with_log
from modeler.runtime import CompiledModel

_WIDEST = 44  # letters of a cell

_POOR = 0.2  # relative error of a fit that is told


def run_log(args: argparse.Namespace) -> Json:
    """Prints what the log holds, its doubts, and a [log] to start from."""
    compiled = described = uncompiled = None
    if args.write:
        if args.robot is None:
            raise DataError("--write: got no robot file to write into; expected --robot FILE.toml")
        check_own_file(args.robot, "columns of logs")
    if args.robot is not None:
        robot = read_robot_with_notes(args.robot)
        with working(f"deriving {robot.name}"):
            described = workflow.generate(workflow.derive(robot))
            try:
                compiled = workflow.compile_model(described)
            except BuildError as error:
                if args.write:  # a guess is tried before it is written
                    raise
                uncompiled = error
    mapping = map_from_words(args.map) if described is None else log_map(described, args.map)
    seen = look_at(args.log, described, args.map)
    doubts = [*seen.doubts]
    if uncompiled is not None:
        doubts.append(f"not tried by a fit of {robot.name}: {on_one_line(str(uncompiled))}")
    noise = noise_of_positions(seen.positions)
    bands, marks = bands_of(noise), marks_of(seen)
    if compiled is not None:
        sure = suggested_map(seen.plain, mapping)
        ranged = suggested_map(seen.suggested, mapping)
        heard, _, stands = believed(
            lambda names: _heard(compiled, args.log, names, seen), sure,
            None if seen.suggested == seen.plain else ranged,
        )  # fmt: skip
        if heard.report is not None:
            noise, bands = heard.report.noise, heard.report.bands
            marks = most_of([*marks, *heard.report.logs[0].marks()])
        if stands:  # it fits as it is: a range alone is no doubt
            doubts = [line for line in doubts if line not in seen.ranged]
            seen = dataclasses.replace(seen, suggested=seen.plain)
        more = [line for line in heard.lines if not line.endswith(tuple(doubts))]
        doubts = [own for own in doubts if not any(own in line for line in more)] + more
    said = [*noise.channel_lines(), *bands.chosen_by] if noise is not None else []
    say_lines(_lines(seen, doubts, said))
    places = []
    if args.write and compiled is not None:
        named = dataclasses.replace(map_from_words(args.map), auto=True)
        table = log_maps(compiled, [args.log], named)[0].table(compiled.spec.joints)
        before = " in place of its own" if robot.log else ""
        write_atomically(Path(args.robot), with_log(robot.text, table))
        places.append(f"[log] in {args.robot}{before}")
    if args.report is not None:
        with working("drawing the page"):
            places.append(str(write_page(Path(args.report), log_page(seen, doubts, [], bands))))
    if args.picture is not None:
        places.append(written_pictures(args.picture, log_pictures(seen, bands)))
    if places:
        say(f"written: {', '.join(places)}")
    plain = [dataclasses.asdict(mark) for mark in marks]
    return nulled(seen.to_json() | {"doubts": doubts, "bands": bands, "marks": plain})


def _lines(seen: LogInspection, doubts: Sequence[str], noise: Sequence[str]) -> list[str]:
    lines = [f"{seen.name}: {seen.rows} rows"]
    lines += [
        f"  {stream.name}  {stream.kind}, {stream.rows} messages{', the clock' * stream.clock}"
        for stream in seen.streams
    ]
    lines.append("clock: none found" if seen.clock is None else f"clock {clock_line(seen.clock)}")
    rows = [
        [*(c if len(c) <= _WIDEST else f"...{c[3 - _WIDEST :]}" for c in cells), remarks]
        for *cells, remarks in channel_rows(seen)
    ]
    lines += ["", *(line.rstrip() for line in aligned(rows, (0, 1, 6))), ""]
    lines += [*noise, *(f"note: {note}" for note in seen.notes)]
    lines += [f"doubt: {doubt}" for doubt in doubts] or ["no doubts"]
    if seen.suggested:
        told = "a mapping to start from, a guess: paste it into the robot file, or --map FILE.toml"
        lines += ["", told, "", seen.suggested.rstrip()]
    return lines


def _heard(compiled: CompiledModel, place: str, mapping: LogMap, seen: LogInspection) -> Heard:
    try:
        with working("fitting"):
            observation, result = _fitted(compiled, place, mapping)
            found = log_findings(compiled, observation)
    except ModelerError as error:
        line = f"as a log of {compiled.spec.robot} it cannot be fitted: {error}"
        return Heard(float("inf"), (line,))
    verdict = result.verdict
    lines = [*observation.report.logs[0].notes, *(f.line for f in found if not f.unseen)]
    if verdict is not None and not verdict.usable:
        lines += [*verdict.doubts, f"a fit of {observation.robot}: {verdict.line}"]
    elif result.relative_error > _POOR:
        lines.append(f"a fit of {observation.robot} leaves {percent(result.relative_error)} of the "
                     "torque unexplained")  # fmt: skip
    fresh = [line for line in dict.fromkeys(lines) if not line.endswith(seen.notes)]
    longer = [line for line in fresh if not any(o != line and o.endswith(line) for o in fresh)]
    usable = verdict is not None and verdict.usable
    return Heard(result.relative_error, tuple(longer), usable, observation.report)


def _fitted(compiled: CompiledModel, place: str, mapping: LogMap) -> tuple[Observation, FitResult]:
    """A weighted fit with its verdict, of a long log in chunks."""
    if are_long([place]):
        try:
            source = source_of(Path(file_and_span(place)[0]), compiled.spec, mapping)
            assert source is not None  # others are not known to be long
            streamed = stream(compiled, [source])
            return streamed.observation, judged_long(compiled, streamed, "weighted")
        except WholeLogNeeded:
            if too_long([place]):
                raise
    observation = workflow.observe(compiled, [read_mapped(place, compiled.spec, mapping)])
    way = FitOutcome(identify(observation, "weighted", compiled))
    return observation, judged(compiled, observation, way)
