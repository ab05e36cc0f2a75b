"""Robots, derived and compiled once, with their limits."""

import dataclasses
from functools import cache

import numpy as np

from modeler.api import compile_model, derive, generate
from modeler.api.motion_bounds import build_bounds
from modeler.derivation.assembly_modes import complete_home
from modeler.excitation import ExcitationTask, MotionRequest, build_task
from modeler.robot import Robot, read_robot
from modeler.runtime.model import CompiledModel


@cache
def robot(name: str) -> tuple[Robot, CompiledModel]:
    result = read_robot(name)
    if result.loops:
        result = complete_home(result).robot
    return result, compile_model(generate(derive(result)))


def limits_of(name, limits=(), boxes=()):
    """The robot compiled, and its limits as the command line takes them."""
    result, compiled = robot(name)
    return compiled, build_bounds(result, compiled, limits, boxes)


def plausible(compiled: CompiledModel, seed: int = 0) -> np.ndarray:
    """(c,) some parameters: positive masses and inertias on the diagonal, small products."""
    rng = np.random.default_rng(seed)
    values = []
    for parameter in compiled.spec.standard:
        prefix = parameter.name.removesuffix(parameter.joint)
        size = {"M": 5.0, "MX": 0.3, "MY": 0.3, "MZ": 0.3}.get(prefix, 0.2)
        product = prefix in ("XY", "XZ", "YZ")
        values.append(0.1 * size * rng.normal() if product else size * rng.uniform(0.5, 1.5))
    return compiled.base_parameters(values)


def small_task(name: str, limited: float = np.inf, boxes: tuple[str, ...] = ()) -> ExcitationTask:
    """A search of few harmonics; `limited`: every torque, in N m."""
    compiled, bounds = limits_of(name, boxes=boxes)
    bounds = dataclasses.replace(bounds, torque=np.full(len(bounds.joints), limited))
    beta = plausible(compiled) if np.isfinite(limited) else None
    return build_task(compiled, bounds, MotionRequest(4.0, 3), None, None, beta)
