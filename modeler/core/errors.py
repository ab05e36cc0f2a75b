"""The errors a user may see, one line each; the choices that commands name; windows of a log."""

from pathlib import Path
from typing import Literal, get_args

LONGEST = 1000
"""Characters of a line that somebody still reads."""


class ModelerError(Exception):
    """The input is at fault; the command line prints the message and ends with status 1."""


class RobotError(ModelerError):
    """A robot description is wrong: file, row and column, what was got, what was expected."""


class DataError(ModelerError):
    """A log is wrong or cannot tell what was asked: file, column, row."""


class ShapeError(ModelerError):
    """An array argument has the wrong shape."""


class DerivationError(ModelerError):
    """The model cannot be derived as asked."""


class EmitError(ModelerError):
    """An expression has no C99 form."""


class BuildError(ModelerError):
    """The C compiler is missing or refused the emitted code; its own words are quoted."""


class ManifestError(ModelerError):
    """A manifest, model file or compiled library does not say what it should."""


class LoopError(ModelerError):
    """A kinematic loop leaves too much or too little free, is singular, or cannot close."""


class SolutionError(ModelerError):
    """Equations have no solution: an inertia that is not positive, a singular posture."""


class FitWarning(UserWarning):
    """A model is returned whose fit is not usable; Python shows it once for each line of code."""


def suggest_install(part: str) -> str:
    """What installs an optional part; what is imported as modeler is installed by another name."""
    return f'pip install "modeler-robotics[{part}]"'


_SHORT_OF_MEMORY = (
    "failed to map segment", "Cannot allocate memory", "start new thread", "launch worker thread",
)  # fmt: skip


def is_out_of_memory(error: BaseException) -> bool:
    """True where memory ran out, in whatever words the system or a library says so."""
    return isinstance(error, MemoryError) or any(w in str(error) for w in _SHORT_OF_MEMORY)


def flatten_message(message: str) -> str:
    """The message as one line: line ends, other control characters and what is endless made short.

    A name of a file may hold anything, and a compiler's own words are many lines.
    """
    lines = [line.strip() for line in message.splitlines()]
    text = " ".join(line for line in lines if line)
    text = "".join(c if c.isprintable() else "?" for c in text)
    if len(text) <= LONGEST:
        return text
    return f"{text[: LONGEST // 2]} ... {text[-LONGEST // 2 :]}"


# Choices that a user is offered, where parsers and the stages that make them both can look.


Method = Literal[
    "weighted", "ordinary", "robust", "ridge", "iv", "iv-direct", "didim", "didim-robust",
    "consistent", "iv-consistent", "iv-direct-consistent", "didim-consistent",
]  # fmt: skip
"""Estimators; `core.estimators` says what each is."""

ModelKind = Literal["torque", "energy"]
"""What a row of the fit states: a joint's torque, or the energy balance of a window."""

Precision = Literal["double", "single"]
"""Of the emitted C: its numbers are `double`, or `float`."""

Also = Literal["vectors", "structured_text", "a2l"]
"""What `generate` adds to a folder if it is asked to."""

ALSO: tuple[Also, ...] = get_args(Also)

Machine = Literal["cortex-m7", "cortex-m4", "host"]
"""What the cost of the emitted C is measured for; host: this machine."""

GAIN_METHOD = "tls"
"""Total least squares, for drive gains besides."""

TWO_STEPS = "two-step"
"""Each joint that moves alone, then the parameters."""

Derivatives = Literal["auto", "log", "position"]
"""Whether velocities are taken from the log or differentiated; auto: the quieter."""

LOW_SPEED = 0.02
"""Rows below this share of a joint's top speed are left out, where friction depends on its sign."""


# A log, or a piece of it, as it is typed: FILE, or FILE@START:END.


def split_time_range(place: str) -> tuple[str, str | None]:
    """The file, and what stands after its last "@"; None if that belongs to the file's name."""
    path, at, time_range = place.rpartition("@")
    return (place, None) if not at or Path(place).exists() else (path, time_range)
