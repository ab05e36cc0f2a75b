"""HDF5 files as columns; datasets stay on disk until they are asked for."""

from pathlib import Path
from typing import Any

from modeler.logs.arrays import Held, columns_of, with_fields
from modeler.logs.columns import Columns, Wanted, missing_package, reading

_UNITS = ("units", "unit", "Units", "Unit")  # attributes in use


def read_hdf5(path: Path, wanted: Wanted) -> Columns:
    """The columns of all datasets, by their path: `arm/q[1]`; a `units` attribute is kept."""
    with reading(path, "HDF5"):
        return columns_of(path, "HDF5", _datasets(_opened(path, "HDF5")), wanted)


def read_mat73(path: Path, wanted: Wanted) -> Columns:
    """The same of a MAT file of version 7.3: fields of structs as `data.q[1]`."""
    what = "MAT 7.3 file"
    with reading(path, what):
        found, opaque = [], []
        for held in _datasets(_opened(path, "a MAT file of version 7.3")):
            kind = held.data.attrs.get("MATLAB_class", b"") if hasattr(held.data, "attrs") else b""
            if held.name.startswith(("#", ".")) or "/#" in held.name:
                continue  # what references point to
            if held.data.dtype.kind == "O" or kind in (b"char", b"cell"):
                opaque.append(held.name)
                continue
            found.append(Held(held.name.replace("/", "."), held.data, held.unit, True))
        notes = [f"{', '.join(opaque[:8])} left out: cells, objects or text"] if opaque else []
        return columns_of(path, what, found, wanted, notes)


def _opened(path: Path, what: str) -> Any:
    try:
        import h5py
    except ImportError:
        raise missing_package(path, what, "h5py") from None
    return h5py.File(path, "r")


def _datasets(file: Any) -> list[Held]:
    """All datasets of a file; links to other files are not followed."""
    import h5py

    found: list[Held] = []

    def visit(name: str, item: Any) -> None:
        if isinstance(item, h5py.Dataset) and item.shape is not None:
            found.extend(with_fields(name, item, unit=_unit(item)))

    file.visititems(visit)
    return found


def _unit(item: Any) -> str:
    for name in _UNITS:
        if name in item.attrs:
            text = item.attrs[name]
            return text.decode(errors="replace") if isinstance(text, bytes) else str(text)
    return ""
