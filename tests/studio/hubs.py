"""Hubs of project folders; NiceGUI is imported where one is made, not while tests are collected."""

import contextlib
import resource
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from modeler.studio.project import Project, Workspace
from modeler.studio.tasks import Step, Task
from tests.coroutines import run_coroutine


@contextlib.contextmanager
def hub_of(folder: Path, allow: Sequence[Path] = ()) -> Iterator[Any]:
    """One whose commands and questions start no process."""
    from modeler.studio.studio import Hub
    from tests.studio.in_process import without_processes

    with without_processes():
        hub = Hub(Workspace(folder), (*allow,), {})
        try:
            yield hub
        finally:
            hub.close()


def run_tasks(hub: Any, *tasks: Callable[[Project], Task], keep: bool = True) -> list[Step]:
    """Tasks one after the other, each made for the project as it is then."""

    async def run_all() -> list[Step]:
        return [await hub.run(task(hub.project), keep=keep) for task in tasks]

    return run_coroutine(run_all())


@contextlib.contextmanager
def full_disk(size: int) -> Iterator[None]:
    """No file may be larger: it needs no rights, and fails in the same place."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
