"""One log on the screen "data": its pictures and its time, its columns, its doubts."""

import re
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from typing import Any

import numpy as np
from nicegui import ui

from modeler.core.errors import ModelerError
from modeler.core.figure import Curve, Panel, Picture
from modeler.core.files import read_text, resource_dir
from modeler.core.json import parse_toml
from modeler.core.style import BLACK, BLUE, GREEN, ORANGE, PINK, VERMILLION, Style
from modeler.studio import figures, timeline
from modeler.studio.elements import command_line, doubt_lines, folded, part, table
from modeler.studio.log_mapping import Choice, as_mapped, kind_of, words_of
from modeler.studio.mapping_table import MappingTable
from modeler.studio.project import ProjectLog
from modeler.studio.project_logs import ProjectLogs
from modeler.studio.robot_frame import robot_frame
from modeler.studio.tasks import ROBOT, Stretch, Task
from modeler.studio.timeline import Timeline

_POINTS = 1500  # of a curve, at most
_ALL_POINTS = 14_000  # of all curves
_COLORS = (BLUE, VERMILLION, GREEN, ORANGE, PINK, BLACK)  # SKY is what BLUE is in the dark
_PANELS = {"q": "position", "qd": "speed", "tau": "torque or force", "current": "current"}
_SPEEDS = {speed: f"{speed:g} x" for speed in (0.1, 0.5, 1.0, 2.0, 5.0)}
_ROOM = 0.02  # s beside a doubt that is left out too
_ABSENT = (
    "this log has no column {} for {}: the mapping is that of all logs; take this one off the "
    "list, or let each be taken by its own guess"
)


