"""One log on the screen "data": its pictures and its time, its columns, its doubts."""

from __future__ import annotations  # the screen has a desk, and the desk its screen

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from nicegui import ui

from modeler.core.errors import ModelerError
from modeler.core.figure import Curve, Panel, Picture
from modeler.core.style import BLACK, BLUE, GREEN, ORANGE, PINK, VERMILLION, Style
from modeler.studio import commands, figures, timeline
from modeler.studio.elements import command_line, doubt_lines, folded, part, table
from modeler.studio.log_mapping import Choice, as_mapped, kind_of, words_of
from modeler.studio.mapping_table import MappingTable
from modeler.studio.project import ProjectLog, Stretch
from modeler.studio.robot_frame import robot_frame
from modeler.studio.timeline import Role, Timeline

if TYPE_CHECKING:
    from modeler.studio.data_screen import DataScreen

_POINTS = 1500  # of a curve, at most
_ALL_POINTS = 14_000  # of all curves
_COLORS = (BLUE, VERMILLION, GREEN, ORANGE, PINK, BLACK)  # SKY is what BLUE is in the dark
_PANELS = {"q": "position", "qd": "speed", "tau": "torque", "current": "current"}
_SPEEDS = {0.1: "0.1 x", 0.5: "0.5 x", 1.0: "1 x", 2.0: "2 x", 5.0: "5 x"}
_ROOM = 0.02  # s beside a doubt that is left out too
_WHY: Mapping[str, str] = {
    "gap": "Rows are missing. No filter runs across a gap: the log goes on as another piece.",
    "back": "Time must increase: sort the rows, or split the log there.",
    "repeated": "A recorder faster than the robot writes rows twice. They are dropped; the rate of "
    "the rows that are left is the robot's.",
    "missing": "Rows without a value are bridged where they are few, and not used for the fit.",
    "limit": "A torque at the limit of its drive is not what the motion asks for; such rows are "
    "not used. Drive slower or with less load.",
    "spike": "No machine does that, so the values are left out as they stand; check the wiring.",
    "frozen": "A torque that repeats an old value while its joint moves, for longer than it ever "
    "stays the same, is not measured; those values are left out.",
    "clipped": "The motion just before and after would have led beyond the end of the range.",
    "wrap": "The position is counted on from the longest stretch between two leaps.",
    "zero": "The encoder found another zero; the parts are joined to the longest stretch.",
    "lost": "Rows are missing while the clock ran on; no filter runs across.",
    "open": "The loops of the robot cannot be closed with these positions.",
}
"""What the documentation says of a kind of doubt."""


