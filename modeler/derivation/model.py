"""The symbolic model tau = phi chi: its standard parameters, columns and effects."""

import math
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property, partial
from typing import Any, Self, TypeAlias, TypeGuard

from modeler.core.errors import DerivationError
from modeler.core.expression import FUNCTIONS, LAW, Expression
from modeler.core.json import ShortRepr
from modeler.derivation import kinematics
from modeler.derivation.closure import Closure, derive_closure
from modeler.derivation.geometry import Geometry
from modeler.derivation.graph import Expr, Graph, Label, combine_linearly, differentiate
from modeler.derivation.kinematics import GraphAlgebra, Motion, MotionState, Pose, Screw
from modeler.effects import ENCODERS, MOTION, NOISE, TURN, EffectTarget, EnergyBlock, InternalState
from modeler.robot import Joint, Robot

_INERTIAL_UNITS = dict.fromkeys(("XX", "XY", "XZ", "YY", "YZ", "ZZ"), "kg m2") | dict.fromkeys(
    ("MX", "MY", "MZ"), "kg m"
)


@dataclass(frozen=True, kw_only=True)
class _Column(ShortRepr):
    """What all standard parameters have.

    Attributes:
        name: "XX2", "Fv1".
        row: index of its row in the table.
        prefix: "XX", "Fv".
        unit: of the parameter.
        others: columns of the same parameter on other rows, which similar legs share; the
            parameter's column is the sum of its `parts`.
    """

    name: str
    row: int
    prefix: str
    unit: str
    others: tuple[Self, ...] = ()

    @property
    def parts(self) -> tuple[Self, ...]:
        """Returns the column on every row that has the parameter, each for itself."""
        return (replace(self, others=()), *self.others)


@dataclass(frozen=True, kw_only=True)
class LinkColumn(_Column):
    """One of the ten inertial parameters of a link."""

    kind: str = "inertial"
    effect: str = "rigid_body"

    @property
    def nonnegative(self) -> bool:
        """Returns True if physics allows no negative value."""
        return self.prefix in ("XX", "YY", "ZZ", "M")


@dataclass(frozen=True, kw_only=True)
class ShaftColumn(_Column):
    """One parameter of an effect, which acts along a shaft: a joint's, or a motor's.

    Attributes:
        kind: rotor_inertia | friction | offset | other.
        effect: its id.
        equation: torque on the shaft, or its change of position, per unit of the parameter.
        block: its energy function, for grouping.
        nonnegative: physics allows no negative value.
        shaft: {k: coefficient}; the speed of the shaft is v = sum of coefficient * ud[k] over the
            free variables, and it turns them back with the same coefficients.
        acts: on what the effect acts.
        shapes: values of the effect's shape parameters.
        memory: of its inner state, if there is one.
    """

    kind: str
    effect: str
    equation: Expression
    block: EnergyBlock
    nonnegative: bool
    shaft: Mapping[int, Fraction]
    acts: EffectTarget
    nonlinear_parameters: Mapping[str, float]
    memory: InternalState | None


StandardColumn: TypeAlias = LinkColumn | ShaftColumn


def is_in_block(column: StandardColumn, block: EnergyBlock) -> TypeGuard[ShaftColumn]:
    """Returns True for an effect's parameter with that energy function."""
    return isinstance(column, ShaftColumn) and column.block is block


def build_standard_columns(geometry: Geometry) -> tuple[StandardColumn, ...]:
    """Returns all standard parameters: row by row, the link's, then those of its effects.

    A shared parameter stands where its first member would.
    """
    robot = geometry.robot
    columns: list[StandardColumn] = []
    for row, joint in enumerate(robot.joints):
        if joint.is_moving:
            prefixes = robot.get_inertial_prefixes(joint.name)
            columns += [build_link_column(prefix, row, joint) for prefix in prefixes]
            columns += _build_effect_columns(geometry, row, joint)
    return _merge_shared_columns(robot, columns)


def _merge_shared_columns(
    robot: Robot, columns: list[StandardColumn]
) -> tuple[StandardColumn, ...]:
    by_name: dict[str, Any] = {column.name: column for column in columns}
    for shared in robot.shared:
        first, *others = (by_name[name] for name in shared.members)
        by_name[shared.members[0]] = replace(first, name=shared.name, others=tuple(others))
        for other in others:
            del by_name[other.name]
    return tuple(by_name.values())


