"""A controller's state of a robot with loops: closed once a cycle, then every quantity from it."""

import ctypes
import shutil
import subprocess
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from modeler.codegen.package import write_emitted
from modeler.core.manifest import EmittedModule, ModuleSpec
from tests.modules import STRICT, compiler, module
from tests.rotation import ROTATING

MORE = ("delta", "orthoglide-2003", "stewart", "evra")
ROBOTS = ["five-bar", *(pytest.param(name, marks=ROTATING) for name in MORE)]


class Robot(NamedTuple):
    """A robot's compiled C, and a state of it."""

    spec: ModuleSpec
    library: ctypes.CDLL
    memory: Any

    def call(self, role: str, *arguments: np.ndarray | int | None, out: tuple[int, ...] = ()):
        """(status, output) of `<prefix>_<role>`; at the state where the name ends so."""
        known = [
            a if a is None or isinstance(a, int) else ctypes.c_void_p(a.ctypes.data)
            for a in arguments
        ]
        result = np.zeros(out)
        known += [ctypes.c_void_p(result.ctypes.data)] if out else []
        known = [self.memory, *known] if role.endswith("_at") else known
        return getattr(self.library, f"{self.spec.prefix}_{role}")(*known), result

    def state(self, q, qd, first=False, most=None):
        """Status of `<prefix>_state`, or with `most` of `<prefix>_state_with_bound`."""
        arrays = [np.ascontiguousarray(x) for x in (q, qd)]
        previous = None if first else ctypes.c_void_p(self.library.last_posture(self.memory))
        inputs = [*(ctypes.c_void_p(x.ctypes.data) for x in arrays), previous]
        if most is None:
            return int(getattr(self.library, f"{self.spec.prefix}_state")(*inputs, self.memory))
        call = getattr(self.library, f"{self.spec.prefix}_state_with_bound")
        return int(call(*inputs, most, self.memory))


def compiled(emitted: EmittedModule, folder: Path, *flags: str) -> ctypes.CDLL:
    """A robot's C with counting.c."""
    prefix = emitted.spec.prefix
    write_emitted(emitted, folder)
    shutil.copy(Path(__file__).parent / "counting.c", folder)
    command = [compiler("gcc"), *STRICT, "-O0", *flags, f'-DHEADER="{prefix}.h"']
    command += [f"-DPREFIX={prefix}", "-shared", "-fPIC", "-o", "robot.so"]
    command += [f"-Wl,--wrap={prefix}_tree_{part}" for part in ("closure", "residual")]
    units = [path.name for path in folder.glob("*.c")]
    subprocess.run([*command, *units, "-lm"], cwd=folder, check=True)
    return ctypes.CDLL(str(folder / "robot.so"))


@pytest.fixture(scope="module")
def robots(tmp_path_factory) -> Any:
    """{name: Robot}, each compiled once."""

    @cache
    def robot(name: str) -> Robot:
        emitted = module(name).emitted
        library = compiled(emitted, tmp_path_factory.mktemp("c"))
        library.state_size.restype = ctypes.c_size_t
        library.last_posture.restype = ctypes.c_void_p
        memory = ctypes.create_string_buffer(library.state_size())
        return Robot(emitted.spec, library, memory)

    return robot


def motion(spec: ModuleSpec, t: np.ndarray, seed: int) -> tuple[np.ndarray, ...]:
    """q, qd, qdd around home: up to some 0.3 rad or 0.1 m, and 2 rad/s or 0.7 m/s."""
    rng = np.random.default_rng(seed)
    closure = spec.closure
    assert closure is not None
    home = np.array([closure.home[k] for k in closure.actuated])
    size = np.array([0.3 if joint.unit == "rad" else 0.08 for joint in spec.joints])
    size = size * rng.uniform(0.5, 1, len(home))
    w, phase = rng.uniform(4, 8, len(home)), rng.uniform(-3, 3, len(home))
    angle = t[:, None] * w + phase
    q = home + size * (np.sin(angle) - np.sin(phase))
    return q, size * w * np.cos(angle), -size * w**2 * np.sin(angle)


