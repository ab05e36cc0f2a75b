"""The screen "robot": its table, edited beside its picture, and what it can be identified by."""

import asyncio
import contextlib
import json
from functools import partial
from typing import Any

from nicegui import ui

from modeler.core.errors import ModelerError
from modeler.robot import (
    TableText,
    convention_of,
    pasted_cells,
    pasted_table,
    table_text,
    with_cell,
    with_effect_on,
    with_limits,
    with_pasted,
    with_row,
    with_symbol,
    without_row,
)
from modeler.studio import robot_start
from modeler.studio.elements import head, run_button
from modeler.studio.robot_frame import RobotFrame
from modeler.studio.robot_text import DRAFT, RobotText, keep
from modeler.studio.robot_views import BASIC_EFFECTS, RobotLook
from modeler.studio.studio import Studio
from modeler.studio.tasks import ROBOT, Step, Task

_PAUSE = 0.2  # s after the last stroke in the text
_LIMITS = ("joint", "lower", "upper", "speed", "acceleration")


async def draw(studio: Studio) -> None:
    """Draws it."""
    kept = studio.kept.get("robot")
    names = (DRAFT, studio.project.robot)
    last = next((n for n in names if n and (studio.folder / n).exists()), "")
    now = studio.text(last) if last else ""
    if not isinstance(kept, RobotText) or studio.read_only:
        kept = studio.kept["robot"] = RobotText(now)
    elif now:
        kept.change(now)  # where somebody else wrote it
    editor = _RobotEditor(studio, kept)
    if kept.text:
        await editor.draw()
        return
    head("The robot", "Its table, as a paper or a drawing has it. How does it come in?")
    robot_start.start(studio, "", editor.take)


