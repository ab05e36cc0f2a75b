"""What loops tie together: which variables are solved for, by which equations.

f(u) = 0 are the closure equations, u the free variables of the tree, q the actuated ones among
them. With the Jacobian J = df/du = [J_q | J_s] of the actuated and of the solved variables,

    qd_s = -J_s^-1 J_q qd,   qdd_s = -J_s^-1 (J_q qdd + d/dt(J) ud),

and torques follow by the principle of virtual power, tau_q = G^T tau_u with ud = G qd
(Briot and Gautier 2012, eq. 4; Khalil and Dombre 2002, 10.3).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeler.core.errors import LoopError
from modeler.core.expression import get_precise_context
from modeler.core.json import ShortRepr
from modeler.derivation import kinematics
from modeler.derivation.geometry import Geometry
from modeler.derivation.graph import Expr, Graph, differentiate
from modeler.derivation.kinematics import Algebra, GraphAlgebra, Pose, dot
from modeler.derivation.precise import convert_to_precise, evaluate_precisely
from modeler.derivation.thresholds import THRESHOLDS
from modeler.robot import INERTIAL, Loop, Robot

# The loops in floating point, for many postures at once: Newton on all equations, redundant ones
# included, in the sense of least squares; what the emitted C does with an independent set of them
# is checked against this.


@dataclass(frozen=True)
class LoopEquations(ShortRepr):
    """The closure equations as functions of arrays.

    Attributes:
        graph: of the expressions.
        values: of the geometric symbols.
        equations: all, redundant ones included.
        jacobian: their derivatives by u.
        given: places in u of the coordinates q.
        solved: places in u of the others.
        lengths: by u, True for a travel in m.
        size: of the robot, m: the longest way from a frame to the next with all joints at 0.
        alignments: positive where the loops are closed as meant.
        others: equations that follow from `equations` where the loops are closed, but possibly not
            where these alone hold.
    """

    graph: Graph
    values: Mapping[str, float]
    equations: Sequence[Expr]
    jacobian: Sequence[Sequence[Expr]]
    actuated: tuple[int, ...]
    solved: tuple[int, ...]
    is_travel: tuple[bool, ...]
    size: float
    alignments: Sequence[Expr] = ()
    others: Sequence[Expr] = ()

    @property
    def unknown_count(self) -> int:
        """Returns the number of free variables u."""
        return len(self.is_travel)

    @property
    def scale(self) -> np.ndarray:
        """Returns what counts as 1 for each variable: a rad, or `size`."""
        return np.where(self.is_travel, self.size, 1.0)

    @cached_property
    def row_scales(self) -> np.ndarray:
        """Returns (equations,) usual lengths of the rows of the Jacobian.

        Those at a posture would not do: an equation that changes only in second order there, as
        along a stretched chain, makes it singular, however small the row is.
        """
        u = np.random.default_rng(THRESHOLDS.row_scale_seed).uniform(
            -np.pi, np.pi, (THRESHOLDS.row_scale_samples, self.unknown_count)
        )
        J = self.compute_jacobians(u * self.scale) * self.scale
        length = np.median(np.linalg.norm(J, axis=2), axis=0)
        # An equation that follows from relations is 0 = 0 up to rounding: not to be scaled up.
        return np.where(length > THRESHOLDS.zero_row * np.max(length, initial=0.0), length, np.inf)

    def compute_residuals(self, u: np.ndarray) -> np.ndarray:
        """Returns (n, equations) residuals of (n, unknowns)."""
        return self.evaluate_expressions(self.equations, u)

    def compute_openness(self, u: np.ndarray) -> np.ndarray:
        """Returns (n,) the largest residual, that of the other equations included."""
        residuals = self.evaluate_expressions([*self.equations, *self.others], u)
        return np.asarray(np.max(np.abs(residuals), axis=1, initial=0.0))

    def are_aligned(self, u: np.ndarray) -> np.ndarray:
        """Returns (n,) True where no loop is closed with opposite axes; NaN postures are not."""
        values = self.evaluate_expressions(self.alignments, u)
        return np.all(np.isfinite(u), axis=1) & np.all(values > 0.0, axis=1)

    def compute_jacobians(self, u: np.ndarray) -> np.ndarray:
        """Returns (n, equations, unknowns) derivatives of the equations."""
        flat = self.evaluate_expressions([entry for line in self.jacobian for entry in line], u)
        return flat.reshape(len(u), len(self.equations), self.unknown_count)

    def linearise_loops(self, u: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Returns residuals, openness and Jacobians of (n, unknowns), which share most steps."""
        slopes = [entry for line in self.jacobian for entry in line]
        count, every = len(self.equations), len(self.equations) + len(self.others)
        results = self.evaluate_expressions([*self.equations, *self.others, *slopes], u)
        openness = np.max(np.abs(results[:, :every]), axis=1, initial=0.0)
        jacobians = results[:, every:].reshape(len(u), count, self.unknown_count)
        return results[:, :count], openness, jacobians

    def compute_scaled_jacobian(self, u: np.ndarray) -> np.ndarray:
        """Returns Jacobians with travels in robot sizes and rows of usual length 1."""
        return np.asarray(self.compute_jacobians(u) * self.scale / self.row_scales[:, None])

    def compute_passive_jacobian(self, u: np.ndarray) -> np.ndarray:
        """Returns (n, equations, solved) columns of the scaled Jacobian of the passive joints."""
        return self.compute_scaled_jacobian(u)[:, :, list(self.solved)]

    def compute_singularity_distance(self, u: np.ndarray) -> np.ndarray:
        """Returns (n,) smallest singular values of the passive Jacobian.

        0 where joints can move with the actuated ones locked.
        """
        return np.asarray(np.linalg.svd(self.compute_passive_jacobian(u), compute_uv=False)[:, -1])

    def solve_passive(self, u: np.ndarray, f: np.ndarray) -> np.ndarray:
        """Returns (n, solved, ...) J_s^-1 f of (n, equations, ...).

        For independent equations, as many as joints follow.
        """
        inner = self.compute_jacobians(u)[:, :, list(self.solved)]
        return np.linalg.solve(inner, f.reshape(len(u), len(self.equations), -1)).reshape(f.shape)

    def evaluate_expressions(
        self, expressions: Sequence[Expr], u: np.ndarray, ud: np.ndarray | None = None
    ) -> np.ndarray:
        """Evaluates expressions at postures and, if any, speeds (n, unknowns)."""
        inputs = {f"q[{k}]": u[:, k] for k in range(self.unknown_count)}
        if ud is not None:
            inputs |= {f"qd[{k}]": ud[:, k] for k in range(self.unknown_count)}
        nonzeros = [(i, e) for i, e in enumerate(expressions) if e.ref]
        results = self.graph.evaluate_outputs([e for _, e in nonzeros], {**self.values, **inputs})
        out = np.zeros((len(u), len(expressions)))
        for (i, _), value in zip(nonzeros, results, strict=True):
            out[:, i] = value
        return out

    def close_loops(self, u: np.ndarray, solved: Sequence[int] | None = None) -> np.ndarray:
        """Closes the loops by Newton's method from u, the other joints held; NaN where it fails."""
        places = list(self.solved if solved is None else solved)
        u = np.array(u, dtype=float)
        scale = self.scale[places]
        for _ in range(THRESHOLDS.newton_iterations):
            f = self.compute_residuals(u)
            largest = np.max(np.abs(f), axis=1, initial=0.0)
            if np.all(largest < THRESHOLDS.closed_residual * self.size):
                break
            J = self.compute_jacobians(u)[:, :, places] * scale
            step = -np.einsum("nij,nj->ni", np.linalg.pinv(J, rcond=1e-12), f)
            longest = np.max(np.abs(step), axis=1, keepdims=True)
            step *= np.minimum(1.0, 0.4 / np.maximum(longest, 1e-300))
            u[:, places] += step * scale
        bad = ~(np.max(np.abs(self.compute_residuals(u)), axis=1, initial=0.0) < 1e-9 * self.size)
        u[bad] = np.nan
        return u


