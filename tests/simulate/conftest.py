"""Plants of short logs are interpreted: to compile one takes longer than it saves."""

import pytest

from modeler.simulation import plant


@pytest.fixture
def compiled_plants() -> None:
    """Requested by tests of the compiled plant."""


@pytest.fixture(autouse=True)
def interpreted_plants(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    if "compiled_plants" not in request.fixturenames:
        monkeypatch.setattr(plant, "compile_if_possible", lambda function: function)
