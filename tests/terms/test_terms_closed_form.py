"""Closed forms against the Newton-Euler graph, laws, and an independent count of monomials."""

from itertools import product

import numpy as np
import pytest
import sympy

from modeler.core.errors import DerivationError, RobotError
from modeler.derivation.columns import LinkColumn
from modeler.derivation.derive import derive_model
from modeler.derivation.geometry import geometric_symbol
from modeler.derivation.model import SymbolicModel
from modeler.effects.effect import EnergyBlock
from modeler.formulas.closed_form import ClosedForm, closed_form
from modeler.formulas.ring import TrigRing
from modeler.robot.read import robot_from_text
from tests.rotation import rotating
from tests.terms.cases import SMALL, base_of, closed_of, edited_wrist, general, model_of, robot_text
from tests.terms.closed_form_values import evaluate


def graph_torque(model: SymbolicModel, q, qd, qdd, chi) -> np.ndarray:
    """Torque of links and rotors by the Newton-Euler graph: another formula, another algebra."""
    graph = model.graph
    kept = {
        i: graph.symbol(f"chi[{i}]")
        for i, column in enumerate(model.columns)
        if isinstance(column, LinkColumn) or column.block is EnergyBlock.KINETIC
    }
    values = dict(model.geometry.values)
    for i in range(len(q)):
        values |= {f"q[{i}]": q[i], f"qd[{i}]": qd[i], f"qdd[{i}]": qdd[i]}
    values |= {f"chi[{i}]": chi[name] for i, name in enumerate(model.names)}
    return np.array(graph.evaluate(model.torque(kept), values), dtype=float)


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
        q, qd, qdd = random_state(model.geometry.joints, seed)
        found = evaluate(closed_of(name), q, chi).torque(qd, qdd)
        expected = graph_torque(model, q, qd, qdd, chi)
        assert np.allclose(found, expected, rtol=1e-11, atol=1e-11 * np.abs(expected).max())


MIXED = ["odd", *rotating("general3", "wrist", "scara")]


@pytest.mark.parametrize("name", MIXED)
def test_base_parameters_give_the_same_torque(name):
    model, base = model_of(name), base_of(name)
    closed, chi = closed_form(model, base), random_parameters(model)
    numbers = {geometric_symbol(k): v for k, v in model.geometry.values.items()}
    grouped = {
        p.name: sum(float(t.coefficient.subs(numbers)) * chi[t.parameter] for t in p.terms)
        for p in base.parameters
    }
    q, qd, qdd = random_state(model.geometry.joints, 5)
    expected = evaluate(closed_of(name), q, chi).torque(qd, qdd)
    assert np.allclose(evaluate(closed, q, grouped).torque(qd, qdd), expected, rtol=1e-10)


def as_sympy(closed: ClosedForm, name: str) -> sympy.Expr:
    """A function as a sympy expression of s, c, parameters: for an independent recount."""
    function = closed.by_name[name]
    motion = [sympy.Symbol(x) for x in closed.algebra.names[: closed.algebra.moving]]
    total = sympy.Integer(0)
    for exponents, form in function.terms.items():
        monomial = sympy.prod([x**e for x, e in zip(motion, exponents, strict=True)])
        for column, factor in form.items():
            total += monomial * factor.as_expr() * sympy.Symbol(closed.parameters[column])
    return sympy.expand(total)


def monomials(expression: sympy.Expr, motion: list[sympy.Symbol]) -> int:
    return 0 if expression == 0 else len(sympy.Poly(expression, *motion).terms())


@pytest.mark.parametrize(
    ("robot", "name"),
    [("general3", name) for name in ("J12", "J22", "S213")]
    + [pytest.param("orthoglide-leg-tree", n, marks=pytest.mark.rotating) for n in ("J22", "S223")]
    + [("two-link", "J11")],
)
def test_no_choice_of_squares_has_fewer_monomials(robot, name):
    closed = closed_of(robot)
    expression = as_sympy(closed, name)
    turning = [m.joint for m in closed.algebra.motions if m.sine is not None]
    motion = [sympy.Symbol(x) for x in closed.algebra.names[: closed.algebra.moving]]
    counts = []
    for choice in product("sc", repeat=len(turning)):
        reduced = expression
        for joint, letter in zip(turning, choice, strict=True):
            old, new = (sympy.Symbol(x + joint) for x in (letter, "c" if letter == "s" else "s"))
            reduced = sympy.expand(reduced.subs(old**2, 1 - new**2))
        counts.append(monomials(reduced, motion))
    assert len(closed.by_name[name].terms) == min(counts)


