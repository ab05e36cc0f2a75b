"""Every function of a folder against an oracle that knows the table alone."""

import re
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest

from modeler.api.workflow import load
from modeler.codegen import Control, derive
from modeler.robot.read import parse_robot_text
from tests.control import draw
from tests.control.emitted_folder import Folder
from tests.oracles.complex_step import Oracle

LOOPS = tuple(
    """
    five-bar 3rrr delta stewart sr400 orthoglide-2003 orthoglide-2012 evra orthoglide-leg dvrk-psm
    wrist-coupled
""".split()
)
TREES = ("sr400-tree", "orthoglide-leg-tree", *(f"tree {k}" for k in range(4)))
CHAINS = (
    *"puma560 panda ur10e wrist rx90 scara lwr kinova_gen3 tx40 so101 vx300s two-link".split(),
    "chain 0",
    "chain 1",
)

SOLVED = 1e-9  # of what equations are solved for, or loops are
EXACT = 1e-11
SINGLE = 1e-4
WIDTH = 0.3  # rad/s
DAMPING = 0.1


class State(NamedTuple):
    """Posture u (free variables), motion, references; as the folder's numbers hold them."""

    u: np.ndarray
    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    v: np.ndarray
    a: np.ndarray


def derivation(name: str):
    """Of a built-in robot, or of one drawn: "chain 1", "tree 2"."""
    kind, _, seed = name.partition(" ")
    if name == "dry":
        return derive(parse_robot_text(COULOMB, "dry.toml"))
    return derive(draw.drawn(int(seed), tree=kind == "tree") if seed else load(name))


def states(folder: Folder, samples: int, seed: int, wide: float = 1.0) -> Iterator[State]:
    """Random states; those of loops closed on a way from home."""
    o, random, number = folder.oracle, np.random.default_rng(seed), folder.number
    home = home_of(folder)
    reach = wide * (0.25 if folder.robot.loops else 2.0)
    units = np.array([1.0 if j.is_revolute else 0.3 * o.size for j in folder.robot.coordinates])
    text = 0
    for _ in range(20 * samples):
        q = home[o.given] + random.uniform(-reach, reach, o.n) * units
        q = q.astype(number).astype(float)
        motion = random.normal(0, 1, (4, o.n)).astype(number).astype(float)
        u = home
        for share in np.linspace(0, 1, 9 if o.solved else 2)[1:]:
            u = o.closed(home[o.given] * (1 - share) + q * share, u)
        if not np.isfinite(u).all() or o.regular(u) < 0.03:
            continue
        yield State(u, q, *motion)
        text += 1
        if text == samples:
            return
    raise AssertionError("no closed postures near home")


def home_of(folder: Folder) -> np.ndarray:
    """The free variables at home, closed."""
    o, closure = folder.oracle, folder.spec.closure
    inputs = folder.robot.home
    home = np.array([inputs.get(j.name, 0.0) for j in folder.robot.free_joints])
    if closure is not None:
        assert len(closure.home) == len(home)
        home = np.array(closure.home)
    for _ in range(30 if o.solved else 0):
        open_, slopes = o.errors(home)
        home = home - np.linalg.lstsq(slopes[0], open_[0], rcond=None)[0]
    return home


