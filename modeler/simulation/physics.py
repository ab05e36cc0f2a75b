"""Effects beyond rigid links as physics: torques on shafts, inertias of shafts, inner states.

To simulate one more effect, add an `EffectPhysics` to `PHYSICS`. This is deliberately a second
statement of each effect, apart from the catalogue from which regressors are made.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import casadi as ca
import numpy as np


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
class EffectPhysics:
    """One simulated effect.

    Attributes:
        effect: id as in robot files.
        prefixes: of its parameters; the joint's name follows.
        on_motor: True if it acts on the motor shaft of `[coupling]`, False if on the joint.
        draw: plausible parameters, prefix -> value, SI.
        act: its contribution, given its parameters by prefix.
        signed: prefixes that may be negative.
    """

    effect: str
    prefixes: tuple[str, ...]
    on_motor: bool
    draw: Callable[[np.random.Generator, ShaftScale], dict[str, float]]
    act: Callable[[Shaft, Mapping[str, float]], Contribution]
    signed: tuple[str, ...] = ()


def dry_friction(shaft: Shaft, level: ca.SX | float) -> ca.SX:
    """Friction of that level against the motion, nearly independent of the speed."""
    # sign(v) with a core 1/1000 of the top speed wide: the joint creeps there instead of sticking,
    # and the equation stays one that Runge-Kutta steps can follow.
    return level * ca.tanh(shaft.speed / shaft.settling)


PHYSICS: Mapping[str, EffectPhysics] = {
    physics.effect: physics
    for physics in (
        EffectPhysics(
            "rotor_inertia",
            ("Ia",),
            on_motor=False,
            draw=lambda rng, scale: {"Ia": scale.inertia * rng.uniform(0.2, 0.6)},
            act=lambda shaft, value: Contribution(inertia=value["Ia"]),
        ),
        EffectPhysics(
            "viscous",
            ("Fv",),
            on_motor=False,
            draw=lambda rng, scale: {"Fv": scale.torque * rng.uniform(0.05, 0.15) / scale.speed},
            act=lambda shaft, value: Contribution(torque=value["Fv"] * shaft.speed),
        ),
        EffectPhysics(
            "coulomb",
            ("Fs",),
            on_motor=False,
            draw=lambda rng, scale: {"Fs": scale.torque * rng.uniform(0.06, 0.15)},
            act=lambda shaft, value: Contribution(torque=dry_friction(shaft, value["Fs"])),
        ),
        EffectPhysics(
            "offset",
            ("Off",),
            on_motor=False,
            draw=lambda rng, scale: {
                "Off": scale.torque * rng.choice([-1.0, 1.0]) * rng.uniform(0.01, 0.04)
            },
            act=lambda shaft, value: Contribution(torque=ca.SX(value["Off"])),
            signed=("Off",),
        ),
        EffectPhysics(
            "coupled_inertia",
            ("Iam",),
            on_motor=True,
            draw=lambda rng, scale: {"Iam": scale.inertia * rng.uniform(0.1, 0.3)},
            act=lambda shaft, value: Contribution(inertia=value["Iam"]),
        ),
        EffectPhysics(
            "coupled_friction",
            ("Fvm", "Fsm"),
            on_motor=True,
            draw=lambda rng, scale: {
                "Fvm": scale.torque * rng.uniform(0.03, 0.1) / scale.speed,
                "Fsm": scale.torque * rng.uniform(0.04, 0.1),
            },
            act=lambda shaft, value: Contribution(
                torque=value["Fvm"] * shaft.speed + dry_friction(shaft, value["Fsm"])
            ),
        ),
    )
}
"""The effects that can be simulated, by id."""
