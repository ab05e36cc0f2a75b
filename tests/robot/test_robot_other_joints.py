"""Names of joints that close no loop here are refused with what to write instead."""

import re
import tomllib

import pytest

from modeler.core.errors import RobotError
from modeler.robot.mechanism import OTHER_JOINTS
from modeler.robot.read import parse_robot_text
from modeler.robot.robot import LOOP_KINDS
from tests.robot_texts import CRANK


def message_of(kind: str) -> str:
    with pytest.raises(RobotError) as error:
        parse_robot_text(CRANK.replace('"position"', f'"{kind}"'), "crank.toml")
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
            assert message_of(name).endswith(f"; {instead}")


def test_what_is_not_supported_says_what_to_write():
    for instead in INSTEAD.keys() - SUPPORTED:
        for name in INSTEAD[instead]:
            assert message_of(name).endswith(f"; {instead}")


def test_the_rest_lists_what_there_is():
    assert "(did you mean" in message_of("sphericl")
    assert message_of("magic").endswith(f"expected one of {', '.join(LOOP_KINDS)}")


def test_advice_that_is_a_relation_can_be_read():
    for message in INSTEAD:
        for relation in re.findall(r'q(\d) = "([^"]+)"', message):
            text = CRANK.split("[loops]")[0]
            other = {"4": "3", "2": "1"}[relation[0]]
            joint = '  ["4", "0", 0, 0, 0, 0, 0, "q4", 0],\n]\n' if relation[0] == "4" else "]\n"
            text = text.rstrip().removesuffix("]") + joint
            robot = parse_robot_text(f'{text}\n[relations]\nq{relation[0]} = "{relation[1]}"', "x")
            assert robot.relations[relation[0]].names == {f"q{other}"}
