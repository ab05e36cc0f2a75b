"""docs/reference/python.md names every function, and every table and figure of results."""

import re
from pathlib import Path

import pytest

import modeler.api as api
from modeler.core.result import find_presentation
from tests.notebook.session import session

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/reference/python.md").read_text(encoding="utf-8")


def part(title: str) -> str:
    """The text below a title."""
    return PAGE.split(f"## {title}\n")[1].split("\n## ")[0]


def rows(title: str) -> list[list[str]]:
    """The cells of the table below a title."""
    lines = [line for line in part(title).splitlines() if line.startswith("|")][2:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def test_every_function_stands_there() -> None:
    lines = set(re.findall(r"`(\w+)\(", part("Functions")))
    offered = {name: getattr(api, name) for name in api.__all__ if name not in ("Mapped", "AnyLog")}
    functions = {n for n, x in offered.items() if callable(x) and not isinstance(x, type)}
    assert functions <= lines <= {*offered}


@pytest.mark.rotating("results of the session")
def test_every_table_and_figure_stands_there() -> None:
    made = session()
    cells = {name: further for name, *further in rows("What results show")}
    data = {name: [set(c.split(", ")) - {""} for c in further] for name, further in cells.items()}
    assert data.pop("look")[0] == {"channels"}
    for name, (tables, figures) in data.items():
        shown = find_presentation(type(made[name]))
        assert shown is not None
        there = set(shown.tables(made[name]))
        assert there <= tables and tables - there <= {"loads", "gains", "waterfall"}, name
        drawn = {
            re.sub(r"\w+@\w+", "EFFECT@J", re.sub(r" \d+$", " J", f))
            for f in shown.figures(made[name])
        }
        assert drawn <= figures and figures - drawn <= {"waterfall"}, name
    with_tables = {n for n in made if (p := find_presentation(type(made[n]))) and p.tables(made[n])}
    assert with_tables <= {*data, "better", "better comparison", "report"}
