"""What the process of the viewer answers: windows of logs, torques and residuals as pictures.

Every function takes plain arguments and answers with plain data or a `Picture`. Files are read once
and stay cached until they change.
"""

from collections import OrderedDict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from modeler.api import (
    Model,
    Robot,
    build_log_map,
    compile,
    open_model,
    open_robot,
    parse_time_range,
)
from modeler.api.checks import compare_logs
from modeler.api.front_end import DataError, JointSpec, Picture
from modeler.api.log_windows import LogWindows, guess_columns, list_robot_joints, open_log_windows
from modeler.api.model_on_logs import ModelOnLogs, Verdict, draw_residuals, draw_torques
from modeler.studio import places
from modeler.studio.log_mapping import LogGuess, build_default_joints, merge_map, parse_guess
from modeler.studio.thresholds import THRESHOLDS

T = TypeVar("T")
_CACHED: dict[str, OrderedDict[Any, Any]] = {}
_FACTS = 200  # logs of a project


def forget() -> None:
    """Lets go of all that was read."""
    _CACHED.clear()


def _cache_result(
    kind: str, key: Any, make: Callable[[], T], most: int = THRESHOLDS.cached_results
) -> T:
    """What was made for that key, or is made now; of each kind the last ones used stay."""
    entries = _CACHED.setdefault(kind, OrderedDict())
    if key not in entries:
        entries[key] = make()
        while len(entries) > most:
            entries.popitem(last=False)
    entries.move_to_end(key)
    result: T = entries[key]
    return result


def _read_state(place: str) -> tuple[str, int, int]:
    """A file as it is now; a window after it belongs to its name."""
    path = str(parse_time_range(place)[0])
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


def log_facts(place: str, words: Sequence[str] = (), robot: str = "") -> LogFacts:
    """Returns columns, units and extent of a log.

    Args:
        place: its file.
        words: of the mapping, as of `--map`.
        robot: robot file, whose [log] lies under them.
    """

    def read_facts() -> LogFacts:
        log = _load_log(place, words, robot)
        start, end, names = float(log.time[0]), float(log.time[-1]), tuple(log.values)
        return LogFacts(log.rows, start, end, names, log.units, log.is_coarse)

    key = (_read_state(place), tuple(words), robot and _read_state(robot))
    return _cache_result("facts", key, read_facts, _FACTS)


