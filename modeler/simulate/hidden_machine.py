"""Hidden bodies, gravity and forces of the whole machine, and what its sensors do wrong."""

import numpy as np

from modeler.simulate.hidden_kind import HiddenKind, Site, either_sign


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
