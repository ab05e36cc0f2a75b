"""Relations whose energies are multiples of the closure equations.

Where a joint closes a loop, components of the difference of two speeds vanish in every motion that
the loop allows, and with them every product of such a component and a speed of the opened tree. So
a combination of parameters whose energy rows are, in the opened tree, sums of such products

    2T = sum a_ijk x_i w_jk + sum b_ijk x_i v_jk,   P = sum c_ij x_i g_j

has no effect once the loop is closed. Here x_i are the components that vanish, w_k and v_k belong
to the bodies k of the loop, and a, b, c are constants; all vectors have the axes of one body. Of
frames A and B that meet, with angular velocities wA and wB, origins at pA and pB and velocities vA
and vB of these, vanish

    all of vB - vA, where the joint keeps the origins in one point;
    else, of vB - vA - wA x (pB - pA), what is across the axis along which the frames slide, or
    along the axis across which they slide; by axes of A;
    wB - wA where the frames do not turn, else what of it is across the axis about which they do;

and the same with A and B exchanged. What vanishes altogether has the axes of the body that both
sides of the loop come from.

An example are the products of inertia of the bars of a planar four-bar that swings as a whole: a
vector s fixed to each bar, XZ and YZ of each its components, adds 2 W.(e x ds/dt) to 2T, with the
swing W and the axes' direction e; the vectors of a closed polygon sum to a constant. Another is a
body on a cylindrical joint of the base: it turns about one axis only. Relations of one joint stand
below; these go around the loop, and are looked for where the torques tell that some are missing.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from modeler.derivation.certificate import (
    ModularState,
    Residues,
    cross,
    fill_residues,
    rotate_into_axes,
)
from modeler.derivation.closure import ALL, LOOP_JOINTS
from modeler.derivation.columns import StandardColumn
from modeler.derivation.field import CoefficientTooLarge, Element, ExactField
from modeler.derivation.geometry import Geometry
from modeler.derivation.thresholds import THRESHOLDS
from modeler.derivation.tied import find_dependent_columns
from modeler.derivation.tree import build_joint_constant, build_placement, move_parameters
from modeler.robot import INERTIAL


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
    return find_dependent_columns(
        geometry, products.compute_rows, K, [*first, *order], set(order), seed
    )


class _ClosureProducts:
    """Energy rows of the columns, followed by those of the products of every loop."""

    def __init__(self, geometry: Geometry, columns: Sequence[StandardColumn]) -> None:
        self.columns, self.geometry = columns, geometry
        places = {joint.name: k for k, joint in enumerate(geometry.robot.joints)}
        self.loops = [
            _LoopPath(geometry, places.get(loop.frame), places.get(loop.meets), loop.kind)
            for loop in geometry.robot.loops
        ]

    def find_distinct(self, K: ExactField, seed: int) -> list[int]:
        """Numbers of the products that are not zero, nor equal to one before."""
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
        """(2 points, places): rows of 2T, then of the power of gravity."""
        count = len(self.columns)
        standard_places = [place for place in places if place < count]
        row_columns = dict(
            zip(
                standard_places,
                state.compute_energy_rows([self.columns[i] for i in standard_places]).T,
                strict=True,
            )
        )
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
        self.bodies = [
            k
            for k in dict.fromkeys([*in_common[:1], *way])
            if geometry.rows[k].index is not None or k == self.root
        ]

    def compute_products(self, state: ModularState) -> list[Residues]:
        """(2 points,) each: what vanishes by w and v of the bodies, and by gravity."""
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
# the torques tells.


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
