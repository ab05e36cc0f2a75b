"""Single precision: literals, runtime, sine and cosine, whole modules against double precision."""

import dataclasses
import subprocess
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from modeler.cli import main
from modeler.codegen.emit import emit
from modeler.codegen.package import write_emitted
from modeler.core.errors import ManifestError
from modeler.core.manifest import EmittedModule, parse_manifest
from modeler.runtime.model import CompiledModel, load_folder
from tests.codegen.fitted_library import fitted_of, robot_module
from tests.csrc.emitted_folders import built, run
from tests.modules import STRICT, compiler, loaded, module, plain, states, unoptimised
from tests.rotation import ROTATING, rotating, with_cases

FLOATS = ["-Wdouble-promotion", "-Wfloat-conversion"]


@cache
def emitted(name: str) -> EmittedModule:
    made = robot_module(name)
    return emit(made.model, made.base, fitted_of(made.emitted.spec), precision="single")


@cache
def single(name: str) -> CompiledModel:
    return loaded(emit(module(name).model, module(name).base, precision="single"))


@with_cases(
    "name, cc",
    ("slow-arm", "gcc"),
    *rotating(("slow-arm", "clang"), ("five-bar", "gcc"), ("five-bar", "clang")),
)
def test_a_module_compiles_without_a_warning_and_checks_itself(name, cc, tmp_path):
    """The fitted unit and all programs included; of <math.h> only functions of floats."""
    made = emitted(name)
    write_emitted(made, tmp_path)
    flags = " ".join([*STRICT[1:], *FLOATS])
    make = ["make", "-s", "-C", str(tmp_path), f"CC={compiler(cc)}", f"CFLAGS={flags} -O0"]
    said = subprocess.run([*make, "check", "examples"], capture_output=True, text=True, check=False)
    assert said.returncode == 0, said.stdout + said.stderr
    assert "functions agree with the stored states" in said.stdout
    wanted = subprocess.run(
        ["nm", "-u", *tmp_path.glob("*_model.a")], capture_output=True, text=True, check=True
    )
    asked = {line.split()[1] for line in wanted.stdout.splitlines() if line.startswith(" ")}
    assert not asked & {"sin", "cos", "tan", "exp", "pow", "tanh", "fabs", "sqrt", "fmin", "fmax"}
    lines = "0.1 0.2 0.1 0 0 0 0.1 0.2 0.1 0 0 0 0 0 0 20\n" if name == "slow-arm" else ""
    example = [tmp_path / "example_computed_torque"]
    torques = subprocess.run(example, input=lines, capture_output=True, text=True, check=True)
    assert len(torques.stdout.split()) == (3 if lines else 0)


@with_cases(
    "name, bound, samples",
    pytest.param("wrist", 1e-6, 50, marks=pytest.mark.digits),
    pytest.param("five-bar", 1e-5, 50, marks=pytest.mark.digits),
    pytest.param("orthoglide-2003", 1e-4, 300, marks=ROTATING),
    *(
        pytest.param(name, 1e-6, 300, marks=ROTATING)
        for name in ("puma560", "emps", "sr400-tree", "wrist-coupled", "sr400")
    ),
)
def test_it_computes_what_double_precision_computes(name, bound, samples):
    """To `bound` of what is added up; of loops as well as the posture shows, near home."""
    one, two = single(name), plain(name)
    spec = two.spec
    q, qd, qdd = states(len(spec.joints), samples)
    if spec.closure is not None:
        size = [1.0 if joint.unit == "rad" else 0.3 for joint in spec.joints]
        q = 0.1 * q * size + [spec.closure.home[k] for k in spec.closure.actuated]
    rng = np.random.default_rng(2)
    signals = rng.uniform(0, 1, (samples, len(spec.signals)))
    q, qd, qdd, signals = (a.astype(np.float32).astype(float) for a in (q, qd, qdd, signals))
    closed = (one.closing_status(q) == 0) & (two.closing_status(q) == 0)
    assert closed.mean() > 0.9
    motion = [q[closed], qd[closed], qdd[closed]]
    beta = rng.normal(size=len(spec.base)).astype(np.float32).astype(float)
    s = {"s": signals[closed]} if spec.signals else {}
    phi = two.base_regressor(*motion, **s)
    for columns in (one.base_regressor(*motion, **s), one.observation(*motion, **s)):
        worst = np.abs(columns.reshape(phi.shape) - phi).max(axis=(1, 2))
        assert (worst <= bound * np.abs(phi).max(axis=(1, 2))).all()
    parts = np.einsum("njc,c->nj", np.abs(phi), np.abs(beta)).max(axis=1)
    torques = [model.inverse_dynamics(*motion, beta, **s) for model in (one, two)]
    assert (np.abs(torques[0] - torques[1]).max(axis=1) <= bound * parts).all()
    M = two.inertia_matrix(motion[0], beta)
    worst = np.abs(one.inertia_matrix(motion[0], beta) - M).max(axis=(1, 2))
    assert (worst <= 4 * bound * np.abs(M).max(axis=(1, 2))).all()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["five-bar", "3rrr", "delta", "evra"])
