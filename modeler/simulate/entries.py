"""What `modeler.simulate` offers; loaded when the first of these is asked for."""

from modeler.simulate.closed_motion import KEPT as KEPT
from modeler.simulate.currents import drive_gains as drive_gains
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
from modeler.simulate.motion_file import at_rate as at_rate
from modeler.simulate.motion_file import read_motion as read_motion
from modeler.simulate.parameters import PlantParameters as PlantParameters
from modeler.simulate.parameters import plant_parameters as plant_parameters
from modeler.simulate.run import simulate as simulate
from modeler.simulate.settings import MOTIONS as MOTIONS
from modeler.simulate.settings import SimulationSettings as SimulationSettings
from modeler.simulate.trajectory import Reference as Reference
