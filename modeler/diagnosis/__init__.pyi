from .add import (
    add_effect as add_effect,
    add_findings as add_findings,
    add_learned_law as add_learned_law,
    add_learned_laws as add_learned_laws,
    remove_last_effect as remove_last_effect,
)
from .added_model import (
    LogSplit as LogSplit,
    describe_additions as describe_additions,
    describe_last_addition as describe_last_addition,
)
from .candidates import (
    Candidate as Candidate,
    JointScale as JointScale,
    StatedEffects as StatedEffects,
    evaluate_columns as evaluate_columns,
    expand_grid as expand_grid,
)
from .diagnosis import diagnose as diagnose
from .events import find_load_reversals as find_load_reversals
from .generation import (
    compute_joint_order_spectrum as compute_joint_order_spectrum,
    fit_residual_baseline as fit_residual_baseline,
)
from .learn import (
    ANY_LAW as ANY_LAW,
    LEARNED as LEARNED,
    LawRequest as LawRequest,
    LearnedLaw as LearnedLaw,
    learn_law as learn_law,
)
from .messages import (
    describe_equivalents as describe_equivalents,
    describe_undetectable as describe_undetectable,
    format_equivalents as format_equivalents,
    format_lines as format_lines,
    format_location as format_location,
    format_unit as format_unit,
)
from .ranking import GramBlocks as GramBlocks
from .result import Diagnosis as Diagnosis, Finding as Finding, PushWindow as PushWindow
from .scoring import ScoredCandidate as ScoredCandidate
from .search import Search as Search, SearchStep as SearchStep
from .signals import SignalReference as SignalReference, Signals as Signals
from .state import (
    State as State,
    analyse_logs as analyse_logs,
    build_columns as build_columns,
    build_state as build_state,
)
from .thresholds import THRESHOLDS as THRESHOLDS
