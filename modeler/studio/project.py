"""A project folder: its robot, its logs, the steps that were taken, in one file `project.toml`.

    project.toml            what follows
    robot.toml              the robot as it is edited
    robots/N.toml           the robot as it was when step N began
    logs/ models/ results/ motions/ pages/ taken/

A `Project` is what the file says and does not change; a `Workspace` holds the one that is valid now
and writes the next. The file is written in one piece, so that whoever is killed loses no more than
the step that ran.
"""

import dataclasses
import json
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from modeler.core.errors import DataError
from modeler.core.files import read_text, write_atomically
from modeler.core.json import UndeclaredEntry, built, parse_toml

FILE = "project.toml"
ROBOT = "robot.toml"
FOLDERS = ("robots", "logs", "models", "results", "motions", "pages", "taken")

MAKING = ("fit", "add", "undo")
"""Kinds of steps that end in a model; other steps say something about one."""


@dataclass(frozen=True)
class Stretch:
    """Seconds of a log, as `FILE@START:END` counts them; without ends all of it."""

    start: float = -math.inf
    end: float = math.inf

    def word(self, file: str) -> str:
        """It, as a command takes it."""
        ends = [f"{side:.15g}" if math.isfinite(side) else "" for side in (self.start, self.end)]
        return f"{file}@{':'.join(ends)}" if any(ends) else file

    def without(self, gaps: Sequence["Stretch"]) -> "list[Stretch]":
        """What is left of it between gaps."""
        left, start = [], self.start
        for gap in sorted(gaps, key=lambda gap: gap.start):
            if gap.end <= max(start, gap.start) or gap.start >= self.end:
                continue
            if gap.start > start:
                left.append(Stretch(start, gap.start))
            start = max(start, gap.end)
        return left + ([Stretch(start, self.end)] if start < self.end else [])


@dataclass(frozen=True)
class ProjectLog:
    """A log of the project, and what its stretches are for.

    Attributes:
        file: relative to the folder, or where it lies.
        train: what is fitted.
        test: held out: judged on, never fitted.
        out: left out of both.
    """

    file: str
    train: tuple[Stretch, ...] = ()
    test: tuple[Stretch, ...] = ()
    out: tuple[Stretch, ...] = ()

    def words(self, role: str) -> list[str]:
        """Its stretches of one role, "train" or "test", as a command takes them."""
        parts: tuple[Stretch, ...] = getattr(self, role)
        return [own.word(self.file) for part in parts for own in part.without(self.out)]


@dataclass(frozen=True)
class Step:
    """A command that was carried out.

    Attributes:
        number: of the step; files that it wrote are called so.
        parent: the step whose model it is about, or went on from; 0: none.
        kind: the command, or "undo".
        words: after `modeler`, with paths relative to the folder.
        title: for people.
        model: file that it wrote; "" if it made none.
        result: its JSON; "" if it has none.
        pictures: they, as plain data; "" if it drew none.
        seconds: that it took.
        made: when, ISO 8601.
    """

    number: int
    parent: int
    kind: str
    words: tuple[str, ...]
    title: str = ""
    model: str = ""
    result: str = ""
    pictures: str = ""
    seconds: float = 0.0
    made: str = ""


