"""The rules of the architecture: reads the syntax trees of a package, yields what breaks a rule."""

import ast
import sys
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

NORTH = ("effects", "robot", "derivation", "formulas", "codegen")
SOUTH = tuple("numerics runtime logs regression estimation diagnosis validation excitation".split())

# Which packages a package may import, besides itself. The south knows a robot by its manifest only,
# and of the north the catalogue of effects, which imports nothing but the core: columns of an
# effect are evaluated from the same definition that is emitted. The simulator shares no dynamics
# with what it is there to test.
STAGES: dict[str, set[str]] = {
    "core": set(),
    **{stage: {"core", *NORTH[:i]} for i, stage in enumerate(NORTH)},
    **{stage: {"core", *SOUTH[:i]} for i, stage in enumerate(SOUTH)},
    "logs": {"core", "numerics"},
    "diagnosis": {"core", "effects", *SOUTH[: SOUTH.index("diagnosis")]},
    "validation": {"core", "effects", *SOUTH[: SOUTH.index("validation")]},
    "excitation": {"core", "effects", "numerics", "runtime", "regression", "diagnosis"},
    "simulation": {"core", "numerics", "robot"},
    "formats": {"core", "effects", "robot", "numerics", "runtime", "regression", "estimation"},
    "papers": {"core", *NORTH, *SOUTH[:2], "regression", "estimation", "simulation", "excitation"},
    "views": {"core", *NORTH, *SOUTH, "simulation"},
    "api": {"core", *NORTH, *SOUTH, "simulation", "formats", "views"},
    "studio": {"api"},
    "cli": {"core", *NORTH, *SOUTH, "simulation", "papers", "formats", "views", "api", "studio"},
}

# An effect goes round: from the diagnosis into the robot description, and from there all the way.
ROUND = {"diagnosis/add.py": {"robot", "codegen"}, "diagnosis/added_model.py": {"robot"}}

# Which packages of others a package may import, besides the standard library.
PACKAGES: dict[str, set[str]] = {
    "core": {"numpy", "mpmath", "pandas", "distributed"},
    "numerics": {"numpy", "scipy", "clarabel"},
    "effects": set(),
    "robot": {"tomlkit"},
    "derivation": {"numpy", "sympy", "casadi", "flint"},
    "formulas": {"numpy", "sympy"},
    "codegen": {"numpy", "sympy", "jinja2", "casadi"},
    "runtime": {"numpy", "cffi", "cupy"},
    "logs": {"numpy", "scipy", "pyarrow", "h5py", "rosbags", "python_calamine"},
    "regression": {"numpy", "scipy"},
    "estimation": {"numpy", "scipy"},
    "diagnosis": {"numpy", "scipy", "threadpoolctl"},
    "validation": {"numpy", "scipy"},
    "excitation": {"numpy", "scipy", "matplotlib", "pyarrow"},
    "simulation": {"numpy", "scipy", "pyarrow", "casadi"},
    "formats": {"numpy", "scipy", "mujoco"},
    "papers": {"numpy", "sympy"},
    "views": {"numpy", "scipy", "matplotlib", "jinja2"},
    "api": {"numpy", "sklearn"},
    "studio": {"numpy", "nicegui", "fastapi", "starlette", "uvicorn"},
    "cli": {"numpy", "rich"},
}

# Packages that few files may know: what replaces such a package replaces these files.
ONLY_IN = {
    "jinja2": ("codegen/package.py", "views/page.py"),
    "cupy": ("runtime/gpu.py",),
    "cffi": ("runtime/bind.py",),
    "casadi": ("derivation/lagrange.py", "codegen/casadi_functions.py", "simulation/"),
    "clarabel": ("numerics/least_squares.py",),
    "flint": ("derivation/field.py", "derivation/precise.py"),
    "pandas": ("core/table.py",),
    "h5py": ("logs/arrays.py",),
    "rosbags": ("logs/bags.py",),
    "python_calamine": ("logs/blocks.py",),
    "distributed": ("core/jobs.py",),
    "sklearn": ("api/regressor.py",),
    "mujoco": ("formats/mjcf.py",),
    "tomlkit": ("robot/edit.py", "robot/robot_text.py"),
    "matplotlib": ("views/", "excitation/result.py"),
}

