"""What the process of the viewer answers, and that process: windows, residuals, kill, memory."""

import asyncio
import dataclasses
import os
import re
import signal
import time
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet
import pytest

from modeler.api import checks, log_windows
from modeler.api.model_on_logs import compute_explained_share
from modeler.api.thresholds import THRESHOLDS
from modeler.cli import main
from modeler.core.errors import DataError, ModelerError
from modeler.core.figure import Curve, Means, thin_curves
from modeler.estimation import load_model
from modeler.regression import LONG
from modeler.studio import viewing
from modeler.studio.processes import Viewer, compute_answer
from tests.coroutines import run_coroutine
from tests.rotation import rotating

HIDDEN = ("--hide", "load_friction@2", "--noise", "0.01", "--duration", "24", "--rate", "250")


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Iterator[Path]:
    """Two runs of an arm with a hidden effect, a model of the first."""
    place = tmp_path_factory.mktemp("viewed")
    before = Path.cwd()
    os.chdir(place)
    try:
        for log, seed in (("a.parquet", "21"), ("b.parquet", "22")):
            assert main(["simulate", "demo-arm", *HIDDEN, "--seed", seed, "--out", log, "-q"]) == 0
        assert main(["fit", "demo-arm", "a.parquet", "--out", "m.json", "-q"]) == 0
        viewing.forget()
        yield place
    finally:
        os.chdir(before)
        viewing.forget()


@pytest.fixture(scope="module")
def comparison(folder: Path) -> Any:
    """That of the command, of the second run."""
    return checks.compare(load_model("m.json"), ["b.parquet"])


# Thinning.


