from .comparison import (
    JOINT_COLUMNS as JOINT_COLUMNS,
    WINDOW as WINDOW,
    Comparison as Comparison,
    JointComparison as JointComparison,
    build_log_columns as build_log_columns,
    compare as compare,
    compare_long_logs as compare_long_logs,
    describe_methods as describe_methods,
)
from .fleet import (
    QUANTITY_COLUMNS as QUANTITY_COLUMNS,
    Fleet as Fleet,
    FleetFinding as FleetFinding,
    QuantityHistory as QuantityHistory,
    QuantityValues as QuantityValues,
    analyse_fleet as analyse_fleet,
    describe_finding as describe_finding,
    format_effect_title as format_effect_title,
    format_fleet as format_fleet,
    format_headline as format_headline,
    format_skipped as format_skipped,
)
from .fleet_logs import (
    LogJob as LogJob,
    LogName as LogName,
    LogSummary as LogSummary,
    SkippedLog as SkippedLog,
    arrange_logs as arrange_logs,
    name_logs as name_logs,
    read_log_list as read_log_list,
    reduce_log as reduce_log,
    summarise_log as summarise_log,
)
from .free_run import (
    FreeRunSettings as FreeRunSettings,
    Gains as Gains,
    simulate_free_run as simulate_free_run,
)
from .free_run_result import (
    FreeRun as FreeRun,
    JointFreeRun as JointFreeRun,
    draw_free_run_picture as draw_free_run_picture,
    draw_free_run_pictures as draw_free_run_pictures,
)
from .models import (
    JointModelComparison as JointModelComparison,
    ModelComparison as ModelComparison,
    ModelErrors as ModelErrors,
    check_joints as check_joints,
    compare_models as compare_models,
    describe_model_comparison as describe_model_comparison,
    describe_winner as describe_winner,
    format_model_comparison as format_model_comparison,
    predict_together as predict_together,
)
from .pictures import (
    break_at_gaps as break_at_gaps,
    build_cloud as build_cloud,
    build_means as build_means,
    build_residual_panel as build_residual_panel,
    build_time_curve as build_time_curve,
    build_torque_panels as build_torque_panels,
    compute_binned_means as compute_binned_means,
    concatenate_time as concatenate_time,
    describe_masks as describe_masks,
    draw_overlay_picture as draw_overlay_picture,
    draw_overview_picture as draw_overview_picture,
    draw_residual_picture as draw_residual_picture,
    draw_time_picture as draw_time_picture,
    find_masked_spans as find_masked_spans,
)
from .prediction import (
    JointInfo as JointInfo,
    Prediction as Prediction,
    compute_residual as compute_residual,
    predict as predict,
    predict_every_row as predict_every_row,
)
from .residual_structure import (
    evaluate_coordinate as evaluate_coordinate,
    format_coordinate_unit as format_coordinate_unit,
    select_coordinates as select_coordinates,
)
from .thresholds import THRESHOLDS as THRESHOLDS
from .verdict import (
    classify_residual as classify_residual,
    describe_wrong_scale as describe_wrong_scale,
    find_best_other as find_best_other,
    find_best_pattern as find_best_pattern,
    is_noise_like as is_noise_like,
    is_too_large as is_too_large,
    write_headline as write_headline,
    write_joint_verdict as write_joint_verdict,
    write_verdict as write_verdict,
)
