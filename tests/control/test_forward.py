"""Forward dynamics against Pinocchio's articulated bodies, and there and back again."""

import subprocess

import numpy as np
import pytest

from modeler.codegen import derive, generate
from modeler.codegen.control import Control
from modeler.core.errors import ModelerError
from modeler.core.manifest import FittedParameter, FittedSpec
from modeler.robot.read import robot_from_text
from tests.control.robots import (
    SERIAL,
    TREE,
    controlled,
    frictions,
    in_pinocchio,
    physical,
    robot_of,
)
from tests.elementary_motions import frames
from tests.modules import STRICT, compiler, loaded

FEW = ("puma560", "tree-1")
OTHERWISE = ("tree-1", "tree-3")
"""Rows in an order that Pinocchio's inertia matrix and derivatives do not allow."""


def few_first(names):
    return [n if n in FEW else pytest.param(n, marks=pytest.mark.slow) for n in names]


def drawn(name, samples=20, seed=3):
    model, random = controlled(name), np.random.default_rng(seed)
    chi = physical(model.spec, random)
    q, qd, tau = random.normal(size=(3, samples, len(model.spec.joints)))
    return model, chi, model.base_parameters([*chi.values()]), q, qd, 5 * tau


@pytest.mark.parametrize("name", few_first([*SERIAL, *TREE]))
def test_forward_dynamics(name):
    pin = pytest.importorskip("pinocchio")
    model, chi, beta, q, qd, tau = drawn(name)
    qdd = model.evaluate("forward_dynamics", q=q, qd=qd, tau=tau, beta=beta)
    back = model.inverse_dynamics(q, qd, qdd, beta)
    assert np.abs(back - tau).max() <= 1e-10 * np.abs(tau).max()
    other, rows = in_pinocchio(robot_of(name), chi)
    data, effort = other.createData(), tau - frictions(model.spec, chi, qd)
    for k in range(len(q)):
        x, v, f = np.zeros((3, other.nv))
        x[rows], v[rows], f[rows] = q[k], qd[k], effort[k]
        theirs = pin.aba(other, data, x, v, f)[rows]
        assert np.abs(qdd[k] - theirs).max() <= 1e-9 * np.abs(theirs).max()


def differences(model, *state, h=1e-6):
    """Those of Pinocchio's forward dynamics, whose derivatives want another order of rows."""
    pin = pytest.importorskip("pinocchio")
    data, found = model.createData(), np.zeros((3, model.nv, model.nv))
    for part in range(3):
        for j in range(model.nv):
            step = np.zeros((3, model.nv))
            step[part, j] = h
            ahead, behind = (pin.aba(model, data, *(state + s * step)) + 0.0 for s in (1, -1))
            found[part][:, j] = (ahead - behind) / (2 * h)
    return found


@pytest.mark.parametrize("name", few_first([*SERIAL, *TREE]))
def test_forward_derivatives(name):
    pin = pytest.importorskip("pinocchio")
    model, chi, beta, q, qd, tau = drawn(name, samples=6, seed=11)
    D = model.evaluate("forward_derivatives", q=q, qd=qd, tau=tau, beta=beta)
    other, rows = in_pinocchio(robot_of(name), chi)
    data, effort = other.createData(), tau - frictions(model.spec, chi, qd)
    viscous = np.diag([chi.get(f"Fv{joint.name}", 0.0) for joint in model.spec.joints])
    pick = np.ix_(rows, rows)
    for k in range(len(q)):
        x, v, f = np.zeros((3, other.nv))
        x[rows], v[rows], f[rows] = q[k], qd[k], effort[k]
        found = pin.computeABADerivatives(other, data, x, v, f)
        exact = name not in OTHERWISE
        by_q, by_qd, by_tau = (
            each[pick] for each in (found if exact else differences(other, x, v, f))
        )
        theirs = np.array([by_q, by_qd - by_tau @ viscous, by_tau])
        for ours, its in zip(D[k], theirs, strict=True):
            assert np.abs(ours - its).max() <= (1e-9 if exact else 1e-6) * np.abs(its).max()


