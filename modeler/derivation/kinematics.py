"""Frames and joint axes by recursion from the base, and Newton-Euler, over any algebra.

Everything is expressed in the link's own frame. Rotations are applied as their three plane
rotations, so that right angles cost nothing and general ones eight multiplications.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from types import MappingProxyType
from typing import Any, Protocol

import sympy

from modeler.core.errors import DerivationError
from modeler.core.expression import FUNCTIONS
from modeler.core.json import ShortRepr
from modeler.derivation.geometry import Geometry, GeometryRow, cos_sin, count_quarter_turns
from modeler.derivation.graph import (
    Expr,
    Graph,
    Link,
    Scalar,
    Vector,
    attach_labels,
    attach_matrix_labels,
    combine_linearly,
)


class Algebra(Protocol):
    """The arithmetic in which kinematics are computed; abstract, holds no data."""

    def static(self, value: sympy.Expr) -> Scalar:
        """Returns a geometric constant."""
        ...

    def variable(self, row: GeometryRow) -> Scalar:
        """Returns rate * q + offset of a prismatic joint."""
        ...

    def cos_sin(self, row: GeometryRow) -> tuple[Scalar, Scalar]:
        """Returns cosine and sine of theta = rate * q + offset."""
        ...


class GraphAlgebra:
    """Expressions of a graph; its symbols `q[0]`, `qd[0]`, ... are those of the free variables.

    Links behind elastic joints have the positions `links` instead.
    """

    def __init__(
        self, graph: Graph, geometry: Geometry, links: Mapping[int, Expr] = MappingProxyType({})
    ) -> None:
        self.graph = graph
        self.geometry = geometry
        self.links = links
        for row in geometry.rows:
            before = "0" if row.parent is None else geometry.rows[row.parent].joint.name
            moves = "turning" if row.joint.is_revolute else "sliding"
            graph.links[row.joint.name] = Link(before, "" if row.index is None else moves)

    def static(self, value: sympy.Expr) -> Expr:
        """Returns a geometric constant as a static expression."""
        if value.is_Rational:
            return self.graph.constant(Fraction(int(value.p), int(value.q)))
        if value.is_Float:
            return self.graph.constant(Fraction(repr(float(value))))
        if value.is_Symbol:
            return self.graph.symbol(value.name, static=True)
        if value is sympy.pi:
            return self.graph.pi()
        if value is sympy.E:
            return self.graph.call("exp", self.graph.constant(1))
        args = [self.static(arg) for arg in value.args]
        if value.is_Add or value.is_Mul:
            total = args[0]
            for arg in args[1:]:
                total = total + arg if value.is_Add else total * arg
            return total
        if value.is_Pow:
            halves = 2 * value.exp
            if not halves.is_Integer:
                raise DerivationError(
                    f"{value}: only whole powers and square roots have a C form; give the number"
                )
            whole, half = divmod(int(halves), 2)
            power = args[0] ** whole
            return power * self.graph.call("sqrt", args[0]) if half else power
        name = value.func.__name__.lower()
        if name not in FUNCTIONS:
            raise DerivationError(f"{value}: {name} has no C form; expected {', '.join(FUNCTIONS)}")
        return self.graph.call(name, args[0])

    def variable(self, row: GeometryRow) -> Expr:
        """Returns rate * q + offset of a prismatic joint."""
        q = self.combine_variable("q", row)
        return (q if row.rate > 0 else -q) + self.static(row.r)

    def combine_variable(self, kind: str, row: GeometryRow) -> Expr:
        """Returns the variable of a moving row ("q"), or its derivative ("qd", "qdd")."""
        assert row.index is not None
        form = self.geometry.forms[row.index]
        symbols = {k: self.graph.symbol(f"{kind}[{k}]") for k in form}
        links = self.links if kind == "q" else {}
        return combine_linearly(self.graph, form, {**symbols, **links})

    def cos_sin(self, row: GeometryRow) -> tuple[Expr, Expr]:
        """Returns cosine and sine of theta; right angles are taken out exactly."""
        if row.index is None or not row.joint.is_revolute:
            c, s = cos_sin(row.theta)
            return self.static(c), self.static(s)
        q = self.combine_variable("q", row)
        angle = q if row.rate > 0 else -q
        quarters, rest = count_quarter_turns(row.theta)
        if rest:
            angle = angle + self.static(rest)
        c, s = self.graph.call("cos", angle), self.graph.call("sin", angle)
        for _ in range(quarters % 4):
            c, s = -s, c
        return c, s


def cross(a: Vector, b: Vector) -> Vector:
    """Returns a x b."""
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a: Vector, b: Vector) -> Scalar:
    """Returns a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def plus(a: Vector, b: Vector) -> Vector:
    """Returns a + b."""
    return [x + y for x, y in zip(a, b, strict=True)]


