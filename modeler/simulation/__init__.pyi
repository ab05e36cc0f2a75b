from .closing import KEPT as KEPT
from .log import (
    HiddenEffect as HiddenEffect,
    SimulatedLog as SimulatedLog,
    SimulationSettings as SimulationSettings,
    check_settings as check_settings,
    check_suffix as check_suffix,
    parse_drive_gains as parse_drive_gains,
    parse_hidden_effect as parse_hidden_effect,
    write_log as write_log,
    write_truth as write_truth,
)
from .parameters import (
    PlantParameters as PlantParameters,
    draw_plant_parameters as draw_plant_parameters,
)
from .physics import HIDDEN as HIDDEN
from .run import simulate as simulate
from .trajectory import (
    Reference as Reference,
    build_curve as build_curve,
    build_point_to_point_reference as build_point_to_point_reference,
    collect_motion_limits as collect_motion_limits,
    read_motion as read_motion,
    resample_motion as resample_motion,
)
