"""Hidden torques that follow the position: springs, ripples, transmissions that give way."""

import casadi as ca
import numpy as np

from modeler.simulation.hidden_kind import HiddenKind, Site, Values, either_sign
from modeler.simulation.physics import Contribution, Shaft

_SHARPNESS = 0.005  # of the gap: width of the edge where gear teeth come to bear
_SEEN = 0.2  # of the sampling rate: faster ripples are not hidden, no log would show them


def _spring(shaft: Shaft, value: Values) -> Contribution:
    return Contribution(torque=value["stiffness"] * (shaft.position - value["rest"]))


def _lever(shaft: Shaft, value: Values) -> tuple[ca.SX, ca.SX]:
    """Length of a spring between a point on the link and one on the base, and its slope in q."""
    b, h = value["lever"], value["base"]
    turn = shaft.position - value["angle"]
    length = ca.sqrt(b**2 + h**2 - 2 * b * h * ca.cos(turn))
    return length, b * h * ca.sin(turn) / length


def _counterbalance(shaft: Shaft, value: Values) -> Contribution:
    length, slope = _lever(shaft, value)
    return Contribution(torque=value["stiffness"] * (length - value["length"]) * slope)


def _gas_spring(shaft: Shaft, value: Values) -> Contribution:
    return Contribution(torque=value["force"] * _lever(shaft, value)[1])


def _draw_lever(rng: np.random.Generator) -> dict[str, float]:
    base = rng.uniform(0.3, 0.5)
    return {
        "lever": rng.uniform(0.3, 0.7) * base,
        "base": base,
        "angle": rng.uniform(-3.1, 3.1),
    }


def _draw_counterbalance(rng: np.random.Generator, site: Site) -> dict[str, float]:
    place = _draw_lever(rng)
    shortest = place["base"] - place["lever"]
    length = rng.uniform(0.5, 0.9) * shortest
    pull = rng.uniform(0.4, 0.8) * site.torque / place["lever"]
    return place | {"length": length, "stiffness": pull / (place["base"] - length)}


def _draw_gas_spring(rng: np.random.Generator, site: Site) -> dict[str, float]:
    place = _draw_lever(rng)
    return place | {"force": rng.uniform(0.4, 0.8) * site.torque / place["lever"]}


def _motor_ripple(shaft: Shaft, value: Values) -> Contribution:
    turn = value["order"] * value["gear"] * shaft.position + value["phase"]
    return Contribution(torque=value["amplitude"] * ca.sin(turn))


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


def _joint_ripple(shaft: Shaft, value: Values) -> Contribution:
    turn = value["order"] * shaft.position + value["phase"]
    return Contribution(torque=value["amplitude"] * ca.sin(turn))


def _elastic(ahead: ca.SX, rate: ca.SX, value: Values) -> ca.SX:
    return value["stiffness"] * ahead + value["damping"] * rate


def _backlash(ahead: ca.SX, rate: ca.SX, value: Values) -> ca.SX:
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
    rng: np.random.Generator, site: Site, lowest: float, highest: float
) -> dict[str, float]:
    omega = 2 * np.pi * rng.uniform(lowest, highest)  # of the links on it, motor held
    zeta = rng.uniform(0.05, 0.15)
    return {"stiffness": site.inertia * omega**2, "damping": 2 * zeta * omega * site.inertia}


