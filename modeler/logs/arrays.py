"""Arrays by name, as MAT, HDF5 and numpy files hold them, as columns; numpy files."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from modeler.core.errors import DataError
from modeler.core.files import check_unpacked
from modeler.logs.columns import Column, Columns, NotNumbers, Wanted, reading

LEAST_ROWS = 10
"""A log of fewer rows carries no motion: fifth of a second at the slowest usual rate."""

_SHOWN = 8  # names in a note


@dataclass(frozen=True)
class Held:
    """An array of a file; `data` may be on disk still.

    Attributes:
        name: of it in the file.
        data: has shape, dtype, and `data[()]` for its values.
        unit: that the file states, or "".
        flipped: True if the file keeps it by columns: the axes are the other way round.
    """

    name: str
    data: Any
    unit: str = ""
    flipped: bool = False

    @property
    def shape(self) -> tuple[int, ...]:
        """As the user wrote it."""
        return tuple(self.data.shape[::-1] if self.flipped else self.data.shape)


class _Reader:
    """Reads the arrays of one file; keeps the last, whose columns come one after the other."""

    def __init__(self, path: Path, what: str) -> None:
        self._path, self._what = path, what
        self._last: tuple[Any, np.ndarray] | None = None

    def values(self, held: Held) -> np.ndarray:
        if self._last is None or self._last[0] is not held:
            with reading(self._path, self._what):
                self._last = (held, np.asarray(held.data[()]))
        return self._last[1].T if held.flipped else self._last[1]


@dataclass(frozen=True, eq=False)
class _Slice:
    """One column of an array."""

    reader: _Reader
    held: Held
    place: int
    across: bool  # rows of the array are the columns

    @property
    def numeric(self) -> bool:
        return self.held.data.dtype.kind in "iuf"

    def numbers(self) -> np.ndarray:
        if not self.numeric:
            raise NotNumbers(
                f" holds {self.held.data.dtype}; expected numbers; write it as floating point"
            )
        values = self.reader.values(self.held)
        if values.ndim == 2:
            values = values[self.place] if self.across else values[:, self.place]
        return np.array(values, dtype=float).reshape(-1)


def columns_of(
    path: Path, what: str, arrays: Sequence[Held], wanted: Wanted, notes: Sequence[str] = ()
) -> Columns:
    """The columns of arrays: (n,) one, (n, k) and (k, n) k of them, `name[1]` to `name[k]`.

    n is the length that most arrays share; the others are left out, and told.

    Raises:
        DataError: no such group, or nothing that could be a log.
    """
    arrays = _in_group(path, arrays, wanted)
    rows = _rows(arrays)
    if rows is None:
        raise DataError(
            f"{path}: no array of {LEAST_ROWS} rows or more; expected the samples of a motion as "
            f"arrays (n,) or (n, joints); it holds {_listed([_told(a) for a in arrays])}"
        )
    reader, found = _Reader(path, what), list[tuple[str, Column]]()
    units, left = dict[str, str](), list[str]()
    for held in arrays:
        slices = _slices(reader, held, rows)
        if not slices:
            left.append(_told(held))
        found += slices
        units |= {name: held.unit for name, _ in slices if held.unit}
    told = [f"{_listed(left)} left out: no columns of {rows} rows"] if left else []
    return Columns(tuple(found), rows, units, (*notes, *told))


def _in_group(path: Path, arrays: Sequence[Held], wanted: Wanted) -> list[Held]:
    """The arrays inside the group that is asked for, their names from there on."""
    topic = wanted.topic.strip("/")
    if not topic:
        return list(arrays)
    found = [
        Held(a.name[len(topic) + 1 :], a.data, a.unit, a.flipped)
        for a in arrays
        if a.name.startswith((f"{topic}.", f"{topic}/"))
    ]
    if not found:
        groups = sorted({a.name[:i] for a in arrays for i, c in enumerate(a.name) if c in "./"})
        raise DataError(
            f"{path}: topic {wanted.topic}: no group of that name; the groups are "
            f"{_listed(groups) or 'none'}"
        )
    return found


def _rows(arrays: Sequence[Held]) -> int | None:
    """The length that most arrays have along an axis; of two the longer."""
    counts = Counter(
        n for a in arrays if len(a.shape) in (1, 2) for n in set(a.shape) if n >= LEAST_ROWS
    )
    return max(counts, key=lambda n: (counts[n], n), default=None)


def _slices(reader: _Reader, held: Held, rows: int) -> list[tuple[str, Column]]:
    shape = held.shape
    if shape in ((rows,), (rows, 1), (1, rows)):
        return [(held.name, _Slice(reader, held, 0, shape == (1, rows)))]
    if len(shape) != 2 or rows not in shape:
        return []
    across = shape[0] != rows
    count = shape[0] if across else shape[1]
    return [(f"{held.name}[{k + 1}]", _Slice(reader, held, k, across)) for k in range(count)]


def with_fields(name: str, data: Any, **more: Any) -> list[Held]:
    """An array, or those of its fields where its rows are records."""
    if data.dtype.names is None:
        return [Held(name, data, **more)]
    head = f"{name}." if name else ""
    return [Held(f"{head}{field}", _Field(data, field), **more) for field in data.dtype.names]


@dataclass(frozen=True, eq=False)
class _Field:
    """One field of an array of records, which may be on disk still."""

    data: Any
    field: str

    @property
    def shape(self) -> tuple[int, ...]:
        return (*self.data.shape, *self._kind.shape)

    @property
    def dtype(self) -> np.dtype:
        return self._kind.base

    @property
    def _kind(self) -> np.dtype:
        fields: Mapping[str, Any] = self.data.dtype.fields
        return fields[self.field][0]

    def __getitem__(self, key: tuple[()]) -> np.ndarray:
        return np.asarray(self.data[self.field])


def _told(held: Held) -> str:
    return f"{held.name} ({' x '.join(map(str, held.shape)) or '1 value'})"


def _listed(names: Sequence[str]) -> str:
    more = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return ", ".join(names[:_SHOWN]) + more


def read_numpy(path: Path, wanted: Wanted) -> Columns:
    """The columns of the arrays of an .npz file, or of the fields of an .npy file.

    Arrays of Python objects are refused: reading them would run what the file says.
    """
    with reading(path, "numpy file"), path.open("rb") as file:
        content = np.load(file, allow_pickle=False)
        if isinstance(content, np.ndarray):
            name = "" if content.dtype.names else path.stem
            arrays = with_fields(name, content)
        else:
            with content:
                check_unpacked(path, sum(member.file_size for member in content.zip.infolist()))
                arrays = [a for name in content.files for a in with_fields(name, content[name])]
    return columns_of(path, "numpy file", arrays, wanted)
