"""The examples of docs/reference/python.md, type-checked from outside."""

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.repository import ROOT

# A checker reads the whole package.
pytestmark = [pytest.mark.slow, pytest.mark.rotating("type checkers")]


USES = """
import numpy as np
import pandas as pd
import polars as pl

import modeler as md
from modeler.api import diagnose

one: md.Model = md.identify("arm.toml", "run.csv@0:10")
two: md.Model = md.identify(md.open_robot("emps"), [pd.DataFrame(), pl.DataFrame(), "x.parquet"])
three = md.identify("emps", {"time": [0.0], "q": np.zeros((1, 1))}, mapping={"q1": "a"})
four = md.identify("emps", pl.DataFrame(), pl.DataFrame(), method="robust", mapping="auto")
value: float = one["Fs2"].value
low, high = one["Fs2"].conf_int(0.95)
error: float = one.error(pl.DataFrame())
added: md.Model = one.add("spring", joint=2, held_out=["x.csv", pl.DataFrame()])
added = md.add(added, "spring", ["x.csv"])
added = md.remove_last(md.reduced_model(added), ["x.csv"])
found: md.Diagnosis = diagnose(one, ["x.csv"])
files: dict[str, str] = one.to_c("out").code
"""

WRONG = """
import modeler as md

md.identify("arm.toml", 3)
md.identify("arm.toml", "x.csv").eror("x.csv")
md.identify("arm.toml", "x.csv", method="weigthed")
md.identify("arm.toml", "x.csv")["Fs2"].value.lower()
md.opn_model("x")
"""


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of somebody else: the page's programs, further uses, and mistakes."""
    folder = tmp_path_factory.mktemp("outside")
    page = (ROOT / "docs" / "reference" / "python.md").read_text(encoding="utf-8")
    blocks = [part.split("```")[0] for part in page.split("```python\n")[1:]]
    assert len(blocks) >= 4
    for k, block in enumerate(blocks):
        # what a block takes from those before it stands before it
        head = (
            "import modeler as md\nmodel = md.open_model('arm.json')\n" if "model." in block else ""
        )
        (folder / f"page{k}.py").write_text(block if "model = " in block else head + block)
    (folder / "uses.py").write_text(USES)
    (folder / "wrong.py").write_text(WRONG)
    return folder


def run(folder: Path, *words: str) -> tuple[int, str]:
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "MYPYPATH": str(ROOT)}
    ran = subprocess.run(
        [sys.executable, "-m", *words],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=600,
    )
    return ran.returncode, ran.stdout + ran.stderr


def right(folder: Path) -> list[str]:
    return sorted(p.name for p in folder.glob("*.py") if p.name != "wrong.py")


def test_mypy_strict(programs: Path) -> None:
    packages = ("pandas", "sklearn", "sklearn.*")  # that are not typed themselves
    lines = "\n".join(f"[mypy-{name}]\nignore_missing_imports = true" for name in packages)
    (programs / "mypy.ini").write_text(f"[mypy]\nstrict = true\n{lines}\n")
    status, out = run(programs, "mypy", *right(programs))
    assert status == 0, out
    status, out = run(programs, "mypy", "wrong.py")
    lines_told = {line.split(":")[1] for line in out.splitlines() if ": error:" in line}
    assert lines_told == {"4", "5", "6", "7", "8"}, out


def test_pyright(programs: Path) -> None:
    if importlib.util.find_spec("pyright") is None or shutil.which("node") is None:
        pytest.skip("NOT CHECKED: pyright needs the package pyright and node")
    words = ("pyright", "--pythonpath", sys.executable)
    status, out = run(programs, *words, *right(programs))
    if "npm" in out and status not in (0, 1):
        pytest.skip(f"NOT CHECKED: pyright cannot be loaded here: {out[-300:]}")
    assert status == 0, out
    status, out = run(programs, *words, "wrong.py")
    lines_told = {line.split(":")[1] for line in out.splitlines() if " error: " in line}
    assert status == 1 and lines_told == {"4", "5", "6", "7", "8"}, out
