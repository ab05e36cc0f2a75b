"""The notebook in docs/ runs from its first cell to its last, and shows what it says."""

import importlib.util
import json
import os
from pathlib import Path
from typing import Any

import pytest

pytestmark = pytest.mark.slow  # docs/reference/python.md is run with the other pages

ROOT = Path(__file__).resolve().parents[2]
NOTEBOOK = ROOT / "docs" / "tutorials" / "identification.ipynb"


def test_the_notebook_is_kept_without_outputs() -> None:
    kept = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
    assert kept["nbformat"] == 4
    for cell in kept["cells"]:
        if cell["cell_type"] == "code":
            assert cell["outputs"] == [] and cell["execution_count"] is None
    assert NOTEBOOK.stat().st_size < 20_000


@pytest.fixture(scope="module")
def executed(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The notebook with the outputs of a fresh kernel."""
    for package in ("nbclient", "ipykernel", "pandas"):
        if importlib.util.find_spec(package) is None:
            pytest.skip(f"NOT CHECKED: {package} is not installed, so the notebook is not run")
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(NOTEBOOK, as_version=4)
    nbformat.validate(notebook)
    folder = tmp_path_factory.mktemp("notebook")
    before = os.environ.get("PYTHONPATH")
    os.environ["PYTHONPATH"] = os.pathsep.join([str(ROOT), *([before] if before else [])])
    try:
        client = NotebookClient(
            notebook, timeout=240, kernel_name="python3",
            resources={"metadata": {"path": str(folder)}},
        )  # fmt: skip
        return client.execute()
    finally:
        os.environ.pop("PYTHONPATH")
        if before is not None:
            os.environ["PYTHONPATH"] = before


def outputs(executed: Any) -> list[tuple[str, dict[str, str]]]:
    """The last line of each cell that shows something, and what it shows by kind."""
    found = []
    for cell in executed.cells:
        for output in cell.get("outputs", ()):
            assert output["output_type"] != "error", output
            assert output.get("name") != "stderr", output["text"]
            if "data" in output:
                found.append((cell["source"].splitlines()[-1], dict(output["data"])))
    return found


def shown(executed: Any, line: str) -> dict[str, str]:
    """What the cell that ends in that line shows."""
    return next(data for last, data in outputs(executed) if last == line)


def test_no_cell_fails_or_complains(executed: Any) -> None:
    assert len(outputs(executed)) > 12


def test_figures_and_tables_are_there(executed: Any) -> None:
    for line in ("robot.plot()", "train.plot()", "model.plot()", 'comparison.plot("time 2")',
                 "diagnosis.plot()", 'better.plot("waterfall")'):  # fmt: skip
        assert len(shown(executed, line)["image/png"]) > 5000, line
    for line, words in (
        ("robot", "theta"), ("derivation", "base parameter"), ("model", "relative sigma"),
        ("comparison", "repeatable"), ("diagnosis", "load_friction"), ("module", "demo_arm_"),
    ):  # fmt: skip
        assert words in shown(executed, line)["text/html"], line
    for line in ("derivation.relations", "derivation.closed_form()"):
        assert r"\begin{align" in shown(executed, line)["text/latex"]
    assert all(len(data["text/plain"]) < 1000 for _, data in outputs(executed))


def test_the_error_falls(executed: Any) -> None:
    """The story that the notebook tells is true."""
    table = shown(executed, 'better.table("waterfall")')["text/html"]
    assert "as fitted" in table and "load_friction" in table
    rows = [row.split("<td>")[1:] for row in table.split("<tr>")[2:]]
    first, last = (float(row[2].split("<")[0]) for row in (rows[0], rows[-1]))
    assert last < 0.3 * first
