from .control import Control as Control
from .package import leftovers as leftovers, write_emitted as write_emitted
from .workflow import Derivation as Derivation, derive as derive, generate as generate, load as load
