from .checks import compare as compare, contest as contest, free_run as free_run
from .exporting import export as export
from .fitting import (
    Load as Load,
    fit as fit,
    fit_gains as fit_gains,
    identified as identified,
    side_by_side as side_by_side,
)
from .fleets import fleet as fleet
from .identifying import identify as identify
from .improve import (
    add as add,
    add_discoveries as add_discoveries,
    auto as auto,
    diagnose as diagnose,
    undo as undo,
)
from .log_maps import (
    Mapped as Mapped,
    file_and_span as file_and_span,
    log_map as log_map,
    look_at as look_at,
    settled as settled,
)
from .model import (
    Model as Model,
    Parameter as Parameter,
    load as load,
    open_model as open_model,
    open_robot as open_robot,
)
from .motion import (
    check_motion as check_motion,
    excite as excite,
    forecast as forecast,
    simulate as simulate,
    tell_apart as tell_apart,
)
from .pages import write_report as write_report
from .physical_parameters import physical as physical
from .postures import at_home as at_home, home as home
from .reexports import (
    Asked as Asked,
    Comparison as Comparison,
    CompiledModel as CompiledModel,
    Derivation as Derivation,
    Diagnosis as Diagnosis,
    Emitted as Emitted,
    Exported as Exported,
    FitResult as FitResult,
    FitWarning as FitWarning,
    Fleet as Fleet,
    FreeRunSettings as FreeRunSettings,
    GpuModel as GpuModel,
    IdentifiedModel as IdentifiedModel,
    Log as Log,
    Observation as Observation,
    Payload as Payload,
    Processing as Processing,
    Robot as Robot,
    show as show,
)
from .workflow import (
    AnyLog as AnyLog,
    compile_model as compile_model,
    convert as convert,
    derive as derive,
    effects as effects,
    estimators as estimators,
    generate as generate,
    new_robot as new_robot,
    observe as observe,
    on_gpu as on_gpu,
    own_effect as own_effect,
    read_currents as read_currents,
    read_logs as read_logs,
    recompile as recompile,
    reduced as reduced,
    robots as robots,
    save as save,
)
