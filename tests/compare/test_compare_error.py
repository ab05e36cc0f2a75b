"""One number is called error by every command; the command after `compare` runs as it stands."""

import json
import shutil

import pytest

from modeler.api import open_model
from modeler.cli import main


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("error")
    run(
        [
            *"""
                simulate two-link --hide stribeck@2 --duration 8 --rate 200 --seed 5 --out
            """.split(),
            place / "a.parquet",
        ]
    )
    run(["fit", "two-link", place / "a.parquet", "--out", place / "m.json"])
    return place


def run(words):
    assert main([str(word) for word in words]) == 0


def errors(place, words):
    run([*words, "--json", place / "out.json"])
    joints = json.loads((place / "out.json").read_text())["joints"]
    return {name: joint["relative_error"] for name, joint in joints.items()}


@pytest.mark.rotating("long tests of compare")
def test_error_is_one_number_of_one_model_and_log(folder, capsys):
    log, model = folder / "a.parquet", folder / "m.json"
    fit = errors(folder, ["fit", "two-link", log, "--out", folder / "again.json"])
    assert errors(folder, ["compare", model, log]) == pytest.approx(fit)
    capsys.readouterr()
    assert errors(folder, ["diagnose", model, log]) == pytest.approx(fit)
    said = capsys.readouterr().out
    bare = said.replace("cross-validated error", "").replace("held-out error", "")
    lines = [line for line in bare.splitlines() if " error " in line and "%" in line]
    assert all(line.startswith("error of the model on these logs") for line in lines), lines
    better = folder / "better.json"
    words = ["add", model, "stribeck", "--joint", "2", log, "--out", better]
    added = errors(folder, words)
    said = capsys.readouterr().out
    assert "error of the model on the logs of the fit: joint 1" in said
    assert "the cross-validated error falls: joint 2" in said
    assert errors(folder, ["compare", better, log]) == pytest.approx(added)


def test_the_log_of_a_fit_is_known_by_its_path(folder, tmp_path, monkeypatch):
    (tmp_path / "in").mkdir()
    shutil.copy(folder / "a.parquet", tmp_path / "1.parquet")
    monkeypatch.chdir(tmp_path / "in")
    run(["fit", "two-link", "../1.parquet", "--out", "m.json"])
    (log,) = open_model("m.json").logs
    assert log.find_place(".") == "../1.parquet"
    monkeypatch.chdir(tmp_path)
    assert log.find_place("in") == "in/../1.parquet"
    (tmp_path / "1.parquet").unlink()
    assert log.find_place("in") == ""
