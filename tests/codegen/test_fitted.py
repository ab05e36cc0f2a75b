"""The C of a fitted model: its functions against the regressors, and friction of any width."""

import dataclasses

import numpy as np
import pytest

from modeler.core.errors import EmitError
from modeler.core.manifest import FittedSpec
from tests.codegen.fitted_library import Functions, fitted_of, motion, robot_module, with_values

KINDS = (
    *("sr400", pytest.param("slow-arm", marks=pytest.mark.digits)),
    *(pytest.param(name, marks=pytest.mark.rotating) for name in ("ur10e", "orthoglide-2003")),
)
"""One whose joints are tied, one whose effects read signals, a serial robot, one with loops."""


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
    beta, given = beta_of(made.spec), motion(name)
    alike(made("fitted_inverse_dynamics", given), made("base_regressor", given) @ beta)
    np.testing.assert_array_equal(made.numbers("beta", len(beta)), beta)
    twins = [role for role in made.roles if role != "fitted_inverse_dynamics"]
    assert len(twins) >= 4
    for role in twins:
        alike(made(role, given), made(role.removeprefix("fitted_"), {**given, "beta": beta}))
    alike(parts(made, given), made("fitted_inverse_dynamics", given))


def parts(made: Functions, given) -> np.ndarray:
    """M qdd + c + g + f."""
    total = np.einsum("nij,nj->ni", made("fitted_inertia_matrix", given), given["qdd"])
    for role in ("coriolis", "gravity", "friction"):
        total = total + made(f"fitted_{role}", given)
    return total


@pytest.mark.parametrize(
    "name", ["slow-arm", pytest.param("orthoglide-2003", marks=pytest.mark.rotating)]
)
def test_parts_add_up_whatever_the_width(name):
    emitted = with_values(name)
    given = motion(name)
    sharp, wide = Functions(emitted), Functions(emitted, COULOMB_WIDTH=0.3)
    alike(parts(wide, given), wide("fitted_inverse_dynamics", given))
    apart = sharp("fitted_friction", given) - wide("fitted_friction", given)
    assert np.all(np.abs(apart).max(axis=0) > 0.0)
    # What fits rely on is phi beta, with the sign, at every width.
    beta = {**given, "beta": beta_of(emitted.spec)}
    for role in ("base_regressor", "regressor", "inverse_dynamics", "friction"):
        np.testing.assert_array_equal(wide(role, beta), sharp(role, beta))


@pytest.mark.parametrize("name", ["slow-arm", pytest.param("rubbing", marks=pytest.mark.rotating)])
def test_friction_takes_power_at_every_width_and_tends_to_the_sign(name):
    """Fs and Fv at least 0, offsets and all else 0: f qd >= 0. Passive joints of loops rub too."""
    spec = robot_module(name).emitted.spec
    only = dataclasses.replace(
        fitted_of(spec),
        parameters=tuple(
            dataclasses.replace(p, value=abs(p.value) * (base.column_of[:2] in ("Fs", "Fv")))
            for p, base in zip(fitted_of(spec).parameters, spec.base, strict=True)
        ),
    )
    emitted, given = with_values(name, only), motion(name)
    slow = np.logspace(-3, 0, len(given["qd"]))[:, None]
    given["qd"] = speeds = np.copysign(slow + np.abs(given["qd"]) * slow, given["qd"])
    sharp, farther = Functions(emitted)("fitted_friction", given), np.inf
    for width in (1.0, 1e-8):
        friction = Functions(emitted, COULOMB_WIDTH=width)("fitted_friction", given)
        assert np.all(np.sum(friction * speeds, axis=1) >= 0.0)
        distance = float(np.abs(friction - sharp).max())
        assert distance < farther
        farther = distance
    assert np.all(np.sum(sharp * speeds, axis=1) > 0.0)
    assert farther < 1e-6 * np.abs(sharp).max()


def test_friction_of_one_joint_is_fs_tanh_and_a_joint_may_have_a_width_of_its_own():
    """By the equation, on an arm that turns and slides; the rest is what the sign leaves."""
    spec = robot_module("slow-arm").emitted.spec
    emitted, given = with_values("slow-arm"), motion("slow-arm")
    assert emitted.spec.fitted.widths == tuple(f"SLOW_ARM_COULOMB_WIDTH_{j}" for j in "123")
    header = emitted.files["slow_arm_fitted.h"]
    assert "WIDTH_2 [rad/s]" in header and "WIDTH_3 [m/s]" in header
    own = Functions(emitted, COULOMB_WIDTH_3=0.05)("fitted_friction", given)
    sharp = Functions(emitted)("fitted_friction", given)
    np.testing.assert_array_equal(own[:, :2], sharp[:, :2])
    Fs = {base.name: p.value for base, p in zip(spec.base, emitted.spec.fitted.parameters,
                                                strict=True)}["Fs3"]  # fmt: skip
    v = given["qd"][:, 2]
    alike(own[:, 2] - sharp[:, 2], Fs * (np.tanh(v / 0.05) - np.sign(v)))
    every = Functions(emitted, COULOMB_WIDTH=0.05, COULOMB_WIDTH_3=0)("fitted_friction", given)
    np.testing.assert_array_equal(every[:, 2], sharp[:, 2])
    assert np.all(np.any(every[:, :2] != sharp[:, :2], axis=0))


@pytest.mark.parametrize("width", [0.0, 0.1])
def test_a_speed_that_is_no_number_gives_a_torque_that_is_none(width):
    """Coulomb friction alone: the sign of NaN must not be 0, that of infinity no number."""
    spec = robot_module("two-link").emitted.spec
    fitted = fitted_of(spec)
    values = [p.value * base.column_of.startswith("Fs")
              for p, base in zip(fitted.parameters, spec.base, strict=True)]  # fmt: skip
    only = tuple(dataclasses.replace(p, value=v) for p, v in
                 zip(fitted.parameters, values, strict=True))  # fmt: skip
    emitted = with_values("two-link", dataclasses.replace(fitted, parameters=only))
    speeds = np.array([[np.nan, 0.0], [np.inf, -np.inf], [0.0, 1e-320]])
    given = {"q": speeds, "qd": speeds}
    got = Functions(emitted, COULOMB_WIDTH=width)("fitted_friction", given)
    assert np.isnan(got[0, 0]) and got[0, 1] == 0.0
    assert np.all(np.isnan(got[1])) and np.all(np.isfinite(got[2])) and got[2, 0] == 0.0


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
    for given, most in ((some, 1.0), (fewer, 0.95)):
        emitted = with_values("demo-arm", given)
        for function in emitted.spec.fitted.functions:
            twin = twins[function.name.replace("_fitted", "")]
            assert function.additions <= most * twin.additions
            assert function.multiplications <= most * twin.multiplications
    assert "set aside: the logs do not tell it" in emitted.files["demo_arm_fitted.c"]


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (lambda p: p[1:], "expected those of the base parameters"),
        (lambda p: (p[1], p[0], *p[2:]), "expected those of the base parameters"),
        (lambda p: (dataclasses.replace(p[0], value=float("nan")), *p[1:]),
         r"ZZ1R: got the value nan; expected a number; fit the model again"),
    ],
)  # fmt: skip
def test_values_that_are_none_are_refused(change, told):
    fitted: FittedSpec = fitted_of(robot_module("two-link").emitted.spec)
    wrong = dataclasses.replace(fitted, parameters=change(fitted.parameters))
    with pytest.raises(EmitError, match=told):
        with_values("two-link", wrong)
