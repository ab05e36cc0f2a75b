"""The equation of motion, and the regressor, in closed form with the words that explain them."""

from dataclasses import dataclass, replace

from modeler.core.errors import RobotError
from modeler.core.formula import Formulas
from modeler.derivation.model import SymbolicModel
from modeler.derivation.newton_euler import Motion, MotionState, motions
from modeler.derivation.result import BaseParameter, BaseParameters
from modeler.formulas.closed_form import (
    fresh_model,
    letters_of,
    named_columns,
    signal_letters,
    write_short_form,
)
from modeler.formulas.function_sheet import (
    Sheet,
    SheetWriter,
    sheet_latex,
    sheet_lines,
    sheet_markdown,
)
from modeler.formulas.loop_form import LoopForm, write_loops

_AXES = "xyz"


@dataclass(frozen=True, eq=False)
class Equation:
    """Formulas, and what they are.

    Attributes:
        words: sentences: the equation in which they stand.
        sheet: the formulas, with their abbreviations.
        loops: what closes the tree whose formulas these are; None without loops.
    """

    words: tuple[str, ...]
    sheet: Sheet
    loops: LoopForm | None

    def formulas(self) -> Formulas:
        """As text, LaTeX and Markdown."""
        text = "\n".join(sheet_lines(self.sheet))
        title = "; ".join(self.words)
        return Formulas(title, text, sheet_latex(self.sheet), sheet_markdown(self.sheet))


def short_form(model: SymbolicModel, base: BaseParameters) -> Equation:
    """J(q), S(q), g(q) and the effects' torques in closed form, abbreviated: the whole torque."""
    return equation_of(model, base, motion=True)


def regressor_form(model: SymbolicModel, base: BaseParameters) -> Equation:
    """The columns of the base parameters in closed form."""
    return equation_of(model, base, columns=True)


def equation_of(
    model: SymbolicModel, base: BaseParameters, *, motion: bool = False, columns: bool = False
) -> Equation:
    """The equation of motion, the columns, or both on one sheet, where each name is one thing."""
    model = fresh_model(model)
    writer = SheetWriter(model.graph, letters_of(model, named_columns(base)))
    loops = write_loops(model, writer) if model.closure is not None else None
    words = []
    if motion:
        write_short_form(model, base, writer)
        words += _motion_words(base, "t_i" if loops else "tau_i")
    if columns:
        write_columns(model, base, writer)
        words.append(f"{'t' if loops else 'tau'} = phi beta, phi<joint>_<parameter>; what is not "
                     "listed is 0")  # fmt: skip
    words += [*_signals(model), *(loops.lines if loops else ())]
    return Equation(tuple(words), writer.finished(), loops)


def _motion_words(base: BaseParameters, left: str) -> list[str]:
    words = [
        f"{left} = sum_j J_ij qdd_j + sum_{{j<=k}} S_ijk qd_j qd_k + g_i + e_i; e: friction, "
        "offsets and all other effects but rotor inertias, which are in J; what is not listed is 0"
    ]
    mixed = [p.name for p in base.parameters if _kinds(base, p) >= {"inertial", "offset"}]
    if mixed:
        words.append(f"constant gravity and an offset in one, in e or in g: {', '.join(mixed)}")
    return words


def _kinds(base: BaseParameters, parameter: BaseParameter) -> set[str]:
    """Of the standard parameters in a base parameter."""
    kinds = {column.name: column.kind for column in base.columns}
    return {kinds[term.parameter] for term in parameter.terms}


def _signals(model: SymbolicModel) -> list[str]:
    """What the letters are that effects read besides the motion."""
    letters = signal_letters(model)
    told = [
        f"{letter}: {signal.kind}"
        + (f" of joint {model.robot.joints[signal.row].name}" if signal.row >= 0 else "")
        for letter, signal in zip(letters, model.signals, strict=True)
    ]
    return ["; ".join(told)] if told else []


def write_columns(model: SymbolicModel, base: BaseParameters, writer: SheetWriter) -> None:
    """Results phi<joint>_<parameter>, N m or N per unit; those of effects too; and what they need.

    Each intermediate quantity once. Newton and Euler in screw form (Khalil and Dombre 2002, 9.5 and
    9.6), as in the emitted code: w, wd and vd are angular velocity, angular acceleration and
    acceleration of the origin less gravity of a link in its own frame, U = [wd x] + [w x][w x], e
    and m the rotation of the link and the velocity of its origin for unit speed of a joint. The
    wrench that one unit of a parameter needs, projected on these, is its column.

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
    moved = motions(geometry, model.frames, MotionState(speeds, growth, gravity), model.algebra)
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


# Which base parameters are 0 at the nominal values: what printed models leave out.


_ROUNDING = 1e-12
"""Of the terms of a base parameter: what is left of those that cancel."""


def nonzero_base(model: SymbolicModel, base: BaseParameters) -> BaseParameters:
    """The base parameters that are not 0 at the nominal values of `[parameters]`.

    Parameters of effects stay: their values are rarely known beforehand. The formulas hold for any
    values of those that are left, the others being 0.

    Raises:
        RobotError: the robot file states no values of inertial parameters.
    """
    known, lengths = model.robot.parameters, model.geometry.values
    kept = []
    for parameter in base.parameters:
        sizes = []
        for term in parameter.terms:
            letters = {s: lengths[s.name] for s in term.coefficient.free_symbols}
            sizes.append(float(term.coefficient.subs(letters)) * known.get(term.parameter, 0.0))
        link = base.columns[parameter.column].kind == "inertial"
        if not link or abs(sum(sizes)) > _ROUNDING * sum(map(abs, sizes)):
            kept.append(parameter)
    if not any(base.columns[parameter.column].kind == "inertial" for parameter in kept):
        raise RobotError(
            f"robot {model.robot.name}: all inertial base parameters are 0 at its nominal values; "
            "state them in [parameters], or leave out --nonzero"
        )
    return replace(base, parameters=tuple(kept))
