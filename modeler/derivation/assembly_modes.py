"""Assembly modes: the ways in which the links can be put together with the actuated joints locked.

With the actuated joints at a common place, every closed posture that is not singular is a mode of
its own: none can be reached from another unless the motors move. Postures that differ only in how
they are written (`Linkage.shape`) are one.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from modeler.derivation.closure import SINGULAR
from modeler.derivation.walks import Linkage

# Closed postures from many starts: Levenberg and Marquardt's method, all starts at once.
#
# N. Yamashita, M. Fukushima, "On the rate of convergence of the Levenberg-Marquardt method",
# Computing Supplementum 15, 2001: with a damping of |f|^2 it converges quadratically, redundant
# equations included.


STARTS = 300
"""Random postures that a search starts from."""
_POSTURE_SEED = 1955  # Denavit and Hartenberg
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
    rng = np.random.default_rng(_POSTURE_SEED)
    lower, upper = linkage.bounds()
    reach = np.where(linkage.lengths, _REACH * linkage.loops.size, np.pi)
    low = np.where(np.isfinite(lower), lower, -reach)
    high = np.where(np.isfinite(upper), upper, reach)
    u = rng.uniform(low, high, (count, len(low)))
    known = np.isfinite(hints)
    spread = np.resize(_SPREADS, count)[:, None] * linkage.loops.scale
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
    loops, u = linkage.loops, np.array(u, dtype=float)
    scale, limit = linkage.loops.scale[places], _ROUGH * loops.size
    done = []
    for _ in range(_ITERATIONS):
        f = loops.residuals(u)
        closed = np.max(np.abs(f), axis=1, initial=0.0) < limit
        done.append(u[closed])
        u, f = u[~closed], f[~closed]
        if not len(u):
            break
        J = loops.jacobians(u)[:, :, places] * scale
        damping = np.clip(np.sum(f**2, axis=1), _LEAST_DAMPING, _MOST_DAMPING)
        normal = J @ J.transpose(0, 2, 1) + damping[:, None, None] * np.eye(J.shape[1])
        step = -np.einsum("nji,nj->ni", J, np.linalg.solve(normal, f[..., None])[..., 0])
        longest = np.max(np.abs(step), axis=1, keepdims=True)
        u[:, places] += step * np.minimum(1.0, _LONGEST / np.maximum(longest, 1e-300)) * scale
    found = np.concatenate(done)
    if not len(found):
        return found
    found = loops.closed(found, list(places))
    return in_a_turn(linkage, found[loops.aligned(found)])


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
    J = linkage.loops.jacobians(u if closed is None else closed) * linkage.loops.scale
    loose = np.max(np.abs(J), axis=(0, 1)) < _LOOSE * linkage.loops.size
    rest = np.where(np.isfinite(hints), hints, np.nan_to_num(linkage.middles))
    return np.where(loose, rest, u)


# Symmetric copies of a closed posture: the same places of frames and axes, other angles.


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
        short = np.flatnonzero(u[:, k] < -1e-9 * linkage.loops.size)
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
    loops = linkage.loops
    open_by = np.max(np.abs(loops.residuals(others)), axis=1)
    different = np.max(np.abs(linkage.shape(others) - linkage.shape(u)), axis=1)
    return (open_by < _CLOSED * loops.size) & (different < _SAME) & loops.aligned(others)


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


# How many joints a posture's loops tie by constant ratios, as a parallelogram does.
#
# A parallelogram can also be put together crossed. With equal lengths both are assembly modes; the
# one that keeps directions is what such lengths are chosen for.


_TIMES = 2  # as many speeds as joints, so that half of the postures are enough
_FEWEST = 8
_TIE_SEED = 1784  # Watt
_STEP = 0.02  # rad or sizes, of the actuated joints
_TOLERANCE = 1e-7


def steady_ties(linkage: Linkage, u: np.ndarray) -> np.ndarray:
    """(n,) numbers of independent combinations of joint speeds that vanish all around a posture.

    0 where half of the motions around it are out of reach.

    Args:
        linkage: the robot.
        u: (n, u) regular closed postures.
    """
    loops, given = linkage.loops, list(linkage.loops.given)
    solved = list(loops.solved)
    count = max(_FEWEST, _TIMES * -(-loops.unknowns // len(given)))
    steps = np.random.default_rng(_TIE_SEED).uniform(-_STEP, _STEP, (count, len(given)))
    around = np.repeat(u[:, None], count, axis=1)
    around[:, :, given] += steps * linkage.loops.scale[given]
    around = loops.closed(around.reshape(-1, loops.unknowns))
    closed = np.all(np.isfinite(around), axis=1)
    J = loops.jacobians(around[closed]) * linkage.loops.scale
    speeds = np.zeros((len(around), loops.unknowns, len(given)))
    speeds[np.ix_(closed, given)] = np.eye(len(given))
    speeds[np.ix_(closed, solved)] = -np.linalg.pinv(J[:, :, solved]) @ J[:, :, given]
    every = speeds.reshape(len(u), count, loops.unknowns, len(given))
    flat = every.transpose(0, 2, 1, 3).reshape(len(u), loops.unknowns, -1)
    values = np.linalg.svd(flat, compute_uv=False)
    moving = np.sum(values > _TOLERANCE * values[:, :1], axis=1)
    enough = 2 * np.sum(closed.reshape(len(u), count), axis=1) >= count
    return np.where(enough, loops.unknowns - moving, 0)


_GOOD = 0.2
"""Share of the best distance to a singularity that a posture to start from has to have."""
_KEPT = 1e-9
"""rad or sizes by which rounding may leave [limits]."""
_DIGITS = 5
"""Of numbers by which postures are ranked, so that rounding never ranks them."""
_STEPS = (0.1, 0.01, 1e-3, 1e-4, 1e-6, 1e-9)
"""rad or sizes (their power of ten), to which actuated joints are rounded."""


@dataclass(frozen=True)
class AssemblyMode:
    """One way to put the links together.

    Attributes:
        letter: A for the one that is best to start from, B, ...
        posture: (u,) values of the free joints, rad and m, loops closed.
        sigma: distance to a singularity, 0 at one; see `LoopEquations.sigma`.
        kept: True within [limits].
        copies: number of ways in which the same was found written, itself included.
        away: from what was stated, rad and sizes, summed over the joints that were.
    """

    letter: str
    posture: np.ndarray
    sigma: float
    kept: bool
    copies: int
    away: float


_BEFORE_TIES = 4
"""Columns of `_ranks` that count more than steady ties."""
_COUNTED = 24


def assembly_modes(linkage: Linkage, hints: np.ndarray) -> tuple[AssemblyMode, ...]:
    """All assembly modes that are found where the actuated joints stand together; the best first.

    The actuated joints stand where hints say, else in the middle of [limits], else where a posture
    is far from singular; where the loops cannot close so, near there. The best mode keeps [limits],
    is no near neighbour of a singular one, is near to the hints, has no negative travels, ties
    joints by constant ratios (`steady_ties`), is far from singular and has small angles, in this
    order. Empty if nothing closes.

    Args:
        linkage: the robot.
        hints: (u,) values that are meant; NaN for joints of which nothing is said.
    """
    found = _together(linkage, hints)
    if not len(found):
        return ()
    groups = [found[group] for group in shapes_apart(linkage, found)]
    best = max(float(np.max(linkage.loops.sigma(group))) for group in groups)
    ranked = []
    for group in groups:
        u = best_copy(linkage, group, lambda some: _ranks(linkage, some, hints, best))
        copies = len(np.unique(np.round(group, _DIGITS - 1), axis=0))
        key = _ranks(linkage, u[None], hints, best)[0]
        ranked.append((_with_ties(key, int(steady_ties(linkage, u[None])[0])), u, copies))
    ranked.sort(key=lambda one: one[0])
    return tuple(
        AssemblyMode(
            letter=_letter(k),
            posture=u,
            sigma=float(linkage.loops.sigma(u[None])[0]),
            kept=bool(linkage.outside(u[None])[0] < _KEPT),
            copies=copies,
            away=float(np.sum(linkage.distances(u[None], hints))),
        )
        for k, (_, u, copies) in enumerate(ranked)
    )


def _letter(k: int) -> str:
    """A, B, ... Z, AA, AB, ..."""
    return ("" if k < 26 else _letter(k // 26 - 1)) + chr(ord("A") + k % 26)


def _ranks(
    linkage: Linkage, u: np.ndarray, hints: np.ndarray, best: float
) -> list[tuple[float, ...]]:
    """By posture, what sorts the better one first."""
    sigma = linkage.loops.sigma(u)
    own = np.array([joint.name not in linkage.robot.platform for joint in linkage.free])
    negative = np.sum(
        (u < -1e-9 * linkage.loops.size) & linkage.lengths & linkage.tied & own, axis=1
    )
    angles = np.sum(np.abs(np.where(linkage.lengths, 0.0, u)), axis=1)
    columns = np.column_stack([
        np.round(linkage.outside(u), _DIGITS),
        sigma < _GOOD * best,
        np.round(np.sum(linkage.distances(u, hints), axis=1), _DIGITS),
        negative,
        np.round(np.log2(best / sigma)),
        np.round(angles, _DIGITS),
        -np.round(u, _DIGITS),  # mirrored: the positive one first
    ])  # fmt: skip
    return [tuple(line) for line in columns.tolist()]


def _with_ties(key: tuple[float, ...], ties: int) -> tuple[float, ...]:
    return (*key[:_BEFORE_TIES], -ties, *key[_BEFORE_TIES:])


def _place(linkage: Linkage, u: np.ndarray, hints: np.ndarray) -> np.ndarray:
    """(u,) the closed posture at whose actuated joints the modes are compared: the best one.

    Ties take long to count: they are for the best postures, and some others down to the worst.
    """
    keys = _ranks(linkage, u, hints, float(np.max(linkage.loops.sigma(u))))
    order = sorted((k for k, key in enumerate(keys) if not key[1]), key=keys.__getitem__)
    spread = np.linspace(0, len(order) - 1, _COUNTED).astype(int)
    some = [order[k] for k in sorted({*range(min(_COUNTED, len(order))), *spread.tolist()})]
    ties = steady_ties(linkage, u[some])
    return u[min(zip(some, ties, strict=True), key=lambda one: _with_ties(keys[one[0]], one[1]))[0]]


def _together(linkage: Linkage, hints: np.ndarray) -> np.ndarray:
    """(n, u) regular closed postures that all have the actuated joints at the same place."""
    given = np.array(linkage.loops.given)
    wanted = np.full(len(hints), np.nan)
    wanted[given] = np.where(np.isfinite(hints), hints, linkage.middles)[given]
    wanted = np.where(linkage.tied, wanted, np.nan)
    every = np.arange(len(hints))
    meant = np.where(np.isfinite(hints), hints, wanted)
    for held in (np.isfinite(wanted), np.isfinite(wanted) & np.isfinite(hints), wanted > np.inf):
        u = starts(linkage, meant)
        u[:, held] = wanted[held]
        around = _regular(linkage, closed_from(linkage, u, every[~held & linkage.tied]), hints)
        if not len(around):
            continue
        around = at_rest(linkage, around, meant)
        place = _place(linkage, around, hints)
        place = _rounded(linkage, place, every[~held & linkage.tied & np.isin(every, given)])
        u = np.concatenate([starts(linkage, meant), around, place[None]])
        u = at_rest(linkage, u, meant, around)
        u[:, given] = place[given]
        found = closed_from(linkage, u, np.array(linkage.loops.solved))
        return _regular(linkage, np.concatenate([place[None], found]), hints)
    return np.empty((0, len(hints)))


def _regular(linkage: Linkage, u: np.ndarray, hints: np.ndarray) -> np.ndarray:
    """Those that are not singular, cylinders longer than zero."""
    if not len(u):
        return u
    return lengthened(linkage, u[linkage.loops.sigma(u) > SINGULAR], hints)


def _rounded(linkage: Linkage, u: np.ndarray, places: np.ndarray) -> np.ndarray:
    """The posture with actuated joints at short numbers, as short as leaves it where it is."""
    before = float(linkage.loops.sigma(u[None])[0])
    unit = np.where(linkage.lengths, 10.0 ** np.floor(np.log10(linkage.loops.size)), 1.0)
    for step in _STEPS:
        trial = u.copy()
        trial[places] = [
            float(f"{round(x / (step * one)) * step * one:.10g}")
            for x, one in zip(u[places], unit[places], strict=True)
        ]
        closed = linkage.loops.closed(trial[None])
        if np.all(np.isfinite(closed)) and linkage.loops.aligned(closed)[0]:
            near = np.max(linkage.distances(closed, u)) < 5 * step
            if near and linkage.loops.sigma(closed)[0] > 0.5 * before:
                return closed[0]
    return u
