"""Hidden friction without memory: torques that follow speed, position and load at once.

Every sign is a tanh and every absolute value a rounded one, deliberately: the machine is not made
of the columns with which it is diagnosed.
"""

import casadi as ca
import numpy as np

from modeler.simulation.hidden_kind import HiddenKind, Site, Values, either_sign
from modeler.simulation.physics import PHYSICS, Contribution, Shaft, dry_friction

_MORE = ("rotor_inertia", "viscous", "coulomb", "offset")  # of what every robot has


def rounded_abs(value: ca.SX, width: float) -> ca.SX:
    """|value|, rounded within `width` of 0."""
    return ca.sqrt(value**2 + width**2) - width


def _stribeck(shaft: Shaft, value: Values) -> Contribution:
    share = ca.exp(-((shaft.speed / value["speed"]) ** 2))
    return Contribution(torque=dry_friction(shaft, value["extra"] * share))


def _asymmetric_viscous(shaft: Shaft, value: Values) -> Contribution:
    return Contribution(torque=value["coefficient"] * rounded_abs(shaft.speed, shaft.settling))


def _nonlinear_viscous(shaft: Shaft, value: Values) -> Contribution:
    size = ca.sqrt(shaft.speed**2 + shaft.settling**2)
    power = value["power"]
    return Contribution(torque=value["coefficient"] * size ** (power - 1) * shaft.speed)


def _load_friction(shaft: Shaft, value: Values) -> Contribution:
    return Contribution(torque=dry_friction(shaft, value["coefficient"] * ca.fabs(shaft.load)))


def _position_friction(shaft: Shaft, value: Values) -> Contribution:
    turn = value["order"] * shaft.position - value["phase"]
    return Contribution(torque=dry_friction(shaft, value["level"] * (1 + ca.cos(turn))))


def _both(shaft: Shaft, value: Values) -> Contribution:
    return Contribution(torque=value["Fv"] * shaft.speed + dry_friction(shaft, value["Fs"]))


def _more(effect: str) -> HiddenKind:
    physics = PHYSICS[effect]
    return HiddenKind(
        effect,
        "joint",
        draw=lambda rng, site: {
            # Half again as large as what is drawn for a robot file: it has to be missed.
            prefix: 1.5 * float(value)
            for prefix, value in physics.draw(rng, site.scale).items()
        },
        act=physics.act,
        signed=physics.signed,
    )


FRICTION: tuple[HiddenKind, ...] = (
    *(_more(effect) for effect in _MORE),
    HiddenKind(
        "asymmetric_viscous",
        "joint",
        draw=lambda rng, site: {
            "coefficient": either_sign(rng) * rng.uniform(0.04, 0.09) * site.torque / site.speed
        },
        act=_asymmetric_viscous,
        signed=("coefficient",),
    ),
    HiddenKind(
        "stribeck",
        "joint",
        draw=lambda rng, site: {
            "extra": rng.uniform(0.06, 0.14) * site.torque,
            "speed": rng.uniform(0.02, 0.06) * site.speed,
        },
        act=_stribeck,
    ),
    HiddenKind(
        "nonlinear_viscous",
        "joint",
        draw=lambda rng, site: _powers(
            float(rng.choice([0.5, 2.0, 3.0])), rng.uniform(0.15, 0.3) * site.torque, site.speed
        ),
        act=_nonlinear_viscous,
    ),
    HiddenKind(
        "load_friction",
        "joint",
        draw=lambda rng, site: {"coefficient": rng.uniform(0.06, 0.14)},
        act=_load_friction,
        loops=False,
    ),
    HiddenKind(
        "position_friction",
        "joint",
        draw=lambda rng, site: {
            "level": rng.uniform(0.05, 0.12) * site.torque,
            # Something turns once with a joint that turns, once per range with one that slides.
            "order": 1.0 if site.angular else 2 * ca.pi / site.span,
            "phase": rng.uniform(-3.1, 3.1),
        },
        act=_position_friction,
        signed=("phase",),
    ),
    HiddenKind(
        "coupled_friction",
        "pair",
        draw=lambda rng, site: {
            "ratio": either_sign(rng),
            "Fv": rng.uniform(0.05, 0.12) * site.torque / site.speed,
            "Fs": rng.uniform(0.06, 0.14) * site.torque,
        },
        act=_both,
        signed=("ratio",),
    ),
    HiddenKind(
        "coupled_inertia",
        "pair",
        draw=lambda rng, site: {
            "ratio": either_sign(rng),
            "Ia": rng.uniform(0.15, 0.4) * site.inertia,
        },
        act=lambda shaft, value: Contribution(inertia=value["Ia"]),
        signed=("ratio",),
    ),
    HiddenKind(
        "passive_friction",
        "passive",
        draw=lambda rng, site: {
            "Fv": rng.uniform(0.05, 0.15) * site.torque / site.speed,
            "Fs": rng.uniform(0.06, 0.2) * site.torque,
        },
        act=_both,
    ),
)
"""Friction without memory, and more of what every robot has."""


