"""A log as blocks of rows: a file of any length, or a log that is in memory already."""

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from modeler.core.contract import ModuleSpec
from modeler.core.errors import DataError
from modeler.logs import LogMap, Table
from modeler.logs.blocks import Blocks, ParquetBlocks, blocks_of
from modeler.logs.table import Part
from modeler.observation.log import Log
from modeler.observation.read import backwards, log_of, needed

_FIRST = 1000  # rows that tell which columns a file has


class Source(Protocol):
    """Rows of one log, read when they are wanted."""

    @property
    def name(self) -> str:
        """Of the file."""

    @property
    def rows(self) -> int:
        """How many; of a CSV file about as many."""

    @property
    def content(self) -> str:
        """Fingerprint of the whole file; "" if nobody has taken it yet."""

    def blocks(self, size: int) -> Iterator[Log]:
        """All rows in their order, about `size` at a time.

        Raises:
            DataError: the log is damaged, or its time does not increase.
        """

    def window(self, share: float, size: int) -> Log:
        """Up to `size` consecutive rows from about a share of the log on."""


class FileSource:
    """A Parquet or CSV file."""

    def __init__(
        self, path: Path, blocks: Blocks, spec: ModuleSpec, mapping: LogMap | None = None
    ) -> None:
        """Looks at the first rows: which columns there are.

        Raises:
            DataError: the file is damaged, or lacks a column.
        """
        self._path, self._blocks, self._spec, self._mapping = path, blocks, spec, mapping
        table = self._table(Part(blocks.window(0.0, _FIRST)))
        self._notes = log_of(table, spec).notes
        self._names = needed(table, spec)

    @property
    def name(self) -> str:
        """Of the file."""
        return self._path.name

    @property
    def place(self) -> tuple[Path, LogMap | None]:
        """The file, and whose column is which: what makes this source again elsewhere."""
        return self._path, self._mapping

    @property
    def exact(self) -> bool:
        """True if a window begins at the very row that its share means."""
        return isinstance(self._blocks, ParquetBlocks)

    @property
    def rows(self) -> int:
        """Of the file."""
        return self._blocks.rows

    @property
    def content(self) -> str:
        """Not known before all rows are read."""
        return ""

    def blocks(self, size: int) -> Iterator[Log]:
        """All rows in their order."""
        before, last, warm = 0, -np.inf, dict[str, float]()
        for columns in self._blocks.blocks(size, self._names):
            table = self._table(Part(columns, before))
            log = log_of(table, self._spec)
            if log.time[0] <= last:
                raise backwards(table, before, last, float(log.time[0]))
            before, last = before + log.rows, float(log.time[-1])
            yield dataclasses.replace(log, notes=self._notes, extra=_carried(log, warm))

    def window(self, share: float, size: int) -> Log:
        """Some rows, as a log."""
        columns = self._blocks.window(share, size, self._names)
        log = log_of(self._table(Part(columns, int(share * self.rows))), self._spec)
        return dataclasses.replace(log, notes=self._notes, extra=_carried(log, {}))

    def _table(self, part: Part) -> Table:
        return Table(self._path, self._mapping, self._spec.joints, part=part)


def _carried(log: Log, last: dict[str, float]) -> dict[str, np.ndarray]:
    """Slow columns without a value in these rows, with the last one before them."""
    found = {}
    for name, values in log.extra.items():
        if not np.isfinite(values).any():
            if name not in last:
                raise DataError(
                    f"{log.name}: {name} has no values from {log.time[0]:.6g} to "
                    f"{log.time[-1]:.6g} s; record it all the time, or drop the column"
                )
            values = np.full(len(values), last[name])
        last[name] = float(values[np.isfinite(values)][-1])
        found[name] = values
    return found


@dataclass(frozen=True, eq=False)
class MemorySource:
    """A log that is in memory."""

    log: Log

    @property
    def name(self) -> str:
        """Of the log."""
        return self.log.name

    @property
    def rows(self) -> int:
        """Of the log."""
        return self.log.rows

    @property
    def content(self) -> str:
        """That of the log."""
        return self.log.content

    def blocks(self, size: int) -> Iterator[Log]:
        """All rows in their order."""
        for first in range(0, self.rows, size):
            yield cut(self.log, slice(first, first + size))

    def window(self, share: float, size: int) -> Log:
        """Some rows."""
        first = max(0, min(int(share * self.rows), self.rows - size))
        return cut(self.log, slice(first, first + size))


def source_of(path: Path, spec: ModuleSpec, mapping: LogMap | None = None) -> FileSource | None:
    """The rows of a file that can be read in blocks; None of another format.

    Raises:
        DataError: the file is damaged, or lacks a column.
    """
    blocks = blocks_of(path)
    return None if blocks is None else FileSource(path, blocks, spec, mapping)


def joined(logs: Sequence[Log]) -> Log:
    """Consecutive rows of one log, put together."""
    return logs[0] if len(logs) == 1 else _joined(logs, _whole(logs, "segment"))


def windows_joined(logs: Sequence[Log]) -> Log:
    """Windows of one log, increasing in time, as a log whose segments they are."""
    numbers, first = [], 0
    for log in logs:
        own = np.zeros(log.rows, dtype=int)
        if log.segment is not None:
            own[1:] = np.cumsum(np.diff(log.segment) != 0)
        numbers.append(first + own)
        first = int(numbers[-1][-1]) + 1
    return _joined(logs, np.concatenate(numbers))


def _joined(logs: Sequence[Log], segment: np.ndarray | None) -> Log:
    columns = {name: _whole(logs, name) for name in ("time", "q", "tau", "qd", "qdd", "commanded")}
    extra = {name: np.concatenate([log.extra[name] for log in logs]) for name in logs[0].extra}
    missing: dict[str, int] = {}
    for log in logs:
        for name, count in log.missing.items():
            missing[name] = missing.get(name, 0) + count
    changed: dict[str, Any] = {**columns, "segment": segment, "extra": extra, "missing": missing}
    return dataclasses.replace(logs[0], **changed)


def _whole(logs: Sequence[Log], name: str) -> np.ndarray | None:
    found = [getattr(log, name) for log in logs]
    return None if any(values is None for values in found) else np.concatenate(found)


def cut(log: Log, rows: slice | np.ndarray) -> Log:
    """Some rows of a log: consecutive ones, or those of a mask (n,)."""

    def some(values: np.ndarray | None) -> np.ndarray | None:
        return None if values is None else values[rows]

    return dataclasses.replace(
        log,
        time=log.time[rows],
        q=log.q[rows],
        tau=log.tau[rows],
        qd=some(log.qd),
        qdd=some(log.qdd),
        commanded=some(log.commanded),
        segment=some(log.segment),
        extra={name: values[rows] for name, values in log.extra.items()},
    )
