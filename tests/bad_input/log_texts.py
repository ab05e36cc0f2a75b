"""Logs as files: names, encodings, separators, headers, what Parquet can hold."""

import datetime
import decimal
import os

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from tests.bad_input.fits import true_values
from tests.bad_input.row import Make, Outcome, Row, row
from tests.bad_input.workdir import Workdir, csv_text

FIT = "fit two-link bad.csv --out f.json"
FIT_PARQUET = "fit two-link bad.parquet --out f.json"


def texts(what: str, outcome: Outcome, change: object, *words: str) -> Row:
    """A row of a CSV file whose text is changed: by a function, or by (old, new)."""

    def make(workdir: Workdir) -> None:
        text = csv_text(workdir.inputs.log("a.csv"))
        new = text.replace(*change, 1) if isinstance(change, tuple) else change(text)  # type: ignore
        assert new != text, what
        workdir.write("bad.csv", new)

    check = true_values if outcome == "works" else None
    return row(f"csv: {what}", outcome, FIT, *words, make=make, check=check)


def _line(text: str, number: int, new: str) -> str:
    lines = text.split("\n")
    lines[number] = new
    return "\n".join(lines)


CSV = [
    texts("semicolons and decimal commas", "told",
          lambda t: t.replace(",", ";").replace(".", ","), "; between", "decimal commas"),
    texts("tabs", "told", lambda t: t.replace(",", "\t"), "read with tabs between"),
    texts("decimal commas between commas", "refused", lambda t: t.replace(".", ","), "bad.csv"),
    texts("units in a second row", "told", ("\n", "\ns,rad,rad,rad,rad,Nm,Nm\n"),
          "units in line 2"),
    texts("no header", "refused", lambda t: t.partition("\n")[2], "bad.csv", "time"),
    texts("header only", "refused", lambda t: t.partition("\n")[0] + "\n", "bad.csv", "row"),
    texts("empty", "refused", lambda t: "", "bad.csv", "empty"),
    texts("only line ends", "refused", lambda t: "\n\n\n", "bad.csv", "empty"),
    texts("UTF-16", "told", lambda t: t.encode("utf-16"), "in utf-16"),
    texts("Latin-1 header", "told", lambda t: t.replace("qc2", "Größe").encode("latin-1"),
          "in latin-1"),
    texts("random bytes", "refused", lambda t: bytes(range(256)) * 20, "bad.csv"),
    texts("NUL bytes in a row", "refused", lambda t: _line(t, 50, "0.245,\0,0,0,0,1,1"), "bad.csv"),
    texts("a row short", "refused", lambda t: _line(t, 50, "0.245,0,0"), "bad.csv", "50|51"),
    texts("an open quote", "refused", lambda t: _line(t, 50, '"0.245,0,0,0,0,1,1'), "row 50",
          "quote"),
    texts("a quote opened in the header", "refused", lambda t: '"' + t, "quote", "not closed"),
    texts("a torque of 1e300", "refused", lambda t: _line(t, 50, "0.245,0,0,0,0,1e300,1"), "tau1",
          "row 50", "1e+300"),
    texts("ERR in a position", "refused", lambda t: _line(t, 50, "0.245,ERR,0,0,0,1,1"),
          "q1", "row 50", "ERR"),
    texts("a column twice", "refused", ("qc2", "q2"), "q2", "2 times", "columns 3, 5"),
    texts("time [s]", "refused", ("time", "time [s]"), "bad.csv", "time"),
    texts("q0, q1 for q1, q2", "refused", ("q1,q2", "q0,q1"), "bad.csv", "q2"),
    texts("torque1 for tau1", "refused", ("tau1", "torque1"), "bad.csv", "tau1", "joint 1"),
    texts("current without gain", "refused", ("tau1", "current1"), "current1", "drive_gains"),
    texts("an unnamed column", "works", lambda t: "\n".join(
        line + "," for line in t.rstrip("\n").split("\n")) + "\n"),
    texts("spaces after the commas", "works", ("time,q1,q2", "time, q1, q2")),
    texts("line ends of Windows", "works", lambda t: t.replace("\n", "\r\n")),
    texts("line ends of old Macs", "works", lambda t: t.replace("\n", "\r")),
    texts("byte order mark", "works", lambda t: "\ufeff" + t),
    texts("blank lines between", "works", lambda t: t.replace("\n", "\n\n")),
    texts("NaN as nan", "works", lambda t: "\n".join(
        line.rpartition(",")[0] + ",nan" if k == 50 else line
        for k, line in enumerate(t.split("\n")))),
    texts("a column of text more", "told", lambda t: "\n".join(
        line + (",note" if k == 0 else ",ok") for k, line in enumerate(t.rstrip("\n").split("\n")))
        + "\n", "note", "left out"),
    texts("a number of a million digits", "told",
          lambda t: _line(t, 50, f"0.245,{'9' * 1000000},0,0,0,1,1"), "q1: 1 rows"),
]  # fmt: skip

