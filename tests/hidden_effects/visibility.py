"""How much of a hidden effect is there to be seen: what a fit of the admitted effects leaves over.

The fit is least squares in a numeric regressor that is read off the plant's inverse dynamics by
unit masses, first moments and tensors.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.signal import butter, sosfiltfilt

from tests.hidden_effects.drives import NOISE, Scales
from tests.hidden_effects.effects import LOADS
from tests.hidden_effects.plant import Plant, rate
from tests.hidden_effects.robots import point_inertia
from tests.hidden_effects.sensors import logged_torque

SLOW = 0.03  # rad/s: Coulomb friction is not sign(v) there
KEPT = slice(100, -100, 12)  # rows after the low-pass filters
BANDS = (29.0, 10.0, 4.0, 2.0)  # Hz, where an effect is looked for beside the noise of positions

Effects = Mapping[str, Sequence[int]]


@dataclass(frozen=True)
class Trial:
    """A motion (ticks, n), temperatures (n,) at its start, and the seed of its run."""

    wanted: np.ndarray
    temperature: np.ndarray
    seed: int


@dataclass(frozen=True)
class Left:
    """What a fit of the admitted effects leaves of the torque, below 30 Hz, on a fine encoder.

    Attributes:
        torque: (rows, n) N m.
        used: (rows, n) rows of it that count.
        encoder: (ticks, n) rad, of the motion.
    """

    torque: np.ndarray
    used: np.ndarray
    encoder: np.ndarray


def left_over(plant, without, name, admitted, delay, trial):
    """What is left over of an effect without noise; None if the arm runs away.

    Args:
        plant: with this effect only.
        without: the same arm without it.
        name: of the effect.
        admitted: effects of the fit.
        delay: s, of the logged torque.
        trial: the motion.
    """
    quiet, plain = plant.copy(), without.copy()
    quiet.noise_torque = plain.noise_torque = 0
    run = quiet.run(trial.wanted, trial.temperature, trial.seed)
    if run is None:
        return None
    rows = regression(without if name in (*LOADS, "base_tilt") else plant, run, delay, admitted)
    learnt = rows
    if name in LOADS:  # the fit has the arm without its load
        unloaded = plain.run(trial.wanted, trial.temperature, trial.seed)
        if unloaded is None:
            return None
        learnt = regression(without, unloaded, 0.0, admitted)
    phi, torque, used = rows
    return Left(torque - phi @ least_squares(*learnt), used, run.encoder)


def visibility(left: Left | None, scales: Scales) -> float:
    """Rms left over on the joint where it is largest, in rms of the medium noise; nan if lost."""
    if left is None:
        return float("nan")
    return float(np.max(_rms(left.torque, left.used) / scales.motors) / NOISE["med"])


def shown(left: Left, plant: Plant, read: np.ndarray, noise: str, scales: Scales) -> float:
    """Visibility beside the noise of positions, in the band where it is best.

    The noise is what the torque of the arm differs by along the positions as read.

    Args:
        left: over from the effect.
        plant: the arm.
        read: (ticks, n) rad, positions as the log has them.
        noise: level of the case.
        scales: of the arm.
    """
    low, last = (butter(4, hertz, fs=1000, output="sos") for hertz in (40, 30))
    moved = []
    for path in (read, left.encoder):
        q = sosfiltfilt(low, path, axis=0)
        v = rate(q)
        a = rate(v)
        asked = plant.inverse_dynamics(q, v, a)[0] + plant.rotor_inertia * a + plant.viscous * v
        moved.append(sosfiltfilt(last, asked, axis=0)[KEPT])
    items, blur = left.torque * left.used, (moved[0] - moved[1]) * left.used
    drive, best = NOISE[noise] * scales.motors, np.zeros(plant.joints)
    for band in BANDS:
        narrow = butter(4, band, fs=1000 / KEPT.step, output="sos")
        size, noisy = (_rms(sosfiltfilt(narrow, x, axis=0), left.used) for x in (items, blur))
        best = np.maximum(best, size / np.sqrt(drive**2 + noisy**2))
    return float(best.max() * NOISE[noise] / NOISE["med"])


def _rms(values: np.ndarray, used: np.ndarray) -> np.ndarray:
    rows = zip(values.T, used.T, strict=True)
    return np.array([np.sqrt((item[use] ** 2).mean()) for item, use in rows])


def regression(plant, run, delay, effects):
    """Regressor (rows, n, columns), torque (rows, n) and which of them to use, below 30 Hz."""
    low = butter(4, 40, fs=1000, output="sos")
    q = sosfiltfilt(low, run.encoder, axis=0)
    v = rate(q)
    a = rate(v)
    columns = _links(plant, q, v, a)
    for name, joints in effects.items():
        value = {"viscous": v, "coulomb": np.sign(v), "rotor_inertia": a}.get(name, np.ones_like(v))
        for j in joints:
            column = np.zeros_like(v)
            column[:, j] = value[:, j]
            columns.append(column)
    last = butter(4, 30, fs=1000, output="sos")
    filtered = [sosfiltfilt(last, x, axis=0)[KEPT] for x in (*columns, logged_torque(run, delay))]
    slow = [np.convolve(np.abs(v[:, j]) < SLOW, np.ones(41), "same") > 0 for j in range(q.shape[1])]
    return np.stack(filtered[:-1], 2), filtered[-1], ~np.stack(slow, 1)[KEPT]


def least_squares(phi: np.ndarray, torque: np.ndarray, used: np.ndarray) -> np.ndarray:
    """(columns,): rows weighed by the torque of their joint; what is not excited is left at 0."""
    weights = 1 / torque.std(0)
    matrix = (phi * weights[None, :, None])[used]
    size = np.linalg.norm(matrix, axis=0) + 1e-30
    matrix /= size
    squares, ways = np.linalg.eigh(matrix.T @ matrix)
    ways, squares = ways[:, squares > squares[-1] * 1e-13], squares[squares > squares[-1] * 1e-13]
    return (ways @ (ways.T @ (matrix.T @ (torque * weights)[used]) / squares)) / size


def _links(plant: Plant, q: np.ndarray, v: np.ndarray, a: np.ndarray) -> list[np.ndarray]:
    """Torque (ticks, n) of unit mass, first moments and tensor about the frame, link by link."""
    bare = plant.copy()
    bare.mass = bare.centre = bare.inertia = 0

    def torque(j: int, mass: float, centre: np.ndarray, inertia: np.ndarray) -> np.ndarray:
        link = bare.copy()
        link.mass[j], link.centre[j], link.inertia[j] = mass, centre, inertia.ravel()
        return link.inverse_dynamics(q, v, a)[0]

    columns = []
    for j in range(plant.joints):
        columns.append(mass := torque(j, 1, np.zeros(3), np.zeros(9)))
        columns += [torque(j, 1, c, -point_inertia(1, c)) - mass for c in np.eye(3)]
        for k in range(3):
            for l in range(k, 3):
                tensor = np.zeros((3, 3))
                tensor[k, l] = tensor[l, k] = 1
                columns.append(torque(j, 0, np.zeros(3), tensor))
    return columns
