"""What every command shares: results on stdout, JSON for machines, progress on stderr, pages."""

import argparse
import contextlib
import io
import json
import os
import platform
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Any

from modeler import __version__
from modeler.cli.places import OutputFolder
from modeler.cli.thresholds import THRESHOLDS
from modeler.core.errors import ModelerError, flatten_message
from modeler.core.files import DestinationKind, resolve_destination, write_atomically

if TYPE_CHECKING:
    from modeler.core.figure import Picture
    from modeler.views import Page
from contextlib import suppress

from modeler.cli.places import DemoFolder, FilePlace, Output

# How much is reported beside the results: `--quiet` and `--verbose`.


class Verbosity(Enum):
    """What goes to stderr: errors alone; notes and, on a terminal, progress; every step."""

    QUIET = "quiet"
    NORMAL = "usual"
    VERBOSE = "verbose"


_LOUDNESS: ContextVar[Verbosity] = ContextVar("loudness", default=Verbosity.NORMAL)

_FOR_PROGRAMS: ContextVar[bool] = ContextVar("for programs", default=False)
"""Whether progress is reported in lines for programs, in place of a bar: `--progress lines`."""


_PACKAGES = [
    "numpy",
    "scipy",
    "sympy",
    "python-flint",
    "casadi",
    "cffi",
    "pyarrow",
    "matplotlib",
    "rich",
]


def get_verbosity() -> Verbosity:
    """Returns the verbosity of the command that runs."""
    return _LOUDNESS.get()


@contextmanager
def apply_verbosity(verbosity: Verbosity, for_programs: bool = False) -> Iterator[None]:
    """Sets the verbosity inside a context; warnings of libraries follow it.

    Args:
        verbosity: how much.
        for_programs: True: progress as lines, even where little is reported.
    """
    import warnings

    before = _LOUDNESS.set(verbosity)
    lines = _FOR_PROGRAMS.set(for_programs)
    try:
        with warnings.catch_warnings():
            if verbosity is Verbosity.QUIET:
                warnings.simplefilter("ignore")
            elif verbosity is Verbosity.VERBOSE:
                warnings.simplefilter("default")
            yield
    finally:
        _FOR_PROGRAMS.reset(lines)
        _LOUDNESS.reset(before)


@contextmanager
def announce_step(title: str) -> Iterator[None]:
    """Prints a step with its seconds if the verbosity is verbose."""
    if get_verbosity() is not Verbosity.VERBOSE:
        yield
        return
    start_time = time.perf_counter()
    print_error(f"{title} ...")
    how = "stopped"
    try:
        yield
        how = "done"
    finally:
        print_error(f"{title}: {how} after {time.perf_counter() - start_time:.2f} s")


@contextmanager
def show_clock(title: str) -> Iterator[None]:
    """Shows title and seconds on a terminal while the progress bar is being loaded."""
    stream = sys.stderr
    if _FOR_PROGRAMS.get():
        _write_progress_line(title, None)
        yield
        return
    if get_verbosity() is Verbosity.QUIET or stream is None or not stream.isatty():
        yield
        return
    import threading

    ended = threading.Event()

    def show_seconds() -> None:
        start_time = time.perf_counter()
        while not ended.wait(THRESHOLDS.clock_interval):
            _write_stderr(f"\r{title} {time.perf_counter() - start_time:.1f} s")
        _write_stderr(f"\r{' ' * (len(title) + 12)}\r")  # a console that knows no codes can do that

    ticking = threading.Thread(target=show_seconds, daemon=True)
    ticking.start()
    try:
        yield
    finally:
        ended.set()
        ticking.join()


def show_start(words: Sequence[str]) -> None:
    """Prints the command as it was read, and the versions, if verbose."""
    if get_verbosity() is not Verbosity.VERBOSE:
        return
    from importlib.metadata import PackageNotFoundError, version

    versions = [
        f"modeler {__version__}",
        f"Python {platform.python_version()}",
        platform.platform(),
    ]
    for name in _PACKAGES:
        with contextlib.suppress(PackageNotFoundError):
            versions.append(f"{name} {version(name)}")
    print_error(f"words: {' '.join(words)}")
    print_error(", ".join(versions))


def show_traceback() -> None:
    """Prints the traceback of the current error, if verbose."""
    if get_verbosity() is Verbosity.VERBOSE:
        import traceback

        _write_stderr(traceback.format_exc())


def _write_stderr(text: str) -> None:
    with contextlib.suppress(OSError, ValueError):
        if sys.stderr is not None:
            sys.stderr.write(text)
            sys.stderr.flush()


