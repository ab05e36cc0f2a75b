"""Hubs of project folders; NiceGUI is imported where one is made, not while tests are collected."""

import asyncio
import contextlib
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from modeler.studio.project import Project, Workspace
from modeler.studio.tasks import Step, Task

if TYPE_CHECKING:
    from modeler.studio.studio import Hub


@contextlib.contextmanager
def hub_of(folder: Path, allow: Sequence[Path] = ()) -> Iterator["Hub"]:
    """One whose commands and questions start no process."""
    from modeler.studio.studio import Hub
    from tests.studio.in_process import without_processes

    with without_processes():
        hub = Hub(Workspace(folder), (*allow,), {})
        try:
            yield hub
        finally:
            hub.close()


def run_tasks(hub: "Hub", *tasks: Callable[[Project], Task], keep: bool = True) -> list[Step]:
    """Tasks one after the other, each made for the project as it is then."""

    async def run_all() -> list[Step]:
        return [await hub.run(task(hub.project), keep=keep) for task in tasks]

    return asyncio.run(run_all())
