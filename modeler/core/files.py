"""Writing files so that nothing is ever half-written."""

import os
import tempfile
from pathlib import Path

from modeler.core.errors import ModelerError


def check_writable(path: Path) -> None:
    """Refuse a place that cannot be written, before the work that it is for; nothing is left there.

    Raises:
        ModelerError: it is a folder, or its folder is missing and cannot be made, or is not
            writable; says which.
    """
    path = Path(path)
    if path.is_dir():
        raise ModelerError(f"{path}: is a folder; expected the name of a file to write")
    made = [folder for folder in path.parents if not folder.exists()]
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, beside = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        os.close(handle)
        Path(beside).unlink()
    except OSError as error:
        raise _unwritable(path, error) from error
    finally:
        for folder in made:
            if folder.exists():
                folder.rmdir()


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
        raise _unwritable(path, error) from error
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


def _unwritable(path: Path, error: OSError) -> ModelerError:
    return ModelerError(
        f"{path}: cannot be written ({error.strerror}); choose a folder you may write to"
    )
