"""Fleets whose drifts are known: logs written by a robot's own equations, with coloured noise."""

from dataclasses import dataclass
from functools import cache
from unittest.mock import patch

import numpy as np
from scipy.signal import lfilter

from modeler.api.workflow import load
from modeler.codegen.workflow import derive, generate
from modeler.core.manifest import EmittedModule
from modeler.regression.log import Log
from modeler.regression.motion import Processing
from modeler.runtime.model import CompiledModel
from modeler.validation.fleet_logs import LogName, LogSummary, summarise_log

RATE = 100.0  # Hz


@cache
def emitted(robot: str = "two-link") -> EmittedModule:
    return generate(derive(load(robot)))


@cache
def compiled(robot: str = "two-link") -> CompiledModel:
    from modeler.api import compile_model

    return compile_model(emitted(robot))


@dataclass(frozen=True)
class Planted:
    """What happens to one machine: relative change of a parameter, or gain, by period."""

    machine: int
    name: str
    by_period: tuple[float, ...]


@dataclass(frozen=True)
class Scene:
    """A fleet as it is.

    Attributes:
        machines, periods: how many.
        apart: spread of friction among machines, relative.
        daily: scatter of friction from period to period, relative.
        noise: of torques, as a share of their rms; half of it correlated over 50 ms.
        planted: what drifts.
        warm: True: a temperature column that rises with the periods.
        duration: of a log, s.
    """

    machines: int = 3
    periods: int = 6
    apart: float = 0.1
    daily: float = 0.0
    noise: float = 0.03
    planted: tuple[Planted, ...] = ()
    warm: bool = False
    duration: float = 12.0


def parameters(seed: int, model: CompiledModel) -> np.ndarray:
    """Base parameters of a robot that could be; friction and offset a tenth of its torque."""
    rng = np.random.default_rng([7, seed])
    values = {}
    for parameter in model.spec.standard:
        prefix = parameter.name.rstrip("0123456789")
        size = {"M": 3.0, "MX": 0.6, "MY": 0.1, "MZ": 0.05, "XX": 0.05, "YY": 0.25, "ZZ": 0.25}
        usual = size.get(prefix, {"Fv": 0.8, "Fs": 1.2, "Off": 0.4, "Ia": 0.2}.get(prefix, 0.0))
        values[parameter.name] = usual * rng.uniform(0.8, 1.2)
    return model.base_parameters([values[p.name] for p in model.spec.standard])


def motion(rng: np.random.Generator, joints: int, duration: float) -> tuple[np.ndarray, ...]:
    """Time, q, qd, qdd of a Fourier series."""
    t = np.arange(0.0, duration, 1.0 / RATE)
    base, values = 2.0 * np.pi * 0.15, [np.zeros((len(t), joints)) for _ in range(3)]
    for j in range(joints):
        for k in range(1, 6):
            a, p, w = rng.normal() / k, rng.uniform(0.0, 2.0 * np.pi), base * k
            values[0][:, j] += a * np.sin(w * t + p)
            values[1][:, j] += a * w * np.cos(w * t + p)
            values[2][:, j] -= a * w**2 * np.sin(w * t + p)
    return t, *values


def coloured_noise(rng: np.random.Generator, count: int) -> np.ndarray:
    """Of variance 1: half white, half with a memory of 50 ms."""
    keep = np.exp(-1.0 / (0.05 * RATE))
    pushes = rng.normal(size=count) * np.sqrt(1.0 - keep**2)
    slow = lfilter([1.0], [1.0, -keep], pushes, zi=[keep * rng.normal()])[0]
    return np.sqrt(0.5) * (rng.normal(size=count) + slow)


def logs(scene: Scene, seed: int, robot: str = "two-link") -> list[tuple[LogName, Log]]:
    """The logs of a fleet."""
    model = compiled(robot)
    rng = np.random.default_rng([11, seed])
    usual, values = parameters(seed, model), []
    kinds = np.array([base.kind in ("friction", "offset") for base in model.spec.base])
    names = [base.name for base in model.spec.base]
    for m in range(scene.machines):
        actual = usual * np.where(kinds, 1.0 + scene.apart * rng.normal(size=len(usual)), 1.0)
        for p in range(scene.periods):
            beta = actual * np.where(kinds, 1.0 + scene.daily * rng.normal(size=len(usual)), 1.0)
            gains = np.ones(len(model.spec.joints))
            for plant in scene.planted:
                if plant.machine == m and plant.name.startswith("gain"):
                    gains[int(plant.name[4:]) - 1] += plant.by_period[p]
                elif plant.machine == m and plant.name == "load":
                    beta = beta + plant.by_period[p] * _load(model)
                elif plant.machine == m:
                    beta[names.index(plant.name)] *= 1.0 + plant.by_period[p]
            name = LogName(f"r{m + 1}", f"day{p + 1}", f"r{m + 1}/day{p + 1}.csv")
            values.append((name, _log(model, beta, gains, scene, rng, p)))
    return values


def _load(model: CompiledModel) -> np.ndarray:
    """What 1 kg changes that sits 0.2 m out on the last link."""
    last = model.spec.joints[-1].name
    values = {f"M{last}": 1.0, f"MX{last}": 0.2, f"YY{last}": 0.04, f"ZZ{last}": 0.04}
    return model.base_parameters([values.get(p.name, 0.0) for p in model.spec.standard])


def _log(model, beta, gains, scene, rng, period):
    t, q, qd, qdd = motion(rng, len(gains), scene.duration)
    exact = model.base_regressor(q, qd, qdd) @ beta
    rms = np.sqrt(np.mean(exact**2, axis=0))
    noise = np.column_stack([coloured_noise(rng, len(t)) for _ in gains]) * rms * scene.noise
    extra = {"temperature": np.full(len(t), 22.0 + 2.0 * period)} if scene.warm else {}
    return Log(
        name=f"day{period + 1}.csv",
        joints=tuple(joint.name for joint in model.spec.joints),
        time=t,
        q=q + 1e-5 * rng.normal(size=q.shape),
        tau=exact * gains + noise,
        extra=extra,
    )


PROCESSING = Processing(position_cutoff=20.0, parallel_cutoff=5.0)


@cache
def summaries(scene: Scene, seed: int, robot: str = "two-link") -> tuple[LogSummary, ...]:
    """The fleet as `reduce_log` sees it, with one processing.

    It is not asked whether logs fit the robot at all, which takes longer than all else.
    """
    model, processing = compiled(robot), PROCESSING
    values: list[LogSummary] = []
    with patch("modeler.validation.fleet_logs.find_log_faults", return_value=()):
        for named, log in logs(scene, seed, robot):
            values.append(summarise_log(model, log, named, processing))
            processing = values[0].processing or processing
    return tuple(values)
