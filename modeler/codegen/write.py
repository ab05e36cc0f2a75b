"""Emitted files to disk."""

from pathlib import Path

from modeler.core.contract import Emitted
from modeler.core.files import write_atomically


def write_emitted(emitted: Emitted, folder: Path) -> tuple[str, ...]:
    """Names of the files that were written: those that are new or have changed.

    A file that says the same already keeps its time, so that `make` has nothing to do. Other files
    of the folder are left alone: it may be the user's controller.

    Raises:
        ModelerError: the folder cannot be written.
    """
    written = []
    for name, text in emitted.files.items():
        path = Path(folder) / name
        if not path.is_file() or path.read_bytes() != text.encode():
            write_atomically(path, text)
            written.append(name)
    return tuple(written)
