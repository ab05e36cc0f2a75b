"""The folder that a controller links: its library, some functions alone, bounds, vectors, C++17."""

import dataclasses
import json
import re
import subprocess
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from modeler.codegen.control import Control
from modeler.codegen.cost import with_cost
from modeler.codegen.package import write_emitted
from modeler.codegen.workflow import Derivation, derive, generate, load
from modeler.core.errors import BuildError, EmitError, ManifestError
from modeler.core.manifest import Emitted, module_from_json
from modeler.runtime.model import load_folder
from tests.modules import STRICT, compiler, unoptimised

MORE = ["-Wundef", "-Wcast-align=strict"]
CPP = ["-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Wshadow", "-Werror"]


@cache
def derivation(name: str) -> Derivation:
    return derive(load(name))


@cache
def emitted(name: str, only: str = "", precision: str = "double", vectors: bool = False) -> Emitted:
    control = Control(only=tuple(only.split(",")) if only else (), vectors=vectors)
    return generate(derivation(name), control=control, precision=precision)


def written(folder: Path, *which: object, **more: object) -> Path:
    write_emitted(emitted(*which, **more), folder)
    return folder


def run(*command: object, where: Path, fails: bool = False) -> str:
    done = subprocess.run(list(map(str, command)), cwd=where, capture_output=True, text=True)
    assert (done.returncode != 0) == fails, done.stdout + done.stderr
    return done.stdout + done.stderr


def made(folder: Path, *targets: str, fails: bool = False) -> str:
    compiler("make")
    flags = " ".join(["-O0", *STRICT, *MORE])
    return run("make", "-s", *targets, f"CFLAGS={flags}", where=folder, fails=fails)


def symbols(library: Path) -> set[str]:
    text = run(compiler("nm"), "-g", "--defined-only", library, where=library.parent)
    return {line.split()[-1] for line in text.splitlines() if len(line.split()) == 3}


@pytest.mark.parametrize("name", ["demo-arm", "five-bar"])
def test_what_only_many_samples_need_is_a_library_of_its_own(name, tmp_path):
    spec = emitted(name).spec
    made(written(tmp_path, name), "all", "batch")
    controller = symbols(tmp_path / f"lib{spec.prefix}_model.a")
    many = symbols(tmp_path / f"lib{spec.prefix}_batch.a")
    assert {f.name for f in spec.every_function} <= controller
    assert f"{spec.prefix}_observation" in many
    assert not controller & many
    assert not [each for each in controller if re.search("batch|tile|observation", each)]
    lines = {n: len((tmp_path / n).read_text().splitlines()) for n in spec.sources}
    assert sum(lines[n] for n in spec.controller_sources) < sum(lines.values())


ONLY = [
    ("demo-arm", "inverse_dynamics,gravity", {"inverse_dynamics", "gravity"}),
    ("demo-arm", "forward_derivatives", {"forward_derivatives"}),
    ("demo-arm", "regressor,observation",
     {"regressor", "base_regressor", "base_regressor_nonzeros"}),
    ("five-bar", "inverse_dynamics,close", {"inverse_dynamics", "close"}),
    ("five-bar", "observation", {"base_regressor"}),
]  # fmt: skip


@pytest.mark.parametrize(("name", "only", "kept"), ONLY)
def test_some_functions_alone(name, only, kept, tmp_path):
    """What they call comes along; all of it compiles without a warning and is what it was."""
    spec = emitted(name, only).spec
    folder = written(tmp_path, name, only, vectors=True)
    told = made(folder, "check", "vectors")
    assert "agree with the stored states" in told and " 0 fail" in told
    roles = {f.name.removeprefix(f"{spec.prefix}_") for f in spec.every_function}
    assert kept <= roles
    assert roles - kept <= {"inverse_dynamics", "derivatives", "inertia_matrix", "forward_dynamics"}
    header = "".join(path.read_text() for path in folder.glob("*.h"))
    for each in emitted(name).spec.every_function:
        declared = f" {each.name}(" in header
        assert declared == (each.name in {f.name for f in spec.every_function}), each.name
    present = {path.name for path in folder.glob("*.[ch]")}
    assert present == {n for n in emitted(name, only, vectors=True).files if n[-2:] in (".c", ".h")
                       and "/" not in n}  # fmt: skip
    assert {*spec.sources, *spec.tile_sources} <= present


