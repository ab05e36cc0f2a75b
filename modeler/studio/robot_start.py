"""Where a robot comes from: a pasted table, a template, another program, the built-in ones."""

import dataclasses
from collections.abc import Awaitable, Callable
from pathlib import Path

from nicegui import background_tasks, ui

from modeler.core.builtin import CONVENTIONS, TEMPLATES, builtin_names, builtin_text
from modeler.core.errors import ModelerError
from modeler.robot import pasted_robot, pasted_table, with_pasted
from modeler.studio.chooser import choose
from modeler.studio.dropped import drop_zone
from modeler.studio.elements import part
from modeler.studio.studio import Studio
from modeler.studio.tasks import ROBOT, Task

Taken = Callable[[str, tuple[str, ...]], Awaitable[None]]
"""Is called with the text of a robot file, and notes on how it was made."""

_FILES = (".urdf", ".xml", ".mjcf", ".par", ".toml")
_AS_HEADED = "as its headings say"
_EXAMPLE = "i\t\u03b1 [deg]\ta [mm]\td [mm]\t\u03b8\n1\t0\t0\t333\tq1\n2\t-90\t0\t0\tq2"


def start(studio: Studio, before: str, taken: Taken) -> None:
    """The ways to a robot.

    Args:
        studio: the window.
        before: text of the robot that there is; "": none.
        taken: is called with the new one.
    """
    with ui.element("div").classes("studio-ways"):
        with part("Paste a table"):
            _pasted(studio, before, taken)
        with part("Begin with a template"):
            _template(studio, taken)
        with part("Open a file"):
            _file(studio, taken)
        with part("Take a built-in robot"):
            _builtin(taken)


def _pasted(studio: Studio, before: str, taken: Taken) -> None:
    area = ui.textarea(placeholder=_EXAMPLE).props("outlined dense rows=5 aria-label='table'")
    area.classes("w-full")
    ui.label(
        "From a spreadsheet or a paper, with headings or without; degrees and mm by their headings."
    ).classes("studio-soft")
    with ui.row().classes("items-center"):
        whose = ui.select(
            [_AS_HEADED, *CONVENTIONS], value=_AS_HEADED, label="whose table"
        ).classes("w-48")

        async def take() -> None:
            try:
                table = pasted_table(
                    str(area.value or ""), "" if whose.value == _AS_HEADED else str(whose.value)
                )
                if not table.headed and whose.value == _AS_HEADED:
                    raise ModelerError(
                        "the table has no headings, and books order their columns differently: "
                        "choose whose table it is, or paste the headings too"
                    )
                text = with_pasted(before, table) if before else pasted_robot(table, "robot")
            except ModelerError as error:
                studio.show_error(str(error))
                return
            notes = (f"taken as a table of convention {table.convention}", *table.notes)
            if table.symbols:
                notes += (f"written into [symbols]: {', '.join(table.symbols)}: give their values",)
            await taken(text, notes)

        ui.button("Take this table", on_click=take).props("no-caps unelevated")


def _template(studio: Studio, taken: Taken) -> None:
    with ui.row().classes("items-center"):
        kind = ui.select(list(TEMPLATES), value=TEMPLATES[0], label="kind").classes("w-40")
        joints = ui.input("joints", value="RRR").classes("w-32")
        joints.props("hint='R turns, P slides'").bind_visibility_from(kind, "value", value="serial")
        whose = ui.select(list(CONVENTIONS), value=CONVENTIONS[0], label="whose table")
        whose.classes("w-36").bind_visibility_from(kind, "value", value="serial")

    async def begin() -> None:
        task = Task("new", template=str(kind.value))
        if kind.value == "serial":
            task = dataclasses.replace(task, joints=str(joints.value), convention=str(whose.value))
        await _made(studio, task, taken)

    ui.button("Begin", on_click=begin).props("no-caps unelevated")


def _file(studio: Studio, taken: Taken) -> None:
    async def came(files: list[str]) -> None:
        file = files[0]
        if Path(file).suffix.lower() == ".toml":
            try:
                await taken(studio.text(file), ())
            except ModelerError as error:
                studio.show_error(str(error))
            return
        await _made(studio, Task("convert", file=file), taken)

    ui.label("URDF, MJCF, SYMORO's .par, or a robot file").classes("studio-soft")
    zone = drop_zone(
        "originals", "drop it here, or choose it",
        lambda files: background_tasks.create(came(files)), studio.show_error,
    )  # fmt: skip
    zone.props(remove="multiple").classes("w-full")
    ui.button(
        "Choose where it lies", icon="folder_open",
        on_click=lambda: choose(
            studio, _FILES, lambda files: background_tasks.create(came(files))
        ),
    ).props("no-caps outline")  # fmt: skip


def _builtin(taken: Taken) -> None:
    async def take() -> None:
        await taken(builtin_text(str(name.value)), ())

    with ui.row().classes("items-center"):
        name = ui.select(list(builtin_names()), value="puma560", label="robot", with_input=True)
        name.classes("w-56")
        ui.button("Take it", on_click=take).props("no-caps unelevated")


async def _made(studio: Studio, task: Task, taken: Taken) -> None:
    """A robot file that a command writes."""
    room = studio.room
    if await studio.run(task, keep=False) is not None and room is not None:
        with room:
            await taken(studio.text(ROBOT), ())
