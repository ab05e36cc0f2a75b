from .bodies import Equations as Equations
from .export import choose_format as choose_format, export_robot as export_robot
from .linkage import locate_capsules as locate_capsules
from .read import convert as convert, read_robot as read_robot
from .result import Exported as Exported, Torques as Torques, Value as Value
from .tree_cuts import parse_lock_values as parse_lock_values
