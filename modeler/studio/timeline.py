"""What the segments of a log are for, and the line on which they are drawn, brushed and played."""

import dataclasses
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from nicegui import ui
from nicegui.element import Element

from modeler.api.front_end import locate_resources
from modeler.studio.project import ProjectLog
from modeler.studio.tasks import TimeRange
from modeler.studio.thresholds import THRESHOLDS

ROLES: Mapping[str, str] = {"train": "training", "test": "held out", "out": "left out"}
"""What people call them."""


ALL = (TimeRange(),)
"""Of a log."""

_DIGITS = 4  # of a second: what a segment begins with


def merge_ranges(parts: Iterable[TimeRange]) -> tuple[TimeRange, ...]:
    """Merges overlapping ranges, in order."""
    merged: list[TimeRange] = []
    for part in sorted(parts, key=lambda one: one.start):
        if merged and part.start <= merged[-1].end:
            merged[-1] = TimeRange(merged[-1].start, max(merged[-1].end, part.end))
        else:
            merged.append(part)
    return tuple(merged)


def assign_role(log: ProjectLog, stretch: TimeRange, role: str) -> ProjectLog:
    """Assigns a role to a range of a log; "in": no longer left out."""
    if role == "out":
        return dataclasses.replace(log, out=merge_ranges([*log.out, stretch]))
    roles: dict[str, Any] = {
        name: tuple(left for part in getattr(log, name) for left in part.subtract_gaps([stretch]))
        for name in (ROLES if role in ROLES else ("out",))
    }
    if role in ROLES:
        roles[role] = merge_ranges([*roles[role], stretch])
    return dataclasses.replace(log, **roles)


Change = Callable[[ProjectLog], ProjectLog]


def build_log_changes(ends: tuple[float, float]) -> dict[str, Change]:
    """Returns the changes of a whole log by their titles.

    Args:
        ends: of it, s.
    """
    cut = round(ends[1] - THRESHOLDS.held_out_share * (ends[1] - ends[0]), _DIGITS)
    last = (TimeRange(end=cut),), (TimeRange(start=cut),)
    return {
        "All training": lambda log: dataclasses.replace(log, train=ALL, test=()),
        "Last 30 % held out": lambda log: dataclasses.replace(log, train=last[0], test=last[1]),
        "All held out": lambda log: dataclasses.replace(log, train=(), test=ALL),
        "Leave nothing out": lambda log: dataclasses.replace(log, out=()),
    }


def assign_default_roles(
    logs: Sequence[ProjectLog], ends: Mapping[str, tuple[float, float]]
) -> tuple[ProjectLog, ...]:
    """Holds out the last 30 % of one log, of several the last one.

    Args:
        logs: of the project.
        ends: first and last time of those that can be read, s; others are neither.
    """
    good, assigned = [log.file for log in logs if log.file in ends], []
    for log in logs:
        if log.file in good:
            last = log.file == good[-1]
            choice = "All training" if not last else _FIRST[len(good) > 1]
            log = build_log_changes(ends[log.file])[choice](log)
        assigned.append(log)
    return tuple(assigned)


_FIRST = {False: "Last 30 % held out", True: "All held out"}


def build_spans(log: ProjectLog) -> list[dict[str, Any]]:
    """Builds the ranges as they are drawn, left-out ones on top; an open end is None."""
    return [
        {"role": role}
        | {name: end if math.isfinite(end) else None for name, end in vars(part).items()}
        for role in ROLES
        for part in getattr(log, role)
    ]


def describe_roles(log: ProjectLog) -> str:
    """Describes the roles of the ranges of a log."""
    roles = {name: getattr(log, role) for role, name in ROLES.items()}
    parts_text = [
        f"{name}: {', '.join(map(_describe_range, parts))}"
        for name, parts in roles.items()
        if parts
    ]
    return "; ".join(parts_text) or "not used"


