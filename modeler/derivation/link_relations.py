"""Exact grouping of serial and tree robots, link by link.

A combination of standard parameters has no effect on the torques if and only if it adds nothing to
the energy rows: twice the kinetic energy and the power of gravity, as functions of the joint
positions and speeds (the equations of Lagrange give no torque exactly then). For a tree these
functions are sums over links, and a leaf's variable occurs in its own link only. So a combination
of the leaf's parameters can be hidden by the others if and only if its energy rows do not depend on
the leaf's variable and speed; then it equals a combination of the antecedent's parameters, the
leaf is cut off, and the argument repeats. All conditions are linear over the exact field: no
sampling, no trigonometric expansion.

What has to be known of the antecedent is which linear functions of its energy rows, of its twist
and of its gravity vector vanish identically. These three spaces follow by recursion from the base,
where twist and energy are zero and gravity is constant.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from sympy import QQ
from sympy.polys.rings import ring

from modeler.derivation.closure import ALL, LOOP_JOINTS
from modeler.derivation.field import (
    CoefficientTooLarge,
    Element,
    ExactField,
    Matrix,
    Residues,
    compute_null_space,
    cross,
    fill_residues,
    reduce_rows,
    replace_square,
    rotate_into_axes,
)
from modeler.derivation.geometry import Geometry, GeometryRow
from modeler.derivation.model import StandardColumn
from modeler.derivation.modular import ModularState, find_dependent_columns
from modeler.derivation.thresholds import THRESHOLDS
from modeler.robot import INERTIAL

# How inertial parameters, twists and gravity pass through a joint, over the exact field.
#
# A link's ten parameters at frame j are carried to the frame before the joint motion, in which
# they are polynomials in (cos, sin) of a rotation or in the travel of a prismatic joint, and from
# there by a constant transformation to the antecedent. Khalil and Dombre 2002, section 9.4.


_J = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))


def multiply_matrices(a: Matrix, b: Matrix, zero: Element) -> Matrix:
    """Returns a b."""
    there = [[(j, y) for j, y in enumerate(line) if y] for line in b]  # most entries are 0
    product_rows = []
    for line in a:
        total = [zero] * len(b[0])
        for x, row_entries in zip(line, there, strict=True):
            for j, y in row_entries if x else ():
                total[j] = total[j] + x * y
        product_rows.append(total)
    return product_rows


def _compute_dot(a: Sequence[Element], b: Sequence[Element], zero: Element) -> Element:
    total = zero
    for x, y in zip(a, b, strict=True):
        if x and y:
            total = total + x * y
    return total


def apply_matrix(a: Matrix, v: Sequence[Element], zero: Element) -> list[Element]:
    """Returns a v."""
    return [_compute_dot(line, v, zero) for line in a]


def build_inertial_transfer(R: Matrix, p: Sequence[Element], zero: Element, one: Element) -> Matrix:
    """Returns 10 x 10: a body's parameters at a frame posed at (R, p) -> those at the origin."""
    units = [[one if i == j else zero for j in range(10)] for i in range(10)]
    columns = [_move_inertia(R, p, unit, zero) for unit in units]
    return [list(line) for line in zip(*columns, strict=True)]


def _move_inertia(
    R: Matrix, p: Sequence[Element], c: Sequence[Element], zero: Element
) -> list[Element]:
    """MS' = S + M p and J' = R J R^T + 2 (p.S) 1 - p S^T - S p^T + M (p.p 1 - p p^T), S = R MS."""
    # Most combinations hold few of the ten: what is 0 is not multiplied out.
    M = c[9]
    S = apply_matrix(R, c[6:9], zero) if any(c[6:9]) else [zero] * 3
    if any(c[:6]):
        J = [[c[0], c[1], c[2]], [c[1], c[3], c[4]], [c[2], c[4], c[5]]]
        half = multiply_matrices(R, J, zero)
        turned = [_compute_dot(half[i], R[j], zero) for i, j in _J]
    else:
        turned = [zero] * 6
    if not (M or any(S)) or not any(p):
        return [*turned, *S, M]
    spread = 2 * _compute_dot(p, S, zero) + M * (_compute_dot(p, p, zero) if M else zero)
    out = []
    for (i, j), value in zip(_J, turned, strict=True):
        if any(S):
            value = value - p[i] * S[j] - S[i] * p[j]
        if M:
            value = value - M * p[i] * p[j]
        out.append(value + spread if i == j else value)
    return out + [S[i] + M * p[i] for i in range(3)] + [M]


