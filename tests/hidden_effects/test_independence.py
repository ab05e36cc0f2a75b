"""The generator shares nothing with what it is there to test."""

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


def test_the_only_import_is_the_chain_and_not_in_passing():
    """Inside of a function: whoever imports the generator does not load the package."""
    lines = [line for f in generator() for line in f.read_text(encoding="utf-8").splitlines()]
    other = [x for x in lines if "import" in x and " tests." in x and "hidden_effects" not in x]
    assert other == ["    from tests.chain import diagnose_case"]
