"""The map between independent coefficients and base parameters, as lines of text."""

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from modeler.terms.coefficients import CoefficientTable
from modeler.terms.relations import inverse_map
from modeler.terms.text import form_text, polynomial_text, signed_sum


def _static(table: CoefficientTable) -> tuple[str, ...]:
    return tuple(table.closed.algebra.names[table.closed.algebra.moving :])


def forward_lines(table: CoefficientTable) -> list[str]:
    """`PJ3 = XX2R + XX3R - ZZ3`, one line per coefficient that is independent."""
    names = table.base_names
    return [
        f"{name} = {form_text(table.by_name[name].base, names, _static(table))}"
        for name in table.map.rows
    ]


def determinant_text(table: CoefficientTable) -> str | None:
    """Determinant of the map; None if it is not square."""
    if table.map.determinant is None:
        return None
    return polynomial_text(table.map.determinant, _static(table))


def backward_lines(table: CoefficientTable) -> list[str]:
    """`ZZ1R = PJ7 - PJ16`, one line per base parameter; none if the map has no inverse."""
    inverse = inverse_map(table.map, table.closed.algebra.static_ring) or {}
    return [f"{name} = {_row_text(row, _static(table))}" for name, row in inverse.items()]


def _row_text(row: Mapping[str, Any], static: tuple[str, ...]) -> str:
    """A row of the inverse: each factor is a quotient of polynomials of the geometry."""
    terms: list[tuple[Fraction, str]] = []
    for name, factor in row.items():
        above, below = factor.numer, factor.denom
        if len(above) == 1 and below.is_ground:
            number = Fraction(int(above.LC.numerator), int(above.LC.denominator))
            number /= Fraction(int(below.LC.numerator), int(below.LC.denominator))
            letters = polynomial_text(above.monic(), static)
            terms.append((number, name if letters == "1" else f"{letters}*{name}"))
        else:
            quotient = f"({polynomial_text(above, static)})"
            if below != 1:
                quotient += f"/({polynomial_text(below, static)})"
            terms.append((Fraction(1), f"{quotient}*{name}"))
    return signed_sum(terms)