def times(scalar: Scalar, a: Vector) -> Vector:
    """Returns scalar * a."""
    return [scalar * x for x in a]


@dataclass(frozen=True)
class Pose(ShortRepr):
    """Frame j in its antecedent frame: plane rotations and the position of its origin.

    R = Rz(gamma) Rx(alpha) Rz(theta), each as (cos, sin); `p` in the antecedent frame.
    """

    gamma: tuple[Scalar, Scalar]
    alpha: tuple[Scalar, Scalar]
    theta: tuple[Scalar, Scalar]
    p: Vector

    def rotate_to_link(self, v: Vector) -> Vector:
        """Returns R^T v: from the antecedent frame to frame j."""
        return _rotate_z(self.theta, _rotate_x(self.alpha, _rotate_z(self.gamma, v)))

    def rotate_to_antecedent(self, v: Vector) -> Vector:
        """Returns R v: from frame j to the antecedent frame."""
        return _rotate_back_z(self.gamma, _rotate_back_x(self.alpha, _rotate_back_z(self.theta, v)))

    def rotate_inertia(self, J: Sequence[Vector]) -> list[Vector]:
        """Returns R J R^T, symmetric as J: from frame j to the antecedent frame."""
        half = [self.rotate_to_antecedent(line) for line in J]
        return [self.rotate_to_antecedent([half[0][i], half[1][i], half[2][i]]) for i in range(3)]


def _rotate_z(angle: tuple[Scalar, Scalar], v: Vector) -> Vector:
    c, s = angle
    return [c * v[0] + s * v[1], c * v[1] - s * v[0], v[2]]


def _rotate_back_z(angle: tuple[Scalar, Scalar], v: Vector) -> Vector:
    c, s = angle
    return [c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]]


def _rotate_x(angle: tuple[Scalar, Scalar], v: Vector) -> Vector:
    c, s = angle
    return [v[0], c * v[1] + s * v[2], c * v[2] - s * v[1]]


def _rotate_back_x(angle: tuple[Scalar, Scalar], v: Vector) -> Vector:
    c, s = angle
    return [v[0], c * v[1] - s * v[2], s * v[1] + c * v[2]]


def compute_pose(row: GeometryRow, algebra: Algebra) -> Pose:
    """Returns frame j in its antecedent: Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r)."""
    gamma = evaluate_rotation(row.gamma, algebra)
    alpha = evaluate_rotation(row.alpha, algebra)
    d, b = algebra.static(row.d), algebra.static(row.b)
    prismatic = row.index is not None and not row.joint.is_revolute
    r = algebra.variable(row) if prismatic else algebra.static(row.r)
    p = _rotate_back_z(gamma, plus(_rotate_back_x(alpha, [d, d * 0, r]), [b * 0, b * 0, b]))
    attach_labels("p", row.joint.name, p)
    return Pose(gamma, alpha, algebra.cos_sin(row), p)


def evaluate_rotation(angle: sympy.Expr, algebra: Algebra) -> tuple[Scalar, Scalar]:
    """Returns cosine and sine of a constant angle."""
    c, s = cos_sin(angle)
    return algebra.static(c), algebra.static(s)


def compute_poses(geometry: Geometry, algebra: Algebra) -> list[Pose]:
    """Returns pose of every row in its antecedent."""
    return [compute_pose(row, algebra) for row in geometry.rows]


