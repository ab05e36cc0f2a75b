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
from modeler.studio.tasks import FIXED, LogPart, Step, Task, command_line

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

    def lies_there(self, word: str) -> bool:
        """Whether a word names a log, or a stretch of it, that lies in the folder."""
        return word.partition("@")[0] in self.logs


def recipe(project: Project, folder: Path, robots: Mapping[str, str]) -> Recipe:
    """Of the current model.

    Args:
        project: with one.
        folder: of it.
        robots: text of the robot as it was in each step, by file.
    """
    way = project.path()
    numbers = {step.number for step in way}
    about = [project.about(verb, number) for verb in _ABOUT for number in sorted(numbers)]
    used = {part.file for step in way for part in (*step.task.logs, *step.task.held)}
    made = [step for step in project.steps if step.verb == "simulate" and step.output in used]
    steps = [*made, *way, *(step for step in about if step is not None)]
    logs = frozenset(file for file in used if file.startswith("logs/"))
    logs |= {log.file for log in project.logs if not Path(log.file).is_absolute()}
    own = sorted({step.robot for step in steps} & {*robots})
    return Recipe(
        folder, tuple(sorted(steps, key=lambda step: step.number)),
        {name: robots[name] for name in own}, logs - {step.output for step in made},
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


def script(own: Recipe) -> str:
    """The recipe for sh."""
    lines = [_HEAD % shlex.quote(str(own.folder))]
    for name, text in own.robots.items():
        end = "END_OF_ROBOT"
        while end in text.splitlines():
            end += "_"
        lines.append(f"cat > {shlex.quote(name)} <<'{end}'\n{text.rstrip()}\n{end}\n")
    for step in own.steps:
        words = [_shell_word(own, word) for word in command_line(step)]
        lines.append(
            f"# {step.number}: {step.task.title}\n$MODELER {' '.join(words)} --json {step.result}\n"
        )
    return "\n".join(lines)


def _shell_word(own: Recipe, word: str) -> str:
    if own.lies_there(word):
        return f'"$LOGS"/{shlex.quote(word)}'
    return shlex.quote(word)


# As a notebook.


def notebook(own: Recipe) -> str:
    """The recipe as .ipynb, in the words of the Python interface."""
    cells = [_cell("markdown", "# The steps of a project of `modeler studio`\n\n"
                   "Run it in an empty folder; `LOGS` is the folder of the project."),
             _cell("code", "\n".join(_preparation(own)))]  # fmt: skip
    for step in own.steps:
        cells.append(_cell("markdown", f"{step.number}. {step.task.title}"))
        cells.append(_cell("code", "\n".join(_code(own, step))))
    for k, cell in enumerate(cells):
        cell["id"] = f"step-{k}"
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    book = {"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}
    return json.dumps(book, indent=1) + "\n"


def _cell(kind: str, text: str) -> dict[str, Any]:
    cell: dict[str, Any] = {"cell_type": kind, "metadata": {}, "source": text.splitlines(True)}
    return cell | ({"outputs": [], "execution_count": None} if kind == "code" else {})


def _preparation(own: Recipe) -> Iterator[str]:
    yield "import dataclasses"
    yield "from pathlib import Path"
    yield ""
    yield "import modeler"
    yield ""
    yield f"LOGS = {str(own.folder)!r}"
    yield 'for name in ("robots", "models", "logs"):'
    yield "    Path(name).mkdir(exist_ok=True)"
    for name, text in own.robots.items():
        raw = "'''" not in text and not text.endswith(("'", "\\"))
        quoted = f"r'''{text}'''" if raw else repr(text)
        yield f"Path({name!r}).write_text({quoted}, encoding='utf-8')"


def _log(own: Recipe, word: str) -> str:
    """A log as Python names it."""
    if own.lies_there(word):
        return f"LOGS + {chr(47) + word!r}"
    return repr(word)


def _logs(own: Recipe, parts: Sequence[LogPart]) -> str:
    return f"[{', '.join(_log(own, part.word) for part in parts)}]"


def _code(own: Recipe, step: Step) -> Iterator[str]:
    task, logs = step.task, _logs(own, step.task.logs)
    made, before = f"model_{step.number}", f"model_{step.parent}"
    held = _logs(own, task.held)
    mapped = f", mapping={[*task.mapping]!r}" if task.mapping else ""
    if step.verb == "simulate":
        yield f"robot = modeler.open_robot({step.robot!r})"
        yield f"modeler.simulate(robot, {task.file!r}, {_simulated(task)})"
    elif step.verb == "fit":
        yield f"robot = modeler.open_robot({step.robot!r})"
        stated = {name: getattr(task, name) for name in _STATED}
        stated = {name: value for name, value in stated.items() if value not in ("", None)}
        if stated:
            yield f"robot = dataclasses.replace(robot, fit={{**robot.fit, **{stated!r}}})"
        effects = f", effects={','.join(task.effects)!r}" if task.effects else ""
        yield f"{made} = modeler.identify(robot, {logs}{mapped}{effects})"
    elif step.verb == "add":
        where = f"joint={task.joint or None!r}, logs={logs}, held_out={held}"
        yield f"{made} = {before}.add({task.effect!r}, {where}{mapped})"
    elif step.verb == "diagnose":
        bans = f"logs={logs}, without={[*task.without]!r}"
        yield f"{before}.missing(held_out={held}, {bans}{mapped})"
    else:
        yield f"{before}.compare({logs}{mapped})"
    if step.model:
        yield f"modeler.save({made}, {step.model!r})"
        yield made


_STATED = (
    "method", "derivatives", "cutoff", "parallel_cutoff", "low_speed", "essential_below"
)  # fmt: skip
"""What of a fit the robot is told, as its table [fit] would."""


def _simulated(task: Task) -> str:
    fixed = dict(zip(FIXED["simulate"][::2], FIXED["simulate"][1::2], strict=True))
    numbers = f"duration={fixed['--duration']}, seed={task.seed}, torque_noise={fixed['--noise']}"
    return f"hide={[fixed['--hide']]!r}, {numbers}"
