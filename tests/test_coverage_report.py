"""The report of coverage: shares by package, and the longest of the least covered functions."""

from typing import Any

from tests.coverage_report import report_lines


def summary(lines: int, run: int, branches: int = 0, taken: int = 0) -> dict[str, Any]:
    counts = {"num_statements": lines, "covered_lines": run, "percent_covered": 100 * run / lines}
    return {"summary": {**counts, "num_branches": branches, "covered_branches": taken}}


def test_packages_and_least_covered_functions() -> None:
    sizes = {"none": 4, "long": 9, "short": 1, "": 50}
    functions = {name: summary(lines, 0) for name, lines in sizes.items()}
    files = {
        "modeler/core/a.py": {**summary(20, 10, 8, 2), "functions": functions},
        "modeler/core/b.py": {**summary(20, 20), "functions": {"all": summary(20, 20)}},
        "modeler/robot/c.py": {**summary(10, 5), "functions": {}},
    }
    _, *rows, head, first, second, last = report_lines({"files": files})
    assert [row.split() for row in rows] == [
        ["all", "50", "70.0%", "8", "25.0%"],
        ["core", "40", "75.0%", "8", "25.0%"],
        ["robot", "10", "50.0%", "0", "0.0%"],
    ]
    assert "least covered" in head
    assert [first.split()[-1], second.split()[-1], last.split()[-1]] == ["long", "none", "all"]
