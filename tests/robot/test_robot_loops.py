"""Legs, relations, platforms and loops of a robot file: what is read, how mistakes are reported."""

import pytest

from modeler.robot.read import parse_robot_text, read_robot
from tests.robot.texts import PLANAR, check_mistake


def test_loops_need_a_motor():
    text = PLANAR.replace('["11", "0", 1,', '["11", "0", 0,')
    check_mistake(text, '["12", "0", 1,', '["12", "0", 0,', "[loops]: no joint is actuated")


def test_a_shared_name_must_be_free():
    text = PLANAR.replace('"7"', '"2"').replace("q7", "q2")
    check_mistake(text, "7 = []", "", 'shared: "XX2" would be shared .. is a parameter')


def test_what_is_written_once_stands_for_every_leg():
    legs = parse_robot_text(PLANAR, "planar.toml")
    names = [joint.name for joint in legs.joints]
    assert names == ["Px", "Py", "P", "11", "12", "21", "31", "22", "32", "7"]
    assert [loop.frame for loop in legs.loops] == ["31", "32"]
    assert legs.home["12"] == 2.2 and legs.parameters["M12"] == 0.5
    assert next(u for u in legs.effects if u.effect == "coulomb").joints == (
        *"11 12 21 22".split(),
    )
    assert next(u for u in legs.effects if u.effect == "viscous").joints == ("11", "12")


def test_coordinates_are_the_actuated_joints():
    robot = parse_robot_text(PLANAR, "planar.toml")
    assert [j.name for j in robot.coordinates] == ["11", "12"]
    assert [j.name for j in robot.free_joints] == ["Px", "Py", "P", "11", "12", "21", "22"]
    assert robot.links["Px"] == () and robot.links["P"] == ("MX", "M")
    assert {s.name for s in robot.shared} >= {"XX2", "M2", "Fs2"}


def test_a_cell_of_other_variables_is_a_relation():
    table = PLANAR.replace('[relations]\nq7 = "-q21 + pi/2"\n', "").replace(
        '["7", "21", 0, 0, 0, "q7"]', '["7", "21", 0, 0, 0, "-q21 + pi/2"]'
    )
    one, other = (parse_robot_text(text, "planar.toml") for text in (PLANAR, table))
    assert one.relations == other.relations
    assert one.get_joint("7").theta == other.get_joint("7").theta


@pytest.mark.parametrize("name", ["stewart", "evra"])
def test_a_free_platform_moves_in_six_ways(name):
    assert read_robot(name).platform == ("Px", "Py", "Pz", "Pa", "Pb", "P")
