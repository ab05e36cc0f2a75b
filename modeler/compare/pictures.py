"""All pictures of a comparison, and as files."""

from collections.abc import Callable
from pathlib import Path

from modeler.compare.comparison import Comparison, JointComparison
from modeler.compare.overview_picture import overview_picture
from modeler.compare.residual_picture import residual_picture
from modeler.compare.time_picture import time_picture
from modeler.pictures.files import write_files
from modeler.pictures.picture import Picture


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
    return write_files(folder, all_pictures(comparison), progress)
