"""What every arm has: friction, rotors, controller, encoders, noise; in proportion to its load."""

from dataclasses import dataclass

import numpy as np

from tests.hidden_effects.motion import Bounds
from tests.hidden_effects.plant import TICK, rate

NOISE = {"low": 0.0035, "med": 0.01, "high": 0.027}
"""Rms of the process torque over that of the motors."""


@dataclass(frozen=True)
class Scales:
    """What is large on the joints of an arm over its motion, (n,) each, SI.

    Attributes:
        rated: torque of the motors.
        bounds: of the motion.
        inertia: diagonal of the links' inertia matrix, mean.
        load, gravity: rms torque of the links, and of their weight.
        gravity_peak: torque of the weight.
        upright: an angle where the weight asks for least.
        crossings: how often the torque of the links changes its sign.
        motors: rms torque of the motors.
        seconds: length of the training motion.
        reach: of the arm, m.
    """

    rated: np.ndarray
    bounds: Bounds
    inertia: np.ndarray
    load: np.ndarray
    gravity: np.ndarray
    gravity_peak: np.ndarray
    upright: np.ndarray
    crossings: np.ndarray
    motors: np.ndarray
    seconds: float
    reach: float


def equip(plant, bounds, path, noise, rng):
    """Motors, friction, controller, encoders and noise for an arm that moves along a path.

    Joint by joint, with r the torque that the links ask for and m their inertia: rotor inertia
    0.12..0.5 m, Coulomb friction 3..8 % of r, viscous 3..9 % of r at top speed, offset 0.6..4 %.
    """
    n, v, a = plant.joints, rate(path)[::10], rate(rate(path))[::10]
    load, diagonal, weight = plant.inverse_dynamics(path[::10], v, a)
    inertia = diagonal.mean(0)
    most = np.abs(load).max()
    rated = np.maximum(np.percentile(np.abs(load), 99, axis=0), 0.02 * most)
    plant.rotor_inertia = rng.uniform(0.12, 0.5, n) * inertia
    rated = rated + plant.rotor_inertia * bounds.acceleration * 0.7
    _add_friction(plant, rated, inertia, bounds, rng)
    _add_controller(plant, rated, inertia, bounds, rng)
    rubbed = plant.coulomb * np.tanh(v / plant.coulomb_width) + plant.viscous * v
    total = load + plant.rotor_inertia * a + rubbed + plant.offset
    motors = _rms(total)
    plant.noise_time, plant.noise_torque = 0.03, 0.95 * NOISE[noise] * motors
    tool = 1.8 * float(np.linalg.norm(plant.centre[n - 1]))
    return Scales(
        rated=rated,
        bounds=bounds,
        inertia=inertia,
        load=_rms(load),
        gravity=_rms(weight),
        gravity_peak=np.abs(weight).max(0),
        upright=path[::10][np.abs(weight).argmin(0), np.arange(n)],
        crossings=(np.abs(np.diff(np.sign(load), axis=0)) > 1).sum(0),
        motors=motors,
        seconds=len(path) * TICK,
        reach=np.abs(plant.d).sum() + np.abs(plant.r).sum() + tool,
    )


def measured_noise(scales: Scales, noise: str) -> np.ndarray:
    """(n,) deviation of the white noise of the measured torque, N m."""
    return 1.2 * NOISE[noise] * scales.motors


def _add_friction(plant, rated, inertia, bounds, rng):
    n = plant.joints
    plant.coulomb = rng.uniform(0.03, 0.08, n) * rated
    plant.viscous = rng.uniform(0.03, 0.09, n) * rated / bounds.speed
    # Narrower, and the step of the integration would be too long for it.
    narrowest = plant.coulomb / (9000 * 0.3 * (inertia + plant.rotor_inertia))
    plant.coulomb_width = np.maximum(rng.uniform(0.003, 0.010, n), narrowest)
    plant.offset = rng.choice([-1, 1], n) * rng.uniform(0.006, 0.04, n) * rated


def _add_controller(plant, rated, inertia, bounds, rng):
    """Speed loops of 12..20 Hz, a current lag of 0.4 ms, encoders of 2^19 steps a turn and more."""
    n = plant.joints
    band = 2 * np.pi * rng.uniform(12, 20)
    moved = inertia + plant.rotor_inertia
    plant.speed_gain, plant.integral_gain = moved * band, moved * band * band / 6
    plant.position_gain, plant.speed_filter = band / 5, 2 * np.pi * 180
    plant.torque_limit = 3.5 * (rated + plant.coulomb + plant.viscous * bounds.speed)
    plant.current_lag = 0.4e-3
    counts = 2.0 ** rng.integers(17, 21, n) * rng.integers(30, 120, n)
    step = 2 * np.pi / (counts / rng.choice([1, 30, 100], n))
    plant.encoder_step = np.minimum(step, 2 * np.pi / 2**19)


def _rms(values: np.ndarray) -> np.ndarray:
    return np.sqrt((values**2).mean(0))
