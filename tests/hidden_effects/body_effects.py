"""Hidden effects of bodies, springs and gears."""

import numpy as np

from tests.hidden_effects.effects import Draw, Hidden, Impossible, effect
from tests.hidden_effects.robots import point_inertia

ELASTIC, WITH_GAP = 1.0, 2.0  # flexible


@effect("spring")
def spring(draw: Draw) -> Hidden:
    """k (q - q0) + k3 (q - q0)^3."""
    j, plant = draw.joint, draw.plant
    k = draw.between(0.05, 0.12) * draw.rated / draw.angle
    plant.spring_stiffness[j], plant.spring_rest[j] = k, draw.between(-0.4, 0.4)
    if draw.rng.uniform() < 0.3:
        plant.spring_cubic[j] = draw.between(0.1, 0.3) * k / draw.angle**2
    return Hidden(j, {"k": k, "k3": plant.spring_cubic[j], "q0": plant.spring_rest[j]})


@effect("counterbalance")
def counterbalance(draw: Draw) -> Hidden:
    """k b h (1 - l0 / l) sin a, l^2 = b^2 + h^2 - 2 b h cos a, a = q - q0: part of the weight."""
    plant, scales = draw.plant, draw.scales
    j = draw.pick([k for k in range(draw.n) if scales.gravity[k] > 0.25 * scales.load[k]])
    b, h = draw.between(0.10, 0.2), draw.between(0.35, 0.7)
    free = (h - b) * draw.between(0.6, 0.95)
    rest = float(scales.upright[j]) + draw.between(-0.3, 0.3)
    most = scales.bounds.angle[j]
    a = np.linspace(-most, most, 200) - rest
    length = np.sqrt(b * b + h * h - 2 * b * h * np.cos(a))
    peak = np.abs(b * h * (1 - free / length) * np.sin(a)).max()
    k = draw.between(0.4, 0.8) * scales.gravity_peak[j] / peak
    plant.counter_stiffness[j], plant.counter_lever[j], plant.counter_height[j] = k, b, h
    plant.counter_length[j], plant.counter_angle[j] = free, rest
    return Hidden(j, {"k": k, "b": b, "h": h, "l0": free, "q0": rest})


def _add_body(draw: Draw, j: int, mass: float) -> dict[str, object]:
    """A ball near link j, beyond its centre."""
    plant, rng = draw.plant, draw.rng
    place = plant.centre[j] + rng.normal(size=3) * 0.06 + plant.centre[j] * draw.between(0.3, 0.9)
    radius = draw.between(0.02, 0.06)
    ball = 0.4 * mass * radius**2 * np.diag(rng.uniform(0.7, 1.3, 3))
    before, old, total = plant.mass[j], plant.centre[j].copy(), plant.mass[j] + mass
    centre = (before * old + mass * place) / total
    plant.mass[j], plant.centre[j] = total, centre
    plant.inertia[j] += (
        point_inertia(before, old - centre) + ball.ravel() + point_inertia(mass, place - centre)
    )
    moments = dict(zip(("MX", "MY", "MZ"), mass * place, strict=True))
    return {"mass": mass, "com": place, **moments}


@effect("payload")
def payload(draw: Draw) -> Hidden:
    """A body on the last link."""
    j = draw.n - 1
    return Hidden(None, _add_body(draw, j, draw.between(0.25, 0.7) * draw.plant.mass[j]))


@effect("link_inertia")
def link_inertia(draw: Draw) -> Hidden:
    """A body on an inner link."""
    first = max(0 if draw.n < 3 else 1, draw.n - 3)
    j = draw.pick(range(first, draw.n - 1))
    return Hidden(j, _add_body(draw, j, draw.between(0.25, 0.7) * draw.plant.mass[j]))


@effect("base_tilt")
def base_tilt(draw: Draw) -> Hidden:
    """Gravity 2 to 5 degrees off what the robot file says."""
    plant = draw.plant
    tilt, g = np.deg2rad(draw.between(2, 5)), plant.gravity.copy()
    side = draw.rng.normal(size=3)
    side -= (side @ g) * g / (g @ g)
    side /= np.linalg.norm(side)
    plant.gravity = g * np.cos(tilt) + np.linalg.norm(g) * np.sin(tilt) * side
    return Hidden(None, {"tilt_deg": np.rad2deg(tilt), "dg": plant.gravity - g})


@effect("external_force")
def external_force(draw: Draw) -> Hidden:
    """A push on the last link for about a second, in the training motion only."""
    plant, rng = draw.plant, draw.rng
    start, lasts = draw.between(0.1, 0.85) * draw.scales.seconds, draw.between(0.4, 1.6)
    way = np.array([0, 0, -1.0]) if rng.uniform() < 0.4 else rng.normal(size=3)
    way /= np.linalg.norm(way)
    force = draw.between(0.25, 0.6) * draw.scales.rated.max() / draw.scales.reach * way
    plant.contact_start, plant.contact_end = start, start + lasts
    plant.contact_force, plant.contact_point = force, 1.8 * plant.centre[draw.n - 1]
    values = {"force": force, "t0": start, "t1": start + lasts}
    return Hidden(None, values | {"point_last_link": plant.contact_point.copy()})


def _soften(draw: Draw, j: int, kind: float, hertz: float) -> float:
    """The stiffness of a gear that swings at so many hertz with its motor locked."""
    plant, inertia = draw.plant, draw.scales.inertia[j]
    stiffness = inertia * (2 * np.pi * hertz) ** 2
    plant.flexible[j], plant.gear_stiffness[j] = kind, stiffness
    return float(stiffness)


@effect("elasticity")
def elasticity(draw: Draw) -> Hidden:
    """Motor and link swing against each other; the encoder is on the motor."""
    j, plant = draw.joint, draw.plant
    if plant.flexible.any():
        raise Impossible
    hertz = draw.between(8, 25)
    stiffness = _soften(draw, j, ELASTIC, hertz)
    critical = 2 * np.sqrt(stiffness * draw.scales.inertia[j])
    plant.gear_damping[j] = draw.between(0.04, 0.12) * critical
    return Hidden(j, {"K": stiffness, "f_locked_Hz": hertz, "D": plant.gear_damping[j]})


@effect("backlash")
def backlash(draw: Draw) -> Hidden:
    """A gap of 1 to 5 mrad in the gear of a joint whose load changes sign."""
    plant = draw.plant
    if plant.flexible.any():
        raise Impossible
    j = draw.pick([k for k in range(draw.n) if draw.scales.crossings[k] > 4])
    stiffness = _soften(draw, j, WITH_GAP, draw.between(35, 55))
    plant.gear_damping[j] = 2 * 0.15 * np.sqrt(stiffness * draw.scales.inertia[j])
    plant.gap[j] = np.exp(draw.between(np.log(1e-3), np.log(5e-3)))
    return Hidden(j, {"gap": plant.gap[j], "contact_K": stiffness})
