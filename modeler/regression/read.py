"""A log of any format as a `Log`, in the columns of the log format."""

import dataclasses
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from modeler.core.errors import DataError
from modeler.core.manifest import JointSpec, ModuleSpec
from modeler.logs import (
    Blocks,
    Columns,
    InMemory,
    LogMap,
    LogTable,
    ParquetBlocks,
    build_frame_columns,
    describe_coarse_clock,
    open_blocks,
)
from modeler.regression.log import MOST_WHOLE, Log, compute_fingerprint
from modeler.regression.thresholds import THRESHOLDS

_SHORTEST_STEP, _LONGEST_STEP = 1e-7, 1e7  # s; beyond, squares of it say nothing any more


def read_log(path: str | Path, spec: ModuleSpec, mapping: LogMap | None = None) -> Log:
    """Reads the `Log` of one file; columns `time`, `q<j>`, optional `qd<j> qdd<j> qc<j>`, `tau<j>`.

    The torque of a joint is `tau<j>` if the log has it, else `current<j>` times the drive gain of
    the robot file, else that of the current that `duty<j>` makes, (duty voltage - k_e qd) / R. A
    passive joint without `tau<j>` has torque 0.

    Args:
        path: a file of any format of `modeler.logs`.
        spec: the robot's manifest; it names the joints.
        mapping: names and units of the file's columns; without it they are ours and SI.

    Raises:
        DataError: the file cannot be read, or is too long to be read at once; a needed column is
            missing or not numeric, time does not increase, or no joint has a measured torque.
    """
    path = Path(path)
    blocks = open_blocks(path)
    if blocks is not None and blocks.rows > MOST_WHOLE:  # as far as it says before it is read
        raise DataError(
            f"{path}: got {blocks.rows} rows; expected at most {MOST_WHOLE} where all are in "
            "memory; give a part of it, FILE@START:END; `modeler log`, `diagnose`, `compare` of "
            "one model, and `fit` by weighted or ordinary least squares read logs of any length"
        )
    return read_whole_log(LogTable(path, mapping, spec.joints), spec)


def read_log_in_memory(
    data: InMemory, spec: ModuleSpec, mapping: LogMap | None = None, where: str = "log"
) -> Log:
    """Reads a frame or a dict of arrays as a `Log`; it is named after what it holds.

    Args:
        data: it.
        spec: the robot's manifest.
        mapping: names and units of its columns.
        where: what messages call it.

    Raises:
        DataError: as `read_log`.
    """
    log = read_whole_log(build_table(data, spec.joints, mapping, where), spec)
    return dataclasses.replace(log, name=f"frame {log.content[:6]}", path="")


def build_table(
    data: InMemory, joints: Sequence[JointSpec], mapping: LogMap | None, where: str
) -> LogTable:
    """Returns the columns of data in memory under our names, as the table of a log."""
    columns = build_frame_columns(data, where, joints)
    return LogTable(Path(where), mapping, joints, part=columns, whole=True)


def read_whole_log(table: LogTable, spec: ModuleSpec) -> Log:
    """Returns all rows of a log, with what only they can show.

    Raises:
        DataError: as `read_log`.
    """
    log = build_log(table, spec)
    ranges = ChannelRanges.compute_from(log)
    notes = (*log.notes, *ranges.collect_warnings(log.step, spec))
    ranges.check_values(table.path, spec)
    content = compute_fingerprint(log.time, log.q, log.tau)
    return dataclasses.replace(log, notes=notes, content=content)


def build_log(table: LogTable, spec: ModuleSpec, measured: bool = True) -> Log:
    """Returns the rows of a table as a log, each looked at by itself.

    Args:
        table: its columns.
        spec: the robot's manifest.
        measured: False of motion whose torques are not requested: all are missing.

    Raises:
        DataError: as `read_log` does, but for what only a whole log can show.
    """
    time = _read_time(table)
    reading_notes = [*table.reading_notes, *table.notes, *_check_induced_voltage(table, spec)]
    positions = []
    for joint in spec.joints:
        if f"q{joint.name}" not in table and not joint.actuated:
            raise DataError(
                f"{table.path}: no column {table.format_name(f'q{joint.name}')}: joint "
                f"{joint.name} of "
                f"{spec.robot} is passive and its position must be logged, or computed from the "
                "closed loops before; add the column"
            )
        positions.append(table.read_measured(f"q{joint.name}"))
    none = np.full(table.rows, np.nan), "not read", 0.0
    torques = [_read_torque(table, joint, spec) if measured else none for joint in spec.joints]
    return Log(
        name=table.path.name,
        joints=tuple(joint.name for joint in spec.joints),
        time=time,
        q=np.stack(positions).T,  # channels are contiguous
        tau=np.stack([values for values, _, _ in torques]).T,
        qd=_read_optional(table, "qd", spec, reading_notes),
        qdd=_read_optional(table, "qdd", spec, reading_notes),
        commanded=_read_optional(table, "qc", spec, reading_notes),
        segment=_read_segment(table),
        extra=_read_extra(table, spec, reading_notes),
        torque_source=tuple(source for _, source, _ in torques),
        notes=tuple(_check_duties(table, spec)),
        induced=tuple(k for *_, k in torques) if any(k for *_, k in torques) else (),
        path=str(table.path),
        reading_notes=tuple(reading_notes),
    )


