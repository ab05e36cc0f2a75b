"""Closed states in floating point: postures, speeds and accelerations that the loops allow."""

from dataclasses import dataclass

import numpy as np

from modeler.derivation.closing import Closing
from modeler.derivation.model import SymbolicModel
from modeler.derivation.walks import Walk, walked


@dataclass(frozen=True)
class ClosedStates:
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
        closure.given, closure.solved, closure.lengths, closure.size, others=closure.others,
    )  # fmt: skip


def closed_walk(
    model: SymbolicModel, samples: int, rng: np.random.Generator, share: float = 0.0
) -> Walk:
    """Postures in which the loops are closed, over all that the actuated joints reach from home.

    Joints stay within their [limits]; without, actuated angles within a turn around home, actuated
    travels within the robot's size of it.

    Args:
        model: with loops.
        samples: number of postures.
        rng: of the random motion.
        share: of home's distance to a singularity that all postures keep.
    """
    closure = model.closure
    assert closure is not None
    ranges = []
    for k, (joint, at) in enumerate(zip(model.robot.free, closure.home, strict=True)):
        limits = model.robot.limits.get(joint.name)
        reach = closure.size if closure.lengths[k] else np.pi
        reach = reach if k in closure.given else np.inf
        low, high = (limits.lower, limits.upper) if limits else (at - reach, at + reach)
        ranges.append((min(low, at), max(high, at)))
    return walked(closing_of(model), np.array(closure.home), ranges, samples, rng, share)


def rounded_off(model: SymbolicModel, u: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Closed postures as another machine might have closed them: each equation wrong by rounding.

    Args:
        model: with loops.
        u: (n, len(u)) closed postures.
        rng: of the signs.
    """
    closing = closing_of(model)
    solved = list(closing.solved)
    error = float(np.finfo(float).eps) * closing.size
    wrong = rng.choice([-error, error], (len(u), len(closing.equations)))
    other = u.copy()
    inner = closing.jacobians(u)[:, :, solved]
    other[:, solved] += np.linalg.solve(inner, wrong[:, :, None])[:, :, 0]
    return other


def closed_motion(model: SymbolicModel, u: np.ndarray, qd: np.ndarray) -> ClosedStates:
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
    return ClosedStates(G, drift)
