"""What a controller calls of a robot with loops, against laws of mechanics along closed motions."""

from functools import cache

import numpy as np
import pytest

from modeler.codegen.control import Control
from modeler.codegen.emit import emit
from modeler.core.errors import LoopError
from tests.codegen.fitted_library import fitted_of, robot_module
from tests.loops.test_loops_outside import physical
from tests.modules import loaded, module
from tests.rotation import ROTATING

ROBOTS = [
    "five-bar",
    *(pytest.param(n, marks=ROTATING) for n in ("3rrr", "delta", "orthoglide-2003", "stewart")),
    *(pytest.param(n, marks=pytest.mark.slow) for n in ("orthoglide-2012", "evra")),
]
H = 1e-5  # s, of central differences


@cache
def controlled(name, precision="double"):
    """The compiled robot with the controller's unit."""
    made = module(name)
    return loaded(emit(made.model, made.base, precision=precision, control=Control()))


class Motion:
    """Random states around home, and what is called there; `at(t)`: moved for a time t."""

    def __init__(self, name, samples=4, seed=31, precision="double"):
        self.robot = controlled(name, precision)
        spec, rng = self.robot.spec, np.random.default_rng(seed)
        home = [spec.closure.home[k] for k in spec.closure.given]
        size = np.array([0.2 if joint.unit == "rad" else 0.04 for joint in spec.joints])
        shape = (samples, len(home))
        self.q = home + size * rng.uniform(-1, 1, shape)
        self.qd, self.qdd = rng.normal(0, 1, shape), rng.normal(0, 3, shape)
        self.v, self.a = rng.normal(0, 1, shape), rng.normal(0, 3, shape)
        chi = physical(name)
        losing = [k for k, p in enumerate(spec.standard) if p.kind != "inertial"]
        chi[losing] = rng.uniform(0.1, 0.5, len(losing))
        self.beta = self.robot.base_parameters(chi)

    def at(self, t):
        q = self.q + self.qd * t + self.qdd * t**2 / 2
        return {"q": q, "qd": self.qd + self.qdd * t}

    def call(self, role, t=0.0, **more):
        """A function at that time, with what it reads."""
        inputs = next(
            f.inputs for f in self.robot.spec.every_function
            if f.name == f"{self.robot.spec.prefix}_{role}"
        )  # fmt: skip
        known = {"beta": self.beta, "qdd": self.qdd, "v": self.v, "a": self.a, **self.at(t), **more}
        return self.robot.evaluate(role, **{a.name: known[a.name] for a in inputs})

    def rate(self, role, **more):
        """Its derivative by time, along the motion."""
        return (self.call(role, H, **more) - self.call(role, -H, **more)) / (2 * H)


def close(got, expected, bound):
    assert np.isfinite(expected).all()
    assert np.abs(got - expected).max() <= bound * max(1e-3, np.abs(expected).max())


@pytest.mark.parametrize("name", ROBOTS)
def test_laws_of_the_functions_of_a_controller(name):
    """Skewness of M' - 2C, rates of momentum and energy, Slotine and Li's regressor."""
    x = Motion(name)
    M, C, qd = x.call("inertia_matrix"), x.call("coriolis_matrix"), x.qd[..., None]
    close(C + C.transpose(0, 2, 1), x.rate("inertia_matrix"), 1e-6)
    close((C @ qd)[..., 0], x.call("coriolis"), 1e-9)
    close(x.call("coriolis_transpose"), (C.transpose(0, 2, 1) @ qd)[..., 0], 1e-9)
    # C(q, qd) v = C(q, v) qd: what makes it that of Christoffel among all that are skew.
    swapped = x.call("coriolis_matrix", qd=x.v) @ qd
    close((C @ x.v[..., None])[..., 0], swapped[..., 0], 1e-9)
    p, tau = x.call("momentum"), x.call("inverse_dynamics")
    close(p, (M @ qd)[..., 0], 1e-10)
    close(x.call("momentum_regressor") @ x.beta, p, 1e-10)
    rest = x.call("momentum_rest_regressor") @ x.beta
    close(x.rate("momentum") + rest, tau, 1e-6)
    energy, power = x.rate("energy_regressor")[:, 0], x.call("power_regressor")[:, 0]
    close((energy + power) @ x.beta, np.einsum("ni,ni->n", tau, x.qd), 1e-6)
    close(
        x.call("slotine_li_regressor", v=x.qd, a=x.qdd), x.call("base_regressor"), 1e-10
    )  # fmt: skip
    expected = (M @ x.a[..., None] + C @ x.v[..., None])[..., 0] + x.call("gravity")
    expected += x.call("friction", qd=x.v)
    close(x.call("slotine_li_regressor") @ x.beta, expected, 1e-9)


