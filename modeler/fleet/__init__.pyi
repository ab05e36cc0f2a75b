from . import result as result
from .fleet import analyse_fleet as analyse_fleet
from .naming import (
    LogName as LogName,
    arrange_logs as arrange_logs,
    name_logs as name_logs,
    read_log_list as read_log_list,
)
from .result import (
    Fleet as Fleet,
    FleetFinding as FleetFinding,
    QuantityHistory as QuantityHistory,
    QuantityValues as QuantityValues,
    format_fleet as format_fleet,
)
from .summary import (
    LogJob as LogJob,
    LogSummary as LogSummary,
    SkippedLog as SkippedLog,
    reduce_log as reduce_log,
    summarise_log as summarise_log,
)
