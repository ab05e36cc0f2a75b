"""Friction columns group by the speeds of their shafts."""

from fractions import Fraction

import numpy as np

from modeler.derivation.columns import ShaftColumn
from modeler.derivation.grouping import friction_relations
from modeler.effects.catalogue import effect_named
from modeler.effects.effect import Acts


def columns(effect: str, *shafts: dict[int, float]) -> list[ShaftColumn]:
    (own,) = effect_named(effect).columns
    return [
        ShaftColumn(
            name=f"F{i}", row=0, prefix="F", unit="", kind=own.kind, effect=effect,
            equation=own.equation, block=own.block, nonnegative=True,
            shaft=shaft, acts=Acts.JOINT, shapes={}, memory=None,
        )
        for i, shaft in enumerate(shafts)
    ]  # fmt: skip


def test_coulomb_columns_of_proportional_speeds_group():
    """q5 = -q2 as on the Orthoglide: weight |-1|; a gear of 2.5: weight 2.5."""
    given = columns(
        "coulomb", {0: 1}, {0: -1}, {1: 1}, {0: 1, 1: 1}, {0: Fraction(5, 2), 1: Fraction(5, 2)}
    )
    assert friction_relations(given) == [
        {1: Fraction(1), 0: Fraction(-1)},
        {4: Fraction(1), 3: Fraction(-5, 2)},
    ]


def test_viscous_columns_group_by_their_squares():
    """(q1 + q2)**2 + (q1 - q2)**2 = 2 q1**2 + 2 q2**2: the fourth column is dependent."""
    given = columns("viscous", {0: 1}, {1: 1}, {0: 1, 1: 1}, {0: 1, 1: -1})
    (relation,) = friction_relations(given)
    rng = np.random.default_rng(1)
    E = np.array([[1, 0], [0, 1], [1, 1], [1, -1]], dtype=float)
    qd = rng.normal(size=2)
    total = sum(float(c) * E[i] * (E[i] @ qd) for i, c in relation.items())
    np.testing.assert_allclose(total, 0, atol=1e-14)
    assert set(relation) == {0, 1, 2, 3}
