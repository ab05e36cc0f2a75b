"""What the stretches of a log are for, and the line on which they are drawn, brushed and played."""

import dataclasses
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Literal

import numpy as np
from nicegui import ui
from nicegui.element import Element

from modeler.core.files import resource_dir
from modeler.studio.project import ProjectLog, Stretch

Role = Literal["train", "test", "out"]

ROLES: Mapping[Role, str] = {"train": "training", "test": "held out", "out": "left out"}
"""What people call them."""

HELD = 0.3
"""Share of the only log of a project that is held out at first."""

_ALL = (Stretch(),)
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


def painted(log: ProjectLog, stretch: Stretch, role: Role) -> ProjectLog:
    """The log with a stretch in a role; what it was left out of lets it go, but for "out"."""
    if role == "out":  # taken out of what it is; what it is comes back when it is let in again
        return dataclasses.replace(log, out=united([*log.out, stretch]))
    others: dict[str, Any] = {
        name: tuple(left for part in getattr(log, name) for left in part.without([stretch]))
        for name in ROLES
    }
    return dataclasses.replace(log, **others | {role: united([*others[role], stretch])})


def let_in(log: ProjectLog, stretch: Stretch) -> ProjectLog:
    """The log with a stretch that is no longer left out."""
    kept = tuple(left for part in log.out for left in part.without([stretch]))
    return dataclasses.replace(log, out=kept)


def all_training(log: ProjectLog) -> ProjectLog:
    """All of it is fitted."""
    return dataclasses.replace(log, train=_ALL, test=())


def all_held(log: ProjectLog) -> ProjectLog:
    """All of it is held out."""
    return dataclasses.replace(log, train=(), test=_ALL)


def last_held(log: ProjectLog, start: float, end: float, share: float = HELD) -> ProjectLog:
    """The last part of it is held out."""
    cut = round(end - share * (end - start), _DIGITS)
    return dataclasses.replace(log, train=(Stretch(end=cut),), test=(Stretch(start=cut),))


def by_default(
    logs: Sequence[ProjectLog], ends: Mapping[str, tuple[float, float]]
) -> tuple[ProjectLog, ...]:
    """Of one log the last 30 % is held out, of several the last one.

    Args:
        logs: of the project.
        ends: first and last time of those that can be read, s; others are neither.
    """
    good = [log.file for log in logs if log.file in ends]
    found = []
    for log in logs:
        if log.file not in ends:
            found.append(dataclasses.replace(log, train=(), test=()))
        elif len(good) == 1:
            found.append(last_held(log, *ends[log.file]))
        else:
            found.append(all_held(log) if log.file == good[-1] else all_training(log))
    return tuple(found)


def spans_of(log: ProjectLog) -> list[dict[str, Any]]:
    """The stretches as they are drawn, left-out ones on top; an end that is open is None."""
    return [
        {"role": role, "start": _end(part.start), "end": _end(part.end)}
        for role in ROLES
        for part in getattr(log, role)
    ]


def _end(side: float) -> float | None:
    return side if math.isfinite(side) else None


def told(log: ProjectLog) -> str:
    """What its stretches are for, in words."""
    said = []
    for role, name in ROLES.items():
        parts = getattr(log, role)
        if parts == _ALL:
            said.append(f"all of it {name}")
        elif parts:
            said.append(f"{name} {', '.join(map(_words, parts))}")
    return "; ".join(said) or "not used"


def _words(part: Stretch) -> str:
    if not math.isfinite(part.start):
        return f"up to {part.end:.6g} s"
    if not math.isfinite(part.end):
        return f"from {part.start:.6g} s on"
    return f"{part.start:.6g} to {part.end:.6g} s"


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
    with ui.row().classes("items-center gap-4 timeline-legend"):
        for role, name in ROLES.items():
            with ui.row().classes("items-center no-wrap gap-1"):
                ui.element("span").classes(f"timeline-swatch timeline-{role}")
                ui.label(name)
        with ui.row().classes("items-center no-wrap gap-1"):
            ui.element("span").classes("timeline-swatch timeline-sign")
            ui.label("a doubt: click it")
