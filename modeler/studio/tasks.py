"""What is done in a project: a verb with typed values, and the one command line that they make.

A project may come from anybody, so no step holds a command line: `build_command_line` makes it,
from the few options named here. No value can be read as an option, and files that a command writes
are named by the number of its step.
"""

import dataclasses
import math
import re
import shlex
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from modeler.api.front_end import DataError, FitOptions

ROBOT: Literal["robot.toml"] = "robot.toml"

Verb = Literal[
    "fit", "add", "compare", "contest", "diagnose", "excite", "generate", "export", "page",
    "log", "new", "convert", "derive", "simulate", "fleet",
]  # fmt: skip
MAKING = ("fit", "add")
"""Verbs that end in a model; the other ones say something about a model, or prepare one."""

PAGED = ("fit", "add", "compare", "diagnose")
"""Verbs whose steps can be run again, for their report page."""

DRAWING = (*PAGED, "contest", "log", "fleet")
"""Verbs whose pictures are kept as plain data."""

_COPYING = ("fit", "derive", "simulate", "fleet")  # they work on a copy of the robot
ABOUT_A_MODEL = ("add", "compare", "contest", "diagnose", "excite", "generate", "export")
_COMMANDS: Mapping[str, str] = {"contest": "compare"}  # verbs that are called otherwise there
_SUFFIX: Mapping[str, str] = {"mjcf": ".xml", "urdf": ".urdf", "sdf": ".sdf"}

FIXED: Mapping[str, tuple[str, ...]] = {
    "derive": ("--no-terms",),
    "convert": ("--out", ROBOT, "--force"),
    "simulate": ("--duration", "20", "--noise", "0.01", "--hide", "load_friction@2"),
}
"""Options that a verb always has."""


@dataclass(frozen=True)
class TimeRange:
    """Seconds of a log, as `FILE@START:END` counts them; without ends all of it."""

    start: float = -math.inf
    end: float = math.inf

    def format_word(self, file: str) -> str:
        """Formats the range as FILE@START:END."""
        ends = [f"{side:.15g}" if math.isfinite(side) else "" for side in (self.start, self.end)]
        return f"{file}@{':'.join(ends)}" if any(ends) else file

    def subtract_gaps(self, gaps: Sequence["TimeRange"]) -> "list[TimeRange]":
        """Returns what is left of the range between gaps."""
        left, start = [], self.start
        for gap in sorted(gaps, key=lambda gap: gap.start):
            if gap.end <= max(start, gap.start) or gap.start >= self.end:
                continue
            if gap.start > start:
                left.append(TimeRange(start, gap.start))
            start = max(start, gap.end)
        return left + ([TimeRange(start, self.end)] if start < self.end else [])


@dataclass(frozen=True)
class LogPart:
    """A segment of a log."""

    file: str
    stretch: TimeRange = TimeRange()

    @property
    def command_word(self) -> str:
        """Returns the part as FILE@START:END."""
        return self.stretch.format_word(self.file)


@dataclass(frozen=True)
class Task:
    """What a command does. Each verb has a few of the fields, and the other ones are empty.

    Attributes:
        verb: what is done.
        logs: that are fitted, compared or searched.
        held: logs that are only judged on.
        mapping: words of `--map`.
        method, derivatives, cutoff, parallel_cutoff, low_speed, essential_below: of a fit, as
            `FitOptions` has them.
        effects: of a fit, in place of the robot file's.
        effect: that is added; auto: all that a diagnosis names.
        joint: of the effect; "": where it explains most.
        without: effects that this robot does not have.
        models: steps whose models are compared.
        step: whose page is written.
        file: log or robot file that is read, log that is simulated.
        robot: whether the log is judged by the robot.
        between, duration, limit: of a motion.
        precision, to, like: of what is generated or exported.
        joints, template, convention: of a new robot.
        name: how paths of logs end, with machine and period.
        seed: of a simulation.
    """

    verb: Verb
    logs: tuple[LogPart, ...] = ()
    held: tuple[LogPart, ...] = ()
    mapping: tuple[str, ...] = ()
    method: str = ""
    derivatives: str = ""
    cutoff: float | None = None
    parallel_cutoff: float | None = None
    low_speed: float | None = None
    essential_below: float | None = None
    effects: tuple[str, ...] = ()
    effect: str = ""
    joint: str = ""
    without: tuple[str, ...] = ()
    models: tuple[int, ...] = ()
    step: int = 0
    file: str = ""
    robot: bool = False
    between: str = ""
    duration: float | None = None
    limit: tuple[str, ...] = ()
    precision: str = ""
    to: str = ""
    like: str = ""
    joints: str = ""
    template: str = ""
    convention: str = ""
    name: str = ""
    seed: int | None = None

    @property
    def title(self) -> str:
        """Returns the title for people."""
        at = f"{self.effect}@{self.joint}" if self.joint else self.effect
        what = at or self.file or self.between or self.to or self.like
        return " ".join(filter(None, (self.verb, what, f"of step {self.step}" * bool(self.step))))


