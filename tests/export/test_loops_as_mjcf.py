"""Robots with loops in MuJoCo: its inverse dynamics on the constraint are the torques of the C."""

import re

import numpy as np
import pytest

from modeler.api import derive, export, generate, load
from modeler.robot import Robot, parse_robot_text
from tests.codegen.fitted_library import robot_text
from tests.modules import loaded
from tests.rotation import ROTATING, with_cases

mujoco = pytest.importorskip("mujoco", reason="NOT CHECKED: no MuJoCo")

STEP = 2e-3
EIGHTH = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
"""Central differences of the eighth order."""

PARTIAL = robot_text("half-said")
"""A four-bar linkage of which some values are stated."""


def stated(robot: Robot) -> Robot:
    """Without dry friction and offsets, which are no forces of MuJoCo's inverse dynamics."""
    dry = r'"?(Fs|Off)\w*(\{i\})?"? *='
    lines = [line for line in robot.text.splitlines() if not re.match(dry, line)]
    return parse_robot_text("\n".join(lines), robot.name)


def apart(robot: Robot, seed: int, count: int = 6) -> float:
    """Largest difference of the torques at random closed motion, over the largest torque."""
    compiled = loaded(generate(derive(robot)))
    spec, rng = compiled.spec, np.random.default_rng(seed)
    model = mujoco.MjModel.from_xml_string(export(robot, to="mjcf").data.decode())
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
    data = mujoco.MjData(model)
    names = [f"joint_{j.name}" for j in robot.free_joints]
    at = [model.joint(name).dofadr[0] for name in names]
    assert len(at) + len(robot.relations) == model.nv
    inputs = list(spec.closure.actuated)
    home = np.array(spec.closure.home)[inputs]
    chi = np.array([p.nominal or 0.0 for p in spec.standard])
    beta, values, right = compiled.base_parameters(chi), [], []
    while len(values) < count:
        q = home + rng.uniform(-0.08, 0.08, len(home))
        qd, qdd = rng.uniform(-1.0, 1.0, (2, len(home)))
        path = q + np.outer(STEP * np.arange(-4, 5), qd)
        if np.any(compiled.closing_status(path)):
            continue
        u, G = compiled.evaluate("close", q=path), compiled.evaluate("coupling", q=path)
        rate = sum(w * (G[4 + k] - G[4 - k]) for k, w in EIGHTH.items()) / STEP
        full = follow(robot, model, at, G[4])
        data.qpos[at], data.qvel[at] = u[4], G[4] @ qd
        data.qacc[at] = G[4] @ qdd + rate @ qd
        set_followers(robot, model, data)
        mujoco.mj_inverse(model, data)
        values.append(full.T @ data.qfrc_inverse)
        right.append(compiled.inverse_dynamics(q[None], qd[None], qdd[None], beta)[0])
    return float(np.abs(np.array(values) - right).max() / np.abs(right).max())


def follow(robot: Robot, model, at: list[int], G: np.ndarray) -> np.ndarray:
    """(nv, n) speeds of all joints per speed of the coordinates."""
    full = np.zeros((model.nv, G.shape[1]))
    full[at] = G
    for name, slopes, _ in lines_of(robot):
        actual = model.joint(f"joint_{name}").dofadr[0]
        full[actual] = sum(c * full[model.joint(f"joint_{k}").dofadr[0]] for k, c in slopes.items())
    return full


def set_followers(robot: Robot, model, data) -> None:
    for name, slopes, constant in lines_of(robot):
        items, others = (
            model.joint(f"joint_{name}").dofadr[0],
            [(model.joint(f"joint_{k}").dofadr[0], c) for k, c in slopes.items()],
        )
        for array, offset in ((data.qpos, constant), (data.qvel, 0.0), (data.qacc, 0.0)):
            array[items] = offset + sum(c * array[k] for k, c in others)


def lines_of(robot: Robot):
    """(follower, {leader: slope}, constant) of the relations, leaders first."""
    known = robot.evaluate_symbols() | {j.variable: 0.0 for j in robot.moving_joints}
    for name, cell in robot.relations.items():
        constant = cell.evaluate(known)
        slopes = {
            v.removeprefix("q"): cell.evaluate(known | {v: 1.0}) - constant
            for v in cell.names
            if v in {j.variable for j in robot.moving_joints}
        }
        yield name, slopes, constant


@with_cases(
    "name, tolerance",
    ("five-bar", 1e-11),
    *(
        pytest.param(name, 1e-9, marks=ROTATING)
        for name in ("orthoglide-2003", "stewart", "delta", "3rrr", "evra")
    ),
)
def test_torques_in_mujoco_are_those_of_the_c(name: str, tolerance: float) -> None:
    assert apart(stated(load(name)), 3) < tolerance


@pytest.mark.rotating("long tests of export")
@pytest.mark.parametrize("seed", [8, pytest.param(9, marks=pytest.mark.rotating)])
def test_bodies_that_are_half_stated_have_the_torques_of_the_c(seed: int) -> None:
    """Random values for some parameters; what is not stated is 0 in the C, and has its effect."""
    rng = np.random.default_rng(seed)
    values = {"M1": 2.0, "MX1": 0.3, "ZZ1": 0.1, "M2": 3.0, "MY2": 0.4, "M3": 1.0}
    lines = [f"{name} = {x * rng.uniform(0.7, 1.3)!r}" for name, x in values.items()]
    robot = parse_robot_text(PARTIAL + "\n".join(lines), "half")
    files = export(robot, to="mjcf")
    texts = [note for note in files.notes if "C" in note]
    assert texts, files.notes
    differ = re.search(r"torques differ by ([\d.]+) %", " ".join(files.notes))
    error = apart(robot, 4)
    assert error < 1e-9 if differ is None else error > 1e-4
