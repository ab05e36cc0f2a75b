"""From a table to the model linear in its parameters, and to base parameters with their proof."""

from modeler.derivation.base_parameters import base_parameters as base_parameters
from modeler.derivation.derive import derive_model as derive_model
from modeler.derivation.model import SymbolicModel as SymbolicModel
from modeler.derivation.result import BaseParameters as BaseParameters
