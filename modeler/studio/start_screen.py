"""The empty page: three doors, a demonstration, a robot, a log."""

import dataclasses
from collections.abc import Callable

from nicegui import ui

from modeler.core.choices import read_builtin_robot
from modeler.core.errors import ModelerError
from modeler.core.files import write_atomically
from modeler.studio.project import ProjectLog
from modeler.studio.studio import Hub, Studio
from modeler.studio.tasks import ROBOT, Task, TimeRange

_RUNS = (("logs/train.parquet", 1), ("logs/held_out.parquet", 2))


async def draw(studio: Studio) -> None:
    """Draws it."""
    ui.label("Your robot's real dynamics").classes("studio-head")
    ui.label(
        "Compare a model with measurements, see where it fails, learn which physical effect is "
        "missing, add it, and watch the error fall."
    ).classes("studio-soft")
    with ui.row().classes("studio-doors"):
        _add_start_button(
            "Try the demo", "play_circle",
            "An arm with three joints, two measured runs, and an effect that its model lacks.",
            lambda: open_demo(studio),
        )  # fmt: skip
        _add_start_button(
            "Start from a table", "precision_manufacturing",
            "Paste the table of a paper, open a URDF, MJCF or .par, or take a built-in robot.",
            lambda: studio.open_screen("robot"),
        )  # fmt: skip
        _add_start_button(
            "Start from a log", "show_chart",
            "CSV, Parquet, MAT, HDF5, MCAP, ROS bags, sheets: see what is in it.",
            lambda: studio.open_screen("data"),
        )  # fmt: skip


def _add_start_button(title: str, icon: str, text: str, act: Callable[[], object]) -> None:
    with ui.button(on_click=act).props("flat no-caps").classes("studio-door"), ui.column():
        ui.icon(icon, size="2.5rem")
        ui.label(title).classes("studio-door-title")
        ui.label(text).classes("studio-soft")


async def open_demo(studio: Studio) -> None:
    """The demonstration; what is wrong is told in the window."""
    try:
        if studio.is_read_only:
            raise ModelerError(studio.read_only_reason)
        await begin_demo(studio.hub)
    except ModelerError as error:
        studio.show_error(str(error))
    else:
        if studio.screen == "start":  # nobody has gone elsewhere meanwhile
            studio.open_screen("data")


async def begin_demo(hub: Hub) -> None:
    """The demonstration arm, and two measured runs of a machine with a hidden effect.

    Raises:
        ModelerError: the folder has a robot already, or cannot be written.
    """
    if hub.project.robot:
        raise ModelerError(
            f"{hub.workspace.folder}: holds a robot already; open the demonstration in a folder of "
            "its own: modeler studio FOLDER --demo"
        )
    write_atomically(hub.workspace.folder / ROBOT, read_builtin_robot("demo-arm"))
    for log, seed in _RUNS:
        await hub.run(Task("simulate", file=log, seed=seed))
    train, held_out_file = (log for log, _ in _RUNS)
    logs = ProjectLog(train, train=(TimeRange(),)), ProjectLog(held_out_file, test=(TimeRange(),))
    hub.workspace.save(dataclasses.replace(hub.project, robot=ROBOT, logs=logs))
    hub.refresh()