def build_unit_z(algebra: Algebra) -> Vector:
    """Returns the joint axis in its own frame."""
    zero = algebra.static(sympy.Integer(0))
    return [zero, zero, algebra.static(sympy.Integer(1))]


@dataclass(frozen=True)
class Screw(ShortRepr):
    """Twist of link k for unit speed of one joint, in frame k: rotation e, velocity m of O_k."""

    e: Vector
    m: Vector


def compute_screws(
    geometry: Geometry, frames: Sequence[Pose], algebra: Algebra
) -> list[dict[int, Screw]]:
    """Returns for every row k the screw of each joint that moves it, by variable index.

    The screw is both the column of the Jacobian of link k in its own frame and the projector of a
    force f and moment n at O_k on the joint: tau = e.n + m.f.
    """
    zero = algebra.static(sympy.Integer(0))
    names = {row.index: row.joint.name for row in geometry.rows}
    row_screws: list[dict[int, Screw]] = []
    for k, row in enumerate(geometry.rows):
        carried: dict[int, Screw] = {}
        if row.parent is not None:
            for index, screw in row_screws[row.parent].items():
                moved = plus(screw.m, cross(screw.e, frames[k].p))
                link, of = row.joint.name, names[index]
                e, m = frames[k].rotate_to_link(screw.e), frames[k].rotate_to_link(moved)
                carried[index] = Screw(
                    *(attach_labels(x, link, v, of=of) for x, v in (("e", e), ("m", m)))
                )
        if row.index is not None:
            axis = [x * row.rate for x in build_unit_z(algebra)]
            nothing = [zero, zero, zero]
            joint_screw = Screw(axis, nothing) if row.joint.is_revolute else Screw(nothing, axis)
            carried[row.index] = joint_screw
        row_screws.append(carried)
    return row_screws


def compute_free_screws(
    geometry: Geometry,
    frames: Sequence[Pose],
    algebra: Algebra,
    number: Callable[[Fraction], Scalar] = lambda coefficient: coefficient,
) -> list[dict[int, Screw]]:
    """Returns for every row the screw of each free variable that moves it.

    A row that follows others passes its screw on to them, times its coefficients.

    Args:
        geometry: the table.
        frames: poses of the rows.
        algebra: of the entries.
        number: a coefficient as the algebra multiplies by it.
    """
    row_screws = []
    for rows in compute_screws(geometry, frames, algebra):
        total: dict[int, Screw] = {}
        for index, screw in rows.items():
            for k, coefficient in geometry.forms[index].items():
                e, m = times(number(coefficient), screw.e), times(number(coefficient), screw.m)
                before = total.get(k)
                total[k] = Screw(plus(before.e, e), plus(before.m, m)) if before else Screw(e, m)
        row_screws.append(total)
    return row_screws


def compute_frame_gravity(
    geometry: Geometry, frames: Sequence[Pose], algebra: Algebra
) -> list[Vector]:
    """Returns acceleration of gravity in every frame."""
    base = [algebra.static(entry) for entry in geometry.gravity]
    frame_gravity: list[Vector] = []
    for row, frame in zip(geometry.rows, frames, strict=True):
        down = base if row.parent is None else frame_gravity[row.parent]
        frame_gravity.append(frame.rotate_to_link(down))
    return frame_gravity


AxesOrigin = tuple[list[Vector], Vector]
"""Axes x, y, z of a frame, and its origin."""


def compute_base_poses(
    geometry: Geometry, frames: Sequence[Pose], algebra: Algebra
) -> list[AxesOrigin]:
    """Returns axes x, y, z of every frame and its origin, in frame 0: the forward kinematics.

    From the base outwards, R_j = R_a Rz(gamma) Rx(alpha) Rz(theta): each plane rotation turns two
    axes, and what one frame costs serves all that follow.
    """
    base_frames = compute_relative_poses(geometry, frames, algebra, None, set(range(len(frames))))
    for k, row in enumerate(geometry.rows):
        axes, origin = base_frames[k]
        for letter, values in zip("xyzo", (*axes, origin), strict=True):
            attach_labels(letter, row.joint.name, values)
    return [base_frames[k] for k in range(len(frames))]


