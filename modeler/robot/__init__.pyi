from .body_tree import (
    BodyTree as BodyTree,
    Inertial as Inertial,
    Pose as Pose,
    collect_moving_links as collect_moving_links,
    combine_inertials as combine_inertials,
    compute_axis_rotation as compute_axis_rotation,
    compute_standard_parameters as compute_standard_parameters,
)
from .cells import extract_linear_form as extract_linear_form
from .conventions import (
    build_written_table as build_written_table,
    get_written_letter as get_written_letter,
    locate_written_cell as locate_written_cell,
)
from .edit import (
    format_home_lines as format_home_lines,
    insert_coupling as insert_coupling,
    insert_effect as insert_effect,
    insert_own_effect as insert_own_effect,
    read_limit_texts as read_limit_texts,
    read_symbol_texts as read_symbol_texts,
    replace_drive_gains as replace_drive_gains,
    replace_effects as replace_effects,
    replace_fitted_values as replace_fitted_values,
    replace_gravity as replace_gravity,
    replace_home as replace_home,
    replace_limits as replace_limits,
    replace_log_table as replace_log_table,
    replace_reference as replace_reference,
    replace_robot_effects as replace_robot_effects,
    replace_symbol as replace_symbol,
    set_joint_effect as set_joint_effect,
)
from .loops import read_home as read_home
from .mdh_rows import compute_roll_pitch_yaw as compute_roll_pitch_yaw
from .mjcf import read_mjcf_tree as read_mjcf_tree
from .motors import compute_joint_directions as compute_joint_directions
from .parameter_words import (
    ParameterDescription as ParameterDescription,
    describe_parameters as describe_parameters,
)
from .pasted import (
    PastedTable as PastedTable,
    build_pasted_robot as build_pasted_robot,
    insert_pasted_table as insert_pasted_table,
    parse_pasted_cells as parse_pasted_cells,
    parse_pasted_table as parse_pasted_table,
)
from .quaternions import compute_quaternion_rotation as compute_quaternion_rotation
from .read import parse_robot_text as parse_robot_text, read_robot as read_robot
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
    Robot as Robot,
    SharedParameter as SharedParameter,
    TomlCell as TomlCell,
    join_names as join_names,
    suggest_name as suggest_name,
)
from .shared_effects import (
    SharedEffects as SharedEffects,
    collect_shared_effects as collect_shared_effects,
    export_effect as export_effect,
)
from .start import (
    check_new_robot as check_new_robot,
    convert as convert,
    fill_template as fill_template,
    new_robot as new_robot,
)
from .table_text import (
    TableText as TableText,
    find_table_text as find_table_text,
    insert_row as insert_row,
    locate_error_cell as locate_error_cell,
    read_table_convention as read_table_convention,
    remove_row as remove_row,
    replace_cell as replace_cell,
)
from .tree_cuts import parse_lock_values as parse_lock_values
from .urdf import read_urdf_tree as read_urdf_tree
from .xml_source import Element as Element, parse_xml as parse_xml, replace_spans as replace_spans
