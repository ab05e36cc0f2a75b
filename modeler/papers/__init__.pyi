from .briot import briot_methods as briot_methods
from .check import Line as Line, LineVerdict as LineVerdict, check_paper as check_paper
from .guegan import guegan_methods as guegan_methods
from .hanssen import hanssen_methods as hanssen_methods
from .houda import houda_methods as houda_methods
from .methods import MethodTable as MethodTable, Outcome as Outcome
from .paper import (
    SLIPS as SLIPS,
    DerivedPaper as DerivedPaper,
    Paper as Paper,
    derived_robot as derived_robot,
    read_paper as read_paper,
)
