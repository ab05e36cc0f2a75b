"""The folder that a controller links: its library, some functions alone, bounds, vectors, C++17."""

import dataclasses
import json
import re
import shutil
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from modeler.api.workflow import load
from modeler.codegen.control import Control
from modeler.codegen.cost import add_cost
from modeler.codegen.package import write_emitted
from modeler.codegen.workflow import Derivation, derive, generate
from modeler.core.errors import BuildError, EmitError, ManifestError
from modeler.core.manifest import parse_manifest
from tests.csrc.emitted_folders import CPP, built, make, run
from tests.modules import STRICT, compiler, loaded
from tests.rotation import rotating, with_cases

PROGRAMS = Path(__file__).with_name("programs")
TUNED = "-O3 -fno-tree-slp-vectorize -fno-math-errno -fno-trapping-math -ffp-contract=fast".split()


@cache
def derivation(name: str) -> Derivation:
    return derive(load(name))


@cache
def emitted(name, only="", precision="double", vectors=False):
    control = Control(only=tuple(only.split(",")) if only else (), vectors=vectors)
    return generate(derivation(name), control=control, precision=precision)


def program(name: str, folder: Path) -> str:
    shutil.copy(PROGRAMS / name, folder)
    return name


def symbols(library: Path) -> set[str]:
    text = run(compiler("nm"), "-g", "--defined-only", library, where=library.parent)
    return {line.split()[-1] for line in text.splitlines() if len(line.split()) == 3}


@pytest.mark.parametrize("name", ["demo-arm", pytest.param("five-bar", marks=pytest.mark.rotating)])
def test_what_only_many_samples_need_is_a_library_of_its_own(name, tmp_path):
    spec = emitted(name, vectors=True).spec
    built(emitted(name, vectors=True), tmp_path, "all", "batch")
    controller = symbols(tmp_path / f"lib{spec.prefix}_model.a")
    many = symbols(tmp_path / f"lib{spec.prefix}_batch.a")
    assert {f.name for f in spec.every_function} <= controller
    assert f"{spec.prefix}_observation" in many
    assert not controller & many
    assert not [each for each in controller if re.search("batch|tile|observation", each)]


BASE = "base_regressor"
ONLY = [
    ("demo-arm", "inverse_dynamics,gravity", "inverse_dynamics gravity", False),
    *rotating(
        ("demo-arm", "forward_derivatives", "forward_derivatives", True),
        ("demo-arm", "regressor,observation", f"regressor {BASE} {BASE}_nonzeros", True),
        ("five-bar", "inverse_dynamics,close", "inverse_dynamics close", False),
        ("five-bar", "observation", BASE, True),
    ),
]


@pytest.mark.parametrize(("name", "only", "wanted", "vectors"), ONLY)
def test_some_functions_alone(name, only, wanted, vectors, tmp_path):
    """What they call comes along; all of it compiles without a warning and is what it was."""
    module = emitted(name, only, vectors=vectors)
    spec = module.spec
    write_emitted(module, tmp_path)
    said = make(tmp_path, "check", *["vectors"] * vectors)
    assert "agree with the stored states" in said and (" 0 fail" in said) == vectors
    names = {f.name for f in spec.every_function}
    others = {n.removeprefix(f"{spec.prefix}_") for n in names} - {*wanted.split()}
    assert names >= {f"{spec.prefix}_{role}" for role in wanted.split()}
    assert others <= {"inverse_dynamics", "derivatives", "inertia_matrix", "forward_dynamics"}
    header = "".join(path.read_text() for path in tmp_path.glob("*.h"))
    for each in emitted(name).spec.every_function:
        assert (f" {each.name}(" in header) == (each.name in names), each.name
    present = {path.name for path in tmp_path.glob("*.[ch]")}
    assert present == {n for n in module.files if n[-2:] in (".c", ".h") and "/" not in n}
    assert {*spec.sources, *spec.tile_sources} <= present


def test_python_calls_what_there_is_and_says_what_there_is_not():
    model = loaded(emitted("demo-arm", "inverse_dynamics,gravity"))
    beta = np.random.default_rng().uniform(1, 2, len(model.spec.base))
    q = np.random.default_rng().uniform(-2, 2, (3, len(model.spec.joints)))
    tau = model.inverse_dynamics(q, 0 * q, 0 * q, beta)
    evaluated = model.evaluate("inverse_dynamics", q=q, qd=0 * q, qdd=0 * q, beta=beta)
    assert evaluated == pytest.approx(tau)
    for call in (
        lambda: model.coriolis(q, q, beta),
        lambda: model.observation(q, q, q),
        lambda: model.base_parameters(np.ones(len(model.spec.standard))),
    ):
        with pytest.raises(ManifestError, match=r"has no function .*generated with --only"):
            call()


