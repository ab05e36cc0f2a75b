"""Pictures as files: PNG and SVG, and their numbers as CSV."""

from collections.abc import Callable, Sequence
from pathlib import Path

from modeler.core.files import write_atomically
from modeler.pictures.picture import Picture, picture_csv


def write_files(
    folder: Path, pictures: Sequence[Picture], progress: Callable[[float], None] | None = None
) -> tuple[Path, ...]:
    """Write every picture; returns the paths written.

    Args:
        folder: made if it is not there.
        pictures: what to draw.
        progress: called with the share done, 0 to 1.

    Raises:
        ModelerError: the folder cannot be written.
    """
    from modeler.pictures.draw_matplotlib import images  # it takes long to load

    written = []
    for number, picture in enumerate(pictures, start=1):
        files = {**images(picture), "csv": picture_csv(picture).encode()}
        for kind, content in files.items():
            place = Path(folder) / f"{picture.name}.{kind}"
            write_atomically(place, content)
            written.append(place)
        if progress is not None:
            progress(number / len(pictures))
    return tuple(written)
