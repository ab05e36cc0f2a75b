"""`[tool]`: the frame that a controller moves; every mistake is told in one line."""

import pytest

from modeler.core.builtin import builtin_text
from modeler.core.errors import RobotError
from modeler.robot import robot_from_text, with_effect

ARM = """\
name = "arm"
gravity = [0, 0, -9.81]

[symbols]
L = 0.3

[mdh]
columns = ["j", "a", "sigma", "theta", "d"]
rows = [["1", "0", 0, "q1", 0], ["2", "1", 0, "q2", "L"], ["E", "2", 2, "pi", "L"]{more}]

[frames]
columns = ["link", "row", "z"]
rows = [["flange", "2", 0.1]]

[tool]
"""
BRANCH = ', ["3", "1", 0, "q3", "L"]'


def tool(lines, more=""):
    return robot_from_text(ARM.replace("{more}", more) + lines, "arm.toml").tool


def test_tool_stands_on_the_last_moving_row_or_where_it_says():
    found = tool('x = "2*L"\nyaw = "90 deg"')
    assert (found.row, found.on) == ("2", None)
    assert found.position[0].number({"L": 0.3}) == 0.6 and found.angles[2].text == "90 deg"
    assert tool("row = 1").row == "1" and tool('row = "E"').row == "E"
    assert tool('row = "3"', BRANCH).row == "3"
    held = tool('link = "flange"\nz = 0.2', BRANCH)
    assert held.row == "2" and held.on.position[2].number() == 0.1
    platform = robot_from_text(builtin_text("orthoglide-2003") + "\n[tool]\nz = 0.1\n", "o")
    assert platform.tool.row == platform.platform[-1]
    assert robot_from_text(builtin_text("puma560"), "p").tool is None


def test_edits_keep_the_tool():
    text = ARM.replace("{more}", "") + 'x = "2*L"  # of the gripper\n'
    edited = with_effect(text, "viscous", "1", {})
    assert robot_from_text(edited, "arm.toml").tool == tool('x = "2*L"')
    assert "# of the gripper" in edited


@pytest.mark.parametrize(
    ("lines", "more", "told"),
    [
        ("xx = 1", "", 'unknown key "xx"'),
        ('x = "M"', "", "[tool], x"),
        ("yaw = true", "", "[tool], yaw"),
        ('row = "7"', "", 'row: got "7"; expected the name of a row'),
        ("row = [1]", "", "row: got [1]; expected the name of a row"),
        ('link = "flang"', "", 'did you mean "flange"'),
        ("link = 1", "", "link: got 1"),
        ('row = "2"\nlink = "flange"', "", "keep one of them"),
        ("z = 1", BRANCH, 'the robot has 2 ends, 2, 3; say which row carries the tool'),
        ('z = "30 deg"', "", "[tool], z"),
    ],
)  # fmt: skip
def test_mistakes(lines, more, told):
    with pytest.raises(RobotError) as caught:
        tool(lines, more)
    text = str(caught.value)
    assert told in text and text.startswith("arm.toml: [tool]") and "\n" not in text