class _RobotEditor:
    """The table, the text and the picture of one robot, in one window."""

    def __init__(self, studio: Studio, kept: RobotText) -> None:
        self.studio, self.kept = studio, kept
        self.look: RobotLook | None = None
        self.frame: RobotFrame | None = None
        self.limits: dict[str, list[str]] = {}  # that are not complete yet

    async def draw(self) -> None:
        """The screen of a robot that there is."""
        studio = self.studio
        with ui.row().classes("items-center w-full"):
            self.title = ui.label().classes("studio-head")
            ui.space()
            with ui.dialog() as ways, ui.card().classes("studio-card studio-dialog"):
                ui.label("Another robot, or another table for this one").classes("studio-part")
                robot_start.start(studio, self.kept.text, self.take)
            self.changing = [
                ui.button(icon="undo", on_click=lambda: self.step(True))
                .props("flat round dense aria-label='undo the edit'").tooltip("undo (Ctrl+Z)"),
                ui.button(icon="redo", on_click=lambda: self.step(False))
                .props("flat round dense aria-label='redo the edit'").tooltip("redo (Ctrl+Y)"),
                ui.button("Another robot or table", on_click=ways.open).props("no-caps outline"),
            ]  # fmt: skip
        self.error = ui.label().classes("studio-error robot-error").props("role=alert")
        self.notes = ui.column().classes("studio-soft gap-0")
        with ui.element("div").classes("studio-split"):
            with ui.column().classes("w-full"):
                self._tabs()
            with ui.column().classes("studio-beside") as self.beside:
                pass
        with self.base:
            await self._derived()
        for button in self.changing:
            button.set_enabled(not studio.read_only)
        await self.check()
        dark = "matchMedia('(prefers-color-scheme: dark)').matches"
        with contextlib.suppress(TimeoutError):  # over a slow line the text stays light
            if await ui.run_javascript(dark, timeout=20.0):
                self.editor.set_theme("vscodeDark")

    def _tabs(self) -> None:
        names = ("Table", "Effects", "Limits", "Base parameters", "Text")
        kept = self.studio.kept
        with ui.tabs().props("no-caps dense align=left") as self.tabs:
            for name in names:
                ui.tab(name)
        tabs = self.tabs
        tabs.value = kept.get("robot tab", names[0])
        tabs.on_value_change(lambda event: kept.update({"robot tab": event.value}))

        def panel(name: str) -> ui.column:
            """Hidden, not taken away: scripts fill what is in it."""
            return ui.column().classes("w-full").bind_visibility_from(tabs, "value", value=name)

        with panel("Table"):
            self.cells = ui.element("div").classes("studio-scroll")
            self._heard(self.cells, cell=self._cell, block=self._block, row=self._row)
            self.cells.on(
                "step", lambda event: self.step(event.args["detail"] == "undo"), args=["detail"]
            )
            _told(
                "Arrows and Enter move, Ctrl+Enter adds a row; a block from a spreadsheet may "
                'be pasted. Angles in rad or "90 deg", lengths in m or "40 mm".'
            )
            self.letters = ui.element("div").classes("studio-scroll")
            self._heard(self.letters, cell=self._letter, block=partial(self._each, self._letter))
        with panel("Effects"):
            self.effects = ui.element("div").classes("studio-scroll")
        with panel("Limits"):
            self.ranges = ui.element("div").classes("studio-scroll")
            self._heard(self.ranges, cell=self._limit, block=partial(self._each, self._limit))
            _told(
                "Of simulated and exciting motions, and of the sliders: rad or m, rad/s or "
                "m/s, and so on. An empty row has the limits that every joint has."
            )
        with panel("Base parameters") as self.base:
            pass
        with panel("Text"):
            self.editor = ui.codemirror(
                self.kept.text, language="TOML", on_change=self._typed, theme="vscodeLight"
            ).classes("studio-text w-full")
            self.editor.set_enabled(not self.studio.read_only)

    def _heard(self, element: ui.element, **handlers: Any) -> None:
        """Edits that a script tells; one that fails tells its line."""
        for name, handler in handlers.items():

            async def act(event: Any, handler: Any = handler) -> None:
                if self.studio.read_only:
                    return
                try:
                    await handler(**event.args["detail"])
                except ModelerError as error:
                    self._tell(str(error))

            element.on(name, act, args=["detail"])

    # Edits: each makes another text of the robot file.

    async def take(self, text: str, notes: tuple[str, ...]) -> None:
        """A robot that came from elsewhere."""
        try:
            if self.studio.read_only:
                raise ModelerError(self.studio.why_read_only)
            self.kept.change(text)
            self.studio.kept["robot notes"] = notes
            look: RobotLook = await self.studio.view("robot_look", text)
            keep(self.studio.folder, text, not look.error)
        except ModelerError as error:
            self.studio.show_error(str(error))
            return
        if look.error:
            self.studio.redraw()
        else:
            self.studio.change(redraw=True, robot=ROBOT)

    async def step(self, back: bool) -> None:
        """Undo and redo."""
        if not self.studio.read_only and self.kept.step(back):
            await self.check(all_cells=True)

    async def change(self, text: str, all_cells: bool = False) -> None:
        """Another text."""
        if self.kept.change(text):
            self.studio.kept.pop("robot notes", None)
            await self.check(all_cells)

    async def _typed(self, event: Any) -> None:
        text = str(event.value)
        if self.studio.read_only or not self.kept.change(text, typing=True):
            return
        await asyncio.sleep(_PAUSE)
        if self.kept.text == text:
            await self.check()

    async def _cell(self, row: int, column: int, text: str) -> None:
        await self.change(with_cell(self.kept.text, row, column, text))

    async def _block(self, row: int, column: int, text: str) -> None:
        changed = self.kept.text
        try:
            headed = pasted_table(text)
        except ModelerError:
            headed = None
        if headed is not None and headed.headed:
            await self.take(with_pasted(changed, headed), headed.notes)
            return
        for k, cells in enumerate(pasted_cells(text)):
            table = table_text(changed)
            if table is not None and row + k >= len(table.rows):
                changed = with_row(changed, len(table.rows) - 1, _new_row(table, changed))
            for i, cell in enumerate(cells):
                if table is not None and column + i < len(table.columns):
                    changed = with_cell(changed, row + k, column + i, cell)
        await self.change(changed, all_cells=True)

    async def _row(self, row: int, what: str) -> None:
        text, table = self.kept.text, table_text(self.kept.text)
        if table is not None and what == "add":
            text = with_row(text, row, _new_row(table, text, row))
        elif table is not None:
            text = without_row(text, row)
        await self.change(text, all_cells=True)

    async def _letter(self, row: int, column: int, text: str) -> None:
        if self.look is not None and column == 1 and row < len(self.look.symbols):
            await self.change(with_symbol(self.kept.text, self.look.symbols[row][0], text))

    async def _limit(self, row: int, column: int, text: str) -> None:
        if self.look is None or not 0 < column < len(_LIMITS) or row >= len(self.look.joints):
            return
        joint = self.look.joints[row]
        cells = self.limits.setdefault(joint.name, list(joint.limits))
        cells[column - 1] = text.strip()
        if all(cells) or not any(cells):
            del self.limits[joint.name]
            await self.change(with_limits(self.kept.text, joint.name, cells))
        else:
            self._tell(f"[limits], joint {joint.name}: write all four, or none")

    async def _each(self, edit: Any, row: int, column: int, text: str) -> None:
        """A block from the clipboard, cell by cell."""
        for k, cells in enumerate(pasted_cells(text), row):
            for i, cell in enumerate(cells, column):
                await edit(k, i, cell)

    async def _effect(self, effect: str, joint: str, wanted: bool) -> None:
        everyone = () if self.look is None else self.look.everyone
        try:
            await self.change(with_effect_on(self.kept.text, effect, joint, wanted, everyone))
        except ModelerError as error:
            self._tell(str(error))

    # What the edits make.

    async def check(self, all_cells: bool = False) -> None:
        """Looks at the text: a new picture and a robot file, or what is wrong and where."""
        text = self.kept.text
        try:
            kind = f"robot {id(self)}"
            look: RobotLook | None = await self.studio.view("robot_look", text, kind=kind)
            if look is None or text != self.kept.text:
                return  # a newer one is looked at
            if not self.studio.read_only:
                keep(self.studio.folder, text, not look.error)
                if not look.error and not self.studio.project.robot:
                    self.studio.change(robot=ROBOT)
            await self._show(look, all_cells)
        except ModelerError as error:
            self._tell(str(error))

    async def _show(self, look: RobotLook, all_cells: bool) -> None:
        if self.editor.value != self.kept.text:
            self.editor.set_value(self.kept.text)
        before = self.look
        if not look.error:
            self.look = look
        self._tell(look.error)
        self._show_cells(look, all_cells)
        self._show_named(self.look or look, look, all_cells)
        if look.content is None:
            if self.frame is None and (self.studio.folder / ROBOT).exists():
                await self._picture(self.studio.text(ROBOT))  # the last one that was right
            return
        self.title.text = look.name
        notes = (*self.studio.kept.get("robot notes", ()), *look.notes)
        self.notes.clear()
        with self.notes:
            for note in notes:
                ui.label(note)
        if self.frame is None:
            await self._picture(self.kept.text)
        else:
            self.frame.replace(look.content)
        if all_cells or before is None or before.joints != look.joints:
            self._show_effects(look)
        self._stale()

    async def _picture(self, text: str) -> None:
        html = await self.studio.view("robot_page", text)
        with self.beside:
            self.frame = RobotFrame(self.studio, html, "calc(100vh - 190px)")
        self.frame.on_joint(self._clicked)

    def _clicked(self, joint: str) -> None:
        """A joint of the picture: its row."""
        self.tabs.value = "Table"
        words = ", ".join(map(json.dumps, (self.cells.html_id, joint)))
        self.cells.client.run_javascript(f"focusRow({words})")

    def _show_cells(self, look: RobotLook, all_cells: bool) -> None:
        if look.table is None:
            return
        names = look.names or (self.look.names if self.look else ())
        self._script(self.cells, columns=look.table.columns, rows=look.table.rows, all=all_cells,
                     wrong=look.wrong, line=look.error, reading=self.studio.read_only,
                     names=names, fixed=0)  # fmt: skip

    def _show_named(self, good: RobotLook, look: RobotLook, all_cells: bool) -> None:
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
            self._script(element, columns=columns, rows=rows, all=all_cells, wrong=wrong,
                         line=look.error, reading=self.studio.read_only, names=names,
                         fixed=1)  # fmt: skip

    def _show_effects(self, look: RobotLook) -> None:
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
                                self._box(effect, joint.name, effect in joint.effects)

    def _box(self, effect: str, joint: str, has: bool) -> None:
        box = ui.checkbox(value=has).props("dense")
        box.props["aria-label"] = f"{effect} of joint {joint}"
        box.set_enabled(not self.studio.read_only)
        box.on_value_change(lambda event: self._effect(effect, joint, bool(event.value)))

    def _script(self, element: ui.element, **content: Any) -> None:
        words = json.dumps(content, separators=(",", ":"))
        call = f"showCells({json.dumps(element.html_id)}, {words})"
        element.client.run_javascript(call)

    def _tell(self, line: str) -> None:
        self.error.text = line

    # Base parameters.

    async def _derived(self) -> None:
        """The button, and what the last derivation found."""
        studio = self.studio
        with ui.column().classes("w-full"):
            run_button(studio, "Derive", lambda: Task("derive"))
            self.stale = ui.label("of an earlier table: derive again").classes("studio-doubtful")
            self.stale.set_visibility(False)
            self.step_shown = _last(studio)
            if self.step_shown is None:
                return
            step = self.step_shown
            try:
                html, told = await studio.view("relations_of", step.result, step.robot)
            except ModelerError as error:
                ui.label(str(error)).classes("studio-error")
                return
            ui.label(_counted(told))
            _told("Point at one, or go there by Tab: its links light up, and every term is told.")
            ui.html(html, sanitize=False).classes("w-full")

    def _stale(self) -> None:
        step = self.step_shown
        there = step is not None and (self.studio.folder / step.robot).exists()
        old = there and step is not None and self.studio.text(step.robot) != self.kept.text
        self.stale.set_visibility(old)


