from . import long_logs as long_logs, model_file as model_file
from .covariance import (
    estimate_autocorrelation as estimate_autocorrelation,
    estimate_correlation as estimate_correlation,
    sum_lagged_products as sum_lagged_products,
)
from .drive_gains import (
    GainFit as GainFit,
    are_currents as are_currents,
    check_currents as check_currents,
    check_known_quantities as check_known_quantities,
    describe_deviations as describe_deviations,
    identify_gains as identify_gains,
    set_unit_gains as set_unit_gains,
)
from .energy_fit import identify_energy as identify_energy
from .identify import (
    Equations as Equations,
    MethodComparison as MethodComparison,
    MethodResult as MethodResult,
    compare_methods as compare_methods,
    compute_relative_errors as compute_relative_errors,
    find_disconnected_joints as find_disconnected_joints,
    find_methods as find_methods,
    identify as identify,
    identify_elastic as identify_elastic,
)
from .instrumental import (
    ControlLoop as ControlLoop,
    DirectModel as DirectModel,
    scale_inertia as scale_inertia,
)
from .least_squares import solve_by_qr as solve_by_qr, solve_least_squares as solve_least_squares
from .log_faults import find_log_faults as find_log_faults
from .long_logs import (
    OF_TRIANGLES as OF_TRIANGLES,
    read_all_rows as read_all_rows,
    reduce_by_threads as reduce_by_threads,
    stream_logs as stream_logs,
)
from .machine_change import (
    MachineComparison as MachineComparison,
    ParameterChange as ParameterChange,
    SingleFit as SingleFit,
    build_load_columns as build_load_columns,
    compare_machines as compare_machines,
    convert_model_fit as convert_model_fit,
    fit_machine as fit_machine,
    merge_sums as merge_sums,
    sum_machine_rows as sum_machine_rows,
    sum_observation as sum_observation,
)
from .model_file import (
    Addition as Addition,
    IdentifiedModel as IdentifiedModel,
    collect_provenance as collect_provenance,
    keep_essential as keep_essential,
    load_model as load_model,
    save_model as save_model,
)
from .parameters import (
    ParameterEstimate as ParameterEstimate,
    format_prior as format_prior,
    format_spread as format_spread,
)
from .payload import (
    Payload as Payload,
    add_known_load as add_known_load,
    build_loaded_equations as build_loaded_equations,
    find_heterogeneous_logs as find_heterogeneous_logs,
    identify_with_payloads as identify_with_payloads,
    separate_payload as separate_payload,
)
from .physical_consistency import (
    PREFIXES as PREFIXES,
    PhysicalParameters as PhysicalParameters,
    compute_pseudo_inertia as compute_pseudo_inertia,
    define_body as define_body,
    define_physical_parameters as define_physical_parameters,
    extract_parameters as extract_parameters,
    project_parameters as project_parameters,
)
from .prior import (
    Prior as Prior,
    build_prior as build_prior,
    compute_body_covariance as compute_body_covariance,
    describe_unused_prior as describe_unused_prior,
)
from .result import (
    FitResult as FitResult,
    compute_friction_by_direction as compute_friction_by_direction,
)
from .single_joint import JointDirections as JointDirections
from .thresholds import THRESHOLDS as THRESHOLDS
from .two_step import TwoStepFit as TwoStepFit, identify_in_two_steps as identify_in_two_steps
from .verdict import find_contradictions as find_contradictions, judge_fit as judge_fit
from .windup import (
    Motion as Motion,
    Windup as Windup,
    WindupProblem as WindupProblem,
    read_windup as read_windup,
)
