"""The screen "take away": C, files, pages, the steps as script and notebook; the disk they use."""

import re
from collections.abc import Callable
from pathlib import Path

from nicegui import ui

from modeler.core.errors import ModelerError
from modeler.robot import with_fitted
from modeler.studio import elements, recipe
from modeler.studio.places import disk_use, size_text, spare
from modeler.studio.studio import Studio
from modeler.studio.tasks import Task

_FORMATS = {"urdf": "URDF", "mjcf": "MJCF (MuJoCo)", "sdf": "SDF (Gazebo)"}
_LIKE = (".urdf", ".xml", ".mjcf", ".sdf")


async def draw(studio: Studio) -> None:
    """Draws it."""
    project = studio.project
    elements.head(
        "Take away", "Everything leaves as files; the script and the notebook do it all again."
    )
    if not project.model:
        elements.lacks_model(studio)
    else:
        name = re.sub(r"[^\w.-]", "_", str(studio.model(studio.made)["robot"]))
        _commanded(studio, name)
        _files(studio, name)
        _again(studio)
    _disk(studio)


def _download(studio: Studio, title: str, name: str, content: Callable[[], Path | bytes]) -> None:
    """A button that downloads what is made when it is pressed."""

    def pressed() -> None:
        try:
            ui.download.from_url(studio.hub.download(content(), name), name)
        except ModelerError as error:
            studio.show_error(str(error))

    ui.button(title, on_click=pressed).props("no-caps outline icon=download")


def _commanded(studio: Studio, name: str) -> None:
    """C and files for simulators, which commands write."""
    chosen = studio.kept.setdefault("take", {"precision": "double", "to": "urdf", "like": ""})
    files = sorted(file.name for file in studio.folder.iterdir() if file.suffix in _LIKE)
    kinds = {"": "a file of its own", **{name: name for name in files}}
    with elements.part("C for the controller"):
        precision = ui.toggle(["double", "single"]).bind_value(chosen, "precision")
        renew = elements.run_button(
            studio, "Write C", lambda: Task("generate", precision=chosen["precision"])
        )
        precision.props("no-caps").on_value_change(renew)
        _written(studio, "generate", f"{name}_c")
    with elements.part("For simulators and planners"):
        with ui.row().classes("items-end"):
            to = ui.select(_FORMATS, label="format").bind_value(chosen, "to").classes("w-48")
            like = ui.select(kinds, label="into the bytes of").bind_value(chosen, "like")
        renew = elements.run_button(
            studio,
            "Export",
            lambda: Task("export", to="" if chosen["like"] else chosen["to"], like=chosen["like"]),
        )
        to.on_value_change(renew)
        like.classes("w-64").on_value_change(renew)
        _written(studio, "export", name)


def _written(studio: Studio, verb: str, name: str) -> None:
    """What the last command of that verb wrote of this model, to be downloaded."""
    step = studio.project.about(verb)
    if step is not None:
        place, name = studio.folder / step.output, name + Path(step.output).suffix
        with ui.row().classes("items-center no-wrap w-full"):
            title = f"Download {name}{'.zip' if place.is_dir() else ''}"
            _download(studio, title, name, lambda: place)
            elements.step_line(studio, step)


def _files(studio: Studio, name: str) -> None:
    """Model, robot, page."""
    place = studio.folder / studio.made.model
    with elements.part("Files of this model"):
        ui.label(
            "The model is one file that holds all that other commands need. The robot file has the "
            "effects that were added; values stand in it where the estimator ends in them."
        ).classes("studio-soft")
        with ui.row():
            _download(studio, "Model", f"{name}.model.json", lambda: place)
            _download(studio, "Robot file", f"{name}.toml", lambda: _robot(studio))
        elements.page_button(studio, studio.made)


def _robot(studio: Studio) -> bytes:
    model = studio.model(studio.made)
    return with_fitted(model["robot_text"], model["fit"]["standard"]).encode()


def _again(studio: Studio) -> None:
    """The steps as a script and as a notebook."""

    def own() -> recipe.Recipe:
        copies = {step.robot for step in studio.project.steps} - {""}
        robots = {name: studio.text(name) for name in copies if (studio.folder / name).is_file()}
        return recipe.recipe(studio.project, studio.folder, robots)

    with elements.part("All of it again"):
        ui.label(
            "Both make the same values in an empty folder, and name the same effects. The logs are "
            "read where they lie."
        ).classes("studio-soft")
        with ui.row():
            _download(studio, "Shell script", "steps.sh", lambda: recipe.script(own()).encode())
            _download(studio, "Notebook", "steps.ipynb", lambda: recipe.notebook(own()).encode())
        for step in own().steps:
            elements.step_line(studio, step)


def _disk(studio: Studio) -> None:
    """What the project uses, and what of it nobody needs."""
    with elements.part("Disk"):
        used = disk_use(studio.folder)
        rows = [(kind, size_text(size)) for kind, size in used.items() if size]
        elements.table(("of", "uses"), [*rows, ("all", size_text(sum(used.values())))])
        left = spare(studio.folder, studio.project)
        if not left.files:
            return
        gone = len(studio.project.steps) - len(left.project.steps)

        def tidied() -> None:
            if studio.change(steps=left.project.steps):
                left.remove(studio.folder)
                studio.redraw()

        with ui.row().classes("items-center"):
            button = ui.button(f"Tidy: {size_text(left.size)}", on_click=tidied)
            elements.busy_with(studio, button.props("no-caps outline icon=delete_sweep"))
            ui.label(
                f"takes away {len(left.files)} files of {gone} steps that were set aside; logs, "
                "pages and the way to the current model stay"
            ).classes("studio-soft")
