"""The screen of exports: C, files, pages, the steps as a script and a notebook, disk use."""

import json
import re
import shlex
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from nicegui import ui

from modeler.api.front_end import replace_fitted_values
from modeler.studio import elements
from modeler.studio.elements import add_button, draw_note
from modeler.studio.places import compute_disk_use, find_unused_files, format_size
from modeler.studio.project import Project
from modeler.studio.studio import Studio
from modeler.studio.tasks import FIT_OPTIONS, FIXED, LogPart, Step, Task, build_command_line

_ABOUT = ("compare", "diagnose")
"""Verbs that say something about a model, and are reported again."""


@dataclass(frozen=True)
class Recipe:
    """The steps that lead to the current model, and what they need.

    Attributes:
        folder: of the project, where its logs lie.
        steps: in their order.
        robots: text by file.
        logs: files that lie in the folder, and are made by no step.
    """

    folder: Path
    steps: tuple[Step, ...]
    robots: Mapping[str, str]
    logs: frozenset[str]

    def has_log(self, word: str) -> bool:
        """Returns True if a word names a log, or a range of it, in the folder."""
        return word.partition("@")[0] in self.logs


def build_recipe(project: Project, folder: Path, robots: Mapping[str, str]) -> Recipe:
    """Builds the recipe of the current model.

    Args:
        project: with one.
        folder: of it.
        robots: text of the robot as it was in each step, by file.
    """
    model_path = project.collect_path()
    numbers = {step.number for step in model_path}
    about = [project.find_step_about(verb, number) for verb in _ABOUT for number in sorted(numbers)]
    used = {part.file for step in model_path for part in (*step.task.logs, *step.task.held)}
    simulations = [s for s in project.steps if s.verb == "simulate" and s.output in used]
    steps = [*simulations, *model_path, *(step for step in about if step is not None)]
    logs = frozenset(file for file in used if file.startswith("logs/"))
    logs |= {log.file for log in project.logs if not Path(log.file).is_absolute()}
    robot_files = sorted({step.robot_copy for step in steps} & {*robots})
    steps.sort(key=lambda step: step.number)
    texts = {name: robots[name] for name in robot_files}
    return Recipe(folder, tuple(steps), texts, logs - {step.output for step in simulations})


# As a shell script.


_HEAD = """\
#!/bin/sh
# The steps of a project of `modeler studio`, with the robot as it was in each.
# Run it in an empty folder; LOGS is the folder of the project, MODELER what starts modeler.
set -eu
LOGS=${LOGS:-%s}
MODELER=${MODELER:-modeler}
mkdir -p robots models results logs
"""


def format_script(recipe: Recipe) -> str:
    """Formats the recipe as a shell script."""
    lines = [_HEAD % shlex.quote(str(recipe.folder))]
    for name, text in recipe.robots.items():
        end = "END_OF_ROBOT"
        while end in text.splitlines():
            end += "_"
        lines.append(f"cat > {shlex.quote(name)} <<'{end}'\n{text.rstrip()}\n{end}\n")
    for step in recipe.steps:
        words = " ".join(_quote_word(recipe, word) for word in build_command_line(step))
        lines.append(f"# {step.number}: {step.task.title}")
        lines.append(f"$MODELER {words} --json {step.result_file}\n")
    return "\n".join(lines)


def _quote_word(recipe: Recipe, word: str) -> str:
    if recipe.has_log(word):
        return f'"$LOGS"/{shlex.quote(word)}'
    return shlex.quote(word)


# As a notebook.


