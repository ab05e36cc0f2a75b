"""A robot as it looks: its skeleton on a page that can be moved, and as a picture for papers.

Only numbers: poses come from the table, loops are closed by least squares. What cannot be derived
(loops that do not close, more or less free than is actuated) is shown all the same: that is what
one wants to look at.
"""

from modeler.show.closing import Gap as Gap
from modeler.show.closing import Posture as Posture
from modeler.show.closing import gaps_of as gaps_of
from modeler.show.closing import home_posture as home_posture
from modeler.show.modes import modes_bytes as modes_bytes
from modeler.show.paper import PICTURE_KINDS as PICTURE_KINDS
from modeler.show.picture import picture_bytes as picture_bytes
from modeler.show.pose import poses as poses
from modeler.show.pose import size_of as size_of
from modeler.show.skeleton import Skeleton as Skeleton
from modeler.show.skeleton import skeleton_of as skeleton_of
from modeler.show.summary import described as described
from modeler.show.summary import told as told
