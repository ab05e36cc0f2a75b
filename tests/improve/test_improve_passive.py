"""Friction of joints without motor: robot files may have it, and so may `modeler add --joint`."""

from pathlib import Path

import pytest

from modeler.estimation.model_file import load_model
from tests.diagnose.conftest import Run, made
from tests.rotation import rotating_with

HIDDEN = ("five-bar", "--hide", "passive_friction@21", "--duration", "8", "--rate", "250")


@pytest.fixture(scope="module")
def loops(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with logs of a robot that rubs in a joint without motor, and a model without."""
    folder = tmp_path_factory.mktemp("loops")
    for name, seed in (("train", "1"), ("other", "2")):
        made("simulate", *HIDDEN, "--seed", seed, "--out", folder / f"{name}.parquet")
    made("fit", "five-bar", folder / "train.parquet", "--out", folder / "m.json")
    return folder


@rotating_with("effects are added")
def test_viscous_and_coulomb_one_after_the_other(loops: Path, run: Run, tmp_path: Path) -> None:
    logs = (loops / "train.parquet", "--holdout", loops / "other.parquet")
    one, two, robot = tmp_path / "1.json", tmp_path / "2.json", tmp_path / "r.toml"
    status, _, err = run("add", loops / "m.json", "viscous", "--joint", "21", *logs, "--out", one)
    assert (status, err) == (0, "")
    line = ("add", one, "coulomb", "--joint", "21", *logs, "--out", two, "--robot-out", robot)
    status, out, _ = run(*line)
    assert status == 0 and "coulomb, joint 21: the held-out error falls: joint 11" in out
    text = robot.read_text(encoding="utf-8")
    assert 'viscous = ["21"]' in text and 'coulomb = ["21"]' in text
    error = load_model(two).history[-1].error
    both = tmp_path / "both.json"
    line = ("add", loops / "m.json", "passive_friction", "--joint", "21", *logs, "--out", both)
    assert run(*line)[0] == 0
    assert load_model(both).history[-1].error == pytest.approx(error, rel=1e-3)


REFUSED = {
    "there already": ("viscous --joint 21", "viscous: joint 21 has it in this model already"),
    "shapes": ("stribeck --joint 21", "--joint 21: it has no motor, and there stribeck cannot be"),
    "no such joint": ("viscous --joint 7", "no such joint; expected one of 11, 12, 21, 22"),
}


@pytest.mark.parametrize("mistake", REFUSED)
def test_what_cannot_be_there_is_refused(
    loops: Path, run: Run, tmp_path: Path, mistake: str
) -> None:
    words, message = REFUSED[mistake]
    train, model = loops / "train.parquet", loops / "m.json"
    if mistake == "there already":
        model = tmp_path / "rubs.json"
        line = ("add", loops / "m.json", *words.split(), train, "--out", model)
        assert run(*line)[0] == 0
    status, out, err = run("add", model, *words.split(), train, "--out", tmp_path / "m2.json")
    assert (status, out) == (1, "") and err.count("\n") == 1 and message in err