def _told(text: str) -> None:
    """What one may do here."""
    ui.label(text).classes("studio-soft studio-small")


def _last(studio: Studio) -> Step | None:
    own = [step for step in studio.project.steps if step.verb == "derive"]
    return own[-1] if own else None


def _counted(told: dict[str, Any]) -> str:
    counts = ", ".join(
        f"{count} {kind.replace('_', ' ')}" for kind, count in told["counts"].items() if count
    )
    kept, dropped = told["rank_gap"]
    gap = f"the smallest singular value kept is {kept:.3g}" if kept else ""
    gap += f", the largest dropped {dropped:.1e}" if dropped else ""
    return f"{told['rank']} base parameters ({counts}); proof: {told['proof']}; {gap}"


def _new_row(table: TableText, text: str, after: int | None = None) -> list[str]:
    """A revolute row on the row that it stands below."""
    columns, rows = table.columns, table.rows
    place = columns.index("j") if "j" in columns else 0
    taken = [row[place] for row in rows if place < len(row)]
    name = next(str(k) for k in range(1, len(rows) + 2) if str(k) not in taken)
    above = taken[len(rows) - 1 if after is None else after] if taken else "0"
    known = {"j": name, "parent": above, "mu": "1", "theta": f"q{name}"}
    if convention_of(text) == "khalil":
        known["a"] = above
    return [known.get(column, "0") for column in columns]
