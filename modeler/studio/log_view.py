"""The mapping of columns, and a log as it is looked at: windows, cuts, roles."""

import dataclasses
import re
from collections.abc import Awaitable, Callable, Mapping, Sequence
from functools import cache, partial
from typing import Any

import numpy as np
from nicegui import ui
from nicegui.element import Element

from modeler.api.front_end import (
    COLORS,
    Curve,
    JointSpec,
    Panel,
    Picture,
    Style,
    locate_resources,
    parse_toml,
    read_text,
)
from modeler.studio import figures, timeline
from modeler.studio.elements import (
    add_button,
    add_card,
    add_robot_frame,
    draw_command_line,
    draw_folded,
    draw_note,
    draw_table,
    draw_warnings,
)
from modeler.studio.log_mapping import (
    KINDS,
    ColumnChoice,
    apply_choice,
    build_map_words,
    select_units,
    split_quantity,
)
from modeler.studio.project import ProjectLog
from modeler.studio.project_logs import ProjectLogs
from modeler.studio.tasks import ROBOT, Task, TimeRange
from modeler.studio.thresholds import THRESHOLDS
from modeler.studio.timeline import add_player

_SIGNS = {1: "+", -1: "\u2212"}


class MappingTable:
    """A row for each joint, a place for each quantity; and the file's columns, to be dragged.

    Args:
        joints: of the robot.
        columns: of the file, and units that it states.
        chosen: our name -> column, as it is now.
        ranged: our names whose unit is a guess by its range.
        changed: is called with another choice.
    """

    def __init__(
        self,
        joints: Sequence[JointSpec],
        columns: Mapping[str, str],
        chosen: Mapping[str, ColumnChoice],
        ranged: Sequence[str],
        changed: Callable[[Mapping[str, ColumnChoice]], Awaitable[None]],
    ) -> None:
        self.joints, self.columns, self.chosen = joints, columns, dict(chosen)
        self.ranged, self.changed = ranged, changed
        self._dragged = ""
        self._cells: dict[str, Element] = {}
        self._chips: dict[str, Element] = {}
        present = {split_quantity(quantity, joints)[0] for quantity in chosen}
        driven = next((kind for kind in ("tau", "current", "duty") if kind in present), "tau")
        shown = [kind for kind in KINDS if kind in ("q", "qd", driven)]
        wide = ui.checkbox("all quantities").props("dense")
        wide.on_value_change(lambda: self._draw([*KINDS] if wide.value else shown))
        self._place = ui.element("div").classes("mapping-scroll")
        self._draw(shown)
        with ui.element("div").classes("mapping-chips"):
            for name, unit in [*columns.items()][: THRESHOLDS.max_menu_columns]:
                chip = ui.label(f"{name} [{unit}]" if unit else name).classes("mapping-chip")
                chip.props("draggable=true")
                chip.on("dragstart", lambda _, name=name: setattr(self, "_dragged", name), args=[])
                self._chips[name] = chip
        self._update_marks()

    def update_choices(
        self, chosen: Mapping[str, ColumnChoice], ranged: Sequence[str], anew: bool = False
    ) -> None:
        """Shows other choices; cells that show them already stay as they are, unless `anew`."""
        changed = [o for o in self._cells if anew or chosen.get(o) != self.chosen.get(o)]
        self.chosen, self.ranged = dict(chosen), ranged
        for quantity in changed:
            self._fill_cell(quantity)
        self._update_marks()

    def _update_marks(self) -> None:
        """What is a guess, and which columns are taken."""
        used_columns = {one.column for one in self.chosen.values()}
        for quantity, cell in self._cells.items():
            cell.classes(**{"add" if quantity in self.ranged else "remove": "mapping-guess"})
        for name, chip in self._chips.items():
            chip.classes(**{"add" if name in used_columns else "remove": "mapping-taken"})

    def _draw(self, kinds: Sequence[str]) -> None:
        self._place.clear()
        self._cells.clear()
        with self._place, ui.element("table").classes("studio-table mapping"):
            with ui.element("tr"):
                ui.element("th")
                for kind in kinds:
                    with ui.element("th"), ui.row().classes("items-center no-wrap"):
                        ui.label(KINDS[kind])
                        if self.joints:
                            self._add_common_unit_menu(kind)
            for name in ("time", *(joint.name for joint in self.joints)):
                with ui.element("tr"):
                    with ui.element("th"):
                        ui.label(name if name == "time" else f"joint {name}")
                    every = ["time"] if name == "time" else [f"{kind}{name}" for kind in kinds]
                    for quantity in every:
                        with ui.element("td"):
                            self._add_cell(quantity)
        self._update_marks()

    def _add_common_unit_menu(self, kind: str) -> None:
        """One menu for the units of all joints."""
        every = [f"{kind}{joint.name}" for joint in self.joints]
        units = [unit for quantity in every for unit in select_units(quantity, self.joints)]

        async def apply_unit(event: Any) -> None:
            chosen = dict(self.chosen)
            for quantity in (quantity for quantity in every if quantity in chosen):
                chosen[quantity] = self._convert_to_unit(quantity, chosen[quantity], event.value)
            await self.changed(chosen)

        menu = ui.select([*dict.fromkeys(units)], label="all in", on_change=apply_unit)
        menu.props("dense options-dense").classes("mapping-all")

    def _add_cell(self, quantity: str) -> None:
        """Where one of ours is said; a column can be dropped here."""
        self._cells[quantity] = cell = ui.element("div").classes("mapping-cell")
        cell.props["data-own"] = quantity
        cell.on("dragover", js_handler="(event) => event.preventDefault()")
        let = "(event) => { event.preventDefault(); emit(); }"
        cell.on("drop", lambda: self._assign_column(quantity, self._dragged), js_handler=let)
        self._fill_cell(quantity)

    def _fill_cell(self, quantity: str) -> None:
        """The column, its unit and its sign."""
        one, cell = self.chosen.get(quantity), self._cells[quantity]
        cell.clear()
        names = [*self.columns][: THRESHOLDS.max_menu_columns]
        if one is not None and one.column not in names:
            names.insert(0, one.column)
        with cell:
            menu = ui.select(names, value=one and one.column, with_input=True)
            menu.on_value_change(lambda event: self._assign_column(quantity, event.value))
            menu.props("dense options-dense").props("" if quantity == "time" else "clearable")
            menu.props["aria-label"] = f"column of {quantity}"
            menu.classes("mapping-column")
            if one is None:
                return
            if one.column not in self.columns:
                menu.props("error").tooltip("this log has no such column")
            self._add_unit_menu(quantity, one)
            if quantity != "time":
                sign = ui.button(_SIGNS[one.sign]).props("dense flat")
                sign.props["aria-label"] = f"sign of {quantity}"
                sign.on_click(lambda: self._flip_sign(quantity, sign))

    def _convert_to_unit(self, quantity: str, one: ColumnChoice, unit: str | None) -> ColumnChoice:
        """The same column in another unit; SI need not be said where the file says nothing."""
        plain = unit == select_units(quantity, self.joints)[0] and not self.columns.get(one.column)
        return dataclasses.replace(one, unit="" if plain else unit or "")

    def _add_unit_menu(self, quantity: str, one: ColumnChoice) -> None:
        units = list(select_units(quantity, self.joints))
        current_unit = one.unit or self.columns.get(one.column) or units[0]
        if current_unit not in units:
            units.append(current_unit)

        async def apply_unit(event: Any) -> None:
            one = self.chosen[quantity]
            self.chosen[quantity] = self._convert_to_unit(quantity, one, event.value)
            await self.changed(self.chosen)

        menu = ui.select(units, value=current_unit, with_input=True, new_value_mode="add-unique")
        menu.on_value_change(apply_unit)
        menu.props("dense options-dense hide-dropdown-icon").classes("mapping-unit")
        menu.props["aria-label"] = f"unit of {quantity}"

    async def _assign_column(self, quantity: str, column: str | None) -> None:
        chosen = dict(self.chosen)
        old = chosen.pop(quantity, None)
        if column:
            chosen[quantity] = dataclasses.replace(old or ColumnChoice(column), column=column)
        await self.changed(chosen)

    async def _flip_sign(self, quantity: str, button: ui.button) -> None:
        one = self.chosen[quantity]
        self.chosen[quantity] = dataclasses.replace(one, sign=-one.sign)
        button.text = _SIGNS[-one.sign]
        await self.changed(self.chosen)