class LogView:
    """One drawing of a log.

    Args:
        project_logs: that the log is from.
        file: of the log.
        renew: is called with the log as it shall be.
        look: is called when the mapping was changed.
    """

    def __init__(
        self,
        project_logs: ProjectLogs,
        file: str,
        renew: Callable[[ProjectLog], Any],
        look: Callable[[], Any],
    ) -> None:
        self.project_logs, self.studio, self.file = project_logs, project_logs.studio, file
        self._renew, self._again = renew, look
        self.known, self.guess = project_logs.logs[file], project_logs.guess(file)
        self.chosen = project_logs.chosen(self.guess)
        self.window: tuple[float, float] | None = None
        self.brush: Stretch | None = None
        self._turn = 0  # of the picture: another one forgets its zoom

    @property
    def log(self) -> ProjectLog:
        """As the project has it."""
        return self.project_logs.log(self.file)

    async def draw(self) -> None:
        """Pictures first; what takes longer comes after them."""
        with part(self.file), ui.row().classes("w-full no-wrap items-start data-log-view"):
            with ui.column().classes("data-pictures gap-2"):
                self._plot = ui.plotly(figures.figure(self._picture({}), self.file))
                self._plot.classes("w-full").on("plotly_relayout", self._zoomed)
                self._line = Timeline(self.file, self.known.ends)
                self._line.on_brush(self._hold)
                self._line.on("mark", lambda event: self._why(self.marks()[int(event.args)]))
                self._line.on("role", lambda event: self._paint(event.args))
                self._controls()
            self._robot = ui.column().classes("data-robot")
        with part("Columns"):
            self._about = ui.column().classes("w-full gap-1")
            joints, columns = self.project_logs.joints, self.guess.columns
            self._table = MappingTable(joints, columns, self.chosen, self._ranged(), self._mapped)
            self._said = command_line("")
        with part("What modeler log says"):
            self._words = ui.column().classes("w-full gap-1")
        self._say()
        self.judged()
        await self._curves()
        if self._robot.is_deleted:
            return  # another log was opened meanwhile
        with self._robot:
            if self.studio.project.robot:
                self._line.frame = (await robot_frame(self.studio, alone=True)).id
                await self._film()
            else:
                self._offer()

    # Pictures.

    async def _ask(self, question: str, *arguments: Any, kind: str = "") -> Any:
        """What the viewer answers of this log; None where it has no answer, which is told."""
        try:
            return await self.studio.view(
                question, self.project_logs.path(self.file), *arguments, kind=kind
            )
        except ModelerError as error:
            self.studio.show_error(str(error))

    def _columns(self, kinds: Sequence[str]) -> dict[str, Choice]:
        """Our name -> column, of those kinds, where the log has it."""
        own = {own: one for own, one in self.chosen.items() if one.column in self.guess.columns}
        return {
            o: one for o, one in own.items() if kind_of(o, self.project_logs.joints)[0] in kinds
        }

    def _values(self, own: str, values: np.ndarray) -> np.ndarray:
        """A column as it is mapped."""
        one = self.chosen[own]
        stated = self.known.units.get(one.column, "")
        return as_mapped(values, stated, one, own, self.project_logs.joints)

    async def _curves(self) -> None:
        """Asks for the window that is looked at, and draws it."""
        names = [one.column for one in self._columns([*_PANELS]).values()]
        window, points = self.window or (-np.inf, np.inf), _ALL_POINTS // max(1, len(names))
        more = (self.known.clock, "", min(points, _POINTS))
        raw = await self._ask("log_window", names, *window, *more, kind="window")
        if raw is not None:
            self._plot.update_figure(figures.figure(self._picture(raw), self.file))

    def _picture(self, raw: Mapping[str, tuple[np.ndarray, np.ndarray]]) -> Picture:
        """Positions, speeds and torques as they are mapped, one below the other."""
        joints = self.project_logs.joints
        curves: dict[str, list[Curve]] = {kind: [] for kind in _PANELS}
        for own, one in self._columns([*_PANELS]).items():
            kind, joint = kind_of(own, joints)
            if joint is not None and one.column in raw:
                (time, values), place = raw[one.column], joints.index(joint)
                dash, color = divmod(place, len(_COLORS))
                style = Style(_COLORS[color], width=1.2, dash=bool(dash % 2))
                y = self._values(own, values)
                curves[kind].append(Curve(f"joint {joint.name}", time, y, style))
        motion, effort = (
            " or ".join(dict.fromkeys(getattr(joint, name) for joint in joints))
            for name in ("unit", "effort_unit")
        )
        units = {"q": motion, "qd": f"{motion} per s", "tau": effort, "current": "A or drive units"}
        panels = [
            (Panel("", "time [s]", f"{_PANELS[k]} [{units[k]}]", tuple(c), x_range=self.window),)
            for k, c in curves.items()
            if c
        ] or [(Panel("", "time [s]", "nothing is mapped" if raw else "", ()),)]
        name, height = f"{self.file} {self._turn}", 130 + 150 * len(panels)
        return Picture(name, "", "", tuple(panels), height, True)

    async def _zoomed(self, event: Any) -> None:
        found = figures.x_range(event.args)
        if found is not False:
            self.window = found if isinstance(found, tuple) else None
            await self._curves()

    async def _look(self, window: tuple[float, float] | None) -> None:
        """At a part of the log."""
        self.window, self._turn = window, self._turn + 1
        await self._curves()

    async def _film(self) -> None:
        """The robot moves as the log says."""
        named = self._columns(["q"])
        columns = [one.column for one in named.values()]
        film = await self._ask("log_film", columns, self.known.clock)
        if film is not None:
            q = {own: self._values(own, film[one.column]) for own, one in named.items()}
            self._line.show(film["time"], {own.removeprefix("q"): v for own, v in q.items()})

    def _offer(self) -> None:
        count = len(self.project_logs.joints)
        ui.label("There is no robot yet: no fit, and nothing moves.").classes("studio-soft")
        title = f"A robot with {count} joint{'s' * (count != 1)} to start from"
        ui.button(title, on_click=self._start).props("no-caps outline")
        _small("Describe it", lambda: self.studio.go("robot"))

    async def _start(self) -> None:
        task = Task("new", joints="R" * max(1, len(self.project_logs.joints)))
        if await self.studio.run(task) is not None:
            self.studio.change(redraw=True, robot=ROBOT)

    # The time.

    def _controls(self) -> None:
        """What is done with the cursor, with the stretch that is held, and with the whole log."""
        with ui.row().classes("items-center gap-2"):
            play = ui.button(icon="play_arrow").props('dense round unelevated aria-label="play"')
            speed = ui.select(_SPEEDS, value=1.0).props('dense borderless aria-label="speed"')
            play.on_click(lambda: self._line.play(speed.value))
            faces = {True: "icon=pause aria-label=pause", False: "icon=play_arrow aria-label=play"}
            self._line.on("playing", lambda event: play.props(faces[bool(event.args)]))
            self._ends = [
                ui.number(label, format="%.4f", on_change=self._typed).classes("data-end")
                for label in ("from s", "to s")
            ]
            with ui.row().classes("gap-1") as self._roles:
                for role, name in timeline.ROLES.items():
                    _small(name, lambda _, role=role: self._paint(role)).props(
                        "outline", remove="flat"
                    )
                _small("let in again", lambda: self._paint("in"))
                _small("zoom to it", lambda: self._look(_ends(self.brush)))
        with ui.row().classes("items-center gap-2"):
            for title, change in timeline.whole(self.known.ends).items():
                _small(title, lambda _, change=change: self._become(change))
            _small("whole log", lambda: self._look(None))
            self._told = ui.label().classes("studio-soft")

    def _drawn(self) -> None:
        self._line.renew(self.log, self.marks(), self.brush)
        self._roles.set_visibility(self.brush is not None)
        self._told.text = timeline.told(self.log)

    def _hold(self, stretch: Stretch | None) -> None:
        """The stretch that was brushed; None: it was let go."""
        self.brush = stretch
        for field, side in zip(self._ends, _ends(stretch) or (None, None), strict=True):
            field.set_value(side)
        self._drawn()

    def _typed(self) -> None:
        start, end = (field.value for field in self._ends)
        if start is not None and end is not None and start < end:
            self.brush = Stretch(float(start), float(end))
            self._drawn()

    def _paint(self, role: str) -> None:
        if self.brush is not None:
            held = self.brush
            self._become(lambda log: timeline.painted(log, held, role))

    def _become(self, change: Callable[[ProjectLog], ProjectLog]) -> None:
        self._renew(change(self.log))
        self._drawn()

    # The columns.

    def _ranged(self) -> Sequence[str]:
        """Our names whose unit is a guess by range alone, while the mapping is one."""
        return self.guess.ranged if self.project_logs.is_guess(self.guess) else ()

    def _say(self) -> None:
        """What the mapping is, in words of people and of commands."""
        words = self.studio.project.mapping
        said = " ".join(f"--map {word}" for word in words)
        self._said.text = said or "columns as they are called"
        self._about.clear()
        lacking = [own for own, one in self.chosen.items() if one.column not in self.guess.columns]
        with self._about:
            if "auto" in words:
                text = "The logs name their columns differently: each is taken by its own guess."
                ui.label(text).classes("studio-soft")
            elif self.project_logs.is_guess(self.guess):
                ranged = ", dotted units by range alone" if self.guess.ranged else ""
                ui.label(f"A guess by names{ranged}: check it.").classes("studio-soft")
            if lacking and "auto" not in words:
                doubt_lines([_ABSENT.format(self.chosen[lacking[0]].column, lacking[0])])
                _small("each by its own guess", self.project_logs.guess_each)

    async def _mapped(self, chosen: Mapping[str, Choice]) -> None:
        """Other columns, units or signs: words of `--map`, and the pictures at once."""
        project_logs, joints = self.project_logs, self.project_logs.joints
        try:
            for own, one in chosen.items():
                as_mapped(np.empty(0), "", one, own, joints)  # says which units cannot be
            words = words_of(chosen, project_logs.under(self.guess), joints)
            words = (*project_logs.kept(self.guess), *words)
            changed = self.studio.change(mapping=words, mapped=True)
        except ModelerError as error:
            self.studio.show_error(str(error))
            changed = False
        if not changed:
            self._table.renew(self.chosen, self._ranged(), anew=True)
            return
        self.studio.show_error("")
        timed, self.chosen = chosen.get("time") == self.chosen.get("time"), dict(chosen)
        if not timed:
            self.studio.redraw()
            return
        self._table.renew(self.chosen, self._ranged())
        self._say()
        await self._curves()
        if self.studio.project.robot:
            await self._film()
        self._again()

    # The doubts.

    def marks(self) -> list[Mapping[str, Any]]:
        """Doubts that have a place in time."""
        return list(self.project_logs.result(self.file).get("marks", ()))

    def judged(self) -> None:
        """What `modeler log` says, anew."""
        self._drawn()
        result, marks = self.project_logs.result(self.file), self.marks()
        doubts = result.get("doubts", self.guess.doubts)
        rows = {line: [m for m in marks if line.endswith(m["line"])] for line in doubts}
        told = [id(mark) for own in rows.values() for mark in own]
        alike: dict[str, list[Mapping[str, Any]]] = {}
        for mark in (mark for mark in marks if id(mark) not in told):
            alike.setdefault(re.sub(r"[\d.]+", "#", mark["line"]), []).append(mark)
        for own in alike.values():
            more = f", and {len(own) - 1} like it" if len(own) > 1 else ""
            rows[f"{own[0]['start']:.4f} s: {own[0]['line']}{more}"] = own
        self._words.clear()
        with self._words:
            for line, own in rows.items():
                self._doubt(line, own)
            if not rows:
                text = "no doubts" if result else "It is looked at."
                ui.label(text).classes("studio-soft")
            heads = ("channel", "unit", "from", "to", "resolution", "missing")
            if result:
                table(heads, map(_cells, result["channels"]))
                folded("notes", result["notes"])

    def _doubt(self, line: str, marks: Sequence[Mapping[str, Any]]) -> None:
        """A doubt, and what can be done where it has a place."""
        with ui.row().classes("items-center no-wrap gap-2 w-full"):
            with ui.element("div").classes("data-doubt"):
                doubt_lines([line])
            if marks:
                _small("why", lambda: self._why(marks[0]))
                _small("leave out", lambda: self._leave(marks)).props("outline", remove="flat")

    def _leave(self, marks: Sequence[Mapping[str, Any]]) -> None:
        log = self.log
        for start, end in ((mark["start"] - _ROOM, mark["end"] + _ROOM) for mark in marks):
            log = timeline.painted(log, Stretch(round(start, 4), round(end, 4)), "out")
        self._become(lambda _: log)

    def _why(self, mark: Mapping[str, Any]) -> None:
        """The whole line, what the documentation says, and what can be done."""
        start, end = mark["start"], mark["end"]
        near = (start - 25 * _ROOM, end + 25 * _ROOM)
        with ui.dialog(value=True) as dialog, ui.card().classes("studio-card"):
            ui.label(f"{mark['channel']}, {start:.4f} to {end:.4f} s").classes("studio-part")
            ui.label(mark["line"])
            ui.label(_sentences().get(mark["kind"], "")).classes("studio-soft")
            with ui.row():
                _small("Leave out", lambda: self._leave([mark])).on_click(dialog.close)
                _small("Look at it", lambda: self._look(near)).on_click(dialog.close)
                _small("Close", dialog.close)


@cache
def _sentences() -> dict[str, str]:
    """What the documentation says of a kind of doubt."""
    return parse_toml(read_text(resource_dir("templates") / "studio" / "doubts.toml"))


def _small(title: str, act: Callable[..., Any]) -> ui.button:
    return ui.button(title, on_click=act).props("dense flat no-caps").classes("no-wrap")


def _ends(stretch: Stretch | None) -> tuple[float, float] | None:
    return None if stretch is None else (stretch.start, stretch.end)


def _cells(channel: Mapping[str, Any]) -> Sequence[str]:
    """A channel in words."""
    unit = f"{channel['unit'] or ''}{'?' * channel['guessed']}"
    numbers = (channel[name] for name in ("low", "high", "resolution"))
    texts = ("" if value is None else f"{value:.4g}" for value in numbers)
    return (channel["name"], unit, *texts, str(channel["missing"] or ""))
