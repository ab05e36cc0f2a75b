"""Symmetric copies of a closed posture: the same places of frames and axes, other angles."""

from collections.abc import Callable

import numpy as np

from modeler.symbolic.linkage import Linkage
from modeler.symbolic.posture_search import in_a_turn

_SAME = 1e-6
"""Shapes that are so near are one."""
_CLOSED = 1e-9


def shapes_apart(linkage: Linkage, u: np.ndarray) -> list[np.ndarray]:
    """Numbers of the postures of every shape: each array the symmetric copies of one."""
    shape = linkage.shape(u)
    groups: list[list[int]] = []
    firsts = np.empty((0, shape.shape[1]))
    for k, one in enumerate(shape):
        same = np.flatnonzero(np.max(np.abs(firsts - one), axis=1, initial=0.0) < _SAME)
        if len(same):
            groups[int(same[0])].append(k)
        else:
            groups.append([k])
            firsts = np.vstack([firsts, one])
    return [np.array(group) for group in groups]


def lengthened(linkage: Linkage, u: np.ndarray, hints: np.ndarray) -> np.ndarray:
    """(n, u) the postures, with cylinders of negative length turned to point the other way.

    Where a travel is negative, and the opposite travel with one or two angles turned by pi has the
    same shape, it is a matter of how the posture is written. What hints or [limits] say stays.
    """
    lower, _ = linkage.bounds()
    meant = (hints < 0.0) | (np.isfinite(lower) & (lower < 0.0))
    u = np.array(u)
    for k in np.flatnonzero(linkage.lengths & linkage.tied & ~meant):
        short = np.flatnonzero(u[:, k] < -1e-9 * linkage.closing.size)
        u[short] = _turned_over(linkage, u[short], int(k))
    return u


def _turned_over(linkage: Linkage, u: np.ndarray, k: int) -> np.ndarray:
    """(n, u) the postures with the opposite travel k where they have such a copy."""
    turns = _turns(linkage, k)
    if not turns or not len(u):
        return u
    others = np.repeat(u, len(turns), axis=0)
    others[:, k] *= -1.0
    for place, turn in enumerate(turns):
        others[place :: len(turns)][:, list(turn)] += np.pi
    others = in_a_turn(linkage, others)
    copies = _are_copies(linkage, others, np.repeat(u, len(turns), axis=0))
    copies = copies.reshape(len(u), len(turns))
    first = others.reshape(len(u), len(turns), -1)[np.arange(len(u)), np.argmax(copies, axis=1)]
    return np.where(np.any(copies, axis=1)[:, None], first, u)


def _turns(linkage: Linkage, k: int) -> list[tuple[int, ...]]:
    """One or two angles on the chain through joint k."""
    rows = linkage.geometry.rows
    names = [row.joint.name for row in rows]
    row = names.index(linkage.free[k].name)
    chain = set(linkage.geometry.ancestors(row)) | {
        i for i in range(len(rows)) if row in linkage.geometry.ancestors(i)
    }
    angles = [
        i
        for i, joint in enumerate(linkage.free)
        if joint.angular and names.index(joint.name) in chain
    ]
    return [(i,) for i in angles] + [(i, j) for i in angles for j in angles if i < j]


Ranks = Callable[[np.ndarray], list[tuple[float, ...]]]
"""What sorts the better one of (n, u) postures first."""


def best_copy(linkage: Linkage, copies: np.ndarray, ranks: Ranks) -> np.ndarray:
    """(u,) the best way to write a posture, each leg in the best of the ways that were found.

    Args:
        linkage: the robot.
        copies: (n, u) closed postures of one shape.
        ranks: what is better.
    """
    keys = ranks(copies)
    best = copies[min(range(len(copies)), key=keys.__getitem__)]
    for leg in _legs(linkage):
        others = np.tile(best, (len(copies), 1))
        others[:, leg] = copies[:, leg]
        others = np.concatenate([best[None], others[_are_copies(linkage, others, best[None])]])
        keys = ranks(others)
        best = others[min(range(len(others)), key=keys.__getitem__)]
    return best + 0.0


def _are_copies(linkage: Linkage, others: np.ndarray, u: np.ndarray) -> np.ndarray:
    """(n,) True for closed postures that have the shape of those of u, (n, u) or (1, u)."""
    closing = linkage.closing
    open_by = np.max(np.abs(closing.residuals(others)), axis=1)
    different = np.max(np.abs(linkage.shape(others) - linkage.shape(u)), axis=1)
    return (open_by < _CLOSED * closing.size) & (different < _SAME) & closing.aligned(others)


def _legs(linkage: Linkage) -> list[list[int]]:
    """Joints that serve the same loops, as those of a leg do, by number in u."""
    geometry, free = linkage.geometry, [joint.name for joint in linkage.free]
    names = [row.joint.name for row in geometry.rows]
    served: dict[tuple[str, ...], list[int]] = {}
    chains = {
        loop.name: {
            names[i]
            for frame in (loop.frame, loop.meets)
            if frame != "0"
            for i in geometry.ancestors(names.index(frame))
        }
        for loop in linkage.robot.loops
    }
    for k, name in enumerate(free):
        served.setdefault(tuple(n for n, rows in chains.items() if name in rows), []).append(k)
    return list(served.values())
