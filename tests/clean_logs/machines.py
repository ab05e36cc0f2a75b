"""Random arms without a fault, and the ways in which their logs are recorded.

A machine has two of the ways of `WAYS`: friction that sticks, slow motion with coarse logged
speeds, gaps, channels that are refreshed slower than the rows, an uneven clock, one joint at a
time. All of them are harmless; `Truth` says what is right.
"""

from dataclasses import dataclass, field
from itertools import combinations
from pathlib import Path

import numpy as np

from tests.hidden_effects.drives import equip, measured_noise
from tests.hidden_effects.effects import BASE
from tests.hidden_effects.motion import Bounds, draw_bounds, fourier, moves
from tests.hidden_effects.plant import STEPS, TICK, Plant, Run
from tests.hidden_effects.robot_file import robot_text
from tests.hidden_effects.robots import draw_arm
from tests.hidden_effects.sensors import write

WAYS = ("sticks", "slow", "gaps", "held", "uneven", "single")
PAIRS = tuple(combinations(WAYS, 2))
SECONDS = 24.0
RINGS = 30.0  # Hz: a joint with a thousandth of its energy above it is no quiet one


@dataclass
class Truth:
    """What is right of a log.

    Attributes:
        ways: of recording.
        rate: of the rows, Hz.
        held: channel -> seconds after which it is refreshed.
        steps: channel -> resolution, in its unit.
    """

    ways: tuple[str, ...]
    rate: float = 1000.0
    held: dict[str, float] = field(default_factory=dict)
    steps: dict[str, float] = field(default_factory=dict)


def make_machine(seed: int, folder: Path, ways: tuple[str, ...] | None = None) -> Truth:
    """Write robot.toml, train.parquet and holdout.parquet of a machine; give what is right of them.

    Args:
        seed: of arm, motion and recording; the pair of ways is the seed's, one after the other.
        folder: where to; made if need be.
        ways: of recording, in place of the seed's.
    """
    ways = ways or PAIRS[seed % len(PAIRS)]
    for attempt in range(30):
        rng = np.random.default_rng([seed, 4711, attempt])
        plant, paths, noise = _draw(rng, ways)
        runs = [_run(plant, path, seed + 5 * k) for k, path in enumerate(paths)]
        whole = [run for run in runs if run is not None]
        if len(whole) == len(paths):
            break
    else:
        raise AssertionError(f"machine {seed}: every arm runs away or rings")
    n = plant.joints
    folder.mkdir(parents=True, exist_ok=True)
    text = robot_text(f"clean{seed}", plant, {name: list(range(n)) for name in BASE})
    (folder / "robot.toml").write_text(text, encoding="utf-8")
    truth = Truth(ways, rate=float(rng.choice([200, 250, 500, 1000])))
    choices = int(rng.integers(1 << 30))
    for name, path, run in zip(("train", "holdout"), paths, whole, strict=True):
        torque = run.torque[::STEPS] + rng.normal(size=path.shape) * noise
        columns = _recorded(run.encoder, path, torque, plant, truth, choices, rng)
        write(columns, folder / f"{name}.parquet")
    return truth


def _draw(rng, ways):
    """An arm, its two motions, the noise of its torques."""
    plant, _ = draw_arm(rng, str(rng.choice(["2R", "3R", "4R", "6R"], p=[0.2, 0.45, 0.2, 0.15])))
    bounds = draw_bounds(rng, plant.joints)
    if "slow" in ways:
        bounds = Bounds(bounds.angle, bounds.speed / 5, bounds.acceleration / 12)
    paths = [_path(rng, bounds, ways) for _ in range(2)]
    scales = equip(plant, bounds, paths[0], "low", rng)
    if "sticks" in ways:
        _let_it_stick(plant, rng)
    return plant, paths, measured_noise(scales, "low")


def _run(plant: Plant, path: np.ndarray, seed: int) -> Run | None:
    """The motion; None if the controller loses its arm, or the arm truly rings."""
    run = plant.run(path, np.full(plant.joints, 22.0), seed)
    if run is None:
        return None
    speed = np.diff(run.link, axis=0) / TICK
    power = np.abs(np.fft.rfft(speed, axis=0)) ** 2
    quick = np.fft.rfftfreq(len(speed), TICK) > RINGS
    share = power[quick].sum(0) / np.maximum(power.sum(0), 1e-12)
    return None if share.max() > 1e-3 else run


