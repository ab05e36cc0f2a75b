"""Are the sigmas what repetition shows? Machines of known values, measured again and again.

Each seed is another machine, another motion, other noise: a two-link arm whose parameters lie 10 %
(standard deviation) about those of its file, or a built-in robot whose file leaves them open.
"""

import dataclasses
import re
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

import numpy as np

from modeler import api
from modeler.core.choices import read_builtin_robot
from modeler.core.errors import DataError
from modeler.estimation.identify import identify
from modeler.regression.log import Log
from modeler.robot.read import parse_robot_text
from modeler.runtime.model import CompiledModel
from modeler.simulation import SimulationSettings, simulate
from tests.chain import chain_of

TWO_LINK = "two-link"
SCATTER = 0.1  # of the machine's parameters about those of the file
INTERVAL = 1.96  # sigmas of a stated 95 % interval


@dataclasses.dataclass(frozen=True)
class Case:
    """What is measured, and how well.

    Attributes:
        noise: of the torques, as a share of their rms.
        counts: of the encoders per turn.
        robot: built-in.
        duration: s.
        rate: samples per second.
        bursts: a joint, in which its torque sensor reads 1 to 3 rms too much or too little, 60 ms.
    """

    noise: float = 0.02
    counts: int = 1_000_000
    robot: str = TWO_LINK
    duration: float = 8.0
    rate: float = 500.0
    bursts: int = 0


CASES = {
    "torque": Case(),
    "encoder": Case(counts=6_000),
    "coarse": Case(counts=1_500),
    "bursts": Case(counts=20_000, bursts=4),
    "bound": Case(0.1, 20_000, "wrist", 6.0, 250.0),
    "arm": Case(0.1, 20_000, "demo-arm", 6.0, 250.0),
    "loop": Case(0.02, 20_000, "five-bar", 8.0, 250.0),
}
"""A quiet arm; coarser encoders; sensors that are wrong at times; arms whose links come to the
bound of what can be built; a closed loop under its controller."""

_TUBES = ["XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M"]


@dataclasses.dataclass(frozen=True, eq=False)
class Covered:
    """What one method did over the seeds of one case.

    Attributes:
        z: (fits, c) estimate less truth over sigma; NaN where it was set aside.
        shift: (fits, c) estimate less truth over truth.
        seconds: (fits,) of CPU time.
        refused: so many more were refused.
    """

    z: np.ndarray
    shift: np.ndarray
    seconds: np.ndarray
    refused: int


def compiled(robot: str = TWO_LINK) -> CompiledModel:
    return chain_of(robot).compiled


def machine(seed: int) -> str:
    """The robot file of a machine whose parameters are not quite those of the file.

    The inertia of a link is scaled as a whole (a heavier tube), friction entry by entry.
    """
    rng = np.random.default_rng([seed, 77])
    scale = {f"link{j}": 1.0 + SCATTER * rng.normal() for j in "12"}

    def other(found: re.Match[str]) -> str:
        name, value = found[1], float(found[2])
        tube = name.rstrip("12") in _TUBES
        factor = scale[f"link{name[-1]}"] if tube else 1.0 + SCATTER * rng.normal()
        return f"{name} = {value * factor!r}"

    head, mark, body = read_builtin_robot(TWO_LINK).partition("[parameters]")
    return head + mark + re.sub(r"(?m)^([A-Z][A-Za-z]*[12]) = ([-\d.]+)", other, body)


def measured(seed: int, case: str) -> tuple[Log, np.ndarray]:
    """A log of a machine, and its true base parameters."""
    how = CASES[case]
    file = parse_robot_text(machine(seed), f"machine {seed}")
    robot = file if how.robot == TWO_LINK else api.load(how.robot)
    settings = SimulationSettings(
        duration=how.duration,
        rate=how.rate,
        seed=seed,
        parameter_seed=seed,
        controller=True,
        torque_noise=how.noise,
        encoder_counts=how.counts,
    )
    run, model = simulate(robot, settings), compiled(how.robot)
    chi = np.array([run.truth.parameters[parameter.name] for parameter in model.spec.standard])
    tau = with_bursts(run.tau, how, np.random.default_rng([seed, 88]))
    log = Log(f"run{seed}", run.joints, run.time, run.q, tau, commanded=run.qc)
    return log, model.base_parameters(chi)


