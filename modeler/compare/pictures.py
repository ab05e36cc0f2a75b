"""All pictures of a comparison."""

from modeler.compare.comparison import Comparison, JointComparison
from modeler.compare.overview_picture import overview_picture
from modeler.compare.picture import Picture
from modeler.compare.residual_picture import residual_picture
from modeler.compare.time_picture import time_picture


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