def test_thinning_keeps_every_extreme_and_the_ends() -> None:
    rng = np.random.default_rng(time.time_ns() % 2**32)
    for rows in (1501, 4096, 99_991):
        curves = tuple(rng.normal(size=rows).cumsum() for _ in range(3))
        curves[1][rng.integers(0, rows, rows // 9)] = np.nan
        curves[2][rng.integers(0, rows, 5)] = 1e6
        stored = thin_curves(curves, 1500)
        assert stored.size <= 1500 and stored[0] == 0 and stored[-1] == rows - 1
        assert (np.diff(stored) > 0).all()
        size = -(-rows // (1498 // 6))  # of bins
        for values in curves:
            for start in range(0, rows, size):
                actual = values[start : start + size]
                there = values[stored[(stored >= start) & (stored < start + size)]]
                assert np.nanmax(there) == np.nanmax(actual) and np.nanmin(there) == np.nanmin(
                    actual
                )


# Logs.


@pytest.mark.rotating("long tests of studio")
def test_a_window_of_a_log_has_its_rows_and_its_extremes(folder) -> None:
    table = pyarrow.parquet.read_table("a.parquet")
    clock, q1 = table["time"].to_numpy(), table["q1"].to_numpy()
    facts = viewing.log_facts("a.parquet", robot="")
    assert facts.rows == clock.size and not facts.coarse
    assert (facts.start, facts.end) == (clock[0], clock[-1])
    assert {"q1", "tau3"} <= set(facts.names) and "time" not in facts.names
    x, y = viewing.log_window("a.parquet", ["q1", "nothing"], 2.0, 2.5)["q1"]
    rows = (clock >= 2.0) & (clock <= 2.5)
    assert set(clock[rows]) <= set(x)
    np.testing.assert_array_equal(y[np.isin(x, clock[rows])], q1[rows])
    x, y = viewing.log_window("a.parquet", ["q1"], -np.inf, np.inf)["q1"]
    assert x.size <= THRESHOLDS.curve_points and (y.min(), y.max()) == (q1.min(), q1.max())


@pytest.mark.parametrize("kind", ["parquet", *rotating("csv")])
def test_a_long_log_is_seen_coarsely_then_closely(tmp_path, monkeypatch, kind: str) -> None:
    small = dataclasses.replace(THRESHOLDS, max_whole_values=1)
    monkeypatch.setattr(log_windows, "THRESHOLDS", small)
    place, clock = tmp_path / f"long.{kind}", np.arange(LONG + 40_000) * 1e-3
    q1 = np.sin(0.3 * clock) + 1e-4 * np.random.default_rng(8).normal(size=clock.size)
    q1[clock.size // 3] = 9.0  # a single spike
    columns = {"time": clock, "q1": q1, "tau1": 3.0 * q1}
    if kind == "csv":
        rows = np.column_stack([*columns.values()])
        np.savetxt(place, rows, "%.9g", ",", header=",".join(columns), comments="")
    else:
        pyarrow.parquet.write_table(pa.table(columns), place, row_group_size=64_000)
    facts = viewing.log_facts(str(place))
    assert facts.coarse and facts.rows == clock.size
    assert abs(facts.end - clock[-1]) < 1e-9
    x, y = viewing.log_window(str(place), ["q1"], -np.inf, np.inf)["q1"]
    assert x.size <= THRESHOLDS.curve_points and abs(y.max() - 9.0) < 1e-6  # one row of 290 000
    at = clock[clock.size // 3]
    x, y = viewing.log_window(str(place), ["q1"], at - 0.2, at + 0.2)["q1"]
    rows = np.abs(clock - at) < 0.1905
    inside = np.abs(x - at) < 0.1905
    np.testing.assert_allclose(x[inside], clock[rows], atol=1e-9)
    np.testing.assert_allclose(y[inside], q1[rows], atol=1e-8)
    for ends in ((clock[-1] - 0.3, clock[-1]), (0.0, 0.3)):
        x, _ = viewing.log_window(str(place), ["q1"], *ends)["q1"]
        assert x[0] <= ends[0] + 1e-9 and x[-1] >= ends[1] - 1e-9 and x.size >= 300


def test_a_file_that_went_away_or_changed_is_seen(tmp_path) -> None:
    place = tmp_path / "log.csv"
    text = "time,q1,tau1\n" + "".join(f"{k * 0.01},{k % 7},{k % 5}\n" for k in range(300))
    place.write_text(text)
    assert viewing.log_facts(str(place)).rows == 300
    place.write_text(text + "3.00,1,1\n")
    assert viewing.log_facts(str(place)).rows == 301
    place.unlink()
    with pytest.raises(DataError, match=r"log\.csv: cannot be read .* put the file back"):
        viewing.log_facts(str(place))


# Torques.


@pytest.mark.rotating("long tests of studio")
def test_the_verdict_is_that_of_the_command(folder, capsys) -> None:
    assert main(["compare", "m.json", "b.parquet"]) == 0
    text = capsys.readouterr().out
    result = viewing.verdict("m.json", ["b.parquet"])
    assert result.joints == ("1", "2", "3")
    assert all(sentence in text for sentence in result.sentences)
    assert max(zip(result.errors, result.joints, strict=True))[1] == "2"  # the hidden effect's
    assert {"velocity", "position", "acceleration", "load", "travel", "time", "qc1"} <= {
        channel for channel, _ in result.channels
    }


def test_a_joint_that_rests_is_not_judged(folder, tmp_path) -> None:
    table = pyarrow.parquet.read_table("b.parquet")
    rest = pa.array(np.full(table.num_rows, 0.3))
    place = str(tmp_path / "rest.parquet")
    pyarrow.parquet.write_table(table.set_column(table.column_names.index("q3"), "q3", rest), place)
    result = viewing.verdict("m.json", [place])
    assert result.joints == ("1", "2")
    assert result.unjudged[0].startswith("Joint 3: not judged: ")


def test_torques_are_those_of_the_comparison(comparison) -> None:
    p = comparison.prediction
    picture = viewing.torque_picture(["m.json"], ["b.parquet"], "2", 3.0, 8.0)
    above, below = (row[0] for row in picture.panels)
    rows = (p.time >= 3.0) & (p.time <= 8.0)
    for curve, values in zip(above.series, (p.measured, p.predicted), strict=True):
        assert isinstance(curve, Curve)
        there = np.isfinite(curve.y)
        np.testing.assert_allclose(curve.y[there], values[rows, 1], rtol=1e-12)
    left = below.series[0]
    assert isinstance(left, Curve)
    expected = np.where(p.used, p.measured - p.predicted, np.nan)[rows, 1]
    finite = (values[np.isfinite(values)] for values in (left.y, expected))
    np.testing.assert_allclose(*finite, rtol=1e-9)
    assert above.x_range is not None and 3.0 <= above.x_range[0] < above.x_range[1] <= 8.0
    assert {span.label for span in above.spans} == {span.label for span in below.spans}


@pytest.mark.parametrize("channel", ["velocity", "load", "qc3"])
def test_the_residual_over_a_channel_is_that_of_numpy(comparison, channel: str) -> None:
    """Means of bins of the same samples, counted anew."""
    p = comparison.prediction
    table = pyarrow.parquet.read_table("b.parquet")
    x = {
        "velocity": p.qd[:, 1],
        "load": np.abs(p.predicted[:, 1]) * np.sign(p.qd[:, 1]),
        "qc3": np.interp(p.time, table["time"].to_numpy(), table["qc3"].to_numpy()),
    }[channel][p.used[:, 1]]
    e = (p.measured - p.predicted)[p.used[:, 1], 1]
    series = viewing.residual_picture(["m.json"], ["b.parquet"], "2", channel).panels[0][0].series
    samples, means = series
    np.testing.assert_allclose(np.sort(samples.x), np.sort(x), rtol=1e-12)
    assert isinstance(means, Means)
    edges = np.unique(
        np.concatenate(
            [np.linspace(x.min(), x.max(), 13), np.quantile(x, np.linspace(0.0, 1.0, 13))]
        )
    )
    expected = []
    for low, high in pairwise(edges):
        actual = (x >= low) & ((x < high) | ((high == edges[-1]) & (x <= high)))
        if actual.sum() >= 8:
            expected.append((x[actual].mean(), e[actual].mean()))
    np.testing.assert_allclose(np.column_stack([means.x, means.y]), expected, rtol=1e-9)


def test_explained_shares_are_those_of_what_was_put_in() -> None:
    rng = np.random.default_rng(time.time_ns() % 2**32)
    n = 20_000
    x, noise = rng.uniform(-1.0, 1.0, n), rng.normal(size=n)
    assert compute_explained_share(x, noise) < 0.01
    signal = np.where(x > 0.0, 1.0, -1.0)  # of variance 1, as the noise
    assert abs(compute_explained_share(x, signal + noise) - 0.5) < 0.03
    assert abs(compute_explained_share(np.sign(x), signal + noise) - 0.5) < 0.03  # two values
    assert np.isnan(compute_explained_share(np.ones(n), noise)) and np.isnan(
        compute_explained_share(x[:9], x[:9])
    )
    slow = np.convolve(noise, np.ones(500), "same")  # remembers: no function of a slow channel
    assert compute_explained_share(np.arange(n) * 1e-3, slow) < 0.1


def test_the_map_shows_which_joint_follows_what(comparison) -> None:
    """As the command says it where it does, of the columns of the log besides."""
    heat = viewing.where_picture("m.json", ["b.parquet"]).panels[0][0].series[0]
    assert heat.rows == ("1", "2", "3") and "qc3" in heat.columns
    for item, values in zip(comparison.joints, heat.values, strict=True):
        assert item.structure is not None
        for name in ("velocity", "load", "time"):
            share = values[heat.columns.index(name)]
            np.testing.assert_allclose(share, 100.0 * item.structure.get_share(name))
        assert 0.0 <= values[heat.columns.index("qc3")] <= 100.0
    load = heat.values[:, heat.columns.index("load")]
    assert load.argmax() == 1 and load[1] > 20.0  # the hidden effect's


def test_poses_and_errors_by_log(folder) -> None:
    clock, q = viewing.poses("m.json", ["a.parquet", "b.parquet"])
    assert set(q) == {"1", "2", "3"} and (np.diff(clock) >= 0.0).all()
    errors = viewing.log_errors("m.json", ["a.parquet", "b.parquet"])
    assert [name for name, _, _ in errors] == ["a.parquet", "b.parquet"]
    for _, whole, by_joint in errors:
        assert min(by_joint.values()) <= whole <= max(by_joint.values())
    picture = viewing.residual_picture(["m.json"], ["a.parquet", "b.parquet"], "2", "load", True)
    names = [series.label.split()[0] for series in picture.panels[0][0].series]
    assert names == ["a.parquet"] * 2 + ["b.parquet"] * 2


# The process.


def test_the_viewer_drops_stale_questions_and_starts_again_after_a_kill(folder) -> None:
    async def beat(beats: list[float]) -> None:
        while True:
            beats.append(time.monotonic())
            await asyncio.sleep(0.01)

    async def ask_all() -> None:
        beats: list[float] = []
        viewer, heart = Viewer(folder, (folder,)), asyncio.create_task(beat(beats))
        try:
            window = ("log_window", "a.parquet", ["q1"], 0.0)
            asks = [viewer.ask(*window, float(end), kind="zoom") for end in range(1, 7)]
            answers = await asyncio.gather(viewer.ask("verdict", "m.json", ["b.parquet"]), *asks)
            assert answers[0].joints == ("1", "2", "3")
            assert answers[1:-1] == [None] * 5 and answers[-1]["q1"][0][-1] >= 6.0
            assert len(beats) > 20  # the loop went on while the process started and predicted
            for file, why in (
                ("none.parquet", r"none\.parquet: cannot be read"),
                (__file__, "outside the folders"),
            ):
                with pytest.raises(ModelerError, match=why):
                    await viewer.ask("log_facts", file)
            facts, old = await viewer.ask("log_facts", "a.parquet"), [*viewer._pool._processes]
            os.kill(old[0], signal.SIGKILL)
            assert await viewer.ask("log_facts", "a.parquet") == facts
            assert [*viewer._pool._processes] != old
        finally:
            heart.cancel()
            viewer.end()

    run_coroutine(ask_all())


@pytest.mark.parametrize("error", [MemoryError(), RuntimeError("OpenBLAS: Cannot allocate memory")])
def test_memory_that_runs_out_is_one_line(monkeypatch, error: Exception) -> None:
    def hungry(*arguments: Any) -> None:
        raise error

    monkeypatch.setattr(viewing, "log_facts", hungry)
    with pytest.raises(DataError, match=r"memory ran out .* shorter stretch"):
        compute_answer("log_facts", ("a",))


@pytest.mark.rotating("long tests of studio")
def test_a_log_that_is_called_differently_is_judged_as_the_command_judges_it(folder: Path) -> None:
    table = pa.parquet.read_table("b.parquet")
    names = [name.replace("tau", "effort_") for name in table.column_names]
    names = [re.sub(r"^q(\d)$", r"joint_pos_\1", name) for name in names]
    pa.parquet.write_table(table.rename_columns(names), "other.parquet")
    with pytest.raises(DataError, match="no column"):
        viewing.verdict("m.json", ["other.parquet"])
    result = viewing.verdict("m.json", ["other.parquet", "--map", "auto"])
    assert result.errors == viewing.verdict("m.json", ["b.parquet"]).errors
