"""Closed states in floating point: postures, speeds and accelerations that the loops allow."""

from dataclasses import dataclass

import numpy as np

from modeler.symbolic.closing import Closing, moved_postures
from modeler.symbolic.model import SymbolicModel


@dataclass(frozen=True)
class ClosedMotion:
    """How the free variables follow the coordinates, at n postures.

    Attributes:
        coupling: G of ud = G qd, (n, len(u), len(q)).
        drift: gamma of udd = G qdd + gamma, (n, len(u)).
    """

    coupling: np.ndarray
    drift: np.ndarray


def closing_of(model: SymbolicModel) -> Closing:
    """The independent closure equations of a model with loops, as functions of arrays."""
    closure = model.closure
    assert closure is not None
    return Closing(
        model.graph, model.geometry.values, closure.equations, closure.jacobian,
        closure.given, closure.solved, closure.lengths,
    )  # fmt: skip


def closed_postures(
    model: SymbolicModel, samples: int, rng: np.random.Generator, reach: float = 0.3
) -> np.ndarray:
    """(samples, len(u)) postures around home in which the loops are closed.

    Args:
        model: with loops.
        samples: number of postures.
        rng: of the random motion.
        reach: of the motion, in rad and twice the robot's size.
    """
    closure = model.closure
    assert closure is not None
    return moved_postures(closing_of(model), np.array(closure.home), rng, samples, reach)


def closed_motion(model: SymbolicModel, u: np.ndarray, qd: np.ndarray) -> ClosedMotion:
    """G and gamma at closed postures.

    Args:
        model: with loops.
        u: (n, len(u)) closed postures.
        qd: (n, len(q)) speeds of the coordinates.
    """
    closure = model.closure
    assert closure is not None
    given, solved = list(closure.given), list(closure.solved)
    J = closing_of(model).jacobians(u)
    G = np.zeros((*u.shape, len(given)))
    G[:, given, np.arange(len(given))] = 1.0
    G[:, solved] = -np.linalg.solve(J[:, :, solved], J[:, :, given])
    ud = np.einsum("nij,nj->ni", G, qd)
    inputs = {f"q[{k}]": u[:, k] for k in range(u.shape[1])}
    inputs |= {f"qd[{k}]": ud[:, k] for k in range(u.shape[1])}
    found = model.graph.evaluate(list(closure.drift), {**model.geometry.values, **inputs})
    rate = np.stack([np.broadcast_to(value, len(u)) for value in found], axis=1)
    drift = np.zeros_like(u)
    drift[:, solved] = -np.linalg.solve(J[:, :, solved], rate[:, :, None])[:, :, 0]
    return ClosedMotion(G, drift)
