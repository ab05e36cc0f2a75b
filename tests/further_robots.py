"""Robots with loops beside the checkout: not part of the project, so each may be absent."""

from collections.abc import Iterator
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[2] / "shared" / "robots"


class FurtherRobots:
    """The files of a folder; one that is not there, or has nothing in it, is skipped loudly."""

    def __init__(self, folder: Path = FOLDER) -> None:
        self.folder = folder

    def __truediv__(self, name: str) -> Path:
        path = self.folder / name
        if not path.is_file() or not path.stat().st_size:
            pytest.skip(f"NOT CHECKED: a further robot with loops, nothing in {path}")
        return path

    def all(self) -> Iterator[Path]:
        """Every robot file with content, in the order of their names."""
        return (path for path in sorted(self.folder.glob("*.toml")) if path.stat().st_size)