@pytest.mark.parametrize("name", ROBOTS)
def test_accelerations_and_frames(name):
    """Round trip of forward and inverse dynamics; Jacobian and twist against moved poses."""
    x = Motion(name, seed=32)
    tau = x.call("inverse_dynamics")
    close(x.call("forward_dynamics", tau=tau), x.qdd, 1e-10)
    T, J = x.call("pose"), x.call("jacobian")
    motion = (J @ x.qd[..., None])[..., 0]
    moved = x.rate("pose")
    close(motion[:, :3], moved[:, :, 3], 1e-6)
    turned = moved[:, :, :3] @ T[:, :, :3].transpose(0, 2, 1)  # R' R^T, skew
    turns = np.stack([turned[:, 2, 1], turned[:, 0, 2], turned[:, 1, 0]], axis=1)
    close(motion[:, 3:], turns, 1e-6)
    x.v = x.qd
    fast = (x.call("jacobian", H) @ (x.qd + x.qdd * H)[..., None])[..., 0]
    slow = (x.call("jacobian", -H) @ (x.qd - x.qdd * H)[..., None])[..., 0]
    bias = x.call("jacobian_dot_qd")
    close((J @ x.qdd[..., None])[..., 0] + bias, (fast - slow) / (2 * H), 1e-6)
    own = np.einsum("nji,naj->nai", T[:, :, :3], motion.reshape(-1, 2, 3)).reshape(-1, 6)
    close(x.call("twist"), own, 1e-10)


@pytest.mark.parametrize("name", ["five-bar", pytest.param("delta", marks=ROTATING)])
def test_single_precision_gives_what_double_precision_gives(name):
    one, two = Motion(name, precision="single", seed=33), Motion(name, seed=33)
    tau = two.call("inverse_dynamics")
    for role in ("coriolis_matrix", "coriolis_transpose", "momentum", "slotine_li_regressor",
                 "momentum_rest_regressor", "jacobian", "jacobian_dot_qd", "forward_dynamics",
                 "coupling_rate"):  # fmt: skip
        close(one.call(role, tau=tau), two.call(role, tau=tau), 5e-5)


def test_what_cannot_be_done_is_told():
    """Loops that do not close, a singular posture, NaN, no inertia: a status and NaN."""
    x = Motion("five-bar", samples=1)
    now = {"q": x.q, "qd": x.qd, "beta": x.beta}
    for wrong, expected in (
        ({"q": x.q + np.array([[4.0, -4.0]])}, (1, 2, 4)),
        ({"q": x.q * np.nan}, (3,)),
        ({"beta": x.beta * np.inf}, (3,)),
    ):
        assert x.robot.statuses("coriolis_matrix", **{**now, **wrong})[0] in expected
        with pytest.raises(LoopError):
            x.robot.evaluate("coriolis_matrix", **{**now, **wrong})
    given = {"q": x.q, "qd": x.qd, "tau": x.v}
    assert x.robot.statuses("forward_dynamics", **given, beta=x.beta)[0] == 0
    assert x.robot.statuses("forward_dynamics", **given, beta=0 * x.beta)[0] == 2
    assert x.robot.statuses("forward_dynamics", **given, beta=-x.beta)[0] == 2


def test_fitted_functions_have_the_values():
    """Of a robot with loops: the same numbers as with the values as beta."""
    made = robot_module("five-bar")
    fitted = fitted_of(made.emitted.spec)
    robot = loaded(emit(made.model, made.base, fitted, control=Control()))
    x = Motion("five-bar", seed=34)
    x.beta = np.array([parameter.value for parameter in fitted.parameters])
    given = {"q": x.q, "qd": x.qd}
    for role in ("coriolis_matrix", "coriolis_transpose", "momentum"):
        close(robot.evaluate(f"fitted_{role}", **given), x.call(role), 1e-12)
