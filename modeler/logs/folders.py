"""One motion in several files: one for each quantity, or one for each joint."""

import dataclasses
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeler.core.errors import DataError
from modeler.logs.arrays import LEAST_ROWS
from modeler.logs.columns import Column, ColumnRequest, Columns, NotNumericError
from modeler.logs.guess import guess_role, split_label

_GAP = 3.0  # steps of a file across which it is not interpolated
_SAME = 0.5  # of a step, that clocks of the same rows are apart at most

Reader = Callable[[Path, ColumnRequest], Columns]


@dataclass(frozen=True, eq=False)
class _FilePart:
    """One file: its columns but the clock, and that."""

    path: Path
    content: Columns
    clock: str | None
    key: str = ""  # ours, where [log] says which file it is

    @property
    def names(self) -> list[str]:
        return [name for name, _ in self.content.columns if name != self.clock]


def read_files(places: Mapping[Path, str], where: Path, reader: Reader) -> Columns:
    """The columns of several files as those of one log; rows belong together by their place.

    Where counts or clocks differ and every file has its clock, they are joined by time.

    A column is called `q[1]`, whether it is column 1 of q.csv or column q of joint1.csv; `q1`, our
    name of it, if [log] says that the file holds q.

    Args:
        places: the files, and our name of what each holds, "" where nobody said.
        where: the folder, or what the names of all files begin with.
        reader: of one file.

    Raises:
        DataError: other counts of rows without clocks, no common time, several logs, or a file that
            cannot be read.
    """
    parts = [_read_part(place, key, reader) for place, key in places.items()]
    parts, joined = _join_by_time(parts, where)
    first = parts[0]
    for part in parts:
        if part.content.rows != first.content.rows:
            raise DataError(
                f"{where}: {part.path.name} has {part.content.rows} rows and {first.path.name} "
                f"{first.content.rows}; expected the same rows, or a time column in each file of "
                "one "
                "motion; give files of several motions one by one"
            )
    twice = {name for name, n in Counter(n for p in parts for n in p.names).items() if n > 1}
    columns, units = list[tuple[str, Column]](), dict[str, str]()
    clock, clock_note = _compare_clocks(parts)
    for part in parts:
        part_columns = dict(part.content.columns)
        names = _rename_columns(part, twice, where)
        columns += [(names[n], part_columns[n]) for n in part.names]
        units |= {names[n]: u for n, u in part.content.units.items() if n in names}
        if clock is part and clock.clock is not None:
            columns.insert(0, (clock.clock, part_columns[clock.clock]))
            units |= {n: u for n, u in part.content.units.items() if n == clock.clock}
    rate = next((p.content.rate for p in parts if p.content.rate), None)
    listed = ", ".join(part.path.name for part in parts)
    summary = f"one motion in {len(parts)} files: {listed}{clock_note}"
    notes, reading_notes = (_collect_notes(parts, name) for name in ("notes", "told"))
    rows = first.content.rows
    reading_notes = (*joined, *reading_notes)
    return Columns(
        tuple(columns), rows, units, notes, rate=rate, reading_notes=(summary, *reading_notes)
    )


def _read_part(path: Path, key: str, reader: Reader) -> _FilePart:
    content = reader(path, ColumnRequest())
    timed = [n for n, column in content.columns if column.is_numeric and guess_role(n) == "time"]
    alone = len(content.columns) == 1
    return _FilePart(path, content, timed[0] if timed and not alone else None, key)


@dataclass(frozen=True, eq=False)
class _InterpolatedColumn:
    """A column at the times of another file; missing across gaps of its own."""

    column: Column
    time: np.ndarray
    wanted: np.ndarray
    widest: float  # step that is no gap, s

    @property
    def is_numeric(self) -> bool:
        return self.column.is_numeric

    def read_numbers(self) -> np.ndarray:
        after = np.clip(np.searchsorted(self.time, self.wanted), 1, len(self.time) - 1)
        apart = self.time[after] - self.time[after - 1]
        values = np.interp(self.wanted, self.time, self.column.read_numbers())
        return np.where(apart > self.widest, np.nan, values)


