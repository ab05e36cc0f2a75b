"""One joint under a controller of 1 kHz, with what no logger does: stops, sticking, kicks."""

import numpy as np

from modeler.regression.log import Log

STEP = 1e-4  # s
KINDS = ("stop", "creep", "steps", "triangle", "blow")


def rough_log(seed, rate, kind, seconds=4.0):
    """A log of `rate` Hz, one joint, quantised position and noisy torque; drawn from the seed."""
    random = np.random.default_rng(seed)
    inertia = 10 ** random.uniform(-2.0, 0.5)
    bandwidth = random.uniform(20.0, 80.0)
    kp, kd = inertia * bandwidth**2, 2.0 * inertia * bandwidth * random.uniform(0.4, 1.0)
    coulomb = 10.0 * inertia * random.uniform(0.05, 1.0)
    static, viscous = coulomb * random.uniform(1.0, 2.0), inertia * random.uniform(0.0, 0.5)
    frequency, size = random.uniform(0.3, 1.5), random.uniform(0.2, 1.5)
    wall = size * random.uniform(0.4, 0.8)
    stiffness = inertia * (2.0 * np.pi * random.uniform(20.0, 300.0)) ** 2
    counts = 2.0 * np.pi / 10 ** random.uniform(3.5, 6.0)
    noise = 10.0 * inertia * 10 ** random.uniform(-3.0, -1.0)
    levels, blow = random.uniform(-size, size, 64), 0.01 * random.integers(1, 6)
    limit = 300.0 * inertia if seed % 2 else np.inf
    n = int(seconds / STEP)
    time = STEP * np.arange(n)
    want, speed = wanted(kind, time, frequency, size, levels)
    q = v = tau = before = 0.0
    positions, torques = np.empty(n), np.empty(n)
    for k in range(n):
        if k % 10 == 0:
            error = want[k] - round(q / counts) * counts
            slope = (error - before) / 1e-3 if kind == "steps" else speed[k] - v
            before = error
            tau = max(-limit, min(limit, kp * error + kd * slope))
        outer = -stiffness * (q - wall) if kind == "stop" and q > wall else 0.0
        if kind == "blow" and 2.0 < time[k] < 2.0 + blow:
            outer = 200.0 * inertia * np.sin(np.pi * (time[k] - 2.0) / blow)
        side = np.tanh(v / 0.002)
        friction = (coulomb + (static - coulomb) * np.exp(-((v / 0.02) ** 2))) * side + viscous * v
        v += STEP * (tau + outer - friction) / inertia
        q += STEP * v
        positions[k], torques[k] = q, tau
    rows = slice(0, n, 10000 // rate)
    measured = torques[rows] + noise * random.normal(size=len(torques[rows]))
    logged = np.round(positions[rows] / counts) * counts
    return Log("run", ("1",), time[rows], logged[:, None], measured[:, None])


def wanted(kind, time, frequency, size, levels):
    """Position and speed that the controller is to follow."""
    if kind == "steps":
        return levels[(2.0 * time).astype(int)], np.zeros_like(time)
    if kind == "triangle":
        phase = (0.8 * time) % 1.0
        return 2.0 * size * np.abs(phase - 0.5), 1.6 * size * np.sign(phase - 0.5)
    if kind == "creep":
        frequency, size = 0.2, 0.05
    angle = 2.0 * np.pi * frequency * time
    return size * np.sin(angle), 2.0 * np.pi * frequency * size * np.cos(angle)
