"""One motion in several files: one for each quantity, or one for each joint."""

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeler.core.errors import DataError
from modeler.logs.columns import Column, Columns, NotNumbers, Wanted
from modeler.logs.guess import role_of, template_of

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

    A column is called `q[1]`, whether it is column 1 of q.csv or column q of joint1.csv; `q1`, our
    name of it, if [log] says that the file holds q.

    Args:
        places: the files, and our name of what each holds, "" where nobody said.
        where: the folder, or what the names of all files begin with.
        reader: of one file.

    Raises:
        DataError: other counts of rows, other clocks, several logs, or a file that cannot be read.
    """
    parts = [_part(place, key, reader) for place, key in places.items()]
    first = parts[0]
    for part in parts:
        if part.found.rows != first.found.rows:
            raise DataError(
                f"{where}: {part.path.name} has {part.found.rows} rows and {first.path.name} "
                f"{first.found.rows}; expected the same rows in each file of one motion; give "
                "files of several motions one by one, or resample one to the clock of the other"
            )
    twice = {name for name, n in Counter(n for p in parts for n in p.names).items() if n > 1}
    columns, units = list[tuple[str, Column]](), dict[str, str]()
    clock, told = _clock(parts, where)
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
    return Columns(tuple(columns), rows, units, notes, rate=rate, told=(said, *told_of))


def _part(path: Path, key: str, reader: Reader) -> _Part:
    found = reader(path, Wanted())
    timed = [n for n, column in found.columns if column.numeric and role_of(n) == "time"]
    alone = len(found.columns) == 1
    return _Part(path, found, timed[0] if timed and not alone else None, key)


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


def _clock(parts: Sequence[_Part], where: Path) -> tuple[_Part | None, str]:
    """The file whose clock all rows have, and how far others are from it, in words.

    Raises:
        DataError: further than half a step.
    """
    timed = [(part, *_times(part)) for part in parts if part.clock is not None]
    if not timed:
        return None, ""
    first, time, start = timed[0]
    step = float(np.median(np.abs(np.diff(time)))) if len(time) > 1 else 0.0
    widest = 0.0
    for part, own, begins in timed[1:]:
        off = np.abs(own + (begins - start) - time)
        widest = max(widest, float(np.nanmax(off, initial=0.0)))
        if widest > _SAME * step:
            row = int(np.nanargmax(off)) + 1
            raise DataError(
                f"{where}: the clocks of {part.path.name} and {first.path.name} are {widest:.4g} "
                f"apart in row {row}, of steps of {step:.4g}; expected the same times in each "
                "file; resample one to the clock of the other"
            )
    return first, f", whose clocks are up to {widest:.2g} apart: that of {first.path.name}" * (
        widest > 1e-6 * step
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
