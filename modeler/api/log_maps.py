"""Whose column is which in a log: as the robot file, the user, or the log itself says."""

import dataclasses
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from modeler import regression
from modeler.api.thresholds import THRESHOLDS
from modeler.core.errors import DataError, ModelerError, split_time_range
from modeler.core.manifest import EmittedModule
from modeler.estimation import find_contradictions, find_log_faults, identify, judge_fit
from modeler.logs import (
    EITHER,
    InMemory,
    LogInspection,
    LogMap,
    LogTable,
    build_map,
    inspect_table,
    open_blocks,
    parse_map_options,
    read_windows,
)
from modeler.regression import FINGER, LONG, WINDOW, WINDOWS
from modeler.runtime import CompiledModel
from modeler.simulation import SimulatedLog

Mapped = Mapping[str, Any] | Sequence[str] | LogMap
"""Whose column is which: a table as [log] of a robot file, or texts as `--map` takes them."""


def build_log_map(compiled: CompiledModel | EmittedModule, mapping: Mapped = ()) -> LogMap:
    """Builds the column mapping of logs: `mapping`, and under it [log] of the robot file.

    >>> names = build_log_map(compiled, ["q1=position_a:deg"])
    >>> names.expand_entries(compiled.spec.joints)["q1"].columns
    ('position_a',)
    """
    if isinstance(mapping, LogMap):
        return mapping
    stated = build_map(compiled.log, f"{compiled.spec.robot}: [log]")
    return parse_mapping(mapping).merge_over(stated)


def parse_mapping(mapping: Mapped) -> LogMap:
    """Parses a mapping by itself."""
    if isinstance(mapping, LogMap):
        return mapping
    if isinstance(mapping, Mapping):
        return build_map(mapping, "mapping", strict=True)
    return parse_map_options([mapping] if isinstance(mapping, str) else mapping)


def build_log_maps(
    compiled: CompiledModel, logs: Sequence[Any], mapping: Mapped = ()
) -> list[LogMap]:
    """Builds the column mapping of each log; `auto` adds what the log itself suggests.

    Raises:
        DataError: a wrong mapping, or a file that cannot be read.
    """
    names = build_log_map(compiled, mapping)
    if not names.auto:
        return [names] * len(logs)
    known: dict[tuple[str, ...], LogMap] = {}  # of columns, a guess: once for logs that are alike
    maps = []
    for log in logs:
        if isinstance(log, regression.Log | SimulatedLog):
            maps.append(dataclasses.replace(names, auto=False))
            continue
        inspection = inspect_log(
            log, compiled, LogMap(names=names.names, topic=names.topic, files=names.files)
        )
        clock = next((part for part in inspection.streams if part.is_clock), None)
        if clock and not names.topic and [p.kind for p in inspection.streams].count(clock.kind) > 1:
            names = dataclasses.replace(names, topic=clock.name)
        key = (
            inspection.suggested_map,
            inspection.suggested_map_without_ranges,
            *(c.name for c in inspection.channels),
        )
        if key not in known:
            guess, joints = _guess_map(compiled, log, names, inspection), compiled.spec.joints
            equal_maps = (
                m for m in known.values() if m.build_table(joints) == guess.build_table(joints)
            )
            more = " (of this log; the model keeps that of the first)" * bool(known)
            messages = tuple(line + more for line in guess.guess_notes)
            known[key] = next(equal_maps, None) or dataclasses.replace(guess, guess_notes=messages)
        maps.append(known[key])
    return maps


def resolve_mapping(
    compiled: CompiledModel, logs: Sequence[Any], mapping: Mapped = ()
) -> tuple[Mapped, dict[str, Any]]:
    """Resolves the guesses of a mapping; returns it and the table that a model keeps.

    >>> resolve_mapping(compiled, ["mon.parquet"])
    ((), {})

    The model keeps the map of the first log, with what the robot file says; nothing if that says
    it all. Where `auto` gives other logs other maps, they stay to be guessed.
    """
    parsed_mapping = parse_mapping(mapping)
    if not parsed_mapping.auto and not parsed_mapping.build_table():
        return mapping, {}
    maps = build_log_maps(compiled, logs, mapping) or [build_log_map(compiled, mapping)]
    is_same_map = all(one is maps[0] for one in maps)
    return maps[0] if is_same_map else mapping, maps[0].build_table(compiled.spec.joints)


