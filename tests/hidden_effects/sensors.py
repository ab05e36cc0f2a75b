"""What is logged of a run, at 1 kHz."""

from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet
from scipy.interpolate import CubicSpline
from scipy.signal import lfilter

from tests.hidden_effects.plant import STEPS, TICK, Run

SENSOR_LAG = 1.5  # s, of a temperature


def logged_torque(run: Run, delay: float) -> np.ndarray:
    """(ticks, n): torque of the motors at the time of the row, or that so many s later."""
    if not delay:
        return run.torque[::STEPS]
    fine = np.arange(len(run.torque)) * (TICK / STEPS)
    rows = np.clip(np.arange(len(run.encoder)) * TICK + delay, 0, fine[-1])
    return CubicSpline(fine, run.torque)(rows)


def log(run, wanted, noise, rng, *, delay=0.0, start=0.0, thermal=False):
    """Columns time, q, qc (wanted), tau and, if thermal, temperature, joint after joint.

    Args:
        run: what happened.
        wanted: (ticks, n) rad.
        noise: (n,) deviation of the measured torque, N m.
        rng: of the noise.
        delay: s, of the torque.
        start: s, time of the first row.
        thermal: True if temperatures are logged.
    """
    ticks, n = wanted.shape
    torque = logged_torque(run, delay)
    torque = torque + rng.normal(size=torque.shape) * noise
    columns = {"time": np.arange(ticks) * TICK + start}
    for name, values in (("q", run.encoder), ("qc", wanted), ("tau", torque)):
        columns |= {f"{name}{j + 1}": values[:, j] for j in range(n)}
    for j in range(n if thermal else 0):
        columns[f"temperature{j + 1}"] = _thermometer(run.temperature[:, j], rng)
    return columns


def write(columns: dict[str, np.ndarray], path: Path) -> None:
    """A Parquet file."""
    pyarrow.parquet.write_table(pyarrow.table(columns), path)


def _thermometer(temperature: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """A first order lag, noise of 0.05 K, steps of 0.01 K."""
    share = TICK / SENSOR_LAG
    start = [(1 - share) * temperature[0]]
    late, _ = lfilter([share], [1, share - 1], temperature, zi=start)
    return np.round(late + rng.normal(size=len(late)) * 0.05, 2)
