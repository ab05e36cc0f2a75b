from .clearance import (
    BASE as BASE,
    SAMPLES as SAMPLES,
    Clearance as Clearance,
    Nearest as Nearest,
    Solids as Solids,
    nearest as nearest,
    without_neighbours as without_neighbours,
)
from .criterion import Known as Known, condition as condition, signals as signals
from .limit_check import Excess as Excess, exceeded_limits as exceeded_limits
from .motion import Bounds as Bounds, Box as Box
from .result import (
    Exciting as Exciting,
    Gain as Gain,
    check_kind as check_kind,
    csv_text as csv_text,
    motion_table as motion_table,
    picture as picture,
)
from .search import (
    Wish as Wish,
    default_harmonics as default_harmonics,
    excite as excite,
    random_motion as random_motion,
    task_of as task_of,
)
from .separate import (
    Question as Question,
    Separation as Separation,
    choose as choose,
    tell_apart as tell_apart,
)
from .task import Task as Task
