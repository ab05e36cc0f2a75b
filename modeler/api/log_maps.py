"""Whose column is which in a log: as the robot file, the user, or the log itself says."""

import dataclasses
import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from modeler import observation
from modeler.core.errors import DataError, ModelerError, file_and_window
from modeler.core.manifest import Emitted
from modeler.estimation import identify, log_findings, with_verdict
from modeler.logs import (
    EITHER,
    InMemory,
    LogInspection,
    LogMap,
    LogTable,
    blocks_of,
    inspect_log,
    map_from_table,
    map_from_words,
    windows_of,
)
from modeler.observation import FINGER, LONG, WINDOW, WINDOWS
from modeler.runtime import CompiledModel
from modeler.simulation import SimulatedLog

Mapped = Mapping[str, Any] | Sequence[str] | LogMap
"""Whose column is which: a table as [log] of a robot file, or texts as `--map` takes them."""

_BETTER = 0.5  # of the error, that a guess must reach to be believed


def log_map(compiled: CompiledModel | Emitted, mapping: Mapped = ()) -> LogMap:
    """Which columns of logs are ours: [log] of the robot file, and `mapping` over it.

    >>> log_map(compiled, ["q1=position_a:deg"]).entries(compiled.spec.joints)["q1"].columns
    ('position_a',)
    """
    if isinstance(mapping, LogMap):
        return mapping
    stated = map_from_table(compiled.log, f"{compiled.spec.robot}: [log]")
    return given_map(mapping).overriding(stated)


def given_map(mapping: Mapped) -> LogMap:
    """A mapping as it was given, by itself."""
    if isinstance(mapping, LogMap):
        return mapping
    if isinstance(mapping, Mapping):
        return map_from_table(mapping, "mapping", strict=True)
    return map_from_words([mapping] if isinstance(mapping, str) else mapping)


def log_maps(compiled: CompiledModel, logs: Sequence[Any], mapping: Mapped = ()) -> list[LogMap]:
    """The map of each log: that of all, and with `auto` under it what the log itself suggests.

    Raises:
        DataError: a wrong mapping, or a file that cannot be read.
    """
    names = log_map(compiled, mapping)
    if not names.auto:
        return [names] * len(logs)
    known: dict[tuple[str, ...], LogMap] = {}  # of columns, a guess: once for logs that are alike
    found = []
    for log in logs:
        if isinstance(log, observation.Log | SimulatedLog):
            found.append(dataclasses.replace(names, auto=False))
            continue
        seen = look_at(
            log, compiled, LogMap(names=names.names, topic=names.topic, files=names.files)
        )
        clock = next((part for part in seen.streams if part.clock), None)
        if clock and not names.topic and [p.kind for p in seen.streams].count(clock.kind) > 1:
            names = dataclasses.replace(names, topic=clock.name)
        key = (seen.suggested, seen.plain, *(c.name for c in seen.channels))
        if key not in known:
            own, joints = _guessed(compiled, log, names, seen), compiled.spec.joints
            alike = (m for m in known.values() if m.table(joints) == own.table(joints))
            more = " (of this log; the model keeps that of the first)" * bool(known)
            told = tuple(line + more for line in own.told)
            known[key] = next(alike, None) or dataclasses.replace(own, told=told)
        found.append(known[key])
    return found


def settled(
    compiled: CompiledModel, logs: Sequence[Any], mapping: Mapped = ()
) -> tuple[Mapped, dict[str, Any]]:
    """The mapping with its guesses made, and what a model keeps of it, a table like [log].

    >>> settled(compiled, ["mon.parquet"])
    ((), {})

    The model keeps the map of the first log, with what the robot file says; nothing if that says
    it all. Where `auto` gives other logs other maps, they stay to be guessed.
    """
    given = given_map(mapping)
    if not given.auto and not given.table():
        return mapping, {}
    maps = log_maps(compiled, logs, mapping) or [log_map(compiled, mapping)]
    alike = all(one is maps[0] for one in maps)
    return maps[0] if alike else mapping, maps[0].table(compiled.spec.joints)


def _guessed(
    compiled: CompiledModel, place: str | Path | InMemory, names: LogMap, seen: LogInspection
) -> LogMap:
    """The guess, for what is not named yet, by the rule of `believed`."""
    joints = compiled.spec.joints
    there = {channel.name for channel in seen.channels}
    taken = {o for o, e in names.entries(joints).items() if there & {*e.columns}}
    taken |= {"time"} if names.rate else set()

    def under(text: str) -> LogMap:
        guess = _read(text)
        for layer in guess.layers:
            own = guess.entries(joints)
            left = {name: entry for name, entry in own.items() if name not in taken}
            guess = dataclasses.replace(guess, layers=(layer if len(left) == len(own) else left,))
        said = [f"{k} = {_shown(e)}" for k, e in guess.table(joints).items()]
        told = f"--map auto took {'; '.join(said) or 'the columns as they are called'}"
        lacking = [f"{o} (no column {e.columns[0]})" for o, e in names.entries(joints).items()
                   if e.strict and not there & {*e.columns}]  # fmt: skip
        told += f"; guessed too: {', '.join(lacking)}" if lacking else ""
        # A name for a column that is not here is for other logs.
        stated = dataclasses.replace(names, auto=False, layers=_present(names, there, joints))
        either = tuple(line for line in seen.doubts if EITHER in line and "[deg]" in told)
        return dataclasses.replace(stated.overriding(guess), told=(told, *either))

    if seen.suggested == seen.plain:
        return under(seen.plain)

    def hear(names: LogMap) -> Heard:
        return _heard(compiled, place, names)

    return believed(hear, under(seen.plain), under(seen.suggested))[1]


