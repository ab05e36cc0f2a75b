"""Exact grouping where joints follow others by linear relations.

Link-by-link elimination (`modeler.base.tree`) needs joints that move on their own. Here the energy
rows are sampled modulo a prime at random states: which columns depend on which others follows from
one random geometry; each coefficient, a rational function of a few letters of the geometry, is
interpolated from its values at several geometries and checked at fresh ones.
"""

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
import sympy

from modeler.base.certificate import ModularState
from modeler.base.elimination import TooLarge
from modeler.base.field import Element, ExactField
from modeler.base.interpolation import Point, Probes, coefficient
from modeler.base.residues import LARGE, SMALL, Residues, row_echelon
from modeler.symbolic import Geometry, StandardColumn

_SPARE = 6
_POINTS = 3


def tied_relations(
    geometry: Geometry,
    columns: Sequence[StandardColumn],
    K: ExactField,
    order: Sequence[int],
    seed: int,
) -> list[dict[int, Element]]:
    """All relations among the energy rows of the columns, loops left open.

    Args:
        geometry: the table, with relations.
        columns: inertial, rotor inertia and offset columns; others are not looked at.
        K: the field of the geometry.
        order: columns in the order in which they are kept.
        seed: of the random points.

    Returns:
        A basis: sum of coefficient * column = 0, the coefficient of one column of each being 1.

    Raises:
        TooLarge: a coefficient is no simple function of few letters.
    """
    supports = _supports(geometry, columns, K, order, seed)
    relations: list[dict[int, Element]] = [
        {column: K.one} for column, support in supports.items() if not support
    ]
    dependent = {column: support for column, support in supports.items() if support}
    if not dependent:
        return relations
    sampler = _Sampler(geometry, columns, K, dependent, seed)
    probes = Probes(len(K.letters), seed)
    for column, support in dependent.items():
        relation = {column: K.one}
        for place, kept in enumerate(support):
            relation[kept] = -coefficient(partial(sampler.values, (column, place)), K, probes)
        relations.append(relation)
    return relations


def _supports(
    geometry: Geometry,
    columns: Sequence[StandardColumn],
    K: ExactField,
    order: Sequence[int],
    seed: int,
) -> dict[int, list[int]]:
    """For each dependent column the kept columns that it is a combination of."""
    energetic = [i for i in order if _has_energy(columns[i])]
    state = ModularState(geometry, K, len(energetic) + _SPARE, seed, SMALL)
    rows = state.energy_rows([columns[i] for i in energetic])
    pivots = row_echelon(rows, range(len(energetic)), SMALL)
    kept = {column: row for row, column in pivots}
    return {
        energetic[column]: [
            energetic[pivot] for pivot, row in kept.items() if rows[row, column] != 0
        ]
        for column in range(len(energetic))
        if column not in kept
    }


def _has_energy(column: StandardColumn) -> bool:
    return column.column is None or column.kind in ("rotor_inertia", "offset")


class _Sampler:
    """Values of all coefficients at given geometries, modulo the large prime."""

    def __init__(
        self,
        geometry: Geometry,
        columns: Sequence[StandardColumn],
        K: ExactField,
        dependent: Mapping[int, Sequence[int]],
        seed: int,
    ) -> None:
        self.geometry, self.K, self.dependent, self.seed = geometry, K, dependent, seed
        used = sorted({c for c, support in dependent.items() for c in (c, *support)})
        self.place = {column: i for i, column in enumerate(used)}
        self.columns = [columns[i] for i in used]
        self.points = max(len(support) for support in dependent.values()) + _POINTS
        self._known: dict[Point, dict[tuple[int, int], int]] = {}

    def values(self, at: tuple[int, int], geometries: Sequence[Point]) -> list[int]:
        """The coefficient `at` = (dependent column, place in its support) at the geometries.

        Raises:
            TooLarge: there the column is not the combination that it was at one geometry.
        """
        missing = [g for g in dict.fromkeys(geometries) if g not in self._known]
        if missing:
            self._sample(missing)
        return [self._known[g][at] for g in geometries]

    def _sample(self, geometries: Sequence[Point]) -> None:
        n = self.points
        letters: dict[sympy.Expr, Residues] = {
            letter: np.array([g[i] for g in geometries for _ in range(n)], dtype=object)
            for i, letter in enumerate(self.K.letters)
        }
        total = n * len(geometries)
        self.seed += 1
        state = ModularState(self.geometry, self.K, total, self.seed, LARGE, letters)
        rows = state.energy_rows(self.columns)
        for i, geometry in enumerate(geometries):
            part = np.concatenate(
                [rows[i * n : (i + 1) * n], rows[total + i * n : total + (i + 1) * n]]
            )
            self._known[geometry] = self._solved(part)

    def _solved(self, rows: np.ndarray) -> dict[tuple[int, int], int]:
        found = {}
        for column, support in self.dependent.items():
            matrix = rows[:, [self.place[c] for c in (*support, column)]].copy()
            pivots = row_echelon(matrix, range(len(support)), LARGE)
            if len(pivots) < len(support) or np.any(matrix[len(pivots) :, -1]):
                raise TooLarge("what depends on what at one geometry does not at another")
            for place, (row, _) in enumerate(pivots):
                found[column, place] = int(matrix[row, -1])
        return found
