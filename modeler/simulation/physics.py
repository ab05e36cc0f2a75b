"""Effects beyond rigid links as physics: torques on shafts, inertias of shafts, inner states.

To simulate one more effect of robot files, add an `EffectPhysics` to `PHYSICS`; one that the robot
file lacks is a `HiddenKind`, below. This is deliberately a second statement of each effect,
apart from the catalogue from which regressors are made.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal, TypeVar

import casadi as ca
import numpy as np

from modeler.core.errors import RobotError
from modeler.simulation.rigid import Body
from modeler.simulation.thresholds import THRESHOLDS

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
    """Returns plausible value: uniform from low to high, as a share of what is large on the shaft.

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
    """Returns -1 or 1, whatever the scale."""
    return float(rng.choice([-1.0, 1.0]))


def combine_draws(
    **draws: Callable[[np.random.Generator, Scale], float],
) -> Callable[[np.random.Generator, Scale], dict[str, float]]:
    """Returns values by name, each drawn by itself, in this order."""
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
    """Returns friction of that level against the motion, nearly independent of the speed."""
    # sign(v) with a core 1/1000 of the top speed wide: the joint creeps there instead of sticking,
    # and the equation stays one that Runge-Kutta steps can follow.
    return level * ca.tanh(shaft.speed / shaft.settling)


def build_inertia_act(inertia: str) -> Act:
    """Returns the shaft's own inertia, the value of that name."""
    return lambda shaft, value: Contribution(inertia=value[inertia])


def build_friction_act(viscous: str, dry: str) -> Act:
    """Returns viscous and dry friction, the values of these names."""
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


# Physics that a simulated machine can have and its robot file not: one table, an entry per effect.


# Friction without memory: torques that follow speed, position and load at once.


def _compute_stribeck(shaft: Shaft, value: Values) -> Contribution:
    part = ca.exp(-((shaft.speed / value["speed"]) ** 2))
    return Contribution(compute_dry_friction(shaft, value["extra"] * part))


def _compute_asymmetric_viscous(shaft: Shaft, value: Values) -> Contribution:
    rounded = ca.sqrt(shaft.speed**2 + shaft.settling**2) - shaft.settling
    return Contribution(value["coefficient"] * rounded)


def _compute_nonlinear_viscous(shaft: Shaft, value: Values) -> Contribution:
    size = ca.sqrt(shaft.speed**2 + shaft.settling**2)
    return Contribution(value["coefficient"] * size ** (value["power"] - 1) * shaft.speed)


def _draw_nonlinear_viscous(rng: np.random.Generator, site: Site) -> dict[str, float]:
    power = float(rng.choice([0.5, 2.0, 3.0]))
    return {"coefficient": rng.uniform(0.15, 0.3) * site.torque / site.speed**power, "power": power}


def _compute_position_friction(shaft: Shaft, value: Values) -> Contribution:
    turn = value["order"] * shaft.position - value["phase"]
    return Contribution(compute_dry_friction(shaft, value["level"] * (1 + ca.cos(turn))))


def _compute_single_order(rng: np.random.Generator, site: Site) -> float:
    """Something turns once with a joint that turns, once per range with one that slides."""
    return 1.0 if site.angular else 2 * np.pi / site.span


# Friction with memory: bristles, cables, heat.


_AMBIENT = 25.0  # degC


def _compute_presliding(shaft: Shaft, value: Values) -> Contribution:
    """Bristles (Canudas de Wit et al. 1995): F = s0 z + s1 z', z' = v - |v| z / distance."""
    z = ca.SX.sym(f"bristle_{shaft.name}")
    rate = shaft.speed - ca.fabs(shaft.speed) * z / value["distance"]
    torque = value["level"] / value["distance"] * z + value["damping"] * rate
    fastest = THRESHOLDS.speed_overshoot * shaft.top / value["distance"]
    return Contribution(torque, state=z, rate=rate, fastest=fastest)


def _draw_presliding(rng: np.random.Generator, site: Site) -> dict[str, float]:
    level = site.joint_parameters.get("Fs") or rng.uniform(0.1, 0.2) * site.torque
    distance = rng.uniform(5e-4, 3e-3) * site.span
    inertia = site.inertia + site.joint_parameters.get("Ia", 0.0)
    damping = 2 * THRESHOLDS.bristle_damping_ratio * np.sqrt(level / distance * inertia)
    return {"level": level, "distance": distance, "damping": float(damping)}


