"""Assembly modes: the ways in which the links can be put together with the actuated joints locked.

With the actuated joints at a common place, every closed posture that is not singular is a mode of
its own: none can be reached from another unless the motors move. Postures that differ only in how
they are written (`Linkage.compute_shape`) are one.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from modeler.derivation.thresholds import THRESHOLDS
from modeler.derivation.walks import Linkage

# Closed postures from many starts: Levenberg and Marquardt's method, all starts at once.
#
# N. Yamashita, M. Fukushima, "On the rate of convergence of the Levenberg-Marquardt method",
# Computing Supplementum 15, 2001: with a damping of |f|^2 it converges quadratically, redundant
# equations included.


def draw_start_postures(
    linkage: Linkage, hints: np.ndarray, count: int = THRESHOLDS.assembly_starts
) -> np.ndarray:
    """Returns (count, u) postures over [limits], full turns and travels of some sizes of the robot.

    Where there are hints, every second one is near them.

    Args:
        linkage: the robot.
        hints: (u,) values to stay near; NaN for joints without.
        count: how many.
    """
    rng = np.random.default_rng(THRESHOLDS.start_seed)
    lower, upper = linkage.get_bounds()
    reach = np.where(linkage.is_travel, THRESHOLDS.travel_reach * linkage.loops.size, np.pi)
    low = np.where(np.isfinite(lower), lower, -reach)
    high = np.where(np.isfinite(upper), upper, reach)
    u = rng.uniform(low, high, (count, len(low)))
    known = np.isfinite(hints)
    spread = np.resize(THRESHOLDS.hint_spreads, count)[:, None] * linkage.loops.scale
    around = np.where(known, hints, 0.0) + spread * rng.normal(size=u.shape)
    near = known & (np.arange(count) % 2 == 0)[:, None]
    u = np.where(near, around, u)
    return u


def find_closed_postures(linkage: Linkage, u: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Returns (m, u) closed postures that Newton's method reaches from (n, u) starts.

    Args:
        linkage: the robot.
        u: starts.
        places: numbers of the joints that may move.
    """
    loops, u = linkage.loops, np.array(u, dtype=float)
    scale, limit = linkage.loops.scale[places], THRESHOLDS.rough_residual * loops.size
    done = []
    for _ in range(THRESHOLDS.newton_iterations):
        f = loops.compute_residuals(u)
        closed = np.max(np.abs(f), axis=1, initial=0.0) < limit
        done.append(u[closed])
        u, f = u[~closed], f[~closed]
        if not len(u):
            break
        J = loops.compute_jacobians(u)[:, :, places] * scale
        damping = np.clip(np.sum(f**2, axis=1), THRESHOLDS.min_damping, THRESHOLDS.max_damping)
        normal = J @ J.transpose(0, 2, 1) + damping[:, None, None] * np.eye(J.shape[1])
        step = -np.einsum("nji,nj->ni", J, np.linalg.solve(normal, f[..., None])[..., 0])
        longest = np.max(np.abs(step), axis=1, keepdims=True)
        u[:, places] += (
            step * np.minimum(1.0, THRESHOLDS.max_search_step / np.maximum(longest, 1e-300)) * scale
        )
    closed_postures = np.concatenate(done)
    if not len(closed_postures):
        return closed_postures
    closed_postures = loops.close_loops(closed_postures, list(places))
    return wrap_angles(linkage, closed_postures[loops.are_aligned(closed_postures)])


def wrap_angles(linkage: Linkage, u: np.ndarray) -> np.ndarray:
    """Returns angles within half a turn of 0, or of the middle of their [limits]."""
    middle = np.nan_to_num(linkage.limit_middles)
    # What should be pi is not to be -pi on another machine.
    turns = np.ceil((u - middle - 1e-9) / (2 * np.pi) - 0.5)
    return np.where(linkage.is_travel | (turns == 0.0), u, u - 2 * np.pi * turns)


