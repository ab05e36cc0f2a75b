"""Writing files so that nothing is ever half-written."""

import os
import tempfile
from pathlib import Path

from modeler.core.errors import ModelerError


def write_atomically(path: Path, content: bytes | str) -> None:
    r"""Write `content` beside `path`, then rename: readers see the old file or the new one.

    Text is written as UTF-8 with `\n` line ends on every system.

    Raises:
        ModelerError: the folder is missing or not writable; says which.
    """
    data = content.encode() if isinstance(content, str) else content
    path = Path(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, beside = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    except OSError as error:
        raise ModelerError(
            f"{path}: cannot be written ({error.strerror}); choose a folder you may write to"
        ) from error
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
        Path(beside).chmod(0o644)
        Path(beside).replace(path)
    except OSError as error:
        Path(beside).unlink(missing_ok=True)
        raise ModelerError(
            f"{path}: cannot be written ({error.strerror}); choose another place"
        ) from error
    except BaseException:
        Path(beside).unlink(missing_ok=True)
        raise
