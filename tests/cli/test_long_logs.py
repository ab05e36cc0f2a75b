"""`modeler fit` of logs that are read in chunks: same numbers, reported in lines and JSON."""

import dataclasses
import json
import re
import subprocess
import sys

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet
import pytest

from modeler import regression, validation
from modeler.api import log_maps
from modeler.cli import main
from modeler.estimation import stream_logs
from modeler.validation import compare_long_logs
from tests.cli.running import complaint, run
from tests.modules import compiled
from tests.rotation import slow_rotating, with_cases

ROWS = 9000


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A folder with one motion of a two-link arm, as Parquet and as CSV."""
    model = compiled("two-link")
    random = np.random.default_rng(4)
    time = np.arange(ROWS) * 5e-3
    w = 2.0 * np.pi * random.uniform(0.1, 0.5, (3, 2))
    angle = time[:, None, None] * w + random.uniform(0.0, 6.0, w.shape)
    q, qd, qdd = (np.sin(angle).sum(1), (w * np.cos(angle)).sum(1), -(w**2 * np.sin(angle)).sum(1))
    beta = random.uniform(0.5, 2.0, len(model.spec.base))
    tau = model.inverse_dynamics(q, qd, qdd, beta) + random.normal(scale=0.05, size=q.shape)
    q = q + random.normal(scale=1e-5, size=q.shape)
    columns = {"time": time, "q1": q[:, 0], "q2": q[:, 1], "tau1": tau[:, 0], "tau2": tau[:, 1]}
    folder = tmp_path_factory.mktemp("long")
    table = pa.table(columns)
    pa.parquet.write_table(table, folder / "run.parquet", row_group_size=1500)
    pa.csv.write_csv(table, folder / "run.csv")
    return folder


@pytest.fixture
def chunked(monkeypatch):
    """Logs of some thousand rows are long."""
    survey = sys.modules["modeler.regression.survey"]
    for where in (regression, regression.log, log_maps, survey):
        monkeypatch.setattr(where, "LONG", 4000)
    for where in (regression.log, log_maps, survey):
        monkeypatch.setattr(where, "FINGER", 1024)
    monkeypatch.setattr(log_maps, "WINDOW", 900)
    monkeypatch.setattr(compare_long_logs, "__defaults__", (lambda share: None, 1024))
    monkeypatch.setattr(stream_logs, "__defaults__", (None, lambda share: None, 1024, None))


def fitted(place, name, *options):
    words = f"fit two-link {place}/run.parquet --out {place}/{name}.json --json {place}/{name}.fit"
    assert main([*words.split(), *options]) == 0
    return json.loads((place / f"{name}.fit").read_text())


def test_a_long_log_is_fitted_in_chunks(place, chunked, monkeypatch, capsys):
    """Fingerprint, rows and span of a log in chunks are those of the log read whole."""
    fit = fitted(place, "chunked")
    out = capsys.readouterr().out
    chunks = fit["reading"]["chunks"]
    assert 2 <= chunks <= 9 and fit["reading"]["passes"] == 1
    assert f"all {ROWS} rows are read once, in {chunks} chunks" in out
    assert "9000 rows at 200 Hz" in out
    monkeypatch.setattr(regression, "LONG", 10**9)
    whole = fitted(place, "whole")
    assert not whole["reading"]
    for one, other in zip(fit["parameters"], whole["parameters"], strict=True):
        # rows lie elsewhere between the samples
        assert abs(one["value"] - other["value"]) < 3.0 * other["sigma"]
    assert fit["verdict"] == whole["verdict"] or fit["valid"] == whole["valid"]
    logs = [json.loads((place / f"{n}.json").read_text())["logs"][0] for n in ("chunked", "whole")]
    one, other = ({k: log[k] for k in ("rows", "fingerprint", "start", "end")} for log in logs)
    assert one == other


def test_a_log_given_twice_is_refused(place, chunked, capsys):
    words = ("fit", "two-link", place / "run.parquet", place / "run.csv", "--out", place / "m.json")
    assert "run.csv: got rows of run.parquet again" in complaint(capsys, *words)


def test_a_method_that_needs_all_rows_reads_them_or_says_that_they_are_too_many(
    place, chunked, monkeypatch, capsys
):
    assert not fitted(place, "robust", "--method", "robust")["reading"]
    monkeypatch.setattr(regression, "MOST_WHOLE", 5000)
    words = ("fit", "two-link", place / "run.parquet", "--out", place / "m.json")
    out = complaint(capsys, *words, "--method", "robust")
    assert "method robust keeps all rows in memory; got 9000 rows, expected at most 5000" in out
    assert "--method weighted or ordinary" in out


def test_where_only_the_whole_log_will_do_it_is_read_whole(
    place, chunked, tmp_path, capsys, monkeypatch
):
    table = pa.parquet.read_table(place / "run.parquet")
    name = table.column_names[1]
    moved = np.array(table[name])
    moved[5000:] += 0.4
    path = tmp_path / "moved.parquet"
    pa.parquet.write_table(table.set_column(1, name, pa.array(moved)), path)
    words = ("fit", "two-link", path, "--out", tmp_path / "m.json")
    status, out, err = run(capsys, *words)
    assert status == 0 and "counts from another zero from 25 s on" in err
    assert "read as a whole instead" in err and "q1: jumps by 0.4 ra" in out
    monkeypatch.setattr(regression, "MOST_WHOLE", 5000)
    assert "fit its parts, as in moved.parquet@:25" in run(capsys, *words)[2]


def counted(found):
    """What comes of sums over rows: all but shares by functions that were fitted to them."""
    left = tuple(
        "structure systematic_share systematic_sigma noise_share orders spectrum bias".split()
    )
    joints = {
        name: {k: v for k, v in joint.items() if k not in left}
        for name, joint in found["joints"].items()
    }
    keys = ("samples", "relative_error", "by_log", "by_unit", "logs")
    return flat({"joints": joints, **{k: found[k] for k in keys}})


def flat(found, name=""):
    """Texts and numbers by their place."""
    if isinstance(found, dict | list):
        pairs = found.items() if isinstance(found, dict) else enumerate(found)
        return {k: v for key, value in pairs for k, v in flat(value, f"{name}/{key}").items()}
    return {name: found}


def agree(found, whole, rel=1e-9, least=1e-10):
    """Equal texts, and numbers that differ by no more."""
    assert found.keys() == whole.keys()
    for name, value in whole.items():
        if isinstance(value, float):
            value = pytest.approx(value, rel=rel, abs=least)
        assert found[name] == value, name


def told_of(words, place, capsys):
    status, out, _ = run(capsys, *words, "--json", place)
    assert status == 0
    return json.loads(place.read_text()), out


@pytest.fixture(scope="module")
def model(place):
    """The model of a fit of the log, read whole."""
    fitted(place, "model")
    return place / "model.json"


def test_a_long_log_is_compared_in_chunks(place, model, chunked, tmp_path, monkeypatch, capsys):
    """Numbers are those of the log read whole, where rows lie at the same samples.

    Read whole, every 16th row lies in the middle of the log: as from its beginning on, of 8992.
    """
    path = tmp_path / "run.csv"
    pa.csv.write_csv(pa.parquet.read_table(place / "run.parquet").slice(0, 8992), path)
    words = ["compare", model, path]
    result, out = told_of([*words, "--report", tmp_path / "long.html"], tmp_path / "l", capsys)
    assert re.search(r"long logs: all 8992 rows are read once, in [2-9] chunks", out)
    monkeypatch.setattr(regression, "LONG", 10**9)
    whole, out = told_of(words, tmp_path / "whole", capsys)
    assert "long logs" not in out
    agree(counted(result), counted(whole))


def test_rows_of_a_comparison_are_no_more_than_fit_in_memory(
    place, chunked, tmp_path, monkeypatch, capsys
):
    fitted(place, "chunked")  # rows are known again by chunks of the same size
    words = ["compare", place / "chunked.json", place / "run.parquet"]
    every, out = told_of(words, tmp_path / "every", capsys)
    assert "training only: the model was fitted on run.parquet" in out
    few = dataclasses.replace(validation.THRESHOLDS, max_rows=150)
    monkeypatch.setattr(sys.modules["modeler.validation.comparison"], "THRESHOLDS", few)
    some, _ = told_of(words, tmp_path / "some", capsys)
    assert 120 < some["samples"] <= 151 < every["samples"]
    assert some["relative_error"] == pytest.approx(every["relative_error"], rel=0.3)


def test_a_long_log_is_looked_at_in_blocks(place, chunked, tmp_path, monkeypatch, capsys):
    """With gaps on the border of blocks and inside, missing values, and a torque at its limit."""
    table = pa.parquet.read_table(place / "run.parquet").to_pydict()
    columns = {name: np.array(values) for name, values in table.items()}
    columns["time"][1024:] += 0.3
    columns["time"][5000:] += 0.1
    columns["tau1"] = np.clip(columns["tau1"], -np.inf, np.quantile(columns["tau1"], 0.9))
    columns["q2"][[7, 6000]] = np.nan
    path = tmp_path / "run.parquet"
    pa.parquet.write_table(pa.table(columns), path)
    words = ["log", path]
    drawn = ["--picture", tmp_path / "drawn.json"]
    result, out = told_of([*words, *drawn], tmp_path / "long", capsys)
    assert f"long log: all {ROWS} rows are read for ranges" in out
    monkeypatch.setattr("modeler.api.log_maps.LONG", 10**9)
    whole, _ = told_of(words, tmp_path / "whole", capsys)
    assert result["clock"]["gaps"] == 2
    assert result["clock"]["largest_gap_start"] == whole["clock"]["largest_gap_start"] == 5.115
    del result["notes"], whole["notes"]
    del result["marks"], whole["marks"]  # of long logs only what their first look shows has a place
    assert all(any(c[what] for c in whole["channels"]) for what in ("limits", "missing_rows"))
    noises = [one.pop("bands")["noise"] for one in (result, whole)]
    for some, every in zip(*noises, strict=True):  # of the windows
        assert some["deviation"] == pytest.approx(every["deviation"], rel=0.5)
    limits = [[c.pop("limits") for c in one["channels"]] for one in (result, whole)]
    agree(flat(limits[0]), flat(limits[1]), rel=0.03)  # a few rows where a run ends with its block
    agree(flat(result), flat(whole), rel=1e-6, least=1e-9)


@with_cases(
    "words",
    "compare --free-run {model} {log}",
    "add {model} viscous@1 {log} --out {model}2",
    "fit two-link {log} --method all",
)
def test_a_command_that_needs_all_rows_refuses_too_many(words, place, model, capsys, monkeypatch):
    monkeypatch.setattr("modeler.regression.read.MOST_WHOLE", 5000)
    out = complaint(capsys, *words.format(model=model, log=place / "run.parquet").split())
    assert "run.parquet: got 9000 rows; expected at most 5000 where all are in memory" in out


PEAK = """
import resource, sys
from modeler.cli import main
assert main(sys.argv[1:]) == 0
unit = 1 if sys.platform == "darwin" else 1024
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit)
"""


@slow_rotating("memory of long logs")
def test_memory_does_not_grow_with_the_rows(place, model, tmp_path):
    """360 000 rows more of five columns: 14 MB as floats, and many times that read whole."""
    table = pa.parquet.read_table(place / "run.parquet")
    peaks = {"log": [], "compare": []}
    for count in (20, 60):
        path = tmp_path / f"{count}.parquet"
        with pa.parquet.ParquetWriter(path, table.schema) as file:
            for k in range(count):
                time = pa.array(np.array(table["time"]) + k * (ROWS * 5e-3 + 1.0))
                file.write_table(table.set_column(0, "time", time))
        for command, item in peaks.items():
            read = [str(model)] if command == "compare" else []
            words = [sys.executable, "-c", PEAK, command, *read, str(path)]
            done = subprocess.run(words, capture_output=True, text=True, check=True)
            item.append(int(done.stdout.split()[-1]))
    for command, (few, many) in peaks.items():
        assert many - few < 100 * 40 * ROWS, (command, few, many)  # whole: 180 and 390 a row


@pytest.mark.rotating("long tests of cli")
def test_a_log_of_any_length_is_diagnosed_by_stretches_of_it(
    place, model, tmp_path, monkeypatch, capsys
):
    """All rows are read: its fingerprint is that of the whole log."""
    words = ["diagnose", model, place / "run.parquet"]
    every, _ = told_of(words, tmp_path / "all", capsys)
    chunk = sys.modules["modeler.regression.chunk"]
    for name, value in {"FINGER": 1024, "_ROWS": 4096, "_PARTS": 8}.items():
        monkeypatch.setattr(chunk, name, value)
    monkeypatch.setattr("modeler.regression.read.MOST_WHOLE", 5000)
    monkeypatch.setattr(regression, "SPREAD", 5000)
    few, out = told_of(words, tmp_path / "few", capsys)
    assert "9000 rows; 4096 of them are looked at, in 8 segments of 2.56 s" in out
    assert few["verdict"] == every["verdict"] == "nothing significant"
    assert few["joints"]["1"]["error_before"] == pytest.approx(
        every["joints"]["1"]["error_before"], rel=0.2
    )
    spec = compiled("two-link").spec
    source = regression.open_source(place / "run.parquet", spec)
    log = regression.read_spread(source, spec)
    whole = next(source.read_blocks(ROWS))
    blocks = [
        regression.log.compute_block_hash(
            *(x[k : k + 1024] for x in (whole.time, whole.q, whole.tau))
        )
        for k in range(0, ROWS, 1024)
    ]
    assert log.content == regression.log.combine_hashes(blocks)
    assert len(np.unique(log.piece_number)) == 8 and log.rows == 4096
    assert log.span == pytest.approx((0.0, 5e-3 * (ROWS - 1)), abs=2.6)