def _guess_map(
    compiled: CompiledModel, place: str | Path | InMemory, names: LogMap, inspection: LogInspection
) -> LogMap:
    """The guess, for what is not named yet, by the rule of `choose_mapping`."""
    joints = compiled.spec.joints
    column_names = {channel.name for channel in inspection.channels}
    assigned = {o for o, e in names.expand_entries(joints).items() if column_names & {*e.columns}}
    assigned |= {"time"} if names.rate else set()

    def map_over_stated(text: str) -> LogMap:
        guess = _parse_suggested(text)
        for layer in guess.layers:
            entries = guess.expand_entries(joints)
            left = {name: entry for name, entry in entries.items() if name not in assigned}
            guess = dataclasses.replace(
                guess, layers=(layer if len(left) == len(entries) else left,)
            )
        assignments = [f"{k} = {_format_entry(e)}" for k, e in guess.build_table(joints).items()]
        message = f"mapping auto took {'; '.join(assignments) or 'the columns as they are called'}"
        missing = [
            f"{o} (no column {e.columns[0]})"
            for o, e in names.expand_entries(joints).items()
            if e.strict and not column_names & {*e.columns}
        ]
        message += f"; guessed too: {', '.join(missing)}" if missing else ""
        # A name for a column that is not here is for other logs.
        stated = dataclasses.replace(
            names, auto=False, layers=_drop_absent_entries(names, column_names, joints)
        )
        either = tuple(
            line for line in inspection.warnings if EITHER in line and "[deg]" in message
        )
        return dataclasses.replace(stated.merge_over(guess), guess_notes=(message, *either))

    if inspection.suggested_map == inspection.suggested_map_without_ranges:
        return map_over_stated(inspection.suggested_map_without_ranges)

    def fit_mapping(names: LogMap) -> MappingFit:
        return _fit_mapping(compiled, place, names)

    return choose_mapping(
        fit_mapping,
        map_over_stated(inspection.suggested_map_without_ranges),
        map_over_stated(inspection.suggested_map),
    )[1]


def _drop_absent_entries(
    names: LogMap, column_names: set[str], joints: Sequence[Any]
) -> tuple[Any, ...]:
    """The layers, without entries whose columns are not there."""
    entries = names.expand_entries(joints)
    missing = {o for o, e in entries.items() if not column_names & {*e.columns}}
    if not missing:
        return names.layers
    return ({o: e for o, e in entries.items() if o not in missing},)


def _format_entry(entry: Any) -> str:
    return str(entry["column"] if isinstance(entry, dict) and "column" in entry else entry)


def _parse_suggested(text: str) -> LogMap:
    """The map of a suggested [log]."""
    return build_map(tomllib.loads(text)["log"], "guessed [log]") if text else LogMap()


@dataclass(frozen=True)
class MappingFit:
    """What a fit says: relative error, infinite without fit; warnings; if usable; its data."""

    error: float
    lines: tuple[str, ...] = ()
    is_usable: bool = False
    data_report: regression.DataReport | None = None


def choose_mapping(
    fit_mapping: Callable[[LogMap], MappingFit], plain: LogMap, guessed: LogMap | None
) -> tuple[MappingFit, LogMap, bool]:
    """Chooses between the plain and the guessed mapping by a trial fit.

    A guess by range is believed if it halves the error of the log as it stands, or alone is
    usable; what goes wrong under a guess is never reported about the log.
    """
    plain_fit = fit_mapping(plain)
    if guessed is None:
        return plain_fit, plain, False
    guessed_fit = fit_mapping(guessed)
    better = (
        guessed_fit.error < THRESHOLDS.max_guess_error_share * plain_fit.error
        and guessed_fit.is_usable >= plain_fit.is_usable
    )
    if better or (guessed_fit.is_usable and not plain_fit.is_usable):
        return guessed_fit, guessed, False
    return plain_fit, plain, plain_fit.is_usable


def merge_suggested_map(text: str, mapping: LogMap) -> LogMap:
    """Merges a suggested [log] under a mapping."""
    return mapping.merge_over(_parse_suggested(text))


