"""A fitted model as a file: its torques, what it cannot hold, a machine that could be built."""

import dataclasses

import numpy as np
import pytest

from modeler import estimation
from modeler.api import compile, export, identify, load, simulate
from modeler.formats import read_robot
from modeler.formats.bodies import Original, build_export_parameters
from modeler.formats.completion import Prior, compute_completion, find_nearest_physical
from modeler.robot import parse_robot_text
from tests.export.arms import URDF, changed, written
from tests.export.test_fresh_files import close, mujoco_torques, pinocchio_torques

pytest.importorskip("pinocchio", reason="NOT CHECKED: no Pinocchio")
pytest.importorskip("mujoco", reason="NOT CHECKED: no MuJoCo")


@pytest.fixture(scope="module")
def fitted(tmp_path_factory):
    """The arm that the file describes, and another of which a model was fitted."""
    folder = tmp_path_factory.mktemp("arm")
    place = written(folder, "arm.urdf", URDF)
    truth = changed(read_robot(place), np.random.default_rng())
    seed = int(np.random.default_rng().integers(1000))
    log = simulate(truth, duration=6.0, rate=250.0, seed=seed)
    return place, truth, identify(read_robot(place), log)


def torques_without(model, q, qd, qdd, left_out, values=None) -> np.ndarray:
    """Of a fit, without what some parameters add: those that stand for themselves, and values."""
    beta = model.beta.copy()
    for i, base in enumerate(model.spec.base):
        beta[i] -= sum(t.value * (values or {}).get(t.parameter, 0.0) for t in base.terms)
    for i, base in enumerate(model.spec.base):
        if base.name.startswith(left_out):
            assert len(base.terms) == 1
            beta[i] = 0.0
    return compile(model).inverse_dynamics(q, qd, qdd, beta)


def test_the_exported_file_has_the_torques_of_the_fit(fitted) -> None:
    place, _, model = fitted
    files = export(model, like=place)
    assert files.shift_in_sigmas == 0.0
    rng = np.random.default_rng()
    q, qd, qdd = (rng.uniform(-1.0, 1.0, (50, 3)) for _ in range(3))
    joints = ["shoulder", "elbow", "slide"]
    lost = {name: x for lost in files.lost_effects for name, x in lost.values.items()}
    assert set(lost) == {f"{prefix}{j}" for prefix in ("Ia", "Off") for j in "123"}
    rotors = {name: x for name, x in lost.items() if name.startswith("Ia")}
    ours = torques_without(model, q, qd, qdd, ("Fv", "Fs", "Off"), rotors)
    exact = files.data.replace(b'"1.5708 ', b'"1.5707963267948966 ')  # as it is read
    assert close(pinocchio_torques(exact, joints, q, qd, qdd), ours)
    assert not close(pinocchio_torques(URDF, joints, q, qd, qdd), ours, 0.05)
    whole = torques_without(model, q, qd, qdd, ("Fs", "Off"))
    standing = export(model, to="mjcf")
    fresh = standing.data
    assert all(f'name="{value.part}"'.encode() in fresh for value in standing.values)
    assert close(mujoco_torques(fresh, [f"{j}" for j in joints], q, qd, qdd), whole)


def test_values_have_the_sigmas_of_the_fit(fitted) -> None:
    place, _, model = fitted
    values = {(v.part, v.quantity): v for v in export(model, like=place).values}
    friction = values["shoulder", "friction"]
    assert friction.before == 0.7 and friction.after == pytest.approx(model["Fs1"].value)
    assert friction.sigma == pytest.approx(model["Fs1"].sigma)
    physics = build_export_parameters(model, Original())
    beta = physics.machine.K @ physics.completion.chi
    assert np.allclose(beta, model.beta, rtol=1e-12, atol=1e-13)
    C = physics.machine.K @ physics.completion.covariance @ physics.machine.K.T
    assert np.allclose(C, model.covariance, rtol=1e-6, atol=1e-9 * np.abs(model.covariance).max())
    # A sigma by random draws of the ten parameters.
    places = physics.find_link_indices("1")
    rng = np.random.default_rng()
    tens = rng.multivariate_normal(
        physics.completion.chi[places],
        1e-4 * physics.completion.covariance[np.ix_(places, places)],
        4000,
    )
    centre = tens[:, 6] / tens[:, 9]
    fresh = {(v.part, v.quantity): v for v in export(model, to="urdf").values}
    assert fresh["link_1", "centre x"].sigma == pytest.approx(1e2 * centre.std(), rel=0.1)