def describe_open_loop(loops: LoopEquations, u: np.ndarray, owners: Sequence[str]) -> str:
    """Names the loop that is open furthest at a posture."""
    f = np.abs(loops.compute_residuals(u[None])[0])
    worst = int(np.argmax(f))
    return f'loop "{owners[worst]}" cannot close near that posture (open by {f[worst]:.3g})'


def find_nearest_closed(loops: LoopEquations, start: np.ndarray) -> np.ndarray | None:
    """Returns the closed posture that Newton finds from `start`, with axes as meant.

    Other starts differ in the solved angles.
    """
    home = loops.close_loops(start[None])
    if loops.are_aligned(home)[0]:
        return home[0]
    if not np.all(np.isfinite(home)):
        return None
    rng = np.random.default_rng(THRESHOLDS.restart_seed)
    others = np.tile(start, (THRESHOLDS.restarts, 1))
    angles = [k for k in loops.solved if not loops.is_travel[k]]
    others[:, angles] += rng.uniform(-np.pi, np.pi, (THRESHOLDS.restarts, len(angles)))
    closed_postures = loops.close_loops(others)
    closed_postures = closed_postures[loops.are_aligned(closed_postures)]
    if len(closed_postures) == 0:
        return None
    turns = wrap_to_pi(closed_postures[:, angles] - start[angles])
    closed_postures[:, angles] = start[angles] + turns
    # Mirrored postures may be equally near: digits that no rounding reaches decide then.
    near = np.round(np.sum(np.abs(closed_postures - start), axis=1), THRESHOLDS.posture_decimals)
    keys = np.round(closed_postures, THRESHOLDS.posture_decimals)
    return closed_postures[min(range(len(keys)), key=lambda i: (near[i], *keys[i]))]


