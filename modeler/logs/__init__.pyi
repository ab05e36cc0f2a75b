from .blocks import (
    Blocks as Blocks,
    ParquetBlocks as ParquetBlocks,
    blocks_of as blocks_of,
    windows_of as windows_of,
)
from .columns import Columns as Columns
from .guess import template_of as template_of
from .inspect import Clock as Clock, LogInspection as LogInspection, inspect_log as inspect_log
from .log_table import LogTable as LogTable
from .mapping import (
    LogMap as LogMap,
    map_from_table as map_from_table,
    map_from_words as map_from_words,
)
from .rates import (
    clock_line as clock_line,
    common_factor as common_factor,
    repeats_line as repeats_line,
)