def format_notebook(recipe: Recipe) -> str:
    """Formats the recipe as a notebook with the Python interface."""
    head = "Run it in an empty folder; `LOGS` is the folder of the project."
    cells = [
        _build_cell("markdown", f"# The steps of a project of `modeler studio`\n\n{head}"),
        _build_cell("code", "\n".join(_format_preparation(recipe))),
    ]
    for step in recipe.steps:
        cells.append(_build_cell("markdown", f"{step.number}. {step.task.title}"))
        cells.append(_build_cell("code", "\n".join(_format_code(recipe, step))))
    for k, cell in enumerate(cells):
        cell["id"] = f"step-{k}"
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    book = {"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(book, indent=1) + "\n"


def _build_cell(kind: str, text: str) -> dict[str, Any]:
    cell: dict[str, Any] = {"cell_type": kind, "metadata": {}, "source": text.splitlines(True)}
    return cell | ({"outputs": [], "execution_count": None} if kind == "code" else {})


def _format_preparation(recipe: Recipe) -> Iterator[str]:
    yield "import dataclasses"
    yield "from pathlib import Path"
    yield ""
    yield "import modeler"
    yield ""
    yield f"LOGS = {str(recipe.folder)!r}"
    yield 'for name in ("robots", "models", "logs"):'
    yield "    Path(name).mkdir(exist_ok=True)"
    for name, text in recipe.robots.items():
        raw = "'''" not in text and not text.endswith(("'", "\\"))
        quoted = f"r'''{text}'''" if raw else repr(text)
        yield f"Path({name!r}).write_text({quoted}, encoding='utf-8')"


def _format_log(recipe: Recipe, word: str) -> str:
    """A log as Python names it."""
    if recipe.has_log(word):
        return f"LOGS + {chr(47) + word!r}"
    return repr(word)


def _format_logs(recipe: Recipe, parts: Sequence[LogPart]) -> str:
    return f"[{', '.join(_format_log(recipe, part.command_word) for part in parts)}]"


def _format_code(recipe: Recipe, step: Step) -> Iterator[str]:
    task, logs = step.task, _format_logs(recipe, step.task.logs)
    model_name, before = f"model_{step.number}", f"model_{step.parent}"
    held_out_logs = _format_logs(recipe, task.held)
    mapped = f", mapping={[*task.mapping]!r}" if task.mapping else ""
    if step.verb == "simulate":
        yield f"robot = modeler.open_robot({step.robot_copy!r})"
        yield f"modeler.simulate(robot, {task.file!r}, {_format_settings(task)})"
    elif step.verb == "fit":
        yield f"robot = modeler.open_robot({step.robot_copy!r})"
        stated = {option.name: getattr(task, option.name) for option in FIT_OPTIONS}
        stated = {name: value for name, value in stated.items() if value not in ("", None)}
        if stated:
            yield f"robot = dataclasses.replace(robot, fit={{**robot.fit, **{stated!r}}})"
        effects = f", effects={','.join(task.effects)!r}" if task.effects else ""
        yield f"{model_name} = modeler.identify(robot, {logs}{mapped}{effects})"
    elif step.verb == "add":
        where = f"joint={task.joint or None!r}, logs={logs}, held_out={held_out_logs}"
        yield f"{model_name} = {before}.add({task.effect!r}, {where}{mapped})"
    elif step.verb == "diagnose":
        bans = f"logs={logs}, without={[*task.without]!r}"
        yield f"{before}.missing(held_out={held_out_logs}, {bans}{mapped})"
    else:
        yield f"{before}.compare({logs}{mapped})"
    if step.model_file:
        yield f"modeler.save({model_name}, {step.model_file!r})"
        yield model_name


def _format_settings(task: Task) -> str:
    fixed = dict(zip(FIXED["simulate"][::2], FIXED["simulate"][1::2], strict=True))
    numbers = f"duration={fixed['--duration']}, seed={task.seed}, torque_noise={fixed['--noise']}"
    return f"hide={[fixed['--hide']]!r}, {numbers}"


_FORMATS = {"urdf": "URDF", "mjcf": "MJCF (MuJoCo)", "sdf": "SDF (Gazebo)"}
_LIKE = (".urdf", ".xml", ".mjcf", ".sdf")


async def draw(studio: Studio) -> None:
    """Draws the screen of the exports."""
    project = studio.project
    elements.draw_head(
        "Export", "Everything leaves as files; the script and the notebook do it all again."
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
        with studio.show_errors():
            ui.download.from_url(studio.hub.register_download(content(), name), name)

    add_button(title, download_content, "outline icon=download")


def _draw_exports(studio: Studio, name: str) -> None:
    """C and files for simulators, which commands write."""
    chosen = studio.state.setdefault("take", {"precision": "double", "to": "urdf", "like": ""})
    files = sorted(file.name for file in studio.folder.iterdir() if file.suffix in _LIKE)
    kinds = {"": "none", **{name: name for name in files}}
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
            like = ui.select(kinds, label="Template file").bind_value(chosen, "like")
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
        draw_note(
            "The model is one file that holds all that other commands need. The robot file has the "
            "effects that were added; values stand in it where the estimator ends in them."
        )
        with ui.row():
            fill = partial(_fill_robot_file, studio)
            _add_download_button(studio, "Model", f"{name}.model.json", lambda: place)
            _add_download_button(studio, "Robot file", f"{name}.toml", fill)
        elements.add_page_button(studio, studio.model_step)


def _fill_robot_file(studio: Studio) -> bytes:
    model = studio.read_model(studio.model_step)
    return replace_fitted_values(model["robot_text"], model["fit"]["standard"]).encode()


def _draw_recipe(studio: Studio) -> None:
    """The steps as a script and as a notebook."""

    def collect_recipe() -> Recipe:
        copies = {step.robot_copy for step in studio.project.steps} - {""}
        there = (name for name in copies if (studio.folder / name).is_file())
        robots = {name: studio.read_text(name) for name in there}
        return build_recipe(studio.project, studio.folder, robots)

    with elements.add_card("All of it again"):
        draw_note(
            "Both make the same values in an empty folder, and name the same effects. The logs are "
            "read in place."
        )
        with ui.row():
            for title, file, write in (
                ("Shell script", "steps.sh", format_script),
                ("Notebook", "steps.ipynb", format_notebook),
            ):

                def make(write: Callable[[Recipe], str] = write) -> bytes:
                    return write(collect_recipe()).encode()

                _add_download_button(studio, title, file, make)
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
            title, props = f"Tidy: {format_size(left.size)}", "outline icon=delete_sweep"
            elements.disable_while_busy(studio, add_button(title, remove_unused, props))
            draw_note(
                f"removes {len(left.files)} files of {gone} steps of other branches; logs, "
                "pages and the history of the current model stay"
            )
