from .limits import (
    BASE as BASE,
    Box as Box,
    Clearance as Clearance,
    ClearanceReport as ClearanceReport,
    ClosestApproach as ClosestApproach,
    CollisionGeometry as CollisionGeometry,
    LimitExcess as LimitExcess,
    MotionBounds as MotionBounds,
    exclude_neighbours as exclude_neighbours,
    find_closest_approach as find_closest_approach,
    find_exceeded_limits as find_exceeded_limits,
)
from .result import (
    ExcitingMotion as ExcitingMotion,
    InformationGain as InformationGain,
    check_picture_kind as check_picture_kind,
    draw_motion as draw_motion,
    encode_parquet as encode_parquet,
    format_csv as format_csv,
)
from .search import (
    ExcitationTask as ExcitationTask,
    MotionRequest as MotionRequest,
    build_task as build_task,
    choose_harmonics as choose_harmonics,
    design_motion as design_motion,
    draw_random_motion as draw_random_motion,
)
from .separate import (
    Discrimination as Discrimination,
    DiscriminationProblem as DiscriminationProblem,
    MotionSubset as MotionSubset,
    choose_motions as choose_motions,
    design_discriminating_motion as design_discriminating_motion,
)
from .series import (
    PriorInformation as PriorInformation,
    compute_condition as compute_condition,
    compute_signals as compute_signals,
)
from .thresholds import THRESHOLDS as THRESHOLDS
