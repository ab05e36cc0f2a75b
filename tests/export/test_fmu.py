"""The FMU in FMPy: valid, and it moves as our own integration of the same equations."""

import hashlib
import io
import zipfile

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from modeler.api import derive, export, generate, load
from modeler.core.errors import BuildError
from modeler.core.files import locate_resources
from tests.csrc.emitted_folders import run as run_command
from tests.modules import STRICT, compiler, loaded
from tests.rotation import rotating, with_cases
from tests.when_used import WhenUsed

fmpy = WhenUsed("fmpy", "NOT CHECKED: no FMPy")
validation = WhenUsed("fmpy.validation", "NOT CHECKED: no FMPy")

STEP, LENGTH = 2e-3, 0.2
WIDTH = 0.02


class Plant:
    """The equations with numpy: friction by its law, all else by the regressor."""

    def __init__(self, robot) -> None:
        self.compiled = loaded(generate(derive(robot)))
        self.spec = self.compiled.spec
        self.n = len(self.spec.joints)
        nominal = {p.name: p.nominal or 0.0 for p in self.spec.standard}
        terms = [base.terms for base in self.spec.base]
        self.beta = np.array([sum(t.value * nominal[t.parameter] for t in each) for each in terms])
        places = {base.name: k for k, base in enumerate(self.spec.base)}
        self.coulomb = {
            joint.name: places[name]
            for joint in self.spec.joints
            if (name := f"Fs{joint.name}") in places
        }

    def accelerations(self, q, qd, tau) -> np.ndarray:
        phi = self.compiled.base_regressor(q[None], qd[None], 0.0 * qd[None])[0]
        for i, joint in enumerate(self.spec.joints):
            if joint.name in self.coulomb:
                phi[i, self.coulomb[joint.name]] = np.tanh(qd[i] / WIDTH)
        M = self.compiled.inertia_matrix(q[None], self.beta)[0]
        return np.linalg.solve(M, tau - phi @ self.beta)

    def slope(self, x, tau) -> np.ndarray:
        q, qd = x[: self.n], x[self.n :]
        return np.concatenate([qd, self.accelerations(q, qd, tau)])

    def runge_kutta(self, x, torques, h, per) -> np.ndarray:
        rows = [x]
        for tau in torques:
            for _ in range(per):
                k1 = self.slope(x, tau)
                k2 = self.slope(x + h / 2 * k1, tau)
                k3 = self.slope(x + h / 2 * k2, tau)
                k4 = self.slope(x + h * k3, tau)
                x = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            rows.append(x)
        return np.array(rows)


@pytest.fixture(scope="module", params=["demo-arm", *rotating("five-bar")])
def unit(request, tmp_path_factory):
    """A robot as FMU, its equations, a state and torques over time."""
    robot = load(request.param)
    place = tmp_path_factory.mktemp("fmu") / "robot.fmu"
    export(robot, place)
    plant = Plant(robot)
    rng = np.random.default_rng()
    state = np.concatenate([rng.uniform(-1, 1, plant.n), rng.uniform(-0.5, 0.5, plant.n)])
    if (closure := plant.spec.closure) is not None:
        home = np.array(closure.home)[list(closure.actuated)]
        state[: plant.n] = home + 0.1 * state[: plant.n]
    times = np.arange(round(LENGTH / STEP) + 1) * STEP
    still = plant.compiled.gravity(state[None, : plant.n], plant.beta)[0]
    waves = rng.uniform(-9, 9, (plant.n, 1)) * np.sin(
        rng.uniform(5, 30, (plant.n, 1)) * times + rng.uniform(0, 6, (plant.n, 1))
    )
    M = plant.compiled.inertia_matrix(state[None, : plant.n], plant.beta)[0]
    torques = still[:, None] + M.diagonal()[:, None] * waves
    return place, plant, state, times, torques.T


def run(unit, kind: str, torques, **options) -> np.ndarray:
    place, plant, state, times, _ = unit
    names = [joint.name for joint in plant.spec.joints]
    states = [f"{kind}{name}" for kind in ("q", "qd") for name in names]
    values = np.zeros(len(times), [("time", float), *((f"tau{name}", float) for name in names)])
    values["time"] = times
    for name, column in zip(names, torques.T, strict=True):
        values[f"tau{name}"] = column
    start = dict(zip(states, state, strict=True)) | {"step": 5e-4}
    start |= {f"width{name}": WIDTH for name in plant.coulomb}
    options |= {"stop_time": LENGTH, "output_interval": STEP, "fmi_type": kind, "input": values}
    options |= {"start_values": start, "output": states, "validate": True}
    run = fmpy.simulate_fmu(str(place), **options)
    assert np.allclose(run["time"], times)
    return np.column_stack([run[name] for name in states])


def test_the_description_is_valid(unit) -> None:
    assert validation.validate_fmu(str(unit[0])) == []


def test_co_simulation_is_our_own_integration(unit) -> None:
    _, plant, state, _, torques = unit
    out = run(unit, "CoSimulation", torques)
    ours = plant.runge_kutta(state, torques[:-1], 5e-4, 4)
    assert np.abs(out - state).max() > 1e-2
    assert np.abs(out - ours).max() < 1e-9 * np.abs(ours).max()