def _compute_cable_hysteresis(shaft: Shaft, value: Values) -> Contribution:
    """Bouc and Wen's loop: F = level z, z' = (v - (b |v| z + (1 - b) v |z|) ) / width."""
    z, v = ca.SX.sym(f"cable_{shaft.name}"), shaft.speed
    beta = THRESHOLDS.bouc_wen_beta
    back = beta * ca.fabs(v) * z + (1 - beta) * v * ca.fabs(z)
    rate = (v - back) / value["width"]
    fastest = THRESHOLDS.speed_overshoot * shaft.top / value["width"]
    return Contribution(value["level"] * z, state=z, rate=rate, fastest=fastest)


def _compute_warming(shaft: Shaft, value: Values) -> Contribution:
    """Friction that heats its joint and falls by half per 30 K: time T' = R P - (T - ambient)."""
    warmer = ca.SX.sym(f"heat_{shaft.name}")  # than at the start, K
    above = warmer + value["start"]
    fallen = 2 ** (-above / THRESHOLDS.friction_halving_temperature)
    torque = fallen * (value["Fv"] * shaft.speed + compute_dry_friction(shaft, value["Fs"]))
    rate = (value["heating"] * torque * shaft.speed - above) / value["time"]
    return Contribution(torque, state=warmer, rate=rate, temperature=_AMBIENT + above)


def _draw_warming(rng: np.random.Generator, site: Site) -> dict[str, float]:
    viscous = site.joint_parameters.get("Fv") or rng.uniform(0.1, 0.2) * site.torque / site.speed
    dry = site.joint_parameters.get("Fs") or rng.uniform(0.1, 0.2) * site.torque
    usual = 0.35 * site.speed  # mean speed of lively motion
    return {
        "Fv": viscous,
        "Fs": dry,
        # Cold friction would warm the joint by 40 to 70 K.
        "heating": rng.uniform(40.0, 70.0) / ((viscous * usual + dry) * usual),
        "time": rng.uniform(25.0, 60.0),
        "start": 0.0,
    }


# Torques that follow the position: springs, ripples, transmissions that give way.


def _compute_lever(shaft: Shaft, value: Values) -> tuple[ca.SX, ca.SX]:
    """Length of a spring between a point on the link and one on the base, and its slope in q."""
    b, h = value["lever"], value["base"]
    turn = shaft.position - value["angle"]
    length = ca.sqrt(b**2 + h**2 - 2 * b * h * ca.cos(turn))
    return length, b * h * ca.sin(turn) / length


def _compute_counterbalance(shaft: Shaft, value: Values) -> Contribution:
    length, slope = _compute_lever(shaft, value)
    return Contribution(value["stiffness"] * (length - value["length"]) * slope)


def _draw_lever(rng: np.random.Generator) -> dict[str, float]:
    base = rng.uniform(0.3, 0.5)
    lever = rng.uniform(0.3, 0.7) * base
    return {"lever": lever, "base": base, "angle": rng.uniform(-3.1, 3.1)}


def _draw_counterbalance(rng: np.random.Generator, site: Site) -> dict[str, float]:
    place = _draw_lever(rng)
    length = rng.uniform(0.5, 0.9) * (place["base"] - place["lever"])  # of the shortest
    pull = rng.uniform(0.4, 0.8) * site.torque / place["lever"]
    return place | {"length": length, "stiffness": pull / (place["base"] - length)}


def _draw_gas_spring(rng: np.random.Generator, site: Site) -> dict[str, float]:
    place = _draw_lever(rng)
    return place | {"force": rng.uniform(0.4, 0.8) * site.torque / place["lever"]}


def _compute_ripple(shaft: Shaft, value: Values) -> Contribution:
    """Of the joint, or of a motor behind a gear."""
    turn = value["order"] * value.get("gear", 1.0) * shaft.position + value["phase"]
    return Contribution(value["amplitude"] * ca.sin(turn))


def _draw_motor_ripple(rng: np.random.Generator, site: Site) -> dict[str, float]:
    order = float(rng.choice([1.0, 2.0]))
    most = THRESHOLDS.max_ripple_share_of_rate * site.rate * 2 * np.pi / (order * site.speed)
    gear = rng.uniform(50, 160) if site.angular else rng.uniform(300, 700)
    return {
        "amplitude": rng.uniform(0.04, 0.09) * site.torque,
        "order": order,
        "gear": float(np.floor(min(gear, most))),
        "phase": rng.uniform(-3.1, 3.1),
    }


def _compute_elastic(ahead: ca.SX, rate: ca.SX, value: Values) -> ca.SX:
    return value["stiffness"] * ahead + value["damping"] * rate


