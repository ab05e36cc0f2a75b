"""Limits of a motion: ranges, boxes, loops, distances of links, and motions that exceed them."""

import dataclasses
import math
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from modeler.core.errors import DataError, LoopError
from modeler.core.json import Document, ShortRepr
from modeler.excitation.thresholds import THRESHOLDS

if TYPE_CHECKING:
    from modeler.runtime import CompiledModel

BASE = -1
"""Carrier of what stands still."""


@dataclass(frozen=True, eq=False)
class CollisionGeometry(ShortRepr):
    """A robot and its surroundings: k capsules, and after them planes.

    Attributes:
        names: of the link of each capsule, then of the planes.
        carriers: places of their rows, as `forward_kinematics` has them; `BASE`.
        ends: (k, 2, 3) of the axes of capsules, in the frames of these rows, m.
        radius: m; 0 of planes.
        normals, offsets: (m, 3) and (m,) of planes: `normal x > offset` is free.
        pairs: (p, 2) that must not meet, the capsule first.
    """

    names: tuple[str, ...]
    carriers: np.ndarray
    ends: np.ndarray
    radius: np.ndarray
    normals: np.ndarray
    offsets: np.ndarray
    pairs: np.ndarray

    @property
    def median_radius(self) -> float:
        """Returns the median radius of capsules, m."""
        return float(np.median(self.radius[: len(self.ends)]))

    def get_pair_names(self, pair: int) -> tuple[str, str]:
        """Returns the names of a pair."""
        one, other = self.pairs[pair]
        return self.names[one], self.names[other]

    def select_frames(self, poses: np.ndarray) -> np.ndarray:
        """Selects the frames of the carriers, (n, k + m, 3, 4), of poses (n, rows, 3, 4)."""
        still = np.eye(3, 4)[None, None].repeat(len(poses), axis=0)
        return np.concatenate([poses, still], axis=1)[:, self.carriers]

    def place_capsules(self, poses: np.ndarray) -> np.ndarray:
        """Places the ends in frame 0, (n, k, 2, 3), of poses (n, rows, 3, 4)."""
        capsule_frames = self.select_frames(poses)[:, : len(self.ends)]
        turned = np.einsum("nkab,ksb->nksa", capsule_frames[..., :3], self.ends)
        return turned + capsule_frames[:, :, None, :, 3]

    def compute_distances(self, ends: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Computes distances (n, p), m, and nearest points of axes and planes (n, p, 2, 3).

        Args:
            ends: (n, k, 2, 3) of `place_capsules`.
        """
        k, (one, other) = len(self.ends), self.pairs.T
        flat = other >= k
        points = np.zeros((len(ends), len(self.pairs), 2, 3))
        points[:, ~flat] = find_nearest_points(ends[:, one[~flat]], ends[:, other[~flat]])
        gaps = np.linalg.norm(points[:, :, 0] - points[:, :, 1], axis=2)
        tips, normals = ends[:, one[flat]], self.normals[other[flat] - k]
        heights = np.einsum("nmsa,ma->nms", tips, normals) - self.offsets[other[flat] - k, None]
        low = heights.argmin(axis=2)[:, :, None]
        gaps[:, flat] = np.take_along_axis(heights, low, 2)[:, :, 0]
        tip = np.take_along_axis(tips, low[..., None], 2)[:, :, 0]
        points[:, flat] = np.stack([tip, tip - gaps[:, flat, None] * normals], axis=2)
        return gaps - self.radius[self.pairs].sum(axis=1), points


def find_nearest_points(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Finds where two segments, (..., 2, 3) ends each, come nearest, (..., 2, 3).

    Ericson 2005, Real-Time Collision Detection, section 5.1.9.
    """
    d, e, r = one[..., 1, :] - one[..., 0, :], other[..., 1, :] - other[..., 0, :], one - other
    r = r[..., 0, :]
    pairs = ((d, d), (e, e), (d, e), (d, r), (e, r))
    dd, ee, de, dr, er = (np.sum(a * b, axis=-1) for a, b in pairs)
    s = np.clip(_compute_ratio(de * er - dr * ee, dd * ee - de**2, 1e-12 * dd * ee), 0.0, 1.0)
    t = np.clip(_compute_ratio(de * s + er, ee), 0.0, 1.0)
    s = np.clip(_compute_ratio(de * t - dr, dd), 0.0, 1.0)
    return np.stack([one[..., 0, :] + s[..., None] * d, other[..., 0, :] + t[..., None] * e], -2)


def _compute_ratio(a: np.ndarray, b: np.ndarray, least: np.ndarray | float = 0.0) -> np.ndarray:
    """a / b; 0 where b is no more than `least`."""
    return np.divide(a, b, out=np.zeros_like(a), where=b > least)


@dataclass(frozen=True, eq=False)
class ClosestApproach(ShortRepr):
    """Where a motion brings two closest to each other.

    Attributes:
        pair: names of links, or of a link and a plane.
        distance: least one that was seen, m; below 0 they overlap.
        bound: no distance is smaller at any time, m.
        time: of it, s.
        posture: free joint variables there, by joint, those that follow too.
        points: (2, 3) nearest points of both surfaces, in frame 0.
    """

    pair: tuple[str, str]
    distance: float
    bound: float
    time: float
    posture: Mapping[str, float]
    points: np.ndarray


@dataclass(frozen=True, eq=False)
class Clearance(ShortRepr):
    """What links must keep from each other.

    Attributes:
        solids: of the robot, without pairs that are left out.
        margin: least distance, m.
        excluded_pairs: pairs that are not looked at, and why.
    """

    solids: CollisionGeometry
    margin: float
    excluded_pairs: tuple[tuple[str, str, str], ...] = ()

    def format_line(self, near: ClosestApproach | None) -> str:
        """Formats what a motion keeps of it."""
        out = ", ".join(f"{a} and {b} ({why})" for a, b, why in self.excluded_pairs)
        excluded_text = f"; not looked at: {out}" if out else ""
        if near is None:
            return f"no two links or planes are looked at{excluded_text}"
        return (
            f"nearest are {near.pair[0]} and {near.pair[1]}, {1e3 * near.distance:.1f} mm apart at "
            f"{near.time:.4g} s; at no time, between samples too, are any two nearer than "
            f"{1e3 * near.bound:.1f} mm, of {1e3 * self.margin:g} mm requested{excluded_text}"
        )

    def compute_shares(self, compiled: "CompiledModel", q: np.ndarray) -> np.ndarray:
        """Computes exp((margin - distance) / median radius), (n, pairs): < 1 where far apart."""
        ends = self.solids.place_capsules(compiled.forward_kinematics(q))
        gaps = self.solids.compute_distances(ends)[0]
        return np.exp((self.margin - gaps) / self.solids.median_radius)

    def pull_back_gradient(
        self, compiled: "CompiledModel", q: np.ndarray, pull: np.ndarray, steps: np.ndarray
    ) -> np.ndarray:
        """Computes the derivative by q, (n, J), of a number with derivative `pull` by the shares.

        For distances above 0. Nearest points are taken as fixed on their links: by how little they
        slide, the distance does not change. The links' motion is by central differences of `steps`
        (J,).
        """
        solids, poses = self.solids, compiled.forward_kinematics(q)
        gaps, points = solids.compute_distances(solids.place_capsules(poses))
        apart = points[:, :, 0] - points[:, :, 1]
        length = np.linalg.norm(apart, axis=2)
        share = np.exp((self.margin - gaps) / self.solids.median_radius)
        push = -pull * share / self.solids.median_radius / np.maximum(length, 1e-12)
        push = push[..., None] * apart
        moments = np.zeros(poses.shape)
        for column, side in np.ndindex(solids.pairs.shape):
            carrier = solids.carriers[solids.pairs[column, side]]
            if carrier == BASE:
                continue
            R, p = poses[:, carrier, :, :3], poses[:, carrier, :, 3]
            at = np.ones((len(q), 1, 4))
            at[:, 0, :3] = np.einsum("nba,nb->na", R, points[:, column, side] - p)
            moments[:, carrier] += (1.0 - 2.0 * side) * push[:, column, :, None] * at
        slope = np.empty_like(q)
        for j, step in enumerate(steps.tolist()):
            displacement = step * np.eye(len(steps))[j]
            ahead, behind = (compiled.forward_kinematics(q + s * displacement) for s in (1, -1))
            moved = ahead - behind
            slope[:, j] = np.einsum("nrab,nrab->n", moments, moved) / (2.0 * step)
        return slope


def exclude_neighbours(
    compiled: "CompiledModel",
    solids: CollisionGeometry,
    margin: float,
    ranges: np.ndarray,
    home: np.ndarray | None,
) -> Clearance:
    """Excludes the pairs that no motion can keep apart.

    These are nearer than `margin` in 95 % of 500 postures that close or, where loops are closed
    from home, at home.

    Args:
        compiled: the robot.
        solids: all pairs of links that share no joint.
        margin: m.
        ranges: (2, J) lower and upper limits, in which postures are drawn.
        home: (J,) of a robot with loops.
    """
    size = (THRESHOLDS.contact_postures, ranges.shape[1])
    q = np.random.default_rng(0).uniform(ranges[0], ranges[1], size)
    q = np.vstack([q[compiled.closing_status(q) == 0], *([] if home is None else [home])])
    near = Clearance(solids, margin).compute_shares(compiled, q) > 1.0
    often, at_home = near.mean(axis=0), near[-1] & (home is not None)
    out = at_home | (often > THRESHOLDS.max_contact_share)
    reasons = {}
    for k in map(int, np.flatnonzero(out)):
        share = f"in {100.0 * often[k]:.0f} % of postures"
        reasons[solids.get_pair_names(k)] = "at home" if at_home[k] else share
    checked_solids = dataclasses.replace(solids, pairs=solids.pairs[~out])
    return Clearance(checked_solids, margin, tuple((*pair, why) for pair, why in reasons.items()))


# A whole motion, also between its samples.


def find_closest_approach(
    compiled: "CompiledModel",
    solids: CollisionGeometry,
    path: Callable[[np.ndarray], np.ndarray],
    duration: float,
    samples: int = THRESHOLDS.clearance_samples,
) -> ClosestApproach:
    """Finds the least distance along a motion, by halving intervals where it may lie.

    Seen from the other one, the ends of an axis leave their chords within an interval h by
    A h^2 / 8 at most, A twice the largest second difference of the samples. On the chords the
    distance d falls no faster than they travel: d >= (d_0 + d_1 - travel) / 2 - A h^2 / 8.

    Args:
        compiled: the robot.
        solids: its capsules.
        path: from times (n,) to positions (n, J).
        duration: s.
        samples: to begin with.
    """
    one, other = solids.pairs.T
    times, bend = np.linspace(0.0, duration, samples), np.zeros(0)
    for _ in range(THRESHOLDS.max_halvings):
        at, q = times, path(times)
        poses = compiled.forward_kinematics(q)
        ends, frames = solids.place_capsules(poses), solids.select_frames(poses)[:, other]
        gaps, points = solids.compute_distances(ends)
        away = ends[:, one] - frames[:, :, None, :, 3]
        relative_ends = np.einsum("npba,npsb->npsa", frames[..., :3], away)
        h = np.diff(times)
        if not bend.size:
            second = np.linalg.norm(np.diff(relative_ends, 2, axis=0), axis=3)
            bend = 2.0 * second.max(axis=(0, 2)) / h[0] ** 2
        travel = np.linalg.norm(np.diff(relative_ends, axis=0), axis=3).max(axis=2)
        low = 0.5 * (gaps[1:] + gaps[:-1] - travel) - bend * h[:, None] ** 2 / 8.0
        near = low.min(axis=1) < gaps.min() - THRESHOLDS.clearance_tolerance * solids.median_radius
        if not near.any() or len(times) > THRESHOLDS.max_clearance_samples:
            break
        times = np.sort(np.append(times, times[:-1][near] + 0.5 * h[near]))
    row, pair = (int(k) for k in np.unravel_index(np.argmin(gaps), gaps.shape))
    direction = points[row, pair, 1] - points[row, pair, 0]
    direction = direction / max(float(np.linalg.norm(direction)), 1e-12)
    radii = [1.0, -1.0] * solids.radius[solids.pairs[pair]]
    surface = points[row, pair] + np.outer(radii, direction)
    closure = compiled.spec.closure
    names = [j.name for j in compiled.spec.joints] if closure is None else closure.variables
    posture = dict(zip(names, compiled.close(q[row : row + 1])[0].tolist(), strict=True))
    least = float(gaps[row, pair])
    names, bound = solids.get_pair_names(pair), min(least, float(low.min()))
    return ClosestApproach(names, least, bound, float(at[row]), posture, surface)


@dataclass(frozen=True)
class Box:
    """Where the origin of a frame must stay, in frame 0.

    Attributes:
        frame: name of a moving row.
        row: its place among the moving rows, as `forward_kinematics` has them.
        lower, upper: x, y, z in m.
    """

    frame: str
    row: int
    lower: tuple[float, float, float]
    upper: tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class MotionBounds(ShortRepr):
    """Limits of a motion, in the order of the manifest's joints, SI units.

    Attributes:
        joints: names.
        lower, upper: (J,) positions.
        speed, acceleration: (J,) largest ones.
        torque: (J,) largest ones, infinite where there is none.
        boxes: of frames.
        passive: places in u of joints that follow, with their lower and upper limits.
        home: (J,) where loops are closed from; None without loops.
        clearance: what links keep from each other; None: it is not looked at.
        assumed: joints of which nobody has stated limits.
    """

    joints: tuple[str, ...]
    lower: np.ndarray
    upper: np.ndarray
    speed: np.ndarray
    acceleration: np.ndarray
    torque: np.ndarray
    boxes: tuple[Box, ...] = ()
    passive: tuple[tuple[int, float, float], ...] = ()
    home: np.ndarray | None = None
    clearance: Clearance | None = None
    assumed: tuple[str, ...] = ()

    @property
    def mid_range(self) -> np.ndarray:
        """Returns the middle of the ranges, (J,)."""
        return 0.5 * (self.lower + self.upper)

    @property
    def half_range(self) -> np.ndarray:
        """Returns half of the ranges, (J,)."""
        return 0.5 * (self.upper - self.lower)


def check_bounds(bounds: MotionBounds) -> None:
    """Checks that some motion may keep to them.

    Raises:
        DataError: names the joint, what was got and what is expected.
    """
    for j, joint in enumerate(bounds.joints):
        where = f"limits of joint {joint}"
        lower, upper = float(bounds.lower[j]), float(bounds.upper[j])
        if not (math.isfinite(lower) and math.isfinite(upper) and lower < upper):
            raise DataError(
                f"{where}: got lower {lower:g}, upper {upper:g}; expected two finite numbers, "
                "lower < upper"
            )
        for what in ("speed", "acceleration", "torque"):
            value = float(getattr(bounds, what)[j])
            if not value > 0.0 or (what != "torque" and not math.isfinite(value)):
                raise DataError(
                    f"{where}: got {what} {value:g}; expected a number above 0: a joint that may "
                    "not move excites nothing"
                )
        if bounds.home is not None and not lower <= bounds.home[j] <= upper:
            raise DataError(
                f"{where}: [home] {bounds.home[j]:g} is outside of {lower:g} to {upper:g}; loops "
                "are closed from home; expected limits around it"
            )
    for box in bounds.boxes:
        if any(not low < high for low, high in zip(box.lower, box.upper, strict=True)):
            ends = (", ".join(f"{value:g}" for value in end) for end in (box.lower, box.upper))
            raise DataError(
                f"box of frame {box.frame}: got ({') to ('.join(ends)}); expected x, y and z each "
                "lower < upper, in m"
            )


@dataclass(frozen=True, eq=False)
class PostureLimits:
    """Shares of limits that hang on the positions alone.

    Loops stay away from singular postures by G of ud = G qd: near one, joints that follow are
    infinitely fast. Rows of G are taken together by unit, motors weighed by their ranges.

    Attributes:
        compiled: the robot.
        bounds: limits.
        kinds: (rows,) places of u by unit, those that follow.
        fastest: of the same groups, the size of G that counts as the limit.
    """

    compiled: "CompiledModel"
    bounds: MotionBounds
    kinds: tuple[np.ndarray, ...] = ()
    fastest: tuple[float, ...] = ()

    def compute_shares(self, q: np.ndarray) -> np.ndarray:
        """Computes numbers (n, r) that must stay between -1 and 1.

        Raises:
            LoopError: a posture does not close.
        """
        parts = [self.compute_stated_shares(q)]
        if self.bounds.clearance is not None:
            parts.append(self.bounds.clearance.compute_shares(self.compiled, q))
        return np.hstack(parts)

    def compute_stated_shares(self, q: np.ndarray) -> np.ndarray:
        """Computes the shares of the limits of loops, passive joints and boxes, (n, r)."""
        parts = []
        if self.kinds:
            parts.append(self.compute_coupling_sizes(q) / np.array(self.fastest))
        if self.bounds.passive:
            u = self.compiled.close(q)
            for place, lower, upper in self.bounds.passive:
                parts.append((2.0 * u[:, place, None] - lower - upper) / (upper - lower))
        if self.bounds.boxes:
            poses = self.compiled.forward_kinematics(q)
            for box in self.bounds.boxes:
                low, high = np.array(box.lower), np.array(box.upper)
                parts.append((2.0 * poses[:, box.row, :, 3] - low - high) / (high - low))
        return np.hstack(parts) if parts else np.zeros((len(q), 0))

    def compute_coupling_sizes(self, q: np.ndarray) -> np.ndarray:
        """Computes the sizes of G of the passive joints, (n, groups)."""
        G = self.compiled.coupling(q) * self.bounds.half_range
        sizes = [np.sum(G[:, places] ** 2, axis=(1, 2)) for places in self.kinds]
        return np.sqrt(np.column_stack(sizes))

    def pull_back_gradient(self, q: np.ndarray, pull: np.ndarray) -> np.ndarray:
        """Computes the derivative by q, (n, J), of one with derivative `pull` by the shares."""
        slope, clearance = np.zeros_like(q), self.bounds.clearance
        steps = THRESHOLDS.posture_step * self.bounds.half_range
        if clearance is not None:
            first = pull.shape[1] - len(clearance.solids.pairs)
            clearance_pull, pull = pull[:, first:], pull[:, :first]
            with suppress(LoopError):  # as below
                slope += clearance.pull_back_gradient(self.compiled, q, clearance_pull, steps)
        for j, size in enumerate(steps.tolist() if pull.shape[1] else ()):
            step = np.zeros(q.shape[1])
            step[j] = size
            try:
                change = self.compute_stated_shares(q + step) - self.compute_stated_shares(q - step)
            except LoopError:  # beyond the wall: the barrier has brought us as near as can be
                change = np.zeros_like(pull)
            slope[:, j] += np.sum(change * pull, axis=1) / (2.0 * size)
        return slope


def build_posture_limits(compiled: "CompiledModel", bounds: MotionBounds) -> PostureLimits:
    """Builds what the positions of a robot must keep to.

    Raises:
        DataError: home itself is outside.
    """
    closure = compiled.spec.closure
    plain = PostureLimits(compiled, bounds)
    if closure is None or bounds.home is None:
        return plain
    driven = set(closure.actuated)
    units = [(i, unit) for i, unit in enumerate(closure.units) if i not in driven]
    places = [np.array([i for i, unit in units if unit == kind]) for kind in ("rad", "m")]
    kinds = tuple(group for group in places if len(group))
    loops = PostureLimits(compiled, bounds, kinds, ())
    home = loops.compute_coupling_sizes(bounds.home[None, :])[0]
    limits = PostureLimits(compiled, bounds, kinds, tuple(THRESHOLDS.max_coupling_ratio * home))
    at_home = limits.compute_shares(bounds.home[None, :])
    if not np.abs(at_home).max(initial=0.0) < 1.0:
        raise DataError(
            f"{compiled.spec.robot}: [home] is outside of the boxes or of [limits] of joints that "
            "follow; expected limits around it"
        )
    return limits


@dataclass(frozen=True)
class ClearanceReport(Document):
    """What links keep from each other along a motion.

    Attributes:
        closest_approach: None where there are no two.
    """

    KEYS = "margin=clearance.margin excluded_pairs=clearance.excluded_pairs closest_approach"

    clearance: Clearance
    closest_approach: ClosestApproach | None


@dataclass(frozen=True)
class LimitExcess(ShortRepr, Document):
    """Where a joint exceeds a limit most.

    Attributes:
        joint: name.
        quantity: "position" | "speed" | "acceleration" | "speed at the start" | "speed at the end".
        time: s, from the first sample on.
        value, limit: SI.
        unit: of them.
        step: (rad or m, s) of the largest step between two samples there; None for others.
    """

    KEYS = "joint quantity time value limit unit"

    joint: str
    quantity: str
    time: float
    value: float
    limit: float
    unit: str
    step: tuple[float, float] | None = None

    def format_line(self) -> str:
        """Returns the excess over the limit as a sentence."""
        step = ""
        if self.step is not None:
            distance, seconds = self.step
            step = f" ({distance:.3g} {self.unit.partition('/')[0]} in {1e3 * seconds:.3g} ms)"
        expected = "expected rest" if "speed at" in self.quantity else f"limit {self.limit:.4g}"
        return (
            f"joint {self.joint}, {self.time:.4g} s: {self.quantity} {self.value:.4g} {self.unit}"
            f"{step}, {expected}"
        )


def find_exceeded_limits(
    bounds: MotionBounds,
    units: tuple[str, ...],
    time: np.ndarray,
    q: np.ndarray,
    stated: tuple[np.ndarray, np.ndarray] | None,
) -> list[LimitExcess]:
    """Finds where each joint exceeds each of its limits most, first by time.

    Mean speeds over a window, and their mean change, are never above the largest ones between. A
    motion that begins or ends faster than its acceleration reaches in a window is not at rest.

    Args:
        bounds: limits.
        units: (J,) "rad" or "m".
        time: (n,) s.
        q: (n, J).
        stated: speeds and accelerations (n, J) of the file; None: it has none.
    """
    step = float(np.median(np.diff(time)))
    k = min(math.ceil(THRESHOLDS.derivative_window / step), (len(time) - 1) // 2)
    digits = range(THRESHOLDS.max_file_digits)
    rounded = (10.0**-n for n in digits if np.allclose(q, q.round(n), 0.0, 1e-12))
    digit = next(rounded, 0.0)
    v = (q[k:] - q[:-k]) / (time[k:] - time[:-k])[:, None]
    a = 2.0 * (v[k:] - v[:-k]) / (time[2 * k :] - time[: -2 * k])[:, None]
    excesses, factor = [], 1.0 + THRESHOLDS.limit_tolerance

    def check_limit(
        what: str, at: np.ndarray, values: np.ndarray, most: np.ndarray, per: str, slack: float
    ) -> None:
        for j in np.flatnonzero(np.abs(values).max(axis=0) > factor * most + slack):
            i = int(np.abs(values[:, j]).argmax())
            place, step, value = at[i], None, float(values[i, j])
            if values is v:
                ways = np.abs(np.diff(q[i : i + k + 1, j]))
                m = i + int(ways.argmax())
                place, step = time[m + 1], (float(ways.max()), float(time[m + 1] - time[m]))
                value = math.copysign(step[0] / step[1], value)
            excess = float(place), value, float(most[j]), units[j] + per, step
            excesses.append(LimitExcess(bounds.joints[j], what, *excess))

    reach = bounds.half_range
    for j in np.flatnonzero((np.abs(q - bounds.mid_range) > factor * reach).any(axis=0)):
        i = int(np.abs(q[:, j] - bounds.mid_range[j]).argmax())
        limit = bounds.upper[j] if q[i, j] > bounds.mid_range[j] else bounds.lower[j]
        details = float(time[i]), float(q[i, j]), float(limit), units[j]
        excesses.append(LimitExcess(bounds.joints[j], "position", *details))
    speed, acceleration = bounds.speed, bounds.acceleration
    slacks = digit / (k * step), 2.0 * digit / (k * step) ** 2
    check_limit("speed", time[k:], v, speed, "/s", slacks[0])
    check_limit("acceleration", time[k:-k], a, acceleration, "/s2", slacks[1])
    if stated is not None:
        change = np.diff(stated[0], axis=0) / np.diff(time)[:, None]
        check_limit("speed", time, stated[0], speed, "/s", 0.0)
        check_limit("acceleration", time, stated[1], acceleration, "/s2", 0.0)
        check_limit("acceleration", time[1:], change, acceleration, "/s2", digit / step)
    for end, at, value in (("start", time[:1], v[:1]), ("end", time[-1:], v[-1:])):
        check_limit(f"speed at the {end}", at, value, acceleration * k * step, "/s", slacks[0])
    first = {(each.joint, each.quantity): each for each in reversed(excesses)}
    return sorted(first.values(), key=lambda each: each.time)