SPRINGS: tuple[HiddenKind, ...] = (
    HiddenKind(
        "spring",
        "joint",
        draw=lambda rng, site: {
            "stiffness": rng.uniform(0.3, 0.6) * site.torque / site.span,
            "rest": rng.uniform(-0.2, 0.2) * site.span,
        },
        act=_spring,
        signed=("rest",),
    ),
    HiddenKind(
        "counterbalance", "lever", _draw_counterbalance, act=_counterbalance, signed=("angle",)
    ),
    HiddenKind(
        "constant_force_spring", "lever", _draw_gas_spring, act=_gas_spring, signed=("angle",)
    ),
    HiddenKind("motor_ripple", "joint", _draw_motor_ripple, act=_motor_ripple, signed=("phase",)),
    HiddenKind(
        "joint_ripple",
        "joint",
        draw=lambda rng, site: {
            "amplitude": rng.uniform(0.03, 0.08) * site.torque,
            "order": float(rng.integers(8, 40) if site.angular else rng.integers(60, 300)),
            "phase": rng.uniform(-3.1, 3.1),
        },
        act=_joint_ripple,
        signed=("phase",),
    ),
    HiddenKind(
        "elasticity",
        "geared",
        draw=lambda rng, site: _draw_elastic(rng, site, 8.0, 20.0),
        role="transmission",
        spring=_elastic,
        loops=False,
    ),
    HiddenKind(
        "backlash",
        "geared",
        draw=lambda rng, site: (
            {"gap": rng.uniform(2e-4, 8e-4) * site.span} | _draw_elastic(rng, site, 40.0, 60.0)
        ),
        role="transmission",
        spring=_backlash,
        loops=False,
    ),
)
"""Springs, ripples, transmissions."""


# Hidden bodies, gravity and forces of the whole machine, and what its sensors do wrong.


def _draw_body(rng: np.random.Generator, site: Site) -> dict[str, float]:
    reach = float(np.linalg.norm(site.body.centre)) or 0.1
    centre = rng.uniform(1.0, 2.0) * site.body.centre + 0.2 * reach * rng.normal(size=3)
    mass = rng.uniform(0.06, 0.14) * site.mass
    return {
        "mass": mass,
        **{name: float(value) for name, value in zip("xyz", centre, strict=True)},
        "radius": rng.uniform(0.2, 0.4) * reach,
    }


def _draw_force(rng: np.random.Generator, site: Site) -> dict[str, float]:
    direction = rng.normal(size=3)
    force = rng.uniform(0.5, 0.9) / site.lever * direction / np.linalg.norm(direction)
    names = ("fx", "fy", "fz")
    return {
        **{name: float(value) for name, value in zip(names, force, strict=True)},
        **{name: float(value) for name, value in zip("xyz", site.body.centre, strict=True)},
        "start": rng.uniform(0.3, 0.6) * site.duration,
        "length": rng.uniform(0.05, 0.1) * site.duration,
    }


MACHINE: tuple[HiddenKind, ...] = (
    HiddenKind("payload", "system", _draw_body, role="body", signed=("x", "y", "z")),
    HiddenKind("link_inertia", "link", _draw_body, role="body", signed=("x", "y", "z")),
    HiddenKind(
        "base_tilt",
        "system",
        draw=lambda rng, site: {
            "angle": np.deg2rad(rng.uniform(2.0, 4.0)),
            "heading": rng.uniform(-3.1, 3.1),
        },
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
)
"""Bodies, gravity, forces."""


SENSORS: tuple[HiddenKind, ...] = (
    HiddenKind(
        "encoder_offset",
        "joint",
        draw=lambda rng, site: {"angle": either_sign(rng) * rng.uniform(0.01, 0.03) * site.span},
        role="sensor",
        signed=("angle",),
        loops=False,
    ),
    HiddenKind(
        "encoder_eccentricity",
        "joint",
        draw=lambda rng, site: {
            "amplitude": rng.uniform(1.5e-3, 4e-3) * site.span,
            "order": 1.0 if site.angular else 2 * np.pi / site.span,
            "phase": rng.uniform(-3.1, 3.1),
        },
        role="sensor",
        signed=("phase",),
        loops=False,
    ),
    HiddenKind(
        "time_delay",
        "system",
        draw=lambda rng, site: {"delay": rng.uniform(2e-3, 6e-3)},
        role="sensor",
        signed=("delay",),
    ),
    HiddenKind(
        "drive_gain",
        "joint",
        draw=lambda rng, site: {"ratio": 1 + either_sign(rng) * rng.uniform(0.06, 0.14)},
        role="sensor",
    ),
    HiddenKind(
        "drift",
        "joint",
        draw=lambda rng, site: {
            "per_minute": either_sign(rng) * rng.uniform(0.15, 0.4) * site.torque
        },
        role="sensor",
        signed=("per_minute",),
    ),
)
"""What encoders and torque sensors do wrong."""