def find_needed_columns(table: LogTable, spec: ModuleSpec) -> list[str]:
    """Returns the file's names of the columns that a fit of these joints reads."""
    used = _collect_names(spec) | {"time", "segment"}
    used -= {"time"} if table.rated else set()
    names = [name for name in table.names if name in used or name.startswith("temperature")]
    return [table.find_file_column(name) for name in names if table.is_numeric(name)]


def _read_time(table: LogTable) -> np.ndarray:
    time, name = table.read_numbers("time"), table.format_name("time")
    bad = np.flatnonzero(~np.isfinite(time))
    if bad.size:
        raise DataError(
            f"{table.path}: column {name}, row {table.before + bad[0] + 1}: no value; every row "
            "needs its time; delete the row or restore the time"
        )
    back = np.flatnonzero(np.diff(time) <= 0.0)
    if back.size:
        row = int(back[0]) + 1
        numeric = [name for name in table.names if name != "time" and table.is_numeric(name)]
        channels = (table.read_numbers(name) for name in numeric)
        if coarse := describe_coarse_clock(time, channels):
            raise DataError(f"{table.path}: column {name}, row {table.before + row + 1}: {coarse}")
        raise build_time_error(table, table.before + row, time[row - 1], time[row])
    step = float(np.median(np.diff(time))) if len(time) > 1 else 1.0
    if not _SHORTEST_STEP <= step <= _LONGEST_STEP:
        raise DataError(
            f"{table.path}: column {name}: median step of {step:.3g} s; expected "
            f"{_SHORTEST_STEP:g} to {_LONGEST_STEP:g} s; write the time in seconds, or map it "
            "with its unit"
        )
    return time


def build_time_error(table: LogTable, row: int, before: float, time: float) -> DataError:
    """Returns the error of a row, counted from 0, whose time is not after the one before it."""
    remedy = "sort the file, or split it where the clock restarts"
    if time == before:
        remedy = "delete rows written twice; if times are rounded, give the rate, --map rate=HZ"
    return DataError(
        f"{table.path}: column {table.format_name('time')}, row {row + 1}: {time:.9g} s after "
        f"{before:.9g} s; expected increasing time; {remedy}"
    )


def _read_torque(
    table: LogTable, joint: JointSpec, spec: ModuleSpec
) -> tuple[np.ndarray, str, float]:
    """Returns its torque, the source of that, and the torque per speed to be taken from it."""
    tau, current, duty = (f"{kind}{joint.name}" for kind in ("tau", "current", "duty"))
    if tau in table:
        return table.read_measured(tau), table.describe_source(tau), 0.0
    if current in table:
        if joint.drive_gain is None:
            raise DataError(
                f"{table.path}: {table.format_name(current)} is in drive units and {spec.robot} "
                "has no "
                f"drive gain for joint {joint.name}; write [drive_gains] {joint.name} = torque per "
                f"unit in the robot file, log {tau}, or let `modeler fit --method tls` find it"
            )
        source = f"{table.describe_source(current)} x {joint.drive_gain:g}"
        return joint.drive_gain * table.read_measured(current), source, 0.0
    if duty in table:
        return _compute_duty_torque(table, joint, spec)
    if not joint.actuated:
        return np.zeros(table.rows), "0 (passive)", 0.0
    called = " or ".join(map(table.format_name, (tau, current, *([duty] if joint.drive else []))))
    raise DataError(
        f"{table.path}: no column {called}: joint {joint.name} of "
        f"{spec.robot} is actuated; log its torque, or its current and give the drive gain; "
        "if another file of the same clock has it, give a folder with both"
    )


