"""The symbolic model: tau = phi chi, column by column, and what else is computed from it."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property, partial

from modeler.core.brief import Brief
from modeler.core.errors import DerivationError
from modeler.core.expression import FUNCTIONS, LAW, Expression
from modeler.derivation.closure import Closure, closure_of
from modeler.derivation.columns import (
    LinkColumn,
    ShaftColumn,
    Signal,
    StandardColumn,
    signals_of,
    signals_read,
)
from modeler.derivation.differentiation import derivatives
from modeler.derivation.geometry import Geometry
from modeler.derivation.graph import Expr, Graph, GraphAlgebra, combination
from modeler.derivation.kinematics import (
    Motion,
    MotionState,
    Pose,
    Screw,
    base_poses,
    free_screws,
    inertia_matrix,
    inverse_dynamics,
    motions,
    poses,
    project,
    wrench_columns,
)
from modeler.derivation.labels import Label
from modeler.effects import ENCODERS, MOTION, Acts
from modeler.robot import Robot

_REFERRED = ("rigid_body", "rotor_inertia", "viscous", "coulomb", "offset")
"""Effects whose parameters `[reference]` may state: those that depend on nothing else."""

_SMOOTH = ("rigid_body", "rotor_inertia", "viscous")

_OF_SPEEDS = {"wd": "w", "vd": "v", "U": "W", "f": "l", "n": "k", "fc": "lc", "nc": "kc"}

Entries = Mapping[tuple[int, int], Expr]
"""Structural nonzeros of a regressor: (joint, column) -> expression."""


@dataclass(frozen=True)
class SymbolicModel(Brief):
    """The dynamics of a robot as expressions of one graph.

    Inputs of the graph: `q[0]`, `qd[0]`, `qdd[0]`, ... in the order of `robot.free`, which no
    geometric symbol can be named like, and the geometric symbols by name. Torques are those along
    the free variables; where loops tie these to each other, `closure` says how.

    Attributes:
        special: joints that follow others by relations which the loops imply at the given lengths
            and angles only.
        unproven: joints that seemed to follow others by a relation that was not proven.
    """

    robot: Robot
    geometry: Geometry
    graph: Graph
    columns: tuple[StandardColumn, ...]
    special: tuple[str, ...] = ()
    unproven: tuple[str, ...] = ()

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
        """The symbols of `kind` "q", "qd", "qdd", "v" or "a", of the free variables."""
        return [self.graph.symbol(f"{kind}[{k}]") for k in range(self.geometry.coordinates)]

    @cached_property
    def closure(self) -> Closure | None:
        """What ties the free variables to each other; None without loops.

        Raises:
            LoopError: the loops leave more or less free than is actuated, or cannot close.
        """
        return closure_of(self.geometry, self.graph, self.frames, self.algebra)

    def free_efforts(self, rows: Sequence[Expr]) -> list[Expr]:
        """Torques along the free variables from those of the moving rows: F^T tau."""
        found = [self.graph.constant(0)] * self.geometry.coordinates
        for form, torque in zip(self.geometry.forms, rows, strict=True):
            for k, coefficient in form.items():
                found[k] = found[k] + torque * coefficient
        return found

    def link_motions(
        self, qd: Sequence[Expr], qdd: Sequence[Expr], gravity: bool = True,
        v: Sequence[Expr] | None = None,
    ) -> list[Motion]:  # fmt: skip
        """Motion of every row's link for these speeds and accelerations of the free variables.

        Args:
            qd: speeds.
            qdd: accelerations.
            gravity: False without gravity.
            v: second speeds; see `MotionState`.
        """
        zero = self.graph.constant(0)
        down = [self.algebra.static(x) if gravity else zero for x in self.geometry.gravity]
        state = MotionState(
            self.of_rows(qd), self.of_rows(qdd), down, None if v is None else self.of_rows(v)
        )
        return motions(self.geometry, self.frames, state, self.algebra)

    def of_rows(self, free: Sequence[Expr]) -> list[Expr]:
        """Speeds of the moving rows from those of the free variables: F u."""
        return [combination(self.graph, form, free) for form in self.geometry.forms]

    @cached_property
    def regressor(self) -> Entries:
        """Structural nonzeros of phi in tau = phi chi, over all standard columns.

        Inertial columns by Newton-Euler in screw form: the wrench of one unit of a parameter,
        projected on every joint below; effect columns from their definition.
        """
        moved = self.link_motions(self.inputs("qd"), self.inputs("qdd"))
        found = self.entries(self.projected(moved), partial(effect_entries, self))
        self._labels.update(self.graph.labels)
        return found

    def projected(self, moved: Sequence[Motion]) -> Callable[[LinkColumn], dict[int, Expr]]:
        """{free variable: torque along it} per unit of a link's parameter, in this motion."""
        carried = self.carried
        columns = [wrench_columns(motion) for motion in moved]

        def found(part: LinkColumn) -> dict[int, Expr]:
            force, moment = columns[part.row][part.prefix]
            return {k: project(screw, force, moment) for k, screw in carried[part.row].items()}

        return found

    def entries(
        self, link: Callable[[LinkColumn], Mapping[int, Expr]],
        shaft: Callable[[ShaftColumn], Mapping[int, Expr]],
    ) -> Entries:  # fmt: skip
        """Structural nonzeros over all standard columns, by row of what the parts give.

        Args:
            link: {row: value} of a link's parameter.
            shaft: of an effect's parameter.
        """
        entries: dict[tuple[int, int], Expr] = {}
        for place, column in enumerate(self.columns):
            for part in column.parts:
                values = shaft(part) if isinstance(part, ShaftColumn) else link(part)
                for k, value in values.items():
                    value = entries.get((k, place), self.graph.constant(0)) + value
                    entries[k, place] = value
        return {at: value for at, value in entries.items() if not value.is_zero}

    @contextmanager
    def speeds_for_accelerations(self) -> Iterator[None]:
        """While recursions are given speeds as accelerations: labels say what comes of it."""
        self.graph.called = _OF_SPEEDS
        try:
            yield
        finally:
            self.graph.called = {}

    @cached_property
    def _labels(self) -> dict[int, Label]:
        """Those that stood when the regressor was there."""
        return {}

    @contextmanager
    def labelled(self) -> Iterator[None]:
        """While a module is written: labels do not depend on what else was asked of the model."""
        graph, before = self.graph, self.graph.labels
        assert self.regressor
        graph.labels = self._labels.copy()
        try:
            yield
        finally:
            graph.labels = before

    @cached_property
    def carried(self) -> list[dict[int, Screw]]:
        """For every row, the screw of each free variable that moves it."""
        return free_screws(self.geometry, self.frames, self.algebra)

    @cached_property
    def signals(self) -> tuple[Signal, ...]:
        """What effects read besides the motion: the input `s`, in order."""
        return signals_of(self.columns)

    def reference_torque(self, kind: str) -> list[Expr]:
        """Torques along the free variables at the parameters of `[reference]`.

        Args:
            kind: "load", of the links; "static", of gravity; "torque", of the textbook effects too;
                "axis", of links, rotors and viscous friction: what follows from a motion smoothly.
        """
        referred = _SMOOTH if kind == "axis" else _REFERRED
        known = {
            place: self.graph.constant(Fraction(repr(float(self.robot.reference[column.name]))))
            for place, column in enumerate(self.columns)
            if column.name in self.robot.reference and column.effect in referred
        }
        still = kind == "static"
        return self.torque(
            known, speeds=not still, accelerations=not still, effects=kind in ("torque", "axis")
        )

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
        none = [zero] * self.geometry.coordinates
        qd = self.inputs("qd") if speeds else none
        qdd = self.inputs("qdd") if accelerations else none
        tau = list(none)
        if links:
            moved = self.link_motions(qd, qdd, gravity)
            rows = self.link_parameters(parameters)
            torques = inverse_dynamics(self.geometry, self.frames, moved, rows, zero)
            tau = self.free_efforts(torques)
        for place in parameters if effects else ():
            for part in self.columns[place].parts:
                if isinstance(part, ShaftColumn):
                    for joint, value in effect_entries(self, part).items():
                        tau[joint] = tau[joint] + value * parameters[place]
        return tau

    def link_parameters(self, parameters: Mapping[int, Expr]) -> list[dict[str, Expr]]:
        """Per row, the inertial parameters among `parameters`, by prefix."""
        rows: list[dict[str, Expr]] = [{} for _ in self.geometry.rows]
        for place, value in parameters.items():
            for part in self.columns[place].parts:
                if isinstance(part, LinkColumn):
                    rows[part.row][part.prefix] = value
        return rows

    def inertia_matrix(self, parameters: Mapping[int, Expr]) -> list[list[Expr]]:
        """M(q) of the free variables: composite links, and the rotor inertias of the effects."""
        zero = self.graph.constant(0)
        rows = self.link_parameters(parameters)
        tree = inertia_matrix(self.geometry, self.frames, rows, zero)
        half = [self.free_efforts(line) for line in tree]
        matrix = [self.free_efforts([line[k] for line in half]) for k in range(len(half[0]))]
        for i, j, value in self.rotors(parameters):
            matrix[i][j] = matrix[i][j] + value
        return matrix

    def rotors(self, parameters: Mapping[int, Expr]) -> Iterator[tuple[int, int, Expr]]:
        """(row, column, value) of what rotor inertias add to M."""
        for place, value in parameters.items():
            for part in self.columns[place].parts:
                if isinstance(part, ShaftColumn) and part.kind == "rotor_inertia":
                    for i, ci in part.shaft.items():
                        for j, cj in part.shaft.items():
                            yield i, j, value * (ci * cj)

    def forward_kinematics(self) -> list[list[list[Expr]]]:
        """[R | p], 3 x 4, of every moving row's frame in frame 0, in table order.

        The columns of R are the frame's axes x, y, z in frame 0; p is its origin, m.
        """
        found = base_poses(self.geometry, self.frames, self.algebra)
        return [
            [[*(axis[i] for axis in axes), origin[i]] for i in range(3)]
            for row, (axes, origin) in zip(self.geometry.rows, found, strict=True)
            if row.index is not None
        ]


