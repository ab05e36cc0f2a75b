"""Forward dynamics where it is singular, of friction that reads accelerations, and in MuJoCo."""

from pathlib import Path

import numpy as np
import pytest

from modeler.codegen import derive, generate
from modeler.codegen.control import Control
from modeler.core.errors import ModelerError
from modeler.robot.read import parse_robot_text
from tests.bodies import buildable
from tests.control.draw import emitted
from tests.modules import loaded


def drawn_parameters(spec, random) -> dict[str, float]:
    names = [parameter.name for parameter in spec.standard]
    return dict(zip(names, buildable(spec, random), strict=True))


def test_a_massless_last_link():
    """M is singular for its joint alone; rounding must not make a number of it."""
    model, random = loaded(emitted("puma560")[1]), np.random.default_rng(8)
    n, chi = len(model.spec.joints), drawn_parameters(model.spec, random)
    last = model.spec.joints[-1].name
    without = {k for k in chi if k.endswith(last) and k[:2] not in ("Fv", "Fs", "Of")}
    beta = model.base_parameters([0.0 if name in without else v for name, v in chi.items()])
    q, qd, tau = random.normal(size=(3, 20, n))
    cells = {"q": q, "qd": qd, "tau": 5 * tau, "beta": beta}
    assert set(model.evaluate_status("forward_dynamics", **cells)) == {2}
    with pytest.raises(ModelerError, match=r"forward_dynamics.*not positive"):
        model.evaluate("forward_dynamics", **cells)


LOADED = Path(__file__).with_name("loaded.toml").read_text(encoding="utf-8")


def test_friction_that_reads_accelerations():
    """A bounded iteration, which gives what inverse dynamics takes; and its derivatives."""
    emitted = generate(derive(parse_robot_text(LOADED, "loaded")), control=Control())
    model, random = loaded(emitted), np.random.default_rng(9)
    chi = drawn_parameters(model.spec, random) | {"mu2": 0.3, "mu3": 0.2, "Fz1": 0.5}
    assert len(chi) == len(model.spec.standard)
    beta = model.base_parameters([*chi.values()])
    q, qd, tau = random.normal(size=(3, 200, 3))
    cells = {"q": q, "qd": qd, "tau": 10 * tau, "s": random.uniform(-1, 1, (200, 1)), "beta": beta}
    qdd = model.evaluate("forward_dynamics", **cells)
    back = model.inverse_dynamics(q, qd, qdd, beta, s=cells["s"])
    assert np.abs(back - cells["tau"]).max() <= 1e-10 * np.abs(cells["tau"]).max()
    without = beta.copy()
    without[[k for k, base in enumerate(model.spec.base) if base.name.startswith("mu")]] = 0.0
    plain = model.evaluate("forward_dynamics", **(cells | {"beta": without}))
    assert np.abs(qdd - plain).max() > 0.1
    D = model.evaluate("forward_derivatives", **cells)
    for part, name in enumerate(("q", "qd", "tau")):
        step = 1e-6 * np.eye(3)
        for j in range(3):
            ahead, behind = (
                model.evaluate("forward_dynamics", **(cells | {name: cells[name] + s * step[j]}))
                for s in (1, -1)
            )
            apart = np.abs((ahead - behind) / 2e-6 - D[:, part, :, j]).max(axis=1)
            assert np.median(apart) < 1e-6 and (apart > 1e-4).sum() <= 2  # where |load| turns


def test_an_own_effect_of_the_acceleration():
    local = """drag = ["2"]

[own_effects.drag]
title = "drag of a fluid that is carried along"
columns = { Da = "a*abs(a)" }
unit = "1"

[reference]"""
    text = LOADED[: LOADED.index("load_friction")] + local + LOADED.split("[reference]")[1]
    model = loaded(generate(derive(parse_robot_text(text, "drag")), control=Control()))
    random = np.random.default_rng(10)
    chi = drawn_parameters(model.spec, random)
    beta = model.base_parameters([*chi.values()])
    q, qd, tau = random.normal(size=(3, 50, 3))
    qdd = model.evaluate("forward_dynamics", q=q, qd=qd, tau=10 * tau, beta=beta)
    assert np.abs(model.inverse_dynamics(q, qd, qdd, beta) - 10 * tau).max() <= 1e-9


def test_forward_dynamics_in_mujoco():
    from tests.oracles.mujoco_machine import mujoco, mujoco_model
    from tests.oracles.pinocchio_dynamics import PinocchioDynamics

    robot, made = emitted("puma560")
    model, random = loaded(made), np.random.default_rng(14)
    chi = drawn_parameters(model.spec, random)
    q, qd, tau = random.normal(size=(3, 10, len(model.spec.joints)))
    beta = model.base_parameters([*chi.values()])
    qdd = model.evaluate("forward_dynamics", q=q, qd=qd, tau=5 * tau, beta=beta)
    other, friction = mujoco_model(robot, chi, light=0.0), PinocchioDynamics(robot, chi).friction
    data = mujoco.MjData(other)
    for k in range(len(q)):
        data.qpos[:], data.qvel[:] = q[k], qd[k]
        data.qfrc_applied[:] = 5 * tau[k] - friction(qd[k])[0]
        mujoco.mj_forward(other, data)
        assert np.abs(qdd[k] - data.qacc).max() <= 1e-8 * np.abs(qdd[k]).max()
