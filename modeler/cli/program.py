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


def run_program(words: Sequence[str]) -> int:
    """Runs as a program: encoding, interrupts and exit belong to this process."""
    with exit_on_interrupt():
        from modeler.cli.console import escape_unprintable
    escape_unprintable()
    # Symbols are many small objects: looking for rings among them every 700 took a tenth of a run.
    gc.set_threshold(20_000)
    _retain_freed_memory()
    try:
        return _run_words(words, exit_on_interrupt)
    finally:  # all is done or given up; another interrupt can only spoil how it is reported
        if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
            signal.signal(signal.SIGINT, signal.SIG_IGN)


def _retain_freed_memory() -> None:
    """Lets the C library reuse freed arrays: fresh pages took a fifth of the time of `diagnose`.

    All threads share one heap, as in `mallopt(3)`; other C libraries know no such option.
    """
    import ctypes

    set_option = getattr(ctypes.pythonapi, "mallopt", None)
    if set_option is not None:
        for option, value in _HEAP_OPTIONS.items():
            set_option(option, value)


_HEAP_OPTIONS = {-8: 1, -3: 2**24, -1: 2**26}
"""Of `malloc.h`: M_ARENA_MAX, then M_MMAP_THRESHOLD and M_TRIM_THRESHOLD, bytes."""


def run_in_process(words: Sequence[str]) -> int:
    """Runs a command from Python, in the process of the caller."""
    return _run_words(words, nullcontext)


def _run_words(words: Sequence[str], phase: Phase) -> int:
    with phase():
        from modeler.cli.console import flush_stdout, print_error
        from modeler.core.errors import ModelerError, flatten_message, is_out_of_memory

    try:
        try:
            _run_parsed(words, phase)
        finally:
            flush_stdout()
    except ModelerError as error:
        print_error(flatten_message(str(error)))
        return 1
    except BrokenPipeError:
        return 0  # the reader of our output has gone (`modeler ... | head`): nothing is wrong
    except OSError as error:  # what the system refuses of a path, wherever it is first looked at
        if error.filename is None or is_out_of_memory(error):
            raise
        print_error(
            flatten_message(f"{error.filename}: cannot be used ({error.strerror}); check the path")
        )
        return 1
    except KeyboardInterrupt:
        print_error("interrupted")
        return INTERRUPTED
    return 0


def _run_parsed(words: Sequence[str], phase: Phase) -> None:
    with phase():
        from modeler.cli.console import Verbosity, apply_verbosity, show_start, show_traceback
        from modeler.cli.parser import parse_words
        from modeler.core.errors import ModelerError
        from modeler.core.options import OptionError

        args, verbosity = parse_words(words)
    with apply_verbosity(verbosity, args.progress == "lines"):
        try:
            show_start(words)
            _execute_command(args, phase, verbosity is Verbosity.VERBOSE)
        except OptionError as error:
            show_traceback()
            raise ModelerError(error.format_line(lambda name: args.option_words[name])) from error
        except ModelerError:
            show_traceback()
            raise


def _execute_command(args: "argparse.Namespace", phase: Phase, every_line: bool) -> None:
    with phase():
        from modeler.cli.console import announce_step, open_page_when_done, run_command, show_clock
        from modeler.cli.places import check_places
        from modeler.core.options import check_together

    with open_page_when_done(args):
        check_places(args)
        check_together(vars(args), args.rules)
        with phase(), announce_step("loading"), show_clock("loading"):
            import logging

            # Where it may keep no list of fonts it says so in its own lines; pictures are the same.
            if not every_line:
                logging.getLogger("matplotlib").setLevel(logging.ERROR)
            run = args.load()
        with announce_step(args.command):
            run_command(args, run)


@contextlib.contextmanager
def exit_on_interrupt() -> Iterator[None]:
    """Exits at once on an interrupt inside the context."""
    before = signal.getsignal(signal.SIGINT)
    if before is not signal.default_int_handler:  # ignored, or somebody else's
        yield
        return
    signal.signal(signal.SIGINT, _exit_interrupted)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def _exit_interrupted(number: int, frame: FrameType | None) -> None:
    with contextlib.suppress(OSError):
        os.write(2, b"modeler: interrupted\n")
    os._exit(INTERRUPTED)