def test_loops_that_close_in_single_precision_close_on_the_branch_of_home(name):
    """Far away, past singular postures: where floats close, short steps in double arrive there."""
    one, two = single(name), plain(name)
    closure = two.spec.closure
    assert closure is not None
    home = np.array([closure.home[k] for k in closure.actuated])
    size = np.array([1.0 if joint.unit == "rad" else 0.3 for joint in two.spec.joints])
    shift = np.random.default_rng(3).uniform(-2, 2, (400, len(home))) * size
    q = (home + shift).astype(np.float32).astype(float)
    closed = one.closing_status(q) == 0
    assert closed.any()
    fine = walked(two, home, q[closed] - home)
    np.testing.assert_allclose(one.close(q[closed]), fine, atol=2e-3)


def walked(model: CompiledModel, home: np.ndarray, way: np.ndarray, steps: int = 400) -> np.ndarray:
    """(n, free) postures at the ends of straight ways (n, given), each step from the last."""
    library = model._library
    function = next(f for f in model.spec.functions if f.name.endswith("_close_from"))
    u = np.tile(model.spec.closure.home, (len(way), 1))
    for k in range(1, steps + 1):
        status, out = np.zeros(len(way), dtype=np.intc), np.empty_like(u)
        library.run_batch(function, [home + way * k / steps, u], out, status)
        assert not status.any(), f"closed in single precision, but a way ends at {k / steps}"
        u = out
    return u


@pytest.mark.rotating("programs that link folders")
def test_robots_of_both_precisions_live_in_one_program(tmp_path):
    """The runtime of one kind of number is not that of the other; two of one kind share theirs."""
    wrist, emps = module("wrist").emitted, module("emps").emitted
    arm = emit(module("two-link").model, module("two-link").base, precision="single")
    libraries = []
    for made in (wrist, arm, emps):
        folder = built(made, tmp_path / made.spec.prefix, "all", "batch")
        items = [folder / f"lib{made.spec.prefix}_{kind}.a" for kind in ("batch", "model")]
        libraries += [*items, f"-I{folder}"]
    source = Path(__file__).with_name("programs") / "both_precisions.c"
    run("gcc", "-o", "main", source, *libraries, "-lm", where=tmp_path)
    assert run(tmp_path / "main", where=tmp_path).split() == ["2.000", "2.000", "2.000"]


def test_the_command_writes_it_and_the_manifest_says_so(capsys, tmp_path):
    out = tmp_path / "c"
    assert main(["generate", "two-link", "--precision", "single", "--out", str(out)]) == 0
    assert "10 base parameters, single precision, written to" in capsys.readouterr().out
    assert "const float q[" in (out / "two_link.h").read_text()
    assert "every number is `float`" in (out / "README.md").read_text()
    with unoptimised():
        model = load_folder(out)
    assert model.spec.precision == "single"
    q, beta = [[0.1, 0.2]], np.ones(10)
    np.testing.assert_allclose(model.gravity(q, beta), plain("two-link").gravity(q, beta), 1e-6)
    assert '"precision"' not in module("two-link").emitted.spec.to_json()
    wrong = dataclasses.replace(model.spec, precision="half").to_json()
    with pytest.raises(ManifestError, match="precision is 'half', expected double or single"):
        parse_manifest(wrong, "m")
