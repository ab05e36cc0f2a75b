"""The table in which columns of a log become ours: by menu, by dragging, with unit and sign."""

import dataclasses
from collections.abc import Awaitable, Callable, Mapping, Sequence
from typing import Any

from nicegui import ui
from nicegui.element import Element

from modeler.core.manifest import JointSpec
from modeler.studio.log_mapping import KINDS, ColumnChoice, select_units, split_quantity

_MOST = 400  # columns that a menu lists; others are typed
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
        present_kinds = {split_quantity(quantity, joints)[0] for quantity in chosen}
        driven = [kind for kind in ("tau", "current", "duty") if kind in present_kinds][:1] or [
            "tau"
        ]
        shown = [kind for kind in KINDS if kind in ("q", "qd", *driven)]
        wide = ui.checkbox("all quantities").props("dense")
        wide.on_value_change(lambda: self._draw([*KINDS] if wide.value else shown))
        self._place = ui.element("div").classes("mapping-scroll")
        self._draw(shown)
        with ui.element("div").classes("mapping-chips"):
            for name, unit in [*columns.items()][:_MOST]:
                chip = ui.label(f"{name} [{unit}]" if unit else name).classes("mapping-chip")
                chip.props("draggable=true")
                chip.on("dragstart", lambda _, name=name: setattr(self, "_dragged", name), args=[])
                self._chips[name] = chip
        self._update_marks()

    def update_choices(
        self, chosen: Mapping[str, ColumnChoice], ranged: Sequence[str], anew: bool = False
    ) -> None:
        """Shows other choices; cells that show them already stay as they are, unless `anew`."""
        changed = [
            quantity
            for quantity in self._cells
            if anew or chosen.get(quantity) != self.chosen.get(quantity)
        ]
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
                    for quantity in (
                        ["time"] if name == "time" else [f"{kind}{name}" for kind in kinds]
                    ):
                        with ui.element("td"):
                            self._add_cell(quantity)
        self._update_marks()

    def _add_common_unit_menu(self, kind: str) -> None:
        """One menu for the units of all joints."""
        every = [f"{kind}{joint.name}" for joint in self.joints]
        units = list(
            dict.fromkeys(
                unit for quantity in every for unit in select_units(quantity, self.joints)
            )
        )

        async def apply_unit(event: Any) -> None:
            chosen = dict(self.chosen)
            for quantity in (quantity for quantity in every if quantity in chosen):
                chosen[quantity] = self._convert_to_unit(quantity, chosen[quantity], event.value)
            await self.changed(chosen)

        menu = ui.select(units, label="all in", on_change=apply_unit).classes("mapping-all")
        menu.props("dense options-dense")

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
        names = [*self.columns][:_MOST]
        if one is not None and one.column not in names:
            names.insert(0, one.column)
        with cell:
            menu = ui.select(
                names, value=one and one.column, with_input=True, clearable=quantity != "time",
                on_change=lambda event: self._assign_column(quantity, event.value),
            )  # fmt: skip
            menu.props("dense options-dense").props["aria-label"] = f"column of {quantity}"
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
            self.chosen[quantity] = self._convert_to_unit(
                quantity, self.chosen[quantity], event.value
            )
            await self.changed(self.chosen)

        menu = ui.select(units, value=current_unit, with_input=True, new_value_mode="add-unique",
                         on_change=apply_unit)  # fmt: skip
        menu.props("dense options-dense hide-dropdown-icon").props["aria-label"] = (
            f"unit of {quantity}"
        )
        menu.classes("mapping-unit")

    async def _assign_column(self, quantity: str, column: str | None) -> None:
        chosen = dict(self.chosen)
        old = chosen.pop(quantity, None)
        if column:
            chosen[quantity] = (
                ColumnChoice(column) if old is None else dataclasses.replace(old, column=column)
            )
        await self.changed(chosen)

    async def _flip_sign(self, quantity: str, button: ui.button) -> None:
        one = self.chosen[quantity]
        self.chosen[quantity] = dataclasses.replace(one, sign=-one.sign)
        button.text = _SIGNS[-one.sign]
        await self.changed(self.chosen)
