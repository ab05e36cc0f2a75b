"""All of modeler from Python: a robot, its parameters, its C, a model from logs, what it lacks.

    from modeler.api import auto, compare, compile_model, derive, diagnose, fit, generate, load
    from modeler.api import observe, simulate

    robot = load("emps")                               # a file, or the name of a built-in robot
    derivation = derive(robot)                         # base parameters, exactly
    emitted = generate(derivation, "emps_c")           # C, header, manifest, build files
    compiled = compile_model(emitted)
    observation = observe(compiled, ["train.parquet"])
    model = fit(derivation, emitted, observation)
    print(compare(model, ["pulses.parquet"]).summary())

Every result has a short `repr`, a `summary()`, its tables (`table(name)`, `to_frame(name)`), most a
figure (`plot(name)`), and HTML for a notebook; docs/python.md lists them. The functions of a name
that a stage has too are that stage's, with the usual choices; use the stages for others.
"""

import modeler.api.door as door
import modeler.notebook as notebook
from modeler.api.catalogue import effects as effects
from modeler.api.catalogue import estimators as estimators
from modeler.api.catalogue import robots as robots
from modeler.api.chain import AnyLog as AnyLog
from modeler.api.chain import Derivation as Derivation
from modeler.api.chain import Mapped as Mapped
from modeler.api.chain import compare as compare
from modeler.api.chain import compile_model as compile_model
from modeler.api.chain import derive as derive
from modeler.api.chain import diagnose as diagnose
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
from modeler.api.chain import show as show
from modeler.api.contests import contest as contest
from modeler.api.exciting import excite as excite
from modeler.api.exciting import tell_apart as tell_apart
from modeler.api.files import open_model as open_model
from modeler.api.files import save as save
from modeler.api.fleets import fleet as fleet
from modeler.api.freeruns import free_run as free_run
from modeler.api.gains import Load as Load
from modeler.api.gains import fit_gains as fit_gains
from modeler.api.improving import add as add
from modeler.api.improving import auto as auto
from modeler.api.improving import undo as undo
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
from modeler.diagnose import Diagnosis as Diagnosis
from modeler.fit import FitResult as FitResult
from modeler.fit import IdentifiedModel as IdentifiedModel
from modeler.fit import Payload as Payload
from modeler.fleet import Fleet as Fleet
from modeler.freerun import Asked as Asked
from modeler.observation import Log as Log
from modeler.observation import Observation as Observation
from modeler.observation import Processing as Processing
from modeler.robot import Robot as Robot

notebook.register()
door.guard(globals())
