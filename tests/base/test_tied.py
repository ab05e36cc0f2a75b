"""Joints that follow others: all relations, exactly, against papers and other ways to them."""

import re
from pathlib import Path

import numpy as np
import pytest
import sympy

from modeler.core.choices import read_builtin_robot
from modeler.derivation.base_parameters import derive_column_relations
from modeler.derivation.derive import derive_model
from modeler.derivation.field import CoefficientTooLarge, build_geometry_field, reduce_sparse_rows
from modeler.derivation.modular import derive_tied_relations
from modeler.derivation.numeric_rank import draw_random_states, evaluate_regressor
from modeler.robot.read import parse_robot_text
from tests.base.ranks import seen
from tests.modules import module
from tests.rotation import with_cases

TIES = '[relations]\nq4 = "-q3"\nq5 = "-q2 - pi/2"\nq7 = "q3"\n'


def leg(gravity: str = "[0, 'g', 0]", effects: str = "", changes: tuple = (), links: str = ""):
    """The open leg with its relations."""
    text = re.sub(r"\[effects\](.*\n)*?(?=\[|\Z)", "", read_builtin_robot("orthoglide-leg-tree"))
    text = re.sub(r"^gravity = .*$", f"gravity = {gravity}", text, flags=re.M)
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return derive_model(parse_robot_text(f"{text}\n{TIES}\n{links}\n{effects}", "leg"))


def energetic(model) -> list[int]:
    return [i for i, column in enumerate(model.columns) if column.kind != "friction"]


def relations_of(model, seed: int = 3):
    K = build_geometry_field(model.geometry)
    order = range(len(model.columns))
    return K, derive_tied_relations(model.geometry, model.columns, K, order, seed)


def grouping(model, text: str) -> sympy.Matrix:
    """K of printed base parameters: beta = K chi."""
    letters = {s: sympy.Symbol(s, real=True) for s in model.geometry.values}
    chi = [sympy.Symbol(name) for name in model.names]
    names = letters | {symbol.name: symbol for symbol in chi}
    rows = [sympy.sympify(line, locals=names) for line in text.split("\n") if line.strip()]
    return sympy.Matrix([[sympy.expand(row).coeff(symbol) for symbol in chi] for row in rows])


def assert_groups_as(model, text: str) -> None:
    """W = W_base K: the relations are the null space of K."""
    printed = grouping(model, text)
    K, relations = relations_of(model)
    assert len(relations) == len(energetic(model)) - printed.rank()
    for relation in relations:
        vector = sympy.zeros(len(model.columns), 1)
        for place, x in relation.items():
            vector[place] = K.expression(x)
        assert (printed * vector).applyfunc(sympy.simplify).is_zero_matrix


EQUATION_18 = """
Ia1 + M1 + M2 + M3 + M4 + M7
ZZ2 + YY3 + YY4 + D4**2*M4 + YY7
MX2
MY2 + MZ3 + MZ4 + MZ7
XX3 - YY3 - D4**2*M4 + XX7 - YY7
XY3 + XY7
XZ3 - D4*MZ4 + XZ7
YZ3 + YZ7
ZZ3 + D4**2*M4 + ZZ7
MX3 + D4*M4 + MX7
MY3 + MY7
MX4
"""
ALONG_THE_SLIDE = EQUATION_18.replace("Ia1 + M1 + M2 + M3 + M4 + M7", "Ia1\nM1 + M2 + M3 + M4 + M7")
NO_LINK_5 = {"links": "[links]\n5 = []\n", "effects": '[effects]\nrotor_inertia = ["1"]\n'}


@with_cases(
    "gravity, printed, rank",
    ("[0, 'g', 0]", EQUATION_18, 12),
    ("[0, 0, 'g']", ALONG_THE_SLIDE, 13),
    ("['g', 'g/3', '-g']", ALONG_THE_SLIDE, 13),
)
def test_orthoglide_leg_groups_as_printed(gravity, printed, rank):
    """Guegan, Khalil, Lemoine 2003, eq. (18): every term, and no other relation."""
    model = leg(gravity, **NO_LINK_5)
    assert grouping(model, printed).rank() == rank
    assert_groups_as(model, printed)


