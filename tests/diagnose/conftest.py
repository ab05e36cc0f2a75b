"""Two simulated runs of the demonstration arm, and a way to hide effects in them."""

import dataclasses
import tempfile
from collections.abc import Callable
from functools import cache, cached_property, lru_cache
from pathlib import Path

import numpy as np
import pytest

from modeler.api import compile_model, derive, fit, generate, load, observe
from modeler.cli import main
from modeler.codegen.workflow import Derivation
from modeler.core.manifest import Emitted
from modeler.diagnosis.diagnosis import diagnose
from modeler.diagnosis.result import Diagnosis
from modeler.estimation.model_file import IdentifiedModel
from modeler.observation.log import Log
from modeler.observation.read import read_log
from modeler.runtime.model import CompiledModel
from modeler.simulation import SimulationSettings, simulate, write_log

SEEDS = {"train": (4, 30.0), "holdout": (5, 20.0)}
RATE = 500.0  # Hz

Torque = Callable[[Log], np.ndarray]
"""(n, joints) torque that a hidden effect adds to a log."""


@dataclasses.dataclass(frozen=True, eq=False)
class Case:
    """A robot, its two runs without any hidden effect, and fits of them with one."""

    derivation: Derivation
    compiled: CompiledModel
    train: Log
    holdout: Log

    @cached_property
    def emitted(self) -> Emitted:
        """The C of the robot."""
        return generate(self.derivation)

    def hidden(self, torque: Torque) -> tuple[IdentifiedModel, Log, Log]:
        """The model fitted to the training run with the effect, and both runs with it."""
        return _hidden(self, torque)

    def found(self, torque: Torque, without: tuple[str, ...] = ()) -> Diagnosis:
        """What is said of both runs with the effect; of the last few it is remembered."""
        return _found(self, torque, without)

    def fitted(self, log: Log) -> IdentifiedModel:
        """The model fitted to one log."""
        return fit(self.derivation, self.emitted, observe(self.compiled, [log]))


@lru_cache(maxsize=8)
def _hidden(case: Case, torque: Torque) -> tuple[IdentifiedModel, Log, Log]:
    train, holdout = (
        dataclasses.replace(log, tau=log.tau + torque(log), content=log.content + "x")
        for log in (case.train, case.holdout)
    )
    return case.fitted(train), train, holdout


@lru_cache(maxsize=4)
def _found(case: Case, torque: Torque, without: tuple[str, ...]) -> Diagnosis:
    model, train, holdout = case.hidden(torque)
    return diagnose(model, case.compiled, [train], [holdout], without=without)


@cache
def demonstration(rate: float = RATE) -> Case:
    """The demonstration arm, once for all tests of a process."""
    derivation = derive(load("demo-arm"))
    compiled, logs = compile_model(generate(derivation)), []
    with tempfile.TemporaryDirectory() as folder:
        for name, (seed, duration) in SEEDS.items():
            place = Path(folder) / f"{name}.parquet"
            settings = SimulationSettings(
                duration=duration, rate=rate, seed=seed, torque_noise=0.01
            )
            write_log(place, simulate(derivation.robot, settings))
            logs.append(read_log(place, compiled.spec))
    return Case(derivation, compiled, *logs)


@pytest.fixture(scope="session")
def case() -> Case:
    """The demonstration arm."""
    return demonstration()


Run = Callable[..., tuple[int, str, str]]


def made(*words: object) -> None:
    """A command that ends well."""
    assert main([str(word) for word in words]) == 0


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Run:
    """Status, stdout, stderr of a command."""

    def call(*words: object) -> tuple[int, str, str]:
        capsys.readouterr()
        status = main([str(word) for word in words])
        out, err = capsys.readouterr()
        return status, out, err

    return call


@pytest.fixture(scope="session")
def arm(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with two simulated logs of the arm, and a model fitted to the first."""
    folder = tmp_path_factory.getbasetemp() / "arm-of-all-folders"
    if not folder.exists():
        folder.mkdir()
        for name, seed in (("train", 4), ("other", 5)):
            log = folder / f"{name}.parquet"
            words = ("--duration", 15, "--rate", 250, "--seed", seed, "--out", log)
            made("simulate", "demo-arm", *words)
        made("fit", "demo-arm", folder / "train.parquet", "--out", folder / "m.json")
    return folder


def motion(log: Log) -> tuple[np.ndarray, np.ndarray]:
    """Commanded positions and their velocities: what no encoder has touched."""
    assert log.commanded is not None
    return log.commanded, np.gradient(log.commanded, log.time, axis=0)


def on_joint(log: Log, joint: int, torque: np.ndarray) -> np.ndarray:
    """(n, joints) zero but on one joint."""
    found = np.zeros_like(log.tau)
    found[:, joint] = torque
    return found


def nothing(log: Log) -> np.ndarray:
    """No effect at all."""
    return np.zeros_like(log.tau)


def spring(log: Log) -> np.ndarray:
    """A spring on joint 3."""
    return on_joint(log, 2, 1.5 * motion(log)[0][:, 2])


def position_friction(log: Log) -> np.ndarray:
    """Friction of joint 1 that depends on its position."""
    q, v = motion(log)
    return on_joint(log, 0, 2.5 * np.cos(q[:, 0] - 1.0) * np.tanh(v[:, 0] / 0.002))


def two(log: Log) -> np.ndarray:
    """Both."""
    return spring(log) + position_friction(log)
