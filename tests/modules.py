"""Built-in robots through derivation and emission, each once per test run; C compilers."""

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest

from modeler.core.manifest import EmittedModule
from modeler.derivation.model import SymbolicModel
from modeler.derivation.relations import BaseParameters
from modeler.robot.read import read_robot
from modeler.runtime.model import CompiledModel, load_module
from tests.derived_once import base_of, emitted_of, model_of


class Module(NamedTuple):
    model: SymbolicModel
    base: BaseParameters
    emitted: EmittedModule


@cache
def module(name: str) -> Module:
    model = model_of(read_robot(name))
    base = base_of(model)
    return Module(model, base, emitted_of(model, base))


@cache
def compiled(name: str) -> CompiledModel:
    emitted = module(name).emitted
    return load_module(emitted.spec, emitted.files)


@cache
def plain(name: str) -> CompiledModel:
    """The same compiled in a quarter of the time, for tests of what the C says."""
    return loaded(module(name).emitted)


def loaded(emitted: EmittedModule) -> CompiledModel:
    """A module compiled as `plain` does, but with CFLAGS where they are set."""
    with unoptimised():
        return load_module(emitted.spec, emitted.files)


@contextmanager
def unoptimised(*words: str) -> Iterator[None]:
    """Compile fast: what is tested does not hang on the last digits of an optimiser."""
    before = os.environ.get("CFLAGS")
    os.environ["CFLAGS"] = " ".join([before or "-O0", *words])
    try:
        yield
    finally:
        del os.environ["CFLAGS"]
        if before is not None:
            os.environ["CFLAGS"] = before


def states(joints: int, samples: int, seed: int = 20) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Random q, qd, qdd, (samples, joints)."""
    rng = np.random.default_rng(seed)
    q = rng.uniform(-3, 3, (samples, joints))
    return q, rng.normal(0, 2, q.shape), rng.normal(0, 5, q.shape)


def compiler(name: str) -> str:
    if shutil.which(name) is None:
        pytest.skip(f"NOT CHECKED: {name} is not installed")
    return name


STRICT = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow", "-Wconversion", "-Werror"]
