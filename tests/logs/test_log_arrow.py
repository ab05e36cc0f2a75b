"""Numbers out of Arrow's columns: all kinds of them, missing ones, in pieces."""

from decimal import Decimal

import numpy as np
import pyarrow as pa
import pytest

from modeler.logs.blocks import arrow_columns

COLUMNS = {
    "whole": pa.array([1, -2, 3, 4, 5], pa.int32()),
    "large": pa.array([2**62, 1, 2, 3, 4], pa.int64()),
    "single": pa.array([0.1, 0.2, float("nan"), 0.4, 0.5], pa.float32()),
    "double": pa.array([0.1, float("inf"), 0.3, 0.4, -0.0], pa.float64()),
    "decimal": pa.array([Decimal("1.25"), Decimal("2.50"), None, Decimal("4.00"), None]),
    "missing": pa.array([0.1, None, 0.3, None, 0.5], pa.float64()),
    "none": pa.nulls(5, pa.float64()),
}


def numbers(column: pa.ChunkedArray) -> np.ndarray:
    ((_, found),) = arrow_columns(pa.table({"x": column})).columns
    return found.numbers()


@pytest.mark.parametrize("name", COLUMNS)
def test_numbers_are_those_of_the_column(name: str) -> None:
    column = COLUMNS[name]
    told = [float("nan") if value is None else float(value) for value in column.to_pylist()]
    for pieces in ([column], [column[:2], column[2:3], column[3:]], [column[:0], column]):
        found = numbers(pa.chunked_array(pieces))
        assert found.dtype == float and found.flags.writeable and found.flags.c_contiguous
        np.testing.assert_array_equal(found, told)


def test_a_column_without_rows_has_no_numbers() -> None:
    assert numbers(pa.chunked_array([], pa.float64())).shape == (0,)
