"""The energy model and the reduced model as a user types them; the counts of Evr@."""

import json

import pyarrow
import pytest
from pyarrow import parquet

from modeler.cli import main
from tests.rotation import ROTATING


def run(capsys, *argv):
    status = main([str(a) for a in argv])
    out, err = capsys.readouterr()
    return status, out, err


@pytest.mark.parametrize(
    ("options", "rank", "friction", "offset"),
    [
        ([], 90, 0, 0),
        pytest.param(["--effects", "viscous,coulomb"], 106, 16, 0, marks=ROTATING),
        (["--effects", "viscous,coulomb,asymmetric_viscous,offset"], 122, 24, 8),
        (["--cut-loops"], 96, 0, 0),
    ],
)
def test_the_counts_of_evra(capsys, tmp_path, options, rank, friction, offset):
    """90; 16 more with friction, 32 by direction; 96 where the legs are not closed."""
    status, out, err = run(
        capsys, "derive", "evra", *options, "--no-terms", "--json", tmp_path / "d.json"
    )
    raw = json.loads((tmp_path / "d.json").read_text())
    assert (status, err) == (0, "") and raw["rank"] == rank and raw["proof"] == "exact"
    assert raw["counts"]["friction"] == friction and raw["counts"]["offset"] == offset
    assert raw["counts"]["inertial"] == rank - friction - offset
    assert f"{rank} base parameters" in out


def test_a_tree_has_no_loops_to_cut(capsys):
    status, out, err = run(capsys, "derive", "scara", "--cut-loops")
    assert (status, out) == (1, "")
    assert err == "modeler: --cut-loops: scara has no loops to cut; leave --cut-loops out\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("energy")
    for name, seed in (("a", 1), ("b", 2)):
        argv = ["simulate", "five-bar", "--effects", "viscous,coulomb", "--duration", "8",
                "--rate", "250", "--noise", "0.02", "--seed", seed,
                "--out", folder / f"{name}.parquet"]  # fmt: skip
        assert main([*map(str, argv)]) == 0
    return folder


def fit(capsys, folder, *options, effects="viscous,coulomb"):
    return run(capsys, "fit", "five-bar", folder / "a.parquet", "--out", folder / "m.json",
               "--effects", effects, *options)  # fmt: skip


def test_energies_of_a_robot_with_loops_are_fitted_and_compared(capsys, folder):
    status, out, err = fit(capsys, folder, "--model", "energy", "--json", folder / "f.json")
    assert (status, err) == (0, "")
    raw = json.loads((folder / "f.json").read_text())
    assert raw["model"] == "energy" and raw["usable"] is True
    assert raw["energy"]["figures"][0]["model"] == "torque"
    assert raw["energy"]["ratio"] > 1.0 and "beside the torque model on the same data" in out
    status, out, _ = run(capsys, "compare", folder / "m.json", folder / "b.parquet",
                         "--json", folder / "c.json")  # fmt: skip
    assert status == 0
    assert json.loads((folder / "c.json").read_text())["relative_error"] < 0.1


def test_compare_predicts_with_the_essential_parameters(capsys, folder):
    effects = "viscous,coulomb,offset"  # the simulated robot has no offset
    status, out, _ = fit(capsys, folder, "--json", folder / "f.json", effects=effects)
    essential = json.loads((folder / "f.json").read_text())["essential"]
    assert status == 0 and essential["dropped"] and "reduced model: " in out
    assert essential["condition_number"] > 1.0
    errors = []
    for options in ([], ["--essential"]):
        status, _, err = run(capsys, "compare", folder / "m.json", folder / "b.parquet",
                             *options, "--json", folder / "c.json")  # fmt: skip
        assert (status, err) == (0, "")
        errors.append(json.loads((folder / "c.json").read_text())["relative_error"])
    assert errors[0] != errors[1] and errors[1] < 1.1 * errors[0]


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (["--window", "0.1"], "--window: only windows of --model energy have a length; add that"),
        (
            ["--model", "energy", "--window", "60"],
            "is longer than the longest motion without a gap",
        ),
        (["--model", "energy", "--window", "1e-4"], "expected two samples or more"),
        (["--model", "energy", "--window", "2"], "parameters; record more motion, or give a short"),
    ],
)
def test_windows_that_cannot_be(capsys, folder, options, told):
    status, out, err = fit(capsys, folder, *options)
    assert (status, out) == (1, "") and err.startswith("modeler: ") and told in err
    assert err.count("\n") == 1


def test_loads_are_for_the_torque_model(capsys, folder):
    status, _, err = fit(capsys, folder, "--model", "energy", "--payload-log", folder / "b.parquet")
    assert status == 1 and "--payload-log: the energy model takes logs without load" in err


@pytest.mark.parametrize("method", ["robust", "consistent", "tls", "two-step"])
def test_windows_are_fitted_by_least_squares(capsys, folder, method):
    status, out, err = fit(capsys, folder, "--model", "energy", "--method", method)
    assert (status, out) == (1, "") and err.count("\n") == 1
    assert f"--method {method}: got it with --model energy, whose rows are windows" in err


def test_a_log_without_a_motors_torque(capsys, folder):
    table = parquet.read_table(folder / "a.parquet")
    tau = next(i for i, name in enumerate(table.column_names) if name.startswith("tau"))
    name = table.column_names[tau]
    for file, values in (("dead", [0.0]), ("nan", [float("nan")])):
        changed = table.set_column(tau, name, pyarrow.array(values * table.num_rows))
        parquet.write_table(changed, folder / f"{file}.parquet")
        status, _, err = run(capsys, "fit", "five-bar", folder / f"{file}.parquet", "--model",
                             "energy", "--out", folder / "x.json")  # fmt: skip
        assert status == 1 and err.startswith("modeler: ") and err.count("\n") == 1
        told = (
            "is 0 in every row; the energy model needs"
            if file == "dead"
            else "has no values; record it"
        )
        assert told in err
        assert not (folder / "x.json").exists()