_SHOWN: ContextVar[bool] = ContextVar("shown", default=False)
"""Whether a bar is on the terminal: work inside work adds none."""

Json = Any
"""What a command returns for `--json`: dicts, lists, texts, numbers."""


def print_result(text: str = "") -> None:
    """Prints one result on stdout."""
    write_stdout(f"{text}\n")


def print_lines(lines: Iterable[str], before: str = "") -> None:
    """Prints results line by line, each with the same prefix."""
    for line in lines:
        print_result(before + line)


def show_next(commands: Sequence[str]) -> None:
    """Prints the suggested next command as the last line."""
    print_lines(commands[:1], "next: ")


def draw_page(place: str | None, page: "Callable[[], Page]") -> None:
    """Writes the page of a result, if a place for it is given."""
    if place is not None:
        from modeler.views import write_page  # pages take long to load

        with show_activity("drawing the page"):
            written = write_page(Path(place), page())
        print_result(f"written: {written}")


def draw_result(args: argparse.Namespace, build_page: "Callable[[], Page]") -> None:
    """Writes the page of a result and its pictures, as far as places for them are given."""
    if args.report is not None or args.picture is not None:
        with show_activity("drawing"):
            page = build_page()
        draw_page(args.report, lambda: page)
        draw_pictures(args.picture, page.collect_pictures)


def draw_pictures(place: str | None, pictures: "Callable[[], Sequence[Picture]]") -> None:
    """Writes pictures and their numbers, if a place for them is given."""
    if place is not None:
        print_result(f"written: {write_pictures(place, pictures())}")


def write_pictures(place: str, pictures: "Sequence[Picture]") -> str:
    """Writes pictures into a folder, or as plain data into a file; says where they are."""
    if not isinstance(place, OutputFolder):
        from modeler.core.figure import format_pictures

        write_atomically(Path(place), format_pictures(pictures))
        return place
    from modeler.views import write_files

    with show_progress("drawing pictures") as bar:
        written = write_files(Path(place), pictures, bar)
    return f"{len(written)} files in {place}"


def write_stdout(text: str) -> None:
    """Writes text to stdout; nothing if stdout was closed before the start.

    Raises:
        ModelerError: it cannot be written, as on a full disk.
        BrokenPipeError: its reader has gone.
    """
    with _convert_stdout_errors():
        if sys.stdout is not None:
            sys.stdout.write(text)


def flush_stdout() -> None:
    """Writes what is held back; after an error, that is dropped, so that it is reported once.

    Raises:
        ModelerError: it cannot be written, as on a full disk.
        BrokenPipeError: its reader has gone.
    """
    try:
        with _convert_stdout_errors():
            if sys.stdout is not None:
                sys.stdout.flush()
    except (ModelerError, BrokenPipeError):
        with contextlib.suppress(OSError, ValueError):  # ValueError: a stream without a number
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, sys.stdout.fileno())
            os.close(nowhere)
        raise


def print_error(text: str) -> None:
    """Prints one line on stderr."""
    _write_stderr(f"modeler: {text}\n")


def print_note(text: str) -> None:
    """Prints a note on stderr; none with --quiet."""
    if get_verbosity() is not Verbosity.QUIET:
        print_error(text)