def compute_relative_poses(
    geometry: Geometry, frames: Sequence[Pose], algebra: Algebra, root: int | None, rows: set[int]
) -> dict[int | None, AxesOrigin]:
    """Returns axes and origins of some rows, and of all between, in the frame of `root`.

    Args:
        geometry: the table.
        frames: its poses.
        algebra: of the entries.
        root: a row that all of `rows` descend from, or None for the base.
        rows: places in the table.
    """
    relative_poses: dict[int | None, AxesOrigin] = {root: build_unit_axes(algebra)}
    needed = {k for row in rows for k in geometry.find_ancestors(row)}
    for k, (row, frame) in enumerate(zip(geometry.rows, frames, strict=True)):
        if k in needed and row.parent in relative_poses and k != root:
            relative_poses[k] = _propagate_frame(relative_poses[row.parent], frame)
    return relative_poses


def build_unit_axes(algebra: Algebra) -> AxesOrigin:
    """Returns axes and origin of a frame in itself."""
    zero, one = algebra.static(sympy.Integer(0)), algebra.static(sympy.Integer(1))
    return [[one, zero, zero], [zero, one, zero], [zero, zero, one]], [zero] * 3


def _propagate_frame(parent: AxesOrigin, frame: Pose) -> AxesOrigin:
    """Axes and origin of a frame from those of its antecedent."""
    (x, y, z), origin = parent
    for axis, length in zip((x, y, z), frame.p, strict=True):
        origin = plus(origin, times(length, axis))
    x, y = rotate_axes(frame.gamma, x, y)
    y, z = rotate_axes(frame.alpha, y, z)
    x, y = rotate_axes(frame.theta, x, y)
    return [x, y, z], origin


def rotate_axes(angle: tuple[Scalar, Scalar], a: Vector, b: Vector) -> tuple[Vector, Vector]:
    """Returns two axes turned in their plane, a towards b."""
    c, s = angle
    return plus(times(c, a), times(s, b)), plus(times(c, b), times(-s, a))


# Newton-Euler in screw form: regressor columns and inverse dynamics, over any algebra.
#
# Khalil and Dombre 2002, section 9.5 (recursion) and 9.6 (regressor). The base accelerates with -g,
# which makes gravity part of the acceleration of every link.


@dataclass(frozen=True)
class Motion:
    """Motion of a link in its own frame.

    Attributes:
        w: angular velocity, rad/s.
        wd: angular acceleration, rad/s2.
        vd: acceleration of the origin minus gravity, m/s2.
        ww: y z, x z and x y of w, rad2/s2.
        U: [wd x] + [w x][w x], rows of three.
        link: its name.
        half: half the angular velocity of the second speeds; three times None without.
    """

    w: Vector
    wd: Vector
    vd: Vector
    ww: Vector
    U: list[Vector]
    half: Vector
    link: str = ""


@dataclass(frozen=True)
class MotionState:
    """Joint speeds and accelerations, gravity in frame 0; zero where they are left out.

    Attributes:
        v: second speeds: every product of two speeds is then the mean of its two ways to take one
            of `qd` and one of `v`. So torques are those of M qdd + C(q, qd) v + g, where C is the
            Coriolis matrix of Christoffel symbols, which C(q, qd) v = C(q, v) qd defines.
    """

    qd: Sequence[Scalar]
    qdd: Sequence[Scalar]
    gravity: Vector
    v: Sequence[Scalar] | None = None


def propagate_motions(
    geometry: Geometry, frames: Sequence[Pose], state: MotionState, algebra: Algebra
) -> list[Motion]:
    """Returns the motion of every row's link."""
    zero = algebra.static(sympy.Integer(0))
    none = [zero] * 3
    half = [None] * 3 if state.v is None else none
    base = Motion(none, none, [-g for g in state.gravity], none, [none] * 3, half)
    link_motions: list[Motion] = []
    for row, frame in zip(geometry.rows, frames, strict=True):
        before = base if row.parent is None else link_motions[row.parent]
        link_motions.append(_propagate_motion(before, row, frame, state))
    return link_motions


