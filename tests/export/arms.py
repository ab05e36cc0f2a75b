"""A small arm as URDF, MJCF and SDF, written as people write them; what is needed to compare."""

import dataclasses
import re
from pathlib import Path

import numpy as np

from modeler.api import derive, generate
from modeler.estimation import PREFIXES
from modeler.formats import read_robot
from modeler.robot import Robot
from modeler.runtime.model import CompiledModel
from tests.modules import loaded

FILES = Path(__file__).with_name("files")
URDF = (FILES / "arm.urdf").read_bytes()
"""Quotes of both kinds, elements in one line, turned inertia, a tool and a finger on fixed joints,
a slide that moves a link without mass, joints without dynamics."""

MJCF = (FILES / "arm.xml").read_bytes()
"""Defaults, several joints in a body, a body whose geom weighs, a principal frame by angles."""

SDF = (FILES / "arm.sdf").read_bytes()

_NUMBER = re.compile(rb'(?<=["\'> ])-?\d+\.?\d*(?:e-?\d+)?(?=["\'< ])')


def written(folder: Path, name: str, data: bytes) -> Path:
    """The file."""
    place = folder / name
    place.write_bytes(data)
    return place


def without_numbers(data: bytes) -> bytes:
    """The text with every number as one letter."""
    return _NUMBER.sub(b"N", _NUMBER.sub(b"N", data))


def without_comment(data: bytes) -> bytes:
    """The text without the comment that an export puts."""
    return re.sub(rb"<!-- modeler export: .*?-->\r?\n", b"", data, flags=re.DOTALL)


def changed(robot: Robot, rng: np.random.Generator, rows: str = "") -> Robot:
    """Heavier or lighter bodies, that hang elsewhere; other friction."""
    values = dict(robot.parameters)
    for row in [joint.name for joint in robot.moving_joints]:
        names = [f"{prefix}{row}" for prefix in PREFIXES]
        if all(name in values for name in names) and (not rows or row in rows):
            more = rng.uniform(0.1, 0.4) * values[f"M{row}"]
            at = rng.uniform(-0.1, 0.1, 3)
            point = more * (at @ at * np.eye(3) - np.outer(at, at))
            round_ = more * 0.05**2 * np.eye(3)
            add = [*(point + round_)[np.triu_indices(3)], *(more * at), more]
            values |= {n: values[n] + x for n, x in zip(names, map(float, add), strict=True)}
    for name in values:
        if name.startswith(("Fv", "Fs", "Ia")) and values[name]:
            values[name] *= float(rng.uniform(0.5, 1.5))
    return dataclasses.replace(robot, parameters=values)


def torques(robot: Robot, q, qd, qdd, without: tuple[str, ...] = ()) -> np.ndarray:
    """Of our C, with nominal values; parameters that begin with one of `without` left out."""
    bare = dataclasses.replace(robot, parameters={}, text="", name="", frames={}, limits={})
    model = _compiled(repr(bare), bare)
    chi = [
        0.0 if p.name.startswith(without) else robot.parameters.get(p.name, 0.0)
        for p in model.spec.standard
    ]
    return model.inverse_dynamics(q, qd, qdd, model.base_parameters(np.array(chi)))


_MODELS: dict[str, CompiledModel] = {}


def _compiled(key: str, robot: Robot) -> CompiledModel:
    """Robots that differ in values alone share their C."""
    if key not in _MODELS:
        _MODELS[key] = loaded(generate(derive(dataclasses.replace(robot, name="robot"))))
    return _MODELS[key]


def same_physics(one: Robot, other: Robot, share: float = 1e-9) -> bool:
    """Torques of both, nominal values, at random states."""
    rng = np.random.default_rng()
    q, qd, qdd = (rng.uniform(-1.0, 1.0, (50, len(one.coordinates))) for _ in range(3))
    values = [torques(robot, q, qd, qdd) for robot in (one, other)]
    return bool(np.abs(values[0] - values[1]).max() <= share * np.abs(values[0]).max())


def reread(folder: Path, name: str, data: bytes) -> Robot:
    """The robot of an exported file."""
    return read_robot(written(folder, name, data))
