"""CSV files, block by block of whole lines."""

import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import pyarrow as pa
import pyarrow.csv

from modeler.logs.arrow import arrow_columns, bare, told
from modeler.logs.columns import Columns
from modeler.logs.csv_text import check_csv
from modeler.logs.unchanged import State, check_unchanged, state_of

_LINES = 200  # by whose length the rows of the file are counted


class CsvBlocks:
    """The lines of a CSV file; a block is parsed by itself, and its columns are what it holds."""

    def __init__(self, path: Path) -> None:
        self._path, self._state = path, state_of(path)
        with told(path, "CSV"):
            check_csv(path)
            with path.open("rb") as file:
                header = file.readline()
                while header and not header.strip():
                    header = file.readline()
                self._start = file.tell()
                lines = [line for _, line in zip(range(_LINES), file, strict=False) if line.strip()]
            self._names = pa.csv.read_csv(pa.py_buffer(header)).column_names
        self._line = max(1.0, sum(map(len, lines)) / max(1, len(lines)))  # bytes

    @property
    def rows(self) -> int:
        """About as many as the file has."""
        return round((self._state[0] - self._start) / self._line)

    @property
    def state(self) -> State:
        """Of the file when it was opened."""
        return self._state

    def blocks(self, size: int, names: Sequence[str] = ()) -> Iterator[Columns]:
        """All rows in their order, about `size` at a time."""
        read, rest = 0, b""
        with told(self._path, "CSV"), self._path.open("rb") as file:
            file.seek(self._start)
            while True:
                text = file.read(max(1, int(size * self._line)))
                end = text.rfind(b"\n") + 1
                if text and not end:
                    rest += text
                    continue
                whole, rest = (rest + text[:end], text[end:]) if text else (rest, b"")
                if whole.strip():
                    table = self._parsed(whole, names, read)
                    yield arrow_columns(table, read)
                    read += table.num_rows
                if not text:
                    break
        check_unchanged(self._path, self._state)

    def window(self, share: float, size: int, names: Sequence[str] = ()) -> Columns:
        """Up to `size` rows from about a share of the file on."""
        room = int(size * self._line)
        start = max(self._start, min(self._start + int(share * self._state[0]),
                                     self._state[0] - room))  # fmt: skip
        with told(self._path, "CSV"), self._path.open("rb") as file:
            file.seek(start - 1)
            file.readline()  # the line that begins before
            text = file.read(room)
            text += file.readline()
            return arrow_columns(self._parsed(text, names, 0))

    def _parsed(self, text: bytes, names: Sequence[str], before: int) -> pa.Table:
        """A table of whole lines; an error of one row names its place in the file."""
        wanted = [name for name in self._names if not names or bare(name) in names]
        convert = pa.csv.ConvertOptions(include_columns=wanted)
        try:
            return pa.csv.read_csv(
                pa.py_buffer(text), pa.csv.ReadOptions(column_names=self._names),
                convert_options=convert,
            )  # fmt: skip
        except pa.ArrowInvalid:
            # Rows are counted only where one thread reads all.
            options = pa.csv.ReadOptions(column_names=self._names, use_threads=False)
            try:
                return pa.csv.read_csv(pa.py_buffer(text), options, convert_options=convert)
            except pa.ArrowInvalid as error:
                check_unchanged(self._path, self._state)
                # As in a file that is read whole, the header is row 1.
                told_row = re.sub(r"Row #(\d+)", lambda m: f"Row #{int(m[1]) + before + 1}",
                                  str(error))  # fmt: skip
                raise pa.ArrowInvalid(told_row) from None