def _propagate_motion(a: Motion, row: GeometryRow, frame: Pose, state: MotionState) -> Motion:
    link = row.joint.name
    w = attach_labels("w", link, frame.rotate_to_link(a.w), "b")
    wd = attach_labels("wd", link, frame.rotate_to_link(a.wd), "b")
    half = a.half if state.v is None else frame.rotate_to_link(a.half)
    vd = attach_labels("vd", link, plus(a.vd, [dot(line, frame.p) for line in a.U]), "a")
    vd = attach_labels("vd", link, frame.rotate_to_link(vd), "b")
    if row.index is not None:
        qd, qdd = state.qd[row.index] * row.rate, state.qdd[row.index] * row.rate
        v = None if state.v is None else state.v[row.index] * row.rate / 2
        x, y = _multiply_speeds(w[1], qd, half[1], v), _multiply_speeds(w[0], qd, half[0], v)
        if row.joint.is_revolute:
            wd = [wd[0] + x, wd[1] - y, wd[2] + qdd]
            w = [w[0], w[1], w[2] + qd]
            half = half if v is None else [half[0], half[1], half[2] + v]
        else:
            vd = [vd[0] + 2 * x, vd[1] - 2 * y, vd[2] + qdd]
    attach_labels("w", link, w), attach_labels("wd", link, wd), attach_labels("vd", link, vd)
    return _build_motion(w, wd, vd, half, link)


def _multiply_speeds(a: Scalar, b: Scalar, half_a: Scalar, half_b: Scalar) -> Scalar:
    """a b of the speeds; with halves of second speeds, the mean of the two mixed products."""
    return a * b if half_a is None else a * half_b + half_a * b


def _build_motion(w: Vector, wd: Vector, vd: Vector, half: Vector, link: str) -> Motion:
    xx, yy, zz = (_multiply_speeds(w[i], w[i], half[i], half[i]) for i in range(3))
    pairs = ((0, 1), (0, 2), (1, 2))
    xy, xz, yz = (_multiply_speeds(w[i], w[j], half[i], half[j]) for i, j in pairs)
    components = ("xx", "yy", "zz", "xy", "xz", "yz")
    attach_labels("ww", link, (xx, yy, zz, xy, xz, yz), components=components)
    U = [
        [-(yy + zz), xy - wd[2], xz + wd[1]],
        [xy + wd[2], -(xx + zz), yz - wd[0]],
        [xz - wd[1], yz + wd[0], -(xx + yy)],
    ]
    return Motion(w, wd, vd, [yz, xz, xy], attach_matrix_labels("U", link, U), half, link)


def compute_wrench_columns(motion: Motion) -> dict[str, tuple[Vector, Vector]]:
    """Returns (force, moment) that one unit of each inertial parameter needs, in its frame.

    f = M vd + U MS and n = J wd + w x (J w) + MS x vd, where
    J = [[XX, XY, XZ], [XY, YY, YZ], [XZ, YZ, ZZ]].
    """
    columns = _build_wrench_columns(motion)
    for name, (force, moment) in columns.items():
        attach_labels("f", motion.link, force, of=name)
        attach_labels("n", motion.link, moment, of=name)
    return columns


def _build_wrench_columns(motion: Motion) -> dict[str, tuple[Vector, Vector]]:
    wd, vd, U = motion.wd, motion.vd, motion.U
    zero = 0 * vd[0]
    none = [zero, zero, zero]
    yz, xz, xy = motion.ww
    return {
        "XX": (none, [wd[0], xz, -xy]),
        "XY": (none, [-U[2][0], U[2][1], U[0][0] - U[1][1]]),
        "XZ": (none, [U[1][0], U[2][2] - U[0][0], -U[1][2]]),
        "YY": (none, [-yz, wd[1], xy]),
        "YZ": (none, [U[1][1] - U[2][2], -U[0][1], U[0][2]]),
        "ZZ": (none, [yz, -xz, wd[2]]),
        "MX": ([U[0][0], U[1][0], U[2][0]], [zero, -vd[2], vd[1]]),
        "MY": ([U[0][1], U[1][1], U[2][1]], [vd[2], zero, -vd[0]]),
        "MZ": ([U[0][2], U[1][2], U[2][2]], [-vd[1], vd[0], zero]),
        "M": (vd, none),
    }