def build_link_column(prefix: str, row: int, joint: Joint) -> LinkColumn:
    """Returns an inertial parameter of the link behind a joint, on its own."""
    unit = _INERTIAL_UNITS.get(prefix, "kg")
    return LinkColumn(name=prefix + joint.name, row=row, prefix=prefix, unit=unit)


def _build_effect_columns(geometry: Geometry, row: int, joint: Joint) -> list[ShaftColumn]:
    effect_columns = []
    for effect, form, instance in geometry.robot.find_joint_effects(joint.name):
        for column in form.columns:
            effect_columns.append(
                ShaftColumn(
                    name=column.prefix + joint.name + instance.label,
                    row=row,
                    prefix=column.prefix,
                    unit=column.unit_revolute if joint.is_revolute else column.unit_prismatic,
                    kind=column.kind,
                    effect=effect.id,
                    equation=column.equation,
                    block=column.block,
                    nonnegative=column.nonnegative,
                    shaft=_derive_shaft(geometry, joint, effect.is_coupled),
                    acts=effect.acts,
                    nonlinear_parameters=instance.nonlinear_parameters,
                    memory=form.internal_state,
                )
            )
    return effect_columns


def _derive_shaft(geometry: Geometry, joint: Joint, coupled: bool) -> dict[int, Fraction]:
    """The shaft's speed in the speeds of the free variables."""
    order = {moving.name: index for index, moving in enumerate(geometry.robot.moving_joints)}
    coupling = geometry.robot.coupling[joint.name] if coupled else {joint.name: 1.0}
    total: dict[int, Fraction] = {}
    for name, factor in coupling.items():
        for k, coefficient in geometry.forms[order[name]].items():
            total[k] = total.get(k, Fraction(0)) + parse_decimal_fraction(factor) * coefficient
    return {k: coefficient for k, coefficient in total.items() if coefficient}


def parse_decimal_fraction(value: float) -> Fraction:
    """Returns a coefficient of the robot file as the decimal fraction that was written."""
    return Fraction(repr(value))


# What effects read besides the motion: time, temperatures, inner states. Inputs `s` of the C.


WINDUP = ("windup", "windup_rate", "windup_acceleration")
"""Kinds of the three signals of an elastic joint: e = q_motor - q_link, e', e''."""


@dataclass(frozen=True)
class Signal:
    """One entry of the input `s`.

    Attributes:
        kind: one of `modeler.core.manifest.SIGNALS`.
        row: of the joint whose temperature or inner state it is; -1 for the time.
        value: as of a `SignalSpec`.
        follows: of a lag and of what it follows, that.
        shapes: values of the shapes in it.
        share: b of a Bouc-Wen loop.
    """

    kind: str
    row: int
    value: float = 0.0
    follows: Expression | None = None
    nonlinear_parameters: tuple[tuple[str, float], ...] = ()
    share: float = 1.0

    @property
    def prerequisites(self) -> tuple["Signal", ...]:
        """Returns the signals that it is stepped with; they stand before it."""
        if self.kind == "since":
            return (Signal("direction", self.row, self.value),)
        if self.kind == "lag":
            return (replace(self, kind="followed", value=0.0),)
        return tuple(self.input_signals.values())

    @property
    def input_signals(self) -> dict[str, "Signal"]:
        """Returns the signals that the followed expression reads, by the variable."""
        if self.kind != "followed" or self.follows is None:
            return {}
        return _find_signals(self.follows.names, self.row, dict(self.nonlinear_parameters))


def _find_signals(
    names: Collection[str], row: int, nonlinear_parameters: Mapping[str, float]
) -> dict[str, Signal]:
    """Signals that an equation reads, by the variable; not its inner state."""
    since = Signal("since", row, nonlinear_parameters.get(TURN, NOISE))
    signals = {"t": Signal("time", -1), "T": Signal("temperature", row), "since": since}
    return {name: signal for name, signal in signals.items() if name in names}


def collect_signals(columns: Sequence[StandardColumn]) -> tuple[Signal, ...]:
    """Returns the signals that any column reads, each once, in the order of the columns."""
    signals: dict[Signal, None] = {}

    def add_signal(signal: Signal) -> None:
        for needed in signal.prerequisites:
            add_signal(needed)
        signals.setdefault(signal)

    for column in columns:
        if isinstance(column, ShaftColumn):
            for part in column.parts:
                for signal in map_column_signals(part).values():
                    add_signal(signal)
    return tuple(signals)


