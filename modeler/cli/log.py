"""`modeler log FILE`: what is in a log, before anything is fitted to it."""

import argparse
import dataclasses
from collections.abc import Sequence
from pathlib import Path

import modeler.api.workflow as workflow
from modeler.api.fitting import FitOutcome, add_long_verdict, add_verdict
from modeler.api.log_maps import (
    MappingFit,
    build_log_map,
    build_log_maps,
    choose_mapping,
    inspect_log,
    merge_suggested_map,
    parse_time_range,
    read_mapped_log,
)
from modeler.api.workflow import are_long, are_too_long
from modeler.cli.console import print_lines, print_result, show_activity, write_pictures
from modeler.cli.documents import LogReport
from modeler.cli.lists import read_robot_with_notes
from modeler.cli.thresholds import THRESHOLDS
from modeler.core.errors import BuildError, ModelerError, flatten_message
from modeler.core.files import write_atomically
from modeler.core.table import align_columns, format_percent
from modeler.estimation import (
    FitResult,
    find_contradictions,
    find_log_faults,
    identify,
    stream_logs,
)
from modeler.logs import LogInspection, LogMap, find_marks, keep_longest, parse_map_options
from modeler.regression import (
    Observation,
    WholeLogNeeded,
    build_bands,
    estimate_position_noise,
    open_source,
)
from modeler.robot import replace_log_table
from modeler.runtime import CompiledModel
from modeler.views import (
    build_log_page,
    describe_clock,
    draw_log_pictures,
    tabulate_channels,
    write_page,
)

_WIDEST = 44  # letters of a cell


def run_log(args: argparse.Namespace) -> LogReport:
    """Prints what the log holds, its warnings, and a [log] to start from."""
    compiled = described = uncompiled = None
    if args.write:
        from modeler.api.postures import check_own_file  # symbols take long to load

        check_own_file(args.robot, "columns of logs")
    if args.robot is not None:
        robot = read_robot_with_notes(args.robot)
        with show_activity(f"deriving {robot.name}"):
            described = workflow.generate(workflow.derive(robot))
            try:
                compiled = workflow.compile_model(described)
            except BuildError as error:
                if args.write:  # a guess is tried before it is written
                    raise
                uncompiled = error
    mapping = (
        parse_map_options(args.mapping)
        if described is None
        else build_log_map(described, args.mapping)
    )
    inspection = inspect_log(args.log, described, args.mapping)
    doubts = [*inspection.warnings]
    if uncompiled is not None:
        doubts.append(f"not tried by a fit of {robot.name}: {flatten_message(str(uncompiled))}")
    noise = estimate_position_noise(inspection.positions)
    bands, marks = build_bands(noise), find_marks(inspection)
    if compiled is not None:
        sure = merge_suggested_map(inspection.suggested_map_without_ranges, mapping)
        ranged = merge_suggested_map(inspection.suggested_map, mapping)
        mapping_fit, _, stands = choose_mapping(
            lambda names: _fit_mapping(compiled, args.log, names, inspection),
            sure,
            None if inspection.suggested_map == inspection.suggested_map_without_ranges else ranged,
        )
        if mapping_fit.data_report is not None:
            noise, bands = mapping_fit.data_report.noise, mapping_fit.data_report.bands
            marks = keep_longest([*marks, *mapping_fit.data_report.logs[0].collect_marks()])
        if stands:  # it fits as it is: a range alone is no warning
            doubts = [line for line in doubts if line not in inspection.range_warnings]
            inspection = dataclasses.replace(
                inspection, suggested_map=inspection.suggested_map_without_ranges
            )
        more = [line for line in mapping_fit.lines if not line.endswith(tuple(doubts))]
        doubts = [doubt for doubt in doubts if not any(doubt in line for line in more)] + more
    noise_lines = [*noise.format_channels(), *bands.reasons] if noise is not None else []
    print_lines(_format_inspection(inspection, doubts, noise_lines))
    places = []
    if args.write and compiled is not None:
        guess_map = dataclasses.replace(parse_map_options(args.mapping), auto=True)
        table = build_log_maps(compiled, [args.log], guess_map)[0].build_table(compiled.spec.joints)
        before = " in place of its own" if robot.log else ""
        write_atomically(Path(args.robot), replace_log_table(robot.text, table))
        places.append(f"[log] in {args.robot}{before}")
    if args.report is not None:
        with show_activity("drawing the page"):
            places.append(
                str(write_page(Path(args.report), build_log_page(inspection, doubts, [], bands)))
            )
    if args.picture is not None:
        places.append(write_pictures(args.picture, draw_log_pictures(inspection, bands)))
    if places:
        print_result(f"written: {', '.join(places)}")
    return LogReport(inspection, doubts, bands, marks)