def test_the_comment_and_the_tables_tell_it(fitted, tmp_path) -> None:
    place, _, model = fitted
    files = export(model, tmp_path / "better.urdf", like=place)
    text = (tmp_path / "better.urdf").read_bytes()
    comment = text[text.index(b"<!-- modeler export") : text.index(b"-->")].decode()
    assert "--" not in comment.removeprefix("<!--") and "+-" in comment
    assert "shoulder friction:" in comment and "was 0.7" in comment
    assert "numbers changed" in files.summary()
    table = files.to_frame()
    assert list(table.columns[:2]) == ["part", "quantity"]
    assert files.to_dict()["values"][0]["is_changed"] in (True, False)


@pytest.mark.rotating("long tests of export")
def test_what_a_format_cannot_hold_is_told_with_its_share(tmp_path) -> None:
    robot = load("demo-arm")
    log = simulate(robot, duration=4.0, rate=200.0, seed=3)
    model = identify(robot, log)
    exact = {(x.effect, x.joint): x for x in export(model, to="urdf").lost_effects}
    assert {effect for effect, _ in exact} == {"rotor_inertia", "offset"}
    rows = model._fit_observation
    part = np.zeros_like(model.beta)
    names = [base.name for base in model.spec.base]
    part[names.index("Ia3")] = exact["rotor_inertia", "3"].values["Ia3"]
    share = np.linalg.norm(np.where(rows.used, rows.predict(part), 0.0)[:, 2])
    share /= np.linalg.norm(np.where(rows.used, rows.predict(model.beta), 0.0)[:, 2])
    assert exact["rotor_inertia", "3"].share == pytest.approx(share)
    assert exact["rotor_inertia", "3"].share_of == "the torque of joint 3"
    about = export(dataclasses.replace(model, in_memory_logs=()), to="urdf").lost_effects
    (offset,) = (x for x in about if (x.effect, x.joint) == ("offset", "1"))
    assert offset.share_of == "all torques" and 0.0 < offset.share < 1.0
    fresh = export(model, to="mjcf")
    assert {x.effect for x in fresh.lost_effects} == {"offset"}
    assert "offset of joint" in fresh.summary()


def a_link(rng) -> np.ndarray:
    points = np.c_[rng.normal(scale=0.1, size=(9, 3)), np.ones(9)]
    masses = rng.uniform(0.1, 0.4, 9)
    return estimation.extract_parameters(np.einsum("ki,k,kj->ij", points, masses, points))


def test_the_nearest_machine_is_the_nearest() -> None:
    """Against 2000 possible ones, in the metric of the completion."""
    rng = np.random.default_rng()
    ten = a_link(rng)
    K = np.zeros((4, 10))
    K[range(4), [0, 5, 6, 9]] = 1.0
    machine = estimation.PhysicalParameters(tuple("abcdefghij"), K, {"1": np.arange(10)}, {})
    S = np.diag((0.3 * np.maximum(np.abs(ten), 0.01)) ** 2)
    beta = K @ ten
    beta[1] = -0.2 * beta[1]  # ZZ below 0
    C = np.diag((0.05 * np.abs(K @ ten)) ** 2)
    result = compute_completion(K, Prior(ten, S), beta, C)
    assert np.allclose(K @ result.chi, beta, rtol=1e-12)
    size = {"1": np.linalg.inv(np.linalg.cholesky(estimation.compute_pseudo_inertia(ten)))}
    best = find_nearest_physical(machine, result, beta, C, size, {})
    assert best is not None and best.shift_in_sigmas > 1.0
    assert np.linalg.eigvalsh(estimation.compute_pseudo_inertia(best.chi))[0] > 0.0
    L = np.linalg.cholesky(result.covariance)

    def far(chi) -> float:
        return float(np.linalg.norm(np.linalg.solve(L, chi - result.chi)))

    least = far(best.chi)
    for t in np.repeat(np.geomspace(1e-3, 1.0, 20), 100):
        chi = best.chi + t * L @ rng.normal(size=10)
        if np.linalg.eigvalsh(estimation.compute_pseudo_inertia(chi))[0] > 1e-9:
            assert far(chi) > least * (1.0 - 1e-4)