def wrap_to_pi(angle: np.ndarray) -> np.ndarray:
    """Returns angles in [-pi, pi)."""
    return (angle + np.pi) % (2 * np.pi) - np.pi


def polish_home(
    loops: LoopEquations, home: np.ndarray, chosen: Sequence[int], robot: Robot
) -> tuple[float, ...]:
    """Returns the doubles next to the closed posture `home`, the same on every machine.

    Newton on the independent equations, their residuals with 40 digits, the given variables held.

    Args:
        loops: the loops.
        home: a closed posture.
        chosen: numbers of the independent equations.
        robot: for the message.

    Raises:
        LoopError: it does not settle; loops so near to singular have no certain digits.
    """
    mp, solved = get_precise_context(), list(loops.solved)
    count = len(solved)
    equations = [loops.equations[i] for i in chosen]
    slopes = [loops.jacobian[i][k] for i in chosen for k in solved]
    u = [convert_to_precise(float(x)) for x in home]
    for _ in range(THRESHOLDS.polish_iterations):
        inputs = {f"q[{k}]": x for k, x in enumerate(u)}
        results = evaluate_precisely(loops.graph, [*equations, *slopes], {**loops.values, **inputs})
        # The step is good to a double, what is left is known to 40 digits: so it goes on shrinking.
        f, J = (np.array(part, dtype=float) for part in (results[:count], results[count:]))
        try:
            step = np.linalg.solve(J.reshape(count, count), f)
        except np.linalg.LinAlgError:
            break
        for k, change in zip(solved, step, strict=True):
            u[k] -= float(change)
        if max(abs(change) for change in step) < THRESHOLDS.polish_step * loops.size:
            for k in solved:  # what should be 0 is left at the size of the last step, not at 0
                u[k] = mp.nint(u[k] / THRESHOLDS.polish_step) * THRESHOLDS.polish_step
            return tuple(float(x) for x in u)
    raise LoopError(
        f"{robot.name}: [home]: the closed posture is not certain to the last digit, the loops are "
        "nearly singular there; state another posture"
    )


def draw_nearby_postures(
    loops: LoopEquations,
    home: np.ndarray,
    rng: np.random.Generator,
    samples: int,
    reach: float = 0.3,
) -> np.ndarray:
    """Returns (samples, unknowns) closed postures around home after random small steps.

    A sample stops where the loops would not close any further.
    """
    scale = loops.scale * reach
    scale = np.where(loops.is_travel, 0.5 * scale, scale)
    u = np.tile(home, (samples, 1))
    target = rng.uniform(-1.0, 1.0, u.shape) * scale
    step = _compute_tangent(loops, u, target) / THRESHOLDS.posture_steps
    for _ in range(THRESHOLDS.posture_steps):
        trial = loops.close_loops(u + step, range(loops.unknown_count))
        jump = np.max(np.abs(trial - u) / loops.scale, axis=1)
        good = np.isfinite(jump) & (jump < 4 * reach / THRESHOLDS.posture_steps * 3)
        u[good] = trial[good]
        step = _compute_tangent(loops, u, target) / THRESHOLDS.posture_steps
    return u