def test_python_calls_what_there_is_and_says_what_there_is_not(tmp_path):
    written(tmp_path, "demo-arm", "inverse_dynamics,forward_dynamics")
    with unoptimised():
        model = load_folder(tmp_path)
    n, c = len(model.spec.joints), len(model.spec.base)
    beta = model_beta(c)
    q = np.random.default_rng().uniform(-2, 2, (3, n))
    tau = model.inverse_dynamics(q, 0 * q, 0 * q, beta)
    assert model.evaluate("inverse_dynamics", q=q, qd=0 * q, qdd=0 * q, beta=beta) == (
        pytest.approx(tau)
    )
    for call in (lambda: model.gravity(q, beta), lambda: model.observation(q, q, q),
                 lambda: model.base_parameters(np.ones(len(model.spec.standard)))):  # fmt: skip
        with pytest.raises(ManifestError, match=r"has no function .*generated with --only"):
            call()


def model_beta(columns: int) -> np.ndarray:
    return np.random.default_rng().uniform(1, 2, columns)


def test_a_function_that_is_none_is_refused():
    with pytest.raises(EmitError, match=r"--only: demo-arm has no function gravitation; expected"):
        emitted("demo-arm", "gravity,gravitation")
    with pytest.raises(EmitError, match="--cuda: not with --only"):
        generate(derivation("demo-arm"), cuda=True, control=Control(only=("gravity",)))


SHORT = """#include "demo_arm.h"
double tau[DEMO_ARM_JOINTS], beta[DEMO_ARM_BASE_PARAMETERS];
void call(void);
void call(void)
{
    const double q[DEMO_ARM_JOINTS - SHORTER] = {0.0};

    demo_arm_gravity(q, beta, tau);
}
"""


@pytest.mark.parametrize("words", [["gcc", "-std=c99"], ["g++", "-std=c++17", "-x", "c++"]])
def test_an_array_that_is_too_short_warns(words, tmp_path):
    written(tmp_path, "demo-arm")
    (tmp_path / "short.c").write_text(SHORT)
    command = [compiler(words[0]), *words[1:], "-O2", "-Wall", "-Wextra", "-Werror", "-c",
               "short.c"]  # fmt: skip
    run(*command, "-DSHORTER=0", where=tmp_path)
    if words[0] == "gcc":
        told = run(*command, "-DSHORTER=1", where=tmp_path, fails=True)
        assert "demo_arm_gravity" in told and "[-Werror=stringop-over" in told


CONSTANTS = """#include <stdio.h>
#include "demo_arm_joints.h"
#include "demo_arm_generator.h"

int main(void)
{
    for (int i = 0; i < DEMO_ARM_JOINTS; i++) {
        const demo_arm_joint *const joint = &demo_arm_joints[i];

        printf("%s|%s|%s|%d|%.17g|%.17g|%.17g|%.17g\\n", joint->name, joint->unit,
               joint->effort_unit, joint->actuated, joint->lower, joint->upper, joint->speed,
               joint->acceleration);
    }
    printf("%d|%s|%s|%08x%08x|%s\\n", DEMO_ARM_INTERFACE, DEMO_ARM_LICENSE, DEMO_ARM_GENERATOR,
           DEMO_ARM_SIGNATURE_1, DEMO_ARM_SIGNATURE_2, DEMO_ARM_SIGNATURE);
    return 0;
}
"""


