"""Stage 5: C99 that needs no allocation and no library but <math.h>."""

from modeler.codegen.emit import emit as emit
from modeler.codegen.write import edited_leftovers as edited_leftovers
from modeler.codegen.write import write_emitted as write_emitted
from modeler.core.contract import Emitted as Emitted