def test_cosine_squares_everywhere_give_the_canonical_count():
    # 103 by an independent derivation: 16 gravity, 24 inertia (J11 has 9), 63 Christoffel
    model = edited_wrist(
        ('keep_sine_squares = ["J11", "J12"]', "keep_sine_squares = []"),
        ('J11 = ["s2**2*s3**2", "c3*s2**2*s3", "s2**2", "c2*s2*s3"', 'J11 = ["c2*s2*s3"'),
    )
    closed = closed_form(model)
    assert closed.monomials == 103
    assert len(closed.by_name["J11"].terms) == 9


def test_gravity_letter_is_taken_out_only_where_it_divides_everything():
    assert closed_of("wrist").gravity_factor == "g"
    assert closed_of("odd").gravity_factor == ""
    assert closed_of("weightless").gravity_factor == ""


def test_rotor_that_two_joints_turn_enters_all_their_entries():
    """v = q2 - 2 q1: Iam2 v**2 / 2 gives 4, -2, 1 times Iam2."""
    found = evaluate(closed_of("shared"), [0.2, 0.9], {"Iam2": 1.5}).inertia
    assert found[0, 0] == 6.0 and found[0, 1] == found[1, 0] == -3.0 and found[1, 1] == 1.5


def test_long_joint_names_are_kept_apart():
    names = " ".join(f.name for f in closed_of("weightless").functions)
    assert names == "J11_11 J11_12 J12_12 S11_11_12 S11_12_12 S12_11_11"


def test_derivative_in_normal_form_is_the_derivative():
    algebra = TrigRing(model_of("odd").geometry)
    s1, c1, q2, s3, c3, *_ = algebra.ring.gens
    poly = algebra.normal(s1**2 * c3 * q2**3 + s1 * c1 * s3 - 4 * c1**2 * q2)
    x, y, z = sympy.symbols("x y z")
    values = (sympy.sin(x), sympy.cos(x), y, sympy.sin(z), sympy.cos(z))
    places = dict(zip(algebra.ring.symbols[:5], values, strict=True))
    function = poly.as_expr().subs(places)
    assert sympy.simplify(function - (sympy.sin(x) ** 2 * sympy.cos(z) * y**3
        + sympy.sin(x) * sympy.cos(x) * sympy.sin(z) - 4 * sympy.cos(x) ** 2 * y)) == 0  # fmt: skip
    for index, variable in enumerate((x, y, z)):
        found = algebra.derivative(poly, index).as_expr().subs(places)
        assert sympy.simplify(found - sympy.diff(function, variable)) == 0


def test_too_large_robot_is_refused_with_its_count():
    model = derive_model(robot_from_text(general(6), "general6"))
    with pytest.raises(DerivationError, match=r"general6.*takes about [0-9,]+ products.*500,000"):
        closed_form(model)


def test_lengths_must_be_polynomials():
    text = robot_text("slope", ['"1", "0", 0, 0, 0, 0, "1/L", "q1", 0'], "L = 0.5\n")
    with pytest.raises(DerivationError, match=r"got 1/L.*declare a symbol"):
        closed_form(derive_model(robot_from_text(text, "slope")))


def test_symbol_that_reads_like_a_sine_is_refused():
    text = robot_text("clash", ['"1", "0", 0, 0, 0, 0, "s1", "q1", 0'], "s1 = 0.5\n")
    with pytest.raises(DerivationError, match=r"symbol s1 reads like the sine.*rename"):
        closed_form(derive_model(robot_from_text(text, "clash")))


@pytest.mark.parametrize(
    ("new", "message"),
    [('["J99"]', r"got J99, which is zero"), ("[11]", r"got \[11\]; expected a list")],
)
def test_wrong_choice_of_squares(new, message):
    with pytest.raises(RobotError, match=f"keep_sine_squares: {message}"):
        closed_form(edited_wrist(('["J11", "J12"]', new)))
