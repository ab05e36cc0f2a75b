"""Estimates of the base parameters, their certainty, and the model file."""

from modeler.core.choices import Method as Method
from modeler.fit.drive_gains import GainFit as GainFit
from modeler.fit.drive_gains import are_currents as are_currents
from modeler.fit.drive_gains import check_currents as check_currents
from modeler.fit.drive_gains import identify_gains as identify_gains
from modeler.fit.drive_gains import in_drive_units as in_drive_units
from modeler.fit.emitted import fitted_spec as fitted_spec
from modeler.fit.energy import EnergyFit as EnergyFit
from modeler.fit.energy import identify_energy as identify_energy
from modeler.fit.essential import Essential as Essential
from modeler.fit.identify import identify as identify
from modeler.fit.known import known_doubts as known_doubts
from modeler.fit.model_file import Addition as Addition
from modeler.fit.model_file import IdentifiedModel as IdentifiedModel
from modeler.fit.model_file import LogProvenance as LogProvenance
from modeler.fit.model_file import load_model as load_model
from modeler.fit.model_file import provenance as provenance
from modeler.fit.model_file import save_model as save_model
from modeler.fit.payload import Payload as Payload
from modeler.fit.payload import identify_with_payloads as identify_with_payloads
from modeler.fit.result import FitResult as FitResult
from modeler.fit.result import JointFit as JointFit
from modeler.fit.result import ParameterEstimate as ParameterEstimate
from modeler.fit.result import Verdict as Verdict
from modeler.fit.verdict import contradictions as contradictions
from modeler.fit.verdict import with_verdict as with_verdict