_COLORS = (*COLORS[:5], *COLORS[6:])  # without sky, which blue is in the dark
_PANELS = {"q": "position", "qd": "speed", "tau": "torque or force", "current": "current"}
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
        self.known, self.guess = project_logs.logs[file], project_logs.get_guess(file)
        self.chosen = project_logs.resolve_columns(self.guess)
        self.window: tuple[float, float] | None = None
        self.brush: TimeRange | None = None
        self._turn = 0  # of the picture: another one forgets its zoom

    @property
    def log(self) -> ProjectLog:
        """Returns the log as the project has it."""
        return self.project_logs.get_log(self.file)

    async def draw(self) -> None:
        """Draws pictures first, then what takes longer."""
        with add_card(self.file), ui.row().classes("w-full no-wrap items-start data-log-view"):
            with ui.column().classes("data-pictures gap-2"):
                self._plot = ui.plotly(figures.build_plot(self._build_picture({}), self.file))
                self._plot.classes("w-full").on("plotly_relayout", self._update_zoom)
                self._line = add_player(self.file, self.known.ends)
                self._line.connect_brush(self._hold_range)
                self._line.on("mark", lambda e: self._explain_mark(self.get_marks()[int(e.args)]))
                self._line.on("role", lambda event: self._assign_role(event.args))
                self._draw_controls()
            self._robot = ui.column().classes("data-robot")
        with add_card("Columns"):
            self._about = ui.column().classes("w-full gap-1")
            joints, ranged = self.project_logs.joints, self._find_ranged()
            self._table = MappingTable(
                joints, self.guess.columns, self.chosen, ranged, self._apply_mapping
            )
            self._said = draw_command_line("")
        with add_card("What modeler log says"):
            self._words = ui.column().classes("w-full gap-1")
        self._describe_mapping()
        self.draw_findings()
        await self._draw_curves()
        if self._robot.is_deleted:
            return  # another log was opened meanwhile
        with self._robot:
            if self.studio.project.robot:
                self._line.frame = (await add_robot_frame(self.studio, alone=True)).element_id
                await self._show_film()
            else:
                self._offer_robot()

    # Pictures.

    async def _ask_viewer(self, question: str, *arguments: Any, kind: str = "") -> Any:
        """What the viewer answers of this log; None where it has no answer, which is reported."""
        place = self.project_logs.resolve_path(self.file)
        return await self.studio.try_viewer(question, place, *arguments, kind=kind)

    def _select_columns(self, kinds: Sequence[str]) -> dict[str, ColumnChoice]:
        """Our name -> column, of those kinds, where the log has it."""
        joints, columns = self.project_logs.joints, self.guess.columns
        return {
            quantity: one
            for quantity, one in self.chosen.items()
            if one.column in columns and split_quantity(quantity, joints)[0] in kinds
        }

    def _convert_values(self, quantity: str, values: np.ndarray) -> np.ndarray:
        """A column as it is mapped."""
        one = self.chosen[quantity]
        stated = self.known.units.get(one.column, "")
        return apply_choice(values, stated, one, quantity, self.project_logs.joints)

    async def _draw_curves(self) -> None:
        """Asks for the window that is looked at, and draws it."""
        names = [one.column for one in self._select_columns([*_PANELS]).values()]
        window = self.window or (-np.inf, np.inf)
        more = (self.known.clock, "", THRESHOLDS.all_curve_points // max(1, len(names)))
        raw = await self._ask_viewer("log_window", names, *window, *more, kind="window")
        if raw is not None:
            self._plot.update_figure(figures.build_plot(self._build_picture(raw), self.file))

    def _build_picture(self, raw: Mapping[str, tuple[np.ndarray, np.ndarray]]) -> Picture:
        """Positions, speeds and torques as they are mapped, one below the other."""
        joints = self.project_logs.joints
        curves: dict[str, list[Curve]] = {kind: [] for kind in _PANELS}
        for quantity, one in self._select_columns([*_PANELS]).items():
            kind, joint = split_quantity(quantity, joints)
            if joint is not None and one.column in raw:
                (time, values), place = raw[one.column], joints.index(joint)
                dash, color = divmod(place, len(_COLORS))
                style = Style(_COLORS[color], width=1.2, dash=bool(dash % 2))
                y = self._convert_values(quantity, values)
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

    async def _update_zoom(self, event: Any) -> None:
        time_range = figures.read_x_range(event.args)
        if time_range is not False:
            self.window = time_range if isinstance(time_range, tuple) else None
            await self._draw_curves()

    async def _show_window(self, window: tuple[float, float] | None) -> None:
        """At a part of the log."""
        self.window, self._turn = window, self._turn + 1
        await self._draw_curves()

    async def _show_film(self) -> None:
        """The robot moves as the log says."""
        positions = self._select_columns(["q"])
        columns = [one.column for one in positions.values()]
        film = await self._ask_viewer("log_film", columns, self.known.clock)
        if film is not None:
            q = {
                quantity.removeprefix("q"): self._convert_values(quantity, film[one.column])
                for quantity, one in positions.items()
            }
            self._line.show_motion(film["time"], q)

    def _offer_robot(self) -> None:
        count = len(self.project_logs.joints)
        draw_note("There is no robot yet: no fit, and nothing moves.")
        title = f"A robot with {count} joint{'s' * (count != 1)} to start from"
        add_button(title, self._create_robot, "outline")
        _add_small_button("Describe it", lambda: self.studio.open_screen("robot"))

    async def _create_robot(self) -> None:
        task = Task("new", joints="R" * max(1, len(self.project_logs.joints)))
        if await self.studio.run(task) is not None:
            self.studio.change_project(redraw=True, robot=ROBOT)

    # The time.

    def _draw_controls(self) -> None:
        """What is done with the cursor, with the segment that is held, and with the whole log."""
        with ui.row().classes("items-center gap-2"):
            self._ends = [
                ui.number(label, format="%.4f", on_change=self._read_ends).classes("data-end")
                for label in ("from s", "to s")
            ]
            with ui.row().classes("gap-1") as self._roles:
                for role, name in timeline.ROLES.items():
                    _add_small_button(name, partial(self._assign_role, role), "outline")
                _add_small_button("let in again", lambda: self._assign_role("in"))
                _add_small_button("zoom to it", lambda: self._show_window(_get_ends(self.brush)))
        with ui.row().classes("items-center gap-2"):
            for title, change in timeline.build_log_changes(self.known.ends).items():
                _add_small_button(title, partial(self._change_log, change))
            _add_small_button("whole log", lambda: self._show_window(None))
            self._roles_label = draw_note("")

    def _update_line(self) -> None:
        self._line.update_log(self.log, self.get_marks(), self.brush)
        self._roles.set_visibility(self.brush is not None)
        self._roles_label.text = timeline.describe_roles(self.log)

    def _hold_range(self, stretch: TimeRange | None) -> None:
        """The segment that was brushed; None: it was let go."""
        self.brush = stretch
        for field, side in zip(self._ends, _get_ends(stretch) or (None, None), strict=True):
            field.set_value(side)
        self._update_line()

    def _read_ends(self) -> None:
        start, end = (field.value for field in self._ends)
        if start is not None and end is not None and start < end:
            self.brush = TimeRange(float(start), float(end))
            self._update_line()

    def _assign_role(self, role: str) -> None:
        if self.brush is not None:
            time_range = self.brush
            self._change_log(lambda log: timeline.assign_role(log, time_range, role))

    def _change_log(self, change: Callable[[ProjectLog], ProjectLog]) -> None:
        self._renew(change(self.log))
        self._update_line()

    # The columns.

    def _find_ranged(self) -> Sequence[str]:
        """Our names whose unit is a guess by range alone, while the mapping is one."""
        return self.guess.ranged if self.project_logs.is_guess(self.guess) else ()

    def _describe_mapping(self) -> None:
        """What the mapping is, in words of people and of commands."""
        words = self.studio.project.mapping
        map_options = " ".join(f"--map {word}" for word in words)
        self._said.text = map_options or "columns as they are called"
        self._about.clear()
        missing = [o for o, one in self.chosen.items() if one.column not in self.guess.columns]
        with self._about:
            if "auto" in words:
                draw_note("The logs name their columns differently: each has its own guess.")
            elif self.project_logs.is_guess(self.guess):
                ranged = ", dotted units by range alone" if self.guess.ranged else ""
                draw_note(f"A guess by names{ranged}: check it.")
            if missing and "auto" not in words:
                draw_warnings([_ABSENT.format(self.chosen[missing[0]].column, missing[0])])
                _add_small_button("each by its own guess", self.project_logs.apply_each_guess)

    async def _apply_mapping(self, chosen: Mapping[str, ColumnChoice]) -> None:
        """Other columns, units or signs: words of `--map`, and the pictures at once."""
        project_logs, joints, changed = self.project_logs, self.project_logs.joints, False
        with self.studio.show_errors():
            for quantity, one in chosen.items():
                apply_choice(np.empty(0), "", one, quantity, joints)  # says which units cannot be
            under = project_logs.resolve_default_columns(self.guess)
            general = project_logs.select_general_words(self.guess)
            words = (*general, *build_map_words(chosen, under, joints))
            changed = self.studio.change_project(mapping=words, mapped=True)
        if not changed:
            self._table.update_choices(self.chosen, self._find_ranged(), anew=True)
            return
        self.studio.show_error("")
        timed, self.chosen = chosen.get("time") == self.chosen.get("time"), dict(chosen)
        if not timed:
            self.studio.redraw()
            return
        self._table.update_choices(self.chosen, self._find_ranged())
        self._describe_mapping()
        await self._draw_curves()
        if self.studio.project.robot:
            await self._show_film()
        self._again()

    # The warnings.

    def get_marks(self) -> list[Mapping[str, Any]]:
        """Returns the warnings that have a place in time."""
        return list(self.project_logs.read_result(self.file).get("marks", ()))

    def draw_findings(self) -> None:
        """Draws the output of `modeler log`."""
        self._update_line()
        result, marks = self.project_logs.read_result(self.file), self.get_marks()
        doubts = result.get("warnings", self.guess.doubts)
        rows = {line: [m for m in marks if line.endswith(m["line"])] for line in doubts}
        shown_marks = [id(mark) for line_marks in rows.values() for mark in line_marks]
        alike: dict[str, list[Mapping[str, Any]]] = {}
        for mark in (mark for mark in marks if id(mark) not in shown_marks):
            alike.setdefault(re.sub(r"[\d.]+", "#", mark["line"]), []).append(mark)
        for line_marks in alike.values():
            more = f", and {len(line_marks) - 1} like it" if len(line_marks) > 1 else ""
            rows[f"{line_marks[0]['start']:.4f} s: {line_marks[0]['line']}{more}"] = line_marks
        self._words.clear()
        with self._words:
            for line, line_marks in rows.items():
                self._draw_warning(line, line_marks)
            if not rows:
                draw_note("no warnings" if result else "Inspecting")
            heads = ("channel", "unit", "from", "to", "resolution", "missing")
            if result:
                draw_table(heads, map(_format_channel, result["channels"]))
                draw_folded("notes", result["notes"])

    def _draw_warning(self, line: str, marks: Sequence[Mapping[str, Any]]) -> None:
        """A warning, and what can be done where it has a place."""
        with ui.row().classes("items-center no-wrap gap-2 w-full"):
            with ui.element("div").classes("data-doubt"):
                draw_warnings([line])
            if marks:
                _add_small_button("why", lambda: self._explain_mark(marks[0]))
                _add_small_button("leave out", lambda: self._leave_out(marks), "outline")

    def _leave_out(self, marks: Sequence[Mapping[str, Any]]) -> None:
        log, margin = self.log, THRESHOLDS.warning_margin
        for mark in marks:
            start, end = round(mark["start"] - margin, 4), round(mark["end"] + margin, 4)
            log = timeline.assign_role(log, TimeRange(start, end), "out")
        self._change_log(lambda _: log)

    def _explain_mark(self, mark: Mapping[str, Any]) -> None:
        """The whole line, what the documentation says, and what can be done."""
        start, end = mark["start"], mark["end"]
        near = (start - 25 * THRESHOLDS.warning_margin, end + 25 * THRESHOLDS.warning_margin)
        with ui.dialog(value=True) as dialog, ui.card().classes("studio-card"):
            ui.label(f"{mark['channel']}, {start:.4f} to {end:.4f} s").classes("studio-part")
            ui.label(mark["line"])
            draw_note(_read_sentences().get(mark["kind"], ""))
            with ui.row():
                leave_out = _add_small_button("Leave out", lambda: self._leave_out([mark]))
                zoom = _add_small_button("Zoom in", lambda: self._show_window(near))
                for button in (leave_out, zoom):
                    button.on_click(dialog.close)
                _add_small_button("Close", dialog.close)


@cache
def _read_sentences() -> dict[str, str]:
    """What the documentation says of a kind of warning."""
    return parse_toml(read_text(locate_resources("templates") / "studio" / "doubts.toml"))


def _add_small_button(title: str, act: Callable[..., Any], face: str = "flat") -> ui.button:
    return add_button(title, act, "dense").props(face).classes("no-wrap")


def _get_ends(stretch: TimeRange | None) -> tuple[float, float] | None:
    return None if stretch is None else (stretch.start, stretch.end)


def _format_channel(channel: Mapping[str, Any]) -> Sequence[str]:
    """A channel in words."""
    unit = f"{channel['unit'] or ''}{'?' * channel['is_unit_guessed']}"
    numbers = (channel[name] for name in ("low", "high", "resolution"))
    texts = ("" if value is None else f"{value:.4g}" for value in numbers)
    return (channel["name"], unit, *texts, str(channel["missing_rows"] or ""))