def _join_by_time(parts: Sequence[_FilePart], where: Path) -> tuple[list[_FilePart], list[str]]:
    """The files on the clock of the slowest, over the time that all have; how, in words.

    The others are interpolated, whose rows are closer. Files of equal rows and times stay.

    Raises:
        DataError: their times have less in common than a log has rows.
    """
    if any(part.clock is None for part in parts):
        return [*parts], []
    counted = [_read_times(part) for part in parts]
    times = [time + begins - counted[0][1] for time, begins in counted]
    if any(len(t) < LEAST_ROWS or not (np.diff(t) > 0.0).all() for t in times):
        return [*parts], []
    steps = [float(np.median(np.diff(t))) for t in times]
    slow = int(np.argmax(steps))
    if len({*map(len, times)}) == 1 and np.ptp(times, axis=0).max() <= _SAME * steps[slow]:
        return [*parts], []
    begin, end = max(t[0] for t in times), min(t[-1] for t in times)
    rows = times[slow][(times[slow] >= begin) & (times[slow] <= end)]
    if len(rows) < LEAST_ROWS:
        spans = (f"{p.path.name} {t[0]:.7g} to {t[-1]:.7g}"
                 for p, t in zip(parts, times, strict=True))  # fmt: skip
        raise DataError(
            f"{where}: the times of its files have less than {LEAST_ROWS} rows in common: "
            f"{', '.join(spans)}; expected one clock in the same unit; shift or convert one"
        )
    made = list[_FilePart]()
    for part, time, step in zip(parts, times, steps, strict=True):
        is_slow = part is parts[slow]
        columns = tuple(
            (name, _InterpolatedColumn(column, time, rows, _GAP * step))
            for name, column in part.content.columns
            if column.is_numeric and (is_slow or name != part.clock)
        )
        content = dataclasses.replace(part.content, columns=columns, rows=len(rows))
        made.append(
            dataclasses.replace(part, content=content, clock=part.clock if is_slow else None)
        )
    rates = (f"{p.path.name} {1.0 / s:.4g}" for p, s in zip(parts, steps, strict=True))
    return made, [
        f"joined by time, {end - begin:.4g} long, on the rows of {parts[slow].path.name}; rows per "
        f"unit of time: {', '.join(rates)}; the others are interpolated"
    ]


def _rename_columns(part: _FilePart, twice: set[str], where: Path) -> dict[str, str]:
    """Names of the file -> names in the log."""
    stem, labels = part.path.stem, [split_label(name) for name in part.names]
    alike = len({template for template, _ in labels}) == 1
    whose = split_label(stem)[1] or stem
    new_names = {}
    for name, (_, label) in zip(part.names, labels, strict=True):
        label = label if alike and label else name
        if part.key:
            new_names[name] = part.key if part.key == "time" else part.key + label
        elif guess_role(stem) and (name in twice or not guess_role(name)):
            new_names[name] = stem if len(part.names) == 1 else f"{stem}[{label}]"
        elif name in twice and split_label(name)[1]:
            raise DataError(
                f"{where}: {name} is in several files, {part.path.name} among them; expected one "
                "motion, a file for each quantity or joint; give several logs one by one"
            )
        else:
            new_names[name] = f"{name}[{whose}]" if name in twice else name
    return new_names


def _compare_clocks(parts: Sequence[_FilePart]) -> tuple[_FilePart | None, str]:
    """The file whose clock all rows have, and how far others are from it, in words."""
    timed = [(part, *_read_times(part)) for part in parts if part.clock is not None]
    if not timed:
        return None, ""
    first, time, start = timed[0]
    off = [
        float(np.nanmax(np.abs(other_time + b - start - time), initial=0.0))
        for _, other_time, b in timed
    ]
    step = float(np.median(np.abs(np.diff(time)))) if len(time) > 1 else 0.0
    return first, f", whose clocks are up to {max(off):.2g} apart: that of {first.path.name}" * (
        max(off) > 1e-6 * step
    )


def _read_times(part: _FilePart) -> tuple[np.ndarray, float]:
    """The times of a file, and what they are counted from, in the same unit."""
    column = dict(part.content.columns)[part.clock or ""]
    origin = getattr(column, "origin", None) or 0
    try:
        return column.read_numbers(), origin * 1e-9 if getattr(column, "is_time", False) else origin
    except NotNumericError as why:
        raise DataError(f"{part.path}: column {part.clock}{why}") from None


def _collect_notes(parts: Sequence[_FilePart], kind: str) -> tuple[str, ...]:
    """Notes of the files, or how they were read, each once."""
    by: dict[str, list[str]] = {}
    for part in parts:
        for note in getattr(part.content, kind):
            by.setdefault(note, []).append(part.path.name)
    more = {note: f" and {len(names) - 1} more" * (len(names) > 1) for note, names in by.items()}
    return tuple(f"{names[0]}{more[note]}: {note}" for note, names in by.items())
