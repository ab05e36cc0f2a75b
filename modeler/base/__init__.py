"""Stage 3: base (minimal) parameters, exactly."""

from modeler.base.agreement import grouping_matrix as grouping_matrix
from modeler.base.derive import base_parameters as base_parameters
from modeler.base.result import BaseParameter as BaseParameter
from modeler.base.result import BaseParameters as BaseParameters
from modeler.base.result import Proof as Proof
from modeler.base.result import Term as Term
