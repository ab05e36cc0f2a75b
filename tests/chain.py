"""The chain from a machine to what is said of it: robot, logs, fit and diagnosis, for all tests.

Robots and simulated logs are made once in a process.
"""

import os
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

from modeler import api
from modeler.core.manifest import EmittedModule
from modeler.effects.catalogue import find_effect
from modeler.regression.log import Log
from modeler.regression.read import read_log
from modeler.robot.read import parse_robot_text
from modeler.robot.robot import Robot
from modeler.runtime.model import CompiledModel
from modeler.simulation import SimulationSettings, simulate, write_log


@dataclass(frozen=True, eq=False)
class Chain:
    """A robot, its C, and the same compiled."""

    derivation: api.Derivation
    emitted: EmittedModule
    compiled: CompiledModel
    _logs: dict[str, Log] = field(default_factory=dict)

    def log(self, name: str, **settings: Any) -> Log:
        """A simulated log as a file has it; settings as of `SimulationSettings`."""
        key = f"{name} {settings}"
        if key not in self._logs:
            with tempfile.TemporaryDirectory() as folder:
                place = Path(folder) / f"{name}.parquet"
                made = simulate(self.derivation.robot, SimulationSettings(**settings))
                write_log(place, made)
                self._logs[key] = read_log(place, self.compiled.spec)
        return self._logs[key]

    def fit(self, logs, processing=None, method="weighted"):
        """The model fitted to logs; without a processing, with one that is chosen from them."""
        observation = api.observe(self.compiled, logs, processing)
        return api.fit(self.derivation, self.emitted, observation, method)


def chain_of(robot: str | Path | Robot) -> Chain:
    """Of a built-in robot, a robot file or its text, or a robot."""
    if isinstance(robot, str) and "\n" in robot:
        return _of_text(robot, "robot.toml")
    opened = robot if isinstance(robot, Robot) else api.open_robot(robot)
    return _of_text(opened.text, opened.name)


@lru_cache(maxsize=64)
def _of_text(text: str, name: str) -> Chain:
    derivation = api.derive(parse_robot_text(text, name))
    emitted = api.generate(derivation)
    return Chain(derivation, emitted, api.compile_model(emitted))


def diagnose_case(folder: Path, withheld: Sequence[str] = ()) -> dict[str, Any]:
    """What `modeler diagnose --json` says of a case, and how long it took ("seconds").

    The model is fitted to the training log; it is asked about that log or, if there is one, the
    log with a load. Errors come from the held-out log of the same arm. The truth is not read.

    Args:
        folder: of a case of `tests/hidden_effects`, which names nothing of the package itself.
        withheld: effects that may not be named, nor those that are the same column.
    """
    known = [effect for effect in map(find_effect, withheld) if effect is not None]
    same = [other for effect in known for other in effect.equivalent_effects]
    with _cache_of_its_own():
        model = chain_of(folder / "robot.toml").fit([folder / "train.parquet"])
        asked = [folder / "train.parquet", folder / "holdout.parquet"]
        if (folder / "loaded.parquet").exists():
            asked = [folder / "loaded.parquet", folder / "loaded_holdout.parquet"]
        start = time.perf_counter()
        diagnosis = api.diagnose(model, asked[:1], asked[1:], without=[*withheld, *same])
    return diagnosis.to_json() | {"seconds": time.perf_counter() - start}


@contextmanager
def _cache_of_its_own() -> Iterator[None]:
    """Compiled arms go to a folder that goes away: nobody needs a random arm again."""
    before = os.environ.get("MODELER_CACHE")
    with tempfile.TemporaryDirectory() as folder:
        os.environ["MODELER_CACHE"] = folder
        try:
            yield
        finally:
            del os.environ["MODELER_CACHE"]
            if before is not None:
                os.environ["MODELER_CACHE"] = before
