"""A log of any format as a `Log`, in the columns of the log format."""

import dataclasses
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeler.core.contract import JointSpec, ModuleSpec
from modeler.core.errors import DataError
from modeler.logs import LogMap, Table
from modeler.logs.blocks import blocks_of
from modeler.observation.log import MOST_WHOLE, Log, fingerprint

_SLOW_STEP = 0.2  # s; a median step above it is more likely a time column in ms
_SHORTEST_STEP, _LONGEST_STEP = 1e-7, 1e7  # s; beyond, squares of it say nothing any more
_FAR = 30.0  # rad; nearly five turns: more likely degrees


def read_log(path: str | Path, spec: ModuleSpec, mapping: LogMap | None = None) -> Log:
    """The `Log` of one file; columns `time`, `q<j>`, optional `qd<j> qdd<j> qc<j>`, `tau<j>`.

    The torque of a joint is `tau<j>` if the log has it, else `current<j>` times the drive gain of
    the robot file. A passive joint without `tau<j>` has torque 0.

    Args:
        path: a file of any format of `modeler.logs`.
        spec: the robot's manifest; it names the joints.
        mapping: names and units of the file's columns; without it they are ours and SI.

    Raises:
        DataError: the file cannot be read, or is too long to be read at once; a needed column is
            missing or not numeric, time does not increase, or no joint has a measured torque.
    """
    path = Path(path)
    _check_fits(path)
    table = Table(path, mapping, spec.joints)
    log = log_of(table, spec)
    ranges = Ranges.of(log)
    doubts = ranges.doubts(log.step, spec)
    ranges.check(path, spec)
    return dataclasses.replace(
        log,
        notes=(*log.notes, *doubts),
        content=fingerprint(log.time, log.q, log.tau),
    )


def _check_fits(path: Path) -> None:
    """Refuse a file that would not be in memory as a whole, as far as it says before it is read."""
    blocks = blocks_of(path)
    if blocks is not None and blocks.rows > MOST_WHOLE:
        raise DataError(
            f"{path}: got {blocks.rows} rows; expected at most {MOST_WHOLE} where all are in "
            "memory; give a part of it, FILE@START:END; `modeler log`, `compare` of one model, and "
            "`fit` by weighted or ordinary least squares read logs of any length"
        )


def log_of(table: Table, spec: ModuleSpec) -> Log:
    """The rows of a table as a log, each looked at by itself.

    Raises:
        DataError: as `read_log` does, but for what only a whole log can tell.
    """
    time = _time(table)
    notes: list[str] = [*table.notes]
    q = np.column_stack([_position(table, joint, spec) for joint in spec.joints])
    torques = [_torque(table, joint, spec) for joint in spec.joints]
    return Log(
        name=table.path.name,
        joints=tuple(joint.name for joint in spec.joints),
        time=time,
        q=q,
        tau=np.column_stack([values for values, _ in torques]),
        qd=_optional(table, "qd", spec, notes),
        qdd=_optional(table, "qdd", spec, notes),
        commanded=_optional(table, "qc", spec, notes),
        segment=_segment(table),
        extra=_extra(table, spec, notes),
        torque_source=tuple(source for _, source in torques),
        missing=_missing(table, spec),
        notes=tuple(notes),
    )


def needed(table: Table, spec: ModuleSpec) -> list[str]:
    """The file's names of the columns that a fit of these joints reads."""
    used = _used_names(spec) | {"time", "segment"}
    return [
        table.column(name)
        for name in table.names
        if (name in used or name.startswith("temperature")) and table.is_numeric(name)
        and not (name == "time" and table.rated)
    ]  # fmt: skip


def _time(table: Table) -> np.ndarray:
    time, name = table.numbers("time"), table.called("time")
    bad = np.flatnonzero(~np.isfinite(time))
    if bad.size:
        raise DataError(
            f"{table.path}: column {name}, row {table.before + bad[0] + 1}: no value; every row "
            "needs its time; delete the row or restore the time"
        )
    back = np.flatnonzero(np.diff(time) <= 0.0)
    if back.size:
        row = int(back[0]) + 1
        raise backwards(table, table.before + row, time[row - 1], time[row])
    if len(time) > 1:
        check_step(table.path, name, float(np.median(np.diff(time))))
    return time


def backwards(table: Table, row: int, before: float, time: float) -> DataError:
    """The error of a row, counted from 0, whose time is not after the one before it."""
    return DataError(
        f"{table.path}: column {table.called('time')}, row {row + 1}: {time:.9g} s after "
        f"{before:.9g} s; expected increasing time; delete repeated rows, or sort "
        "and split the file where the clock restarts"
    )


def check_step(path: Path, name: str, step: float) -> None:
    """Refuse a median step, s, that squares of say nothing."""
    if not _SHORTEST_STEP <= step <= _LONGEST_STEP:
        raise DataError(
            f"{path}: column {name}: median step of {step:.3g} s; expected "
            f"{_SHORTEST_STEP:g} to {_LONGEST_STEP:g} s; write the time in seconds, or map it "
            "with its unit"
        )


def _position(table: Table, joint: JointSpec, spec: ModuleSpec) -> np.ndarray:
    name = f"q{joint.name}"
    if name not in table and not joint.actuated:
        raise DataError(
            f"{table.path}: no column {table.called(name)}: joint {joint.name} of {spec.robot} is "
            "passive and its position must be logged, or computed from the closed loops before; "
            "add the column"
        )
    return table.measured(name)


