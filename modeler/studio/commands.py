"""What is typed for what is done: the words of every command line, from a project.

Files are named relative to the folder of the project, in which the commands run. Bookkeeping of the
studio itself (`--json`, `--picture`) comes to the words when they run, and is no part of a step.
"""

import re
import shlex
from collections.abc import Sequence
from dataclasses import dataclass

from modeler.studio.project import ROBOT, Project, Step

DRAWING = ("log", "fit", "compare", "diagnose", "add", "fleet")
"""Commands whose pictures are kept as plain data."""


@dataclass(frozen=True)
class Asked:
    """A command that is to be run.

    Attributes:
        kind: of the step.
        words: after `modeler`.
        title: for people, while it runs and in the list of steps.
        model: file that it writes; "" for none.
        about: the step whose model it is about; None: the current one.
    """

    kind: str
    words: tuple[str, ...]
    title: str
    model: str = ""
    about: int | None = None


def typed(words: Sequence[str]) -> str:
    """A command line, as a shell takes it."""
    return shlex.join(["modeler", *words])


def bookkeeping(words: Sequence[str], number: int) -> tuple[list[str], str, str]:
    """Words that come to those of a step, the JSON and the pictures that it writes."""
    result = f"results/{number}.json"
    pictures = f"results/{number}.pictures.json" if words[0] in DRAWING else ""
    more = ["--picture", pictures] if pictures else []
    return ["--json", result, *more], result, pictures


def robot_copy(project: Project) -> str:
    """Where the next step keeps the robot as it is now, which it works on."""
    return f"robots/{project.next_number}.toml"


def fit(project: Project, options: Sequence[str] = ()) -> Asked:
    """The fit of the training stretches.

    Args:
        project: with a robot and logs.
        options: more of `modeler fit`, as ("--method", "robust").
    """
    model = f"models/{project.next_number}.json"
    words = ("fit", robot_copy(project), *project.words("train"), "--out", model)
    return Asked("fit", (*words, *mapped(project), *options), "fit", model, about=0)


def compare(project: Project, files: Sequence[str] = (), options: Sequence[str] = ()) -> Asked:
    """Measured against predicted: on the held-out stretches, or where there are none on all."""
    logs = files or project.words("test") or project.words("train")
    words = ("compare", project.model, *logs, *guessing(project), *options)
    return Asked("compare", words, "compare")


def diagnose(project: Project) -> Asked:
    """What the current model lacks."""
    words = ("diagnose", project.model, *project.words("train"), *_held(project))
    bans = [word for effect in project.without for word in ("--without", effect)]
    return Asked("diagnose", (*words, *guessing(project), *bans), "look for what is missing")


def add(project: Project, effect: str, joint: str | None) -> Asked:
    """The current model with an effect more."""
    model = f"models/{project.next_number}.json"
    place = ("--joint", joint) if joint is not None else ()
    words = ("add", project.model, effect, *project.words("train"), *place)
    name = effect if joint is None else f"{effect}@{joint}"
    words = (*words, *_held(project), *guessing(project), "--out", model)
    return Asked("add", words, f"add {name}", model)


def look(project: Project, file: str) -> Asked:
    """What is in a log, and with a robot what contradicts it."""
    robot = ("--robot", project.robot) if project.robot else ()
    return Asked("log", ("log", file, *robot, *mapped(project)), f"look at {file}", about=0)


def new_robot(joints: int) -> Asked:
    """A robot to start from, with so many joints that turn."""
    letters = "R" * max(1, joints)
    return Asked("new", ("new", ROBOT, "--joints", letters), f"a robot of {len(letters)}", about=0)


def again(project: Project, step: Step) -> Asked:
    """The page of what a step found: the same command, which ends as it did."""
    number, own = project.next_number, out_of(step.words)
    page, model = f"pages/{number}.html", f"models/{number}.json"
    words = (*(model if word == own else word for word in step.words), "--report", page)
    return Asked("page", words, f"page of {step.title}", page, about=step.number)


def generate(project: Project, precision: str = "double") -> Asked:
    """C with the fitted values."""
    folder = f"taken/{project.next_number}_c"
    single = () if precision == "double" else ("--precision", precision)
    words = ("generate", project.model, "--out", folder, *single)
    return Asked("generate", words, "write C", folder)


def export(project: Project, to: str, like: str = "") -> Asked:
    """The robot with its values for another program.

    Args:
        project: with a model.
        to: urdf, mjcf or sdf.
        like: file of the same robot, of which only numbers are replaced.
    """
    out = f"taken/{project.next_number}.{'xml' if to == 'mjcf' else to}"
    words = ("export", project.model, *(("--like", like) if like else ("--to", to)), "--out", out)
    return Asked("export", words, f"write {to.upper()}", out)


def out_of(words: Sequence[str]) -> str:
    """What a command writes: the word behind `--out`."""
    return words[words.index("--out") + 1] if "--out" in words else ""


def as_it_was(asked: Asked, step: Step | None) -> bool:
    """Whether a step is what would be done now, but for the numbers of its own files."""
    return step is not None and _plain(asked.words) == _plain(step.words)


def _plain(words: Sequence[str]) -> list[str]:
    own = out_of(words)
    return [word for word in words if word != own and not is_copy(word)]


def is_copy(word: str) -> bool:
    """Whether it is the robot as it was when a step began."""
    return _COPY.fullmatch(word) is not None


_COPY = re.compile(r"robots/\d+\.toml")


def demo(project: Project, log: str, seed: int) -> Asked:
    """A measured run of the demonstration arm, whose machine has what its robot file lacks."""
    robot = robot_copy(project)
    words = ("simulate", robot, "--duration", "20", "--seed", str(seed), "--noise", "0.01")
    hidden = ("--hide", "load_friction@2", "--out", log)
    return Asked("simulate", (*words, *hidden), f"measure {log}", about=0)


def mapped(project: Project) -> tuple[str, ...]:
    """Whose column is which, as every command takes it."""
    return tuple(word for own in project.mapping for word in ("--map", own))


def guessing(project: Project) -> tuple[str, ...]:
    """The same where logs are called differently: a model keeps what is so in the first one."""
    return mapped(project) if "auto" in project.mapping else ()


def _held(project: Project) -> tuple[str, ...]:
    held = project.words("test")
    return ("--holdout", *held) if held else ()
