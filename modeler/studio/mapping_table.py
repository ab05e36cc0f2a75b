"""The table in which columns of a log become ours: by menu, by dragging, with unit and sign."""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from nicegui import ui

from modeler.core.manifest import JointSpec
from modeler.studio.log_mapping import KINDS, Choice, kind_of, units_of

_MOST = 400  # columns that a menu lists; others are typed
_AS_STATED = "as the file says"


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
        ranged: Sequence[str], changed: Callable[[Mapping[str, Choice]], Any],
    ) -> None:  # fmt: skip
        self.joints, self.columns, self.chosen = joints, columns, dict(chosen)
        self.ranged, self.changed = ranged, changed
        self._dragged = ""
        there = {kind_of(own, joints)[0] for own in chosen}
        self._wide = ui.checkbox("all quantities").props("dense")
        effort = ("tau", "current", "duty")
        driven = [kind for kind in effort if kind in there][:1] or ["tau"]
        shown = [kind for kind in KINDS if kind in ("q", "qd", *driven)]
        self._place = ui.element("div").classes("mapping-scroll")
        self._wide.on_value_change(lambda: self._table([*KINDS] if self._wide.value else shown))
        self._table(shown)
        self._chips()

    def _table(self, kinds: Sequence[str]) -> None:
        self._place.clear()
        with self._place, ui.element("table").classes("studio-table mapping"):
            with ui.element("tr"):
                self._th("")
                for kind in kinds:
                    self._th(KINDS[kind])
            with ui.element("tr"):
                self._th("time")
                with ui.element("td"):
                    self._cell("time")
                if self.joints:
                    for kind in kinds[1:]:
                        with ui.element("td"):
                            self._unit_of_all(kind)
            for joint in self.joints:
                with ui.element("tr"):
                    self._th(f"joint {joint.name}")
                    for kind in kinds:
                        with ui.element("td"):
                            self._cell(f"{kind}{joint.name}")

    @staticmethod
    def _th(text: str) -> None:
        with ui.element("th"):
            ui.label(text)

    def _unit_of_all(self, kind: str) -> None:
        """One menu for the units of all joints."""
        every = [f"{kind}{joint.name}" for joint in self.joints]
        units = list(dict.fromkeys(unit for own in every for unit in units_of(own, self.joints)))

        def take(event: Any) -> None:
            for own in every:
                if own in self.chosen and event.value in units_of(own, self.joints):
                    self.chosen[own] = dataclasses.replace(self.chosen[own], unit=event.value)
            self.changed(self.chosen)

        menu = ui.select(units, label="all in", on_change=take).props("dense options-dense")
        menu.classes("mapping-all").mark(f"all-{kind}")

    def _cell(self, own: str) -> None:
        """The column, its unit and its sign; a column can be dropped here."""
        one = self.chosen.get(own)
        guessed = " mapping-guess" if own in self.ranged else ""
        with ui.element("div").classes(f"mapping-cell{guessed}") as cell:
            names = [*self.columns][:_MOST]
            if one is not None and one.column not in names:
                names.insert(0, one.column)
            menu = ui.select(
                names, value=one and one.column, with_input=True, clearable=own != "time",
                on_change=lambda event: self._take(own, event.value),
            )  # fmt: skip
            menu.props(f'dense options-dense aria-label="column of {own}"').classes(
                "mapping-column"
            )
            menu.mark(f"column-{own}")
            if one is not None and one.column not in self.columns:
                menu.props("error").tooltip("this log has no such column")
            if one is not None:
                self._unit(own, one)
                sign = ui.button(
                    "+" if one.sign > 0 else "\u2212", on_click=lambda: self._turn(own)
                )
                sign.props(f'dense flat aria-label="sign of {own}"').mark(f"sign-{own}")
            if guessed:
                cell.tooltip("a guess by its range alone: check it")
        cell.on("dragover", js_handler="(event) => event.preventDefault()")
        cell.on(
            "drop",
            lambda: self._take(own, self._dragged),
            js_handler="(event) => { event.preventDefault(); emit(); }",
        )
        cell.props(f'data-own="{own}"')

    def _unit(self, own: str, one: Choice) -> None:
        units = list(units_of(own, self.joints))
        stated = self.columns.get(one.column, "")
        shown = one.unit or stated or units[0]
        if shown not in units:
            units.append(shown)

        def take(event: Any) -> None:
            self.chosen[own] = dataclasses.replace(self.chosen[own], unit=event.value or "")
            self.changed(self.chosen)

        menu = ui.select(units, value=shown, with_input=True, new_value_mode="add-unique",
                         on_change=take)  # fmt: skip
        menu.props(f'dense options-dense hide-dropdown-icon aria-label="unit of {own}"')
        menu.classes("mapping-unit").mark(f"unit-{own}")
        if stated and not one.unit:
            menu.tooltip(_AS_STATED)

    def _take(self, own: str, column: str | None) -> None:
        if not column:
            self.chosen.pop(own, None)
        else:
            old = self.chosen.get(own)
            self.chosen[own] = (
                Choice(column) if old is None else dataclasses.replace(old, column=column)
            )
        self.changed(self.chosen)

    def _turn(self, own: str) -> None:
        one = self.chosen[own]
        self.chosen[own] = dataclasses.replace(one, sign=-one.sign)
        self.changed(self.chosen)

    def _chips(self) -> None:
        """Columns of the file; what is taken already is faint."""
        taken = {one.column for one in self.chosen.values()}
        with ui.element("div").classes("mapping-chips"):
            for name, unit in [*self.columns.items()][:_MOST]:
                chip = ui.label(f"{name} [{unit}]" if unit else name).classes("mapping-chip")
                chip.props("draggable=true").classes("mapping-taken" if name in taken else "")
                chip.on("dragstart", lambda _, name=name: setattr(self, "_dragged", name), args=[])
