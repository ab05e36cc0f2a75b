"""What an effect is: everything that any stage needs to know of it."""

import enum
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from modeler.core.expression import Expression
from modeler.core.json import ShortRepr


class EnergyBlock(enum.Enum):
    """Where a column stands in the energy rows that decide grouping (see `modeler.derivation`).

    With v the speed of the shaft (the joint's, or the motor's where motors are coupled), the column
    is the derivative of that function; columns of different blocks never group.
    """

    KINETIC = "v**2: twice the kinetic energy"
    POWER = "v: power of a constant force"
    RAYLEIGH = "v**2: Rayleigh dissipation function"
    COULOMB = "|v|: dissipated power of dry friction"
    OWN = "of no other column: it never groups"


class EffectTarget(enum.Enum):
    """On what an effect acts; the meaning of the equations of its columns."""

    JOINT = "adds equation * parameter to the torque of its joint"
    MOTOR = "the same on the shaft of a motor that turns with several joints ([coupling])"
    POSITION = "moves the position that the links have by equation * parameter from the measured"
    TORQUE = "adds equation * parameter to the torques of all joints alike"
    PASSIVE = "adds equation * parameter to the torque of a joint without motor, in a loop"
    GRAVITY = "turns the direction of gravity"
    LINK = "adds a body to a link"
    WINDOW = "pushes on the last link for a while"


class Requirement(enum.Enum):
    """What must be true of the robot for the values of an effect to be believed."""

    GRAVITY = "gravity turns its joint"
    CURVE = "its torque bends over the stroke by more than is left unexplained"
    REST = "its rest position q0 lies in the motion, unless the model has an offset"
    TILT = "gravity keeps its size: it only turns"
    MASS = "the body has no negative mass"
    GAIN = "the gain of a drive is positive, and within ten times of the one given"
    LAG = "its torque is the filtered one, not one that is only delayed"
    FRICTION = "it is a part of the friction of its joint, never larger than all of it"


SignatureAxis = Literal[
    "q", "v", "a", "load", "torque", "rate", "t", "T", "since", "travel", "waves", "itself"
]
"""The axis against which a residual shows an effect: a variable of `VARIABLES`; the travel since
the joint last turned back; waves per turn; or the torque of the effect itself, where it is a
function of no single quantity."""

SCALES: Mapping[str, tuple[str, str]] = {
    "speed": ("rad/s", "m/s"),  # fractions of the joint's top speed
    "travel": ("rad", "m"),  # for a prismatic joint, thirds of its range of motion
    "place": ("rad", "m"),  # the same from the middle of the motion
    "bend": ("1/rad^2", "1/m^2"),  # one over the square of a travel
    "load": ("N m", "N"),  # fractions of the joint's rms load
    "turn": ("1", "1/m"),  # one per rad; for a prismatic joint, a turn per stroke
    "number": ("1", "1"),
    "angle": ("rad", "rad"),
    "stiffness": ("N m/rad", "N/m"),
    "damping": ("N m s/rad", "N s/m"),
    "seconds": ("s", "s"),
    "hertz": ("Hz", "Hz"),
    "waves": ("1", "1/m"),  # per turn; found in the order spectrum where the grid has none
    "moment": ("1", "1"),  # 1, or 0 where the first moment of the link has that part
    "own": ("1", "1"),  # SI, as a robot file gives it for an effect of its own
}
"""What the grid of a shape parameter is measured in -> its unit where the joint turns, slides."""


@dataclass(frozen=True)
class NonlinearParameter(ShortRepr):
    """A parameter that enters a column nonlinearly; found on a grid, then refined.

    Attributes:
        name: in the equations.
        scale: what the grid is measured in, one of `SCALES`.
        grid: values tried first.
        limits: least and largest value that make sense; equal where only those of the grid do.
        meaning: plain language.
    """

    name: str
    scale: str
    grid: tuple[float, ...]
    limits: tuple[float, float]
    meaning: str

    @property
    def is_continuous(self) -> bool:
        """Returns True if values between those of the grid make sense."""
        return self.limits[0] < self.limits[1]

    def get_unit(self, linear: bool) -> str:
        """Returns the unit on a prismatic or a revolute joint; "1" for a number."""
        return SCALES[self.scale][linear]


