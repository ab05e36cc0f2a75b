"""Base parameters in floating point, where exact symbols cannot be had.

For robots whose constants obey a relation that the exact field does not know (an angle of pi/3
and a gravity with sqrt(3), say), or whose exact coefficients would fill pages. The coefficients
are then numbers with an error bound, never symbols that might be wrong.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import sympy

from modeler.base.numeric import ZERO, NumericRank, Sample
from modeler.base.priority import priority_order
from modeler.base.result import BaseParameter, Term
from modeler.symbolic import StandardColumn, SymbolicModel

_DIGITS = 10
_NOTHING = 1e-9
"""A factor below this is 0, a number this near to a whole one is that."""


@dataclass(frozen=True)
class NumericGrouping:
    """Base parameters, parameters without effect, and the error bound of the coefficients."""

    parameters: tuple[BaseParameter, ...]
    unidentifiable: tuple[str, ...]
    bound: float


def numeric_grouping(model: SymbolicModel, sample: Sample, numeric: NumericRank) -> NumericGrouping:
    """First-come independent columns of the torque regressor at random states, nominal geometry.

    A column is dependent if the columns before it leave less of it than lies in the middle of the
    gap of the singular values: what is left of an independent one is no less than the last kept
    value, of a dependent one it is rounding.

    Args:
        model: of the robot.
        sample: its regressor.
        numeric: the rank of that.

    Raises:
        DerivationError: a priority pattern matches nothing.
    """
    W = sample.matrix
    last, first = numeric.gap
    tolerance = math.sqrt(last * max(first, float(np.finfo(float).eps)))
    lengths = np.linalg.norm(W, axis=0)
    absent = {i for i, length in enumerate(lengths) if length <= ZERO * lengths.max(initial=0.0)}
    order = [i for i in priority_order(model.names, model.robot.kept_first) if i not in absent]
    kept, relations, bound = _first_come(W, lengths, order, tolerance)
    terms = {b: [Term(sympy.Integer(1), model.names[b])] for b in sorted(kept)}
    for column in sorted(relations):
        for b, factor in relations[column].items():
            terms[b].append(Term(factor, model.names[column]))
    return NumericGrouping(
        tuple(_parameter(model.columns, b, found) for b, found in terms.items()),
        tuple(model.names[i] for i in sorted(absent)),
        bound,
    )


def _parameter(columns: Sequence[StandardColumn], b: int, terms: list[Term]) -> BaseParameter:
    return BaseParameter(columns[b].name + ("R" if len(terms) > 1 else ""), b, tuple(terms))


def _first_come(
    W: np.ndarray, lengths: np.ndarray, order: Sequence[int], tolerance: float
) -> tuple[list[int], dict[int, dict[int, sympy.Expr]], float]:
    """Columns kept, {dropped column: {kept column: factor}}, and the error of the factors."""
    kept: list[int] = []
    Q = np.zeros((W.shape[0], 0))
    relations: dict[int, dict[int, sympy.Expr]] = {}
    worst = 0.0
    for column in order:
        unit = W[:, column] / lengths[column]
        rest = unit - Q @ (Q.T @ unit)
        rest -= Q @ (Q.T @ rest)  # twice is enough (Kahan, Parlett)
        if np.linalg.norm(rest) > tolerance:
            Q = np.column_stack([Q, rest / np.linalg.norm(rest)])
            kept.append(column)
            continue
        factors, *_ = np.linalg.lstsq(W[:, kept] / lengths[kept], unit, rcond=None)
        left = unit - (W[:, kept] / lengths[kept]) @ factors
        worst = max(worst, float(np.linalg.norm(left)))
        scaled = factors * lengths[column] / lengths[kept]
        relations[column] = {
            b: _number(float(s))
            for b, s, f in zip(kept, scaled, factors, strict=True)
            if abs(f) > _NOTHING
        }
    return kept, relations, worst


def _number(value: float) -> sympy.Expr:
    if abs(value - round(value)) < _NOTHING and round(value):
        return sympy.Integer(round(value))
    # Its decimals are its value: what is printed is what is computed with.
    return sympy.Float(float(f"{value:.{_DIGITS}g}"))
