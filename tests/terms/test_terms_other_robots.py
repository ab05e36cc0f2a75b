"""Coefficient tables of other robots: names, relations, physical letters, the map."""

import random

import pytest
import sympy

from modeler.core.errors import RobotError
from modeler.derivation.base_parameters import base_parameters
from modeler.derivation.derive import derive_model
from modeler.derivation.field import value_modulo
from modeler.formulas.coefficients import coefficient_table
from modeler.formulas.physical import random_point
from modeler.formulas.ring import inverse_map
from modeler.robot.read import robot_from_text
from tests.terms.cases import TEXTS, edited_wrist, robot_text, table_of

ROBOTS = ["two-link", "scara", "general3", "odd", "weightless", "emps", "demo-arm"]


@pytest.mark.parametrize("name", [*ROBOTS, "orthoglide-leg"])
def test_combinations_hold_at_a_random_point(name):
    """Exactly, modulo a prime: every coefficient is the combination that the table states."""
    table = table_of(name)
    prime, point = random_point(table.physical.names, random.Random(4))
    values = {c.name: value_modulo(c.physical, point, prime) for c in table.coefficients}
    for key, combination in table.relations.combinations.items():
        total = sum(
            v.numerator * pow(v.denominator, -1, prime) * values[k] for k, v in combination.items()
        )
        assert (values[key] - total) % prime == 0, key


@pytest.mark.parametrize("name", ROBOTS)
def test_map_is_square_with_as_many_rows_as_base_parameters_that_count(name):
    """Known geometry leaves as many coefficients as there are base parameters in M, S or g."""
    table = table_of(name)
    frictionless = [
        p
        for p in table.base.parameters
        if table.base.columns[p.column].kind in ("inertial", "rotor_inertia")
    ]
    assert len(table.known_geometry) == len(table.map.columns) == len(frictionless)
    assert table.map.determinant
    inverse = inverse_map(table.map, table.closed.algebra.static_ring)
    assert inverse is not None and set(inverse) == {p.name for p in frictionless}


def test_generic_letters_and_first_names_of_a_planar_arm():
    """Textbook 2R: J11 = ... + 2 L1 (MX2 c2 - MY2 s2), J12 and S112 follow from it."""
    table = table_of("two-link")
    by_place = {(c.function, c.monomial): c for c in table.coefficients}
    combination = table.relations.combinations
    names = {place: c.name for place, c in by_place.items()}
    twice = names["J11", "c2"]
    assert combination[names["J12", "c2"]] == {twice: sympy.Rational(1, 2)}
    assert combination[names["S112", "s2"]] == {twice: -1}
    m2, cx2, L1 = sympy.symbols("m2 cx2 L1")
    assert by_place["J11", "c2"].physical.as_expr() == 2 * m2 * cx2 * L1
    assert names["g1", "s1*s2"] == "PG1" and names["J11", "s2"] == "PJ1"


def test_an_axis_needs_only_its_mass():
    table = table_of("emps")
    assert [(c.name, c.function, c.monomial) for c in table.coefficients] == [("PJ1", "J11", "1")]
    assert table.identifiability.appearing == ("m1",)


def test_rotor_inertias_are_physical_parameters():
    appearing = table_of("odd").identifiability.appearing
    assert {"Ia1", "Ia2", "Ia3"} <= set(appearing)


def test_angles_count_once():
    letters = table_of("general3").identifiability.letters
    assert {"al1", "al2", "al3"} <= set(letters)
    assert not any(letter.startswith(("cos", "sin")) for letter in letters)


def test_no_column_of_the_jacobian_is_mistaken_for_another():
    """Physical: MZ of the last link enters as cz3, and with a known length not alone."""
    table = table_of("scara")
    assert [dict(group) for group in table.identifiability.sums] == [{"Izz2": 1, "Izz3": 1}]


def test_difference_of_two_letters_is_told():
    link = '[physical.1]\nmass = "m"\ncentre = ["u - v", 0, 0]\ninertia = [0, 0, 0, 0, 0, 0]\n'
    text = robot_text("lever", ['"1", "0", 0, 0, 0, 0, 0, "q1", 0'], rest=link)
    model = derive_model(robot_from_text(text, "lever"))
    table = coefficient_table(model, base_parameters(model))
    assert [dict(group) for group in table.identifiability.sums] == [{"u": 1, "v": -1}]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('mass = "bm"', 'mass = "sin(bm)"', r'\[physical.2\]: got "sin\(bm\)"; expected a polynom'),
        ('mass = "bm"', 'mass = "1/bm"', r'\[physical.2\]: got "1/bm"; expected a polynomial'),
    ],
)
def test_mistakes_in_physical(old, new, message):
    model = edited_wrist((old, new))
    with pytest.raises(RobotError, match=message):
        coefficient_table(model, base_parameters(model))


def test_symbol_that_is_a_generic_letter_is_refused():
    text = TEXTS["weightless"].replace('"L"', '"m12"').replace("L = 0.5", "m12 = 0.5")
    model = derive_model(robot_from_text(text, "weightless"))
    with pytest.raises(RobotError, match=r"symbol m12 is also the name of a physical parameter"):
        coefficient_table(model, base_parameters(model))