def expected(o: Oracle, folder: Folder, s: State) -> dict[str, tuple]:
    """{role: (what it gives, bound in double precision[, what to make of the output])}."""
    beta, chi = folder.beta, np.array(list(folder.chi.values()))
    exact = SOLVED if o.solved else EXACT
    u, qd = s.u, s.qd
    tau = o.torques(u, qd, s.qdd)[0]

    def of_beta(out):
        return out.astype(float) @ beta

    rate = np.einsum("kfn,k->fn", o.slopes(o.G, u), qd) if o.solved else None
    table = {
        "inverse_dynamics": (tau, exact),
        "regressor": (tau, exact, lambda out: out.astype(float) @ chi),
        "base_regressor": (tau, exact, of_beta),
        "inertia_matrix": (o.inertia(u), exact),
        "gravity": (o.gravity_torques(u), exact),
        "coriolis": (o.coriolis_matrix(u, qd) @ qd, exact),
        "friction": (o.friction(u, qd)[0], exact),
        "forward_kinematics": (o.forward_kinematics(u), exact),
        "coriolis_matrix": (o.coriolis_matrix(u, qd), exact),
        "coriolis_transpose": (o.coriolis_transpose(u, qd), exact),
        "momentum": (o.momentum(u, qd), exact),
        "slotine_li_regressor": (o.slotine_li(u, qd, s.v, s.a), exact, of_beta),
        "momentum_regressor": (o.momentum(u, qd), exact, of_beta),
        "momentum_rest_regressor": (o.momentum_rest(u, qd), exact, of_beta),
        "power_regressor": (o.lost_power(u, qd), exact, of_beta),
        "pose": (o.pose(u), exact),
        "jacobian": (o.jacobian(u), exact),
        "jacobian_dot_qd": (o.jacobian_dot_qd(u, qd), exact),
        "twist": (o.twist(u, qd), exact),
        "derivatives": (o.inverse_derivatives(u, qd, s.qdd), exact),
        "forward_dynamics": (o.forward_dynamics(u, qd, tau), SOLVED),
        "forward_derivatives": (o.forward_derivatives(u, qd, tau), SOLVED),
        "operational_inertia": (o.operational_inertia(u, DAMPING), SOLVED),
        "operational_inverse": (o.operational_inverse(u, DAMPING), SOLVED),
        "coupling": (o.G(u)[0], SOLVED),
        "coupling_rate": (rate, SOLVED),
        "close": (u, SOLVED),
        "close_from": (u, SOLVED),
    }
    for end, name in named(folder).items():
        table[f"pose_{end}"] = (o.pose(u, name), exact)
        table[f"jacobian_{end}"] = (o.jacobian(u, name), exact)
        table[f"jacobian_dot_qd_{end}"] = (o.jacobian_dot_qd(u, qd, name), exact)
        table[f"twist_{end}"] = (o.twist(u, qd, name), exact)
    o.width = WIDTH
    table["smooth_friction"] = (o.friction(u, qd)[0], exact)
    table["smooth_inverse_dynamics"] = (o.torques(u, qd, s.qdd)[0], exact)
    o.width = 0.0
    return table


def named(folder: Folder) -> dict[str, str]:
    """{end of the function's name: row or link} that was requested besides the tool."""
    ends = [role[len("pose_") :] for role in folder.roles if role.startswith("pose_")]
    names = [*folder.robot.frames, *(joint.name for joint in folder.robot.joints)]
    table = {re.sub(r"\W", "_", name).lower(): name for name in reversed(names)}
    return {end: table[end] for end in ends}


def widths(folder: Folder) -> np.ndarray:
    """As many as the folder's friction turns over."""
    sizes = [a.size for f in folder.roles.values() for a in f.inputs if a.name == "widths"]
    return np.full(max(sizes, default=0), WIDTH)


def together(folder: Folder) -> bool:
    """Whether joints that turn in proportion share a dry friction: one width serves for both."""
    return any(
        sum(t.parameter.startswith("Fs") for t in base.terms) > 1 for base in folder.spec.base
    )


SMOOTH = ("smooth_friction", "smooth_inverse_dynamics")
LEFT = ("base_regressor_nonzeros", "base_parameters", "energy_regressor", "advance")
"""Checked on their own, or none of a posture."""


