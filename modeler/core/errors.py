"""The errors a user may see, one line each; windows of a log."""

from pathlib import Path

LONGEST = 1000
"""Characters of a line that somebody still reads."""


class ModelerError(Exception):
    """The input is at fault; the command line prints the message and ends with status 1."""


class RobotError(ModelerError):
    """A robot description is wrong: file, row and column, what was got, what was expected."""


class DataError(ModelerError):
    """A log is wrong or cannot show what was asked: file, column, row."""


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
    """Returns the command that installs an optional part of the package."""
    return f'pip install "modeler-robotics[{part}]"'


_SHORT_OF_MEMORY = (
    "failed to map segment",
    "Cannot allocate memory",
    "start new thread",
    "launch worker thread",
)


def is_out_of_memory(error: BaseException) -> bool:
    """Returns True where memory ran out, in whatever words the system or a library says so."""
    return isinstance(error, MemoryError) or any(w in str(error) for w in _SHORT_OF_MEMORY)


def flatten_message(message: str) -> str:
    """Returns the message as one line: without line ends and control characters, and shortened.

    A name of a file may hold anything, and a compiler's own words are many lines.
    """
    lines = [line.strip() for line in message.splitlines()]
    text = " ".join(line for line in lines if line)
    text = "".join(c if c.isprintable() else "?" for c in text)
    if len(text) <= LONGEST:
        return text
    return f"{text[: LONGEST // 2]} ... {text[-LONGEST // 2 :]}"


# A log, or a piece of it, as it is typed: FILE, or FILE@START:END.


def split_time_range(place: str) -> tuple[str, str | None]:
    """Returns the file, and what stands after its last "@".

    None if that belongs to the file's name.
    """
    path, at, time_range = place.rpartition("@")
    return (place, None) if not at or Path(place).exists() else (path, time_range)
