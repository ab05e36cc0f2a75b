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

from modeler.studio.commands import out_of
from modeler.studio.project import MAKING, Project, Step

_ABOUT = ("compare", "diagnose")
"""Kinds of steps that say something about a model, and are told again."""

_MANY = ("--holdout",)
"""Options that take all words up to the next option."""

_WORDS = ("--method", "--derivatives")
"""Options of a fit whose value is no number."""


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
    about = [project.about(kind, number) for kind in _ABOUT for number in sorted(numbers)]
    used = {word.partition("@")[0] for step in way for word in step.words}
    made = [step for step in project.steps if step.kind == "simulate"]
    made = [step for step in made if out_of(step.words) in used]
    steps = [*made, *way, *(step for step in about if step is not None)]
    logs = frozenset(file for file in used if file.startswith("logs/"))
    logs |= {log.file for log in project.logs if not Path(log.file).is_absolute()}
    own = {word for step in steps for word in step.words if word in robots}
    return Recipe(
        folder, tuple(sorted(steps, key=lambda step: step.number)),
        {name: robots[name] for name in sorted(own)},
        logs - {out_of(step.words) for step in made},
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
        words = [_shell_word(own, word) for word in step.words]
        result = f" --json results/{step.number}.json"
        lines.append(
            f"# {step.number}: {_one_line(step.title)}\n$MODELER {' '.join(words)}{result}\n"
        )
    return "\n".join(lines)


def _one_line(text: str) -> str:
    return " ".join(text.split())


def _shell_word(own: Recipe, word: str) -> str:
    if own.lies_there(word):
        return f'"$LOGS"/{shlex.quote(word)}'
    return shlex.quote(word)


# As a notebook.


def _parsed(words: Sequence[str]) -> tuple[list[str], dict[str, list[str]]]:
    """Words of a command: what stands by itself, and options with what follows each."""
    plain: list[str] = []
    options: dict[str, list[str]] = {}
    taking: list[str] | None = None
    rest = iter(words[1:])
    for word in rest:
        if word.startswith("--"):
            own = options.setdefault(word, [])
            taking = own if word in _MANY else None
            own += [] if word in _MANY else [next(rest)]
        else:
            (plain if taking is None else taking).append(word)
    return plain, options


def notebook(own: Recipe) -> str:
    """The recipe as .ipynb, in the words of the Python interface."""
    cells = [_cell("markdown", "# The steps of a project of `modeler studio`\n\n"
                   "Run it in an empty folder; `LOGS` is the folder of the project."),
             _cell("code", "\n".join(_preparation(own)))]  # fmt: skip
    for step in own.steps:
        cells.append(_cell("markdown", f"{step.number}. {_one_line(step.title)}"))
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


def _logs(own: Recipe, words: Sequence[str]) -> str:
    return f"[{', '.join(_log(own, word) for word in words)}]"


def _code(own: Recipe, step: Step) -> Iterator[str]:
    plain, options = _parsed(step.words)
    out, held = out_of(step.words), _logs(own, options.get("--holdout", []))
    first, made = _name(plain[0]), _name(out)
    mapped = f", mapping={options['--map']!r}" if "--map" in options else ""
    if step.kind == "simulate":
        yield f"robot = modeler.open_robot({plain[0]!r})"
        yield f"modeler.simulate(robot, {out!r}, {_simulated(options)})"
    elif step.kind == "fit":
        yield f"robot = modeler.open_robot({plain[0]!r})"
        yield from _fitted(options)
        effects = options.get("--effects", [""])[-1]
        given = mapped + (f", effects={effects!r}" if effects else "")
        yield f"{made} = modeler.identify(robot, {_logs(own, plain[1:])}{given})"
    elif step.kind == "add":
        joint = options.get("--joint", [None])[-1]
        logs = f"logs={_logs(own, plain[2:])}, held_out={held}"
        yield f"{made} = {first}.add({plain[1]!r}, joint={joint!r}, {logs}{mapped})"
    elif step.kind == "diagnose":
        logs, bans = _logs(own, plain[1:]), options.get("--without", [])
        yield f"{first}.missing(held_out={held}, logs={logs}, without={bans!r}{mapped})"
    else:
        yield f"{first}.compare({_logs(own, plain[1:])}{mapped})"
    if step.kind in MAKING:
        yield f"modeler.save({made}, {out!r})"
        yield made


def _name(model: str) -> str:
    return f"model_{Path(model).stem}"


def _simulated(options: Mapping[str, list[str]]) -> str:
    names = {"--duration": "duration", "--seed": "seed", "--noise": "torque_noise"}
    given = [f"hide={options.get('--hide', [])!r}"]
    for word, name in names.items():
        for value in options.get(word, [])[-1:]:  # a number, whoever wrote the project
            given.append(f"{name}={int(value) if value.isdecimal() else float(value)!r}")
    return ", ".join(given)


def _fitted(options: Mapping[str, list[str]]) -> Iterator[str]:
    """What of `modeler fit` the robot is told, as its table [fit] would."""
    words = [word for word in options if word not in ("--out", "--map", "--effects")]
    stated = {
        word[2:].replace("-", "_"): options[word][-1]
        if word in _WORDS
        else float(options[word][-1])
        for word in words
    }
    if stated:
        yield f"robot = dataclasses.replace(robot, fit={{**robot.fit, **{stated!r}}})"
