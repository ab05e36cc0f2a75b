from .closing import KEPT as KEPT
from .hidden import HIDDEN as HIDDEN
from .log import (
    SimulatedLog as SimulatedLog,
    Truth as Truth,
    check_suffix as check_suffix,
    hidden_json as hidden_json,
    write_log as write_log,
    write_truth as write_truth,
)
from .parameters import PlantParameters as PlantParameters, plant_parameters as plant_parameters
from .run import simulate as simulate
from .settings import (
    HiddenEffect as HiddenEffect,
    SimulationSettings as SimulationSettings,
    check_settings as check_settings,
    drive_gains as drive_gains,
    hidden_from_text as hidden_from_text,
)
from .trajectory import (
    Reference as Reference,
    at_rate as at_rate,
    curve_of as curve_of,
    motion_limits as motion_limits,
    point_to_point_reference as point_to_point_reference,
    read_motion as read_motion,
)