@pytest.mark.parametrize("name", few_first([*SERIAL, *TREE]))
@pytest.mark.parametrize("damping", [0.0, 0.1])
def test_operational_space(name, damping):
    """L and Jbar by dense algebra on Pinocchio's matrices."""
    pin = pytest.importorskip("pinocchio")
    model, chi, beta, q, _, _ = drawn(name, samples=6, seed=12)
    robot = robot_of(name)
    other, rows = in_pinocchio(robot, chi)
    carried = frames(robot, np.zeros(len(rows)))  # the last row may be fixed on the last joint
    on = np.linalg.inv(carried[robot.moving[-1].name]) @ carried[robot.joints[-1].name]
    end = other.addFrame(pin.Frame("end", rows[-1] + 1, 0, pin.SE3(on), pin.OP_FRAME))
    data = other.createData()
    roles = ("operational_inertia", "operational_inverse")
    given = {"q": q, "beta": beta, "damping": [damping]}
    statuses = [model.statuses(role, **given) for role in roles]
    results = [model._called(role, given)[0] for role in roles]
    for k in range(len(q)):
        x = np.zeros(other.nv)
        x[rows] = q[k]
        M = pin.crba(other, data, x)
        M = (np.triu(M) + np.triu(M, 1).T)[np.ix_(rows, rows)]
        J = pin.computeFrameJacobian(other, data, x, end, pin.LOCAL_WORLD_ALIGNED)[:, rows]
        S = J @ np.linalg.solve(M, J.T) + damping**2 * np.eye(6)
        full = damping > 0 or np.linalg.matrix_rank(J) == 6
        assert [status[k] for status in statuses] == ([0, 0] if full else [2, 2])
        if not full:
            assert all(np.isnan(result[k]).all() for result in results)
            continue
        L = np.linalg.inv(S)
        slack = 1e-9 + 1e-14 * np.linalg.cond(S)
        assert np.abs(results[0][k] - L).max() <= slack * np.abs(L).max()
        Jbar = np.linalg.solve(M, J.T) @ L
        assert np.abs(results[1][k] - Jbar).max() <= slack * np.abs(Jbar).max()
        if damping == 0.0:
            assert np.abs(J @ results[1][k] - np.eye(6)).max() <= 1e-8


def test_bad_input_is_a_status_never_a_number():
    model, _, beta, q, qd, tau = drawn("puma560", samples=1)
    state = {"q": q, "qd": qd, "tau": tau, "beta": beta}
    place = {"q": q, "beta": beta, "damping": [0.0]}
    roles = {"forward_dynamics": state, "forward_derivatives": state,
             "operational_inertia": place, "operational_inverse": place}  # fmt: skip
    for role, given in roles.items():
        assert model.statuses(role, **given)[0] == 0
        for name, array in given.items():
            for bad in (np.nan, np.inf, -np.inf):
                for k in range(np.size(array)):
                    spoilt = np.array(array, dtype=float)
                    spoilt.flat[k] = bad
                    out, status, _ = model._called(role, given | {name: spoilt})
                    assert status[0] == 3 and np.isnan(out).all(), (role, name, k)
        massless = np.zeros(len(beta))
        out, status, _ = model._called(role, given | {"beta": massless})
        assert status[0] == 2 and np.isnan(out).all()
    with pytest.raises(ModelerError) as caught:
        model.evaluate("forward_dynamics", **(state | {"beta": massless}))
    assert "forward_dynamics" in str(caught.value) and "not positive" in str(caught.value)


def test_a_massless_last_link():
    """M is singular for its joint alone; rounding must not make a number of it."""
    model, chi, _, q, qd, tau = drawn("panda", seed=8)
    last = model.spec.joints[-1].name
    without = {k: v for k, v in chi.items() if k.endswith(last) and k[:2] not in ("Fv", "Fs", "Of")}
    beta = model.base_parameters([0.0 if name in without else v for name, v in chi.items()])
    assert set(model.statuses("forward_dynamics", q=q, qd=qd, tau=tau, beta=beta)) == {2}


LOADED = """\
name = "loaded"
gravity = [0, 0, -9.81]

[mdh]
columns = ["j", "alpha", "d", "theta", "r"]
rows = [["1", 0, 0, "q1", 0.3], ["2", "pi/2", 0.2, "q2", 0], ["3", 0, 0.5, "q3", 0.1]]

[effects]
viscous = "all"
coulomb = "all"
rotor_inertia = "all"
load_friction = [{joint = "2", w = 1}, {joint = "3", w = 0.5}]
presliding = [{joint = "1", d = 0.01}]

[reference]
M2 = 4
MX2 = 1.2
ZZ2 = 0.6
M3 = 2
MX3 = 0.5
ZZ3 = 0.2
"""


