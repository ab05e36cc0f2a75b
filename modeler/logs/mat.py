"""MAT files of MATLAB, which are HDF5 files from 7.3 on, and HDF5 files, as columns."""

import math
import os
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from modeler.core.errors import DataError
from modeler.core.files import check_unpacked
from modeler.logs.arrays import Held, columns_of, with_fields
from modeler.logs.columns import Columns, Wanted, missing_package, reading

_UNITS = ("units", "unit", "Units", "Unit")  # attributes in use

_HDF5 = b"\x89HDF\r\n\x1a\n"
_DEEPEST = 20  # structs in structs
_PIECE = 2**24  # bytes that are unpacked at a time, to be counted


@dataclass(frozen=True, eq=False)
class _Stored:
    """A dataset on disk. The file is open only while it is read: it may be written anew."""

    path: Path
    name: str
    shape: tuple[int, ...]
    dtype: np.dtype
    kind: str = ""  # that MATLAB gives it
    unit: str = ""

    def __getitem__(self, key: Any) -> np.ndarray:
        import h5py

        with h5py.File(self.path, "r") as file:
            return np.asarray(file[self.name][key])


@dataclass
class _Visitor:
    """Lists the datasets of a file; refuses what lies in other files."""

    path: Path
    found: list[_Stored] = field(default_factory=list)

    def __call__(self, name: str, item: Any) -> None:
        import h5py

        if isinstance(item, h5py.Group):
            for key in item:
                if isinstance(link := item.get(key, getlink=True), h5py.ExternalLink):
                    raise self._outside(f"{name}/{key}".strip("/"), link.filename)
        elif item.external:
            raise self._outside(name, item.external[0][0])
        elif item.is_virtual and (outside := {s.file_name for s in item.virtual_sources()} - {"."}):
            raise self._outside(name, min(outside))
        elif item.shape is not None:
            unit = next((_text(item.attrs[u]) for u in _UNITS if u in item.attrs), "")
            kind = _text(item.attrs.get("MATLAB_class", ""))
            self.found.append(_Stored(self.path, name, item.shape, item.dtype, kind, unit))

    def _outside(self, name: str, place: str) -> DataError:
        return DataError(
            f"{self.path}: {name} lies in another file, {place}; expected all data in the log "
            "itself, for what a file names may be anybody's; copy them into one (h5repack, h5copy)"
        )


def read_hdf5(path: Path, wanted: Wanted) -> Columns:
    """The columns of all datasets, by their path: `arm/q[1]`; a `units` attribute is kept."""
    with reading(path, "HDF5"):
        stored = _datasets(path, "an HDF5 file")
        held = [held for one in stored for held in with_fields(one.name, one, unit=one.unit)]
    return columns_of(path, "HDF5", held, wanted)


def read_mat73(path: Path, wanted: Wanted) -> Columns:
    """The same of a MAT file of version 7.3: fields of structs as `data.q[1]`."""
    what, found, opaque = "MAT 7.3 file", list[Held](), list[str]()
    with reading(path, what):
        for one in _datasets(path, "a MAT file of version 7.3"):
            if one.name.startswith("#"):
                continue  # what references point to
            if one.dtype.kind == "O" or one.kind in ("char", "cell"):
                opaque.append(one.name)
            else:
                found.append(Held(one.name.replace("/", "."), one, one.unit, True))
    notes = [f"{', '.join(opaque[:8])} left out: cells, objects or text"] if opaque else []
    return columns_of(path, what, found, wanted, notes)


def _datasets(path: Path, what: str) -> list[_Stored]:
    try:
        import h5py
    except ModuleNotFoundError:
        raise missing_package(path, what, "h5py") from None
    visitor = _Visitor(path)
    with h5py.File(path, "r") as file:
        visitor("", file)
        file.visititems(visitor)
    sizes = [math.prod(one.shape) * one.dtype.itemsize for one in visitor.found]
    check_unpacked(path, max(sizes, default=0))  # they are read one by one
    return visitor.found


def _text(value: Any) -> str:
    return value.decode(errors="replace") if isinstance(value, bytes) else str(value)


def read_mat(path: Path, wanted: Wanted) -> Columns:
    """The columns of a MAT file, versions 4 to 7, and 7.3 where h5py is installed."""
    with reading(path, "MAT file"), path.open("rb") as file:
        header = file.read(520)
    if header.startswith((b"MATLAB 7.3", _HDF5)) or _HDF5 in header:
        return read_mat73(path, wanted)
    import scipy.io  # only here: other logs need not wait for it

    with reading(path, "MAT file"):
        _check_size(path)
        content = scipy.io.loadmat(path, simplify_cells=True)
        found, other = [], []
        for name, value in _values(content):
            if isinstance(value, np.ndarray) and value.dtype.kind in "iufb":
                found.append(Held(name, value))
            elif np.asarray(value).dtype.kind in "OV":
                other.append(name)
    notes = []
    if other:
        notes.append(
            f"{', '.join(other[:8])} left out: an object that only MATLAB reads; of a timeseries, "
            "save its Time and Data"
        )
    return columns_of(path, "MAT file", found, wanted, notes)


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
                check_unpacked(path, size)


def _values(content: Any, name: str = "", depth: int = 0) -> Iterator[tuple[str, Any]]:
    """Every value and its name: fields after a point, entries of lists counted from 1."""
    if depth > _DEEPEST:
        return
    if isinstance(content, dict):
        for key, value in content.items():
            if isinstance(key, str) and not key.startswith("__"):
                yield from _values(value, f"{name}.{key}" if name else key, depth + 1)
    elif isinstance(content, list) or (
        isinstance(content, np.ndarray) and content.dtype.kind == "O" and content.ndim == 1
    ):
        for i, value in enumerate(content):
            yield from _values(value, f"{name}[{i + 1}]", depth + 1)
    else:
        yield name, content
