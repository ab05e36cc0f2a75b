"""The screen "robot": its table, edited beside its picture, and the ways to a robot."""

import asyncio
import contextlib
import dataclasses
import json
import time
from collections.abc import Awaitable, Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from nicegui import background_tasks, ui

from modeler.api.front_end import (
    CONVENTIONS,
    TEMPLATES,
    ModelerError,
    TableText,
    build_pasted_robot,
    find_table_text,
    insert_pasted_table,
    insert_row,
    list_builtin_robots,
    parse_pasted_cells,
    parse_pasted_table,
    read_builtin_robot,
    read_table_convention,
    remove_row,
    replace_cell,
    replace_limits,
    replace_symbol,
    set_joint_effect,
    write_atomically,
)
from modeler.studio.elements import (
    RobotFrame,
    add_button,
    add_card,
    add_run_button,
    draw_error,
    draw_head,
    draw_note,
)
from modeler.studio.file_inputs import add_drop_zone, choose_files
from modeler.studio.project import DRAFT
from modeler.studio.studio import Studio
from modeler.studio.tasks import ROBOT, Step, Task
from modeler.studio.thresholds import THRESHOLDS

if TYPE_CHECKING:  # who only draws loads nothing that computes
    from modeler.studio.robot_views import RobotPreview


class RobotText:
    """The text of a robot file and its past.

    Attributes:
        text: as it is now.
    """

    def __init__(self, text: str) -> None:
        self.text = text
        self._past: list[str] = []
        self._future: list[str] = []
        self._typed = 0.0

    def change_text(self, text: str, typing: bool = False) -> bool:
        """Changes the text to another one, one step further; of typing a step a second.

        Returns:
            False if it is the same.
        """
        if text == self.text:
            return False
        now = time.monotonic()
        if not (typing and now - self._typed < THRESHOLDS.typing_step and self._past):
            self._past = [*self._past[-THRESHOLDS.max_undo_steps :], self.text]
        self._typed = now if typing else 0.0
        self._future.clear()
        self.text = text
        return True

    def move_in_history(self, back: bool) -> bool:
        """Moves one step back or forth; returns False where there is none."""
        source, other = (self._past, self._future) if back else (self._future, self._past)
        if not source:
            return False
        other.append(self.text)
        self.text = source.pop()
        self._typed = 0.0
        return True


def save_text(folder: Path, text: str, right: bool) -> None:
    """Writes the text where it belongs.

    Args:
        folder: of the project.
        text: of the robot file.
        right: True if nothing is wrong in it.

    Raises:
        ModelerError: it cannot be written.
    """
    write_atomically(folder / (ROBOT if right else DRAFT), text)
    if right:
        with contextlib.suppress(OSError):
            (folder / DRAFT).unlink()


Taken = Callable[[str, tuple[str, ...]], Awaitable[None]]
"""Is called with the text of a robot file, and notes on how it was made."""

_FILES = (".urdf", ".xml", ".mjcf", ".par", ".toml")
_EXAMPLE = "i\t\u03b1 [deg]\ta [mm]\td [mm]\t\u03b8\n1\t0\t0\t333\tq1\n2\t-90\t0\t0\tq2"


def draw_choices(studio: Studio, before: str, on_taken: Taken) -> None:
    """Draws the ways to get a robot: those between which a user chooses.

    Args:
        studio: the window.
        before: text of the robot that there is; "": none.
        on_taken: is called with the new one.
    """
    with ui.element("div").classes("studio-ways"):
        with add_card("Paste a table"):
            _draw_paste(studio, before, on_taken)
        with add_card("Begin with a template"):
            _draw_template(studio, on_taken)
        with add_card("Open a file"):
            _draw_file(studio, on_taken)
        with add_card("Take a built-in robot"):
            _draw_builtin(on_taken)


