"""What is in a log, as pictures and as a page."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from modeler.logs.guess import template_of
from modeler.logs.look import Channel, Clock, Look
from modeler.pages.sheet import (
    Cell,
    Code,
    Figure,
    Items,
    Lead,
    Origin,
    Section,
    Sheet,
    Table,
    write_page,
)
from modeler.pictures.picture import COLORS, SLATE, Curve, Panel, Picture, Points, Style
from modeler.pictures.thinning import thin_curves, thin_points

_HEAD = ("channel", "unit", "least", "greatest", "resolution", "missing", "remarks")
_LIMIT = 600  # points of one curve


def write_log_page(
    path: Path, seen: Look, doubts: Sequence[str], provenance: Sequence[str]
) -> Path:
    """Write the page; returns the path of the file written.

    Args:
        path: an `.html` file, or a folder, which then gets `log.html`.
        seen: what is in the log.
        doubts: about it, those of a fit too.
        provenance: lines on how it was read.

    Raises:
        ModelerError: the place cannot be written.
    """
    head, *rows = channel_rows(seen)
    sections = [
        Section("Doubts", [Items([("", line) for line in doubts])] if doubts else [Lead("None.")]),
        Section("Channels", [_table(head, rows), *map(Figure, channel_pictures(seen))]),
    ]
    picture = clock_picture(seen)
    if seen.clock is not None and picture is not None:
        sections.append(Section("Clock", [Lead(clock_line(seen.clock)), Figure(picture)]))
    if seen.suggested:
        sections.append(Section("A [log] to start from", [Code(seen.suggested)]))
    sheet = Sheet(
        f"What is in {seen.name}",
        (str(len(doubts)), "doubts" if len(doubts) != 1 else "doubt"),
        sections,
        Origin(logs=(seen.name,)),
        [("rows", str(seen.rows)), ("clock", clock_line(seen.clock) if seen.clock else "none")],
        provenance=[*seen.notes, *provenance],
        command="log",
    )
    return write_page(path, sheet, "log.html")


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> Table:
    """Units and remarks are text."""
    texts = (1, len(head) - 1)
    return Table(
        [Cell(cell, "text") if k in texts else cell for k, cell in enumerate(head)],
        [[Cell(cell, "text") if k in texts else cell for k, cell in enumerate(r)] for r in rows],
    )


def clock_line(clock: Clock) -> str:
    """The clock in words."""
    rate = f"{clock.rate:.6g} Hz" if clock.rate > 0.0 else "unknown rate"
    parts = [f"{clock.column}: {rate} over {clock.duration:.4g} s"]
    uneven = f"jitter {100 * clock.jitter:.2g} % of a step"
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


def channel_rows(seen: Look) -> list[list[str]]:
    """Header and one row a channel, as text."""
    return [list(_HEAD), *(_row(channel) for channel in seen.channels)]


def _row(channel: Channel) -> list[str]:
    remarks = ["never changes"] if channel.constant else []
    remarks += [f"stays at {end:.4g} in {share:.1%} of the rows" for end, share in channel.limits]
    return [
        channel.name,
        f"{channel.unit}?" if channel.guessed else channel.unit or "-",
        f"{channel.low:.5g}",
        f"{channel.high:.5g}",
        f"{channel.resolution:.3g}" if channel.resolution else "-",
        str(channel.missing or "-"),
        "; ".join(remarks),
    ]


def log_pictures(seen: Look) -> list[Picture]:
    """All pictures of a log."""
    clock = clock_picture(seen)
    return [*channel_pictures(seen), *([clock] if clock is not None else [])]


def channel_pictures(seen: Look) -> list[Picture]:
    """One picture for the columns of each kind, against time."""
    groups: dict[str, list[str]] = {}
    for name in seen.values:
        groups.setdefault(template_of(name)[0], []).append(name)
    time = f"time column {seen.clock.column}" if seen.clock is not None else ""
    return [
        _against_time(seen, number, template, names)
        for number, (template, names) in enumerate(groups.items(), start=1)
        if template != "time" and not (len(names) == 1 and time.endswith(names[0]))
    ]


def _against_time(seen: Look, number: int, template: str, names: Sequence[str]) -> Picture:
    title = template.replace("{}", "*")
    unit = next((c.unit for c in seen.channels if c.unit and names[0] in c.name), "")
    label = f"{title} [{unit}]" if unit else title
    curves = []
    for k, name in enumerate(names):
        values = seen.values[name]
        rows = thin_curves((values,), _LIMIT)
        style = Style(COLORS[k % len(COLORS)], dash=k >= len(COLORS))
        curves.append(Curve(name, seen.time[rows], values[rows], style))
    panel = Panel("", _time_label(seen), label, tuple(curves))
    caption = (
        f"{title} against time, as logged, {len(names)} columns: every extreme is drawn, values "
        "between them are thinned. A value that is missing breaks its line."
    )
    return Picture(f"channels_{number}", title, caption, ((panel,),), (1.0,), (1.0,), 320)


def clock_picture(seen: Look) -> Picture | None:
    """The steps of the clock against time; None without a clock."""
    time, steps = seen.steps[0], 1e3 * seen.steps[1]
    if seen.clock is None or not np.isfinite(steps).any():
        return None
    rows = thin_points(time, steps)
    dots = Points("step", time[rows], steps[rows], Style(SLATE, width=2.0))
    known = steps[np.isfinite(steps)]
    reach = (min(0.0, float(known.min())), float(max(known.max(), 2.0 * np.median(known))))
    panel = Panel("", _time_label(seen), "step of the clock [ms]", (dots,), y_range=reach)
    caption = (
        "Time from each row to the next. A level line is a steady clock; dots above it are gaps, "
        "dots at or below 0 times that repeat or go back."
    )
    return Picture("clock", "Clock", caption, ((panel,),), (1.0,), (1.0,), 260)


def _time_label(seen: Look) -> str:
    return "row" if seen.clock is None else "time [s]"
