"""Which reader a file is for, by its ending."""

from collections.abc import Callable, Mapping
from pathlib import Path

from modeler.core.errors import DataError
from modeler.logs.arrays import read_hdf5, read_mat, read_numpy
from modeler.logs.bags import read_bag
from modeler.logs.blocks import read_csv, read_dataset, read_parquet
from modeler.logs.columns import ColumnRequest, Columns
from modeler.logs.datasets import INFO
from modeler.logs.dialect import TEXTS
from modeler.logs.folders import read_files
from modeler.logs.sheets import read_sheets

_READERS: Mapping[str, Callable[[Path, ColumnRequest], Columns]] = {
    ".parquet": read_parquet, **dict.fromkeys(TEXTS, read_csv), ".xlsx": read_sheets,
    ".mat": read_mat, ".h5": read_hdf5, ".hdf5": read_hdf5, ".mcap": read_bag, ".db3": read_bag,
    ".bag": read_bag, ".npz": read_numpy, ".npy": read_numpy,
}  # fmt: skip

BAG = "metadata.yaml"
"""The file that makes a folder a ROS 2 bag."""


def read_columns(path: Path, wanted: ColumnRequest) -> Columns:
    """The columns of a file, of the folder of a ROS 2 bag or a dataset, or of several files.

    Raises:
        DataError: there is none, its ending is unknown, its package is missing, or it is damaged.
    """
    try:
        path.stat()
    except FileNotFoundError:
        pass  # told below
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
    places = {key: path / end if path.is_dir() else Path(f"{path}{end}")
              for key, end in files.items()}  # fmt: skip
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
        return read_dataset(path, wanted)
    files = [p for p in sorted(path.iterdir()) if p.suffix.lower() in _READERS and p.is_file()
             and not p.name.startswith(".")]  # fmt: skip
    if not files:
        raise DataError(
            f"{path}: is a folder without {BAG}, {INFO} or logs; expected a log, the folder of a "
            "ROS 2 bag or a dataset, or a folder with a file for each quantity or joint"
        )
    return read_files(dict.fromkeys(files, ""), path, read_columns)
