"""Reference of the Python interface: which objects there are; mkdocstrings writes them out."""

import importlib
import importlib.util
import inspect

STAGES = (
    "robot",
    "derivation",
    "formulas",
    "codegen",
    "runtime",
    "regression",
    "estimation",
    "validation",
    "diagnosis",
    "simulation",
    "papers",
)
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
    """(name, where it is defined) of the functions and classes that a package offers."""
    module = importlib.import_module(module_name)
    offered = {name: getattr(module, name) for name in getattr(module, "__all__", ())}
    return [
        (name, f"{item.__module__}.{item.__qualname__}")
        for name, item in offered.items()
        if inspect.isfunction(item) or inspect.isclass(item)
    ]


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
