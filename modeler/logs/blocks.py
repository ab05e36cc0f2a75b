"""Files that are read block by block of rows, so that one of any length fits in memory."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np
import pyarrow as pa
import pyarrow.parquet

from modeler.core.errors import DataError
from modeler.logs.arrow import arrow_columns, opened, told
from modeler.logs.columns import Columns, Values
from modeler.logs.csv_blocks import CsvBlocks
from modeler.logs.unchanged import State, check_unchanged, state_of

_BYTES = 1 << 20  # of a file at a time


class Blocks(Protocol):
    """A file as consecutive blocks of rows."""

    @property
    def rows(self) -> int:
        """Rows of the file; of a CSV file about as many."""

    def blocks(self, size: int, names: Sequence[str] = ()) -> Iterator[Columns]:
        """All rows in their order, about `size` at a time.

        Args:
            size: rows of a block.
            names: of the columns that are wanted; all without any.

        Raises:
            DataError: the file is damaged, or was written to while it was read.
        """

    def window(self, share: float, size: int, names: Sequence[str] = ()) -> Columns:
        """Up to `size` consecutive rows from about a share of the file on.

        Raises:
            DataError: the file is damaged there.
        """


def blocks_of(path: Path) -> Blocks | None:
    """The blocks of a Parquet or CSV file; None of a format that is read whole.

    Raises:
        DataError: the file is damaged.
    """
    if not path.is_file() or path.stat().st_size == 0:
        return None
    kind = path.suffix.lower()
    if kind == ".parquet":
        return ParquetBlocks(path)
    if kind == ".csv":
        return CsvBlocks(path)
    return None


def windows_of(blocks: Blocks, count: int, size: int) -> Columns:
    """Windows spread over a file, one after the other; columns that hold numbers in all of them."""
    found = [dict(blocks.window((k + 0.5) / count, size).columns) for k in range(count)]
    values = tuple(
        (name, Values(np.concatenate([own[name].numbers() for own in found])))
        for name in found[0]
        if all(own[name].numeric for own in found)
    )
    return Columns(values, len(values[0][1].values) if values else 0)


@dataclass(frozen=True, eq=False)
class _Group:
    """One row group: its place in the file, and the rows before it and up to its end."""

    place: int
    start: int
    stop: int


class ParquetBlocks:
    """The row groups of a Parquet file, decoded one after the other."""

    def __init__(self, path: Path) -> None:
        self._path, self._state = path, state_of(path)
        self._groups: list[_Group] = []
        with told(path, "PARQUET"):
            meta = self._open().metadata
            for place in range(meta.num_row_groups):
                start = self.rows
                self._groups.append(_Group(place, start, start + meta.row_group(place).num_rows))

    @property
    def rows(self) -> int:
        """Of the file."""
        return self._groups[-1].stop if self._groups else 0

    @property
    def state(self) -> State:
        """Of the file when it was opened."""
        return self._state

    def blocks(self, size: int, names: Sequence[str] = ()) -> Iterator[Columns]:
        """All rows in their order, `size` at a time."""
        read = 0
        for table in self._read(self._groups, size, names):
            yield arrow_columns(table, read)
            read += table.num_rows
        check_unchanged(self._path, self._state)

    def window(self, share: float, size: int, names: Sequence[str] = ()) -> Columns:
        """Up to `size` rows from about a share of the file on."""
        start = max(0, min(int(share * self.rows), self.rows - size))
        at = next((k for k, group in enumerate(self._groups) if start < group.stop), 0)
        parts, rows, skip = list[pa.Table](), 0, start - self._groups[at].start
        for table in self._read(self._groups[at:], size, names):
            taken = table.slice(min(skip, table.num_rows), size - rows)
            skip -= min(skip, table.num_rows)
            parts.append(taken)
            rows += taken.num_rows
            if rows >= size:
                break
        return arrow_columns(pa.concat_tables(parts), start)

    def _open(self) -> pa.parquet.ParquetFile:
        return opened(self._path, buffer_size=_BYTES, pre_buffer=False)

    def _read(
        self, groups: Sequence[_Group], size: int, names: Sequence[str]
    ) -> Iterator[pa.Table]:
        read = groups[0].start if groups else 0
        places = [group.place for group in groups]
        try:
            file = self._open()
            for batch in file.iter_batches(size, row_groups=places, columns=list(names) or None):
                yield pa.Table.from_batches([batch])
                read += batch.num_rows
        except (pa.ArrowException, OSError) as error:
            check_unchanged(self._path, self._state)
            words = str(error).strip().split("\n")[0]
            raise DataError(
                f"{self._path}: cannot be read as PARQUET beyond row {read} ({words}); copy it "
                "again, or write what can be read of it to a new file"
            ) from None
