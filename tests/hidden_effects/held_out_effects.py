"""Causes that no catalogue of effects holds: real physics, and no name may be stated as a fact.

An arm never gets them unless they are requested: they stand in `HELD_OUT_EFFECTS`, apart from
`EFFECTS`.
"""

from functools import partial

import numpy as np

from tests.hidden_effects.effects import Draw, Hidden, Hide, Impossible, effect

HELD_OUT_EFFECTS: dict[str, Hide] = {}
"""How to hide such a cause, by name."""

held_out = partial(effect, known=HELD_OUT_EFFECTS)

STEEPEST = 9000 * 0.3  # 1/s: dry friction over its width and inertia, for the integration


def _dry(draw: Draw, torque: float) -> float:
    """So much more dry friction; its sign change becomes as wide as the integration needs it."""
    j, plant = draw.joint, draw.plant
    moved = draw.scales.inertia[j] + plant.rotor_inertia[j]
    narrowest = (plant.coulomb[j] + torque) / (STEEPEST * moved)
    plant.coulomb_width[j] = max(plant.coulomb_width[j], narrowest)
    return torque


def _another(draw: Draw) -> int:
    """A joint next to the one that is drawn."""
    return draw.pick([k for k in (draw.joint - 1, draw.joint + 1) if 0 <= k < draw.n])


@held_out("pinched_dress")
def pinched_dress(draw: Draw) -> Hidden:
    """F sign(v_j) / (1 + exp(-(q_k - q0) / w)): beyond an angle of k, cables are pinched at j."""
    j, plant, k = draw.joint, draw.plant, _another(draw)
    plant.pinch_torque[j] = _dry(draw, draw.between(0.06, 0.14) * draw.rated)
    plant.pinched_by[j] = k
    plant.pinch_angle[j] = draw.between(-0.3, 0.3) * draw.scales.bounds.angle[k]
    plant.pinch_width[j] = draw.sign() * draw.between(0.05, 0.2)
    values = {"with_joint": str(k + 1), "F": plant.pinch_torque[j]}
    return Hidden(j, values | {"q0": plant.pinch_angle[j], "w": plant.pinch_width[j]})


@held_out("hose_across")
def hose_across(draw: Draw) -> Hidden:
    """k (q_i + c q_k - s) on i and c times it on k: a hose that both joints stretch."""
    i, plant, k = draw.joint, draw.plant, _another(draw)
    weaker, angles = min(draw.scales.rated[[i, k]]), draw.scales.bounds.angle
    plant.hose_joint, plant.hose_with = i, k
    plant.hose_ratio = draw.sign() * draw.between(0.6, 1.6)
    longest = angles[i] + abs(plant.hose_ratio) * angles[k]
    plant.hose_stiffness = draw.between(0.06, 0.14) * weaker / longest
    plant.hose_rest = draw.between(-0.4, 0.4)
    values = {"with_joint": str(k + 1), "k": plant.hose_stiffness}
    return Hidden(i, values | {"c": plant.hose_ratio, "s": plant.hose_rest})


@held_out("grease_pocket")
def grease_pocket(draw: Draw) -> Hidden:
    """Fv (1 + cos(q - q0)) / 2 v: grease has gathered on one side."""
    j, plant = draw.joint, draw.plant
    plant.pocket_viscous[j] = draw.between(0.12, 0.25) * draw.rated / draw.speed
    plant.pocket_angle[j] = draw.between(-np.pi, np.pi)
    return Hidden(j, {"Fv": plant.pocket_viscous[j], "q0": plant.pocket_angle[j]})


@held_out("lifting_seal")
def lifting_seal(draw: Draw) -> Hidden:
    """F sign(v) / (1 + exp((|v| - v1) / w)): a lip that rubs up to a speed, and lifts off there."""
    j, plant = draw.joint, draw.plant
    plant.seal_torque[j] = _dry(draw, draw.between(0.05, 0.10) * draw.rated)
    plant.seal_speed[j] = draw.between(0.25, 0.55) * draw.speed
    plant.seal_width[j] = draw.between(0.01, 0.03) * draw.speed
    values = {"F": plant.seal_torque[j], "v1": plant.seal_speed[j]}
    return Hidden(j, values | {"w": plant.seal_width[j]})


@held_out("saturating_motor")
def saturating_motor(draw: Draw) -> Hidden:
    """torque = s tanh(torque_logged / s): the iron of the motor saturates."""
    j, plant = draw.joint, draw.plant
    plant.saturation[j] = draw.between(1.4, 2.6) * draw.rated
    return Hidden(j, {"s": plant.saturation[j]})


