"""Effects beyond rigid links as physics: torques on shafts, inertias of shafts, inner states.

To simulate one more effect of robot files, add an `EffectPhysics` to `PHYSICS`; one that the robot
file lacks is a `HiddenKind` in `hidden.py`. This is deliberately a second statement of each effect,
apart from the catalogue from which regressors are made.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal, TypeVar

import casadi as ca
import numpy as np

from modeler.simulation.rigid import Body

Values = Mapping[str, float]


@dataclass(frozen=True)
class Shaft:
    """What an effect acts on: the joint itself, or a motor that turns with several joints.

    Attributes:
        position: rad or m.
        speed: rad/s or m/s.
        settling: speed above which dry friction is fully developed, rad/s or m/s.
        name: prefix for symbols of inner states.
        load: torque that the links ask of it, inertia and gravity together, N m or N.
        top: largest speed it is made for, rad/s or m/s.
    """

    position: ca.SX
    speed: ca.SX
    settling: float
    name: str
    load: ca.SX
    top: float


@dataclass(frozen=True)
class Contribution:
    """What an effect adds on its shaft.

    Attributes:
        torque: taken from the motor: M qdd + h + torque = tau; N m or N.
        inertia: moves with the shaft, kg m2 or kg.
        state: (k, 1) symbols of inner states, all 0 at the start.
        rate: (k, 1) their time derivatives.
        fastest: rate at which inner states follow at top speed, 1/s; 0 if the speed is no matter.
        temperature: what a thermometer on the joint reads, degC; None if there is none.
    """

    torque: ca.SX = field(default_factory=lambda: ca.SX(0))
    inertia: float = 0.0
    state: ca.SX = field(default_factory=lambda: ca.SX(0, 1))
    rate: ca.SX = field(default_factory=lambda: ca.SX(0, 1))
    fastest: float = 0.0
    temperature: ca.SX | None = None


Act = Callable[[Shaft, Values], Contribution]


@dataclass(frozen=True)
class ShaftScale:
    """What is large and small on a joint, for plausible values.

    Attributes:
        torque: rms torque of the links along lively motion, N m or N.
        speed: top speed, rad/s or m/s.
        inertia: typical diagonal element of the inertia matrix, kg m2 or kg.
    """

    torque: float
    speed: float
    inertia: float


@dataclass(frozen=True)
class Site(ShaftScale):
    """What is large and small where a hidden effect sits; known friction is in the torque.

    Attributes:
        span: range of motion, rad or m.
        angular: True if the joint turns.
        own: the joint's parameters that the robot file knows, by prefix (Fv, Fs, Ia).
        body: the link that the joint moves, or the last one.
        mass: of all links, kg.
        lever: torque or force of a joint per newton at the last body, the largest of all joints
            per rms torque: 1/N.
        rate: samples per second.
        duration: of the measurement, s.
    """

    span: float
    angular: bool
    joint_parameters: Values
    body: Body
    mass: float
    lever: float
    rate: float
    duration: float


Scale = TypeVar("Scale", bound=ShaftScale)


def build_share_draw(
    low: float, high: float, of: str = "", either: bool = False
) -> Callable[[np.random.Generator, ShaftScale], float]:
    """A plausible value: uniform from low to high, as a share of what is large on the shaft.

    Args:
        low: smallest share.
        high: largest share.
        of: what it is a share of, as "torque" or "torque/speed"; "": of 1.
        either: True if it has either sign.
    """
    over, _, under = of.partition("/")

    def draw_value(rng: np.random.Generator, scale: ShaftScale) -> float:
        value = (draw_sign(rng) if either else 1.0) * rng.uniform(low, high)
        value *= getattr(scale, over) if over else 1.0
        return float(value / getattr(scale, under) if under else value)

    return draw_value


def draw_sign(rng: np.random.Generator, scale: ShaftScale | None = None) -> float:
    """-1 or 1, whatever the scale."""
    return float(rng.choice([-1.0, 1.0]))


def combine_draws(
    **draws: Callable[[np.random.Generator, Scale], float],
) -> Callable[[np.random.Generator, Scale], dict[str, float]]:
    """Values by name, each drawn by itself, in this order."""
    return lambda rng, scale: {name: draw(rng, scale) for name, draw in draws.items()}


@dataclass(frozen=True)
class EffectPhysics:
    """One simulated effect of robot files.

    Attributes:
        effect: id as in robot files.
        prefixes: of its parameters; the joint's name follows.
        draw: plausible parameters, prefix -> value, SI.
        act: its contribution, given its parameters by prefix.
        on_motor: True if it acts on the motor shaft of `[coupling]`, False if on the joint.
        signed: prefixes that may be negative.
    """

    effect: str
    prefixes: tuple[str, ...]
    draw: Callable[[np.random.Generator, ShaftScale], dict[str, float]]
    act: Act
    on_motor: bool = False
    signed: tuple[str, ...] = ()


@dataclass(frozen=True)
class HiddenKind:
    """One effect that can be hidden.

    Attributes:
        effect: id.
        where: what it sits on. joint: with a motor; lever: the same, and turning; pair: a joint and
            the next one; geared: a joint with a rotor inertia; link: between the first and the
            last; passive: a joint of a loop without motor; system: no joint.
        draw: plausible values, by name; these are all the values it has.
        act: on a shaft: what it adds there.
        role: what it changes: a torque on a shaft, what lies between motor and link, the bodies,
            the direction of gravity, a force on the last link, what is measured.
        spring: of a transmission: torque by which it pulls the link back, from how far the link is
            ahead of the motor and how fast that grows.
        replaces: effects of the robot file that are not simulated beside it on the same joint.
        signed: values that may be negative or 0.
        loops: True if it can be simulated on robots with loops.
    """

    effect: str
    where: Literal["joint", "lever", "pair", "geared", "link", "passive", "system"]
    draw: Callable[[np.random.Generator, Site], dict[str, float]]
    act: Act | None = None
    role: Literal["shaft", "transmission", "body", "gravity", "push", "sensor"] = "shaft"
    spring: Callable[[ca.SX, ca.SX, Values], ca.SX] | None = None
    replaces: tuple[str, ...] = ()
    signed: tuple[str, ...] = ()
    loops: bool = True


def compute_dry_friction(shaft: Shaft, level: ca.SX | float) -> ca.SX:
    """Friction of that level against the motion, nearly independent of the speed."""
    # sign(v) with a core 1/1000 of the top speed wide: the joint creeps there instead of sticking,
    # and the equation stays one that Runge-Kutta steps can follow.
    return level * ca.tanh(shaft.speed / shaft.settling)


def build_inertia_act(inertia: str) -> Act:
    """The shaft's own inertia, the value of that name."""
    return lambda shaft, value: Contribution(inertia=value[inertia])


