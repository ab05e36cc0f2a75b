"""A file that must stay as it is while it is read."""

from pathlib import Path

from modeler.core.errors import DataError

State = tuple[int, int]
"""Bytes of a file, and when it was last written to."""


def state_of(path: Path) -> State:
    """Of a file that is there."""
    state = path.stat()
    return state.st_size, state.st_mtime_ns


def check_unchanged(path: Path, before: State) -> None:
    """A file that is written while it is read has no one content.

    Raises:
        DataError: it is another than before.
    """
    try:
        now = state_of(path)
    except OSError as error:
        raise DataError(
            f"{path}: went away while it was read ({error.strerror}); expected it to stay; run "
            "this again"
        ) from None
    if now != before:
        raise DataError(
            f"{path}: was written to while it was read ({before[0]} bytes, now {now[0]}); expected "
            "a log that is complete; wait until it is, and run this again"
        )
