"""What other packages define and `modeler.api` hands on: the things its functions take and give."""

from modeler.codegen import Derivation as Derivation
from modeler.core.errors import FitWarning as FitWarning
from modeler.core.manifest import EmittedModule as EmittedModule
from modeler.diagnosis import Diagnosis as Diagnosis
from modeler.estimation import (
    FitResult as FitResult,
    IdentifiedModel as IdentifiedModel,
    Payload as Payload,
)
from modeler.formats import Exported as Exported
from modeler.regression import Log as Log, Observation as Observation, Processing as Processing
from modeler.robot import Robot as Robot
from modeler.runtime import CompiledModel as CompiledModel, GpuModel as GpuModel
from modeler.validation import (
    Comparison as Comparison,
    Fleet as Fleet,
    FreeRunSettings as FreeRunSettings,
)
from modeler.views import show as show

Asked = FreeRunSettings
"""As scripts and docs/how-to/free-run.md call it."""
