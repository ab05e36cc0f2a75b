"""Links as capsules: how near they come to each other and to planes along a motion."""

import dataclasses
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from modeler.core.brief import ShortRepr
from modeler.excitation.thresholds import THRESHOLDS
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
        """The middle radius of capsules, m."""
        return float(np.median(self.radius[: len(self.ends)]))

    def get_pair_names(self, pair: int) -> tuple[str, str]:
        """The names of a pair."""
        one, other = self.pairs[pair]
        return self.names[one], self.names[other]

    def select_frames(self, poses: np.ndarray) -> np.ndarray:
        """(n, k + m, 3, 4) of the carriers, of poses (n, rows, 3, 4)."""
        still = np.eye(3, 4)[None, None].repeat(len(poses), axis=0)
        return np.concatenate([poses, still], axis=1)[:, self.carriers]

    def place_capsules(self, poses: np.ndarray) -> np.ndarray:
        """(n, k, 2, 3) ends in frame 0, of poses (n, rows, 3, 4)."""
        capsule_frames = self.select_frames(poses)[:, : len(self.ends)]
        return (
            np.einsum("nkab,ksb->nksa", capsule_frames[..., :3], self.ends)
            + capsule_frames[:, :, None, :, 3]
        )

    def compute_distances(self, ends: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """(n, p) m, below 0 where two meet, and (n, p, 2, 3) the nearest points of axes and planes.

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
    """(..., 2, 3) where two segments, (..., 2, 3) ends each, come nearest to each other.

    Ericson 2005, Real-Time Collision Detection, section 5.1.9.
    """
    d, e, r = one[..., 1, :] - one[..., 0, :], other[..., 1, :] - other[..., 0, :], one - other
    r = r[..., 0, :]
    dd, ee, de, dr, er = (
        np.sum(a * b, axis=-1) for a, b in ((d, d), (e, e), (d, e), (d, r), (e, r))
    )
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

    def to_json(self) -> dict[str, Any]:
        """Plain data."""
        return {
            "pair": list(self.pair),
            "distance": self.distance,
            "bound": self.bound,
            "time": self.time,
            "posture": dict(self.posture),
            "points": self.points.tolist(),
        }


@dataclass(frozen=True, eq=False)
class Clearance(ShortRepr):
    """What links must keep from each other.

    Attributes:
        solids: of the robot, without pairs that are left out.
        margin: least distance, m.
        left_out: pairs that are not looked at, and why.
    """

    solids: CollisionGeometry
    margin: float
    left_out: tuple[tuple[str, str, str], ...] = ()

    def format_line(self, near: ClosestApproach | None) -> str:
        """What a motion keeps of it, as a sentence."""
        out = ", ".join(f"{a} and {b} ({why})" for a, b, why in self.left_out)
        excluded_text = f"; not looked at: {out}" if out else ""
        if near is None:
            return f"no two links or planes are looked at{excluded_text}"
        return (
            f"nearest are {near.pair[0]} and {near.pair[1]}, {1e3 * near.distance:.1f} mm apart at "
            f"{near.time:.4g} s; at no time, between samples too, are any two nearer than "
            f"{1e3 * near.bound:.1f} mm, of {1e3 * self.margin:g} mm asked for{excluded_text}"
        )

    def to_json(self, near: ClosestApproach | None) -> dict[str, Any]:
        """Plain data."""
        return {
            "margin": self.margin,
            "left_out": [list(each) for each in self.left_out],
            "nearest": None if near is None else near.to_json(),
        }

    def compute_shares(self, compiled: CompiledModel, q: np.ndarray) -> np.ndarray:
        """(n, pairs) exp((margin - distance) / middle radius): below 1 where they are far apart."""
        ends = self.solids.place_capsules(compiled.forward_kinematics(q))
        return np.exp(
            (self.margin - self.solids.compute_distances(ends)[0]) / self.solids.median_radius
        )

    def pull_back_gradient(
        self, compiled: CompiledModel, q: np.ndarray, pull: np.ndarray, steps: np.ndarray
    ) -> np.ndarray:
        """(n, J) derivative by q of a number whose derivative by `compute_shares` is `pull`.

        For distances above 0. Nearest points are taken as fixed on their links: by how little they
        slide, the distance does not change. The links' motion is by central differences of `steps`
        (J,).
        """
        solids, poses = self.solids, compiled.forward_kinematics(q)
        gaps, points = solids.compute_distances(solids.place_capsules(poses))
        apart = points[:, :, 0] - points[:, :, 1]
        length = np.linalg.norm(apart, axis=2)
        share = np.exp((self.margin - gaps) / self.solids.median_radius)
        push = (-pull * share / self.solids.median_radius / np.maximum(length, 1e-12))[
            ..., None
        ] * apart
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
            moved = compiled.forward_kinematics(q + displacement) - compiled.forward_kinematics(
                q - displacement
            )
            slope[:, j] = np.einsum("nrab,nrab->n", moments, moved) / (2.0 * step)
        return slope


def exclude_neighbours(
    compiled: CompiledModel,
    solids: CollisionGeometry,
    margin: float,
    ranges: np.ndarray,
    home: np.ndarray | None,
) -> Clearance:
    """A clearance without the pairs that no motion can keep apart.

    These are nearer than `margin` in 95 % of 500 postures that close or, where loops are closed
    from home, at home.

    Args:
        compiled: the robot.
        solids: all pairs of links that share no joint.
        margin: m.
        ranges: (2, J) lower and upper limits, in which postures are drawn.
        home: (J,) of a robot with loops.
    """
    q = np.random.default_rng(0).uniform(
        ranges[0], ranges[1], (THRESHOLDS.contact_postures, ranges.shape[1])
    )
    q = np.vstack([q[compiled.closing_status(q) == 0], *([] if home is None else [home])])
    near = Clearance(solids, margin).compute_shares(compiled, q) > 1.0
    often, at_home = near.mean(axis=0), near[-1] & (home is not None)
    out = at_home | (often > THRESHOLDS.max_contact_share)
    reasons = {
        solids.get_pair_names(int(k)): "at home"
        if at_home[k]
        else f"in {100.0 * often[k]:.0f} % of postures"
        for k in np.flatnonzero(out)
    }
    checked_solids = dataclasses.replace(solids, pairs=solids.pairs[~out])
    return Clearance(checked_solids, margin, tuple((*pair, why) for pair, why in reasons.items()))


# A whole motion, also between its samples.


def find_closest_approach(
    compiled: CompiledModel,
    solids: CollisionGeometry,
    path: Callable[[np.ndarray], np.ndarray],
    duration: float,
    samples: int = THRESHOLDS.clearance_samples,
) -> ClosestApproach:
    """The least distance along a motion, by intervals that are halved where it may lie.

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
            bend = (
                2.0
                * np.linalg.norm(np.diff(relative_ends, 2, axis=0), axis=3).max(axis=(0, 2))
                / h[0] ** 2
            )
        travel = np.linalg.norm(np.diff(relative_ends, axis=0), axis=3).max(axis=2)
        low = 0.5 * (gaps[1:] + gaps[:-1] - travel) - bend * h[:, None] ** 2 / 8.0
        near = low.min(axis=1) < gaps.min() - THRESHOLDS.clearance_tolerance * solids.median_radius
        if not near.any() or len(times) > THRESHOLDS.max_clearance_samples:
            break
        times = np.sort(np.append(times, times[:-1][near] + 0.5 * h[near]))
    row, pair = (int(k) for k in np.unravel_index(np.argmin(gaps), gaps.shape))
    direction = points[row, pair, 1] - points[row, pair, 0]
    direction = direction / max(float(np.linalg.norm(direction)), 1e-12)
    surface = points[row, pair] + np.outer(
        [1.0, -1.0] * solids.radius[solids.pairs[pair]], direction
    )
    closure = compiled.spec.closure
    names = [j.name for j in compiled.spec.joints] if closure is None else closure.variables
    posture = dict(zip(names, compiled.close(q[row : row + 1])[0].tolist(), strict=True))
    least = float(gaps[row, pair])
    return ClosestApproach(
        solids.get_pair_names(pair),
        least,
        min(least, float(low.min())),
        float(at[row]),
        posture,
        surface,
    )