@dataclass(frozen=True)
class Project:
    """What `project.toml` says.

    Attributes:
        robot: file that is edited, relative to the folder; "" before there is one.
        current: the step whose model is looked at; 0 before there is one.
        mapping: words of `--map`, for every log.
        without: effects that this robot does not have, as of `--without`.
        logs: in the order in which they came.
        steps: in the order in which they were taken; those that were undone stay.
    """

    robot: str = ""
    current: int = 0
    mapping: tuple[str, ...] = ()
    without: tuple[str, ...] = ()
    logs: tuple[ProjectLog, ...] = ()
    steps: tuple[Step, ...] = ()

    def step(self, number: int) -> Step | None:
        """The step of that number."""
        return next((step for step in self.steps if step.number == number), None)

    @property
    def model(self) -> str:
        """The file of the current model; "" before there is one."""
        step = self.step(self.current)
        return "" if step is None else step.model

    @property
    def next_number(self) -> int:
        """Of the next step."""
        return 1 + max((step.number for step in self.steps), default=0)

    def path(self, number: int | None = None) -> list[Step]:
        """The steps that made a model, from the first fit on; None: the current one."""
        found: list[Step] = []
        step = self.step(self.current if number is None else number)
        while step is not None:
            found.insert(0, step)
            step = self.step(step.parent) if step.parent < step.number else None
        return found

    def about(self, kind: str, number: int | None = None) -> Step | None:
        """The last step of that kind about a model; None of `number`: the current one."""
        parent = self.current if number is None else number
        own = [step for step in self.steps if step.kind == kind and step.parent == parent]
        return own[-1] if own else None

    def words(self, role: str) -> list[str]:
        """All stretches of one role, "train" or "test", as a command takes them."""
        return [word for log in self.logs for word in log.words(role)]


def project_text(project: Project) -> str:
    """The project as TOML."""
    return "\n".join(_lines(project)) + "\n"


def _lines(project: Project) -> Iterator[str]:
    yield "# A project of `modeler studio`: its commands run in this folder."
    for name, value in vars(project).items():
        if name not in ("logs", "steps"):
            yield f"{name} = {_toml(value)}"
    for title, entries in (("logs", project.logs), ("steps", project.steps)):
        for entry in entries:
            yield f"\n[[{title}]]"
            plain = dataclasses.asdict(entry)
            yield from (f"{name} = {_toml(value)}" for name, value in plain.items())


def _toml(value: Any) -> str:
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{name} = {_toml(item)}' for name, item in value.items())} }}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(_toml(item) for item in value)}]"
    return repr(value)


def project_from_text(text: str, where: str) -> Project:
    """What a `project.toml` says.

    Raises:
        DataError: it is no such file; says what is wrong with it.
    """
    try:
        project: Project = built(Project, parse_toml(text))
        for file in _files(project):
            if file and not _OWN.fullmatch(file):
                raise ValueError(f"{file} is no file of this folder")
        return project
    except (UndeclaredEntry, ValueError) as error:
        raise DataError(
            f"{where}: {error}; expected a file that `modeler studio` wrote; mend it, or move it "
            "away to begin anew beside the same files"
        ) from None


_OWN = re.compile(r"(?:(?!\.\.?/)[\w.+-]+/)*(?!\.\.?$)[\w.+-]+")
"""Files that the studio calls its own: below the folder, and of harmless letters."""


def _files(project: Project) -> Iterator[str]:
    yield project.robot
    for step in project.steps:
        yield from (step.model, step.result, step.pictures)


class Workspace:
    """A project folder in use.

    Attributes:
        folder: of the project.
        project: as it is now.
        writable: False where somebody else has the folder open.
    """

    def __init__(self, folder: Path, writable: bool = True) -> None:
        """Opens the folder; makes it if it is not there.

        Raises:
            DataError: its `project.toml` cannot be read.
            ModelerError: the folder cannot be made.
        """
        self.folder, self.writable = folder, writable
        place = folder / FILE
        self.project = (
            project_from_text(read_text(place), str(place)) if place.exists() else Project()
        )

    def save(self, project: Project) -> None:
        """Makes another project the valid one.

        Raises:
            DataError: the folder is only read here.
            ModelerError: the file cannot be written; the project stays as it was.
        """
        if not self.writable:
            raise DataError(
                f"{self.folder}: is open in another window, which alone may change it; go on "
                "there, or close it and take over here"
            )
        write_atomically(self.folder / FILE, project_text(project))
        self.project = project

    def reread(self) -> None:
        """What the file says now, where another process writes it."""
        place = self.folder / FILE
        if place.exists():
            self.project = project_from_text(read_text(place), str(place))
