"""`[tool]`: the frame that a controller moves; every mistake is reported in one line."""

import pytest

from modeler.core.choices import read_builtin_robot
from modeler.core.errors import RobotError
from modeler.robot import insert_effect, parse_robot_text
from tests.robot.texts import ARM

BRANCH = '  ["5", "1", 0, 0, 0, 0, "q5", 0],\n'


def text_of(lines, more=""):
    text = ARM.replace('link = "hand"\nx = "2*D3"\n', f"{lines}\n")
    return text.replace('  ["E", "4"', f'{more}  ["E", "4"')


def tool(lines, more=""):
    return parse_robot_text(text_of(lines, more), "arm.toml").tool


def test_tool_stands_on_the_last_moving_row_or_where_it_says():
    frame = tool('x = "2*D3"\nyaw = "90 deg"')
    assert (frame.row, frame.on) == ("4", None)
    assert frame.position[0].evaluate({"D3": 0.3}) == 0.6 and frame.angles[2].text == "90 deg"
    assert tool("row = 1").row == "1" and tool('row = "E"').row == "E"
    assert tool('row = "5"', BRANCH).row == "5"
    held = tool('link = "hand"\nz = 0.2', BRANCH)
    assert held.row == "4" and held.on.position[0].evaluate({"R4": 0.2}) == 0.1
    platform = parse_robot_text(read_builtin_robot("orthoglide-2003") + "\n[tool]\nz = 0.1\n", "o")
    assert platform.tool.row == platform.platform[-1]
    assert parse_robot_text(read_builtin_robot("puma560"), "p").tool is None


def test_edits_keep_the_tool():
    edited = insert_effect(text_of('x = "2*D3"  # of the gripper'), "coulomb", "1", {})
    assert parse_robot_text(edited, "arm.toml").tool == tool('x = "2*D3"')
    assert "# of the gripper" in edited


def test_a_tool_of_two_ends_says_which():
    text = "the robot has 2 ends, 4, 5; say which row carries the tool"
    with pytest.raises(RobotError, match=text):
        tool("z = 1", BRANCH)
