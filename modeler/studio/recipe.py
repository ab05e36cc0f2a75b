"""What was done, to be done again: as a shell script, and as a notebook.

Both hold the robot as it was in every step, simulate again what was simulated here, read the logs
from the folder of the project, and make models of the same values in the folder they run in.
"""

import json
import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from modeler.studio.project import Project
from modeler.studio.tasks import FIXED, LogPart, Step, Task, build_command_line

_ABOUT = ("compare", "diagnose")
"""Verbs that say something about a model, and are told again."""


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
    simulations = [
        step for step in project.steps if step.verb == "simulate" and step.output in used
    ]
    steps = [*simulations, *model_path, *(step for step in about if step is not None)]
    logs = frozenset(file for file in used if file.startswith("logs/"))
    logs |= {log.file for log in project.logs if not Path(log.file).is_absolute()}
    robot_files = sorted({step.robot_copy for step in steps} & {*robots})
    return Recipe(
        folder, tuple(sorted(steps, key=lambda step: step.number)),
        {name: robots[name] for name in robot_files}, logs - {step.output for step in simulations},
    )  # fmt: skip


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
        words = [_quote_word(recipe, word) for word in build_command_line(step)]
        lines.append(
            f"# {step.number}: {step.task.title}\n$MODELER {' '.join(words)} --json "
            f"{step.result_file}\n"
        )
    return "\n".join(lines)


def _quote_word(recipe: Recipe, word: str) -> str:
    if recipe.has_log(word):
        return f'"$LOGS"/{shlex.quote(word)}'
    return shlex.quote(word)


# As a notebook.


def format_notebook(recipe: Recipe) -> str:
    """Formats the recipe as a notebook with the Python interface."""
    cells = [_build_cell("markdown", "# The steps of a project of `modeler studio`\n\n"
                   "Run it in an empty folder; `LOGS` is the folder of the project."),
             _build_cell("code", "\n".join(_format_preparation(recipe)))]  # fmt: skip
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
        stated = {name: getattr(task, name) for name in _STATED}
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


_STATED = (
    "method", "derivatives", "cutoff", "parallel_cutoff", "low_speed", "essential_below"
)  # fmt: skip
"""What of a fit the robot is told, as its table [fit] would."""


def _format_settings(task: Task) -> str:
    fixed = dict(zip(FIXED["simulate"][::2], FIXED["simulate"][1::2], strict=True))
    numbers = f"duration={fixed['--duration']}, seed={task.seed}, torque_noise={fixed['--noise']}"
    return f"hide={[fixed['--hide']]!r}, {numbers}"
