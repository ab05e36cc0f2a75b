"""Assembly modes: the ways in which the links can be put together with the actuated joints locked.

With the actuated joints at a common place, every closed posture that is not singular is a mode of
its own: none can be reached from another unless the motors move. Postures that differ only in how
they are written (`Linkage.compute_shape`) are one.
"""

import dataclasses
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DerivationError, LoopError, RobotError
from modeler.core.json import ShortRepr
from modeler.core.result import Result
from modeler.derivation.closure import check_mobility, describe_open_loop, find_nearest_closed
from modeler.derivation.geometry import build_exact_geometry
from modeler.derivation.graph import Graph
from modeler.derivation.model import SymbolicModel, build_standard_columns
from modeler.derivation.thresholds import THRESHOLDS
from modeler.derivation.walks import Linkage, build_linkage
from modeler.robot import Robot, parse_robot_text

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
        size = np.maximum(longest, 1e-300)
        u[:, places] += step * np.minimum(1.0, THRESHOLDS.max_search_step / size) * scale
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
        departures = np.max(np.abs(firsts - one), axis=1, initial=0.0)
        same = np.flatnonzero(departures < THRESHOLDS.same_shape)
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
    free = enumerate(linkage.free)
    angles = [i for i, joint in free if joint.is_revolute and names.index(joint.name) in chain]
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
    same = (open_by < THRESHOLDS.copy_residual * loops.size) & (different < THRESHOLDS.same_shape)
    return same & loops.are_aligned(others)


def _find_legs(linkage: Linkage) -> list[list[int]]:
    """Joints that serve the same loops, as those of a leg do, by number in u."""
    geometry, free = linkage.geometry, [joint.name for joint in linkage.free]
    names = [row.joint.name for row in geometry.rows]
    served: dict[tuple[str, ...], list[int]] = {}
    chains: dict[str, set[str]] = {}
    for loop in linkage.robot.loops:
        ends = [names.index(frame) for frame in (loop.frame, loop.meets) if frame != "0"]
        chains[loop.name] = {names[i] for end in ends for i in geometry.find_ancestors(end)}
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
    per_actuated = -(-loops.unknown_count // len(actuated))
    count = max(THRESHOLDS.min_ratio_postures, THRESHOLDS.speeds_per_joint * per_actuated)
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


@dataclass(frozen=True, repr=False)
class AssemblyMode(ShortRepr):
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
            linkage, group, lambda some: _rank_postures(linkage, some, hints, best)
        )
        copies = len(np.unique(np.round(group, THRESHOLDS.rank_key_digits - 1), axis=0))
        key = _rank_postures(linkage, u[None], hints, best)[0]
        ratios = int(count_constant_ratios(linkage, u[None])[0])
        ranked.append((_insert_ratios(key, ratios), u, copies))
    ranked.sort(key=lambda one: one[0])
    distance, excess = linkage.loops.compute_singularity_distance, linkage.compute_limit_excess
    return tuple(
        AssemblyMode(
            letter=_format_letter(k),
            posture=u,
            singularity_distance=float(distance(u[None])[0]),
            is_within_limits=bool(excess(u[None])[0] < THRESHOLDS.limit_rounding),
            copy_count=copies,
            distance_from_stated=float(np.sum(linkage.compute_distances(u[None], hints))),
        )
        for k, (_, u, copies) in enumerate(ranked)
    )


