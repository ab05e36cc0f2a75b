"""A log: what one run of the robot left behind; and whether two logs share rows."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from modeler.core.errors import DataError
from modeler.core.result import Result

GAP = 5.0
"""A step longer than this many median steps ends a piece of motion."""

_FINE = 1e-7  # of a step; over the rows of a block, less than a row


class LogRows(Protocol):
    """Rows of a file: a log, or what is kept of it."""

    @property
    def name(self) -> str:
        """Of the file."""

    @property
    def content(self) -> str:
        """Fingerprint of the whole file; "" if there is none."""

    @property
    def span(self) -> tuple[float, float]:
        """First and last time, s."""


@dataclass(frozen=True, eq=False)
class Log(Result):
    """One measured run; n rows, joints in the order of the manifest, SI units.

    A missing measurement is NaN and stays in its row; nothing has been filtered or left out.

    Attributes:
        name: file name without its folder.
        joints: joint names, the order of the columns below.
        time: (n,) s, strictly increasing.
        q: (n, joints) rad or m.
        tau: (n, joints) N m or N; 0 for passive joints without a column. Where it comes of a duty,
            what the motor induces is not taken from it yet: that needs the filtered speed.
        qd: (n, joints) logged velocities, or None.
        qdd: (n, joints) logged accelerations, or None.
        commanded: (n, joints) commanded positions, or None.
        segment: (n,) number of the piece of motion each row belongs to, or None.
        extra: further numeric columns, (n,) each.
        torque_source: where each joint's torque comes from, in words.
        notes: doubtful but usable things seen while reading, one sentence each.
        told: how it was read, one sentence each.
        content: fingerprint of the whole file's measurements, whatever its name; a piece of the
            log keeps it. Empty if the log came from no file.
        robot_steps: usual and longest step, s, of the rows that are left where a recorder wrote
            some again; else None.
        induced: (joints,) torque per speed that is still to be taken from tau; empty for none.
        path: of its file as it was given, `@START:END` of a piece of it too; "" if none was.
    """

    name: str
    joints: tuple[str, ...]
    time: np.ndarray
    q: np.ndarray
    tau: np.ndarray
    qd: np.ndarray | None = None
    qdd: np.ndarray | None = None
    commanded: np.ndarray | None = None
    segment: np.ndarray | None = None
    extra: Mapping[str, np.ndarray] = field(default_factory=dict)
    torque_source: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    content: str = ""
    robot_steps: tuple[float, float] | None = None
    induced: tuple[float, ...] = ()
    path: str = ""
    reading_notes: tuple[str, ...] = ()

    @property
    def rows(self) -> int:
        """Number of rows, n."""
        return len(self.time)

    @property
    def span(self) -> tuple[float, float]:
        """First and last time, s."""
        return float(self.time[0]), float(self.time[-1])

    @property
    def missing(self) -> dict[str, int]:
        """Column -> rows without a value; only columns that have any."""
        kinds = {"q": self.q, "qd": self.qd, "qdd": self.qdd, "qc": self.commanded}
        missing_rows = {
            f"{prefix}{name}": int(np.isnan(values[:, j]).sum())
            for prefix, values in kinds.items() if values is not None
            for j, name in enumerate(self.joints)
        }  # fmt: skip
        sources = self.torque_source or [f"tau{name}" for name in self.joints]
        for source, values in zip(sources, self.tau.T, strict=True):
            missing_rows[source.split()[0]] = int(np.isnan(values).sum())
        return {column: count for column, count in missing_rows.items() if count}

    @property
    def piece_number(self) -> np.ndarray:
        """(n,) whole numbers from 0 that grow where a piece of motion begins."""
        if self.segment is None:
            return np.zeros(self.rows, dtype=int)
        return np.concatenate([[0], np.cumsum(np.diff(self.segment) != 0)])

    @property
    def step(self) -> float:
        """Median time step, s.

        Large times are coarse: seconds since 1970 come in steps of 2.4e-7 s. Where the median is
        such a step, it is the mean of those that differ from it by no more than that.
        """
        if self.robot_steps is not None:
            return self.robot_steps[0]
        steps = np.diff(self.time)
        step = float(np.median(steps))
        resolution = float(np.spacing(np.abs(self.time).max()))
        if resolution < _FINE * step:
            return step
        return float(np.mean(steps[np.abs(steps - step) <= 1.5 * resolution]))

    @property
    def gap(self) -> float:
        """s; a longer step ends a piece of motion."""
        return max(GAP * self.step, *(self.robot_steps or (0.0,)))


FINGER = 32_768
"""Rows of which a long log keeps one fingerprint; that of the log is theirs together."""

LONG = 250_000
"""Rows above which a log is long: it need not be in memory at once."""

MOST_WHOLE = 5_000_000
"""Rows of a file that is read at once: about 5 GB with six joints."""


def compute_fingerprint(*measurements: np.ndarray) -> str:
    """A text that equal arrays share and others do not: SHA-256 of their numbers, in hexadecimal.

    The numbers and not the bytes of the file: a copy as CSV of a Parquet log is the same run. A
    long log has the fingerprint of those of its blocks, which are taken one by one.

    Args:
        measurements: (n, ...) each.
    """
    rows = len(measurements[0])
    return (
        compute_block_hash(*measurements).hex()
        if rows <= LONG
        else combine_hashes(compute_block_hashes(*measurements))
    )


def compute_block_hashes(*measurements: np.ndarray) -> tuple[bytes, ...]:
    """Those of the blocks of a long log: rows from a multiple of `FINGER` on."""
    starts = range(0, len(measurements[0]), FINGER)
    return tuple(
        compute_block_hash(*(values[k : k + FINGER] for values in measurements)) for k in starts
    )


def combine_hashes(hashes: Sequence[bytes]) -> str:
    """That of a long log."""
    return hashlib.sha256(b"".join(hashes)).hexdigest()


def compute_block_hash(*measurements: np.ndarray) -> bytes:
    """That of one block."""
    content = hashlib.sha256()
    for values in measurements:
        # Adding 0 makes -0 into 0: writers differ there, and no fit does.
        numbers = np.ascontiguousarray(values + 0.0, dtype="<f8")
        numbers[np.isnan(numbers)] = np.nan
        content.update(f"{numbers.shape}".encode())
        content.update(numbers.tobytes())
    return content.digest()


def has_shared_rows(log: LogRows, content: str, start: float, end: float) -> bool:
    """True if `log` holds rows of the file with that fingerprint from `start` to `end`, s."""
    same = log.content != "" and log.content == content
    return same and log.span[0] <= end and start <= log.span[1]


# Logs that are used together: every row has one part, fitted, explained or held out.


def check_no_overlap(
    logs: Sequence[LogRows], holdout: Sequence[LogRows] = (), places: Sequence[str] = ()
) -> None:
    """Refuse rows that are given twice, and held-out rows that are also explained.

    Args:
        logs: as they were read, or their reports.
        holdout: of which errors are to be told.
        places: what the user typed for `logs`; none: their names.

    Raises:
        DataError: names the two logs.
    """
    for group, typed in ((logs, places), (holdout, ())):
        names = typed or [log.name for log in group]
        for index, log in enumerate(group):
            for first, other in zip(names, group[:index], strict=False):
                if has_shared_rows(log, other.content, *other.span):
                    raise DataError(
                        f"{names[index]}: got rows of {first} again; rows that repeat count "
                        "twice, and their noise looks like something that returns; give each row "
                        "once"
                    )
    for other in holdout:
        for log in logs:
            if has_shared_rows(other, log.content, *log.span):
                raise DataError(
                    f"--holdout {other.name}: shares rows with {log.name}; expected other motion; "
                    "leave it out, or split the log with FILE@START:END"
                )
