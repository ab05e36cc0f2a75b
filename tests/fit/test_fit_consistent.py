"""`--method consistent` gives one machine; how far another fit is from one."""

import json

import numpy as np
import pyarrow
import pytest
from pyarrow import parquet

from modeler.cli import main
from modeler.estimation.model_file import load_model
from modeler.estimation.physical_consistency import (
    attribute_distance,
    define_physical_parameters,
    project_parameters,
)
from modeler.robot import INERTIAL, read_robot
from modeler.robot.edit import replace_parameters
from modeler.simulation.rigid import compute_pseudo_inertia
from tests.bodies import buildable
from tests.modules import compiled
from tests.rotation import rotating, with_cases


@pytest.fixture(scope="module", params=["two-link", *rotating("five-bar")])
def fitted(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("consistent")
    for words in (
        f"simulate {request.param} --duration 8 --rate 200 --seed 1 --out {folder}/a.parquet",
        f"fit {request.param} {folder}/a.parquet --method consistent --out {folder}/m.json "
        f"--robot-out {folder}/r.toml --json {folder}/fit.json",
    ):
        assert main(words.split()) == 0
    return request.param, folder, json.loads((folder / "fit.json").read_text())


def test_standard_and_base_are_one_machine(fitted):
    name, folder, text = fitted
    spec = compiled(name).spec
    chi = np.array([text["standard"][p.name] for p in spec.standard])
    beta = np.array([p["value"] for p in text["parameters"]])
    np.testing.assert_allclose(
        compiled(name).base_parameters(chi), beta, rtol=0, atol=1e-9 * np.abs(beta).max()
    )
    assert text["method"] == "consistent" and text["valid"]
    for joint in {p.joint for p in spec.standard if p.effect == "rigid_body"}:
        body = compute_pseudo_inertia({p: text["standard"][f"{p}{joint}"] for p in INERTIAL})
        size = np.sqrt(np.diag(body))
        assert np.linalg.eigvalsh(body / np.outer(size, size))[0] > 0.0
    assert load_model(folder / "m.json").fit.standard == text["standard"]


def test_the_robot_file_simulates_and_the_model_predicts_it(fitted, capsys):
    _, folder, text = fitted
    robot = read_robot(folder / "r.toml")
    rest = {k: v for k, v in robot.parameters.items() if k in text["standard"]}
    assert {k: float(v) for k, v in rest.items()} == {k: text["standard"][k] for k in rest}
    log, report = folder / "b.parquet", folder / "c.json"
    simulate = f"simulate {folder / 'r.toml'} --duration 8 --rate 200 --seed 2 --out {log}"
    assert main(simulate.split()) == 0
    assert main(["compare", str(folder / "m.json"), str(log), "--json", str(report)]) == 0
    assert json.loads(report.read_text())["relative_error"] < 0.01


def test_a_drawing_counts(fitted, tmp_path):
    """What no torque depends on is that of the drawing, where the robot file has one."""
    name, folder, text = fitted
    first = min(n[1:] for n in text["standard"] if n.startswith("M") and n[1:] in "12345")
    values = (0.5, 0.0, 0.0, 0.6, 0.0, 0.7, 0.0, 0.0, 0.0, 20.0)
    drawn = {f"{p}{first}": v for p, v in zip(INERTIAL, values, strict=True)}

    path = tmp_path / "drawn.toml"
    path.write_text(replace_parameters(read_robot(name).text, drawn))
    fit = f"fit {path} {folder / 'a.parquet'} --method consistent --out {tmp_path / 'm.json'}"
    assert main(fit.split()) == 0
    result = load_model(tmp_path / "m.json").fit.standard
    assert result[f"M{first}"] == pytest.approx(20.0, rel=0.3)
    assert abs(text["standard"][f"M{first}"] - 20.0) > abs(result[f"M{first}"] - 20.0)


CROSSED = """name = "crossed"
gravity = [0, 0, -9.81]
effects = {viscous = "all", rotor_inertia = ["2"]}
parameters = {Fv1 = 0.1}
[mdh]
columns = ["j", "a", "alpha", "d", "theta"]
rows = [["1", "0", 0, 0, "q1"], ["2", "1", "pi/2", 0.3, "q2"]]
"""


def test_what_is_put_at_zero_is_not_called_negative(tmp_path, capsys):
    """ZZ2R = ZZ2 + Ia2 is positive and says nothing of Ia2; Fv1 has a column of its own."""
    (tmp_path / "c.toml").write_text(CROSSED)
    log, robot = tmp_path / "a.parquet", tmp_path / "c.toml"
    words = f"simulate {robot} --duration 8 --rate 200 --seed 1 --out {log}"
    assert main(words.split()) == 0
    table = parquet.read_table(log)
    pushed = table["tau1"].to_numpy() - 0.6 * np.gradient(table["q1"], table["time"])
    at = table.column_names.index("tau1")
    parquet.write_table(table.set_column(at, "tau1", pyarrow.array(pushed)), log)
    words = f"fit {robot} {log} --method consistent --out {tmp_path / 'm.json'}"
    assert main(words.split()) == 0
    said = capsys.readouterr().out
    assert "Ia2 is not identifiable apart from ZZ2 and is put at 0" in said
    assert "\nFv1 held at 0, which would be negative" in said


def buildable_two_link(seed):
    """The machine of a two-link arm, the names of its base parameters, and values of a body."""
    spec = compiled("two-link").spec
    machine, chi = define_physical_parameters(spec), buildable(spec, np.random.default_rng(seed))
    return machine, [base.name for base in spec.base], machine.K[:, : len(chi)] @ chi


@pytest.mark.parametrize("name", ["two-link", *rotating("sr400", "dvrk-psm", "orthoglide-2003")])
def test_a_machine_that_could_be_built_is_at_no_distance(name):
    machine = define_physical_parameters(compiled(name).spec)
    chi = buildable(compiled(name).spec, np.random.default_rng(41))
    beta = machine.K[:, : len(chi)] @ chi
    np.testing.assert_allclose(beta, compiled(name).base_parameters(chi), rtol=1e-9)
    root = np.diag(1.0 / (0.01 * np.abs(beta) + 1e-6))  # one percent
    result = project_parameters(machine, beta, root)
    assert result is not None and result.distance < 1e-2  # standard deviations


@with_cases("name, carrier, rel", ("Fv2", "Fv2", 1e-3), ("ZZ2", "2", 1e-2))
def test_a_value_below_zero_is_as_far_as_it_is_below_and_has_a_carrier(name, carrier, rel):
    machine, names, beta = buildable_two_link(42)
    place = names.index(name)
    beta[place] = -0.4
    weights = np.full(len(beta), 20.0 if name == "Fv2" else 1e-3)  # free to follow, or not
    weights[place] = 20.0
    root = np.diag(weights)
    nearest = project_parameters(machine, beta, root)
    assert nearest is not None and nearest.distance == pytest.approx(0.4 * 20.0, rel=rel)
    assert nearest.beta[place] == pytest.approx(0.0, abs=0.1 * rel)
    assert attribute_distance(machine, beta, root, nearest.distance) == [carrier]
