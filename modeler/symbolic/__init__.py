"""Stage 2: the model as expressions, linear in the standard parameters."""

from modeler.symbolic.assembly_modes import AssemblyMode as AssemblyMode
from modeler.symbolic.closure import Closure as Closure
from modeler.symbolic.columns import LinkColumn as LinkColumn
from modeler.symbolic.columns import ShaftColumn as ShaftColumn
from modeler.symbolic.columns import StandardColumn as StandardColumn
from modeler.symbolic.columns import in_block as in_block
from modeler.symbolic.columns import link_column as link_column
from modeler.symbolic.derive import derive_model as derive_model
from modeler.symbolic.derive import modes_near as modes_near
from modeler.symbolic.derive import with_home as with_home
from modeler.symbolic.geometry import Geometry as Geometry
from modeler.symbolic.geometry import exact_geometry as exact_geometry
from modeler.symbolic.graph import Expr as Expr
from modeler.symbolic.graph import Graph as Graph
from modeler.symbolic.home import HomeModes as HomeModes
from modeler.symbolic.home import written as written
from modeler.symbolic.linkage import Linkage as Linkage
from modeler.symbolic.model import SymbolicModel as SymbolicModel
