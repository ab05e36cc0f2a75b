"""The base columns in closed form: tau = phi beta, each intermediate quantity once.

Newton and Euler in screw form (Khalil and Dombre 2002, 9.5 and 9.6), as in the emitted code: w, wd
and vd are angular velocity, angular acceleration and acceleration of the origin less gravity of a
link in its own frame, U = [wd x] + [w x][w x], e and m the rotation of the link and the velocity of
its origin for unit speed of a joint. The wrench that one unit of a parameter needs, projected on
these, is its column.
"""

from dataclasses import dataclass

from modeler.base import BaseParameters
from modeler.symbolic import SymbolicModel
from modeler.symbolic.newton_euler import Motion, State, motions
from modeler.terms.fresh import fresh_model, letters_of, named_columns
from modeler.terms.loop_form import LoopForm, write_loops
from modeler.terms.sheet import Sheet, SheetWriter

_AXES = "xyz"


@dataclass(frozen=True)
class RegressorForm:
    """The base regressor as a sheet: results phi<joint>_<parameter>, zeros left out.

    Attributes:
        model: the model on the graph of the sheet.
        base: its base parameters.
        sheet: the formulas.
        loops: what closes the tree whose columns these are; None without loops.
    """

    model: SymbolicModel
    base: BaseParameters
    sheet: Sheet
    loops: LoopForm | None


def regressor_form(model: SymbolicModel, base: BaseParameters) -> RegressorForm:
    """Every base column in closed form, those of effects too.

    Units are those of the torque (N m, N) per unit of the parameter; rows are the free joints.
    With loops they are the opened tree's, and `write_loops` says how its variables are tied.

    Args:
        model: of any robot.
        base: its base parameters.
    """
    model = fresh_model(model)
    writer = SheetWriter(model.graph, letters_of(model, named_columns(base)))
    loops = write_loops(model, writer) if model.closure is not None else None
    write_columns(model, base, writer)
    return RegressorForm(model, base, writer.finished(), loops)


def write_columns(model: SymbolicModel, base: BaseParameters, writer: SheetWriter) -> None:
    """The results of the regressor form, and what they are made of, on a sheet."""
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
