"""Arrays by name, as MAT, HDF5 and numpy files hold them, as columns; numpy files."""

import dataclasses
import itertools
import math
import os
import re
import struct
import zlib
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from modeler.core.errors import DataError
from modeler.core.files import UNPACKED, check_unpacked_size
from modeler.logs.columns import (
    Column,
    ColumnRequest,
    Columns,
    NotNumericError,
    join_stamps,
    make_package_error,
    wrap_read_errors,
)
from modeler.logs.guess import guess_role
from modeler.logs.thresholds import THRESHOLDS

LEAST_ROWS = 10
"""A log of fewer rows carries no motion: fifth of a second at the slowest usual rate."""

_EPISODE = re.compile(r"(|.*?[./])([A-Za-z_]*)(\d+)[./](.+)", re.DOTALL)
_EPISODES = re.compile(
    r"(?i)(?:demo|demonstration|episode|ep|traj|trajectory|rollout|run|trial|sequence|seq)_?$"
)
_RATES = ("fs", "fps", "rate", "sample_rate", "samplerate", "sampling_rate", "f_s")
_STEPS = ("ts", "dt", "sample_time", "sampletime", "delta_t", "t_s")


@dataclass(frozen=True, eq=False)
class NamedArray:
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
        """Returns the shape as the user wrote it."""
        return tuple(self.data.shape[::-1] if self.flipped else self.data.shape)


@dataclass(frozen=True, eq=False)
class _SlicedColumn(Column):
    """One column of an array; `values` reads one, and keeps the last: its columns follow."""

    values: Callable[[NamedArray], np.ndarray]
    array: NamedArray
    index: int
    across: bool  # rows of the array are the columns

    @property
    def is_numeric(self) -> bool:
        return self.array.data.dtype.kind in "iuf"

    def read_numbers(self) -> np.ndarray:
        if not self.is_numeric:
            raise NotNumericError(
                f" holds {self.array.data.dtype}; expected numbers; write it as floating point"
            )
        values = self.values(self.array)
        if values.ndim == 2:
            values = values[self.index] if self.across else values[:, self.index]
        return np.array(values, dtype=float).reshape(-1)


def build_columns(
    path: Path,
    what: str,
    arrays: Sequence[NamedArray],
    wanted: ColumnRequest,
    notes: Sequence[str] = (),
) -> Columns:
    """Returns the columns of arrays: (n,) one, (n, k) and (k, n) k of them, `name[1]` to `name[k]`.

    n is the length that most arrays share; the others are left out, and reported.

    Raises:
        DataError: no such group, or nothing that could be a log.
    """
    arrays = _select_group(path, arrays, wanted)
    arrays, episodes = _concatenate_episodes(arrays)
    rows = _find_row_count(arrays)
    if rows is None:
        raise DataError(
            f"{path}: no array of {LEAST_ROWS} rows or more; expected the samples of a motion as "
            "arrays (n,) or (n, joints); it holds "
            f"{_join_names([_describe_array(a) for a in arrays])}"
        )

    @lru_cache(maxsize=1)
    def read_values(held: NamedArray) -> np.ndarray:
        with wrap_read_errors(path, what):
            content = np.asarray(held.data[()])
        return content.T if held.flipped else content

    array_columns = list[tuple[str, Column]]()
    units, left = dict[str, str](), list[str]()
    for held in arrays:
        slices = _slice_columns(read_values, held, rows)
        if not slices:
            left.append(_describe_array(held))
        array_columns += slices
        units |= {name: held.unit for name, _ in slices if held.unit}
    omissions = [f"{_join_names(left)} left out: no columns of {rows} rows"] if left else []
    scalars = (a for a in arrays if math.prod(a.shape) == 1)
    single = ((a.name, a.data[()]) for a in scalars if _is_rate_name(a.name))
    columns, stamped, how = join_stamps(array_columns)
    units |= stamped
    how = (*episodes, *how)
    rate = _find_stated_rate(single)
    return Columns(columns, rows, units, (*notes, *omissions), rate=rate, reading_notes=how)


def _is_rate_name(name: str) -> bool:
    return re.split(r"[./]", name)[-1].lower() in (*_RATES, *_STEPS)


def _find_stated_rate(values: Iterable[tuple[str, Any]]) -> float | None:
    """Hz, of single values such as fs or dt."""
    for name, value in values:
        value = np.asarray(value)
        number = float(value.reshape(-1)[0]) if value.dtype.kind in "iuf" else 0
        if _is_rate_name(name) and 0.0 < number < math.inf:
            return number if re.split(r"[./]", name)[-1].lower() in _RATES else 1.0 / number
    return None


