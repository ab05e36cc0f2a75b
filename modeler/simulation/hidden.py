"""Physics that a simulated machine can have and its robot file not: one table, an entry per effect.

Every sign is a tanh and every absolute value a rounded one, deliberately: the machine is not made
of the columns with which it is diagnosed.
"""

from collections.abc import Mapping

import casadi as ca
import numpy as np

from modeler.core.errors import RobotError
from modeler.simulation.physics import (
    PHYSICS,
    Contribution,
    HiddenKind,
    Shaft,
    ShaftScale,
    Site,
    Values,
    build_friction_act,
    build_inertia_act,
    build_share_draw,
    combine_draws,
    compute_dry_friction,
    draw_sign,
)

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


_OVERSHOOT = 1.3  # of the top speed, that inner states must follow
_AMBIENT = 25.0  # degC
_BRISTLE_DAMPING = 0.5  # of the oscillation of a joint on its bristles, of the critical one
_SHAPE = 0.7  # Bouc and Wen's beta of beta + gamma = 1
_HALVED = 30.0  # K, by which friction falls to a half


def _compute_presliding(shaft: Shaft, value: Values) -> Contribution:
    """Bristles (Canudas de Wit et al. 1995): F = s0 z + s1 z', z' = v - |v| z / distance."""
    z = ca.SX.sym(f"bristle_{shaft.name}")
    rate = shaft.speed - ca.fabs(shaft.speed) * z / value["distance"]
    torque = value["level"] / value["distance"] * z + value["damping"] * rate
    fastest = _OVERSHOOT * shaft.top / value["distance"]
    return Contribution(torque, state=z, rate=rate, fastest=fastest)


def _draw_presliding(rng: np.random.Generator, site: Site) -> dict[str, float]:
    level = site.joint_parameters.get("Fs") or rng.uniform(0.1, 0.2) * site.torque
    distance = rng.uniform(5e-4, 3e-3) * site.span
    inertia = site.inertia + site.joint_parameters.get("Ia", 0.0)
    damping = 2 * _BRISTLE_DAMPING * np.sqrt(level / distance * inertia)
    return {"level": level, "distance": distance, "damping": float(damping)}


def _compute_cable_hysteresis(shaft: Shaft, value: Values) -> Contribution:
    """Bouc and Wen's loop: F = level z, z' = (v - (b |v| z + (1 - b) v |z|) ) / width."""
    z, v = ca.SX.sym(f"cable_{shaft.name}"), shaft.speed
    back = _SHAPE * ca.fabs(v) * z + (1 - _SHAPE) * v * ca.fabs(z)
    rate, fastest = (v - back) / value["width"], _OVERSHOOT * shaft.top / value["width"]
    return Contribution(value["level"] * z, state=z, rate=rate, fastest=fastest)


def _compute_warming(shaft: Shaft, value: Values) -> Contribution:
    """Friction that heats its joint and falls by half per 30 K: time T' = R P - (T - ambient)."""
    warmer = ca.SX.sym(f"heat_{shaft.name}")  # than at the start, K
    above = warmer + value["start"]
    fallen = 2 ** (-above / _HALVED)
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


_SHARPNESS = 0.005  # of the gap: width of the edge where gear teeth come to bear
_SEEN = 0.2  # of the sampling rate: faster ripples are not hidden, no log would show them


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
    most = _SEEN * site.rate * 2 * np.pi / (order * site.speed)
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
    width = _SHARPNESS * value["gap"]
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
