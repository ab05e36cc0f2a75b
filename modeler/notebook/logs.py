"""Logs, observations of them, and motions."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from modeler.core.presented import Figures, Presentation, Tables, present
from modeler.core.table import Cell, Table
from modeler.excite.result import Exciting
from modeler.logs.look import Look
from modeler.notebook.figures import log_figure, picture_figure
from modeler.observation import DataReport, Log, Observation
from modeler.pages.log import channel_rows, clock_line, log_pictures
from modeler.simulate import SimulatedLog


def present_logs() -> None:
    """Look, Log, SimulatedLog, Observation, DataReport, Exciting."""
    present(Look, Presentation("a look at a log", _look_summary, _look_tables, _look_figures))
    present(Log, Presentation("a log", _log_summary, _log_tables, _log_figures))
    present(SimulatedLog, Presentation("a simulated log", _simulated_summary, _simulated_tables,
                                       _simulated_figures))  # fmt: skip
    present(Observation, Presentation("an observation", _observation_summary,
                                      _observation_tables))  # fmt: skip
    present(DataReport, Presentation("a report", lambda r: "\n".join(r.lines()), _report_tables))
    present(Exciting, Presentation("a motion", _motion_summary, _motion_tables))


def _look_summary(seen: Look) -> str:
    clock = "no clock" if seen.clock is None else clock_line(seen.clock)
    lines = [f"{seen.name}: {seen.rows} rows, {len(seen.channels)} channels", clock]
    lines += [f"note: {note}" for note in seen.notes]
    return "\n".join([*lines, *([f"doubt: {doubt}" for doubt in seen.doubts] or ["no doubts"])])


def _look_tables(seen: Look) -> Tables:
    head, *rows = channel_rows(seen)
    columns = tuple((name, "") for name in head)
    return {"channels": lambda: Table(f"channels of {seen.name}", columns, tuple(map(tuple, rows)))}


def _look_figures(seen: Look) -> Figures:
    return {picture.name: partial(picture_figure, picture) for picture in log_pictures(seen)}


def _log_summary(log: Log) -> str:
    span = float(log.time[-1] - log.time[0])
    channels = [name for name in ("qd", "qdd", "commanded") if getattr(log, name) is not None]
    lines = [f"{log.name}: {log.rows} rows, {span:.4g} s at {1.0 / log.step:.4g} Hz, joints "
             f"{', '.join(log.joints)}"]  # fmt: skip
    lines.append("channels: " + ", ".join(["q", "tau", *channels, *log.extra]))
    lines += [f"{column}: {count} rows without a value" for column, count in log.missing.items()]
    return "\n".join([*lines, *log.notes])


def _log_channels(log: Log) -> Iterator[tuple[str, np.ndarray]]:
    """Every column by name; units are SI."""
    pairs = (("q", log.q), ("qd", log.qd), ("qdd", log.qdd), ("qc", log.commanded),
             ("tau", log.tau))  # fmt: skip
    for prefix, values in pairs:
        for j, name in enumerate(log.joints) if values is not None else ():
            yield f"{prefix}{name}", values[:, j]  # type: ignore[index]
    yield from log.extra.items()


def _log_tables(log: Log) -> Tables:
    rows = tuple(_channel(name, values) for name, values in _log_channels(log))
    return {"channels": lambda: _channels(log.name, rows), "data": lambda: _data(log)}


def _channel(name: str, values: np.ndarray) -> tuple[Cell, ...]:
    there = values[np.isfinite(values)]
    if not there.size:
        return name, None, None, None, int(values.size)
    return (name, float(there.min()), float(there.max()), float(np.sqrt(np.mean(there**2))),
            int(values.size - there.size))  # fmt: skip


def _channels(title: str, rows: tuple[tuple[Cell, ...], ...]) -> Table:
    names = ("channel", "least", "largest", "rms", "missing")
    return Table(f"channels of {title}, SI units", tuple((name, "") for name in names), rows)


def _data(log: Log) -> Table:
    """Every row; a long table."""
    columns = {"time": log.time, **dict(_log_channels(log))}
    rows = tuple(map(tuple, np.column_stack([*columns.values()]).tolist()))
    return Table(log.name, tuple((name, "") for name in columns), rows)


def _log_figures(log: Log) -> Figures:
    return {"channels": lambda: log_figure(log.name, log.joints, log.time, log.q, log.tau)}


def _simulated_summary(log: SimulatedLog) -> str:
    lines = [f"{log.robot}, simulated: {len(log.time)} samples of {len(log.joints)} joints, "
             f"{float(log.time[-1] - log.time[0]):.4g} s, seed {log.settings.seed}"]  # fmt: skip
    for effect in log.truth.hidden:
        where = f" on {effect.joint}" if effect.joint else ""
        values = ", ".join(f"{name} = {value:.4g}" for name, value in effect.values.items())
        lines.append(f"hidden: {effect.effect}{where}: {values}")
    return "\n".join(lines)


def _simulated_tables(log: SimulatedLog) -> Tables:
    rows = tuple((name, value, name in log.truth.drawn)
                 for name, value in log.truth.parameters.items())  # fmt: skip
    truth = Table(
        f"{log.robot}: true parameters", (("parameter", ""), ("value", "SI"), ("drawn", "")), rows
    )
    return {"truth": lambda: truth}


def _simulated_figures(log: SimulatedLog) -> Figures:
    title = f"{log.robot}, simulated"
    return {"channels": lambda: log_figure(title, log.joints, log.time, log.q, log.tau)}


def _observation_summary(observation: Observation) -> str:
    rows, columns = int(observation.used.sum()), len(observation.names)
    first = (f"{observation.robot}: {rows} rows of {len(observation.time)} samples, {columns} "
             f"columns, from {', '.join(observation.logs)}")  # fmt: skip
    return "\n".join([first, *observation.report.lines()])


def _observation_tables(observation: Observation) -> Tables:
    return _report_tables(observation.report)


def _report_tables(report: DataReport) -> Tables:
    joints = tuple((j.name, j.used, j.samples, j.slow, j.speed_floor, j.unit)
                   for j in report.joints)  # fmt: skip
    logs = tuple((log.name, log.rows, log.rate, log.samples, log.decimation, log.pieces,
                  log.derivatives) for log in report.logs)  # fmt: skip
    of_joint = ("joint", "rows", "samples", "share slow", "speed floor", "unit")
    of_log = ("log", "rows", "rate", "samples", "one of", "pieces", "derivatives")
    return {
        "joints": lambda: Table("rows of each joint", tuple((n, "") for n in of_joint), joints),
        "logs": lambda: Table(
            "logs", tuple((n, "Hz" if n == "rate" else "") for n in of_log), logs
        ),
    }


def _motion_summary(motion: Exciting) -> str:
    return "\n".join([f"{motion.robot}: a motion of {motion.series.duration:g} s, condition number "
                      f"{motion.quality.condition:.4g}", *motion.lines()])  # fmt: skip


def _motion_tables(motion: Exciting) -> Tables:
    b, u = motion.bounds, motion.used
    rows = tuple(
        (name, float(u.lower[j]), float(u.upper[j]), float(b.lower[j]), float(b.upper[j]),
         float(u.speed[j]), float(b.speed[j]), float(u.acceleration[j]), float(b.acceleration[j]))
        for j, name in enumerate(b.joints)
    )  # fmt: skip
    names = ("joint", "lower", "upper", "lower limit", "upper limit", "speed", "speed limit",
             "acceleration", "acceleration limit")  # fmt: skip
    title = f"{motion.robot}: what the motion uses of the limits, SI units"
    return {"limits": lambda: Table(title, tuple((n, "") for n in names), rows)}