def _draw_paste(studio: Studio, before: str, on_taken: Taken) -> None:
    area = ui.textarea(placeholder=_EXAMPLE).props("outlined dense rows=5 aria-label='table'")
    area.classes("w-full")
    draw_note("From a spreadsheet or a paper; headings may be left out, and may name deg and mm.")
    with ui.row().classes("items-center"):
        conventions = {"": "Detect from headings", **{name: name for name in CONVENTIONS}}
        convention = ui.select(conventions, value="", label="DH convention").classes("w-48")

        async def take_table() -> None:
            with studio.show_errors():
                table = parse_pasted_table(str(area.value or ""), convention.value)
                if not table.has_headings and not convention.value:
                    raise ModelerError(
                        "the table has no headings, and books order their columns differently: "
                        "choose the DH convention, or paste the headings too"
                    )
                new = build_pasted_robot(table, "robot") if not before else ""
                notes = (f"taken as a table of convention {table.convention}", *table.notes)
                if table.symbols:
                    symbols = ", ".join(table.symbols)
                    notes += (f"written into [symbols]: {symbols}: give their values",)
                await on_taken(new or insert_pasted_table(before, table), notes)

        add_button("Take this table", take_table, "unelevated")


def _draw_template(studio: Studio, on_taken: Taken) -> None:
    with ui.row().classes("items-center"):
        kind = ui.select(list(TEMPLATES), value=TEMPLATES[0], label="kind").classes("w-40")
        joints = ui.input("joints", value="RRR").classes("w-32")
        joints.props("hint='R turns, P slides'").bind_visibility_from(kind, "value", value="serial")
        table = ui.select(list(CONVENTIONS), value=CONVENTIONS[0], label="DH convention")
        table.classes("w-36").bind_visibility_from(kind, "value", value="serial")

    async def create_robot() -> None:
        task = Task("new", template=str(kind.value))
        if kind.value == "serial":
            task = dataclasses.replace(task, joints=str(joints.value), convention=str(table.value))
        await _take_command_robot(studio, task, on_taken)

    add_button("Begin", create_robot, "unelevated")


def _draw_file(studio: Studio, on_taken: Taken) -> None:
    async def open_file(files: list[str]) -> None:
        if Path(files[0]).suffix.lower() != ".toml":
            await _take_command_robot(studio, Task("convert", file=files[0]), on_taken)
            return
        with studio.show_errors():
            await on_taken(studio.read_text(files[0]), ())

    def begin_opening(files: list[str]) -> None:
        background_tasks.create(open_file(files))

    draw_note("URDF, MJCF, SYMORO's .par, or a robot file")
    label = "drop it here, or choose it"
    zone = add_drop_zone("originals", label, begin_opening, studio.show_error)
    zone.props(remove="multiple").classes("w-full")
    browse = partial(choose_files, studio, _FILES, begin_opening)
    add_button("Browse (no copy)", browse, "outline", icon="folder_open")


def _draw_builtin(on_taken: Taken) -> None:
    async def take_builtin() -> None:
        await on_taken(read_builtin_robot(str(name.value)), ())

    with ui.row().classes("items-center"):
        robots = list(list_builtin_robots())
        name = ui.select(robots, value="puma560", label="robot", with_input=True).classes("w-56")
        add_button("Take it", take_builtin, "unelevated")


async def _take_command_robot(studio: Studio, task: Task, on_taken: Taken) -> None:
    """A robot file that a command writes."""
    room = studio.room
    if await studio.run(task, keep=False) is not None and room is not None:
        with room:
            await on_taken(studio.read_text(ROBOT), ())


BASIC_EFFECTS = ("rotor_inertia", "viscous", "coulomb", "offset")
"""Columns of the grid of effects."""

_LIMITS = ("joint", "lower", "upper", "speed", "acceleration")


async def draw(studio: Studio) -> None:
    """Draws the screen of the robot."""
    document = studio.state.get("robot")
    names = (DRAFT, studio.project.robot)
    last = next((n for n in names if n and (studio.folder / n).exists()), "")
    file_text = studio.read_text(last) if last else ""
    if not isinstance(document, RobotText) or studio.is_read_only:
        document = studio.state["robot"] = RobotText(file_text)
    elif file_text:
        document.change_text(file_text)  # where somebody else wrote it
    editor = _RobotEditor(studio, document)
    if document.text:
        await editor.draw()
        return
    draw_head("The robot", "Its table, as a paper or a drawing has it. How does it come in?")
    draw_choices(studio, "", editor.take_robot)


