"""`passive_friction` in a robot file: viscous and Coulomb friction of joints without motor."""

import pytest

from modeler.core.errors import RobotError
from modeler.effects.catalogue import PASSIVE_FRICTION_IS
from modeler.robot.edit import insert_effect, replace_effects
from modeler.robot.read import parse_robot_text, read_robot
from tests.robot.texts import FIVE_BAR


def with_lines(*lines: str) -> str:
    return FIVE_BAR.replace("[effects]", "\n".join(["[effects]", *lines]))


def joints_of(text: str) -> dict[str, tuple[str, ...]]:
    return {use.effect: use.joints for use in parse_robot_text(text, "five-bar").effects}


@pytest.mark.parametrize(("cell", "joints"), [('["21"]', ("21",)), ('"all"', ("21", "22"))])
def test_it_is_read_as_what_it_is_made_of(cell: str, joints: tuple[str, ...]) -> None:
    assert joints_of(with_lines(f"passive_friction = {cell}")) == dict.fromkeys(
        PASSIVE_FRICTION_IS, joints
    )


def test_it_stands_beside_the_friction_of_the_motors() -> None:
    both = joints_of(with_lines('passive_friction = "all"', 'viscous = "all"'))
    assert both == {"viscous": ("11", "21", "12", "22"), "coulomb": ("21", "22")}
    written = joints_of(with_lines('viscous = ["11", "12", "21", "22"]', 'coulomb = ["21", "22"]'))
    assert both == written


def test_all_of_them_leaves_the_platform_out() -> None:
    """What moves a platform is no joint."""
    text = replace_effects(read_robot("delta").text, {"passive_friction": "all"})
    robot = parse_robot_text(text, "delta")
    rubbing = joints_of(text)["viscous"]
    names = [j.name for j in robot.moving_joints if not j.actuated and j.name not in robot.platform]
    assert list(rubbing) == names and robot.platform


def test_a_robot_whose_joints_all_have_motors_has_none() -> None:
    text = replace_effects(read_robot("two-link").text, {"passive_friction": "all"})
    with pytest.raises(RobotError, match=r"passive_friction: acts on joints without motor"):
        parse_robot_text(text, "two-link")


def test_its_values_stay_with_it_and_leave_with_it() -> None:
    values = {"Fv21": 0.3, "Fs21": 0.4}
    lines = "\n".join(["[parameters]", *(f"{name} = {value}" for name, value in values.items())])
    text = with_lines('passive_friction = ["21"]').replace("[parameters]", lines)
    stored = replace_effects(text, {"passive_friction": ["21"], "viscous": ["11"]})
    assert values.items() <= parse_robot_text(stored, "five-bar").parameters.items()
    gone = parse_robot_text(replace_effects(text, {}), "five-bar").parameters
    assert gone and not values.keys() & gone.keys()


def test_friction_of_one_more_joint_is_written_beside_it() -> None:
    text = with_lines('passive_friction = ["21"]', 'viscous = "all"')
    more = insert_effect(text, "viscous", "22", {}, ["11", "12"])
    assert joints_of(more)["viscous"] == ("11", "21", "12", "22")
