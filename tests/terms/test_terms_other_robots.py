"""Coefficient tables of other robots: names, relations, physical letters, the map."""

import random
from typing import Any

import numpy as np
import pytest
import sympy
from sympy.polys.domains import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

from modeler.core.choices import read_builtin_robot
from modeler.core.errors import RobotError
from modeler.derivation.base_parameters import derive_base_parameters
from modeler.derivation.derive import derive_model
from modeler.derivation.field import evaluate_modulo
from modeler.formulas.coefficients import (
    build_coefficient_table,
    format_backward_map,
    format_forward_map,
    select_independent_coefficients,
)
from modeler.formulas.physical import draw_random_point
from modeler.formulas.ring import build_base_map
from modeler.robot.read import parse_robot_text
from tests.base.formulas import text_value
from tests.rotation import rotating, with_cases
from tests.terms.cases import TEXTS, closed_of, robot_text, table_of
from tests.terms.closed_form_values import evaluate
from tests.terms.printed_lines import compiled, derived

ROBOTS = ["two-link", "odd", "emps", *rotating("scara", "general3", "weightless", "demo-arm")]


@pytest.mark.parametrize("name", [*ROBOTS, *rotating("orthoglide-leg")])
def test_combinations_hold_at_a_random_point(name):
    """Exactly, modulo a prime: every coefficient is the combination that the table states."""
    table = table_of(name)
    prime, point = draw_random_point(table.physical.names, random.Random(4))
    values = {c.name: evaluate_modulo(c.physical, point, prime) for c in table.coefficients}
    for key, combination in table.relations.combinations.items():
        terms = ((v.numerator, v.denominator, values[k]) for k, v in combination.items())
        total = sum(n * pow(d, -1, prime) * value for n, d, value in terms)
        assert (values[key] - total) % prime == 0, key


@pytest.mark.parametrize("name", [*ROBOTS, *rotating("wrist")])
def test_the_printed_map_and_its_printed_inverse_undo_each_other(name):
    """Known geometry leaves as many coefficients as there are base parameters in M, S or g."""
    table, random = table_of(name), np.random.default_rng(14)
    kinds = [table.base.columns[p.column].kind for p in table.base.parameters]
    frictionless = sum(kind in ("inertial", "rotor_inertia") for kind in kinds)
    assert len(table.known_geometry) == len(table.map.columns) == frictionless
    lengths = {name: random.uniform(0.3, 1.4) for name in table.closed.algebra.geometry.values}
    base = {name: random.uniform(0.3, 1.4) for name in table.base_names}
    forward = [line.split(" = ") for line in format_forward_map(table)]
    coefficients = {name: text_value(right, lengths | base) for name, right in forward}
    assert list(coefficients) == list(table.map.rows)
    values = {
        name: text_value(right, lengths | coefficients)
        for name, right in (line.split(" = ") for line in format_backward_map(table))
    }
    assert values.keys() == set(table.map.columns) and table.map.determinant
    for name, value in values.items():
        assert value == pytest.approx(base[name], rel=1e-10), name


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


LEVER = robot_text(
    "lever",
    ['"1", "0", 0, 0, 0, 0, 0, "q1", 0'],
    rest='[physical.1]\nmass = "m"\ncentre = ["u - v", 0, 0]\ninertia = [0, 0, 0, 0, 0, 0]\n',
)


def test_which_letters_are_felt():
    """An axis needs its mass; rotors and angles count, once; MZ of a last link enters as cz3, and
    with a known length not alone; of a difference of letters it is reported.
    """
    table = table_of("emps")
    assert [(c.name, c.function, c.monomial) for c in table.coefficients] == [("PJ1", "J11", "1")]
    assert table.identifiability.appearing == ("m1",)
    odd = table_of("odd").identifiability
    assert {"Ia1", "Ia2", "Ia3"} <= set(odd.appearing) and "al" in odd.letters
    assert not any(letter.startswith(("cos", "sin")) for letter in odd.letters)
    model = derive_model(parse_robot_text(LEVER, "lever"))
    lever = build_coefficient_table(model, derive_base_parameters(model))
    for table, sums in ((table_of("scara"), {"Izz2": 1, "Izz3": 1}), (lever, {"u": 1, "v": -1})):
        assert [dict(group) for group in table.identifiability.sums] == [sums]


@with_cases(
    "text, message",
    (
        read_builtin_robot("wrist").replace('mass = "bm"', 'mass = "sin(bm)"'),
        r'\[physical.2\]: got "sin\(bm\)"; expected a polynom',
    ),
    (
        read_builtin_robot("wrist").replace('mass = "bm"', 'mass = "1/bm"'),
        r'\[physical.2\]: got "1/bm"; expected a polynomial',
    ),
    (
        TEXTS["weightless"].replace('"L"', '"m12"').replace("L = 0.5", "m12 = 0.5"),
        r"symbol m12 is also the name of a physical parameter",
    ),
)
def test_letters_that_cannot_be_are_refused(text, message):
    model = derive_model(parse_robot_text(text, "robot"))
    with pytest.raises(RobotError, match=message):
        build_coefficient_table(model, derive_base_parameters(model))


@pytest.mark.parametrize("name", ["orthoglide-leg", *rotating("geared", "sr400")])
def test_expanded_form_of_a_tied_robot_gives_the_torque_of_the_c(name):
    derivation, model = derived(name), compiled(name)
    columns = derivation.base.columns
    closed = closed_of(name)
    rng = np.random.default_rng(4)
    chi = dict.fromkeys(derivation.model.names, 0.0)
    for column in columns:
        if column.kind in ("inertial", "rotor_inertia"):
            chi[column.name] = float(rng.normal())
    for _ in range(3):
        q, qd, qdd = rng.uniform(-2, 2, (3, derivation.model.geometry.coordinate_count))
        actual = np.array(evaluate(closed, list(q), chi).torque(qd, qdd))
        phi = model.regressor(q[None], qd[None], qdd[None])[0]
        expected = phi @ np.array([chi[name] for name in derivation.model.names])
        assert np.max(np.abs(actual - expected)) < 1e-12 * np.max(np.abs(expected))


def test_a_leg_has_34_coefficients_of_rank_12():
    """As many as its inertial base parameters (eq. 18); gravity acts on q3 alone."""
    table = table_of("orthoglide-leg")
    assert len(table.coefficients) == 34 and table.relations.rank == 12
    assert len(table.known_geometry) == len(table.map.columns) == 12 and table.map.determinant
    assert [c.monomial for c in table.coefficients if c.function == "g3"] == ["s3", "c3"]
    assert "m5" not in table.physical.letters  # link 5 has no body


def test_long_tables_are_cut_to_what_the_others_follow_from():
    table = table_of("wrist")
    short = select_independent_coefficients(table)
    assert len(table.coefficients) == 101
    assert [c.name for c in short.coefficients] == list(table.relations.independent)


def test_a_determinant_that_nobody_would_read_is_not_expanded():
    """That of seven joints with general angles takes minutes."""
    ring = PolyRing(["a", "b"], QQ, lex)
    names = [str(k) for k in range(13)]
    a, b = ring.gens

    def entries(size: int) -> list[dict[int, Any]]:
        return [{j: a**j + b**i * (i + j) for j in range(size)} for i in range(size)]

    assert build_base_map(names[:2], entries(2), names[:2], ring).determinant
    assert build_base_map(names, entries(13), names, ring).determinant is None
