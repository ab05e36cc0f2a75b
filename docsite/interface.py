"""Reference of the Python interface: which objects there are; mkdocstrings writes them out."""

import importlib
import importlib.util
import inspect
from collections.abc import Iterator
from types import ModuleType
from typing import Any

STAGES = (
    "robot", "derivation", "formulas", "codegen", "runtime", "observation", "estimation",
    "validation", "diagnosis", "fleet", "simulation", "papers",
)  # fmt: skip
"""Stages with pages of their own, in the order of the data; `modeler.api` comes before them."""


def interface_pages() -> dict[str, str]:
    """{"python/estimation.md": text} of `modeler.api`, of each stage, and an index of them."""
    shown: set[str] = set()
    pages = {"python/api.md": _page("modeler.api", shown)}
    for stage in _stages():
        pages[f"python/{stage}.md"] = _page(f"modeler.{stage}", shown)
    return {"python/index.md": _index(), **pages}


def _stages() -> list[str]:
    return [stage for stage in STAGES if exported(f"modeler.{stage}")]


def exported(module_name: str) -> list[tuple[str, str]]:
    """(name, where it is defined) of the functions and classes that a module hands on."""
    module = importlib.import_module(module_name)
    entries = f"{module_name}.entries"  # of stages that are loaded when they are needed
    if hasattr(module, "__path__") and importlib.util.find_spec(entries) is not None:
        module = importlib.import_module(entries)
    return [(name, f"{found.__module__}.{found.__qualname__}") for name, found in _public(module)]


def _public(module: ModuleType) -> Iterator[tuple[str, Any]]:
    for name, found in vars(module).items():
        ours = str(getattr(found, "__module__", "")).startswith("modeler")
        kind = inspect.isfunction(found) or inspect.isclass(found)
        if ours and kind and name[0] != "_" and _is_handed_on(module, name, found):
            yield name, found


def _is_handed_on(module: ModuleType, name: str, found: Any) -> bool:
    """Defined there, or imported as itself (`import x as x`), which hands it on."""
    inside = found.__module__ == module.__name__
    return inside or f"import {name} as {name}\n" in inspect.getsource(module)


def _index() -> str:
    lines = ["# Python", "", _docstring("modeler.api"), ""]
    lines += [
        "All of it: [modeler.api](api.md). The stages it is made of, in the order of the data:"
    ]
    lines += [""]
    for stage in _stages():
        lines.append(f"* [modeler.{stage}]({stage}.md): {_first_line(f'modeler.{stage}')}")
    return "\n".join(lines) + "\n"


def _docstring(module_name: str) -> str:
    return inspect.cleandoc(importlib.import_module(module_name).__doc__ or "")


def _first_line(module_name: str) -> str:
    return _docstring(module_name).split("\n\n")[0].replace("\n", " ")


def _page(module_name: str, shown: set[str]) -> str:
    """The objects of a module, one after the other; `shown`, on earlier pages, are left out."""
    parts = [f"# {module_name}", "", _docstring(module_name), ""]
    for _, path in sorted(exported(module_name), key=lambda entry: entry[0].lower()):
        if path not in shown:
            parts += [f"::: {path}", ""]
            shown.add(path)
    return "\n".join(parts)
