"""The generator shares nothing with what it is there to test."""

import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
TESTED = "modeler"


def generator() -> list[Path]:
    """Every source but the tests."""
    files = [*HERE.glob("*.py"), *HERE.glob("*.c"), *HERE.glob("*.h")]
    return [f for f in files if not f.name.startswith("test_")]


def test_no_source_names_the_package():
    assert len(generator()) > 15
    named = [f.name for f in generator() if TESTED in f.read_text(encoding="utf-8").lower()]
    assert named == []


def test_the_only_import_is_the_chain():
    lines = [line for f in generator() for line in f.read_text(encoding="utf-8").splitlines()]
    other = [x for x in lines if "import" in x and " tests." in x and "hidden_effects" not in x]
    assert [line.split() for line in other] == [["from", "tests.chain", "import", "diagnose_case"]]


def test_it_is_not_loaded_in_passing():
    program = f"import sys, tests.hidden_effects.__main__; print({TESTED!r} in sys.modules)"
    command = [sys.executable, "-c", program]
    ran = subprocess.run(command, capture_output=True, text=True, check=True, cwd=HERE.parents[1])
    assert ran.stdout == "False\n"
