"""One run of the command line: what is typed, what is loaded, what is done, how it ends.

Ctrl-C ends the program with one line and status 130, whatever it was doing. While modules load, an
exception is not enough: some of what is loaded swallows it, or turns it into another. Nothing is
written then, so the program just ends. While a command runs, it is an exception, so that what is
half done can be cleaned up.
"""

import contextlib
import gc
import os
import signal
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from types import FrameType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse

INTERRUPTED = 130
"""Exit status, as of a shell: 128 + SIGINT."""

Phase = Callable[[], AbstractContextManager[None]]


def started(words: Sequence[str]) -> int:
    """As a program: letters, interrupts and the end of the process are ours."""
    with loading():
        from modeler.cli.console import escape_unprintable
    escape_unprintable()
    # Symbols are many small objects: looking for rings among them every 700 took a tenth of a run.
    gc.set_threshold(20_000)
    try:
        return _run(words, loading)
    finally:  # all is done or given up; another interrupt can only spoil how it is told
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            signal.signal(signal.SIGINT, signal.SIG_IGN)


def called(words: Sequence[str]) -> int:
    """From Python: the process belongs to the caller."""
    return _run(words, nullcontext)


def _run(words: Sequence[str], phase: Phase) -> int:
    with phase():
        from modeler.cli.console import flush_stdout, print_error
        from modeler.core.errors import ModelerError, on_one_line, short_of_memory

    try:
        try:
            _answer(words, phase)
        finally:
            flush_stdout()
    except ModelerError as error:
        print_error(on_one_line(str(error)))
        return 1
    except BrokenPipeError:
        return 0  # the reader of our output has gone (`modeler ... | head`): nothing is wrong
    except OSError as error:  # what the system refuses of a path, wherever it is first looked at
        if error.filename is None or short_of_memory(error):
            raise
        print_error(
            on_one_line(f"{error.filename}: cannot be used ({error.strerror}); check the path")
        )
        return 1
    except KeyboardInterrupt:
        print_error("interrupted")
        return INTERRUPTED
    return 0


def _answer(words: Sequence[str], phase: Phase) -> None:
    with phase():
        from modeler.cli.commands import parsed
        from modeler.cli.console import Loudness, show_start, show_traceback, using_loudness
        from modeler.core.errors import ModelerError

        args, wanted = parsed(words)
    with using_loudness(wanted, args.progress == "lines"):
        try:
            show_start(words)
            _carried_out(args, phase, wanted is Loudness.VERBOSE)
        except ModelerError:
            show_traceback()
            raise


def _carried_out(args: "argparse.Namespace", phase: Phase, every_line: bool) -> None:
    with phase():
        from modeler.cli.browser import opened_page
        from modeler.cli.console import clock, run_command, step
        from modeler.cli.places import check_places

    with opened_page(args):
        check_places(args)
        with phase(), step("loading"), clock("loading"):
            import logging

            # Where it may keep no list of fonts it says so in its own lines; pictures are the same.
            if not every_line:
                logging.getLogger("matplotlib").setLevel(logging.ERROR)
            run = args.load()
        with step(args.command):
            run_command(args, run)


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


def _end(number: int, frame: FrameType | None) -> None:
    with contextlib.suppress(OSError):
        os.write(2, b"modeler: interrupted\n")
    os._exit(INTERRUPTED)
