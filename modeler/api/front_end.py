"""What a front end needs beside the verbs: errors, files, choices, texts, pictures, robot texts.

The studio imports these from here. None of them loads what derives or reads logs.
"""

from modeler.core.choices import (
    ABOUT as ABOUT,
    APART as APART,
    CONVENTIONS as CONVENTIONS,
    EFFECTS as EFFECTS,
    LOG_ENDINGS as LOG_ENDINGS,
    OTHER_PROGRAMS as OTHER_PROGRAMS,
    TEMPLATES as TEMPLATES,
    list_builtin_robots as list_builtin_robots,
    read_builtin_robot as read_builtin_robot,
)
from modeler.core.errors import (
    DataError as DataError,
    ModelerError as ModelerError,
    flatten_message as flatten_message,
    is_out_of_memory as is_out_of_memory,
)
from modeler.core.figure import (
    COLORS as COLORS,
    Band as Band,
    Bars as Bars,
    Curve as Curve,
    Heat as Heat,
    Panel as Panel,
    Picture as Picture,
    Points as Points,
    Style as Style,
    read_pictures as read_pictures,
)
from modeler.core.files import (
    locate_resources as locate_resources,
    read_text as read_text,
    write_atomically as write_atomically,
)
from modeler.core.jobs import (
    block_interrupts as block_interrupts,
    exit_with_parent as exit_with_parent,
)
from modeler.core.json import (
    build_instance as build_instance,
    parse_json as parse_json,
    parse_toml as parse_toml,
)
from modeler.core.manifest import JointSpec as JointSpec
from modeler.core.options import FitOptions as FitOptions
from modeler.core.table import (
    format_error_pair as format_error_pair,
    format_percent as format_percent,
)
from modeler.effects import CATALOGUE as CATALOGUE, find_effect as find_effect
from modeler.estimation import format_spread as format_spread
from modeler.logs import (
    LogMap as LogMap,
    MappedColumn as MappedColumn,
    build_map as build_map,
    find_unit as find_unit,
    parse_map_options as parse_map_options,
    resolve_si_unit as resolve_si_unit,
)
from modeler.robot import (
    TableText as TableText,
    build_pasted_robot as build_pasted_robot,
    find_table_text as find_table_text,
    insert_pasted_table as insert_pasted_table,
    insert_row as insert_row,
    locate_error_cell as locate_error_cell,
    parse_pasted_cells as parse_pasted_cells,
    parse_pasted_table as parse_pasted_table,
    parse_robot_text as parse_robot_text,
    read_limit_texts as read_limit_texts,
    read_symbol_texts as read_symbol_texts,
    read_table_convention as read_table_convention,
    remove_row as remove_row,
    replace_cell as replace_cell,
    replace_fitted_values as replace_fitted_values,
    replace_limits as replace_limits,
    replace_symbol as replace_symbol,
    set_joint_effect as set_joint_effect,
)
from modeler.runtime import find_cache_folder as find_cache_folder
from modeler.views import build_figure as build_figure
