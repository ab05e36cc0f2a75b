"""CasADi's functions are those of the C, and their derivatives those of the motion."""

import io
import zipfile

import casadi
import numpy as np
import pytest

from modeler.api import derive, export, generate, identify, load, simulate
from modeler.codegen import Control, generate as generate_with
from modeler.robot import parse_robot_text
from tests.modules import loaded

SLOW = [
    pytest.param(n, marks=pytest.mark.slow) for n in ("puma560", "ur10e", "sr400-tree", "so101")
]
TREES = ("demo-arm", pytest.param("two-link", marks=pytest.mark.rotating), *SLOW)
LOOPS = ("five-bar", pytest.param("orthoglide-2003", marks=pytest.mark.slow))


def functions_of(data: bytes, tmp_path) -> dict[str, casadi.Function]:
    """As a user opens the file."""
    place = tmp_path / "robot.casadi"
    place.write_bytes(data)
    return {f.name(): f for f in casadi.FileDeserializer(str(place)).unpack()}


def called(function, values) -> np.ndarray:
    """Its outputs, one below the other, by the names of its inputs."""
    result = function.call([casadi.DM(values[name]) for name in function.name_in()])
    return np.vstack([x.full() for x in result])


def state_of(spec, rng) -> dict[str, np.ndarray]:
    n, c = len(spec.joints), len(spec.base)
    sizes = {"q": n, "qd": n, "qdd": n, "v": n, "a": n, "tau": n, "beta": c}
    sizes |= {"chi": len(spec.standard), "s": len(spec.signals), "dq": n, "dt": 1}
    return {name: rng.uniform(-1.5, 1.5, size) for name, size in sizes.items()}


def far(name: str, tmp_path, rng, reach: float = 1.5) -> dict[str, float]:
    """{function: its largest distance from the C, relative}, at random states."""
    robot = load(name)
    files = export(robot, to="casadi")
    functions = functions_of(files.data, tmp_path)
    assert functions.keys() == files.functions.keys()
    derivation = derive(robot)
    compiled = loaded(generate_with(derivation, control=Control()))
    spec, errors = compiled.spec, dict[str, float]()
    for emitted in spec.every_function:
        role = emitted.name.removeprefix(f"{spec.prefix}_")
        if role not in functions or role in ("base_parameters", "forward_dynamics"):
            continue
        for _ in range(3):
            state = state_of(spec, rng)
            if spec.closure is not None:
                home = np.array(spec.closure.home)[list(spec.closure.actuated)]
                state["q"] = home + reach * state["q"]
            sizes = {argument.name: argument.size for argument in emitted.inputs}
            state["widths"] = rng.uniform(0.1, 1.0, sizes.get("widths", 0))
            cells = {name: state[name] for name in sizes}
            theirs = compiled.evaluate(role, **cells)[0].reshape(-1)
            ours = called(functions[role], state).reshape(-1)
            error = np.abs(ours - theirs).max() / max(np.abs(theirs).max(), 1e-9)
            errors[role] = max(errors.get(role, 0.0), error)
    chi = rng.uniform(-1, 1, len(spec.standard))
    beta = called(functions["base_parameters"], {"chi": chi}).reshape(-1)
    assert np.allclose(beta, compiled.base_parameters(chi), rtol=1e-13, atol=1e-13)
    return errors


@pytest.mark.parametrize("name", [*TREES, *LOOPS])
def test_the_functions_are_those_of_the_c(name: str, tmp_path) -> None:
    """With loops as well as these are closed."""
    loops = name in ("five-bar", "orthoglide-2003")
    errors = far(name, tmp_path, np.random.default_rng(), reach=0.03 if loops else 1.5)
    assert max(errors.values()) < (1e-9 if loops else 1e-12), errors
    assert len(errors) >= (10 if loops else 20)
    assert not loops or {"close", "coupling", "inverse_dynamics", "coriolis"} <= errors.keys()


