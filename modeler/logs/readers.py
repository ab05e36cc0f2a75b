"""Readers by the ending of a file; several files of one motion; frames in memory."""

import dataclasses
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

import numpy as np
import pyarrow as pa

from modeler.core.errors import DataError
from modeler.core.manifest import JointSpec
from modeler.logs import blocks
from modeler.logs.arrays import (
    LEAST_ROWS,
    NamedArray,
    build_columns,
    read_hdf5,
    read_mat,
    read_numpy,
)
from modeler.logs.bags import read_bag
from modeler.logs.columns import (
    Column,
    ColumnRequest,
    Columns,
    NotNumericError,
    find_origins,
    is_moment,
)
from modeler.logs.datasets import INFO, flatten_table
from modeler.logs.dialect import TEXTS
from modeler.logs.guess import guess_role, split_label
from modeler.logs.thresholds import THRESHOLDS

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
    """Reads several files as the columns of one log; rows belong together by their place.

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
                f"{first.content.rows}; expected the same rows, or a time column in each file "
                "of one "
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
    notes = _collect_notes((part.path.name, part.content.notes) for part in parts)
    read = _collect_notes((part.path.name, part.content.reading_notes) for part in parts)
    reading_notes = (summary, *joined, *read)
    rows = first.content.rows
    return Columns(tuple(columns), rows, units, notes, rate=rate, reading_notes=reading_notes)


def _read_part(path: Path, key: str, reader: Reader) -> _FilePart:
    content = reader(path, ColumnRequest())
    timed = [n for n, column in content.columns if column.is_numeric and guess_role(n) == "time"]
    alone = len(content.columns) == 1
    return _FilePart(path, content, timed[0] if timed and not alone else None, key)


@dataclass(frozen=True, eq=False)
class _InterpolatedColumn(Column):
    """A column at the times of another file; missing across gaps of its own."""

    column: Column
    time: np.ndarray
    wanted: np.ndarray
    widest: float  # step that is no gap, s

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
    is_equal_length = len({*map(len, times)}) == 1
    if is_equal_length and np.ptp(times, axis=0).max() <= THRESHOLDS.max_clock_offset * steps[slow]:
        return [*parts], []
    begin, end = max(t[0] for t in times), min(t[-1] for t in times)
    rows = times[slow][(times[slow] >= begin) & (times[slow] <= end)]
    if len(rows) < LEAST_ROWS:
        pairs = zip(parts, times, strict=True)
        spans = (f"{p.path.name} {t[0]:.7g} to {t[-1]:.7g}" for p, t in pairs)
        raise DataError(
            f"{where}: the times of its files have less than {LEAST_ROWS} rows in common: "
            f"{', '.join(spans)}; expected one clock in the same unit; shift or convert one"
        )
    made = list[_FilePart]()
    for part, time, step in zip(parts, times, steps, strict=True):
        is_slow = part is parts[slow]
        columns = tuple(
            (
                name,
                _InterpolatedColumn(column, time, rows, THRESHOLDS.max_interpolated_steps * step),
            )
            for name, column in part.content.columns
            if column.is_numeric and (is_slow or name != part.clock)
        )
        content = dataclasses.replace(part.content, columns=columns, rows=len(rows))
        clock = part.clock if is_slow else None
        made.append(dataclasses.replace(part, content=content, clock=clock))
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
    shifts = (other_time + b - start - time for _, other_time, b in timed)
    off = [float(np.nanmax(np.abs(shift), initial=0.0)) for shift in shifts]
    step = float(np.median(np.abs(np.diff(time)))) if len(time) > 1 else 0.0
    return first, f", whose clocks are up to {max(off):.2g} apart: that of {first.path.name}" * (
        max(off) > 1e-6 * step
    )


def _read_times(part: _FilePart) -> tuple[np.ndarray, float]:
    """The times of a file, and what they are counted from, in the same unit."""
    column = dict(part.content.columns)[part.clock or ""]
    origin = column.origin or 0
    try:
        return column.read_numbers(), origin * 1e-9 if column.is_time else origin
    except NotNumericError as why:
        raise DataError(f"{part.path}: column {part.clock}{why}") from None


def _collect_notes(notes: Iterable[tuple[str, Iterable[str]]]) -> tuple[str, ...]:
    """Notes of the files, by their names, each once."""
    by: dict[str, list[str]] = {}
    for file, sentences in notes:
        for note in sentences:
            by.setdefault(note, []).append(file)
    more = {note: f" and {len(names) - 1} more" * (len(names) > 1) for note, names in by.items()}
    return tuple(f"{names[0]}{more[note]}: {note}" for note, names in by.items())


# Logs that are in memory: frames of pandas, Polars and all that speaks Arrow, dicts of arrays.


_PER_JOINT = ("q", "qd", "qdd", "qc", "tau", "current", "duty", "voltage")


@runtime_checkable
class Frame(Protocol):
    """A table that hands out its columns as Arrow does (the Arrow PyCapsule interface).

    Frames of pandas (2.2 and later) and of Polars, tables of Arrow and of DuckDB are such.
    """

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """A capsule with a stream of its rows."""


InMemory = Frame | Mapping[str, Any]
"""A frame, or arrays by name: one column each, or (rows, joints) for `q`, `tau` and the like."""


def build_frame_columns(frame: InMemory, where: str, joints: Sequence[JointSpec] = ()) -> Columns:
    """Returns the columns of a frame, or of a dict of arrays.

    >>> build_frame_columns({"time": range(20), "q": np.zeros((20, 2))}, "run").rows
    20

    Args:
        frame: it; an index that is not just counted is a column too, dates without a name the time.
        where: what messages call it.
        joints: of the robot: an array (rows, joints) of our name has a column for each, one
            (rows, actuated joints) for each of those.

    Raises:
        DataError: no frame, or nothing that could be a log.
    """
    if isinstance(frame, Mapping):
        arrays = list(_list_arrays(frame, where, joints))
        return build_columns(Path(where), "dict", arrays, ColumnRequest())
    try:
        table = pa.table(frame)
        table = table.rename_columns([_name_column(field, table) for field in table.schema])
        return blocks.build_arrow_columns(flatten_table(table, None), 0, find_origins(table))
    except (pa.ArrowException, TypeError, ValueError) as error:
        message = " ".join(str(error).split())[:200]
        raise DataError(
            f"{where}: this frame has columns that Arrow does not know ({message}); expected "
            "numbers "
            "in every column; drop or convert the others"
        ) from None


def _name_column(field: pa.Field, table: pa.Table) -> str:
    """The name of a column; of an index of pandas without one, of dates or times, `time`."""
    nameless = field.name.startswith("__index_level_") and is_moment(field.type)
    return "time" if nameless and "time" not in table.column_names else str(field.name)


def _list_arrays(
    arrays: Mapping[str, Any], where: str, joints: Sequence[JointSpec]
) -> Iterator[NamedArray]:
    for name, values in arrays.items():
        array = np.asarray(values)
        if array.dtype.kind in "Mm" and array.size:  # dates and times: s since the first
            array = (array - array.flat[0]) / np.timedelta64(1, "s")
        if array.dtype.kind == "O" or not array.ndim:
            raise DataError(
                f"{where}: got {type(values).__name__} as {name}; expected an array of numbers, "
                "one for each row"
            )
        joint_columns = split_joints(str(name), array.shape, joints)
        if joint_columns:
            yield from (NamedArray(each, array[:, k]) for k, each in enumerate(joint_columns))
        else:
            yield NamedArray(str(name), array)


def split_joints(name: str, shape: tuple[int, ...], joints: Sequence[JointSpec]) -> list[str]:
    """Returns the columns that an array of our name stands for; none of another one.

    Args:
        name: "q", "tau" ...
        shape: of it.
        joints: of the robot.
    """
    if name not in _PER_JOINT or len(shape) != 2:
        return []
    every = (joints, [joint for joint in joints if joint.actuated])
    selected_joints = next((some for some in every if len(some) == shape[1]), ())
    return [f"{name}{joint.name}" for joint in selected_joints]


# Which reader a file is for, by its ending.


_READERS: Mapping[str, Callable[[Path, ColumnRequest], Columns]] = {
    ".parquet": blocks.read_parquet,
    **dict.fromkeys(TEXTS, blocks.read_csv),
    ".xlsx": blocks.read_sheets,
    ".mat": read_mat,
    ".h5": read_hdf5,
    ".hdf5": read_hdf5,
    ".mcap": read_bag,
    ".db3": read_bag,
    ".bag": read_bag,
    ".npz": read_numpy,
    ".npy": read_numpy,
}

BAG = "metadata.yaml"
"""The file that makes a folder a ROS 2 bag."""


def read_columns(path: Path, wanted: ColumnRequest) -> Columns:
    """Reads the columns of a file, of the folder of a ROS 2 bag or a dataset, or of several files.

    Raises:
        DataError: there is none, its ending is unknown, its package is missing, or it is damaged.
    """
    try:
        path.stat()
    except FileNotFoundError:
        pass  # reported below
    except OSError as error:
        raise DataError(f"{path}: cannot be read ({error.strerror}); check the path") from None
    if wanted.files and not path.is_file():
        return read_files(_locate_parts(path, wanted.files), path, read_columns)
    if path.is_dir():
        return _read_folder(path, wanted)
    reader = _READERS.get(path.suffix.lower())
    if reader is None and (path.suffix or path.exists()):
        raise DataError(
            f"{path}: a log ends in .parquet or .csv, or in {', '.join([*_READERS][2:])}, got "
            f'"{path.suffix or "no suffix"}"; convert or rename it'
        )
    if reader is None or not path.is_file():
        ending = "" if reader else ", which ends in .parquet, .csv or another ending of a log"
        what = "a pipe or a device, no file" if path.exists() else "there is no such file"
        raise DataError(f"{path}: {what}; check the path{ending}")
    if path.stat().st_size == 0:
        raise DataError(f"{path}: the file is empty; record or copy it again")
    return reader(path, wanted)


def _locate_parts(path: Path, files: Mapping[str, str]) -> dict[Path, str]:
    """The files that [log] names, in a folder or with a beginning of all their names."""
    is_folder = path.is_dir()
    places = {k: path / end if is_folder else Path(f"{path}{end}") for k, end in files.items()}
    missing = [place for place in places.values() if not place.is_file()]
    if missing:
        raise DataError(
            f"{path}: there is no file {missing[0]}; expected a log, or what the names in files of "
            f"[log] stand after or in: {', '.join(files.values())}; check the path"
        )
    return {place: key for key, place in places.items()}


def _read_folder(path: Path, wanted: ColumnRequest) -> Columns:
    if (path / BAG).is_file():
        return read_bag(path, wanted)
    if (path / INFO).is_file():
        return blocks.read_dataset(path, wanted)
    every = (p for p in sorted(path.iterdir()) if p.suffix.lower() in _READERS)
    files = [p for p in every if p.is_file() and not p.name.startswith(".")]
    if not files:
        raise DataError(
            f"{path}: is a folder without {BAG}, {INFO} or logs; expected a log, the folder of a "
            "ROS 2 bag or a dataset, or a folder with a file for each quantity or joint"
        )
    return read_files(dict.fromkeys(files, ""), path, read_columns)
