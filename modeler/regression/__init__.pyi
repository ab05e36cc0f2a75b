from .block_fits import (
    BlockSums as BlockSums,
    compute_prior_weights as compute_prior_weights,
    number_blocks as number_blocks,
    predict_left_out as predict_left_out,
    sum_blocks as sum_blocks,
    sum_joint_rows as sum_joint_rows,
)
from .chunk import (
    SPREAD as SPREAD,
    Chunk as Chunk,
    cut_window as cut_window,
    read_chunks as read_chunks,
    read_chunks_between as read_chunks_between,
    read_part as read_part,
    read_spread as read_spread,
)
from .cutoffs import CutoffSearch as CutoffSearch, compute_chatter_ratios as compute_chatter_ratios
from .log import (
    FINGER as FINGER,
    LONG as LONG,
    MOST_WHOLE as MOST_WHOLE,
    Log as Log,
    LogRows as LogRows,
    check_no_overlap as check_no_overlap,
    find_runs as find_runs,
    has_shared_rows as has_shared_rows,
)
from .motion import (
    ChosenProcessing as ChosenProcessing,
    Processing as Processing,
    Segment as Segment,
    apply_low_pass as apply_low_pass,
    compute_travel_since_reversal as compute_travel_since_reversal,
    differentiate_positions as differentiate_positions,
    read_processing as read_processing,
)
from .motion_noise import (
    Bands as Bands,
    ChannelNoise as ChannelNoise,
    MotionNoise as MotionNoise,
    build_bands as build_bands,
)
from .observation import (
    MASKS as MASKS,
    WHY as WHY,
    ModelRegressor as ModelRegressor,
    Observation as Observation,
    add_stretch as add_stretch,
    assemble_observation as assemble_observation,
    build_no_row_error as build_no_row_error,
    build_observation as build_observation,
    classify_rows as classify_rows,
    compute_fitted_torque as compute_fitted_torque,
    compute_model_torque as compute_model_torque,
    compute_triangles as compute_triangles,
    evaluate_columns_at as evaluate_columns_at,
    is_streamed as is_streamed,
    iterate_blocks as iterate_blocks,
    rebuild_observation as rebuild_observation,
)
from .observe import observe as observe
from .prepare import (
    LogRepair as LogRepair,
    PreparedLogs as PreparedLogs,
    choose_cutoffs as choose_cutoffs,
    close_segments as close_segments,
    estimate_position_noise as estimate_position_noise,
    find_nearest_closed as find_nearest_closed,
    prepare_logs as prepare_logs,
)
from .read import (
    FileSource as FileSource,
    MemorySource as MemorySource,
    Source as Source,
    build_log as build_log,
    build_table as build_table,
    open_source as open_source,
    read_log as read_log,
    read_log_in_memory as read_log_in_memory,
)
from .report import (
    DataReport as DataReport,
    DataWarning as DataWarning,
    LogFacts as LogFacts,
    LogReport as LogReport,
)
from .segments import (
    REST_TRAVEL as REST_TRAVEL,
    FilteredSegment as FilteredSegment,
    apply_lag as apply_lag,
    compute_bristle_state as compute_bristle_state,
    compute_signals as compute_signals,
    compute_signals_along as compute_signals_along,
    compute_time_since_reversal as compute_time_since_reversal,
    count_unsettled_samples as count_unsettled_samples,
    filter_segment as filter_segment,
    find_shafts as find_shafts,
)
from .survey import (
    WINDOW as WINDOW,
    WINDOWS as WINDOWS,
    KnownFacts as KnownFacts,
    LogChoices as LogChoices,
    LogPasses as LogPasses,
    Survey as Survey,
    WholeLogNeeded as WholeLogNeeded,
    build_chunk_rows as build_chunk_rows,
    build_streamed_report as build_streamed_report,
    choose_from_windows as choose_from_windows,
)
from .thresholds import THRESHOLDS as THRESHOLDS
