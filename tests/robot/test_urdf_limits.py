"""Limits of a URDF reach the motion that is planned; what is missing is reported."""

import re

import pytest

import modeler.api as md
from modeler.core.errors import RobotError
from modeler.formats.tree_cuts import cut_tree
from modeler.formats.tree_text import convert_tree
from modeler.formats.urdf import read_urdf_tree
from modeler.robot.read import parse_robot_text
from tests.rotation import with_cases

ARM = """<robot name="arm"><link name="base"/><link name="a"><inertial><origin xyz="0.1 0 0.02"/>
<mass value="1"/><inertia ixx="0.02" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.02"/></inertial>
</link><joint name="j1" type="%s"><parent link="base"/><child link="a"/><axis xyz="0 1 0"/>%s
</joint></robot>"""


def convert(limit: str, kind: str = "revolute", more: str = ""):
    attributes = f'<limit effort="10" {limit}/>{more}' if limit else more
    made = convert_tree(
        cut_tree(read_urdf_tree((ARM % (kind, attributes)).encode(), "arm.urdf")), "arm.urdf"
    )
    return parse_robot_text(made.text, "arm.toml"), made


RANGE = 'lower="-1" upper="1" velocity="2"'


@with_cases(
    "limit, expected",
    (f'{RANGE} acceleration="1.5" deceleration="1.0" jerk="20"', 1.0),
    (f'{RANGE} deceleration="9"', 9.0),
    (f'{RANGE} acceleration="inf" drake:acceleration="3"', 3.0),
)
def test_acceleration_that_is_stated_is_the_limit(limit: str, expected: float) -> None:
    """The smaller of both; the text claims nothing else, and a jerk is reported."""
    robot, made = convert(limit)
    assert robot.limits["1"].acceleration == expected
    assert "assumed" not in made.text and "no file states" not in made.text
    assert any("jerk" in note and '"j1"' in note for note in made.notes) == ("jerk" in limit)


def test_excite_says_of_which_joints_no_limits_are_stated(tmp_path) -> None:
    path = tmp_path / "arm.urdf"
    path.write_text(ARM % ("continuous", ""))
    motion = md.excite(md.load(path), duration=5.0, harmonics=2, starts=1)
    assert any(
        "no limits are stated for 1: those above are" in line for line in motion.format_lines()
    )


@pytest.mark.parametrize("velocity", ['velocity="0"', "", 'velocity="1e400"'])
def test_a_speed_that_is_none_is_told_as_assumed(velocity: str) -> None:
    robot, made = convert(f'lower="-1" upper="1" {velocity}')
    assert robot.limits["1"].speed == 2.0
    (line,) = re.findall(r"^1 = .*", made.text, re.MULTILINE)
    assert line.endswith("# assumed: speed, acceleration")
    assert any('assumed in [limits]: speed 2 rad/s of "j1"' in note for note in made.notes)
    assert any("0 or inf" in note for note in made.notes) == bool(velocity)


@with_cases(
    "limit, kind, text, stated",
    ('lower="1" upper="-1" velocity="2"', "revolute", "leave no range", False),
    ('lower="-inf" upper="1" velocity="2"', "revolute", "infinite on one side", True),
    ('lower="-inf" upper="inf" velocity="2"', "revolute", "range -pi to pi", True),
    ('lower="-inf" upper="inf" velocity="2"', "prismatic", "", False),
    ('velocity="2"', "continuous", "range -pi to pi", True),
    ('lower="-1" upper="1" velocity="2"', "continuous", "continuous has no range", True),
)
def test_ranges_that_are_none_are_told(limit: str, kind: str, text: str, stated: bool) -> None:
    """What leaves no range is no limit; an open one is -pi to pi, and the line says so."""
    robot, made = convert(limit, kind)
    assert ("1" in robot.limits) == stated
    assert any(text in note and '"j1"' in note for note in made.notes) or not text
    assert ("# assumed: range" in made.text) == stated


def test_the_range_of_a_safety_controller_is_the_range() -> None:
    soft = '<safety_controller k_velocity="9" soft_lower_limit="-0.5" soft_upper_limit="%s"/>'
    robot, made = convert(RANGE, more=soft % 2)
    assert (robot.limits["1"].lower, robot.limits["1"].upper) == (-0.5, 1.0)
    assert any("safety_controller" in note and '"j1"' in note for note in made.notes)
    for none in ('<safety_controller k_velocity="9"/>', soft.replace("-0.5", "3") % 4):
        robot, made = convert(RANGE, more=none)
        assert (robot.limits["1"].lower, robot.limits["1"].upper) == (-1.0, 1.0)
        assert any("leaves no range" in note for note in made.notes) == ("soft" in none)
    with pytest.raises(RobotError, match="soft_lower_limit"):
        convert(RANGE, more=soft.replace("-0.5", "low") % 2)
