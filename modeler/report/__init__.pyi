from . import comparison as comparison, notebook as notebook, page as page
from .comparison import (
    all_pictures as all_pictures,
    comparison_page as comparison_page,
    contest_page as contest_page,
)
from .derivation import derivation_page as derivation_page, relations_html as relations_html
from .diagnosis import diagnosis_page as diagnosis_page
from .estimators import (
    estimators_page as estimators_page,
    remarks_of as remarks_of,
    table_of as table_of,
    values_of as values_of,
)
from .figure_page import write_files as write_files
from .fit import fit_page as fit_page
from .fleet import fleet_page as fleet_page
from .history import (
    additions_page as additions_page,
    effect_page as effect_page,
    step_name as step_name,
)
from .log import (
    channel_rows as channel_rows,
    clock_line as clock_line,
    log_page as log_page,
    log_pictures as log_pictures,
)
from .nearest_page import nearest_html as nearest_html
from .page import (
    Origin as Origin,
    Page as Page,
    after_add as after_add,
    after_compare as after_compare,
    after_diagnosis as after_diagnosis,
    after_fit as after_fit,
    after_stated as after_stated,
    write_page as write_page,
)
from .robot_closing import Posture as Posture
from .robot_drawing import modes_bytes as modes_bytes, picture_bytes as picture_bytes
from .robot_page import (
    PICTURE_KINDS as PICTURE_KINDS,
    modes_html as modes_html,
    page_content as page_content,
    posture_json as posture_json,
    posture_lines as posture_lines,
    robot_html as robot_html,
    show as show,
)
from .robot_skeleton import size_of as size_of, skeleton_of as skeleton_of
from .values import relation as relation
