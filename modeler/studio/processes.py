"""Processes of the studio: commands, one at a time, and the viewer of logs and predictions."""

import asyncio
import contextlib
import multiprocessing
import os
import re
import shlex
import signal
import sys
import sysconfig
import time
from collections import deque
from collections.abc import AsyncIterator, Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from modeler.api.front_end import (
    DataError,
    ModelerError,
    block_interrupts,
    exit_with_parent,
    flatten_message,
    is_out_of_memory,
)
from modeler.studio import places
from modeler.studio.thresholds import THRESHOLDS

_PROGRESS = re.compile(r"progress (-|[\d.]+) (.*)")  # as `--progress lines` writes it
_TOLD = re.compile(r"modeler(?: [\w-]+)?: (.*)")  # a note, an error, a wrong usage
_PIECE = 2**16

INTERRUPTED = 130
"""Status of a command that was cancelled."""


@dataclass(frozen=True)
class Outcome:
    """How a command ended.

    Attributes:
        status: of the process; 0 done, `INTERRUPTED` cancelled.
        error: the line that says why it is not 0; "" where it is.
        lines: of its stdout.
        seconds: that it took.
    """

    status: int
    error: str
    lines: tuple[str, ...]
    seconds: float

    @property
    def is_cancelled(self) -> bool:
        """Returns True if the user cancelled it."""
        return self.status == INTERRUPTED


class RunningCommand:
    """A command that runs from now on, in the loop of events that runs here.

    Args:
        words: after `modeler`, as a shell would be given them.
        folder: in which it runs.
        title: what it is for, in a few words.

    Attributes:
        share: of the work that is done, 0 to 1; None where nobody knows.
        doing: what it does now.
        lines: of its stdout so far.
        started: seconds of `time.monotonic`.
    """

    def __init__(self, words: Sequence[str], folder: Path, title: str) -> None:
        self.words, self.folder, self.title = tuple(words), folder, title
        self.share: float | None = None
        self.doing = "starting"
        self.lines: deque[str] = deque(maxlen=THRESHOLDS.max_output_lines)
        self.started = time.monotonic()
        self._stderr_lines: deque[str] = deque(maxlen=THRESHOLDS.max_output_lines)
        self._cancelled = False
        self._process: asyncio.subprocess.Process | None = None
        self._changed = asyncio.Event()
        self._end = asyncio.create_task(self._execute())

    @property
    def seconds(self) -> float:
        """Returns the seconds since the start."""
        return time.monotonic() - self.started

    async def wait(self, on_progress: Callable[[], None] = lambda: None) -> Outcome:
        """Waits until the command ends; a cancelled wait does not end it.

        Args:
            on_progress: is called when it is further than before, and once in a second.
        """
        while not self._end.done():
            ticking = asyncio.create_task(self._changed.wait())
            await asyncio.wait([self._end, ticking], timeout=1.0, return_when="FIRST_COMPLETED")
            ticking.cancel()
            self._changed.clear()
            on_progress()
        return self._end.result()

    def cancel(self) -> None:
        """Interrupts the command as Ctrl-C does, and kills it if it does not end."""
        if not self._cancelled and not self._end.done():
            self._cancelled = True
            self.doing = "cancelling"
            self._changed.set()
            self._send_signal(signal.SIGINT)
            self._killing = asyncio.create_task(self._kill_later())

    def kill(self) -> None:
        """Kills the command at once."""
        self._send_signal(getattr(signal, "SIGKILL", signal.SIGTERM))

    async def _kill_later(self) -> None:
        await asyncio.wait([self._end], timeout=THRESHOLDS.interrupt_patience)
        if not self._end.done():
            self.kill()

    def _send_signal(self, number: int) -> None:
        if self._process is None or self._process.returncode is not None:
            return
        with contextlib.suppress(ProcessLookupError):
            if hasattr(os, "killpg"):
                os.killpg(self._process.pid, number)
            elif number == signal.SIGINT and self._process.stdin is not None:
                self._process.stdin.close()  # it interrupts itself: on Windows nobody else can
            else:
                self._process.send_signal(number)

    async def _execute(self) -> Outcome:
        try:
            status = await self._follow_process()
        except (OSError, ValueError) as error:  # ValueError: a NUL in a word
            line = f"{self.title}: cannot be started ({error}); check {self.folder}"
            return self._finish(1, line)
        except asyncio.CancelledError:  # the studio ends
            self._send_signal(signal.SIGINT)
            if self._process is not None:
                with contextlib.suppress(TimeoutError):
                    await asyncio.wait_for(self._process.wait(), THRESHOLDS.interrupt_patience)
                self.kill()
            raise
        if status and self._cancelled:
            return self._finish(INTERRUPTED, f"{self.title}: cancelled")
        return self._finish(status, "" if status == 0 else self._describe_error(status))

    async def _follow_process(self) -> int:
        """Its status, when it has ended."""
        command, *rest = self.words
        self._process = process = await asyncio.create_subprocess_exec(
            # -P: a file of the project that is called numpy.py is no module
            *(sys.executable, "-P", "-m", "modeler.cli.followed"),
            *(command, "--progress", "lines", *rest),
            cwd=self.folder,
            env=_build_environment(),
            stdin=asyncio.subprocess.PIPE,
            stdout=asyncio.subprocess.PIPE,
            stderr=asyncio.subprocess.PIPE,
            start_new_session=True,
        )
        assert process.stdin and process.stdout and process.stderr
        if self._cancelled:
            self.kill()
        await asyncio.gather(self._read_stdout(process.stdout), self._read_stderr(process.stderr))
        status = await process.wait()
        process.stdin.close()
        return status

    def _finish(self, status: int, error: str) -> Outcome:
        self.share, self.doing = 1.0, error or "done"
        return Outcome(status, error, tuple(self.lines), self.seconds)

    async def _read_stdout(self, stream: asyncio.StreamReader) -> None:
        async for line in _read_lines(stream):
            self.lines.append(line)

    async def _read_stderr(self, stream: asyncio.StreamReader) -> None:
        async for line in _read_lines(stream):
            progress = _PROGRESS.fullmatch(line)
            if progress is None:
                self._stderr_lines.append(line)
            elif not self._cancelled:
                self.share = None if progress[1] == "-" else min(float(progress[1]), 1.0)
                self.doing = progress[2]
                self._changed.set()

    def _describe_error(self, status: int) -> str:
        """The line that the command printed; where it printed none, what is known of its end."""
        last = next((line for line in reversed(self._stderr_lines) if line.strip()), "")
        if message := _TOLD.fullmatch(last):
            return message[1]
        if status == -getattr(signal, "SIGKILL", 9):
            return f"{self.title}: the system ended it, as where memory runs out; take less of it"
        line = shlex.join(["modeler", *self.words, "--verbose"])
        return flatten_message(f"{self.title}: ended with status {status} ({last}); run `{line}`")


