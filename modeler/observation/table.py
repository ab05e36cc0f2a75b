"""A Parquet or CSV file as named columns of floats, or a DataError that says what is wrong."""

import re
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.csv
import pyarrow.parquet

from modeler.core.errors import DataError
from modeler.observation.csv_text import check_csv

_TINY, _HUGE = 1e-100, 1e100  # in any unit; squares of what is beyond are no numbers any more

LEAST_ROWS = 10
"""A log of fewer rows carries no motion: fifth of a second at the slowest usual rate."""


class Table:
    """The columns of one file; numbers are converted when they are asked for."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._table = _load(path)
        self.names: tuple[str, ...] = tuple(_bare(name) for name in self._table.column_names)
        self.rows: int = self._table.num_rows
        self._check()

    def _check(self) -> None:
        twice = sorted({name for name in self.names if self.names.count(name) > 1})
        if twice:
            raise DataError(
                f"{self.path}: column {twice[0]} appears {self.names.count(twice[0])} times; "
                "keep one of them"
            )
        if self.rows < LEAST_ROWS:
            raise DataError(
                f"{self.path}: {self.rows} rows; expected at least {LEAST_ROWS}; record a "
                "longer motion"
            )

    def __contains__(self, name: str) -> bool:
        return name in self.names

    def is_numeric(self, name: str) -> bool:
        """True if the column holds numbers (or nothing at all)."""
        kind = self._table.column(self.names.index(name)).type
        return (
            pa.types.is_integer(kind)
            or pa.types.is_floating(kind)
            or pa.types.is_decimal(kind)
            or pa.types.is_null(kind)
        )

    def numbers(self, name: str) -> np.ndarray:
        """The column as floats, (rows,); null, NaN and infinite entries are NaN.

        Raises:
            DataError: the column is missing or holds something else than numbers.
        """
        if name not in self.names:
            raise DataError(
                f"{self.path}: no column {name}; the columns are {', '.join(self.names[:40])}; "
                "add it or rename the one that holds it"
            )
        column = self._table.column(self.names.index(name))
        if not self.is_numeric(name):
            raise DataError(self._not_a_number(name, column))
        values = np.array(pc.cast(column, pa.float64(), safe=False).to_numpy(), dtype=float)
        values[~np.isfinite(values)] = np.nan
        return values

    def measured(self, name: str) -> np.ndarray:
        """The same of something that was measured: specks are 0, what is beyond all measure NaN."""
        values = self.numbers(name)
        values[np.abs(values) < _TINY] = 0.0
        values[np.abs(values) > _HUGE] = np.nan
        return values

    def _not_a_number(self, name: str, column: pa.ChunkedArray) -> str:
        if pa.types.is_string(column.type) or pa.types.is_large_string(column.type):
            for row, value in enumerate(column.to_pylist(), start=1):
                try:
                    float(value if value is not None else "nan")
                except ValueError:
                    return (
                        f'{self.path}: column {name}, row {row}: got "{value}"; expected a '
                        f"number{_with_point(value)}; correct it, or leave the entry empty if the "
                        "measurement is missing"
                    )
        return (
            f"{self.path}: column {name} holds {column.type}; expected numbers; "
            "write the column as floating point"
        )


def _with_point(value: str) -> str:
    return " with a decimal point" if re.fullmatch(r"\s*[+-]?\d*,\d+\s*", value) else ""


def _bare(name: str) -> str:
    """A column name without blanks and quotes around it: `"time", "q1"` leaves both."""
    name = name.strip()
    if len(name) > 1 and name[0] == name[-1] and name[0] in "\"'":
        name = name[1:-1].strip()
    return name


def _read_csv(path: Path) -> pa.Table:
    """The table of a CSV file; an error of one row names it."""
    try:
        return pa.csv.read_csv(path)
    except pa.ArrowInvalid:
        # Rows are counted only where one thread reads all.
        return pa.csv.read_csv(path, pa.csv.ReadOptions(use_threads=False))


def _load(path: Path) -> pa.Table:
    suffix = path.suffix.lower()
    if suffix not in (".csv", ".parquet"):
        raise DataError(
            f"{path}: a log ends in .parquet or .csv, got "
            f'"{path.suffix or "no suffix"}"; convert or rename it'
        )
    if path.is_dir():
        raise DataError(f"{path}: is a folder; expected a log, a .parquet or .csv file")
    if not path.is_file():
        raise DataError(f"{path}: there is no such file; check the path")
    if path.stat().st_size == 0:
        raise DataError(f"{path}: the file is empty; record or copy it again")
    try:
        if suffix == ".csv":
            check_csv(path)
            return _read_csv(path)
        return pa.parquet.ParquetFile(path).read()  # read_table refuses names that stand twice
    except (pa.ArrowException, OSError) as error:
        words = str(error).strip().split("\n")[0]
        raise DataError(
            f"{path}: cannot be read as {suffix[1:].upper()} ({words}); write the file again"
        ) from None