def test_friction_that_reads_accelerations():
    """A bounded iteration, which gives what inverse dynamics takes; and its derivatives."""
    emitted = generate(derive(robot_from_text(LOADED, "loaded")), control=Control())
    model, random = loaded(emitted), np.random.default_rng(9)
    chi = physical(model.spec, random) | {"mu2": 0.3, "mu3": 0.2, "Fz1": 0.5}
    assert {"mu2", "mu3", "Fz1"} <= {parameter.name for parameter in model.spec.standard}
    beta = model.base_parameters([chi[p.name] for p in model.spec.standard])
    q, qd, tau = random.normal(size=(3, 200, 3))
    given = {"q": q, "qd": qd, "tau": 10 * tau, "s": random.uniform(-1, 1, (200, 1)), "beta": beta}
    qdd = model.evaluate("forward_dynamics", **given)
    back = model.inverse_dynamics(q, qd, qdd, beta, s=given["s"])
    assert np.abs(back - given["tau"]).max() <= 1e-10 * np.abs(given["tau"]).max()
    without = beta.copy()
    without[[k for k, base in enumerate(model.spec.base) if base.name.startswith("mu")]] = 0.0
    plain = model.evaluate("forward_dynamics", **(given | {"beta": without}))
    assert np.abs(qdd - plain).max() > 0.1
    D = model.evaluate("forward_derivatives", **given)
    for part, name in enumerate(("q", "qd", "tau")):
        step = 1e-6 * np.eye(3)
        for j in range(3):
            ahead, behind = (
                model.evaluate("forward_dynamics", **(given | {name: given[name] + s * step[j]}))
                for s in (1, -1)
            )
            apart = np.abs((ahead - behind) / 2e-6 - D[:, part, :, j]).max(axis=1)
            assert np.median(apart) < 1e-6 and (apart > 1e-4).sum() <= 2  # where |load| turns


def test_an_own_effect_of_the_acceleration():
    own = """drag = ["2"]

[own_effects.drag]
title = "drag of a fluid that is carried along"
columns = { Da = "a*abs(a)" }
unit = "1"

[reference]"""
    text = LOADED[: LOADED.index("load_friction")] + own + LOADED.split("[reference]")[1]
    model = loaded(generate(derive(robot_from_text(text, "drag")), control=Control()))
    random = np.random.default_rng(10)
    chi = physical(model.spec, random) | {"Da2": 0.3}
    beta = model.base_parameters([chi[p.name] for p in model.spec.standard])
    q, qd, tau = random.normal(size=(3, 50, 3))
    qdd = model.evaluate("forward_dynamics", q=q, qd=qd, tau=10 * tau, beta=beta)
    assert np.abs(model.inverse_dynamics(q, qd, qdd, beta) - 10 * tau).max() <= 1e-9


@pytest.mark.parametrize("name", few_first(["puma560", "panda", "tree-2"]))
def test_single_precision_and_fitted_values(name):
    model, _, beta, q, qd, tau = drawn(name, samples=5, seed=13)
    single = controlled(name, "single")
    fitted = fitted_twin(name, tuple(map(float, beta)))
    for role in ("forward_dynamics", "forward_derivatives"):
        double = model.evaluate(role, q=q, qd=qd, tau=tau, beta=beta)
        scale = np.abs(double).max()
        rough = single.evaluate(role, q=q, qd=qd, tau=tau, beta=beta)
        assert np.abs(rough - double).max() <= 2e-3 * scale
        own = fitted.evaluate(f"fitted_{role}", q=q, qd=qd, tau=tau)
        assert np.abs(own - double).max() <= 1e-9 * scale
    for role in ("operational_inertia", "operational_inverse"):
        double = model.evaluate(role, q=q, beta=beta, damping=[0.1])
        rough = single.evaluate(role, q=q, beta=beta, damping=[0.1])
        assert np.abs(rough - double).max() <= 2e-3 * np.abs(double).max()
        own = fitted.evaluate(f"fitted_{role}", q=q, damping=[0.1])
        assert np.abs(own - double).max() <= 1e-9 * np.abs(double).max()
    assert (
        single.statuses("forward_dynamics", q=q, qd=qd, tau=tau, beta=0 * beta).tolist() == [2] * 5
    )


def fitted_twin(name, values):
    derivation = derive(robot_of(name))
    parameters = tuple(
        FittedParameter(p.name, "SI", value, 0.1)
        for p, value in zip(derivation.base.parameters, values, strict=True)
    )
    fitted = FittedSpec("ols", True, "good", (), (), parameters)
    return loaded(generate(derivation, fitted=fitted, control=Control()))


