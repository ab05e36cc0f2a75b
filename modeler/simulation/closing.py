"""The joints that follow: closed postures along a commanded motion, speeds, and what ties cost."""

import dataclasses
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np

from modeler.core.errors import DataError, RobotError
from modeler.robot import Limits, Robot
from modeler.simulation.rigid import FUNCTIONS, Frame, compute_world_frames
from modeler.simulation.thresholds import THRESHOLDS
from modeler.simulation.trajectory import Reference

# What ties the joints of a simulated robot: relations and loops, as equations in all joints.
#
# Whole frames are compared here (nine direction cosines where three would do): nothing is shared
# with the loop equations of the modeling stages.


@dataclass(frozen=True)
class Constraints:
    """c(v) = 0 for the variables v of all moving rows.

    Attributes:
        given: places in v of the coordinates that follow the commanded motion.
        others: places of the rest.
        value: v -> c.
        slope: v -> J = dc/dv.
        curvature: (v, vd) -> J' vd, so that J vdd + J' vd = 0.
        units: (moving rows,) 1 for an angle, the robot's size [m] for a travel.
    """

    coordinate_rows: list[int]
    passive_rows: list[int]
    residual: ca.Function
    jacobian: ca.Function
    curvature: ca.Function
    units: np.ndarray


def build_constraints(robot: Robot) -> Constraints:
    """Returns the equations of a robot's relations and loops; lengths in sizes of the robot."""
    moving = robot.moving_joints
    v, vd = ca.SX.sym("v", len(moving)), ca.SX.sym("vd", len(moving))
    names = [joint.name for joint in moving]
    variables = {joint.variable: v[i] for i, joint in enumerate(moving)}
    values = {**robot.evaluate_symbols(), **variables}
    relations = ((v[names.index(n)], relation) for n, relation in robot.relations.items())
    rows = [x - relation.fold(values, FUNCTIONS, float(np.pi), float) for x, relation in relations]
    # The largest of the robot's lengths, m; 1 where none has a symbol.
    lengths = [abs(value) for name, value in robot.evaluate_symbols().items() if name != "g"]
    size = max(lengths, default=1.0) or 1.0
    poses = compute_world_frames(robot, v).items()
    frames = {name: Frame(f.rotation, f.position / size, f.axis) for name, f in poses}
    for loop in robot.loops:
        rows += _KINDS[loop.kind](frames[loop.frame], frames[loop.meets])
    c = ca.vertcat(*rows)
    slope = ca.jacobian(c, v)
    coordinate_rows = [names.index(joint.name) for joint in robot.coordinates]
    curvature = ca.jtimes(slope @ vd, v, vd)
    return Constraints(
        coordinate_rows=coordinate_rows,
        passive_rows=[i for i in range(len(names)) if i not in coordinate_rows],
        residual=ca.Function("c", [v], [ca.densify(ca.cse(c))]),
        jacobian=ca.Function("J", [v], [ca.densify(ca.cse(slope))]),
        curvature=ca.Function("k", [v, vd], [ca.densify(ca.cse(curvature))]),
        units=np.array([1.0 if joint.is_revolute else size for joint in moving]),
    )


def evaluate_samples(function: ca.Function, *samples: np.ndarray) -> np.ndarray:
    """Returns (n, rows, columns) of a function of vectors, for samples (n, its length) of each."""
    rows, columns = function.size_out(0)
    count = len(samples[0])
    mapped: Any = function.map(count)
    values, inputs = np.zeros((count, columns, rows)), [np.ascontiguousarray(s) for s in samples]
    assert mapped.nnz_out(0) == values.size
    # Through the buffer: CasADi's own matrices are slow to turn into arrays.
    buffer, evaluate = mapped.buffer()
    for i, array in enumerate(inputs):
        buffer.set_arg(i, array.data)
    buffer.set_res(0, values.data)
    evaluate()
    return values.transpose(0, 2, 1)


def _compare_positions(a: Frame, b: Frame) -> list[ca.SX]:
    return [a.position - b.position]


