from .bodies import Equations as Equations
from .capsules import locate_capsules as locate_capsules
from .held import LostEffect as LostEffect, Torques as Torques
from .result import Exported as Exported, Value as Value
from .write import (
    ENDINGS as ENDINGS,
    FORMATS as FORMATS,
    choose_format as choose_format,
    export_robot as export_robot,
)