@pytest.mark.parametrize("name", [TREES[0], TREES[2]])
def test_derivatives_are_those_of_the_motion(name: str, tmp_path) -> None:
    robot, rng = load(name), np.random.default_rng()
    tau = functions_of(export(robot, to="casadi").data, tmp_path)["inverse_dynamics"]
    compiled = loaded(generate_with(derive(robot), control=Control()))
    nominal = np.array([p.nominal or 0.0 for p in compiled.spec.standard])
    state = state_of(compiled.spec, rng) | {"beta": compiled.base_parameters(nominal)}
    slopes = tau.jacobian()
    values = slopes.call([*(state[n] for n in tau.name_in()), 0 * state["tau"]])
    ours = {name: x.full() for name, x in zip(slopes.name_out(), values, strict=True)}
    theirs = compiled.evaluate("derivatives", **{n: state[n] for n in tau.name_in()})[0]
    M = compiled.evaluate("inertia_matrix", q=state["q"], beta=state["beta"])[0]
    for kind, matrix in (("q", theirs[0]), ("qd", theirs[1]), ("qdd", M)):
        size = np.abs(matrix).max()
        assert np.abs(ours[f"jac_tau_{kind}"] - matrix).max() < 1e-12 * size, kind


LOADED = """
[effects]
load_friction = [{joint = "2", w = 0.5}]"""


@pytest.mark.parametrize(
    "name", ["two-link", *(pytest.param(n, marks=pytest.mark.slow) for n in ("dvrk-psm", "tx40"))]
)
def test_forward_dynamics_where_torques_read_accelerations(name: str, tmp_path) -> None:
    """Friction on the load; followers and coupled motors: accelerations that give these torques."""
    robot, rng = load(name), np.random.default_rng(4)
    if name == "two-link":
        text = robot.text.replace("\n[effects]", LOADED) + "\n[reference]\nM2 = 1.5\nMX2 = 0.2\n"
        robot = parse_robot_text(text, "loaded")
    functions = functions_of(export(robot, to="casadi").data, tmp_path)
    compiled = loaded(generate_with(derive(robot), control=Control()))
    spec = compiled.spec
    names = [p.name for p in spec.standard]
    chi = np.array([1.0 + 20.0 * name.startswith(("XX", "YY", "ZZ", "Ia")) for name in names])
    small = [name[0] in "FOK" or name.startswith("MX") for name in names]
    state = state_of(spec, rng) | {"beta": compiled.base_parameters(np.where(small, 0.1, chi))}
    tau, solved = functions["inverse_dynamics"], functions["forward_dynamics"]
    state["tau"] = called(tau, state).reshape(-1)
    qdd = called(solved, state).reshape(-1)
    assert np.allclose(qdd, state["qdd"], rtol=1e-9, atol=1e-9)
    theirs = compiled.evaluate("forward_dynamics", **{n: state[n] for n in solved.name_in()})[0]
    assert np.allclose(qdd, theirs, rtol=1e-9, atol=1e-9)


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


@pytest.mark.rotating("long tests of export")
def test_a_model_has_its_values_in_place_of_beta(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr("modeler.api.exporting.build_portable_library", lambda _: b"no need of it")
    robot = load("two-link")
    model = identify(robot, simulate(robot, duration=4.0, rate=200.0, seed=3))
    files = export(model, tmp_path / "two.casadi")
    assert [value.after for value in files.values] == pytest.approx(list(model.beta))
    fitted, free = (functions_of(export(x, to="casadi").data, tmp_path) for x in (model, robot))
    state = state_of(model.spec, np.random.default_rng()) | {"beta": model.beta}
    for role, function in fitted.items():
        assert "beta" not in function.name_in()
        if "widths" not in function.name_in():
            assert np.allclose(called(function, state), called(free[role], state), rtol=1e-12)
    # The other interfaces have them as start values.
    with zipfile.ZipFile(io.BytesIO(export(model, to="fmu").data)) as archive:
        text = archive.read("modelDescription.xml").decode()
    core = export(model, to="ros2").files["src/computed_torque.hpp"].decode()
    for parameter in model.fit.parameters:
        assert f' name="{parameter.name}"' in text and f'start="{parameter.value!r}"' in text
        assert f"{parameter.value!r},  /* {parameter.name}," in core