def project_wrench(screw: Screw, force: Vector, moment: Vector) -> Scalar:
    """Returns torque of a joint under a force and a moment at O_k: e.n + m.f."""
    return dot(screw.e, moment) + dot(screw.m, force)


def compute_inverse_dynamics(
    geometry: Geometry,
    frames: Sequence[Pose],
    moved: Sequence[Motion],
    parameters: Sequence[Mapping[str, Any]],
    zero: Scalar,
) -> list[Scalar]:
    """Returns torques of the rigid links by the backward recursion.

    Args:
        geometry: the table.
        frames: poses of the rows.
        moved: motions of the rows.
        parameters: per row, the inertial parameters that are not zero.
        zero: the algebra's zero.

    Returns:
        (joints,) torques in N m, forces in N.
    """
    tau = [zero] * geometry.joint_count
    for k, f, n in accumulate_wrenches(
        geometry, frames, lambda k: compute_link_wrench(moved[k], parameters[k], zero)
    ):
        row = geometry.rows[k]
        if row.index is not None:
            tau[row.index] = (n if row.joint.is_revolute else f)[2] * row.rate
    return tau


def accumulate_wrenches(
    geometry: Geometry,
    frames: Sequence[Pose],
    link_wrench: Callable[[int], tuple[Vector, Vector]],
    quantities: tuple[str, str] = ("fc", "nc"),
) -> Iterator[tuple[int, Vector, Vector]]:
    """Yields (row, force, moment) of every link with all that it carries, the last first.

    Args:
        geometry: the table.
        frames: poses of the rows.
        link_wrench: those of the row's link alone, in its frame.
        quantities: what the two are called.
    """
    total: dict[int, tuple[Vector, Vector]] = {}
    for k in reversed(range(len(geometry.rows))):
        f, n = link_wrench(k)
        if k in total:
            f, n = plus(total[k][0], f), plus(total[k][1], n)
        for quantity, vector in zip(quantities, (f, n), strict=True):
            attach_labels(quantity, geometry.rows[k].joint.name, vector)
        yield k, f, n
        parent = geometry.rows[k].parent
        if parent is not None:
            f = frames[k].rotate_to_antecedent(f)
            n = plus(frames[k].rotate_to_antecedent(n), cross(frames[k].p, f))
            for quantity, vector in zip(quantities, (f, n), strict=True):
                attach_labels(quantity, geometry.rows[k].joint.name, vector, "a")
            before = total.get(parent)
            total[parent] = (plus(before[0], f), plus(before[1], n)) if before else (f, n)


def compute_link_wrench(
    motion: Motion, parameters: Mapping[str, Any], zero: Scalar
) -> tuple[Vector, Vector]:
    """Returns force and moment at the origin that a link needs: Newton and Euler."""
    J = [[parameters.get(name, zero) for name in line] for line in _INERTIA]
    MS = [parameters.get(name, zero) for name in ("MX", "MY", "MZ")]
    f = plus(times(parameters.get("M", zero), motion.vd), [dot(line, MS) for line in motion.U])
    Jw = attach_labels("h", motion.link, [dot(line, motion.w) for line in J])
    n = plus([dot(line, motion.wd) for line in J], cross(motion.w, Jw))
    n = plus(n, cross(MS, motion.vd))
    return attach_labels("f", motion.link, f), attach_labels("n", motion.link, n)


_INERTIA = (("XX", "XY", "XZ"), ("XY", "YY", "YZ"), ("XZ", "YZ", "ZZ"))


# Joint inertia matrix by composite links, over any algebra (Khalil and Dombre 2002, 9.7.2).


