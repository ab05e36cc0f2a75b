"""All pictures of a comparison, and as files."""

from collections.abc import Callable, Sequence
from pathlib import Path

from modeler.compare.comparison import Comparison, JointComparison
from modeler.compare.overview_picture import overview_picture
from modeler.compare.residual_picture import residual_picture
from modeler.compare.time_picture import time_picture
from modeler.core.files import write_atomically
from modeler.pictures.draw_matplotlib import images
from modeler.pictures.picture import Picture, picture_csv


def joint_pictures(comparison: Comparison, item: JointComparison) -> tuple[Picture, ...]:
    """The pictures of one joint: against time, then against each coordinate."""
    return (
        time_picture(comparison.prediction, item),
        residual_picture(comparison.prediction, item),
    )


def all_pictures(comparison: Comparison) -> tuple[Picture, ...]:
    """The overview, then the pictures of each judged joint."""
    drawn = [picture for item in comparison.joints for picture in joint_pictures(comparison, item)]
    return (overview_picture(comparison), *drawn)


def write_pictures(
    folder: Path, comparison: Comparison, progress: Callable[[float], None] | None = None
) -> tuple[Path, ...]:
    """Write every picture as PNG and SVG and its numbers as CSV; returns the paths written.

    Args:
        folder: made if it is not there.
        comparison: from `compare`.
        progress: called with the share done, 0 to 1.

    Raises:
        ModelerError: the folder cannot be written.
    """
    return write_each(folder, all_pictures(comparison), progress)


def write_each(
    folder: Path,
    pictures: Sequence[Picture],
    progress: Callable[[float], None] | None = None,
) -> tuple[Path, ...]:
    """Write these pictures as PNG, SVG and CSV; as `write_pictures`."""
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