def _compare_axes(a: Frame, b: Frame) -> list[ca.SX]:
    return [a.rotation[:, 2] - b.rotation[:, 2]]


def _compare_rotations(a: Frame, b: Frame) -> list[ca.SX]:
    return [ca.vec(a.rotation - b.rotation)]


def _compare_lines(a: Frame, b: Frame) -> list[ca.SX]:
    return [ca.cross(a.rotation[:, 2], b.position - a.position)]


_KINDS: Mapping[str, Callable[[Frame, Frame], list[ca.SX]]] = {
    "position": _compare_positions,
    "spherical": _compare_positions,
    "universal": lambda a, b: [
        *_compare_positions(a, b),
        ca.dot(a.rotation[:, 2], b.rotation[:, 2]),
    ],
    "revolute": lambda a, b: [*_compare_positions(a, b), *_compare_axes(a, b)],
    "cylindrical": lambda a, b: [*_compare_lines(a, b), *_compare_axes(a, b)],
    "prismatic": lambda a, b: [*_compare_lines(a, b), *_compare_rotations(a, b)],
    "planar": lambda a, b: [
        ca.dot(a.rotation[:, 2], b.position - a.position),
        *_compare_axes(a, b),
    ],
    "rigid": lambda a, b: [*_compare_positions(a, b), *_compare_rotations(a, b)],
}


def compute_closed_postures(
    robot: Robot,
    constraints: Constraints,
    q: np.ndarray,
    progress: Callable[[float], None] | None = None,
) -> np.ndarray:
    """Computes (n, moving rows) closed postures along (n, coordinates), from `home` on.

    Raises:
        RobotError: `home` does not close, or leaves joints undetermined.
        DataError: the loops do not close on the way; says where.
    """
    v = _close_at_home(robot, constraints)
    v = _close_stepwise(robot, constraints, v, q[0], "on the way from [home] to the first sample")
    out = np.empty((len(q), len(v)))
    for part in _iterate_chunks(len(q)):
        out[part] = _interpolate_postures(robot, constraints, v, q[part], part.start)
        v = out[part.stop - 1]
        if progress is not None:
            progress(part.stop / len(q))
    return out