async def _read_lines(stream: asyncio.StreamReader) -> AsyncIterator[str]:
    """Of any length, the last one too where nothing ends it."""
    rest = b""
    while piece := await stream.read(_PIECE):
        *whole, rest = (rest + piece).split(b"\n")
        for line in whole:
            yield line.decode(errors="replace").rstrip("\r")
    if rest:
        yield rest.decode(errors="replace")


def _build_environment() -> dict[str, str]:
    """Ours, in which the child finds this very package, wherever it was imported from."""
    root = str(Path(__file__).resolve().parents[2])
    environment = dict(os.environ)
    # An empty place in this list would be the folder of the project, in spite of -P.
    places = [place for place in environment.get("PYTHONPATH", "").split(os.pathsep) if place]
    if root not in (sysconfig.get_path("purelib"), sysconfig.get_path("platlib")):
        places.insert(0, root)
    return environment | {"PYTHONPATH": os.pathsep.join(places)}


class Viewer:
    """Functions of `modeler.studio.viewing`, called in a process of its own.

    The process is started when it is first asked, anew where it has ended (as when memory runs
    out), and ends with this one, even if that is killed. The event loop never waits.
    """

    def __init__(self, folder: Path = Path(), allowed: Sequence[Path] = ()) -> None:
        """Names of files are relative to the folder.

        Args:
            folder: of the project.
            allowed: folders in which files may be read; none: everywhere.
        """
        self._places = folder, tuple(allowed)
        self._pool: ProcessPoolExecutor | None = None
        self._turn = asyncio.Lock()
        self._newest: dict[str, int] = {}
        self._asked = 0

    async def ask(self, function: str, *arguments: Any, kind: str = "") -> Any:
        """Returns the answer of a function; questions are answered one after the other.

        Args:
            function: its name.
            arguments: plain ones.
            kind: of questions of which only the newest counts, as the window of one picture: one
                that waits is dropped when the next comes, and its answer is None.

        Raises:
            ModelerError: as the function, or the process ended twice over it.
        """
        self._asked += 1
        number = self._newest[kind] = self._asked
        async with self._turn:
            if kind and self._newest[kind] != number:
                return None
            for _ in range(2):
                try:
                    return await self._compute_answer(function, arguments)
                except BrokenProcessPool:
                    self.end()
            raise DataError(
                "the process that draws logs ended in the middle of its work, twice, as when "
                "memory runs out; close other programs, or look at a shorter stretch"
            )

    async def launch(self) -> None:
        """Starts the process, before it is needed."""
        if self._pool is None:
            with contextlib.suppress(ModelerError):
                await self.ask("robot_joints", "")

    async def _compute_answer(self, function: str, arguments: tuple[Any, ...]) -> Any:
        if self._pool is None:
            context = multiprocessing.get_context("spawn")
            self._pool = ProcessPoolExecutor(
                1, mp_context=context, initializer=_initialise_process, initargs=self._places
            )
        loop = asyncio.get_running_loop()
        with block_interrupts():  # of the process that this starts
            future = loop.run_in_executor(self._pool, compute_answer, function, arguments)
        return await future

    def end(self) -> None:
        """Lets go of the process; the next question starts another."""
        if self._pool is not None:
            pool, self._pool = self._pool, None
            for process in list((pool._processes or {}).values()):
                process.kill()
            pool.shutdown(wait=False, cancel_futures=True)


def _initialise_process(folder: Path, allowed: tuple[Path, ...]) -> None:
    """At the start of the process."""
    exit_with_parent()
    os.chdir(folder)
    places.READABLE = places.Roots(allowed)


def compute_answer(function: str, arguments: tuple[Any, ...]) -> Any:
    """Calls a function of `viewing`, in the process of the viewer.

    Raises:
        ModelerError: as the function, or memory ran out.
    """
    from modeler.studio import robot_views

    viewer_function: Callable[..., Any] | None = getattr(robot_views, function, None)
    if viewer_function is not None:  # a robot needs nothing of what reads logs
        return viewer_function(*arguments)
    from modeler.studio import viewing

    viewer_function = getattr(viewing, function)
    try:
        return viewer_function(*arguments)
    except (MemoryError, OSError, RuntimeError) as error:
        if not is_out_of_memory(error):
            raise DataError(f"{function}: {error}") from error
        viewing.forget()
        raise DataError(
            "memory ran out while a log was drawn; close other programs, or look at a shorter "
            "stretch"
        ) from error
