"""Thousands of mutants of robot files, logs and model files: no traceback, no hang, no mess.

The same mutants every time; MODELER_FUZZ=5000 takes so many per test, from fresh seeds.
"""

import io
import json
import tempfile
import tomllib
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given, strategies as st

from modeler.core.builtin import builtin_text
from tests.bad_input.judge import clear, run_here, standing_in, within
from tests.bad_input.mutants import (
    NUMBERS,
    PLACE,
    edited_bytes,
    edited_structure,
    edits,
    mutants,
    structure_edits,
    toml_text,
)  # fmt: skip
from tests.bad_input.robot_texts import CRANK, LEGS, MAGNET, SERIAL
from tests.bad_input.yard import Ground, Yard, csv_text

pytestmark = pytest.mark.slow

ROBOTS = [
    SERIAL,
    CRANK,
    LEGS,
    MAGNET,
    *map(builtin_text, ("two-link", "emps", "demo-arm", "scara")),
]
WORDS = (
    *NUMBERS, '"', "[", "]", "{", "}", "=", ",", "\n", "#", '"q1"', '"q2"', "sin(", ")", "**", "/",
    "+ ", "-", "pi", "[mdh]", "[effects]", "[loops]", "rows", "columns", '"all"', '"0"', "{i}",
    "\0",
    "é", "\\", "true", "'",
)  # fmt: skip
CELLS = (
    *NUMBERS,
    ",",
    "\n",
    "\r\n",
    ";",
    '"',
    "time",
    "q1",
    "tau1",
    "text",
    " ",
    "\t",
    "\0",
    "é",
    "",
)
KINDS = (
    pa.float32(), pa.int64(), pa.int8(), pa.string(), pa.bool_(), pa.binary(), pa.null(),
    pa.timestamp("ns"), pa.list_(pa.float64()), pa.dictionary(pa.int32(), pa.string()),
    pa.decimal128(20, 6), pa.duration("ms"), pa.float16(),
)  # fmt: skip


@pytest.fixture(scope="module")
def ground(tmp_path_factory: pytest.TempPathFactory) -> Ground:
    return Ground(tmp_path_factory.mktemp("ground"))


def survives(ground: Ground, name: str, content: bytes, command: str) -> None:
    """The command on a mutant ends in time, by itself, and with one line if it is refused."""
    with tempfile.TemporaryDirectory() as folder:
        yard = Yard(Path(folder), ground)
        yard.write(name, content)
        words = tuple(command.split())
        yard.take_named(words)
        with standing_in(yard), within(20.0):
            result = run_here(words, yard)
        assert not result.broke, result.broke
        assert result.status in (0, 1, 2), f"exit status {result.status}"
        unclear = clear(words, result) if result.status else []
        assert not unclear, unclear


DERIVE = "derive bad.toml --no-terms --json d.json"


@mutants(160)
@given(robot=st.sampled_from(ROBOTS), made=edits())
def test_robot_files_of_mutated_text(ground, robot, made):
    survives(ground, "bad.toml", edited_bytes(robot.encode(), made, WORDS), DERIVE)


@mutants(200)
@given(robot=st.sampled_from(ROBOTS), made=structure_edits())
def test_robot_files_of_mutated_tables(ground, robot, made):
    document = edited_structure(tomllib.loads(robot), made)
    survives(ground, "bad.toml", toml_text(document).encode(errors="replace"), DERIVE)


@mutants(160)
@given(made=edits())
def test_logs_of_mutated_text(ground, made):
    short = {name: values[:400] for name, values in ground.log("a.csv").items()}
    content = edited_bytes(csv_text(short).encode(), made, CELLS)
    survives(ground, "bad.csv", content, "fit two-link bad.csv --out f.json")


@mutants(60)
@given(made=edits())
def test_logs_of_mutated_parquet_bytes(ground, made):
    file = io.BytesIO()
    pq.write_table(pa.table(ground.log("a.csv")).slice(0, 400), file)
    content = edited_bytes(file.getvalue(), made, CELLS)
    survives(ground, "bad.parquet", content, "fit two-link bad.parquet --out f.json")


def _change_column(
    table: dict[str, pa.Array], column: str, kind: pa.DataType, place: int, value: float
) -> None:
    """One column in another kind, or with another value somewhere, or gone."""
    values = np.array(table[column], dtype=float)
    how = place % 5
    if how == 0:
        try:
            table[column] = pa.array(values).cast(kind, safe=False)
        except pa.ArrowException:
            table[column] = pa.array([None] * len(values), kind)
    elif how == 1:
        values[place % len(values) :][: place % 50 + 1] = value
        table[column] = pa.array(values)
    elif how == 2:
        with np.errstate(all="ignore"):
            table[column] = pa.array(values * value)
    elif how == 3:
        table[column] = pa.array(np.roll(values, place % len(values)))
    else:
        del table[column]


@mutants(120)
@given(
    changes=st.lists(
        st.tuples(PLACE, st.sampled_from(KINDS), PLACE, st.floats()), min_size=1, max_size=3
    )
)
def test_logs_of_mutated_columns(ground, changes):
    table = {name: pa.array(v[:400]) for name, v in ground.log("a.csv").items()}
    for which, kind, place, value in changes:
        names = [name for name, column in table.items() if pa.types.is_float64(column.type)]
        if names:
            _change_column(table, names[which % len(names)], kind, place, value)
    file = io.BytesIO()
    pq.write_table(pa.table(table), file)
    survives(ground, "bad.parquet", file.getvalue(), "fit two-link bad.parquet --out f.json")


COMPARE = "compare bad.json b.csv --json c.json"


@mutants(80)
@given(made=edits())
def test_model_files_of_mutated_text(ground, made):
    text = (ground.folder / "m.json").read_bytes()
    survives(ground, "bad.json", edited_bytes(text, made, (*NUMBERS, *WORDS)), COMPARE)


@mutants(120)
@given(made=structure_edits())
def test_model_files_of_mutated_structure(ground, made):
    raw = edited_structure(ground.model("added.json"), made)
    survives(ground, "bad.json", json.dumps(raw).encode(errors="replace"), COMPARE)
