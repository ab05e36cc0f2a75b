"""The robot as the user states it: data, no derivation."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from modeler.core.expression import Expression
from modeler.robot.joint import Joint

INERTIAL = ("XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M")
"""The ten standard inertial parameters of a link at the origin of its frame, in that frame
(Khalil and Dombre 2002, section 9.2): inertia [kg m2], first moments [kg m], mass [kg]."""

_EMPTY: Mapping = MappingProxyType({})


@dataclass(frozen=True)
class EffectUse:
    """An effect of the catalogue, and the joints that have it."""

    effect: str
    joints: tuple[str, ...]


@dataclass(frozen=True)
class PhysicalLink:
    """How a paper writes a link: mass, mass centre, inertia about the mass centre.

    Attributes:
        mass: [kg].
        centre: mass centre in frame j, m.
        inertia: XX XY XZ YY YZ ZZ about the mass centre, along the axes of frame j, kg m2.
    """

    mass: Expression
    centre: tuple[Expression, Expression, Expression]
    inertia: tuple[Expression, ...]


@dataclass(frozen=True)
class Limits:
    """Range of a joint for simulated motion: position [rad, m], speed and acceleration."""

    lower: float
    upper: float
    speed: float
    acceleration: float


@dataclass(frozen=True)
class Robot:
    """A serial or tree-structured robot.

    Attributes:
        gravity: acceleration of gravity in frame 0, m/s2.
        symbols: declared geometric symbols and their values, in file order; a value is a number
            or an expression without joint variables.
        joints: rows of the table; each stands after its antecedent.
        effects: physical effects beyond rigid links, in catalogue order.
        coupling: motor rows that turn with several joints: name of the joint whose motor it is ->
            {joint: coefficient}; motor speed = sum of coefficient * qd (gear ratio taken out).
        priority: names or patterns (`ZZ*`, `Ia?`) of parameters that are kept first when
            parameters group; the others follow in table order.
        parameters: nominal values of standard parameters, SI units.
        drive_gains: joint torque per unit of the logged drive current, by joint.
        limits: range of motion for simulation, by joint.
        physical: the letters of a paper for the links, by joint.
        terms: how a paper prints its coefficients (see `modeler.terms`).
        notes: source of the table and remarks, for people.
        text: the TOML text it was read from.
    """

    name: str
    title: str
    gravity: tuple[Expression, Expression, Expression]
    symbols: Mapping[str, Expression]
    joints: tuple[Joint, ...]
    effects: tuple[EffectUse, ...] = ()
    coupling: Mapping[str, Mapping[str, float]] = field(default_factory=lambda: _EMPTY)
    priority: tuple[str, ...] = ()
    parameters: Mapping[str, float] = field(default_factory=lambda: _EMPTY)
    drive_gains: Mapping[str, float] = field(default_factory=lambda: _EMPTY)
    limits: Mapping[str, Limits] = field(default_factory=lambda: _EMPTY)
    physical: Mapping[str, PhysicalLink] = field(default_factory=lambda: _EMPTY)
    terms: Mapping[str, object] = field(default_factory=lambda: _EMPTY)
    notes: str = ""
    text: str = ""

    @property
    def moving(self) -> tuple[Joint, ...]:
        """Rows with a joint variable, in table order: the order of q, qd, qdd, tau."""
        return tuple(joint for joint in self.joints if joint.moves)

    def joint(self, name: str) -> Joint:
        """Row of that name."""
        return next(joint for joint in self.joints if joint.name == name)

    def has_effect(self, effect: str, joint: str) -> bool:
        """True if that joint carries that effect."""
        return any(use.effect == effect and joint in use.joints for use in self.effects)

    def symbol_values(self) -> dict[str, float]:
        """Numbers of all declared symbols."""
        values: dict[str, float] = {}
        for name, expression in self.symbols.items():
            values[name] = expression.number(values)
        return values
