"""Which reader a file is for, by its ending."""

from collections.abc import Callable, Mapping
from pathlib import Path

from modeler.core.errors import DataError
from modeler.logs.arrays import read_hdf5, read_mat, read_numpy
from modeler.logs.bags import read_bag
from modeler.logs.blocks import read_csv, read_parquet
from modeler.logs.columns import Columns, Wanted

_READERS: Mapping[str, Callable[[Path, Wanted], Columns]] = {
    ".parquet": read_parquet, ".csv": read_csv, ".mat": read_mat, ".h5": read_hdf5,
    ".hdf5": read_hdf5, ".mcap": read_bag, ".db3": read_bag, ".bag": read_bag, ".npz": read_numpy,
    ".npy": read_numpy,
}  # fmt: skip

BAG = "metadata.yaml"
"""The file that makes a folder a ROS 2 bag."""


def read_columns(path: Path, wanted: Wanted) -> Columns:
    """The columns of a file, or of the folder of a ROS 2 bag.

    Raises:
        DataError: there is none, its ending is unknown, its package is missing, or it is damaged.
    """
    try:
        path.stat()
    except FileNotFoundError:
        pass  # told below
    except OSError as error:
        raise DataError(f"{path}: cannot be read ({error.strerror}); check the path") from None
    if path.is_dir():
        if not (path / BAG).is_file():
            raise DataError(
                f"{path}: is a folder without {BAG}; expected a log, or the folder of a ROS 2 bag"
            )
        return read_bag(path, wanted)
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