@held_out("dead_band")
def dead_band(draw: Draw) -> Hidden:
    """torque = t - b tanh(t / b), t as logged: an amplifier that gives nothing of what is small."""
    j, plant = draw.joint, draw.plant
    plant.dead_torque[j] = draw.between(0.03, 0.07) * draw.rated
    return Hidden(j, {"b": plant.dead_torque[j]})


@held_out("crosstalk")
def crosstalk(draw: Draw) -> Hidden:
    """torque_j = t_j - c t_k, t as logged: the sensor of drive j reads some of the current of k."""
    j, plant, k = draw.joint, draw.plant, _another(draw)
    motors = draw.scales.motors
    plant.crosstalk[j] = draw.sign() * draw.between(0.06, 0.15) * motors[j] / motors[k]
    plant.crosstalk_from[j] = k
    return Hidden(j, {"with_joint": str(k + 1), "c": plant.crosstalk[j]})


@held_out("dragging_brake")
def dragging_brake(draw: Draw) -> Hidden:
    """F sign(v) for a second or two every few seconds, or once for a good part of the log."""
    j, plant = draw.joint, draw.plant
    plant.brake_torque[j] = _dry(draw, draw.between(0.06, 0.14) * draw.rated)
    if draw.rng.uniform() < 0.5:
        period = draw.between(4, 8)
        lasts, start = draw.between(1, 2), draw.between(0, 2)
    else:
        period = 1e6
        lasts, start = (draw.between(0.15, 0.35) * draw.scales.seconds for _ in range(2))
    plant.brake_start[j], plant.brake_lasts[j], plant.brake_period[j] = start, lasts, period
    values = {"F": plant.brake_torque[j], "start": start, "lasts": lasts}
    return Hidden(j, values | {"period": period})


@held_out("sloshing_load")
def sloshing_load(draw: Draw) -> Hidden:
    """A mass held by a spring and a damper on the last link: it swings at 1 to 3 Hz."""
    plant, last = draw.plant, draw.n - 1
    mass = draw.between(0.04, 0.12) * plant.mass[last]
    hertz, damping = draw.between(1, 3), draw.between(0.04, 0.15)
    plant.slosh_mass, plant.slosh_stiffness = mass, mass * (2 * np.pi * hertz) ** 2
    plant.slosh_damping = 2 * damping * mass * 2 * np.pi * hertz
    plant.slosh_point = 1.8 * plant.centre[last]
    return Hidden(None, {"mass": mass, "f_Hz": hertz, "damping": damping})


@held_out("strap_to_base")
def strap_to_base(draw: Draw) -> Hidden:
    """k (length - free) along a strap from the base to an outer link, where it is taut."""
    plant, rng = draw.plant, draw.rng
    if draw.n < 2:
        raise Impossible
    link = draw.pick(range(1, draw.n))
    base = rng.normal(size=3)
    base *= draw.between(0.3, 0.7) * draw.scales.reach / np.linalg.norm(base)
    point = 1.5 * plant.centre[link]
    size = np.linalg.norm(base) * np.linalg.norm(point)
    plant.strap_link, plant.strap_base, plant.strap_point = link, base, point
    plant.strap_length = draw.between(0.5, 0.9) * np.linalg.norm(base)
    plant.strap_stiffness = draw.between(0.1, 0.25) * draw.scales.rated[link] / size
    values = {"k": plant.strap_stiffness, "free": plant.strap_length}
    return Hidden(link, values | {"base": base, "point": point})


@held_out("bearing_moment")
def bearing_moment(draw: Draw) -> Hidden:
    """c |moment across the axis| sign(v): the weight beyond tilts the bearing, and it rubs."""
    j, plant, scales = draw.joint, draw.plant, draw.scales
    plant.bearing_share[j] = draw.between(0.03, 0.08)
    _dry(draw, plant.bearing_share[j] * float(scales.gravity_peak.max()))
    return Hidden(j, {"c": plant.bearing_share[j]})


@held_out("back_driven_gear")
def back_driven_gear(draw: Draw) -> Hidden:
    """F sign(v) where the load drives the motor, none where the motor drives the load."""
    j, plant = draw.joint, draw.plant
    plant.back_driven_torque[j] = _dry(draw, draw.between(0.06, 0.14) * draw.rated)
    plant.back_driven_load[j] = 0.03 * draw.rated
    return Hidden(j, {"F": plant.back_driven_torque[j]})
