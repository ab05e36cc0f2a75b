"""What loops tie together: which variables are solved for, by which equations.

f(u) = 0 are the closure equations, u the free variables of the tree, q the actuated ones among
them. With the Jacobian J = df/du = [J_q | J_s] of the actuated and of the solved variables,

    qd_s = -J_s^-1 J_q qd,   qdd_s = -J_s^-1 (J_q qdd + d/dt(J) ud),

and torques follow by the principle of virtual power, tau_q = G^T tau_u with ud = G qd
(Briot and Gautier 2012, eq. 4; Khalil and Dombre 2002, 10.3).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import LoopError
from modeler.core.rounded import precise
from modeler.derivation.closing import (
    SINGULAR,
    Closing,
    moved_postures,
    nearest_closed,
    open_loop,
    polished,
)
from modeler.derivation.geometry import Geometry
from modeler.derivation.graph import Algebra, Expr, Graph, GraphAlgebra, derivatives
from modeler.derivation.kinematics import Pose, dot, plus, poses_from, times
from modeler.derivation.precise import precise_values
from modeler.robot.robot import Loop

# Closure equations of the loops, from the poses of the frames that meet.


Frame = tuple[Sequence[list[Expr]], list[Expr]]
"""(axes x, y, z; origin) in one frame."""


def meeting(
    geometry: Geometry, loop: Loop, frames: Sequence[Pose], algebra: Algebra
) -> tuple[Frame, Frame]:
    """The two frames that meet, in the frame of the body that both their sides come from.

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
    sides = [[] if end is None else geometry.ancestors(end) for end in ends]
    root = next((k for k in sides[0] if k in sides[1]), None)
    posed = poses_from(geometry, frames, algebra, root, {k for k in ends if k is not None})
    return posed[ends[0]], posed[ends[1]]


def _position(a: Frame, b: Frame) -> list[Expr]:
    return plus(a[1], times(-1, b[1]))


def _parallel(a: Frame, b: Frame) -> list[Expr]:
    return [dot(a[0][0], b[0][2]), dot(a[0][1], b[0][2])]


def _aligned(a: Frame, b: Frame) -> list[Expr]:
    return [*_parallel(a, b), dot(a[0][0], b[0][1])]


def _on_axis(a: Frame, b: Frame) -> list[Expr]:
    way = _position(b, a)
    return [dot(a[0][0], way), dot(a[0][1], way)]


_KINDS: Mapping[str, Callable[[Frame, Frame], list[Expr]]] = {
    "position": _position,
    "spherical": _position,
    "universal": lambda a, b: [*_position(a, b), dot(a[0][2], b[0][2])],
    "revolute": lambda a, b: [*_position(a, b), *_parallel(a, b)],
    "cylindrical": lambda a, b: [*_on_axis(a, b), *_parallel(a, b)],
    "prismatic": lambda a, b: [*_on_axis(a, b), *_aligned(a, b)],
    "planar": lambda a, b: [dot(a[0][2], _position(b, a)), *_parallel(a, b)],
    "rigid": lambda a, b: [*_position(a, b), *_aligned(a, b)],
}
"""By kind of loop: expressions that vanish where it is closed, some perhaps redundant; lengths in m
where positions are compared, cosines where directions are."""

MEETING = ("position", "spherical", "universal", "revolute", "rigid")
"""Kinds of loops whose origins coincide."""

_SAME_AXES: Mapping[str, tuple[int, ...]] = {
    "position": (), "spherical": (), "universal": (), "revolute": (2,), "cylindrical": (2,),
    "planar": (2,), "prismatic": (0, 2), "rigid": (0, 2),
}  # fmt: skip
"""Axes whose product is 1 where the loop is closed as meant, -1 with axes opposite: the equations
compare directions by right angles, which opposite axes fulfil too."""


_RANK = 1e-9
"""Singular value of `Closing.scaled_jacobian` that counts as none at generic postures."""
_ALIKE = 1e-6
_SAMPLES = 12
_SEED = 20120


@dataclass(frozen=True, kw_only=True)
class Closure(Closing):
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
    redundant: int


