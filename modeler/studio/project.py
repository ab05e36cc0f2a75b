"""A project folder: its robot, its logs, the steps that were taken, in one file `project.toml`.

    project.toml            what follows
    robot.toml              the robot as it is edited
    robots/N.toml           the robot as it was when step N began
    logs/ models/ results/ motions/ pages/ taken/

A `Project` is what the file says and does not change; a `Workspace` holds the one that is valid now
and writes the next. The file is written in one piece, so that whoever is killed loses no more than
the step that ran.
"""

import contextlib
import dataclasses
import hmac
import json
import os
import secrets
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from modeler.api.front_end import (
    DataError,
    ModelerError,
    build_instance,
    find_cache_folder,
    parse_toml,
    read_text,
    write_atomically,
)
from modeler.studio.tasks import (
    ABOUT_A_MODEL,
    MAKING,
    LogPart,
    Step,
    Task,
    TimeRange,
    build_command_line,
    check_values,
)

FILE = "project.toml"
DRAFT = "robot.draft.toml"
FOLDERS = ("robots", "logs", "models", "results", "motions", "pages", "taken")


@dataclass(frozen=True)
class ProjectLog:
    """A log of the project, and what its segments are for.

    Attributes:
        file: relative to the folder, or where it lies.
        train: what is fitted.
        test: held out: judged on, never fitted.
        out: left out of both.
    """

    file: str
    train: tuple[TimeRange, ...] = ()
    test: tuple[TimeRange, ...] = ()
    out: tuple[TimeRange, ...] = ()

    def get_parts(self, role: str) -> list[LogPart]:
        """Returns the log's time ranges of one role, "train" or "test"."""
        parts: tuple[TimeRange, ...] = getattr(self, role)
        left = (time_range for part in parts for time_range in part.subtract_gaps(self.out))
        return [LogPart(self.file, time_range) for time_range in left]


@dataclass(frozen=True)
class Project:
    """What `project.toml` says.

    Attributes:
        robot: file that is edited, in the folder; "" before there is one.
        current: the step whose model is looked at; 0 before there is one.
        mapping: words of `--map`, for every log.
        mapped: whether the user has chosen the mapping; else it is a guess.
        without: effects that this robot does not have, as of `--without`.
        logs: in the order in which they came.
        steps: in the order in which they were taken; those that were undone stay.
    """

    robot: Literal["", "robot.toml"] = ""
    current: int = 0
    mapping: tuple[str, ...] = ()
    mapped: bool = False
    without: tuple[str, ...] = ()
    logs: tuple[ProjectLog, ...] = ()
    steps: tuple[Step, ...] = ()

    def find_step(self, number: int) -> Step | None:
        """Finds the step of that number."""
        return next((step for step in self.steps if step.number == number), None)

    @property
    def model_file(self) -> str:
        """Returns the file of the current model; "" without one."""
        step = self.find_step(self.current)
        return "" if step is None else step.model_file

    @property
    def next_number(self) -> int:
        """Returns the number of the next step."""
        return 1 + max((step.number for step in self.steps), default=0)

    def collect_path(self, number: int | None = None) -> list[Step]:
        """Collects the steps that made a model, from the first fit on; None: the current one."""
        path: list[Step] = []
        step = self.find_step(self.current if number is None else number)
        while step is not None:
            path.insert(0, step)
            step = self.find_step(step.parent) if step.parent < step.number else None
        return path

    def find_step_about(self, verb: str, number: int | None = None) -> Step | None:
        """Finds the last step of a verb about a model; None: the current one."""
        parent = self.current if number is None else number
        every = [step for step in self.steps if step.verb == verb and step.parent == parent]
        return every[-1] if every else None

    def collect_parts(self, role: str) -> tuple[LogPart, ...]:
        """Collects all time ranges of one role, "train" or "test"."""
        return tuple(part for log in self.logs for part in log.get_parts(role))

    def collect_judged_parts(self) -> tuple[LogPart, ...]:
        """Collects the held-out time ranges; those of training where none is held out."""
        return self.collect_parts("test") or self.collect_parts("train")

    def collect_words(self, role: str) -> list[str]:
        """Collects the time ranges of a role as words of a command."""
        return [part.command_word for part in self.collect_parts(role)]

    def make_next_step(self, task: Task) -> Step:
        """Makes the next step of a task."""
        parent = self.current if task.verb in ABOUT_A_MODEL else task.step
        return Step(self.next_number, parent, task)


def format_project(project: Project) -> str:
    """Formats the project as TOML."""
    return "\n".join(_format_lines(project)) + "\n"


def _format_lines(project: Project) -> Iterator[str]:
    yield "# A project of `modeler studio`: its commands run in this folder."
    for name, value in vars(project).items():
        if name not in ("logs", "steps"):
            yield f"{name} = {_format_toml(value)}"
    for title, entries in (("logs", project.logs), ("steps", project.steps)):
        for entry in entries:
            yield f"\n[[{title}]]"
            yield from (f"{name} = {_format_toml(value)}" for name, value in vars(entry).items())


