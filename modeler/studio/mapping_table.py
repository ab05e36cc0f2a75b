"""The table in which columns of a log become ours: by menu, by dragging, with unit and sign."""

import dataclasses
from collections.abc import Awaitable, Callable, Mapping, Sequence
from typing import Any

from nicegui import ui
from nicegui.element import Element

from modeler.core.manifest import JointSpec
from modeler.studio.log_mapping import KINDS, Choice, kind_of, units_of

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
        self, joints: Sequence[JointSpec], columns: Mapping[str, str], chosen: Mapping[str, Choice],
        ranged: Sequence[str], changed: Callable[[Mapping[str, Choice]], Awaitable[None]],
    ) -> None:  # fmt: skip
        self.joints, self.columns, self.chosen = joints, columns, dict(chosen)
        self.ranged, self.changed = ranged, changed
        self._dragged = ""
        self._cells: dict[str, Element] = {}
        self._chips: dict[str, Element] = {}
        there = {kind_of(own, joints)[0] for own in chosen}
        driven = [kind for kind in ("tau", "current", "duty") if kind in there][:1] or ["tau"]
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
        self._mark()

    def renew(
        self, chosen: Mapping[str, Choice], ranged: Sequence[str], anew: bool = False
    ) -> None:
        """Shows other choices; cells that show them already stay as they are, unless `anew`."""
        changed = [own for own in self._cells if anew or chosen.get(own) != self.chosen.get(own)]
        self.chosen, self.ranged = dict(chosen), ranged
        for own in changed:
            self._fill(own)
        self._mark()

    def _mark(self) -> None:
        """What is a guess, and which columns are taken."""
        taken = {one.column for one in self.chosen.values()}
        for own, cell in self._cells.items():
            cell.classes(**{"add" if own in self.ranged else "remove": "mapping-guess"})
        for name, chip in self._chips.items():
            chip.classes(**{"add" if name in taken else "remove": "mapping-taken"})

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
                            self._unit_of_all(kind)
            for name in ("time", *(joint.name for joint in self.joints)):
                with ui.element("tr"):
                    with ui.element("th"):
                        ui.label(name if name == "time" else f"joint {name}")
                    for own in ["time"] if name == "time" else [f"{kind}{name}" for kind in kinds]:
                        with ui.element("td"):
                            self._cell(own)
        self._mark()

    def _unit_of_all(self, kind: str) -> None:
        """One menu for the units of all joints."""
        every = [f"{kind}{joint.name}" for joint in self.joints]
        units = list(dict.fromkeys(unit for own in every for unit in units_of(own, self.joints)))

        async def take(event: Any) -> None:
            chosen = dict(self.chosen)
            for own in (own for own in every if own in chosen):
                chosen[own] = self._in_unit(own, chosen[own], event.value)
            await self.changed(chosen)

        menu = ui.select(units, label="all in", on_change=take).classes("mapping-all")
        menu.props("dense options-dense")

    def _cell(self, own: str) -> None:
        """Where one of ours is said; a column can be dropped here."""
        self._cells[own] = cell = ui.element("div").classes("mapping-cell")
        cell.props["data-own"] = own
        cell.on("dragover", js_handler="(event) => event.preventDefault()")
        let = "(event) => { event.preventDefault(); emit(); }"
        cell.on("drop", lambda: self._take(own, self._dragged), js_handler=let)
        self._fill(own)

    def _fill(self, own: str) -> None:
        """The column, its unit and its sign."""
        one, cell = self.chosen.get(own), self._cells[own]
        cell.clear()
        names = [*self.columns][:_MOST]
        if one is not None and one.column not in names:
            names.insert(0, one.column)
        with cell:
            menu = ui.select(
                names, value=one and one.column, with_input=True, clearable=own != "time",
                on_change=lambda event: self._take(own, event.value),
            )  # fmt: skip
            menu.props("dense options-dense").props["aria-label"] = f"column of {own}"
            menu.classes("mapping-column")
            if one is None:
                return
            if one.column not in self.columns:
                menu.props("error").tooltip("this log has no such column")
            self._unit(own, one)
            if own != "time":
                sign = ui.button(_SIGNS[one.sign]).props("dense flat")
                sign.props["aria-label"] = f"sign of {own}"
                sign.on_click(lambda: self._turn(own, sign))

    def _in_unit(self, own: str, one: Choice, unit: str | None) -> Choice:
        """The same column in another unit; SI need not be said where the file says nothing."""
        plain = unit == units_of(own, self.joints)[0] and not self.columns.get(one.column)
        return dataclasses.replace(one, unit="" if plain else unit or "")

    def _unit(self, own: str, one: Choice) -> None:
        units = list(units_of(own, self.joints))
        shown = one.unit or self.columns.get(one.column) or units[0]
        if shown not in units:
            units.append(shown)

        async def take(event: Any) -> None:
            self.chosen[own] = self._in_unit(own, self.chosen[own], event.value)
            await self.changed(self.chosen)

        menu = ui.select(units, value=shown, with_input=True, new_value_mode="add-unique",
                         on_change=take)  # fmt: skip
        menu.props("dense options-dense hide-dropdown-icon").props["aria-label"] = f"unit of {own}"
        menu.classes("mapping-unit")

    async def _take(self, own: str, column: str | None) -> None:
        chosen = dict(self.chosen)
        old = chosen.pop(own, None)
        if column:
            chosen[own] = Choice(column) if old is None else dataclasses.replace(old, column=column)
        await self.changed(chosen)

    async def _turn(self, own: str, button: ui.button) -> None:
        one = self.chosen[own]
        self.chosen[own] = dataclasses.replace(one, sign=-one.sign)
        button.text = _SIGNS[-one.sign]
        await self.changed(self.chosen)