def _select_group(
    path: Path, arrays: Sequence[NamedArray], wanted: ColumnRequest
) -> list[NamedArray]:
    """The arrays inside the group that is requested, their names from there on."""
    topic = wanted.topic.strip("/")
    if not topic:
        return list(arrays)
    heads = (f"{topic}.", f"{topic}/")
    members = [a for a in arrays if a.name.startswith(heads)]
    members = [NamedArray(a.name[len(topic) + 1 :], a.data, a.unit, a.flipped) for a in members]
    if not members:
        groups = sorted({a.name[:i] for a in arrays for i, c in enumerate(a.name) if c in "./"})
        raise DataError(
            f"{path}: topic {wanted.topic}: no group of that name; the groups are "
            f"{_join_names(groups) or 'none'}"
        )
    return members


@dataclass(frozen=True, eq=False)
class _ConcatenatedArray:
    """Arrays along their first axis, one after the other; times go on from one to the next."""

    parts: Sequence[NamedArray]
    shape: tuple[int, ...]
    dtype: np.dtype

    def __getitem__(self, key: tuple[()]) -> np.ndarray:
        whole = [np.asarray(part.data[()]).astype(self.dtype) for part in self.parts]
        pairs = zip(whole, self.parts, strict=True)
        values = [episode.T if part.flipped else episode for episode, part in pairs]
        if guess_role(self.parts[0].name) == "time":
            longer = (episode for episode in values if episode.size > 1)
            for before, episode in itertools.pairwise(longer):
                if episode.flat[0] <= before.flat[-1]:
                    step = np.median(np.diff(before.reshape(-1)))
                    episode += (before.flat[-1] + step - episode.flat[0]).astype(episode.dtype)
        return np.concatenate(values)


def _concatenate_episodes(arrays: Sequence[NamedArray]) -> tuple[list[NamedArray], list[str]]:
    """The arrays, those of episodes one after the other, with `segment`; what is reported about it.

    `data/demo_0/q` and `data/demo_1/q` are `data/q`. Groups that only count are episodes if their
    rows differ: those of joints have the same.
    """
    groups: dict[str, dict[int, dict[str, NamedArray]]] = {}
    for array in arrays:
        if array.shape and (match := _EPISODE.fullmatch(array.name)):
            episodes = groups.setdefault(match[1] + match[2], {})
            named = episodes.setdefault(int(match[3]), {})
            named[match[1] + match[4]] = array
    for group, numbered in groups.items():
        episodes = dict(sorted(numbered.items()))
        rows = [
            Counter(a.shape[0] for a in named.values()).most_common(1)[0][0]
            for named in episodes.values()
        ]
        if len(rows) < 2 or not (_EPISODES.search(group) or len({*rows}) > 1):
            continue
        inside = {id(array) for named in episodes.values() for array in named.values()}
        made, left = [array for array in arrays if id(array) not in inside], list[str]()
        for name, first in episodes[min(episodes)].items():
            parts = [named[name] for named in episodes.values() if name in named]
            shape = first.shape[1:]
            if [part.shape for part in parts] == [(count, *shape) for count in rows]:
                whole = _ConcatenatedArray(parts, (sum(rows), *shape), first.data.dtype)
                made.append(NamedArray(name, whole, first.unit))
            else:
                left.append(name)
        made.append(NamedArray("segment", np.repeat([float(n) for n in episodes], rows)))
        return made, [
            f"{len(rows)} episodes, {group}{min(episodes)} to {max(episodes)}, one after the other "
            "as segments; --map topic=GROUP takes one",
            *[f"{_join_names(left)} left out: not alike in all episodes"] * bool(left),
        ]
    return [*arrays], []


def _find_row_count(arrays: Sequence[NamedArray]) -> int | None:
    """The length that most arrays have along an axis; of two the longer."""
    small = (a for a in arrays if len(a.shape) in (1, 2))
    counts = Counter(n for a in small for n in set(a.shape) if n >= LEAST_ROWS)
    return max(counts, key=lambda n: (counts[n], n), default=None)


def _slice_columns(
    values: Callable[[NamedArray], np.ndarray], held: NamedArray, rows: int
) -> list[tuple[str, Column]]:
    shape = held.shape
    if shape in ((rows,), (rows, 1), (1, rows)):
        return [(held.name, _SlicedColumn(values, held, 0, shape == (1, rows)))]
    if len(shape) != 2 or rows not in shape:
        return []
    across = shape[0] != rows
    count = shape[0] if across else shape[1]
    return [(f"{held.name}[{k + 1}]", _SlicedColumn(values, held, k, across)) for k in range(count)]


def expand_fields(name: str, data: Any, **more: Any) -> list[NamedArray]:
    """Returns an array, or those of its fields where its rows are records."""
    if data.dtype.names is None:
        return [NamedArray(name, data, **more)]
    head = f"{name}." if name else ""
    fields = data.dtype.names
    return [NamedArray(f"{head}{x}", _MatField(data, x), **more) for x in fields]


