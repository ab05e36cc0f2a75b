from .checks import (
    compare as compare,
    compare_methods as compare_methods,
    compare_models as compare_models,
    free_run as free_run,
)
from .exporting import export as export, write_report as write_report
from .fitting import (
    Load as Load,
    assemble_model as assemble_model,
    fit as fit,
    fit_gains as fit_gains,
    identify as identify,
)
from .fleets import fleet as fleet
from .improve import (
    add as add,
    add_all as add_all,
    add_discoveries as add_discoveries,
    diagnose as diagnose,
    remove_last as remove_last,
)
from .log_maps import (
    Mapped as Mapped,
    build_log_map as build_log_map,
    inspect_log as inspect_log,
    parse_time_range as parse_time_range,
    resolve_mapping as resolve_mapping,
)
from .model import (
    Model as Model,
    Parameter as Parameter,
    load as load,
    open_model as open_model,
    open_robot as open_robot,
)
from .motion import (
    discriminating_motion as discriminating_motion,
    excite as excite,
    expected_sigmas as expected_sigmas,
    simulate as simulate,
)
from .motion_bounds import check_motion as check_motion
from .physical_parameters import physical as physical
from .postures import home as home, home_posture as home_posture
from .reexports import (
    Asked as Asked,
    Comparison as Comparison,
    CompiledModel as CompiledModel,
    Derivation as Derivation,
    Diagnosis as Diagnosis,
    EmittedModule as EmittedModule,
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
    compile as compile,
    compile_model as compile_model,
    convert as convert,
    define_effect as define_effect,
    derive as derive,
    effects as effects,
    estimators as estimators,
    generate as generate,
    load_on_gpu as load_on_gpu,
    new_robot as new_robot,
    observe as observe,
    read_currents as read_currents,
    read_logs as read_logs,
    reduced_model as reduced_model,
    robots as robots,
    save as save,
)
