"""Two simulated runs of the demonstration arm, and a way to hide effects in them."""

import dataclasses
from collections.abc import Callable, Mapping
from functools import cache, lru_cache
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from modeler.cli import main
from modeler.codegen.workflow import Derivation
from modeler.core.table import format_error_pair
from modeler.diagnosis.diagnosis import diagnose
from modeler.diagnosis.result import Diagnosis
from modeler.estimation.model_file import IdentifiedModel
from modeler.regression.log import Log
from modeler.runtime.model import CompiledModel
from tests.chain import Chain, chain_of

SECONDS = (22.0, 14.0)
RATE = 250.0  # Hz

Torque = Callable[[Log], np.ndarray]
"""(n, joints) torque that a hidden effect adds to a log."""


@dataclasses.dataclass(frozen=True, eq=False)
class Case:
    """A robot, its two runs without any hidden effect, and fits of them with one."""

    chain: Chain
    train: Log
    holdout: Log

    @property
    def derivation(self) -> Derivation:
        """Of the robot."""
        return self.chain.derivation

    @property
    def compiled(self) -> CompiledModel:
        """The robot."""
        return self.chain.compiled

    def hidden(self, torque: Torque) -> tuple[IdentifiedModel, Log, Log]:
        """The model fitted to the training run with the effect, and both runs with it."""
        return _hidden(self, torque)

    def found(self, torque: Torque, without: tuple[str, ...] = ()) -> Diagnosis:
        """What is said of both runs with the effect."""
        return (_shared if torque in SHARED and not without else _found)(self, torque, without)

    def fitted(self, log: Log) -> IdentifiedModel:
        """The model fitted to one log."""
        return self.chain.fit([log])


@lru_cache(maxsize=8)
def _hidden(case: Case, torque: Torque) -> tuple[IdentifiedModel, Log, Log]:
    train, holdout = (
        dataclasses.replace(log, tau=log.tau + torque(log), content=log.content + "x")
        for log in (case.train, case.holdout)
    )
    return case.fitted(train), train, holdout


def _diagnosed(case: Case, torque: Torque, without: tuple[str, ...]) -> Diagnosis:
    model, train, holdout = case.hidden(torque)
    result = diagnose(model, case.compiled, [train], [holdout], without=without)
    check_gains(result)
    return result


_found, _shared = lru_cache(maxsize=4)(_diagnosed), cache(_diagnosed)


def check_gains(found: Diagnosis) -> None:
    """The gain of an effect is what its two printed errors imply, and nothing else."""
    findings, text = [*found.effects, *found.refinements], found.to_json()
    for plain, finding in zip([*text["effects"], *text["refinements"]], findings, strict=True):
        before, after = plain["error_before"], plain["error_after"]
        if after is None:  # play whose column does not lower the error
            assert plain["gain"] is None
            continue
        assert abs(plain["gain"] - (1.0 - (after / before) ** 2)) < 1e-12
        numbers = format_error_pair(before, after)
        assert numbers[0] != numbers[1] and after < before
        assert " -> ".join(numbers) in finding.evidence


@cache
def demonstration(rate=RATE, robot="demo-arm", seconds=SECONDS):
    """The demonstration arm, or another robot, once for all tests of a process."""
    chain = chain_of(robot)
    runs = (
        chain.log(name, duration=duration, rate=rate, seed=seed, torque_noise=0.01)
        for name, seed, duration in zip(("train", "holdout"), (4, 5), seconds, strict=True)
    )
    return Case(chain, *runs)


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


Table = Mapping[str, np.ndarray]
"""Columns of a log."""


def columns_of(place: Path) -> dict[str, np.ndarray]:
    """Of a Parquet file."""
    read = pq.read_table(place)
    return {name: read[name].to_numpy().copy() for name in read.column_names}


def written(place: Path, columns: Table) -> Path:
    """The log as a Parquet file."""
    pq.write_table(pa.table(dict(columns)), place)
    return place


def motion(log: Log) -> tuple[np.ndarray, np.ndarray]:
    """Commanded positions and their velocities: what no encoder has touched."""
    assert log.commanded is not None
    return log.commanded, np.gradient(log.commanded, log.time, axis=0)


def on_joint(log: Log, joint: int, torque: np.ndarray) -> np.ndarray:
    """(n, joints) zero but on one joint."""
    actual = np.zeros_like(log.tau)
    actual[:, joint] = torque
    return actual


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


SHARED = (nothing, spring, two)
"""Torques that many tests ask about: what is said of them is kept."""
