"""A robot as it looks: its skeleton on a page that can be moved, and as a picture for papers.

Only numbers: poses come from the table, loops are closed by least squares. What cannot be derived
(loops that do not close, more or less free than is actuated) is shown all the same: that is what
one wants to look at.
"""

from typing import TYPE_CHECKING, Any

from modeler.show.closing import Gap as Gap
from modeler.show.closing import Posture as Posture
from modeler.show.closing import gaps_of as gaps_of
from modeler.show.closing import home_posture as home_posture
from modeler.show.kinds import PICTURE_KINDS as PICTURE_KINDS
from modeler.show.pose import poses as poses
from modeler.show.pose import size_of as size_of
from modeler.show.skeleton import Skeleton as Skeleton
from modeler.show.skeleton import skeleton_of as skeleton_of
from modeler.show.summary import described as described
from modeler.show.summary import told as told

if TYPE_CHECKING:
    from modeler.show.modes import modes_bytes as modes_bytes
    from modeler.show.picture import picture_bytes as picture_bytes
else:

    def __getattr__(name: str) -> Any:
        """What draws; matplotlib takes long to load."""
        if name == "modes_bytes":
            from modeler.show.modes import modes_bytes as found
        elif name == "picture_bytes":
            from modeler.show.picture import picture_bytes as found
        else:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        return found
