"""Emitted C made callable. Knows manifests and C text, nothing of symbols."""

from modeler.runtime.model import CompiledModel as CompiledModel
from modeler.runtime.model import load as load
from modeler.runtime.model import load_folder as load_folder
