"""Fixed-step integration of the plant over one control tick."""

import casadi as ca
import numpy as np

from modeler.core.errors import DataError
from modeler.robot import Limits
from modeler.simulate.plant import Plant, sample_poses

_SLOWEST_STEP = 5e-4  # s: rigid motion of an arm is then exact to some 1e-10
_STABLE = 1.5  # of a step times the fastest mode; Runge-Kutta 4 is stable up to 2.78
_MOST_STEPS = 400  # per tick


def steps_per_tick(
    plant: Plant,
    limits: tuple[Limits, ...],
    tick: float,
    postures: tuple[np.ndarray, np.ndarray] | None = None,
) -> int:
    """Runge-Kutta steps inside one control tick of `tick` seconds.

    The fastest mode is the spectral radius of d(x')/dx at rest, where dry friction is stiffest,
    over poses of the whole range, or over `postures`: (k, joints) positions, (k, states) states.

    Raises:
        DataError: friction so stiff against the inertia that no sensible step follows it; names
            the joint.
    """
    fastest, joint = 0.0, 0
    if postures is None:
        poses = sample_poses(limits, 8)
        postures = poses, np.zeros((len(poses), plant.states))
    for pose, z in zip(*postures, strict=True):
        values, vectors = np.linalg.eig(_jacobian(plant, pose, z, limits))
        worst = int(np.argmax(np.abs(values)))
        if abs(values[worst]) > fastest:
            n = pose.size
            fastest, joint = abs(values[worst]), int(np.argmax(np.abs(vectors[n : 2 * n, worst])))
    if plant.fastest * tick / _STABLE > _MOST_STEPS:
        raise DataError(
            f"simulation: the state of a hidden effect follows at {plant.fastest:.1e} 1/s at top "
            f"speed; expected at most {_MOST_STEPS * _STABLE / tick:.1e}; give it a larger "
            "distance or width, or sample faster"
        )
    needed = tick * max(fastest, plant.fastest) / _STABLE
    steps = int(np.ceil(max(tick / _SLOWEST_STEP, needed)))
    if steps > _MOST_STEPS:
        raise DataError(
            f"simulation, joint {plant.joints[joint]}: friction stops it within "
            f"{1 / fastest:.1e} s; expected {tick / _STABLE / _MOST_STEPS:.1e} s or more; state a "
            "larger inertia (Ia) or a smaller Fs, or sample faster"
        )
    return steps


def tick_function(plant: Plant, tick: float, steps: int) -> ca.Function:
    """x, tau -> x one tick later under constant torque; x = (q, qd, z), Runge-Kutta of order 4.

    What is left open in loops, 1e-10 of the robot's size, is closed at the end of every tick.
    """
    n = len(plant.joints)
    x, tau = ca.MX.sym("x", 2 * n + plant.states), ca.MX.sym("tau", n)

    def rate(state: ca.MX) -> ca.MX:
        qdd, z_rate = plant.acceleration(state[:n], state[n : 2 * n], state[2 * n :], tau)
        return ca.vertcat(state[n : 2 * n], qdd, z_rate)

    h = tick / steps
    k1 = rate(x)
    k2 = rate(x + h / 2 * k1)
    k3 = rate(x + h / 2 * k2)
    k4 = rate(x + h * k3)
    step = ca.Function("step", [x, tau], [x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)])
    later = x
    for _ in range(steps):
        later = step(later, tau)
    if plant.closer is not None:
        later = ca.vertcat(later[: 2 * n], plant.closer(later[:n], later[2 * n :]))
    return ca.Function("tick", [x, tau], [later])


def _jacobian(
    plant: Plant, pose: np.ndarray, z: np.ndarray, limits: tuple[Limits, ...]
) -> np.ndarray:
    """d(qd, qdd, z')/d(q, qd, z) at rest, torque that holds the robot there; by differences."""
    n = pose.size
    rest = np.zeros(n)
    tau = plant.torque(pose, rest, rest, z).full().ravel()

    def rate(x: np.ndarray) -> np.ndarray:
        qdd, z_rate = plant.acceleration(x[:n], x[n : 2 * n], x[2 * n :], tau)
        return np.concatenate([x[n : 2 * n], qdd.full().ravel(), z_rate.full().ravel()])

    x = np.concatenate([pose, rest, z])
    # Steps well inside the smooth core of dry friction (1e-3 of the top speed).
    size = np.concatenate(
        [np.full(n, 1e-6), [1e-6 * limit.speed for limit in limits], np.full(z.size, 1e-6)]
    )
    columns = [
        (rate(x + h * unit) - rate(x - h * unit)) / (2 * h)
        for h, unit in zip(size, np.eye(x.size), strict=True)
    ]
    return np.column_stack(columns)