FIT_OPTIONS = tuple(
    option
    for option in dataclasses.fields(FitOptions)
    if option.name in {field.name for field in dataclasses.fields(Task)}
)
"""Options of `modeler fit` that a task has, as they are declared."""


@dataclass(frozen=True)
class Step:
    """A task that was carried out.

    Attributes:
        number: of the step; files that it wrote are called so.
        parent: the step whose model it is about, or went on from; 0: none.
        task: that was carried out.
        seconds: that it took.
        made: when, ISO 8601.
    """

    number: int
    parent: int
    task: Task
    seconds: float = 0.0
    made: str = ""

    @property
    def verb(self) -> Verb:
        """Returns the verb of its task."""
        return self.task.verb

    @property
    def output(self) -> str:
        """Returns the path that it writes; "" for its result alone."""
        n, ending = self.number, self.task.like.rpartition(".")[2]
        places = {
            **dict.fromkeys(MAKING, f"models/{n}.json"),
            "page": f"pages/{n}.html",
            "generate": f"taken/{n}_c",
            "excite": f"motions/{n}.csv",
            "simulate": self.task.file,
            "export": f"taken/{n}{_SUFFIX.get(self.task.to, f'.{ending}')}",
        }
        return places.get(self.verb, "")

    @property
    def model_file(self) -> str:
        """Returns the model that it made; "" for none."""
        return self.output if self.verb in MAKING else ""

    @property
    def robot_copy(self) -> str:
        """Returns the robot file as it was when the step began; "" for none."""
        copied = self.verb in _COPYING or (self.verb == "excite" and not self.parent)
        return f"robots/{self.number}.toml" if copied else ""

    @property
    def result_file(self) -> str:
        """Returns the path of its JSON."""
        return f"results/{self.number}.json"

    @property
    def pictures_file(self) -> str:
        """Returns the path of its pictures as data; "" for none."""
        return f"results/{self.number}.pictures.json" if self.verb in DRAWING else ""


def build_command_line(step: Step, steps: Sequence[Step] = ()) -> tuple[str, ...]:
    """Builds the words after `modeler` that carry out a step, in the project folder.

    Args:
        step: it.
        steps: of the project, among which a page finds the one that it is of.

    Raises:
        DataError: a value that would be something else in a command line.
    """
    task = step.task
    check_task(task)
    if task.verb == "page":
        of = next((earlier for earlier in steps if earlier.number == task.step), None)
        if of is None or of.verb not in PAGED:
            raise DataError(f"step {task.step}: has no report page; choose a fit or a comparison")
        words = build_command_line(of)
        if of.model_file:  # which stays as it is: the same model is written once more
            words = (*words[:-1], f"models/{step.number}.json")
        return (*words, "--report", step.output)
    model = f"models/{step.parent}.json"
    about: Mapping[str, tuple[str, ...]] = {
        "add": (model, task.effect),
        "contest": tuple(f"models/{n}.json" for n in task.models),
        "new": (ROBOT,),
        **dict.fromkeys(("log", "convert"), (task.file,)),
    }
    line = [_COMMANDS.get(task.verb, task.verb)]
    line += about.get(task.verb, (step.robot_copy or model,))
    line += [part.command_word for part in task.logs]
    line += ("--robot", ROBOT) if task.robot else ()
    line += (*_yield_options(task), *FIXED.get(task.verb, ()))
    line += ("--force",) if task.template else ()
    line += ("--out", step.output) if step.output else ()
    return tuple(line)


