"""Replacing the effects of a robot file."""

import tomllib

import pytest

from modeler.core.choices import list_builtin_robots
from modeler.core.errors import RobotError
from modeler.robot.edit import replace_effects, replace_parameters
from modeler.robot.read import parse_robot_text, read_robot

ARM = """
name = "arm"
gravity = [0, 0, 0]

[mdh]
columns = ["j", "theta"]
rows = [["1", "q1"], ["2", "q2"]]

[effects]                # of both joints
viscous = "all"
coulomb = ["1"]
rotor_inertia = "all"

[parameters]             # nominal values
ZZ1 = 0.5
Fv1 = 2.0                # N m s/rad
"Fs1" = 3.0
Ia2 = 0.1
M2 = 1.5
"""


def test_only_effects_and_their_values_change():
    robot = parse_robot_text(replace_effects(ARM, {"viscous": ["2"]}), "changed")
    assert [(use.effect, use.joints) for use in robot.effects] == [("viscous", ("2",))]
    assert robot.parameters == {"ZZ1": 0.5, "M2": 1.5}
    before, after = tomllib.loads(ARM), tomllib.loads(robot.text)
    for key in ("name", "gravity", "mdh"):
        assert before[key] == after[key]
    stored = parse_robot_text(replace_effects(ARM, {"back_emf": "all"}), "changed").parameters
    assert stored == {"ZZ1": 0.5, "Fv1": 2.0, "M2": 1.5}  # viscous friction by another name


@pytest.mark.parametrize("name", list_builtin_robots())
def test_every_built_in_robot_can_lose_all_effects(name):
    robot = read_robot(name)
    bare = parse_robot_text(replace_effects(robot.text, {}), name)
    assert bare.effects == () and bare.joints == robot.joints
    assert set(bare.parameters) <= set(robot.parameters)


def test_values_of_coupled_motors_are_not_taken_for_those_of_joints():
    text = ARM.replace('coulomb = ["1"]', 'coupled_friction = "all"')
    text = text.replace('"Fs1" = 3.0', "Fvm2 = 3.0") + '\n[coupling]\n2 = "q1 + q2"\n'
    assert "Fvm2" in parse_robot_text(text, "arm").parameters
    bare = parse_robot_text(replace_effects(text, {"viscous": "all"}), "changed")
    assert set(bare.parameters) == {"ZZ1", "Fv1", "M2"}


def test_a_table_in_one_line_stays_there():
    text = ARM.partition("[effects]")[0].replace("[mdh]", 'effects = { viscous = "all" }\n[mdh]')
    changed = replace_effects(text, {"coulomb": "all"})
    assert tomllib.loads(changed) == {**tomllib.loads(text), "effects": {"coulomb": "all"}}
    assert changed.count("\n") == text.count("\n")


def test_dotted_keys_are_refused():
    text = ARM.partition("[effects]")[0].replace("[mdh]", 'effects.viscous = "all"\n[mdh]')
    with pytest.raises(RobotError, match=r"write them as a table \[effects\]"):
        replace_effects(text, {"coulomb": "all"})


def test_other_nominal_values_keep_what_is_known_of_them():
    head = ARM.partition("[effects]")[0] + '[effects]\nviscous = "all"\n'
    for tail in (
        '[parameters]\nFv1 = 1.0\nZZ1 = 1\nheld = ["ZZ1"]\n[parameters.uncertainty]\nFv1 = 0.2\n',
        '[parameters]\nFv1 = 1.0\nZZ1 = 1\nuncertainty = {Fv1 = 0.2, held = ["ZZ1"]}\n',
    ):
        robot = parse_robot_text(replace_parameters(head + tail, {"Fv1": 3.0}), "x.toml")
        assert robot.parameters == {"Fv1": 3.0, "ZZ1": 1.0}
        assert robot.uncertainty == {"Fv1": 0.2, "ZZ1": 0.0}


def test_one_blank_line_stands_between_sections():
    text = read_robot("two-link").text
    for k in range(5):
        text = replace_parameters(replace_effects(text, {"viscous": "all"}), {"Fv1": float(k + 1)})
    assert "\n\n\n" not in text and "\n\n[parameters]" in text and "\n\n[effects]" in text
