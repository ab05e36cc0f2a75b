"""Stage 5: C99 that needs no allocation and no library but <math.h>."""

from modeler.codegen.emit import emit as emit
from modeler.codegen.package import leftovers as leftovers
from modeler.codegen.package import write_emitted as write_emitted
from modeler.core.manifest import Emitted as Emitted
