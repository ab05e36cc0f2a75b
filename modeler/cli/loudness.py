"""How much is told beside the results: `--quiet` and `--verbose`."""

import contextlib
import platform
import sys
import time
from collections.abc import Iterator, Sequence
from contextvars import ContextVar
from enum import Enum

from modeler import __version__


class Loudness(Enum):
    """What goes to stderr: errors alone; notes and, on a terminal, progress; every step."""

    QUIET = "quiet"
    USUAL = "usual"
    VERBOSE = "verbose"


_LOUDNESS: ContextVar[Loudness] = ContextVar("loudness", default=Loudness.USUAL)

_TICK = 0.5  # s

_PACKAGES = (
    "numpy", "scipy", "sympy", "python-flint", "casadi", "cffi", "pyarrow", "matplotlib", "rich",
)  # fmt: skip


def loudness() -> Loudness:
    """Of the command that runs."""
    return _LOUDNESS.get()


@contextlib.contextmanager
def told(wanted: Loudness) -> Iterator[None]:
    """While this lasts, so much is told; warnings of libraries too."""
    import warnings

    before = _LOUDNESS.set(wanted)
    try:
        with warnings.catch_warnings():
            if wanted is Loudness.QUIET:
                warnings.simplefilter("ignore")
            elif wanted is Loudness.VERBOSE:
                warnings.simplefilter("default")
            yield
    finally:
        _LOUDNESS.reset(before)


@contextlib.contextmanager
def step(title: str) -> Iterator[None]:
    """Told with its seconds, if every step is."""
    if loudness() is not Loudness.VERBOSE:
        yield
        return
    begun = time.perf_counter()
    _line(f"{title} ...")
    how = "stopped"
    try:
        yield
        how = "done"
    finally:
        _line(f"{title}: {how} after {time.perf_counter() - begun:.2f} s")


@contextlib.contextmanager
def clock(title: str) -> Iterator[None]:
    """Title and seconds on a terminal, while what could draw a bar is itself being loaded."""
    stream = sys.stderr
    if loudness() is Loudness.QUIET or stream is None or not stream.isatty():
        yield
        return
    import threading

    ended = threading.Event()

    def tick() -> None:
        begun = time.perf_counter()
        while not ended.wait(_TICK):
            _raw(f"\r{title} {time.perf_counter() - begun:.1f} s")
        _raw("\r\x1b[2K")

    ticking = threading.Thread(target=tick, daemon=True)
    ticking.start()
    try:
        yield
    finally:
        ended.set()
        ticking.join()


def versions() -> list[str]:
    """What runs here: of this program, of Python, and of what it counts with."""
    from importlib.metadata import PackageNotFoundError, version

    found = [f"modeler {__version__}", f"Python {platform.python_version()}", platform.platform()]
    for name in _PACKAGES:
        with contextlib.suppress(PackageNotFoundError):
            found.append(f"{name} {version(name)}")
    return found


def tell_start(words: Sequence[str]) -> None:
    """The command as it was read, and the versions."""
    if loudness() is Loudness.VERBOSE:
        _line(f"words: {' '.join(words)}")
        _line(", ".join(versions()))


def tell_error() -> None:
    """Where the error that is being handled came from."""
    if loudness() is Loudness.VERBOSE:
        import traceback

        _raw(traceback.format_exc())


def _line(text: str) -> None:
    _raw(f"modeler: {text}\n")


def _raw(text: str) -> None:
    with contextlib.suppress(OSError, ValueError):
        if sys.stderr is not None:
            sys.stderr.write(text)
            sys.stderr.flush()