class Desk:
    """One drawing of a log.

    Args:
        screen: that it is on.
        file: of the log.
    """

    def __init__(self, screen: DataScreen, file: str) -> None:
        self.screen, self.studio, self.file = screen, screen.studio, file
        self.known = screen.logs[file]
        assert self.known.guess is not None
        self.guess = self.known.guess
        self.chosen = screen.chosen(self.guess)
        self.window: tuple[float, float] | None = None
        self.brush: Stretch | None = None
        self._turn = 0  # of the picture: another one forgets its zoom

    @property
    def log(self) -> ProjectLog:
        """As the project has it."""
        return self.screen.log(self.file)

    async def draw(self) -> None:
        """Pictures first; what takes longer comes after them."""
        with part(self.file), ui.row().classes("w-full no-wrap items-start data-desk"):
            with ui.column().classes("data-pictures gap-2"):
                self._plot = ui.plotly(figures.figure(self._picture({}), self.file)).classes(
                    "w-full"
                )
                self._plot.on("plotly_relayout", self._zoomed)
                self._line = Timeline(self.file, self.known.ends)
                self._line.on_brush(self._brushed)
                self._line.on("mark", lambda event: self._doubt(self.marks()[int(event.args)]))
                self._line.on("role", lambda event: self._paint(event.args))
                self._controls()
            self._robot = ui.column().classes("data-robot")
        self.columns = part("Columns")
        self.words = part("Doubts")
        self._mapping()
        self.judged()
        self._drawn_line()
        await self._curves()
        await self._film()

    # Pictures.

    def _named(self) -> dict[str, Choice]:
        """What is drawn: our name -> column, where the log has it."""
        kinds = {own: kind_of(own, self.screen.joints)[0] for own in self.chosen}
        return {
            own: one
            for own, one in self.chosen.items()
            if kinds[own] in _PANELS and one.column in self.guess.columns
        }

    async def _curves(self) -> None:
        """Asks for the window that is looked at, and draws it."""
        named = self._named()
        start, end = self.window or (-np.inf, np.inf)
        points = min(_POINTS, _ALL_POINTS // max(1, len(named)))
        try:
            found = await self.studio.view(
                "log_window", self.screen.path(self.file), [one.column for one in named.values()],
                start, end, self.known.clock, "", points, kind="window",
            )  # fmt: skip
            if found is None:
                return  # another window was asked for
            self._raw = found
            self._show()
        except ModelerError as error:
            self.studio.show_error(str(error))

    def _show(self) -> None:
        """Draws what is there as it is mapped now."""
        try:
            figure = figures.figure(self._picture(self._raw), self.file)
        except ModelerError as error:
            self.studio.show_error(str(error))
            return
        self._plot.update_figure(figure)

    def _picture(self, raw: Mapping[str, tuple[np.ndarray, np.ndarray]]) -> Picture:
        """Positions, speeds and torques as they are mapped, one below the other."""
        joints = self.screen.joints
        rows: dict[str, list[Curve]] = {kind: [] for kind in _PANELS}
        for own, one in self._named().items():
            kind, joint = kind_of(own, joints)
            if joint is None or one.column not in raw:
                continue
            time, values = raw[one.column]
            stated = self.known.units.get(one.column, "")
            place = joints.index(joint)
            color, dash = _COLORS[place % len(_COLORS)], place // len(_COLORS) % 2 == 1
            y = as_mapped(values, stated, one, own, joints)
            style = Style(color, width=1.2, dash=dash)
            rows[kind].append(Curve(f"joint {joint.name}", time, y, style))
        motion = " or ".join(dict.fromkeys(joint.unit for joint in joints)) or "rad"
        effort = " or ".join(dict.fromkeys(joint.effort_unit for joint in joints)) or "N m"
        units = {"q": motion, "qd": f"{motion} per s", "tau": effort, "current": "A or drive units"}
        drawn = {
            kind: curves
            for kind, curves in rows.items()
            if curves or (not raw and kind != "current")
        }
        panels = tuple(
            (
                Panel(
                    "",
                    "time [s]",
                    f"{_PANELS[kind]} [{units[kind]}]",
                    tuple(curves),
                    x_range=self.window,
                ),
            )
            for kind, curves in drawn.items()
        ) or ((Panel("", "time [s]", "nothing mapped", ()),),)
        return Picture(f"{self.file} {self._turn}", "", "", panels, 130 + 150 * len(panels), True)

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
        robot = self.studio.project.robot
        if not robot:
            with self._robot:
                self._offer()
            return
        with self._robot:
            if not self._line.frame:
                self._line.frame = (await robot_frame(self.studio, alone=True)).id
        named = {
            own: one
            for own, one in self._named().items()
            if kind_of(own, self.screen.joints)[0] == "q"
        }
        try:
            film = await self.studio.view(
                "log_film", self.screen.path(self.file), [one.column for one in named.values()],
                self.known.clock,
            )  # fmt: skip
        except ModelerError as error:
            self.studio.show_error(str(error))
            return
        self._postures = film, named
        self._act()

    def _act(self) -> None:
        """Hands the postures as they are mapped now to the line, which plays them."""
        film, named = self._postures
        joints = self.screen.joints
        q = {
            joint.name: as_mapped(
                film[one.column], self.known.units.get(one.column, ""), one, own, joints
            )
            for own, one in named.items()
            if (joint := kind_of(own, joints)[1]) is not None and one.column in film
        }
        self._line.show(film["time"], q)

    def _offer(self) -> None:
        count = len(self.screen.joints)
        ui.label("There is no robot yet: no fit, and nothing moves.").classes("studio-soft")
        if self.studio.read_only:
            return
        title = f"A robot with {count} joint{'s' * (count != 1)} to start from"
        ui.button(title, on_click=self._start).props("no-caps outline")
        ui.button("Describe it", on_click=lambda: self.studio.go("robot")).props("no-caps flat")

    async def _start(self) -> None:
        asked = commands.new_robot(self.guess.joints)
        if await self.studio.run(asked) is not None:
            self.studio.change(redraw=True, robot=asked.words[1])

    # The time.

    def _controls(self) -> None:
        """What is done with the stretch that is held, and with the cursor."""
        with ui.row().classes("items-center gap-2"):
            self._play = ui.button(icon="play_arrow", on_click=self._playing)
            self._play.props('dense round unelevated aria-label="play"')
            self._speed = ui.select(_SPEEDS, value=1.0).props('dense borderless aria-label="speed"')
            self._line.on("playing", lambda event: self._plays(bool(event.args)))
            self._ends = tuple(
                ui.number(label, format="%.4f", on_change=self._typed)
                .props("dense")
                .classes("data-end")
                for label in ("from s", "to s")
            )
            self._roles = ui.row().classes("gap-1")
            with self._roles:
                for role, name in timeline.ROLES.items():
                    button = ui.button(name, on_click=lambda _, role=role: self._paint(role))
                    button.props("dense outline no-caps").mark(f"role-{role}")
                ui.button("let in again", on_click=lambda: self._paint("in")).props(
                    "dense flat no-caps"
                )
                ui.button("zoom to it", on_click=self._zoom).props("dense flat no-caps")
        with ui.row().classes("items-center gap-2"):
            ends = self.known.ends
            for title, change in (
                ("All training", timeline.all_training),
                ("Last 30 % held out", lambda log: timeline.last_held(log, *ends)),
                ("All held out", timeline.all_held),
                ("Leave nothing out", lambda log: dataclasses.replace(log, out=())),
            ):
                button = ui.button(title, on_click=lambda _, change=change: self._become(change))
                button.props("dense flat no-caps")
            ui.button("whole log", on_click=lambda: self._look(None)).props("dense flat no-caps")
            self._told = ui.label().classes("studio-soft")

    def _drawn_line(self) -> None:
        self._line.renew(self.log, self.marks(), self.brush)
        self._roles.set_visibility(self.brush is not None)
        self._told.text = timeline.told(self.log)

    def _brushed(self, stretch: Stretch | None) -> None:
        self.brush = stretch
        if stretch is not None:
            for field, side in zip(self._ends, (stretch.start, stretch.end), strict=True):
                field.set_value(side)
        self._drawn_line()

    def _typed(self) -> None:
        start, end = (field.value for field in self._ends)
        if start is not None and end is not None and start < end:
            typed = Stretch(float(start), float(end))
            if typed != self.brush:
                self.brush = typed
                self._drawn_line()

    def _paint(self, role: Role | str) -> None:
        if self.brush is None:
            return
        held = self.brush
        if role == "in":
            self._become(lambda log: timeline.let_in(log, held))
        else:
            self._become(lambda log: timeline.painted(log, held, role))  # type: ignore[arg-type]

    def _become(self, change: Callable[[ProjectLog], ProjectLog]) -> None:
        self.screen.renew(change(self.log))
        self._drawn_line()

    async def _zoom(self) -> None:
        if self.brush is not None:
            await self._look((self.brush.start, self.brush.end))

    def _playing(self) -> None:
        self._line.play(float(self._speed.value))

    def _plays(self, on: bool) -> None:
        self._play.props(
            f"icon={'pause' if on else 'play_arrow'} aria-label={'pause' if on else 'play'}"
        )

    # The columns.

    def _mapping(self) -> None:
        """The table."""
        with self.columns:
            self._about = ui.column().classes("w-full gap-1")
            joints, columns = self.screen.joints, self.guess.columns
            self._table = MappingTable(joints, columns, self.chosen, self._ranged(), self._mapped)
            self._said = command_line(())
        self._say()

    def _guessed(self) -> bool:
        """Whether the mapping is still what the log looks like."""
        words = self.studio.project.mapping
        alike = words in (self.screen.guessed(self.guess), ("auto",))
        return alike and bool(self.guess.choices)

    def _ranged(self) -> tuple[str, ...]:
        return self.guess.ranged if self._guessed() else ()

    def _say(self) -> None:
        """What the mapping is, in words of people and of commands."""
        words = commands.mapped(self.studio.project)
        self._said.text = " ".join(words) if words else "columns as they are called"
        self._about.clear()
        with self._about:
            if "auto" in words:
                text = "The logs name their columns differently: each is taken by its own guess."
                ui.label(text).classes("studio-soft")
            elif self._guessed():
                ranged = ", dotted units by range alone" if self._ranged() else ""
                ui.label(f"A guess by names{ranged}: check it.").classes("studio-soft")
            self._absent()

    def _absent(self) -> None:
        """What the mapping of all logs does not find in this one."""
        lacking = {
            own: one.column
            for own, one in self.chosen.items()
            if one.column not in self.guess.columns
        }
        if not lacking or "auto" in self.studio.project.mapping:
            return
        first, column = next(iter(lacking.items()))
        with ui.row().classes("items-center gap-2"):
            doubt_lines([
                f"this log has no column {column} for {first}: the mapping is that of all logs; "
                "take it off the list, or let each log be taken by its own guess"
            ])  # fmt: skip
            button = ui.button(
                "each by its own guess",
                on_click=lambda: self.studio.change(redraw=True, mapping=("auto",)),
            )
            button.props("dense outline no-caps")

    async def _mapped(self, chosen: Mapping[str, Choice]) -> None:
        """Other columns, units or signs: words of `--map`, and the pictures at once."""
        screen, project = self.screen, self.studio.project
        kept = tuple(
            word
            for word in project.mapping
            if word == "auto" or word.startswith(("topic=", "rate=", "names="))
        )
        under = screen.under(self.guess)
        if "auto" in kept:
            under |= self.guess.choices
        try:
            self._check_units(chosen)
            words = (*kept, *words_of(chosen, under, screen.joints))
        except ModelerError as error:
            self.studio.show_error(str(error))
            self._table.renew(self.chosen, self._ranged(), anew=True)
            return
        if not self.studio.change(mapping=words):
            self._table.renew(self.chosen, self._ranged(), anew=True)
            return
        self.studio.show_error("")
        if chosen.get("time") != self.chosen.get("time"):
            self.studio.redraw()
            return
        self.chosen = dict(chosen)
        self._table.renew(self.chosen, self._ranged())
        self._say()
        fresh = {one.column for one in self._named().values()} - set(self._raw)
        if fresh:
            await self._curves()
            if self.studio.project.robot:
                await self._film()
        else:
            self._show()
            if self.studio.project.robot:
                self._act()
        screen.look_again()

    def _check_units(self, chosen: Mapping[str, Choice]) -> None:
        none = np.empty(0)
        for own, one in chosen.items():
            as_mapped(none, "", one, own, self.screen.joints)

    # The doubts.

    def marks(self) -> list[Mapping[str, Any]]:
        """Doubts that have a place in time."""
        return list(self.screen.result(self.file).get("marks", ()))

    def judged(self) -> None:
        """What `modeler log` says, anew."""
        self._drawn_line()
        result = self.screen.result(self.file)
        self.words.clear()
        with self.words:
            ui.label("What `modeler log` says").classes("studio-part")
            if not result:
                ui.label("It is looked at.").classes("studio-soft")
                doubt_lines(self.guess.doubts)
                return
            marks = self.marks()
            for line in result["doubts"]:
                own = [mark for mark in marks if line.endswith(mark["line"])]
                self._doubt_row(line, own)
            told = [
                mark
                for mark in marks
                if not any(d.endswith(mark["line"]) for d in result["doubts"])
            ]
            for mark in told[:_MOST]:
                self._doubt_row(f"{mark['start']:.4f} s: {mark['line']}", [mark])
            if not (result["doubts"] or told):
                ui.label("no doubts").classes("studio-soft")
            table(
                ("channel", "unit", "from", "to", "resolution", "missing"),
                map(_cells, result["channels"]),
            )
            folded("notes", result["notes"])

    def _doubt_row(self, line: str, marks: Sequence[Mapping[str, Any]]) -> None:
        """A doubt, and what can be done where it has a place."""
        with ui.row().classes("items-center no-wrap gap-2 w-full"):
            with ui.element("div").classes("data-doubt"):
                doubt_lines([line])
            if marks:
                ui.button("why", on_click=lambda: self._doubt(marks[0])).props("dense flat no-caps")
                leave = ui.button("leave out", on_click=lambda: self._leave(marks))
                leave.props("dense outline no-caps").classes("no-wrap")

    def _leave(self, marks: Sequence[Mapping[str, Any]]) -> None:
        log = self.log
        for mark in marks:
            start, end = (
                round(mark[side] + room, 4) for side, room in (("start", -_ROOM), ("end", _ROOM))
            )
            log = timeline.painted(log, Stretch(start, end), "out")
        self._become(lambda _: log)

    def _doubt(self, mark: Mapping[str, Any]) -> None:
        """Why, and what can be done."""
        with ui.dialog() as dialog, ui.card().classes("studio-card"):
            ui.label(f"{mark['channel']}, {mark['start']:.4f} to {mark['end']:.4f} s").classes(
                "studio-part"
            )
            ui.label(str(mark["line"]))
            ui.label(_WHY.get(mark["kind"], "")).classes("studio-soft")
            with ui.row():
                leave = ui.button("Leave out", on_click=lambda: self._leave([mark]))
                leave.on_click(dialog.close)
                leave.props("no-caps unelevated")
                near = (mark["start"] - 25 * _ROOM, mark["end"] + 25 * _ROOM)
                ui.button(
                    "Look at it", on_click=lambda: (dialog.close(), self._look(near))[1]
                ).props("no-caps flat")
                ui.button("Close", on_click=dialog.close).props("no-caps flat")
        dialog.open()


_MOST = 30  # marks that are listed; the line has all


def _cells(channel: Mapping[str, Any]) -> Sequence[str]:
    """A channel in words."""
    low, high, step = (channel[name] for name in ("low", "high", "resolution"))
    unit = channel["unit"] or ""
    return (
        channel["name"], f"{unit}?" if channel["guessed"] else unit,
        *("" if value is None else f"{value:.4g}" for value in (low, high, step)),
        str(channel["missing"] or ""),
    )  # fmt: skip
