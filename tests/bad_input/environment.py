"""Machines that lack something: a compiler, a cache, a home, a disk with room."""

from tests.bad_input.judge import AS_IT_IS
from tests.bad_input.row import Make, Outcome, Process, Row, row
from tests.bad_input.workdir import Workdir

COMPARE = "compare m.json b.csv --json c.json"
FIT = "fit two-link a.csv --out f.json --json g.json"
SESSION = {"MODELER_CACHE": AS_IT_IS}
REPORT = f"{COMPARE} --report page.html"
NOWHERE = "/proc/nowhere"
HOMELESS = {"HOME": NOWHERE, "MODELER_CACHE": None, "XDG_CACHE_HOME": None}
OWN_CACHE = {"MODELER_CACHE": "WORKDIR/cache", "CFLAGS": "-O0"}


def on(
    what: str,
    outcome: Outcome,
    run: str,
    *words: str,
    make: Make | None = None,
    beside: tuple[str, ...] = ("cache",),
    file_limit: int | None = None,
    slow: bool = False,
    **env: str | None,
) -> Row:
    """A row in a process of its own, with variables set or taken away."""
    process = Process({**OWN_CACHE, **env}, file_limit, slow=slow)
    name = f"environment: {what}"
    return row(name, outcome, run, *words, make=make, process=process, beside=beside)


def _true(workdir: Workdir) -> None:
    """A compiler that makes nothing."""
    workdir.write("cc.sh", "#!/bin/sh\n").chmod(0o755)


# Compilers that are missing or fail, caches that are cut: tests/compiled/test_build.py.
COMPILER = [
    on("CC does nothing", "refused", COMPARE, "wrote no library", make=_true, CC="WORKDIR/cc.sh"),
    on("CC has an open quote", "refused", COMPARE, "CC", CC='gcc "'),
    on("CC is spaces", "works", COMPARE, CC="   "),
]

CACHE = [
    on("the cache is in Greek", "works", COMPARE, MODELER_CACHE="WORKDIR/κρυφό", beside=("κρυφό",)),
    on("HOME is not set", "works", COMPARE, HOME=None),
    on("HOME is nowhere, and is needed", "refused", COMPARE, "MODELER_CACHE", **HOMELESS),
    on("TMPDIR is nowhere", "ends", COMPARE, "", TMPDIR="/nowhere"),
    on("matplotlib may keep nothing", "ends", REPORT, "", MPLCONFIGDIR=NOWHERE),
]

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
    row(
        "folder: the manifest is a folder",
        "refused",
        "generate two-link --out c",
        "manifest.json|c",
        make=lambda w: w.path("c/manifest.json/x").parent.mkdir(exist_ok=True),
    ),
    row(
        "folder: a C file is a link to the user's own",
        "refused",
        "generate two-link --out c",
        "two_link.c",
        make=lambda w: w.path("c/two_link.c").symlink_to(w.write("mine.c", "int x;")),
    ),
]

ROWS = [*COMPILER, *CACHE, *DISKS, *FOLDERS]
