"""Shapes of an effect are sought again with the others in: none is named to mend a bad shape."""

import json
from pathlib import Path

from modeler.cli import main
from tests.rotation import rotating_with


@rotating_with("effects are added")
def test_a_balancing_spring_is_not_mended_by_another(tmp_path: Path) -> None:
    """Of the shoulder's counterbalance; four effects more are missing, friction is known."""
    logs = [str(tmp_path / f"{seed}.parquet") for seed in (1, 2)]
    hide = ("--hide", "counterbalance@2", "--parameter-seed", "77", "--duration", "30")
    for seed, log in enumerate(logs, start=1):
        assert main(["simulate", "demo-arm", *hide, "--seed", str(seed), "--out", log]) == 0
    model, better, told = (str(tmp_path / name) for name in ("m.json", "b.json", "add.json"))
    effects = ("--effects", "viscous,coulomb")
    assert main(["fit", "demo-arm", *effects, logs[0], "--out", model]) == 0
    words = (model, "auto", logs[0], "--holdout", logs[1])
    assert main(["add", *words, "--out", better, "--json", told]) == 0
    found = json.loads(Path(told).read_text())
    added = {(step["effect"], step["joint"]) for step in found["waterfall"]}
    assert ("counterbalance", "2") in added and ("spring", "2") not in added
    assert found["waterfall"][-1]["error"] < 0.002
