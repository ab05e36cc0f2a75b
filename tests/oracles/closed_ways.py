"""Ways of closed postures in small steps, by the oracle's kinematics: what a branch reaches."""

import numpy as np

from tests.oracles.complex_step import Oracle

CLOSED = 1e-8  # sizes of the robot, or 1
NEWTON = 6  # corrections of a step
LONGEST = 0.3  # step of a variable, in its scale
ROUNDING = 1e-7  # of a posture, in its scale
STEPS = 60  # of a way
REGULAR = 0.03  # smallest singular value on it


def open_at(oracle: Oracle, u: np.ndarray) -> np.ndarray:
    """(n, e) what is open: lengths in sizes of the robot, directions as differences."""
    return oracle.errors(u)[0]


def scaled_slopes(oracle: Oracle, u: np.ndarray) -> np.ndarray:
    """(n, e, f) derivatives of what is open by the scaled free variables."""
    return oracle.errors(u)[1] * oracle.scale


def regularity(oracle: Oracle, u: np.ndarray) -> np.ndarray:
    """(n,) smallest singular values of the solved columns."""
    slopes = scaled_slopes(oracle, u)[:, :, oracle.solved]
    return np.linalg.svd(slopes, compute_uv=False)[:, -1]


def closed_near(oracle: Oracle, u: np.ndarray, rounds: int = 4) -> np.ndarray:
    """(n, f) closed to rounding by Newton's method, the given variables held."""
    u, solved = u.copy(), oracle.solved
    for _ in range(rounds):
        open_, slopes = oracle.errors(u)
        back = np.linalg.pinv(slopes[:, :, solved] * oracle.scale[solved])
        step = np.einsum("nij,nj->ni", back, open_)
        u[:, solved] -= np.clip(step, -LONGEST, LONGEST) * oracle.scale[solved]
    return u


def followed(oracle, home, targets, steps):
    """Straight ways of the given variables from home, and how near singularity they came.

    A way ends where Newton's method goes further than the tangent does, and where the solved
    columns change their orientation: behind a turning point or a bifurcation.

    Args:
        oracle: of the robot.
        home: (f,) or (n, f) closed postures where the ways start.
        targets: (n, given) where they lead.
        steps: of equal length.

    Returns:
        (n, f) postures, NaN where the way ended; (n,) the smallest singular value of the solved
        columns on the way.
    """
    n, inputs = len(targets), oracle.given
    start = np.broadcast_to(home, (n, len(oracle.scale)))
    u, nearest, going = start.copy(), np.full(n, np.inf), np.arange(n)
    J = scaled_slopes(oracle, u)
    for k in range(1, steps + 1):
        q = start[:, inputs] + (targets - start[:, inputs]) * (k / steps)
        v, J_after, good, singular = _step(oracle, u[going], q[going], J)
        nearest[going] = np.minimum(nearest[going], singular)
        u[going] = v
        u[going[~good]] = np.nan
        going, J = going[good], J_after[good]
        if not len(going):
            break
    return u, nearest


def _step(oracle: Oracle, u: np.ndarray, q: np.ndarray, J: np.ndarray) -> tuple:
    """One step to q: postures, all slopes there, who arrived, least singular values."""
    inputs, solved = oracle.given, oracle.solved
    v, scale = u.copy(), oracle.scale[solved]
    change = (q - u[:, inputs]) / oracle.scale[inputs]
    back = np.linalg.pinv(J[:, :, solved])
    along = -np.einsum("nij,njk,nk->ni", back, J[:, :, inputs], change)
    v[:, solved] += along * scale
    v[:, inputs] = q
    predicted = v.copy()
    inverse = np.linalg.pinv(scaled_slopes(oracle, v)[:, :, solved])
    for _ in range(NEWTON):
        v[:, solved] -= np.einsum("nij,nj->ni", inverse, open_at(oracle, v)) * scale
    open_, after = oracle.errors(v)
    after = after * oracle.scale
    turned = np.linalg.det(back @ after[:, :, solved])
    bent = np.max(np.abs(v - predicted) / oracle.scale, axis=1)
    length = np.max(np.abs(predicted - u) / oracle.scale, axis=1)
    good = (np.max(np.abs(open_), axis=1) < CLOSED) & (turned > 0.0)
    good &= (bent < 0.5 * length + ROUNDING) & (length < LONGEST)
    singular = np.linalg.svd(after[:, :, solved], compute_uv=False)[:, -1]
    return v, after, good, singular


def reached(oracle, home, count, seed, reach, steps=STEPS):
    """(m, f) closed postures that random ways arrive at, far from singularities.

    Args:
        oracle: of the robot.
        home: a posture that is all but closed.
        count: of the ways.
        seed: of their ends.
        reach: of the longest, rad; of a travel 0.3 sizes of the robot for each.
        steps: of a way.
    """
    rng = np.random.default_rng(seed)
    wide = [reach if j.is_revolute else 0.3 * reach * oracle.size for j in oracle.robot.coordinates]
    home = closed_near(oracle, home[None])[0]
    share = rng.uniform(0.02, 1.0, (count, 1)) ** 2
    targets = home[oracle.given] + share * rng.uniform(-1, 1, (count, len(wide))) * wide
    u, distance = followed(oracle, home, targets, steps)
    return closed_near(oracle, u[np.isfinite(u[:, 0]) & (distance > REGULAR)])
