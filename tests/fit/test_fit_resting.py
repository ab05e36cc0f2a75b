"""Logs in which joints rest: every command and every estimator has a result, or one clear line."""

import warnings

import numpy as np
import pytest

from modeler.cli import main
from modeler.core.choices import ABOUT
from tests.modules import compiled
from tests.rotation import ROTATING, with_cases

ROBOT, JOINTS, MASS = "demo-arm", 3, 2.0


def written(place, rest, seed, load=0.0, kind="tau"):
    """A log of 3 s: sines on the joints that move, noise of 1 % on all torques."""
    rng, time = np.random.default_rng(seed), np.arange(0.0, 3.0, 0.01)
    q = np.tile(rng.uniform(-0.5, 0.5, JOINTS), (time.size, 1))
    qd, qdd = np.zeros_like(q), np.zeros_like(q)
    for j in range(JOINTS):
        for k in range(1, 4) if j not in rest else ():
            w, a, p = 2.0 * np.pi * k * 0.4, rng.normal() * 0.5 / k, rng.uniform(0.0, 6.0)
            q[:, j] += a * np.sin(w * time + p)
            qd[:, j] += a * w * np.cos(w * time + p)
            qdd[:, j] -= a * w * w * np.sin(w * time + p)
    spec, value = compiled(ROBOT).spec, {"M3": 5.0 + load}
    beta = [value.get(p.name, 1.0 if p.nonnegative else 0.1) for p in spec.standard]
    tau = np.einsum("sjc,c->sj", compiled(ROBOT).regressor(q, qd, qdd, None), np.array(beta))
    tau += 0.01 * tau.std() * rng.normal(size=tau.shape)
    q += 1e-6 * rng.normal(size=q.shape)
    names = [f"{letter}{j + 1}" for letter in ("q", kind) for j in range(JOINTS)]
    table = np.column_stack([time, q, tau])
    np.savetxt(place, table, delimiter=",", header=",".join(["time", *names]), comments="")
    return place


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("resting")
    written(place / "full.csv", (), 1)
    written(place / "other.csv", (), 9)
    for name, kind in (("", "tau"), ("_i", "current")):
        written(place / f"bare{name}.csv", (), 1, kind=kind)
        written(place / f"loaded{name}.csv", (), 3, MASS, kind)
    assert main(f"fit {ROBOT} {place}/full.csv --out {place}/m.json".split()) == 0
    return place


LONG = ("didim-robust", "iv-direct-consistent", "didim-consistent")
COMMANDS = [
    f"log R --robot {ROBOT}",
    "diagnose m.json full.csv --holdout R",
    "add m.json spring R --out Y",
    f"fit {ROBOT} R --out own.json",
    "physical own.json",
    "compare own.json full.csv",
    "generate own.json --out own_c --force",
    "compare m.json R",
    "diagnose m.json R",
]
OTHERS = [
    f"fit {ROBOT} R --model energy --out X",
    f"fleet {ROBOT} R full.csv",
    f"fit {ROBOT} R --holdout other.csv --method weighted,ridge",
    "compare m.json R --free-run",
]
FITS, LONG_FITS = (
    [f"fit {ROBOT} R --method {m} --out X" for m in ABOUT if (m in LONG) == long]
    for long in (False, True)
)
LOADED = [
    f"fit {ROBOT} {logs} --payload-mass {MASS} --method {method} --out X"
    for logs, method in (
        ("R --payload-log RL", "weighted"),
        ("R --payload-log loaded.csv", "weighted"),
        ("full.csv --payload-log RL", "robust"),
        ("bare_i.csv --payload-log RLI", "tls"),
    )
]
BOTH = [
    f"fit {ROBOT} RI --payload-log {log} --payload-mass {MASS} --method tls --out X"
    for log in ("loaded_i.csv", "RLI")
]
ONE, ALL = (1,), (0, 1, 2)


@pytest.mark.rotating("long tests of fit")
@with_cases(
    "rest, commands",
    *(
        (rest, items)
        for rest in (ONE, ALL)
        for items in (COMMANDS, OTHERS, FITS[::2], FITS[1::2], LOADED)
    ),
    *(
        pytest.param(rest, items, marks=ROTATING)
        for rest in (ONE, ALL)
        for items in (LONG_FITS, BOTH)
    ),
)
def test_a_result_or_one_clear_line(folder, rest, commands, capsys, monkeypatch):
    """`main` raises whatever is no ModelerError: a traceback fails."""
    monkeypatch.chdir(folder)
    for name, *more in (
        ("R.csv", 1),
        ("RL.csv", 3, MASS),
        ("RI.csv", 1, 0.0, "current"),
        ("RLI.csv", 3, MASS, "current"),
    ):
        written(name, rest, *more)
    (folder / "own.json").unlink(missing_ok=True)
    for words in commands:
        inputs = [f"{w}.csv" if w in ("R", "RL", "RI", "RLI") else w for w in words.split()]
        with warnings.catch_warnings():
            warnings.simplefilter("error", RuntimeWarning)
            status = main(inputs)
        out = capsys.readouterr()
        assert status in (0, 1), words
        lines = [line for line in out.err.splitlines() if line.startswith("modeler: ")]
        if status == 1 and words.split()[1] != "own.json":
            assert len(lines) == 1 and len(lines[0]) > 40, f"{words}: {out.err}"
        else:
            assert out.out.strip() or status, words