def reset_uncoupled_joints(
    linkage: Linkage, u: np.ndarray, hints: np.ndarray, closed: np.ndarray | None = None
) -> np.ndarray:
    """Returns (n, u) with joints that move no loop where hints or [limits] say, else at 0.

    Such a joint turns all of its loops, as the swing of an excavator does.

    Args:
        linkage: the robot.
        u: postures.
        hints: (u,) NaN for joints without.
        closed: closed postures by which those joints are found; `u` itself if left out.
    """
    J = linkage.loops.compute_jacobians(u if closed is None else closed) * linkage.loops.scale
    loose = np.max(np.abs(J), axis=(0, 1)) < THRESHOLDS.uncoupled_column * linkage.loops.size
    rest = np.where(np.isfinite(hints), hints, np.nan_to_num(linkage.limit_middles))
    return np.where(loose, rest, u)


# Symmetric copies of a closed posture: the same places of frames and axes, other angles.


def partition_by_shape(linkage: Linkage, u: np.ndarray) -> list[np.ndarray]:
    """Returns the numbers of the postures of every shape: each array holds symmetric copies."""
    shape = linkage.compute_shape(u)
    groups: list[list[int]] = []
    firsts = np.empty((0, shape.shape[1]))
    for k, one in enumerate(shape):
        same = np.flatnonzero(
            np.max(np.abs(firsts - one), axis=1, initial=0.0) < THRESHOLDS.same_shape
        )
        if len(same):
            groups[int(same[0])].append(k)
        else:
            groups.append([k])
            firsts = np.vstack([firsts, one])
    return [np.array(group) for group in groups]


def flip_negative_travels(linkage: Linkage, u: np.ndarray, hints: np.ndarray) -> np.ndarray:
    """Returns (n, u) the postures with cylinders of negative length turned the other way.

    Where a travel is negative, and the opposite travel with one or two angles turned by pi has the
    same shape, it is a matter of how the posture is written. What hints or [limits] say stays.
    """
    lower, _ = linkage.get_bounds()
    meant = (hints < 0.0) | (np.isfinite(lower) & (lower < 0.0))
    u = np.array(u)
    for k in np.flatnonzero(linkage.is_travel & linkage.is_tied & ~meant):
        short = np.flatnonzero(u[:, k] < -1e-9 * linkage.loops.size)
        u[short] = _flip_travel(linkage, u[short], int(k))
    return u


def _flip_travel(linkage: Linkage, u: np.ndarray, k: int) -> np.ndarray:
    """(n, u) the postures with the opposite travel k where they have such a copy."""
    turns = _find_flip_angles(linkage, k)
    if not turns or not len(u):
        return u
    others = np.repeat(u, len(turns), axis=0)
    others[:, k] *= -1.0
    for place, turn in enumerate(turns):
        others[place :: len(turns)][:, list(turn)] += np.pi
    others = wrap_angles(linkage, others)
    copies = _are_copies(linkage, others, np.repeat(u, len(turns), axis=0))
    copies = copies.reshape(len(u), len(turns))
    first = others.reshape(len(u), len(turns), -1)[np.arange(len(u)), np.argmax(copies, axis=1)]
    return np.where(np.any(copies, axis=1)[:, None], first, u)


def _find_flip_angles(linkage: Linkage, k: int) -> list[tuple[int, ...]]:
    """One or two angles on the chain through joint k."""
    rows = linkage.geometry.rows
    names = [row.joint.name for row in rows]
    row = names.index(linkage.free[k].name)
    chain = set(linkage.geometry.find_ancestors(row)) | {
        i for i in range(len(rows)) if row in linkage.geometry.find_ancestors(i)
    }
    angles = [
        i
        for i, joint in enumerate(linkage.free)
        if joint.is_revolute and names.index(joint.name) in chain
    ]
    return [(i,) for i in angles] + [(i, j) for i in angles for j in angles if i < j]


Ranks = Callable[[np.ndarray], list[tuple[float, ...]]]
"""What sorts the better one of (n, u) postures first."""


