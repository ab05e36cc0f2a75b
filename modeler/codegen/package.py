"""What makes an emitted folder a package: templates, version, what is installed."""

import hashlib
import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

import jinja2

from modeler import __version__
from modeler.codegen.functions import read_catalogue
from modeler.codegen.vectors import PRODUCTS, TURNING
from modeler.core.errors import ModelerError
from modeler.core.files import locate_resources, write_atomically, write_files
from modeler.core.manifest import (
    CLOSURE_RUNTIME,
    CONTROL_RUNTIME,
    MANIFEST,
    EmittedModule,
    FunctionSpec,
    ModuleSpec,
    OriginSpec,
    digest_text,
)

# The programs of a folder.


FOLDER = "programs"
"""Of a module's folder, so that all C files beside the library's are the library's."""

_EXAMPLES: Mapping[str, Any] = read_catalogue()["examples"]
EXAMPLES = tuple(_EXAMPLES)
"""Templates, and names of the programs."""

SELF_CHECK = "self_check"
COUNT = "count_instructions"
VECTORS = "run_vectors"
PROGRAMS = (SELF_CHECK, COUNT, VECTORS, *EXAMPLES)
"""All programs that a module may have."""

# Which files of a folder an earlier `modeler generate` wrote, and as what.
#
# The record is the file `generated.sha256` beside them, in the form that `sha256sum -c` reads: one
# line per file, checksum and name.


RECORD = "generated.sha256"
_LINE = re.compile(r"([0-9a-f]{64})  (\S.*)")

Record = Mapping[str, frozenset[str]]
"""Checksums by name of file; two of a file while it is being replaced."""


def hash_content(content: bytes) -> str:
    """Returns SHA-256, in hexadecimal digits."""
    return hashlib.sha256(content).hexdigest()


def read_record(folder: Path) -> Record | None:
    """Returns what was written into the folder.

    Empty if nothing is known; None if that file is no record.

    Raises:
        OSError: the record cannot be read.
    """
    path = folder / RECORD
    if not path.exists():
        return {}
    if not path.is_file():
        return None
    record: dict[str, frozenset[str]] = {}
    for line in path.read_bytes().decode(errors="replace").splitlines():
        match = _LINE.fullmatch(line)
        if match is None:
            return None
        record[match[2]] = record.get(match[2], frozenset()) | {match[1]}
    return record


def format_record(record: Record) -> str:
    """Returns the record as a file."""
    lines = [f"{sum_}  {name}" for name in sorted(record) for sum_ in sorted(record[name])]
    return "".join(f"{line}\n" for line in lines)


# Emitted files to disk, over what an earlier run wrote and over nothing else.


def write_emitted(emitted: EmittedModule, folder: Path, force: bool = False) -> tuple[str, ...]:
    """Returns names of the files that were written: those that are new or have changed.

    A file that says the same already keeps its time, so that `make` has nothing to do. Other files
    of the folder are left alone: it may be the user's controller. What is written is recorded
    beside it (`generated.sha256`), so that the next run knows its own files from the user's. What
    had the values of a model goes where none are emitted, unless it was edited (`leftovers`).

    Args:
        emitted: the files.
        folder: made if it is not there.
        force: write also over files that no earlier run wrote, or that were edited since.

    Raises:
        ModelerError: the folder holds such files, which are named, and nothing is written; or it
            cannot be written.
    """
    folder = Path(folder)
    new = {name: text.encode() for name, text in emitted.files.items()}
    try:
        old = {name: _read_content(folder / name) for name in new}
        known = read_record(folder)
    except OSError as error:
        raise ModelerError(
            f"{error.filename or folder}: cannot be read ({error.strerror}); nothing is written "
            "over what is not known; choose another folder"
        ) from error
    changed = [name for name in new if old[name] != new[name]]
    if not force:
        _check_overwrite(folder, [name for name in changed if old[name] is not None], old, known)
    record = {name: sums for name, sums in (known or {}).items() if (folder / name).is_file()}
    sums = {name: frozenset([hash_content(content)]) for name, content in new.items()}
    gone = _find_unedited(folder, {n: s for n, s in record.items() if n in _list_unwanted(emitted)})
    # Both are known while files are replaced, so that a run that was killed can be repeated.
    both = {**record, **{n: s | record.get(n, frozenset()) for n, s in sums.items()}}
    files = [(folder / name, new[name]) for name in changed]
    if files or gone:
        texts = [(folder / RECORD, format_record(both).encode()), *files]
        write_files(texts, [folder / name for name in gone])
    last = {**{n: s for n, s in record.items() if (folder / n).is_file()}, **sums}
    if last != known:
        write_atomically(folder / RECORD, format_record(last))
    return tuple(changed)


