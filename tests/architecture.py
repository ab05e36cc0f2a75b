"""The house rules as a program: reads the syntax trees of a package, gives what breaks a rule."""

import ast
import sys
from collections.abc import Iterator
from pathlib import Path

NORTH = ("effects", "robot", "symbolic", "base", "terms", "papers", "codegen")
SOUTH = (
    "pictures", "compiled", "logs", "observation", "estimate", "fit", "residuals", "compare",
    "freerun", "fleet", "hypotheses", "scoring", "diagnose", "excite", "pages",
)  # fmt: skip

# Which stages a stage may import, besides itself. The south knows a robot by its manifest only,
# and of the north the catalogue of effects, which imports nothing but the core: columns of an
# effect are evaluated from the same definition that is emitted. The simulator shares no dynamics
# with what it is there to test.
STAGES: dict[str, set[str]] = {
    "core": set(),
    **{stage: {"core", *NORTH[:i]} for i, stage in enumerate(NORTH)},
    **{stage: {"core", *SOUTH[:i]} for i, stage in enumerate(SOUTH)},
    "fleet": {"core", "effects", *SOUTH[: SOUTH.index("fleet")]},
    "jobs": {"core"},
    "hypotheses": {"core", "effects", *SOUTH[: SOUTH.index("hypotheses")]},
    "scoring": {"core", "effects", *SOUTH[: SOUTH.index("scoring")]},
    "diagnose": {"core", "effects", *SOUTH[: SOUTH.index("diagnose")]},
    "logs": {"core"},
    "excite": {"core", "effects", "pictures", "compiled", "observation", "hypotheses"},
    "pages": {"core", "effects", "robot", "show", *SOUTH[: SOUTH.index("pages")]},
    "simulate": {"core", "robot"},
    "show": {"core", "robot"},
    "derivation": {"core", *NORTH},
    "showing": {"core", *NORTH, "show", "pages"},
    "improve": {"core", *NORTH, *SOUTH, "derivation"},
    "methods": {"core", *NORTH, *SOUTH, "simulate", "derivation"},
    "notebook": {"core", *NORTH, *SOUTH, "simulate", "show", "derivation", "showing"},
    "api": {
        "core",
        *NORTH,
        *SOUTH,
        "simulate",
        "derivation",
        "showing",
        "improve",
        "jobs",
        "notebook",
    },
    "cli": {
        "core",
        *NORTH,
        *SOUTH,
        "simulate",
        "show",
        "derivation",
        "showing",
        "improve",
        "jobs",
        "methods",
        "notebook",
        "api",
    },
}

# Which packages of others a stage may import, besides the standard library.
PACKAGES: dict[str, set[str]] = {
    "core": {"numpy", "mpmath", "pandas"},
    "effects": set(),
    "robot": set(),
    "symbolic": {"numpy", "sympy", "casadi", "flint"},
    "base": {"numpy", "sympy"},
    "terms": {"numpy", "sympy"},
    "papers": {"sympy"},
    "codegen": {"numpy", "sympy", "jinja2"},
    "pictures": {"numpy", "matplotlib"},
    "compiled": {"numpy", "cffi", "cupy"},
    "logs": {"numpy", "scipy", "pyarrow", "h5py", "rosbags"},
    "observation": {"numpy", "scipy"},
    "estimate": {"numpy", "scipy", "clarabel", "cvxpy"},
    "fit": {"numpy", "scipy"},
    "residuals": {"numpy", "scipy"},
    "compare": {"numpy", "scipy"},
    "freerun": {"numpy", "scipy"},
    "fleet": {"numpy", "scipy"},
    "jobs": {"distributed"},
    "hypotheses": {"numpy", "scipy"},
    "scoring": {"numpy", "scipy"},
    "diagnose": {"numpy", "threadpoolctl"},
    "pages": {"numpy", "scipy", "jinja2"},
    "simulate": {"numpy", "scipy", "pyarrow", "casadi", "cvxpy"},
    "excite": {"numpy", "matplotlib", "pyarrow"},
    "show": {"numpy", "matplotlib"},
    "derivation": set(),
    "showing": set(),
    "improve": {"numpy", "threadpoolctl"},
    "methods": {"numpy"},
    "notebook": {"numpy"},
    "api": {"numpy"},
    "cli": {"numpy", "rich"},
}

