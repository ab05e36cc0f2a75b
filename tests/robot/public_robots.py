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


KINDS = ("double_pendulum_continuous", "panda", "so101", "ur5_robot", "allegro_left_hand", "z1")
"""A plane chain, an arm with a gripper that follows, rounded angles, limits of its own, a hand
with branches, bodies on fixed joints: the others rotate."""


def each_public_urdf() -> pytest.MarkDecorator:
    """The test for every one of them, as `path`."""
    paths = public_urdfs()
    why = "NOT CHECKED: public URDFs, for example-robot-data is not installed"
    none = [pytest.param(None, id="none", marks=pytest.mark.skip(why))]
    cases = [
        pytest.param(p, id=p.stem, marks=() if p.stem in KINDS else pytest.mark.rotating)
        for p in paths
    ]
    return pytest.mark.parametrize("path", cases or none)
