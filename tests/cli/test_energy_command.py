"""The energy model as a user types it; the counts of Evr@."""

import json

import pytest

from modeler.cli import main
from tests.cli.running import answer, refusal, run
from tests.rotation import ROTATING, rotating, with_cases


@with_cases(
    "options, rank, friction, offset",
    *rotating(("", 90, 0, 0)),
    pytest.param("--effects viscous,coulomb", 106, 16, 0, marks=ROTATING),
    ("--effects viscous,coulomb,asymmetric_viscous,offset", 122, 24, 8),
    ("--cut-loops", 96, 0, 0),
)
def test_the_counts_of_evra(capsys, tmp_path, options, rank, friction, offset):
    """90; 16 more with friction, 32 by direction; 96 where the legs are not closed."""
    words = ("derive", "evra", *options.split(), "--no-terms", "--json", tmp_path / "d.json")
    assert f"{rank} base parameters" in answer(capsys, *words)
    raw = json.loads((tmp_path / "d.json").read_text())
    assert raw["rank"] == rank and raw["proof"] == "exact"
    assert raw["counts"]["friction"] == friction and raw["counts"]["offset"] == offset
    assert raw["counts"]["inertial"] == rank - friction - offset


def test_a_tree_has_no_loops_to_cut(capsys):
    err = refusal(capsys, "derive", "scara", "--cut-loops")
    assert err == "modeler: --cut-loops: scara has no loops to cut; leave --cut-loops out\n"


FIT = "fit five-bar a.parquet --effects viscous,coulomb --model energy --out m.json"


@pytest.mark.rotating("long tests of cli")
def test_energies_of_a_robot_with_loops_are_fitted_and_compared(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, seed in (("a", 1), ("b", 2)):
        words = (
            "simulate five-bar --effects viscous,coulomb --duration 8 --rate 250 --noise 0.02 "
            f"--seed {seed} --out {name}.parquet"
        )
        assert main(words.split()) == 0
    out = answer(capsys, *FIT.split(), "--json", "f.json")
    raw = json.loads((tmp_path / "f.json").read_text())
    assert raw["model"] == "energy" and raw["valid"] is True
    assert raw["energy"]["figures"][0]["model"] == "torque"
    assert raw["energy"]["uncertainty_ratio"] > 1.0
    assert "beside the torque model on the same data" in out
    assert run(capsys, *["compare", "m.json", "b.parquet", "--json", "c.json"])[0] == 0
    assert json.loads((tmp_path / "c.json").read_text())["relative_error"] < 0.1


@with_cases(
    "options, message",
    ("--window 0.1", "a window needs the energy model; add --model energy"),
    ("--model energy --window 60", "is longer than the longest motion without a gap"),
    ("--model energy --window 1e-4", "expected two samples or more"),
    ("--model energy --payload-log b.csv", "the energy model takes no logs with a load"),
    *(
        (f"--model energy --method {method}", f"the energy model does not take method {method}")
        for method in ("robust", "tls", "two-step")
    ),
)
def test_what_the_energy_model_refuses(capsys, axis, tmp_path, monkeypatch, options, message):
    monkeypatch.chdir(axis)
    words = ("fit", "emps", "a.csv", "--out", tmp_path / "m.json", *options.split())
    assert message in refusal(capsys, *words)
