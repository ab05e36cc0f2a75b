from .add import (
    add_effect as add_effect,
    add_findings as add_findings,
    add_laws as add_laws,
    add_learned as add_learned,
    undone as undone,
)
from .added_model import Logs as Logs, added as added, notes as notes
from .candidates import (
    Candidate as Candidate,
    JointScale as JointScale,
    StatedEffects as StatedEffects,
    over_grid as over_grid,
)
from .diagnosis import diagnose as diagnose
from .effect_columns import all_columns as all_columns
from .events import AFTER as AFTER, MARGIN as MARGIN, Window as Window, load_turns as load_turns
from .judge import Judged as Judged
from .learn import (
    ANY_LAW as ANY_LAW,
    LEARNED as LEARNED,
    LawAsked as LawAsked,
    Learned as Learned,
    learn as learn,
)
from .orders import order_spectrum as order_spectrum, rival as rival
from .ranking import Base as Base
from .result import Diagnosis as Diagnosis, Finding as Finding
from .search import Search as Search, Step as Step
from .sentences import (
    blind_spots as blind_spots,
    lines as lines,
    tie_names as tie_names,
    tied as tied,
    unit as unit,
    where as where,
)
from .signals import SignalReference as SignalReference, Signals as Signals
from .state import (
    State as State,
    analysed as analysed,
    columns_of as columns_of,
    state_of as state_of,
)
