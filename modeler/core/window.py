"""A log, or a piece of it, as it is typed: FILE, or FILE@START:END."""

from pathlib import Path


def file_and_window(place: str) -> tuple[str, str | None]:
    """The file, and what stands after its last "@"; None if that belongs to the file's name."""
    path, at, window = place.rpartition("@")
    return (place, None) if not at or Path(place).exists() else (path, window)