@dataclass(frozen=True, eq=False)
class _MatField:
    """One field of an array of records, which may be on disk still."""

    data: Any
    field: str

    @property
    def shape(self) -> tuple[int, ...]:
        return (*self.data.shape, *self.data.dtype[self.field].shape)

    @property
    def dtype(self) -> np.dtype:
        kind: np.dtype = self.data.dtype[self.field]
        return kind.base

    def __getitem__(self, key: tuple[()]) -> np.ndarray:
        return np.asarray(self.data[self.field])


def _describe_array(held: NamedArray) -> str:
    return f"{held.name} ({' x '.join(map(str, held.shape)) or '1 value'})"


def _join_names(names: Sequence[str]) -> str:
    rest = len(names) - THRESHOLDS.max_listed_names
    more = f" and {rest} more" if rest > 0 else ""
    return ", ".join(names[: THRESHOLDS.max_listed_names]) + more


def read_numpy(path: Path, wanted: ColumnRequest) -> Columns:
    """Returns the columns of the arrays of an .npz file, or of the fields of an .npy file.

    Arrays of Python objects are refused: reading them would run what the file says.
    """
    with wrap_read_errors(path, "numpy file"), path.open("rb") as file:
        content = np.load(file, allow_pickle=False)
        if isinstance(content, np.ndarray):
            name = "" if content.dtype.names else path.stem
            arrays = expand_fields(name, content)
        else:
            with content:
                size = sum(member.file_size for member in content.zip.infolist())
                check_unpacked_size(path, size)
                arrays = [a for name in content.files for a in expand_fields(name, content[name])]
    return build_columns(path, "numpy file", arrays, wanted)


# MAT files of MATLAB, which are HDF5 files from 7.3 on, and HDF5 files, as columns.


_UNITS = ("units", "unit", "Units", "Unit")  # attributes in use

_HDF5 = b"\x89HDF\r\n\x1a\n"
_PIECE = 2**24  # bytes that are unpacked at a time, to be counted


@dataclass(frozen=True, eq=False)
class _StoredDataset:
    """A dataset on disk. The file is open only while it is read: it may be written anew."""

    path: Path
    name: str
    shape: tuple[int, ...]
    dtype: np.dtype
    kind: str  # that MATLAB gives it
    unit: str

    def __getitem__(self, key: Any) -> np.ndarray:
        import h5py

        with h5py.File(self.path, "r") as file:
            return np.asarray(file[self.name][key])


def read_hdf5(path: Path, wanted: ColumnRequest) -> Columns:
    """Returns the columns of all datasets, by their path: `arm/q[1]`.

    A `units` attribute is kept.
    """
    with wrap_read_errors(path, "HDF5"):
        stored = _list_datasets(path, "an HDF5 file")
        held = [held for one in stored for held in expand_fields(one.name, one, unit=one.unit)]
    return build_columns(path, "HDF5", held, wanted)


def read_mat73(path: Path, wanted: ColumnRequest) -> Columns:
    """Returns the columns of a MAT file of version 7.3: fields of structs as `data.q[1]`."""
    what, arrays, opaque = "MAT 7.3 file", list[NamedArray](), list[str]()
    with wrap_read_errors(path, what):
        for one in _list_datasets(path, "a MAT file of version 7.3"):
            if one.name.startswith("#"):
                continue  # what references point to
            if one.dtype.kind == "O" or one.kind in ("char", "cell"):
                opaque.append(one.name)
            else:
                arrays.append(NamedArray(one.name.replace("/", "."), one, one.unit, True))
    notes = [f"{', '.join(opaque[:8])} left out: cells, objects or text"] if opaque else []
    return build_columns(path, what, arrays, wanted, notes)


def _list_datasets(path: Path, what: str) -> list[_StoredDataset]:
    try:
        import h5py
    except ModuleNotFoundError:
        raise make_package_error(path, what, "h5py") from None
    datasets = list[_StoredDataset]()

    def visit(name: str, item: Any) -> None:
        """Lists the datasets; refuses what lies in other files."""
        if isinstance(item, h5py.Group):
            for key in item:
                if isinstance(link := item.get(key, getlink=True), h5py.ExternalLink):
                    raise _describe_external_link(path, f"{name}/{key}".strip("/"), link.filename)
        elif item.external:
            raise _describe_external_link(path, name, item.external[0][0])
        elif item.is_virtual and (outside := {s.file_name for s in item.virtual_sources()} - {"."}):
            raise _describe_external_link(path, name, min(outside))
        elif item.shape is not None:
            unit = next((_decode_text(item.attrs[u]) for u in _UNITS if u in item.attrs), "")
            kind = _decode_text(item.attrs.get("MATLAB_class", ""))
            datasets.append(_StoredDataset(path, name, item.shape, item.dtype, kind, unit))
            _check_chunks(path, item)

    with h5py.File(path, "r") as file:
        visit("", file)
        file.visititems(visit)
    sizes = [math.prod(one.shape) * one.dtype.itemsize for one in datasets]
    check_unpacked_size(path, max(sizes, default=0))  # they are read one by one
    return datasets


