"""What is kept in files: models and robots."""

from pathlib import Path

from modeler.core.files import write_atomically
from modeler.fit import IdentifiedModel, load_model, save_model
from modeler.robot import Robot


def save(thing: IdentifiedModel | Robot, path: str | Path) -> Path:
    """Write a model file, or the file of a robot; an interrupted write leaves the old file.

    Raises:
        ModelerError: the folder cannot be written.
    """
    if isinstance(thing, Robot):
        write_atomically(Path(path), thing.text)
    else:
        save_model(path, thing)
    return Path(path)


def open_model(path: str | Path) -> IdentifiedModel:
    """Read a model file. Robot files are read by `load`.

    Raises:
        ManifestError: missing, not a model file, of another format, damaged, or changed since it
            was saved.
    """
    return load_model(path)
