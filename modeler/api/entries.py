"""What `modeler.api` offers, each function with the door before it."""

import modeler.api.door as door
from modeler.api.catalogue import effects as effects
from modeler.api.catalogue import estimators as estimators
from modeler.api.catalogue import robots as robots
from modeler.api.chain import AnyLog as AnyLog
from modeler.api.chain import Mapped as Mapped
from modeler.api.chain import compile_model as compile_model
from modeler.api.chain import derive as derive
from modeler.api.chain import file_and_span as file_and_span
from modeler.api.chain import fit as fit
from modeler.api.chain import generate as generate
from modeler.api.chain import identified as identified
from modeler.api.chain import load as load
from modeler.api.chain import log_map as log_map
from modeler.api.chain import observe as observe
from modeler.api.chain import own_effect as own_effect
from modeler.api.chain import read_currents as read_currents
from modeler.api.chain import read_logs as read_logs
from modeler.api.chain import recompile as recompile
from modeler.api.chain import reduced as reduced
from modeler.api.contests import contest as contest
from modeler.api.exciting import excite as excite
from modeler.api.exciting import tell_apart as tell_apart
from modeler.api.files import open_model as open_model
from modeler.api.files import save as save
from modeler.api.freeruns import free_run as free_run
from modeler.api.gains import Load as Load
from modeler.api.gains import fit_gains as fit_gains
from modeler.api.improving import add as add
from modeler.api.improving import auto as auto
from modeler.api.improving import undo as undo
from modeler.api.judging import compare as compare
from modeler.api.judging import diagnose as diagnose
from modeler.api.letters import physical as physical
from modeler.api.looking import look_at as look_at
from modeler.api.postures import at_home as at_home
from modeler.api.postures import home as home
from modeler.api.reports import write_report as write_report
from modeler.api.simulating import simulate as simulate
from modeler.api.trials import side_by_side as side_by_side
from modeler.compare import Comparison as Comparison
from modeler.compiled import CompiledModel as CompiledModel
from modeler.core.contract import Emitted as Emitted
from modeler.derivation import Derivation as Derivation
from modeler.diagnose import Diagnosis as Diagnosis
from modeler.fit import FitResult as FitResult
from modeler.fit import IdentifiedModel as IdentifiedModel
from modeler.fit import Payload as Payload
from modeler.freerun import Asked as Asked
from modeler.observation import Log as Log
from modeler.observation import Observation as Observation
from modeler.observation import Processing as Processing
from modeler.robot import Robot as Robot
from modeler.showing import show as show

door.guard(globals())
