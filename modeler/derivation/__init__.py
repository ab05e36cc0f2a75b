"""From a table to the model linear in its parameters, and to base parameters with their proof."""

from modeler.derivation.assembly_modes import AssemblyMode as AssemblyMode
from modeler.derivation.base_parameters import base_parameters as base_parameters
from modeler.derivation.closure import Closure as Closure
from modeler.derivation.columns import LinkColumn as LinkColumn
from modeler.derivation.columns import ShaftColumn as ShaftColumn
from modeler.derivation.columns import StandardColumn as StandardColumn
from modeler.derivation.columns import in_block as in_block
from modeler.derivation.columns import link_column as link_column
from modeler.derivation.derive import derive_model as derive_model
from modeler.derivation.derive import modes_near as modes_near
from modeler.derivation.derive import with_home as with_home
from modeler.derivation.geometry import Geometry as Geometry
from modeler.derivation.geometry import exact_geometry as exact_geometry
from modeler.derivation.graph import Expr as Expr
from modeler.derivation.graph import Graph as Graph
from modeler.derivation.home import HomeModes as HomeModes
from modeler.derivation.home import written as written
from modeler.derivation.model import SymbolicModel as SymbolicModel
from modeler.derivation.numeric_rank import grouping_matrix as grouping_matrix
from modeler.derivation.result import BaseParameter as BaseParameter
from modeler.derivation.result import BaseParameters as BaseParameters
from modeler.derivation.result import Proof as Proof
from modeler.derivation.result import Term as Term
from modeler.derivation.walks import Linkage as Linkage
