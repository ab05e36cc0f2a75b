from .briot import reproduce_briot as reproduce_briot
from .guegan import reproduce_guegan as reproduce_guegan
from .hanssen import reproduce_hanssen as reproduce_hanssen
from .houda import reproduce_houda as reproduce_houda
from .methods import MethodTable as MethodTable, Outcome as Outcome
from .paper import (
    SLIPS as SLIPS,
    DerivedRobot as DerivedRobot,
    Paper as Paper,
    derive_robot as derive_robot,
    read_paper as read_paper,
)
from .readings import (
    CheckedLine as CheckedLine,
    LineVerdict as LineVerdict,
    check_paper as check_paper,
)
