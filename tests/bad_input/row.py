"""A row of the table: what is made, what is run, and how it must end."""

import dataclasses
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal

from tests.bad_input.workdir import Workdir

Outcome = Literal["refused", "told", "works", "ends"]
"""refused: status 1 or 2 and one clear line; reported: done, and the warning is named; works: as if
nothing were odd; ends: refused or works, where only a size decides which."""

Make = Callable[[Workdir], object]


@dataclass(frozen=True)
class Result:
    """How a run ended.

    Attributes:
        status: exit status; of a call from Python 1 for a `ModelerError`, 0 for none.
        out, err: what was printed; of a call from Python, err is the message.
        broke: what else came out: a traceback, a warning, a hang; "" for nothing.
        workdir: where it ran.
    """

    status: int
    out: str
    err: str
    broke: str
    workdir: Workdir


@dataclass(frozen=True)
class Process:
    """A run in a process of its own.

    Attributes:
        env: variables that are set; None: taken away.
        file_limit: largest file in bytes that it may write, as on a disk that is full.
        seconds: in which it must end.
        slow: takes many seconds.
    """

    env: Mapping[str, str | None] = field(default_factory=dict)
    file_limit: int | None = None
    seconds: float = 60.0
    slow: bool = False

    @property
    def anew(self) -> bool:
        """Whether Python itself must start: it, not the program, reads what is set."""
        return any(name.startswith("PYTHON") for name in self.env)


@dataclass(frozen=True)
class Row:
    """One bad or odd input.

    Attributes:
        id: theme and what is wrong, in a few words.
        run: the words of the command in the folder where `make` was, or a function for Python.
        outcome: what must come of it.
        words: pieces that the line or the output must hold, any case; "a|b" is either.
        make: makes the input in the workdir.
        check: of what was written; an assertion says what is wrong.
        process: run in a process of its own; None: in this one.
        beside: files besides those that the command names as outputs that it may write.
        alone: it runs code that no other test runs, so that it never rests.
    """

    id: str
    run: tuple[str, ...] | Callable[[Workdir], object]
    outcome: Outcome
    words: tuple[str, ...] = ()
    make: Make | None = None
    check: Callable[[Result], None] | None = None
    process: Process | None = None
    beside: tuple[str, ...] = ()
    alone: bool = False

    @property
    def theme(self) -> str:
        """What stands before the colon of the id."""
        return self.id.partition(":")[0]

    @property
    def command(self) -> str:
        """The command as a user types it."""
        return " ".join(self.run) if isinstance(self.run, tuple) else "from Python"


def split(command: str | tuple[str, ...]) -> tuple[str, ...]:
    """Words of a command; a tuple where a word holds spaces."""
    return tuple(command.split(" ")) if isinstance(command, str) else command


def row(id, outcome, run, *words, make=None, **more):
    """A row; the command as one text."""
    command = run if callable(run) else split(run)
    return dataclasses.replace(Row(id, command, outcome, words, make), **more)  # type: ignore


def missing_words(words: tuple[str, ...], text: str) -> list[str]:
    """Those of `words` that the text lacks."""
    text = re.sub(r"\s+", " ", text).lower()
    return [word for word in words if not any(piece.lower() in text for piece in word.split("|"))]