def test_a_fit_that_could_not_be_built_becomes_one_that_could(fitted) -> None:
    place, _, model = fitted
    values = list(model.fit.parameters)
    at = next(i for i, p in enumerate(values) if p.name == "Fs2")
    values[at] = dataclasses.replace(values[at], value=-3.0 * values[at].sigma)
    fit = dataclasses.replace(model.fit, parameters=tuple(values))
    broken = dataclasses.replace(model, fit=fit)
    files = export(broken, like=place)
    assert files.shift_in_sigmas == pytest.approx(3.0, rel=0.2) and "moved by 3" in files.summary()
    elbow = [v for v in files.values if (v.part, v.quantity) == ("elbow", "friction")]
    assert elbow[0].after >= 0.0


@pytest.mark.rotating("long tests of export")
def test_what_hangs_on_a_link_changes_only_where_it_must(tmp_path) -> None:
    """The finger weighs 0.2 kg, and the fit says that slider and finger come to less."""
    box = b'<mass value="0.1"/><inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/>'
    arm = URDF.replace(
        b'<link name="slider"/>', b'<link name="slider"><inertial>' + box + b"</inertial></link>"
    )
    place = written(tmp_path, "arm.urdf", arm)
    robot = read_robot(place)
    masses = {}
    for share in (1.2, 0.5):
        light = {f"{p}3": share * robot.parameters[f"{p}3"] for p in estimation.PREFIXES}
        truth = dataclasses.replace(robot, parameters=robot.parameters | light)
        model = identify(robot, simulate(truth, duration=6.0, rate=200.0, seed=5))
        files = export(model, like=place)
        again = read_robot(written(tmp_path, "again.urdf", files.data))
        assert again.parameters["M3"] == pytest.approx(0.3 * share, rel=0.05)
        masses[share] = {v.part: v.after for v in files.values if v.quantity == "mass"}
        assert any("changed with it: finger" in note for note in files.notes) == (share < 1.0)
    assert masses[1.2]["slider"] == pytest.approx(0.16, rel=0.1) and "finger" not in masses[1.2]
    assert 0.0 < masses[0.5]["slider"] < 0.1 and 0.0 < masses[0.5]["finger"] < 0.2


@pytest.mark.rotating("long tests of export")
def test_links_without_values_get_capsules_and_it_is_told() -> None:
    robot = load("scara")
    bare = parse_robot_text(robot.text, "scara.toml")
    model = identify(bare, simulate(robot, duration=4.0, rate=200.0, seed=2))
    files = export(model, to="mjcf")
    assert any("that of a capsule" in note for note in files.notes)
    rng = np.random.default_rng()
    q, qd, qdd = (rng.uniform(-0.5, 0.5, (50, 4)) for _ in range(3))
    offsets = [p.name for p in model.spec.standard if p.kind == "offset"]
    left = tuple({name.rstrip("0123456789") for name in offsets} | {"Fs"})
    names = [f"joint_{joint.name}" for joint in robot.moving_joints]
    ours = torques_without(model, q, qd, qdd, left)
    assert close(mujoco_torques(files.data, names, q, qd, qdd), ours)