def _list_unwanted(emitted: EmittedModule) -> set[str]:
    """Files of an earlier run with other options, not emitted now."""
    prefix = emitted.spec.prefix
    units = ("fitted", "control", "joints", "batch", "tile", "regressor", "base_regressor")
    names = {f"{prefix}_{unit}.{kind}" for unit in units for kind in "hc"}
    names |= {f"{prefix}.{kind}" for kind in ("cu", "st", "a2l", "hpp")} | {f"{prefix}_generator.h"}
    names |= {"vectors.csv", "cost.json"}  # the runtime may be that of another robot's files too
    names |= {f"{FOLDER}/{name}.c" for name in PROGRAMS}
    return names - emitted.files.keys()


def list_leftovers(emitted: EmittedModule, folder: str | Path) -> list[str]:
    """Returns files with a model's values that are not emitted now.

    And stay because they were edited.

    Args:
        emitted: what `write_emitted` wrote.
        folder: where.
    """
    known = read_record(Path(folder)) or {}
    return sorted(known.keys() & _list_unwanted(emitted))


def _find_unedited(folder: Path, stale: Record) -> set[str]:
    """Names of the files of an earlier run that say what it wrote."""
    same = set()
    for name, sums in stale.items():
        with suppress(OSError):  # what cannot be read stays
            if hash_content((folder / name).read_bytes()) in sums:
                same.add(name)
    return same


def _read_content(path: Path) -> bytes | None:
    """Of a file; empty of anything else, None of nothing."""
    if path.is_file():
        return path.read_bytes()
    return b"" if path.exists() else None


def _check_overwrite(
    folder: Path, changed: Sequence[str], old: dict[str, bytes | None], known: Record | None
) -> None:
    """Nothing is lost that somebody wrote by hand."""
    foreign, edited = [RECORD] if known is None else [], []
    for name in changed:
        content = old[name]
        if not known or name not in known:
            foreign.append(name)
        elif content is not None and hash_content(content) not in known[name]:
            edited.append(name)
    problems = []
    if foreign:
        problems.append(f"{', '.join(sorted(foreign))}, not known to be of an earlier generate")
    if edited:
        problems.append(f"{', '.join(sorted(edited))}, edited since an earlier generate")
    if problems:
        raise ModelerError(
            f"{folder}: would write over {'; and over '.join(problems)}; choose another folder, or "
            "write over them with --force"
        )


# The Jinja environment; nothing else knows Jinja.
#
# Templates lay out finished strings, with `for` and `if` and nothing more.


@cache
def _get_environment() -> jinja2.Environment:
    return jinja2.Environment(
        loader=jinja2.FileSystemLoader(locate_resources("templates")),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,  # C, make and Markdown are no HTML
    )


def render(template: str, **values: Any) -> str:
    """Returns text of `templates/<template>.jinja` with these values."""
    return _get_environment().get_template(f"{template}.jinja").render(**values)


C_INTERFACE = 2
"""Raised when a function of the emitted C takes other arguments under the same name, or stands in
another header or library."""

LICENSE = "MIT"
"""SPDX identifier of what is emitted: that of the templates and of the runtime."""


def make_origin() -> OriginSpec:
    """Returns what the manifest and a header say of this version.

    The other files are the robot's alone.
    """
    return OriginSpec(C_INTERFACE, f"modeler {__version__}", LICENSE)


def format_package_version(signature: str) -> str:
    """Returns `2.4660.22136.43981`.

    The C interface, then 48 bits of the signature, 16 in each number.

    Build systems compare numbers, not digests: so `find_package(arm 2.4660.22136.43981)` and
    `pkg-config 'arm = 2.4660.22136.43981'` find this code and no other. There is no order among
    the last three.

    Args:
        signature: of the manifest, hexadecimal.
    """
    words = (int(signature[i : i + 4], 16) for i in (0, 4, 8))
    return ".".join(map(str, (C_INTERFACE, *words)))


