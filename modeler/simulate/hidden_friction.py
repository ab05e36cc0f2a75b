"""Hidden friction without memory: torques that follow speed, position and load at once.

Every sign is a tanh and every absolute value a rounded one, deliberately: the machine is not made
of the columns with which it is diagnosed.
"""

import casadi as ca

from modeler.simulate.hidden_kind import HiddenKind, Values, either_sign
from modeler.simulate.physics import PHYSICS, Contribution, Shaft, dry_friction

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
