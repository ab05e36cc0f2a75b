from .casadi_functions import write_casadi as write_casadi
from .control import Control as Control
from .package import list_leftovers as list_leftovers, write_emitted as write_emitted
from .workflow import Derivation as Derivation, derive as derive, generate as generate
from .wrappers import (
    build_fmu_files as build_fmu_files,
    build_ros2_files as build_ros2_files,
    find_fmu_roles as find_fmu_roles,
)