def build_friction_act(viscous: str, dry: str) -> Act:
    """Viscous and dry friction, the values of these names."""
    return lambda shaft, value: Contribution(
        value[viscous] * shaft.speed + compute_dry_friction(shaft, value[dry])
    )


PHYSICS: Mapping[str, EffectPhysics] = {
    physics.effect: physics
    for physics in (
        EffectPhysics(
            "rotor_inertia",
            ("Ia",),
            combine_draws(Ia=build_share_draw(0.2, 0.6, "inertia")),
            build_inertia_act("Ia"),
        ),
        EffectPhysics(
            "viscous",
            ("Fv",),
            combine_draws(Fv=build_share_draw(0.05, 0.15, "torque/speed")),
            lambda shaft, value: Contribution(value["Fv"] * shaft.speed),
        ),
        EffectPhysics(
            "coulomb",
            ("Fs",),
            combine_draws(Fs=build_share_draw(0.06, 0.15, "torque")),
            lambda shaft, value: Contribution(compute_dry_friction(shaft, value["Fs"])),
        ),
        EffectPhysics(
            "offset",
            ("Off",),
            combine_draws(Off=build_share_draw(0.01, 0.04, "torque", either=True)),
            lambda shaft, value: Contribution(ca.SX(value["Off"])),
            signed=("Off",),
        ),
        EffectPhysics(
            "coupled_inertia",
            ("Iam",),
            combine_draws(Iam=build_share_draw(0.1, 0.3, "inertia")),
            build_inertia_act("Iam"),
            on_motor=True,
        ),
        EffectPhysics(
            "coupled_friction",
            ("Fvm", "Fsm"),
            combine_draws(
                Fvm=build_share_draw(0.03, 0.1, "torque/speed"),
                Fsm=build_share_draw(0.04, 0.1, "torque"),
            ),
            build_friction_act("Fvm", "Fsm"),
            on_motor=True,
        ),
    )
}
"""The effects that can be simulated, by id."""
