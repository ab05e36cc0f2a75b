"""Closed forms against the Newton-Euler graph, laws, and an independent count of monomials."""

import numpy as np
import pytest

from modeler.core.errors import DerivationError, RobotError
from modeler.derivation.derive import derive_model
from modeler.derivation.geometry import create_geometric_symbol
from modeler.derivation.model import LinkColumn, SymbolicModel
from modeler.effects.effect import EnergyBlock
from modeler.formulas.closed_form import derive_closed_form
from modeler.robot.read import parse_robot_text
from tests.rotation import rotating, with_cases
from tests.terms.cases import SMALL, base_of, closed_of, edited_wrist, general, model_of, robot_text
from tests.terms.closed_form_values import evaluate


def graph_torque(model: SymbolicModel, q, qd, qdd, chi) -> np.ndarray:
    """Torque of links and rotors by the Newton-Euler graph: another formula, another algebra."""
    graph = model.graph
    rest = {
        i: graph.symbol(f"chi[{i}]")
        for i, column in enumerate(model.columns)
        if isinstance(column, LinkColumn) or column.block is EnergyBlock.KINETIC
    }
    values = dict(model.geometry.values)
    for i in range(len(q)):
        values |= {f"q[{i}]": q[i], f"qd[{i}]": qd[i], f"qdd[{i}]": qdd[i]}
    values |= {f"chi[{i}]": chi[name] for i, name in enumerate(model.names)}
    return np.array(graph.evaluate_outputs(model.derive_torque(rest), values), dtype=float)


def random_state(joints: int, seed: int) -> tuple[list[float], list[float], list[float]]:
    rng = np.random.default_rng(seed)
    return tuple(list(rng.uniform(-2, 2, joints)) for _ in range(3))


def random_parameters(model: SymbolicModel, seed: int = 3) -> dict[str, float]:
    rng = np.random.default_rng(seed)
    return {name: float(rng.uniform(-1, 1)) for name in model.names}


@pytest.mark.parametrize("name", SMALL)
def test_torque_of_the_closed_form_is_that_of_newton_and_euler(name):
    model = model_of(name)
    chi = random_parameters(model)
    for seed in range(3):
        q, qd, qdd = random_state(model.geometry.joint_count, seed)
        actual = evaluate(closed_of(name), q, chi).torque(qd, qdd)
        expected = graph_torque(model, q, qd, qdd, chi)
        assert np.allclose(actual, expected, rtol=1e-11, atol=1e-11 * np.abs(expected).max())


MIXED = ["odd", *rotating("general3", "wrist", "scara")]


@pytest.mark.parametrize("name", MIXED)
def test_base_parameters_give_the_same_torque(name):
    model, base = model_of(name), base_of(name)
    closed, chi = derive_closed_form(model, base), random_parameters(model)
    numbers = {create_geometric_symbol(k): v for k, v in model.geometry.values.items()}
    grouped = {
        p.name: sum(float(t.coefficient.subs(numbers)) * chi[t.parameter] for t in p.terms)
        for p in base.parameters
    }
    q, qd, qdd = random_state(model.geometry.joint_count, 5)
    expected = evaluate(closed_of(name), q, chi).torque(qd, qdd)
    assert np.allclose(evaluate(closed, q, grouped).torque(qd, qdd), expected, rtol=1e-10)


def test_cosine_squares_everywhere_give_the_canonical_count():
    # 103 by an independent derivation: 16 gravity, 24 inertia (J11 has 9), 63 Christoffel
    model = edited_wrist(
        ('keep_sine_squares = ["J11", "J12"]', "keep_sine_squares = []"),
        ('J11 = ["s2**2*s3**2", "c3*s2**2*s3", "s2**2", "c2*s2*s3"', 'J11 = ["c2*s2*s3"'),
    )
    closed = derive_closed_form(model)
    assert closed.monomial_count == 103
    assert len(closed.by_name["J11"].terms) == 9


def test_gravity_letter_is_taken_out_only_where_it_divides_everything():
    assert closed_of("wrist").gravity_factor == "g"
    assert closed_of("odd").gravity_factor == ""
    assert closed_of("weightless").gravity_factor == ""


def test_rotor_that_two_joints_turn_enters_all_their_entries():
    """v = q2 - 2 q1: Iam2 v**2 / 2 gives 4, -2, 1 times Iam2."""
    actual = evaluate(closed_of("shared"), [0.2, 0.9], {"Iam2": 1.5}).inertia
    assert actual[0, 0] == 6.0 and actual[0, 1] == actual[1, 0] == -3.0 and actual[1, 1] == 1.5


def test_long_joint_names_are_kept_apart():
    names = " ".join(f.name for f in closed_of("weightless").functions)
    assert names == "J11_11 J11_12 J12_12 S11_11_12 S11_12_12 S12_11_11"


def test_too_large_robot_is_refused_with_its_count():
    model = derive_model(parse_robot_text(general(6), "general6"))
    with pytest.raises(DerivationError, match=r"general6.*takes about [0-9,]+ products.*500,000"):
        derive_closed_form(model)


@pytest.mark.parametrize(
    ("cell", "message"),
    [("1/L", r"got 1/L.*declare a symbol"), ("s1", r"symbol s1 reads like the sine.*rename")],
)
def test_lengths_must_be_polynomials_of_letters(cell, message):
    row = f'"1", "0", 0, 0, 0, 0, "{cell}", "q1", 0'
    text = robot_text("slope", [row], "L = 0.5\ns1 = 0.5\n")
    with pytest.raises(DerivationError, match=message):
        derive_closed_form(derive_model(parse_robot_text(text, "slope")))


@with_cases(
    "new, message", ('["J99"]', r"got J99, which is zero"), ("[11]", r"got \[11\]; expected a list")
)
def test_wrong_choice_of_squares(new, message):
    with pytest.raises(RobotError, match=f"keep_sine_squares: {message}"):
        derive_closed_form(edited_wrist(('["J11", "J12"]', new)))
