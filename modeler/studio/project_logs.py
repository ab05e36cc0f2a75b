"""What is known of the logs of a project: columns, times, whose column is which, what was said."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from modeler.core.errors import ModelerError
from modeler.core.files import read_text
from modeler.core.json import entries
from modeler.core.manifest import JointSpec
from modeler.logs import map_from_words
from modeler.studio.log_mapping import Choice, LogGuess, anybody, choices, said, words_of
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

    def path(self, file: str) -> str:
        """Of a file of the project, wherever it lies."""
        return str(self.studio.folder / file)

    async def learn(self, file: str) -> None:
        """Looks at the columns of a log."""
        robot, place = self.studio.project.robot, self.path(file)
        try:
            guess = await self.studio.view("log_guess", place, robot and self.path(robot))
            self.logs[file] = KnownLog(guess, size=Path(place).stat().st_size)
            if not robot:
                self.joints = anybody(max(len(self.joints), guess.joints))
        except (ModelerError, OSError) as error:
            self.logs[file] = KnownLog(error=str(error))

    async def read(self, file: str) -> None:
        """Reads its time, as the mapping says it."""
        known = self.logs[file]
        if known.guess is None:
            return
        try:
            time = self.chosen(known.guess).get("time", Choice("time"))
            own = words_of({"time": time}, {"time": Choice("time")}, self.joints)
            kept = (word for word in self.studio.project.mapping if word.startswith(_SETTINGS))
            clock = (*kept, *own) if time.column in known.guess.columns else tuple(kept)
            facts = await self.studio.view("log_facts", self.path(file), clock)
            found = {"ends": (facts.start, facts.end), **entries(facts, "rows units")}
            self.logs[file] = replace(known, clock=clock, **found)
        except ModelerError as error:
            self.logs[file] = KnownLog(error=str(error))

    def kept(self, guess: LogGuess) -> tuple[str, ...]:
        """Words of the mapping that are about no column, or about one of other logs."""
        words = self.studio.project.mapping
        said = {word: map_from_words([word]).entries(self.joints).values() for word in words}
        far = [
            w for w, own in said.items() if not any({*e.columns} & {*guess.columns} for e in own)
        ]
        return tuple(w for w in far if AUTO in words or w.startswith(_SETTINGS))

    def guess(self, file: str) -> LogGuess:
        """Of a log that can be read."""
        guess = self.logs[file].guess
        assert guess is not None
        return guess

    def chosen(self, guess: LogGuess) -> dict[str, Choice]:
        """What the columns of a log are taken as."""
        words = self.studio.project.mapping
        found = self._choices(words, guess)
        if AUTO not in words:
            return found
        there = map_from_words(words).entries(self.joints)  # those of other logs stay out
        own = {name for name, entry in there.items() if {*entry.columns} & {*guess.columns}}
        return self.under(guess) | {name: found[name] for name in own}

    def under(self, guess: LogGuess) -> dict[str, Choice]:
        """The same without words about columns."""
        found = self._choices((), guess)
        return {**found, **(guess.choices if AUTO in self.studio.project.mapping else {})}

    def _choices(self, words: tuple[str, ...], guess: LogGuess) -> dict[str, Choice]:
        names = said(words, self.stated, self.studio.project.robot)
        return choices(names, self.joints, guess.columns)

    def guessed(self, guess: LogGuess) -> tuple[str, ...]:
        """Words of what a log looks like."""
        under = self._choices((), guess)
        topic = (f"topic={guess.topic}",) if guess.topic else ()
        return (*topic, *words_of({**under, **guess.choices}, under, self.joints))

    def is_guess(self, guess: LogGuess) -> bool:
        """Whether a log is taken as what it looks like."""
        own = self.studio.project.mapping in ((AUTO,), self.guessed(guess))
        return own and bool(guess.choices)

    def guess_each(self) -> None:
        """Every log by its own guess, below what was chosen."""
        chosen = self.studio.project.mapping if self.studio.project.mapped else ()
        words = (AUTO, *(word for word in chosen if word != AUTO))
        self.studio.change(redraw=True, mapping=words)

    def log(self, file: str) -> ProjectLog:
        """As the project has it."""
        return next(log for log in self.studio.project.logs if log.file == file)

    def checked(self, file: str) -> Step | None:
        """The last look at a log."""
        steps = self.studio.project.steps
        return next((s for s in reversed(steps) if s.verb == "log" and s.task.file == file), None)

    def result(self, file: str) -> dict[str, Any]:
        """What it said; nothing before there is one."""
        step = self.checked(file)
        try:
            return dict(json.loads(read_text(self.studio.folder / step.result))) if step else {}
        except (OSError, ValueError):
            return {}
