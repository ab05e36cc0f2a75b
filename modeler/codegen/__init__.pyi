from .casadi_functions import casadi_file as casadi_file
from .package import leftovers as leftovers, write_emitted as write_emitted
from .workflow import Derivation as Derivation, derive as derive, generate as generate, load as load