def test_a_function_that_is_none_is_refused():
    with pytest.raises(EmitError, match=r"--only: demo-arm has no function gravitation; expected"):
        emitted("demo-arm", "gravity,gravitation")
    with pytest.raises(EmitError, match="--cuda: not with --only"):
        generate(derivation("demo-arm"), cuda=True, control=Control(only=("gravity",)))


@pytest.mark.parametrize("words", [["gcc", "-std=c99"], ["g++", "-std=c++17", "-x", "c++"]])
def test_an_array_that_is_too_short_warns(words, tmp_path):
    write_emitted(emitted("demo-arm"), tmp_path)
    flags = "-O2 -Wall -Wextra -Werror -c".split()
    command = [compiler(words[0]), *words[1:], *flags, program("short.c", tmp_path)]
    run(*command, "-DSHORTER=0", where=tmp_path)
    if words[0] == "gcc":
        warning = run(*command, "-DSHORTER=1", where=tmp_path, fails=True)
        assert "demo_arm_gravity" in warning and "[-Werror=stringop-over" in warning


@pytest.mark.parametrize("words", [["gcc", *STRICT], ["clang++", *CPP, "-x", "c++"]])
def test_joints_limits_and_versions_are_constants(words, tmp_path):
    """Beside the robot file and the manifest."""
    robot, spec = derivation("demo-arm").robot, emitted("demo-arm").spec
    write_emitted(emitted("demo-arm"), tmp_path)
    files = (program("constants.c", tmp_path), "demo_arm_joints.c", "-o", "constants")
    run(compiler(words[0]), *words[1:], *files, where=tmp_path)
    *joints, last = run(tmp_path / "constants", where=tmp_path).splitlines()
    for line, joint in zip(joints, spec.joints, strict=True):
        name, unit, effort, actuated, *limits = line.split("|")
        stated = robot.limits.get(joint.name)
        wanted = [np.nan] * 4 if stated is None else dataclasses.astuple(stated)
        assert (name, unit, effort, actuated) == (joint.name, joint.unit, joint.effort_unit, "1")
        assert np.array_equal(np.array(limits, float), wanted, equal_nan=True)
    origin = parse_manifest((tmp_path / "manifest.json").read_text(), "").origin
    signature = spec.compute_signature()
    words = [origin.interface, origin.license, origin.generator, signature, signature]
    assert last == "|".join(map(str, words))
    assert origin.license == "MIT" and origin.generator.startswith("modeler ")


def test_the_version_of_modeler_is_in_no_signature(monkeypatch):
    monkeypatch.setattr("modeler.codegen.package.__version__", "99.1")
    later, now = generate(derivation("demo-arm"), control=Control()), emitted("demo-arm")
    differ = {name for name in now.files if later.files[name] != now.files[name]}
    assert differ == {"manifest.json", "demo_arm_generator.h"}
    assert "99.1" in later.files["demo_arm_generator.h"]
    spec = parse_manifest(later.files["manifest.json"], "")
    assert spec.compute_signature() == now.spec.compute_signature()