def escape_unprintable() -> None:
    """Shows characters that the terminal cannot encode as their codes."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


@contextmanager
def _convert_stdout_errors() -> Iterator[None]:
    try:
        yield
    except BrokenPipeError:
        raise
    except OSError as error:
        raise ModelerError(
            f"stdout: cannot be written ({error.strerror or error}); choose another place for it"
        ) from error


def run_command(args: argparse.Namespace, run: Callable[[argparse.Namespace], Json]) -> None:
    """Runs the command of `args` and writes its result to the file of `--json`.

    `args.after`, if the command set one, judges the result when all is written. A command that goes
    on after its result gives that to `args.tell` itself, and returns None.

    "-" is stdout, and so is /dev/stdout; it then carries the JSON alone.
    """
    alone = args.json is not None and _is_stdout(args.json)
    stdout = sys.stdout

    def write_result(content: Json) -> None:
        if args.json is None:
            return
        from modeler.core.json import convert_to_plain  # it reads TOML too, which help need not

        document = add_schema(args.command, convert_to_plain(content))
        text = json.dumps(document, indent=1, allow_nan=False) + "\n"
        if alone:
            with contextlib.redirect_stdout(stdout):
                write_stdout(text)
                flush_stdout()
        else:
            write_atomically(Path(args.json), text)

    args.tell = write_result
    with contextlib.redirect_stdout(io.StringIO()) if alone else contextlib.nullcontext():
        content = run(args)
    if content is not None:
        write_result(content)
    if hasattr(args, "after"):
        args.after(args)


SCHEMA = 1
"""Version of what `--json` writes; entries may come, a name that changes makes another version."""


def add_schema(command: str, content: Json) -> Json:
    """Adds the identifier of its schema to an object."""
    if not isinstance(content, dict):
        return content
    return {"schema": f"urn:modeler:schema:{command}:{SCHEMA}", **content}


def _is_stdout(place: str) -> bool:
    """True of "-", and of every name of the open file that stdout is."""
    if place == "-":
        return True
    try:
        target = resolve_destination(Path(place))
        return (
            target.kind is DestinationKind.DESCRIPTOR and target.descriptor == sys.stdout.fileno()
        )
    except (AttributeError, OSError, ValueError, ModelerError):
        return False


@contextmanager
def show_progress(title: str) -> Iterator[Callable[[float], None]]:
    """Shows a progress bar on a terminal; yields the function that takes the share done."""
    with announce_step(title), _show_bar(title, 1.0) as tell:
        yield tell


@contextmanager
def show_activity(title: str) -> Iterator[None]:
    """Shows a bar without share, and the elapsed time, on a terminal."""
    with announce_step(title), _show_bar(title, None):
        yield


@contextmanager
def _show_bar(title: str, total: float | None) -> Iterator[Callable[[float], None]]:
    """A bar on a terminal; it moves to and fro where nobody knows the share."""
    hidden = get_verbosity() is Verbosity.QUIET or _SHOWN.get()
    if _FOR_PROGRAMS.get() and not _SHOWN.get():
        with _show_progress_lines(title, total) as tell:
            yield tell
        return
    if hidden or sys.stderr is None or not sys.stderr.isatty():
        yield lambda share: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description}", markup=False), BarColumn(), TimeElapsedColumn())
    before = _SHOWN.set(True)
    try:
        with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
            task = bar.add_task(title, total=total)
            yield lambda share: bar.update(task, completed=share)
    finally:
        _SHOWN.reset(before)


@contextmanager
def _show_progress_lines(title: str, total: float | None) -> Iterator[Callable[[float], None]]:
    """The same in lines: one at the beginning, then one where there is another percent to show."""
    last_shown = [time.monotonic(), 0.0]

    def show_share(share: float) -> None:
        now = time.monotonic()
        if share >= last_shown[1] + 0.01 and now >= last_shown[0] + THRESHOLDS.progress_interval:
            last_shown[:] = now, share
            _write_progress_line(title, share)

    before = _SHOWN.set(True)
    try:
        _write_progress_line(title, None if total is None else 0.0)
        yield show_share
    finally:
        _SHOWN.reset(before)


def _write_progress_line(title: str, share: float | None) -> None:
    _write_stderr(
        f"progress {'-' if share is None else f'{min(share, 1.0):.2f}'} {flatten_message(title)}\n"
    )


# The page of `--open`, shown in the browser.


@contextmanager
def open_page_when_done(args: argparse.Namespace) -> Iterator[None]:
    """Opens the page of `--open` in the browser when the command is done.

    A page that has no place gets one in a temporary folder, which stays if the command is done.
    """
    args.page_is_temporary = False
    if vars(args).get("open") and "report" in args and args.report is None:
        import tempfile  # these are loaded where they are wanted

        folder = tempfile.mkdtemp(prefix="modeler-")
        args.report = Output(Path(folder) / f"{args.command}.html")
        args.page_is_temporary = True
    try:
        yield
    except BaseException:
        discard_page(args)
        raise
    _show_page(args)


def discard_page(args: argparse.Namespace) -> None:
    """Removes the temporary page when the command writes none."""
    if args.page_is_temporary:
        with suppress(OSError):  # not empty: the page was written
            Path(args.report).parent.rmdir()
        args.report, args.open = None, False


def _show_page(args: argparse.Namespace) -> None:
    """One line where there is no browser, or no page."""
    if not vars(args).get("open"):
        return
    import webbrowser

    page = _locate_page(vars(args).get("report") or args.out)
    if not page.is_file():
        print_note("--open: no page was written, so none is shown")
    elif not webbrowser.open(page.resolve().as_uri()):
        print_note(f"--open: no browser was found; open {page} in one")


def _locate_page(place: str) -> Path:
    if isinstance(place, DemoFolder):
        return Path(place) / "index.html"
    return place.file if isinstance(place, FilePlace) else Path(place)
