from .casadi_functions import casadi_file as casadi_file
from .control import Control as Control
from .fmu import fmu_files as fmu_files, fmu_roles as fmu_roles
from .package import leftovers as leftovers, write_emitted as write_emitted
from .ros2 import ros2_files as ros2_files
from .workflow import Derivation as Derivation, derive as derive, generate as generate, load as load