def _compute_backlash(ahead: ca.SX, rate: ca.SX, value: Values) -> ca.SX:
    """Teeth that bear half a gap from the middle, on either side; none push when they part."""
    width = THRESHOLDS.backlash_edge_share * value["gap"]
    sides = []
    for side in (1.0, -1.0):
        into = side * ahead - value["gap"] / 2
        pressed = (into + ca.sqrt(into**2 + width**2)) / 2
        bears = (1 + ca.tanh(into / width)) / 2
        sides.append(side * (value["stiffness"] * pressed + value["damping"] * bears * side * rate))
    return sides[0] + sides[1]


def _draw_elastic(
    rng: np.random.Generator, site: Site, lowest: float = 8.0, highest: float = 20.0
) -> dict[str, float]:
    omega = 2 * np.pi * rng.uniform(lowest, highest)  # of the links on it, motor held
    zeta = rng.uniform(0.05, 0.15)
    return {"stiffness": site.inertia * omega**2, "damping": 2 * zeta * omega * site.inertia}


# Bodies, gravity and forces of the whole machine.


def _draw_body(rng: np.random.Generator, site: Site) -> dict[str, float]:
    reach = float(np.linalg.norm(site.body.centre)) or 0.1
    centre = rng.uniform(1.0, 2.0) * site.body.centre + 0.2 * reach * rng.normal(size=3)
    mass = rng.uniform(0.06, 0.14) * site.mass
    place = dict(zip("xyz", centre.tolist(), strict=True))
    return {"mass": mass, **place, "radius": rng.uniform(0.2, 0.4) * reach}


def _draw_force(rng: np.random.Generator, site: Site) -> dict[str, float]:
    if site.lever == 0.0:
        raise RobotError(
            "external_force: the mass centre of the last link lies on every axis, where no force "
            "moves a joint; expected one off the axes; hide another effect, such as friction"
        )
    direction = rng.normal(size=3)
    force = rng.uniform(0.5, 0.9) / site.lever * direction / np.linalg.norm(direction)
    return {
        **dict(zip(("fx", "fy", "fz"), force.tolist(), strict=True)),
        **dict(zip("xyz", site.body.centre.tolist(), strict=True)),
        "start": rng.uniform(0.3, 0.6) * site.duration,
        "length": rng.uniform(0.05, 0.1) * site.duration,
    }


def _build_enlarged_kind(effect: str) -> HiddenKind:
    """More of what robot files have, half again as large as what is drawn for these."""
    physics = PHYSICS[effect]

    def draw_values(rng: np.random.Generator, scale: ShaftScale) -> dict[str, float]:
        return {name: 1.5 * value for name, value in physics.draw(rng, scale).items()}

    return HiddenKind(effect, "joint", draw_values, physics.act, signed=physics.signed)


