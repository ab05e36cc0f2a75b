"""What a robot file means: defaults, exactness, order, names."""

import math
from fractions import Fraction
from pathlib import Path

import pytest

from modeler.core.builtin import builtin_names, builtin_text
from modeler.effects.catalogue import CATALOGUE
from modeler.robot.read import read_robot, robot_from_text
from modeler.robot.robot import EffectUse, JointKind, Limits

HEAD = 'name = "arm"\ngravity = [0, 0, -9.81]\n'
TWO = '[mdh]\ncolumns = ["j", "theta", "d"]\nrows = [[1, "q1", 0], [2, "q2", 0.3]]\n'


def arm(text):
    return robot_from_text(HEAD + text, "arm.toml")


def theta(cell):
    """The theta cell of a one-joint arm, as it is read."""
    return arm(f'[mdh]\ncolumns = ["j", "theta"]\nrows = [["1", {cell}]]').joints[0].theta


def alpha(cell):
    rows = f'rows = [["1", "q1", {cell}]]'
    return arm(f'[mdh]\ncolumns = ["j", "theta", "alpha"]\n{rows}').joints[0].alpha


def test_columns_left_out_have_their_defaults():
    first, second = arm(TWO).joints
    assert (first.name, first.antecedent) == ("1", "0")
    assert (second.name, second.antecedent) == ("2", "1")
    assert second.kind is JointKind.REVOLUTE
    assert second.actuated
    assert all(cell.is_zero for cell in (second.gamma, second.b, second.alpha, second.r))
    assert arm(TWO).title == "arm"


def test_decimals_stay_exact():
    d = arm(TWO).joints[1].d
    assert d.fold({}, {}, None, lambda value: value) == Fraction(3, 10)


@pytest.mark.parametrize(
    ("cell", "text"),
    [
        ("1.5707963267948966", "pi/2"),
        ("3.141592653589793", "pi"),
        ("4.71238898038469", "3*pi/2"),
        ("1.5707963265", "pi/2"),
        ("1e-17", "0"),
        ('"2*0.7853981633974483"', "pi/2"),
        ('"pi/2"', "pi/2"),
        ("0.5", "0.5"),
        ('"0.25*pi"', "0.25*pi"),
    ],
)
def test_angles_are_exact_multiples_of_a_quarter_turn(cell, text):
    assert alpha(cell).text == text


@pytest.mark.parametrize(
    ("cell", "text"),
    [
        ('"q1 + 1.5707963267948966"', "q1 + pi/2"),
        ('"-q1 - 3.141592653589793"', "-q1 - pi"),
        ('"1.5707963267948966 - q1"', "-q1 + pi/2"),
        ('"pi/2 - q1"', "pi/2 - q1"),
        ('"q1 + 1e-12"', "q1"),
    ],
)
def test_joint_angles_keep_their_sign_and_offset(cell, text):
    assert theta(cell).text == text
    plain = {"q1": 0.7}
    assert theta(cell).number(plain) == pytest.approx(eval_cell(cell, 0.7), abs=1e-9)


def eval_cell(cell, q1):
    return eval(cell.strip('"'), {"q1": q1, "pi": math.pi})


def test_a_measured_angle_may_be_declared():
    rows = '[mdh]\ncolumns = ["j", "theta", "alpha"]\nrows = [["1","q1","al"]]'
    assert arm(f"[symbols]\nal = 1.57\n{rows}").joints[0].alpha.text == "al"


def test_symbols_may_be_declared_in_any_order():
    robot = arm('[symbols]\nR = "2*D"\nE = "R + D"\nD = 0.1\nal = "pi/2"\n' + TWO)
    assert robot.symbol_values() == pytest.approx({"D": 0.1, "R": 0.2, "E": 0.3, "al": math.pi / 2})


def test_effects_come_in_catalogue_order_and_by_their_id():
    robot = arm(TWO + '[effects]\ntorque_bias = ["2"]\nviscous = [2, 1]\narmature = "all"')
    assert robot.effects == (
        EffectUse("rotor_inertia", ("1", "2")),
        EffectUse("viscous", ("1", "2")),
        EffectUse("offset", ("2",)),
    )
    order = [effect.id for effect in CATALOGUE]
    assert order.index("rotor_inertia") < order.index("viscous") < order.index("offset")


def test_all_leaves_passive_joints_out():
    rows = '[mdh]\ncolumns = ["j", "mu", "theta"]\nrows = [["1", 1, "q1"], ["2", 0, "q2"]]\n'
    robot = arm(rows + '[effects]\nviscous = "all"\ncoulomb = ["2"]')
    assert robot.has_effect("viscous", "1")
    assert not robot.has_effect("viscous", "2")
    assert robot.has_effect("coulomb", "2")


def test_coupling_is_a_sum_of_speeds():
    text = TWO + '[symbols]\nn = 3\n[coupling]\n2 = "(q1 - n*q2)/2"\n'
    robot = arm(text + '[effects]\ncoupled_inertia = "all"')
    assert robot.coupling == {"2": {"1": 0.5, "2": -1.5}}
    assert robot.effects == (EffectUse("coupled_inertia", ("2",)),)


def test_values_by_joint():
    text = TWO + '[parameters]\nZZ1 = 1\n[drive_gains]\n2 = -3.5\n[limits]\n1 = ["-pi", "pi", 2, 5]'
    robot = arm(text)
    assert robot.parameters == {"ZZ1": 1.0}
    assert robot.drive_gains == {"2": -3.5}
    assert robot.limits == {"1": Limits(-math.pi, math.pi, 2.0, 5.0)}


def test_letters_of_a_paper_need_no_value():
    text = TWO + '[physical.2]\nmass="am"\ncentre=["at1 - d", 0, 0]\ninertia=["J1",0,0,"J2",0,"J3"]'
    link = arm(text).physical["2"]
    assert link.mass.names == {"am"}
    assert link.centre[0].names == {"at1", "d"}
    assert [entry.text for entry in link.inertia] == ["J1", "0", "0", "J2", "0", "J3"]


def test_a_file_and_its_text_are_kept(tmp_path, monkeypatch):
    path = tmp_path / "arm.toml"
    path.write_text("\ufeff" + HEAD + TWO, encoding="utf-8")
    assert read_robot(path).text == HEAD + TWO
    assert read_robot(str(path)).name == "arm"
    monkeypatch.chdir(tmp_path)
    assert read_robot("arm.toml").name == "arm"
    Path("wrist").write_text(HEAD + TWO)
    assert read_robot("wrist").name == "wrist"
    assert read_robot("./wrist").name == "arm"
    assert read_robot(Path("wrist")).name == "arm"


def test_built_in_names_are_file_names():
    for name in builtin_names():
        assert read_robot(name).name == name
    with pytest.raises(KeyError):
        builtin_text("no-such-robot")