def find_windups(geometry: Geometry) -> dict[int, tuple[Signal, ...]]:
    """Returns the signals e, e', e'' of elastic joints, by the free variable that is the motor's.

    The first has the stiffness, the second the damping as its value.
    """
    windups = {}
    for row, joint in enumerate(geometry.robot.joints):
        index, sizes = geometry.rows[row].index, geometry.robot.find_windup(joint.name)
        if sizes is not None and index is not None:
            (k,) = geometry.forms[index]  # of a joint that turns with no other
            windups[k] = tuple(map(Signal, WINDUP, [row] * 3, (*sizes, 0.0)))
    return windups


def map_column_signals(column: ShaftColumn) -> dict[str, Signal]:
    """Returns the signals that a column reads, by the variable of its equation."""
    names, memory = column.equation.names, column.memory
    signals = _find_signals(names, column.row, column.nonlinear_parameters)
    if "z" in names:
        if memory is None or memory.kind == "resonance":
            raise DerivationError(f"{column.name}: its inner state has no form in C")
        shapes, follows = column.nonlinear_parameters, memory.lagged_input
        shape_items = () if follows is None else tuple(sorted(shapes.items()))
        shape, share = shapes[memory.parameter], shapes.get(memory.share, 1.0)
        signals["z"] = Signal(memory.kind, column.row, shape, follows, shape_items, share)
    return signals


# The symbolic model: tau = phi chi, column by column, and what else is computed from it.


_REFERRED = ("rigid_body", "rotor_inertia", "viscous", "coulomb", "offset")
"""Effects whose parameters `[reference]` may state: those that depend on nothing else."""

_SMOOTH = ("rigid_body", "rotor_inertia", "viscous")

_OF_SPEEDS = {"wd": "w", "vd": "v", "U": "W", "f": "l", "n": "k", "fc": "lc", "nc": "kc"}

Entries = Mapping[tuple[int, int], Expr]
"""Structural nonzeros of a regressor: (joint, column) -> expression."""