def compute_rates(
    constraints: Constraints, v: np.ndarray, qd: np.ndarray, qdd: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Returns (n, moving rows) speeds and accelerations that the constraints allow.

    J vd = 0 and J vdd + J' vd = 0 at closed postures v, for those of the coordinates.
    """
    coordinate_rows, others = constraints.coordinate_rows, constraints.passive_rows
    vd, vdd = np.zeros_like(v), np.zeros_like(v)
    vd[:, coordinate_rows], vdd[:, coordinate_rows] = qd, qdd
    for part in _iterate_chunks(len(v)):
        J = evaluate_samples(constraints.jacobian, v[part])
        Q, R = np.linalg.qr(J[:, :, others])
        driven = J[:, :, coordinate_rows]
        vd[part, others] = -_solve_least_squares(Q, R, np.einsum("nij,nj->ni", driven, qd[part]))
        curvature = evaluate_samples(constraints.curvature, v[part], vd[part])[:, :, 0]
        pull = np.einsum("nij,nj->ni", driven, qdd[part]) + curvature
        vdd[part, others] = -_solve_least_squares(Q, R, pull)
    return vd, vdd


def compute_motor_torques(constraints: Constraints, v: np.ndarray, load: np.ndarray) -> np.ndarray:
    """Computes (n, coordinates) motor torques that balance the joints' load.

    load = S tau + J^T lambda: the rows of joints without motor give the multipliers lambda (the
    smallest ones where equations are redundant), the others then tau.

    Args:
        constraints: the equations.
        v: (n, moving rows) closed postures.
        load: (n, moving rows) M vdd + h of the open tree, friction included.
    """
    coordinate_rows, others = constraints.coordinate_rows, constraints.passive_rows
    tau = np.empty((len(v), len(coordinate_rows)))
    for part in _iterate_chunks(len(v)):
        J = evaluate_samples(constraints.jacobian, v[part])
        Q, R = np.linalg.qr(J[:, :, others])
        carried = np.linalg.solve(R.transpose(0, 2, 1), load[part, others][:, :, None])
        multipliers = Q @ carried
        tau[part] = load[part, coordinate_rows] - np.einsum(
            "nij,ni->nj", J[:, :, coordinate_rows], multipliers[..., 0]
        )
    return tau


def compute_singularity_distances(constraints: Constraints, v: np.ndarray) -> np.ndarray:
    """Returns (n,) least singular value of J in the joints that follow; 0 in a singular posture.

    Lengths count in sizes of the robot.
    """
    least = np.empty(len(v))
    for part in _iterate_chunks(len(v)):
        J = evaluate_samples(constraints.jacobian, v[part]) * constraints.units
        _, R = np.linalg.qr(J[:, :, constraints.passive_rows])
        least[part] = np.linalg.svd(R, compute_uv=False)[:, -1]
    return least


def _iterate_chunks(count: int) -> Iterator[slice]:
    chunk = THRESHOLDS.samples_per_chunk
    return (slice(begin, min(begin + chunk, count)) for begin in range(0, count, chunk))


def _solve_least_squares(Q: np.ndarray, R: np.ndarray, right: np.ndarray) -> np.ndarray:
    """(n, columns) least squares solutions of Q R x = right."""
    turned = np.einsum("nij,ni->nj", Q, right)
    return np.linalg.solve(R, turned[:, :, None])[:, :, 0]


def _close_at_home(robot: Robot, constraints: Constraints) -> np.ndarray:
    names = [joint.name for joint in robot.moving_joints]
    home = _solve_posture(constraints, np.array([robot.home.get(name, 0.0) for name in names]))
    if home is None:
        raise RobotError(
            f"simulation: the loops of {robot.name} do not close at [home]; state values near a "
            "closed posture, and check the lengths"
        )
    J = constraints.jacobian(home).full()[:, constraints.passive_rows]
    _, sizes, turned = np.linalg.svd(J)
    free = turned[np.sum(sizes > THRESHOLDS.min_independent_share * sizes[0]) :]
    if len(free):
        undetermined_joints = np.array(names)[constraints.passive_rows][
            np.max(np.abs(free), axis=0) > THRESHOLDS.min_independent_share
        ]
        raise RobotError(
            f"simulation: joints {', '.join(undetermined_joints)} of {robot.name} can move at "
            "[home] with the "
            "actuated joints locked; actuate one of them, add a loop or a relation, or correct "
            "[home]"
        )
    return home


def _close_stepwise(
    robot: Robot, constraints: Constraints, v: np.ndarray, q: np.ndarray, where: str
) -> np.ndarray:
    """The closed posture at q, from the closed posture v, straight and in small steps."""
    begin = v[constraints.coordinate_rows]
    steps = max(1, int(np.ceil(np.max(np.abs(q - begin)) / THRESHOLDS.posture_stride)))
    for share in np.arange(1, steps + 1) / steps:
        start = v.copy()
        start[constraints.coordinate_rows] = begin + share * (q - begin)
        posture = _solve_posture(constraints, start)
        if posture is None or not _is_same_mode(constraints, v, posture):
            raise _build_closure_error(robot, start[constraints.coordinate_rows], where)
        v = posture
    return v


def _is_same_mode(constraints: Constraints, before: np.ndarray, after: np.ndarray) -> bool:
    """True if no joint jumped, and no singular posture lies between two near postures.

    Of square Jacobians, the ratio of the determinants is above 0; of redundant equations, that of
    what one Jacobian is in the columns of the other.
    """
    if np.max(np.abs(after - before)) > THRESHOLDS.max_joint_jump:
        return False
    rows = constraints.passive_rows
    old, new = (constraints.jacobian(v).full()[:, rows] for v in (before, after))
    least = THRESHOLDS.min_relative_singular_value
    return bool(np.linalg.det(np.linalg.lstsq(old, new, rcond=least)[0]) > 0)


def _interpolate_postures(
    robot: Robot, constraints: Constraints, before: np.ndarray, q: np.ndarray, first: int
) -> np.ndarray:
    """Closed postures at q: some one after the other, those between them all at once."""
    travel = np.cumsum(np.max(np.abs(np.diff(q, axis=0, prepend=q[:1])), axis=1))
    steps = np.flatnonzero(np.diff(travel // THRESHOLDS.anchor_spacing))
    anchors = np.unique([0, *steps, len(q) - 1])
    postures = []
    for k in anchors:
        before = _close_stepwise(robot, constraints, before, q[k], f"at sample {first + k + 1}")
        postures.append(before)
    at, columns = np.arange(len(q)), np.array(postures).T
    start = np.column_stack([np.interp(at, anchors, column) for column in columns])
    start[:, constraints.coordinate_rows] = q
    v, closed = _refine_postures(constraints, start)
    wrong = ~closed | (np.max(np.abs(v - start), axis=1) > THRESHOLDS.max_joint_jump)
    if np.any(wrong):
        k = int(np.argmax(wrong))
        raise _build_closure_error(robot, q[k], f"at sample {first + k + 1}")
    return v


def _refine_postures(constraints: Constraints, v: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Newton for all samples at once; (n, moving rows), and (n,) True where loops are closed."""
    v = v.copy()
    for _ in range(THRESHOLDS.max_newton_iterations):
        c = evaluate_samples(constraints.residual, v)[:, :, 0]
        open_ = np.flatnonzero(np.max(np.abs(c), axis=1) >= THRESHOLDS.max_closure_error)
        if not open_.size:
            break
        J = evaluate_samples(constraints.jacobian, v[open_])
        Q, R = np.linalg.qr(J[:, :, constraints.passive_rows])
        diagonal = np.abs(np.diagonal(R, axis1=1, axis2=2))
        least = THRESHOLDS.min_independent_share * diagonal.max(axis=1)
        if not np.all(diagonal.min(axis=1) > least):
            break  # joints that are not given are not determined
        step = _solve_least_squares(Q, R, c[open_])
        longest = np.max(np.abs(step), axis=1, keepdims=True)
        step *= np.minimum(1.0, THRESHOLDS.max_newton_step / longest)
        v[open_[:, None], constraints.passive_rows] -= step
    return v, np.max(
        np.abs(evaluate_samples(constraints.residual, v)[:, :, 0]), axis=1
    ) < THRESHOLDS.max_closure_error


def _solve_posture(constraints: Constraints, v: np.ndarray) -> np.ndarray | None:
    """Newton on the rows that are not given, by least squares; None if it does not converge."""
    v = v.copy()
    for _ in range(THRESHOLDS.max_newton_iterations):
        c = constraints.residual(v).full().ravel()
        if np.max(np.abs(c)) < THRESHOLDS.max_closure_error:
            return v
        J = constraints.jacobian(v).full()[:, constraints.passive_rows]
        step = np.linalg.lstsq(J, -c, rcond=THRESHOLDS.min_relative_singular_value)[0]
        longest = np.max(np.abs(step))
        v[constraints.passive_rows] += step * min(1.0, THRESHOLDS.max_newton_step / longest)
    return None


def _build_closure_error(robot: Robot, q: np.ndarray, where: str) -> DataError:
    joints = ", ".join(joint.name for joint in robot.coordinates)
    values = ", ".join(f"{x:.4g}" for x in q)
    return DataError(
        f"simulation: the loops of {robot.name} do not close {where}, joints {joints} at "
        f"{values}; shrink [limits] of these joints"
    )


# Relations of a simulated robot as a matrix: all joints of the tree from the free ones.


def compute_tree_map(robot: Robot) -> tuple[np.ndarray, np.ndarray]:
    """Returns F (moving rows, free rows) and c (moving rows,) of v = F u + c.

    Args:
        robot: u are the variables of `robot.free`, v those of `robot.moving`.
    """
    names = [joint.name for joint in robot.moving_joints]
    at_zero = robot.evaluate_symbols() | {joint.variable: 0.0 for joint in robot.moving_joints}
    follows, constant = np.zeros((len(names), len(names))), np.zeros(len(names))
    for name, relation in robot.relations.items():
        row = names.index(name)
        constant[row] = relation.evaluate(at_zero)
        for k, joint in enumerate(robot.moving_joints):
            if joint.variable in relation.names:
                follows[row, k] = relation.evaluate(at_zero | {joint.variable: 1.0}) - constant[row]
    selection = np.zeros((len(names), len(robot.free_joints)))
    for k, joint in enumerate(robot.free_joints):
        selection[names.index(joint.name), k] = 1.0
    # Relations may hold joints that follow others themselves; never in a circle.
    left = np.eye(len(names)) - follows
    return np.linalg.solve(left, selection), np.linalg.solve(left, constant)


def build_identity_map(robot: Robot) -> tuple[np.ndarray, np.ndarray]:
    """Returns the same matrix and constants with every moving row free."""
    count = len(robot.moving_joints)
    return np.eye(count), np.zeros(count)


# Commanded motion of a robot with loops: closed all along, and away from singular postures.


KEPT = 0.5
"""Share of home's distance to a singular posture that a simulated motion keeps."""


Motion = Callable[[tuple[Limits, ...]], Reference]
"""A commanded motion within limits, in the order of `robot.coordinates`."""


@dataclass(frozen=True, eq=False)
class ClosedMotion:
    """A commanded motion and what follows from it.

    Attributes:
        reference: of the coordinates.
        v: (n, moving rows) closed postures.
        share: of the way from home to the limits, that the motion was given; 1 is the whole range.
    """

    reference: Reference
    v: np.ndarray
    range_share: float


def find_closed_motion(
    robot: Robot,
    constraints: Constraints,
    limits: tuple[Limits, ...],
    motion: Motion,
    progress: Callable[[float], None] | None = None,
) -> ClosedMotion:
    """Returns motion over the largest share of the range that keeps away from singular postures.

    The loops close all along, and every posture keeps half of home's distance to a singular one
    (see `compute_singularity_distances`). Near one the motors' torques grow without bound, and so
    does every error.

    Args:
        robot: with loops.
        constraints: its loops and relations.
        limits: of the coordinates.
        motion: makes the commanded motion within limits.
        progress: called with the share done, 0 to 1.

    Raises:
        RobotError: `home` does not close.
        DataError: no share of the range will do.
    """
    home = np.array([robot.home.get(joint.name, 0.0) for joint in robot.coordinates])
    posture = compute_closed_postures(robot, constraints, home[None])
    least = KEPT * compute_singularity_distances(constraints, posture)[0]

    def is_clear_of_singularities(reference: Reference) -> bool:
        """Returns True if loops close from home on, no nearer than `least` to a singularity."""
        first = reference.q[0] - home
        parts = int(np.ceil(np.max(np.abs(first)) / THRESHOLDS.home_path_spacing))
        fractions = np.linspace(0.0, 1.0, 1 + parts)
        step = reference.time[1] - reference.time[0]
        stride = max(1, round(1 / (THRESHOLDS.checked_rate * step)))
        q = np.vstack([home + fractions[:, None] * first, reference.q[::stride]])
        try:
            postures = compute_closed_postures(robot, constraints, q)
            return bool(compute_singularity_distances(constraints, postures).min() >= least)
        except DataError:
            return False

    share = 1.0
    while share > THRESHOLDS.min_range_share:
        near = []
        for limit, at in zip(limits, home, strict=True):  # the same share of the way to both
            middle = min(max(at, limit.lower), limit.upper)
            lower = middle + share * (limit.lower - middle)
            upper = middle + share * (limit.upper - middle)
            near.append(dataclasses.replace(limit, lower=lower, upper=upper))
        reference = motion(tuple(near))
        if is_clear_of_singularities(reference):
            v = compute_closed_postures(robot, constraints, reference.q, progress)
            return ClosedMotion(reference, v, share)
        share *= THRESHOLDS.range_reduction
    joints = ", ".join(joint.name for joint in robot.coordinates)
    raise DataError(
        f"simulation: no motion of joints {joints} of {robot.name} keeps its loops closed and away "
        "from singular postures; expected [limits] around [home]; state other [limits], or "
        "another [home]"
    )
