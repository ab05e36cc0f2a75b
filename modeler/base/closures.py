"""Relations whose energies are multiples of the closure equations.

Where two frames meet in one point, the difference dv of the velocities of their origins vanishes in
every motion that the loop allows, and with it every product of dv and a speed of the opened tree.
So a combination of parameters whose energy rows are, in the opened tree, sums of such products

    2T = sum a_ijk dv_i w_jk + sum b_ijk dv_i v_jk,   P = sum c_ij dv_i g_j

(w_k and v_k: of the bodies k of the loop; i, j: axes of the body that both its sides come from) has
no effect once the loop is closed; a, b, c are constants. An example are the products of inertia of
the bars of a planar four-bar that swings as a whole: a vector s fixed to each bar, XZ and YZ of
each its components, adds 2 W.(e x ds/dt) to 2T, with the swing W and the axes' direction e; the
vectors of a closed polygon sum to a constant. `modeler.base.loops` has the relations of one joint;
these here go around the loop, and are looked for where the torques tell that some are missing.
"""

from collections.abc import Sequence

import numpy as np

from modeler.base.certificate import ModularState
from modeler.base.elimination import TooLarge
from modeler.base.field import Element, ExactField
from modeler.base.residues import Residues, filled
from modeler.base.tied import dependent_columns
from modeler.symbolic import Geometry, StandardColumn

_SAME_ORIGIN = ("position", "spherical", "universal", "revolute", "rigid")
"""Joints whose frames have their origins in common."""

_POINTS = 4
_MOST = 800
"""Columns of which relations are looked for; with more, elimination takes minutes."""


def closure_relations(
    geometry: Geometry,
    columns: Sequence[StandardColumn],
    K: ExactField,
    order: Sequence[int],
    seed: int,
) -> list[dict[int, Element]]:
    """Relations among the columns of `order` that products of the closure equations make.

    Args:
        geometry: the table.
        columns: all of the robot.
        K: the field of the geometry.
        order: columns that are independent in the opened tree, in the order of keeping.
        seed: of the random points.

    Raises:
        TooLarge: a coefficient is no short quotient of polynomials, or has long numbers.
    """
    products = _Products(geometry, columns)
    first = products.different(K, seed)
    if len(first) + len(order) > _MOST:
        raise TooLarge(f"relations around the loops are among more than {_MOST} functions")
    found = dependent_columns(geometry, products, K, [*first, *order], set(order), seed)
    return [relation for relation in found if len(relation) > 1]


class _Products:
    """Energy rows of the columns, followed by those of the products of every loop."""

    def __init__(self, geometry: Geometry, columns: Sequence[StandardColumn]) -> None:
        self.columns, self.geometry = columns, geometry
        places = {joint.name: k for k, joint in enumerate(geometry.robot.joints)}
        self.loops = [
            _Around(geometry, places.get(loop.frame), places.get(loop.meets))
            for loop in geometry.robot.loops
            if loop.kind in _SAME_ORIGIN
        ]

    def different(self, K: ExactField, seed: int) -> list[int]:
        """Numbers of the products that are not zero, nor equal to one before."""
        state = ModularState(self.geometry, K, _POINTS, seed)
        known = {bytes(2 * 8 * _POINTS)}
        found = []
        for number, product in enumerate(self._products(state), len(self.columns)):
            value = product.tobytes()
            if value not in known:
                known.add(value)
                found.append(number)
        return found

    def rows(self, state: ModularState, places: Sequence[int]) -> np.ndarray:
        """(2 points, places): rows of 2T, then of the power of gravity."""
        count = len(self.columns)
        own = [place for place in places if place < count]
        found = dict(zip(own, state.energy_rows([self.columns[i] for i in own]).T, strict=True))
        if len(own) < len(places):
            found |= dict(enumerate(self._products(state), count))
        return np.stack([found[place] for place in places], axis=1)

    def _products(self, state: ModularState) -> list[Residues]:
        return [product for loop in self.loops for product in loop.products(state)]


class _Around:
    """One loop: the rows where it closes, and the bodies on its way."""

    def __init__(self, geometry: Geometry, one: int | None, other: int | None) -> None:
        """For the numbers of the rows that meet; None is the base."""
        self.ends = one, other
        sides = [[] if end is None else geometry.ancestors(end) for end in self.ends]
        in_common = [k for k in sides[0] if k in sides[1]]
        self.root = in_common[0] if in_common else None
        way = [k for side in sides for k in side if k not in in_common]
        self.bodies = [
            k
            for k in dict.fromkeys([*in_common[:1], *way])
            if geometry.rows[k].index is not None or k == self.root
        ]

    def products(self, state: ModularState) -> list[Residues]:
        """(2 points,) each: dv by w and v of the bodies, and dv by gravity."""
        prime = state.prime
        nothing = filled(0, state.points, prime)
        speeds = [[nothing] * 3 if end is None else state.motion[end][3] for end in self.ends]
        dv = self._turned(state, [(a - b) % prime for a, b in zip(*speeds, strict=True)])
        found = []
        for k in self.bodies:
            for vector in state.motion[k][2:]:
                for y in self._turned(state, vector):
                    found += [np.concatenate([x * y % prime, nothing]) for x in dv]
        for y in self._turned(state, state.gravity):
            found += [np.concatenate([nothing, x * y % prime]) for x in dv]
        return found

    def _turned(self, state: ModularState, vector: Sequence[Residues]) -> list[Residues]:
        """A vector in the axes of the body that both sides come from."""
        if self.root is None:
            return list(vector)
        R, prime = state.motion[self.root][0], state.prime
        return [sum(R[j][i] * vector[j] % prime for j in range(3)) % prime for i in range(3)]
