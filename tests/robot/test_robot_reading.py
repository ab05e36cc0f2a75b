"""What a robot file means: defaults, exactness, order, names."""

import math
from fractions import Fraction
from pathlib import Path

import pytest

from modeler.effects.catalogue import CATALOGUE
from modeler.robot.read import parse_robot_text, read_robot
from modeler.robot.robot import EffectUse, JointKind, Limits
from tests.robot.texts import ARM

HEAD = 'name = "arm"\ngravity = [0, 0, -9.81]\n'
TWO = '[mdh]\ncolumns = ["j", "theta", "d"]\nrows = [[1, "q1", 0], [2, "q2", 0.3]]\n'


def arm(text):
    return parse_robot_text(HEAD + text, "arm.toml")


def test_columns_left_out_have_their_defaults():
    first, second = arm(TWO).joints
    assert (first.name, first.antecedent) == ("1", "0")
    assert (second.name, second.antecedent) == ("2", "1")
    assert second.kind is JointKind.REVOLUTE
    assert second.actuated
    assert all(cell.is_zero for cell in (second.gamma, second.b, second.alpha, second.r))
    assert second.d.fold({}, {}, None, lambda value: value) == Fraction(3, 10)  # exactly
    assert arm(TWO).title == "arm"


def test_symbols_may_be_declared_in_any_order():
    robot = arm('[symbols]\nR = "2*D"\nE = "R + D"\nD = 0.1\nal = "pi/2"\n' + TWO)
    assert robot.evaluate_symbols() == pytest.approx(
        {"D": 0.1, "R": 0.2, "E": 0.3, "al": math.pi / 2}
    )


def test_effects_come_in_catalogue_order_and_by_their_id():
    robot = arm(TWO + '[effects]\ntorque_bias = ["2"]\nviscous = [2, 1]\narmature = "all"')
    assert robot.effects == (
        EffectUse("rotor_inertia", ("1", "2")),
        EffectUse("viscous", ("1", "2")),
        EffectUse("offset", ("2",)),
    )
    order = [effect.id for effect in CATALOGUE]
    assert order.index("rotor_inertia") < order.index("viscous") < order.index("offset")


def test_coupling_is_a_sum_of_speeds():
    text = TWO + '[symbols]\nn = 3\n[coupling]\n2 = "(q1 - n*q2)/2"\n'
    robot = arm(text + '[effects]\ncoupled_inertia = "all"')
    assert robot.coupling == {"2": {"1": 0.5, "2": -1.5}}
    assert robot.effects == (EffectUse("coupled_inertia", ("2",)),)


def test_tables_of_a_file():
    robot = parse_robot_text(ARM, "arm.toml")
    assert robot.parameters == {"ZZ1": 0.5, "Fv1": 2.0}
    assert robot.drive_gains == {"1": 12.5}
    assert robot.limits == {"1": Limits(-math.pi, 2.5, 3.0, 10.0)}
    link, hand, values = robot.physical["1"], robot.frames["hand"], robot.evaluate_symbols()
    assert link.mass.names == {"m1"} and link.centre[2].names == {"z1", "D3"}  # without a value
    assert [entry.text for entry in link.inertia] == ["J1", "0", "0", "J2", "0", "J3"]
    assert (hand.row, hand.joint, robot.frames["base"].row) == ("4", "wrist", "0")
    numbers = [x.evaluate(values) for x in (*hand.position, *hand.angles)]
    assert numbers == [0.1125, 0.0, 0.0, 0.0, 0.0, math.pi / 2]


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