@dataclass(frozen=True)
class SymbolicModel(ShortRepr):
    """The dynamics of a robot as expressions of one graph.

    Inputs of the graph: `q[0]`, `qd[0]`, `qdd[0]`, ... in the order of `robot.free`, which no
    geometric symbol can be named like, and the geometric symbols by name. Torques are those along
    the free variables; where loops tie these to each other, `closure` says how.

    Attributes:
        special: joints that follow others by relations which the loops imply at the given lengths
            and angles only.
        unproven: joints that seemed to follow others by a relation that was not proven.
        deflections: e, e', e'' of elastic joints, motor less link, by free variable, as another
            function has them than by the signals; None: the signals.
        motors: positions, speeds, accelerations of the motors by "q", "qd", "qdd", where they are
            not the inputs of these names.
    """

    robot: Robot
    geometry: Geometry
    graph: Graph
    columns: tuple[StandardColumn, ...]
    special: tuple[str, ...] = ()
    unproven: tuple[str, ...] = ()
    deflections: Mapping[int, Sequence[Expr]] | None = None
    motors: Mapping[str, Sequence[Expr]] = field(default_factory=dict)

    @property
    def names(self) -> tuple[str, ...]:
        """Returns names of the standard parameters, in column order."""
        return tuple(column.name for column in self.columns)

    @cached_property
    def algebra(self) -> GraphAlgebra:
        """Returns the graph as numbers for the recursions."""
        links = self.get_link_inputs("q") if self.windups else []
        return GraphAlgebra(self.graph, self.geometry, {k: links[k] for k in self.windups})

    @cached_property
    def windups(self) -> dict[int, tuple[Signal, ...]]:
        """Returns the signals e, e', e'' of elastic joints, by free variable."""
        return find_windups(self.geometry)

    @property
    def rigid(self) -> "SymbolicModel":
        """Returns the model whose positions are those of the links: no joint winds up."""
        return replace(self, deflections={}) if self.windups else self

    def get_link_inputs(self, kind: str) -> list[Expr]:
        """Returns "q", "qd" or "qdd" of the links: those of the motors less e, e' or e''."""
        inputs, order = self.get_inputs(kind), MOTOR_MOTION.index(kind)
        for k, signals in self.windups.items():
            if self.deflections is None:
                inputs[k] = inputs[k] - get_signal_symbol(self, signals[order])
            elif k in self.deflections:
                inputs[k] = inputs[k] - self.deflections[k][order]
        return inputs

    @cached_property
    def frames(self) -> list[Pose]:
        """Returns pose of every row in its antecedent."""
        return kinematics.compute_poses(self.geometry, self.algebra)

    def get_inputs(self, kind: str) -> list[Expr]:
        """Returns the symbols of `kind` "q", "qd", "qdd", "v" or "a", of the free variables."""
        if kind in self.motors:
            return list(self.motors[kind])
        return [self.graph.symbol(f"{kind}[{k}]") for k in range(self.geometry.coordinate_count)]

    @cached_property
    def closure(self) -> Closure | None:
        """Returns the loop closure that ties the free variables; None without loops.

        Raises:
            LoopError: the loops leave more or less free than is actuated, or cannot close.
        """
        return derive_closure(self.geometry, self.graph, self.frames, self.algebra)

    def reduce_to_free(self, rows: Sequence[Expr]) -> list[Expr]:
        """Returns torques along the free variables from those of the moving rows: F^T tau."""
        free_torques = [self.graph.constant(0)] * self.geometry.coordinate_count
        for form, torque in zip(self.geometry.forms, rows, strict=True):
            for k, coefficient in form.items():
                free_torques[k] = free_torques[k] + torque * coefficient
        return free_torques

    def derive_link_motions(
        self,
        qd: Sequence[Expr],
        qdd: Sequence[Expr],
        gravity: bool = True,
        v: Sequence[Expr] | None = None,
    ) -> list[Motion]:
        """Returns the motion of every link for speeds and accelerations of the free variables.

        Args:
            qd: speeds.
            qdd: accelerations.
            gravity: False without gravity.
            v: second speeds; see `MotionState`.
        """
        zero = self.graph.constant(0)
        down = [self.algebra.static(x) if gravity else zero for x in self.geometry.gravity]
        second = None if v is None else self.expand_to_rows(v)
        state = MotionState(self.expand_to_rows(qd), self.expand_to_rows(qdd), down, second)
        return kinematics.propagate_motions(self.geometry, self.frames, state, self.algebra)

    def expand_to_rows(self, free: Sequence[Expr]) -> list[Expr]:
        """Returns speeds of the moving rows from those of the free variables: F u."""
        return [combine_linearly(self.graph, form, free) for form in self.geometry.forms]

    @cached_property
    def regressor(self) -> Entries:
        """Returns structural nonzeros of phi in tau = phi chi, over all standard columns.

        Inertial columns by Newton-Euler in screw form: the wrench of one unit of a parameter,
        projected on every joint below; effect columns from their definition.
        """
        moved = self.derive_link_motions(self.get_link_inputs("qd"), self.get_link_inputs("qdd"))
        derive_effects = partial(derive_effect_entries, self)
        entries = self.assemble_entries(self.build_projection(moved), derive_effects)
        self._labels.update(self.graph.labels)
        return entries

    def build_projection(self, moved: Sequence[Motion]) -> Callable[[LinkColumn], dict[int, Expr]]:
        """Returns what gives {free variable: torque} per unit of a link's parameter."""
        free_screws = self.free_screws
        columns = [kinematics.compute_wrench_columns(motion) for motion in moved]

        def project_part(part: LinkColumn) -> dict[int, Expr]:
            force, moment = columns[part.row][part.prefix]
            screws = free_screws[part.row].items()
            return {k: kinematics.project_wrench(screw, force, moment) for k, screw in screws}

        return project_part

    def assemble_entries(
        self,
        link: Callable[[LinkColumn], Mapping[int, Expr]],
        shaft: Callable[[ShaftColumn], Mapping[int, Expr]],
    ) -> Entries:
        """Returns the structural nonzeros over all standard columns from those of their parts.

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
    def relabel_speeds(self) -> Iterator[None]:
        """Labels what recursions give while speeds stand in the place of accelerations."""
        self.graph.renamed_quantities = _OF_SPEEDS
        try:
            yield
        finally:
            self.graph.renamed_quantities = {}

    @cached_property
    def _labels(self) -> dict[int, Label]:
        """Those that stood when the regressor was there."""
        return {}

    @contextmanager
    def restore_labels(self) -> Iterator[None]:
        """Restores the labels of the regressor while a module is written."""
        graph, before = self.graph, self.graph.labels
        assert self.regressor
        graph.labels = self._labels.copy()
        try:
            yield
        finally:
            graph.labels = before

    @cached_property
    def free_screws(self) -> list[dict[int, Screw]]:
        """Returns for every row the screw of each free variable that moves it."""
        return kinematics.compute_free_screws(self.geometry, self.frames, self.algebra)

    @cached_property
    def signals(self) -> tuple[Signal, ...]:
        """Returns the signals that effects read besides the motion: the input `s`, in order."""
        windups = (signal for signals in self.windups.values() for signal in signals)
        return (*collect_signals(self.columns), *windups)

    def derive_reference_torque(self, kind: str) -> list[Expr]:
        """Returns torques along the free variables at the parameters of `[reference]`.

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
        return self.derive_torque(
            known, speeds=not still, accelerations=not still, effects=kind in ("torque", "axis")
        )

    def derive_torque(
        self,
        parameters: Mapping[int, Expr],
        *,
        speeds: bool = True,
        accelerations: bool = True,
        gravity: bool = True,
        effects: bool = True,
        links: bool = True,
    ) -> list[Expr]:
        """Returns tau by the Newton-Euler recursion for parameters by column; the others are 0.

        Args:
            parameters: {column: value}.
            speeds: False for standstill.
            accelerations: False for zero acceleration.
            gravity: False without gravity.
            effects: False without the effects' columns.
            links: False without the links.
        """
        zero = self.graph.constant(0)
        none = [zero] * self.geometry.coordinate_count
        qd = self.get_link_inputs("qd") if speeds else none
        qdd = self.get_link_inputs("qdd") if accelerations else none
        tau = list(none)
        if links:
            moved = self.derive_link_motions(qd, qdd, gravity)
            rows = self.collect_link_parameters(parameters)
            torques = kinematics.compute_inverse_dynamics(
                self.geometry, self.frames, moved, rows, zero
            )
            tau = self.reduce_to_free(torques)
        for place in parameters if effects else ():
            for part in self.columns[place].parts:
                if isinstance(part, ShaftColumn):
                    for joint, value in derive_effect_entries(self, part).items():
                        tau[joint] = tau[joint] + value * parameters[place]
        return tau

    def collect_link_parameters(self, parameters: Mapping[int, Expr]) -> list[dict[str, Expr]]:
        """Returns for each row the inertial parameters among `parameters`, by prefix."""
        rows: list[dict[str, Expr]] = [{} for _ in self.geometry.rows]
        for place, value in parameters.items():
            for part in self.columns[place].parts:
                if isinstance(part, LinkColumn):
                    rows[part.row][part.prefix] = value
        return rows

    def derive_inertia_matrix(
        self, parameters: Mapping[int, Expr], rotors: bool = True
    ) -> list[list[Expr]]:
        """Returns M(q) of the free variables, rotor inertias of the effects included or not."""
        zero = self.graph.constant(0)
        rows = self.collect_link_parameters(parameters)
        tree = kinematics.compute_inertia_matrix(self.geometry, self.frames, rows, zero)
        half = [self.reduce_to_free(line) for line in tree]
        matrix = [self.reduce_to_free([line[k] for line in half]) for k in range(len(half[0]))]
        for i, j, value in self.enumerate_rotor_inertias(parameters) if rotors else ():
            matrix[i][j] = matrix[i][j] + value
        return matrix

    def enumerate_rotor_inertias(
        self, parameters: Mapping[int, Expr]
    ) -> Iterator[tuple[int, int, Expr]]:
        """Yields (row, column, value) of what rotor inertias add to M."""
        for place, value in parameters.items():
            for part in self.columns[place].parts:
                if isinstance(part, ShaftColumn) and part.kind == "rotor_inertia":
                    for i, ci in part.shaft.items():
                        for j, cj in part.shaft.items():
                            yield i, j, value * (ci * cj)

    def derive_forward_kinematics(self) -> list[list[list[Expr]]]:
        """Returns [R | p], 3 x 4, of every moving row's frame in frame 0, in table order.

        The columns of R are the frame's axes x, y, z in frame 0; p is its origin, m.
        """
        base_frames = kinematics.compute_base_poses(self.geometry, self.frames, self.algebra)
        return [
            [[*(axis[i] for axis in axes), origin[i]] for i in range(3)]
            for row, (axes, origin) in zip(self.geometry.rows, base_frames, strict=True)
            if row.index is not None
        ]


