"""What the process of the viewer answers: windows of logs, torques and residuals as pictures.

Every function takes plain arguments and answers with plain data or a `Picture`. Files are read once
and kept until they change.
"""

from collections import OrderedDict
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from modeler import validation
from modeler.api import checks, log_maps, workflow
from modeler.core.errors import DataError
from modeler.core.figure import (
    BLACK,
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PINK,
    SKY,
    VERMILLION,
    Curve,
    Heat,
    Means,
    Panel,
    Picture,
    Points,
    Series,
    Style,
    thin_curves,
    thin_points,
)
from modeler.core.manifest import JointSpec
from modeler.core.table import WORDS
from modeler.estimation import IdentifiedModel, load_model
from modeler.formats import read_robot
from modeler.logs import (
    Columns,
    LogMap,
    LogTable,
    build_map,
    inspect_table,
    open_blocks,
    parse_map_options,
    read_windows,
)
from modeler.regression import FINGER, LONG
from modeler.robot import Robot
from modeler.runtime import CompiledModel
from modeler.studio import places
from modeler.studio.log_mapping import LogGuess, build_default_joints, parse_guess
from modeler.studio.thresholds import THRESHOLDS
from modeler.validation import Prediction, concatenate_time

# What was read stays, by what it was read from.

T = TypeVar("T")
_KEPT: dict[str, OrderedDict[Any, Any]] = {}


def forget() -> None:
    """Lets go of all that was read."""
    _KEPT.clear()


def _cache_result(
    kind: str, key: Any, make: Callable[[], T], most: int = THRESHOLDS.cached_results
) -> T:
    """What was made for that key, or is made now; of each kind the last ones used stay."""
    entries = _KEPT.setdefault(kind, OrderedDict())
    if key not in entries:
        entries[key] = make()
        while len(entries) > most:
            entries.popitem(last=False)
    entries.move_to_end(key)
    result: T = entries[key]
    return result


def _read_state(place: str) -> tuple[str, int, int]:
    """A file as it is now; a window after it belongs to its name."""
    path = str(log_maps.parse_time_range(place)[0])
    if places.READABLE.folders:  # the same rule as for commands
        places.READABLE.check_tree(path, Path(path))
    try:
        status = Path(path).stat()
    except OSError as error:
        raise DataError(
            f"{path}: cannot be read ({error.strerror}); put the file back, or take it out"
        ) from None
    return place, status.st_mtime_ns, status.st_size


# Logs as they are.


@dataclass(frozen=True)
class LogFacts:
    """What a log holds.

    Attributes:
        rows: of the file.
        start, end: s.
        names: of columns with numbers, ours where the mapping knows them.
        units: of them as they are answered: SI for ours, as in the file for others.
        coarse: True of a long log, of which a window is read when it is looked at.
    """

    rows: int
    start: float
    end: float
    names: tuple[str, ...]
    units: dict[str, str]
    coarse: bool


@dataclass(eq=False)
class _Log:
    """The rows of a log; of a long one the least and largest values of so many rows at a time."""

    rows: int
    time: np.ndarray  # (n,) s; of a long log (2n,), where the values of each piece begin and end
    values: dict[str, np.ndarray]
    units: dict[str, str]
    source: "_Source | None" = None  # of a long log
    near: dict[str, np.ndarray] = field(default_factory=dict)  # the last window, all rows of it
    within: tuple[float, float] = (np.inf, -np.inf)  # s, of that window


@dataclass(frozen=True)
class _Source:
    path: Path
    mapping: LogMap
    joints: tuple[JointSpec, ...]

    def table(self, part: Columns | None = None, before: int = 0) -> LogTable:
        return LogTable(self.path, self.mapping, self.joints, True, part, before)


