"""Effects that MuJoCo has and the robot file has not: named, on their joint, with their value.

MuJoCo shares nothing with the model, its simulator or its filters.
"""

import dataclasses
from functools import cache

import numpy as np
import pytest

from modeler import api

pytest.importorskip("mujoco", reason="NOT CHECKED: MuJoCo (PyPI: mujoco-core) is not installed")

from tests.chain import chain_of
from tests.diagnose.conftest import written
from tests.diagnose.mujoco_arm import ROWS, G, random_arm, random_body, robot_text, run
from tests.rotation import ROTATING, rotating, with_cases

TRAIN, HOLDOUT = 12.0, 6.0  # s, of moves, and as much of a Fourier series
USUAL = ("rotor_inertia", "viscous", "coulomb", "offset")
WHERE = {  # by effect: seed of the arm, and joint
    "viscous": (1, 2),
    "spring": (1, 1),
    "payload": (1, None),
    "coulomb": (2, 3),
    "rotor_inertia": (2, 3),  # those of joints 1 and 2 are inertias of the links
    "base_tilt": (2, None),
}
TRUE = {
    "viscous": ("Fv", "damping"),
    "coulomb": ("Fs", "frictionloss"),
    "rotor_inertia": ("Ia", "armature"),
    "spring": ("Ks", "stiffness"),
}
"""Prefix of the parameter -> attribute of the arm."""
EVER = ("viscous", "coulomb", "rotor_inertia")  # in every arm; the file leaves one out
STIFFNESS = 4.0  # N m/rad
TILT = np.radians(3.0)


def effects_without(effect=None, joint=None):
    return {name: [j for j in ROWS if (name, j) != (effect, joint)] for name in USUAL}


def altered(effect, joint, seed):
    """The arm with what no usual model has; friction and rotor inertia it has anyway."""
    arm, rng = random_arm(seed), np.random.default_rng([seed, 3])
    if effect == "spring":
        return dataclasses.replace(arm, stiffness=STIFFNESS * (np.array(ROWS) == joint))
    if effect == "base_tilt":
        way = rng.uniform(0, 2 * np.pi)
        down = [np.sin(TILT) * np.cos(way), np.sin(TILT) * np.sin(way), -np.cos(TILT)]
        return dataclasses.replace(arm, gravity=G * np.array(down))
    if effect == "payload":
        load = random_body(rng, rng.uniform(1.2, 2.0), [0.3, -0.05, -0.05], [0.45, 0.05, 0.05])
        return dataclasses.replace(arm, payload=load)
    return arm


@cache
def simulated(effect, joint, seed):
    """Columns of a log to explain and of one held out, of another motion."""
    arm = altered(effect, joint, seed)
    return run(arm, 10 * seed + 1, TRAIN), run(arm, 10 * seed + 2, HOLDOUT)


def diagnosed(folder, seed, effect=None, joint=None):
    """The diagnosis of a model that lacks this effect on this joint."""
    added = effect if effect not in EVER else None
    logs = simulated(added, joint if added else None, seed)
    train, holdout = (written(folder / f"{k}.parquet", log) for k, log in enumerate(logs))
    fitted = train
    if effect == "payload":  # a model of the arm without load, asked about the arm with it
        fitted = written(folder / "unloaded.parquet", simulated(None, None, seed)[0])
    path = folder / "robot.toml"
    text = robot_text(random_arm(seed), effects_without(effect, joint))
    path.write_text(text, encoding="utf-8")
    return api.diagnose(chain_of(path).fit([fitted]), [train], [holdout])


@pytest.mark.rotating("long tests of diagnose")
@with_cases(
    "effect",
    "viscous",
    *rotating("spring", "payload"),
    *(pytest.param(name, marks=ROTATING) for name in [*WHERE][3:]),
)
def test_what_the_file_lacks_is_named_first(tmp_path, effect):
    seed, joint = WHERE[effect]
    first = diagnosed(tmp_path, seed, effect, joint).effects[0]
    assert (first.effect, first.joint) == (effect, None if joint is None else str(joint))
    assert first.error_after < first.error_before
    arm = altered(effect, joint, seed)
    if effect == "payload":
        assert first.parameters["mass"] == pytest.approx(arm.payload.mass, rel=0.15)
    elif effect == "base_tilt":
        change = [first.parameters[name] for name in ("gx", "gy", "gz")]
        true = [*arm.gravity[:2], 0.0]
        np.testing.assert_allclose(change, true, atol=0.1 * G * np.sin(TILT))
    else:
        prefix, values = TRUE[effect]
        true = getattr(arm, values)[joint - 1]
        assert first.parameters[f"{prefix}{joint}"] == pytest.approx(true, rel=0.15)


@pytest.mark.rotating("long tests of diagnose")
def test_nothing_is_named_where_nothing_lacks(tmp_path):
    result = diagnosed(tmp_path, 1)
    assert not result.effects, result.sentences
