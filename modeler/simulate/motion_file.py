"""A commanded motion from a file: what `modeler excite` writes, or a log's commands."""

import io
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.csv as pacsv
import pyarrow.parquet as pq
from scipy.interpolate import BPoly, make_interp_spline

from modeler.core.errors import DataError
from modeler.core.files import check_unpacked, read_file
from modeler.simulate.trajectory import Reference

_DEGREE = 5  # of the spline through positions where derivatives are not given
_LARGEST = 2**30  # bytes
_FEWEST = _DEGREE + 1  # samples


def read_motion(path: str | Path, joints: Sequence[str]) -> Reference:
    """The motion of a CSV or Parquet file, with its own samples.

    Columns by name: time, positions qc1.. (commanded) or else q1.., and qd1.., qdd1.. where all
    joints have them; else the derivatives of a spline of degree five through the positions.

    Args:
        path: .csv or .parquet.
        joints: names, in the order of the columns that are given back.

    Raises:
        DataError: no such file, a column that is missing or not a finite number, time that does
            not increase, too few samples.
    """
    path = Path(path)
    table = _table(path)
    time = _column(table, path, "time")
    if len(time) < _FEWEST:
        raise DataError(f"{path}: got {len(time)} samples; expected {_FEWEST} or more")
    if not np.all(np.diff(time) > 0.0):
        row = int(np.argmin(np.diff(time) > 0.0)) + 2
        raise DataError(f"{path}, row {row}: time does not increase; expected seconds in order")
    prefix = "qc" if all(f"qc{joint}" in table.column_names for joint in joints) else "q"
    path_of = {
        p: np.column_stack([_column(table, path, f"{p}{joint}") for joint in joints])
        for p in (prefix, "qd", "qdd")
        if p == prefix or (prefix == "q" and f"{p}{joints[0]}" in table.column_names)
    }
    q = path_of[prefix]
    if {"qd", "qdd"} <= path_of.keys():
        return Reference(time - time[0], q, path_of["qd"], path_of["qdd"])
    spline = make_interp_spline(time, q, k=_DEGREE)
    return Reference(time - time[0], q, spline.derivative()(time), spline.derivative(2)(time))


def at_rate(motion: Reference, rate: float) -> Reference:
    """The motion at other samples: polynomials of degree five that meet all that is given."""
    ends = np.stack([motion.q, motion.qd, motion.qdd], axis=1)
    curve = BPoly.from_derivatives(motion.time, ends)
    count = int(np.floor(motion.time[-1] * rate + 1e-9)) + 1
    time = np.arange(count) / rate
    at = np.minimum(time, motion.time[-1])
    return Reference(time, curve(at), curve.derivative()(at), curve.derivative(2)(at))


def _table(path: Path) -> pa.Table:
    try:
        content = read_file(path, _LARGEST)
    except OSError as error:
        raise DataError(
            f"{path}: cannot be read ({error.strerror}); expected the file of a motion, or "
            "exciting or point-to-point"
        ) from None
    if path.suffix not in (".parquet", ".csv"):
        raise DataError(f"{path}: got suffix {path.suffix or '(none)'}; expected .csv or .parquet")
    try:
        if path.suffix == ".parquet":
            file = pq.ParquetFile(io.BytesIO(content))
            check_unpacked(path, 8 * file.metadata.num_rows * file.metadata.num_columns)
            return file.read()
        one_by_one = pacsv.ReadOptions(use_threads=False)  # which knows the row of an error
        return pacsv.read_csv(io.BytesIO(content), one_by_one)
    except (pa.ArrowException, OSError) as error:
        first, table = (
            str(error).splitlines()[0],
            "CSV" if path.suffix == ".csv" else "Parquet file",
        )
        raise DataError(
            f"{path}: cannot be read as a table of columns ({first}); correct it, or write the "
            f"{table} again"
        ) from None


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _column(table: pa.Table, path: Path, name: str) -> np.ndarray:
    if name not in table.column_names:
        raise DataError(
            f"{path}: no column {name}; got {', '.join(table.column_names[:12])}; expected time "
            "and q of every joint of the robot"
        )
    column = table[name].combine_chunks()
    if not len(column):
        raise DataError(f"{path}: got no rows; expected a motion of 6 samples or more")
    if pa.types.is_string(column.type):
        row = next((i for i, text in enumerate(column.to_pylist()) if not _is_number(text)), 0)
        raise DataError(
            f"{path}, row {row + 2}: {name} is {str(column[row])[:40]!r}; expected a number"
        )
    if not (pa.types.is_floating(column.type) or pa.types.is_integer(column.type)):
        raise DataError(f"{path}, column {name}: got {column.type}; expected numbers")
    values = column.cast(pa.float64()).to_numpy(zero_copy_only=False)
    if not np.all(np.isfinite(values)):
        row = int(np.argmax(~np.isfinite(values))) + 2
        raise DataError(f"{path}, row {row}: {name} is empty or not finite; expected a number")
    return values