@pytest.mark.parametrize("name", ["five-bar", pytest.param("delta", marks=ROTATING)])
def test_memory_of_zeros_is_no_state_and_a_first_cycle_that_fails_does_no_harm(name, robots):
    robot = robots(name)
    fresh = robot._replace(memory=ctypes.create_string_buffer(len(robot.memory)))
    n, u = len(robot.spec.joints), len(robot.spec.closure.home)
    q, qd, qdd = (x[0] for x in motion(robot.spec, np.zeros(1), seed=3))
    beta = np.ones(len(robot.spec.base))

    def refused() -> bool:
        calls = [
            fresh.call("gravity_at", beta, out=(n,)),
            fresh.call("inverse_dynamics_at", qdd, beta, out=(n,)),
            fresh.call("coupling_rate_at", out=(u, n)),
        ]
        return all(status != 0 and np.isnan(out).all() for status, out in calls)

    assert refused()
    assert fresh.state(np.full(n, np.nan), qd) == 3 and refused()
    assert fresh.state(np.full(n, 1e3), qd) in (1, 4) and refused()
    assert fresh.state(q, qd) == 0  # from its own last posture, which is none: from home
    status, torque = fresh.call("gravity_at", beta, out=(n,))
    assert status == 0 and np.isfinite(torque).all()


@pytest.mark.parametrize("name", ROBOTS)
def test_one_cycle_of_a_controller_at_1_khz_evaluates_the_loops_at_most_4_times(name, robots):
    """Torques, M, g, C, friction and regressor together."""
    robot = robots(name)
    spec, n, c = robot.spec, len(robot.spec.joints), len(robot.spec.base)
    counter = ctypes.c_int.in_dll(robot.library, "evaluations")
    q, qd, qdd = motion(spec, np.arange(0, 0.15, 1e-3), 11)
    beta = np.random.default_rng(4).normal(size=c)
    assert robot.state(q[0], 0 * qd[0], first=True) == 0
    for k in range(len(q)):
        now = [np.ascontiguousarray(x[k]) for x in (q, qd, qdd)]
        counter.value = 0
        assert robot.state(*now[:2]) == 0
        at = {  # their values: tests/control/test_every_function.py
            "inverse_dynamics": robot.call("inverse_dynamics_at", now[2], beta, out=(n,)),
            "inertia_matrix": robot.call("inertia_matrix_at", beta, out=(n, n)),
            "gravity": robot.call("gravity_at", beta, out=(n,)),
            "coriolis": robot.call("coriolis_at", beta, out=(n,)),
            "friction": robot.call("friction_at", beta, out=(n,)),
            "base_regressor": robot.call("base_regressor_at", now[2], out=(n, c)),
        }
        assert counter.value <= 4
        assert all(status == 0 and np.isfinite(got).all() for status, got in at.values())


@pytest.mark.parametrize("name", ROBOTS)
def test_a_bound_holds_at_run_time_is_told_and_the_next_cycle_goes_on(name, robots):
    """From the last closed posture, far from home, though the bound would not do from home."""
    robot = robots(name)
    spec = robot.spec
    counter = ctypes.c_int.in_dll(robot.library, "evaluations")
    q, qd, _ = motion(spec, np.arange(0, 0.3, 1e-3), 5)
    assert robot.state(q[0], qd[0], True, 5000) == 0
    far = q[0] + 40.0 * np.sign(q[-1] - q[0])
    for k in range(1, len(q)):
        if k % 60 == 0:  # a cycle with a wrong measurement
            for most in (0, 1, 2, 7):
                counter.value = 0
                assert robot.state(far, qd[k], most=most) == 4
                assert counter.value <= most
        counter.value = 0
        assert robot.state(q[k], qd[k], most=7) == 0, k
        assert counter.value <= 7
    counter.value = 0
    assert robot.state(q[-1], qd[-1], True, 2) == 4 and counter.value <= 2
    assert robot.state(q[-1], qd[-1], True, 10**9) == 0


