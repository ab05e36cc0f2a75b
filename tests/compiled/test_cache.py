"""The cache of compiled libraries may be deleted at any time."""

import shutil
from pathlib import Path

import pytest

from modeler.runtime.model import load_module
from tests.modules import module


@pytest.fixture
def cache(tmp_path, monkeypatch) -> Path:
    folder = tmp_path / "cache"
    monkeypatch.setenv("MODELER_CACHE", str(folder))
    return folder


def test_a_loaded_library_may_go(cache) -> None:
    model = load_module(module("emps").emitted.spec, module("emps").emitted.files)
    shutil.rmtree(cache)
    assert model.gravity([[0.1]], [1.0] * len(model.spec.base)).shape == (1, 1)