def _format_letter(k: int) -> str:
    """A, B, ... Z, AA, AB, ..."""
    return ("" if k < 26 else _format_letter(k // 26 - 1)) + chr(ord("A") + k % 26)


def _rank_postures(
    linkage: Linkage, u: np.ndarray, hints: np.ndarray, best: float
) -> list[tuple[float, ...]]:
    """By posture, what sorts the better one first."""
    sigma = linkage.loops.compute_singularity_distance(u)
    is_leg_joint = np.array([joint.name not in linkage.robot.platform for joint in linkage.free])
    counted = linkage.is_travel & linkage.is_tied & is_leg_joint
    negative = np.sum((u < -1e-9 * linkage.loops.size) & counted, axis=1)
    angles = np.sum(np.abs(np.where(linkage.is_travel, 0.0, u)), axis=1)
    digits = THRESHOLDS.rank_key_digits
    columns = np.column_stack(
        [
            np.round(linkage.compute_limit_excess(u), digits),
            sigma < THRESHOLDS.min_singularity_share * best,
            np.round(np.sum(linkage.compute_distances(u, hints), axis=1), digits),
            negative,
            np.round(np.log2(best / sigma)),
            np.round(angles, digits),
            -np.round(u, digits),  # mirrored: the positive one first
        ]
    )
    return [tuple(line) for line in columns.tolist()]


def _insert_ratios(key: tuple[float, ...], ties: int) -> tuple[float, ...]:
    return (*key[:_BEFORE_TIES], -ties, *key[_BEFORE_TIES:])


def _select_reference_posture(linkage: Linkage, u: np.ndarray, hints: np.ndarray) -> np.ndarray:
    """(u,) the closed posture at whose actuated joints the modes are compared: the best one.

    Ties take long to count: they are for the best postures, and some others down to the worst.
    """
    best = float(np.max(linkage.loops.compute_singularity_distance(u)))
    keys = _rank_postures(linkage, u, hints, best)
    order = sorted((k for k, key in enumerate(keys) if not key[1]), key=keys.__getitem__)
    spread = np.linspace(0, len(order) - 1, THRESHOLDS.counted_postures).astype(int)
    first = range(min(THRESHOLDS.counted_postures, len(order)))
    some = [order[k] for k in sorted({*first, *spread.tolist()})]
    ties = count_constant_ratios(linkage, u[some])
    ranked = zip(some, ties, strict=True)
    return u[min(ranked, key=lambda one: _insert_ratios(keys[one[0]], one[1]))[0]]


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
        posed = find_closed_postures(linkage, u, every[~held & linkage.is_tied])
        around = _discard_singular(linkage, posed, hints)
        if not len(around):
            continue
        around = reset_uncoupled_joints(linkage, around, meant)
        place = _select_reference_posture(linkage, around, hints)
        tied = every[~held & linkage.is_tied & np.isin(every, actuated)]
        place = _round_actuated_joints(linkage, place, tied)
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
    regular = linkage.loops.compute_singularity_distance(u) > THRESHOLDS.min_singular_value
    return flip_negative_travels(linkage, u[regular], hints)


def _round_actuated_joints(linkage: Linkage, u: np.ndarray, places: np.ndarray) -> np.ndarray:
    """The posture with actuated joints at short numbers, as short as leaves it where it is."""
    before = float(linkage.loops.compute_singularity_distance(u[None])[0])
    unit = np.where(linkage.is_travel, 10.0 ** np.floor(np.log10(linkage.loops.size)), 1.0)
    for step in THRESHOLDS.rounding_steps:
        trial = u.copy()
        pairs = zip(u[places], unit[places], strict=True)
        trial[places] = [float(f"{round(x / (step * one)) * step * one:.10g}") for x, one in pairs]
        closed = linkage.loops.close_loops(trial[None])
        if np.all(np.isfinite(closed)) and linkage.loops.are_aligned(closed)[0]:
            near = np.max(linkage.compute_distances(closed, u)) < 5 * step
            if near and linkage.loops.compute_singularity_distance(closed)[0] > 0.5 * before:
                return closed[0]
    return u


def describe_free_motions(linkage: Linkage, u: np.ndarray) -> list[str]:
    """Describes the motions that a singular posture leaves free: `q11 : q12 : qP = 1 : -0.5 : 0.3`.

    Travels count in sizes of the robot. Joints that move little are left out.

    Args:
        linkage: the robot.
        u: (u,) closed posture.
    """
    names = [f"q{linkage.free[k].name}" for k in linkage.loops.solved]
    _, values, turned = np.linalg.svd(linkage.loops.compute_passive_jacobian(u[None])[0])
    descriptions = []
    for motion in turned[values <= THRESHOLDS.min_singular_value]:
        motion = motion / motion[np.argmax(np.abs(motion) > (1 - 1e-6) * np.max(np.abs(motion)))]
        moved = [k for k, share in enumerate(motion) if abs(share) > THRESHOLDS.min_motion_share]
        who = " : ".join(names[k] for k in moved)
        descriptions.append(who + " = " + " : ".join(f"{motion[k]:.2g}" for k in moved))
    return descriptions


@dataclass(frozen=True)
class HomeModes(Result):
    """The assembly modes of a robot, and which of them its file means.

    Attributes:
        linkage: the robot.
        modes: the best first; at least one.
        own: place among them of the posture that the file means as it stands; None if [home] is
            missing or poor, so that the first is taken.
    """

    linkage: Linkage
    modes: tuple[AssemblyMode, ...]
    stated_index: int | None


@dataclass(frozen=True)
class ClosedHome:
    """A robot with a [home] from which its loops close.

    Attributes:
        robot: with its home; the robot itself where that was good as it stood.
        told: one line on what was found or moved; "" where nothing was.
    """

    robot: Robot
    message: str = ""

    def write_to_text(self, robot: Robot) -> Robot:
        """Returns the robot whose file's text states the home too, for model files."""
        if not self.message:
            return robot
        from modeler.robot import replace_home  # most states are written to none

        try:
            text = replace_home(robot.text, robot.home, self.robot.home)
        except RobotError:  # it is found again, the same
            return self.robot
        return parse_robot_text(text, f"{robot.name} with its [home]")


def resolve_home(model: SymbolicModel) -> ClosedHome:
    """Returns the robot with a [home] from which its loops close and that is not singular.

    A home stays as it is if the passive joints close the loops near it: none moves further than
    `max_home_move`, rows left out counting as 0, and the posture is not singular. Else the assembly
    modes are searched, and the best one near to what is stated is taken.

    Raises:
        LoopError: the posture stated is singular, the loops leave more or less free than is
            actuated, or cannot close.
    """
    robot, linkage = model.robot, build_linkage(model)
    if linkage is None:
        return ClosedHome(robot)
    stated = linkage.build_vector(robot.home)
    if _close_stated_home(linkage, stated) is not None:
        return ClosedHome(robot)
    start = np.nan_to_num(stated)
    check_mobility(linkage.loops, start, linkage.geometry, linkage.owners)
    modes = find_assembly_modes(linkage, stated)
    posture = find_nearest_closed(linkage.loops, start)
    if (
        posture is not None
        and linkage.loops.compute_singularity_distance(posture[None])[0]
        <= THRESHOLDS.min_singular_value
    ):
        # Meant, if all actuated joints on which the loops depend are stated.
        loop_joints = [k for k in linkage.loops.actuated if linkage.is_tied[k]]
        if np.all(np.isfinite(stated[loop_joints])):
            raise LoopError(_describe_singularity(linkage, posture, modes))
    if not modes:
        raise _build_closure_error(linkage, start)
    home = express_as_home(linkage, modes[0].posture)
    return ClosedHome(dataclasses.replace(robot, home=home), _describe_home(linkage, modes, stated))


def find_modes_near(robot: Robot, near: Mapping[str, float]) -> HomeModes:
    """Returns the assembly modes of a robot with loops, the best one near a posture first.

    Args:
        robot: as read.
        near: values that are meant, by row; what is left out is found.

    Raises:
        DerivationError: an entry of the table has no exact value.
        LoopError: the robot has no loops that are left to close, they leave more or less free than
            is actuated, or no closed posture is found that is not singular.
    """
    linkage = build_linkage(_build_model(robot))
    if linkage is None:
        raise LoopError(
            f"{robot.name}: there is no loop to close; [home] applies to robots with [loops] "
            "that no relations close already"
        )
    hints = linkage.build_vector(near)
    start = np.nan_to_num(hints)
    check_mobility(linkage.loops, start, linkage.geometry, linkage.owners)
    stated_posture = _close_stated_home(linkage, linkage.build_vector(robot.home))
    if stated_posture is not None and not near:  # [home] is left out where all joints at 0 will do
        hints[list(linkage.loops.actuated)] = stated_posture[list(linkage.loops.actuated)]
    modes = find_assembly_modes(linkage, hints)
    if not modes:
        raise _build_closure_error(linkage, np.nan_to_num(hints))
    if stated_posture is None:
        return HomeModes(linkage, modes, None)
    shapes = linkage.compute_shape(np.array([stated_posture, *(mode.posture for mode in modes)]))
    away = np.max(np.abs(shapes[1:] - shapes[0]), axis=1)
    at = int(np.argmin(away))
    return HomeModes(linkage, modes, at if away[at] < THRESHOLDS.stated_shape else None)


def _build_closure_error(linkage: Linkage, start: np.ndarray) -> LoopError:
    reason = describe_open_loop(linkage.loops, start, linkage.owners)
    return LoopError(
        f"{linkage.robot.name}: [home]: {reason}, nor from "
        f"{THRESHOLDS.assembly_starts} others without being singular; check the "
        "lengths, and the joints of [loops]"
    )


def express_as_home(linkage: Linkage, u: np.ndarray) -> dict[str, float]:
    """Returns a posture as [home] states it: actuated joints exact, the others to 1e-6.

    Rows that follow others are stated where they were before.
    """
    robot, actuated = linkage.robot, linkage.loops.actuated
    home = {
        joint.name: float(u[k]) if k in actuated else round(float(u[k]), 6) + 0.0
        for k, joint in enumerate(linkage.free)
    }
    values = {**robot.evaluate_symbols(), **{f"q{name}": value for name, value in home.items()}}
    left = dict(robot.relations)
    while left:  # there are no circles
        for name in [n for n, relation in left.items() if relation.names <= values.keys()]:
            values[f"q{name}"] = left.pop(name).evaluate(values)
    stated = {name: values[f"q{name}"] for name in robot.relations if name in robot.home}
    return {**home, **stated}


def _close_stated_home(linkage: Linkage, stated: np.ndarray) -> np.ndarray | None:
    """The closed posture that was stated, rows left out at 0; None if it is no good one."""
    posture = find_nearest_closed(linkage.loops, np.nan_to_num(stated))
    if (
        posture is None
        or linkage.loops.compute_singularity_distance(posture[None])[0]
        <= THRESHOLDS.min_singular_value
    ):
        return None
    moved = linkage.compute_distances(posture[None], np.nan_to_num(stated))
    turned = flip_negative_travels(linkage, posture[None], stated)
    stays = np.max(moved) <= THRESHOLDS.max_home_move and np.array_equal(turned[0], posture)
    return posture if stays else None


def _describe_home(linkage: Linkage, modes: tuple[AssemblyMode, ...], stated: np.ndarray) -> str:
    robot, posture = linkage.robot, modes[0].posture
    others = f"{len(modes)} assembly modes: `modeler home` shows them, --write writes one down"
    if len(modes) == 1:
        others = "the only assembly mode found; `modeler home --write` writes it down"
    if not modes[0].is_within_limits:
        others += "; it is outside [limits], which none keeps there: check the lengths"
    if not np.any(np.isfinite(stated)):
        actuated = linkage.loops.actuated
        values = _format_values(linkage, posture, actuated)
        return f"{robot.name}: [home] found: mode A at {values}; {others}"
    moved = linkage.compute_distances(posture[None], stated)[0]
    far = [k for k in np.argsort(-moved, kind="stable") if moved[k] > 0.01]
    change = ", ".join(
        f"q{linkage.free[k].name} {stated[k]:.4g} -> {posture[k]:.4g}"
        for k in far[: THRESHOLDS.listed_moves]
    )
    change = f"moved {change}" if far else "what it leaves out was found"
    return f"{robot.name}: [home] completed: {change}; mode A of {others}"


def _format_values(linkage: Linkage, u: np.ndarray, places: tuple[int, ...] | range) -> str:
    return ", ".join(f"q{linkage.free[k].name} = {float(f'{u[k]:.5g}') + 0.0:g}" for k in places)


def _describe_singularity(linkage: Linkage, u: np.ndarray, modes: tuple[AssemblyMode, ...]) -> str:
    names = [f"q{joint.name}" for joint in linkage.free]
    motions = describe_free_motions(linkage, u)
    lost = [name for name in names if any(name in m.split(" = ")[0].split(" : ") for m in motions)]
    away = linkage.loops.compute_singularity_distance(u[None])[0]
    advice = "state another posture"
    if modes:
        advice += f", such as {_format_values(linkage, modes[0].posture, range(len(names)))}"
    joints = ", ".join(name[1:] for name in lost)
    return (
        f"{linkage.robot.name}: the loops are singular at [home]: joint"
        f"{'s' if len(lost) > 1 else ''} {joints} could move there with the actuated joints "
        f"locked ({'; '.join(motions)}; singular value {away:.1e}); {advice}"
    )


def complete_home(robot: Robot) -> ClosedHome:
    """Returns the robot with a [home] from which its loops close, found where it is missing.

    Raises:
        DerivationError: an entry of the table has no exact value.
        LoopError: see `resolve_home`.
    """
    return resolve_home(_build_model(robot))


def _build_model(robot: Robot) -> SymbolicModel:
    try:
        geometry = build_exact_geometry(robot)
    except DerivationError as error:
        raise DerivationError(f"{robot.name}: {error}") from None
    return SymbolicModel(robot, geometry, Graph(), build_standard_columns(geometry))