def _check_chunks(path: Path, item: Any) -> None:
    """Refuse chunks that have no room, or are packed by zlib from more than they state."""
    if item.chunks is None:
        return
    size = math.prod(item.chunks) * item.dtype.itemsize
    check_unpacked_size(path, size)
    for at in range(item.id.get_num_chunks()) if item.compression == "gzip" else ():
        chunk = item.id.get_chunk_info(at)
        if chunk.filter_mask or chunk.size * THRESHOLDS.max_deflate_ratio <= UNPACKED:
            continue
        packed = item.id.read_direct_chunk(chunk.chunk_offset)[1]
        length, unpacking = 0, zlib.decompressobj()
        while not unpacking.eof and packed:
            length += len(unpacking.decompress(packed, _PIECE))
            packed = unpacking.unconsumed_tail
            if length > size + THRESHOLDS.max_filter_bytes:
                raise ValueError("a chunk unpacks to more than it states")


def _describe_external_link(path: Path, name: str, place: str) -> DataError:
    return DataError(
        f"{path}: {name} lies in another file, {place}; expected all data in the log "
        "itself, for what a file names may be anybody's; copy them into one (h5repack, h5copy)"
    )


def _decode_text(value: Any) -> str:
    return value.decode(errors="replace") if isinstance(value, bytes) else str(value)


def read_mat(path: Path, wanted: ColumnRequest) -> Columns:
    """Returns the columns of a MAT file, versions 4 to 7, and 7.3 where h5py is installed."""
    with wrap_read_errors(path, "MAT file"), path.open("rb") as file:
        header = file.read(520)
    if header.startswith((b"MATLAB 7.3", _HDF5)) or _HDF5 in header:
        return read_mat73(path, wanted)
    import scipy.io  # only here: other logs need not wait for it

    with wrap_read_errors(path, "MAT file"):
        _check_size(path)
        content = scipy.io.loadmat(path, simplify_cells=True)
        arrays, other = [], []
        for name, value in _list_values(content):
            if isinstance(value, np.ndarray) and value.dtype.kind in "iufb":
                arrays.append(NamedArray(name, value))
            elif np.asarray(value).dtype.kind in "OV":
                other.append(name)
    notes = []
    if other:
        notes.append(
            f"{', '.join(other[:8])} left out: an object that only MATLAB reads; of a timeseries, "
            "save its Time and Data"
        )
    columns = build_columns(path, "MAT file", arrays, wanted, notes)
    single = ((n, v) for n, v in _list_values(content) if isinstance(v, int | float | np.number))
    return dataclasses.replace(columns, rate=columns.rate or _find_stated_rate(single))


def _check_size(path: Path) -> None:
    """Refuse variables of a file of version 5 to 7 that have no room (other versions pack nothing).

    A variable is a tag, type and length of 32 bits, and its data; type 15 is packed by zlib.
    Mathworks, "MAT-file format" (R2019b), section 1.
    """
    size = 0
    with path.open("rb") as file:
        order = {b"IM": "<", b"MI": ">"}.get(file.read(128)[126:])
        while order and len(tag := file.read(8)) == 8:
            kind, length = struct.unpack(f"{order}II", tag)
            if kind != 15:
                file.seek(length, os.SEEK_CUR)
                continue
            unpacking, data = zlib.decompressobj(), file.read(length)
            while data and not unpacking.eof:
                size += len(unpacking.decompress(data, _PIECE))
                data = unpacking.unconsumed_tail
                check_unpacked_size(path, size)


def _list_values(content: Any, name: str = "", depth: int = 0) -> Iterator[tuple[str, Any]]:
    """Every value and its name: fields after a point, entries of lists counted from 1."""
    if depth > THRESHOLDS.max_struct_depth:
        return
    if isinstance(content, dict):
        for key, value in content.items():
            if isinstance(key, str) and not key.startswith("__"):
                yield from _list_values(value, f"{name}.{key}" if name else key, depth + 1)
    elif isinstance(content, list) or (
        isinstance(content, np.ndarray) and content.dtype.kind == "O" and content.ndim == 1
    ):
        for i, value in enumerate(content):
            yield from _list_values(value, f"{name}[{i + 1}]", depth + 1)
    else:
        yield name, content
