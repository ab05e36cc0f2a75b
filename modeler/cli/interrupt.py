"""What Ctrl-C does: it ends the program with one line and status 130, whatever it was doing.

While modules load, an exception is not enough: some of what is loaded swallows it, or turns it into
another. Nothing is written then, so the program just ends. While a command runs, it is an
exception, so that what is half done can be cleaned up.
"""

import contextlib
import os
import signal
from collections.abc import Iterator
from types import FrameType

INTERRUPTED = 130
"""Exit status, as of a shell: 128 + SIGINT."""


@contextlib.contextmanager
def loading() -> Iterator[None]:
    """While this lasts, an interrupt ends the program at once; nothing may be half done."""
    before = signal.getsignal(signal.SIGINT)
    if before is not signal.default_int_handler:  # ignored, or somebody else's
        yield
        return
    signal.signal(signal.SIGINT, _end)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def ending() -> None:
    """All is done or given up; another interrupt can only spoil how it is told."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


def _end(number: int, frame: FrameType | None) -> None:
    with contextlib.suppress(OSError):
        os.write(2, b"modeler: interrupted\n")
    os._exit(INTERRUPTED)
