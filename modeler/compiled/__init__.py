"""Stage 6: emitted C made callable. Knows manifests and C text, nothing of symbols."""

from modeler.compiled.model import CompiledModel as CompiledModel
from modeler.compiled.model import load as load
from modeler.compiled.model import load_folder as load_folder
from modeler.core.contract import Emitted as Emitted
from modeler.core.contract import ModuleSpec as ModuleSpec
from modeler.core.contract import module_from_json as module_from_json
