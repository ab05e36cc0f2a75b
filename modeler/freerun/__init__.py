"""Positions instead of torques: the fitted robot left to itself under what was logged.

Numeric half, after the comparison of torques: forward dynamics from the compiled C.
"""

from modeler.freerun.result import FreeRun as FreeRun
from modeler.freerun.result import JointFreeRun as JointFreeRun
from modeler.freerun.run import Asked as Asked
from modeler.freerun.run import free_run as free_run
