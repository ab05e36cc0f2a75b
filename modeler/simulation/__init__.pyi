from .closing import KEPT as KEPT
from .hidden import HIDDEN as HIDDEN
from .log import (
    SimulatedLog as SimulatedLog,
    Truth as Truth,
    check_suffix as check_suffix,
    serialise_hidden_effects as serialise_hidden_effects,
    write_log as write_log,
    write_truth as write_truth,
)
from .parameters import (
    PlantParameters as PlantParameters,
    draw_plant_parameters as draw_plant_parameters,
)
from .run import simulate as simulate
from .settings import (
    HiddenEffect as HiddenEffect,
    SimulationSettings as SimulationSettings,
    check_settings as check_settings,
    parse_drive_gains as parse_drive_gains,
    parse_hidden_effect as parse_hidden_effect,
)
from .trajectory import (
    Reference as Reference,
    build_curve as build_curve,
    build_point_to_point_reference as build_point_to_point_reference,
    collect_motion_limits as collect_motion_limits,
    read_motion as read_motion,
    resample_motion as resample_motion,
)