def _compute_duty_torque(
    table: LogTable, joint: JointSpec, spec: ModuleSpec
) -> tuple[np.ndarray, str, float]:
    """Returns the torque gain (duty voltage - k_e qd) / R of a joint, its last term apart."""
    duty, voltage, drive = f"duty{joint.name}", f"voltage{joint.name}", joint.drive
    if drive is None or joint.drive_gain is None:
        raise DataError(
            f"{table.path}: {table.format_name(duty)} is a share of a voltage, and {spec.robot} "
            "has no "
            f"voltage model for joint {joint.name}; write [drives] {joint.name} = {{voltage = 12, "
            "resistance = 4.4, gain = 1.1} with the numbers of its motor in the robot file"
        )
    per_volt = joint.drive_gain / drive.resistance
    supply = table.read_measured(voltage) if voltage in table else drive.voltage
    by = table.describe_source(voltage) if voltage in table else f"{drive.voltage:g} V"
    induced = per_volt * drive.k_e
    lost = f" - {induced:.4g} qd{joint.name}" if induced else ""
    source = f"{table.describe_source(duty)} x {by} x {per_volt:.4g}{lost}"
    return per_volt * supply * table.read_measured(duty), source, induced


def _find_duty_joints(table: LogTable, spec: ModuleSpec) -> list[JointSpec]:
    """Returns joints whose torque comes of a duty."""
    names = {*table.names}
    joints = [j for j in spec.joints if j.drive and f"duty{j.name}" in table]
    return [j for j in joints if not {f"tau{j.name}", f"current{j.name}"} & names]


def _check_duties(table: LogTable, spec: ModuleSpec) -> list[str]:
    """Returns sentences on duties that are no shares of 1."""
    names = [f"duty{joint.name}" for joint in _find_duty_joints(table, spec)]
    largest = {n: float(np.nanmax(np.abs(table.read_measured(n)), initial=0.0)) for n in names}
    return [
        f"{table.format_name(name)} reaches {value:.4g}: expected a share from -1 to 1; is it in "
        "%? "
        f"say so in [log] or with --map"
        for name, value in largest.items()
        if value > THRESHOLDS.max_duty
    ]


def _check_induced_voltage(table: LogTable, spec: ModuleSpec) -> list[str]:
    """Returns what is reported where a voltage model has no k_e."""
    joints = _find_duty_joints(table, spec)
    names = [joint.name for joint in joints if joint.drive and not joint.drive.k_e]
    what = f"joint{'s' * (len(names) > 1)} {', '.join(names)}"
    line = (
        f"{what}: without k_e in [drives], the back-EMF is part of the viscous friction (from "
        "duties alone both cannot be distinguished)"
    )
    return [line] if names else []


def _read_optional(
    table: LogTable, prefix: str, spec: ModuleSpec, reading_notes: list[str]
) -> np.ndarray | None:
    names = [f"{prefix}{joint.name}" for joint in spec.joints]
    there = [name for name in names if name in table]
    if len(there) == len(names):
        return np.stack([table.read_measured(name) for name in names]).T
    if there:
        absent = [name for name in names if name not in table]
        reading_notes.append(
            f"{', '.join(map(table.format_name, absent))} missing, so the logged {prefix} of the "
            "other "
            "joints is not used"
        )
    return None


def _read_segment(table: LogTable) -> np.ndarray | None:
    values = table.read_numbers("segment") if "segment" in table else None
    bad = np.flatnonzero(np.isnan(values)) if values is not None else np.zeros(0)
    if bad.size:
        raise DataError(
            f"{table.path}: column {table.format_name('segment')}, row "
            f"{table.before + bad[0] + 1}: no value; number every row, or leave the column out"
        )
    return values


def _collect_names(spec: ModuleSpec) -> set[str]:
    prefixes = ("q", "qd", "qdd", "qc", "tau", "current")
    by_duty = {f"{kind}{j.name}" for kind in ("duty", "voltage") for j in spec.joints if j.drive}
    return by_duty | {f"{prefix}{joint.name}" for prefix in prefixes for joint in spec.joints}


def _read_extra(
    table: LogTable, spec: ModuleSpec, reading_notes: list[str]
) -> dict[str, np.ndarray]:
    known = _collect_names(spec) | {"time", "segment"}
    # A current beside a torque is a measurement of its own: temperature and gain effects need it.
    known -= {f"current{joint.name}" for joint in spec.joints if f"tau{joint.name}" in table}
    others = [name for name in table.names if name not in known]
    text = [name for name in others if not table.is_numeric(name)]
    if text:
        reading_notes.append(f"{', '.join(text)} not numeric, left out")
    columns = {name: table.read_measured(name) for name in others if name not in text}
    return columns | _interpolate_temperatures(table, columns, reading_notes)


