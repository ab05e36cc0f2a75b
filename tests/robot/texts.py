"""Robot files that several tests of this folder read, and the check of a mistake in one."""

import re

import pytest

from modeler.core.builtin import builtin_text
from modeler.core.errors import RobotError
from modeler.robot.edit import with_effects
from modeler.robot.read import robot_from_text
from tests.learned import text_with

ARM = """\
name = "arm"
title = "Arm for tests"
gravity = [0, 0, "-g"]
priority = ["ZZ*", "Ia?"]
notes = "none"

[symbols]
g = 9.81
D3 = 0.45
R4 = "D3 / 2"

[mdh]
columns = ["j", "a", "mu", "sigma", "alpha", "d", "theta", "r"]
rows = [
  ["1", "0", 1, 0, 0, 0, "q1", 0],
  ["2", "1", 1, 0, "pi/2", 0, "pi/2 - q2", 0],
  ["3", "2", 1, 1, 0, "D3", 0, "q3 + R4"],
  ["4", "3", 0, 0, "-pi/2", 0, "-q4", "R4"],
  ["E", "4", 0, 2, 0, 0.1, "pi", 0],
]

[effects]
viscous = "all"
rotor_inertia = ["1", "2"]
coupled_friction = "all"

[coupling]
2 = "q1 + 2*q2"

[parameters]
ZZ1 = 0.5
Fv1 = 2

[drive_gains]
1 = 12.5

[limits]
1 = ["-pi", 2.5, 3, 10]

[frames]
columns = ["link", "row", "joint", "x", "yaw"]
rows = [["hand", "4", "wrist", "R4/2", "90 deg"], ["base", 0, "", 0, 0]]

[tool]
link = "hand"
x = "2*D3"

[physical.1]
mass = "m1"
centre = ["x1", 0, "z1 - D3"]
inertia = ["J1", 0, 0, "J2", 0, "J3"]

[terms]
PG1 = "m1*x1"
"""

PLANAR = """\
name = "planar"
gravity = [0, "-g", 0]
legs = ["1", "2"]
shared = ["*2{i}"]
priority = ["*P"]

[symbols]
g = 9.81
L1 = 0.3

[mdh]
columns = ["j", "a", "mu", "sigma", "d", "theta"]
rows = [
  ["11", "0", 1, 0, 0, "q11"],
  ["12", "0", 1, 0, 0.2, "q12"],
  ["2{i}", "1{i}", 0, 0, "L1", "q2{i}"],
  ["3{i}", "2{i}", 0, 2, 0.4, 0],
  ["7", "21", 0, 0, 0, "q7"],
]

[relations]
q7 = "-q21 + pi/2"

[platform]
name = "P"
motion = "translation"

[loops]
columns = ["loop", "frame", "meets", "joint"]
rows = [["leg {i}", "3{i}", "P", "position"]]

[home]
"q1{i}" = 2.2
q21 = "-pi/3"

[links]
P = ["M", "MX"]
7 = []

[effects]
viscous = "all"
coulomb = ["1{i}", "2{i}"]

[parameters]
"M1{i}" = 0.5
"""

OWN_EFFECTS = """\
name = "arm"
gravity = [0, 0, 0]
priority = ["Keb*"]

[mdh]
columns = ["j", "theta"]
rows = [["1", "q1"], ["2", "q2"]]

[own_effects.eddy_brake]
title = "drag of a magnet"
columns = {Keb = "v*exp(-((q - c)/w)**2)"}
shapes = {c = [1, -1, 0], w = [0.1, 0.3]}
unit = "N*m*s/rad"
nonnegative = true

[own_effects.wave]
columns = {Wc = "cos(k*q)", Ws = "sin(k*q)"}
shapes = {k = 2}
unit = {Ws = "rad"}
acts = "position"

[own_effects.hook]
columns = {Kh = "z*cos(q)"}
shapes = {d = [0.01, 0.1]}

[effects]
eddy_brake = [{joint = "2", c = 0.7, w = 0.2}]
hook = [{joint = "1", d = 0.05}]

[parameters]
Keb2 = 3.0
Kh1 = 1.0
M1 = 2.0
"""

LAW = text_with("two-link", {}, 'brake = ["2"]\n').replace(
    "[effects]\n",
    '[own_effects.brake]\ncolumns = {Kw = "law(q)"}\n'
    "law = {low = [-1], high = [1], cells = [2], values = [0, 0, 0, 1, 1]}\n\n[effects]\n",
)

MOTORS = 'm1 = "q1"\nm2 = "q2 - 0.4*q1"\nm3 = "q3 - 0.5*q2 + 0.2*q1"\n'
COUPLED = builtin_text("wrist-coupled").split("[parameters]")[0]

FIVE_BAR = with_effects(builtin_text("five-bar"), {})
"""Without effects."""


def check_mistake(text: str, old: str, new: str, told: str) -> None:
    """With `new` in place of `old` the file is refused in a line that has the pieces of `told`.

    Args:
        text: of a robot file that is right.
        old: part of it.
        new: what stands there instead.
        told: pieces of the message in this order, with ` .. ` between them.
    """
    assert old in text
    pattern = ".*".join(map(re.escape, told.split(" .. ")))
    with pytest.raises(RobotError, match=pattern) as caught:
        robot_from_text(text.replace(old, new, 1), "arm.toml")
    message = str(caught.value)
    assert message.startswith("arm.toml: ") and "\n" not in message and len(message) < 700