def select_best_copy(linkage: Linkage, copies: np.ndarray, ranks: Ranks) -> np.ndarray:
    """Returns (u,) the best way to write a posture, each leg in the best of the ways found.

    Args:
        linkage: the robot.
        copies: (n, u) closed postures of one shape.
        ranks: what is better.
    """
    keys = ranks(copies)
    best = copies[min(range(len(copies)), key=keys.__getitem__)]
    for leg in _find_legs(linkage):
        others = np.tile(best, (len(copies), 1))
        others[:, leg] = copies[:, leg]
        others = np.concatenate([best[None], others[_are_copies(linkage, others, best[None])]])
        keys = ranks(others)
        best = others[min(range(len(others)), key=keys.__getitem__)]
    return best + 0.0


def _are_copies(linkage: Linkage, others: np.ndarray, u: np.ndarray) -> np.ndarray:
    """(n,) True for closed postures that have the shape of those of u, (n, u) or (1, u)."""
    loops = linkage.loops
    open_by = np.max(np.abs(loops.compute_residuals(others)), axis=1)
    different = np.max(np.abs(linkage.compute_shape(others) - linkage.compute_shape(u)), axis=1)
    return (
        (open_by < THRESHOLDS.copy_residual * loops.size)
        & (different < THRESHOLDS.same_shape)
        & loops.are_aligned(others)
    )