def closure_of(
    geometry: Geometry, graph: Graph, frames: Sequence[Pose], algebra: GraphAlgebra
) -> Closure | None:
    """The closure of a robot's loops; None if it has none, or relations say all that they do.

    Raises:
        LoopError: the loops do not close at home, leave more or less free than is actuated, or
            are singular at home.
    """
    robot = geometry.robot
    if not robot.loops:
        return None
    closing, owners = loop_closing(geometry, graph, frames, algebra)
    start = np.array([robot.home.get(joint.name, 0.0) for joint in robot.free])
    if not closing.equations:
        if closing.solved:
            raise LoopError(_mobility(closing, geometry, np.zeros((1, len(start))), owners))
        return None
    if not check_freedom(closing, start, geometry, owners):
        raise LoopError(
            f"{robot.name}: [home]: {open_loop(closing, start, owners)}; state values near a "
            "closed one, and check the lengths"
        )
    home = nearest_closed(closing, start)
    if home is None:
        raise LoopError(
            f"{robot.name}: [home]: the passive joints do not close the loops there; state another "
            "posture"
        )
    if not closing.solved:
        return None
    chosen = _independent(closing, home, geometry)
    equations = tuple(closing.equations[i] for i in chosen)
    jacobian = tuple(tuple(closing.jacobian[i]) for i in chosen)
    held = {equation.ref for equation in equations}
    return Closure(
        graph=graph,
        values=closing.values,
        equations=equations,
        jacobian=jacobian,
        given=closing.given,
        solved=closing.solved,
        lengths=closing.lengths,
        size=closing.size,
        alignments=tuple(closing.alignments),
        others=tuple(e for e in closing.equations if e.ref not in held),
        drift=tuple(_drift(graph, jacobian, closing.unknowns)),
        home=polished(closing, home, chosen, robot),
        platform=_platform(closing, home, geometry),
        redundant=len(closing.equations) - len(equations),
    )


def loop_closing(
    geometry: Geometry, graph: Graph, frames: Sequence[Pose], algebra: GraphAlgebra
) -> tuple[Closing, list[str]]:
    """The equations of all loops, and the name of the loop that each comes from."""
    robot = geometry.robot
    equations: list[Expr] = []
    owners: list[str] = []
    aligned: list[Expr] = []
    for loop in robot.loops:
        one, other = meeting(geometry, loop, frames, algebra)
        found = [value for value in _KINDS[loop.kind](one, other) if not value.is_zero]
        aligned += [dot(one[0][axis], other[0][axis]) for axis in _SAME_AXES[loop.kind]]
        equations += found
        owners += [loop.name] * len(found)
    n = geometry.coordinates
    columns = [derivatives(equations, {f"q[{k}]": graph.constant(1)}) for k in range(n)]
    jacobian = [tuple(column[i] for column in columns) for i in range(len(equations))]
    names = [joint.name for joint in robot.free]
    given = tuple(names.index(joint.name) for joint in robot.coordinates)
    solved = tuple(k for k in range(n) if k not in given)
    lengths = tuple(not joint.angular for joint in robot.free)
    # The longest way from a frame to the next with all joints at 0, m; 1 where all are one point.
    # It goes into the emitted C: taken with 40 digits, it is the same on every machine.
    still = {f"q[{k}]": 0.0 for k in range(n)}
    ways = [graph.lift(entry) for pose in frames for entry in pose.p]
    precisely = precise_values(graph, ways, {**geometry.values, **still})
    norms = map(precise().norm, zip(*[iter(precisely)] * 3, strict=True))
    size = float(max(norms)) or 1.0
    closing = Closing(
        graph, geometry.values, equations, jacobian, given, solved, lengths, size, aligned
    )
    return closing, owners


def _drift(graph: Graph, jacobian: Sequence[Sequence[Expr]], n: int) -> list[Expr]:
    """d/dt(J) ud."""
    speeds = [graph.symbol(f"qd[{k}]") for k in range(n)]
    rates = []
    for line in jacobian:
        total = graph.constant(0)
        for entry, speed in zip(line, speeds, strict=True):
            total = total + entry * speed
        rates.append(total)
    return derivatives(rates, {f"q[{k}]": speeds[k] for k in range(n)})


def check_freedom(
    closing: Closing, start: np.ndarray, geometry: Geometry, owners: Sequence[str]
) -> bool:
    """The loops leave as much free as is actuated, and the actuated joints drive it.

    Returns:
        False if no closed posture is near the start, all joints being free to move.

    Raises:
        LoopError: they do not.
    """
    near = closing.closed(start[None], range(closing.unknowns))[0]
    if not np.all(np.isfinite(near)):
        return False
    postures = moved_postures(closing, near, np.random.default_rng(_SEED), _SAMPLES)
    J = closing.scaled_jacobian(postures)
    ranks = [_rank(sample) for sample in J]
    if closing.unknowns - max(ranks) != len(closing.given):
        raise LoopError(_mobility(closing, geometry, J[int(np.argmax(ranks))], owners))
    inner = J[:, :, list(closing.solved)]
    best = inner[max(range(len(inner)), key=lambda i: _rank(inner[i]))]
    if _rank(best) < len(closing.solved):
        raise LoopError(
            f"{geometry.robot.name}: {_moving_names(closing, geometry, best)} can move with all "
            "actuated joints locked, and the actuated joints are tied to each other; actuate "
            "others (mu 1)"
        )
    return True


