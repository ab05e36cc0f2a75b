"""Exact grouping where joints follow others by linear relations.

Link-by-link elimination (`modeler.base.tree`) needs joints that move on their own. Here the energy
rows are sampled modulo a prime at random states: which columns depend on which others follows from
one random geometry; each coefficient, a rational function of a few letters of the geometry, is
interpolated from its values at several geometries and checked at fresh ones.
"""

from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass
from functools import partial
from typing import Protocol

import numpy as np
import sympy

from modeler.base.certificate import ModularState
from modeler.base.elimination import TooLarge
from modeler.base.field import Element, ExactField
from modeler.base.interpolation import Point, Probes, coefficient
from modeler.base.residues import LARGE, SMALL, Residues, row_echelon
from modeler.symbolic import Geometry, LinkColumn, StandardColumn

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
        TooLarge: a coefficient is no short quotient of polynomials, or has long numbers.
    """
    energetic = [i for i in order if has_energy(columns[i])]
    return dependent_columns(geometry, _Energies(columns), K, energetic, set(energetic), seed)


class Functions(Protocol):
    """Functions on the opened tree, numbered, of which relations are looked for."""

    def rows(self, state: ModularState, places: Sequence[int]) -> np.ndarray:
        """(2 points, places): what those functions add to 2T, then to the power of gravity."""
        ...


@dataclass(frozen=True)
class _Energies:
    """The energy rows of columns."""

    columns: Sequence[StandardColumn]

    def rows(self, state: ModularState, places: Sequence[int]) -> np.ndarray:
        """(2 points, places)."""
        return state.energy_rows([self.columns[i] for i in places])


def dependent_columns(
    geometry: Geometry,
    functions: Functions,
    K: ExactField,
    order: Sequence[int],
    wanted: Set[int],
    seed: int,
) -> list[dict[int, Element]]:
    """The relation of every wanted function that is a combination of those before it.

    Args:
        geometry: the table.
        functions: on its opened tree.
        K: the field of the geometry.
        order: numbers of the functions, in the order in which they are kept.
        wanted: numbers of those whose coefficients are wanted; others are left out of relations.
        seed: of the random points.

    Raises:
        TooLarge: a coefficient is no short quotient of polynomials, or has long numbers.
    """
    try:
        supports = _supports(geometry, functions, K, order, seed)
        supports = {column: kept for column, kept in supports.items() if column in wanted}
        return _interpolated(_Sampler(geometry, functions, K, supports, seed), wanted)
    except ValueError as error:  # a constant whose denominator is a multiple of a prime
        raise TooLarge(f"a constant has no value modulo a prime ({error})") from None


def _interpolated(sampler: "_Sampler", wanted: Set[int]) -> list[dict[int, Element]]:
    """The relation of each dependent function, from the kept ones that it involves."""
    relations: list[dict[int, Element]] = []
    K = sampler.K
    probes = Probes(len(K.letters), sampler.seed)
    for column, support in sampler.supports.items():
        relation = {column: K.one}
        for kept in support:
            if kept in wanted:
                relation[kept] = -coefficient(partial(sampler.values, (column, kept)), K, probes)
        relations.append(relation)
    return relations


def _supports(
    geometry: Geometry, functions: Functions, K: ExactField, order: Sequence[int], seed: int
) -> dict[int, list[int]]:
    """For each dependent function the kept ones that it is a combination of."""
    state = ModularState(geometry, K, len(order) + _SPARE, seed, SMALL)
    rows = functions.rows(state, order)
    pivots = row_echelon(rows, range(len(order)), SMALL)
    kept = {column: row for row, column in pivots}
    return {
        order[column]: [order[pivot] for pivot, row in kept.items() if rows[row, column] != 0]
        for column in range(len(order))
        if column not in kept
    }


def has_energy(column: StandardColumn) -> bool:
    """True where a column adds to the energies: no friction."""
    return isinstance(column, LinkColumn) or column.kind in ("rotor_inertia", "offset")


class _Sampler:
    """Values of all coefficients at given geometries, modulo the large prime."""

    def __init__(
        self,
        geometry: Geometry,
        functions: Functions,
        K: ExactField,
        supports: Mapping[int, Sequence[int]],
        seed: int,
    ) -> None:
        self.geometry, self.K, self.supports, self.seed = geometry, K, supports, seed
        self.functions = functions
        self.blocks = _blocks(supports)
        self.used = sorted({c for kept, dependent in self.blocks for c in (*kept, *dependent)})
        self.place = {column: i for i, column in enumerate(self.used)}
        self.points = max((len(kept) for kept, _ in self.blocks), default=0) + _POINTS
        self._known: dict[Point, dict[tuple[int, int], int]] = {}

    def values(self, at: tuple[int, int], geometries: Sequence[Point]) -> list[int]:
        """The coefficient `at` = (dependent column, kept column) at the geometries.

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
        rows = self.functions.rows(state, self.used).reshape(2, len(geometries), n, -1)
        for i, geometry in enumerate(geometries):
            self._known[geometry] = {}
            for kept, dependent in self.blocks:
                places = [self.place[column] for column in (*kept, *dependent)]
                part = rows[:, i, : len(kept) + _POINTS, places].reshape(len(places), -1).T
                self._known[geometry] |= self._solved(part.copy(), kept, dependent)

    def _solved(
        self, matrix: np.ndarray, kept: Sequence[int], dependent: Sequence[int]
    ) -> dict[tuple[int, int], int]:
        """Coefficients at one geometry, from its energy rows (rows, kept and then dependent)."""
        size = len(kept)
        pivots = row_echelon(matrix, range(size), LARGE)
        found = {}
        for column, values in zip(dependent, matrix[:, size:].T, strict=True):
            combination = {c for c, value in zip(kept, values, strict=False) if value}
            if (
                len(pivots) < size
                or np.any(values[size:])
                or combination != {*self.supports[column]}
            ):
                raise TooLarge("what depends on what at one geometry does not at another")
            for c, value in zip(kept, values, strict=False):
                found[column, c] = int(value)
        return found


def _blocks(supports: Mapping[int, Sequence[int]]) -> list[tuple[list[int], list[int]]]:
    """(kept, dependent) columns, apart where no dependent column involves kept ones of both."""
    blocks: list[tuple[list[int], list[int]]] = []
    for column, support in supports.items():
        if not support:
            continue
        kept, dependent = list(support), [column]
        for block in [block for block in blocks if set(block[0]) & set(support)]:
            blocks.remove(block)
            kept = [*block[0], *(c for c in kept if c not in block[0])]
            dependent = [*block[1], *dependent]
        blocks.append((kept, dependent))
    return blocks
