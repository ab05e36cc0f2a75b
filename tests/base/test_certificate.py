"""The certificate must be able to say no."""

import dataclasses

import numpy as np
import pytest

from modeler.derivation import base_parameters, field
from modeler.derivation.derive import derive_model
from modeler.derivation.modular import PRIME, compute_modular_rank
from modeler.robot.read import read_robot


@pytest.fixture(scope="module")
def wrist():
    model = derive_model(read_robot("wrist"))
    K = field.build_geometry_field(model.geometry)
    return model, K, base_parameters.derive_column_relations(model, model.geometry, K, seed=1)


def prove(model, K, relations, seed):
    return base_parameters.certify_relations(model.geometry, model.columns, K, relations, seed)


def test_right_relations_pass(wrist):
    assert prove(*wrist, seed=1).rank == 17


def test_a_wrong_coefficient_is_found(wrist):
    model, K, relations = wrist
    index = next(i for i, row in enumerate(relations.rows) if len(row) > 1)
    row = dict(relations.rows[index])
    other = next(place for place in row if place != relations.dropped_columns[index])
    row[other] = row[other] + K.one
    rows = (*relations.rows[:index], row, *relations.rows[index + 1 :])
    wrong = dataclasses.replace(relations, rows=rows)
    with pytest.raises(base_parameters.ProofError, match=r"the relation of \w+ does not hold"):
        prove(model, K, wrong, seed=1)


def test_a_missing_relation_is_found(wrist):
    model, K, relations = wrist
    fewer = dataclasses.replace(
        relations,
        rows=relations.rows[1:],
        dropped_columns=relations.dropped_columns[1:],
        kept_columns=tuple(sorted((*relations.kept_columns, relations.dropped_columns[0]))),
    )
    with pytest.raises(
        base_parameters.ProofError, match="of 18 columns kept only 17 are independent"
    ):
        prove(model, K, fewer, seed=1)


def test_modular_arithmetic():
    values = np.array([2, 3, PRIME - 1], dtype=np.int64)
    np.testing.assert_array_equal(values * field.invert_residues(values, PRIME) % PRIME, 1)
    assert field.compute_power(values, 5, PRIME)[0] == 32
    rng = np.random.default_rng()
    for rows, inner, columns in ((3, 2, 3), (40, 7, 12), (41, 12, 20), (25, 12, 12), (5, 5, 9)):
        left, right = (rng.integers(0, PRIME, s) for s in ((rows, inner), (inner, columns)))
        matrix = np.array([[sum(map(int, a * b % PRIME)) % PRIME for b in right.T] for a in left])
        matrix[:, rng.random(columns) < 0.2] = 0
        assert compute_modular_rank(matrix) == len(
            field.reduce_to_echelon(matrix.copy(), range(columns), PRIME)
        )
