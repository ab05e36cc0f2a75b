from .arrays import LEAST_ROWS as LEAST_ROWS
from .blocks import (
    Blocks as Blocks,
    ParquetBlocks as ParquetBlocks,
    open_blocks as open_blocks,
    read_windows as read_windows,
)
from .columns import Columns as Columns, describe_coarse_clock as describe_coarse_clock
from .guess import EITHER as EITHER, guess_role as guess_role, split_label as split_label
from .inspect import (
    Channel as Channel,
    Clock as Clock,
    LogInspection as LogInspection,
    Mark as Mark,
    Positions as Positions,
    find_marks as find_marks,
    inspect_table as inspect_table,
    keep_longest as keep_longest,
)
from .log_table import LogTable as LogTable
from .mapping import (
    LogMap as LogMap,
    MappedColumn as MappedColumn,
    build_map as build_map,
    find_unit as find_unit,
    parse_map_options as parse_map_options,
    resolve_si_unit as resolve_si_unit,
)
from .rates import (
    describe_clock_factor as describe_clock_factor,
    describe_repeats as describe_repeats,
    find_common_factor as find_common_factor,
    is_derivative as is_derivative,
    is_moving as is_moving,
)
from .readers import (
    Frame as Frame,
    InMemory as InMemory,
    build_frame_columns as build_frame_columns,
    split_joints as split_joints,
)