FILES = [
    row("log file: a unit of a huge power", "refused",
        "fit two-link a.csv --map q1=q1:rad^999999999 --out f.json", "rad^999999999", "no unit"),
    row("log file: one column for two joints", "refused",
        "fit two-link a.csv --map q1=q1 --map q2=q1 --out f.json", "taken as q1 and as q2"),
    row("log file: a pipe", "refused", "fit two-link x.csv --out f.json", "x.csv", "pipe",
        make=lambda w: os.mkfifo(w.path("x.csv"))),
    row("log file: a folder called like a log", "refused", "fit two-link x.csv --out f.json",
        "x.csv", "folder", make=lambda w: w.path("x.csv").mkdir()),
    row("log file: Excel", "refused", "fit two-link a.xlsx --out f.json", "a.xlsx", "spreadsheet",
        make=lambda w: w.write("a.xlsx", b"PK\x03\x04rest")),
    row("log file: no suffix", "refused", "fit two-link run --out f.json", "run", ".csv",
        make=lambda w: w.take("a.csv", "run")),
    row("log file: .txt", "works", "fit two-link run.txt --out f.json", "run.txt",
        make=lambda w: w.take("a.csv", "run.txt"), check=true_values),
    row("log file: CSV called Parquet", "refused", "fit two-link run.parquet --out f.json",
        "run.parquet", make=lambda w: w.take("a.csv", "run.parquet")),
    row("log file: a model file", "refused", "fit two-link m.json --out f.json", "m.json", ".csv"),
    row("log file: of another robot", "refused", "fit two-link e.csv --out f.json", "e.csv", "q2"),
    row("log file: of a robot with more joints", "told", "fit two-link d.csv --out f.json", "3"),
    row("log file: suffix in capitals", "works", "fit two-link A.CSV --out f.json", "A.CSV",
        make=lambda w: w.take("a.csv", "A.CSV"), check=true_values),
    row("log file: name with spaces and @", "works",
        ("fit", "two-link", "run @ 5 Hz.csv", "--out", "f.json"), "run @ 5 Hz.csv",
        make=lambda w: w.take("a.csv", "run @ 5 Hz.csv"), check=true_values),
    row("log file: a link", "works", "fit two-link link.csv --out f.json",
        make=lambda w: w.path("link.csv").symlink_to(w.take("a.csv", "real.csv")),
        check=true_values),
]  # fmt: skip


def _parquet(change: object) -> Make:
    def make(workdir: Workdir) -> None:
        table = pa.table(workdir.inputs.log("a.csv"))
        pq.write_table(change(table), workdir.path("bad.parquet"))  # type: ignore

    return make


def _put(name: str, values: object) -> Make:
    """The column `name` made of other values."""

    def change(table: pa.Table) -> pa.Table:
        column = values(table[name].to_numpy()) if callable(values) else values
        place = table.column_names.index(name)
        return table.set_column(place, name, [column])

    return _parquet(change)


def _days(values: np.ndarray) -> pa.Array:
    start = datetime.datetime(2024, 1, 1)
    return pa.array([start + datetime.timedelta(seconds=float(v)) for v in values])


def _row_parquet(what: str, outcome: Outcome, make: Make, *words: str) -> Row:
    check = true_values if outcome == "works" else None
    return row(f"parquet: {what}", outcome, FIT_PARQUET, *words, make=make, check=check)


def _holed(workdir: Workdir) -> None:
    data = bytearray((workdir.inputs.folder / "c.parquet").read_bytes())
    data[2000:4000] = bytes(2000)
    workdir.write("bad.parquet", bytes(data))


PARQUET = [
    _row_parquet("empty file", "refused", lambda w: w.write("bad.parquet", b""), "bad.parquet"),
    _row_parquet("random bytes", "refused",
                 lambda w: w.write("bad.parquet", b"PAR1" + bytes(range(256)) + b"PAR1"),
                 "bad.parquet"),
    _row_parquet("zeros in its middle", "refused", _holed, "bad.parquet"),
    _row_parquet("no rows", "refused", _parquet(lambda t: t.slice(0, 0)), "bad.parquet", "row"),
    _row_parquet("time as dates", "works", _put("time", _days)),
    _row_parquet("time as text", "refused", _put("time", lambda v: pa.array(map(str, v))), "time"),
    _row_parquet("position as lists", "refused",
                 _put("q1", lambda v: pa.array([[float(x)] for x in v])), "q1[1]"),
    _row_parquet("position of nothing", "refused", _put("q1", lambda v: pa.nulls(len(v))), "q1"),
    _row_parquet("single precision", "works",
                 _put("q1", lambda v: pa.array(v.astype(np.float32)))),
    _row_parquet("dictionary encoded", "works",
                 _put("tau1", lambda v: pa.array(v).dictionary_encode())),
    _row_parquet("decimals", "works",
                 _put("tau2", lambda v: pa.array([decimal.Decimal(f"{x:.6f}") for x in v]))),
    _row_parquet("time as durations", "ends",
                 _put("time", lambda v: pa.array((v * 1e9).astype("timedelta64[ns]"))),
                 "Valid for torque prediction"),
    _row_parquet("integer microseconds for time", "told",
                 _put("time", lambda v: pa.array((v * 1e6).astype(np.int64))), "second"),
    _row_parquet("columns in another order", "works",
                 _parquet(lambda t: t.select(sorted(t.column_names)))),
    _row_parquet("a column of lists more", "ends",
                 _parquet(lambda t: t.append_column("x", [[[1]] * t.num_rows])), "x"),
]  # fmt: skip

ROWS = [*CSV, *FILES, *PARQUET]
