"""The robot file with one effect more."""

import numpy as np

from modeler.core.errors import DataError, RobotError
from modeler.effects import PASSIVE_FRICTION, PASSIVE_FRICTION_IS, Acts, Effect
from modeler.hypotheses.candidates import Candidate
from modeler.hypotheses.signals import Reference
from modeler.hypotheses.tilt import tilt_basis
from modeler.robot import Robot, robot_from_text
from modeler.robot.edit import with_coupling, with_effect, with_gravity, with_reference


def described(text: str, pick: Candidate, values: np.ndarray, reference: Reference) -> str:
    """The robot file with the effect.

    Args:
        text: as it is.
        pick: effect, joint, shapes.
        values: of its parameters, for effects that change the description itself.
        reference: the model.

    Raises:
        DataError: its coupling cannot be written.
        RobotError: it stands there already.
    """
    effect = pick.effect
    if effect.acts is Acts.GRAVITY:
        return with_gravity(text, _tilted(text, values, reference).tolist())
    if effect.acts is Acts.PASSIVE:
        assert pick.joint is not None
        return _passive(text, effect, pick.joint)
    assert pick.joint is not None
    if effect.acts is Acts.MOTOR:
        text = _coupled(text, pick, reference)
    changed = with_effect(text, effect.id, pick.joint, _shapes(pick, reference))
    return with_reference(changed, _referred(reference)) if _depends(effect) else changed


def _passive(text: str, effect: Effect, joint: str) -> str:
    """The file with friction on a joint without motor."""
    robot = robot_from_text(text, "robot of the model")
    everyone = [row.name for row in robot.moving if row.actuated]
    for name in PASSIVE_FRICTION_IS if effect.id == PASSIVE_FRICTION else (effect.id,):
        text = with_effect(text, name, joint, {}, everyone)
    return text


def _shapes(pick: Candidate, reference: Reference) -> dict[str, float]:
    """The shapes of a joint's effect, and where its temperature or time is 0."""
    shapes = {} if pick.effect.acts is Acts.MOTOR else dict(pick.shapes)
    fixed = {s.name: s.grid[0] for s in pick.form.shapes if len(s.grid) == 1}
    shapes = {name: value for name, value in shapes.items() if fixed.get(name) != value}
    moments = [shape.name for shape in pick.form.shapes if shape.scale == "moment"]
    if moments and _is_first_moment(pick, reference):
        shapes |= dict.fromkeys(moments, 0.0)
    if "T" in pick.form.names and pick.joint is not None:
        shapes["T0"] = reference.temperature[pick.joint]
    if "t" in pick.form.names:
        shapes["t0"] = reference.time
    return shapes


def _is_first_moment(pick: Candidate, reference: Reference) -> bool:
    """True if the model has sin(q - q0) on that joint already: gravity of its links."""
    model = reference.compiled
    joints = len(model.spec.joints)
    generator = np.random.default_rng(7)
    q, qd, qdd = generator.uniform(-2.0, 2.0, (3, 40 * joints, joints))
    signals = np.ones((len(q), len(model.spec.signals))) if model.spec.signals else None
    phi = model.base_regressor(q, qd, qdd, signals).reshape(q.size, -1)
    column = np.zeros(q.shape)
    column[:, pick.index] = np.sin(q[:, pick.index] - pick.shapes["q0"])
    target = column.ravel()
    solved = np.linalg.lstsq(phi, target, rcond=1e-10)[0]
    return bool(np.linalg.norm(phi @ solved - target) < 1e-6 * np.linalg.norm(target))


def _depends(effect: Effect) -> bool:
    names = frozenset().union(*(form.names for form in effect.forms))
    return effect.acts is Acts.POSITION or not names.isdisjoint({"load", "static", "torque"})


def _referred(reference: Reference) -> dict[str, float]:
    """Standard parameters with the torques of the model: each base parameter in its own column."""
    known = ("rigid_body", "rotor_inertia", "viscous", "coulomb", "offset")
    effects = {p.name: p.effect for p in reference.compiled.spec.standard}
    return {
        base.column_of: float(f"{value:.9g}")
        for base, value in zip(reference.compiled.spec.base, reference.beta, strict=True)
        if effects[base.column_of] in known
    }


def _tilted(text: str, values: np.ndarray, reference: Reference) -> np.ndarray:
    """Gravity with the tilt, of the length it had."""
    robot: Robot = robot_from_text(text, "robot of the model")
    symbols = {name: value.number() for name, value in robot.symbols.items()}
    gravity = np.array([entry.number(symbols) for entry in robot.gravity])
    basis = tilt_basis(reference)
    assert basis is not None
    turned = gravity + values[0] * basis[0][0] + values[1] * basis[1][0]
    return turned * (np.linalg.norm(gravity) / np.linalg.norm(turned))


def _coupled(text: str, pick: Candidate, reference: Reference) -> str:
    """The file with the motor's coupling, if it has none for that joint."""
    if "c" not in pick.shapes:
        return text
    joints = reference.compiled.spec.joints
    here, before = joints[pick.index].name, joints[pick.index - 1].name
    sign = "+" if pick.shapes["c"] > 0.0 else "-"
    share = abs(pick.shapes["c"])
    times = "" if share == 1.0 else f"{share:g}*"
    try:
        return with_coupling(text, here, f"q{here} {sign} {times}q{before}")
    except RobotError as error:
        raise DataError(f"{pick.effect.id}: {error}") from None
