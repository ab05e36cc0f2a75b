"""MAT files of MATLAB as columns: arrays, and fields of structs as `data.q[1]`."""

import os
import struct
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from modeler.core.files import check_unpacked
from modeler.logs.arrays import Held, columns_of
from modeler.logs.columns import Columns, Wanted, reading
from modeler.logs.hdf5 import read_mat73

_HDF5 = b"\x89HDF\r\n\x1a\n"
_DEEPEST = 20  # structs in structs
_PIECE = 2**24  # bytes that are unpacked at a time, to be counted


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
