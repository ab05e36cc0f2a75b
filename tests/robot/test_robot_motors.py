"""Motors that turn with several joints, by the laws of the coupling and by Hanssen's counts."""

import numpy as np
import pytest

from modeler.core.choices import read_builtin_robot
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.derivation.numeric_rank import evaluate_regressor
from modeler.robot.edit import insert_effect
from modeler.robot.mechanism import compute_joint_directions
from modeler.robot.read import parse_robot_text, read_robot
from tests.modules import module
from tests.robot.texts import COUPLED, MOTORS

_G = np.array([[1.0, 0.0, 0.0], [-0.4, 1.0, 0.0], [0.2, -0.5, 1.0]])
_JM, _FV, _FS = np.array([0.5, 0.3, 0.15]), np.array([4.0, 2.5, 1.2]), np.array([3.0, 2.0, 1.2])
_TEXT = read_builtin_robot("wrist-coupled")
_ROTORS = 'rotor_inertia = "all"\nviscous = "all"\ncoulomb = "all"\n'


def _coupled(motors: str, effects: str = _ROTORS):
    assert MOTORS in COUPLED and _ROTORS in COUPLED
    text = COUPLED.replace(MOTORS, motors).replace(_ROTORS, effects)
    return parse_robot_text(text, "coupled.toml")


def _sums(G: np.ndarray) -> str:
    lines = (" + ".join(f"({c})*q{j + 1}" for j, c in enumerate(row) if c) for row in G.tolist())
    return "".join(f'm{i + 1} = "{line}"\n' for i, line in enumerate(lines))


def test_motor_torques_are_those_of_the_joints_by_virtual_work():
    """tau_m = G^-T tau_a + Jm qmdd + Fv qmd + Fs sign(qmd), tau_a of the wrist without motors."""
    qm, qmd, qmdd = np.random.default_rng(3).uniform(-2, 2, (3, 50, 3))
    back, nominal = np.linalg.inv(_G), read_robot("wrist-coupled").parameters

    def torques(name, *states):
        model = module(name).model
        return evaluate_regressor(model, states) @ [nominal.get(p, 0.0) for p in model.names]

    tau_a = torques("wrist", *(x @ back.T for x in (qm, qmd, qmdd)))
    expected = tau_a @ back + _JM * qmdd + _FV * qmd + _FS * np.sign(qmd)
    got = torques("wrist-coupled", qm, qmd, qmdd)
    assert np.abs(got - expected).max() < 1e-12 * np.abs(expected).max()


@pytest.mark.parametrize("seed", range(3))
def test_17_base_parameters_and_3_of_friction_for_any_coupling(seed):
    G = np.random.default_rng(seed).integers(-9, 10, (3, 3)) / 4 + 3 * np.eye(3)
    base = derive_base_parameters(derive_model(_coupled(_sums(G), 'coulomb = "all"\n')))
    assert len(base.parameters) == 17 + 3


@pytest.mark.parametrize(
    ("G", "count"),
    [(np.diag([1.0, 2.0, 0.5]), 18 + 3), (np.diag([-3.0, 1.5, 7.0]), 18 + 3), (_G, 19 + 3)],
)
def test_rotor_inertias_add_one_or_two(G, count):
    """18 with a diagonal G, where Jm3 separates PJ22 from PJ16; 19 with a lower triangular one."""
    effects = 'rotor_inertia = "all"\ncoulomb = "all"\n'
    base = derive_base_parameters(derive_model(_coupled(_sums(G), effects)))
    assert len(base.parameters) == count


@pytest.mark.parametrize("ratio", [1, 3])
def test_the_first_rotor_groups_with_the_square_of_its_ratio(ratio):
    """ZZ1R' = ZZ1R + G11^2 Jm1."""
    G = _G.copy()
    G[0, 0] = ratio
    base = derive_base_parameters(derive_model(_coupled(_sums(G), 'rotor_inertia = "all"\n')))
    zz1 = next(p for p in base.parameters if p.name == "ZZ1R")
    terms = {term.parameter: float(term.coefficient) for term in zz1.terms}
    assert terms == {"ZZ1": 1.0, "YY2": 1.0, "Iam1": ratio**2}


def test_thirds_are_thirds():
    robot = _coupled('m1 = "q1/3"\nm2 = "q2"\nm3 = "q3"\n')
    assert robot.relations["1"].text == "3*qm1"


def test_directions_are_the_columns_of_the_coupling():
    ways = compute_joint_directions(read_robot("wrist-coupled"))
    np.testing.assert_allclose([*ways.values()], _G.T)
    assert compute_joint_directions(read_robot("five-bar")) == {"11": (1.0, 0.0), "12": (0.0, 1.0)}


def test_motors_of_sliding_joints_slide():
    text = """
name = "slide"
gravity = [0, 0, 0]

[mdh]
columns = ["j", "sigma", "alpha", "theta", "r"]
rows = [["1", 1, 0, 0, "q1"], ["2", 0, 0, "q2", 0]]

[motors]
a = "2*q1"
b = "q2 + 5*q1"
"""
    kinds = [joint.is_revolute for joint in parse_robot_text(text, "slide.toml").coordinates]
    assert kinds == [False, True]


def test_an_effect_that_is_added_leaves_the_values_of_the_motors():
    """Fvm1 is viscous friction of the motor m1, not friction of a motor on joint 1."""
    changed = insert_effect(_TEXT, "stribeck", "m2", {"vs": 0.1, "d": 2.0})
    assert parse_robot_text(changed, "x.toml").parameters == read_robot("wrist-coupled").parameters
