"""Closed postures over the whole range that the actuated joints reach, by walking along the loops.

One step solves the linearised loops for the passive joints, J_s du_s = -f - J_q dq: prediction of
the motion dq and correction of what the step before left open, in one. A walker whose step leaves
the loops wide open, whose determinant of J_s changes sign or whose passive joints run away goes
back and takes another direction: it never passes to another assembly mode. Equations that follow
from the others near home count as open loops where they no longer do.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeler.core.json import ShortRepr
from modeler.derivation.closure import Frame, LoopEquations, derive_loop_equations, wrap_to_pi
from modeler.derivation.geometry import Geometry
from modeler.derivation.kinematics import compute_base_poses
from modeler.derivation.model import SymbolicModel
from modeler.derivation.thresholds import THRESHOLDS
from modeler.robot import Joint, Robot


@dataclass(frozen=True)
class Walk:
    """Closed postures, and how far they went.

    Attributes:
        postures: (samples, unknowns), home first; they come again where few are reached.
        distance: least singular value of J_s over the postures; rows of J scaled to usual length 1,
            travels counted in sizes of the robot. 0 is a singularity.
    """

    postures: np.ndarray
    distance: float


def _close_postures(loops: LoopEquations, u: np.ndarray) -> np.ndarray:
    """The postures, all but closed, closed to rounding; those that do not settle are left out.

    So are those that go far to close: near a singularity Newton may end in another assembly mode.
    """
    solved = list(loops.solved)
    start, u = u, u.copy()
    for _ in range(THRESHOLDS.closing_steps):
        u[:, solved] -= loops.solve_passive(u, loops.compute_residuals(u))
    left = loops.compute_openness(u)
    far = np.abs(u - start) / loops.scale
    is_closed = left < THRESHOLDS.closed_residual * loops.size
    return u[is_closed & (np.max(far, axis=1) < THRESHOLDS.max_walk_step)]


class _Walkers:
    """Walkers on their way, each to its own target."""

    def __init__(
        self, loops: LoopEquations, u: np.ndarray, ranges: np.ndarray, rng: np.random.Generator
    ) -> None:
        self.loops, self.rng, self.ranges = loops, rng, ranges
        self.scale = loops.scale
        self.actuated, self.solved = list(loops.actuated), list(loops.solved)
        self.u = self.before = self.home = u
        self.sign = self._linearise_loops(u)[2]
        self.pace = np.ones(len(u))
        self.target = self._draw_targets(len(u))

    def _draw_targets(self, count: int) -> np.ndarray:
        """Random positions of the actuated joints; about half of them at an end of the range."""
        low, high = self.ranges[self.actuated].T
        wide = self.rng.uniform(-0.5, 1.5, (count, len(self.actuated)))
        return np.asarray(low + np.clip(wide, 0.0, 1.0) * (high - low))

    def _linearise_loops(self, u: np.ndarray) -> tuple[np.ndarray, ...]:
        """Residuals, Jacobian with travels in sizes of the robot, sign of det J_s, openness."""
        f, openness, J = self.loops.linearise_loops(u)
        J = J * self.scale
        return f, J, np.linalg.slogdet(J[:, :, self.solved])[0], openness

    def advance_walkers(self) -> np.ndarray:
        """Advances every walker a step; returns the all but closed postures that were reached."""
        f, J, sign, openness = self._linearise_loops(self.u)
        lost = openness > THRESHOLDS.max_open_residual * self.loops.size
        (low, high), margin = self.ranges.T, THRESHOLDS.max_walk_step * self.scale
        outside = np.any((self.u < low - margin) | (self.u > high + margin), axis=1)
        lost |= (sign != self.sign) | outside
        self.pace = np.where(lost, self.pace / 4, np.minimum(1.0, 2 * self.pace))
        stuck = self.pace < THRESHOLDS.min_pace
        if np.any(lost):
            # From the edge of what is reached steps go astray: who is stuck starts again at home.
            back = np.where(stuck[:, None], self.home, self.before)
            self.u = np.where(lost[:, None], back, self.u)
            f[lost], J[lost], *_ = self._linearise_loops(self.u[lost])
        self._replace_targets(stuck)
        self.before = self.u
        self.u = self.u + self._compute_step(f, J)
        return self.before[~lost]

    def _replace_targets(self, stuck: np.ndarray) -> None:
        """Other targets for walkers that are stuck, and for those that have arrived."""
        left = np.abs(self.target - self.u[:, self.actuated]) / self.scale[self.actuated]
        done = stuck | np.all(left < 1e-9, axis=1)
        # Most joints stay: one at its end must not hold up the others.
        goes = self.rng.random((int(np.sum(done)), len(self.actuated)))
        most = goes.min(axis=1, keepdims=True, initial=1.0)
        stays = (goes > THRESHOLDS.moving_share) & (goes > most)
        here = self.u[done][:, self.actuated]
        self.target[done] = np.where(stays, here, self._draw_targets(len(here)))
        self.pace[done] = 0.25

    def _compute_step(self, f: np.ndarray, J: np.ndarray) -> np.ndarray:
        """dq towards the target, and the du_s that keeps the loops closed; in rad and m."""
        way = (self.target - self.u[:, self.actuated]) / self.scale[self.actuated]
        longest = np.max(np.abs(way), axis=1)
        most = THRESHOLDS.max_walk_step * self.pace / np.maximum(longest, 1e-300)
        dq = way * np.minimum(1.0, most)[:, None]
        along = np.einsum("nij,nj->ni", J[:, :, self.actuated], dq)
        both = np.stack([f, along], axis=2)
        back = -np.linalg.solve(J[:, :, self.solved], both)
        fastest = np.max(np.abs(back[:, :, 1]), axis=1)
        share = np.minimum(1.0, THRESHOLDS.max_walk_step / np.maximum(fastest, 1e-300))[:, None]
        step = np.zeros_like(self.u)
        step[:, self.actuated] = dq * share
        most = THRESHOLDS.max_walk_step
        step[:, self.solved] = np.clip(back[:, :, 0], -most, most) + back[:, :, 1] * share
        return step * self.scale


# The loops of a robot as functions of many postures at once, and what a posture looks like.


@dataclass(frozen=True)
class Linkage(ShortRepr):
    """A robot with loops, as arrays of postures u of its free joints.

    Attributes:
        robot: as read.
        geometry: its exact table.
        loops: the loop equations.
        owners: by equation, the loop that it comes from.
        frames: axes and origin of every row in frame 0, as expressions.
    """

    robot: Robot
    geometry: Geometry
    loops: LoopEquations
    owners: Sequence[str]
    frames: Sequence[Frame]

    @property
    def free(self) -> tuple[Joint, ...]:
        """Returns the rows whose variables are u."""
        return self.robot.free_joints

    @cached_property
    def is_travel(self) -> np.ndarray:
        """Returns for each variable True for a travel in m."""
        return np.array(self.loops.is_travel, dtype=bool)

    @cached_property
    def is_tied(self) -> np.ndarray:
        """Returns for each variable True if a loop depends on it."""
        columns = zip(*self.loops.jacobian, strict=True)
        return np.array([any(not entry.is_zero for entry in column) for column in columns])

    def build_vector(self, values: Mapping[str, float]) -> np.ndarray:
        """Returns (u,) values by row name; NaN for rows without."""
        return np.array([values.get(joint.name, np.nan) for joint in self.free])

    def get_bounds(self) -> tuple[np.ndarray, np.ndarray]:
        """Returns (u,) lower and upper [limits]; infinite for joints without."""
        limits = [self.robot.limits.get(joint.name) for joint in self.free]
        lower = np.array([-np.inf if one is None else one.lower for one in limits])
        upper = np.array([np.inf if one is None else one.upper for one in limits])
        return lower, upper

    @cached_property
    def limit_middles(self) -> np.ndarray:
        """Returns (u,) middles of [limits]; NaN for joints without."""
        lower, upper = self.get_bounds()
        with np.errstate(invalid="ignore"):
            middle = np.where(np.isfinite(lower + upper), 0.5 * (lower + upper), np.nan)
        return np.array([float(f"{x:.12g}") for x in middle])

    def compute_shape(self, u: np.ndarray) -> np.ndarray:
        """Returns (n, numbers) the positions of all frames and joint axes, an axis without a sense.

        Postures of one shape are symmetric copies: a fork turned over with its universal joint, a
        cylinder of negative length that points the other way.
        """
        z, points = (
            self.loops.evaluate_expressions(
                [x for frame in frame_vectors for x in frame], u
            ).reshape(len(u), -1, 3)
            for frame_vectors in zip(
                *((axes[2], origin) for axes, origin in self.frames), strict=True
            )
        )
        lines = np.einsum("nri,nrj->nrij", z, z)[:, :, *np.triu_indices(3)]
        signs = np.concatenate([points / self.loops.size, lines], axis=2)
        return signs.reshape(len(u), 9 * len(self.frames))

    def compute_distances(self, u: np.ndarray, other: np.ndarray) -> np.ndarray:
        """Returns (n, u) distances of joints, rad and robot sizes, the shorter way; NaN as 0."""
        way = u - other
        way = np.where(self.is_travel, way / self.loops.size, wrap_to_pi(way))
        return np.abs(np.nan_to_num(way))

    def compute_limit_excess(self, u: np.ndarray) -> np.ndarray:
        """Returns (n,) the excess over [limits], rad and robot sizes."""
        lower, upper = self.get_bounds()
        beyond = np.maximum(np.maximum(lower - u, u - upper), 0.0)
        return np.asarray(np.sum(beyond / self.loops.scale, axis=1))


def build_linkage(model: SymbolicModel) -> Linkage | None:
    """Returns the linkage of a model; None if no loop equation is left to be solved."""
    robot = model.robot
    if not robot.loops:
        return None
    loops, owners = derive_loop_equations(model.geometry, model.graph, model.frames, model.algebra)
    if not loops.equations or not loops.solved:
        return None
    frames = compute_base_poses(model.geometry, model.frames, model.algebra)
    return Linkage(robot, model.geometry, loops, owners, frames)


# Closed states in floating point: postures, speeds and accelerations that the loops allow.


@dataclass(frozen=True)
class ClosedStates:
    """How the free variables follow the coordinates, at n postures.

    Attributes:
        coupling: G of ud = G qd, (n, len(u), len(q)).
        drift: gamma of udd = G qdd + gamma, (n, len(u)).
    """

    coupling: np.ndarray
    drift: np.ndarray


def draw_closed_walk(
    model: SymbolicModel, samples: int, rng: np.random.Generator, share: float = 0.0
) -> Walk:
    """Returns closed postures over all that the actuated joints reach from home.

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
    for k, (joint, at) in enumerate(zip(model.robot.free_joints, closure.home, strict=True)):
        limits = model.robot.limits.get(joint.name)
        reach = closure.size if closure.is_travel[k] else np.pi
        reach = reach if k in closure.actuated else np.inf
        low, high = (limits.lower, limits.upper) if limits else (at - reach, at + reach)
        ranges.append((min(low, at), max(high, at)))
    walkers = max(THRESHOLDS.walkers, -(-2 * samples // THRESHOLDS.walk_steps))
    home = np.array(closure.home)
    with np.errstate(all="ignore"):  # steps that go astray are taken back
        path = _Walkers(closure, np.tile(home, (walkers, 1)), np.array(ranges), rng)
        reached = np.concatenate([path.advance_walkers() for _ in range(THRESHOLDS.walk_steps)])
        rng.shuffle(reached)
        both = np.concatenate([reached[: 3 * samples], home[None]])
        closed_postures = _close_postures(closure, both)
    distance = closure.compute_singularity_distance(closed_postures)
    least = max(THRESHOLDS.min_walk_distance, share * distance[-1])
    far = np.flatnonzero(distance >= min(least, distance[-1]))
    chosen = np.resize(far[::-1], samples)  # home first; few of them come again
    return Walk(closed_postures[chosen], float(distance[chosen].min()))


def compute_closed_motion(model: SymbolicModel, u: np.ndarray, qd: np.ndarray) -> ClosedStates:
    """Returns G and gamma at closed postures.

    Args:
        model: with loops.
        u: (n, len(u)) closed postures.
        qd: (n, len(q)) speeds of the coordinates.
    """
    closure = model.closure
    assert closure is not None
    actuated, solved = list(closure.actuated), list(closure.solved)
    G = np.zeros((*u.shape, len(actuated)))
    G[:, actuated, np.arange(len(actuated))] = 1.0
    G[:, solved] = -closure.solve_passive(u, closure.compute_jacobians(u)[:, :, actuated])
    ud = np.einsum("nij,nj->ni", G, qd)
    drift = np.zeros_like(u)
    drift[:, solved] = -closure.solve_passive(u, closure.evaluate_expressions(closure.drift, u, ud))
    return ClosedStates(G, drift)
