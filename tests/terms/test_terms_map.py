"""The printed map to the base parameters and its printed inverse undo each other."""

import numpy as np
import pytest

from modeler.formulas.render import backward_lines, forward_lines
from tests.base.formulas import text_value
from tests.terms.cases import table_of


@pytest.mark.parametrize("name", ["wrist", "odd"])
def test_the_printed_map_and_its_printed_inverse_undo_each_other(name):
    table, random = table_of(name), np.random.default_rng(14)
    lengths = {name: random.uniform(0.3, 1.4) for name in table.closed.algebra.geometry.values}
    base = {name: random.uniform(0.3, 1.4) for name in table.base_names}
    forward = [line.split(" = ") for line in forward_lines(table)]
    coefficients = {name: text_value(right, lengths | base) for name, right in forward}
    assert list(coefficients) == list(table.map.rows)
    backward = [line.split(" = ") for line in backward_lines(table)]
    if table.map.determinant is None:
        assert backward == []
        return
    found = {name: text_value(right, lengths | coefficients) for name, right in backward}
    assert found.keys() == set(table.map.columns)
    for name, value in found.items():
        assert value == pytest.approx(base[name], rel=1e-10), name