def _describe_range(part: TimeRange) -> str:
    ends = (part.start, part.end)  # of a clock that may count from 1970
    start, end = (f"{round(side, 3):.15g} s" if math.isfinite(side) else "" for side in ends)
    if start and end:
        return f"{start} to {end}"
    return f"from {start} on" if start else f"up to {end}" if end else "all of it"


class Timeline(
    Element, component=locate_resources("templates") / "studio" / "parts" / "timeline.js"
):
    """The time of a log: segments by colour and pattern, marks, a brush, a cursor that plays.

    Args:
        name: of its time, which pictures share.
        ends: of the log, s.
        active: True: it is brushed and played; False: it is only looked at.
    """

    def __init__(self, name: str, ends: tuple[float, float], active: bool = True) -> None:
        super().__init__()
        self._props |= {"name": name, "start": ends[0], "end": ends[1], "active": active}
        self._props |= {"label": f"time of {name}, s", "frame": "", "spans": [], "marks": []}
        self._props["brush"] = None

    @property
    def frame(self) -> str:
        """Returns the id of the robot frame that follows the cursor; "": none."""
        return str(self._props["frame"])

    @frame.setter
    def frame(self, name: str) -> None:
        self._props["frame"] = name
        self.update()

    def update_log(
        self,
        log: ProjectLog,
        marks: Sequence[Mapping[str, Any]] = (),
        brush: TimeRange | None = None,
    ) -> None:
        """Updates the drawing of a log to what its segments and marks are now."""
        self._props["spans"] = build_spans(log)
        self._props["marks"] = list(marks)
        self._props["brush"] = None if brush is None else [brush.start, brush.end]
        self.update()

    def connect_brush(self, on_brushed: Callable[[TimeRange | None], Any]) -> None:
        """Calls back with the segment that was drawn; None: it was let go."""

        def handle_brush(event: Any) -> None:
            ends = event.args
            on_brushed(
                None if not ends else TimeRange(*(round(float(end), _DIGITS) for end in ends))
            )

        self.on("brush", handle_brush)

    def show_motion(self, time: np.ndarray, q: Mapping[str, np.ndarray]) -> None:
        """Sets the motion that the robot shows while the cursor moves.

        Args:
            time: (n,) s.
            q: (n,) position of each joint, rad or m.
        """
        postures = {
            joint: [round(v, 6) if math.isfinite(v) else None for v in positions.tolist()]
            for joint, positions in q.items()
        }
        self.run_method("show", {"time": time.tolist(), "q": postures})

    def toggle_play(self, speed: float) -> None:
        """Starts the cursor, or stops it."""
        self.run_method("toggle", speed)


def add_player(
    name: str, ends: tuple[float, float], speeds: Sequence[float] = (0.1, 0.5, 1.0, 2.0, 5.0)
) -> Timeline:
    """Adds a timeline with a button that plays it, and the choice of its speed.

    Args:
        name: of its time.
        ends: of it, s.
        speeds: times real time.
    """
    with ui.row().classes("w-full items-center no-wrap"):
        play = ui.button(icon="play_arrow").props("dense round unelevated aria-label=play")
        menu = {speed: f"{speed:g} x" for speed in speeds}
        speed = ui.select(menu, value=1.0).props("dense borderless aria-label=speed")
        with ui.element("div").classes("col"):
            line = Timeline(name, ends)
    faces = {True: "icon=pause aria-label=pause", False: "icon=play_arrow aria-label=play"}
    line.on("playing", lambda event: play.props(faces[bool(event.args)]))
    play.on_click(lambda: line.toggle_play(speed.value))
    return line


def draw_legend() -> None:
    """Draws the legend of the colours of a timeline."""
    for role, name in {**ROLES, "sign": "a warning: click it"}.items():
        with ui.row().classes("items-center no-wrap gap-1"):
            ui.element("span").classes(f"timeline-swatch timeline-{role}")
            ui.label(name)