# The ratchet: it may only be lowered, or raised by a line that says why.
MOST_PACKAGES = 21  # readers and writers of other formats in one; fleets are validation
MOST_MODULES = 328
MOST_CODE_LINES = 78800
MOST_CIRCLES = 0

# Packages without a public interface: their modules are collections by subject, each imported by
# its own name.
COLLECTIONS = {"core", "numerics"}

# The public interface of the API is what users were promised; the command line and the studio are
# other skins.
SKINS = (("cli", "api"), ("studio", "api"))

NAMES_THAT_SAY_NOTHING = {"utils", "util", "helpers", "misc", "common", "tools"}
MODULE_LINES = 700


def broken_rules(package: Path) -> list[str]:
    """All that breaks a rule in the folder of a package, as "file:line: what, and the rule"."""
    breaks: list[str] = []
    for path in modules(package):
        relative = path.relative_to(package).as_posix()
        text = path.read_text(encoding="utf-8")
        breaks += [f"{relative}:{line}: {what}" for line, what in _breaks(relative, text)]
    return breaks


@cache
def _nodes(text: str) -> tuple[ast.AST, ...]:
    """The nodes of a module that rules are about, and texts of several lines."""
    return tuple(
        node
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Import | ast.ImportFrom | ast.Name | ast.Attribute | ast.Expr)
        or (isinstance(node, ast.Constant | ast.JoinedStr) and node.end_lineno != node.lineno)
    )


def modules(package: Path) -> list[Path]:
    """Every Python file of the package."""
    return sorted(path for path in package.rglob("*.py") if "__pycache__" not in path.parts)


def imported_packages(package: Path) -> set[str]:
    """The packages of others that any module imports."""
    names: set[str] = set()
    for path in modules(package):
        text = path.read_text(encoding="utf-8")
        names |= {name.split(".")[0] for _, name in _imported(text)}
    return names - set(sys.stdlib_module_names) - {"", "modeler"}


def _breaks(relative: str, text: str) -> Iterator[tuple[int, str]]:
    yield from _imports(relative, text)
    yield from _calls(relative, text)
    yield from _sizes(text)
    if Path(relative).stem in NAMES_THAT_SAY_NOTHING or (
        NAMES_THAT_SAY_NOTHING & set(Path(relative).parent.parts)
    ):
        yield 1, f"the name {relative} says nothing; name the idea"


def _stage(relative: str) -> str:
    """The stage of a file; "" for the package's own __init__.py."""
    if relative == "__main__.py":  # `python -m modeler`
        return "cli"
    return "" if relative == "__init__.py" else relative.split("/")[0].removesuffix(".py")


def _imports(relative: str, text: str) -> Iterator[tuple[int, str]]:
    stage = _stage(relative)
    if stage and stage not in STAGES:
        yield 1, f"{stage} is no stage we know; say in architecture.py what it may import"
        return
    for line, name in _imported(text):
        top, _, rest = name.partition(".")
        if top == "":
            yield line, "relative import; write it absolute"
        elif not stage:
            if name != "modeler.api":  # in a function, when a name is requested
                yield line, f"imports {name}; the package itself imports nothing but modeler.api"
        elif top == "modeler":
            other = rest.split(".")[0]
            if other not in {stage, "__version__"} | STAGES[stage] | ROUND.get(relative, set()):
                yield line, f"imports {name}; {stage} may import {_listed(STAGES[stage])}"
            elif "." in rest and other not in {stage, *COLLECTIONS} and (stage, other) not in SKINS:
                face = f"modeler/{other}/__init__.pyi"
                yield line, f"imports {name}; what others may use is in {face}"
        elif top == "lazy_loader":
            if Path(relative).name != "__init__.py" and stage != "logs":  # which loads Arrow so
                yield line, "imports lazy_loader; only a package's __init__.py and logs may"
        elif top not in sys.stdlib_module_names:
            if top not in PACKAGES[stage]:
                yield line, f"imports {name}; {stage} may import {_listed(PACKAGES[stage])}"
            if top in ONLY_IN and not relative.startswith(ONLY_IN[top]):
                yield line, f"imports {name}; only {_listed(set(ONLY_IN[top]))} may"


