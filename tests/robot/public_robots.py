"""Robot files that others publish, from the packages that carry them; none is copied here."""

import importlib.metadata
from pathlib import Path

import pytest


def public_urdfs() -> list[Path]:
    """All URDFs of the package example-robot-data; none where it is not installed."""
    try:
        package = importlib.metadata.distribution("example-robot-data")
    except importlib.metadata.PackageNotFoundError:
        return []
    folder = Path(str(package.locate_file("cmeel.prefix/share/example-robot-data/robots")))
    return sorted(folder.rglob("*.urdf"))


def public_urdf(name: str) -> Path:
    """One of them; skips where the package is missing."""
    for path in public_urdfs():
        if path.name == name:
            return path
    pytest.skip(f"NOT CHECKED: {name}, for example-robot-data is not installed")


def each_public_urdf() -> pytest.MarkDecorator:
    """The test for every one of them, as `path`."""
    found = public_urdfs()
    why = "NOT CHECKED: public URDFs, for example-robot-data is not installed"
    none = [pytest.param(None, id="none", marks=pytest.mark.skip(why))]
    return pytest.mark.parametrize(
        "path", [pytest.param(path, id=path.stem) for path in found] or none
    )
