from .bodies import Equations as Equations
from .capsules import capsules_on_links as capsules_on_links
from .held import NotHeld as NotHeld, Torques as Torques
from .result import Exported as Exported, Value as Value
from .write import (
    ENDINGS as ENDINGS,
    FORMATS as FORMATS,
    exported as exported,
    format_of as format_of,
)
