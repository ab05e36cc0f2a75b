"""What `modeler.simulation` offers; loaded when the first of these is asked for."""

from modeler.core.builtin import MOTIONS as MOTIONS
from modeler.simulation.closing import KEPT as KEPT
from modeler.simulation.hidden import HIDDEN as HIDDEN
from modeler.simulation.log import SimulatedLog as SimulatedLog
from modeler.simulation.log import Truth as Truth
from modeler.simulation.log import check_suffix as check_suffix
from modeler.simulation.log import told_hidden as told_hidden
from modeler.simulation.log import write_log as write_log
from modeler.simulation.log import write_truth as write_truth
from modeler.simulation.parameters import PlantParameters as PlantParameters
from modeler.simulation.parameters import plant_parameters as plant_parameters
from modeler.simulation.run import simulate as simulate
from modeler.simulation.settings import HiddenEffect as HiddenEffect
from modeler.simulation.settings import SimulationSettings as SimulationSettings
from modeler.simulation.settings import drive_gains as drive_gains
from modeler.simulation.settings import hidden_from_text as hidden_from_text
from modeler.simulation.trajectory import Reference as Reference
from modeler.simulation.trajectory import at_rate as at_rate
from modeler.simulation.trajectory import motion_limits as motion_limits
from modeler.simulation.trajectory import read_motion as read_motion
