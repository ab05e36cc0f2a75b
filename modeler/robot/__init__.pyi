from .body_tree import (
    BodyTree as BodyTree,
    Inertial as Inertial,
    Pose as Pose,
    about_origin as about_origin,
    moving_links as moving_links,
    together as together,
    turned as turned,
)
from .cells import linear_form as linear_form
from .conventions import (
    written_cell as written_cell,
    written_letter as written_letter,
    written_table as written_table,
)
from .edit import (
    home_lines as home_lines,
    robot_with_effects as robot_with_effects,
    with_coupling as with_coupling,
    with_drive_gains as with_drive_gains,
    with_effect as with_effect,
    with_effect_on as with_effect_on,
    with_effects as with_effects,
    with_fitted as with_fitted,
    with_gravity as with_gravity,
    with_home_text as with_home_text,
    with_limits as with_limits,
    with_log as with_log,
    with_own_effect as with_own_effect,
    with_reference as with_reference,
    with_symbol as with_symbol,
    written_limits as written_limits,
    written_symbols as written_symbols,
)
from .loops import read_home as read_home
from .mdh_rows import roll_pitch_yaw as roll_pitch_yaw
from .mjcf import mjcf_tree as mjcf_tree
from .motors import joint_directions as joint_directions
from .parameter_words import ParameterWords as ParameterWords, parameter_words as parameter_words
from .pasted import (
    PastedTable as PastedTable,
    pasted_cells as pasted_cells,
    pasted_robot as pasted_robot,
    pasted_table as pasted_table,
    with_pasted as with_pasted,
)
from .quaternions import rotation_matrix as rotation_matrix
from .read import read_robot as read_robot, robot_from_text as robot_from_text
from .robot import (
    INERTIAL as INERTIAL,
    LOOP_KINDS as LOOP_KINDS,
    EffectUse as EffectUse,
    Joint as Joint,
    JointKind as JointKind,
    Limits as Limits,
    LinkCapsule as LinkCapsule,
    LinkFrame as LinkFrame,
    Loop as Loop,
    PhysicalLink as PhysicalLink,
    Place as Place,
    Robot as Robot,
    SharedParameter as SharedParameter,
    listed as listed,
    near as near,
)
from .shared_effects import (
    SharedEffects as SharedEffects,
    exported_effect as exported_effect,
    shared_effects as shared_effects,
)
from .start import (
    check_new_robot as check_new_robot,
    convert as convert,
    new_robot as new_robot,
    template_robot as template_robot,
)
from .table_text import (
    TableText as TableText,
    cell_of as cell_of,
    convention_of as convention_of,
    table_text as table_text,
    with_cell as with_cell,
    with_row as with_row,
    without_row as without_row,
)
from .tree_cuts import lock_values as lock_values
from .urdf import urdf_tree as urdf_tree
from .xml_source import Element as Element, parse_xml as parse_xml, replaced as replaced