@dataclass(frozen=True)
class InternalState:
    """The inner state z of an effect with memory.

    Attributes:
        kind: "slip": z' = (v/d)(1 - z sign v), the bristle of Dahl's friction; "bouc_wen":
            z' = (v - b |v| z - (1 - b) v |z|)/d, the loop of Bouc and Wen; "resonance": the
            load through the oscillator z'' = w^2 (load - z) - 2 zeta w z', w = 2 pi f; "lag":
            z' = (x - z)/tau; "windup": of an elastic joint, e = q_motor - q_link, by which all
            that the links do is behind: no column reads it.
        shape: name of the shape parameter that sets it (d, f, tau or K).
        damping: of a resonance or a windup, name of the shape parameter that is zeta or D.
        share: of a Bouc-Wen loop, name of the shape parameter that is b.
        follows: of a lag, x.
    """

    kind: Literal["slip", "bouc_wen", "resonance", "lag", "windup"]
    parameter: str
    damping: str = ""
    lagged_input: Expression | None = None
    share: str = ""


@dataclass(frozen=True)
class EffectColumn(ShortRepr):
    """One column: torque of the joint = equation * parameter.

    Attributes:
        prefix: parameter name without the joint, e.g. "Fv".
        equation: in `VARIABLES` and the shape parameters of its form.
        unit_revolute: unit of the parameter on a revolute joint.
        unit_prismatic: the same on a prismatic joint.
        kind: rotor_inertia | friction | offset | other: how base parameters are counted.
        block: its energy function, for grouping.
        nonnegative: physics allows no negative value.
        largest: magnitude beyond which it is another effect, SI.
    """

    prefix: str
    equation: Expression
    unit_revolute: str
    unit_prismatic: str
    kind: str
    block: EnergyBlock
    nonnegative: bool
    largest: float = math.inf


VARIABLES = {
    "q": "position of the joint or shaft, rad or m",
    "v": "its speed",
    "a": "its acceleration",
    "load": "torque that the links ask of the joint, inertia and gravity together",
    "static": "the part of it that gravity asks",
    "torque": "torque of the whole model on the joint",
    "rate": "d torque / dt",
    "t": "time of the log, s",
    "T": "temperature of the joint less its mean over the logs, K",
    "since": "time since the joint last turned back, s; before, since the start of the stretch",
    "z": "inner state of the effect",
}
"""What the equation of a column may use; SI units."""

TURN = "back"
"""Shape of an effect that reads `since`: a joint that has come back by more has turned back."""

NOISE = 3e-3
"""rad or m of `TURN` where an effect does not say it: two counts of 2**12 in a turn."""

MOTION = ("q", "v", "a")
"""Those that it may read of another joint too, whose name follows: `v3`."""


@dataclass(frozen=True)
class Form(ShortRepr):
    """One way to write an effect: its columns and what shapes them.

    Attributes:
        columns: what it adds to the regressor.
        shapes: nonlinear parameters of all its columns.
        memory: of the inner state z, if there is one.
    """

    columns: tuple[EffectColumn, ...]
    nonlinear_parameters: tuple[NonlinearParameter, ...] = ()
    internal_state: InternalState | None = None

    @property
    def free_parameters(self) -> tuple[NonlinearParameter, ...]:
        """Returns shapes that a robot file must state: those whose grid does not fix them."""
        return tuple(shape for shape in self.nonlinear_parameters if len(shape.grid) != 1)

    @property
    def is_windup(self) -> bool:
        """Returns True of an elastic joint, which has no columns."""
        return self.internal_state is not None and self.internal_state.kind == "windup"

    @cached_property
    def names(self) -> frozenset[str]:
        """Returns variables that its equations use: of `VARIABLES`, and as `v3` of other joints."""
        equations = [column.equation for column in self.columns]
        if self.internal_state is not None and self.internal_state.lagged_input is not None:
            equations.append(self.internal_state.lagged_input)
        used = frozenset().union(*(equation.names for equation in equations))
        return used - {shape.name for shape in self.nonlinear_parameters}

    @cached_property
    def other_joint_names(self) -> frozenset[str]:
        """Returns the names in the equations that stand for other joints."""
        return self.names - VARIABLES.keys()

    def find_references_to(self, joint: str) -> list[str]:
        """Returns names of that joint in the equations: the effect cannot act on it therefore."""
        return sorted(name for name in self.other_joint_names if name[1:] == joint)