@pytest.mark.parametrize(
    "words",
    [["gcc", *STRICT], ["clang", *STRICT], ["g++", *CPP, "-x", "c++"],
     ["clang++", *CPP, "-x", "c++"]],
)  # fmt: skip
def test_joints_limits_and_versions_are_constants(words, tmp_path):
    """Beside the robot file and the manifest."""
    robot, spec = derivation("demo-arm").robot, emitted("demo-arm").spec
    written(tmp_path, "demo-arm")
    (tmp_path / "constants.c").write_text(CONSTANTS)
    run(compiler(words[0]), *words[1:], "constants.c", "demo_arm_joints.c", "-o", "constants",
        where=tmp_path)  # fmt: skip
    *joints, last = run(tmp_path / "constants", where=tmp_path).splitlines()
    for line, joint in zip(joints, spec.joints, strict=True):
        name, unit, effort, actuated, *limits = line.split("|")
        stated = robot.limits.get(joint.name)
        wanted = [np.nan] * 4 if stated is None else dataclasses.astuple(stated)
        assert (name, unit, effort, actuated) == (joint.name, joint.unit, joint.effort_unit, "1")
        assert np.array_equal(np.array(limits, float), wanted, equal_nan=True)
    origin = module_from_json((tmp_path / "manifest.json").read_text(), "").origin
    signature = spec.signature()
    told = [origin.interface, origin.license, origin.generator, signature, signature]
    assert last == "|".join(map(str, told))
    assert origin.license == "MIT" and origin.generator.startswith("modeler ")


def test_the_version_of_modeler_is_in_no_signature(monkeypatch):
    monkeypatch.setattr("modeler.codegen.package.__version__", "99.1")
    later, now = generate(derivation("demo-arm"), control=Control()), emitted("demo-arm")
    differ = {name for name in now.files if later.files[name] != now.files[name]}
    assert differ == {"manifest.json", "demo_arm_generator.h"}
    assert "99.1" in later.files["demo_arm_generator.h"]
    spec = module_from_json(later.files["manifest.json"], "")
    assert spec.signature() == now.spec.signature()


