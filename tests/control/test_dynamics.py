"""Functions for controllers beside Pinocchio, and by laws that no derivation is needed for."""

import numpy as np
import pytest

from modeler.robot import Robot
from tests.bodies import buildable
from tests.control.draw import emitted
from tests.control.pinocchio_dynamics import Oracle
from tests.modules import loaded

SAMPLES = 5
SERIAL = [("puma560", False), (1, False)]
TREES = [(1, True)]
MORE = [*((name, False) for name in ("panda", "ur10e", "scara", "wrist", "emps", "rx90")),
        *((seed, False) for seed in (2, 3, 4, 5)), ("sr400-tree", False),
        *((seed, True) for seed in (2, 3, 4, 5))]  # fmt: skip
ROBOTS = [*SERIAL, *TREES, *(pytest.param(*each, marks=pytest.mark.slow) for each in MORE)]


def drawn_states(n: int, seed: int) -> dict[str, np.ndarray]:
    rng = np.random.default_rng([17, seed])
    q = rng.uniform(-3, 3, (SAMPLES, n))
    return {"q": q} | {name: rng.normal(size=q.shape) for name in ("qd", "qdd", "v", "a")}


def compare(robot: Robot, single: bool, made, bound: float) -> None:
    model, spec = loaded(made), made.spec
    n, rng = len(spec.joints), np.random.default_rng(23)
    chi = buildable(spec, rng)
    beta = model.base_parameters(chi)
    oracle = Oracle(robot, {p.name: x for p, x in zip(spec.standard, chi, strict=True)})
    x = drawn_states(n, 1)
    if single:
        x = {name: values.astype(np.float32).astype(float) for name, values in x.items()}
    theirs = [oracle.at(*(values[k] for values in x.values())) for k in range(SAMPLES)]
    expected = {name: np.array([each[name] for each in theirs]) for name in theirs[0]}

    def close(role: str, got: np.ndarray, wanted: np.ndarray) -> None:
        error = np.abs(got.reshape(wanted.shape) - wanted).max()
        assert error <= bound * max(np.abs(wanted).max(), 1.0), (robot.name, role, error)

    def ours(role: str) -> np.ndarray:
        function = next(f for f in spec.control.functions if f.name == f"{spec.prefix}_{role}")
        reads = [argument.name for argument in function.inputs]
        return model.evaluate(role, **{k: beta if k == "beta" else x[k] for k in reads})

    for role in ("coriolis_matrix", "coriolis_transpose", "momentum", "derivatives"):
        close(role, ours(role), expected[role])
    for role, of in (("slotine_li_regressor", "slotine_li"), ("momentum_regressor", "momentum"),
                     ("momentum_rest_regressor", "momentum_rest")):  # fmt: skip
        close(role, ours(role) @ beta, expected[of])
    # An offset may group with gravity, so energy and losses are compared by the power balance.
    h = 1e-2 if single else 1e-4
    ahead, behind = (
        model.evaluate("energy_regressor", q=x["q"] + step * x["qd"] + step**2 / 2 * x["qdd"],
                       qd=x["qd"] + step * x["qdd"]) for step in (h, -h)
    )  # fmt: skip
    power = ((ahead - behind) / (2 * h) + ours("power_regressor")) @ beta
    error = np.abs(power.ravel() - expected["power"]).max()
    assert error <= (2e-2 if single else 1e-6) * np.abs(expected["power"]).max()
    first = robot.joints[0].name
    end = "tool" if robot.tool else robot.joints[-1].name
    for suffix, frame in (("", end), (f"_{first}", first)):
        for role in ("pose", "jacobian", "jacobian_dot_qd", "twist"):
            if f"{role} {frame}" in expected:
                close(role, ours(f"{role}{suffix}"), expected[f"{role} {frame}"])


@pytest.mark.parametrize(("robot", "tree"), ROBOTS)
def test_functions_are_those_of_pinocchio(robot, tree):
    compare(emitted(robot, tree)[0], False, emitted(robot, tree)[1], 1e-11)


@pytest.mark.parametrize(
    ("robot", "tree"), [(1, True), pytest.param("panda", False, marks=pytest.mark.slow)]
)
def test_single_precision_is_as_near_as_floats_can_be(robot, tree):
    found, made = emitted(robot, tree, True)
    compare(found, True, made, 5e-5)
