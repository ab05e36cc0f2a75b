"""Functions for controllers beside Pinocchio, and by laws that no derivation is needed for."""

import numpy as np
import pytest

from tests.bodies import buildable
from tests.control.draw import emitted
from tests.modules import loaded
from tests.oracles.pinocchio_dynamics import PinocchioDynamics

SAMPLES = 5
FEW = [("puma560", False), (1, True)]
CHAINS = ("panda", "ur10e", "scara", "wrist", "emps", "rx90", "sr400-tree", 1, 2, 3, 4, 5)
MORE = [*((name, False) for name in CHAINS), *((seed, True) for seed in (2, 3, 4, 5))]
ROBOTS = [*FEW, *(pytest.param(*each, marks=pytest.mark.slow) for each in MORE)]


def drawn_states(n: int, seed: int) -> dict[str, np.ndarray]:
    rng = np.random.default_rng([17, seed])
    q = rng.uniform(-3, 3, (SAMPLES, n))
    return {"q": q} | {name: rng.normal(size=q.shape) for name in ("qd", "qdd", "v", "a")}


@pytest.mark.parametrize(("name", "tree"), ROBOTS)
def test_functions_are_those_of_pinocchio(name, tree):
    robot, made = emitted(name, tree)
    model, spec = loaded(made), made.spec
    chi = buildable(spec, np.random.default_rng(23))
    beta = model.base_parameters(chi)
    oracle = PinocchioDynamics(robot, {p.name: x for p, x in zip(spec.standard, chi, strict=True)})
    x = drawn_states(len(spec.joints), 1)
    theirs = [oracle.at(*(values[k] for values in x.values())) for k in range(SAMPLES)]
    end = "tool" if robot.tool else robot.joints[-1].name
    expected = {role: np.array([each[role] for each in theirs]) for role in theirs[0]}
    x |= {"beta": beta, "tau": expected["tau"]}
    functions = {f.name.removeprefix(f"{spec.prefix}_"): f for f in spec.every_function}

    def ours(role: str) -> np.ndarray:
        return model.evaluate(role, **{a.name: x[a.name] for a in functions[role].inputs})

    def close(got: np.ndarray, role: str, bound: float = 1e-11) -> None:
        wanted = expected[role]
        error = np.abs(got.reshape(wanted.shape) - wanted).max()
        assert error <= bound * max(np.abs(wanted).max(), 1.0), (robot.name, role, error)

    for role in "inertia_matrix coriolis_matrix coriolis_transpose momentum derivatives".split():
        close(ours(role), role)
    for role in ("forward_dynamics", "forward_derivatives"):
        close(ours(role), role, 1e-9)
    for damping in (0.1, 0.0) if len(spec.joints) == 6 else (0.1,):
        x["damping"] = [damping]
        each = [
            PinocchioDynamics.operational(t["inertia_matrix"], t[f"jacobian {end}"], damping)
            for t in theirs
        ]
        expected |= {role: np.array([one[role] for one in each]) for role in each[0]}
        for role in each[0]:
            close(ours(role), role, 1e-8)
    for role, of in (
        ("slotine_li_regressor", "slotine_li"),
        ("momentum_regressor", "momentum"),
        ("momentum_rest_regressor", "momentum_rest"),
    ):
        close(ours(role) @ beta, of)
    # An offset may group with gravity, so energy and losses are compared by the power balance.
    h = 1e-4
    ahead, behind = (
        model.evaluate(
            "energy_regressor",
            q=x["q"] + step * x["qd"] + step**2 / 2 * x["qdd"],
            qd=x["qd"] + step * x["qdd"],
        )
        for step in (h, -h)
    )
    power = ((ahead - behind) / (2 * h) + ours("power_regressor")) @ beta
    error = np.abs(power.ravel() - expected["power"]).max()
    assert error <= 1e-6 * np.abs(expected["power"]).max()
    first = robot.joints[0].name
    for suffix, frame in (("", end), (f"_{first}", first)):
        for role in ("pose", "jacobian", "jacobian_dot_qd", "twist"):
            if f"{role} {frame}" in expected:
                close(ours(f"{role}{suffix}"), f"{role} {frame}")
