"""The C of a fitted model: its functions against the regressors, and friction of any width."""

import dataclasses

import numpy as np
import pytest

from modeler.core.errors import EmitError
from modeler.core.manifest import FittedSpec
from tests.codegen.fitted_library import Functions, fitted_of, motion, robot_module, with_values
from tests.rotation import rotating, with_cases

KINDS = (
    pytest.param("slow-arm", marks=pytest.mark.digits),
    *(pytest.param(n, marks=pytest.mark.rotating) for n in ("sr400", "ur10e", "orthoglide-2003")),
)
"""One whose effects read signals, one whose joints are tied, a serial robot, one with loops."""


def beta_of(spec) -> np.ndarray:
    assert spec.fitted is not None
    return np.array([parameter.value for parameter in spec.fitted.parameters])


def alike(got: np.ndarray, expected: np.ndarray, within: float = 1e-12) -> None:
    scale = max(float(np.abs(expected).max(initial=0.0)), 1e-300)
    np.testing.assert_allclose(got / scale, expected / scale, rtol=0, atol=within)


@pytest.mark.parametrize("name", KINDS)
def test_fitted_functions_are_the_regressor_times_the_values(name):
    """And every one of them is its twin, which reads beta."""
    made = Functions(with_values(name))
    beta, state = beta_of(made.spec), motion(name)
    alike(made("fitted_inverse_dynamics", state), made("base_regressor", state) @ beta)
    np.testing.assert_array_equal(made.numbers("beta", len(beta)), beta)
    twins = [role for role in made.roles if role != "fitted_inverse_dynamics"]
    assert len(twins) >= 4
    for role in twins:
        alike(made(role, state), made(role.removeprefix("fitted_"), {**state, "beta": beta}))
    alike(parts(made, state), made("fitted_inverse_dynamics", state))


def parts(made: Functions, state) -> np.ndarray:
    """M qdd + c + g + f."""
    total = np.einsum("nij,nj->ni", made("fitted_inertia_matrix", state), state["qdd"])
    for role in ("coriolis", "gravity", "friction"):
        total = total + made(f"fitted_{role}", state)
    return total


def friction_alone(name: str, *kinds: str) -> FittedSpec:
    """Parameters of these kinds at least 0, all others 0."""
    spec = robot_module(name).emitted.spec
    fitted = fitted_of(spec)
    parameters = tuple(
        dataclasses.replace(p, value=p.value * base.column_of.startswith(kinds))
        for p, base in zip(fitted.parameters, spec.base, strict=True)
    )
    return dataclasses.replace(fitted, parameters=parameters)


@pytest.mark.parametrize("name", ["slow-arm", *rotating("rubbing")])
def test_friction_takes_power_at_every_width_and_tends_to_the_sign(name):
    """Fs and Fv at least 0, offsets and all else 0: f qd >= 0. Passive joints of loops rub too."""
    emitted, state = with_values(name, friction_alone(name, "Fs", "Fv")), motion(name)
    slow = np.logspace(-3, 0, len(state["qd"]))[:, None]
    state["qd"] = speeds = np.copysign(slow + np.abs(state["qd"]) * slow, state["qd"])
    sharp, farther = Functions(emitted)("fitted_friction", state), np.inf
    for width in (1.0, 1e-8):
        friction = Functions(emitted, COULOMB_WIDTH=width)("fitted_friction", state)
        assert np.all(np.sum(friction * speeds, axis=1) >= 0.0)
        distance = float(np.abs(friction - sharp).max())
        assert distance < farther
        farther = distance
    assert np.all(np.sum(sharp * speeds, axis=1) > 0.0)
    assert farther < 1e-6 * np.abs(sharp).max()


