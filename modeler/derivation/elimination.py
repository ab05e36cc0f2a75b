"""Row reduction over an exact field, on small or sparse matrices.

sympy's `DomainMatrix.rref` gives the same rows, but cannot stop where the coefficients fill pages:
six joints with general twists are given up after 1.4 s here, and take 9 s there; for the Panda it
takes 39 ms in the place of 2.
"""

from collections.abc import Mapping, Sequence

from sympy.polys.fields import FracElement

from modeler.derivation.field import Element, minus, times
from modeler.derivation.transfer import Matrix

LARGEST = 400
"""Terms of a coefficient, numerator and denominator together, beyond which nobody reads it."""


class TooLarge(ArithmeticError):
    """The exact coefficients grow beyond `LARGEST` terms."""


def row_reduce(rows: Matrix) -> tuple[Matrix, list[int]]:
    """Reduced row echelon form without zero rows, and the pivot columns."""
    sparse = [{j: x for j, x in enumerate(line) if x} for line in rows]
    width = len(rows[0]) if rows else 0
    reduced, pivots = sparse_row_reduce(sparse, range(width))
    if not rows:
        return [], []
    zero = rows[0][0] - rows[0][0]
    return [[line.get(j, zero) for j in range(width)] for line in reduced], pivots


def sparse_row_reduce(
    rows: Sequence[Mapping[int, Element]], order: Sequence[int]
) -> tuple[list[dict[int, Element]], list[int]]:
    """Reduced row echelon form of sparse rows, pivots searched in the given order of columns.

    Returns:
        Rows with pivot 1, and their pivot columns, in order.
    """
    left = [dict(row) for row in rows if row]
    done: list[dict[int, Element]] = []
    pivots: list[int] = []
    for column in order:
        having = [row for row in left if column in row]
        if not having:
            continue
        # The shortest row keeps the fill, and so the size of the coefficients, small.
        pivot = min(having, key=len)
        left = [row for row in left if row is not pivot]
        if pivot[column] != 1:
            inverse = 1 / pivot[column]
            pivot = {j: times(x, inverse) for j, x in pivot.items()}
        for row in (*left, *done):
            if column in row:
                _subtract(row, pivot, row[column])
        left = [row for row in left if row]
        done.append(pivot)
        pivots.append(column)
    return done, pivots


def _subtract(row: dict[int, Element], pivot: Mapping[int, Element], factor: Element) -> None:
    for j, x in pivot.items():
        part = times(factor, x)
        value = minus(row[j], part) if j in row else -part
        if _terms(value) > LARGEST:
            raise TooLarge(f"a coefficient has more than {LARGEST} terms")
        if value:
            row[j] = value
        else:
            row.pop(j, None)


def null_space(rows: Matrix, width: int, zero: Element, one: Element) -> Matrix:
    """Basis of {c : rows c = 0}, as rows of length `width`."""
    reduced, pivots = row_reduce(rows)
    basis = []
    for free in range(width):
        if free in pivots:
            continue
        vector = [zero] * width
        vector[free] = one
        for line, pivot in zip(reduced, pivots, strict=True):
            vector[pivot] = -line[free]
        basis.append(vector)
    return basis


def _terms(value: Element) -> int:
    return len(value.numer) + len(value.denom) if isinstance(value, FracElement) else 1
