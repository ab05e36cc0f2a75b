"""Names of joints that close no loop here are refused with what to write instead."""

import re
import tomllib

import pytest

from modeler.codegen.workflow import derive
from modeler.core.errors import RobotError
from modeler.derivation.relations import as_json
from modeler.robot.loops import OTHER_JOINTS
from modeler.robot.read import robot_from_text
from modeler.robot.robot import LOOP_KINDS
from tests.robot_texts import CRANK


def refused(kind: str) -> str:
    with pytest.raises(RobotError) as error:
        robot_from_text(CRANK.replace('"position"', f'"{kind}"'), "crank.toml")
    message, place = str(error.value), 'crank.toml: [loops], row 1, "pin", column joint: got '
    assert message.startswith(f'{place}"{kind}"') and "\n" not in message
    return message


INSTEAD = tomllib.loads(OTHER_JOINTS.read_text(encoding="utf-8"))
SUPPORTED = [instead for instead in INSTEAD if instead.startswith("write ")]


def test_other_names_of_what_is_supported():
    for instead in SUPPORTED:
        known, *others = INSTEAD[instead]
        assert instead == f"write {known}" and known in LOOP_KINDS
        for name in (known.title(), *others, *(f"{other}_joint".title() for other in others)):
            assert refused(name).endswith(f"; {instead}")


def test_what_is_not_supported_says_what_to_write():
    for instead in INSTEAD.keys() - SUPPORTED:
        for name in INSTEAD[instead]:
            assert refused(name).endswith(f"; {instead}")


def test_the_rest_lists_what_there_is():
    assert "(did you mean" in refused("sphericl")
    assert refused("magic").endswith(f"expected one of {', '.join(LOOP_KINDS)}")


TWO = """
name = "two"
gravity = ["-g", 0, 0]
symbols = {{g = 9.81, D2 = 0.4}}
[mdh]
columns = ["j", "a", "mu", "sigma", "gamma", "b", "alpha", "d", "theta", "r"]
rows = [
  ["1", "0", 1, 0, 0, 0, 0, 0, "q1", 0],
  ["2", "0", 0, 0, 0, 0, 0, "D2", "q2", 0],
{rows}]
"""
WAYS = """
  ["x", "2", 0, 1, 0, 0, "pi/2", 0, "pi/2", "qx"],
  ["y", "x", 0, 1, 0, 0, "pi/2", 0, "pi/2", "qy"],
  ["z", "y", 0, 1, 0, 0, "pi/2", 0, "pi/2", "qz"],
"""
CLOSED = """
[loops]
columns = ["loop", "frame", "meets", "joint"]
rows = [["parallel", "{frame}", "1", "rigid"]]
[links]
x = []
y = []
z = []
[home]
q1 = 0.3
q2 = {q2}
"""


def test_the_advice_for_directions_alone_is_sound():
    """Three travels and a rigid joint tie directions only: as the relation q2 = q1 does."""
    text = TWO.format(rows=WAYS) + CLOSED.format(frame="z", q2=0.3)
    ours = derive(robot_from_text(text, "ways"))
    told = derive(robot_from_text(TWO.format(rows="") + '[relations]\nq2 = "q1"\n', "relation"))
    names = [{b["name"] for b in as_json("two", each.base)["base"]} for each in (ours, told)]
    assert names[0] == names[1] and len(names[0]) == 3
    assert ours.base.rank == told.base.rank


def test_advice_that_is_a_relation_can_be_read():
    for told in INSTEAD:
        for relation in re.findall(r'q(\d) = "([^"]+)"', told):
            text = CRANK.split("[loops]")[0]
            other = {"4": "3", "2": "1"}[relation[0]]
            joint = '  ["4", "0", 0, 0, 0, 0, 0, "q4", 0],\n]\n' if relation[0] == "4" else "]\n"
            text = text.rstrip().removesuffix("]") + joint
            robot = robot_from_text(f'{text}\n[relations]\nq{relation[0]} = "{relation[1]}"', "x")
            assert robot.relations[relation[0]].names == {f"q{other}"}