def test_friction_is_fs_tanh_and_a_joint_may_have_a_width_of_its_own():
    """By the equation, on an arm that turns and slides; the rest is what the sign leaves."""
    emitted, state = with_values("slow-arm"), motion("slow-arm")
    spec = emitted.spec
    assert spec.fitted.widths == tuple(f"SLOW_ARM_COULOMB_WIDTH_{j}" for j in "123")
    header = emitted.files["slow_arm_fitted.h"]
    assert "WIDTH_2 [rad/s]" in header and "WIDTH_3 [m/s]" in header
    # What fits rely on is phi beta, with the sign, at every width.
    reading = {name for name in spec.sources if "COULOMB_WIDTH" in emitted.files[name]}
    assert reading == {"slow_arm_fitted.c", "slow_arm_fitted.h"}
    sharp = Functions(emitted)("fitted_friction", state)
    wide = Functions(emitted, COULOMB_WIDTH=0.3, COULOMB_WIDTH_3=0.05)
    alike(parts(wide, state), wide("fitted_inverse_dynamics", state))
    beta = dict(zip([base.name for base in spec.base], beta_of(spec), strict=True))
    v, friction = state["qd"], wide("fitted_friction", state)
    alike(friction[:, 2] - sharp[:, 2], beta["Fs3"] * (np.tanh(v[:, 2] / 0.05) - np.sign(v[:, 2])))
    every = Functions(emitted, COULOMB_WIDTH=0.05, COULOMB_WIDTH_3=0)("fitted_friction", state)
    np.testing.assert_array_equal(every[:, 2], sharp[:, 2])
    for turned in (friction, every):
        assert np.all(np.any(turned[:, :2] != sharp[:, :2], axis=0))


@pytest.mark.parametrize("width", [0.0, 0.1])
def test_a_speed_that_is_no_number_gives_a_torque_that_is_none(width):
    """Coulomb friction alone: the sign of NaN must not be 0, that of infinity no number."""
    emitted = with_values("two-link", friction_alone("two-link", "Fs"))
    speeds = np.array([[np.nan, 0.0], [np.inf, -np.inf], [0.0, 1e-320]])
    torques = Functions(emitted, COULOMB_WIDTH=width)(
        "fitted_friction", {"q": speeds, "qd": speeds}
    )
    assert np.isnan(torques[0, 0]) and torques[0, 1] == 0.0
    assert np.all(np.isnan(torques[1])) and np.all(np.isfinite(torques[2]))
    assert torques[2, 0] == 0.0


def test_values_of_zero_cost_nothing():
    """Only what was set aside saves operations: the base parameters are as few as can be."""
    spec = robot_module("demo-arm").emitted.spec
    some = fitted_of(spec)
    fewer = dataclasses.replace(
        some,
        parameters=tuple(
            dataclasses.replace(p, value=p.value * (i % 2), sigma=0.1 if i % 2 else None)
            for i, p in enumerate(some.parameters)
        ),
    )
    twins = {f.name: f for f in spec.functions}
    for values, most in ((some, 1.0), (fewer, 0.95)):
        emitted = with_values("demo-arm", values)
        for function in emitted.spec.fitted.functions:
            twin = twins[function.name.replace("_fitted", "")]
            assert function.additions <= most * twin.additions
            assert function.multiplications <= most * twin.multiplications
    assert "set aside: the logs do not identify it" in emitted.files["demo_arm_fitted.c"]


@with_cases(
    "change, says",
    (lambda p: p[1:], "expected those of the base parameters"),
    (lambda p: (p[1], p[0], *p[2:]), "expected those of the base parameters"),
    (
        lambda p: (dataclasses.replace(p[0], value=float("nan")), *p[1:]),
        r"ZZ1R: got the value nan; expected a number; fit the model again",
    ),
)
def test_values_that_are_none_are_refused(change, says):
    fitted: FittedSpec = fitted_of(robot_module("two-link").emitted.spec)
    wrong = dataclasses.replace(fitted, parameters=change(fitted.parameters))
    with pytest.raises(EmitError, match=says):
        with_values("two-link", wrong)
