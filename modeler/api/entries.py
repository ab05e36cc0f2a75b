"""What `modeler.api` offers, each function with the door before it."""

import modeler.api.arguments as door
from modeler.api.checks import (
    compare as compare,
    contest as contest,
    free_run as free_run,
    look_at as look_at,
)
from modeler.api.fitting import (
    Load as Load,
    fit as fit,
    fit_gains as fit_gains,
    identified as identified,
    side_by_side as side_by_side,
)
from modeler.api.fleets import fleet as fleet
from modeler.api.improve import add as add, auto as auto, diagnose as diagnose, undo as undo
from modeler.api.motion import excite as excite, simulate as simulate, tell_apart as tell_apart
from modeler.api.pages import write_report as write_report
from modeler.api.physical_parameters import physical as physical
from modeler.api.postures import at_home as at_home, home as home
from modeler.api.workflow import (
    AnyLog as AnyLog,
    Mapped as Mapped,
    compile_model as compile_model,
    derive as derive,
    effects as effects,
    estimators as estimators,
    file_and_span as file_and_span,
    generate as generate,
    load as load,
    log_map as log_map,
    observe as observe,
    on_gpu as on_gpu,
    open_model as open_model,
    own_effect as own_effect,
    read_currents as read_currents,
    read_logs as read_logs,
    recompile as recompile,
    reduced as reduced,
    robots as robots,
    save as save,
)
from modeler.codegen import Derivation as Derivation
from modeler.core.manifest import Emitted as Emitted
from modeler.diagnosis import Diagnosis as Diagnosis
from modeler.estimation import (
    FitResult as FitResult,
    IdentifiedModel as IdentifiedModel,
    Payload as Payload,
)
from modeler.fleet import Fleet as Fleet
from modeler.observation import Log as Log, Observation as Observation, Processing as Processing
from modeler.report import show as show
from modeler.robot import Robot as Robot
from modeler.runtime import CompiledModel as CompiledModel, GpuModel as GpuModel
from modeler.validation import Comparison as Comparison, FreeRunSettings as FreeRunSettings

Asked = FreeRunSettings
"""As scripts and docs/free-run.md call it."""

door.guard(globals())
