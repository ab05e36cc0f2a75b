"""Small robots for the simulator's tests, and the same robots built for Pinocchio by hand."""

import numpy as np
import pinocchio as pin

from modeler.robot.read import robot_from_text
from modeler.robot.robot import Robot
from modeler.simulation import PlantParameters
from tests.elementary_motions import row_pose

PENDULUM = """
name = "pendulum"
gravity = [0, "-9.81", 0]
[mdh]
columns = ["j", "a", "theta"]
rows = [["1", "0", "q1"]]
"""

TWO_LINK = """
name = "two"
gravity = [0, "-9.81", 0]
[mdh]
columns = ["j", "a", "d", "theta"]
rows = [["1", "0", 0, "q1"], ["2", "1", 0.5, "q2"]]
"""

ARM = """
name = "arm"
gravity = [0.3, -0.2, -9.7]
[symbols]
D3 = 0.4
[mdh]
columns = ["j", "a", "sigma", "gamma", "b", "alpha", "d", "theta", "r"]
rows = [
  ["1", "0", 0, 0,   0,   0.1,     0.05, "q1 + pi/2", 0.3],
  ["2", "1", 0, 0,   0,   "pi/2",  0.1,  "q2",        0.02],
  ["3", "2", 0, 0.3, 0.1, "-pi/3", "D3", "q3",        0.05],
]
[effects]
rotor_inertia = "all"
viscous = "all"
coulomb = "all"
offset = "all"
"""

SIX = """
name = "six"
gravity = [0, 0, -9.81]
[mdh]
columns = ["j", "a", "alpha", "d", "theta", "r"]
rows = [
  ["1", "0", 0,       0,    "q1",        0.4],
  ["2", "1", "pi/2",  0.05, "q2 + pi/2", 0],
  ["3", "2", 0,       0.6,  "q3",        0.1],
  ["4", "3", "-pi/2", 0.1,  "q4",        0.5],
  ["5", "4", "pi/2",  0,    "q5",        0],
  ["6", "5", "-pi/2", 0,    "q6 - 0.2",  0.1],
]
[effects]
rotor_inertia = "all"
viscous = "all"
coulomb = "all"
offset = "all"
"""

# A prismatic joint, a branch, a frame fixed on a link, and a joint after that frame.
TREE = """
name = "tree"
gravity = [0, 0, -9.81]
[mdh]
columns = ["j", "a", "sigma", "gamma", "b", "alpha", "d", "theta", "r"]
rows = [
  ["1", "0", 0, 0,   0,   0,      0,   "q1", 0.2],
  ["2", "1", 1, 0.2, 0.1, "pi/2", 0.1, 0.4,  "q2 + 0.3"],
  ["3", "2", 0, 0,   0,   "pi/4", 0.2, "q3", 0],
  ["f", "1", 2, 0.5, 0.3, "pi/6", 0.1, 0.7,  0.2],
  ["4", "f", 0, 0,   0,   "pi/3", 0.1, "q4", 0.1],
]
[effects]
rotor_inertia = ["1", "4"]
"""

# As TREE, with joints of both kinds that run against z, first, between others and at the ends.
BACKWARDS = """
name = "backwards"
gravity = [0.3, -0.2, -9.7]
[mdh]
columns = ["j", "a", "sigma", "gamma", "b", "alpha", "d", "theta", "r"]
rows = [
  ["1", "0", 1, 0,   0,   0.2,    0,   0.1,        "-q1"],
  ["2", "1", 0, 0.2, 0.1, "pi/2", 0.1, "0.4 - q2", 0.2],
  ["3", "2", 1, 0,   0,   "pi/4", 0.2, 0.3,        "0.1 - q3"],
  ["4", "3", 0, 0,   0,   "pi/3", 0.1, "q4",       0.1],
  ["f", "2", 2, 0.5, 0.3, "pi/6", 0.1, 0.7,        0.2],
  ["5", "f", 0, 0,   0,   "pi/3", 0.1, "-q5",      0.1],
  ["6", "5", 1, 0,   0,   "pi/2", 0,   0,          "-q6"],
]
[effects]
rotor_inertia = ["2", "3"]
viscous = "all"
"""

# A crank that drives a slider, without relations or limits; every length is known in closed form.
CRANK = """
name = "crank"
gravity = [0, "-g", 0]
[symbols]
g = 9.81
R = 0.10
L = 0.35
[mdh]
columns = ["j", "a", "mu", "sigma", "gamma", "alpha", "d", "theta", "r"]
rows = [
  ["1",   "0", 1, 0, 0,      0,      0,   "q1", 0],
  ["2",   "1", 0, 0, 0,      0,      "R", "q2", 0],
  ["tip", "2", 0, 2, 0,      0,      "L", 0,    0],
  ["3",   "0", 0, 1, "pi/2", "pi/2", 0,   0,    "q3"],
]
[loops]
columns = ["loop", "frame", "meets", "joint"]
rows = [["pin", "tip", "3", "position"]]
[home]
q1 = "pi/2"
q2 = -1.86
q3 = 0.33
"""


def robot(text: str, **changes: str) -> Robot:
    """The robot of the text, with further tables appended: robot(ARM, limits="1 = ...")."""
    tables = "".join(f"\n[{name}]\n{lines}\n" for name, lines in changes.items())
    return robot_from_text(text + tables, "test.toml")


def pinocchio_model(source: Robot, parameters: PlantParameters) -> pin.Model:
    """The robot as Pinocchio bodies, from joint placements multiplied out here with numpy."""
    symbols = source.symbol_values()
    model = pin.Model()
    model.gravity.linear = np.array([cell.number(symbols) for cell in source.gravity])
    holders = {"0": (0, np.eye(4))}  # frame -> (joint it is fixed on, its pose there)
    for row in source.joints:
        values = {**symbols, row.variable: 0.0}
        cells = ("gamma", "b", "alpha", "d", "theta", "r")
        pose = row_pose(*(getattr(row, cell).number(values) for cell in cells))
        holder, there = holders[row.antecedent]
        if not row.moves:
            holders[row.name] = (holder, there @ pose)
            continue
        cell = row.theta if row.angular else row.r
        axis = np.array([0, 0, cell.number({**values, row.variable: 1.0}) - cell.number(values)])
        axis = axis.round(12)
        revolute, prismatic = pin.JointModelRevoluteUnaligned, pin.JointModelPrismaticUnaligned
        kind = revolute(axis) if row.angular else prismatic(axis)
        index = model.addJoint(holder, kind, pin.SE3(there @ pose), row.name)
        body = parameters.bodies[row.name]
        inertia = pin.Inertia(body.mass, body.centre, body.inertia)
        model.appendBodyToJoint(index, inertia, pin.SE3.Identity())
        holders[row.name] = (index, np.eye(4))
    armature = [parameters.standard.get(f"Ia{row.name}", 0.0) for row in source.moving]
    model.armature = np.array(armature)
    return model
