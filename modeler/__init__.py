"""A code-generating symbolic modeler for robot dynamics.

    import modeler as md

    model = md.identify("arm.toml", ["mon.csv", "tue.parquet"])
    model["Fs2"], model.error("wed.csv")

All of it is `modeler.api`, whose names are here too. Data flows one way::

    effects -> robot -> derivation -> codegen => C + manifest
            => runtime -> logs -> regression -> estimation -> validation -> diagnosis -> robot ...

The packages before the emitted C derive (sympy, casadi, jinja2); those after it only use numbers.
A robot names effects of the catalogue; `formulas` stands beside codegen and writes for people;
`simulation` has physics of its own; `formats` reads and writes robots of other programs;
`numerics` has the linear algebra of all; `excitation` and `papers` build on them; `views` shows
results; `api` has a function a command, of which `cli` and `studio` are skins.
docs/explanation/architecture.md shows the architecture.
This module imports nothing before a name of the API is requested, so that the numeric stages never
load the symbolic ones.
"""

__version__ = "0.1.0"

_PACKAGES = (
    "api", "cli", "codegen", "core", "derivation", "diagnosis", "effects", "estimation",
    "excitation", "formats", "formulas", "logs", "numerics", "regression", "papers",
    "views", "robot", "runtime", "simulation", "studio", "validation",
)  # fmt: skip


def __getattr__(name: str) -> object:
    """A name of `modeler.api`; packages are imported by their own names."""
    if name in _PACKAGES or name.startswith("_"):
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from modeler import api

    try:
        return getattr(api, name)
    except AttributeError:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}") from None


def __dir__() -> list[str]:
    from modeler import api

    return sorted({*globals(), *dir(api)} - {"_PACKAGES"})
