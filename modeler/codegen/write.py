"""Emitted files to disk, over what an earlier run wrote and over nothing else."""

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from modeler.codegen.examples import EXAMPLES, FOLDER, PROGRAMS
from modeler.codegen.record import RECORD, Record, checksum, read_record, record_text
from modeler.core.contract import Emitted
from modeler.core.errors import ModelerError
from modeler.core.files import write_atomically, write_together


def write_emitted(emitted: Emitted, folder: Path, force: bool = False) -> tuple[str, ...]:
    """Names of the files that were written: those that are new or have changed.

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
        old = {name: _content(folder / name) for name in new}
        known = read_record(folder)
    except OSError as error:
        raise ModelerError(
            f"{error.filename or folder}: cannot be read ({error.strerror}); nothing is written "
            "over what is not known; choose another folder"
        ) from error
    changed = [name for name in new if old[name] != new[name]]
    if not force:
        _check(folder, [name for name in changed if old[name] is not None], old, known)
    record = {name: sums for name, sums in (known or {}).items() if (folder / name).is_file()}
    sums = {name: frozenset([checksum(content)]) for name, content in new.items()}
    gone = _unedited(folder, {n: s for n, s in record.items() if n in _unwanted(emitted)})
    # Both are known while files are replaced, so that a run that was killed can be repeated.
    both = {**record, **{n: s | record.get(n, frozenset()) for n, s in sums.items()}}
    files = [(folder / name, new[name]) for name in changed]
    if files or gone:
        texts = [(folder / RECORD, record_text(both).encode()), *files]
        write_together(texts, [folder / name for name in gone])
    last = {**{n: s for n, s in record.items() if (folder / n).is_file()}, **sums}
    if last != known:
        write_atomically(folder / RECORD, record_text(last))
    return tuple(changed)


def _unwanted(emitted: Emitted) -> set[str]:
    """Files that hold a model's values, or need them, or CUDA, and are not emitted now.

    And programs that stand among the library's files, as earlier versions wrote them.
    """
    prefix = emitted.spec.prefix
    names = {f"{prefix}_fitted.c", f"{prefix}_fitted.h", f"{prefix}.cu"}
    names |= {f"{FOLDER}/{name}.c" for name in EXAMPLES} | {f"{name}.c" for name in PROGRAMS}
    return names - emitted.files.keys()


def leftovers(emitted: Emitted, folder: str | Path) -> list[str]:
    """Files with a model's values that are not emitted now, and stay because they were edited.

    Args:
        emitted: what `write_emitted` wrote.
        folder: where.
    """
    known = read_record(Path(folder)) or {}
    return sorted(known.keys() & _unwanted(emitted))


def _unedited(folder: Path, stale: Record) -> set[str]:
    """Names of the files of an earlier run that say what it wrote."""
    same = set()
    for name, sums in stale.items():
        with suppress(OSError):  # what cannot be read stays
            if checksum((folder / name).read_bytes()) in sums:
                same.add(name)
    return same


def _content(path: Path) -> bytes | None:
    """Of a file; empty of anything else, None of nothing."""
    if path.is_file():
        return path.read_bytes()
    return b"" if path.exists() else None


def _check(
    folder: Path, changed: Sequence[str], old: dict[str, bytes | None], known: Record | None
) -> None:
    """Nothing is lost that somebody wrote by hand."""
    foreign, edited = [RECORD] if known is None else [], []
    for name in changed:
        content = old[name]
        if not known or name not in known:
            foreign.append(name)
        elif content is not None and checksum(content) not in known[name]:
            edited.append(name)
    told = []
    if foreign:
        told.append(f"{', '.join(sorted(foreign))}, not known to be of an earlier generate")
    if edited:
        told.append(f"{', '.join(sorted(edited))}, edited since an earlier generate")
    if told:
        raise ModelerError(
            f"{folder}: would write over {'; and over '.join(told)}; choose another folder, or "
            "write over them with --force"
        )
