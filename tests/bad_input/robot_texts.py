"""Good robot files, and rows made from them by one edit each."""

import re
from collections.abc import Callable, Iterable
from functools import partial

from modeler.api import derive
from modeler.robot.read import robot_from_text
from tests.bad_input.row import Make, Row, row
from tests.bad_input.yard import Yard

SERIAL = """\
name = "arm"
title = "Arm with most of what a file may say"
notes = "none"
gravity = [0, 0, "-g"]
priority = ["ZZ*", "Ia?"]

[symbols]
g = 9.81
D3 = 0.45
R4 = "D3 / 2"
tilt = "pi/6"

[mdh]
columns = ["j", "a", "mu", "sigma", "alpha", "d", "theta", "r"]
rows = [
  ["1", "0", 1, 0, 0, 0, "q1", 0],
  ["2", "1", 1, 0, "pi/2", 0, "pi/2 - q2", 0],
  ["3", "2", 1, 1, 0, "D3", 0, "q3 + R4"],
  ["E", "3", 0, 2, "tilt", 0.1, "pi", 0],
]

[effects]
viscous = "all"
coulomb = ["1", "2"]
rotor_inertia = ["1"]
coupled_friction = "all"
stribeck = [{joint = "1", vs = 0.1, d = 2}]
motor_ripple = [{joint = "2", m = 7}, {joint = "2", m = 14}]

[coupling]
2 = "q1 + 2*q2"

[parameters]
ZZ1 = 0.5
Fv1 = 2

[drive_gains]
1 = 12.5

[limits]
1 = ["-pi", 2.5, 3, 10]
"""

CRANK = """\
name = "crank"
gravity = [0, "-g", 0]

[symbols]
g = 9.81
R = 0.10
L = 0.35

[mdh]
columns = ["j",   "a", "mu", "sigma", "gamma", "alpha", "d", "theta", "r"]
rows = [
  ["1",   "0",  1,    0,       0,       0,       0,  "q1",     0],
  ["2",   "1",  0,    0,       0,       0,      "R", "q2",     0],
  ["tip", "2",  0,    2,       0,       0,      "L",  0,       0],
  ["3",   "0",  0,    1,      "pi/2",  "pi/2",   0,   0,      "q3"],
]

[loops]
columns = ["loop", "frame", "meets", "joint"]
rows = [
  ["pin",  "tip",   "3",     "position"],
]

[home]
q1 = "pi/2"
q2 = -1.86
q3 = 0.33

[effects]
viscous = ["1", "3"]
"""

LEGS = """\
name = "twins"
gravity = [0, "-g", 0]
legs = ["1", "2"]
shared = ["*1{i}"]

[symbols]
g = 9.81
B1 = 0
B2 = 0.2
L = 0.3
W1 = 0
W2 = 0.93

[mdh]
columns = ["j",    "a",    "mu", "sigma", "d",    "theta"]
rows = [
  ["1{i}", "0",     1,    0,      "B{i}",  "q1{i}"],
  ["2{i}", "1{i}",  0,    0,      "L",     "q2{i}"],
  ["3{i}", "2{i}",  0,    2,      "L",      0],
  ["4{i}", "P",     0,    2,      "W{i}",   0],
]

[relations]
q22 = "-q21"

[platform]
name = "P"
motion = "planar"

[loops]
columns = ["loop", "frame", "meets", "joint"]
rows = [["leg {i}", "3{i}", "4{i}", "revolute"]]

[links]
P = ["M"]

[home]
q11 = 2.0
q21 = 0.5
q12 = 1.1416
qPx = -0.365
qPy = 0.452

[effects]
viscous = "all"
"""

MAGNET = """\
name = "magnet"
gravity = [0, "-g", 0]

[symbols]
g = 9.81
D2 = 0.4

[mdh]
columns = ["j", "a", "d", "theta"]
rows = [["1", "0", 0, "q1"], ["2", "1", "D2", "q2"]]

[effects]
viscous = "all"
eddy_brake = [{joint = "2", c = 0.7, w = 0.2}]

[own_effects.eddy_brake]
title = "drag of a magnet that the joint passes"
columns = { Keb = "v*exp(-((q - c)/w)**2)" }
shapes = { c = [-1, 0, 1], w = [0.1, 0.3] }
unit = "N*m*s/rad"
nonnegative = true
"""

Edit = tuple[str, ...]
"""What is wrong, the old text, the new one, and words of the line."""


def edited(text: str, old: str, new: str) -> str:
    """The text with its first `old` made `new`; `old` must be there."""
    assert old in text, f"the good file has no {old!r}"
    return text.replace(old, new, 1)


def refusals(theme: str, text: str, edits: Iterable[Edit]) -> list[Row]:
    """A row for every edit of a good robot file that must be refused.

    The first goes through a command, the others are only read; what tests/robot/
    test_robot_mistakes.py has is not here again.
    """
    rows = []
    for what, old, new, *words in edits:
        content = edited(text, old, new)
        name = _file(content)
        run: str | Callable[[Yard], object] = f"derive {name} --no-terms --json d.json"
        if rows:
            run = partial(_read, name, content)
        rows.append(row(f"{theme}: {what}", "refused", run, *words, make=writes(name, content)))
    return rows


def _read(name: str, content: str, yard: Yard) -> object:
    return derive(robot_from_text(content, name))


def writes(name: str, content: str | bytes) -> Make:
    """Makes a file of that content."""
    return lambda yard: yard.write(name, content)


def _file(content: str) -> str:
    """A name for a robot file: that of the good file, by which messages call the robot too."""
    found = re.search(r'^name = "(\w+)"$', content, re.MULTILINE)
    return f"{found[1][:20] if found else 'bad'}.toml"


def derived(theme: str, text: str, edits: Iterable[Edit]) -> list[Row]:
    """A row for every edit of a good robot file that must work; its words are in the output."""
    return [
        row(
            f"{theme}: {what}", "works", "derive odd.toml --no-terms", *words,
            make=writes("odd.toml", edited(text, old, new)),
        )
        for what, old, new, *words in edits
    ]  # fmt: skip
