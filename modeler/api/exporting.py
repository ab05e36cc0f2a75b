"""A robot or a model as a file for another program: URDF, MJCF, SDF, CasADi, FMU."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np

from modeler.api.code_exports import OF_EQUATIONS, export_code
from modeler.api.workflow import compile, compile_model, observe
from modeler.codegen import derive, generate
from modeler.core.errors import DataError
from modeler.core.files import write_without_overwriting
from modeler.derivation import complete_home
from modeler.estimation import IdentifiedModel
from modeler.exports import Equations, Exported, Torques, choose_format, export_robot
from modeler.robot import Robot

_STATES, _SEED = 200, 1
_REACH = 0.05  # rad, m: of random motion around home


def export(
    thing: Robot | IdentifiedModel,
    out: str | Path | None = None,
    to: str | None = None,
    like: str | Path | None = None,
    force: bool = False,
) -> Exported:
    """Exports a robot or a model for another program; `table()` of the result lists the numbers.

    >>> export(model, to="urdf").table("not held").column("effect")
    []

    Args:
        thing: a robot with values, or a model.
        out: the file that is written, of "ros2" the folder; None: none.
        to: "urdf", "mjcf", "sdf", "casadi", "fmu", "simulink" or "ros2"; None: by the original, or
            the ending of `out`.
        like: a file of the same robot, of which only the numbers are replaced.
        force: write also over a file with another content.

    Raises:
        DataError: no values, no format, or what the format cannot state.
        RobotError: a mistake in the original.
        ModelerError: there is such a file, or it cannot be written.
    """
    kind = choose_format(to, str(like or ""), str(out or ""))
    if kind in OF_EQUATIONS:
        result = _export_equations(thing, kind, like)
    else:
        if isinstance(thing, Robot) and thing.loops:
            thing = complete_home(thing).write_to_text(thing)
        torques = _build_torque_function(thing) if isinstance(thing, IdentifiedModel) else None
        equations = partial(_build_equations, thing) if isinstance(thing, Robot) else None
        result = export_robot(thing, kind, None if like is None else Path(like), torques, equations)
    if out is not None:
        for name, data in result.files.items():
            write_without_overwriting(Path(out) / name, data, force)
        if not result.files:
            write_without_overwriting(Path(out), result.data, force)
    return result


def _export_equations(
    thing: Robot | IdentifiedModel, kind: str, like: str | Path | None
) -> Exported:
    if like is not None:
        raise DataError(f"--like {like}: is for robot files, and --to says {kind}; leave out one")
    return export_code(thing, kind)


def _build_equations(robot: Robot) -> Equations:
    """Its parameters, and torques at random motion around home, which are asked for rarely."""
    emitted = generate(derive(robot))

    def compute_torques(beta: np.ndarray) -> np.ndarray:
        compiled, rng = compile_model(emitted), np.random.default_rng(_SEED)
        home = [robot.home.get(joint.name, 0.0) for joint in robot.coordinates]
        q, qd, qdd = rng.uniform(-1.0, 1.0, (3, _STATES, len(home)))
        q = home + _REACH * q
        if emitted.spec.closure is not None:
            q = q[compiled.closing_status(q) == 0]
        return np.asarray(compiled.inverse_dynamics(q, qd[: len(q)], qdd[: len(q)], beta))

    return Equations(emitted.spec, compute_torques)


def _build_torque_function(model: IdentifiedModel) -> Torques | None:
    """Torques of base parameters on the rows of the fit; None where its logs are not there."""
    find = getattr(model, "its_logs", None)  # of `api.model.Model`
    try:
        logs = find(None, "export") if find else []
    except DataError:
        return None
    if not logs:
        return None
    rows: list[Callable[[np.ndarray], np.ndarray]] = []
    names = tuple(joint.name for joint in model.spec.joints)

    def compute_torques(beta: np.ndarray) -> tuple[np.ndarray, tuple[str, ...]]:
        if not rows:  # read when they are first asked for
            observation = observe(compile(model), logs, model.processing)
            rows.append(lambda each: np.where(observation.used, observation.predict(each), 0.0))
        return rows[0](beta), names

    return compute_torques
