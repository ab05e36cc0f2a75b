"""What the simulator knows of an effect that it can hide: where it sits, its size, its physics."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal

import casadi as ca
import numpy as np

from modeler.simulation.physics import Contribution, Shaft, ShaftScale
from modeler.simulation.rigid import Body

Where = Literal["joint", "lever", "pair", "geared", "link", "passive", "system"]
"""joint: with a motor; lever: the same, and turning; pair: a joint and the next one; geared: a
joint with a rotor inertia; link: between the first and the last; passive: a joint of a loop without
motor; system: no joint."""

Role = Literal["shaft", "transmission", "body", "gravity", "push", "sensor"]
"""What the effect changes: a torque on a shaft, what lies between motor and link, the bodies, the
direction of gravity, a force on the last link, what is measured."""

Values = Mapping[str, float]


@dataclass(frozen=True)
class Site:
    """What is large and small where an effect sits, for plausible sizes.

    Attributes:
        torque: rms torque of the joint along lively motion, known friction included, N m or N.
        speed: top speed, rad/s or m/s.
        inertia: typical inertia of the links about the joint, kg m2 or kg.
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

    torque: float
    speed: float
    inertia: float
    span: float
    angular: bool
    own: Values
    body: Body
    mass: float
    lever: float
    rate: float
    duration: float

    @property
    def scale(self) -> ShaftScale:
        """The part of it that the physics of robot files asks for."""
        return ShaftScale(self.torque, self.speed, self.inertia)


@dataclass(frozen=True)
class HiddenKind:
    """One effect that can be hidden.

    Attributes:
        effect: id.
        where: what it sits on.
        draw: plausible values, by name; these are all the values it has.
        role: what it changes.
        act: on a shaft: what it adds there.
        spring: of a transmission: torque by which it pulls the link back, from how far the link is
            ahead of the motor and how fast that grows.
        replaces: effects of the robot file that are not simulated beside it on the same joint.
        signed: values that may be negative or 0.
        loops: True if it can be simulated on robots with loops.
    """

    effect: str
    where: Where
    draw: Callable[[np.random.Generator, Site], dict[str, float]]
    role: Role = "shaft"
    act: Callable[[Shaft, Values], Contribution] | None = None
    spring: Callable[[ca.SX, ca.SX, Values], ca.SX] | None = None
    replaces: tuple[str, ...] = ()
    signed: tuple[str, ...] = ()
    loops: bool = True


def either_sign(rng: np.random.Generator) -> float:
    """-1 or 1."""
    return float(rng.choice([-1.0, 1.0]))