def _present(names: LogMap, there: set[str], joints: Sequence[Any]) -> tuple[Any, ...]:
    """The layers, without entries whose columns are not there."""
    entries = names.entries(joints)
    missing = {o for o, e in entries.items() if not there & {*e.columns}}
    if not missing:
        return names.layers
    return ({o: e for o, e in entries.items() if o not in missing},)


def _shown(entry: Any) -> str:
    return str(entry["column"] if isinstance(entry, dict) and "column" in entry else entry)


def _read(text: str) -> LogMap:
    """The map of a suggested [log]."""
    return map_from_table(tomllib.loads(text)["log"], "guessed [log]") if text else LogMap()


@dataclass(frozen=True)
class Heard:
    """What a fit says: relative error, infinite without fit; doubts; if it is usable; its data."""

    error: float
    lines: tuple[str, ...] = ()
    usable: bool = False
    report: observation.DataReport | None = None


def believed(
    hear: Callable[[LogMap], Heard], plain: LogMap, guessed: LogMap | None
) -> tuple[Heard, LogMap, bool]:
    """What is heard of a fit, the map that is believed, and whether the plain one will do.

    A guess by range is believed if it halves the error of the log as it stands, or alone is
    usable; what goes wrong under a guess is never told of the log.
    """
    as_it_is = hear(plain)
    if guessed is None:
        return as_it_is, plain, False
    heard = hear(guessed)
    better = heard.error < _BETTER * as_it_is.error and heard.usable >= as_it_is.usable
    if better or (heard.usable and not as_it_is.usable):
        return heard, guessed, False
    return as_it_is, plain, as_it_is.usable


def suggested_map(text: str, mapping: LogMap) -> LogMap:
    """A suggested [log], and a map over it."""
    return mapping.overriding(_read(text))


def _heard(compiled: CompiledModel, place: str | Path | InMemory, names: LogMap) -> Heard:
    """A weighted fit, of a long log of its beginning."""
    try:
        path, span = file_and_span(place) if isinstance(place, str | Path) else ("", None)
        blocks = blocks_of(Path(path)) if path and span is None else None
        if blocks is not None and blocks.rows > LONG:
            source = observation.source_of(Path(path), compiled.spec, names)
            assert source is not None  # it has blocks
            log = source.window(0.0, LONG)
        else:
            log = read_mapped(place, compiled.spec, names)
        rows = observation.observe(compiled, [log])
        result = identify(rows, "weighted", compiled)
        judged = with_verdict(compiled, rows, result, log_findings(compiled, rows))
    except ModelerError:
        return Heard(float("inf"))
    usable = judged.verdict is not None and judged.verdict.usable
    return Heard(judged.relative_error, (), usable, rows.report)


def read_mapped(
    place: str | Path | InMemory, spec: Any, names: LogMap, where: str = "log",
    spread: bool = False,
) -> observation.Log:  # fmt: skip
    """A log, or a piece of it, with the columns of a map; `where` is a frame in messages.

    With `spread` a log too long to be diagnosed as a whole is read as stretches of it.
    """
    if not isinstance(place, str | Path):
        return observation.log_in_memory(place, spec, names, where)
    path, span = file_and_span(place)
    if span is None:
        source = observation.source_of(Path(path), spec, names) if spread else None
        if source is None or source.rows <= observation.SPREAD:
            return observation.read_log(path, spec, names)
        return dataclasses.replace(observation.read_spread(source, spec), path=str(place))
    source = observation.source_of(Path(path), spec, names)
    if source is not None and source.rows > (LONG if source.exact else 2 * LONG):
        part = observation.read_part(source, spec, *span)
    else:
        part = observation.window(observation.read_log(path, spec, names), *span)
    return dataclasses.replace(part, path=str(place))


def file_and_span(place: str | Path) -> tuple[str | Path, tuple[float | None, float | None] | None]:
    """The file of a log, and the seconds that `@start:end` after it means; None for all of it.

    >>> file_and_span("run.parquet@0:10")
    ('run.parquet', (0.0, 10.0))

    Raises:
        DataError: something else stands after the @.
    """
    path, times = file_and_window(str(place))
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


def look_at(
    place: str | Path | InMemory,
    compiled: CompiledModel | Emitted | None = None,
    mapping: Mapped = (),
) -> LogInspection:
    """Channels, clock, gaps and doubts of a log.

    >>> look_at("mon.parquet").table().column("channel")[:3]
    ['time', 'q1', 'q2']

    Args:
        place: of any format of `modeler.logs`; with `@start:end` a piece of it; a frame, a dict.
        compiled: the robot that it may be of; None: the columns speak for themselves.
        mapping: whose column is which, as of `read_logs`; what it leaves open is guessed.

    Raises:
        DataError: the file cannot be read, or has no rows in that piece.
    """
    names = given_map(mapping) if compiled is None else log_map(compiled, mapping)
    joints = () if compiled is None else compiled.spec.joints
    if not isinstance(place, str | Path):
        held = observation.table_in_memory(place, joints, names, "log")
        return inspect_log(held, names, joints, (None, None))
    path, span = file_and_span(str(place))
    blocks, span = blocks_of(Path(path)), span or (None, None)
    if blocks is None or blocks.rows <= LONG:
        table = LogTable(Path(path), names, joints, any_topic=True)
        return inspect_log(table, names, joints, span)
    seen = windows_of(blocks, WINDOWS, WINDOW)
    every = (LogTable(Path(path), names, joints, part=own) for own in blocks.blocks(FINGER))
    return inspect_log(LogTable(Path(path), names, joints, part=seen), names, joints, span, every)