def checked(folder: Folder, samples: int, seed: int, wide: float = 1.0) -> dict[str, float]:
    """{role: error over its bound}, the worst of all states; every role of the folder."""
    worst: dict[str, float] = {}
    o, beta = folder.oracle, folder.beta
    before = None

    def compare(role: str, out, status: int, wanted: tuple) -> None:
        value, bound, *make = wanted
        assert status == 0, f"{role}: status {status}"
        got = make[0](out) if make else out
        bound = max(bound, SINGLE) if folder.single else bound
        scale = max(np.abs(value).max(), 0.1)
        error = np.abs(got - value).max() / scale / bound
        worst[role] = max(worst.get(role, 0.0), error) if error == error else np.inf

    for s in states(folder, samples, seed, wide):
        wanted = expected(o, folder, s)
        tau = o.torques(s.u, s.qd, s.qdd)[0]
        cells = {
            **s._asdict(),
            "beta": beta,
            "tau": tau,
            "damping": [DAMPING],
            "start": home_of(folder),
            "widths": widths(folder),
        }
        state = None
        if folder.has("state"):
            status, state = folder.state(s.q, s.qd)
            assert status == 0
        for role in folder.roles:
            plain = role.removeprefix("fitted_")
            if plain in LEFT or "platform" in plain or (plain in SMOOTH and together(folder)):
                continue
            compare(role, *reversed(folder.call(role, **cells)), wanted[plain])
            if state is not None and folder.has(f"{role}_at"):
                compare(f"{role}_at", *reversed(folder.call(role, state, **cells)), wanted[plain])
        h = folder.call("energy_regressor", **cells)[1].astype(float) @ beta
        total = o.energy(s.u, s.qd)
        if before is not None:
            compare("energy_regressor", h - before[0], 0, (total - before[1], SOLVED))
        before = h, total
    return worst


def refuse(worst: dict[str, float]) -> None:
    bad = {role: error for role, error in worst.items() if not error <= 1.0}
    assert not bad, bad


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Folders by robot and precision, each compiled once."""

    @cache
    def made(name: str, single: bool = False) -> Folder:
        result = derivation(name)
        moving = [name for name, frame in result.robot.frames.items() if frame.row != "0"]
        frames = (result.robot.joints[0].name, *moving[:1])
        path = tmp_path_factory.mktemp("c")
        return Folder(result, path, single, control=Control(frames)).compiled()

    return made


def slowly(names, fast: tuple[str, ...]):
    return [n if n in fast else pytest.param(n, marks=pytest.mark.slow) for n in names]


FAST = ("two-link", "tree 1", "five-bar")


@pytest.mark.parametrize("name", slowly((*CHAINS, *TREES, *LOOPS), FAST))
def test_every_function_is_that_of_the_table(folder, name):
    """Twins with values and functions at a state too; nothing that the folder has is left out."""
    refuse(checked(folder(name), samples=2, seed=31))


@pytest.mark.rotating("long tests of control")
@pytest.mark.parametrize("name", slowly(("tx40", "tree 3", "orthoglide-2003", *FAST), FAST[1:]))
def test_every_function_in_single_precision(folder, name):
    refuse(checked(folder(name, single=True), samples=2, seed=32))


@pytest.mark.parametrize("name", ["tree 1", "five-bar"])
def test_the_oracle_knows_mechanics_two_ways(folder, name):
    """Lagrange and Newton-Euler, the skewness of M' - 2C, the power of the torques."""
    o = folder(name).oracle
    for s in states(folder(name), 2, 33):
        tau = o.torques(s.u, s.qd, s.qdd)[0]
        np.testing.assert_allclose(o.inverse_dynamics(s.u, s.qd, s.qdd), tau, atol=1e-11)
        C, rate = o.coriolis_matrix(s.u, s.qd), np.einsum("kij,k->ij", o.slopes(o.M, s.u), s.qd)
        np.testing.assert_allclose(C + C.T, rate, atol=1e-12)


# Bad input: a status and NaN, never a number.


NOT_FINITE = 3
COULOMB = """
name = "dry"
gravity = [0, 0, -9.81]
[mdh]
columns = ["j", "d", "alpha", "theta"]
rows = [["1", 0, 0, "q1"], ["2", 0.3, "pi/2", "q2"]]
[effects]
coulomb = "all"
"""