def _format_toml(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if dataclasses.is_dataclass(value):  # what is as usual is left out
        every = ((getattr(value, field.name), field) for field in dataclasses.fields(value))
        changed = [(field.name, item) for item, field in every if item != field.default]
        entries = ", ".join(f"{name} = {_format_toml(item)}" for name, item in changed)
        return f"{{ {entries} }}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(_format_toml(item) for item in value)}]"
    return repr(value)


def parse_project(text: str, where: str) -> Project:
    """Parses a `project.toml`.

    Raises:
        DataError: it is no such file; says what is wrong with it.
    """
    try:
        project: Project = build_instance(Project, parse_toml(text))
        _check_project(project)
        return project
    except (ValueError, DataError) as error:
        raise DataError(
            f"{where}: {error}; expected a file that `modeler studio` wrote; mend it, or move it "
            "away to begin anew beside the same files"
        ) from None


def _check_project(project: Project) -> None:
    """Refuses values that no studio writes: names that are options or lead out, other numbers.

    Raises:
        DataError: names the first.
    """
    for name in ("mapping", "without"):
        check_values(name, getattr(project, name))
    for log in project.logs:
        check_values("file", (log.file,))
    for step in project.steps:
        build_command_line(step, project.steps)
        if not 0 <= step.parent < 1e9 or not 0 < step.number < 1e9:
            raise DataError(f"step {step.number}: got such a number; expected 1 to 999999999")
    if len({step.number for step in project.steps}) < len(project.steps):
        raise DataError("steps: two have the same number; expected each number once")
    making = [step.number for step in project.steps if step.verb in MAKING]
    if project.current not in (0, *making):
        raise DataError(f"current: got {project.current}; expected a step that made a model, or 0")


class Workspace:
    """A project folder in use.

    Attributes:
        folder: of the project.
        project: as it is now.
        writable: False where somebody else has the folder open.
        foreign: True of a project that no studio of this user wrote as it is now; it is only read.
    """

    def __init__(self, folder: Path, writable: bool = True) -> None:
        """Opens the folder; makes it if it is not there.

        Raises:
            DataError: its `project.toml` cannot be read.
            ModelerError: the folder cannot be made.
        """
        self.folder, self.writable = folder, writable
        self.foreign = False
        self.project = Project()
        self.reload_project()
        self.foreign = (folder / FILE).exists() and not self._is_own_project()

    @property
    def can_change(self) -> bool:
        """Returns True if the project can be changed here."""
        return self.writable and not self.foreign

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
        if self.foreign:
            raise DataError(FOREIGN.format(self.folder))
        text = format_project(project)
        write_atomically(self.folder / FILE, f"{_SEAL}{_compute_seal(text)}\n{text}")
        self.project = project

    def accept(self) -> None:
        """Accepts a foreign project as one of this user.

        Raises:
            ModelerError: as `save`.
        """
        self.foreign = False
        try:
            self.save(self.project)
        except ModelerError:
            self.foreign = True
            raise

    def reload_project(self) -> None:
        """Reads the file again, where another process writes it.

        Raises:
            DataError: it cannot be read.
        """
        place = self.folder / FILE
        if os.path.lexists(place):
            self.project = parse_project(self._read_text(), str(place))

    def _read_text(self) -> str:
        place = self.folder / FILE
        try:
            return read_text(place)
        except UnicodeDecodeError as error:
            why = f"is not valid UTF-8 (byte {error.start + 1})"
        except OSError as error:
            why = f"cannot be read ({error.strerror})"
        raise DataError(f"{place}: {why}; put the file back, or move it away to begin anew")

    def _is_own_project(self) -> bool:
        head, _, text = self._read_text().partition("\n")
        return hmac.compare_digest(head.encode(), (_SEAL + _compute_seal(text)).encode())


FOREIGN = (
    "{}: the project was made by another user or on another machine, or project.toml was changed "
    "by hand; look at it, and accept it to go on"
)
_KEY = 32  # bytes
_SEAL = "# seal of the user who wrote this file: "


def _compute_seal(text: str) -> str:
    """What only this user's studio can write above a text, with a key that lies in the cache."""
    place = find_cache_folder() / "studio.key"
    with contextlib.suppress(OSError):
        place.parent.mkdir(parents=True, exist_ok=True)
        descriptor = os.open(place, os.O_CREAT | os.O_EXCL | os.O_WRONLY, 0o600)
        os.write(descriptor, secrets.token_bytes(_KEY))
        os.close(descriptor)
    key = b""
    with contextlib.suppress(OSError):
        key = place.read_bytes()
    if len(key) != _KEY:  # without one no project is known again
        key = secrets.token_bytes(_KEY)
    return hmac.new(key, text.encode(), "sha256").hexdigest()
