"""Logs as files: names, encodings, separators, headers, what Parquet can hold."""

import decimal
import os
from collections.abc import Callable

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
    texts("only line ends", "refused", lambda t: "\n\n\n", "bad.csv", "empty"),
    texts(
        "an open quote", "refused", lambda t: _line(t, 50, '"0.245,0,0,0,0,1,1'), "row 50", "quote"
    ),
    texts("a quote opened in the header", "refused", lambda t: '"' + t, "quote", "not closed"),
    texts(
        "an unnamed column",
        "works",
        lambda t: "\n".join(line + "," for line in t.rstrip("\n").split("\n")) + "\n",
    ),
    texts("line ends of old Macs", "works", lambda t: t.replace("\n", "\r")),
    texts("blank lines between", "works", lambda t: t.replace("\n", "\n\n")),
    texts(
        "a number of a million digits",
        "told",
        lambda t: _line(t, 50, f"0.245,{'9' * 1000000},0,0,0,1,1"),
        "q1: 1 rows",
    ),
]

FILES = [
    row("log file: a unit of a huge power", "refused",
        "fit two-link a.csv --map q1=q1:rad^999999999 --out f.json", "rad^999999999", "no unit"),
    row("log file: one column for two joints", "refused",
        "fit two-link a.csv --map q1=q1 --map q2=q1 --out f.json", "taken as q1 and as q2"),
    row("log file: a pipe", "refused", "fit two-link x.csv --out f.json", "x.csv", "pipe",
        make=lambda w: os.mkfifo(w.path("x.csv"))),
    row("log file: of a robot with more joints", "told", "fit two-link d.csv --out f.json", "3"),
    row("log file: suffix in capitals", "works", "fit two-link A.CSV --out f.json", "A.CSV",
        make=lambda w: w.take("a.csv", "A.CSV"), check=true_values),
    row("log file: name with spaces and @", "works",
        ("fit", "two-link", "run @ 5 Hz.csv", "--out", "f.json"), "run @ 5 Hz.csv",
        make=lambda w: w.take("a.csv", "run @ 5 Hz.csv"), check=true_values),
]  # fmt: skip


def _parquet(change: object) -> Make:
    def make(workdir: Workdir) -> None:
        table = pa.table(workdir.inputs.log("a.csv"))
        pq.write_table(change(table), workdir.path("bad.parquet"))  # type: ignore

    return make


def _put(**columns: Callable[[np.ndarray], pa.Array]) -> Make:
    """The columns, by name, made of other values, and all in the order of their names."""

    def change(table: pa.Table) -> pa.Table:
        new = {name: make(table[name].to_numpy()) for name, make in columns.items()}
        return pa.table({name: new.get(name, table[name]) for name in sorted(table.column_names)})

    return _parquet(change)


def _row_parquet(what: str, outcome: Outcome, make: Make, *words: str) -> Row:
    check = true_values if outcome == "works" else None
    return row(f"parquet: {what}", outcome, FIT_PARQUET, *words, make=make, check=check)


PARQUET = [
    _row_parquet("single precision, a dictionary and decimals", "works",
                 _put(q1=lambda v: pa.array(v.astype(np.float32)),
                      tau1=lambda v: pa.array(v).dictionary_encode(),
                      tau2=lambda v: pa.array([decimal.Decimal(f"{x:.6f}") for x in v]))),
    _row_parquet("time as durations", "ends",
                 _put(time=lambda v: pa.array((v * 1e9).astype("timedelta64[ns]"))),
                 "Valid for torque prediction"),
    _row_parquet("a column of lists more", "ends",
                 _parquet(lambda t: t.append_column("x", [[[1]] * t.num_rows])), "x"),
]  # fmt: skip

ROWS = [*CSV, *FILES, *PARQUET]