def _imported(text: str) -> Iterator[tuple[int, str]]:
    """Line and dotted name of every import, inside functions too; ".x" for a relative one."""
    for node in _nodes(text):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            module = "." * node.level + (node.module or "")
            if module == "modeler":  # from modeler import robot
                yield from ((node.lineno, f"modeler.{alias.name}") for alias in node.names)
            else:
                yield node.lineno, module


def _calls(relative: str, text: str) -> Iterator[tuple[int, str]]:
    for node in _nodes(text):
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


def code_lines(package: Path) -> int:
    """Lines of the package without blanks, comments and docstrings."""
    return sum(_code_lines(path.read_text(encoding="utf-8")) for path in modules(package))


def _code_lines(text: str) -> int:
    bare = (line.strip() for line in text.splitlines())
    lines = {k for k, line in enumerate(bare, start=1) if line and not line.startswith("#")}
    docs: set[int] = set()
    for node in _nodes(text):
        value = node.value if isinstance(node, ast.Expr) else None
        if isinstance(value, ast.Constant) and isinstance(value.value, str):
            docs |= _span(value)
        elif isinstance(node, ast.Constant | ast.JoinedStr):
            lines |= _span(node)  # blank lines in a text are of the program
    return len(lines - docs)


def _span(node: ast.expr) -> set[int]:
    return set(range(node.lineno, (node.end_lineno or node.lineno) + 1))


def circles(package: Path) -> list[set[str]]:
    """Modules that import each other, in functions and for types too."""
    names = {_dotted(path, package): path for path in modules(package)}
    exported = _exported(package)
    graph = {
        name: {
            imported
            for _, target in _targets(path.read_text(encoding="utf-8"))
            for imported in exported.get(target, {target, target.rpartition(".")[0]})
            if imported in names and imported != name and names[imported].name != "__init__.py"
        }
        for name, path in names.items()
        if path.name != "__init__.py"
    }
    reached = {name: _reached(graph, name) for name in graph}
    rings = {
        frozenset({name, *(other for other in reached[name] if name in reached[other])})
        for name in graph
        if name in reached[name]
    }
    return [set(ring) for ring in rings]


def _exported(package: Path) -> dict[str, set[str]]:
    """The modules behind every name of a package's interface, and behind the package itself."""
    behind: dict[str, set[str]] = {}
    for path in package.glob("*/__init__.pyi"):
        room = f"{package.name}.{path.parent.name}"
        for node in ast.walk(ast.parse(path.read_bytes())):
            if isinstance(node, ast.ImportFrom):
                for alias in node.names:
                    module = f"{room}.{node.module or alias.name}"
                    behind[f"{room}.{alias.name}"] = {module}
                    behind.setdefault(room, set()).add(module)
    return behind


def _dotted(path: Path, package: Path) -> str:
    parts = path.relative_to(package.parent).with_suffix("").parts
    return ".".join(parts).removesuffix(".__init__")


def _targets(text: str) -> Iterator[tuple[int, str]]:
    """Line and dotted name of all that is imported, names from modules with them."""
    for node in _nodes(text):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level:
            yield from ((node.lineno, f"{node.module}.{alias.name}") for alias in node.names)


def _reached(graph: Mapping[str, set[str]], start: str) -> set[str]:
    reached: set[str] = set()
    left = list(graph[start])
    while left:
        name = left.pop()
        if name not in reached:
            reached.add(name)
            left += graph.get(name, ())
    return reached
