from .arrays import LEAST_ROWS as LEAST_ROWS
from .blocks import (
    Blocks as Blocks,
    ParquetBlocks as ParquetBlocks,
    blocks_of as blocks_of,
    windows_of as windows_of,
)
from .columns import Columns as Columns
from .frames import (
    Frame as Frame,
    InMemory as InMemory,
    columns_given as columns_given,
    split_joints as split_joints,
)
from .guess import EITHER as EITHER, template_of as template_of
from .inspect import (
    Clock as Clock,
    LogInspection as LogInspection,
    Positions as Positions,
    inspect_log as inspect_log,
)
from .log_table import LogTable as LogTable
from .mapping import (
    LogMap as LogMap,
    MappedColumn as MappedColumn,
    find_unit as find_unit,
    map_from_table as map_from_table,
    map_from_words as map_from_words,
    si_unit as si_unit,
)
from .marks import Mark as Mark, marks_of as marks_of, most_of as most_of
from .rates import (
    clock_line as clock_line,
    common_factor as common_factor,
    is_derivative as is_derivative,
    moves as moves,
    repeats_line as repeats_line,
)
from .stamps import coarse_clock as coarse_clock