def _find_legs(linkage: Linkage) -> list[list[int]]:
    """Joints that serve the same loops, as those of a leg do, by number in u."""
    geometry, free = linkage.geometry, [joint.name for joint in linkage.free]
    names = [row.joint.name for row in geometry.rows]
    served: dict[tuple[str, ...], list[int]] = {}
    chains = {
        loop.name: {
            names[i]
            for frame in (loop.frame, loop.meets)
            if frame != "0"
            for i in geometry.find_ancestors(names.index(frame))
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


def count_constant_ratios(linkage: Linkage, u: np.ndarray) -> np.ndarray:
    """Returns (n,) numbers of independent combinations of joint speeds that stay 0 around it.

    0 where half of the motions around it are out of reach.

    Args:
        linkage: the robot.
        u: (n, u) regular closed postures.
    """
    loops, actuated = linkage.loops, list(linkage.loops.actuated)
    solved = list(loops.solved)
    count = max(
        THRESHOLDS.min_ratio_postures,
        THRESHOLDS.speeds_per_joint * -(-loops.unknown_count // len(actuated)),
    )
    steps = np.random.default_rng(THRESHOLDS.ratio_seed).uniform(
        -THRESHOLDS.ratio_step, THRESHOLDS.ratio_step, (count, len(actuated))
    )
    around = np.repeat(u[:, None], count, axis=1)
    around[:, :, actuated] += steps * linkage.loops.scale[actuated]
    around = loops.close_loops(around.reshape(-1, loops.unknown_count))
    closed = np.all(np.isfinite(around), axis=1)
    J = loops.compute_jacobians(around[closed]) * linkage.loops.scale
    speeds = np.zeros((len(around), loops.unknown_count, len(actuated)))
    speeds[np.ix_(closed, actuated)] = np.eye(len(actuated))
    speeds[np.ix_(closed, solved)] = -np.linalg.pinv(J[:, :, solved]) @ J[:, :, actuated]
    every = speeds.reshape(len(u), count, loops.unknown_count, len(actuated))
    flat = every.transpose(0, 2, 1, 3).reshape(len(u), loops.unknown_count, -1)
    values = np.linalg.svd(flat, compute_uv=False)
    moving = np.sum(values > THRESHOLDS.ratio_rank * values[:, :1], axis=1)
    enough = 2 * np.sum(closed.reshape(len(u), count), axis=1) >= count
    return np.where(enough, loops.unknown_count - moving, 0)


@dataclass(frozen=True)
class AssemblyMode:
    """One way to put the links together.

    Attributes:
        letter: A for the one that is best to start from, B, ...
        posture: (u,) values of the free joints, rad and m, loops closed.
        sigma: distance to a singularity, 0 at one; see
            `LoopEquations.compute_singularity_distance`.
        kept: True within [limits].
        copies: number of ways in which the same was found written, itself included.
        away: from what was stated, rad and sizes, summed over the joints that were.
    """

    letter: str
    posture: np.ndarray
    singularity_distance: float
    is_within_limits: bool
    copy_count: int
    distance_from_stated: float


_BEFORE_TIES = 4
"""Columns of `_ranks` that count more than steady ties."""


def find_assembly_modes(linkage: Linkage, hints: np.ndarray) -> tuple[AssemblyMode, ...]:
    """Returns all assembly modes found at one place of the actuated joints, the best first.

    The actuated joints stand where hints say, else in the middle of [limits], else where a posture
    is far from singular; where the loops cannot close so, near there. The best mode keeps [limits],
    is no near neighbour of a singular one, is near to the hints, has no negative travels, ties
    joints by constant ratios (`count_constant_ratios`), is far from singular and has small angles,
    in this order. Empty if nothing closes.

    Args:
        linkage: the robot.
        hints: (u,) values that are meant; NaN for joints of which nothing is said.
    """
    postures = _find_common_postures(linkage, hints)
    if not len(postures):
        return ()
    groups = [postures[group] for group in partition_by_shape(linkage, postures)]
    best = max(float(np.max(linkage.loops.compute_singularity_distance(group))) for group in groups)
    ranked = []
    for group in groups:
        u = select_best_copy(
            linkage, group, lambda some: _compute_rank_keys(linkage, some, hints, best)
        )
        copies = len(np.unique(np.round(group, THRESHOLDS.rank_key_digits - 1), axis=0))
        key = _compute_rank_keys(linkage, u[None], hints, best)[0]
        ranked.append(
            (_insert_ratio_count(key, int(count_constant_ratios(linkage, u[None])[0])), u, copies)
        )
    ranked.sort(key=lambda one: one[0])
    return tuple(
        AssemblyMode(
            letter=_format_letter(k),
            posture=u,
            singularity_distance=float(linkage.loops.compute_singularity_distance(u[None])[0]),
            is_within_limits=bool(
                linkage.compute_limit_excess(u[None])[0] < THRESHOLDS.limit_rounding
            ),
            copy_count=copies,
            distance_from_stated=float(np.sum(linkage.compute_distances(u[None], hints))),
        )
        for k, (_, u, copies) in enumerate(ranked)
    )


def _format_letter(k: int) -> str:
    """A, B, ... Z, AA, AB, ..."""
    return ("" if k < 26 else _format_letter(k // 26 - 1)) + chr(ord("A") + k % 26)


def _compute_rank_keys(
    linkage: Linkage, u: np.ndarray, hints: np.ndarray, best: float
) -> list[tuple[float, ...]]:
    """By posture, what sorts the better one first."""
    sigma = linkage.loops.compute_singularity_distance(u)
    is_leg_joint = np.array([joint.name not in linkage.robot.platform for joint in linkage.free])
    negative = np.sum(
        (u < -1e-9 * linkage.loops.size) & linkage.is_travel & linkage.is_tied & is_leg_joint,
        axis=1,
    )
    angles = np.sum(np.abs(np.where(linkage.is_travel, 0.0, u)), axis=1)
    columns = np.column_stack([
        np.round(linkage.compute_limit_excess(u), THRESHOLDS.rank_key_digits),
        sigma < THRESHOLDS.min_singularity_share * best,
        np.round(np.sum(linkage.compute_distances(u, hints), axis=1), THRESHOLDS.rank_key_digits),
        negative,
        np.round(np.log2(best / sigma)),
        np.round(angles, THRESHOLDS.rank_key_digits),
        -np.round(u, THRESHOLDS.rank_key_digits),  # mirrored: the positive one first
    ])  # fmt: skip
    return [tuple(line) for line in columns.tolist()]


def _insert_ratio_count(key: tuple[float, ...], ties: int) -> tuple[float, ...]:
    return (*key[:_BEFORE_TIES], -ties, *key[_BEFORE_TIES:])


def _select_reference_posture(linkage: Linkage, u: np.ndarray, hints: np.ndarray) -> np.ndarray:
    """(u,) the closed posture at whose actuated joints the modes are compared: the best one.

    Ties take long to count: they are for the best postures, and some others down to the worst.
    """
    keys = _compute_rank_keys(
        linkage, u, hints, float(np.max(linkage.loops.compute_singularity_distance(u)))
    )
    order = sorted((k for k, key in enumerate(keys) if not key[1]), key=keys.__getitem__)
    spread = np.linspace(0, len(order) - 1, THRESHOLDS.counted_postures).astype(int)
    some = [
        order[k]
        for k in sorted({*range(min(THRESHOLDS.counted_postures, len(order))), *spread.tolist()})
    ]
    ties = count_constant_ratios(linkage, u[some])
    return u[
        min(
            zip(some, ties, strict=True), key=lambda one: _insert_ratio_count(keys[one[0]], one[1])
        )[0]
    ]


def _find_common_postures(linkage: Linkage, hints: np.ndarray) -> np.ndarray:
    """(n, u) regular closed postures that all have the actuated joints at the same place."""
    actuated = np.array(linkage.loops.actuated)
    wanted = np.full(len(hints), np.nan)
    wanted[actuated] = np.where(np.isfinite(hints), hints, linkage.limit_middles)[actuated]
    wanted = np.where(linkage.is_tied, wanted, np.nan)
    every = np.arange(len(hints))
    meant = np.where(np.isfinite(hints), hints, wanted)
    for held in (np.isfinite(wanted), np.isfinite(wanted) & np.isfinite(hints), wanted > np.inf):
        u = draw_start_postures(linkage, meant)
        u[:, held] = wanted[held]
        around = _discard_singular(
            linkage, find_closed_postures(linkage, u, every[~held & linkage.is_tied]), hints
        )
        if not len(around):
            continue
        around = reset_uncoupled_joints(linkage, around, meant)
        place = _select_reference_posture(linkage, around, hints)
        place = _round_actuated_joints(
            linkage, place, every[~held & linkage.is_tied & np.isin(every, actuated)]
        )
        u = np.concatenate([draw_start_postures(linkage, meant), around, place[None]])
        u = reset_uncoupled_joints(linkage, u, meant, around)
        u[:, actuated] = place[actuated]
        closed_postures = find_closed_postures(linkage, u, np.array(linkage.loops.solved))
        return _discard_singular(linkage, np.concatenate([place[None], closed_postures]), hints)
    return np.empty((0, len(hints)))


def _discard_singular(linkage: Linkage, u: np.ndarray, hints: np.ndarray) -> np.ndarray:
    """Those that are not singular, cylinders longer than zero."""
    if not len(u):
        return u
    return flip_negative_travels(
        linkage,
        u[linkage.loops.compute_singularity_distance(u) > THRESHOLDS.min_singular_value],
        hints,
    )


def _round_actuated_joints(linkage: Linkage, u: np.ndarray, places: np.ndarray) -> np.ndarray:
    """The posture with actuated joints at short numbers, as short as leaves it where it is."""
    before = float(linkage.loops.compute_singularity_distance(u[None])[0])
    unit = np.where(linkage.is_travel, 10.0 ** np.floor(np.log10(linkage.loops.size)), 1.0)
    for step in THRESHOLDS.rounding_steps:
        trial = u.copy()
        trial[places] = [
            float(f"{round(x / (step * one)) * step * one:.10g}")
            for x, one in zip(u[places], unit[places], strict=True)
        ]
        closed = linkage.loops.close_loops(trial[None])
        if np.all(np.isfinite(closed)) and linkage.loops.are_aligned(closed)[0]:
            near = np.max(linkage.compute_distances(closed, u)) < 5 * step
            if near and linkage.loops.compute_singularity_distance(closed)[0] > 0.5 * before:
                return closed[0]
    return u