# Packages that few files may know: what replaces such a package replaces these files.
ONLY_IN = {
    "jinja2": ("codegen/render.py", "pages/render.py"),
    "cupy": ("compiled/gpu.py",),
    "cffi": ("compiled/bind.py", "compiled/bind_fused.py", "compiled/bind_tile.py"),
    "casadi": ("symbolic/lagrange.py", "simulate/"),
    "clarabel": ("estimate/possible.py",),
    "cvxpy": ("estimate/consistent.py", "simulate/completion.py"),
    "flint": ("symbolic/balls.py",),
    "pandas": ("core/table.py",),
    "h5py": ("logs/mat.py",),
    "rosbags": ("logs/bags.py",),
    "distributed": ("jobs/cluster.py",),
}

NAMES_THAT_SAY_NOTHING = {"utils", "util", "helpers", "misc", "common", "tools"}
MODULE_LINES = 600


def broken_rules(package: Path) -> list[str]:
    """All that breaks a rule in the folder of a package, as "file:line: what, and the rule"."""
    found: list[str] = []
    for path in modules(package):
        relative = path.relative_to(package).as_posix()
        text = path.read_text(encoding="utf-8")
        tree = ast.parse(text, filename=str(path))
        found += [f"{relative}:{line}: {what}" for line, what in _breaks(relative, text, tree)]
    return found


def modules(package: Path) -> list[Path]:
    """Every Python file of the package."""
    return sorted(path for path in package.rglob("*.py") if "__pycache__" not in path.parts)


def imported_packages(package: Path) -> set[str]:
    """The packages of others that any module imports."""
    names: set[str] = set()
    for path in modules(package):
        names |= {name.split(".")[0] for _, name in _imported(ast.parse(path.read_bytes()))}
    return names - set(sys.stdlib_module_names) - {"", "modeler"}


def _breaks(relative: str, text: str, tree: ast.AST) -> Iterator[tuple[int, str]]:
    yield from _imports(relative, tree)
    yield from _calls(relative, tree)
    yield from _sizes(text)
    if Path(relative).stem in NAMES_THAT_SAY_NOTHING or (
        NAMES_THAT_SAY_NOTHING & set(Path(relative).parent.parts)
    ):
        yield 1, f"the name {relative} says nothing; name the idea"


def _stage(relative: str) -> str:
    """The stage of a file; "" for the package's own __init__.py."""
    return "" if relative == "__init__.py" else relative.split("/")[0].removesuffix(".py")


def _imports(relative: str, tree: ast.AST) -> Iterator[tuple[int, str]]:
    stage = _stage(relative)
    if stage and stage not in STAGES:
        yield 1, f"{stage} is no stage we know; say in architecture.py what it may import"
        return
    for line, name in _imported(tree):
        top, _, rest = name.partition(".")
        if top == "":
            yield line, "relative import; write it absolute"
        elif not stage:
            yield line, f"imports {name}; the package itself imports nothing"
        elif top == "modeler":
            other = rest.split(".")[0]
            if other not in {stage, "__version__"} | STAGES[stage]:
                yield line, f"imports {name}; {stage} may import {_listed(STAGES[stage])}"
        elif top not in sys.stdlib_module_names:
            if top not in PACKAGES[stage]:
                yield line, f"imports {name}; {stage} may import {_listed(PACKAGES[stage])}"
            if top in ONLY_IN and not relative.startswith(ONLY_IN[top]):
                yield line, f"imports {name}; only {_listed(set(ONLY_IN[top]))} may"


def _imported(tree: ast.AST) -> Iterator[tuple[int, str]]:
    """Line and dotted name of every import, inside functions too; ".x" for a relative one."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            module = "." * node.level + (node.module or "")
            if module == "modeler":  # from modeler import robot
                yield from ((node.lineno, f"modeler.{alias.name}") for alias in node.names)
            else:
                yield node.lineno, module


def _calls(relative: str, tree: ast.AST) -> Iterator[tuple[int, str]]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Name) and node.id == "print" and _stage(relative) != "cli":
            yield node.lineno, "print; only cli prints"
        if (isinstance(node, ast.Name) and node.id == "__import__") or (
            isinstance(node, ast.Attribute) and node.attr == "import_module"
        ):
            yield node.lineno, "import by name; write an import statement, so that rules see it"


def _sizes(text: str) -> Iterator[tuple[int, str]]:
    lines = len(text.splitlines())
    if lines > MODULE_LINES:
        yield lines, f"{lines} lines; a module has at most {MODULE_LINES}"


def _listed(names: set[str]) -> str:
    return ", ".join(sorted(names)) or "nothing"