@pytest.mark.parametrize(("name", "precision"), [("demo-arm", "double"), ("five-bar", "single")])
def test_a_port_qualifies_itself_by_vectors(name, precision, tmp_path):
    """And a number that is wrong in the twelfth digit (of floats: the fifth) is told."""
    folder = written(tmp_path, name, precision=precision, vectors=True)
    lines = (folder / "vectors.csv").read_text().splitlines()
    outputs = [
        k for k, line in enumerate(lines) if line.startswith(f"{emitted(name).spec.prefix}_")
    ]
    assert {int(line.split(",")[1]) for line in lines[:-1]} == set(range(50))
    assert lines[-1] == f"outputs,{len(outputs)}"
    assert f"{len(outputs)} outputs, 0 fail" in made(folder, "vectors")
    digits = [len(re.sub(r"e.*|\D", "", x).lstrip("0")) for k in outputs[:40]
              for x in lines[k].split(",")[2:] if x != "0"]  # fmt: skip
    assert min(digits) >= 50
    at = next(k for k in outputs[60:] if "inverse_dynamics" in lines[k])
    head, state, first, *rest = lines[at].split(",")
    largest = max(abs(float(x)) for x in (first, *rest))
    wrong = float(first) + (2e-12 if precision == "double" else 1e-3) * largest
    lines[at] = ",".join([head, state, f"{wrong:.17g}", *rest])
    (folder / "vectors.csv").write_text("\n".join(lines) + "\n")
    told = made(folder, "vectors", fails=True)
    assert f"{head}: state {state}: status 0, apart" in told and " 1 fail" in told
    for short in (lines[:-2], lines[: len(lines) // 2], [lines[0][:-9], *lines[1:]]):
        (folder / "vectors.csv").write_text("\n".join(short) + "\n")
        made(folder, "vectors", fails=True)
    (folder / "vectors.csv").write_text("")
    assert "0 outputs" in made(folder, "vectors", fails=True)


WRAPPED = """#include "demo_arm.hpp"
#include <cstdio>

int main()
{
    namespace arm = demo_arm_model;
    std::array<double, arm::joints> q{}, qd{}, tau{};
    double beta[DEMO_ARM_BASE_PARAMETERS], plain[DEMO_ARM_JOINTS];

    for (std::size_t i = 0; i < arm::joints; i++)
        q[i] = 0.3 * static_cast<double>(i + 1), qd[i] = 0.5;
    for (double &x : beta)
        x = 0.7;
    const auto g = arm::gravity(q, beta);
    demo_arm_gravity(q.data(), beta, plain);
    arm::gravity(q, arm::view<const double, DEMO_ARM_BASE_PARAMETERS>(&beta[0]), tau);
    int wrong = 0;
    for (std::size_t i = 0; i < arm::joints; i++)
        wrong += g[i] != plain[i] || tau[i] != plain[i];
    q[0] = 1.0 / 0.0 * 0.0;
    const auto told = arm::forward_dynamics(q, qd, g, beta);
    const arm::status again = arm::forward_dynamics(q, qd, g, beta, tau);
    wrong += told || told.told != arm::status::not_finite || again != told.told;
    SPOIL;
    std::printf("%d", wrong);
    return wrong;
}
"""


@pytest.mark.parametrize("cc", ["g++", "clang++"])
def test_the_header_for_cpp_returns_what_the_c_writes(cc, tmp_path):
    made(written(tmp_path, "demo-arm"))
    (tmp_path / "wrapped.cpp").write_text(WRAPPED)
    command = [compiler(cc), *CPP, "wrapped.cpp", "libdemo_arm_model.a", "-lm", "-o", "wrapped"]
    run(*command, "-DSPOIL=(void)0", where=tmp_path)
    assert run(tmp_path / "wrapped", where=tmp_path) == "0"
    ignored = "arm::forward_dynamics(q,qd,g,beta,tau)"
    assert "nodiscard" in run(*command, f"-DSPOIL={ignored}", where=tmp_path, fails=True)
    short = "arm::gravity(std::array<double,2>{},beta,tau)"
    assert "no matching function" in run(*command, f"-DSPOIL={short}", where=tmp_path, fails=True)


STATE = """#include "five_bar.hpp"

int main()
{
    namespace robot = five_bar_model;
    static struct five_bar_state now;
    const std::array<float, 2> q{1.9f, 1.1f}, qd{1.0f, -1.0f}, qdd{0.5f, 0.2f};
    std::array<float, FIVE_BAR_BASE_PARAMETERS> beta{};

    beta.fill(1.0f);
    if (robot::close_at(now, q, qd, false) != robot::status::done)
        return 1;
    const auto at = robot::inverse_dynamics_at(now, qdd, beta);
    const auto whole = robot::inverse_dynamics(q, qd, qdd, beta);
    return at && whole && at.value == whole.value ? 0 : 2;
}
"""


def test_the_header_for_cpp_has_the_state_of_loops(tmp_path):
    made(written(tmp_path, "five-bar", precision="single"))
    (tmp_path / "state.cpp").write_text(STATE)
    run(compiler("g++"), *CPP, "state.cpp", "libfive_bar_model.a", "-lm", "-o", "state",
        where=tmp_path)  # fmt: skip
    run(tmp_path / "state", where=tmp_path)


# What calls cost.


PAINTED = """#define _GNU_SOURCE
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include "five_bar.h"

enum { SIZE = 1 << 18 };
static unsigned char stack[SIZE] __attribute__((aligned(4096)));
static double q[] = {1.9, 1.1}, qd[] = {1.0, 1.0}, qdd[] = {1.0, 1.0};
static double beta[FIVE_BAR_BASE_PARAMETERS], out[1024];

static void *nothing(void *x) { return x; }
static void *torque(void *x) { five_bar_inverse_dynamics(q, qd, qdd, beta, out); return x; }
static void *rows(void *x) { five_bar_regressor(q, qd, qdd, out); return x; }

static int used(void *(*run)(void *))
{
    pthread_attr_t how;
    pthread_t thread;
    int i = 0;

    memset(stack, 0xA5, SIZE);
    pthread_attr_init(&how);
    pthread_attr_setstack(&how, stack, SIZE);
    pthread_create(&thread, &how, run, NULL);
    pthread_join(thread, NULL);
    while (i < SIZE && stack[i] == 0xA5)
        i++;
    return SIZE - i;
}

int main(void)
{
    used(rows), used(torque); /* binds the functions of the C library */
    printf("%d %d %d", used(nothing), used(torque), used(rows));
    return 0;
}
"""


def costs(module: Emitted) -> dict[str, dict[str, object]]:
    told = json.loads(with_cost(module, "host").files["cost.json"])
    return {row["name"]: row for row in told["functions"]}


def test_the_stack_of_a_call_is_a_bound_of_what_it_uses(tmp_path):
    """Painted and looked at after the call; the C library's own frames come on top."""
    compiler("gcc"), compiler("objdump")
    found = costs(emitted("five-bar"))
    written(tmp_path, "five-bar")
    (tmp_path / "painted.c").write_text(PAINTED)
    flags = ["-O3", "-fno-tree-slp-vectorize", "-fno-math-errno", "-fno-trapping-math",
             "-ffp-contract=fast"]  # fmt: skip
    sources = ["modeler_batch.c", *sorted(p.name for p in tmp_path.glob("five_bar*.c"))]
    sources += sorted(p.name for p in tmp_path.glob("modeler_clos*.c"))
    run("gcc", *flags, "painted.c", *sources, "-lm", "-lpthread", "-o", "painted", where=tmp_path)
    nothing, *both = map(int, run(tmp_path / "painted", where=tmp_path).split())
    for painted, name in zip(both, ("inverse_dynamics", "regressor"), strict=True):
        stack = found[f"five_bar_{name}"]["stack"]
        assert painted - nothing - 1500 <= stack <= 2 * (painted - nothing), name


def test_what_one_function_costs_alone():
    """A function that calls nothing: its frame and its section, as the compiler states them."""
    compiler("gcc"), compiler("objdump")
    found = costs(emitted("demo-arm", "friction,inverse_dynamics"))
    friction, torque = found["demo_arm_friction"], found["demo_arm_inverse_dynamics"]
    assert friction["outside"] == [] and 0 < friction["flash"] < torque["flash"]
    assert friction["stack"] < torque["stack"] and torque["outside"]


@pytest.mark.parametrize("name", ["two-link", "five-bar"])
def test_the_stack_of_a_function_in_several_versions_is_that_of_the_largest(name, tmp_path):
    """As gcc states it of each; functions that call none of ours are told that and no more."""
    compiler("gcc"), compiler("objdump")
    module = emitted(name)
    found, prefix = costs(module), module.spec.prefix
    write_emitted(module, tmp_path)
    sources = [n for n in module.spec.controller_sources if n.startswith(prefix) and n[-1] == "c"]
    flags = ["-std=c99", "-O3", "-fno-tree-slp-vectorize", "-fno-math-errno",
             "-fno-trapping-math", "-ffp-contract=fast"]  # fmt: skip
    run("gcc", *flags, "-fno-asynchronous-unwind-tables", "-fstack-usage", "-c", *sources,
        where=tmp_path)  # fmt: skip
    frames: dict[str, int] = {}
    for path in tmp_path.glob("*.su"):
        for place, size, _ in (line.split("\t") for line in path.read_text().splitlines()):
            function, _, version = place.rpartition(":")[2].partition(".")
            if version != "resolver":
                frames[function] = max(frames.get(function, 0), int(size))
    assert len(found) > 8
    for function, row in found.items():
        assert row["stack"] >= frames[function] > 0, function
    if name == "two-link":
        assert found["two_link_regressor"]["stack"] == frames["two_link_regressor"]
    else:
        inner = frames["five_bar_tree_regressor"] + frames["five_bar_regressor"]
        assert found["five_bar_regressor"]["stack"] >= inner


def test_a_machine_whose_compiler_is_missing_is_refused_in_one_line(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(BuildError, match="--measure: arm-none-eabi-gcc is not installed; install"):
        with_cost(emitted("demo-arm", "gravity"), "cortex-m7")


def test_the_cost_on_a_microcontroller_is_in_the_readme(tmp_path):
    for tool in ("arm-none-eabi-gcc", "qemu-system-arm"):
        compiler(tool)
    module = with_cost(emitted("two-link", "gravity,forward_dynamics", "single"), "cortex-m4")
    told = json.loads(module.files["cost.json"])
    gravity = next(row for row in told["functions"] if row["name"] == "two_link_gravity")
    assert 10 < gravity["instructions"] < 400 and 50 < gravity["flash"] < 2000
    line = f"| `two_link_gravity` | {gravity['stack']} | {gravity['flash']} "
    assert line + f"| {gravity['instructions']} |" in module.files["README.md"]
    write_emitted(module, tmp_path)
    assert (tmp_path / "cost.json").is_file()
