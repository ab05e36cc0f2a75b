"""One run of the command line: what is typed, what is loaded, what is done, how it ends."""

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext

from modeler.cli.interrupt import INTERRUPTED, ending, loading

Phase = Callable[[], AbstractContextManager[None]]


def started(words: Sequence[str]) -> int:
    """As a program: letters, interrupts and the end of the process are ours."""
    with loading():
        from modeler.cli.console import show_any_letter
    show_any_letter()
    try:
        return _run(words, loading)
    finally:
        ending()


def called(words: Sequence[str]) -> int:
    """From Python: the process belongs to the caller."""
    return _run(words, nullcontext)


def _run(words: Sequence[str], phase: Phase) -> int:
    with phase():
        from modeler.cli.console import complain, flush_stdout
        from modeler.core.errors import ModelerError, on_one_line

    try:
        try:
            _answer(words, phase)
        finally:
            flush_stdout()
    except ModelerError as error:
        complain(on_one_line(str(error)))
        return 1
    except BrokenPipeError:
        return 0  # the reader of our output has gone (`modeler ... | head`): nothing is wrong
    except KeyboardInterrupt:
        complain("interrupted")
        return INTERRUPTED
    return 0


def _answer(words: Sequence[str], phase: Phase) -> None:
    with phase():
        from modeler.cli.console import run_command
        from modeler.cli.parsers import parser
        from modeler.cli.places import check_places

        args = parser().parse_args(list(words))
    check_places(args)
    with phase():
        import logging

        # Where it may keep no list of fonts it says so in lines of its own; pictures are the same.
        logging.getLogger("matplotlib").setLevel(logging.ERROR)
        run = args.load()
    run_command(args, run)