class _RobotEditor:
    """The table, the text and the picture of one robot, in one window."""

    def __init__(self, studio: Studio, document: RobotText) -> None:
        self.studio, self.document = studio, document
        self.look: RobotPreview | None = None
        self.frame: RobotFrame | None = None
        self.limits: dict[str, list[str]] = {}  # that are not complete yet

    async def draw(self) -> None:
        """Draws the screen of a robot that there is."""
        studio = self.studio
        with ui.row().classes("items-center w-full"):
            self.title = ui.label().classes("studio-head")
            ui.space()
            with ui.dialog() as ways, ui.card().classes("studio-card studio-dialog"):
                ui.label("Another robot, or another table for this one").classes("studio-part")
                draw_choices(studio, self.document.text, self.take_robot)
            self.changing = []
            for what, key, back in (("undo", "Z", True), ("redo", "Y", False)):
                button = ui.button(icon=what, on_click=partial(self.move_in_history, back))
                button.props("flat round dense").props["aria-label"] = f"{what} the edit"
                self.changing.append(button.tooltip(f"{what} (Ctrl+{key})"))
            self.changing.append(add_button("Another robot or table", ways.open, "outline"))
        self.error = ui.label().classes("studio-error robot-error").props("role=alert")
        self.notes = ui.column().classes("studio-soft gap-0")
        with ui.element("div").classes("studio-split"):
            with ui.column().classes("w-full"):
                self._draw_tabs()
            with ui.column().classes("studio-beside") as self.beside:
                pass
        with self.base:
            await self._draw_derivation()
        for button in self.changing:
            button.set_enabled(not studio.is_read_only)
        await self.check_text()
        dark = "matchMedia('(prefers-color-scheme: dark)').matches"
        with contextlib.suppress(TimeoutError):  # over a slow line the text stays light
            if await ui.run_javascript(dark, timeout=20.0):
                self.editor.set_theme("vscodeDark")

    def _draw_tabs(self) -> None:
        names = ("Table", "Effects", "Limits", "Base parameters", "Text")
        state = self.studio.state
        with ui.tabs().props("no-caps dense align=left") as self.tabs:
            for name in names:
                ui.tab(name)
        tabs = self.tabs
        tabs.value = state.get("robot tab", names[0])
        tabs.on_value_change(lambda event: state.update({"robot tab": event.value}))

        def add_panel(name: str) -> ui.column:
            """Adds a panel that tabs hide, not take away: scripts fill what is in it."""
            return ui.column().classes("w-full").bind_visibility_from(tabs, "value", value=name)

        with add_panel("Table"):
            self.cells = ui.element("div").classes("studio-scroll")
            self._connect_edits(
                self.cells, cell=self._edit_cell, block=self._paste_block, row=self._edit_row
            )

            def move(event: Any) -> Any:
                return self.move_in_history(event.args["detail"] == "undo")

            self.cells.on("step", move, args=["detail"])
            _draw_hint(
                "Arrows and Enter move, Ctrl+Enter adds a row; a block from a spreadsheet may "
                'be pasted. Angles in rad or "90 deg", lengths in m or "40 mm".'
            )
            self.letters = self._add_named_cells(self._edit_symbol)
        with add_panel("Effects"):
            self.effects = ui.element("div").classes("studio-scroll")
        with add_panel("Limits"):
            self.ranges = self._add_named_cells(self._edit_limit)
            _draw_hint(
                "Of simulated and exciting motions, and of the sliders: rad or m, rad/s or "
                "m/s, and so on. An empty row has the limits that every joint has."
            )
        with add_panel("Base parameters") as self.base:
            pass
        with add_panel("Text"):
            text = self.document.text
            self.editor = ui.codemirror(text, language="TOML", theme="vscodeLight")
            self.editor.on_value_change(self._apply_typed).classes("studio-text w-full")
            self.editor.set_enabled(not self.studio.is_read_only)

    def _add_named_cells(self, edit: Any) -> ui.element:
        """Cells of rows that have names, edited one by one or as a block."""
        cells = ui.element("div").classes("studio-scroll")
        self._connect_edits(cells, cell=edit, block=partial(self._paste_cells, edit))
        return cells

    def _connect_edits(self, element: ui.element, **handlers: Any) -> None:
        """Edits from a script; one that fails reports its line."""
        for name, handler in handlers.items():

            async def apply_edit(event: Any, handler: Any = handler) -> None:
                if self.studio.is_read_only:
                    return
                try:
                    await handler(**event.args["detail"])
                except ModelerError as error:
                    self._show_error(str(error))

            element.on(name, apply_edit, args=["detail"])

    # Edits: each makes another text of the robot file.

    async def take_robot(self, text: str, notes: tuple[str, ...]) -> None:
        """Takes a robot that came from elsewhere into the project."""
        with self.studio.show_errors():
            self.studio.check_writable()
            self.document.change_text(text)
            self.studio.state["robot notes"] = notes
            look: RobotPreview = await self.studio.ask_viewer("robot_look", text)
            save_text(self.studio.folder, text, not look.error)
            if look.error:
                self.studio.redraw()
            else:
                self.studio.change_project(redraw=True, robot=ROBOT)

    async def move_in_history(self, back: bool) -> None:
        """Undoes the last edit of the text (`back`), or redoes it."""
        if not self.studio.is_read_only and self.document.move_in_history(back):
            await self.check_text(all_cells=True)

    async def change_text(self, text: str, all_cells: bool = False) -> None:
        """Changes the text of the robot to another one, and checks it."""
        if self.document.change_text(text):
            self.studio.state.pop("robot notes", None)
            await self.check_text(all_cells)

    async def _apply_typed(self, event: Any) -> None:
        text = str(event.value)
        if self.studio.is_read_only or not self.document.change_text(text, typing=True):
            return
        await asyncio.sleep(THRESHOLDS.typing_pause)
        if self.document.text == text:
            await self.check_text()

    async def _edit_cell(self, row: int, column: int, text: str) -> None:
        await self.change_text(replace_cell(self.document.text, row, column, text))

    async def _paste_block(self, row: int, column: int, text: str) -> None:
        changed = self.document.text
        try:
            headed = parse_pasted_table(text)
        except ModelerError:
            headed = None
        if headed is not None and headed.has_headings:
            await self.take_robot(insert_pasted_table(changed, headed), headed.notes)
            return
        for k, cells in enumerate(parse_pasted_cells(text)):
            table = find_table_text(changed)
            if table is not None and row + k >= len(table.rows):
                changed = insert_row(changed, len(table.rows) - 1, _build_row(table, changed))
            for i, cell in enumerate(cells):
                if table is not None and column + i < len(table.columns):
                    changed = replace_cell(changed, row + k, column + i, cell)
        await self.change_text(changed, all_cells=True)

    async def _edit_row(self, row: int, what: str) -> None:
        text, table = self.document.text, find_table_text(self.document.text)
        if table is not None and what == "add":
            text = insert_row(text, row, _build_row(table, text, row))
        elif table is not None:
            text = remove_row(text, row)
        await self.change_text(text, all_cells=True)

    async def _edit_symbol(self, row: int, column: int, text: str) -> None:
        if self.look is not None and column == 1 and row < len(self.look.symbols):
            symbol = self.look.symbols[row][0]
            await self.change_text(replace_symbol(self.document.text, symbol, text))

    async def _edit_limit(self, row: int, column: int, text: str) -> None:
        if self.look is None or not 0 < column < len(_LIMITS) or row >= len(self.look.joints):
            return
        joint = self.look.joints[row]
        cells = self.limits.setdefault(joint.name, list(joint.limits))
        cells[column - 1] = text.strip()
        if all(cells) or not any(cells):
            del self.limits[joint.name]
            await self.change_text(replace_limits(self.document.text, joint.name, cells))
        else:
            self._show_error(f"[limits], joint {joint.name}: write all four, or none")

    async def _paste_cells(self, edit: Any, row: int, column: int, text: str) -> None:
        """A block from the clipboard, cell by cell."""
        for k, cells in enumerate(parse_pasted_cells(text), row):
            for i, cell in enumerate(cells, column):
                await edit(k, i, cell)

    async def _edit_effect(self, effect: str, joint: str, is_wanted: bool) -> None:
        everyone = () if self.look is None else self.look.everyone
        try:
            changed = set_joint_effect(self.document.text, effect, joint, is_wanted, everyone)
            await self.change_text(changed)
        except ModelerError as error:
            self._show_error(str(error))

    # What the edits make.

    async def check_text(self, all_cells: bool = False) -> None:
        """Looks at the text: a new picture and a robot file, or what is wrong and where."""
        text = self.document.text
        try:
            kind = f"robot {id(self)}"
            look: RobotPreview | None = await self.studio.ask_viewer("robot_look", text, kind=kind)
            if look is None or text != self.document.text:
                return  # a newer one is looked at
            if not self.studio.is_read_only:
                save_text(self.studio.folder, text, not look.error)
                if not look.error and not self.studio.project.robot:
                    self.studio.change_project(robot=ROBOT)
            await self._show_preview(look, all_cells)
        except ModelerError as error:
            self._show_error(str(error))

    async def _show_preview(self, look: "RobotPreview", all_cells: bool) -> None:
        if self.editor.value != self.document.text:
            self.editor.set_value(self.document.text)
        before = self.look
        if not look.error:
            self.look = look
        self._show_error(look.error)
        self._show_cells(look, all_cells)
        self._show_named_tables(self.look or look, look, all_cells)
        if look.content is None:
            if self.frame is None and (self.studio.folder / ROBOT).exists():  # the last right one
                await self._draw_picture(self.studio.read_text(ROBOT))
            return
        self.title.text = look.name
        notes = (*self.studio.state.get("robot notes", ()), *look.notes)
        self.notes.clear()
        with self.notes:
            for note in notes:
                ui.label(note)
        if self.frame is None:
            await self._draw_picture(self.document.text)
        else:
            self.frame.replace_robot(look.content)
        if all_cells or before is None or before.joints != look.joints:
            self._show_effects(look)
        self._update_stale()

    async def _draw_picture(self, text: str) -> None:
        html = await self.studio.ask_viewer("robot_page", text)
        with self.beside:
            self.frame = RobotFrame(self.studio, html, "calc(100vh - 190px)")
        self.frame.connect_joint(self._select_row)

    def _select_row(self, joint: str) -> None:
        """A joint of the picture: its row."""
        self.tabs.value = "Table"
        words = ", ".join(map(json.dumps, (self.cells.html_id, joint)))
        self.cells.client.run_javascript(f"focusRow({words})")

    def _show_cells(self, look: "RobotPreview", all_cells: bool) -> None:
        if look.table is None:
            return
        names = look.names or (self.look.names if self.look else ())
        columns, rows = look.table.columns, look.table.rows
        self._fill_cells(self.cells, columns, rows, look.wrong_cell, names, 0, look, all_cells)

    def _show_named_tables(
        self, good: "RobotPreview", look: "RobotPreview", all_cells: bool
    ) -> None:
        """The tables of limits and letters; `good` is the last text in which nothing was wrong."""
        joints = [joint.name for joint in good.joints]
        limits = [(f"{j.name} [{j.unit}]", *self.limits.get(j.name, j.limits)) for j in good.joints]
        letters = [name for name, _ in good.symbols]
        uses: list[list[str]] = [[] for _ in letters]
        for element, table, columns, rows, keys, names in (
            (self.ranges, "limits", _LIMITS, limits, joints, [[name] for name in joints]),
            (self.letters, "symbols", ("letter", "value"), good.symbols, letters, uses),
        ):
            wrong = None
            if look.named[:1] == (table,) and look.named[1] in keys:
                wrong = (keys.index(look.named[1]), -1)
            self._fill_cells(element, columns, rows, wrong, names, 1, look, all_cells)

    def _show_effects(self, look: "RobotPreview") -> None:
        self.effects.clear()
        with self.effects, ui.element("table").classes("studio-grid"):
            with ui.element("thead"), ui.element("tr"):
                for name in ("joint", *(effect.replace("_", " ") for effect in BASIC_EFFECTS)):
                    with ui.element("th").props("scope=col"):
                        ui.label(name)
            with ui.element("tbody"):
                for joint in look.joints:
                    with ui.element("tr") as row:
                        row.props["data-rows"] = joint.name
                        with ui.element("th").props("scope=row"):
                            ui.label(joint.name if joint.actuated else f"{joint.name} (passive)")
                        for effect in BASIC_EFFECTS:
                            with ui.element("td"):
                                self._add_effect_box(effect, joint.name, effect in joint.effects)

    def _add_effect_box(self, effect: str, joint: str, has: bool) -> None:
        box = ui.checkbox(value=has).props("dense")
        box.props["aria-label"] = f"{effect} of joint {joint}"
        box.set_enabled(not self.studio.is_read_only)
        box.on_value_change(lambda event: self._edit_effect(effect, joint, bool(event.value)))

    def _fill_cells(
        self,
        element: ui.element,
        columns: Sequence[str],
        rows: Sequence[Sequence[str]],
        wrong: tuple[int, int] | None,
        names: Sequence[Sequence[str]],
        fixed: int,
        look: "RobotPreview",
        all_cells: bool,
    ) -> None:
        """Shows cells by a script: those before `fixed` cannot be edited, `wrong` has a mistake."""
        content = {"columns": columns, "rows": rows, "wrong": wrong, "names": names, "fixed": fixed}
        content |= {"all": all_cells, "line": look.error, "reading": self.studio.is_read_only}
        words = json.dumps(content, separators=(",", ":"))
        element.client.run_javascript(f"showCells({json.dumps(element.html_id)}, {words})")

    def _show_error(self, line: str) -> None:
        self.error.text = line

    # Base parameters.

    async def _draw_derivation(self) -> None:
        """The button, and what the last derivation found."""
        studio = self.studio
        with ui.column().classes("w-full"):
            add_run_button(studio, "Derive", lambda: Task("derive"))
            self.stale = ui.label("of an earlier table: derive again").classes("studio-doubtful")
            self.stale.set_visibility(False)
            self.step_shown = _find_last_derivation(studio)
            step = self.step_shown
            if step is None:
                return None
            files = step.result_file, step.robot_copy
            try:
                html, facts = await studio.ask_viewer("relations_of", *files)
            except ModelerError as error:
                return draw_error(error)
            ui.label(_describe_counts(facts))
            _draw_hint(
                "Point at one, or go there by Tab: its links light up, and every term is reported."
            )
            ui.html(html, sanitize=False).classes("w-full")
        return None

    def _update_stale(self) -> None:
        step, folder = self.step_shown, self.studio.folder
        if step is not None and (folder / step.robot_copy).exists():
            old = self.studio.read_text(step.robot_copy) != self.document.text
            self.stale.set_visibility(old)


