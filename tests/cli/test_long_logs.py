"""`modeler fit` of logs that are read in chunks: same numbers, told in lines and JSON."""

import json

import numpy as np
import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet
import pytest

from modeler.api import compile_model, derive, generate, load
from modeler.cli import main

ROWS = 9000


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A folder with one motion of a two-link arm, as Parquet and as CSV."""
    compiled = compile_model(generate(derive(load("two-link"))))
    random = np.random.default_rng(4)
    time = np.arange(ROWS) * 5e-3
    w = 2.0 * np.pi * random.uniform(0.1, 0.5, (3, 2))
    angle = time[:, None, None] * w + random.uniform(0.0, 6.0, w.shape)
    q, qd, qdd = (
        np.sin(angle).sum(1), (w * np.cos(angle)).sum(1), -(w**2 * np.sin(angle)).sum(1)
    )  # fmt: skip
    beta = random.uniform(0.5, 2.0, len(compiled.spec.base))
    tau = compiled.inverse_dynamics(q, qd, qdd, beta) + random.normal(scale=0.05, size=q.shape)
    names = [joint.name for joint in compiled.spec.joints]
    columns = {"time": time}
    columns |= {f"q{n}": q[:, j] + random.normal(scale=1e-5, size=ROWS)
                for j, n in enumerate(names)}  # fmt: skip
    columns |= {f"tau{n}": tau[:, j] for j, n in enumerate(names)}
    folder = tmp_path_factory.mktemp("long")
    table = pa.table(columns)
    pa.parquet.write_table(table, folder / "run.parquet", row_group_size=1500)
    pa.csv.write_csv(table, folder / "run.csv")
    return folder


@pytest.fixture
def chunked(monkeypatch):
    """Logs of some thousand rows are long."""
    for where in ("modeler.observation.log.LONG", "modeler.api.long_logs.LONG",
                  "modeler.observation.streamed_report.LONG"):  # fmt: skip
        monkeypatch.setattr(where, 4000)
    for where in ("log", "seen"):
        monkeypatch.setattr(f"modeler.observation.{where}.FINGER", 1024)
    monkeypatch.setattr("modeler.fit.streamed.stream.__defaults__", (None, lambda share: None,
                                                                     1024, None))  # fmt: skip


def fitted(place, log, name, *options):
    assert main(["fit", "two-link", str(place / log), "--out", str(place / f"{name}.json"),
                 "--json", str(place / f"{name}.fit"), *options]) == 0  # fmt: skip
    return json.loads((place / f"{name}.fit").read_text())


def values(fit):
    return (np.array([p["value"] for p in fit["parameters"]]),
            np.array([p["sigma"] for p in fit["parameters"]]))  # fmt: skip


@pytest.mark.parametrize("log", ["run.parquet", "run.csv"])
def test_a_long_log_is_fitted_in_chunks(log, place, chunked, monkeypatch, capsys):
    fit = fitted(place, log, "chunked")
    out = capsys.readouterr().out
    assert f"all {ROWS} rows are read once, in 9 chunks" in out and "9000 rows at 200 Hz" in out
    assert fit["reading"]["chunks"] == 9 and fit["reading"]["passes"] == 1
    monkeypatch.setattr("modeler.api.long_logs.LONG", 10**9)
    whole = fitted(place, log, "whole")
    assert "reading" not in whole
    (beta, _), (true, sigma) = values(fit), values(whole)
    assert np.abs((beta - true) / sigma).max() < 3.0  # rows lie elsewhere between the samples
    assert fit["verdict"] == whole["verdict"] or fit["usable"] == whole["usable"]


def test_its_model_knows_the_log_again(place, chunked, monkeypatch, capsys):
    """Fingerprint, rows and span of a log in chunks are those of the log read whole."""
    fitted(place, "run.parquet", "chunked")
    monkeypatch.setattr("modeler.api.long_logs.LONG", 10**9)
    fitted(place, "run.csv", "whole")
    logs = [json.loads((place / f"{n}.json").read_text())["logs"][0] for n in ("chunked", "whole")]
    one, other = ({k: log[k] for k in ("rows", "content", "start", "end")} for log in logs)
    assert one == other
    assert main(["compare", str(place / "chunked.json"), str(place / "run.parquet")]) == 0
    assert "run.parquet" in capsys.readouterr().out


def test_a_log_given_twice_is_refused(place, chunked, capsys):
    words = ["fit", "two-link", str(place / "run.parquet"), str(place / "run.csv"), "--out",
             str(place / "m.json")]  # fmt: skip
    assert main(words) == 1
    assert "run.csv: got rows of run.parquet again" in capsys.readouterr().err


def test_a_method_that_needs_all_rows_reads_them_or_says_that_they_are_too_many(
    place, chunked, monkeypatch, capsys
):
    assert "reading" not in fitted(place, "run.parquet", "robust", "--method", "robust")
    monkeypatch.setattr("modeler.api.long_logs.MOST_WHOLE", 5000)
    words = ["fit", "two-link", str(place / "run.parquet"), "--out", str(place / "m.json")]
    assert main([*words, "--method", "robust"]) == 1
    told = capsys.readouterr().err
    assert "method robust keeps all rows in memory; got 9000 rows, expected at most 5000" in told
    assert "--method weighted or ordinary" in told


def test_where_only_the_whole_log_will_do_it_is_read_whole(place, chunked, tmp_path, capsys,
                                                           monkeypatch):  # fmt: skip
    table = pa.parquet.read_table(place / "run.parquet")
    name = table.column_names[1]
    moved = np.array(table[name])
    moved[5000:] += 0.4
    path = tmp_path / "moved.parquet"
    pa.parquet.write_table(table.set_column(1, name, pa.array(moved)), path)
    words = ["fit", "two-link", str(path), "--out", str(tmp_path / "m.json")]
    assert main(words) == 0
    told = capsys.readouterr()
    assert "counts from another zero from 25 s on" in told.err
    assert "read as a whole instead" in told.err and "the encoder found another zero" in told.out
    monkeypatch.setattr("modeler.api.long_logs.MOST_WHOLE", 5000)
    assert main(words) == 1
    assert "fit its parts, as in moved.parquet@:25" in capsys.readouterr().err


def test_a_damaged_row_group_in_the_middle_is_one_line(place, chunked, tmp_path, capsys):
    content = bytearray((place / "run.parquet").read_bytes())
    middle = len(content) // 2
    content[middle : middle + 3000] = bytes(range(250)) * 12
    path = tmp_path / "broken.parquet"
    path.write_bytes(content)
    assert main(["fit", "two-link", str(path), "--out", str(tmp_path / "m.json")]) == 1
    told = capsys.readouterr().err.strip()
    assert told.count("\n") == 0 and "broken.parquet: cannot be read as PARQUET beyond row" in told
    assert not (tmp_path / "m.json").exists()
