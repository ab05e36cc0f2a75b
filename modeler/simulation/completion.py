"""A possible rigid body with some of its ten parameters stated, near a reference body.

Ten parameters are those of a distribution of mass if and only if the 4 x 4 pseudo-inertia is
positive semi-definite (Wensing, Kim and Slotine 2018, IEEE RA-L 3(1)). The stated ones fix linear
combinations of its elements, so that completing them is a small convex problem: it has an answer,
or its best is no body (Boyd and Vandenberghe 2004, sections 4.6 and 11.4). cvxpy with Clarabel.
"""

import warnings
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeler.robot import INERTIAL
from modeler.simulation.rigid import compute_pseudo_inertia, convert_pseudo_inertia, is_physical

_SUMS = {"XX": (1, 2), "YY": (0, 2), "ZZ": (0, 1)}  # XX = int y2 dm + int z2 dm, ...
_OUTSIDE = {"XY": (0, 1), "XZ": (0, 2), "YZ": (1, 2), "MX": (0, 3), "MY": (1, 3), "MZ": (2, 3)}
_ROUNDING = 1e-13  # relative; differences of stated numbers below it are 0
_STRICT = 1e-7  # least eigenvalue, of a matrix near ones on its diagonal, of a body with an inside
_EDGE = 1e-8  # below 0 by so little is the rounding of a plate, a rod or a point
_EXACT = 1e-10  # below 0 by less is no matter
_THIN = 1e-5  # eigenvalues below it are those of a plate, a rod or a point
_STEPS = 5  # of Newton, each of which doubles the digits
_DAMPED = 500  # steps before those at most
_PULL = 1e-3  # weight of the trace beside the least eigenvalue
_TOLERANCES = {f"tol_{what}": 1e-11 for what in ("gap_abs", "gap_rel", "feas")}


@dataclass(frozen=True)
class Completion:
    """Outcome of a search for a body.

    Attributes:
        values: all ten parameters by prefix, the stated ones as stated; None if none were found.
        impossible: True if it is proved that no body has the stated values.
    """

    values: dict[str, float] | None
    is_impossible: bool = False


@dataclass(frozen=True)
class _BodyProblem:
    """S(x) = origin + sum x_k directions[k], the scaled pseudo-inertia without its zero rows."""

    origin: np.ndarray  # (m, m)
    directions: np.ndarray  # (k, m, m), orthonormal as vectors
    scale: np.ndarray  # (4,) S_ij = P_ij / (scale_i scale_j)
    rows: np.ndarray  # (m,) those of the pseudo-inertia that are not zero


def complete_body(stated: Mapping[str, float], reference: Mapping[str, float]) -> Completion:
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
    near = compute_pseudo_inertia(reference) * (
        stated["M"] / reference["M"] if stated.get("M", 0.0) > 0 else 1.0
    )
    problem = _build_problem(stated, near)
    if problem is None:
        return Completion(None, is_impossible=True)
    if not problem.rows.size:
        return Completion(dict.fromkeys(INERTIAL, 0.0) | dict(stated))
    x = _find_feasible(problem)
    if x is None:
        return Completion(None)
    if x.size and _compute_smallest_eigenvalue(_build_matrix(problem, x)) > _STRICT:
        x = _find_nearest(problem, near, x)
    elif x.size:
        x = _flatten_solution(problem, x)
    if _compute_smallest_eigenvalue(_build_matrix(problem, x)) < -_EDGE:
        return Completion(None, is_impossible=True)
    scale = problem.scale[problem.rows]
    completed_matrix = np.zeros((4, 4))
    completed_matrix[np.ix_(problem.rows, problem.rows)] = _build_matrix(problem, x) * np.outer(
        scale, scale
    )
    values = {**convert_pseudo_inertia(completed_matrix), **stated}
    return Completion(values if is_physical(values, _EDGE) else None)


def _build_problem(stated: Mapping[str, float], near: np.ndarray) -> _BodyProblem | None:
    """The stated values as constraints; None if two of them exclude each other."""
    known = _compute_known_diagonal(stated)
    if _is_contradictory(stated, known):
        return None
    rows = np.array([i for i in range(4) if known.get(i) != 0.0], dtype=int)
    scale = _compute_scale(stated, known, near)
    pairs = [(i, j) for a, i in enumerate(rows) for j in rows[a:]]
    basis = np.zeros((len(pairs), 4, 4))
    for element, (i, j) in zip(basis, pairs, strict=True):
        element[i, j] = element[j, i] = 1.0 if i == j else np.sqrt(0.5)
    parameters = [convert_pseudo_inertia(e * np.outer(scale, scale)) for e in basis]
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
    return _BodyProblem(
        np.tensordot(point, small, 1), np.tensordot(free, small, 1), scale=scale, rows=rows
    )


