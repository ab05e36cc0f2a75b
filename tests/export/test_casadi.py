"""CasADi's functions are those of the C, and their derivatives those of the motion."""

import casadi
import numpy as np
import pytest

from modeler.api import compile_model, derive, export, generate, identify, load, simulate
from modeler.codegen import Control, generate as generate_with
from modeler.core.errors import ModelerError
from modeler.robot import robot_from_text

TREES = ("two-link", "puma560", "ur10e", "sr400-tree", "so101")


def functions_of(data: bytes, tmp_path) -> dict[str, casadi.Function]:
    """As a user opens the file."""
    place = tmp_path / "robot.casadi"
    place.write_bytes(data)
    return {f.name(): f for f in casadi.FileDeserializer(str(place)).unpack()}


def called(function, values) -> np.ndarray:
    """Its outputs, one below the other, by the names of its inputs."""
    found = function.call([casadi.DM(values[name]) for name in function.name_in()])
    return np.vstack([np.array(x) for x in found])


def state_of(spec, rng) -> dict[str, np.ndarray]:
    n, c = len(spec.joints), len(spec.base)
    sizes = {"q": n, "qd": n, "qdd": n, "v": n, "a": n, "tau": n, "beta": c}
    sizes |= {"chi": len(spec.standard), "s": len(spec.signals), "dq": n, "dt": 1}
    return {name: rng.uniform(-1.5, 1.5, size) for name, size in sizes.items()}


@pytest.mark.parametrize("name", TREES)
def test_the_functions_are_those_of_the_c(name: str, tmp_path) -> None:
    robot, rng = load(name), np.random.default_rng()
    found = export(robot, to="casadi")
    functions = functions_of(found.data, tmp_path)
    assert functions.keys() == found.functions.keys()
    compiled = compile_model(generate_with(derive(robot), control=Control()))
    spec, shared = compiled.spec, 0
    for emitted in spec.every_function:
        role = emitted.name.removeprefix(f"{spec.prefix}_")
        if role not in functions or role in ("base_parameters", "forward_dynamics"):
            continue
        shared += 1
        for _ in range(3):
            state = state_of(spec, rng)
            given = {argument.name: state[argument.name] for argument in emitted.inputs}
            theirs = compiled.evaluate(role, **given)[0].reshape(-1)
            ours = called(functions[role], state).reshape(-1)
            assert np.abs(ours - theirs).max() <= 1e-12 * np.abs(theirs).max(), role
    assert shared >= 9
    chi = rng.uniform(-1, 1, len(spec.standard))
    beta = called(functions["base_parameters"], {"chi": chi}).reshape(-1)
    assert np.allclose(beta, compiled.base_parameters(chi), rtol=1e-13, atol=1e-13)


@pytest.mark.parametrize("name", ["demo-arm", "puma560"])
def test_derivatives_and_forward_dynamics(name: str, tmp_path) -> None:
    robot, rng = load(name), np.random.default_rng()
    functions = functions_of(export(robot, to="casadi").data, tmp_path)
    spec = generate(derive(robot)).spec
    nominal = {p.name: p.nominal for p in spec.standard}
    state = state_of(spec, rng)
    state["beta"] = np.array([sum(t.value * nominal[t.parameter] for t in b.terms)
                              for b in spec.base])  # fmt: skip
    tau = functions["inverse_dynamics"]
    slopes = tau.jacobian()
    values = [state[n] for n in tau.name_in()]
    found = dict(zip(slopes.name_out(), slopes.call([*values, 0 * state["tau"]]), strict=True))
    assert np.allclose(found["jac_tau_qdd"], functions["inertia_matrix"](state["q"], state["beta"]))
    C = functions["coriolis_matrix"](state["q"], state["qd"], state["beta"])
    losses = functions["friction"].jacobian()
    given = [state[n] for n in functions["friction"].name_in()]
    lost = dict(zip(losses.name_out(), losses.call([*given, 0 * state["tau"]]), strict=True))
    # d c/d qd = 2 C of Christoffel's symbols.
    assert np.allclose(found["jac_tau_qd"] - lost["jac_tau_qd"], 2 * C, atol=1e-10)
    for k, h in ((0, 1e-6),):
        ahead, back = ({**state, "q": state["q"] + d * np.eye(len(state["q"]))[k]} for d in (h, -h))
        slope = (called(tau, ahead) - called(tau, back)).reshape(-1) / (2 * h)
        assert np.allclose(slope, np.array(found["jac_tau_q"])[:, k], rtol=1e-6, atol=1e-5)
    state["tau"] = called(tau, state).reshape(-1)
    qdd = called(functions["forward_dynamics"], state).reshape(-1)
    assert np.allclose(qdd, state["qdd"], rtol=1e-9, atol=1e-9)


def test_smooth_friction_turns_over_its_width(tmp_path) -> None:
    robot, rng = load("demo-arm"), np.random.default_rng()
    functions = functions_of(export(robot, to="casadi").data, tmp_path)
    spec = generate(derive(robot)).spec
    state = state_of(spec, rng) | {"widths": rng.uniform(0.01, 2.0, 3)}
    change = called(functions["smooth_friction"], state) - called(functions["friction"], state)
    Fs = np.array([state["beta"][[b.name for b in spec.base].index(f"Fs{j}")] for j in (1, 2, 3)])
    law = Fs * (np.tanh(state["qd"] / state["widths"]) - np.sign(state["qd"]))
    assert np.allclose(change.reshape(-1), law, atol=1e-13)
    state["tau"] = called(functions["smooth_inverse_dynamics"], state).reshape(-1)
    qdd = called(functions["smooth_forward_dynamics"], state).reshape(-1)
    assert np.allclose(qdd, state["qdd"], rtol=1e-9, atol=1e-9)


def test_a_model_has_its_values_in_place_of_beta(tmp_path) -> None:
    robot = load("two-link")
    model = identify(robot, simulate(robot, duration=4.0, rate=200.0, seed=3))
    found = export(model, tmp_path / "two.casadi")
    assert [value.now for value in found.values] == pytest.approx(list(model.beta))
    fitted, free = (functions_of(export(x, to="casadi").data, tmp_path) for x in (model, robot))
    state = state_of(model.spec, np.random.default_rng()) | {"beta": model.beta}
    for role, function in fitted.items():
        assert "beta" not in function.name_in()
        if "widths" not in function.name_in():
            assert np.allclose(called(function, state), called(free[role], state), rtol=1e-12)


def test_what_is_not_there_is_said() -> None:
    text = load("two-link").text
    loaded = robot_from_text(text.replace("[effects]", '[effects]\nload_friction = "all"'), "loaded")
    found = export(loaded, to="casadi")
    assert "forward_dynamics" not in found.functions
    assert any("forward_dynamics: friction reads accelerations" in note for note in found.notes)
    with pytest.raises(ModelerError, match="five-bar has loops: CasADi"):
        export(load("five-bar"), to="casadi")