_KINDS = (
    *map(_build_enlarged_kind, ("rotor_inertia", "viscous", "coulomb", "offset")),
    HiddenKind(
        "asymmetric_viscous",
        "joint",
        combine_draws(coefficient=build_share_draw(0.04, 0.09, "torque/speed", either=True)),
        _compute_asymmetric_viscous,
        signed=("coefficient",),
    ),
    HiddenKind(
        "stribeck",
        "joint",
        combine_draws(
            extra=build_share_draw(0.06, 0.14, "torque"),
            speed=build_share_draw(0.02, 0.06, "speed"),
        ),
        _compute_stribeck,
    ),
    HiddenKind("nonlinear_viscous", "joint", _draw_nonlinear_viscous, _compute_nonlinear_viscous),
    HiddenKind(
        "load_friction",
        "joint",
        combine_draws(coefficient=build_share_draw(0.06, 0.14)),
        lambda shaft, value: Contribution(
            compute_dry_friction(shaft, value["coefficient"] * ca.fabs(shaft.load))
        ),
        loops=False,
    ),
    HiddenKind(
        "position_friction",
        "joint",
        combine_draws(
            level=build_share_draw(0.05, 0.12, "torque"),
            order=_compute_single_order,
            phase=build_share_draw(-3.1, 3.1),
        ),
        _compute_position_friction,
        signed=("phase",),
    ),
    HiddenKind(
        "coupled_friction",
        "pair",
        combine_draws(
            ratio=draw_sign,
            Fv=build_share_draw(0.05, 0.12, "torque/speed"),
            Fs=build_share_draw(0.06, 0.14, "torque"),
        ),
        build_friction_act("Fv", "Fs"),
        signed=("ratio",),
    ),
    HiddenKind(
        "coupled_inertia",
        "pair",
        combine_draws(ratio=draw_sign, Ia=build_share_draw(0.15, 0.4, "inertia")),
        build_inertia_act("Ia"),
        signed=("ratio",),
    ),
    HiddenKind(
        "passive_friction",
        "passive",
        combine_draws(
            Fv=build_share_draw(0.05, 0.15, "torque/speed"),
            Fs=build_share_draw(0.06, 0.2, "torque"),
        ),
        build_friction_act("Fv", "Fs"),
    ),
    HiddenKind(
        "presliding",
        "joint",
        _draw_presliding,
        _compute_presliding,
        replaces=("coulomb",),
        loops=False,
    ),
    HiddenKind(
        "cable_hysteresis",
        "joint",
        combine_draws(
            level=build_share_draw(0.06, 0.14, "torque"), width=build_share_draw(0.01, 0.06, "span")
        ),
        _compute_cable_hysteresis,
        loops=False,
    ),
    HiddenKind(
        "temperature_friction",
        "joint",
        _draw_warming,
        _compute_warming,
        replaces=("viscous", "coulomb"),
        signed=("start", "Fv", "Fs"),
        loops=False,
    ),
    HiddenKind(
        "spring",
        "joint",
        combine_draws(
            stiffness=build_share_draw(0.3, 0.6, "torque/span"),
            rest=build_share_draw(-0.2, 0.2, "span"),
        ),
        lambda shaft, value: Contribution(value["stiffness"] * (shaft.position - value["rest"])),
        signed=("rest",),
    ),
    HiddenKind(
        "counterbalance", "lever", _draw_counterbalance, _compute_counterbalance, signed=("angle",)
    ),
    HiddenKind(
        "constant_force_spring",
        "lever",
        _draw_gas_spring,
        lambda shaft, value: Contribution(value["force"] * _compute_lever(shaft, value)[1]),
        signed=("angle",),
    ),
    HiddenKind("motor_ripple", "joint", _draw_motor_ripple, _compute_ripple, signed=("phase",)),
    HiddenKind(
        "joint_ripple",
        "joint",
        combine_draws(
            amplitude=build_share_draw(0.03, 0.08, "torque"),
            order=lambda rng, site: float(rng.integers(*((8, 40) if site.angular else (60, 300)))),
            phase=build_share_draw(-3.1, 3.1),
        ),
        _compute_ripple,
        signed=("phase",),
    ),
    HiddenKind(
        "elasticity",
        "geared",
        _draw_elastic,
        role="transmission",
        spring=_compute_elastic,
        loops=False,
    ),
    HiddenKind(
        "backlash",
        "geared",
        lambda rng, site: (
            {"gap": rng.uniform(2e-4, 8e-4) * site.span} | _draw_elastic(rng, site, 40.0, 60.0)
        ),
        role="transmission",
        spring=_compute_backlash,
        loops=False,
    ),
    HiddenKind("payload", "system", _draw_body, role="body", signed=("x", "y", "z")),
    HiddenKind("link_inertia", "link", _draw_body, role="body", signed=("x", "y", "z")),
    HiddenKind(
        "base_tilt",
        "system",
        combine_draws(
            angle=lambda rng, site: np.deg2rad(rng.uniform(2.0, 4.0)),
            heading=build_share_draw(-3.1, 3.1),
        ),
        role="gravity",
        signed=("heading",),
    ),
    HiddenKind(
        "external_force",
        "system",
        _draw_force,
        role="push",
        signed=("fx", "fy", "fz", "x", "y", "z", "start"),
        loops=False,
    ),
    HiddenKind(
        "encoder_offset",
        "joint",
        combine_draws(angle=build_share_draw(0.01, 0.03, "span", either=True)),
        role="sensor",
        signed=("angle",),
        loops=False,
    ),
    HiddenKind(
        "encoder_eccentricity",
        "joint",
        combine_draws(
            amplitude=build_share_draw(1.5e-3, 4e-3, "span"),
            order=_compute_single_order,
            phase=build_share_draw(-3.1, 3.1),
        ),
        role="sensor",
        signed=("phase",),
        loops=False,
    ),
    HiddenKind(
        "time_delay",
        "system",
        combine_draws(delay=build_share_draw(2e-3, 6e-3)),
        role="sensor",
        signed=("delay",),
    ),
    HiddenKind(
        "drive_gain",
        "joint",
        combine_draws(ratio=lambda rng, site: 1 + draw_sign(rng) * rng.uniform(0.06, 0.14)),
        role="sensor",
    ),
    HiddenKind(
        "drift",
        "joint",
        combine_draws(per_minute=build_share_draw(0.15, 0.4, "torque", either=True)),
        role="sensor",
        signed=("per_minute",),
    ),
)

HIDDEN: Mapping[str, HiddenKind] = {kind.effect: kind for kind in _KINDS}
"""The effects that a simulated machine can have and its robot file not, by id."""
