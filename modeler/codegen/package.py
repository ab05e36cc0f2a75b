"""What makes an emitted folder a package: its version, what is installed, texts of the build."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from modeler.codegen.examples import (
    COUNT,
    FOLDER,
    SELF_CHECK,
    call_head,
    count_values,
    example_values,
    examples_of,
)
from modeler.codegen.render import render
from modeler.codegen.single import of_precision
from modeler.codegen.vectors import PRODUCTS, TURNING
from modeler.core.contract import FunctionSpec, ModuleSpec

C_INTERFACE = 1
"""Raised when a function of the emitted C takes other arguments under the same name."""


@dataclass(frozen=True)
class Package:
    """How build systems see the folder.

    Attributes:
        signature: of the manifest; where it has fitted values, with these.
        version: see `package_version`.
        sources: C files of the library.
        headers: all that its objects depend on.
        public: headers that a controller includes, installed.
    """

    signature: str
    version: str
    sources: tuple[str, ...]
    headers: tuple[str, ...]
    public: tuple[str, ...]


def package_version(signature: str) -> str:
    """`1.4660.22136.43981`: the C interface, then 48 bits of the signature, 16 in each number.

    Build systems compare numbers, not digests: so `find_package(arm 1.4660.22136.43981)` and
    `pkg-config 'arm = 1.4660.22136.43981'` find this code and no other. There is no order among
    the last three.

    Args:
        signature: of the manifest, hexadecimal.
    """
    words = (int(signature[i : i + 4], 16) for i in (0, 4, 8))
    return ".".join(map(str, (C_INTERFACE, *words)))


def package_files(
    spec: ModuleSpec, code: Mapping[str, str], values: Mapping[str, Any]
) -> dict[str, str]:
    """{name: text} of what builds, checks, installs and explains the library.

    Args:
        spec: the manifest.
        code: {name: text} of all C files that the library is compiled from.
        values: what all templates of the module are given.
    """
    prefix = spec.prefix
    examples, count = examples_of(spec), count_values(spec)
    every = (*spec.functions, *(spec.fitted.functions if spec.fitted else ()))
    given = {
        **values,
        "package": _package(spec, code),
        "folder": FOLDER,
        "examples": examples,
        "programs": (SELF_CHECK, *examples),
        "counts": count is not None,
        "call": {f.name.removeprefix(f"{prefix}_"): call_head(f) for f in every},
        "every": every,
        "fitted": spec.fitted,
        "passive": ", ".join(joint.name for joint in spec.joints if not joint.actuated),
        **_counts(values["functions"], prefix),
    }
    texts = {name: render(template, **given) for name, template in _names(prefix).items()}
    own = {name: example_values(spec, name) for name in examples}
    own |= {SELF_CHECK: _checked(every, prefix)}
    own |= {COUNT: count} if count is not None else {}
    for name, more in own.items():
        texts[f"{FOLDER}/{name}.c"] = render(f"{name}.c", **given, **more)
    return of_precision(spec.precision, texts)


def _names(prefix: str) -> dict[str, str]:
    """{file: template} of what every folder has."""
    return {
        "Makefile": "Makefile",
        "CMakeLists.txt": "CMakeLists.txt",
        f"{prefix}.pc.in": "package.pc.in",
        f"{prefix}-config.cmake": "config.cmake",
        f"{prefix}-config-version.cmake": "config-version.cmake",
        "README.md": "README.md",
    }


def _package(spec: ModuleSpec, code: Mapping[str, str]) -> Package:
    prefix = spec.prefix
    signature = spec.signature() if spec.fitted is None else spec.fitted.signature
    public = [
        name for name in (f"{prefix}.h", f"{prefix}_fitted.h", f"{prefix}_tile.h") if name in code
    ]
    for name in public:  # grows while it is read
        public += [h for h in _included(code[name]) if h in code and h not in public]
    return Package(
        signature=signature,
        version=package_version(signature),
        sources=tuple(name for name in code if name.endswith(".c")),
        headers=tuple(name for name in code if name.endswith(".h")),
        public=tuple(public),
    )


def _included(text: str) -> list[str]:
    return re.findall(r'^#include "([^"]+)"', text, flags=re.MULTILINE)


def _checked(every: Sequence[FunctionSpec], prefix: str) -> dict[str, Any]:
    """The functions in the order of the check: what is compared with others comes after them."""
    products = {f"{prefix}_{role}" for role in PRODUCTS}
    order = sorted(every, key=lambda f: (f.name in products, f.name != f"{prefix}_base_parameters"))
    largest = max(f.outputs[0].size for f in every)
    return {"checked": order, "products": PRODUCTS, "turning": TURNING, "largest": largest}


def _counts(functions: Sequence[Any], prefix: str) -> dict[str, dict[str, int]]:
    """Operations of closing loops: equations and derivatives, and the solution."""
    return {
        "turn": _operations(functions, f"{prefix}_tree_closure"),
        "solving": _operations(functions, f"{prefix}_tree_factor", f"{prefix}_tree_solve"),
    }


def _operations(functions: Sequence[Any], *names: str) -> dict[str, int]:
    """Operations of the functions of these names together."""
    own = [f for f in functions if f.name in names]
    return {
        "additions": sum(f.additions for f in own),
        "multiplications": sum(f.multiplications for f in own),
    }