def log_facts(place: str, words: Sequence[str] = (), robot: str = "") -> LogFacts:
    """Returns columns, units and extent of a log.

    Args:
        place: its file.
        words: of the mapping, as of `--map`.
        robot: robot file, whose [log] lies under them.
    """

    def read_facts() -> LogFacts:
        log = _load_log(place, words, robot)
        names, ends = tuple(log.values), (float(log.time[0]), float(log.time[-1]))
        return LogFacts(log.rows, *ends, names, log.units, log.source is not None)

    key = (_read_state(place), tuple(words), robot and _read_state(robot))
    return _cache_result("facts", key, read_facts, 200)


def log_window(
    place: str, names: Sequence[str], start: float, end: float, words: Sequence[str] = (),
    robot: str = "", points: int = THRESHOLDS.curve_points,
) -> dict[str, tuple[np.ndarray, np.ndarray]]:  # fmt: skip
    """Returns time and values of columns in a time range, thinned to least and largest.

    Args:
        place: the log's file.
        names: of columns, as `log_facts` has them; one that is not there is left out.
        start: s; -inf and inf are allowed.
        end: s.
        words: of the mapping.
        robot: robot file.
        points: of each column, at most.
    """
    log = _load_log(place, words, robot)
    time, values = _select_rows(log, start, end)
    curves = {}
    for name in names:
        if name in values:
            indices = thin_curves((values[name],), points)
            curves[name] = time[indices], values[name][indices]
    return curves


def log_film(
    place: str, names: Sequence[str], words: Sequence[str] = (), robot: str = "",
    start: float = -np.inf, end: float = np.inf, rate: float = 30.0,
) -> dict[str, np.ndarray]:  # fmt: skip
    """Returns columns at evenly spaced times, and those, as `time`.

    Args:
        place: the log's file.
        names: of columns, as `log_facts` has them; one that is not there is left out.
        words: of the mapping.
        robot: robot file.
        start: s.
        end: s.
        rate: pictures a second.
    """
    time, values = _select_rows(_load_log(place, words, robot), start, end)
    known = time[np.isfinite(time)]
    if known.size == 0:
        return {"time": known}
    count = min(int((known[-1] - known[0]) * rate) + 2, 20_000)
    at = np.linspace(known[0], known[-1], count)
    film = {"time": at}
    for name in (name for name in names if name in values):
        is_valid = np.isfinite(values[name]) & np.isfinite(time)
        film[name] = (
            np.interp(at, time[is_valid], values[name][is_valid]) if is_valid.any() else at * np.nan
        )
    return film


def log_guess(place: str, robot: str = "") -> LogGuess:
    """Guesses the columns of a log by their names and ranges.

    Args:
        place: the log's file.
        robot: robot file; "" where there is none yet: joints are then counted from 1.
    """

    def build_guess() -> LogGuess:
        path, joints = Path(place), robot_joints(robot)
        stated = _load_robot(robot).log_mapping if robot else {}
        names = LogMap(names=build_map(stated, f"{robot}: [log]").names)
        blocks = open_blocks(path)
        part = None if blocks is None or blocks.rows <= LONG else read_windows(blocks, 8, 4096)
        table = LogTable(path, names, joints, True, part)
        inspection = inspect_table(table, names, joints, (None, None))
        columns = {
            name: table.file_columns.units.get(name, "")
            for name, column in table.file_columns.columns
            if column.is_numeric
        }
        count = 1 if inspection.positions is None else len(inspection.positions.names)
        choices, ranged = parse_guess(
            inspection.suggested_map, joints or build_default_joints(count), columns
        )
        clock = next((part for part in inspection.streams if part.is_clock), None)
        is_ambiguous = (
            [part.kind for part in inspection.streams].count(clock.kind) > 1 if clock else False
        )
        topic = clock.name if clock and is_ambiguous else ""
        return LogGuess(columns, choices, ranged, count, topic, () if part else inspection.warnings)

    return _cache_result(
        "guess", (_read_state(place), robot and _read_state(robot)), build_guess, 200
    )


