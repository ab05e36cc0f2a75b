"""The equation of motion, and the regressor, in closed form with the words that explain them."""

from dataclasses import dataclass

from modeler.base import BaseParameter, BaseParameters
from modeler.core.formulas import Formulas
from modeler.symbolic import SymbolicModel
from modeler.terms.fresh import fresh_model, letters_of, named_columns, signal_letters
from modeler.terms.loop_form import LoopForm, write_loops
from modeler.terms.regressor_form import write_columns
from modeler.terms.sheet import Sheet, SheetWriter
from modeler.terms.sheet_render import sheet_latex, sheet_lines, sheet_markdown
from modeler.terms.short_form import write_short_form


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
