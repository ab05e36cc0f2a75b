"""Closed postures from many starts: Levenberg and Marquardt's method, all starts at once.

N. Yamashita, M. Fukushima, "On the rate of convergence of the Levenberg-Marquardt method",
Computing Supplementum 15, 2001: with a damping of |f|^2 it converges quadratically, redundant
equations included.
"""

import numpy as np

from modeler.symbolic.linkage import Linkage

STARTS = 300
"""Random postures that a search starts from."""
_SEED = 1955  # Denavit and Hartenberg
_ITERATIONS = 60
_LONGEST = 0.5  # rad or sizes, of one step
_LEAST_DAMPING, _MOST_DAMPING = 1e-13, 1e-2
_ROUGH = 1e-7  # residual from which Newton's method ends the work
_REACH = 2.0  # sizes of the robot, of a travel without [limits]
_LOOSE = 1e-8  # of the closing equations by a joint that does not move them, rounding
_SPREADS = (0.05, 0.2, 0.6)  # rad or sizes, of starts around hints


def starts(linkage: Linkage, hints: np.ndarray, count: int = STARTS) -> np.ndarray:
    """(count, u) postures over [limits], full turns and travels of some sizes of the robot.

    Where there are hints, every second one is near them.

    Args:
        linkage: the robot.
        hints: (u,) values to stay near; NaN for joints without.
        count: how many.
    """
    rng = np.random.default_rng(_SEED)
    lower, upper = linkage.bounds()
    reach = np.where(linkage.lengths, _REACH * linkage.closing.size, np.pi)
    low = np.where(np.isfinite(lower), lower, -reach)
    high = np.where(np.isfinite(upper), upper, reach)
    u = rng.uniform(low, high, (count, len(low)))
    known = np.isfinite(hints)
    spread = np.resize(_SPREADS, count)[:, None] * linkage.closing.scale
    around = np.where(known, hints, 0.0) + spread * rng.normal(size=u.shape)
    near = known & (np.arange(count) % 2 == 0)[:, None]
    u = np.where(near, around, u)
    return u


def closed_from(linkage: Linkage, u: np.ndarray, places: np.ndarray) -> np.ndarray:
    """(m, u) closed postures that are found from (n, u) starts, loops as meant, angles in a turn.

    Args:
        linkage: the robot.
        u: starts.
        places: numbers of the joints that may move.
    """
    closing, u = linkage.closing, np.array(u, dtype=float)
    scale, limit = linkage.closing.scale[places], _ROUGH * closing.size
    done = []
    for _ in range(_ITERATIONS):
        f = closing.residuals(u)
        closed = np.max(np.abs(f), axis=1, initial=0.0) < limit
        done.append(u[closed])
        u, f = u[~closed], f[~closed]
        if not len(u):
            break
        J = closing.jacobians(u)[:, :, places] * scale
        damping = np.clip(np.sum(f**2, axis=1), _LEAST_DAMPING, _MOST_DAMPING)
        normal = J @ J.transpose(0, 2, 1) + damping[:, None, None] * np.eye(J.shape[1])
        step = -np.einsum("nji,nj->ni", J, np.linalg.solve(normal, f[..., None])[..., 0])
        longest = np.max(np.abs(step), axis=1, keepdims=True)
        u[:, places] += step * np.minimum(1.0, _LONGEST / np.maximum(longest, 1e-300)) * scale
    found = np.concatenate(done)
    if not len(found):
        return found
    found = closing.closed(found, list(places))
    return in_a_turn(linkage, found[closing.aligned(found)])


def in_a_turn(linkage: Linkage, u: np.ndarray) -> np.ndarray:
    """Angles within half a turn of 0, or of the middle of their [limits]."""
    middle = np.nan_to_num(linkage.middles)
    # What should be pi is not to be -pi on another machine.
    turns = np.ceil((u - middle - 1e-9) / (2 * np.pi) - 0.5)
    return np.where(linkage.lengths | (turns == 0.0), u, u - 2 * np.pi * turns)


def at_rest(
    linkage: Linkage, u: np.ndarray, hints: np.ndarray, closed: np.ndarray | None = None
) -> np.ndarray:
    """(n, u) with the joints that move no loop where hints or [limits] say, else at 0.

    Such a joint turns all of its loops, as the swing of an excavator does.

    Args:
        linkage: the robot.
        u: postures.
        hints: (u,) NaN for joints without.
        closed: closed postures by which those joints are found; `u` itself if left out.
    """
    J = linkage.closing.jacobians(u if closed is None else closed) * linkage.closing.scale
    loose = np.max(np.abs(J), axis=(0, 1)) < _LOOSE * linkage.closing.size
    rest = np.where(np.isfinite(hints), hints, np.nan_to_num(linkage.middles))
    return np.where(loose, rest, u)