def _interpolate_temperatures(
    table: LogTable, extra: dict[str, np.ndarray], reading_notes: list[str]
) -> dict[str, np.ndarray]:
    """Returns temperatures, which are slow: interpolated linearly between logged values."""
    temperatures = {}
    for name, values in extra.items():
        logged = np.isfinite(values)
        if not name.startswith("temperature") or logged.all():
            continue
        if not logged.any() and not table.whole:
            continue  # other rows may show
        if not logged.any():
            raise DataError(
                f"{table.path}: {table.format_name(name)} has no values; record it, or drop the "
                "column"
            )
        time = table.read_numbers("time")
        temperatures[name] = np.interp(time, time[logged], values[logged])
        reading_notes.append(
            f"{name} has no value in {int((~logged).sum())} of {len(values)} rows: taken between "
            "the others"
        )
    return temperatures


@dataclass(frozen=True, eq=False)
class ChannelRanges:
    """Between which values the channels of a log lie; J joints, infinite without any.

    Attributes:
        values: (2, J) finite positions and torques.
        low: (2, J) the least of them.
        high: (2, J) the largest.
    """

    values: np.ndarray
    low: np.ndarray
    high: np.ndarray

    @staticmethod
    def compute_from(log: Log) -> "ChannelRanges":
        """Returns the ranges of some rows."""
        channels = (log.q, log.tau)
        there = np.stack([np.isfinite(values).sum(axis=0) for values in channels])
        low = np.stack([np.fmin.reduce(values, axis=0) for values in channels])
        high = np.stack([np.fmax.reduce(values, axis=0) for values in channels])
        return ChannelRanges(there, np.where(there, low, np.inf), np.where(there, high, -np.inf))

    @property
    def torques(self) -> tuple[tuple[float, float], ...]:
        """Returns the smallest and the largest torque of each joint, (J,)."""
        return tuple(zip(self.low[1].tolist(), self.high[1].tolist(), strict=True))

    def merged_with(self, other: "ChannelRanges") -> "ChannelRanges":
        """Returns the ranges of the rows of both."""
        low, high = np.minimum(self.low, other.low), np.maximum(self.high, other.high)
        return ChannelRanges(self.values + other.values, low, high)

    def collect_warnings(self, step: float, spec: ModuleSpec) -> list[str]:
        """Returns sentences on units and dead channels; usable, so no error."""
        warnings = []
        if step > THRESHOLDS.max_plain_step:
            warnings.append(f"median time step {step:.3g} s: is the column in seconds?")
        span = self.high - self.low
        for index, joint in enumerate(spec.joints):
            if joint.kind == "revolute" and span[0, index] > THRESHOLDS.max_plain_span:
                warnings.append(f"q{joint.name} spans {span[0, index]:.4g}: is it in rad?")
            if joint.actuated and span[1, index] == 0.0:
                warnings.append(f"the torque of joint {joint.name} never changes: is it connected?")
        return warnings

    def check_values(self, path: Path, spec: ModuleSpec) -> None:
        """Refuses a log without measurements.

        Raises:
            DataError: a channel has no values, or every torque is 0.
        """
        for index, joint in enumerate(spec.joints):
            for row, prefix in enumerate(("q", "torque of joint ")):
                if self.values[row, index] < 2:
                    raise DataError(
                        f"{path}: {prefix}{joint.name} has no values; record it, or delete the log"
                    )
        moving = [i for i, joint in enumerate(spec.joints) if joint.actuated]
        largest = np.maximum(np.abs(self.low[1, moving]), np.abs(self.high[1, moving]))
        if moving and largest.max() == 0.0:
            raise DataError(
                f"{path}: every measured torque is 0; expected joint torques; check the recording"
            )


# A log as blocks of rows: a file of any length, or a log that is in memory already.


_COLUMNS = ("time", "q", "tau", "qd", "qdd", "commanded", "segment")


