"""The same question in floating point: rank of the torque regressor at random states."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.symbolic import SymbolicModel
from modeler.symbolic.closed_states import closed_motion, closed_postures

TOLERANCE = 1e-9
"""Relative to the largest singular value of the scaled matrix; see `NumericRank.gap`."""

ZERO = 1e-13
"""Columns below this share of the largest one are rounding errors of a zero column: they are left
out, never scaled up."""

States = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Positions, speeds and accelerations of the free variables, each (samples, len(u))."""


@dataclass(frozen=True)
class NumericRank:
    """Rank with what it rests on.

    Attributes:
        rank: number of singular values above tolerance * largest.
        gap: (last kept, first dropped) singular value of the matrix with columns of unit length.
        tolerance: relative.
        scale: how it was scaled.
    """

    rank: int
    gap: tuple[float, float]
    tolerance: float
    scale: str


def random_states(model: SymbolicModel, samples: int, rng: np.random.Generator) -> States:
    """Positions over a turn (prismatic: +-1 m), speeds and accelerations of order 1.

    With loops: closed postures around home, and motions that the loops allow.
    """
    if model.closure is None:
        n = model.geometry.coordinates
        angular = np.array([joint.angular for joint in model.robot.free])
        q = rng.uniform(-1.0, 1.0, (samples, n)) * np.where(angular, np.pi, 1.0)
        return q, rng.normal(size=(samples, n)), rng.normal(size=(samples, n))
    u = closed_postures(model, samples, rng)
    qd, qdd = rng.normal(size=(2, samples, len(model.closure.given)))
    motion = closed_motion(model, u, qd)
    ud = np.einsum("nij,nj->ni", motion.coupling, qd)
    return u, ud, np.einsum("nij,nj->ni", motion.coupling, qdd) + motion.drift


def regressor_values(model: SymbolicModel, states: States) -> np.ndarray:
    """(samples, coordinates, columns): the standard regressor at the nominal geometry."""
    q, qd, qdd = states
    values = dict(model.geometry.values)
    inputs = {
        f"{kind}[{i}]": array[:, i]
        for kind, array in (("q", q), ("qd", qd), ("qdd", qdd))
        for i in range(q.shape[1])
    }
    generator = np.random.default_rng(len(q))
    for k in range(len(model.signals)):
        inputs[f"s[{k}]"] = generator.uniform(0.1, 1.0, len(q))
    entries = model.regressor
    phi = np.zeros((*q.shape, len(model.columns)))
    found = model.graph.evaluate(list(entries.values()), {**values, **inputs})
    for (joint, column), value in zip(entries, found, strict=True):
        phi[:, joint, column] = value
    if model.closure is None:
        return phi
    none = np.zeros((len(q), len(model.closure.given)))
    return np.einsum("nij,nic->njc", closed_motion(model, q, none).coupling, phi)


def numeric_rank(phi: np.ndarray, columns: Sequence[int]) -> NumericRank:
    """Rank of the stacked regressor (samples, joints, columns), of the columns given."""
    W = phi.reshape(-1, phi.shape[2])[:, list(columns)]
    lengths = np.linalg.norm(W, axis=0)
    W = W[:, lengths > ZERO * lengths.max(initial=0.0)]
    if W.shape[1] == 0:
        return NumericRank(0, (0.0, 0.0), TOLERANCE, "no column has an effect")
    singular = np.linalg.svd(W / np.linalg.norm(W, axis=0), compute_uv=False)
    rank = int(np.sum(singular > TOLERANCE * singular[0]))
    dropped = float(singular[rank]) if rank < len(singular) else 0.0
    return NumericRank(
        rank, (float(singular[rank - 1]), dropped), TOLERANCE,
        f"{W.shape[0]} rows, {W.shape[1]} columns (the others are 0), scaled to length 1",
    )  # fmt: skip
