"""Hidden friction with memory: bristles, cables, heat."""

import casadi as ca
import numpy as np

from modeler.simulate.hidden_kind import HiddenKind, Site, Values
from modeler.simulate.physics import Contribution, Shaft, dry_friction

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
