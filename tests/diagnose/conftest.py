"""Two simulated runs of the demonstration arm, and a way to hide effects in them."""

import dataclasses
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from modeler.api import compile_model, derive, fit, generate, load, observe
from modeler.codegen.workflow import Derivation
from modeler.estimation.model_file import IdentifiedModel
from modeler.observation.log import Log
from modeler.observation.read import read_log
from modeler.runtime.model import CompiledModel
from modeler.simulation import SimulationSettings, simulate, write_log

SEEDS = {"train": (4, 30.0), "holdout": (5, 20.0)}

Torque = Callable[[Log], np.ndarray]
"""(n, joints) torque that a hidden effect adds to a log."""


@dataclasses.dataclass(frozen=True, eq=False)
class Case:
    """A robot, its two runs without any hidden effect, and fits of them with one."""

    derivation: Derivation
    compiled: CompiledModel
    train: Log
    holdout: Log

    def hidden(self, torque: Torque) -> tuple[IdentifiedModel, Log, Log]:
        """The model fitted to the training run with the effect, and both runs with it."""
        logs = [
            dataclasses.replace(log, tau=log.tau + torque(log), content=log.content + "x")
            for log in (self.train, self.holdout)
        ]
        return self.fitted(logs[0]), logs[0], logs[1]

    def fitted(self, log: Log) -> IdentifiedModel:
        """The model fitted to one log."""
        emitted = generate(self.derivation)
        return fit(self.derivation, emitted, observe(self.compiled, [log]))


@pytest.fixture(scope="session")
def case(tmp_path_factory: pytest.TempPathFactory) -> Case:
    """The demonstration arm, once for all tests."""
    folder: Path = tmp_path_factory.mktemp("runs")
    derivation = derive(load("demo-arm"))
    compiled = compile_model(generate(derivation))
    logs = {}
    for name, (seed, duration) in SEEDS.items():
        settings = SimulationSettings(duration=duration, seed=seed, torque_noise=0.01)
        write_log(folder / f"{name}.parquet", simulate(derivation.robot, settings))
        logs[name] = read_log(folder / f"{name}.parquet", compiled.spec)
    return Case(derivation, compiled, logs["train"], logs["holdout"])


def motion(log: Log) -> tuple[np.ndarray, np.ndarray]:
    """Commanded positions and their velocities: what no encoder has touched."""
    assert log.commanded is not None
    return log.commanded, np.gradient(log.commanded, log.time, axis=0)


def on_joint(log: Log, joint: int, torque: np.ndarray) -> np.ndarray:
    """(n, joints) zero but on one joint."""
    found = np.zeros_like(log.tau)
    found[:, joint] = torque
    return found
