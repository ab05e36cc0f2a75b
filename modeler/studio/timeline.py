"""What the stretches of a log are for, and the line on which they are drawn, brushed and played."""

import dataclasses
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from nicegui import ui
from nicegui.element import Element

from modeler.core.files import resource_dir
from modeler.studio.project import ProjectLog
from modeler.studio.tasks import Stretch

ROLES: Mapping[str, str] = {"train": "training", "test": "held out", "out": "left out"}
"""What people call them."""

HELD = 0.3
"""Share of the only log of a project that is held out at first."""

ALL = (Stretch(),)
"""Of a log."""

_DIGITS = 4  # of a second: what a stretch begins with


def united(parts: Iterable[Stretch]) -> tuple[Stretch, ...]:
    """The same without overlaps, in order."""
    found: list[Stretch] = []
    for part in sorted(parts, key=lambda one: one.start):
        if found and part.start <= found[-1].end:
            found[-1] = Stretch(found[-1].start, max(found[-1].end, part.end))
        else:
            found.append(part)
    return tuple(found)


def painted(log: ProjectLog, stretch: Stretch, role: str) -> ProjectLog:
    """The log with a stretch in a role; "in": no longer left out of what it is."""
    if role == "out":
        return dataclasses.replace(log, out=united([*log.out, stretch]))
    roles: dict[str, Any] = {
        name: tuple(left for part in getattr(log, name) for left in part.without([stretch]))
        for name in (ROLES if role in ROLES else ("out",))
    }
    if role in ROLES:
        roles[role] = united([*roles[role], stretch])
    return dataclasses.replace(log, **roles)


Change = Callable[[ProjectLog], ProjectLog]


def whole(ends: tuple[float, float]) -> dict[str, Change]:
    """What can be made of a log as a whole.

    Args:
        ends: of it, s.
    """
    cut = round(ends[1] - HELD * (ends[1] - ends[0]), _DIGITS)
    last = (Stretch(end=cut),), (Stretch(start=cut),)
    return {
        "All training": lambda log: dataclasses.replace(log, train=ALL, test=()),
        "Last 30 % held out": lambda log: dataclasses.replace(log, train=last[0], test=last[1]),
        "All held out": lambda log: dataclasses.replace(log, train=(), test=ALL),
        "Leave nothing out": lambda log: dataclasses.replace(log, out=()),
    }


def by_default(
    logs: Sequence[ProjectLog], ends: Mapping[str, tuple[float, float]]
) -> tuple[ProjectLog, ...]:
    """Of one log the last 30 % is held out, of several the last one.

    Args:
        logs: of the project.
        ends: first and last time of those that can be read, s; others are neither.
    """
    good, found = [log.file for log in logs if log.file in ends], []
    for log in logs:
        if log.file in good:
            last = log.file == good[-1]
            choice = "All training" if not last else _FIRST[len(good) > 1]
            log = whole(ends[log.file])[choice](log)
        found.append(log)
    return tuple(found)


_FIRST = {False: "Last 30 % held out", True: "All held out"}


def spans_of(log: ProjectLog) -> list[dict[str, Any]]:
    """The stretches as they are drawn, left-out ones on top; an end that is open is None."""
    return [
        {"role": role}
        | {name: end if math.isfinite(end) else None for name, end in vars(part).items()}
        for role in ROLES
        for part in getattr(log, role)
    ]


def told(log: ProjectLog) -> str:
    """What its stretches are for, in words."""
    roles = {name: getattr(log, role) for role, name in ROLES.items()}
    said = [f"{name}: {', '.join(map(_words, parts))}" for name, parts in roles.items() if parts]
    return "; ".join(said) or "not used"


def _words(part: Stretch) -> str:
    ends = (part.start, part.end)  # of a clock that may count from 1970
    start, end = (f"{round(side, 3):.15g} s" if math.isfinite(side) else "" for side in ends)
    if start and end:
        return f"{start} to {end}"
    return f"from {start} on" if start else f"up to {end}" if end else "all of it"


class Timeline(Element, component=resource_dir("templates") / "studio" / "parts" / "timeline.js"):
    """The time of a log: stretches by colour and pattern, marks, a brush, a cursor that plays.

    Args:
        name: of its time, which pictures share.
        ends: of the log, s.
        active: True: it is brushed and played; False: it is only looked at.
    """

    def __init__(self, name: str, ends: tuple[float, float], active: bool = True) -> None:
        super().__init__()
        self._props |= {
            "name": name, "start": ends[0], "end": ends[1], "active": active, "frame": "",
            "label": f"time of {name}, s", "spans": [], "marks": [], "brush": None,
        }  # fmt: skip

    @property
    def frame(self) -> str:
        """Id of the frame of a robot that follows the cursor; "": none."""
        return str(self._props["frame"])

    @frame.setter
    def frame(self, name: str) -> None:
        self._props["frame"] = name
        self.update()

    def renew(
        self, log: ProjectLog, marks: Sequence[Mapping[str, Any]] = (), brush: Stretch | None = None
    ) -> None:
        """Draws what is so now."""
        self._props["spans"] = spans_of(log)
        self._props["marks"] = list(marks)
        self._props["brush"] = None if brush is None else [brush.start, brush.end]
        self.update()

    def on_brush(self, heard: Callable[[Stretch | None], Any]) -> None:
        """Calls back with the stretch that was drawn; None: it was let go."""

        def brushed(event: Any) -> None:
            ends = event.args
            heard(None if not ends else Stretch(*(round(float(end), _DIGITS) for end in ends)))

        self.on("brush", brushed)

    def show(self, time: np.ndarray, q: Mapping[str, np.ndarray]) -> None:
        """What a robot does while the cursor moves.

        Args:
            time: (n,) s.
            q: (n,) position of each joint, rad or m.
        """
        postures = {
            joint: [round(v, 6) if math.isfinite(v) else None for v in own.tolist()]
            for joint, own in q.items()
        }
        self.run_method("show", {"time": time.tolist(), "q": postures})

    def play(self, speed: float) -> None:
        """Starts the cursor, or stops it."""
        self.run_method("toggle", speed)


def legend() -> None:
    """What the colours of a timeline mean."""
    for role, name in {**ROLES, "sign": "a doubt: click it"}.items():
        with ui.row().classes("items-center no-wrap gap-1"):
            ui.element("span").classes(f"timeline-swatch timeline-{role}")
            ui.label(name)
