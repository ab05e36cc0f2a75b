"""Is a model true? Measured against predicted torque, simulated against logged motion."""

from modeler.validation.comparison import Comparison as Comparison
from modeler.validation.comparison import JointComparison as JointComparison
from modeler.validation.comparison import compare as compare
from modeler.validation.free_run import FreeRunSettings as FreeRunSettings
from modeler.validation.free_run import free_run as free_run
from modeler.validation.free_run_result import FreeRun as FreeRun
from modeler.validation.free_run_result import JointFreeRun as JointFreeRun
from modeler.validation.prediction import JointInfo as JointInfo
from modeler.validation.prediction import Prediction as Prediction
from modeler.validation.verdict import headline as headline
from modeler.validation.verdict import joint_verdict as joint_verdict
from modeler.validation.verdict import verdict as verdict