class FileSource:
    """The rows of a Parquet or CSV file, read when they are wanted.

    Attributes:
        name: of the file.
        place: the file, and whose column is which: what makes this source again elsewhere.
        exact: True if a window begins at the very row that its share means.
        rows: of the file; of CSV about as many.
        content: "": the fingerprint is not known before all rows are read.
    """

    def __init__(
        self, path: Path, blocks: Blocks, spec: ModuleSpec, mapping: LogMap | None = None
    ) -> None:
        """Inspects at the first rows: which columns there are.

        Raises:
            DataError: the file is damaged, or lacks a column.
        """
        self.name, self.place, self.content = path.name, (path, mapping), ""
        self.rows, self.exact = blocks.rows, isinstance(blocks, ParquetBlocks)
        self._blocks, self._spec = blocks, spec
        table = self._build_table(blocks.read_window(0.0, THRESHOLDS.header_rows))
        whole = build_log(table, spec)
        self._notes, self._how = whole.notes, whole.reading_notes
        self._names = find_needed_columns(table, spec)

    def read_blocks(self, size: int) -> Iterator[Log]:
        """Yields all rows in their order, about `size` at a time.

        Raises:
            DataError: the log is damaged, or its time does not increase.
        """
        before, last, warm = 0, -np.inf, dict[str, float]()
        for columns in self._blocks.read_blocks(size, self._names):
            table = self._build_table(columns, before)
            log = build_log(table, self._spec)
            if log.time[0] <= last:
                raise build_time_error(table, before, last, float(log.time[0]))
            before, last = before + log.rows, float(log.time[-1])
            yield self._add_notes(log, warm)

    def read_window(self, share: float, size: int) -> Log:
        """Returns up to `size` consecutive rows from about a share of the log on."""
        columns = self._blocks.read_window(share, size, self._names)
        table = self._build_table(columns, int(share * self.rows))
        return self._add_notes(build_log(table, self._spec), {})

    def _build_table(self, part: Columns, before: int = 0) -> LogTable:
        return LogTable(*self.place, self._spec.joints, part=part, before=before)

    def _add_notes(self, log: Log, last: dict[str, float]) -> Log:
        """Returns the log with its notes; slow columns without a value keep the last one."""
        extra = {}
        for name, values in log.extra.items():
            if not np.isfinite(values).any():
                if name not in last:
                    raise DataError(
                        f"{log.name}: {name} has no values from {log.time[0]:.6g} to "
                        f"{log.time[-1]:.6g} s; record it all the time, or drop the column"
                    )
                values = np.full(len(values), last[name])
            last[name] = float(values[np.isfinite(values)][-1])
            extra[name] = values
        return dataclasses.replace(log, notes=self._notes, reading_notes=self._how, extra=extra)


class MemorySource:
    """A log that is in memory; as `FileSource`."""

    def __init__(self, log: Log) -> None:
        self.log, self.name, self.rows, self.content = log, log.name, log.rows, log.content

    def read_blocks(self, size: int) -> Iterator[Log]:
        """Yields all rows in their order."""
        for first in range(0, self.rows, size):
            yield cut_rows(self.log, slice(first, first + size))

    def read_window(self, share: float, size: int) -> Log:
        """Returns some rows of the log."""
        first = max(0, min(int(share * self.rows), self.rows - size))
        return cut_rows(self.log, slice(first, first + size))


Source = FileSource | MemorySource
"""Rows of one log."""


def open_source(path: Path, spec: ModuleSpec, mapping: LogMap | None = None) -> FileSource | None:
    """Returns the rows of a file that can be read in blocks; None of another format.

    Raises:
        DataError: the file is damaged, or lacks a column.
    """
    blocks = open_blocks(path)
    return None if blocks is None else FileSource(path, blocks, spec, mapping)


def join_logs(logs: Sequence[Log]) -> Log:
    """Returns consecutive rows of one log, put together."""
    if len(logs) == 1:
        return logs[0]
    columns: dict[str, Any] = {}
    for name in _COLUMNS:
        parts = [getattr(log, name) for log in logs]
        columns[name] = None if any(part is None for part in parts) else np.concatenate(parts)
    extra = {name: np.concatenate([log.extra[name] for log in logs]) for name in logs[0].extra}
    return dataclasses.replace(logs[0], **columns, extra=extra)


def join_windows(logs: Sequence[Log]) -> Log:
    """Returns windows of one log, increasing in time, as a log whose segments they are."""
    numbers, first = [], 0
    for log in logs:
        numbers.append(first + log.piece_number)
        first = int(numbers[-1][-1]) + 1
    return dataclasses.replace(join_logs(logs), segment=np.concatenate(numbers))


def cut_rows(log: Log, rows: slice | np.ndarray) -> Log:
    """Returns some rows of a log: consecutive ones, or those of a mask (n,)."""
    whole = {name: getattr(log, name) for name in _COLUMNS}
    parts: dict[str, Any] = {n: v if v is None else v[rows] for n, v in whole.items()}
    extra = {name: values[rows] for name, values in log.extra.items()}
    return dataclasses.replace(log, **parts, extra=extra)