PROGRAM = """
#include "{prefix}_control.h"
int main(void)
{{
    const {real} q[{n}] = {{ {q} }}, beta[{c}] = {{ {beta} }}, damping[1] = {{ 0.1{f} }};
    {real} qdd[{n}], D[3 * {n} * {n}], L[36], inverse[6 * {n}];
    int status = {prefix}_forward_dynamics(q, q, q, beta, qdd);
    status = modeler_first(status, {prefix}_forward_derivatives(q, q, q, beta, D));
    status = modeler_first(status, {prefix}_operational_inertia(q, beta, damping, L));
    return modeler_first(status, {prefix}_operational_inverse(q, beta, damping, inverse));
}}
"""


@pytest.mark.parametrize(
    ("precision", "cc", "flags"),
    [
        ("double", "gcc", ["-Wundef", "-fsanitize=address,undefined"]),
        pytest.param("double", "clang", ["-Wundef", "-O1"], marks=pytest.mark.slow),
        pytest.param("single", "gcc", ["-Wundef", "-Wdouble-promotion"], marks=pytest.mark.slow),
        pytest.param("single", "clang", ["-Wdouble-promotion"], marks=pytest.mark.slow),
    ],
)
def test_strict_compilers_and_sanitizers(tmp_path, precision, cc, flags):
    model = controlled("two-link")
    beta = model.base_parameters([*physical(model.spec, np.random.default_rng(2)).values()])
    generate(derive(robot_of("two-link")), tmp_path, precision=precision, control=Control())
    single, n = precision == "single", len(model.spec.joints)
    f = "f" if single else ""
    text = PROGRAM.format(
        prefix="two_link", real="float" if single else "double", f=f, n=n, c=len(beta),
        q=", ".join([f"0.5{f}"] * n), beta=", ".join(f"{x!r}{f}" for x in map(float, beta)),
    )  # fmt: skip
    sources = sorted(str(path) for path in tmp_path.glob("*.c") if "tile" not in path.name)
    for language in (["-x", "c"], ["-x", "c++", "-std=c++17"]):
        (tmp_path / "main").write_text(text)
        own = [cc, *STRICT[1:], *flags, f"-I{tmp_path}", *language, "-c", "main", "-o", "main.o"]
        subprocess.run(own, cwd=tmp_path, check=True)
        library = [compiler(cc), *STRICT, *flags, "-o", "run", "main.o", *sources, "-lm"]
        subprocess.run(library, cwd=tmp_path, check=True)
        assert subprocess.run([tmp_path / "run"], check=False).returncode == 0


@pytest.mark.parametrize("name", ["puma560", pytest.param("tree-2", marks=pytest.mark.slow)])
def test_forward_dynamics_in_mujoco(name):
    mujoco = pytest.importorskip("mujoco")
    model, chi, beta, q, qd, tau = drawn(name, samples=10, seed=14)
    qdd = model.evaluate("forward_dynamics", q=q, qd=qd, tau=tau, beta=beta)
    other, rows = in_pinocchio(robot_of(name), chi)
    assert rows == list(range(len(rows)))
    spec = mujoco.MjSpec()
    spec.option.gravity = other.gravity.linear
    spec.option.disableflags = mujoco.mjtDisableBit.mjDSBL_CONTACT
    bodies = [spec.worldbody]
    for index in range(1, other.njoints):
        placement, inertia = other.jointPlacements[index], other.inertias[index]
        quaternion = np.zeros(4)
        mujoco.mju_mat2Quat(quaternion, placement.rotation.ravel())
        body = bodies[other.parents[index]].add_body(pos=placement.translation, quat=quaternion)
        body.mass, body.ipos, I = inertia.mass, inertia.lever, inertia.inertia
        body.fullinertia = [I[0, 0], I[1, 1], I[2, 2], I[0, 1], I[0, 2], I[1, 2]]
        body.explicitinertial = True
        kind = "HINGE" if model.spec.joints[index - 1].kind == "revolute" else "SLIDE"
        body.add_joint(
            type=getattr(mujoco.mjtJoint, f"mjJNT_{kind}"), axis=[0, 0, 1],
            armature=other.armature[index - 1],
        )  # fmt: skip
        bodies.append(body)
    made = spec.compile()
    data = mujoco.MjData(made)
    for k, effort in enumerate(tau - frictions(model.spec, chi, qd)):
        data.qpos[:], data.qvel[:], data.qfrc_applied[:] = q[k], qd[k], effort
        mujoco.mj_forward(made, data)
        assert np.abs(qdd[k] - data.qacc).max() <= 1e-8 * np.abs(qdd[k]).max()
