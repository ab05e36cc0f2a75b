"""Hidden effects of motors, encoders and torque signals."""

import numpy as np

from tests.hidden_effects.effects import Draw, Hidden, Impossible, effect


@effect("motor_ripple")
def motor_ripple(draw: Draw) -> Hidden:
    """A sin(order gear q + phase)."""
    j, plant, rng = draw.joint, draw.plant, draw.rng
    gear = float(rng.integers(40, 130))
    order = float(rng.choice([1, 2, 4, 6], p=[0.35, 0.45, 0.1, 0.1]))
    if order > 2:
        gear = float(rng.integers(25, 60))
    plant.motor_ripple[j] = draw.between(0.015, 0.05) * draw.rated
    plant.motor_ripple_order[j] = order * gear
    plant.motor_ripple_phase[j] = draw.between(0, 2 * np.pi)
    values = {"amplitude": plant.motor_ripple[j], "motor_order": order, "gear": gear}
    return Hidden(j, values | {"cycles_per_turn": order * gear})


@effect("joint_ripple")
def joint_ripple(draw: Draw) -> Hidden:
    """A sin(order q + phase)."""
    j, plant = draw.joint, draw.plant
    plant.joint_ripple[j] = draw.between(0.015, 0.04) * draw.rated
    plant.joint_ripple_order[j] = float(draw.rng.integers(11, 70))
    plant.joint_ripple_phase[j] = draw.between(0, 2 * np.pi)
    cycles = plant.joint_ripple_order[j]
    return Hidden(j, {"amplitude": plant.joint_ripple[j], "cycles_per_turn": cycles})


@effect("encoder_offset")
def encoder_offset(draw: Draw) -> Hidden:
    """q_measured = q + d; not on the last joint, not on an upright first one."""
    g = draw.plant.gravity
    lying = abs(g[2]) < 0.7 * np.linalg.norm(g)
    j = draw.pick([k for k in range(draw.n - 1) if k > 0 or lying])
    draw.plant.encoder_offset[j] = draw.sign() * draw.between(0.04, 0.087)
    return Hidden(j, {"d": draw.plant.encoder_offset[j]})


@effect("encoder_eccentricity")
def encoder_eccentricity(draw: Draw) -> Hidden:
    """q_measured = q - e sin(order q + phase): once a turn of the joint, or of its motor."""
    j, plant = draw.joint, draw.plant
    phase, values = draw.between(0, 2 * np.pi), {}
    if draw.rng.uniform() < 0.5:
        order, size = 1.0, draw.between(0.015, 0.03)
    else:
        order = float(draw.rng.integers(20, 60))
        size = draw.between(0.008, 0.03) / order
        values["motor_e"] = size * order
    plant.eccentricity[j], plant.eccentricity_order[j] = size, order
    plant.eccentricity_phase[j] = phase
    return Hidden(j, values | {"e": size, "order": order, "phase": phase})


@effect("time_delay")
def time_delay(draw: Draw) -> Hidden:
    """torque_logged(t) = torque(t + d)."""
    delay = draw.sign() * draw.between(1.0, 4.5) * 1e-3
    return Hidden(None, {"d": delay}, delay)


@effect("drive_gain")
def drive_gain(draw: Draw) -> Hidden:
    """torque = (1 + e) torque_logged."""
    if draw.n < 2:
        raise Impossible
    draw.plant.gain_error[draw.joint] = draw.sign() * draw.between(0.06, 0.15)
    return Hidden(draw.joint, {"e": draw.plant.gain_error[draw.joint]})


@effect("drift")
def drift(draw: Draw) -> Hidden:
    """b t."""
    draw.plant.drift[draw.joint] = draw.sign() * draw.between(0.03, 0.07) * draw.rated / 40
    return Hidden(draw.joint, {"b": draw.plant.drift[draw.joint]})