class Composite:
    """Mass, first moments and inertia (at its frame's origin) of a link and all that it carries."""

    def __init__(self, parameters: Mapping[str, Any], zero: Scalar, link: str = "") -> None:
        self.link = link
        self.M: Scalar = parameters.get("M", zero)
        self.MS: Vector = [parameters.get(name, zero) for name in ("MX", "MY", "MZ")]
        self.J: list[Vector] = [[parameters.get(n, zero) for n in line] for line in _INERTIA]

    def add_composite(self, other: "Composite", frame: Pose) -> None:
        """Adds what hangs on `frame`, moved to this link's frame.

        J += R J R^T + 2 (p.S) 1 - p S^T - S p^T + M (p.p 1 - p p^T) with S = R MS.
        """
        p, S = frame.p, attach_labels("MSc", other.link, frame.rotate_to_antecedent(other.MS), "a")
        turned = frame.rotate_inertia(other.J)
        attach_matrix_labels("Jc", other.link, turned, "a")
        for i, row in enumerate("xyz"):
            for j, column in enumerate("xyz"):
                both, shift = self.J[i][j] + turned[i][j], compute_steiner_term(p, S, other.M, i, j)
                attach_labels("Js", other.link, [shift], components=[row + column])
                self.J[i][j] = both + shift
        self.MS = plus(self.MS, plus(S, times(other.M, p)))
        self.M = self.M + other.M
        attach_matrix_labels("Jc", self.link, self.J)
        attach_labels("MSc", self.link, self.MS)
        attach_labels("Mc", self.link, [self.M], components=[""])

    def compute_momentum(self, row: GeometryRow) -> tuple[Vector, Vector]:
        """Returns linear and angular momentum for unit speed of the row's joint."""
        zero, (x, y, _) = 0 * self.M, self.MS
        if row.joint.is_revolute:
            return [-y * row.rate, x * row.rate, zero], [line[2] * row.rate for line in self.J]
        return [zero, zero, self.M * row.rate], [y * row.rate, -x * row.rate, zero]


def compute_steiner_term(p: Vector, S: Vector, M: Scalar, i: int, j: int) -> Scalar:
    """Returns entry i, j of 2 (p.S) 1 - p S^T - S p^T + M (p.p 1 - p p^T)."""
    total = -(p[i] * S[j] + S[i] * p[j] + M * (p[i] * p[j]))
    if i == j:
        for k in range(3):
            total = total + 2 * (p[k] * S[k]) + M * (p[k] * p[k])
    return total


def compute_inertia_matrix(
    geometry: Geometry,
    frames: Sequence[Pose],
    parameters: Sequence[Mapping[str, Any]],
    zero: Scalar,
) -> list[list[Scalar]]:
    """Returns M(q) of the rigid links, (joints, joints), symmetric by construction.

    Args:
        geometry: the table.
        frames: poses of the rows.
        parameters: per row, the inertial parameters that are not zero.
        zero: the algebra's zero.
    """
    rows = zip(parameters, geometry.rows, strict=True)
    links = [Composite(p, zero, row.joint.name) for p, row in rows]
    matrix = [[zero] * geometry.joint_count for _ in range(geometry.joint_count)]
    for k in reversed(range(len(links))):
        row = geometry.rows[k]
        if row.index is not None:
            _fill_column(matrix, geometry, frames, links[k], k)
        if row.parent is not None:
            links[row.parent].add_composite(links[k], frames[k])
    return matrix


def _fill_column(
    matrix: list[list[Scalar]], geometry: Geometry, frames: Sequence[Pose], link: Composite, k: int
) -> None:
    row = geometry.rows[k]
    assert row.index is not None
    f, n = link.compute_momentum(row)
    for at in geometry.find_ancestors(k):
        other = geometry.rows[at]
        if other.index is not None:
            along = (n if other.joint.is_revolute else f)[2] * other.rate
            matrix[row.index][other.index] = along
            matrix[other.index][row.index] = along
        names = other.joint.name, row.joint.name
        f = attach_labels("lin", names[0], frames[at].rotate_to_antecedent(f), "a", names[1])
        n = plus(frames[at].rotate_to_antecedent(n), cross(frames[at].p, f))
        attach_labels("ang", names[0], n, "a", names[1])
