"""`md.identify` and the model as one object, against statistics and the stages behind it."""

import dataclasses
import pickle
import re
import shutil
from pathlib import Path
from statistics import NormalDist

import numpy as np
import pytest

import modeler as md
from modeler.core.errors import DataError, ManifestError, RobotError
from tests.rotation import with_cases

HIDDEN = "load_friction@2"


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three runs of the demo arm, whose second joint rubs with the load."""
    folder = tmp_path_factory.mktemp("runs")
    for seed, name in enumerate(("mon.parquet", "tue.csv", "wed.parquet"), start=31):
        robot = md.open_robot("demo-arm")
        md.simulate(robot, folder / name, hide=[HIDDEN], duration=6.0, rate=250.0, seed=seed)
    return folder


@pytest.fixture(scope="module")
def logs(place: Path) -> list[str]:
    return [str(place / "mon.parquet"), str(place / "tue.csv")]


@pytest.fixture(scope="module")
def model(place: Path, logs: list[str]) -> md.Model:
    return md.identify("demo-arm", logs, place / "wed.parquet")


@pytest.mark.rotating("long tests of api")
def test_a_parameter_has_value_sigma_unit_interval_and_sum(model: md.Model) -> None:
    k = [p.name for p in model.fit.parameters].index("ZZ1R")
    result = model["ZZ1R"]
    assert (result.value, result.unit) == (model.beta[k], "kg m2")
    assert result.sigma == pytest.approx(model.covariance[k, k] ** 0.5)
    for level in (0.5, 0.95, 0.999):
        normal = NormalDist(result.value, result.sigma)
        expected = (normal.inv_cdf((1.0 - level) / 2.0), normal.inv_cdf((1.0 + level) / 2.0))
        assert result.conf_int(level) == pytest.approx(expected, rel=1e-9)
        np.testing.assert_allclose(model.conf_int(level).loc["ZZ1R"], expected)
    assert float(result) == result.value and "+-" in repr(result) and "kg m2" in repr(result)
    # what it is the sum of is the relation of the derivation
    text = md.derive(md.open_robot("demo-arm")).relations.text
    assert result.relation in re.sub(r" +", " ", text)
    assert model["Fv3"].relation == "" and "Fv3" in model and "ZZ2" not in model


@pytest.mark.rotating("long tests of api")
def test_a_lopsided_interval_stays_lopsided(model: md.Model) -> None:
    one = dataclasses.replace(model["Fv1"], value=2.0, sigma=1.0, interval=(1.0, 6.0))
    assert one.conf_int() == pytest.approx((1.0, 6.0))
    low, high = one.conf_int(0.5)
    assert (2.0 - low) * 4.0 == pytest.approx(high - 2.0)
    aside = dataclasses.replace(one, sigma=None, status="set aside")
    assert np.isnan(aside.conf_int()).all() and "not identifiable" in repr(aside)


@with_cases(
    "name, message",
    ("ZZ2", r"fix no value of ZZ2 alone; ZZ2R = ZZ2 \+ .* holds it: ask for .*ZZ2R"),
    ("M3", r"ZZ1R = .* holds it \(XX2R, ZZ2R, MX2R hold it too\)"),
    ("XX1", "XX1 has no effect on any torque of demo-arm, so no log shows it"),
    ("Fs22", r'no such parameter \(did you mean "Fs2'),
)
def test_who_asks_for_what_is_not_told_alone_learns_what_holds_it(model, name, message):
    with pytest.raises(DataError, match=message) as error:
        model[name]
    assert str(error.value).startswith(f'model["{name}"]: ') and "\n" not in str(error.value)


def test_the_habits_of_statsmodels(model: md.Model) -> None:
    names = [p.name for p in model.fit.parameters]
    assert list(model.params.index) == list(model.bse.index) == names
    np.testing.assert_array_equal(model.params, model.beta)
    np.testing.assert_allclose(model.bse, np.sqrt(np.diag(model.cov_params())))
    assert model.cov_params().loc["Fv1", "Fs1"] == model.covariance[1, 2]
    assert list(model.conf_int().columns) == ["lower", "upper"]
    assert model.nobs == np.isfinite(model.resid).to_numpy().sum() == model.fit.rows
    assert "relative error" in model.summary()
    with pytest.raises(DataError, match=r"conf_int: got 0.05; expected the level .* 0.95 for 95 %"):
        model.conf_int(0.05)
    with pytest.raises(TypeError):
        list(model)  # type: ignore[call-overload]


def test_residuals_are_those_of_the_fit(model: md.Model) -> None:
    left, fitted = model.resid, model.fittedvalues
    assert list(left.columns) == ["tau1", "tau2", "tau3"]
    assert list(left.index.levels[0]) == ["mon.parquet", "tue.csv"]
    for joint in model.fit.joints:
        actual = left[f"tau{joint.name}"].dropna()
        assert np.sqrt(np.mean(actual**2)) == pytest.approx(joint.rms, rel=1e-9)
        measured = actual + fitted[f"tau{joint.name}"].dropna()
        error = np.linalg.norm(actual) / np.linalg.norm(measured)
        assert error == pytest.approx(joint.relative_error, rel=1e-9)


def test_without_pandas_it_is_dicts(model: md.Model, monkeypatch: pytest.MonkeyPatch) -> None:
    expected = model.resid["tau2"].to_numpy()
    monkeypatch.setitem(__import__("sys").modules, "pandas", None)
    assert model.params["Fs2"] == model["Fs2"].value
    assert model.cov_params()["Fs2"].shape == model.beta.shape
    assert {*model.resid} == {"log", "time", "tau1", "tau2", "tau3"}
    np.testing.assert_array_equal(model.resid["tau2"], expected)


@pytest.mark.slow  # some seconds
def test_errors_and_what_is_missing(model: md.Model, place: Path, logs: list[str]) -> None:
    held = str(place / "wed.parquet")
    assert model.error() == model.error(held) == md.compare(model, [held]).relative_error
    assert model.compare(held).to_dict() == md.compare(model, [held]).to_dict()
    result = model.missing()
    assert result.to_dict() == md.diagnose(model, logs, [held]).to_dict()
    assert (result.effects[0].effect, result.effects[0].joint) == ("load_friction", "2")
    better = model.add("load_friction", joint=2)
    assert isinstance(better, md.Model) and better.held_out == model.held_out
    assert better.error() < 0.5 * model.error()
    assert better.history[-1].held_out_logs == ("wed.parquet",)
    auto = model.add("auto", held_out=held)
    assert [s.effect for s in auto.history] == [s.effect for s in better.history]
    assert md.remove_last(better, logs).beta == pytest.approx(model.beta)
    assert isinstance(md.reduced_model(better), md.Model)


def test_it_is_saved_opened_and_finds_its_logs_beside_it(place, tmp_path, monkeypatch):
    """Paths are relative to the folder of work, and to that of the model file."""
    shutil.copy(place / "mon.parquet", tmp_path)
    monkeypatch.chdir(tmp_path)
    made = md.identify("demo-arm", "mon.parquet@0:5")
    assert made.logs[0].path == "mon.parquet@0:5"
    made.save("arm.json")
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    again = md.load("../arm.json")
    assert isinstance(again, md.Model) and repr(again) == repr(made)
    assert again.resid.equals(made.resid)
    with pytest.raises(DataError, match=r"error: no logs were held out; give some: error\(logs\)"):
        again.error()
    log = tmp_path / "mon.parquet"
    shutil.copy(place / "wed.parquet", log)
    changed = "missing: mon.parquet@0:5 has changed since it was fitted; give the logs of the fit"
    with pytest.raises(DataError, match=re.escape(changed)):
        md.load("../arm.json").missing()
    log.unlink()
    with pytest.raises(DataError, match=r"add: mon.parquet@0:5 is not there any more; .*logs=\["):
        again.add("spring")
    moved = again.add("spring", 1, logs=str(place / "mon.parquet"))
    assert moved.logs[0].path == str(place / "mon.parquet")


def test_load_opens_by_what_is_in_the_file(model: md.Model, tmp_path: Path) -> None:
    for name in ("arm.model", "arm", "arm.toml"):
        assert md.load(md.save(model, tmp_path / name)).params.equals(model.params)
    robot = md.load("two-link")
    (tmp_path / "robot.json").write_text(robot.text)
    for place in (md.load(robot.save(tmp_path / "r.toml")), md.load(tmp_path / "robot.json")):
        assert place.text == robot.text
    (tmp_path / "x").write_text('{"kind": "other"}')
    with pytest.raises(ManifestError, match="JSON, but not a model file"):
        md.load(tmp_path / "x")
    for nothing in (tmp_path / "none", tmp_path):
        with pytest.raises(RobotError, match=re.escape(str(nothing))):
            md.load(nothing)


def test_it_remembers_frames_while_it_lives(logs: list[str]) -> None:
    pandas = pytest.importorskip("pandas")
    frame = pandas.read_parquet(logs[0])
    made = md.identify("demo-arm", frame)
    assert made.logs[0].path == "" and made.logs[0].name.startswith("frame ")
    assert made.resid.equals(pickle.loads(pickle.dumps(made)).resid)
    better = made.add("load_friction", 2)
    assert better.resid.shape == made.resid.shape
    gone = dataclasses.replace(made, in_memory_logs=())
    with pytest.raises(DataError, match=r"resid: frame \w+ was no file, .* `compare.logs.` takes"):
        _ = gone.resid
    assert gone.error(frame) == made.error(frame)


@pytest.mark.slow  # some seconds
def test_effects_method_and_options_of_the_robot_file(logs: list[str], tmp_path: Path) -> None:
    bare = md.identify("demo-arm", logs, effects="viscous,coulomb")
    assert not {"Off1", "Ia3"} & {*bare.params.index}
    same = md.identify("demo-arm", logs, effects={"viscous": "all", "coulomb": ["1", "2"]})
    assert "Fs3" not in same and "Fv3" in same
    with pytest.raises(RobotError, match=r'effects: got viscus \(did you mean "viscous'):
        md.identify("demo-arm", logs, effects=["viscus"])
    stated = tmp_path / "arm.toml"
    stated.write_text(md.open_robot("demo-arm").text + '\n[fit]\nmethod = "robust"\n')
    assert md.identify(stated, logs[0]).fit.method == "robust"
    assert md.identify(stated, logs[0], method="ordinary").fit.method == "ordinary"
    with pytest.raises(DataError, match=r"method tls needs .* load=Load\(logs, mass\)"):
        md.identify("demo-arm", logs, method="tls")


@pytest.mark.rotating("long tests of api")
def test_logs_with_a_load_are_not_taken_for_bare_ones() -> None:
    robot = md.open_robot("two-link")
    bare = md.simulate(robot, duration=4.0, seed=61)
    loaded = md.simulate(robot, duration=4.0, seed=62, hide=["payload"])
    made = md.identify(robot, bare, load=md.Load(loaded, mass=None))
    true = {effect.effect: effect.values for effect in loaded.truth.hidden_effects}["payload"]
    assert made["M2_load"].value == pytest.approx(true["mass"], rel=0.05)
    for act in (made.missing, lambda: made.add("spring"), lambda: made.resid):
        with pytest.raises(DataError, match="some logs of the fit carried a load, which is no p"):
            act()
    assert not made.missing(logs=bare).effects
