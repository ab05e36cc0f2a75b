"""One robot kind, many machines and days: what drifts where."""

from modeler.fleet.fleet import fleet_of as fleet_of
from modeler.fleet.naming import Named as Named
from modeler.fleet.naming import named_logs as named_logs
from modeler.fleet.result import Fleet as Fleet
from modeler.fleet.summary import Left as Left
from modeler.fleet.summary import LogJob as LogJob
from modeler.fleet.summary import LogSummary as LogSummary
from modeler.fleet.summary import reduce_log as reduce_log
