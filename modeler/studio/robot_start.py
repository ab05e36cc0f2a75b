"""Where a robot comes from: a pasted table, a template, another program, the built-in ones."""

import dataclasses
from collections.abc import Awaitable, Callable
from pathlib import Path

from nicegui import background_tasks, ui

from modeler.core.choices import CONVENTIONS, TEMPLATES, list_builtin_robots, read_builtin_robot
from modeler.core.errors import ModelerError
from modeler.robot import build_pasted_robot, insert_pasted_table, parse_pasted_table
from modeler.studio.chooser import choose_files
from modeler.studio.dropped import add_drop_zone
from modeler.studio.elements import add_card
from modeler.studio.studio import Studio
from modeler.studio.tasks import ROBOT, Task

Taken = Callable[[str, tuple[str, ...]], Awaitable[None]]
"""Is called with the text of a robot file, and notes on how it was made."""

_FILES = (".urdf", ".xml", ".mjcf", ".par", ".toml")
_AS_HEADED = "as its headings say"
_EXAMPLE = "i\t\u03b1 [deg]\ta [mm]\td [mm]\t\u03b8\n1\t0\t0\t333\tq1\n2\t-90\t0\t0\tq2"


def draw_choices(studio: Studio, before: str, on_taken: Taken) -> None:
    """The ways to a robot.

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
    ui.label(
        "From a spreadsheet or a paper, with headings or without; degrees and mm by their headings."
    ).classes("studio-soft")
    with ui.row().classes("items-center"):
        whose = ui.select(
            [_AS_HEADED, *CONVENTIONS], value=_AS_HEADED, label="whose table"
        ).classes("w-48")

        async def take_table() -> None:
            try:
                table = parse_pasted_table(
                    str(area.value or ""), "" if whose.value == _AS_HEADED else str(whose.value)
                )
                if not table.has_headings and whose.value == _AS_HEADED:
                    raise ModelerError(
                        "the table has no headings, and books order their columns differently: "
                        "choose whose table it is, or paste the headings too"
                    )
                text = (
                    insert_pasted_table(before, table)
                    if before
                    else build_pasted_robot(table, "robot")
                )
            except ModelerError as error:
                studio.show_error(str(error))
                return
            notes = (f"taken as a table of convention {table.convention}", *table.notes)
            if table.symbols:
                notes += (f"written into [symbols]: {', '.join(table.symbols)}: give their values",)
            await on_taken(text, notes)

        ui.button("Take this table", on_click=take_table).props("no-caps unelevated")


def _draw_template(studio: Studio, on_taken: Taken) -> None:
    with ui.row().classes("items-center"):
        kind = ui.select(list(TEMPLATES), value=TEMPLATES[0], label="kind").classes("w-40")
        joints = ui.input("joints", value="RRR").classes("w-32")
        joints.props("hint='R turns, P slides'").bind_visibility_from(kind, "value", value="serial")
        whose = ui.select(list(CONVENTIONS), value=CONVENTIONS[0], label="whose table")
        whose.classes("w-36").bind_visibility_from(kind, "value", value="serial")

    async def create_robot() -> None:
        task = Task("new", template=str(kind.value))
        if kind.value == "serial":
            task = dataclasses.replace(task, joints=str(joints.value), convention=str(whose.value))
        await _take_command_robot(studio, task, on_taken)

    ui.button("Begin", on_click=create_robot).props("no-caps unelevated")


def _draw_file(studio: Studio, on_taken: Taken) -> None:
    async def open_file(files: list[str]) -> None:
        file = files[0]
        if Path(file).suffix.lower() == ".toml":
            try:
                await on_taken(studio.read_text(file), ())
            except ModelerError as error:
                studio.show_error(str(error))
            return
        await _take_command_robot(studio, Task("convert", file=file), on_taken)

    ui.label("URDF, MJCF, SYMORO's .par, or a robot file").classes("studio-soft")
    zone = add_drop_zone(
        "originals", "drop it here, or choose it",
        lambda files: background_tasks.create(open_file(files)), studio.show_error,
    )  # fmt: skip
    zone.props(remove="multiple").classes("w-full")
    ui.button(
        "Choose where it lies", icon="folder_open",
        on_click=lambda: choose_files(
            studio, _FILES, lambda files: background_tasks.create(open_file(files))
        ),
    ).props("no-caps outline")  # fmt: skip


def _draw_builtin(on_taken: Taken) -> None:
    async def take_builtin() -> None:
        await on_taken(read_builtin_robot(str(name.value)), ())

    with ui.row().classes("items-center"):
        name = ui.select(
            list(list_builtin_robots()), value="puma560", label="robot", with_input=True
        )
        name.classes("w-56")
        ui.button("Take it", on_click=take_builtin).props("no-caps unelevated")


async def _take_command_robot(studio: Studio, task: Task, on_taken: Taken) -> None:
    """A robot file that a command writes."""
    room = studio.room
    if await studio.run(task, keep=False) is not None and room is not None:
        with room:
            await on_taken(studio.read_text(ROBOT), ())