def _path(rng: np.random.Generator, bounds: Bounds, ways: tuple[str, ...]) -> np.ndarray:
    path = np.vstack([moves(rng, SECONDS / 2, bounds), fourier(rng, SECONDS / 2, bounds)])
    if "single" not in ways:
        return path
    n, ticks = path.shape[1], len(path)
    alone = np.zeros((n * (ticks + 500), n))
    for j in range(n):
        alone[j * (ticks + 500) : j * (ticks + 500) + ticks, j] = path[:, j]
    return alone[:: max(1, n // 2)].copy() if n < 3 else _shorter(alone, n)


def _shorter(path: np.ndarray, n: int) -> np.ndarray:
    """Of each joint's turn the moves of half the time: logs of six joints stay short."""
    turn = len(path) // n
    parts = [path[j * turn + turn // 2 : (j + 1) * turn] for j in range(n)]
    return np.vstack(parts)


def _let_it_stick(plant: Plant, rng: np.random.Generator) -> None:
    """Much dry friction under a soft controller: a joint rests before it turns back."""
    plant.coulomb = plant.coulomb * rng.uniform(2.5, 5)
    plant.integral_gain = plant.integral_gain * 0.0
    plant.position_gain = plant.position_gain * rng.uniform(0.4, 0.8)
    plant.torque_limit = plant.torque_limit * 2


def _recorded(q, wanted, torque, plant, truth, choices, rng):
    """The columns of a log, as this machine's recorder writes them."""
    item = np.random.default_rng(choices)  # what both logs of a machine share
    n, ticks = q.shape[1], np.arange(len(q))
    every = round(1 / (TICK * truth.rate))
    rows, time = ticks[::every], ticks[::every] * TICK
    if "uneven" in truth.ways:
        spread = item.uniform(0.1, 0.4) * every * TICK
        time = np.sort(time + rng.uniform(-spread, spread, len(time)))
        time -= time[0]
        rows = np.clip(np.round(time / TICK).astype(int), 0, len(q) - 1)
        time = rows * TICK + 1e-9 * np.arange(len(rows)) if every >= 4 else time
        unique = np.concatenate([[True], np.diff(time) > 1e-6])
        rows, time = rows[unique], time[unique]
    step = np.array([plant.encoder_step[j] for j in range(n)])
    counted = step * np.ones(n)
    if item.uniform() < 0.5:  # an encoder of the kind that many arms have
        counted = np.maximum(step, 2 * np.pi / 2 ** item.integers(14, 18, n))
    read = np.floor(q / counted + 0.5) * counted
    columns = {"time": time}
    columns |= {f"q{j + 1}": read[rows, j] for j in range(n)}
    truth.steps |= {f"q{j + 1}": float(counted[j]) for j in range(n)}
    if item.uniform() < 0.5:
        columns |= {f"qc{j + 1}": wanted[rows, j] for j in range(n)}
    if "slow" in truth.ways or item.uniform() < 0.3:
        columns |= _logged_speeds(read, rows, float(item.uniform(0.002, 0.02)))
    grain = float(item.choice([0.0, 0.01, 0.05]))
    measured = torque[rows]
    measured = np.round(measured / grain) * grain if grain else measured
    columns |= {f"tau{j + 1}": measured[:, j] for j in range(n)}
    if "held" in truth.ways:
        _hold(columns, truth, item, n)
    if "gaps" in truth.ways:
        columns = _with_gaps(columns, rng)
    return columns


def _logged_speeds(q: np.ndarray, rows: np.ndarray, step: float) -> dict[str, np.ndarray]:
    """Speeds as a drive differences them over 8 ms, rounded to steps."""
    width = 8
    late = np.vstack([q[:1].repeat(width, 0), q[:-width]])
    speed = np.round((q - late) / (width * TICK) / step) * step
    return {f"qd{j + 1}": speed[rows, j] for j in range(q.shape[1])}


def _hold(columns: dict[str, np.ndarray], truth: Truth, rng: np.random.Generator, n: int) -> None:
    """Refresh one channel, or two, every 20 ms only, as a slow bus does."""
    names = [f"{kind}{j + 1}" for kind in ("q", "tau") for j in range(n)]
    for name in rng.choice(names, int(rng.integers(1, 3)), replace=False):
        rows = max(2, round(0.02 * truth.rate))
        values = columns[name]
        columns[name] = values[(np.arange(len(values)) // rows) * rows]
        truth.held[str(name)] = rows / truth.rate


def _with_gaps(columns: dict[str, np.ndarray], rng: np.random.Generator) -> dict[str, np.ndarray]:
    time = columns["time"]
    keep = np.ones(len(time), bool)
    for start in rng.uniform(1, time[-1] - 2, int(rng.integers(3, 8))):
        lasts = float(rng.choice([0.03, 0.15, 0.4]))
        keep &= ~((time >= start) & (time < start + lasts))
    return {name: values[keep] for name, values in columns.items()}