FOOTNOTE = """
M1 + Ia1 + M2 + M3 + M4 + M5
ZZ2 + Ia2 + YY3 + YY4 + Ia5 + D4**2*(M4 + M5)
MX2
MY2 + MZ3 + MZ4
XX3 - YY3 - D4**2*(M4 + M5)
XY3
XZ3 - D4*MZ4
YZ3
ZZ3 + Ia3 + Ia4 + D4**2*(M4 + M5)
MX3 + D4*(M4 + M5)
MY3
MX4
"""


def test_serial_leg_with_rotors_on_passive_joints():
    """One leg of Briot, Gautier 2012: link 5 keeps its direction, so that it acts as a mass."""
    rotors = '[effects]\nrotor_inertia = ["1", "2", "3", "4", "5"]\n'
    assert_groups_as(leg(effects=rotors, links="[links]\n7 = []\n"), FOOTNOTE)


def test_offset_of_a_slide_along_gravity():
    """Power of a constant force and of weight along the slide: Off - g (all masses)."""
    effects = '[effects]\nrotor_inertia = ["1"]\noffset = ["1"]\n'
    model = leg("[0, 0, 'g']", effects, links=NO_LINK_5["links"])
    assert_groups_as(model, EQUATION_18 + "Off1 - g*(M1 + M2 + M3 + M4 + M7)")


GEARED = Path(__file__).with_name("geared.toml").read_text(encoding="utf-8")


TURN = ("scara", "sr400-tree", "tx40")


def numeric_columns(model) -> np.ndarray:
    states = draw_random_states(model, 200, np.random.default_rng(5))
    return evaluate_regressor(model, states).reshape(-1, len(model.columns))


def test_gears_and_screws():
    """Against the torques at random states, which know nothing of energies and primes."""
    model = derive_model(parse_robot_text(GEARED, "geared"))
    K, relations = relations_of(model)
    W = numeric_columns(model)
    assert seen(model) == len(model.columns) - len(relations)
    values = {sympy.Symbol(n, real=True): x for n, x in model.geometry.values.items()}
    for relation in relations:
        left = sum(float(K.expression(x).subs(values)) * W[:, i] for i, x in relation.items())
        assert np.max(np.abs(left)) < 1e-10 * np.max(np.abs(W))
    # Ia turns with the motor, ZZ1 with 1.0186 times its speed.
    zz1, ia = (model.names.index(name) for name in ("ZZ1", "Iam1"))
    (row,) = [r for r in relations if zz1 in r and len(r) == 2]
    assert {place: K.expression(x) for place, x in row.items()} == {
        zz1: 1,
        ia: -(sympy.Rational(10186, 10000) ** 2),
    }


@pytest.mark.parametrize(
    "name", ["emps", "wrist", *(pytest.param(n, marks=pytest.mark.rotating) for n in TURN)]
)
def test_plain_trees_give_what_link_by_link_elimination_gives(name):
    """Two methods, sharing neither equations nor arithmetic: the same relations, to the letter."""
    model = module(name).model
    K = build_geometry_field(model.geometry)
    order = list(range(len(model.columns)))
    rows = derive_column_relations(model, model.geometry, K, 1).rows
    wanted = [row for row in rows if {*row} <= {*energetic(model)}]
    result = derive_tied_relations(model.geometry, model.columns, K, order, 8)
    assert _reduced(result, order) == _reduced(wanted, order)


def _reduced(rows, order):
    reduced, pivots = reduce_sparse_rows(rows, order)
    return dict(zip(pivots, reduced, strict=True))


def test_the_order_says_what_is_kept():
    model = leg(**NO_LINK_5)
    K = build_geometry_field(model.geometry)
    forward = list(range(len(model.columns)))
    last = derive_tied_relations(model.geometry, model.columns, K, forward[::-1], 3)
    dropped = {min(relation) for relation in last}
    assert len(dropped) == len(last)
    assert all(relation[min(relation)] == K.one for relation in last)
    assert _reduced(last, forward) == _reduced(relations_of(model)[1], forward)


@pytest.mark.parametrize(
    ("length", "message"),
    [("2147483647/10**9", "what depends on what"), ("1/2147483647", "no value modulo a prime")],
)
def test_multiples_of_the_primes(length, message):
    """A length that is zero, or infinite, modulo a prime must not pass for one that is."""
    model = leg(changes=(('"D4"', f'"{length}"'),), **NO_LINK_5)
    with pytest.raises(CoefficientTooLarge, match=message):
        relations_of(model)
