"""Estimators of the base parameters, their certainty, the verdict of a fit, and the model file."""

from modeler.estimation.drive_gains import GainFit as GainFit
from modeler.estimation.drive_gains import are_currents as are_currents
from modeler.estimation.drive_gains import check_currents as check_currents
from modeler.estimation.drive_gains import identify_gains as identify_gains
from modeler.estimation.drive_gains import in_drive_units as in_drive_units
from modeler.estimation.energy_fit import EnergyFit as EnergyFit
from modeler.estimation.energy_fit import identify_energy as identify_energy
from modeler.estimation.essential import Essential as Essential
from modeler.estimation.identify import identify as identify
from modeler.estimation.known import known_doubts as known_doubts
from modeler.estimation.model_file import Addition as Addition
from modeler.estimation.model_file import IdentifiedModel as IdentifiedModel
from modeler.estimation.model_file import LogProvenance as LogProvenance
from modeler.estimation.model_file import fitted_spec as fitted_spec
from modeler.estimation.model_file import load_model as load_model
from modeler.estimation.model_file import provenance as provenance
from modeler.estimation.model_file import save_model as save_model
from modeler.estimation.payload import Payload as Payload
from modeler.estimation.payload import identify_with_payloads as identify_with_payloads
from modeler.estimation.result import FitResult as FitResult
from modeler.estimation.result import JointFit as JointFit
from modeler.estimation.result import ParameterEstimate as ParameterEstimate
from modeler.estimation.result import Verdict as Verdict
from modeler.estimation.verdict import contradictions as contradictions
from modeler.estimation.verdict import with_verdict as with_verdict
