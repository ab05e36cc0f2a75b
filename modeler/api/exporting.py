"""A robot or a model as a file for another program: URDF, MJCF, SDF, CasADi, FMU."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from modeler.api.code_exports import OF_EQUATIONS, code_exported
from modeler.api.workflow import observe, recompile
from modeler.core.errors import DataError
from modeler.core.files import write_unless_other
from modeler.derivation import with_home
from modeler.estimation import IdentifiedModel
from modeler.exports import Exported, Torques, exported, format_of
from modeler.robot import Robot


def export(
    thing: Robot | IdentifiedModel,
    out: str | Path | None = None,
    to: str | None = None,
    like: str | Path | None = None,
    force: bool = False,
) -> Exported:
    """A robot or a model for another program; its `table()` lists the numbers.

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
    kind = format_of(to, str(like or ""), str(out or ""))
    if kind in OF_EQUATIONS:
        found = _of_equations(thing, kind, like)
    else:
        if isinstance(thing, Robot) and thing.loops:
            thing = with_home(thing).in_text(thing)
        torques = _torques(thing) if isinstance(thing, IdentifiedModel) else None
        found = exported(thing, kind, None if like is None else Path(like), torques)
    if out is not None:
        for name, data in found.files.items():
            write_unless_other(Path(out) / name, data, force)
        if not found.files:
            write_unless_other(Path(out), found.data, force)
    return found


def _of_equations(thing: Robot | IdentifiedModel, kind: str, like: str | Path | None) -> Exported:
    if like is not None:
        raise DataError(f"--like {like}: is for robot files, and --to says {kind}; leave out one")
    return code_exported(thing, kind)


def _torques(model: IdentifiedModel) -> Torques | None:
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

    def torques(beta: np.ndarray) -> tuple[np.ndarray, tuple[str, ...]]:
        if not rows:  # read when they are first asked for
            seen = observe(recompile(model), logs, model.processing)
            rows.append(lambda each: np.where(seen.used, seen.predicted(each), 0.0))
        return rows[0](beta), names

    return torques