def build_rotation_z(c: Element, s: Element, zero: Element, one: Element) -> Matrix:
    """Returns Rz as a matrix."""
    return [[c, -s, zero], [s, c, zero], [zero, zero, one]]


def build_rotation_x(c: Element, s: Element, zero: Element, one: Element) -> Matrix:
    """Returns Rx as a matrix."""
    return [[one, zero, zero], [zero, c, -s], [zero, s, c]]


@dataclass(frozen=True)
class ConstantPlacement:
    """A constant placement: R and p."""

    R: Matrix
    p: list[Element]

    def invert_placement(self, K: ExactField) -> "ConstantPlacement":
        """Returns R^T and -R^T p."""
        back = [list(column) for column in zip(*self.R, strict=True)]
        return ConstantPlacement(back, [-x for x in apply_matrix(back, self.p, K.zero)])


def move_parameters(
    step: ConstantPlacement, parameters: Sequence[Element], K: ExactField
) -> list[Element]:
    """Returns the ten parameters of a body posed at `step` as those at the origin."""
    return _move_inertia(step.R, step.p, parameters, K.zero)


def build_placement(row: GeometryRow, K: ExactField) -> ConstantPlacement:
    """Returns Rz(gamma) Tz(b) Rx(alpha) Tx(d), the pose before the joint motion."""
    zero, one = K.zero, K.one
    gamma = build_rotation_z(*K.cos_sin(row.gamma), zero, one)
    alpha = build_rotation_x(*K.cos_sin(row.alpha), zero, one)
    R = multiply_matrices(gamma, alpha, zero)
    p = apply_matrix(R, [K.element(row.d), zero, zero], zero)
    return ConstantPlacement(R, [p[0], p[1], p[2] + K.element(row.b)])


def build_joint_constant(row: GeometryRow, K: ExactField) -> ConstantPlacement:
    """Returns the constant part that commutes with the joint motion: Tz(r), Rz(theta) or both."""
    zero, one = K.zero, K.one
    turns = row.index is not None and row.joint.is_revolute
    slides = row.index is not None and not row.joint.is_revolute
    c, s = (one, zero) if turns else K.cos_sin(row.theta)
    r = zero if slides else K.element(row.r)
    return ConstantPlacement(build_rotation_z(c, s, zero, one), [zero, zero, r])


@lru_cache(maxsize=2)
def build_joint_motion(angular: bool) -> tuple[tuple[Matrix, Matrix], ...]:
    """Returns the joint motion as a sum over its basis functions, the constant one first; over Q.

    Revolute: 1, c, s, c**2, cs of the rotation; prismatic: 1, r, r**2 of the travel.

    Returns:
        For each basis function (L, X): L (10, 10) acts on parameters, X (6, 6) on the coefficients
        of a linear function of the twist (v, w); both bring them to the frame before the motion.
    """
    Q, x, y = ring("x,y", QQ)  # cosine and sine, or the travel
    zero, one = Q.zero, Q.one
    if angular:
        R, p = build_rotation_z(x, y, zero, one), [zero] * 3
        X = [[*line, *p] for line in R] + [[*p, *line] for line in R]
        basis = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1)]
    else:
        R, p = build_rotation_z(one, zero, zero, one), [zero, zero, x]
        X = [[one if i == j else zero for j in range(6)] for i in range(6)]
        # a.v + b.w of the moved frame, where v = v' + w' x (0, 0, r): b' = b + (0, 0, r) x a.
        X[3][1], X[4][0] = -x, x
        basis = [(0, 0), (1, 0), (2, 0)]

    def select_factors(matrix: Matrix, at: tuple[int, int]) -> Matrix:
        """Returns what stands at a basis function in every entry, s**2 being 1 - c**2."""
        reduced = [[replace_square(entry, 1, 1 - x**2) for entry in line] for line in matrix]
        return [[entry.get(at, QQ(0)) for entry in line] for line in reduced]

    L = build_inertial_transfer(R, p, zero, one)
    return tuple((select_factors(L, at), select_factors(X, at)) for at in basis)