def build_package_files(
    spec: ModuleSpec, code: Mapping[str, str], values: Mapping[str, Any]
) -> dict[str, str]:
    """Returns {name: text} of what builds, checks, installs and explains the library.

    Args:
        spec: the manifest.
        code: {name: text} of all C files that the library is compiled from.
        values: what all templates of the module are given.
    """
    prefix = spec.prefix
    examples, count = select_examples(spec), count_values(spec)
    every = spec.every_function
    values = {
        **values,
        "origin": make_origin(),
        "status": any(f.status for f in every),
        "package": _describe_package(spec, code),
        "folder": FOLDER,
        "examples": examples,
        "programs": (SELF_CHECK, *([VECTORS] if values["many_states"] else []), *examples),
        "counts": count is not None,
        "call": {f.name.removeprefix(f"{prefix}_"): format_call_head(f) for f in every},
        "every": every,
        "roles": {f.name.removeprefix(f"{prefix}_") for f in every},
        "batched": spec.has_unit("_batch"),
        "at_state": set(
            re.findall(r"\b\w+_at(?=\()", "".join(code[h] for h in code if h.endswith(".h")))
        ),
        "closure_files": CLOSURE_RUNTIME if spec.closure is not None else (),
        "control_files": [
            name for name in CONTROL_RUNTIME if spec.closure is None or name not in CLOSURE_RUNTIME
        ],
        "head": f"{prefix}{next((u for u in ('_control', '_fitted') if spec.has_unit(u)), '')}",
        "fitted": spec.fitted,
        "passive": ", ".join(joint.name for joint in spec.joints if not joint.actuated),
        # Operations of closing loops: equations and derivatives, and the solution.
        "turn": _sum_operations(values["functions"], f"{prefix}_tree_closure"),
        "solving": _sum_operations(
            values["functions"], f"{prefix}_tree_factor", f"{prefix}_tree_solve"
        ),
    }
    templates = {
        "Makefile": "Makefile",
        "CMakeLists.txt": "CMakeLists.txt",
        f"{prefix}.pc.in": "package.pc.in",
        f"{prefix}_batch.pc.in": "batch.pc.in",
        f"{prefix}-config.cmake": "config.cmake",
        f"{prefix}-config-version.cmake": "config-version.cmake",
        "README.md": "README.md",
    }
    if spec.control is not None:
        templates |= {f"{prefix}_generator.h": "generator.h", f"{prefix}.hpp": "wrapper.hpp"}
    # What is compared with others is checked after them.
    products = {f"{prefix}_{role}" for role in PRODUCTS}
    order = sorted(every, key=lambda f: (f.name in products, f.name != f"{prefix}_base_parameters"))
    stored = {f"{prefix}_{name.removeprefix('at_')}" for name in values["vectors"]["tables"]}
    order = [f for f in order if f.name in stored | products | {f"{prefix}_base_parameters"}]
    largest = max(f.outputs[0].size for f in every)
    checked = {"checked": order, "products": PRODUCTS, "turning": TURNING, "largest": largest}
    more = {name: build_example_values(spec, name) for name in examples} | {SELF_CHECK: checked}
    more |= {COUNT: count} if count is not None else {}
    more |= {VECTORS: {"largest": largest}} if values["many_states"] else {}
    programs = {f"{FOLDER}/{name}.c": texts for name, texts in more.items()}
    measured = ("vectors.csv",) if values["many_states"] else ()
    names = ("base_parameters.md", MANIFEST, *measured)
    values["files"] = {*code, *templates, *programs, *names}
    files = {name: render(template, **values) for name, template in templates.items()}
    return files | {path: render(Path(path).name, **values, **x) for path, x in programs.items()}


def _describe_package(spec: ModuleSpec, code: Mapping[str, str]) -> dict[str, Any]:
    """How build systems see the folder.

    The signature is the manifest's, with fitted values where it has any; all objects depend on the
    headers, of which those that a controller includes are public, and installed.
    """
    signature = spec.compute_signature() if spec.fitted is None else spec.fitted.signature
    if spec.control is not None:
        signature = digest_text(spec.to_json())
    units = ("", "_fitted", "_control", "_joints", "_batch", "_tile")
    heads = [f"{spec.prefix}{unit}.h" for unit in units]
    public = [name for name in (*heads, "modeler_batch.h") if name in code]
    for name in public:  # grows while it is read
        included = re.findall(r'^#include "([^"]+)"', code[name], flags=re.MULTILINE)
        public += [h for h in included if h in code and h not in public]
    controller_sources = spec.controller_sources
    return {
        "signature": signature,
        "version": format_package_version(signature),
        "sources": [name for name in controller_sources if name.endswith(".c")],
        "batch": [name for name in code if name.endswith(".c") and name not in controller_sources],
        "headers": [name for name in code if name.endswith(".h")],
        "public": public
        + ([f"{spec.prefix}_generator.h", f"{spec.prefix}.hpp"] if spec.control else []),
    }


