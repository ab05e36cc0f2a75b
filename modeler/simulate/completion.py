"""A possible rigid body with some of its ten parameters stated, near a reference body.

Ten parameters are those of a distribution of mass if and only if the 4 x 4 pseudo-inertia is
positive semi-definite (Wensing, Kim and Slotine 2018, IEEE RA-L 3(1)). The stated ones fix linear
combinations of its elements, so that completing them is a small convex problem: it has an answer,
or a multiplier that proves that it has none (Boyd and Vandenberghe 2004, sections 5.9 and 11.4).
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeler.robot import INERTIAL
from modeler.simulate.body import is_physical, pseudo_inertia, standard_from_pseudo_inertia

_SUMS = {"XX": (1, 2), "YY": (0, 2), "ZZ": (0, 1)}  # XX = int y2 dm + int z2 dm, ...
_OUTSIDE = {"XY": (0, 1), "XZ": (0, 2), "YZ": (1, 2), "MX": (0, 3), "MY": (1, 3), "MZ": (2, 3)}
_ROUNDING = 1e-13  # relative; differences of stated numbers below it are 0
_STRICT = 1e-7  # least eigenvalue, of a matrix near ones on its diagonal, of a body with an inside
_EDGE = 5e-10  # below 0 by so little is the rounding of a plate, a rod or a point


@dataclass(frozen=True)
class Completion:
    """Outcome of a search for a body.

    Attributes:
        values: all ten parameters by prefix, the stated ones as stated; None if none were found.
        impossible: True if it is proved that no body has the stated values.
    """

    values: dict[str, float] | None
    impossible: bool = False


@dataclass(frozen=True)
class _Problem:
    """S(x) = origin + sum x_k directions[k], the scaled pseudo-inertia without its zero rows."""

    origin: np.ndarray  # (m, m)
    directions: np.ndarray  # (k, m, m), orthonormal as vectors
    scale: np.ndarray  # (4,) S_ij = P_ij / (scale_i scale_j)
    rows: np.ndarray  # (m,) those of the pseudo-inertia that are not zero


def completed(stated: Mapping[str, float], reference: Mapping[str, float]) -> Completion:
    """The stated parameters, and for the others those of the nearest possible body.

    Nearest: least log-determinant divergence tr(P R^-1) - log det(P R^-1) from the reference R,
    brought to the stated mass; a body with an inside is preferred to plates, rods and points.

    Args:
        stated: some of the ten, by prefix.
        reference: all ten, of a body with an inside.
    """
    if not stated:
        return Completion(dict(reference))
    if len(stated) == len(INERTIAL):
        return Completion(dict(stated)) if is_physical(stated) else Completion(None, True)
    near = pseudo_inertia(reference) * (
        stated["M"] / reference["M"] if stated.get("M", 0.0) > 0 else 1.0
    )
    problem = _problem(stated, near)
    if problem is None:
        return Completion(None, impossible=True)
    if not problem.rows.size:
        return Completion(dict.fromkeys(INERTIAL, 0.0) | dict(stated))
    try:
        x, impossible = _feasible(problem)
        if impossible:
            return Completion(None, impossible=True)
        if x.size and _least(_matrix(problem, x)) > 1e-9:
            x = _nearest(problem, x, near)
    except np.linalg.LinAlgError:  # numbers too far apart for floating point
        return Completion(None)
    scale = problem.scale[problem.rows]
    found = np.zeros((4, 4))
    found[np.ix_(problem.rows, problem.rows)] = _matrix(problem, x) * np.outer(scale, scale)
    values = {**standard_from_pseudo_inertia(found), **stated}
    return Completion(values if is_physical(values) else None)


def _problem(stated: Mapping[str, float], near: np.ndarray) -> _Problem | None:
    """The stated values as constraints; None if two of them exclude each other."""
    known = _known_diagonal(stated)
    if _contradicted(stated, known):
        return None
    rows = np.array([i for i in range(4) if known.get(i) != 0.0], dtype=int)
    scale = _scale(stated, known, near)
    pairs = [(i, j) for a, i in enumerate(rows) for j in rows[a:]]
    basis = np.zeros((len(pairs), 4, 4))
    for element, (i, j) in zip(basis, pairs, strict=True):
        element[i, j] = element[j, i] = 1.0 if i == j else np.sqrt(0.5)
    parameters = [standard_from_pseudo_inertia(e * np.outer(scale, scale)) for e in basis]
    equations, targets = [], []
    for prefix, value in stated.items():
        row = np.array([p[prefix] for p in parameters])
        size = float(np.linalg.norm(row))
        if size == 0.0:
            if abs(value) > _ROUNDING * max(map(abs, stated.values())):
                return None
            continue
        equations.append(row / size)
        targets.append(value / size)
    matrix = np.array(equations).reshape(-1, len(pairs))
    point = np.linalg.lstsq(matrix, np.array(targets), rcond=None)[0]
    _, singular, right = np.linalg.svd(matrix, full_matrices=True)
    free = right[int(np.sum(singular > 1e-12)) :]
    small = basis[:, rows][:, :, rows]
    return _Problem(
        np.tensordot(point, small, 1), np.tensordot(free, small, 1), scale=scale, rows=rows
    )


def _known_diagonal(stated: Mapping[str, float]) -> dict[int, float]:
    """Diagonal elements of the pseudo-inertia that the stated values fix; exactly 0 if so."""
    known = {3: float(stated["M"])} if "M" in stated else {}
    sums = {pair: stated[p] for p, pair in _SUMS.items() if p in stated}
    size = max(map(abs, sums.values()), default=0.0)
    if len(sums) == 3:
        half = sum(sums.values()) / 2
        known |= {i: half - stated[p] for i, p in enumerate(_SUMS)}
    for (i, j), value in sums.items():
        if value == 0.0:  # both are 0, as none is negative
            known |= {i: 0.0, j: 0.0}
    for _ in range(2):
        for (i, j), value in sums.items():
            for one, other in ((i, j), (j, i)):
                if one in known and other not in known:
                    known[other] = value - known[one]
    return {i: 0.0 if i < 3 and abs(v) <= _ROUNDING * size else v for i, v in known.items()}


def _contradicted(stated: Mapping[str, float], known: Mapping[int, float]) -> bool:
    """True if a diagonal element is negative, or P_ii P_jj >= P_ij^2 cannot hold for a stated one.

    Says at once what is wrong by far; the multiplier of the search proves the rest.
    """
    most = {i: np.inf for i in range(4)}
    for prefix, pair in _SUMS.items():
        most |= {i: min(most[i], stated[prefix]) for i in pair if prefix in stated}
    most |= known
    if min(most.values()) < 0:
        return True
    for prefix, (i, j) in _OUTSIDE.items():
        product = most[i] * most[j] if most[i] and most[j] else 0.0
        for total in (stated[p] for p, pair in _SUMS.items() if pair == (i, j) and p in stated):
            product = min(product, total**2 / 4)  # the largest a b of a + b
        if stated.get(prefix, 0.0) ** 2 > product * (1 + 1e-9):
            return True
    return False


def _scale(stated: Mapping[str, float], known: Mapping[int, float], near: np.ndarray) -> np.ndarray:
    """(4,) roots of what the diagonal elements are about, so that S is of order 1."""
    size, loose = np.diag(near).copy(), []
    for i in range(4):
        sums = [abs(stated[p]) for p, pair in _SUMS.items() if p in stated and i in pair]
        bound = abs(known.get(i, 0.0)) or min(sums, default=0.0)
        size[i] = bound or size[i]
        loose += [] if bound else [i]
    for _ in range(3):  # P_ii P_jj > P_ij^2
        for prefix, (i, j) in _OUTSIDE.items():
            for one, other in ((i, j), (j, i)):
                if one in loose:
                    size[one] = max(size[one], 2 * stated.get(prefix, 0.0) ** 2 / size[other])
    return np.sqrt(size)


def _feasible(problem: _Problem) -> tuple[np.ndarray, bool]:
    """An x with S(x) > 0, or >= 0 up to rounding; and True if it is proved that there is none.

    Least s with S(x) + s 1 > 0, along the path of minimisers of t s + tr - log det for rising t;
    the trace keeps free elements from running away.
    """
    m = len(problem.rows)
    unit = np.trace(problem.directions, axis1=1, axis2=2)
    if np.allclose(np.tensordot(unit, problem.directions, 1), np.eye(m), rtol=0, atol=1e-12):
        return unit * (1.0 - _least(problem.origin)), False  # no diagonal element is fixed
    moves = np.concatenate([problem.directions, np.eye(m)[None]])
    z = np.zeros(len(moves))
    z[-1] = 1.0 - _least(problem.origin)
    for power in range(13):
        linear = np.trace(moves, axis1=1, axis2=2)
        linear[-1] += 10.0**power
        for _ in range(60):
            step = _newton_step(problem.origin, moves, linear, z)
            z = z + step
            if _least(_matrix(problem, z[:-1])) > _STRICT:
                return z[:-1], False
            if np.linalg.norm(step) <= 1e-10 * (1 + np.linalg.norm(z)):
                break
        if _least(_matrix(problem, z[:-1])) < -_EDGE and _proved(problem, moves, z):
            return z[:-1], True
    return z[:-1], False


def _proved(problem: _Problem, moves: np.ndarray, z: np.ndarray) -> bool:
    """True if a Z >= 0 has <Z, directions> = 0 and <Z, origin> < 0, so that no S(x) is >= 0."""
    multiplier = np.linalg.inv(problem.origin + np.tensordot(z, moves, 1))
    multiplier = (multiplier + multiplier.T) / 2
    multiplier /= np.trace(multiplier)
    along = np.tensordot(problem.directions, multiplier, 2)
    multiplier = multiplier - np.tensordot(along, problem.directions, 1)
    return _least(multiplier) > -1e-13 and float(np.sum(multiplier * problem.origin)) < -_EDGE


def _nearest(problem: _Problem, x: np.ndarray, near: np.ndarray) -> np.ndarray:
    """From an x with S(x) > 0 to that of least divergence from the reference."""
    scale = problem.scale
    reference = (near / np.outer(scale, scale))[np.ix_(problem.rows, problem.rows)]
    linear = np.tensordot(problem.directions, np.linalg.inv(reference), 2)
    for _ in range(200):
        step = _newton_step(problem.origin, problem.directions, linear, x)
        x = x + step
        if np.linalg.norm(step) <= 1e-10 * (1 + np.linalg.norm(x)):
            break
    return x


def _newton_step(
    origin: np.ndarray, moves: np.ndarray, linear: np.ndarray, z: np.ndarray
) -> np.ndarray:
    """Damped step of least linear.z - log det(origin + sum z_k moves_k), > 0 at both ends."""
    inverse = np.linalg.inv(np.linalg.cholesky(origin + np.tensordot(z, moves, 1)))
    turned = inverse @ moves @ inverse.T
    flat = turned.reshape(len(moves), -1)
    slope = linear - np.trace(turned, axis1=1, axis2=2)
    step = -np.linalg.lstsq(flat @ flat.T, slope, rcond=1e-15)[0]
    decrement = float(np.sqrt(max(-slope @ step, 0.0)))
    step = step / (1 + decrement)  # stays inside: the function is self-concordant
    while not _inside(origin + np.tensordot(z + step, moves, 1)):
        step = step / 2
    return step


def _inside(matrix: np.ndarray) -> bool:
    try:
        np.linalg.cholesky(matrix)
    except np.linalg.LinAlgError:
        return False
    return True


def _matrix(problem: _Problem, x: np.ndarray) -> np.ndarray:
    return np.asarray(problem.origin + np.tensordot(x, problem.directions, 1))


def _least(matrix: np.ndarray) -> float:
    return float(np.linalg.eigvalsh(matrix)[0])
