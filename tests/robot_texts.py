"""Texts of small robots that tests of several folders read."""

from modeler.robot.read import robot_from_text
from modeler.robot.robot import Robot

PENDULUM = """\
name = "pendulum"
gravity = [0, "-9.81", 0]
[mdh]
columns = ["j", "a", "theta"]
rows = [["1", "0", "q1"]]
"""

TWO_LINK = """\
name = "two"
gravity = [0, "-9.81", 0]
[mdh]
columns = ["j", "a", "d", "theta"]
rows = [["1", "0", 0, "q1"], ["2", "1", 0.5, "q2"]]
"""

ARM = """\
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

SIX = """\
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
TREE = """\
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
BACKWARDS = """\
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
CRANK = """\
name = "crank"
gravity = [0, "-g", 0]
[symbols]
g = 9.81
R = 0.10
L = 0.35
[mdh]
columns = ["j", "a", "mu", "sigma", "gamma", "alpha", "d", "theta", "r"]
rows = [
  ["1", "0", 1, 0, 0, 0, 0, "q1", 0],
  ["2", "1", 0, 0, 0, 0, "R", "q2", 0],
  ["tip", "2", 0, 2, 0, 0, "L", 0, 0],
  ["3", "0", 0, 1, "pi/2", "pi/2", 0, 0, "q3"],
]
[loops]
columns = ["loop", "frame", "meets", "joint"]
rows = [["pin", "tip", "3", "position"]]
[home]
q1 = "pi/2"
q2 = -1.86
q3 = 0.33
"""

PARALLELOGRAM = """\
name = "parallelogram"
gravity = [0, -9.81, 0]
[symbols]
L = 0.4
B = 0.7
[mdh]
columns = ["j", "a", "mu", "sigma", "d", "theta"]
rows = [
  ["1", "0", 1, 0, 0, "q1"],
  ["2", "1", 0, 0, "L", "q2"],
  ["3", "2", 0, 2, "B", 0],
  ["4", "0", 0, 0, "B", "q4"],
  ["5", "4", 0, 2, "L", 0],
]
[loops]
rows = [["pin", "3", "5", "position"]]
"""

FOUR_BAR = """\
name = "four-bar"
gravity = [0, 0, "-g"]
[symbols]
g = 9.81
a = 0.2
b = 0.45
c = 0.35
f = 0.4
[mdh]
columns = ["j", "a", "mu", "sigma", "alpha", "d", "theta"]
rows = [
  ["w", "0", 1, 0, 0, 0, "qw"],
  ["1", "w", 1, 0, "pi/2", 0, "q1"],
  ["2", "1", 0, 0, 0, "a", "q2"],
  ["w2", "w", 0, 2, "pi/2", "f", 0],
  ["3", "w2", 0, 0, 0, 0, "q3"],
  ["2e", "2", 0, 2, 0, "b", 0],
  ["3e", "3", 0, 2, 0, "c", 0],
]
[loops]
columns = ["loop", "frame", "meets", "joint"]
rows = [["p", "2e", "3e", "revolute"]]
[home]
q1 = 1.2
q2 = -0.8
q3 = 1.4
"""

PANTOGRAPH = """\
name = "pantograph"
gravity = [0, "-g", 0]
[symbols]
g = 9.81
a = 0.2
b = 0.35
c = 0.3
h = 0.18
[mdh]
columns = ["j", "a", "mu", "sigma", "alpha", "d", "theta", "r"]
rows = [
  ["x", "0", 1, 1, "pi/2", 0, 0, "qx"],
  ["xz", "x", 0, 2, "-pi/2", 0, 0, 0],
  ["1", "xz", 0, 0, 0, 0, "q1", 0],
  ["2", "1", 0, 0, 0, "a", "q2", 0],
  ["3", "1", 0, 0, 0, "a + b", "q3", 0],
  ["4", "2", 0, 0, 0, "c", "q4", 0],
  ["4e", "4", 0, 2, 0, "b", 0, 0],
  ["3e", "3", 0, 2, 0, "c", 0, 0],
  ["s0", "0", 0, 2, 0, "h", 0, 0],
  ["s", "s0", 1, 1, "pi/2", 0, 0, "qs"],
  ["se", "s", 0, 2, "-pi/2", 0, 0, 0],
]
[loops]
columns = ["loop", "frame", "meets", "joint"]
rows = [["p", "4e", "3e", "revolute"], ["t", "4", "se", "revolute"]]
[home]
q1 = 0.6
q2 = 0.9
q3 = 0.9
q4 = -0.9
qs = -0.41
"""

OFFSET = """\
name = "offset"
gravity = [0, "-g", 0]
[symbols]
g = 9.81
L = 0.5
D = 0.2
w = 0.4
[mdh]
columns = ["j", "a", "mu", "sigma", "gamma", "d", "theta"]
rows = [
  ["1", "0", 1, 0, 0, 0, "q1"],
  ["2", "0", 0, 0, "w", "D", "q2"],
  ["3", "1", 0, 0, 0, "L", "q3"],
  ["2e", "2", 0, 2, 0, "L", 0],
  ["3e", "3", 0, 2, "w", "D", 0],
]
[loops]
columns = ["loop", "frame", "meets", "joint"]
rows = [["p", "3e", "2e", "revolute"]]
[home]
q1 = 1.2
q2 = 0.8
q3 = -1.2
"""

RHOMBUS = """\
name = "rhombus"
gravity = [0, 0, 0]
[symbols]
L = 0.5
[mdh]
columns = ["j", "a", "mu", "sigma", "d", "theta"]
rows = [
  ["1", "0", 1, 0, 0, "q1"],
  ["2", "1", 0, 0, "L", "q2"],
  ["3", "2", 0, 0, "L", "q3"],
  ["4", "3", 0, 2, "L", 0],
  ["5", "0", 0, 2, "L", 0],
]
[loops]
columns = ["loop", "frame", "meets", "joint"]
rows = [["A", "4", "5", "position"]]
[home]
q1 = 1.0
q2 = -1.0
q3 = -2.1415926535897931
"""

BENNETT = """\
name = "bennett"
gravity = [0, 0, "-g"]
[symbols]
g = 9.81
al = 0.5
be = 1.1
a = 0.3
b = "a*sin(be)/sin(al)"
[mdh]
columns = ["j", "a", "mu", "sigma", "alpha", "d", "theta"]
rows = [
  ["1", "0", 1, 0, 0, 0, "q1"],
  ["2", "1", 0, 0, "al", "a", "q2"],
  ["3", "2", 0, 0, "be", "b", "q3"],
  ["3e", "3", 0, 2, "al", "a", 0],
  ["0e", "0", 0, 2, "-be", "-b", 0],
]
[loops]
columns = ["loop", "frame", "meets", "joint"]
rows = [["L", "3e", "0e", "revolute"]]
[home]
q1 = 0.8
"""
"""Closed at these lengths only: three of five equations follow from the others near home."""


def robot(text: str, **changes: str) -> Robot:
    """The robot of the text, with further tables appended: robot(ARM, limits="1 = ...")."""
    tables = "".join(f"\n[{name}]\n{lines}\n" for name, lines in changes.items())
    return robot_from_text(text + tables, "test.toml")
