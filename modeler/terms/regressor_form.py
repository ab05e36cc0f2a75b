"""The base columns in closed form: tau = phi beta, each intermediate quantity once.

Newton and Euler in screw form (Khalil and Dombre 2002, 9.5 and 9.6), as in the emitted code: w, wd
and vd are angular velocity, angular acceleration and acceleration of the origin less gravity of a
link in its own frame, U = [wd x] + [w x][w x], e and m the rotation of the link and the velocity of
its origin for unit speed of a joint. The wrench that one unit of a parameter needs, projected on
these, is its column.
"""

from modeler.base import BaseParameters
from modeler.symbolic import SymbolicModel
from modeler.symbolic.newton_euler import Motion, State, motions
from modeler.terms.sheet import SheetWriter

_AXES = "xyz"


def write_columns(model: SymbolicModel, base: BaseParameters, writer: SheetWriter) -> None:
    """Results phi<joint>_<parameter>, N m or N per unit; those of effects too; and what they need.

    With loops they are the opened tree's, and `write_loops` says how its variables are tied.
    """
    _propose_motion(model, writer)
    names = [joint.name for joint in model.robot.free]
    for parameter in base.parameters:
        writer.section(f"column of {parameter.name}")
        for i, name in enumerate(names):
            value = model.regressor.get((i, parameter.column))
            if value is not None:
                writer.result(f"phi{name}_{parameter.name}", value)


def _propose_motion(model: SymbolicModel, writer: SheetWriter) -> None:
    """Names of the recursion's quantities, link after link."""
    geometry = model.geometry
    speeds = [model.algebra.combined("qd", row) for row in geometry.rows if row.index is not None]
    growth = [model.algebra.combined("qdd", row) for row in geometry.rows if row.index is not None]
    gravity = [model.algebra.static(entry) for entry in geometry.gravity]
    moved = motions(geometry, model.frames, State(speeds, growth, gravity), model.algebra)
    for row, motion, chain in zip(geometry.rows, moved, model.carried, strict=True):
        name = row.joint.name
        writer.section(f"motion of link {name}, in frame {name}")
        _propose(motion, name, writer)
        for k, screw in sorted(chain.items()):
            free = model.robot.free[k].name
            for axis, e, m in zip(_AXES, screw.e, screw.m, strict=True):
                writer.propose(f"e{free}{axis}_{name}", e)
                writer.propose(f"m{free}{axis}_{name}", m)


def _propose(motion: Motion, name: str, writer: SheetWriter) -> None:
    for letter, vector in (("w", motion.w), ("wd", motion.wd), ("vd", motion.vd)):
        for axis, entry in zip(_AXES, vector, strict=True):
            writer.propose(f"{letter}{axis}_{name}", entry)
    for axis, line in zip(_AXES, motion.U, strict=True):
        for other, entry in zip(_AXES, line, strict=True):
            writer.propose(f"U{axis}{other}_{name}", entry)
