"""The screen "take away": C, files, pages, the steps as script and notebook; the disk they use."""

import re
from collections.abc import Callable
from pathlib import Path

from nicegui import ui

from modeler.core.errors import ModelerError
from modeler.robot import replace_fitted_values
from modeler.studio import elements, recipe
from modeler.studio.places import compute_disk_use, find_unused_files, format_size
from modeler.studio.studio import Studio
from modeler.studio.tasks import Task

_FORMATS = {"urdf": "URDF", "mjcf": "MJCF (MuJoCo)", "sdf": "SDF (Gazebo)"}
_LIKE = (".urdf", ".xml", ".mjcf", ".sdf")


async def draw(studio: Studio) -> None:
    """Draws it."""
    project = studio.project
    elements.draw_head(
        "Take away", "Everything leaves as files; the script and the notebook do it all again."
    )
    if not project.model_file:
        elements.explain_missing_model(studio)
    else:
        name = re.sub(r"[^\w.-]", "_", str(studio.read_model(studio.model_step)["robot"]))
        _draw_exports(studio, name)
        _draw_files(studio, name)
        _draw_recipe(studio)
    _draw_disk(studio)


def _add_download_button(
    studio: Studio, title: str, name: str, content: Callable[[], Path | bytes]
) -> None:
    """A button that downloads what is made when it is pressed."""

    def download_content() -> None:
        try:
            ui.download.from_url(studio.hub.register_download(content(), name), name)
        except ModelerError as error:
            studio.show_error(str(error))

    ui.button(title, on_click=download_content).props("no-caps outline icon=download")


def _draw_exports(studio: Studio, name: str) -> None:
    """C and files for simulators, which commands write."""
    chosen = studio.state.setdefault("take", {"precision": "double", "to": "urdf", "like": ""})
    files = sorted(file.name for file in studio.folder.iterdir() if file.suffix in _LIKE)
    kinds = {"": "a file of its own", **{name: name for name in files}}
    with elements.add_card("C for the controller"):
        precision = ui.toggle(["double", "single"]).bind_value(chosen, "precision")
        renew = elements.add_run_button(
            studio, "Write C", lambda: Task("generate", precision=chosen["precision"])
        )
        precision.props("no-caps").on_value_change(renew)
        _add_output_download(studio, "generate", f"{name}_c")
    with elements.add_card("For simulators and planners"):
        with ui.row().classes("items-end"):
            to = ui.select(_FORMATS, label="format").bind_value(chosen, "to").classes("w-48")
            like = ui.select(kinds, label="into the bytes of").bind_value(chosen, "like")
        renew = elements.add_run_button(
            studio,
            "Export",
            lambda: Task("export", to="" if chosen["like"] else chosen["to"], like=chosen["like"]),
        )
        to.on_value_change(renew)
        like.classes("w-64").on_value_change(renew)
        _add_output_download(studio, "export", name)


def _add_output_download(studio: Studio, verb: str, name: str) -> None:
    """What the last command of that verb wrote of this model, to be downloaded."""
    step = studio.project.find_step_about(verb)
    if step is not None:
        place, name = studio.folder / step.output, name + Path(step.output).suffix
        with ui.row().classes("items-center no-wrap w-full"):
            title = f"Download {name}{'.zip' if place.is_dir() else ''}"
            _add_download_button(studio, title, name, lambda: place)
            elements.draw_step_line(studio, step)


def _draw_files(studio: Studio, name: str) -> None:
    """Model, robot, page."""
    place = studio.folder / studio.model_step.model_file
    with elements.add_card("Files of this model"):
        ui.label(
            "The model is one file that holds all that other commands need. The robot file has the "
            "effects that were added; values stand in it where the estimator ends in them."
        ).classes("studio-soft")
        with ui.row():
            _add_download_button(studio, "Model", f"{name}.model.json", lambda: place)
            _add_download_button(
                studio, "Robot file", f"{name}.toml", lambda: _fill_robot_file(studio)
            )
        elements.add_page_button(studio, studio.model_step)


def _fill_robot_file(studio: Studio) -> bytes:
    model = studio.read_model(studio.model_step)
    return replace_fitted_values(model["robot_text"], model["fit"]["standard"]).encode()


def _draw_recipe(studio: Studio) -> None:
    """The steps as a script and as a notebook."""

    def collect_recipe() -> recipe.Recipe:
        copies = {step.robot_copy for step in studio.project.steps} - {""}
        robots = {
            name: studio.read_text(name) for name in copies if (studio.folder / name).is_file()
        }
        return recipe.build_recipe(studio.project, studio.folder, robots)

    with elements.add_card("All of it again"):
        ui.label(
            "Both make the same values in an empty folder, and name the same effects. The logs are "
            "read where they lie."
        ).classes("studio-soft")
        with ui.row():
            _add_download_button(
                studio,
                "Shell script",
                "steps.sh",
                lambda: recipe.format_script(collect_recipe()).encode(),
            )
            _add_download_button(
                studio,
                "Notebook",
                "steps.ipynb",
                lambda: recipe.format_notebook(collect_recipe()).encode(),
            )
        for step in collect_recipe().steps:
            elements.draw_step_line(studio, step)


def _draw_disk(studio: Studio) -> None:
    """What the project uses, and what of it nobody needs."""
    with elements.add_card("Disk"):
        used = compute_disk_use(studio.folder)
        rows = [(kind, format_size(size)) for kind, size in used.items() if size]
        elements.draw_table(("of", "uses"), [*rows, ("all", format_size(sum(used.values())))])
        left = find_unused_files(studio.folder, studio.project)
        if not left.files:
            return
        gone = len(studio.project.steps) - len(left.project.steps)

        def remove_unused() -> None:
            if studio.change_project(steps=left.project.steps):
                left.remove(studio.folder)
                studio.redraw()

        with ui.row().classes("items-center"):
            button = ui.button(f"Tidy: {format_size(left.size)}", on_click=remove_unused)
            elements.disable_while_busy(studio, button.props("no-caps outline icon=delete_sweep"))
            ui.label(
                f"takes away {len(left.files)} files of {gone} steps that were set aside; logs, "
                "pages and the way to the current model stay"
            ).classes("studio-soft")
