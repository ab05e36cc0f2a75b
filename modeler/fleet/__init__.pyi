from . import result as result
from .fleet import fleet_of as fleet_of
from .naming import (
    Named as Named,
    in_order as in_order,
    listed_logs as listed_logs,
    named_logs as named_logs,
)
from .result import (
    Fleet as Fleet,
    FleetFinding as FleetFinding,
    Followed as Followed,
    Values as Values,
    fleet_lines as fleet_lines,
)
from .summary import (
    LogJob as LogJob,
    LogSummary as LogSummary,
    SkippedLog as SkippedLog,
    reduce_log as reduce_log,
    summary as summary,
)
