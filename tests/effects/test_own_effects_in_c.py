"""Effects that a robot file defines: their columns in the emitted C against numpy."""

from collections.abc import Callable

import numpy as np
import pytest

from modeler.api import define_effect, derive, generate, load
from modeler.core.errors import EmitError
from modeler.robot.edit import insert_effect, replace_reference
from modeler.robot.read import parse_robot_text
from modeler.robot.robot import Robot
from modeler.runtime.model import CompiledModel
from tests.effects.test_effects_in_c import moved_torque
from tests.modules import loaded
from tests.rotation import rotating

SAMPLES = 50
JOINT = 1  # joint "2"
REFERENCE = {"ZZ1": 1.2, "ZZ2": 3.0, "MX2": 3.0, "MX3": 1.1, "ZZ3": 0.4}
Columns = Callable[[np.ndarray, np.ndarray, np.ndarray, np.ndarray], list[np.ndarray]]

# definition, its shapes on the joint, the same in numpy (of q, v, a and the last signal)
OWN: dict[str, tuple[dict, dict[str, float], Columns]] = {
    "eddy_brake": (
        {"columns": {"Keb": "v*exp(-((q - c)/w)**2)"}, "shapes": {"c": [-1, 1], "w": [0.1, 0.3]}},
        {"c": 0.7, "w": 0.2},
        lambda q, v, a, s: [v * np.exp(-(((q - 0.7) / 0.2) ** 2))],
    ),
    "two_columns": (
        {"columns": {"Ka": "a*sin(pi*q)", "Kb": "abs(v)**p*sign(v)"}, "shapes": {"p": 1.5}},
        {},
        lambda q, v, a, s: [a * np.sin(np.pi * q), np.abs(v) ** 1.5 * np.sign(v)],
    ),
    "hook": (
        {"columns": {"Kh": "z*tanh(q)"}, "shapes": {"d": [0.01, 0.1]}},
        {"d": 0.03},
        lambda q, v, a, s: [s * np.tanh(q)],
    ),
    "tiring": (
        {"columns": {"Kt": "tanh(9*v)*exp(-since/w)"}, "shapes": {"w": [0.1, 1]}},
        {"w": 0.4},
        lambda q, v, a, s: [np.tanh(9.0 * v) * np.exp(-s / 0.4)],
    ),
    "warming": (
        {"columns": {"Kz": "v*z**p"}, "lag": "abs(v)", "shapes": {"p": 2, "tau": [0.1, 1]}},
        {"tau": 0.4},
        lambda q, v, a, s: [v * s**2],
    ),
}


def arm_with(name, definition, shapes, reference=False):
    """The demonstration arm with the effect on joint 2."""
    text = insert_effect(
        define_effect(load("demo-arm"), name, **definition).text, name, "2", shapes
    )
    return parse_robot_text(replace_reference(text, REFERENCE) if reference else text, name)


def columns_of(robot: Robot, name: str, compiled: CompiledModel, phi: np.ndarray) -> np.ndarray:
    """(n, joints, k) columns of the effect on joint 2."""
    names = [p.name for p in compiled.spec.standard]
    effect = next(e for e in robot.own_effects if e.id == name)
    return phi[:, :, [names.index(f"{column.prefix}2") for column in effect.columns]]


@pytest.mark.parametrize(
    "name", ["hook", "warming", *rotating("eddy_brake", "two_columns", "tiring")]
)
def test_c_computes_the_equation_of_the_robot_file(name: str) -> None:
    definition, shapes, expected = OWN[name]
    robot = arm_with(name, definition, shapes)
    derivation = derive(robot)
    assert derivation.base.proof.kind == "exact"
    compiled = loaded(generate(derivation))
    generator = np.random.default_rng(3)
    q, v, a = generator.uniform(-2.0, 2.0, (3, SAMPLES, 3))
    s = generator.uniform(0.1, 0.9, (SAMPLES, len(compiled.spec.signals)))
    signals = s if s.size else None
    phi = compiled.regressor(q, v, a, signals)
    got = columns_of(robot, name, compiled, phi)
    wanted = expected(q[:, JOINT], v[:, JOINT], a[:, JOINT], s[:, -1] if s.size else np.zeros(0))
    np.testing.assert_allclose(got[:, JOINT], np.column_stack(wanted), rtol=1e-12, atol=1e-14)
    assert not np.delete(got, JOINT, axis=1).any()
    # Torques: base parameters by the grouping relations against standard parameters.
    chi = generator.normal(size=phi.shape[2])
    beta = compiled.base_parameters(chi)
    standard = phi @ chi
    for base in (
        compiled.base_regressor(q, v, a, signals) @ beta,
        compiled.inverse_dynamics(q, v, a, beta, signals),
    ):
        np.testing.assert_allclose(base, standard, rtol=0, atol=1e-12 * np.abs(standard).max())