def _compute_known_diagonal(stated: Mapping[str, float]) -> dict[int, float]:
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


def _is_contradictory(stated: Mapping[str, float], known: Mapping[int, float]) -> bool:
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


def _compute_scale(
    stated: Mapping[str, float], known: Mapping[int, float], near: np.ndarray
) -> np.ndarray:
    """(4,) roots of what the diagonal elements are about, so that S is of order 1."""
    size, unbounded = np.diag(near).copy(), []
    for i in range(4):
        sums = [abs(stated[p]) for p, pair in _SUMS.items() if p in stated and i in pair]
        bound = abs(known.get(i, 0.0)) or min(sums, default=0.0)
        size[i] = bound or size[i]
        unbounded += [] if bound else [i]
    for _ in range(3):  # P_ii P_jj > P_ij^2
        for prefix, (i, j) in _OUTSIDE.items():
            for one, other in ((i, j), (j, i)):
                if one in unbounded:
                    size[one] = max(size[one], 2 * stated.get(prefix, 0.0) ** 2 / size[other])
    return np.sqrt(size)


def _find_feasible(problem: _BodyProblem) -> np.ndarray | None:
    """The x of the largest t up to 1 with S(x) - t 1 >= 0; None if the solver finds none.

    Least S(x) below 0 then means that none is above.
    """
    import cvxpy as cp  # only here: most robots state all of a link, or nothing

    if not len(problem.directions):
        return np.zeros(0)
    x, t = cp.Variable(len(problem.directions)), cp.Variable()
    S = problem.origin + sum(x[k] * E for k, E in enumerate(problem.directions))
    # The trace keeps free elements from running away.
    goal = cp.Maximize(t - _PULL * cp.trace(S))
    semidefinite_problem = cp.Problem(goal, [S - t * np.eye(len(problem.rows)) >> 0, t <= 1.0])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # the caller looks at the answer itself
        try:
            semidefinite_problem.solve(solver=cp.CLARABEL, **_TOLERANCES)
        except cp.SolverError:
            return None
    return None if x.value is None else np.asarray(x.value)


def _flatten_solution(problem: _BodyProblem, x: np.ndarray) -> np.ndarray:
    """The same plate, rod or point with exact zeros: S(x) times what it nearly vanishes on."""
    for _ in range(_STEPS):
        values, vectors = np.linalg.eigh(_build_matrix(problem, x))
        thin = vectors[:, values < _THIN]
        slope = (problem.directions @ thin).reshape(len(x), -1).T
        rest = (_build_matrix(problem, x) @ thin).ravel()
        flat = x - np.linalg.lstsq(slope, rest, rcond=1e-9)[0]
        x = max(
            (x, flat),
            key=lambda choice: _compute_smallest_eigenvalue(_build_matrix(problem, choice)),
        )
        if _compute_smallest_eigenvalue(_build_matrix(problem, x)) > -_EXACT:
            break
    return x


def _find_nearest(problem: _BodyProblem, near: np.ndarray, x: np.ndarray) -> np.ndarray:
    """The x with S(x) > 0 of least divergence from the reference, to all digits.

    Damped Newton: tr(W S) - log det S is self-concordant, so that it gets there from any x inside
    (Boyd and Vandenberghe 2004, section 9.6).
    """
    reference = (near / np.outer(problem.scale, problem.scale))[np.ix_(problem.rows, problem.rows)]
    weight = np.linalg.inv(reference)
    pull = np.tensordot(problem.directions, weight, 2)
    left = _STEPS
    for _ in range(_DAMPED):
        turned = np.linalg.inv(_build_matrix(problem, x)) @ problem.directions
        slope = pull - np.trace(turned, axis1=1, axis2=2)
        curvature = np.einsum("kij,lji->kl", turned, turned)
        step = np.linalg.lstsq(curvature, slope, rcond=None)[0]
        decrement = np.sqrt(max(float(slope @ step), 0.0))
        at_the_end = decrement < 0.25
        step /= 1.0 if at_the_end else 1.0 + decrement
        left -= at_the_end
        if not _compute_smallest_eigenvalue(_build_matrix(problem, x - step)) > 0.0:
            break
        x = x - step
        if not left:
            break
    return x


def _build_matrix(problem: _BodyProblem, x: np.ndarray) -> np.ndarray:
    return np.asarray(problem.origin + np.tensordot(x, problem.directions, 1))


def _compute_smallest_eigenvalue(matrix: np.ndarray) -> float:
    return float(np.linalg.eigvalsh(matrix)[0])