INERTIA, OFFSET = 10, 11
"""Places of the rotor inertia and of the offset after the ten inertial parameters."""


@dataclass(frozen=True)
class FrameKernels:
    """Which linear functions vanish for all motions of a frame: kernels of these matrices.

    Attributes:
        energy: (., 10) E.c = 0 for all motions iff energy c = 0; E are the frame's energy rows.
        twist: (., 6) the same for v.a + w.b.
        gravity: (., 4) the same for g.u + k.
    """

    energy: Matrix
    twist: Matrix
    gravity: Matrix


@dataclass(frozen=True)
class LinkGrouping:
    """What of one link's parameters another link hides.

    Attributes:
        hidden: basis of the combinations (10 inertial, rotor inertia, offset) of the link that do
            not depend on its own joint, as rows.
        moved: the same combinations as parameters of the antecedent frame, as rows of 10.
    """

    hidden: Matrix
    moved: Matrix


def group_tree(
    geometry: Geometry, K: ExactField, joint_columns: Collection[tuple[int, int]]
) -> list[LinkGrouping]:
    """Returns for every row of the table what its antecedent hides of it.

    Args:
        geometry: the table.
        K: its field.
        joint_columns: which (row, INERTIA) and (row, OFFSET) the robot has.
    """
    gravity = [[*(K.element(g) for g in geometry.gravity), K.one]]
    reaches: list[FrameKernels] = []
    groupings: list[LinkGrouping] = []
    for k, row in enumerate(geometry.rows):
        base = FrameKernels([], [], gravity) if row.parent is None else reaches[row.parent]
        step = _TreeStep(row, K, base)
        absent = [i for i in (INERTIA, OFFSET) if (k, i) not in joint_columns]
        groupings.append(step.derive_grouping(absent))
        reaches.append(step.derive_kernels())
    return groupings


class _TreeStep:
    """One joint: from the reach of the antecedent to the grouping and the reach of the link.

    The conditions are written for the parameters at the frame that moves with the joint, before the
    constant part of its placement. Once the antecedent moves in every way, which is so from the
    third or fourth joint on, they hold rational numbers only.
    """

    def __init__(self, row: GeometryRow, K: ExactField, antecedent: FrameKernels) -> None:
        self.K, self.row = K, row
        self.fixed_part = build_placement(row, K)
        self.before = _propagate_kernels(antecedent, self.fixed_part, K)
        self.constant = build_joint_constant(row, K)
        self.motion = build_joint_motion(row.joint.is_revolute) if row.index is not None else ()

    def derive_grouping(self, absent: list[int]) -> LinkGrouping:
        """Derives what the antecedent hides; `absent` are joint columns that the robot has not."""
        K = self.K
        if not self.motion:
            return LinkGrouping([], [])
        rows = self._build_motion_rows(with_joint_columns=True)
        for L, _ in self.motion[1:]:
            rows += self._pad_rows(multiply_matrices(self.before.energy, L, K.zero))
        rows += [[K.one if i == j else K.zero for i in range(12)] for j in absent]
        null_basis = compute_null_space(rows, 12, K.zero, K.one)
        steady = [apply_matrix(self.motion[0][0], line[:10], K.zero) for line in null_basis]
        back = self.constant.invert_placement(K)
        moved = [[*move_parameters(back, line[:10], K), *line[10:]] for line in null_basis]
        return LinkGrouping(moved, [move_parameters(self.fixed_part, line, K) for line in steady])

    def derive_kernels(self) -> FrameKernels:
        """Derives the kernels of what vanishes identically of the link's own motion."""
        K = self.K
        if not self.motion:
            return _propagate_kernels(self.before, self.constant, K)
        energy = [line[:10] for line in self._build_motion_rows(with_joint_columns=False)]
        own_speed = 5 if self.row.joint.is_revolute else 2
        twist: Matrix = [[K.one if i == own_speed else K.zero for i in range(6)]]
        gravity: Matrix = []
        for m, (L, X) in enumerate(self.motion):
            energy += multiply_matrices(self.before.energy, L, K.zero)
            twist += multiply_matrices(self.before.twist, X, K.zero)
            R = [[*line[:3], K.zero] for line in X[:3]]
            R.append([K.zero, K.zero, K.zero, K.one if m == 0 else K.zero])
            gravity += multiply_matrices(self.before.gravity, R, K.zero)
        kernels = FrameKernels(
            reduce_rows(energy)[0], reduce_rows(twist)[0], reduce_rows(gravity)[0]
        )
        return _propagate_kernels(kernels, self.constant, K)

    def _pad_rows(self, rows: Matrix) -> Matrix:
        return [[*line, self.K.zero, self.K.zero] for line in rows]

    def _build_motion_rows(self, with_joint_columns: bool) -> Matrix:
        """Conditions that nothing depends on the joint speed: terms in qd**2 and qd."""
        K, rows = self.K, []
        for m, (L, _) in enumerate(self.motion):
            kinetic_row, momentum, pull = _derive_speed_terms(L, self.row.joint.is_revolute, K.zero)
            here = K.one if m == 0 and with_joint_columns else K.zero
            rows.append([*kinetic_row, here, K.zero])
            # The offset's power is tau qd, the links' speed along z is rate * qd.
            offset = here * self.row.rate
            rows += self._pad_rows(multiply_matrices(self.before.twist, momentum, K.zero))
            pull = [*self._pad_rows(pull), [K.zero] * 11 + [offset]]
            rows += multiply_matrices(self.before.gravity, pull, K.zero)
        return [line for line in rows if any(line)]


