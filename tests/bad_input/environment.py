"""Machines that lack something: a compiler, a cache, a home, a disk with room."""

import os
import sys
from pathlib import Path

from tests.bad_input.judge import AS_IT_IS
from tests.bad_input.row import Make, Outcome, Process, Row, row
from tests.bad_input.workdir import Workdir

COMPARE = "compare m.json b.csv --json c.json"
FIT = "fit two-link a.csv --out f.json --json g.json"
SESSION = {"MODELER_CACHE": AS_IT_IS}
OWN_CACHE = {"MODELER_CACHE": "WORKDIR/cache", "CFLAGS": "-O0"}


def on(
    what: str, outcome: Outcome, run: str, *words: str, make: Make | None = None,
    beside: tuple[str, ...] = ("cache",), file_limit: int | None = None, slow: bool = False,
    **env: str | None,
) -> Row:  # fmt: skip
    """A row in a process of its own, with variables set or taken away."""
    process = Process({**OWN_CACHE, **env}, file_limit, slow=slow)
    return row(
        f"environment: {what}", outcome, run, *words, make=make, process=process, beside=beside
    )  # fmt: skip


def _script(text: str) -> Make:
    """A compiler of that shell text."""

    def make(workdir: Workdir) -> None:
        workdir.write("cc.sh", f"#!/bin/sh\n{text}\n").chmod(0o755)

    return make


def _bare_path(workdir: Workdir) -> None:
    """A folder for PATH with Python alone."""
    workdir.path("bin/python").symlink_to(sys.executable)


def _file_cache(workdir: Workdir) -> None:
    workdir.write("cache", "no folder")


def _spoilt_cache(workdir: Workdir) -> None:
    """The cache of the session with every library cut."""
    source = Path(os.environ["MODELER_CACHE"])
    for library in sorted(source.rglob("*.so"))[:40]:
        name = library.relative_to(source).as_posix()
        workdir.write(f"cache/{name}", library.read_bytes()[:100])


COMPILER = [
    on("no compiler on the path", "refused", COMPARE, "compiler", "install", make=_bare_path,
       PATH="WORKDIR/bin", CC=None),
    on("CC names nothing", "refused", COMPARE, "CC=", "nowhere-cc", CC="nowhere-cc"),
    on("CC is no program", "refused", COMPARE, "compiler|CC", make=lambda w: w.take("m.json"),
       CC="WORKDIR/m.json"),
    on("CC fails with many words", "refused", COMPARE, "no licence",
       make=_script("echo 'no licence' >&2\necho 'line two' >&2\nexit 1"), CC="WORKDIR/cc.sh"),
    on("CC does nothing", "refused", COMPARE, "made nothing", make=_script("exit 0"),
       CC="WORKDIR/cc.sh"),
    on("CC has an open quote", "refused", COMPARE, "CC", CC='gcc "'),
    on("CC is spaces", "works", COMPARE, CC="   "),
    on("CC with a flag", "works", COMPARE, CC="cc -g0"),
]  # fmt: skip

CACHE = [
    on("the cache is a file", "refused", COMPARE, "MODELER_CACHE", make=_file_cache),
    on("the cache is where nothing can be made", "refused", COMPARE, "MODELER_CACHE",
       MODELER_CACHE="/proc/nowhere"),
    on("every library in the cache is cut", "works", COMPARE, make=_spoilt_cache),
    on("the cache is in Greek", "works", COMPARE, MODELER_CACHE="WORKDIR/κρυφό", beside=("κρυφό",)),
    on("HOME is not set", "works", COMPARE, HOME=None),
    on("HOME is nowhere, and is needed", "refused", COMPARE, "MODELER_CACHE", HOME="/proc/nowhere",
       MODELER_CACHE=None, XDG_CACHE_HOME=None),
    on("TMPDIR is nowhere", "ends", COMPARE, "", TMPDIR="/nowhere"),
    on("matplotlib may keep nothing", "ends", COMPARE + " --report page.html", "",
       MPLCONFIGDIR="/proc/nowhere"),
]  # fmt: skip

# Streams that are closed, full or short of letters: tests/cli/test_streams.py.
DISKS = [
    # The model, or the compiled robot where the cache has forgotten it.
    on("a disk that is full for the model", "refused", FIT, "cannot be written",
       file_limit=2000, **SESSION),
    on("a disk that is full for a page", "refused", "compare m.json b.csv --report p.html",
       "p.html", file_limit=200000),
    on("a disk that is full for Parquet", "refused",
       "simulate two-link --duration 8 --out s.parquet", "s.parquet", file_limit=5000),
    on("optimised Python", "works", COMPARE, PYTHONOPTIMIZE="2", slow=True, **SESSION),
]  # fmt: skip

FOLDERS = [
    row("folder: the manifest is a folder", "refused", "generate two-link --out c",
        "manifest.json|c",
        make=lambda w: w.path("c/manifest.json/x").parent.mkdir(exist_ok=True)),
    row("folder: a C file is a link to the user's own", "refused", "generate two-link --out c",
        "two_link.c", make=lambda w: w.path("c/two_link.c").symlink_to(w.write("mine.c",
        "int x;"))),
]  # fmt: skip

ROWS = [*COMPILER, *CACHE, *DISKS, *FOLDERS]
