"""Are the sigmas what repetition shows? Machines of known values, measured again and again.

Each seed is another machine: a two-link arm whose parameters lie 10 % (standard deviation) about
those of its file, another motion, other noise.
"""

import dataclasses
import re
import time
from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from modeler import api
from modeler.core.builtin import builtin_text
from modeler.core.errors import DataError
from modeler.estimation.identify import identify
from modeler.observation.log import Log
from modeler.robot.read import robot_from_text
from modeler.runtime.model import CompiledModel
from modeler.simulation import SimulationSettings, simulate

ROBOT = "two-link"
SCATTER = 0.1  # of the machine's parameters about those of the file
DURATION, RATE = 8.0, 500.0
CASES = {"torque": (0.02, 1_000_000), "encoder": (0.02, 6_000), "coarse": (0.02, 1_500)}
"""Torque noise as a share of the rms torque, and counts of the encoders per turn."""

_TUBES = ["XX", "XY", "XZ", "YY", "YZ", "ZZ", "MX", "MY", "MZ", "M"]


@dataclasses.dataclass(frozen=True, eq=False)
class Covered:
    """What one method did over the seeds of one case.

    Attributes:
        z: (seeds, c) estimate less truth over sigma; NaN where it was set aside.
        shift: (seeds, c) estimate less truth over truth.
        seconds: (seeds,) of each fit.
        refused: how many fits were refused.
    """

    z: np.ndarray
    shift: np.ndarray
    seconds: np.ndarray
    refused: int


@lru_cache(maxsize=1)
def compiled() -> CompiledModel:
    return api.compile_model(api.generate(api.derive(api.load(ROBOT))))


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

    head, mark, body = builtin_text(ROBOT).partition("[parameters]")
    return head + mark + re.sub(r"(?m)^([A-Z][A-Za-z]*[12]) = ([-\d.]+)", other, body)


def measured(seed: int, case: str) -> tuple[Log, np.ndarray]:
    """A log of a machine, and its true base parameters."""
    noise, counts = CASES[case]
    settings = SimulationSettings(
        duration=DURATION, rate=RATE, seed=seed, torque_noise=noise, encoder_counts=counts
    )
    run = simulate(robot_from_text(machine(seed), f"machine {seed}"), settings)
    spec = compiled().spec
    chi = np.array([run.truth.parameters[parameter.name] for parameter in spec.standard])
    log = Log(f"run{seed}", run.joints, run.time, run.q, run.tau, commanded=run.qc)
    return log, compiled().base_parameters(chi)


def covered(seeds: Sequence[int], case: str, methods: Sequence[str]) -> dict[str, Covered]:
    """Every method on every seed."""
    found: dict[str, list[tuple[np.ndarray, np.ndarray, float]]] = {m: [] for m in methods}
    refused = dict.fromkeys(methods, 0)
    for seed in seeds:
        log, truth = measured(seed, case)
        observation = api.observe(compiled(), [log])
        for method in methods:
            start = time.perf_counter()
            try:
                fit = identify(observation, method, compiled())
            except DataError:
                refused[method] += 1
                continue
            seconds = time.perf_counter() - start
            sigma = np.array([p.sigma or np.nan for p in fit.parameters])
            away = fit.beta - truth
            scale = np.where(np.abs(truth) > 1e-9, truth, np.nan)
            found[method].append((away / sigma, away / scale, seconds))
    return {
        method: Covered(*(np.array(column) for column in zip(*rows, strict=True)), refused[method])
        for method, rows in found.items()
        if rows
    }


def table(case: str, found: dict[str, Covered]) -> str:
    """As Markdown."""
    noise, counts = CASES[case]
    lines = [
        f"Case {case}: torque noise {100 * noise:g} %, {counts} counts a turn, "
        f"{len(next(iter(found.values())).z)} machines",
        "",
        "| method | abs z < 1 | abs z < 2 | rms z | worst rms z | mean z | rms error % | seconds |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for method, own in found.items():
        z = own.z[np.isfinite(own.z)]
        by_column = np.sqrt(np.nanmean(own.z**2, axis=0))
        bias = np.abs(np.nanmean(own.z, axis=0)).max()
        error = 100 * np.sqrt(np.nanmean(own.shift**2))
        cells = [
            method,
            *(f"{100 * np.mean(np.abs(z) < width):.0f} %" for width in (1, 2)),
            f"{np.sqrt(np.mean(z**2)):.2f}",
            f"{by_column.max():.2f}",
            f"{bias:.2f}",
            f"{error:.2f}",
            f"{own.seconds.mean():.2f}" + (f", {own.refused} refused" if own.refused else ""),
        ]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)