def log_window(
    place: str,
    names: Sequence[str],
    start: float,
    end: float,
    words: Sequence[str] = (),
    robot: str = "",
    points: int = THRESHOLDS.all_curve_points,
) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Returns time and values of columns of a log; see `LogWindows.thin_columns`."""
    return _load_log(place, words, robot).thin_columns(names, start, end, points)


def log_film(
    place: str,
    names: Sequence[str],
    words: Sequence[str] = (),
    robot: str = "",
    start: float = -np.inf,
    end: float = np.inf,
    rate: float = 30.0,
) -> dict[str, np.ndarray]:
    """Returns columns of a log, `rate` times a second; see `LogWindows.resample_columns`."""
    return _load_log(place, words, robot).resample_columns(names, start, end, rate)


def log_guess(place: str, robot: str = "") -> LogGuess:
    """Guesses the columns of a log by their names and ranges.

    Args:
        place: the log's file.
        robot: robot file; "" where there is none yet: joints are then counted from 1.
    """

    def build_guess() -> LogGuess:
        guess = guess_columns(place, _load_robot(robot) if robot else None)
        inspection, streams = guess.inspection, guess.inspection.streams
        count = 1 if inspection.positions is None else len(inspection.positions.names)
        joints = robot_joints(robot) or build_default_joints(count)
        choices, ranged = parse_guess(inspection.suggested_map, joints, guess.units)
        clocks = [part for part in streams if part.is_clock]
        alike = [part for part in streams if clocks and part.kind == clocks[0].kind]
        topic = clocks[0].name if len(alike) > 1 else ""
        doubts = () if guess.sampled else inspection.warnings
        return LogGuess(guess.units, choices, ranged, count, topic, doubts)

    key = (_read_state(place), robot and _read_state(robot))
    return _cache_result("guess", key, build_guess, _FACTS)


def _load_log(place: str, words: Sequence[str], robot: str) -> LogWindows:
    stated = _load_robot(robot).log_mapping if robot else {}
    key = (_read_state(place), tuple(words), robot and _read_state(robot))
    return _cache_result(
        "log",
        key,
        lambda: open_log_windows(place, merge_map(words, stated, robot), robot_joints(robot)),
        3,
    )


def _load_robot(place: str) -> Robot:
    return _cache_result("robot", _read_state(place), lambda: open_robot(place))


def robot_logging(place: str) -> tuple[tuple[JointSpec, ...], Mapping[str, Any]]:
    """Returns the joints of a robot file, and its [log]."""
    return robot_joints(place), dict(_load_robot(place).log_mapping)


def robot_joints(place: str) -> tuple[JointSpec, ...]:
    """Returns the joints of a robot file, without deriving; none without a file."""
    return list_robot_joints(_load_robot(place)) if place else ()


# Models, and their torques on logs.


def parameter_relations(model: str, names: Sequence[str]) -> dict[str, str]:
    """Returns what parameters of a model are the sums of, of those that are sums."""
    loaded = _load_model(model)
    return {name: loaded[name].relation for name in names if name in loaded}


def verdict(model: str, logs: Sequence[str]) -> Verdict:
    """Returns the result of `modeler compare MODEL LOG...` for every joint."""
    return _compare_model(model, logs).describe()


def torque_picture(models: Sequence[str], logs: Sequence[str], joint: str, *ends: float) -> Picture:
    """Draws measured and predicted torque of a joint; see `draw_torques`."""
    return draw_torques([_compare_model(model, logs) for model in models], joint, *ends)


def residual_picture(
    models: Sequence[str], logs: Sequence[str], joint: str, channel: str, by_log: bool = False
) -> Picture:
    """Draws the residual of a joint over a channel; see `draw_residuals`."""
    every = [_compare_model(model, logs) for model in models]
    return draw_residuals(every, joint, channel, by_log)


def where_picture(model: str, logs: Sequence[str]) -> Picture:
    """Draws the share of each joint's residual variance that each channel explains."""
    return _compare_model(model, logs).draw_explained_shares()


def log_errors(model: str, logs: Sequence[str]) -> list[tuple[str, float, dict[str, float]]]:
    """Returns the relative error on each log, and by joint."""
    log_comparisons = _compare_model(model, logs).comparison.logs
    return [(one.log, float(one.relative_error), dict(one.joints)) for one in log_comparisons]


def poses(model: str, logs: Sequence[str]) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Returns time on the axis of the pictures and the position of every joint, rad or m."""
    return _compare_model(model, logs).sample_motion()


def _compare_model(place: str, logs: Sequence[str]) -> ModelOnLogs:
    """The model on logs; behind them may stand words of `--map`, as in a command."""
    cut = list(logs).index("--map") if "--map" in logs else len(logs)
    files, mapping = tuple(logs[:cut]), tuple(logs[cut + 1 :: 2])
    state = _read_state(place)

    def run_comparison() -> ModelOnLogs:
        model = _load_model(place)
        compiled = _cache_result("compiled", state, lambda: compile(model))

        def open_log(log: str) -> LogWindows:
            names, joints = build_log_map(compiled), compiled.spec.joints
            key = (_read_state(str(parse_time_range(log)[0])), _read_state(place))
            return _cache_result("log", key, lambda: open_log_windows(log, names, joints), 3)

        comparison, _ = compare_logs(model, list(files), compiled, mapping)
        return ModelOnLogs(f"model {Path(place).stem}", comparison, files, open_log)

    key = (state, tuple(map(_read_state, files)), mapping)
    return _cache_result("judged", key, run_comparison, 4)


def _load_model(place: str) -> Model:
    return _cache_result("model", _read_state(place), lambda: open_model(place))