def _powers(power: float, torque: float, speed: float) -> dict[str, float]:
    return {"coefficient": torque / speed**power, "power": power}


# Hidden friction with memory: bristles, cables, heat.


_OVERSHOOT = 1.3  # of the top speed, that inner states must follow
_AMBIENT = 25.0  # degC
_BRISTLE_DAMPING = 0.5  # of the oscillation of a joint on its bristles, of the critical one
_SHAPE = 0.7  # Bouc and Wen's beta of beta + gamma = 1
_HALVED = 30.0  # K, by which friction falls to a half


def _presliding(shaft: Shaft, value: Values) -> Contribution:
    """Bristles (Canudas de Wit et al. 1995): F = s0 z + s1 z', z' = v - |v| z / distance."""
    z = ca.SX.sym(f"bristle_{shaft.name}")
    rate = shaft.speed - ca.fabs(shaft.speed) * z / value["distance"]
    return Contribution(
        torque=value["level"] / value["distance"] * z + value["damping"] * rate,
        state=z,
        rate=rate,
        fastest=_OVERSHOOT * shaft.top / value["distance"],
    )


def _draw_presliding(rng: np.random.Generator, site: Site) -> dict[str, float]:
    level = site.own.get("Fs") or rng.uniform(0.1, 0.2) * site.torque
    distance = rng.uniform(5e-4, 3e-3) * site.span
    inertia = site.inertia + site.own.get("Ia", 0.0)
    damping = 2 * _BRISTLE_DAMPING * np.sqrt(level / distance * inertia)
    return {"level": level, "distance": distance, "damping": float(damping)}


def _cable(shaft: Shaft, value: Values) -> Contribution:
    """Bouc and Wen's loop: F = level z, z' = (v - (b |v| z + (1 - b) v |z|) ) / width."""
    z = ca.SX.sym(f"cable_{shaft.name}")
    v = shaft.speed
    back = _SHAPE * ca.fabs(v) * z + (1 - _SHAPE) * v * ca.fabs(z)
    return Contribution(
        torque=value["level"] * z,
        state=z,
        rate=(v - back) / value["width"],
        fastest=_OVERSHOOT * shaft.top / value["width"],
    )


def _warming(shaft: Shaft, value: Values) -> Contribution:
    """Friction that heats its joint and falls by half per 30 K: time T' = R P - (T - ambient)."""
    warmer = ca.SX.sym(f"heat_{shaft.name}")  # than at the start, K
    above = warmer + value["start"]
    fallen = 2 ** (-above / _HALVED)
    torque = fallen * (value["Fv"] * shaft.speed + dry_friction(shaft, value["Fs"]))
    return Contribution(
        torque=torque,
        state=warmer,
        rate=(value["heating"] * torque * shaft.speed - above) / value["time"],
        temperature=_AMBIENT + above,
    )


def _draw_warming(rng: np.random.Generator, site: Site) -> dict[str, float]:
    viscous = site.own.get("Fv") or rng.uniform(0.1, 0.2) * site.torque / site.speed
    dry = site.own.get("Fs") or rng.uniform(0.1, 0.2) * site.torque
    usual = 0.35 * site.speed  # mean speed of lively motion
    return {
        "Fv": viscous,
        "Fs": dry,
        # Cold friction would warm the joint by 40 to 70 K.
        "heating": rng.uniform(40.0, 70.0) / ((viscous * usual + dry) * usual),
        "time": rng.uniform(25.0, 60.0),
        "start": 0.0,
    }


MEMORY: tuple[HiddenKind, ...] = (
    HiddenKind(
        "presliding",
        "joint",
        draw=_draw_presliding,
        act=_presliding,
        replaces=("coulomb",),
        loops=False,
    ),
    HiddenKind(
        "cable_hysteresis",
        "joint",
        draw=lambda rng, site: {
            "level": rng.uniform(0.06, 0.14) * site.torque,
            "width": rng.uniform(0.01, 0.06) * site.span,
        },
        act=_cable,
        loops=False,
    ),
    HiddenKind(
        "temperature_friction",
        "joint",
        draw=_draw_warming,
        act=_warming,
        replaces=("viscous", "coulomb"),
        signed=("start", "Fv", "Fs"),
        loops=False,
    ),
)
"""Friction that depends on what was before."""
