from . import long_logs as long_logs, model_file as model_file, two_step_result as two_step_result
from .covariance import (
    autocorrelation as autocorrelation,
    remembered as remembered,
    repeated_whole as repeated_whole,
)
from .direct_model import (
    ControlLoop as ControlLoop,
    DirectModel as DirectModel,
    scaled_inertia as scaled_inertia,
)
from .doubts import not_together as not_together, remounted as remounted
from .drive_gains import (
    GainFit as GainFit,
    are_currents as are_currents,
    check_currents as check_currents,
    identify_gains as identify_gains,
    in_drive_units as in_drive_units,
)
from .energy_fit import identify_energy as identify_energy
from .findings import log_findings as log_findings
from .identify import (
    Equations as Equations,
    dead_joints as dead_joints,
    identify as identify,
    relative_errors as relative_errors,
)
from .known import deviations as deviations, known_doubts as known_doubts
from .least_squares import least_squares as least_squares, solve_by_qr as solve_by_qr
from .long_logs import (
    OF_TRIANGLES as OF_TRIANGLES,
    all_rows as all_rows,
    by_threads as by_threads,
    stream as stream,
)
from .model_file import (
    Addition as Addition,
    IdentifiedModel as IdentifiedModel,
    load_model as load_model,
    provenance as provenance,
    save_model as save_model,
    with_essential_only as with_essential_only,
)
from .nearest_body import (
    PREFIXES as PREFIXES,
    Machine as Machine,
    body as body,
    machine_of as machine_of,
    nearest_possible as nearest_possible,
    parameters_of as parameters_of,
    pseudo_inertia_of as pseudo_inertia_of,
)
from .parameter import prior_text as prior_text, spread_text as spread_text
from .payload import (
    Payload as Payload,
    identify_with_payloads as identify_with_payloads,
    loaded_equations as loaded_equations,
    with_load as with_load,
)
from .prior import (
    Prior as Prior,
    body_covariance as body_covariance,
    describe_unused_prior as describe_unused_prior,
    prior_of as prior_of,
)
from .result import (
    FitResult as FitResult,
    ParameterEstimate as ParameterEstimate,
    friction_by_direction as friction_by_direction,
)
from .side_by_side import SideBySide as SideBySide, Tried as Tried, side_by_side as side_by_side
from .two_step import Directions as Directions
from .two_step_result import (
    TwoStepFit as TwoStepFit,
    identify_in_two_steps as identify_in_two_steps,
)
from .verdict import contradictions as contradictions, with_verdict as with_verdict