def _fit_mapping(
    compiled: CompiledModel, place: str | Path | InMemory, names: LogMap
) -> MappingFit:
    """A weighted fit, of a long log of its beginning."""
    try:
        path, span = parse_time_range(place) if isinstance(place, str | Path) else ("", None)
        blocks = open_blocks(Path(path)) if path and span is None else None
        if blocks is not None and blocks.rows > LONG:
            source = regression.open_source(Path(path), compiled.spec, names)
            assert source is not None  # it has blocks
            log = source.read_window(0.0, LONG)
        else:
            log = read_mapped_log(place, compiled.spec, names)
        rows = regression.observe(compiled, [log])
        result = identify(rows, "weighted", compiled)
        result = judge_fit(compiled, rows, result, find_log_faults(compiled, rows))
    except ModelerError:
        return MappingFit(float("inf"))
    usable = result.verdict is not None and result.verdict.is_valid_everywhere
    usable = usable and not find_contradictions(compiled, rows, result)
    return MappingFit(result.relative_error, (), usable, rows.report)


def read_mapped_log(
    place: str | Path | InMemory, spec: Any, names: LogMap, where: str = "log", spread: bool = False
) -> regression.Log:
    """Reads a log, or a time range of it, with a mapping; `where` begins messages.

    With `spread` a log too long to be diagnosed as a whole is read as segments of it.
    """
    if not isinstance(place, str | Path):
        return regression.read_log_in_memory(place, spec, names, where)
    path, span = parse_time_range(place)
    if span is None:
        source = regression.open_source(Path(path), spec, names) if spread else None
        if source is None or source.rows <= regression.SPREAD:
            return regression.read_log(path, spec, names)
        return dataclasses.replace(regression.read_spread(source, spec), path=str(place))
    source = regression.open_source(Path(path), spec, names)
    if source is not None and source.rows > (LONG if source.exact else 2 * LONG):
        part = regression.read_part(source, spec, *span)
    else:
        part = regression.cut_window(regression.read_log(path, spec, names), *span)
    return dataclasses.replace(part, path=str(place))


def parse_time_range(
    place: str | Path,
) -> tuple[str | Path, tuple[float | None, float | None] | None]:
    """Splits FILE@START:END into the file and the seconds; None for the whole file.

    >>> parse_time_range("run.parquet@0:10")
    ('run.parquet', (0.0, 10.0))

    Raises:
        DataError: something else stands after the @.
    """
    path, times = split_time_range(str(place))
    if times is None:
        return place, None
    start, colon, end = times.partition(":")
    try:
        span = tuple(float(side) if side else None for side in (start, end))
    except ValueError:
        span = ()
    if not (colon and span):
        raise DataError(
            f"{place}: got @{times} after the file; expected @START:END in seconds, as in "
            f"{path}@0:10, {path}@5: or {path}@:5"
        )
    return path, (span[0], span[1])


def inspect_log(
    place: str | Path | InMemory,
    compiled: CompiledModel | EmittedModule | None = None,
    mapping: Mapped = (),
) -> LogInspection:
    """Returns the channels, the clock, the gaps and the warnings of a log.

    >>> inspect_log("mon.parquet").table().column("channel")[:3]
    ['time', 'q1', 'q2']

    Args:
        place: of any format of `modeler.logs`; with `@start:end` a piece of it; a frame, a dict.
        compiled: the robot that it may be of; None: the columns speak for themselves.
        mapping: whose column is which, as of `read_logs`; what it leaves open is guessed.

    Raises:
        DataError: the file cannot be read, or has no rows in that piece.
    """
    names = parse_mapping(mapping) if compiled is None else build_log_map(compiled, mapping)
    joints = () if compiled is None else compiled.spec.joints
    if not isinstance(place, str | Path):
        table_in_memory = regression.build_table(place, joints, names, "log")
        return inspect_table(table_in_memory, names, joints, (None, None))
    path, span = parse_time_range(str(place))
    blocks, span = open_blocks(Path(path)), span or (None, None)
    if blocks is None or blocks.rows <= LONG:
        table = LogTable(Path(path), names, joints, any_topic=True)
        return inspect_table(table, names, joints, span)
    sample = read_windows(blocks, WINDOWS, WINDOW)
    every = (
        LogTable(Path(path), names, joints, part=block) for block in blocks.read_blocks(FINGER)
    )
    return inspect_table(
        LogTable(Path(path), names, joints, part=sample), names, joints, span, every
    )
