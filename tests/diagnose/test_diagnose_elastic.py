"""A gear that gives way: named, added by the command that is printed, confirmed by a third log."""

import json
import shlex
from pathlib import Path

import pytest

from tests.diagnose.conftest import Run

STIFFNESS, DAMPING = 9000.0, 28.0  # about 12 Hz, damping ratio 0.1


def simulate(run: Run, folder: Path, name: str, seed: int, *words: object) -> Path:
    log = folder / f"{name}.parquet"
    most = ("--duration", 15, "--rate", 1000, "--seed", seed, "--out", log)
    status, _, err = run("simulate", "demo-arm", *most, *words)
    assert status == 0, err
    return log


def read_error(run: Run, folder: Path, model: Path, log: Path) -> float:
    """Error of a model on a log, rms over the joints."""
    status, _, err = run("compare", model, log, "--json", folder / "c.json")
    assert status == 0, err
    joints = json.loads((folder / "c.json").read_text())["joints"].values()
    return (sum(joint["relative_error"] ** 2 for joint in joints) / len(joints)) ** 0.5


@pytest.mark.rotating("long tests of diagnose")
def test_an_elastic_joint_is_named_added_and_confirmed(run: Run, tmp_path: Path) -> None:
    hide = ("--hide", f"elasticity@2:stiffness={STIFFNESS},damping={DAMPING}")
    train, other, third = (simulate(run, tmp_path, f"h{k}", k, *hide) for k in (1, 2, 3))
    model = tmp_path / "m.json"
    assert run("fit", "demo-arm", train, "--out", model)[0] == 0
    status, out, err = run("diagnose", model, train, "--holdout", other)
    assert status == 0, err
    assert out.startswith("missing: the gear gives way (elastic joint) (elasticity), joint 2")
    (step,) = [line for line in out.splitlines() if line.startswith("next: ")]
    words = shlex.split(step.removeprefix("next: modeler "))
    assert words[:2] == ["add", str(model)] and "elasticity" in words and "--joint" in words
    status, out, err = run(*words)
    assert status == 0, err
    better = Path(words[words.index("--out") + 1])
    elastic = {one["name"]: one for one in json.loads(better.read_text())["fit"]["elastic"]}
    for name, true in (("K2", STIFFNESS), ("D2", DAMPING)):
        assert abs(elastic[name]["value"] - true) < 4.0 * elastic[name]["sigma"], elastic
        assert f"{name} = " in out
    clean = [simulate(run, tmp_path, f"c{k}", k) for k in (1, 3)]
    floor = tmp_path / "floor.json"
    assert run("fit", "demo-arm", clean[0], "--out", floor)[0] == 0
    reached = read_error(run, tmp_path, better, third)
    assert reached < 1.05 * read_error(run, tmp_path, floor, clean[1])
    assert reached < 0.5 * read_error(run, tmp_path, model, third)
    again = run("diagnose", better, train, "--holdout", other)
    assert again[0] == 0 and again[1].startswith("nothing to add")


@pytest.mark.rotating("long tests of diagnose")
@pytest.mark.parametrize("hidden", ["time_delay", "presliding@2", "drive_gain@2", "backlash@3"])
def test_what_is_no_elastic_joint_is_not_named_one(run: Run, tmp_path: Path, hidden: str) -> None:
    train, other = (simulate(run, tmp_path, f"h{k}", k, "--hide", hidden) for k in (1, 2))
    model = tmp_path / "m.json"
    assert run("fit", "demo-arm", train, "--out", model)[0] == 0
    status, _, err = run("diagnose", model, train, "--holdout", other, "--json", tmp_path / "d")
    assert status == 0, err
    effects = json.loads((tmp_path / "d").read_text())["effects"]
    assert not [e for e in effects if e["effect"] == "elasticity" and e["status"] == "confirmed"]