def _draw_hint(text: str) -> None:
    """What one may do here."""
    draw_note(text, "studio-small")


def _find_last_derivation(studio: Studio) -> Step | None:
    derivations = [step for step in studio.project.steps if step.verb == "derive"]
    return derivations[-1] if derivations else None


def _describe_counts(facts: dict[str, Any]) -> str:
    known = {kind.replace("_", " "): count for kind, count in facts["counts"].items() if count}
    counts = ", ".join(f"{count} {kind}" for kind, count in known.items())
    smallest, dropped = facts["rank_gap"]
    gap = f"the smallest singular value kept is {smallest:.3g}" if smallest else ""
    gap += f", the largest dropped {dropped:.1e}" if dropped else ""
    return f"{facts['rank']} base parameters ({counts}); proof: {facts['proof']}; {gap}"


def _build_row(table: TableText, text: str, after: int | None = None) -> list[str]:
    """A revolute row on the row that it stands below."""
    columns, rows = table.columns, table.rows
    place = columns.index("j") if "j" in columns else 0
    used_names = [row[place] for row in rows if place < len(row)]
    name = next(str(k) for k in range(1, len(rows) + 2) if str(k) not in used_names)
    above = used_names[len(rows) - 1 if after is None else after] if used_names else "0"
    known = {"j": name, "parent": above, "mu": "1", "theta": f"q{name}"}
    if read_table_convention(text) == "khalil":
        known["a"] = above
    return [known.get(column, "0") for column in columns]
