"""The base regressor beside CasADi's C of the same expressions: same terms, same flags, in turn.

Our own graph goes through `casadi.CodeGenerator`, so what differs is how it is written: sines and
cosines, the order of statements, the stores.
"""

import subprocess
import tempfile
from collections.abc import Mapping
from pathlib import Path

from benchmarks.line import Key, Line, Missing, ratio
from benchmarks.regressor import program_of
from benchmarks.robots import emitted, lossy
from modeler.codegen import derive, write_emitted
from modeler.runtime import find_toolchain

ROBOTS = ("puma560", "ur10e", "panda")
_ROUNDS, _FEW = 400, 40
_PEER = """
#include <stddef.h>
static int nothing;
void *peer_model(const char *path);
double peer_regressor(void *model, const double *q, const double *qd, const double *qdd, double *a);
void *peer_model(const char *path) {{ (void)path; return &nothing; }}
double peer_regressor(void *model, const double *q, const double *qd, const double *qdd, double *a)
{{
    static double out[{size}], w[{work} + 1];
    const double *arg[{inputs}] = {{q, qd, qdd}};
    double *res[{outputs}] = {{a ? a : out}};
    (void)model;
    base_regressor(arg, res, NULL, w, 0);
    return res[0][0];
}}
"""


def peer(name: str, folder: Path) -> Path:
    """Shared library of CasADi's C of a robot's base regressor."""
    try:
        import casadi

        from modeler.codegen.casadi_functions import build_casadi_functions
    except ImportError as why:
        raise Missing("no casadi here") from why
    derivation = derive(lossy(name))
    functions, _ = build_casadi_functions(derivation.model, derivation.base)
    item = next(f for f in functions if f.name() == "base_regressor")
    lines = casadi.CodeGenerator("peer", {"with_header": False})
    lines.add(item)
    shim = _PEER.format(
        size=item.nnz_out(0), work=item.sz_w(), inputs=item.sz_arg(), outputs=item.sz_res()
    )
    (folder / "peer.c").write_text(lines.dump() + shim, encoding="utf-8")
    tools, library = find_toolchain(), folder / "peer.so"
    subprocess.run(
        [*tools.command, *tools.flags, "-shared", "-o", library, folder / "peer.c", "-lm"],
        check=True,
        capture_output=True,
    )
    return library


def _measure(quick: bool) -> Mapping[str, float | Missing]:
    table: dict[str, float | Missing] = {}
    for name in ROBOTS:
        keys = (f"casadi_ns.{name}", f"scalar_vs_casadi.{name}")
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(scratch)
            write_emitted(emitted(name), folder / "module")
            try:
                library = peer(name, folder)
                program = program_of(name, folder)
            except Missing as why:
                table |= dict.fromkeys(keys, why)
                continue
            said = subprocess.run(
                [program, str(_FEW if quick else _ROUNDS), "none", library],
                capture_output=True,
                text=True,
                check=True,
            )
        items, *_, theirs = (float(x.rpartition(" ")[2]) for x in said.stdout.splitlines())
        table |= dict(zip(keys, (theirs, theirs / items), strict=True))
    return table


LINES = (
    Line(
        tuple(
            key
            for name in ROBOTS
            for key in (
                Key(f"casadi_ns.{name}", "ns", "CasADi's C of the same regressor, a sample."),
                ratio(f"scalar_vs_casadi.{name}", "It over ours, dense, same flags."),
            )
        ),
        _measure,
        20,
    ),
)
