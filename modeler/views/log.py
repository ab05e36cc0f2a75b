"""Logs: the page of what is in one, its channels and clock, and the noise of the motion."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from modeler.core.figure import SLATE, Panel, Picture, Points, Style, thin_points
from modeler.core.result import Figures, Presentation, Tables
from modeler.core.table import Cell, Table, format_percent
from modeler.excitation import ExcitingMotion
from modeler.logs import Channel, Clock, LogInspection, guess_role, split_label
from modeler.regression import (
    Bands,
    DataReport,
    Log,
    Observation,
    build_bands,
    estimate_position_noise,
)
from modeler.simulation import SimulatedLog, write_log
from modeler.views import page
from modeler.views.figures import build_curves, draw_log, draw_picture
from modeler.views.fit import build_noise_blocks, draw_noise_picture
from modeler.views.thresholds import THRESHOLDS

_HEAD = ("channel", "unit", "least", "greatest", "resolution", "missing", "remarks")


def build_log_page(
    inspection: LogInspection,
    doubts: Sequence[str],
    provenance: Sequence[str],
    bands: Bands | None = None,
) -> page.Page:
    """Builds the page of a log.

    Args:
        inspection: what is in the log.
        doubts: about it, those of a fit too.
        provenance: lines on how it was read.
        bands: of its fit; None: the noise of its positions alone.
    """
    head, *rows = tabulate_channels(inspection)
    table = page.PageTable(head, rows, kinds=dict.fromkeys(("unit", "remarks"), "text"))
    listed = page.Items([("", line) for line in doubts]) if doubts else page.Paragraph("None.")
    pictures, sampling = draw_channel_pictures(inspection), draw_sampling_picture(inspection)
    pictures += [] if sampling is None else [sampling]
    sections = [
        page.Section("Doubts", [listed]),
        page.Section("Channels", [table, *map(page.Figure, pictures)]),
    ]
    noise = build_noise_blocks(bands or build_bands(estimate_position_noise(inspection.positions)))
    if noise:
        sections.append(page.Section("Noise of the motion", noise))
    picture = draw_clock_picture(inspection)
    if inspection.clock is not None and picture is not None:
        sections.append(
            page.Section(
                "Clock", [page.Paragraph(describe_clock(inspection.clock)), page.Figure(picture)]
            )
        )
    if inspection.suggested_map:
        sections.append(
            page.Section("A [log] to start from", [page.Code(inspection.suggested_map)])
        )
    return page.Page(
        f"What is in {inspection.name}",
        (str(len(doubts)), "doubts" if len(doubts) != 1 else "doubt"),
        sections,
        page.Origin(logs=(inspection.name,)),
        [
            ("rows", str(inspection.rows)),
            ("clock", describe_clock(inspection.clock) if inspection.clock else "none"),
        ],
        provenance=[*inspection.notes, *provenance],
        command="log",
    )


def describe_clock(clock: Clock) -> str:
    """Describes the clock of a log in a line."""
    rate = f"{clock.rate:.6g} Hz" if clock.rate > 0.0 else "unknown rate"
    parts = [f"{clock.column}: {rate} over {clock.duration:.4g} s"]
    uneven = f"jitter {format_percent(clock.jitter)} of a step"
    parts += [uneven if clock.jitter > 1e-6 else "even"] * (clock.rate > 0.0)
    if clock.gaps:
        parts.append(
            f"{clock.gaps} gap{'s' * (clock.gaps > 1)}, about {clock.lost_rows} rows lost, "
            f"the widest {clock.largest_gap:.4g} s at {clock.largest_gap_start:.4g} s"
        )
    else:
        parts.append("no gaps")
    parts.append(
        f"{clock.repeated_steps} repeated times" if clock.repeated_steps else "no time twice"
    )
    if clock.backward_steps:
        parts.append(
            f"{clock.backward_steps} steps back: the clock restarts, or rows are not in order"
        )
    return ", ".join(parts)


def tabulate_channels(inspection: LogInspection) -> list[list[str]]:
    """Returns a head and one row a channel, as text."""
    rows = [list(_HEAD)]
    for channel in inspection.channels:
        remarks = ["never changes"] if channel.is_constant else []
        remarks += [f"each value held for {channel.held_rows} rows"] * (channel.held_rows > 1)
        remarks += [
            f"stays at {x:.4g} in {format_percent(share)} of the rows"
            for x, share in channel.limits
        ]
        rows.append(
            [
                channel.name,
                f"{channel.unit}?" if channel.is_unit_guessed else channel.unit or "-",
                f"{channel.low:.5g}",
                f"{channel.high:.5g}",
                f"{channel.resolution:.3g}" if channel.resolution else "-",
                str(channel.missing_rows or "-"),
                "; ".join(remarks),
            ]
        )
    return rows


def draw_log_pictures(inspection: LogInspection, bands: Bands | None = None) -> list[Picture]:
    """Draws all pictures of a log; `bands` as of `build_log_page`."""
    noise = draw_noise_picture(bands or build_bands(estimate_position_noise(inspection.positions)))
    others = draw_sampling_picture(inspection), noise, draw_clock_picture(inspection)
    return [*draw_channel_pictures(inspection), *(p for p in others if p is not None)]


def draw_channel_pictures(inspection: LogInspection) -> list[Picture]:
    """Draws one picture for the columns of each kind, against time."""
    groups: dict[str, list[str]] = {}
    for name in inspection.values:
        groups.setdefault(split_label(name)[0], []).append(name)
    time = f"time column {inspection.clock.column}" if inspection.clock is not None else ""
    return [
        _draw_channels(inspection, number, template, names)
        for number, (template, names) in enumerate(groups.items(), start=1)
        if template != "time" and not (len(names) == 1 and time.endswith(names[0]))
    ]


def _draw_channels(
    inspection: LogInspection, number: int, template: str, names: Sequence[str]
) -> Picture:
    title = template.replace("{}", "*")
    unit = next((c.unit for c in inspection.channels if c.unit and names[0] in c.name), "")
    label = f"{title} [{unit}]" if unit else title
    drawn = build_curves(
        names,
        inspection.time,
        [inspection.values[name] for name in names],
        THRESHOLDS.max_curve_points,
    )
    panel = Panel("", _choose_time_label(inspection), label, drawn)
    caption = (
        f"{title} against time, as logged, {len(names)} columns: every extreme is drawn, values "
        "between them are thinned. A value that is missing breaks its line."
    )
    return Picture(f"channels_{number}", title, caption, ((panel,),), 320)


def draw_sampling_picture(inspection: LogInspection) -> Picture | None:
    """Draws some rows of each position and torque, one by one; None of long logs and at rest."""
    if inspection.clock is None or inspection.time.size != inspection.rows:
        return None
    pairs = zip(inspection.channels, inspection.values.items(), strict=True)
    moving = [
        _build_sampling_panel(inspection, channel, values)
        for channel, (name, values) in pairs
        if guess_role(name) in ("q", "tau", "current") and not channel.is_constant
    ]
    if not moving:
        return None
    per_row = min(len(moving), THRESHOLDS.sampling_panels)
    moving += [Panel("", "", "", ())] * (-len(moving) % per_row)
    grid = tuple(tuple(moving[k : k + per_row]) for k in range(0, len(moving), per_row))
    caption = (
        "Some rows as logged, each a dot, where its steps show best: levels are those of its "
        "lattice, level runs of one length a value that is held, uneven distances the clock."
    )
    return Picture("sampling", "How each channel is sampled", caption, grid, 60 + 200 * len(grid))


def _build_sampling_panel(inspection: LogInspection, channel: Channel, values: np.ndarray) -> Panel:
    rows = min(THRESHOLDS.sampling_rows, len(values))
    change = np.append(0.0, np.cumsum(np.abs(np.nan_to_num(np.diff(values)))))
    travel = change[rows - 1 :] - change[: len(change) - rows + 1]
    if channel.resolution and channel.held_rows == 1:  # slow enough to see its steps
        travel = -np.abs(travel - 0.5 * rows * channel.resolution)
    first = int(np.argmax(travel))
    part = slice(first, first + rows)
    words = [f"steps of {channel.resolution:.3g}"] * bool(channel.resolution)
    words += [f"held for {channel.held_rows} rows"] * (channel.held_rows > 1)
    dots = Points("as logged", inspection.time[part], values[part], Style(SLATE, width=2.0))
    title = f"{channel.name}: {', '.join(words)}" if words else channel.name
    label = f"{channel.name} [{channel.unit}]" if channel.unit else channel.name
    return Panel(title, _choose_time_label(inspection), label, (dots,))


def draw_clock_picture(inspection: LogInspection) -> Picture | None:
    """Draws the steps of the clock against time; None without a clock."""
    time, steps = inspection.steps[0], 1e3 * inspection.steps[1]
    if inspection.clock is None or not np.isfinite(steps).any():
        return None
    rows = thin_points(time, steps)
    dots = Points("step", time[rows], steps[rows], Style(SLATE, width=2.0))
    known = steps[np.isfinite(steps)]
    reach = (min(0.0, float(known.min())), float(max(known.max(), 2.0 * np.median(known))))
    panel = Panel(
        "", _choose_time_label(inspection), "step of the clock [ms]", (dots,), y_range=reach
    )
    caption = (
        "Time from each row to the next. A level line is a steady clock; dots above it are gaps, "
        "dots at or below 0 times that repeat or go back."
    )
    return Picture("clock", "Clock", caption, ((panel,),), 260)


def _choose_time_label(inspection: LogInspection) -> str:
    return "row" if inspection.clock is None else "time [s]"


# Logs, observations of them, and motions.


def _summarise_inspection(inspection: LogInspection) -> str:
    clock = "no clock" if inspection.clock is None else describe_clock(inspection.clock)
    lines = [
        f"{inspection.name}: {inspection.rows} rows, {len(inspection.channels)} channels",
        clock,
    ]
    lines += [f"note: {note}" for note in inspection.notes]
    return "\n".join(
        [*lines, *([f"warning: {doubt}" for doubt in inspection.warnings] or ["no warnings"])]
    )


def _collect_inspection_tables(inspection: LogInspection) -> Tables:
    head, *rows = tabulate_channels(inspection)
    return {"channels": lambda: Table.build(f"channels of {inspection.name}", head, rows)}


def _collect_inspection_figures(inspection: LogInspection) -> Figures:
    return {
        picture.name: partial(draw_picture, picture) for picture in draw_log_pictures(inspection)
    }


def _summarise_log(log: Log) -> str:
    span = float(log.time[-1] - log.time[0])
    channels = [name for name in ("qd", "qdd", "commanded") if getattr(log, name) is not None]
    lines = [
        f"{log.name}: {log.rows} rows, {span:.4g} s at {1.0 / log.step:.4g} Hz, joints "
        f"{', '.join(log.joints)}"
    ]
    lines.append("channels: " + ", ".join(["q", "tau", *channels, *log.extra]))
    lines += [f"{column}: {count} rows without a value" for column, count in log.missing.items()]
    return "\n".join([*lines, *log.notes])


def _collect_log_channels(log: Log) -> dict[str, np.ndarray]:
    """Every column by name; units are SI."""
    kinds = {"q": log.q, "qd": log.qd, "qdd": log.qdd, "qc": log.commanded, "tau": log.tau}
    return {
        f"{prefix}{name}": values[:, j]
        for prefix, values in kinds.items()
        if values is not None
        for j, name in enumerate(log.joints)
    } | dict(log.extra)


def _collect_log_tables(log: Log) -> Tables:
    def build_channel_table() -> Table:
        rows = [
            _build_channel_row(name, values) for name, values in _collect_log_channels(log).items()
        ]
        head = "channel, least, largest, rms, missing"
        return Table.build(f"channels of {log.name}, SI units", head, rows)

    def build_data_table() -> Table:
        """Builds the table of every row of the log; a long one."""
        columns = {"time": log.time, **_collect_log_channels(log)}
        rows = tuple(map(tuple, np.column_stack([*columns.values()]).tolist()))
        return Table(log.name, tuple((name, "") for name in columns), rows)

    return {"channels": build_channel_table, "data": build_data_table}


def _build_channel_row(name: str, values: np.ndarray) -> tuple[Cell, ...]:
    there = values[np.isfinite(values)]
    if not there.size:
        return name, None, None, None, int(values.size)
    return (
        name,
        float(there.min()),
        float(there.max()),
        float(np.sqrt(np.mean(there**2))),
        int(values.size - there.size),
    )


def _collect_log_figures(log: Log | SimulatedLog) -> Figures:
    title = log.name if isinstance(log, Log) else f"{log.robot}, simulated"
    return {"channels": lambda: draw_log(title, log.joints, log.time, log.q, log.tau)}


def _summarise_simulated_log(log: SimulatedLog) -> str:
    lines = [
        f"{log.robot}, simulated: {len(log.time)} samples of {len(log.joints)} joints, "
        f"{float(log.time[-1] - log.time[0]):.4g} s, seed {log.settings.seed}"
    ]
    for effect in log.truth.hidden_effects:
        where = f" on {effect.joint}" if effect.joint else ""
        values = ", ".join(f"{name} = {value:.4g}" for name, value in effect.values.items())
        lines.append(f"hidden: {effect.effect}{where}: {values}")
    return "\n".join(lines)


def _collect_simulated_tables(log: SimulatedLog) -> Tables:
    truth = log.truth
    rows = [
        (name, value, name in truth.random_parameters) for name, value in truth.parameters.items()
    ]
    title = f"{log.robot}: true parameters"
    return {"truth": lambda: Table.build(title, "parameter, value [SI], drawn", rows)}


def _summarise_observation(observation: Observation) -> str:
    rows, columns = int(observation.used.sum()), len(observation.names)
    first = (
        f"{observation.robot}: {rows} rows of {len(observation.time)} samples, {columns} "
        f"columns, from {', '.join(observation.logs)}"
    )
    return "\n".join([first, *observation.report.format_lines()])


def _collect_report_tables(report: DataReport) -> Tables:
    joints = [(j.name, j.used, j.samples, j.slow, j.speed_floor, j.unit) for j in report.joints]
    logs = [
        (log.name, log.rows, log.rate, log.samples, log.decimation, log.pieces, log.derivatives)
        for log in report.logs
    ]
    of_joint = "joint, rows, samples, share slow, speed floor, unit"
    of_log = "log, rows, rate [Hz], samples, one of, pieces, derivatives"
    return {
        "joints": lambda: Table.build("rows of each joint", of_joint, joints),
        "logs": lambda: Table.build("logs", of_log, logs),
    }


def _summarise_motion(motion: ExcitingMotion) -> str:
    return "\n".join(
        [
            f"{motion.robot}: a motion of {motion.series.duration:g} s, condition number "
            f"{motion.quality.condition:.4g}",
            *motion.format_lines(),
        ]
    )


def _tabulate_limits(motion: ExcitingMotion) -> Table:
    b, u = motion.bounds, motion.usage
    columns = (u.lower, u.upper, b.lower, b.upper, u.speed, b.speed, u.acceleration, b.acceleration)
    return Table.build(
        f"{motion.robot}: what the motion uses of the limits, SI units",
        "joint, lower, upper, lower limit, upper limit, speed, speed limit, acceleration, "
        "acceleration limit",
        [(name, *(float(column[j]) for column in columns)) for j, name in enumerate(b.joints)],
    )


PRESENTATIONS = {
    LogInspection: Presentation(
        "an inspection of a log",
        _summarise_inspection,
        _collect_inspection_tables,
        _collect_inspection_figures,
        document=lambda inspection, notes: build_log_page(inspection, inspection.warnings, notes),
    ),
    Log: Presentation("a log", _summarise_log, _collect_log_tables, _collect_log_figures),
    SimulatedLog: Presentation(
        "a simulated log",
        _summarise_simulated_log,
        _collect_simulated_tables,
        _collect_log_figures,
        files=dict.fromkeys((".parquet", ".csv"), write_log),
    ),
    Observation: Presentation(
        "an observation", _summarise_observation, lambda o: _collect_report_tables(o.report)
    ),
    DataReport: Presentation(
        "a report", lambda r: "\n".join(r.format_lines()), _collect_report_tables
    ),
    ExcitingMotion: Presentation(
        "a motion", _summarise_motion, lambda m: {"limits": partial(_tabulate_limits, m)}
    ),
}
