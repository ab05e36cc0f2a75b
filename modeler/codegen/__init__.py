"""Stage 5: C99 that needs no allocation and no library but <math.h>."""

from modeler.codegen.emit import emit as emit
from modeler.codegen.write import leftovers as leftovers
from modeler.codegen.write import write_emitted as write_emitted
from modeler.core.contract import Emitted as Emitted
