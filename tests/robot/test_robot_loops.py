"""Legs, relations, platforms and loops of a robot file: what is read, and how mistakes are told."""

import re

import pytest

from modeler.core.errors import RobotError
from modeler.robot.read import read_robot, robot_from_text

GOOD = """\
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

# (what is wrong, old text, new text, pieces of the message in this order)
MISTAKES = [
    ("mark without legs", 'legs = ["1", "2"]\n', "", ["{i} stands for the legs", "names none"]),
    ("legs no list", 'legs = ["1", "2"]', 'legs = "1"', ["legs: got", "expected a list"]),
    ("leg twice", 'legs = ["1", "2"]', 'legs = ["1", "1"]', ["legs", '"1" stands there twice']),
    ("leg name", 'legs = ["1", "2"]', 'legs = ["1", "a b"]', ["legs", '"a b"', "letters"]),
    ("no legs", 'legs = ["1", "2"]', "legs = []", ["legs", "no legs"]),
    ("other mark", '"1{i}", "2{i}"]', '"1{k}", "2{i}"]', ["[effects]|effects", "{k}", "only mark"]),
    ("relation of nothing", "q7 = ", "q9 = ", ["[relations]", '"q9"', "no joint variable", "q4"]),
    ("relation undeclared", "-q21 + pi/2", "-q99 + pi/2", ["q99 is not declared"]),
    ("relation not linear", "-q21 + pi/2", "q21*q12", ["[relations]", "not linear"]),
    ("relation of itself", "-q21 + pi/2", "q7 + q12", ["holds q7 itself"]),
    ("constant relation", "-q21 + pi/2", "pi/2", ["a constant", "sigma 2"]),
    ("actuated follows", '["7", "21", 0,', '["7", "21", 1,',
     ['row "7"', "column mu", "follows other joints", "write 0"]),
    ("circle", 'q7 = "-q21 + pi/2"', 'q7 = "-q21"\nq21 = "q7"',
     ["[relations]", "follow each other in a circle"]),
    ("twice", '0, 0, 0, "q7"]', '0, 0, 0, "q12"]',
     ["[relations]", "stands as a relation in the table too"]),
    ("platform key", 'motion = "tr', 'moves = "tr', ["[platform]", 'unknown key "moves"']),
    ("no motion", 'motion = "translation"\n', "", ["[platform]", "motion is missing"]),
    ("motion", '"translation"', '"spatial"', ["[platform]", "motion", '"spatial"', "planar"]),
    ("platform name", 'name = "P"', 'name = "P 1"', ["[platform]", "name", '"P 1"', "letters"]),
    ("platform name taken", 'name = "P"', 'name = "12"', ["12", "[platform]"]),
    ("loop columns", '"meets", "joint"]', '"meets", "kind"]', ["[loops]", "columns", "expected"]),
    ("loop cells", '"P", "position"]', '"P"]', ["[loops]", "row 1", "got 3 entries, expected 4"]),
    ("loop frame", '"3{i}", "P"', '"9{i}", "P"', ["[loops]", '"leg 1"', "frame", '"91"', "no row"]),
    ("loop meets", '"3{i}", "P"', '"3{i}", "Q"', ["[loops]", "meets", '"Q"', "no row"]),
    ("loop joint", '"position"', '"ball"', ["[loops]", "joint", '"ball"', "spherical"]),
    ("nothing to close", '"3{i}", "P"', '"3{i}", "2{i}"', ["both fixed on link 21", "nothing"]),
    ("loop rows", "rows = [[", "row = [[", ["[loops]", 'unknown key "row"']),
    ("home of nothing", "q21 = ", "q91 = ", ["[home]", '"q91"', "no joint variable"]),
    ("home no number", '"-pi/3"', '"x"', ["[home]", "x is not declared"]),
    ("links row", "7 = []", "8 = []", ["[links]", '"8"', "no moving joint"]),
    ("links parameter", '["M", "MX"]', '["M", "X"]', ["[links]", '"P"', '"X"', "expected some of"]),
    ("shared without mark", '"*2{i}"', '"*2"', ["shared", '"*2"', "{i}"]),
    ("shared nothing", '"*2{i}"', '"*9{i}"', ["shared", "matches no parameter of leg 1"]),
]  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "pieces"), [pytest.param(*mistake[1:], id=mistake[0]) for mistake in MISTAKES]
)
def test_a_mistake_is_told(old, new, pieces):
    assert GOOD.count(old) >= 1
    pattern = ".*".join(p if "|" in p else re.escape(p) for p in pieces)
    with pytest.raises(RobotError, match=pattern) as caught:
        robot_from_text(GOOD.replace(old, new, 1), "planar.toml")
    assert str(caught.value).startswith("planar.toml: ") and "\n" not in str(caught.value)


def test_loops_need_a_motor():
    with pytest.raises(RobotError, match=r"\[loops\]: no joint is actuated"):
        robot_from_text(GOOD.replace('"0", 1,', '"0", 0,'), "planar.toml")


def test_a_shared_name_must_be_free():
    text = GOOD.replace('"7"', '"2"').replace("q7", "q2").replace("7 = []", "")
    with pytest.raises(RobotError, match=r'shared: "XX2" would be shared .* is a parameter'):
        robot_from_text(text, "planar.toml")


def test_what_is_written_once_stands_for_every_leg():
    robot = robot_from_text(GOOD, "planar.toml")
    names = [joint.name for joint in robot.joints]
    assert names == ["Px", "Py", "P", "11", "12", "21", "31", "22", "32", "7"]
    assert [loop.frame for loop in robot.loops] == ["31", "32"]
    assert robot.home["12"] == 2.2 and robot.parameters["M12"] == 0.5
    assert next(u for u in robot.effects if u.effect == "coulomb").joints == (
        "11",
        "12",
        "21",
        "22",
    )
    assert next(u for u in robot.effects if u.effect == "viscous").joints == ("11", "12")


def test_coordinates_are_the_actuated_joints():
    robot = robot_from_text(GOOD, "planar.toml")
    assert [j.name for j in robot.coordinates] == ["11", "12"]
    assert [j.name for j in robot.free] == ["Px", "Py", "P", "11", "12", "21", "22"]
    assert robot.links["Px"] == () and robot.links["P"] == ("MX", "M")
    assert {s.name for s in robot.shared} >= {"XX2", "M2", "Fs2"}


def test_a_cell_of_other_variables_is_a_relation():
    table = GOOD.replace('[relations]\nq7 = "-q21 + pi/2"\n', "").replace(
        '["7", "21", 0, 0, 0, "q7"]', '["7", "21", 0, 0, 0, "-q21 + pi/2"]'
    )
    one, other = (robot_from_text(text, "planar.toml") for text in (GOOD, table))
    assert one.relations == other.relations
    assert one.joint("7").theta == other.joint("7").theta


@pytest.mark.parametrize("name", ["stewart", "evra"])
def test_a_free_platform_moves_in_six_ways(name):
    assert read_robot(name).platform == ("Px", "Py", "Pz", "Pa", "Pb", "P")
