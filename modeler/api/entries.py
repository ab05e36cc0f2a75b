"""What `modeler.api` offers, each function with the door before it."""

import modeler.api.arguments as door
from modeler.api.checks import compare as compare
from modeler.api.checks import contest as contest
from modeler.api.checks import free_run as free_run
from modeler.api.checks import look_at as look_at
from modeler.api.fitting import Load as Load
from modeler.api.fitting import fit as fit
from modeler.api.fitting import fit_gains as fit_gains
from modeler.api.fitting import identified as identified
from modeler.api.fitting import side_by_side as side_by_side
from modeler.api.fleets import fleet as fleet
from modeler.api.improve import add as add
from modeler.api.improve import auto as auto
from modeler.api.improve import diagnose as diagnose
from modeler.api.improve import undo as undo
from modeler.api.motion import excite as excite
from modeler.api.motion import simulate as simulate
from modeler.api.motion import tell_apart as tell_apart
from modeler.api.pages import write_report as write_report
from modeler.api.physical_parameters import physical as physical
from modeler.api.postures import at_home as at_home
from modeler.api.postures import home as home
from modeler.api.workflow import AnyLog as AnyLog
from modeler.api.workflow import Mapped as Mapped
from modeler.api.workflow import compile_model as compile_model
from modeler.api.workflow import derive as derive
from modeler.api.workflow import effects as effects
from modeler.api.workflow import estimators as estimators
from modeler.api.workflow import file_and_span as file_and_span
from modeler.api.workflow import generate as generate
from modeler.api.workflow import load as load
from modeler.api.workflow import log_map as log_map
from modeler.api.workflow import observe as observe
from modeler.api.workflow import on_gpu as on_gpu
from modeler.api.workflow import open_model as open_model
from modeler.api.workflow import own_effect as own_effect
from modeler.api.workflow import read_currents as read_currents
from modeler.api.workflow import read_logs as read_logs
from modeler.api.workflow import recompile as recompile
from modeler.api.workflow import reduced as reduced
from modeler.api.workflow import robots as robots
from modeler.api.workflow import save as save
from modeler.codegen.workflow import Derivation as Derivation
from modeler.core.manifest import Emitted as Emitted
from modeler.diagnosis.result import Diagnosis as Diagnosis
from modeler.estimation.model_file import IdentifiedModel as IdentifiedModel
from modeler.estimation.payload import Payload as Payload
from modeler.estimation.result import FitResult as FitResult
from modeler.fleet.result import Fleet as Fleet
from modeler.observation.log import Log as Log
from modeler.observation.observation import Observation as Observation
from modeler.observation.settings import Processing as Processing
from modeler.report.robot_page import show as show
from modeler.robot.robot import Robot as Robot
from modeler.runtime.gpu import GpuModel as GpuModel
from modeler.runtime.model import CompiledModel as CompiledModel
from modeler.validation.comparison import Comparison as Comparison
from modeler.validation.free_run import FreeRunSettings as FreeRunSettings

Asked = FreeRunSettings
"""As scripts and docs/free-run.md call it."""

door.guard(globals())
