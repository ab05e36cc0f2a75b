"""Stage 1: what the user states. Data, no derivation."""

from modeler.core.builtin import builtin_names as builtin_names
from modeler.core.builtin import builtin_text as builtin_text
from modeler.robot.read import read_robot as read_robot
from modeler.robot.read import robot_from_text as robot_from_text
from modeler.robot.robot import INERTIAL as INERTIAL
from modeler.robot.robot import LOOP_KINDS as LOOP_KINDS
from modeler.robot.robot import EffectUse as EffectUse
from modeler.robot.robot import Joint as Joint
from modeler.robot.robot import JointKind as JointKind
from modeler.robot.robot import Limits as Limits
from modeler.robot.robot import Loop as Loop
from modeler.robot.robot import PhysicalLink as PhysicalLink
from modeler.robot.robot import Robot as Robot
from modeler.robot.robot import SharedParameter as SharedParameter