# Columns of effects as expressions of the graph, from the equations that define them.


_MEASURED = ("q", "qd", "qdd")


def effect_entries(
    model: SymbolicModel, column: ShaftColumn, motion: Sequence[str] = _MEASURED
) -> dict[int, Expr]:
    """{free variable: torque along it per unit of the column's parameter}.

    Args:
        model: the robot's.
        column: of an effect.
        motion: names of the inputs that are its position, speed and acceleration.
    """
    if column.acts is Acts.POSITION:
        return _moved(model, column)
    torque = _equation(model, column, motion)
    return {k: torque * coefficient for k, coefficient in column.shaft.items()}


def _equation(model: SymbolicModel, column: ShaftColumn, motion: Sequence[str] = _MEASURED) -> Expr:
    """The equation of the column on its shaft."""
    read = {name: signal_symbol(model, signal) for name, signal in signals_read(column).items()}
    return _evaluated(model, column.equation, column.shaft, column.shapes, read, motion)


def signal_symbol(model: SymbolicModel, signal: Signal) -> Expr:
    """The entry of `s` that it is."""
    return model.graph.symbol(f"s[{model.signals.index(signal)}]")


def followed(model: SymbolicModel, signal: Signal, now: Mapping[Signal, Expr]) -> Expr:
    """What a lag follows, with the signals that it reads as they are now."""
    index = model.geometry.rows[signal.row].index
    assert index is not None and signal.follows is not None
    read = {name: now[other] for name, other in signal.read.items()}
    shaft = model.geometry.forms[index]
    return _evaluated(model, signal.follows, shaft, dict(signal.shapes), read, _MEASURED)