@dataclass(frozen=True)
class Effect(ShortRepr):
    """A physical effect, defined once.

    Attributes:
        id: as in robot files.
        aliases: other names of the same column, by algebra.
        title: plain language.
        equation: for people.
        forms: how it may be written; the first is the usual one.
        acts: on what.
        family: friction | load | transmission | measurement | inertia, or the id of an effect of a
            robot file: leftovers of one family on one joint refine each other.
        negative_meaning: what a value below zero means, where that is no missing effect but mends
            the form of one in the model; empty elsewhere.
        is_rotary_only: True if only a joint that turns can have it.
        is_rarely_negative: True if its first parameter seldom is: an alternative that explains as
            much is likelier then.
        is_timing_sensitive: True if errors of timing or of the encoder imitate it: the commanded
            motion decides.
        signature: how it shows itself in the residual.
        signature_axis: the axis on which it does.
        confounders: what it is mistaken for, and which motion distinguishes them.
        equivalent_effects: ids of effects that no data distinguish from it.
        sign: of its last parameter, where that with the other is another effect; else 0.
        needs: what must be true of the robot for its values to be believed.
        is_rare: True if an alternative that explains as much is likelier.
        is_repeatable: True if a joint may have it several times, with other shapes.
        orders: of waves that are proposed for it, least and largest; None: those of its grid only.
        acts_on_whole_axis: True if it moves motor and links: the encoder shows both wrongly.
        is_on_last_link: True if it is carried by the last link.
        has_impacts: True if it shows by bursts after the load changes sign.
        obstacle: why it cannot be put into a model, and what to do; empty if it can.
        range: sign and range that physics allows.
        source: where it is described.
    """

    id: str
    aliases: tuple[str, ...]
    title: str
    equation: str
    forms: tuple[Form, ...]
    acts: EffectTarget
    family: str
    signature: str
    signature_axis: SignatureAxis
    confounders: str
    range: str
    source: str
    equivalent_effects: tuple[str, ...] = ()
    sign: int = 0
    needs: tuple[Requirement, ...] = ()
    is_rare: bool = False
    is_repeatable: bool = False
    orders: tuple[float, float] | None = None
    acts_on_whole_axis: bool = False
    is_on_last_link: bool = False
    has_impacts: bool = False
    obstacle: str = ""
    is_rotary_only: bool = False
    is_rarely_negative: bool = False
    is_timing_sensitive: bool = False
    negative_meaning: str = ""

    @property
    def columns(self) -> tuple[EffectColumn, ...]:
        """Returns the columns of the first form."""
        return self.forms[0].columns

    @property
    def is_learned(self) -> bool:
        """Returns True of a law that was learned, which is no physics."""
        return any(column.equation.law is not None for column in self.columns)

    def refines_model_term(self, value: float) -> bool:
        """Returns True if that value of its first parameter refines a term of the model."""
        return self.negative_meaning != "" and value < 0.0

    @property
    def is_oscillator(self) -> bool:
        """Returns True if it is an oscillator."""
        return any(
            form.internal_state and form.internal_state.kind == "resonance" for form in self.forms
        )

    @property
    def can_be_stated(self) -> bool:
        """Returns True if a robot file may name it: its columns depend on the joints' motion."""
        acts = self.acts in (
            EffectTarget.JOINT,
            EffectTarget.MOTOR,
            EffectTarget.POSITION,
            EffectTarget.PASSIVE,
        )
        return acts and (not self.obstacle or self.usual_form.is_windup)

    @property
    def usual_form(self) -> Form:
        """Returns the form that a robot file usually states: the first, or an elastic joint's."""
        return next((form for form in self.forms if form.is_windup), self.forms[0])

    @property
    def is_coupled(self) -> bool:
        """Returns True if it acts on the shaft of a motor that turns with several joints."""
        return self.acts is EffectTarget.MOTOR
