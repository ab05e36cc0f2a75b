"""Simulated measurements, by physics that share nothing with the regressor.

Rigid links in the world frame, effects as torques on shafts, a controller that sees a quantised
encoder: `simulate` gives a log as a machine would, and the truth beside it. Robots with loops carry
out the commanded motion exactly, closed by equations that the modeling stages do not share.
"""

from modeler.simulate.hidden import HiddenEffect as HiddenEffect
from modeler.simulate.hidden import hidden_from_text as hidden_from_text
from modeler.simulate.hidden_catalogue import HIDDEN as HIDDEN
from modeler.simulate.limits import motion_limits as motion_limits
from modeler.simulate.log import SimulatedLog as SimulatedLog
from modeler.simulate.log import Truth as Truth
from modeler.simulate.log import check_suffix as check_suffix
from modeler.simulate.log import told_hidden as told_hidden
from modeler.simulate.log import write_log as write_log
from modeler.simulate.log import write_truth as write_truth
from modeler.simulate.parameters import PlantParameters as PlantParameters
from modeler.simulate.parameters import plant_parameters as plant_parameters
from modeler.simulate.run import simulate as simulate
from modeler.simulate.settings import MOTIONS as MOTIONS
from modeler.simulate.settings import SimulationSettings as SimulationSettings
