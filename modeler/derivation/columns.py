"""The standard parameters of a robot: which columns the regressor has, and in which order."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any, Self, TypeAlias, TypeGuard

from modeler.core.brief import ShortRepr
from modeler.core.errors import DerivationError
from modeler.core.expression import Expression
from modeler.derivation.geometry import Geometry
from modeler.effects import NOISE, TURN, EffectTarget, EnergyBlock, InternalState
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
        """The column on every row that has the parameter, each for itself."""
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
            columns += [
                build_link_column(prefix, row, joint)
                for prefix in robot.get_inertial_prefixes(joint.name)
            ]
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


@dataclass(frozen=True)
class Signal:
    """One entry of the input `s`.

    Attributes:
        kind: one of `modeler.core.manifest.SIGNALS`.
        row: of the joint whose temperature or inner state it is; -1 for the time.
        value: as of a `SignalSpec`.
        follows: of a lag and of what it follows, that.
        shapes: values of the shapes in it.
    """

    kind: str
    row: int
    value: float = 0.0
    follows: Expression | None = None
    nonlinear_parameters: tuple[tuple[str, float], ...] = ()

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
    signals = {
        "t": Signal("time", -1), "T": Signal("temperature", row),
        "since": Signal("since", row, nonlinear_parameters.get(TURN, NOISE)),
    }  # fmt: skip
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


def map_column_signals(column: ShaftColumn) -> dict[str, Signal]:
    """Returns the signals that a column reads, by the variable of its equation."""
    names, memory = column.equation.names, column.memory
    signals = _find_signals(names, column.row, column.nonlinear_parameters)
    if "z" in names:
        if memory is None or memory.kind == "resonance":
            raise DerivationError(f"{column.name}: its inner state has no form in C")
        shapes, follows = column.nonlinear_parameters, memory.lagged_input
        shape_items = () if follows is None else tuple(sorted(shapes.items()))
        signals["z"] = Signal(
            memory.kind, column.row, shapes[memory.parameter], follows, shape_items
        )
    return signals
