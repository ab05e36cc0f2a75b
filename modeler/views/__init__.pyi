from . import comparison as comparison, notebook as notebook, page as page
from .comparison import (
    build_comparison_page as build_comparison_page,
    build_model_comparison_page as build_model_comparison_page,
    draw_all_pictures as draw_all_pictures,
)
from .derivation import (
    build_derivation_page as build_derivation_page,
    render_relations as render_relations,
)
from .diagnosis import build_diagnosis_page as build_diagnosis_page
from .figure_plotly import build_figure as build_figure, escape_text as escape_text
from .figures import write_files as write_files
from .fit import (
    build_estimators_page as build_estimators_page,
    build_fit_page as build_fit_page,
    collect_remarks as collect_remarks,
    tabulate_estimates as tabulate_estimates,
    tabulate_estimators as tabulate_estimators,
)
from .fleet import build_fleet_page as build_fleet_page
from .history import (
    build_effect_page as build_effect_page,
    build_history_page as build_history_page,
    format_relation as format_relation,
    format_step_name as format_step_name,
)
from .log import (
    build_log_page as build_log_page,
    describe_clock as describe_clock,
    draw_log_pictures as draw_log_pictures,
    tabulate_channels as tabulate_channels,
)
from .page import (
    Origin as Origin,
    Page as Page,
    suggest_after_add as suggest_after_add,
    suggest_after_compare as suggest_after_compare,
    suggest_after_diagnosis as suggest_after_diagnosis,
    suggest_after_fit as suggest_after_fit,
    suggest_after_stated as suggest_after_stated,
    write_page as write_page,
)
from .robot_drawing import render_modes as render_modes, render_picture as render_picture
from .robot_page import (
    PICTURE_KINDS as PICTURE_KINDS,
    build_page_content as build_page_content,
    describe_posture as describe_posture,
    render_modes_page as render_modes_page,
    render_nearest_page as render_nearest_page,
    render_robot_page as render_robot_page,
    serialise_posture as serialise_posture,
    show as show,
)
from .robot_skeleton import (
    Posture as Posture,
    build_skeleton as build_skeleton,
    estimate_robot_size as estimate_robot_size,
)
