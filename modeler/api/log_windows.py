"""Time windows of a log's columns, thinned for a screen, of logs of any length; its columns."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from modeler.api.log_maps import parse_time_range
from modeler.api.thresholds import THRESHOLDS
from modeler.core.figure import thin_curves
from modeler.core.manifest import JointSpec
from modeler.logs import (
    Columns,
    LogInspection,
    LogMap,
    LogTable,
    build_map,
    inspect_table,
    open_blocks,
    read_windows,
)
from modeler.regression import FINGER, LONG
from modeler.robot import Robot

OpenTable = Callable[[Columns | None, int], LogTable]
"""Opens rows of a log with its mapping; None: all of them. The number counts the rows before."""


def list_robot_joints(robot: Robot) -> tuple[JointSpec, ...]:
    """Returns the joints of a robot as logs have them, without deriving it."""
    return tuple(
        JointSpec(
            joint.name,
            "revolute" if joint.is_revolute else "prismatic",
            joint.unit,
            joint.effort_unit,
            joint.actuated,
            robot.drive_gains.get(joint.name),
            robot.drives.get(joint.name),
        )
        for joint in robot.coordinates
    )


@dataclass(frozen=True)
class ColumnGuess:
    """What the columns of a log are by their names and ranges.

    Attributes:
        inspection: of the log, of a long one of evenly spread rows.
        units: of columns with numbers, as the file states them; "" for none.
        sampled: True of a long log, of which not all rows were read.
    """

    inspection: LogInspection
    units: Mapping[str, str]
    sampled: bool


def guess_columns(path: str | Path, robot: Robot | None = None) -> ColumnGuess:
    """Guesses the columns of a log; [log] of the robot file gives names alone.

    Raises:
        DataError: the file cannot be read.
    """
    joints = () if robot is None else list_robot_joints(robot)
    names = LogMap()
    if robot is not None:
        names = LogMap(names=build_map(robot.log_mapping, f"{robot.name}: [log]").names)
    blocks = open_blocks(Path(path))
    part = None if blocks is None or blocks.rows <= LONG else read_windows(blocks, 8, 4096)
    table = LogTable(Path(path), names, joints, True, part)
    columns = table.file_columns
    numeric = (name for name, column in columns.columns if column.is_numeric)
    units = {name: columns.units.get(name, "") for name in numeric}
    inspection = inspect_table(table, names, joints, (None, None))
    return ColumnGuess(inspection, units, part is not None)


@dataclass(eq=False)
class LogWindows:
    """The numbers of a log; of a long log the extremes of many rows at a time.

    Attributes:
        rows: of the file.
        time: (n,) s; of a long log (2n,), where the values of each group of rows begin and end.
        values: (n,) by column; the names are ours where the mapping knows them.
        units: of the columns: SI for ours, as in the file for others.
        is_coarse: True of a long log, of which windows are read when they are asked for.
    """

    rows: int
    time: np.ndarray
    values: dict[str, np.ndarray]
    units: dict[str, str]
    _path: Path
    _open: OpenTable
    is_coarse: bool = False
    _near: dict[str, np.ndarray] = field(default_factory=dict)  # the last window, all rows of it
    _within: tuple[float, float] = (np.inf, -np.inf)  # s, of that window

    def select_rows(self, start: float, end: float) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        """Returns time and columns from one time to another, s; -inf and inf are allowed.

        A short window of a long log is read with all its rows.
        """
        low, high = np.searchsorted(self.time, [start, end])
        selection = slice(max(0, low - 1), high + 1)
        if not self.is_coarse or high - low > THRESHOLDS.curve_points:
            return self.time[selection], {n: v[selection] for n, v in self.values.items()}
        if not self._within[0] <= start <= end <= self._within[1]:
            self._read_window(float(self.time[selection][0]), float(self.time[selection][-1]))
        time = self._near["time"]
        low, high = np.searchsorted(time, [start, end])
        selection = slice(max(0, low - 1), high + 1)
        near = {name: v[selection] for name, v in self._near.items() if name in self.values}
        return time[selection], near

    def thin_columns(
        self, names: Sequence[str], start: float, end: float, points: int
    ) -> dict[str, tuple[np.ndarray, np.ndarray]]:
        """Returns time and values of columns in a time range, thinned to least and largest.

        Args:
            names: of columns; one that is not there is left out.
            start: s.
            end: s.
            points: of each column, at most; never more than `curve_points`.
        """
        time, values = self.select_rows(start, end)
        points, curves = min(points, THRESHOLDS.curve_points), {}
        for name in (name for name in names if name in values):
            indices = thin_curves((values[name],), points)
            curves[name] = time[indices], values[name][indices]
        return curves

    def resample_columns(
        self, names: Sequence[str], start: float, end: float, rate: float
    ) -> dict[str, np.ndarray]:
        """Returns columns at evenly spaced times, and those times, as `time`.

        Args:
            names: of columns; one that is not there is left out.
            start: s.
            end: s.
            rate: times a second.
        """
        time, values = self.select_rows(start, end)
        known = time[np.isfinite(time)]
        if known.size == 0:
            return {"time": known}
        count = min(int((known[-1] - known[0]) * rate) + 2, 20_000)
        at = np.linspace(known[0], known[-1], count)
        film = {"time": at}
        for name in (name for name in names if name in values):
            is_valid = np.isfinite(values[name]) & np.isfinite(time)
            x, y = time[is_valid], values[name][is_valid]
            film[name] = np.interp(at, x, y) if is_valid.any() else at * np.nan
        return film

    def _read_window(self, start: float, end: float) -> None:
        """Reads all rows of a window of a long log and as much again on either side."""
        blocks = open_blocks(self._path)
        assert blocks is not None
        ends = np.searchsorted(self.time, [start, end]) / self.time.size
        room = max(float(ends[1] - ends[0]), FINGER / blocks.rows)
        first, rows = max(0.0, float(ends[0]) - room), int(3.0 * room * blocks.rows) + 2
        for _ in range(8):  # of CSV the place of a row is known about
            part = self._open(blocks.read_window(first, min(rows, blocks.rows)), 0)
            names = [name for name in ("time", *self.values) if name in part]
            near = {name: part.read_numbers(name) for name in names}
            time = near["time"] = _get_seconds(part, near.get("time"))
            self._near, self._within = near, (float(time[0]), float(time[-1]))
            if self._within[0] <= start and end <= self._within[1]:
                break
            if self._within[0] > start:
                first = max(0.0, first - room)
            rows = int(1.5 * rows)


def open_log_windows(
    place: str | Path, mapping: LogMap, joints: tuple[JointSpec, ...] = ()
) -> LogWindows:
    """Reads the columns of a log; a long one in one pass that keeps extremes.

    Raises:
        DataError: the file cannot be read.
    """
    path = Path(parse_time_range(place)[0])

    def open_table(part: Columns | None = None, before: int = 0) -> LogTable:
        return LogTable(path, mapping, joints, True, part, before)

    blocks = open_blocks(path)
    if blocks is not None and blocks.rows > LONG:
        columns = len(blocks.read_window(0.0, 1).columns)
        if blocks.rows * columns > THRESHOLDS.max_whole_values:
            return _read_extremes(path, open_table, blocks, joints)
    table = open_table()
    values = {n: table.read_numbers(n) for n in table.names if table.is_numeric(n)}
    time = _get_seconds(table, values.pop("time", None))
    units = _collect_units(table, values, joints)
    return LogWindows(table.rows, time, values, units, path, open_table)


def _read_extremes(
    path: Path, open_table: OpenTable, blocks: Any, joints: Sequence[JointSpec]
) -> LogWindows:
    """One pass over a long log: the least and the largest value of every group of rows."""
    rows, times, extremes = 0, list[np.ndarray](), dict[str, list[np.ndarray]]()
    units: dict[str, str] = {}
    for part in blocks.read_blocks(FINGER):
        table = open_table(part, rows)
        values = {n: table.read_numbers(n) for n in table.names if table.is_numeric(n)}
        time = _get_seconds(table, values.pop("time", None))
        starts = np.arange(0, table.rows, THRESHOLDS.coarse_rows)
        times.append(np.column_stack([time[starts], time[np.append(starts[1:], table.rows) - 1]]))
        for name, column in values.items():
            ends = [np.fmin.reduceat(column, starts), np.fmax.reduceat(column, starts)]
            extremes.setdefault(name, []).append(np.column_stack(ends).astype(np.float32))
        units = units or _collect_units(table, values, joints)
        rows += table.rows
    whole = {n: np.concatenate(v).ravel() for n, v in extremes.items() if len(v) == len(times)}
    return LogWindows(rows, np.concatenate(times).ravel(), whole, units, path, open_table, True)


def _get_seconds(table: LogTable, time: np.ndarray | None) -> np.ndarray:
    """The clock; row numbers without one."""
    return np.arange(table.before, table.before + table.rows, dtype=float) if time is None else time


def _collect_units(
    table: LogTable, values: Mapping[str, np.ndarray], joints: Sequence[JointSpec]
) -> dict[str, str]:
    """SI of what is ours; of other columns what the file says."""
    of_joint = {
        f"{kind}{joint.name}": joint.effort_unit if kind == "tau" else joint.unit + per
        for joint in joints
        for kind, per in (("q", ""), ("qc", ""), ("qd", "/s"), ("qdd", "/s^2"), ("tau", ""))
    }
    return {name: of_joint.get(name, table.get_unit(name)) for name in values}