PLATFORM = pytest.param("orthoglide-2003", marks=pytest.mark.rotating)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("name", ["two-link", "dry", "five-bar", PLATFORM])
def test_what_is_not_finite_is_told(folder, name, bad):
    """Wherever it stands: a status and NaN; without a status, no finite number that it enters."""
    made = folder(name)
    s = next(states(made, 1, 34))
    good = everything(made, s)
    state = made.state(s.q, s.qd)[1] if made.has("state") else None
    for role, function in made.roles.items():
        for argument in function.inputs:
            value = np.array(good[argument.name], float)
            for place in {0, value.size - 1}:
                wrong = value.copy()
                wrong.flat[place] = bad
                inputs = good | {argument.name: wrong}
                where = f"{role}({argument.name}[{place}] = {bad})"
                status, out = made.call(role, **inputs)
                if not function.status:
                    entered = out != made.call(role, **good)[1]
                    assert not np.isfinite(out[entered]).any(), where
                    continue
                assert status == NOT_FINITE and np.isnan(out).all(), where
                if made.has(f"{role}_at") and argument.name not in ("q", "qd"):
                    status, out = made.call(role, state, **inputs)
                    assert status == NOT_FINITE and np.isnan(out).all(), where


def everything(made: Folder, s: State) -> dict[str, np.ndarray]:
    """All inputs of all functions at a good state."""
    o, closure = made.oracle, made.spec.closure
    x = s.u[list(closure.platform or ())] if closure else s.u[:0]
    return {
        **s._asdict(),
        "beta": made.beta,
        "tau": o.torques(s.u, s.qd, s.qdd)[0],
        "damping": np.array([DAMPING]),
        "start": home_of(made),
        "widths": widths(made),
        "chi": np.array(list(made.chi.values())),
        **{"x": x, "xd": 0 * x + 1, "xdd": 0 * x + 1},
    }


@pytest.mark.parametrize("factor", [0.0, -1.0])
@pytest.mark.parametrize("name", ["two-link", "five-bar"])
def test_an_inertia_that_is_none_is_told(folder, name, factor):
    """Links without mass, or less: forward dynamics and what inverts M say so."""
    made = folder(name)
    s = next(states(made, 1, 35))
    none = everything(made, s) | {"beta": factor * made.beta}
    roles = {
        "forward_dynamics",
        "forward_derivatives",
        "operational_inertia",
        "operational_inverse",
    } & made.roles.keys()
    assert "forward_dynamics" in roles
    for role in roles:
        status, out = made.call(role, **none)
        assert status == 2 and np.isnan(out).all(), role


def test_rank_loss_is_told_unless_it_is_damped(folder):
    """Two joints do not move a tool in six directions."""
    made = folder("two-link")
    good = everything(made, next(states(made, 1, 36)))
    for role in ("operational_inertia", "operational_inverse"):
        status, out = made.call(role, **(good | {"damping": [0.0]}))
        assert status == 2 and np.isnan(out).all()
        assert made.call(role, **good)[0] == 0


def test_far_from_home_loops_are_closed_or_it_is_told(folder):
    """Over the whole turn: what has status 0 is closed and right, all else is NaN."""
    made, random = folder("five-bar"), np.random.default_rng(37)
    o = made.oracle
    good = everything(made, next(states(made, 1, 38)))
    text = closed = 0
    for q in random.uniform(-np.pi, np.pi, (120, o.n)):
        inputs = good | {"q": q}
        status, u = made.call("close", **inputs)
        if status == 0:
            closed += 1
            assert np.abs(o.errors(u)[0]).max() < 1e-9
            if o.regular(u) > 0.01:
                M = made.call("inertia_matrix", **inputs)[1]
                np.testing.assert_allclose(M, o.inertia(u), atol=1e-8 * np.abs(M).max())
            continue
        text += 1
        for role, function in made.roles.items():
            if function.status and role != "close_from":
                answer, out = made.call(role, **inputs)
                assert answer != 0 and np.isnan(out).all(), role
    assert closed and text
