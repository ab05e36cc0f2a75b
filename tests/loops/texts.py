"""Robot files with a loop or two that several tests read."""

CRANK = """\
name = "crank"
gravity = [0, -9.81, 0]

[symbols]
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


FOUR_BAR = """
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

PANTOGRAPH = """
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

OFFSET = """
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

RHOMBUS = """
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


BENNETT = """
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
