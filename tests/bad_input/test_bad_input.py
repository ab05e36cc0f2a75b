"""Every row of the table, and what it is in all."""

from collections.abc import Iterator

import pytest

from tests.bad_input import command_lines, environment, log_signals, log_texts, models, robot_files
from tests.bad_input.drawn import run_mutants
from tests.bad_input.judge import disturbed, ending, faults
from tests.bad_input.row import Result, Row, row as made
from tests.bad_input.workdir import Inputs, Workdir
from tests.rotation import ROTATING, with_cases

THEMES = (robot_files, log_texts, log_signals, models, command_lines, environment)
ROWS: tuple[Row, ...] = tuple(row for theme in THEMES for row in theme.ROWS)


@pytest.fixture(scope="module")
def inputs(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Inputs]:
    inputs = Inputs(tmp_path_factory.mktemp("inputs"))
    yield inputs
    inputs.close()


def cases() -> Iterator[object]:
    """What is refused always runs, at once; of what works, the first of each theme and outcome."""
    seen = set()
    for row in ROWS:
        kind = (row.theme, row.outcome)
        costly = row.outcome != "refused" or row.process is not None
        marks = [pytest.mark.rotating] * (costly and kind in seen and not row.alone)
        marks += [pytest.mark.slow] * (row.process is not None and row.process.slow)
        seen.add(kind)
        yield pytest.param(row, id=row.id, marks=marks)


@pytest.mark.parametrize("row", list(cases()))
def test_a_bad_input_ends_as_it_must(row, inputs, tmp_path):
    wrong = faults(row, Workdir(tmp_path, inputs))
    assert not wrong, f"{row.command[:200]}\n" + "\n".join(wrong)


@with_cases(
    "count, seed", (25, 90210), *(pytest.param(150, seed, marks=ROTATING) for seed in (7, 8, 9, 10))
)
def test_mutants_of_every_format_end_in_one_line(count, seed, inputs):
    assert run_mutants(count, seed, inputs) == []


@with_cases(
    "err, piece",
    ("", "silent"),
    ("modeler: bad.toml: got 3; expected 4\nand more\n", "unclear: 2 lines"),
    ("modeler: got 3; expected 4\n", "names no file"),
    ("modeler: bad.toml: got 3\n", "says not what to do"),
    ("bad.toml: got 3; expected 4\n", "who speaks"),
    (f"modeler: bad.toml: got 3; expected {'x' * 2000}\n", "characters"),
    ("modeler: bad.toml: got 4; expected 5\n", "does not say 'got 3'"),
)
def test_the_judge_sees_an_unclear_line(err, piece, inputs, tmp_path):
    """The judge itself: lines that users must not get."""
    workdir = Workdir(tmp_path, inputs)
    bad_row = made("x: y", "refused", "derive bad.toml", "got 3")
    result = ending(bad_row, Result(1 if err else 0, "", err, "", workdir))
    assert any(piece in line for line in result)


@pytest.mark.rotating("long tests of bad_input")
def test_the_judge_sees_what_was_changed_and_left(inputs, tmp_path):
    bad_row = made("x: y", "works", "fit r.toml a.csv --out m.json")
    workdir = Workdir(tmp_path, inputs)
    workdir.write("m.json", "{")
    result = Result(0, "", "", "", workdir)
    before = {"work/a.csv": "1", "work/r.toml": "2"}
    after = {"work/a.csv": "3", "work/m.json": "4", "work/x.tmp": "5"}
    text = " ".join(disturbed(bad_row, result, before, after))
    for piece in (
        "a.csv was changed",
        "r.toml was removed",
        "left behind: work/x.tmp",
        "half-written: m.json",
    ):
        assert piece in text