def test_model_exchange_follows_the_equations(unit) -> None:
    _, plant, state, times, torques = unit
    torques = np.broadcast_to(torques[7], torques.shape)  # FMPy's solver looks beyond a step
    out = run(unit, "ModelExchange", torques, relative_tolerance=1e-10)
    ours = solve_ivp(
        lambda _, x: plant.slope(x, torques[0]),
        (0, LENGTH),
        state,
        "DOP853",
        times,
        rtol=1e-10,
        atol=1e-12,
    )
    assert np.abs(out - state).max() > 1e-2
    assert np.abs(out - ours.y.T).max() < 1e-6 * np.abs(ours.y).max()


def test_simulink_is_the_same_unit_and_sources_do_alone(monkeypatch) -> None:
    def no_library(sources) -> bytes:
        raise BuildError("C compiler: none of cc, gcc, clang is found")

    monkeypatch.setattr("modeler.api.exporting.build_portable_library", no_library)
    unit, same = (export(load("two-link"), to=to) for to in ("fmu", "simulink"))
    assert unit.data == same.data and "Simulink" in same.notes[0]
    assert any("sources only" in note and "C compiler: none" in note for note in unit.notes)
    names = zipfile.ZipFile(io.BytesIO(unit.data)).namelist()
    assert not any(name.startswith("binaries/") for name in names)
    assert "sources/buildDescription.xml" in names


def opened(unit, folder, messages: list[str]):
    """An instance before its initialization; `messages` gets what it says."""
    unpacked = fmpy.extract(str(unit[0]), str(folder))
    description = fmpy.read_model_description(unpacked)
    slave = fmpy.fmi3.FMU3Slave(
        guid=description.guid,
        unzipDirectory=unpacked,
        instanceName="robot",
        modelIdentifier=description.coSimulation.modelIdentifier,
    )
    slave.log = fmpy.fmi3.fmi3LogMessageCallback(  # lives as long as it may be called
        lambda environment, status, category, message: messages.append(message.decode())
    )
    slave.instantiate(logMessage=slave.log)
    return slave, {v.name: v.valueReference for v in description.modelVariables}


@with_cases(
    "name, value, words",
    ("tau", np.nan, "is not finite"),
    ("width", 0.0, "widths of the Coulomb friction must be positive"),
    ("step", -1e-3, "step must be positive"),
    ("qdd", 1.0, "time and derivatives cannot be set"),
)
def test_values_that_make_no_sense_are_refused(unit, tmp_path, name, value, words) -> None:
    messages: list[str] = []
    slave, places = opened(unit, tmp_path, messages)
    name = name if name == "step" else f"{name}{unit[1].spec.joints[0].name}"
    if name not in places:
        pytest.skip("no Coulomb friction")
    with pytest.raises(fmpy.fmi1.FMICallException, match="status 3"):
        slave.setFloat64([places[name]], [value])
    assert words in messages[-1]
    slave.freeInstance()


def test_a_step_without_accelerations_is_discarded(unit, tmp_path) -> None:
    messages: list[str] = []
    slave, places = opened(unit, tmp_path, messages)
    first = [places[f"q{unit[1].spec.joints[0].name}"]]
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    slave.doStep(0.0, 0.01)
    with pytest.raises(fmpy.fmi1.FMICallException):
        slave.setFloat64(first, [1.0])
    assert "before the initialization ends" in messages[-1]
    state = slave.getFMUState()
    before = slave.getFloat64(first)
    for base in unit[1].spec.base:
        slave.setFloat64([places[base.name]], [0.0])  # no masses
    with pytest.raises(fmpy.fmi1.FMICallException, match="status 2"):
        slave.doStep(0.01, 0.01)
    assert "no accelerations at time 0.01: status 2" in messages[-1]
    assert slave.getFloat64(first) == before
    slave.setFMUState(state)
    slave.freeFMUState(state)
    slave.doStep(0.01, 0.01)
    assert slave.getFloat64(first) != before
    slave.freeInstance()


@pytest.mark.parametrize("cc", ["gcc", "clang"])
def test_the_sources_compile_without_a_warning(unit, tmp_path, cc) -> None:
    with zipfile.ZipFile(unit[0]) as archive:
        archive.extractall(tmp_path)
    (tmp_path / "fmi").mkdir()
    for header in (tmp_path / "sources").glob("fmi3*.h"):
        header.rename(tmp_path / "fmi" / header.name)
    strict = [word for word in STRICT if word != "-Wpedantic"]
    words = [*strict, "-Wundef", "-fsyntax-only", "-isystem", "fmi", "sources/modeler_fmu.c"]
    run_command(compiler(cc), *words, where=tmp_path)


PUBLISHED = {
    "fmi3Functions.h": "6367e9f7895848ed8d06c8a9b7f77e72d9f3eae102f64c313d51c10049b720ee",
    "fmi3FunctionTypes.h": "77bb086dbf9b9123f75edc2a90a0f27fb5c32f913ab3f9b69fe2e2cbc2448b24",
    "fmi3PlatformTypes.h": "19ea19ae07cdab582931fc1a545d9aeef3d5066da131ee96a7e393e72164fa30",
    "LICENSE": "e95981dfdc77107e8bdb475b67ca8cda087e377cc60dde1fa2b213fad65e9dd7",
}
"""SHA-256 of the headers of FMI 3.0 as FMPy 0.3.32 carries them."""


def test_the_headers_are_those_that_were_published() -> None:
    folder = locate_resources("templates") / "fmi3"
    table = {p.name: hashlib.sha256(p.read_bytes()).hexdigest() for p in folder.iterdir()}
    assert table == PUBLISHED
