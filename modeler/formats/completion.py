"""Standard parameters of a machine that could be built, from base parameters.

Torques determine beta = K chi alone, N(beta, C). Of chi the rest is known beforehand, chi ~
N(chi_0, S);
what was known of beta by it does not count again: the distribution of chi is conditioned on K chi
= beta, and beta is then what the fit says (Jeffrey's rule),

    chi = chi_0 + G (beta - K chi_0),   G = S K^T (K S K^T)^-1,
    covariance (1 - G K) S (1 - G K)^T + G C G^T,

so that K chi = beta exactly, K G being 1. Where a body of these is none (pseudo-inertia P_j, less
what hangs on it and keeps its numbers, not positive definite; negative friction), the nearest that
could be built takes its place,

    minimise ||z||^2,  chi = that + L z,  L L^T its covariance,  P_j - P_hung,j >= 0,

a semidefinite problem (Sousa and Cortesao 2014, IJRR 33(6); Wensing, Kim and Slotine 2018, IEEE
RA-L 3(1)).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeler.estimation import PhysicalParameters, compute_pseudo_inertia
from modeler.formats.thresholds import THRESHOLDS
from modeler.numerics.least_squares import minimize_over_cones


@dataclass(frozen=True, eq=False)
class Prior:
    """What is known of chi without torques.

    Attributes:
        mean: (m,) chi_0.
        S: (m, m).
    """

    mean: np.ndarray
    S: np.ndarray


@dataclass(frozen=True, eq=False)
class CompletedParameters:
    """Standard parameters, completed from beta by what is known beforehand.

    Attributes:
        chi: (m,).
        root: (m, r) of their covariance root root^T.
        moved: by how many standard deviations of the fit beta moved so that it can be built.
        far: ||z||, by how many in all chi moved.
    """

    chi: np.ndarray
    root: np.ndarray
    shift_in_sigmas: float = 0.0
    total_shift: float = 0.0

    @cached_property
    def covariance(self) -> np.ndarray:
        """Returns the covariance (m, m) of the standard parameters."""
        return np.asarray(self.root @ self.root.T)


def compute_completion(
    K: np.ndarray, before: Prior, beta: np.ndarray, C: np.ndarray
) -> CompletedParameters:
    """Returns Gaussian completion; K chi = beta wherever what is known beforehand lets chi move."""
    mean, S = before.mean, before.S
    G = S @ K.T @ _invert_covariance(K @ S @ K.T)
    for _ in range(2):  # K G = 1 to the last digits (Newton)
        G = 2.0 * G - G @ (K @ G)
    chi = mean + G @ (beta - K @ mean)
    chi += G @ (beta - K @ chi)  # the rounding of the first step
    rest = np.eye(len(mean)) - G @ K
    # No difference of covariances: what beta determines is not lost in what was known of it.
    return CompletedParameters(chi, np.hstack([rest @ _compute_root(S), G @ _compute_root(C)]))


def find_nearest_physical(
    machine: PhysicalParameters,
    completion: CompletedParameters,
    beta: np.ndarray,
    C: np.ndarray,
    size: Mapping[str, np.ndarray],
    attached_inertia: Mapping[str, np.ndarray],
) -> CompletedParameters | None:
    """Returns the nearest that could be built: itself where it can; None if nothing near can.

    Args:
        machine: unknowns and bounds.
        completion: completion.
        beta: (c,) of the fit.
        C: (c, c) its covariance.
        size: by link, (4, 4) W of a round body P of its size, W P W^T = 1.
        attached_inertia: by link, (10,) what hangs on it and keeps its numbers.
    """
    floors = {link: attached_inertia.get(link, np.zeros(10)) for link in machine.links}
    if not find_violations(machine, completion.chi, size, floors):
        return completion
    L = completion.root[:, np.abs(completion.root).any(axis=0)]
    places = list(machine.positive.values())
    if not L.size or np.any(~L[places].any(axis=1) & (completion.chi[places] < 0.0)):
        return None
    scale = np.maximum(np.abs(completion.chi[places]), np.linalg.norm(L[places], axis=1))
    scale = np.where(scale > 0.0, scale, 1.0)
    matrices = []
    for link, indices in machine.links.items():
        W = size[link]
        now = W @ compute_pseudo_inertia(completion.chi[indices] - floors[link]) @ W.T
        moves = np.einsum("ai,ijk,bj->kab", W, compute_pseudo_inertia(L[indices]), W)
        matrices.append((now - THRESHOLDS.min_solver_eigenvalue * np.eye(4), moves))
    unit = np.eye(L.shape[1])
    bounds = L[places] / scale[:, None], completion.chi[places] / scale
    z = minimize_over_cones((unit, np.zeros(len(unit))), bounds, matrices)
    if z is None:
        return None
    chi = completion.chi + L @ z
    chi[places] = np.maximum(chi[places], 0.0)
    if find_violations(machine, chi, size, floors):
        return None
    moved = compute_distance(machine.K @ chi - beta, C)
    return CompletedParameters(chi, completion.root, moved, float(np.linalg.norm(z)))


def find_violations(
    machine: PhysicalParameters,
    chi: np.ndarray,
    size: Mapping[str, np.ndarray],
    floors: Mapping[str, np.ndarray],
) -> list[str]:
    """Returns links that could not be built, and parameters that are negative and must not."""
    least = {
        link: compute_smallest_eigenvalue(chi[indices] - floors[link], size[link])
        for link, indices in machine.links.items()
    }
    invalid_links = [link for link, x in least.items() if x < THRESHOLDS.min_body_eigenvalue]
    return invalid_links + [name for name, place in machine.positive.items() if chi[place] < 0.0]


def compute_smallest_eigenvalue(ten: np.ndarray, size: np.ndarray) -> float:
    """Returns least eigenvalue of the scaled pseudo-inertia."""
    return float(np.linalg.eigvalsh(size @ compute_pseudo_inertia(ten) @ size.T)[0])


def compute_distance(apart: np.ndarray, C: np.ndarray) -> float:
    """Returns sqrt(d^T C^-1 d): standard deviations; of what has none nothing is counted."""
    return float(max(apart @ _invert_covariance(C) @ apart, 0.0)) ** 0.5


def _invert_covariance(V: np.ndarray) -> np.ndarray:
    """Pseudo-inverse of a covariance, its rows scaled alike."""
    safe, values, vectors = _decompose_covariance(V)
    half = vectors / (safe[:, None] * np.sqrt(values))
    return np.asarray(half @ half.T)


def _compute_root(V: np.ndarray) -> np.ndarray:
    """(m, r) root of a covariance, V = root root^T."""
    safe, values, vectors = _decompose_covariance(V)
    return np.asarray(safe[:, None] * vectors * np.sqrt(values))


def _decompose_covariance(V: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Deviations, and eigenvalues with vectors of the correlation, those of rounding left out."""
    size = np.sqrt(np.maximum(np.diag(V), 0.0))
    safe = np.where(size > 0.0, size, 1.0)
    values, vectors = np.linalg.eigh(V / np.outer(safe, safe))
    most = max(1.0, float(values.max(initial=0.0)))
    is_significant = values > THRESHOLDS.min_relative_eigenvalue * most
    return safe, values[is_significant], vectors[:, is_significant]