@pytest.mark.parametrize("precision", ["double", "single"])
def test_an_equation_reads_the_motion_of_other_joints(precision):
    """Tiles, scalar functions and friction alone, against numpy."""
    columns = {"Kl": "v*exp(-(q3/w)**2)", "Km": "a1*sin(q) + v3*abs(v1)"}
    robot = arm_with("leaning", {"columns": columns, "shapes": {"w": [0.5, 1]}}, {"w": 0.8})
    derivation = derive(robot)
    assert derivation.base.proof.kind == "exact"
    arm = loaded(generate(derivation, precision=precision))
    q, v, a = np.random.default_rng(13).uniform(-2.0, 2.0, (3, SAMPLES, 3))
    phi = arm.regressor(q, v, a)
    got = columns_of(robot, "leaning", arm, phi)
    eddies = v[:, 1] * np.exp(-((q[:, 2] / 0.8) ** 2))
    others = a[:, 0] * np.sin(q[:, 1]) + v[:, 2] * np.abs(v[:, 0])
    wanted = np.column_stack([eddies, others])
    close = (
        {"rtol": 1e-12, "atol": 1e-14} if precision == "double" else {"rtol": 2e-5, "atol": 1e-6}
    )
    np.testing.assert_allclose(got[:, JOINT], wanted, **close)
    assert not np.delete(got, JOINT, axis=1).any()
    place = [b.name for b in arm.spec.base].index("Kl2")
    np.testing.assert_allclose(arm.base_regressor(q, v, a)[:, JOINT, place], wanted[:, 0], **close)
    one = np.eye(len(arm.spec.base))[place]
    friction = arm.friction(v, one, q=q, qdd=a)
    np.testing.assert_allclose(friction[:, JOINT], wanted[:, 0], **close)


def test_what_moves_the_position_moves_the_links() -> None:
    """Column of the C against differences of the inverse dynamics along q + e tanh(2 q)."""
    definition = {"columns": {"Kp": "tanh(k*q)"}, "shapes": {"k": 2}, "acts": "position"}
    robot = arm_with("runout", definition, {}, reference=True)
    compiled = loaded(generate(derive(robot)))
    chi = np.array([REFERENCE.get(p.name, 0.0) for p in compiled.spec.standard])
    q, v, a = np.random.default_rng(5).uniform(-1.0, 1.0, (3, SAMPLES, 3))
    got = columns_of(robot, "runout", compiled, compiled.regressor(q, v, a))[:, :, 0]
    slope = 2.0 / np.cosh(2.0 * q) ** 2
    by = (np.tanh(2.0 * q), slope, -4.0 * np.tanh(2.0 * q) * slope)
    moved = moved_torque(compiled, chi, (q, v, a), by)
    np.testing.assert_allclose(got, moved, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("equation", ["v", *rotating("sign(v)", "1", "2*v**2 - v")])
def test_columns_that_others_have_are_grouped_in_numbers(equation: str) -> None:
    """The base has full rank whatever the user writes twice."""
    columns = {"Ka": equation, "Kb": f"3*({equation})"}
    robot = arm_with("twice", {"columns": columns}, {})
    derivation = derive(robot)
    assert derivation.base.proof.kind == "numeric"
    compiled = loaded(generate(derivation))
    q, v, a = np.random.default_rng(6).uniform(-2.0, 2.0, (3, 200, 3))
    phi = compiled.regressor(q, v, a)
    base = compiled.base_regressor(q, v, a)
    flat = base.reshape(-1, base.shape[2])
    assert np.linalg.matrix_rank(flat / np.linalg.norm(flat, axis=0)) == base.shape[2]
    chi = np.random.default_rng(7).normal(size=phi.shape[2])
    np.testing.assert_allclose(base @ compiled.base_parameters(chi), phi @ chi, atol=1e-9)


def test_robots_with_loops_take_effects_of_motion_only() -> None:
    """They say which effects have no C there."""

    def with_column(equation: str) -> Robot:
        local = define_effect(load("five-bar"), "own", columns={"Kv": equation}).text
        text = replace_reference(insert_effect(local, "own", "11", {}), {"ZZ11": 0.2})
        return parse_robot_text(text, "five-bar")

    for equation in ("v*static", "t"):
        with pytest.raises(EmitError, match=r"five-bar has loops, and effects that read more than"):
            generate(derive(with_column(equation)))
    compiled = loaded(generate(derive(with_column("sin(3*v)*q + a*sin(q)"))))
    home = np.array(compiled.spec.closure.home)[list(compiled.spec.closure.actuated)]
    rng = np.random.default_rng(8)
    q, v, a = home + rng.uniform(-0.1, 0.1, (9, 2)), *rng.normal(size=(2, 9, 2))
    column = [p.column_of for p in compiled.spec.base].index("Kv11")
    phi = compiled.base_regressor(q, v, a)[:, :, column]
    expected = np.sin(3 * v[:, 0]) * q[:, 0] + a[:, 0] * np.sin(q[:, 0])
    np.testing.assert_allclose(phi, np.stack([expected, 0 * expected], 1), atol=1e-13)
    beta = rng.normal(size=len(compiled.spec.base))
    M = compiled.inertia_matrix(q, beta)
    parts = compiled.gravity(q, beta) + compiled.coriolis(q, v, beta)
    parts += np.einsum("nij,nj->ni", M, a) + compiled.friction(v, beta, q, a)
    np.testing.assert_allclose(compiled.inverse_dynamics(q, v, a, beta), parts, atol=1e-12)
