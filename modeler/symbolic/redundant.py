"""Closure equations that follow from the others, because a loop moves in a plane or on a line.

The way d between the two origins of a closed loop has three components in the axes of the base. If
a body that both sides come from turns, none of them vanishes identically even where the loop is
planar; but d stays at right angles to an axis e of that body, e.d = 0 for all u. Where d's other
components are 0, so is d_j, if e_j is not: the equations left out hold by those identities that
have a regular minor. Others may follow for reasons that are not looked for here.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

from modeler.robot import Loop
from modeler.symbolic.balls import Ball, BallFunction, proven_regular
from modeler.symbolic.geometry import Geometry
from modeler.symbolic.graph import Expr, Graph
from modeler.symbolic.kinematics import base_poses, dot, plus, times
from modeler.symbolic.loop_equations import Frame, loop_equations
from modeler.symbolic.model import SymbolicModel

_SAME_ORIGIN = ("position", "spherical", "universal", "revolute", "rigid")
"""Joints whose frames have their origins in common."""


@dataclass(frozen=True)
class Planar:
    """A loop whose way d fulfils identities e.d = 0.

    Attributes:
        normals: the components of each e, in the axes of the base, that belong to `left`.
        left: the equations d_j that the identities are to imply.
    """

    normals: tuple[tuple[Expr, ...], ...]
    left: tuple[Expr, ...]


class Redundant:
    """The closure equations of a model that are not among the independent ones."""

    def __init__(self, model: SymbolicModel) -> None:
        """For a model with loops."""
        # A graph of its own: the model's is what the emitted C comes from.
        self._model = replace(model, graph=Graph())
        self._loops, self.unproven = _planar_loops(model, self._model)

    def follow(self, symbols: Mapping[str, Ball], inputs: Mapping[str, Ball]) -> bool:
        """True if all equations but the `unproven` vanish for certain at a closed posture."""
        return all(_implied(loop, self._model.graph, symbols, inputs) for loop in self._loops)


def _implied(
    loop: Planar, graph: Graph, symbols: Mapping[str, Ball], inputs: Mapping[str, Ball]
) -> bool:
    flat = [entry for normal in loop.normals for entry in normal]
    values, width = BallFunction(graph, flat, symbols)(inputs), len(loop.left)
    lines = [values[i : i + width] for i in range(0, len(values), width)]
    return any(proven_regular(minor) for minor in combinations(lines, width))


def _planar_loops(model: SymbolicModel, fresh: SymbolicModel) -> tuple[list[Planar], int]:
    """The loops with identities, and the number of equations that follow from none."""
    closure, geometry = model.closure, fresh.geometry
    assert closure is not None
    chosen = {abs(equation.ref) for equation in closure.equations}
    posed = base_poses(geometry, fresh.frames, fresh.algebra)
    equations = [x for loop in geometry.robot.loops for x in loop_equations(geometry, loop, posed)]
    pairs = list(zip(closure.every, equations, strict=True))
    held = {abs(x.ref) for old, x in pairs if abs(old.ref) in chosen}
    found = []
    for loop in geometry.robot.loops:
        planar = _planar(geometry, loop, posed, held)
        if planar is not None:
            found.append(planar)
            held |= {abs(x.ref) for x in planar.left}
    return found, sum(abs(x.ref) not in held for x in equations)


def _planar(
    geometry: Geometry, loop: Loop, posed: Sequence[Frame], held: set[int]
) -> Planar | None:
    """What the identities of a loop can imply; None if that is nothing."""
    places = {joint.name: k for k, joint in enumerate(geometry.robot.joints)}
    if loop.kind not in _SAME_ORIGIN or loop.meets == "0":
        return None
    one, other = places[loop.frame], places[loop.meets]
    root = next((k for k in geometry.ancestors(one) if k in geometry.ancestors(other)), None)
    if root is None:
        return None
    way = plus(posed[one][1], times(-1, posed[other][1]))
    left = [j for j in range(3) if not way[j].is_zero and abs(way[j].ref) not in held]
    axes = [axis for axis in posed[root][0] if dot(axis, way).is_zero]
    if not left or len(axes) < len(left):
        return None
    return Planar(tuple(tuple(e[j] for j in left) for e in axes), tuple(way[j] for j in left))
