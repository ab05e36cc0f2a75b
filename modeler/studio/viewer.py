"""The process that holds logs and predictions and answers small questions about them."""

import asyncio
import contextlib
import multiprocessing
import os
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any

from modeler.core.errors import DataError, ModelerError, is_out_of_memory
from modeler.core.jobs import block_interrupts, exit_with_parent
from modeler.studio import places


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