def _compute_tangent(loops: LoopEquations, u: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """`wanted` projected on the motions that the loops allow."""
    scale = loops.scale
    J = loops.compute_jacobians(u) * scale
    w = wanted / scale
    along = np.einsum("nij,nj->ni", np.linalg.pinv(J, rcond=1e-9), np.einsum("nij,nj->ni", J, w))
    return (w - along) * scale


# Closure equations of the loops, from the poses of the frames that meet.


Frame = tuple[Sequence[list[Expr]], list[Expr]]
"""(axes x, y, z; origin) in one frame."""


def compute_loop_frames(
    geometry: Geometry, loop: Loop, frames: Sequence[Pose], algebra: Algebra
) -> tuple[Frame, Frame]:
    """Returns the two frames that meet, in the frame of the body that both sides come from.

    There, and not in frame 0, components of a plane loop stay those of its plane however the body
    turns, and which equations are independent does not depend on it.

    Args:
        geometry: the table.
        loop: which frames meet, and how.
        frames: poses of the rows in their antecedent frames, in table order.
        algebra: of their entries.
    """
    places = {joint.name: k for k, joint in enumerate(geometry.robot.joints)}
    ends = [places.get(name) for name in (loop.frame, loop.meets)]
    sides = [[] if end is None else geometry.find_ancestors(end) for end in ends]
    root = next((k for k in sides[0] if k in sides[1]), None)
    rows = {k for k in ends if k is not None}
    posed = kinematics.compute_relative_poses(geometry, frames, algebra, root, rows)
    return posed[ends[0]], posed[ends[1]]


def _subtract_origins(a: Frame, b: Frame) -> list[Expr]:
    return kinematics.plus(a[1], kinematics.times(-1, b[1]))


def _compare_directions(a: Frame, b: Frame) -> list[Expr]:
    return [dot(a[0][0], b[0][2]), dot(a[0][1], b[0][2])]


def _compare_axes(a: Frame, b: Frame) -> list[Expr]:
    return [*_compare_directions(a, b), dot(a[0][0], b[0][1])]


def _compute_axis_offset(a: Frame, b: Frame) -> list[Expr]:
    way = _subtract_origins(b, a)
    return [dot(a[0][0], way), dot(a[0][1], way)]


def _compare_axis(a: Frame, b: Frame) -> list[Expr]:
    return [dot(a[0][2], b[0][2])]


def _compute_height(a: Frame, b: Frame) -> list[Expr]:
    return [dot(a[0][2], _subtract_origins(b, a))]


ALL, ACROSS, ALONG = (0, 1, 2), (0, 1), (2,)
"""Components by axes of a frame: all, x and y, z."""
_ROUND = ("XX", "YY")


@dataclass(frozen=True)
class LoopJoint:
    """A joint that closes a loop, by the two frames that meet in it.

    Attributes:
        equations: that give expressions which vanish where it is closed, some possibly redundant;
            lengths in m where positions are compared, cosines where directions are.
        axes: whose product is 1 where it is closed as meant, -1 with axes opposite: the equations
            compare directions by right angles, which opposite axes fulfil too.
        velocity: components of the difference of the frames' velocities that vanish; all where
            their origins coincide.
        turning: of the difference of their angular velocities.
        bodies: at the meeting frames that move alike with both: parameters that are 1.
    """

    equations: tuple[Callable[[Frame, Frame], list[Expr]], ...]
    axes: tuple[int, ...]
    velocity: tuple[int, ...]
    turning: tuple[int, ...]
    bodies: tuple[tuple[str, ...], ...]


_SPHERICAL = LoopJoint((_subtract_origins,), (), ALL, (), (("M",),))
_PIN = (_subtract_origins, _compare_directions)
LOOP_JOINTS: Mapping[str, LoopJoint] = {
    "position": _SPHERICAL,
    "spherical": _SPHERICAL,
    "universal": LoopJoint((_subtract_origins, _compare_axis), (), ALL, (), (("M",),)),
    "revolute": LoopJoint(_PIN, (2,), ALL, ACROSS, (("M",), ("MZ",), _ROUND)),
    "cylindrical": LoopJoint(
        (_compute_axis_offset, _compare_directions), (2,), ACROSS, ACROSS, (_ROUND,)
    ),
    "prismatic": LoopJoint(
        (_compute_axis_offset, _compare_axes),
        (0, 2),
        ACROSS,
        ALL,
        tuple((x,) for x in INERTIAL[:6]),
    ),
    "planar": LoopJoint((_compute_height, _compare_directions), (2,), ALONG, ACROSS, (_ROUND,)),
    "rigid": LoopJoint(
        (_subtract_origins, _compare_axes), (0, 2), ALL, ALL, tuple((x,) for x in INERTIAL)
    ),
}


@dataclass(frozen=True, kw_only=True)
class Closure(LoopEquations):
    """The loops of a robot in its free variables u, by independent equations.

    Attributes:
        drift: d/dt(jacobian) ud, of `q[k]` and `qd[k]`: jacobian udd + drift = 0.
        home: u where the loops are closed first; it says which assembly mode is meant.
        platform: places in u that are given where the platform's motion is; None without one.
        redundant: number of equations that follow from the others.
    """

    equations: tuple[Expr, ...]
    jacobian: tuple[tuple[Expr, ...], ...]
    alignments: tuple[Expr, ...]
    others: tuple[Expr, ...]
    drift: tuple[Expr, ...]
    home: tuple[float, ...]
    platform: tuple[int, ...] | None
    redundant_count: int


def derive_closure(
    geometry: Geometry, graph: Graph, frames: Sequence[Pose], algebra: GraphAlgebra
) -> Closure | None:
    """Derives the closure of a robot's loops; None if relations already say all that they do.

    Raises:
        LoopError: the loops do not close at home, leave more or less free than is actuated, or
            are singular at home.
    """
    robot = geometry.robot
    if not robot.loops:
        return None
    loops, owners = derive_loop_equations(geometry, graph, frames, algebra)
    start = np.array([robot.home.get(joint.name, 0.0) for joint in robot.free_joints])
    if not loops.equations:
        if loops.solved:
            raise LoopError(_describe_mobility(loops, geometry, np.zeros((1, len(start))), owners))
        return None
    if not check_mobility(loops, start, geometry, owners):
        raise LoopError(
            f"{robot.name}: [home]: {describe_open_loop(loops, start, owners)}; state values near "
            "a "
            "closed one, and check the lengths"
        )
    home = find_nearest_closed(loops, start)
    if home is None:
        raise LoopError(
            f"{robot.name}: [home]: the passive joints do not close the loops there; state another "
            "posture"
        )
    if not loops.solved:
        return None
    chosen = _select_independent(loops, home, geometry)
    equations = tuple(loops.equations[i] for i in chosen)
    jacobian = tuple(tuple(loops.jacobian[i]) for i in chosen)
    held = {equation.ref for equation in equations}
    return Closure(
        graph=graph,
        values=loops.values,
        equations=equations,
        jacobian=jacobian,
        actuated=loops.actuated,
        solved=loops.solved,
        is_travel=loops.is_travel,
        size=loops.size,
        alignments=tuple(loops.alignments),
        others=tuple(e for e in loops.equations if e.ref not in held),
        drift=tuple(_derive_drift(graph, jacobian, loops.unknown_count)),
        home=polish_home(loops, home, chosen, robot),
        platform=_select_platform(loops, home, geometry),
        redundant_count=len(loops.equations) - len(equations),
    )


def derive_loop_equations(
    geometry: Geometry, graph: Graph, frames: Sequence[Pose], algebra: GraphAlgebra
) -> tuple[LoopEquations, list[str]]:
    """Returns the equations of all loops, and the name of the loop that each comes from."""
    robot = geometry.robot
    equations: list[Expr] = []
    owners: list[str] = []
    alignments: list[Expr] = []
    for loop in robot.loops:
        one, other = compute_loop_frames(geometry, loop, frames, algebra)
        joint = LOOP_JOINTS[loop.kind]
        values = (value for equation in joint.equations for value in equation(one, other))
        joint_equations = [value for value in values if not value.is_zero]
        alignments += [dot(one[0][axis], other[0][axis]) for axis in joint.axes]
        equations += joint_equations
        owners += [loop.name] * len(joint_equations)
    n = geometry.coordinate_count
    columns = [differentiate(equations, {f"q[{k}]": graph.constant(1)}) for k in range(n)]
    jacobian = [tuple(column[i] for column in columns) for i in range(len(equations))]
    names = [joint.name for joint in robot.free_joints]
    actuated = tuple(names.index(joint.name) for joint in robot.coordinates)
    solved = tuple(k for k in range(n) if k not in actuated)
    lengths = tuple(not joint.is_revolute for joint in robot.free_joints)
    # The longest way from a frame to the next with all joints at 0, m; 1 where all are one point.
    # It goes into the emitted C: taken with 40 digits, it is the same on every machine.
    still = {f"q[{k}]": 0.0 for k in range(n)}
    ways = [graph.lift(entry) for pose in frames for entry in pose.p]
    precisely = evaluate_precisely(graph, ways, {**geometry.values, **still})
    norms = map(get_precise_context().norm, zip(*[iter(precisely)] * 3, strict=True))
    size = float(max(norms)) or 1.0
    loops = LoopEquations(
        graph, geometry.values, equations, jacobian, actuated, solved, lengths, size, alignments
    )
    return loops, owners


def _derive_drift(graph: Graph, jacobian: Sequence[Sequence[Expr]], n: int) -> list[Expr]:
    """d/dt(J) ud."""
    speeds = [graph.symbol(f"qd[{k}]") for k in range(n)]
    rates = []
    for line in jacobian:
        total = graph.constant(0)
        for entry, speed in zip(line, speeds, strict=True):
            total = total + entry * speed
        rates.append(total)
    return differentiate(rates, {f"q[{k}]": speeds[k] for k in range(n)})


def check_mobility(
    loops: LoopEquations, start: np.ndarray, geometry: Geometry, owners: Sequence[str]
) -> bool:
    """Checks that the loops leave as much free as is actuated, and that the joints drive it.

    Returns:
        False if no closed posture is near the start, all joints being free to move.

    Raises:
        LoopError: they do not.
    """
    near = loops.close_loops(start[None], range(loops.unknown_count))[0]
    if not np.all(np.isfinite(near)):
        return False
    postures = draw_nearby_postures(
        loops, near, np.random.default_rng(THRESHOLDS.mobility_seed), THRESHOLDS.mobility_postures
    )
    J = loops.compute_scaled_jacobian(postures)
    ranks = [_compute_rank(sample) for sample in J]
    if loops.unknown_count - max(ranks) != len(loops.actuated):
        raise LoopError(_describe_mobility(loops, geometry, J[int(np.argmax(ranks))], owners))
    inner = J[:, :, list(loops.solved)]
    best = inner[max(range(len(inner)), key=lambda i: _compute_rank(inner[i]))]
    if _compute_rank(best) < len(loops.solved):
        raise LoopError(
            f"{geometry.robot.name}: {_find_moving_joints(loops, geometry, best)} can move with "
            "all "
            "actuated joints locked, and the actuated joints are tied to each other; actuate "
            "others (mu 1)"
        )
    return True


def _select_independent(loops: LoopEquations, home: np.ndarray, geometry: Geometry) -> list[int]:
    """Numbers of as many independent equations as there are variables to solve for.

    Raises:
        LoopError: they are singular at home.
    """
    at_home = loops.compute_passive_jacobian(home[None])[0]
    if _compute_rank(at_home, THRESHOLDS.min_singular_value) < len(loops.solved):
        moving = _find_moving_joints(loops, geometry, at_home, THRESHOLDS.min_singular_value)
        raise LoopError(
            f"{geometry.robot.name}: the loops are singular at [home]: {moving} could move there "
            "with the actuated joints locked; state another posture"
        )
    return sorted(select_spanning_rows(at_home, len(loops.solved), THRESHOLDS.pivot_tie))


def select_spanning_rows(matrix: np.ndarray, count: int, alike: float = 0.0) -> list[int]:
    """Selects up to `count` rows, each the longest of what the rows before leave of it.

    Gram-Schmidt with pivoting, as LAPACK has it; but of rows whose lengths differ by less than the
    share `alike` the first is taken, where LAPACK would let the last digit choose.
    """
    rest, chosen = matrix.copy("K"), list[int]()
    for _ in range(count):
        lengths = np.linalg.norm(rest, axis=1)
        best = int(np.argmax(lengths >= (1.0 - alike) * lengths.max()))
        if lengths[best] == 0.0:
            break
        chosen.append(best)
        direction = rest[best] / lengths[best]
        rest -= np.outer(rest @ direction, direction)
    return chosen


def _compute_rank(matrix: np.ndarray, tolerance: float = THRESHOLDS.mobility_rank) -> int:
    return int(np.sum(np.linalg.svd(matrix, compute_uv=False) > tolerance))


def _find_moving_joints(
    loops: LoopEquations,
    geometry: Geometry,
    inner: np.ndarray,
    tolerance: float = THRESHOLDS.mobility_rank,
) -> str:
    """The solved joints that take part in a motion which the equations do not stop."""
    _, _, vt = np.linalg.svd(inner, full_matrices=True)
    rank = _compute_rank(inner, tolerance)
    share = np.max(np.abs(vt[rank:]), axis=0)
    free = geometry.robot.free_joints
    moving = share > 0.1 * share.max()
    names = [free[k].name for k, moves in zip(loops.solved, moving, strict=True) if moves]
    return f"joint{'s' if len(names) > 1 else ''} " + ", ".join(names)


def _describe_mobility(
    loops: LoopEquations, geometry: Geometry, J: np.ndarray, owners: Sequence[str]
) -> str:
    robot, free = geometry.robot, loops.unknown_count - _compute_rank(J)
    actuated = ", ".join(joint.name for joint in robot.coordinates)
    summary = f"{robot.name}: the loops leave {free} degree{'s' if free != 1 else ''} of freedom"
    if free > len(loops.actuated):
        inner = J[:, list(loops.solved)]
        return (
            f"{summary}, {len(loops.actuated)} joints are actuated ({actuated}): under-"
            f"constrained, {_find_moving_joints(loops, geometry, inner)} could move with these "
            "locked; actuate one of them (mu 1), add a relation, or close the loop by a joint that "
            "leaves fewer degrees of freedom"
        )
    # The loops without which more would be free.
    names, full = list(dict.fromkeys(owners)), _compute_rank(J)
    blamed = [name for name in names if _compute_rank(J[[o != name for o in owners]]) < full]
    strictest = ", ".join(f'"{name}"' for name in blamed or names)
    return (
        f"{summary}, {len(loops.actuated)} joints are actuated ({actuated}): over-constrained by "
        f"loop {strictest}; close it by a joint that leaves more degrees of freedom, or make "
        "actuated joints passive (mu 0)"
    )


def _select_platform(
    loops: LoopEquations, home: np.ndarray, geometry: Geometry
) -> tuple[int, ...] | None:
    """Platform coordinates, and as many actuated ones as are still to be given with them."""
    names = [joint.name for joint in geometry.robot.free_joints]
    chosen = [names.index(name) for name in geometry.robot.platform if name in names]
    if not chosen or len(chosen) > len(loops.actuated):
        return None
    J = loops.compute_scaled_jacobian(home[None])[0]

    def is_solvable(places: Sequence[int]) -> bool:
        others = [k for k in range(loops.unknown_count) if k not in places]
        return _compute_rank(J[:, others], THRESHOLDS.min_singular_value) == len(loops.solved)

    for k in loops.actuated:
        if len(chosen) < len(loops.actuated) and k not in chosen and is_solvable([*chosen, k]):
            chosen.append(k)
    return tuple(chosen) if len(chosen) == len(loops.actuated) and is_solvable(chosen) else None