def _select_rows(log: _Log, start: float, end: float) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Time and columns between two times; of a long log all rows only of a short window."""
    low, high = np.searchsorted(log.time, [start, end])
    selection = slice(max(0, low - 1), high + 1)
    if log.source is None or high - low > THRESHOLDS.curve_points:
        return log.time[selection], {name: v[selection] for name, v in log.values.items()}
    if not log.within[0] <= start <= end <= log.within[1]:
        _read_window(log, log.source, float(log.time[selection][0]), float(log.time[selection][-1]))
    time = log.near["time"]
    low, high = np.searchsorted(time, [start, end])
    selection = slice(max(0, low - 1), high + 1)
    return time[selection], {
        name: v[selection] for name, v in log.near.items() if name in log.values
    }


def _read_window(log: _Log, source: _Source, start: float, end: float) -> None:
    """Reads all rows of a window of a long log and as much again on either side."""
    blocks = open_blocks(source.path)
    assert blocks is not None
    ends = np.searchsorted(log.time, [start, end]) / log.time.size
    room = max(float(ends[1] - ends[0]), FINGER / blocks.rows)
    first, rows = max(0.0, float(ends[0]) - room), int(3.0 * room * blocks.rows) + 2
    for _ in range(8):  # of CSV the place of a row is known about
        part = source.table(blocks.read_window(first, min(rows, blocks.rows)))
        log.near = {name: part.read_numbers(name) for name in ("time", *log.values) if name in part}
        time = log.near["time"] = _get_seconds(part, log.near.get("time"))
        log.within = float(time[0]), float(time[-1])
        if log.within[0] <= start and end <= log.within[1]:
            break
        if log.within[0] > start:
            first = max(0.0, first - room)
        rows = int(1.5 * rows)


def _load_log(place: str, words: Sequence[str], robot: str) -> _Log:
    key = (_read_state(place), tuple(words), robot and _read_state(robot))
    return _cache_result("log", key, lambda: _read_log(place, words, robot), 3)


def _read_log(place: str, words: Sequence[str], robot: str) -> _Log:
    mapping = parse_map_options(words)
    if robot:
        stated = _load_robot(robot)
        mapping = mapping.merge_over(build_map(stated.log_mapping, f"{robot}: [log]"))
    joints = robot_joints(robot)
    return _read_mapped(place, mapping, joints)


def _read_mapped(place: str, mapping: LogMap, joints: tuple[JointSpec, ...]) -> _Log:
    path = Path(log_maps.parse_time_range(place)[0])
    source, blocks = _Source(path, mapping, joints), open_blocks(path)
    if blocks is not None and blocks.rows > LONG:
        columns = len(blocks.read_window(0.0, 1).columns)
        if blocks.rows * columns > THRESHOLDS.max_whole_values:
            return _read_coarse(source, blocks)
    table = source.table()
    values = {n: table.read_numbers(n) for n in table.names if table.is_numeric(n)}
    time = _get_seconds(table, values.pop("time", None))
    return _Log(table.rows, time, values, _collect_units(table, values, joints))


def _read_coarse(source: _Source, blocks: Any) -> _Log:
    """One pass over a long log: the least and the largest value of every piece of rows."""
    rows, times, extremes = 0, list[np.ndarray](), dict[str, list[np.ndarray]]()
    units: dict[str, str] = {}
    for part in blocks.read_blocks(FINGER):
        table = source.table(part, rows)
        values = {n: table.read_numbers(n) for n in table.names if table.is_numeric(n)}
        time = _get_seconds(table, values.pop("time", None))
        starts = np.arange(0, table.rows, THRESHOLDS.coarse_rows)
        times.append(np.column_stack([time[starts], time[np.append(starts[1:], table.rows) - 1]]))
        for name, column in values.items():
            ends = [np.fmin.reduceat(column, starts), np.fmax.reduceat(column, starts)]
            extremes.setdefault(name, []).append(np.column_stack(ends).astype(np.float32))
        units = units or _collect_units(table, values, source.joints)
        rows += table.rows
    whole = {n: np.concatenate(v).ravel() for n, v in extremes.items() if len(v) == len(times)}
    return _Log(rows, np.concatenate(times).ravel(), whole, units, source)


def _get_seconds(table: LogTable, time: np.ndarray | None) -> np.ndarray:
    """The clock; row numbers without one."""
    return np.arange(table.before, table.before + table.rows, dtype=float) if time is None else time


def _collect_units(
    table: LogTable, values: dict[str, np.ndarray], joints: Sequence[JointSpec]
) -> dict[str, str]:
    """SI of what is ours; of other columns what the file says."""
    of_joint = {
        f"{kind}{joint.name}": joint.effort_unit if kind == "tau" else joint.unit + per
        for joint in joints
        for kind, per in (("q", ""), ("qc", ""), ("qd", "/s"), ("qdd", "/s^2"), ("tau", ""))
    }
    return {name: of_joint.get(name, table.get_unit(name)) for name in values}


def _load_robot(place: str) -> Robot:
    return _cache_result("robot", _read_state(place), lambda: read_robot(place))


def robot_logging(place: str) -> tuple[tuple[JointSpec, ...], dict[str, Any]]:
    """Returns the joints of a robot file, and its [log]."""
    return robot_joints(place), dict(_load_robot(place).log_mapping)


def robot_joints(place: str) -> tuple[JointSpec, ...]:
    """Returns the joints of a robot file, without deriving; none without a file."""
    if not place:
        return ()
    robot = _load_robot(place)
    return tuple(
        JointSpec(j.name, "revolute" if j.is_revolute else "prismatic", j.unit, j.effort_unit,
                  j.actuated, robot.drive_gains.get(j.name), robot.drives.get(j.name))
        for j in robot.coordinates
    )  # fmt: skip


# Torques of models on logs.


@dataclass(frozen=True, eq=False)
class _ModelOnLogs:
    """A model on logs."""

    comparison: validation.Comparison
    model: str
    compiled: CompiledModel
    logs: tuple[str, ...]

    @property
    def prediction(self) -> Prediction:
        return self.comparison.prediction

    def load_log(self, place: str) -> _Log:
        """Loads all columns of a log, by the names that the model has for them."""
        mapping, joints = log_maps.build_log_map(self.compiled), self.compiled.spec.joints
        key = (_read_state(str(log_maps.parse_time_range(place)[0])), _read_state(self.model))
        return _cache_result("log", key, lambda: _read_mapped(place, mapping, joints), 3)


@dataclass(frozen=True)
class Verdict:
    """How good a model is on logs, joint by joint.

    Attributes:
        joints: names, in order.
        errors: relative, of each.
        sentences: of each, as `modeler compare` says it.
        channels: of each: id and label of what its residual can be drawn over.
        start, end: of the time axis of the pictures, s.
        kinds: of each, what is left: "pattern", "noise", "other", or "untold" by too few samples.
        unjudged: lines on joints that cannot be judged, and why.
    """

    joints: tuple[str, ...]
    errors: tuple[float, ...]
    sentences: tuple[str, ...]
    channels: tuple[tuple[str, str], ...]
    start: float
    end: float
    kinds: tuple[str, ...]
    unjudged: tuple[str, ...]


def verdict(model: str, logs: Sequence[str]) -> Verdict:
    """Returns the result of `modeler compare MODEL LOG...` for every joint."""
    model_on_logs = _compare_model(model, logs)
    time = concatenate_time(model_on_logs.prediction)[0]
    items = model_on_logs.comparison.joints
    return Verdict(
        tuple(item.joint.name for item in items),
        tuple(float(item.relative_error) for item in items),
        tuple(validation.write_joint_verdict(item) for item in items),
        tuple(_collect_channels(model_on_logs)),
        float(time.min()),
        float(time.max()),
        tuple(map(_classify_remainder, items)),
        tuple(
            f"Joint {name}: not judged: {why}"
            for name, why in model_on_logs.comparison.excluded_joints
        ),
    )


def _classify_remainder(item: validation.JointComparison) -> str:
    """What is left of a joint, which too few samples may not show; a large error is no noise."""
    kind = validation.classify_residual(item)
    is_determined = kind != "other" or item.structure is not None or validation.is_too_large(item)
    return kind if is_determined else "untold"


def torque_picture(
    models: Sequence[str], logs: Sequence[str], joint: str, start: float = -np.inf,
    end: float = np.inf,
) -> Picture:  # fmt: skip
    """Draws measured and predicted torque of a joint over time, and the residual below.

    Args:
        models: files; each is overlaid.
        logs: FILE or FILE@START:END.
        joint: its name.
        start: on the axis of the picture, s; logs stand one after the other.
        end: the same.
    """
    first = _compare_model(models[0], logs).prediction
    j = _find_joint(first, joint)
    time, label, marks = concatenate_time(first)
    rows = _select_between(time, start, end)
    unit, alone = first.joints[j].effort_unit, len(models) == 1
    above: list[Series] = [
        _build_curve(first, "measured", time, first.measured[:, j], rows, _MEASURED)
    ]
    below: list[Series] = []
    for k, model in enumerate(models):
        style = Style(_OF_MODELS[k % len(_OF_MODELS)], width=1.4, opacity=0.9)
        p, name = _compare_model(model, logs).prediction, f"model {Path(model).stem}"
        model_time = concatenate_time(p)[0]  # rows of another model may be others
        kept_rows, left = (
            _select_between(model_time, start, end),
            validation.compute_residual(p)[:, j],
        )
        above.append(
            _build_curve(
                p, "predicted" if alone else name, model_time, p.predicted[:, j], kept_rows, style
            )
        )
        below.append(
            _build_curve(p, "residual" if alone else name, model_time, left, kept_rows, style)
        )
    spans = validation.find_masked_spans(first, j, time, rows)
    ends = float(time[rows[0]]), float(time[rows[-1]])
    what = f"{WORDS[unit]} [{unit}]"
    return Picture(
        f"torque_{joint}", f"Joint {joint}: measured and predicted",
        validation.describe_masks(first, j),
        ((Panel("", label, what, tuple(above), marks=marks, spans=spans, x_range=ends),),
         (Panel("", label, f"residual [{unit}]", tuple(below), marks=marks, zero=True, spans=spans,
                x_range=ends),)),
        430, True, (0.6, 0.4),
    )  # fmt: skip


_MEASURED = Style(BLACK, width=1.1)
_OF_MODELS = (ORANGE, BLUE, GREEN, PINK, VERMILLION, SKY)


def _select_between(time: np.ndarray, start: float, end: float) -> np.ndarray:
    """Rows from one time to another; all where there are none."""
    rows = np.flatnonzero((time >= start) & (time <= end))
    return np.arange(time.size) if rows.size < 2 else rows


def _build_curve(
    prediction: Prediction, label: str, time: np.ndarray, values: np.ndarray, rows: np.ndarray,
    style: Style,
) -> Curve:  # fmt: skip
    thinned = rows[thin_curves((np.asarray(values[rows], dtype=float),), THRESHOLDS.curve_points)]
    return Curve(
        label,
        *validation.break_at_gaps(prediction.segment[thinned], time[thinned], values[thinned]),
        style,
    )


def residual_picture(
    models: Sequence[str], logs: Sequence[str], joint: str, channel: str, by_log: bool = False
) -> Picture:
    """Draws the residual of a joint over a channel: samples, means with two standard errors.

    Args:
        models: files.
        logs: FILE or FILE@START:END.
        joint: its name.
        channel: an id of `Verdict.channels`.
        by_log: True: means of each log; else of each model.
    """
    parts: list[tuple[str, np.ndarray, np.ndarray]] = []
    unit = label = ""
    for model in models:
        model_on_logs = _compare_model(model, logs)
        p, j = model_on_logs.prediction, _find_joint(model_on_logs.prediction, joint)
        x, label = _read_channel(model_on_logs, j, channel)
        e, rows = validation.compute_residual(p)[:, j], p.used[:, j] & np.isfinite(x)
        name = f"{f'model {Path(model).stem}'}: " if len(models) > 1 else ""
        for run, log in enumerate(p.logs) if by_log else [(-1, "")]:
            log_rows = rows & (p.run == run) if by_log else rows
            parts.append((name + log, x[log_rows], e[log_rows]))
        unit = p.joints[j].effort_unit
    series: list[Series] = []
    for k, (name, x, e) in enumerate(parts):
        style = Style(_OF_MODELS[(k + 1) % len(_OF_MODELS)], width=1.6)
        thinned = thin_points(x, e, THRESHOLDS.curve_points)
        cloud = Style(style.color if len(parts) > 1 else GREY, width=2.6, opacity=0.35)
        series.append(Points(f"{name} samples".strip(), x[thinned], e[thinned], cloud))
        if x.size:
            means = f"{name} mean, 2 standard errors".strip()
            series.append(Means(means, *validation.compute_binned_means(x, e), style))
    if not any(x.size for _, x, _ in parts):
        raise DataError(f"joint {joint}: no row that counts has a value of {channel}")
    panel = Panel("", label, f"residual [{unit}]", tuple(series), zero=True)
    return Picture(f"residual_{joint}_{channel}", f"Joint {joint}: residual over {label}", "",
                   ((panel,),), 360)  # fmt: skip


def where_picture(model: str, logs: Sequence[str]) -> Picture:
    """Draws the share of each joint's residual variance that each channel explains.

    Of coordinates of the motion as `modeler compare` has it, of other columns as
    `compute_explained_share`.
    """
    model_on_logs = _compare_model(model, logs)
    p, names = (
        model_on_logs.prediction,
        [channel for channel, _ in _collect_channels(model_on_logs)],
    )
    items = model_on_logs.comparison.joints
    values = np.full((len(items), len(names)), np.nan)
    for i, item in enumerate(items):
        if item.structure is None:
            continue
        coordinate_ids = {c.id for c in validation.select_coordinates(p, item.index)}
        for k, name in enumerate(names):
            x, _ = _read_channel(model_on_logs, item.index, name)
            rows = p.used[:, item.index] & np.isfinite(x)
            e = validation.compute_residual(p)[rows, item.index]
            share = (
                item.structure.get_share(name)
                if name in coordinate_ids
                else compute_explained_share(x[rows], e)
            )
            values[i, k] = 100.0 * share
    texts = tuple(tuple("" if np.isnan(v) else f"{v:.0f}" for v in row) for row in values)
    joints = tuple(item.joint.name for item in items)
    heat = Heat("explained share", tuple(names), joints, values, texts, 100.0)
    return Picture(
        "where", "Residual: which joint follows what",
        "Share of each joint's residual variance, in percent, that a curve over that channel "
        "predicts on motion not used to draw it; empty: too few samples to show. Coordinates move "
        "together: shares overlap. Choose a cell to look at it.",
        ((Panel("", "", "joint", (heat,)),),), 110 + 34 * len(joints),
    )  # fmt: skip


def compute_explained_share(x: np.ndarray, e: np.ndarray, bins: int = 24, folds: int = 8) -> float:
    """Computes the cross-validated share of the variance of e that bin means over x explain.

    1 - sum (e - m)^2 / sum (e - mean e)^2, 0 at least; m is the mean of the bin over all other
    parts of the time. Bins are alike in count, or one for each value where there are few.

    Args:
        x: (n,) channel, in time order.
        e: (n,) residual.
        bins: at most.
        folds: consecutive parts.
    """
    if x.size < 4 * bins or np.ptp(x) == 0.0:
        return np.nan
    edges, which = np.unique(x, return_inverse=True)
    if edges.size > bins:
        edges = np.unique(np.quantile(x, np.linspace(0.0, 1.0, bins + 1)))
        which = np.searchsorted(edges[1:-1], x, side="right")
    fold, predicted = np.arange(x.size) * folds // x.size, np.empty(x.size)
    for part in range(folds):
        other = fold != part
        count = np.bincount(which[other], minlength=which.max() + 1)
        total = np.bincount(which[other], e[other], minlength=which.max() + 1)
        mean = np.where(count > 0, total / np.maximum(count, 1), e[other].mean())
        predicted[~other] = mean[which[~other]]
    whole = float(np.sum((e - e.mean()) ** 2))
    return max(0.0, 1.0 - float(np.sum((e - predicted) ** 2)) / whole) if whole else 0.0


def log_errors(model: str, logs: Sequence[str]) -> list[tuple[str, float, dict[str, float]]]:
    """Returns the relative error on each log, and by joint."""
    log_comparisons = _compare_model(model, logs).comparison.logs
    return [(one.log, float(one.relative_error), dict(one.joints)) for one in log_comparisons]


def poses(
    model: str, logs: Sequence[str], points: int = 6000
) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Returns time on the axis of the pictures and the position of every joint, rad or m."""
    p = _compare_model(model, logs).prediction
    time = concatenate_time(p)[0]
    rows = np.arange(0, time.size, -(-time.size // points))
    return time[rows], {info.name: p.q[rows, j] for j, info in enumerate(p.joints)}


def _collect_channels(model_on_logs: _ModelOnLogs) -> list[tuple[str, str]]:
    """Id and label: coordinates of the motion, then all other columns of the log."""
    coordinates = {c.id: c for j in range(len(model_on_logs.prediction.joints))
                   for c in validation.select_coordinates(model_on_logs.prediction, j)}  # fmt: skip
    first = model_on_logs.load_log(model_on_logs.logs[0])
    if first.source is not None:  # of a long log only windows are held
        return [(name, c.label) for name, c in coordinates.items()]
    motion_names = {f"{kind}{joint.name}" for joint in model_on_logs.prediction.joints
           for kind in ("q", "qd", "qdd", "tau")}  # fmt: skip
    others = [(name, name) for name in first.values if name not in {*motion_names, "segment"}]
    return [(name, c.label) for name, c in coordinates.items()] + others


def _read_channel(model_on_logs: _ModelOnLogs, j: int, channel: str) -> tuple[np.ndarray, str]:
    """Values of a channel on all rows, NaN where the log has none, and its label."""
    p = model_on_logs.prediction
    coordinate = next((c for c in validation.select_coordinates(p, j) if c.id == channel), None)
    if coordinate is not None:
        unit = validation.format_coordinate_unit(p, j, channel)
        values = validation.evaluate_coordinate(p, j, channel)
        return np.asarray(values, dtype=float), f"{coordinate.label} [{unit}]"
    channel_values, label = np.full(p.time.size, np.nan), channel
    for run, place in enumerate(model_on_logs.logs):
        rows = p.run == run
        log = model_on_logs.load_log(place)
        if channel in log.values and rows.any():
            channel_values[rows] = np.interp(p.time[rows], log.time, log.values[channel])
            unit = log.units.get(channel, "")
            label = f"{channel} [{unit}]" if unit else channel
    return channel_values, label


def _find_joint(prediction: Prediction, joint: str) -> int:
    return next(j for j, info in enumerate(prediction.joints) if info.name == joint)


def _compare_model(model: str, logs: Sequence[str]) -> _ModelOnLogs:
    """The model on logs; behind them may stand words of `--map`, as in a command."""
    cut = list(logs).index("--map") if "--map" in logs else len(logs)
    files, mapping = tuple(logs[:cut]), tuple(logs[cut + 1 :: 2])

    def run_comparison() -> _ModelOnLogs:
        loaded, compiled = _load_model(model)
        comparison, _ = checks.compare_logs(loaded, list(files), compiled, mapping)
        return _ModelOnLogs(comparison, model, compiled, files)

    return _cache_result(
        "judged", (_read_state(model), tuple(map(_read_state, files)), mapping), run_comparison, 4
    )


def _load_model(place: str) -> tuple[IdentifiedModel, CompiledModel]:
    def load_and_compile() -> tuple[IdentifiedModel, CompiledModel]:
        model = load_model(place)
        return model, workflow.compile(model)

    return _cache_result("model", _read_state(place), load_and_compile)