# Columns of effects as expressions of the graph, from the equations that define them.


MOTOR_MOTION = ("q", "qd", "qdd")
"""What is measured: positions of motors, of which elastic joints are not the links'."""


def derive_effect_entries(
    model: SymbolicModel, column: ShaftColumn, motion: Sequence[str] = MOTOR_MOTION
) -> dict[int, Expr]:
    """Returns {free variable: torque along it per unit of the column's parameter}.

    Args:
        model: the robot's.
        column: of an effect.
        motion: names of the inputs that are its position, speed and acceleration.
    """
    if column.acts is EffectTarget.POSITION:
        return _derive_position_effect(model, column)
    torque = _evaluate_equation(model, column, motion)
    return {k: torque * coefficient for k, coefficient in column.shaft.items()}


def _evaluate_equation(
    model: SymbolicModel, column: ShaftColumn, motion: Sequence[str] = MOTOR_MOTION
) -> Expr:
    """The equation of the column on its shaft."""
    signals = map_column_signals(column)
    read = {name: get_signal_symbol(model, signal) for name, signal in signals.items()}
    shaft, values = column.shaft, column.nonlinear_parameters
    return _evaluate_on_shaft(model, column.equation, shaft, values, read, motion)


def get_signal_symbol(model: SymbolicModel, signal: Signal) -> Expr:
    """Returns the symbol of the signal in the input `s`."""
    return model.graph.symbol(f"s[{model.signals.index(signal)}]")