def _independent(closing: Closing, home: np.ndarray, geometry: Geometry) -> list[int]:
    """Numbers of as many independent equations as there are variables to solve for.

    Raises:
        LoopError: they are singular at home.
    """
    at_home = closing.inner(home[None])[0]
    if _rank(at_home, SINGULAR) < len(closing.solved):
        moving = _moving_names(closing, geometry, at_home, SINGULAR)
        raise LoopError(
            f"{geometry.robot.name}: the loops are singular at [home]: {moving} could move there "
            "with the actuated joints locked; state another posture"
        )
    return sorted(spanning_rows(at_home, len(closing.solved), _ALIKE))


def spanning_rows(matrix: np.ndarray, count: int, alike: float = 0.0) -> list[int]:
    """Numbers of up to `count` rows, each the longest of what the rows before leave of it.

    Gram-Schmidt with pivoting, as LAPACK has it; but of rows whose lengths differ by less than the
    share `alike` the first is taken, where LAPACK would let the last digit choose.
    """
    rest, chosen = matrix.copy(), list[int]()
    for _ in range(count):
        lengths = np.linalg.norm(rest, axis=1)
        best = int(np.argmax(lengths >= (1.0 - alike) * lengths.max()))
        if lengths[best] == 0.0:
            break
        chosen.append(best)
        direction = rest[best] / lengths[best]
        rest -= np.outer(rest @ direction, direction)
    return chosen


def _rank(matrix: np.ndarray, tolerance: float = _RANK) -> int:
    return int(np.sum(np.linalg.svd(matrix, compute_uv=False) > tolerance))


def _moving_names(
    closing: Closing, geometry: Geometry, inner: np.ndarray, tolerance: float = _RANK
) -> str:
    """The solved joints that take part in a motion which the equations do not stop."""
    _, _, vt = np.linalg.svd(inner, full_matrices=True)
    rank = _rank(inner, tolerance)
    share = np.max(np.abs(vt[rank:]), axis=0)
    free = geometry.robot.free
    names = [
        free[k].name for k, s in zip(closing.solved, share, strict=True) if s > 0.1 * share.max()
    ]
    return f"joint{'s' if len(names) > 1 else ''} " + ", ".join(names)


def _mobility(closing: Closing, geometry: Geometry, J: np.ndarray, owners: Sequence[str]) -> str:
    robot, free = geometry.robot, closing.unknowns - _rank(J)
    actuated = ", ".join(joint.name for joint in robot.coordinates)
    told = f"{robot.name}: the loops leave {free} degree{'s' if free != 1 else ''} of freedom"
    if free > len(closing.given):
        inner = J[:, list(closing.solved)]
        return (
            f"{told}, {len(closing.given)} joints are actuated ({actuated}): under-constrained, "
            f"{_moving_names(closing, geometry, inner)} could move with these locked; actuate one "
            "of them (mu 1), add a relation, or close the loop by a joint that lets less free"
        )
    # The loops without which more would be free.
    names, full = list(dict.fromkeys(owners)), _rank(J)
    blamed = [name for name in names if _rank(J[[o != name for o in owners]]) < full]
    strictest = ", ".join(f'"{name}"' for name in blamed or names)
    return (
        f"{told}, {len(closing.given)} joints are actuated ({actuated}): over-constrained by "
        f"loop {strictest}; close it by a joint that lets more free, or make "
        "actuated joints passive (mu 0)"
    )


def _platform(closing: Closing, home: np.ndarray, geometry: Geometry) -> tuple[int, ...] | None:
    """Platform coordinates, and as many actuated ones as are still to be given with them."""
    names = [joint.name for joint in geometry.robot.free]
    chosen = [names.index(name) for name in geometry.robot.platform if name in names]
    if not chosen or len(chosen) > len(closing.given):
        return None
    J = closing.scaled_jacobian(home[None])[0]

    def solvable(places: Sequence[int]) -> bool:
        others = [k for k in range(closing.unknowns) if k not in places]
        return _rank(J[:, others], SINGULAR) == len(closing.solved)

    for k in closing.given:
        if len(chosen) < len(closing.given) and k not in chosen and solvable([*chosen, k]):
            chosen.append(k)
    return tuple(chosen) if len(chosen) == len(closing.given) and solvable(chosen) else None
