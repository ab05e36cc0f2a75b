"""All of this needs a C compiler."""

import pytest

from tests.hidden_effects.plant import NoCompiler, compiler


@pytest.fixture(scope="session")
def plant_compiler() -> list[str]:
    """A C compiler for the simulated arm, or no test."""
    try:
        return compiler()
    except NoCompiler as problem:
        pytest.skip(f"NOT CHECKED: hidden effects: {problem}")
