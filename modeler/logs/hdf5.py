"""HDF5 files as columns; datasets stay on disk until they are asked for."""

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from modeler.core.errors import DataError
from modeler.core.files import check_unpacked
from modeler.logs.arrays import Held, columns_of, with_fields
from modeler.logs.columns import Columns, Wanted, missing_package, reading

_UNITS = ("units", "unit", "Units", "Unit")  # attributes in use


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
