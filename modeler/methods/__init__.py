"""The identifications of the papers, run again in simulation, beside what was printed."""

from modeler.methods.report import MethodTable as MethodTable
from modeler.methods.report import Outcome as Outcome
from modeler.methods.report import Row as Row
from modeler.methods.run import METHODS as METHODS
from modeler.methods.run import run_methods as run_methods
