"""A shared library from emitted files, kept in a cache.

The cache is keyed by everything that can change the library: sources, flags, compiler, processor.
The library's file name is the hash of its own bytes, so a damaged one is noticed and built again;
it is renamed into place, so that any number of processes may build the same robot at once.
"""

import hashlib
import tempfile
from collections.abc import Mapping
from pathlib import Path

from modeler.compiled.cache import cache_folder, in_use, libraries, placed, tidy, whole
from modeler.compiled.toolchain import Toolchain, compile_library, find_toolchain
from modeler.core.errors import BuildError


def build_library(sources: Mapping[str, str]) -> Path:
    """Path of the shared library of these C files, compiled unless the cache has it.

    Args:
        sources: {file name: text}, headers included.

    Raises:
        BuildError: no compiler, the compiler refused, or the cache cannot be written.
    """
    tools = find_toolchain()
    folder = cache_folder() / _key(sources, tools)
    try:
        kept = _intact(folder)
        return kept if kept is not None else _build(sources, tools, folder)
    except IsADirectoryError as error:
        raise BuildError(
            f"{error.filename}: is a folder; expected a compiled library of the cache; remove it"
        ) from None
    except OSError as error:
        raise BuildError(
            f"{folder}: the compiled library cannot be written ({error.strerror}); set "
            "MODELER_CACHE to a folder you may write to"
        ) from error


def _key(sources: Mapping[str, str], tools: Toolchain) -> str:
    parts = [*tools.command, *tools.flags, tools.identity]
    for name in sorted(sources):
        parts += [name, sources[name]]
    # Lengths first: no two lists of parts give the same bytes.
    text = "".join(f"{len(part)}:{part}" for part in parts)
    return hashlib.sha256(text.encode()).hexdigest()


def _intact(folder: Path) -> Path | None:
    """The library of `folder`, if it is still what was built."""
    for path in libraries(folder):
        in_use(path)  # before it is read: from here on nobody removes it
        if whole(path):
            return path
    return None


def _build(sources: Mapping[str, str], tools: Toolchain, folder: Path) -> Path:
    cache = folder.parent
    cache.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=cache, prefix=".build-") as scratch:
        for name, text in sources.items():
            (Path(scratch) / name).write_text(text, encoding="utf-8", newline="\n")
        made = Path(scratch) / "library"
        units = [name for name in sorted(sources) if name.endswith(".c")]
        compile_library(tools, Path(scratch), units, made)
        final = folder / f"{hashlib.sha256(made.read_bytes()).hexdigest()}.so"
        placed(made, final)
    for other in libraries(folder):
        if other != final and not whole(other):
            other.unlink(missing_ok=True)
    tidy(cache)
    return final
