"""The energy model and the reduced model as a user types them; the counts of Evr@."""

import json

import pyarrow
import pytest
from pyarrow import parquet

from modeler.cli import main
from tests.cli.running import answer, refusal, run
from tests.rotation import ROTATING


@pytest.mark.parametrize(
    ("options", "rank", "friction", "offset"),
    [
        pytest.param([], 90, 0, 0, marks=pytest.mark.rotating),
        pytest.param(["--effects", "viscous,coulomb"], 106, 16, 0, marks=ROTATING),
        (["--effects", "viscous,coulomb,asymmetric_viscous,offset"], 122, 24, 8),
        (["--cut-loops"], 96, 0, 0),
    ],
)
def test_the_counts_of_evra(capsys, tmp_path, options, rank, friction, offset):
    """90; 16 more with friction, 32 by direction; 96 where the legs are not closed."""
    out = answer(capsys, "derive", "evra", *options, "--no-terms", "--json", tmp_path / "d.json")
    raw = json.loads((tmp_path / "d.json").read_text())
    assert raw["rank"] == rank and raw["proof"] == "exact"
    assert raw["counts"]["friction"] == friction and raw["counts"]["offset"] == offset
    assert raw["counts"]["inertial"] == rank - friction - offset
    assert f"{rank} base parameters" in out


def test_a_tree_has_no_loops_to_cut(capsys):
    err = refusal(capsys, "derive", "scara", "--cut-loops")
    assert err == "modeler: --cut-loops: scara has no loops to cut; leave --cut-loops out\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("energy")
    for name, seed in (("a", 1), ("b", 2)):
        words = ("simulate five-bar --effects viscous,coulomb --duration 8 --rate 250 --noise 0.02 "
                 f"--seed {seed} --out {folder}/{name}.parquet")  # fmt: skip
        assert main(words.split()) == 0
    return folder


def fit(folder, *options, effects="viscous,coulomb"):
    """The words of a fit."""
    return ("fit", "five-bar", folder / "a.parquet", "--out", folder / "m.json",
            "--effects", effects, *options)  # fmt: skip


@pytest.mark.rotating("long tests of cli")
def test_energies_of_a_robot_with_loops_are_fitted_and_compared(capsys, folder):
    out = answer(capsys, *fit(folder, "--model", "energy", "--json", folder / "f.json"))
    raw = json.loads((folder / "f.json").read_text())
    assert raw["model"] == "energy" and raw["usable"] is True
    assert raw["energy"]["figures"][0]["model"] == "torque"
    assert raw["energy"]["ratio"] > 1.0 and "beside the torque model on the same data" in out
    compared = ("compare", folder / "m.json", folder / "b.parquet", "--json", folder / "c.json")
    assert run(capsys, *compared)[0] == 0
    assert json.loads((folder / "c.json").read_text())["relative_error"] < 0.1


@pytest.mark.rotating("long tests of cli")
def test_compare_predicts_with_the_essential_parameters(capsys, folder):
    effects = "viscous,coulomb,offset"  # the simulated robot has no offset
    status, out, _ = run(capsys, *fit(folder, "--json", folder / "f.json", effects=effects))
    essential = json.loads((folder / "f.json").read_text())["essential"]
    assert status == 0 and essential["dropped"] and "reduced model: " in out
    assert essential["condition_number"] > 1.0
    errors = []
    for options in ([], ["--essential"]):
        words = ("compare", folder / "m.json", folder / "b.parquet", *options)
        answer(capsys, *words, "--json", folder / "c.json")
        errors.append(json.loads((folder / "c.json").read_text())["relative_error"])
    assert errors[0] != errors[1] and errors[1] < 1.1 * errors[0]


ENERGY = "--model energy"
LEAST = "got it with --model energy, whose rows are windows"


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ("--window 0.1", "--window: only windows of --model energy have a length; add that"),
        (f"{ENERGY} --window 60", "is longer than the longest motion without a gap"),
        (f"{ENERGY} --window 1e-4", "expected two samples or more"),
        (f"{ENERGY} --window 2", "parameters; record more motion, or give a short"),
        (f"{ENERGY} --payload-log b.parquet", "--payload-log: the energy model takes logs without"),
        *((f"{ENERGY} --method {m}", f"--method {m}: {LEAST}")
          for m in ("robust", "consistent", "tls", "two-step")),
    ],
)  # fmt: skip
def test_what_the_energy_model_refuses(capsys, folder, monkeypatch, options, told):
    monkeypatch.chdir(folder)
    assert told in refusal(capsys, *fit(folder, *options.split()))


@pytest.mark.parametrize(
    ("value", "told"),
    [(0.0, "is 0 in every row; the energy model needs"), (float("nan"), "has no values; record")],
)
def test_a_log_without_a_motors_torque(capsys, folder, tmp_path, value, told):
    table = parquet.read_table(folder / "a.parquet")
    tau = next(i for i, name in enumerate(table.column_names) if name.startswith("tau"))
    changed = pyarrow.array([value] * table.num_rows)
    place = tmp_path / "x.parquet"
    parquet.write_table(table.set_column(tau, table.column_names[tau], changed), place)
    words = ("fit", "five-bar", place, "--effects", "viscous,coulomb", *ENERGY.split())
    assert told in refusal(capsys, *words, "--out", tmp_path / "x.json")
    assert not (tmp_path / "x.json").exists()
