"""The benchmarks' front: keys that stay, what cannot be measured, one line that is."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from benchmarks import __main__ as front, equal
from benchmarks.all import LINES
from benchmarks.line import Key, Line, Missing
from benchmarks.markdown import markdown
from tests.rotation import with_cases

DOCS = Path(__file__).resolve().parents[1] / "docs" / "explanation" / "benchmarks.md"
KEYS = [key for line in LINES for key in line.keys]


def test_every_key_is_there_once_and_documented() -> None:
    names = [key.name for key in KEYS]
    assert len(set(names)) == len(names) > 80
    figures = figures_told(DOCS.read_text(encoding="utf-8"))
    assert not (set(names) - figures.keys()), "docs/explanation/benchmarks.md is made by --markdown"
    assert all(re.match(r"-?\d", figure) for figure in figures.values())


def figures_told(text: str) -> dict[str, str]:
    """{key: its cell} of the tables that `--markdown` prints: families in rows, variants above."""
    figures: dict[str, str] = {}
    columns: list[str] = []
    for line in text.splitlines():
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
        if cells[:1] == ["key"]:
            columns = cells
        elif cells and len(cells) == len(columns) and cells[0].startswith("`"):
            family = cells[0].strip("`")
            for column, cell in zip(columns[1:-1], cells[1:-1], strict=True):
                key = family if column == "value" else f"{family}.{column}"
                figures |= {key: cell}
    return figures


def test_every_figure_of_a_report_is_in_its_tables() -> None:
    random = np.random.default_rng()
    values = {key.name: float(random.uniform(1e-3, 1e4)) for key in KEYS}
    values[KEYS[-1].name] = None  # type: ignore[assignment]
    about = dict.fromkeys(("date", "processor", "vectors", "cores", "memory_gb", "gcc", "python"))
    report = {"machine": about, "values": values, "missing": {KEYS[-1].name: "no such tool"}}
    figures = figures_told(markdown(report))
    assert figures.keys() == values.keys()
    assert figures[KEYS[-1].name] == "missing: no such tool"
    for key in KEYS[:-1]:
        figure, _, goals = figures[key.name].partition(" ")
        assert float(figure) == pytest.approx(values[key.name], rel=6e-3)
        asked = ["-" if goal is None else f"{goal:g}" for goal in (key.must, key.aim)]
        assert goals == ("" if asked == ["-", "-"] else f"({'/'.join(asked)})")


@pytest.mark.parametrize(
    "name",
    """
        scalar_vs_pinocchio_gcc.puma560 batch_vs_pinocchio_gcc.puma560
        dense_w_vs_stream_fill.puma560 fused_r_vs_lstsq instructions.puma560 fit_seconds_per_1e6
        fit_peak_mb.1e7 loops_us.evra help_seconds
    """.split(),
)
def test_keys_that_others_read_stay(name: str) -> None:
    assert name in {key.name for key in KEYS}


def test_goals_point_the_right_way() -> None:
    for key in KEYS:
        if key.must is not None and key.aim is not None:
            assert (key.aim >= key.must) == (key.better == "more"), key.name


def test_list_says_what_each_key_means(capsys: pytest.CaptureFixture[str]) -> None:
    assert front.main(["--list"]) == 0
    said = capsys.readouterr().out
    assert all(f"{key.name} " in said and key.meaning in said for key in KEYS)


def test_help_is_timed(tmp_path: Path) -> None:
    place = tmp_path / "b.json"
    assert front.main(["--quick", "--only", "help_seconds", "--json", str(place)]) == 0
    report = json.loads(place.read_text(encoding="utf-8"))
    assert 0.0 < report["values"]["help_seconds"] < 60.0
    assert report["machine"]["cores"] >= 1 and report["machine"]["processor"]
    assert "`help_seconds`" in markdown(report)


def test_a_line_that_cannot_be_measured_says_why_and_stops_no_other() -> None:
    def without_tool(quick: bool) -> dict[str, float]:
        raise Missing("no such tool")

    def broken(quick: bool) -> dict[str, float]:
        return {"c": 1.0 / 0.0}

    lines = [
        Line((Key("a", "s", ""),), without_tool, 0),
        Line((Key("c", "s", ""),), broken, 0),
        Line((Key("b", "s", ""),), lambda quick: {"b": 2.0}, 0),
    ]
    report = front.measured(lines, quick=True)
    assert report["values"] == {"a": None, "c": None, "b": 2.0}
    assert report["missing"]["a"] == "no such tool" and "ZeroDivision" in report["missing"]["c"]


def test_an_unknown_key_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert front.main(["--only", "nothing_like_it"]) == 1
    assert "no line matches nothing_like_it; see --list" in capsys.readouterr().err


@with_cases(
    "after, same",
    ({"x": [1e3, 1e-8], "seconds": 2.0, "name": "Fs2"}, True),
    ({"x": [1e3, 2e-6], "seconds": 1.0, "name": "Fs2"}, False),
    ({"x": [1e3 + 2e-6, 0.0], "seconds": 1.0, "name": "Fs2"}, False),
    ({"x": [1e3], "seconds": 1.0, "name": "Fs2"}, False),
    ({"x": [1e3, 0.0], "seconds": 1.0, "name": "Fv2"}, False),
    ({"x": [1e3, 0.0], "seconds": 1.0}, False),
    ("no answer, status 1", False),
)
def test_answers_of_two_checkouts_are_held_against_each_other(after: object, same: bool) -> None:
    before = {"fit.emps": {"x": [1e3, 0.0], "seconds": 1.0, "name": "Fs2"}}
    assert equal.told(before, {"fit.emps": after}) == (not same)
    assert equal.told(before, {}) == 1
