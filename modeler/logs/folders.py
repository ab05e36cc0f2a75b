"""One motion in several files: one for each quantity, or one for each joint."""

import dataclasses
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeler.core.errors import DataError
from modeler.logs.arrays import LEAST_ROWS
from modeler.logs.columns import Column, Columns, NotNumbers, Wanted
from modeler.logs.guess import role_of, template_of

_GAP = 3.0  # steps of a file across which it is not interpolated
_SAME = 0.5  # of a step, that clocks of the same rows are apart at most

Reader = Callable[[Path, Wanted], Columns]


@dataclass(frozen=True, eq=False)
class _Part:
    """One file: its columns but the clock, and that."""

    path: Path
    found: Columns
    clock: str | None
    key: str = ""  # ours, where [log] says which file it is

    @property
    def names(self) -> list[str]:
        return [name for name, _ in self.found.columns if name != self.clock]


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
    parts = [_part(place, key, reader) for place, key in places.items()]
    parts, joined = _joined_by_time(parts, where)
    first = parts[0]
    for part in parts:
        if part.found.rows != first.found.rows:
            raise DataError(
                f"{where}: {part.path.name} has {part.found.rows} rows and {first.path.name} "
                f"{first.found.rows}; expected the same rows, or a time column in each file of one "
                "motion; give files of several motions one by one"
            )
    twice = {name for name, n in Counter(n for p in parts for n in p.names).items() if n > 1}
    columns, units = list[tuple[str, Column]](), dict[str, str]()
    clock, told = _clock(parts)
    for part in parts:
        own = dict(part.found.columns)
        names = _renamed(part, twice, where)
        columns += [(names[n], own[n]) for n in part.names]
        units |= {names[n]: u for n, u in part.found.units.items() if n in names}
        if clock is part and clock.clock is not None:
            columns.insert(0, (clock.clock, own[clock.clock]))
            units |= {n: u for n, u in part.found.units.items() if n == clock.clock}
    rate = next((p.found.rate for p in parts if p.found.rate), None)
    listed = ", ".join(part.path.name for part in parts)
    said = f"one motion in {len(parts)} files: {listed}{told}"
    notes, told_of = (_sentences(parts, name) for name in ("notes", "told"))
    rows = first.found.rows
    told_of = (*joined, *told_of)
    return Columns(tuple(columns), rows, units, notes, rate=rate, told=(said, *told_of))


def _part(path: Path, key: str, reader: Reader) -> _Part:
    found = reader(path, Wanted())
    timed = [n for n, column in found.columns if column.numeric and role_of(n) == "time"]
    alone = len(found.columns) == 1
    return _Part(path, found, timed[0] if timed and not alone else None, key)


@dataclass(frozen=True, eq=False)
class _Interpolated:
    """A column at the times of another file; missing across gaps of its own."""

    column: Column
    time: np.ndarray
    wanted: np.ndarray
    widest: float  # step that is no gap, s

    @property
    def numeric(self) -> bool:
        return self.column.numeric

    def numbers(self) -> np.ndarray:
        after = np.clip(np.searchsorted(self.time, self.wanted), 1, len(self.time) - 1)
        apart = self.time[after] - self.time[after - 1]
        values = np.interp(self.wanted, self.time, self.column.numbers())
        return np.where(apart > self.widest, np.nan, values)


def _joined_by_time(parts: Sequence[_Part], where: Path) -> tuple[list[_Part], list[str]]:
    """The files on the clock of the slowest, over the time that all have; how, in words.

    The others are interpolated, whose rows are closer. Files of equal rows and times stay.

    Raises:
        DataError: their times have less in common than a log has rows.
    """
    if any(part.clock is None for part in parts):
        return [*parts], []
    counted = [_times(part) for part in parts]
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
    made = list[_Part]()
    for part, time, step in zip(parts, times, steps, strict=True):
        is_slow = part is parts[slow]
        columns = tuple(
            (name, _Interpolated(column, time, rows, _GAP * step))
            for name, column in part.found.columns
            if column.numeric and (is_slow or name != part.clock)
        )
        found = dataclasses.replace(part.found, columns=columns, rows=len(rows))
        made.append(dataclasses.replace(part, found=found, clock=part.clock if is_slow else None))
    rates = (f"{p.path.name} {1.0 / s:.4g}" for p, s in zip(parts, steps, strict=True))
    return made, [
        f"joined by time, {end - begin:.4g} long, on the rows of {parts[slow].path.name}; rows per "
        f"unit of time: {', '.join(rates)}; the others are interpolated"
    ]


def _renamed(part: _Part, twice: set[str], where: Path) -> dict[str, str]:
    """Names of the file -> names in the log."""
    stem, labels = part.path.stem, [template_of(name) for name in part.names]
    alike = len({template for template, _ in labels}) == 1
    whose = template_of(stem)[1] or stem
    found = {}
    for name, (_, label) in zip(part.names, labels, strict=True):
        label = label if alike and label else name
        if part.key:
            found[name] = part.key if part.key == "time" else part.key + label
        elif role_of(stem) and (name in twice or not role_of(name)):
            found[name] = stem if len(part.names) == 1 else f"{stem}[{label}]"
        elif name in twice and template_of(name)[1]:
            raise DataError(
                f"{where}: {name} is in several files, {part.path.name} among them; expected one "
                "motion, a file for each quantity or joint; give several logs one by one"
            )
        else:
            found[name] = f"{name}[{whose}]" if name in twice else name
    return found


def _clock(parts: Sequence[_Part]) -> tuple[_Part | None, str]:
    """The file whose clock all rows have, and how far others are from it, in words."""
    timed = [(part, *_times(part)) for part in parts if part.clock is not None]
    if not timed:
        return None, ""
    first, time, start = timed[0]
    off = [float(np.nanmax(np.abs(own + b - start - time), initial=0.0)) for _, own, b in timed]
    step = float(np.median(np.abs(np.diff(time)))) if len(time) > 1 else 0.0
    return first, f", whose clocks are up to {max(off):.2g} apart: that of {first.path.name}" * (
        max(off) > 1e-6 * step
    )


def _times(part: _Part) -> tuple[np.ndarray, float]:
    """The times of a file, and what they are counted from, in the same unit."""
    column = dict(part.found.columns)[part.clock or ""]
    origin = getattr(column, "origin", None) or 0
    try:
        return column.numbers(), origin * 1e-9 if getattr(column, "is_time", False) else origin
    except NotNumbers as why:
        raise DataError(f"{part.path}: column {part.clock}{why}") from None


def _sentences(parts: Sequence[_Part], kind: str) -> tuple[str, ...]:
    """Notes of the files, or how they were read, each once."""
    by: dict[str, list[str]] = {}
    for part in parts:
        for note in getattr(part.found, kind):
            by.setdefault(note, []).append(part.path.name)
    more = {note: f" and {len(names) - 1} more" * (len(names) > 1) for note, names in by.items()}
    return tuple(f"{names[0]}{more[note]}: {note}" for note, names in by.items())