def _derive_speed_terms(
    carried: Matrix, angular: bool, zero: Element
) -> tuple[list[Element], Matrix, Matrix]:
    """Energy rows of a link whose joint adds qd z to its twist, as functions of its parameters.

    Returns:
        (10,) coefficient of qd**2 in 2T; (6, 10) of 2 qd in 2T as a function of (v, w); (3, 10) of
        qd in the power of gravity as a function of g.
    """
    XZ, YZ, ZZ, MX, MY, M = (carried[i] for i in (2, 4, 5, 6, 7, 9))
    none = [zero] * len(M)
    if angular:
        return ZZ, [_negate_row(MY), MX, none, XZ, YZ, ZZ], [MY, _negate_row(MX), none]
    return M, [none, none, M, MY, _negate_row(MX), none], [none, none, _negate_row(M)]


def _negate_row(line: list[Element]) -> list[Element]:
    return [-x for x in line]


def _propagate_kernels(reach: FrameKernels, step: ConstantPlacement, K: ExactField) -> FrameKernels:
    """The reach of a frame posed at (R, p) on a frame: what vanishes, in its coordinates."""

    def propagate_rows(rows: Matrix, width: int, transfer: Callable[[], Matrix]) -> Matrix:
        """Returns the rows for the next frame; where all vanish there is nothing to compute."""
        if len(rows) == width:
            return rows
        return multiply_matrices(rows, transfer(), K.zero) if rows else []

    return FrameKernels(
        propagate_rows(
            reach.energy, 10, lambda: build_inertial_transfer(step.R, step.p, K.zero, K.one)
        ),
        propagate_rows(reach.twist, 6, lambda: _build_twist_transfer(step, K)),
        propagate_rows(
            reach.gravity,
            4,
            lambda: [[*line, K.zero] for line in step.R] + [[K.zero, K.zero, K.zero, K.one]],
        ),
    )


def _build_twist_transfer(step: ConstantPlacement, K: ExactField) -> Matrix:
    # a.v' + b.w' with v' = R^T (v + w x p), w' = R^T w is (R a).v + (R b + p x R a).w.
    R, p = step.R, step.p
    lower = [
        [p[(i + 1) % 3] * R[(i + 2) % 3][j] - p[(i + 2) % 3] * R[(i + 1) % 3][j] for j in range(3)]
        for i in range(3)
    ]
    return [[*line, K.zero, K.zero, K.zero] for line in R] + [[*lower[i], *R[i]] for i in range(3)]


