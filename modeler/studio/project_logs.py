"""What is known of the logs of a project: columns, times, whose column is which, what was said."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from modeler.api.front_end import JointSpec, ModelerError, parse_map_options, read_text
from modeler.studio.log_mapping import (
    ColumnChoice,
    LogGuess,
    build_choices,
    build_default_joints,
    build_map_words,
    merge_map,
)
from modeler.studio.project import ProjectLog
from modeler.studio.studio import Studio
from modeler.studio.tasks import Step

AUTO = "auto"
"""The mapping by which each log is taken by its own guess."""

_SETTINGS = ("topic=", "rate=", "names=")


@dataclass(frozen=True)
class KnownLog:
    """A log as far as it could be read; else the line that says why not.

    Attributes:
        guess: of its columns.
        clock: words of `--map` that say what its time is.
        rows: of it.
        ends: first and last time, s.
        units: of its columns, as the viewer answers them.
        size: bytes.
        error: line.
    """

    guess: LogGuess | None = None
    clock: tuple[str, ...] = ()
    rows: int = 0
    ends: tuple[float, float] = (0.0, 1.0)
    units: Mapping[str, str] = field(default_factory=dict)
    size: int = 0
    error: str = ""


class ProjectLogs:
    """The logs of a project.

    Attributes:
        studio: the window.
        joints: of the robot; as many as the logs have positions where there is none yet.
        stated: [log] of the robot file.
        logs: what is known of them, by file.
    """

    def __init__(self, studio: Studio) -> None:
        self.studio = studio
        self.joints: tuple[JointSpec, ...] = ()
        self.stated: Mapping[str, Any] = {}
        self.logs: dict[str, KnownLog] = {}

    def resolve_path(self, file: str) -> str:
        """Returns the absolute path of a file of the project."""
        return str(self.studio.folder / file)

    async def learn_columns(self, file: str) -> None:
        """Looks at the columns of a log."""
        robot, place = self.studio.project.robot, self.resolve_path(file)
        try:
            robot_place = robot and self.resolve_path(robot)
            guess = await self.studio.ask_viewer("log_guess", place, robot_place)
            self.logs[file] = KnownLog(guess, size=Path(place).stat().st_size)
            if not robot:
                self.joints = build_default_joints(max(len(self.joints), guess.joints))
        except (ModelerError, OSError) as error:
            self.logs[file] = KnownLog(error=str(error))

    async def read_time(self, file: str) -> None:
        """Reads the time of a log, as the mapping says it."""
        known = self.logs[file]
        if known.guess is None:
            return
        try:
            plain = ColumnChoice("time")
            time = self.resolve_columns(known.guess).get("time", plain)
            words = build_map_words({"time": time}, {"time": plain}, self.joints)
            clock = tuple(w for w in self.studio.project.mapping if w.startswith(_SETTINGS))
            clock += words if time.column in known.guess.columns else ()
            facts = await self.studio.ask_viewer("log_facts", self.resolve_path(file), clock)
            rows, ends, units = facts.rows, (facts.start, facts.end), facts.units
            self.logs[file] = replace(known, clock=clock, ends=ends, rows=rows, units=units)
        except ModelerError as error:
            self.logs[file] = KnownLog(error=str(error))

    def select_general_words(self, guess: LogGuess) -> tuple[str, ...]:
        """Selects the words of the mapping that name no column of this log."""
        words, far = self.studio.project.mapping, []
        for word in words:
            entries = parse_map_options([word]).expand_entries(self.joints).values()
            if not any({*entry.columns} & {*guess.columns} for entry in entries):
                far.append(word)
        return tuple(w for w in far if AUTO in words or w.startswith(_SETTINGS))

    def get_guess(self, file: str) -> LogGuess:
        """Returns the guess of a log that can be read."""
        guess = self.logs[file].guess
        assert guess is not None
        return guess

    def resolve_columns(self, guess: LogGuess) -> dict[str, ColumnChoice]:
        """Returns the column of each quantity of a log."""
        words = self.studio.project.mapping
        columns = self._build_choices(words, guess)
        if AUTO not in words:
            return columns
        entries = parse_map_options(words).expand_entries(self.joints)
        # Those of other logs stay out.
        named = {name for name, entry in entries.items() if {*entry.columns} & {*guess.columns}}
        return self.resolve_default_columns(guess) | {name: columns[name] for name in named}

    def resolve_default_columns(self, guess: LogGuess) -> dict[str, ColumnChoice]:
        """Returns the column of each quantity without words of the mapping."""
        columns = self._build_choices((), guess)
        return {**columns, **(guess.choices if AUTO in self.studio.project.mapping else {})}

    def _build_choices(self, words: tuple[str, ...], guess: LogGuess) -> dict[str, ColumnChoice]:
        names = merge_map(words, self.stated, self.studio.project.robot)
        return build_choices(names, self.joints, guess.columns)

    def build_guess_words(self, guess: LogGuess) -> tuple[str, ...]:
        """Builds the mapping words of the guess of a log."""
        under = self._build_choices((), guess)
        topic = (f"topic={guess.topic}",) if guess.topic else ()
        return (*topic, *build_map_words({**under, **guess.choices}, under, self.joints))

    def is_guess(self, guess: LogGuess) -> bool:
        """Returns True if the mapping of a log is its guess."""
        is_same = self.studio.project.mapping in ((AUTO,), self.build_guess_words(guess))
        return is_same and bool(guess.choices)

    def apply_each_guess(self) -> None:
        """Maps every log by its own guess, below the chosen words."""
        chosen = self.studio.project.mapping if self.studio.project.mapped else ()
        words = (AUTO, *(word for word in chosen if word != AUTO))
        self.studio.change_project(redraw=True, mapping=words)

    def get_log(self, file: str) -> ProjectLog:
        """Returns the log as the project has it."""
        return next(log for log in self.studio.project.logs if log.file == file)

    def find_last_inspection(self, file: str) -> Step | None:
        """Finds the last inspection of a log."""
        steps = self.studio.project.steps
        return next((s for s in reversed(steps) if s.verb == "log" and s.task.file == file), None)

    def read_result(self, file: str) -> dict[str, Any]:
        """Reads the result of the last inspection; empty without one."""
        step = self.find_last_inspection(file)
        try:
            text = read_text(self.studio.folder / step.result_file) if step else "{}"
            return dict(json.loads(text))
        except (OSError, ValueError):
            return {}