def _sum_operations(functions: Sequence[Any], *names: str) -> dict[str, int]:
    """Returns the operations of the functions of these names together."""
    blocks = [f.block for f in functions if f.name in names]
    names = ("additions", "multiplications")
    return {name: sum(getattr(block, name) for block in blocks) for name in names}


# The example programs of a fitted module: which there are, and their calls as finished strings.


def select_examples(spec: ModuleSpec) -> tuple[str, ...]:
    """Returns the programs whose functions a module has; none where a joint of q has no motor."""
    roles = {f.name.removeprefix(f"{spec.prefix}_") for f in spec.every_function}
    if not all(joint.actuated for joint in spec.joints):
        return ()
    called = {n: {role for role, _ in row["calls"].values()} for n, row in _EXAMPLES.items()}
    examples = tuple(name for name in EXAMPLES if called[name] <= roles)
    if spec.windups:  # the loops of the others end at the motors
        return tuple(name for name in examples if "fitted_elastic_feedforward" in called[name])
    # A path in space is followed without the state of friction.
    return tuple(name for name in examples if name != "example_cartesian" or not spec.signals)


LOOPS = 6
"""Inputs of a function, at most, of which the runtime has a loop over samples."""


def count_values(spec: ModuleSpec) -> dict[str, Any] | None:
    """Returns what the template of the program that counts instructions needs besides.

    None of a robot with loops: how many turns of Newton close them depends on the posture.
    """
    if spec.closure is not None:
        return None
    functions = [f for f in spec.every_function if not f.status and len(f.inputs) <= LOOPS]
    if not functions:
        return None
    return {
        "states": 16,
        "largest": max(f.outputs[0].size for f in functions),
        "widths_read": max(
            (a.size for f in functions for a in f.inputs if a.name == "widths"), default=0
        ),
        "counted": [
            {
                "name": f.name,
                "role": f.name.removeprefix(f"{spec.prefix}_"),
                "inputs": [argument.name for argument in f.inputs],
            }
            for f in functions
        ],
        "counts_of_inputs": sorted({len(f.inputs) for f in functions}),
    }


def build_example_values(spec: ModuleSpec, name: str) -> dict[str, Any]:
    """Returns what the template of an example needs besides the values of all templates."""
    roles = {f.name.removeprefix(f"{spec.prefix}_"): f for f in spec.every_function}
    measured = [k for k, signal in enumerate(spec.signals) if signal.kind == "temperature"]

    def format_call(role: str, named: str) -> str:
        words = f"q=now->q qd=now->qd s=own->s {named}".split()
        return format_call_head(roles[role], dict(word.split("=", 1) for word in words))

    row, friction = _EXAMPLES[name], roles.get("fitted_friction")
    reads = {argument.name for argument in friction.inputs} if friction is not None else set()
    values: dict[str, Any] = {
        "temperatures": measured,
        "line": row["line"] + ", temperatures" * (bool(measured) and name != EXAMPLES[-1]),
        "friction_reads_acceleration": "qdd" in reads,
        "uses_own": "s" in reads,
    }
    if spec.signals:
        values["advance"] = format_call("advance", "dt=&dt qdd=a") + ", after)"
        values["lags"] = [k for k, signal in enumerate(spec.signals) if signal.kind == "lag"]
    return values | {word: format_call(*each) for word, each in row["calls"].items()}


def format_call_head(function: FunctionSpec, named: Mapping[str, str] | None = None) -> str:
    """Returns the call up to its output: `wrist_gravity(q, beta`.

    Args:
        function: that is called.
        named: {argument: C text that stands for it}; others are called as they are named.
    """
    arguments = ((named or {}).get(argument.name, argument.name) for argument in function.inputs)
    return f"{function.name}({', '.join(arguments)}"