# Relations whose energies are multiples of the closure equations.
#
# Where a joint closes a loop, components of the difference of two speeds vanish in every motion
# that the loop allows, and with them every product of such a component and a speed of the opened
# tree. So a combination of parameters whose energy rows are, in the opened tree, sums of such
# products
#
#     2T = sum a_ijk x_i w_jk + sum b_ijk x_i v_jk,   P = sum c_ij x_i g_j
#
# has no effect once the loop is closed. Here x_i are the components that vanish, w_k and v_k belong
# to the bodies k of the loop, and a, b, c are constants; all vectors have the axes of one body. Of
# frames A and B that meet, with angular velocities wA and wB, origins at pA and pB and velocities
# vA and vB of these, vanish
#
#     all of vB - vA, where the joint keeps the origins in one point;
#     else, of vB - vA - wA x (pB - pA), what is across the axis along which the frames slide, or
#     along the axis across which they slide; by axes of A;
#     wB - wA where the frames do not turn, else what of it is across the axis about which they do;
#
# and the same with A and B exchanged. What vanishes altogether has the axes of the body that both
# sides of the loop come from.
#
# An example are the products of inertia of the bars of a planar four-bar that swings as a whole: a
# vector s fixed to each bar, XZ and YZ of each its components, adds 2 W.(e x ds/dt) to 2T, with the
# swing W and the axes' direction e; the vectors of a closed polygon sum to a constant. Another is a
# body on a cylindrical joint of the base: it turns about one axis only. Relations of one joint
# stand below; these go around the loop, and are looked for where the torques determine that some
# are missing.


def derive_closure_relations(
    geometry: Geometry,
    columns: Sequence[StandardColumn],
    K: ExactField,
    order: Sequence[int],
    seed: int,
) -> list[dict[int, Element]]:
    """Returns relations among the columns of `order` that products of the closure equations make.

    Args:
        geometry: the table.
        columns: all of the robot.
        K: the field of the geometry.
        order: columns that are independent in the opened tree, in the order of keeping.
        seed: of the random points.

    Raises:
        TooLarge: a coefficient is no short quotient of polynomials, or has long numbers.
    """
    products = _ClosureProducts(geometry, columns)
    first = products.find_distinct(K, seed)
    if len(first) + len(order) > THRESHOLDS.max_loop_functions:
        raise CoefficientTooLarge(
            f"relations around loops are among more than {THRESHOLDS.max_loop_functions} functions"
        )
    wanted = [*first, *order]
    return find_dependent_columns(geometry, products.compute_rows, K, wanted, set(order), seed)


class _ClosureProducts:
    """Energy rows of the columns, followed by those of the products of every loop."""

    def __init__(self, geometry: Geometry, columns: Sequence[StandardColumn]) -> None:
        self.columns, self.geometry = columns, geometry
        places = {joint.name: k for k, joint in enumerate(geometry.robot.joints)}
        ends = ((places.get(x.frame), places.get(x.meets), x.kind) for x in geometry.robot.loops)
        self.loops = [_LoopPath(geometry, *each) for each in ends]

    def find_distinct(self, K: ExactField, seed: int) -> list[int]:
        """Finds the numbers of the products that are not zero, nor equal to one before."""
        state = ModularState(self.geometry, K, THRESHOLDS.distinct_points, seed)
        known = {bytes(2 * 8 * THRESHOLDS.distinct_points)}
        numbers = []
        for number, product in enumerate(self._collect_products(state), len(self.columns)):
            value = product.tobytes()
            if value not in known:
                known.add(value)
                numbers.append(number)
        return numbers

    def compute_rows(self, state: ModularState, places: Sequence[int]) -> np.ndarray:
        """Computes the rows (2 points, places) of 2T, then of the power of gravity."""
        count = len(self.columns)
        standard_places = [place for place in places if place < count]
        energies = state.compute_energy_rows([self.columns[i] for i in standard_places]).T
        row_columns = dict(zip(standard_places, energies, strict=True))
        if len(standard_places) < len(places):
            row_columns |= dict(enumerate(self._collect_products(state), count))
        return np.stack([row_columns[place] for place in places], axis=1)

    def _collect_products(self, state: ModularState) -> list[Residues]:
        return [product for loop in self.loops for product in loop.compute_products(state)]