def _evaluated(
    model: SymbolicModel, equation: Expression, shaft: Mapping[int, Fraction],
    shapes: Mapping[str, float], read: Mapping[str, Expr], motion: Sequence[str],
) -> Expr:  # fmt: skip
    """An equation on a shaft; `read` are the signals by variable."""
    graph, names = model.graph, equation.names
    values: dict[str, Expr] = {
        name: graph.constant(Fraction(repr(float(value)))) for name, value in shapes.items()
    }
    for name, kind in zip(MOTION, motion, strict=True):
        values[name] = along(model, shaft, kind)
        for joint, form in zip(model.robot.moving, model.geometry.forms, strict=True):
            if name + joint.name in names - values.keys():
                values[name + joint.name] = combination(graph, form, model.inputs(kind))
    for name in ("load", "static", "torque"):
        if name in names:
            values[name] = _on_shaft(graph, shaft, model.reference_torque(name))
    zero = graph.constant(0)
    for name, value in read.items():
        values[name] = value - values.get(f"{name}0", zero) if name in ("t", "T") else value
    functions = {name: partial(graph.call, name) for name in FUNCTIONS} | {LAW: graph.law}
    pi = graph.constant(Fraction(repr(math.pi)))
    return graph.lift(equation.fold(values, functions, pi, graph.constant))


def along(model: SymbolicModel, shaft: Mapping[int, Fraction], kind: str) -> Expr:
    """Position, speed or acceleration of a shaft."""
    return combination(model.graph, shaft, model.inputs(kind))


def _on_shaft(graph: Graph, shaft: Mapping[int, Fraction], torques: list[Expr]) -> Expr:
    """Torque of the joint that the shaft is; effects on motors of several joints read no load."""
    return combination(graph, {k: 1 / coefficient for k, coefficient in shaft.items()}, torques)


def _moved(model: SymbolicModel, column: ShaftColumn) -> dict[int, Expr]:
    """Torque of the links at the reference, differentiated along a small change of position.

    The change is the column's equation, dq(q); speeds and accelerations change by its time
    derivatives. An encoder's error moves the rotor too.

    Raises:
        DerivationError: the equation has a part without derivative.
    """
    n = model.geometry.coordinates
    speeds = {f"q[{k}]": model.inputs("qd")[k] for k in range(n)}
    rates = speeds | {f"qd[{k}]": model.inputs("qdd")[k] for k in range(n)}
    dq = _equation(model, column)
    try:
        (dv,) = derivatives([dq], speeds)
        (da,) = derivatives([dv], rates)
    except DerivationError as error:
        raise DerivationError(
            f'{column.name}: "{column.equation.text}" moves the position and is '
            f"differentiated twice, but {error}; expected sums, products, whole powers, sqrt, exp, "
            "sin, cos, tan, tanh"
        ) from None
    direction: dict[str, Expr] = {}
    for k, coefficient in column.shaft.items():
        for kind, change in (("q", dq), ("qd", dv), ("qdd", da)):
            direction[f"{kind}[{k}]"] = change * coefficient
    kind = "axis" if column.effect in ENCODERS else "load"
    moved = derivatives(model.reference_torque(kind), direction)
    return {k: value for k, value in enumerate(moved) if not value.is_zero}
