"""The demonstration arm of the diagnoses, for the pages about them."""

import pytest

from tests.diagnose.conftest import Case, demonstration


@pytest.fixture(scope="session")
def case() -> Case:
    """Sampled at 250 Hz."""
    return demonstration()
