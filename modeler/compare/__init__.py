"""Stage 8: is it true? Measured against predicted torque, and where the difference sits."""

from modeler.compare.comparison import Comparison as Comparison
from modeler.compare.comparison import JointComparison as JointComparison
from modeler.compare.comparison import compare as compare
from modeler.compare.pictures import write_pictures as write_pictures
from modeler.compare.prediction import JointInfo as JointInfo
from modeler.compare.prediction import Prediction as Prediction
from modeler.compare.prediction import check_prediction as check_prediction
from modeler.compare.verdict import headline as headline
from modeler.compare.verdict import joint_verdict as joint_verdict
from modeler.compare.verdict import verdict as verdict