def build_bookkeeping_words(step: Step) -> tuple[str, ...]:
    """Builds the words that a step gets when it is run, and are no part of it."""
    pictures = ("--picture", step.pictures_file) if step.pictures_file else ()
    return ("--json", step.result_file, *pictures)


def format_command(words: Sequence[str]) -> str:
    """Formats a command line for a shell."""
    return shlex.join(["modeler", *words])


def _yield_options(task: Task) -> Iterator[str]:
    """Fields that are no places become options of their names; a list is given one by one."""
    names = {"held": "holdout", "mapping": "map"}
    for name in FIELDS[task.verb].split():
        value, option = getattr(task, name), f"--{names.get(name, name).replace('_', '-')}"
        if name in _PLACES or value in ("", None, ()):
            continue
        if name == "held":
            value = tuple(part.command_word for part in value)
        elif name == "effects":
            value = ",".join(value)
        for item in value if isinstance(value, tuple) else (value,):
            yield from (option, f"{item:.12g}" if isinstance(item, float) else str(item))


# What the values of a task may be, whoever wrote them.

FIELDS: Mapping[str, str] = {
    "fit": f"logs mapping {' '.join(option.name for option in FIT_OPTIONS)} effects",
    "add": "logs held mapping effect joint",
    "compare": "logs mapping",
    "contest": "models logs mapping",
    "diagnose": "logs held mapping without",
    "excite": "between duration limit",
    "generate": "precision",
    "export": "to like",
    "page": "step",
    "log": "file robot mapping",
    "new": "joints template convention",
    "convert": "file",
    "derive": "",
    "simulate": "file seed",
    "fleet": "logs name mapping",
}
"""Fields that each verb has."""

_PLACES = ("logs", "file", "effect", "models", "step", "robot")  # they are no options

_NAME = re.compile(r"\w[\w.@-]*")
_TEXT = re.compile(r"(?!-)[^\x00-\x1f\x7f]+")
_FILE = re.compile(r"(?!-)(?!(?:.*/)?\.\.(?:/|$))[^\x00-\x1f\x7f\\]+")
_FORMS: Mapping[str, re.Pattern[str]] = {
    "mapping": re.compile(r"auto|(?!-)[^\x00-\x1f\x7f=]+=[^\x00-\x1f\x7f]+"),
    **dict.fromkeys(("file", "like"), _FILE),
    **dict.fromkeys(("between", "limit", "without", "name"), _TEXT),
}
"""What texts may be where they are no plain names: no option, and files without `..`."""


def check_values(name: str, value: Any) -> None:
    """Refuses a value that no field of that name may have.

    Raises:
        DataError: says which, and what is expected.
    """
    for item in value if isinstance(value, tuple) else (value,):
        if isinstance(item, LogPart):
            check_values("file", item.file)
        elif isinstance(item, str) and item:
            if not _FORMS.get(name, _NAME).fullmatch(item):
                got = f"{name}: got {item[:60]!r}"
                raise DataError(f"{got}; expected no option, and no file outside")
        elif item == "" and isinstance(value, tuple):
            raise DataError(f"{name}: got an empty text; expected a value, or nothing")
        elif isinstance(item, float | int) and not 0 <= item < 1e9:
            raise DataError(f"{name}: got {item:g}; expected a number from 0 to 1e9")


def check_task(task: Task) -> None:
    """Refuses a task whose values are none of its verb, or could be read as something else.

    Raises:
        DataError: names the first field, and says what is expected.
    """
    known = FIELDS[task.verb].split()
    for field in dataclasses.fields(task)[1:]:
        value = getattr(task, field.name)
        if field.name not in known and value != field.default:
            raise DataError(f"{task.verb}, {field.name}: it has no such value; leave it out")
        check_values(field.name, value)
    if task.verb == "simulate" and not re.fullmatch(r"logs/\w[\w.-]*", task.file):
        raise DataError(f"simulate, file: got {task.file[:60]!r}; expected one in logs/")
