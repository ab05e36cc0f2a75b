"""Expanded forms and coefficients of robots whose joints follow others, and their motions."""

from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from sympy.polys.domains import QQ
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyRing

from modeler.formulas.closed_form import closed_form
from modeler.formulas.coefficients import independent_coefficients
from modeler.formulas.ring import base_map, motions_of
from tests.terms.cases import model_of, table_of
from tests.terms.closed_form_values import evaluate
from tests.terms.printed_lines import compiled, derived

ROBOTS = ["orthoglide-leg", "geared", "sr400"]


@pytest.mark.parametrize("name", ROBOTS)
def test_expanded_form_of_a_tied_robot_gives_the_torque_of_the_c(name):
    derivation, model = derived(name), compiled(name)
    columns = derivation.base.columns
    closed = closed_form(derivation.model)
    rng = np.random.default_rng(4)
    chi = dict.fromkeys(derivation.model.names, 0.0)
    for column in columns:
        if column.kind in ("inertial", "rotor_inertia"):
            chi[column.name] = float(rng.normal())
    for _ in range(3):
        q, qd, qdd = rng.uniform(-2, 2, (3, derivation.model.geometry.coordinates))
        found = np.array(evaluate(closed, list(q), chi).torque(qd, qdd))
        phi = model.regressor(q[None], qd[None], qdd[None])[0]
        expected = phi @ np.array([chi[name] for name in derivation.model.names])
        assert np.max(np.abs(found - expected)) < 1e-12 * np.max(np.abs(expected))


def test_a_leg_has_34_coefficients_of_rank_12():
    """As many as its inertial base parameters (eq. 18); gravity acts on q3 alone."""
    table = table_of("orthoglide-leg")
    assert len(table.coefficients) == 34 and table.relations.rank == 12
    assert len(table.known_geometry) == len(table.map.columns) == 12 and table.map.determinant
    assert [c.monomial for c in table.coefficients if c.function == "g3"] == ["s3", "c3"]
    assert "m5" not in table.physical.letters  # link 5 has no body


def test_motions_of_gears_screws_and_sums():
    """q2 = q1/2 makes q1/2 the angle; 1.37 q3 is an angle of its own; q3 - 2 q1 too long a sum."""
    found = motions_of(model_of("geared").geometry)
    assert found.names == ("s1_2", "c1_2", "s3", "c3", "s7", "c7", "q1", "s5", "c5", "s6", "c6")
    assert found.turns[0] == {0: 2} and found.turns[1] == {0: 1}
    assert found.each[0].form == {0: Fraction(1, 2)}
    assert found.each[4].form == {1: Fraction(137, 100)} and found.travel(0) == 6


def test_parallelograms_need_no_angles_of_their_own():
    found = motions_of(model_of("sr400").geometry)
    assert [motion.joint for motion in found.each] == ["1", "2", "4", "5", "6", "7"]


def test_long_tables_are_cut_to_what_the_others_follow_from():
    table = table_of("wrist")
    short = independent_coefficients(table)
    assert len(table.coefficients) == 101
    assert [c.name for c in short.coefficients] == list(table.relations.independent)


def test_a_determinant_that_nobody_would_read_is_not_expanded():
    """That of seven joints with general angles takes minutes."""
    ring = PolyRing(["a", "b"], QQ, lex)
    names = [str(k) for k in range(13)]
    a, b = ring.gens

    def entries(size: int) -> list[dict[int, Any]]:
        return [{j: a**j + b**i * (i + j) for j in range(size)} for i in range(size)]

    assert base_map(names[:2], entries(2), names[:2], ring).determinant
    assert base_map(names, entries(13), names, ring).determinant is None
