"""The symbolic model: tau = phi chi, column by column, and what else is computed from it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from modeler.robot import Robot
from modeler.symbolic.algebra import GraphAlgebra
from modeler.symbolic.columns import StandardColumn, standard_columns
from modeler.symbolic.geometry import Geometry, exact_geometry
from modeler.symbolic.graph import Expr, Graph
from modeler.symbolic.inertia_matrix import inertia_matrix
from modeler.symbolic.kinematics import Pose, base_poses, poses, screws
from modeler.symbolic.newton_euler import (
    Motion,
    State,
    inverse_dynamics,
    motions,
    project,
    wrench_columns,
)

Entries = Mapping[tuple[int, int], Expr]
"""Structural nonzeros of a regressor: (joint, column) -> expression."""


@dataclass(frozen=True)
class SymbolicModel:
    """The dynamics of a robot as expressions of one graph.

    Inputs of the graph: `q[0]`, `qd[0]`, `qdd[0]`, ... in the order of `robot.moving`, which no
    geometric symbol can be named like, and the geometric symbols by name.
    """

    robot: Robot
    geometry: Geometry
    graph: Graph
    columns: tuple[StandardColumn, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the standard parameters, in column order."""
        return tuple(column.name for column in self.columns)

    @cached_property
    def algebra(self) -> GraphAlgebra:
        """The graph as numbers for the recursions."""
        return GraphAlgebra(self.graph, self.geometry)

    @cached_property
    def frames(self) -> list[Pose]:
        """Pose of every row in its antecedent."""
        return poses(self.geometry, self.algebra)

    def inputs(self, kind: str) -> list[Expr]:
        """The symbols of `kind` "q", "qd" or "qdd"."""
        return [self.graph.symbol(f"{kind}[{i}]") for i in range(self.geometry.joints)]

    def _gravity(self) -> list[Expr]:
        return [self.algebra.static(entry) for entry in self.geometry.gravity]

    def _motions(
        self, qd: Sequence[Expr], qdd: Sequence[Expr], gravity: Sequence[Expr]
    ) -> list[Motion]:
        state = State(qd, qdd, list(gravity))
        return motions(self.geometry, self.frames, state, self.algebra)

    @cached_property
    def regressor(self) -> Entries:
        """Structural nonzeros of phi in tau = phi chi, over all standard columns.

        Inertial columns by Newton-Euler in screw form: the wrench of one unit of a parameter,
        projected on every joint below; effect columns from their definition.
        """
        moved = self._motions(self.inputs("qd"), self.inputs("qdd"), self._gravity())
        carried = screws(self.geometry, self.frames, self.algebra)
        wrenches = [wrench_columns(motion) for motion in moved]
        entries: dict[tuple[int, int], Expr] = {}
        for place, column in enumerate(self.columns):
            if column.column is not None:
                entries.update(self._effect_entries(place, column))
                continue
            force, moment = wrenches[column.row][column.prefix]
            for joint, screw in carried[column.row].items():
                value = project(screw, force, moment)
                if not value.is_zero:
                    entries[joint, place] = value
        return entries

    def _effect_entries(self, place: int, column: StandardColumn) -> dict[tuple[int, int], Expr]:
        assert column.column is not None and column.shaft is not None
        speed, acceleration = (self._shaft(column.shaft, kind) for kind in ("qd", "qdd"))
        functions = {
            name: lambda x, name=name: self.graph.call(name, x)
            for name in ("sin", "cos", "tan", "sqrt", "exp", "abs", "sign", "tanh")
        }
        torque = self.graph.lift(
            column.column.equation.fold(
                {"v": speed, "a": acceleration}, functions, None, self.graph.constant
            )
        )
        return {
            (joint, place): torque * exact(coefficient)
            for joint, coefficient in column.shaft.items()
        }

    def _shaft(self, shaft: Mapping[int, float], kind: str) -> Expr:
        total = self.graph.constant(0)
        for joint, coefficient in shaft.items():
            total = total + self.inputs(kind)[joint] * exact(coefficient)
        return total

    def torque(
        self, parameters: Mapping[int, Expr], *, speeds: bool = True,
        accelerations: bool = True, gravity: bool = True, effects: bool = True, links: bool = True,
    ) -> list[Expr]:  # fmt: skip
        """tau by the Newton-Euler recursion for the parameters given by column; the others are 0.

        Args:
            parameters: {column: value}.
            speeds: False for standstill.
            accelerations: False for zero acceleration.
            gravity: False without gravity.
            effects: False without the effects' columns.
            links: False without the links.
        """
        zero = self.graph.constant(0)
        none = [zero] * self.geometry.joints
        qd = self.inputs("qd") if speeds else none
        qdd = self.inputs("qdd") if accelerations else none
        tau = list(none)
        if links:
            moved = self._motions(qd, qdd, self._gravity() if gravity else [zero] * 3)
            rows = self.link_parameters(parameters)
            tau = inverse_dynamics(self.geometry, self.frames, moved, rows, zero)
        if effects:
            for (joint, place), value in self.regressor.items():
                if self.columns[place].column is not None and place in parameters:
                    tau[joint] = tau[joint] + value * parameters[place]
        return tau

    def link_parameters(self, parameters: Mapping[int, Expr]) -> list[dict[str, Expr]]:
        """Per row, the inertial parameters among `parameters`, by prefix."""
        rows: list[dict[str, Expr]] = [{} for _ in self.geometry.rows]
        for place, value in parameters.items():
            if self.columns[place].column is None:
                rows[self.columns[place].row][self.columns[place].prefix] = value
        return rows

    def inertia_matrix(self, parameters: Mapping[int, Expr]) -> list[list[Expr]]:
        """M(q): composite links, and the rotor inertias of the effects."""
        zero = self.graph.constant(0)
        rows = self.link_parameters(parameters)
        matrix = inertia_matrix(self.geometry, self.frames, rows, zero)
        for place, value in parameters.items():
            column = self.columns[place]
            if column.kind == "rotor_inertia" and column.shaft is not None:
                for i, ci in column.shaft.items():
                    for j, cj in column.shaft.items():
                        matrix[i][j] = matrix[i][j] + value * (exact(ci) * exact(cj))
        return matrix

    def forward_kinematics(self) -> list[list[list[Expr]]]:
        """[R | p], 3 x 4, of every frame that a joint moves, in frame 0, in the order of q.

        The columns of R are the frame's axes x, y, z in frame 0; p is its origin, m.
        """
        found = base_poses(self.geometry, self.frames, self.algebra)
        return [
            [[*(axis[i] for axis in axes), origin[i]] for i in range(3)]
            for row, (axes, origin) in zip(self.geometry.rows, found, strict=True)
            if row.index is not None
        ]


def exact(value: float) -> Fraction:
    """A coefficient of the robot file as the decimal fraction that was written."""
    return Fraction(repr(value))


def derive_model(robot: Robot) -> SymbolicModel:
    """The symbolic model of a robot."""
    return SymbolicModel(robot, exact_geometry(robot), Graph(), standard_columns(robot))
