"""Robots derived once a process: of what derives anew, all but the deriving is tested.

Tests of the derivation call it by itself: they do not come by here.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

from modeler.codegen import emit as emission, workflow
from modeler.codegen.emit import emit
from modeler.core.manifest import EmittedModule
from modeler.derivation import BaseParameters, SymbolicModel, derive_base_parameters, derive_model
from modeler.robot import Robot

_MODELS: dict[str, list[tuple[Robot, SymbolicModel]]] = {}
_BASES: dict[int, BaseParameters] = {}
_EMITTED: dict[int, EmittedModule] = {}
"""By robot text, and by the model, which `_MODELS` keeps."""


def model_of(robot: Robot) -> SymbolicModel:
    known = _MODELS.setdefault(robot.text, [])
    for other, model in known:
        if other == robot:
            return model
    known.append((robot, derive_model(robot)))
    return known[-1][1]


def base_of(model: SymbolicModel, *more: Any, **named: Any) -> BaseParameters:
    if more or named:
        return derive_base_parameters(model, *more, **named)
    if id(model) not in _BASES:
        _BASES[id(model)] = derive_base_parameters(model)
    return _BASES[id(model)]


def emitted_of(model, base, *more, **named):
    plain = (*more, *named.values()) in ((), (None, "double", False, None))
    if not plain or _BASES.get(id(model)) is not base:
        return emit(model, base, *more, **named)
    if id(model) not in _EMITTED:
        _EMITTED[id(model)] = emit(model, base)
    return _EMITTED[id(model)]


@contextmanager
def derived_once() -> Iterator[None]:
    """While it lasts, a robot that was derived before is not, nor is its plain C emitted again."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(workflow, "derive_model", model_of)
        patched.setattr(workflow, "derive_base_parameters", base_of)
        patched.setattr(emission, "emit", emitted_of)
        yield