def with_bursts(tau: np.ndarray, how: Case, rng: np.random.Generator) -> np.ndarray:
    """(n, joints) with what the sensors of a case add."""
    length, size, spoilt = round(0.06 * how.rate), np.sqrt(np.mean(tau**2, axis=0)), tau.copy()
    for joint in range(tau.shape[1]):
        for start in rng.integers(0, len(tau) - length, how.bursts):
            far = rng.choice([-1.0, 1.0]) * rng.uniform(1.0, 3.0) * size[joint]
            spoilt[start : start + length, joint] += far
    return spoilt


_Row = tuple[np.ndarray, np.ndarray, float]


def covered(seeds, case, methods, jobs=1):
    """Every method on every seed, in so many processes."""
    inputs = [(seed, case, tuple(methods)) for seed in seeds]
    if jobs == 1:
        every = [*map(_fitted, inputs)]
    else:
        compiled(CASES[case].robot)  # once, not in all processes
        with ProcessPoolExecutor(jobs, get_context("spawn")) as pool:
            every = [*pool.map(_fitted, inputs)]
    table = {method: [item[method] for item in every] for method in methods}
    return {
        method: Covered(
            *(np.array(column) for column in zip(*filter(None, rows), strict=True)),
            rows.count(None),
        )
        for method, rows in table.items()
        if any(rows)
    }


def _fitted(inputs: tuple[int, str, tuple[str, ...]]) -> dict[str, _Row | None]:
    """z, shift and CPU seconds of every method on one machine; None where it is refused."""
    seed, case, methods = inputs
    model = compiled(CASES[case].robot)
    log, truth = measured(seed, case)
    observation = api.observe(model, [log])
    table: dict[str, _Row | None] = {}
    for method in methods:
        start = time.process_time()
        try:
            fit = identify(observation, method, model)
        except DataError:
            table[method] = None
            continue
        seconds = time.process_time() - start
        sigma = np.array([p.sigma or np.nan for p in fit.parameters])
        away, scale = fit.beta - truth, np.where(np.abs(truth) > 1e-9, truth, np.nan)
        table[method] = away / sigma, away / scale, seconds
    return table


def table(case: str, found: dict[str, Covered]) -> str:
    """As Markdown."""
    how, seeds = CASES[case], max(len(entry.z) + entry.refused for entry in found.values())
    sensors = f", {how.bursts} bursts a joint" if how.bursts else ""
    lines = [
        f"Case {case}: {how.robot}, {how.duration:g} s at {how.rate:g} Hz, torque noise "
        f"{100 * how.noise:g} %, {how.counts} counts a turn{sensors}; {seeds} machines",
        "",
        "| method | within sigma | within 95 % interval | worst parameter | rms z "
        "| mean z, largest | median error % | seconds |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for method, item in found.items():
        z, size = item.z[np.isfinite(item.z)], np.abs(item.z)
        inside = np.where(np.isfinite(size), size < INTERVAL, np.nan)
        cells = [
            method,
            f"{100 * np.mean(np.abs(z) < 1):.0f} %",
            f"{100 * np.nanmean(inside):.1f} %",
            f"{100 * np.nanmean(inside, axis=0).min():.0f} %",
            f"{np.sqrt(np.mean(z**2)):.2f}",
            f"{np.abs(np.nanmean(item.z, axis=0)).max():.2f}",
            f"{100 * np.nanmedian(np.abs(item.shift)):.2f}",
            f"{item.seconds.mean():.2f}" + (f", {item.refused} refused" if item.refused else ""),
        ]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)