def _format_inspection(
    inspection: LogInspection, doubts: Sequence[str], noise: Sequence[str]
) -> list[str]:
    lines = [f"{inspection.name}: {inspection.rows} rows"]
    lines += [
        f"  {stream.name}  {stream.kind}, {stream.rows} messages{', the clock' * stream.is_clock}"
        for stream in inspection.streams
    ]
    lines.append(
        "clock: none found"
        if inspection.clock is None
        else f"clock {describe_clock(inspection.clock)}"
    )
    rows = [
        [*(c if len(c) <= _WIDEST else f"...{c[3 - _WIDEST :]}" for c in cells), remarks]
        for *cells, remarks in tabulate_channels(inspection)
    ]
    lines += ["", *(line.rstrip() for line in align_columns(rows, (0, 1, 6))), ""]
    lines += [*noise, *(f"note: {note}" for note in inspection.notes)]
    lines += [f"warning: {doubt}" for doubt in doubts] or ["no warnings"]
    if inspection.suggested_map:
        suggestion_title = (
            "a mapping to start from, a guess: paste it into the robot file, or --map FILE.toml"
        )
        lines += ["", suggestion_title, "", inspection.suggested_map.rstrip()]
    return lines


def _fit_mapping(
    compiled: CompiledModel, place: str, mapping: LogMap, inspection: LogInspection
) -> MappingFit:
    try:
        with show_activity("fitting"):
            observation, result = _fit_log(compiled, place, mapping)
            findings = find_log_faults(compiled, observation)
    except ModelerError as error:
        line = f"as a log of {compiled.spec.robot} it cannot be fitted: {error}"
        return MappingFit(float("inf"), (line,))
    verdict = result.verdict
    lines = [
        *observation.report.logs[0].notes,
        *(f.line for f in findings if not f.is_undetectable),
    ]
    usable = verdict is not None and verdict.is_valid_everywhere
    usable = usable and not find_contradictions(compiled, observation, result)
    if verdict is not None and not usable:
        lines += [*verdict.lines, f"a fit of {observation.robot}: {verdict.line}"]
    elif result.relative_error > THRESHOLDS.max_unremarked_error:
        lines.append(
            f"a fit of {observation.robot} leaves {format_percent(result.relative_error)} of the "
            "torque unexplained"
        )
    fresh = [line for line in dict.fromkeys(lines) if not line.endswith(inspection.notes)]
    longer = [line for line in fresh if not any(o != line and o.endswith(line) for o in fresh)]
    return MappingFit(result.relative_error, tuple(longer), usable, observation.report)


def _fit_log(compiled: CompiledModel, place: str, mapping: LogMap) -> tuple[Observation, FitResult]:
    """A weighted fit with its verdict, of a long log in chunks."""
    if are_long([place]):
        try:
            source = open_source(Path(parse_time_range(place)[0]), compiled.spec, mapping)
            assert source is not None  # others are not known to be long
            streamed = stream_logs(compiled, [source])
            return streamed.observation, add_long_verdict(compiled, streamed, "weighted")
        except WholeLogNeeded:
            if are_too_long([place]):
                raise
    observation = workflow.observe(compiled, [read_mapped_log(place, compiled.spec, mapping)])
    outcome = FitOutcome(identify(observation, "weighted", compiled))
    return observation, add_verdict(compiled, observation, outcome)
