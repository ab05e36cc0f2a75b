"""What `import modeler` offers: the names of `modeler.api`, loaded when they are used.

Of `effects`, which is a package, the function is `modeler.api.effects`.
"""

from modeler.api import (
    AnyLog as AnyLog,
    Asked as Asked,
    Load as Load,
    Mapped as Mapped,
    Model as Model,
    Parameter as Parameter,
    add_all as add_all,
    add_discoveries as add_discoveries,
    assemble_model as assemble_model,
    build_log_map as build_log_map,
    check_motion as check_motion,
    compile as compile,
    compile_model as compile_model,
    define_effect as define_effect,
    discriminating_motion as discriminating_motion,
    estimators as estimators,
    excite as excite,
    expected_sigmas as expected_sigmas,
    export as export,
    fit_gains as fit_gains,
    free_run as free_run,
    home as home,
    home_posture as home_posture,
    load_on_gpu as load_on_gpu,
    open_model as open_model,
    open_robot as open_robot,
    parse_time_range as parse_time_range,
    physical as physical,
    read_currents as read_currents,
    read_logs as read_logs,
    reduced_model as reduced_model,
    remove_last as remove_last,
    resolve_mapping as resolve_mapping,
    robots as robots,
    save as save,
    write_report as write_report,
)
from modeler.codegen import Derivation as Derivation, derive as derive
from modeler.core.errors import FitWarning as FitWarning
from modeler.core.manifest import EmittedModule as EmittedModule
from modeler.diagnosis import Diagnosis as Diagnosis
from modeler.estimation import (
    FitResult as FitResult,
    IdentifiedModel as IdentifiedModel,
    Payload as Payload,
)
from modeler.formats import Exported as Exported, convert as convert
from modeler.regression import Log as Log, Observation as Observation, Processing as Processing
from modeler.robot import Robot as Robot, new_robot as new_robot
from modeler.runtime import CompiledModel as CompiledModel, GpuModel as GpuModel
from modeler.validation import (
    Comparison as Comparison,
    Fleet as Fleet,
    FreeRunSettings as FreeRunSettings,
)
from modeler.views import show as show

from .api import (
    add as add,
    compare as compare,
    compare_methods as compare_methods,
    compare_models as compare_models,
    diagnose as diagnose,
    fit as fit,
    fleet as fleet,
    generate as generate,
    identify as identify,
    inspect_log as inspect_log,
    load as load,
    observe as observe,
    simulate as simulate,
)

__version__: str