def evaluate_followed(model: SymbolicModel, signal: Signal, now: Mapping[Signal, Expr]) -> Expr:
    """Returns what a lag follows, with the present values of the signals that it reads."""
    index = model.geometry.rows[signal.row].index
    assert index is not None and signal.follows is not None
    read = {name: now[other] for name, other in signal.input_signals.items()}
    shaft = model.geometry.forms[index]
    values = dict(signal.nonlinear_parameters)
    return _evaluate_on_shaft(model, signal.follows, shaft, values, read, MOTOR_MOTION)


def _evaluate_on_shaft(
    model: SymbolicModel,
    equation: Expression,
    shaft: Mapping[int, Fraction],
    nonlinear_parameters: Mapping[str, float],
    read: Mapping[str, Expr],
    motion: Sequence[str],
) -> Expr:
    """An equation on a shaft; `read` are the signals by variable."""
    graph, names = model.graph, equation.names
    numbers = {name: Fraction(repr(float(value))) for name, value in nonlinear_parameters.items()}
    values: dict[str, Expr] = {name: graph.constant(number) for name, number in numbers.items()}
    for name, kind in zip(MOTION, motion, strict=True):
        values[name] = combine_along_shaft(model, shaft, kind)
        for joint, form in zip(model.robot.moving_joints, model.geometry.forms, strict=True):
            if name + joint.name in names - values.keys():
                values[name + joint.name] = combine_linearly(graph, form, model.get_inputs(kind))
    for name in ("load", "static", "torque"):
        if name in names:
            # Torque of the joint that the shaft is; motors of several joints read no load.
            inverse = {k: 1 / coefficient for k, coefficient in shaft.items()}
            values[name] = combine_linearly(graph, inverse, model.derive_reference_torque(name))
    zero = graph.constant(0)
    for name, value in read.items():
        values[name] = value - values.get(f"{name}0", zero) if name in ("t", "T") else value
    functions = {name: partial(graph.call, name) for name in FUNCTIONS} | {LAW: graph.law}
    pi = graph.constant(Fraction(repr(math.pi)))
    return graph.lift(equation.fold(values, functions, pi, graph.constant))


def combine_along_shaft(model: SymbolicModel, shaft: Mapping[int, Fraction], kind: str) -> Expr:
    """Returns position, speed or acceleration of a shaft."""
    return combine_linearly(model.graph, shaft, model.get_inputs(kind))


def _derive_position_effect(model: SymbolicModel, column: ShaftColumn) -> dict[int, Expr]:
    """Torque of the links at the reference, differentiated along a small change of position.

    The change is the column's equation, dq(q); speeds and accelerations change by its time
    derivatives. An encoder's error moves the rotor too.

    Raises:
        DerivationError: the equation has a part without derivative.
    """
    n = model.geometry.coordinate_count
    speeds = {f"q[{k}]": model.get_inputs("qd")[k] for k in range(n)}
    rates = speeds | {f"qd[{k}]": model.get_inputs("qdd")[k] for k in range(n)}
    dq = _evaluate_equation(model, column)
    try:
        (dv,) = differentiate([dq], speeds)
        (da,) = differentiate([dv], rates)
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
    moved = differentiate(model.derive_reference_torque(kind), direction)
    return {k: value for k, value in enumerate(moved) if not value.is_zero}