@with_cases("name, precision", ("demo-arm", "double"), *rotating(("five-bar", "single")))
def test_a_port_qualifies_itself_by_vectors(name, precision, tmp_path):
    """And a number that is wrong in the twelfth digit (of floats: the fifth) is reported."""
    module = emitted(name, precision=precision, vectors=True)
    built(module, tmp_path, "all", "batch")
    lines = (tmp_path / "vectors.csv").read_text().splitlines()
    outputs = [k for k, line in enumerate(lines) if line.startswith(f"{module.spec.prefix}_")]
    assert {int(line.split(",")[1]) for line in lines[:-1]} == set(range(50))
    assert lines[-1] == f"outputs,{len(outputs)}"
    assert f"{len(outputs)} outputs, 0 fail" in make(tmp_path, "vectors")
    texts = [x for k in outputs[:40] for x in lines[k].split(",")[2:] if x != "0"]
    digits = [len(re.sub(r"e.*|\D", "", x).lstrip("0")) for x in texts]
    assert min(digits) >= 50
    at = next(k for k in outputs[60:] if "inverse_dynamics" in lines[k])
    head, state, first, *rest = lines[at].split(",")
    largest = max(abs(float(x)) for x in (first, *rest))
    wrong = float(first) + (2e-12 if precision == "double" else 1e-3) * largest
    lines[at] = ",".join([head, state, f"{wrong:.17g}", *rest])

    def told(lines: list[str]) -> str:
        (tmp_path / "vectors.csv").write_text("".join(f"{line}\n" for line in lines))
        return make(tmp_path, "vectors", fails=True)

    whole = told(lines)
    assert f"{head}: state {state}: status 0, apart" in whole and " 1 fail" in whole
    for short in (lines[:-2], lines[: len(lines) // 2], [lines[0][:-9], *lines[1:]]):
        told(short)
    assert "0 outputs" in told([])


@pytest.mark.rotating("programs that link folders")
@pytest.mark.parametrize("cc", ["g++", "clang++"])
def test_the_header_for_cpp_returns_what_the_c_writes(cc, tmp_path):
    built(emitted("demo-arm"), tmp_path, "all", "batch")
    linked = "libdemo_arm_model.a -lm -o wrapped".split()
    command = [compiler(cc), *CPP, program("wrapped.cpp", tmp_path), *linked]
    run(*command, "-DSPOIL=(void)0", where=tmp_path)
    assert run(tmp_path / "wrapped", where=tmp_path) == "0"
    ignored = "arm::forward_dynamics(q,qd,g,beta,tau)"
    assert "nodiscard" in run(*command, f"-DSPOIL={ignored}", where=tmp_path, fails=True)
    short = "arm::gravity(std::array<double,2>{},beta,tau)"
    assert "no matching function" in run(*command, f"-DSPOIL={short}", where=tmp_path, fails=True)


@pytest.mark.rotating("programs that link folders")
def test_the_header_for_cpp_has_the_state_of_loops(tmp_path):
    write_emitted(emitted("five-bar", "inverse_dynamics", "single"), tmp_path)
    make(tmp_path)
    files = (program("state.cpp", tmp_path), *"libfive_bar_model.a -lm -o state".split())
    run(compiler("g++"), *CPP, *files, where=tmp_path)
    run(tmp_path / "state", where=tmp_path)


# What calls cost.


@cache
def costs(name: str, only: str) -> dict[str, dict[str, object]]:
    compiler("gcc"), compiler("objdump")
    text = add_cost(emitted(name, only), "host").files["cost.json"]
    return {row["name"]: row for row in json.loads(text)["functions"]}


BOTH = "inverse_dynamics,regressor"


@pytest.mark.rotating("long tests of csrc")
def test_the_stack_of_a_call_is_a_bound_of_what_it_uses(tmp_path):
    """Painted and looked at after the call; the C library's own frames come on top."""
    values, module = costs("five-bar", BOTH), emitted("five-bar", BOTH)
    write_emitted(module, tmp_path)
    sources = [n for n in module.spec.controller_sources if n.endswith(".c")]
    files = (program("painted.c", tmp_path), *sources, *"-lm -lpthread -o painted".split())
    run("gcc", *TUNED, *files, where=tmp_path)
    nothing, *both = map(int, run(tmp_path / "painted", where=tmp_path).split())
    for painted, role in zip(both, BOTH.split(","), strict=True):
        stack = values[f"five_bar_{role}"]["stack"]
        assert painted - nothing - 1500 <= stack <= 2 * (painted - nothing), role


def test_the_stack_of_a_function_in_several_versions_is_that_of_the_largest(tmp_path):
    """As gcc states it of each; functions that call none of ours are reported as such."""
    module, rows = emitted("two-link", BOTH), costs("two-link", BOTH)
    write_emitted(module, tmp_path)
    sources = [n for n in module.spec.controller_sources if re.match(r"two_link.*\.c", n)]
    flags = "-fno-asynchronous-unwind-tables -fstack-usage -c".split()
    run("gcc", "-std=c99", *TUNED, *flags, *sources, where=tmp_path)
    frames: dict[str, int] = {}
    for line in "".join(path.read_text() for path in tmp_path.glob("*.su")).splitlines():
        place, size, _ = line.split("\t")
        function, _, version = place.rpartition(":")[2].partition(".")
        if version != "resolver":
            frames[function] = max(frames.get(function, 0), int(size))
    assert {f"two_link_{role}" for role in BOTH.split(",")} <= rows.keys()
    for function, row in rows.items():
        assert row["stack"] >= frames[function] > 0, function
    assert rows["two_link_regressor"]["stack"] == frames["two_link_regressor"]


def test_a_machine_whose_compiler_is_missing_is_refused_in_one_line(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(BuildError, match="--measure: arm-none-eabi-gcc is not installed; install"):
        add_cost(emitted("demo-arm", "inverse_dynamics,gravity"), "cortex-m7")


def test_the_cost_on_a_microcontroller_is_in_the_readme(tmp_path):
    for tool in ("arm-none-eabi-gcc", "qemu-system-arm"):
        compiler(tool)
    module = add_cost(emitted("two-link", "gravity,forward_dynamics", "single"), "cortex-m4")
    data = json.loads(module.files["cost.json"])
    gravity = next(row for row in data["functions"] if row["name"] == "two_link_gravity")
    assert 10 < gravity["instructions"] < 400 and 50 < gravity["flash"] < 2000
    line = f"| `two_link_gravity` | {gravity['stack']} | {gravity['flash']} "
    assert line + f"| {gravity['instructions']} |" in module.files["README.md"]
    write_emitted(module, tmp_path)
    assert (tmp_path / "cost.json").is_file()
