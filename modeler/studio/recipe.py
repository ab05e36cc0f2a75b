"""What was done, to be done again: as a shell script, and as a notebook.

Both hold the robot as it was in every step, simulate again what was simulated here, read the logs
from the folder of the project, and make models of the same values in the folder they run in.
"""

import json
import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from modeler.studio.commands import out_of
from modeler.studio.project import Project, Step

_ABOUT = ("compare", "diagnose")
"""Kinds of steps that say something about a model, and are told again."""

_MANY = ("--holdout",)
"""Options that take all words up to the next option."""


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


@dataclass
class _Parsed:
    """Words of a command: what stands by itself, and options with what follows them."""

    plain: list[str] = field(default_factory=list)
    options: dict[str, list[str]] = field(default_factory=dict)

    def one(self, name: str) -> str | None:
        """The value of an option."""
        return self.options[name][-1] if name in self.options else None


def _parsed(words: Sequence[str]) -> _Parsed:
    found, many = _Parsed(), ""
    rest = iter(words[1:])
    for word in rest:
        if word.startswith("--"):
            many = word if word in _MANY else ""
            own = found.options.setdefault(word, [])
            own += [] if many else [next(rest)]
        elif many:
            found.options[many].append(word)
        else:
            found.plain.append(word)
    return found


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
    words = _parsed(step.words)
    first, rest, held = words.plain[0], words.plain[1:], words.options.get("--holdout", [])
    if step.kind == "simulate":
        yield from _simulated(words)
    elif step.kind == "fit":
        yield from _fitted(own, words, _name(out_of(step.words)))
    elif step.kind == "add":
        effect, *logs = rest
        made = out_of(step.words)
        joint = words.one("--joint")
        yield (
            f"{_name(made)} = {_name(first)}.add({effect!r}, joint={joint!r}, "
            f"logs={_logs(own, logs)}, held_out={_logs(own, held)})"
        )
        yield f"modeler.save({_name(made)}, {made!r})"
        yield f"{_name(made)}.table('waterfall')"
    elif step.kind == "diagnose":
        bans = words.options.get("--without", [])
        yield (
            f"{_name(first)}.missing(held_out={_logs(own, held)}, logs={_logs(own, rest)}, "
            f"without={bans!r})"
        )
    else:
        yield f"{_name(first)}.compare({_logs(own, rest)})"


def _name(model: str) -> str:
    return f"model_{Path(model).stem}"


def _simulated(words: _Parsed) -> Iterator[str]:
    names = {"--duration": "duration", "--seed": "seed", "--noise": "torque_noise"}
    settings = [
        f"{name}={float(value)!r}" if name != "seed" else f"seed={int(value)}"
        for word, name in names.items()
        if (value := words.one(word)) is not None
    ]
    out, hide = words.one("--out"), words.options.get("--hide", [])
    yield f"robot = modeler.open_robot({words.plain[0]!r})"
    yield f"modeler.simulate(robot, {out!r}, hide={hide!r}, {', '.join(settings)})"


def _fitted(own: Recipe, words: _Parsed, name: str) -> Iterator[str]:
    numbers = {"--cutoff", "--parallel-cutoff", "--low-speed", "--essential-below"}
    options = {
        word[2:].replace("-", "_"): float(values[-1]) if word in numbers else values[-1]
        for word, values in words.options.items()
        if word not in ("--out", "--map", "--effects")
    }
    yield f"robot = modeler.open_robot({words.plain[0]!r})"
    if options:
        yield f"robot = dataclasses.replace(robot, fit={{**robot.fit, **{options!r}}})"
    more = [f"{key}={value!r}" for key, value in (
        ("mapping", words.options.get("--map")), ("effects", words.one("--effects")),
    ) if value]  # fmt: skip
    given = ", ".join(["robot", _logs(own, words.plain[1:]), *more])
    yield f"{name} = modeler.identify({given})"
    yield f"modeler.save({name}, {words.one('--out')!r})"
    yield name