def _torque(table: Table, joint: JointSpec, spec: ModuleSpec) -> tuple[np.ndarray, str]:
    tau, current = f"tau{joint.name}", f"current{joint.name}"
    if tau in table:
        return table.measured(tau), table.source(tau)
    if current in table:
        if joint.drive_gain is None:
            raise DataError(
                f"{table.path}: {table.called(current)} is in drive units and {spec.robot} has no "
                f"drive gain for joint {joint.name}; write [drive_gains] {joint.name} = torque per "
                f"unit in the robot file, log {tau}, or let `modeler fit --method tls` find it"
            )
        source = f"{table.source(current)} x {joint.drive_gain:g}"
        return joint.drive_gain * table.measured(current), source
    if not joint.actuated:
        return np.zeros(table.rows), "0 (passive)"
    raise DataError(
        f"{table.path}: no column {table.absent(tau, current)}: joint {joint.name} of "
        f"{spec.robot} is actuated; log its torque, or its current and give the drive gain"
    )


def _optional(table: Table, prefix: str, spec: ModuleSpec, notes: list[str]) -> np.ndarray | None:
    names = [f"{prefix}{joint.name}" for joint in spec.joints]
    there = [name for name in names if name in table]
    if len(there) == len(names):
        return np.column_stack([table.measured(name) for name in names])
    if there:
        absent = [name for name in names if name not in table]
        notes.append(
            f"{', '.join(map(table.called, absent))} missing, so the logged {prefix} of the other "
            "joints is not used"
        )
    return None


def _segment(table: Table) -> np.ndarray | None:
    if "segment" not in table:
        return None
    values = table.numbers("segment")
    bad = np.flatnonzero(np.isnan(values))
    if bad.size:
        raise DataError(
            f"{table.path}: column {table.called('segment')}, row "
            f"{table.before + bad[0] + 1}: no value; number every row, or leave the column out"
        )
    return values


def _used_names(spec: ModuleSpec) -> set[str]:
    prefixes = ("q", "qd", "qdd", "qc", "tau", "current")
    return {f"{prefix}{joint.name}" for prefix in prefixes for joint in spec.joints}


def _extra(table: Table, spec: ModuleSpec, notes: list[str]) -> dict[str, np.ndarray]:
    known = _used_names(spec) | {"time", "segment"}
    # A current beside a torque is a measurement of its own: temperature and gain effects want it.
    known -= {f"current{joint.name}" for joint in spec.joints if f"tau{joint.name}" in table}
    others = [name for name in table.names if name not in known]
    text = [name for name in others if not table.is_numeric(name)]
    if text:
        notes.append(f"{', '.join(text)} not numeric, left out")
    found = {name: table.measured(name) for name in others if name not in text}
    return found | _temperatures(table, found, notes)


def _temperatures(
    table: Table, extra: dict[str, np.ndarray], notes: list[str]
) -> dict[str, np.ndarray]:
    """Temperatures, which are slow: between logged values they are taken from a straight line."""
    found = {}
    for name, values in extra.items():
        logged = np.isfinite(values)
        if not name.startswith("temperature") or logged.all():
            continue
        if not logged.any() and not table.whole:
            continue  # other rows may tell
        if not logged.any():
            raise DataError(
                f"{table.path}: {table.called(name)} has no values; record it, or drop the column"
            )
        time = table.numbers("time")
        found[name] = np.interp(time, time[logged], values[logged])
        notes.append(
            f"{name} has no value in {int((~logged).sum())} of {len(values)} rows: taken between "
            "the others"
        )
    return found


def _missing(table: Table, spec: ModuleSpec) -> dict[str, int]:
    names = [name for name in table.names if name in _used_names(spec) and table.is_numeric(name)]
    counts = {name: int(np.isnan(table.measured(name)).sum()) for name in names}
    return {name: count for name, count in counts.items() if count}


@dataclass(frozen=True, eq=False)
class Ranges:
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
    def of(log: Log) -> "Ranges":
        """Of some rows."""
        there, low, high = (
            np.stack(rows) for rows in zip(*map(_range, (log.q, log.tau)), strict=True)
        )
        return Ranges(there, low, high)

    def over(self, other: "Ranges") -> "Ranges":
        """Of the rows of both."""
        return Ranges(
            self.values + other.values,
            np.minimum(self.low, other.low),
            np.maximum(self.high, other.high),
        )

    def doubts(self, step: float, spec: ModuleSpec) -> list[str]:
        """Sentences on units and dead channels; usable, so no error."""
        found = []
        if step > _SLOW_STEP:
            found.append(f"median time step {step:.3g} s: is the column in seconds?")
        span = self.high - self.low
        for index, joint in enumerate(spec.joints):
            if joint.kind == "revolute" and span[0, index] > _FAR:
                found.append(f"q{joint.name} spans {span[0, index]:.4g}: is it in rad?")
            if joint.actuated and span[1, index] == 0.0:
                found.append(f"the torque of joint {joint.name} never changes: is it connected?")
        return found

    def check(self, path: Path, spec: ModuleSpec) -> None:
        """Refuse a log without measurements.

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


def _range(values: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Of values (n, J), NaN where missing: how many there are, the least and the largest."""
    low, high = values.min(axis=0), values.max(axis=0)
    if np.isfinite(low).all() and np.isfinite(high).all():
        return np.full(values.shape[1], len(values)), low, high
    there = np.isfinite(values).sum(axis=0)
    low, high = np.fmin.reduce(values, axis=0), np.fmax.reduce(values, axis=0)
    return there, np.where(there > 0, low, np.inf), np.where(there > 0, high, -np.inf)