class _LoopPath:
    """One loop: the rows where it closes, and the bodies on its way."""

    def __init__(self, geometry: Geometry, one: int | None, other: int | None, kind: str) -> None:
        """For the numbers of the rows that meet; None is the base."""
        self.ends, joint = (one, other), LOOP_JOINTS[kind]
        self.vanishing = (joint.velocity, joint.turning)
        sides = [[] if end is None else geometry.find_ancestors(end) for end in self.ends]
        in_common = [k for k in sides[0] if k in sides[1]]
        self.root = in_common[0] if in_common else None
        way = [k for side in sides for k in side if k not in in_common]
        bodies = dict.fromkeys([*in_common[:1], *way])
        self.bodies = [k for k in bodies if geometry.rows[k].index is not None or k == self.root]

    def compute_products(self, state: ModularState) -> list[Residues]:
        """Computes (2 points,) products that vanish by w and v of the bodies, and by gravity."""
        products: list[Residues] = []
        for end, vanishing in self._find_vanishing(state):
            nothing = 0 * vanishing
            for k in self.bodies:
                for vector in state.motion[k][2:]:
                    for y in _rotate_to_row(state, end, vector):
                        products += [*np.hstack([vanishing * y % state.prime, nothing])]
            for y in _rotate_to_row(state, end, state.gravity):
                products += [*np.hstack([nothing, vanishing * y % state.prime])]
        return products

    def _find_vanishing(self, state: ModularState) -> list[tuple[int | None, Residues]]:
        """Rows in whose axes components vanish, and these: velocities, then angular velocities."""
        components = []
        for place, along in enumerate(self.vanishing):
            if along == ALL:
                vector = self._subtract_velocities(state, self.ends)[place]
                components.append((self.root, _rotate_to_row(state, self.root, vector)))
            elif along:
                for ends in (self.ends, self.ends[::-1]):
                    vector = self._subtract_velocities(state, ends, apart=True)[place]
                    axes = _rotate_to_row(state, ends[0], vector)
                    components.append((ends[0], axes[list(along)]))
        return components

    def _subtract_velocities(
        self, state: ModularState, ends: Sequence[int | None], apart: bool = False
    ) -> tuple[Residues, Residues]:
        """Of the second end from the first: velocity and angular velocity.

        If they are apart, the first velocity is that of its body where the second origin is.
        """
        prime = state.prime
        nothing = np.stack([fill_residues(0, state.points, prime)] * 3)
        (p, w, v), (p_other, w_other, v_other) = (
            (nothing,) * 3 if end is None else state.motion[end][1:] for end in ends
        )
        if apart:
            v = v + cross(w, p_other - p, prime)
        return (v_other - v) % prime, (w_other - w) % prime


def _rotate_to_row(state: ModularState, row: int | None, vector: Residues) -> Residues:
    """A vector in the axes of a row; None is the base."""
    return vector if row is None else rotate_into_axes(state.motion[row][0], vector, state.prime)


# Relations that closing a loop creates.
#
# Where two frames meet in a joint, whatever body moves with one of them as it does with the other
# may be counted to either side. Of a rigid joint that is every body; of a spherical one a point
# mass at its centre; of a revolute one also a point mass anywhere on its axis and a rotor about
# it, which are M, MZ and XX + YY at the meeting frames. These are exact statements on the
# parameters of the two links that carry the frames; that there are no others is what the rank of
# the torques determine.


def derive_loop_relations(
    geometry: Geometry, K: ExactField, places: Mapping[tuple[int, int], int]
) -> list[dict[int, Element]]:
    """Returns the relations among the grouping units that the loops create.

    Args:
        geometry: the table.
        K: its field.
        places: unit of (row, place among the ten inertial parameters).
    """
    names = {joint.name: k for k, joint in enumerate(geometry.robot.joints)}
    relations = []
    for loop in geometry.robot.loops:
        for body in LOOP_JOINTS[loop.kind].bodies:
            vector = [K.one if prefix in body else K.zero for prefix in INERTIAL]
            relation: dict[int, Element] = {}
            for frame, sign in ((loop.frame, 1), (loop.meets, -1)):
                row, moved = move_to_link(geometry, K, names.get(frame), list(vector))
                if row is None:
                    continue
                for i, value in enumerate(moved):
                    unit = places[row, i]
                    relation[unit] = relation.get(unit, K.zero) + sign * value
            relations.append({unit: value for unit, value in relation.items() if value})
    return relations


def move_to_link(
    geometry: Geometry, K: ExactField, row: int | None, parameters: list[Element]
) -> tuple[int | None, list[Element]]:
    """Returns the link that carries a body fixed to frame `row`, and its parameters."""
    rows = geometry.rows
    while row is not None and rows[row].index is None:
        for step in (build_joint_constant(rows[row], K), build_placement(rows[row], K)):
            parameters = move_parameters(step, parameters, K)
        row = rows[row].parent
    return row, parameters
