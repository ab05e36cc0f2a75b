"""Frames, dicts and paths alike: the same numbers in, and out in the names and units of the log."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pytest

import modeler as md
from modeler.api.workflow import convert_to_list
from modeler.core.errors import DataError
from tests.modules import compiled
from tests.rotation import rotating
from tests.texts import read_pairs
from tests.when_used import WhenUsed

pandas = WhenUsed("pandas")
polars = WhenUsed("polars")

ODD = {"time": "t_ms", "q1": "a", "q2": "b", "tau1": "moment_a", "tau2": "moment_b"}
MAPPING = {
    "time": "t_ms [ms]",
    "q1": {"column": "a", "unit": "deg", "sign": -1},
    "q2": "b",
    "tau1": {"column": "moment_a", "unit": "mN m", "sign": -1, "offset": 250.0},
    "tau2": {"column": "moment_b", "scale": 0.5},
}


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("run") / "run.parquet"
    md.simulate(md.open_robot("two-link"), place, duration=5.0, rate=500.0, seed=41)
    return place


@pytest.fixture(scope="module")
def frame(run: Path) -> Any:
    return pandas.read_parquet(run)[["time", "q1", "q2", "tau1", "tau2"]]


@pytest.fixture(scope="module")
def model(run: Path) -> md.Model:
    return md.identify("two-link", run)


def odd(frame: Any) -> Any:
    """The same log in names and units of its own."""
    made = frame.rename(columns=ODD)
    made["t_ms"] *= 1e3
    made["a"] *= -180.0 / np.pi
    made["moment_a"] = -1e3 * made["moment_a"] - -1.0 * -250.0 * -1.0
    made["moment_b"] *= 2.0
    return made


def arrays(frame: Any) -> dict[str, np.ndarray]:
    columns = {name: frame[name].to_numpy() for name in frame}
    return {
        "time": columns["time"],
        "q": np.column_stack([columns["q1"], columns["q2"]]),
        "tau": np.column_stack([columns["tau1"], columns["tau2"]]),
    }


KINDS: dict[str, Callable[[Any], Any]] = {
    "pandas": lambda f: f,
    "pandas by time": lambda f: f.set_index("time"),
    "polars": lambda f: polars.from_pandas(f),
    "Arrow": pa.table,
    "dict of columns": lambda f: {name: f[name].to_numpy() for name in f},
    "dict of lists": lambda f: {name: list(f[name]) for name in f},
    "dict of series": dict,
    "dict of arrays": arrays,
}


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_is_the_same_log_and_predicted_in_its_own_kind(kind, model, run, frame):
    inputs = KINDS[kind](frame)
    (file,), (log,) = (
        md.read_logs(compiled("two-link"), convert_to_list(one)) for one in (run, inputs)
    )
    for name in ("time", "q", "tau"):
        np.testing.assert_array_equal(getattr(log, name), getattr(file, name))
    assert log.content == file.content and log.path == ""
    assert log.name == f"frame {file.content[:6]}"
    expected, predicted = model.predict(run), model.predict(inputs)
    assert type(predicted) is (dict if isinstance(inputs, dict) else type(inputs))
    if kind.startswith("pandas"):
        assert predicted.index.equals(inputs.index)
    if kind == "dict of arrays":
        assert {*predicted} == {"tau"}
        np.testing.assert_array_equal(predicted["tau"], expected)
    else:
        for name in ("tau1", "tau2"):
            np.testing.assert_array_equal(np.asarray(predicted[name]), expected[name])


def test_the_prediction_is_the_models_torque_of_the_motion(model: md.Model, frame: Any) -> None:
    """Of a smooth motion given with its derivatives: by the equation of the arm, row for row."""
    time = np.linspace(0.0, 4.0, 2001)
    amplitude, pulse = np.array([0.6, 0.9]), np.array([3.1, 4.7])
    angle = pulse * time[:, None]
    q, qd, qdd = (
        amplitude * pulse**k * f
        for k, f in enumerate((np.sin(angle), np.cos(angle), -np.sin(angle)))
    )
    predicted = model.predict({"time": time, "q": q, "qd": qd, "qdd": qdd})
    expected = md.compile(model).inverse_dynamics(q, qd, qdd, model.beta)
    sure = np.isfinite(predicted["tau"])
    assert sure.mean() > 0.95
    bound = 2e-3 * np.abs(expected).max(axis=0)
    still = np.abs(qd) > 0.2  # beside reversals the sign of the speed may differ by a sample
    assert (np.abs(predicted["tau"] - expected) < bound)[sure & still].all()


def test_positions_alone_are_enough_and_torques_are_not_read(model: md.Model, frame: Any) -> None:
    expected = model.predict(frame)
    alone = model.predict(frame.drop(columns=["tau1", "tau2"]))
    wrong = model.predict(frame.assign(tau1=np.nan, tau2=7.0))
    for predicted in (alone, wrong):
        assert list(predicted.columns) == ["tau1", "tau2"] and predicted.equals(expected)
    late = model.predict(frame.assign(tau2=np.roll(frame["tau2"], 5)))
    assert late.equals(expected)


def test_names_and_units_are_kept_out_again(frame: Any, model: md.Model, tmp_path: Path) -> None:
    known = odd(frame)
    made = md.identify("two-link", known, mapping=MAPPING)
    np.testing.assert_allclose(made.beta, model.beta, rtol=1e-6)
    expected = odd(pandas.concat([frame[["time", "q1", "q2"]], model.predict(frame)], axis=1))
    predicted = made.predict(known)  # by the mapping that it keeps
    assert list(predicted.columns) == ["moment_a", "moment_b"]
    np.testing.assert_allclose(predicted, expected[["moment_a", "moment_b"]], rtol=1e-5, atol=1e-2)
    again = md.load(made.save(tmp_path / "odd.json"))
    assert again.predict(known).equals(predicted) and again.error(known) == made.error(known)
    known.to_csv(tmp_path / "odd.csv", index=False)
    read = again.predict(tmp_path / "odd.csv")
    assert read.index.name == "time" and list(read.columns) == ["moment_a", "moment_b"]
    np.testing.assert_allclose(read, predicted, rtol=1e-6)


def test_the_guess_is_made_of_frames_too(frame: Any, model: md.Model) -> None:
    names = read_pairs("time t q1 joint1_pos q2 joint2_pos tau1 joint1_torque tau2 joint2_torque")
    made = md.identify("two-link", frame.rename(columns=names), mapping="auto")
    np.testing.assert_allclose(made.beta, model.beta, rtol=1e-9)
    assert made.mapping["q<j>"] == "joint{j}_pos"


def test_currents_come_out_as_currents(tmp_path: Path) -> None:
    text = md.open_robot("two-link").text + "\n[drive_gains]\n1 = 12.5\n2 = -4.0\n"
    (tmp_path / "arm.toml").write_text(text)
    robot = md.open_robot(tmp_path / "arm.toml")
    md.simulate(robot, tmp_path / "run.parquet", duration=4.0, seed=4)
    inputs = pandas.read_parquet(tmp_path / "run.parquet")
    inputs["current1"], inputs["current2"] = inputs.pop("tau1") / 12.5, inputs.pop("tau2") / -4.0
    predicted = md.identify(robot, inputs).predict(inputs)
    assert list(predicted.columns) == ["current1", "current2"]
    measured = inputs[predicted.columns]
    assert ((measured - predicted).std() < 0.1 * measured.std()).all()


@pytest.mark.parametrize("kind", ["index", *rotating("UTC", "since", "Polars", "dict")])
def test_dates_are_times(kind: str, frame: Any, model: md.Model) -> None:
    since = pandas.to_timedelta(frame["time"], unit="s")
    at = pandas.Timestamp("2024-05-01T12:00:00") + since
    known = frame.assign(time={"since": since, "UTC": at.dt.tz_localize("UTC")}.get(kind, at))
    if kind == "index":
        known = known.set_index("time").rename_axis(None)
    known = polars.from_pandas(known) if kind == "Polars" else known
    known = {n: known[n].to_numpy() for n in known} if kind == "dict" else known
    made = md.identify("two-link", known)
    np.testing.assert_allclose(made.beta, model.beta, rtol=1e-4, atol=1e-6)
    assert len(made.predict(known)["tau1"]) == len(frame)


def test_a_piece_of_a_file(model: md.Model, run: Path) -> None:
    whole, part = model.predict(run), model.predict(f"{run}@1:2")
    assert part.index[0] == 1.0 and len(part) == 500
    middle = part.dropna().index[100:-100]
    np.testing.assert_allclose(part.loc[middle], whole.loc[middle], rtol=1e-4, atol=1e-3)


WRONG: dict[str, tuple[Callable[[Any], Any], str]] = {
    "a number": (lambda f: {**arrays(f), "q": 3}, "got int as q; expected an array of numbers"),
    "objects": (lambda f: {**arrays(f), "q": [{}, {}]}, "got list as q; expected an array of num"),
    "no position": (lambda f: f.drop(columns="q2"), "logs.0.: no column q2"),
    "series": (lambda f: f["q1"], r"logs.0.: this frame has columns that Arrow does not know"),
    "mixed": (lambda f: f.assign(q1=["x", 1.0] * (len(f) // 2)), "columns that Arrow does not kno"),
    "text": (lambda f: f.assign(q1="x"), 'column q1, row 1: got "x"; expected a number'),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_is_no_log_is_refused_in_one_line(case: str, frame: Any) -> None:
    make, message = WRONG[case]
    with pytest.raises(DataError, match=message):
        md.identify("two-link", make(frame))
