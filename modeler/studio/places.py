"""Files on the server's side: what may be chosen, what is dropped, what a project uses."""

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path

from modeler.core.errors import ModelerError

_LOCK = ".studio.lock"


@contextlib.contextmanager
def folder_lock(folder: Path) -> Iterator[bool]:
    """True while the folder is ours; False where another studio has it open.

    The system gives the lock back when a process ends, however it ends.

    Raises:
        ModelerError: the folder cannot be made or written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        file = (folder / _LOCK).open("a+b")
    except OSError as error:
        raise ModelerError(
            f"{folder}: cannot be used as a project folder ({error.strerror}); name another one"
        ) from error
    with file:
        yield _locked(file.fileno())


def _locked(descriptor: int) -> bool:
    try:
        if os.name == "nt":
            import msvcrt

            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined,unused-ignore]
        else:
            import fcntl

            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