@pytest.mark.rotating("long tests of loops")
def test_the_bound_of_the_whole_library_is_a_macro(tmp_path):
    emitted = module("five-bar").emitted
    library = compiled(emitted, tmp_path, "-DFIVE_BAR_MAX_CLOSURE_EVALUATIONS=9")
    counter, u = ctypes.c_int.in_dll(library, "evaluations"), np.zeros(4)
    home = np.array([emitted.spec.closure.home[k] for k in emitted.spec.closure.actuated])
    for far, status in ((1e-3, 0), (0.6, 4), (1e9, 4)):
        counter.value = 0
        q = home + far * np.array([1.0, -1.0])
        assert library.five_bar_close(*(ctypes.c_void_p(x.ctypes.data) for x in (q, u))) == status
        assert counter.value <= 9


def test_what_cannot_be_closed_is_told_and_the_last_posture_is_kept(robots):
    robot = robots("five-bar")
    n, beta = len(robot.spec.joints), np.ones(len(robot.spec.base))
    q, qd, _ = motion(robot.spec, np.array([0.0, 1e-3]), 13)
    assert robot.state(q[0], qd[0], first=True) == 0
    for bad_q, bad_qd, expected in (
        (q[0] + [4.0, -4.0], qd[0], {1, 2, 4}),
        (q[0] + [np.nan, 0], qd[0], {3}),
        (q[0], qd[0] + [0, np.inf], {3}),
    ):
        data = robot.state(bad_q, bad_qd)
        assert data in expected
        status, tau = robot.call("gravity_at", beta, out=(n,))
        assert status == data and np.isnan(tau).all()
        status, rate = robot.call("coupling_rate_at", out=(4, n))
        assert status == data and np.isnan(rate).all()
        assert robot.state(q[1], qd[1]) == 0
        status, tau = robot.call("gravity_at", beta, out=(n,))
        assert status == 0 and np.isfinite(tau).all()
    status, tau = robot.call("gravity_at", beta * np.nan, out=(n,))
    assert status == 3 and np.isnan(tau).all()


MICROCONTROLLER = ("-mcpu=cortex-m7", "-mfpu=fpv5-d16", "-mthumb", "-mfloat-abi=hard")


@pytest.mark.parametrize(
    "flags",
    [
        pytest.param(flags, marks=ROTATING)
        for flags in (("gcc",), ("arm-none-eabi-gcc", *MICROCONTROLLER))
    ],
)
def test_functions_at_a_state_need_no_more_than_8_kb_of_stack(flags, tmp_path):
    """All of evra's, with the deepest of what they call added."""
    if shutil.which(flags[0]) is None:
        pytest.skip(f"NOT CHECKED: {flags[0]} is not installed")
    emitted = module("evra").emitted
    write_emitted(emitted, tmp_path)
    command = [*flags, "-std=c99", "-O2", "-fno-inline", "-fstack-usage", "-c"]
    subprocess.run([*command, *(p.name for p in tmp_path.glob("*.c"))], cwd=tmp_path, check=True)
    sizes = {}
    for path in Path(tmp_path).glob("*.su"):
        for line in path.read_text().splitlines():
            place, size = line.split("\t")[:2]
            sizes[place.split(":")[-1]] = int(size)
    assert {"evra_state", "evra_gravity_at", "evra_base_regressor_at"} <= sizes.keys()
    at = max(size for name, size in sizes.items() if name.endswith(("_at", "_state")))
    made = max(v for k, v in sizes.items() if k.startswith(("made_", "base_rows", "evra_moved")))
    tree = max(v for k, v in sizes.items() if k.startswith("evra_tree_"))
    runtime = sum(v for k, v in sizes.items() if k in ("walk", "stepped", "modeler_close_next"))
    assert at + made + runtime + tree <= 8192
