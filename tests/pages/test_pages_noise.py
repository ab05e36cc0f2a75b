"""The noise of the motion as it is reported and drawn: `modeler log`, pages, JSON, model files."""

import json

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from modeler.cli import main
from modeler.core.figure import Curve
from modeler.estimation.model_file import load_model
from modeler.estimation.result import read_fit
from modeler.logs.inspect import inspect_table
from modeler.logs.log_table import LogTable
from modeler.logs.mapping import LogMap, parse_map_options
from modeler.regression.prepare import estimate_position_noise
from modeler.views.log import build_log_page, draw_log_pictures, draw_noise_picture
from tests.logs.writers import parquet
from tests.rotation import with_cases

SIZE = 1e-3  # rad, of white noise
RATE = 500.0


@pytest.fixture(scope="module")
def noisy(tmp_path_factory):
    """A fit and a look at a log whose positions have white noise, as JSON."""
    folder = tmp_path_factory.mktemp("noise")
    run = folder / "fine.parquet"
    words = f"simulate two-link --duration 12 --rate {RATE:g} --seed 4 --out {run}"
    assert main(words.split()) == 0
    table = pq.read_table(run).to_pydict()
    draw = np.random.default_rng(8)
    for name in ("q1", "q2"):
        table[name] = np.array(table[name]) + draw.normal(0.0, SIZE, len(table[name]))
    pq.write_table(pa.table(table), folder / "run.parquet")
    log = str(folder / "run.parquet")
    for name, words in (
        ("fit", ["fit", "two-link", log, "--out", str(folder / "model.json")]),
        ("log", ["log", log]),
        ("log_robot", ["log", log, "--robot", "two-link"]),
    ):
        assert main([*words, "--json", str(folder / f"{name}.json")]) == 0
    return folder


def bands(folder, name):
    return json.loads((folder / f"{name}.json").read_text())["bands"]


def test_the_json_tells_cut_offs_and_noise(noisy):
    result = bands(noisy, "fit")
    assert result["widest_cutoffs"]["parallel_cutoff"] > result["parallel_cutoff"]
    assert result["position_cutoff"] >= 2.0 * result["parallel_cutoff"]
    assert result["limiting_joint"] in ("1", "2") and len(result["reasons"]) >= 2
    assert [entry["joint"] for entry in result["noise"]] == ["1", "2"]
    for item in result["noise"]:
        assert (item["unit"], item["quantity"], item["is_moving"]) == ("rad", "positions", True)
        assert item["density"] == pytest.approx(2.0 * SIZE**2 / RATE, rel=0.4)
        assert item["deviation"] == pytest.approx(SIZE, rel=0.2)
        assert item["band_hz"] < item["noise_crossover_hz"] < 30.0
        assert len(item["frequency"]) == len(item["spectrum"]) > 10
    # no joint's noise makes more torque at the parallel filter than is left of it
    corners = [(local["torque_noise"] / local["noise_torque"]) ** 0.25 for local in result["noise"]]
    assert result["parallel_cutoff"] <= 1.1 * min(corners)


def test_a_log_tells_the_same_with_its_robot_and_the_noise_without(noisy):
    assert bands(noisy, "log_robot") == bands(noisy, "fit")
    alone = bands(noisy, "log")
    assert alone["parallel_cutoff"] is None and alone["reasons"] == []
    densities = [
        [item["density"] for item in values["noise"]] for values in (alone, bands(noisy, "fit"))
    ]
    assert densities[0] == pytest.approx(densities[1], rel=1e-3)


def test_a_model_file_keeps_them_and_old_ones_load(noisy):
    model = load_model(noisy / "model.json")
    raw = json.loads((noisy / "model.json").read_text())["fit"]
    assert json.loads(json.dumps(model.fit.to_json()["bands"])) == bands(noisy, "fit")
    old = read_fit({k: v for k, v in raw.items() if k != "bands"}, model.fit.covariance)
    assert old.bands is None and draw_noise_picture(old.bands) is None


def test_the_picture_crosses_where_the_numbers_say(noisy):
    model = load_model(noisy / "model.json")
    picture = draw_noise_picture(model.fit.bands)
    assert [len(row) for row in picture.panels] == [2, 2]
    for row, item in zip(picture.panels, model.fit.bands.noise, strict=True):
        curves = {s.label: s for s in row[1].series if isinstance(s, Curve)}
        noise, torque = curves["torque of that noise"], curves["noise of the torque"].y[0]
        cross = np.exp(np.interp(np.log(torque), np.log(noise.y), np.log(noise.x)))
        assert cross == pytest.approx((item.torque_noise / item.noise_torque) ** 0.25, rel=1e-6)
        assert curves["parallel filter"].x[0] == model.fit.bands.parallel_cutoff
    limits = [row[1].title for row in picture.panels if "limits" in row[1].title]
    assert limits == [f"Joint {model.fit.bands.limiting_joint}: torques, which limits"]


TIME = np.arange(2000) / 200.0
SWING = np.sin(TIME) + 0.2 * np.sin(4.0 * TIME)
WHITE = np.random.default_rng(2).normal(0.0, 1e-3, len(TIME))


def looked_at(tmp_path, columns, words=()):
    path = parquet(tmp_path / "a.parquet", columns)
    mapping = parse_map_options(words) if words else LogMap()
    return inspect_table(LogTable(path, mapping), mapping)


@pytest.mark.parametrize(("factor", "unit"), [("deg", np.pi / 180.0), ("mm", 1e-3), ("", 1.0)])
def test_units_that_are_stated_are_taken(tmp_path, factor, unit):
    columns = {"t": TIME, "x": (SWING + WHITE) / unit}
    seen = looked_at(tmp_path, columns, ["time=t", f"q1=x{':' * bool(factor)}{factor}"])
    result = estimate_position_noise(seen.positions).joints[0]
    assert result.unit == ("m" if factor == "mm" else "rad")
    assert result.deviation == pytest.approx(1e-3, rel=0.25)


def test_counts_of_an_encoder_stay_counts(tmp_path):
    counts = np.round(1e5 * (SWING + WHITE))
    seen = looked_at(tmp_path, {"time": TIME, "enc1": counts})
    (line,) = estimate_position_noise(seen.positions).format_channels()
    assert "1e+02 counts above" in line and "in steps of 1 counts" in line


@with_cases(
    "columns",
    {"time": TIME, "tau1": SWING},
    {"q1": SWING},
    {"time": TIME, "q1": np.full(len(TIME), np.nan)},
    {"time": TIME[:12], "q1": np.where(np.arange(12) < 11, np.nan, 1.0)},
    {"time": TIME, "q1": np.zeros(len(TIME))},
    {"time": np.zeros(len(TIME)), "q1": SWING},
    ids=["no position", "no clock", "no value", "one value", "at rest", "no time"],
)
def test_where_nothing_can_be_told_nothing_is_drawn(tmp_path, columns):
    seen = looked_at(tmp_path, columns)
    noise = estimate_position_noise(seen.positions)
    assert noise is None or [line.endswith("rests") for line in noise.format_channels()] == [True]
    assert not any(picture.name == "noise_of_the_motion" for picture in draw_log_pictures(seen))
    assert "Noise of the motion" not in [one.title for one in build_log_page(seen, [], []).sections]
