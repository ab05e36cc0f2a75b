from .comparison import (
    WINDOW as WINDOW,
    Comparison as Comparison,
    JointComparison as JointComparison,
    by_log as by_log,
    compare as compare,
    method_lines as method_lines,
    or_dash as or_dash,
)
from .free_run import FreeRunSettings as FreeRunSettings, Gains as Gains, free_run as free_run
from .free_run_result import (
    FreeRun as FreeRun,
    JointFreeRun as JointFreeRun,
    free_run_picture as free_run_picture,
    free_run_pictures as free_run_pictures,
)
from .models import (
    DOUBT as DOUBT,
    Contest as Contest,
    JointContest as JointContest,
    check_joints as check_joints,
    contest as contest,
    contest_lines as contest_lines,
    contest_sentences as contest_sentences,
    headline_of as headline_of,
    predict_together as predict_together,
)
from .pictures import (
    binned_means as binned_means,
    overlay_picture as overlay_picture,
    overview_picture as overview_picture,
    residual_picture as residual_picture,
)
from .predict import at_every_row as at_every_row, compare_long as compare_long, predict as predict
from .prediction import (
    DEVIATIONS as DEVIATIONS,
    JointInfo as JointInfo,
    Prediction as Prediction,
    residual as residual,
)
from .residual_structure import (
    coordinate_unit as coordinate_unit,
    coordinate_values as coordinate_values,
    coordinates_of as coordinates_of,
)
from .time_picture import (
    broken as broken,
    mask_caption as mask_caption,
    masked_spans as masked_spans,
    running_time as running_time,
    time_picture as time_picture,
)
from .verdict import (
    best_other as best_other,
    best_pattern as best_pattern,
    headline as headline,
    joint_verdict as joint_verdict,
    kind_of_residual as kind_of_residual,
    looks_like_noise as looks_like_noise,
    too_large as too_large,
    verdict as verdict,
    wrong_scale as wrong_scale,
)
