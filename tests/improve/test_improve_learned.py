"""A law that no catalogue has: learned, held, beside physics; nothing where there is nothing."""

from pathlib import Path

import numpy as np
import pytest

from modeler import api
from modeler.core.errors import DataError
from modeler.diagnosis import LawAsked
from modeler.diagnosis.learn import learn
from modeler.diagnosis.state import SearchData, analysed, state_of
from modeler.estimation.model_file import load_model, save_model
from modeler.observation.log import Log
from modeler.robot.read import robot_from_text
from tests.diagnose.conftest import Case, Run, demonstration, motion, nothing, on_joint, write_csv

SIZE, WHERE, WIDTH = 2.0, 0.6, 0.15  # N m, rad/s


def dip(v: np.ndarray) -> np.ndarray:
    """Friction that is more at one speed."""
    return SIZE * np.sign(v) * np.exp(-(((np.abs(v) - WHERE) / WIDTH) ** 2))


def hidden(log: Log) -> np.ndarray:
    """The same on joint 2."""
    return on_joint(log, 1, dip(motion(log)[1][:, 1]))


@pytest.fixture(scope="module")
def learned(case: Case, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Log, Log]:
    """The folder of a model with the law, and the logs."""
    folder = tmp_path_factory.mktemp("learned")
    fitted, train, holdout = case.hidden(hidden)
    save_model(folder / "arm.json", fitted)
    better = api.add(fitted, "learned", [train], [holdout], joint="2")
    save_model(folder / "better.json", better)
    return folder, train, holdout


@pytest.mark.rotating("long tests of improve")
def test_the_error_falls_and_physics_stays(learned: tuple[Path, Log, Log]) -> None:
    better = load_model(learned[0] / "better.json")
    first, last = better.history
    assert last.error < 0.25 * first.error and last.falls and last.learned and not last.doubt
    assert (last.effect, last.joint) == ("learned_2", "2")
    assert last.moved and max(last.moved.values()) < 2.0
    physics, law = better.fall_shares or (0.0, 0.0)
    assert physics == 0.0 and law == pytest.approx(first.error - last.error)
    (own,) = robot_from_text(better.robot_text, "better").own_effects
    assert own.learned and own.columns[0].equation.law is not None
    size = next(p.value for p in better.fit.parameters if p.name == "Lw2")
    v = np.linspace(-1.0, 1.0, 41)
    law_torque = size * own.columns[0].equation.fold(
        {"v": v, "q": 0 * v, "load": 0 * v}, {"abs": np.abs, "sign": np.sign}, np.pi, float
    )  # its even rest is viscous and Coulomb friction's
    basis = np.column_stack([v, np.sign(v)])
    left = law_torque - dip(v)
    left -= basis @ np.linalg.lstsq(basis, left, rcond=None)[0]
    assert np.sqrt(np.mean(left**2)) < 0.15 * np.sqrt(np.mean(dip(v) ** 2))


def test_emitted_c_is_the_law(learned: tuple[Path, Log, Log]) -> None:
    better = load_model(learned[0] / "better.json")
    compiled = api.recompile(better)
    rng = np.random.default_rng(11)
    q, qd, qdd = rng.uniform(-3.0, 3.0, (3, 200, 3))
    (own,) = robot_from_text(better.robot_text, "better").own_effects
    found = compiled.base_regressor(q, qd, qdd)
    place = [p.name for p in better.fit.parameters].index("Lw2")
    zero = 0 * q[:, 1]
    expected = own.columns[0].equation.fold(
        {"v": qd[:, 1], "q": q[:, 1], "load": zero}, {"abs": np.abs, "sign": np.sign}, 3.14, float
    )
    assert np.abs(found[:, 1, place] - expected).max() < 1e-12 * np.abs(expected).max()
    assert not found[:, [0, 2], place].any()


@pytest.mark.rotating("effects are added to simulated runs")
def test_nothing_is_learned_of_nothing() -> None:
    fitted, train, holdout = demonstration(robot="two-link").hidden(nothing)
    with pytest.raises(DataError, match="learned: nothing is added: no law explains more than"):
        api.add(fitted, "learned", [train], [holdout])


def test_a_law_as_asked(case: Case) -> None:
    fitted, train, _ = case.hidden(hidden)
    compiled = api.recompile(fitted)
    observation = analysed(compiled, [train], fitted.processing)
    state = state_of(SearchData(compiled, observation), (), fitted.beta)
    for asked, equation in (
        (LawAsked(("z",)), "law(z)"),
        (LawAsked(("q", "v")), "law(q, v)"),
        (LawAsked(("v",), odd=True, rising=1), "sign(v)*law(abs(v))"),
    ):
        found = learn(state, 1, asked)
        assert found is not None and found.coordinates.equation == equation
    x = np.linspace(found.law.low[0], found.law.high[0], 500)
    assert np.all(np.diff(found.law(x)) >= -1e-5)  # rounded to six digits
    assert found.law(1e6) == found.law(found.law.high[0])
    assert abs(found.law(x[-1], along=0)) < 1e-9  # it comes to rest at its end


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("learned --joint 9", "--joint 9: no such joint; expected one of"),
        ("learned --joint 2 --of q,v,a", "--of q,v,a: expected one or two quantities, as in q,v"),
        ("learned --joint 2 --of speed", '--of speed: law: columns, xa: got "speed": speed is'),
        ("viscous --of q", "--of, --odd, --monotone: got them with viscous; expected"),
        ("viscous --learned", "--learned: got it with viscous; expected `modeler add MODEL auto`"),
    ],
)
def test_bad_input(arm: Path, run: Run, words: str, told: str, tmp_path: Path) -> None:
    effect, *rest = words.split()
    out = tmp_path / "out.json"
    line = ("add", arm / "m.json", effect, arm / "train.parquet", *rest, "--out", out)
    status, _, err = run(*line)
    assert status == 1 and told in err and err.count("\n") == 1
    assert not out.exists()


@pytest.mark.rotating("effects are added to simulated runs")
def test_auto_says_what_is_physics(tmp_path: Path, run: Run) -> None:
    def both(log: Log) -> np.ndarray:
        q = motion(log)[0]
        return hidden(log) + on_joint(log, 0, 1.5 * np.sin(q[:, 0]) * np.abs(np.sin(q[:, 0])))

    fitted, train, holdout = demonstration(robot="two-link").hidden(both)
    save_model(tmp_path / "arm.json", fitted)
    logs = [write_csv(tmp_path / f"{n}.csv", log) for n, log in (("a", train), ("b", holdout))]
    words = ["add", tmp_path / "arm.json", "auto", logs[0], "--holdout", logs[1], "--learned",
             "--out", tmp_path / "better.json", "--report", tmp_path / "page.html"]  # fmt: skip
    status, printed, _ = run(*words)
    assert status == 0
    assert "learned, not physics" in printed and "points," in printed
    better = load_model(tmp_path / "better.json")
    kinds = [step.learned for step in better.history[1:]]
    assert kinds == sorted(kinds) and any(kinds)  # laws come last
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "learned, not physics" in page and "moved, in their sigmas" in page
