"""Which sufficing set of known parameters lets errors grow least."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.formulas.physical_system import PhysicalSystem
from modeler.formulas.values import SolvedNumbers


@dataclass(frozen=True)
class Rated:
    """How errors grow with one set of known parameters.

    Attributes:
        known: the set.
        middle: median over the parameters that follow: per cent of error, root mean square, for
            independent errors of 1 % in every identified quantity and every known parameter.
        worst: the largest.
        letter: whose that is.
    """

    known: tuple[str, ...]
    middle: float
    worst: float
    letter: str


def rated(
    system: PhysicalSystem, sets: Sequence[Sequence[str]], values: Mapping[str, float]
) -> tuple[Rated, ...]:
    """The sets by how little errors grow at one robot, the least median first.

    dU = J_U^-1 (dd - J_K dK), d data, U unknowns, K known; parameters that are 0 have no per cent.

    Args:
        system: data as polynomials of the parameters.
        sets: smallest sufficing sets.
        values: of all parameters, SI units; sets that fail there are left out.
    """
    point = np.zeros(len(system.names))
    for name, value in (*system.constants.items(), *values.items()):
        if name in system.place:
            point[system.place[name]] = value
    polys = [SolvedNumbers(system.definitions[d]) for d in system.data]
    J = np.array([poly.slopes(point) for poly in polys])
    data = np.array([poly.value(point) for poly in polys])
    found = []
    for known in sets:
        U = [system.place[x] for x in system.letters if x not in known]
        K = [system.place[x] for x in known]
        inner = J[:, U]
        if inner.shape[0] != inner.shape[1] or np.linalg.matrix_rank(inner) < len(U):
            continue
        G = np.linalg.solve(inner, np.hstack([np.diag(data), -J[:, K] * point[K]]))
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.linalg.norm(G, axis=1) / np.abs(point[U])
        share[~np.isfinite(share)] = np.nan
        k = int(np.nanargmax(share))
        middle, letter = float(np.nanmedian(share)), system.names[U[k]]
        found.append(Rated(tuple(known), middle, float(share[k]), letter))
    return tuple(sorted(found, key=lambda r: (r.middle, r.worst)))
