"""The robots that come with the tool: TOML files in `library/` beside this module."""

from pathlib import Path

_LIBRARY = Path(__file__).resolve().parent / "library"


def builtin_names() -> tuple[str, ...]:
    """Names of the built-in robots, sorted."""
    return tuple(sorted(file.stem for file in _LIBRARY.glob("*.toml")))


def builtin_text(name: str) -> str:
    """The TOML text of a built-in robot.

    Raises:
        KeyError: there is none of that name.
    """
    if name not in builtin_names():
        raise KeyError(name)
    return builtin_file(name).read_text(encoding="utf-8")


def builtin_file(name: str) -> Path:
    """Where the text of a built-in robot stands."""
    return _LIBRARY / f"{name}.toml"
