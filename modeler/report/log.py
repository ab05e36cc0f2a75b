"""What is in a log, as pictures and as a page."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from modeler.core.figure import Panel, Picture, Points
from modeler.core.result import Figures, Presentation, Tables
from modeler.core.style import SLATE, Style
from modeler.core.table import Cell, Table, percent
from modeler.core.thinning import thin_points
from modeler.excitation import Exciting
from modeler.logs import Clock, LogInspection, template_of
from modeler.observation import Bands, DataReport, Log, Observation, bands_of, noise_of_positions
from modeler.report.blocks import Code, Figure, Items, PageTable, Paragraph
from modeler.report.figures import curves, log_figure, picture_figure
from modeler.report.noise import noise_blocks, noise_picture
from modeler.report.page import Origin, Page, Section
from modeler.simulation import SimulatedLog, write_log

_HEAD = ("channel", "unit", "least", "greatest", "resolution", "missing", "remarks")
_LIMIT = 600  # points of one curve


def log_page(
    look: LogInspection, doubts: Sequence[str], provenance: Sequence[str],
    bands: Bands | None = None,
) -> Page:  # fmt: skip
    """The page of a log.

    Args:
        look: what is in the log.
        doubts: about it, those of a fit too.
        provenance: lines on how it was read.
        bands: of its fit; None: the noise of its positions alone.
    """
    head, *rows = channel_rows(look)
    table = PageTable(head, rows, kinds=dict.fromkeys(("unit", "remarks"), "text"))
    listed = Items([("", line) for line in doubts]) if doubts else Paragraph("None.")
    sections = [
        Section("Doubts", [listed]),
        Section("Channels", [table, *map(Figure, channel_pictures(look))]),
    ]
    noise = noise_blocks(bands or bands_of(noise_of_positions(look.positions)))
    if noise:
        sections.append(Section("Noise of the motion", noise))
    picture = clock_picture(look)
    if look.clock is not None and picture is not None:
        sections.append(Section("Clock", [Paragraph(clock_line(look.clock)), Figure(picture)]))
    if look.suggested:
        sections.append(Section("A [log] to start from", [Code(look.suggested)]))
    return Page(
        f"What is in {look.name}",
        (str(len(doubts)), "doubts" if len(doubts) != 1 else "doubt"),
        sections,
        Origin(logs=(look.name,)),
        [("rows", str(look.rows)), ("clock", clock_line(look.clock) if look.clock else "none")],
        provenance=[*look.notes, *provenance],
        command="log",
    )


def clock_line(clock: Clock) -> str:
    """The clock in words."""
    rate = f"{clock.rate:.6g} Hz" if clock.rate > 0.0 else "unknown rate"
    parts = [f"{clock.column}: {rate} over {clock.duration:.4g} s"]
    uneven = f"jitter {percent(clock.jitter)} of a step"
    parts += [uneven if clock.jitter > 1e-6 else "even"] * (clock.rate > 0.0)
    if clock.gaps:
        parts.append(
            f"{clock.gaps} gap{'s' * (clock.gaps > 1)}, about {clock.lost} rows lost, "
            f"the widest {clock.largest:.4g} s at {clock.at:.4g} s"
        )
    else:
        parts.append("no gaps")
    parts.append(f"{clock.repeated} repeated times" if clock.repeated else "no time twice")
    if clock.back:
        parts.append(f"{clock.back} steps back: the clock restarts, or rows are not in order")
    return ", ".join(parts)


def channel_rows(look: LogInspection) -> list[list[str]]:
    """Header and one row a channel, as text."""
    rows = [list(_HEAD)]
    for channel in look.channels:
        remarks = ["never changes"] if channel.constant else []
        remarks += [
            f"stays at {x:.4g} in {percent(share)} of the rows" for x, share in channel.limits
        ]
        rows.append([
            channel.name,
            f"{channel.unit}?" if channel.guessed else channel.unit or "-",
            f"{channel.low:.5g}",
            f"{channel.high:.5g}",
            f"{channel.resolution:.3g}" if channel.resolution else "-",
            str(channel.missing or "-"),
            "; ".join(remarks),
        ])  # fmt: skip
    return rows


def log_pictures(look: LogInspection, bands: Bands | None = None) -> list[Picture]:
    """All pictures of a log; `bands` as of `log_page`."""
    noise = noise_picture(bands or bands_of(noise_of_positions(look.positions)))
    return [*channel_pictures(look), *(p for p in (noise, clock_picture(look)) if p is not None)]


def channel_pictures(look: LogInspection) -> list[Picture]:
    """One picture for the columns of each kind, against time."""
    groups: dict[str, list[str]] = {}
    for name in look.values:
        groups.setdefault(template_of(name)[0], []).append(name)
    time = f"time column {look.clock.column}" if look.clock is not None else ""
    return [
        _against_time(look, number, template, names)
        for number, (template, names) in enumerate(groups.items(), start=1)
        if template != "time" and not (len(names) == 1 and time.endswith(names[0]))
    ]


def _against_time(look: LogInspection, number: int, template: str, names: Sequence[str]) -> Picture:
    title = template.replace("{}", "*")
    unit = next((c.unit for c in look.channels if c.unit and names[0] in c.name), "")
    label = f"{title} [{unit}]" if unit else title
    drawn = curves(names, look.time, [look.values[name] for name in names], _LIMIT)
    panel = Panel("", _time_label(look), label, drawn)
    caption = (
        f"{title} against time, as logged, {len(names)} columns: every extreme is drawn, values "
        "between them are thinned. A value that is missing breaks its line."
    )
    return Picture(f"channels_{number}", title, caption, ((panel,),), 320)


def clock_picture(look: LogInspection) -> Picture | None:
    """The steps of the clock against time; None without a clock."""
    time, steps = look.steps[0], 1e3 * look.steps[1]
    if look.clock is None or not np.isfinite(steps).any():
        return None
    rows = thin_points(time, steps)
    dots = Points("step", time[rows], steps[rows], Style(SLATE, width=2.0))
    known = steps[np.isfinite(steps)]
    reach = (min(0.0, float(known.min())), float(max(known.max(), 2.0 * np.median(known))))
    panel = Panel("", _time_label(look), "step of the clock [ms]", (dots,), y_range=reach)
    caption = (
        "Time from each row to the next. A level line is a steady clock; dots above it are gaps, "
        "dots at or below 0 times that repeat or go back."
    )
    return Picture("clock", "Clock", caption, ((panel,),), 260)


def _time_label(look: LogInspection) -> str:
    return "row" if look.clock is None else "time [s]"


# Logs, observations of them, and motions.


def _inspection_summary(look: LogInspection) -> str:
    clock = "no clock" if look.clock is None else clock_line(look.clock)
    lines = [f"{look.name}: {look.rows} rows, {len(look.channels)} channels", clock]
    lines += [f"note: {note}" for note in look.notes]
    return "\n".join([*lines, *([f"doubt: {doubt}" for doubt in look.doubts] or ["no doubts"])])


def _inspection_tables(look: LogInspection) -> Tables:
    head, *rows = channel_rows(look)
    return {"channels": lambda: Table.of(f"channels of {look.name}", head, rows)}


def _inspection_figures(look: LogInspection) -> Figures:
    return {picture.name: partial(picture_figure, picture) for picture in log_pictures(look)}


def _log_summary(log: Log) -> str:
    span = float(log.time[-1] - log.time[0])
    channels = [name for name in ("qd", "qdd", "commanded") if getattr(log, name) is not None]
    lines = [f"{log.name}: {log.rows} rows, {span:.4g} s at {1.0 / log.step:.4g} Hz, joints "
             f"{', '.join(log.joints)}"]  # fmt: skip
    lines.append("channels: " + ", ".join(["q", "tau", *channels, *log.extra]))
    lines += [f"{column}: {count} rows without a value" for column, count in log.missing.items()]
    return "\n".join([*lines, *log.notes])


def _log_channels(log: Log) -> dict[str, np.ndarray]:
    """Every column by name; units are SI."""
    kinds = {"q": log.q, "qd": log.qd, "qdd": log.qdd, "qc": log.commanded, "tau": log.tau}
    return {
        f"{prefix}{name}": values[:, j]
        for prefix, values in kinds.items()
        if values is not None
        for j, name in enumerate(log.joints)
    } | dict(log.extra)


def _log_tables(log: Log) -> Tables:
    def channels() -> Table:
        rows = [_channel(name, values) for name, values in _log_channels(log).items()]
        head = "channel, least, largest, rms, missing"
        return Table.of(f"channels of {log.name}, SI units", head, rows)

    def data() -> Table:
        """Every row; a long table."""
        columns = {"time": log.time, **_log_channels(log)}
        rows = tuple(map(tuple, np.column_stack([*columns.values()]).tolist()))
        return Table(log.name, tuple((name, "") for name in columns), rows)

    return {"channels": channels, "data": data}


def _channel(name: str, values: np.ndarray) -> tuple[Cell, ...]:
    there = values[np.isfinite(values)]
    if not there.size:
        return name, None, None, None, int(values.size)
    return (name, float(there.min()), float(there.max()), float(np.sqrt(np.mean(there**2))),
            int(values.size - there.size))  # fmt: skip


def _log_figures(log: Log | SimulatedLog) -> Figures:
    title = log.name if isinstance(log, Log) else f"{log.robot}, simulated"
    return {"channels": lambda: log_figure(title, log.joints, log.time, log.q, log.tau)}


def _simulated_summary(log: SimulatedLog) -> str:
    lines = [f"{log.robot}, simulated: {len(log.time)} samples of {len(log.joints)} joints, "
             f"{float(log.time[-1] - log.time[0]):.4g} s, seed {log.settings.seed}"]  # fmt: skip
    for effect in log.truth.hidden:
        where = f" on {effect.joint}" if effect.joint else ""
        values = ", ".join(f"{name} = {value:.4g}" for name, value in effect.values.items())
        lines.append(f"hidden: {effect.effect}{where}: {values}")
    return "\n".join(lines)


def _simulated_tables(log: SimulatedLog) -> Tables:
    truth = log.truth
    rows = [(name, value, name in truth.drawn) for name, value in truth.parameters.items()]
    title = f"{log.robot}: true parameters"
    return {"truth": lambda: Table.of(title, "parameter, value [SI], drawn", rows)}


def _observation_summary(observation: Observation) -> str:
    rows, columns = int(observation.used.sum()), len(observation.names)
    first = (f"{observation.robot}: {rows} rows of {len(observation.time)} samples, {columns} "
             f"columns, from {', '.join(observation.logs)}")  # fmt: skip
    return "\n".join([first, *observation.report.lines()])


def _report_tables(report: DataReport) -> Tables:
    joints = [(j.name, j.used, j.samples, j.slow, j.speed_floor, j.unit) for j in report.joints]
    logs = [(log.name, log.rows, log.rate, log.samples, log.decimation, log.pieces, log.derivatives)
            for log in report.logs]  # fmt: skip
    of_joint = "joint, rows, samples, share slow, speed floor, unit"
    of_log = "log, rows, rate [Hz], samples, one of, pieces, derivatives"
    return {
        "joints": lambda: Table.of("rows of each joint", of_joint, joints),
        "logs": lambda: Table.of("logs", of_log, logs),
    }


def _motion_summary(motion: Exciting) -> str:
    return "\n".join([f"{motion.robot}: a motion of {motion.series.duration:g} s, condition number "
                      f"{motion.quality.condition:.4g}", *motion.lines()])  # fmt: skip


def _limits(motion: Exciting) -> Table:
    b, u = motion.bounds, motion.used
    columns = (u.lower, u.upper, b.lower, b.upper, u.speed, b.speed, u.acceleration, b.acceleration)
    return Table.of(
        f"{motion.robot}: what the motion uses of the limits, SI units",
        "joint, lower, upper, lower limit, upper limit, speed, speed limit, acceleration, "
        "acceleration limit",
        [(name, *(float(column[j]) for column in columns)) for j, name in enumerate(b.joints)],
    )


PRESENTATIONS = {
    LogInspection: Presentation("a look at a log", _inspection_summary, _inspection_tables,
                                _inspection_figures,
                                document=lambda look, notes: log_page(look, look.doubts, notes)),
    Log: Presentation("a log", _log_summary, _log_tables, _log_figures),
    SimulatedLog: Presentation("a simulated log", _simulated_summary, _simulated_tables,
                               _log_figures, files=dict.fromkeys((".parquet", ".csv"), write_log)),
    Observation: Presentation("an observation", _observation_summary,
                              lambda o: _report_tables(o.report)),
    DataReport: Presentation("a report", lambda r: "\n".join(r.lines()), _report_tables),
    Exciting: Presentation("a motion", _motion_summary, lambda m: {"limits": partial(_limits, m)}),
}  # fmt: skip
