"""The equation of motion, and the regressor, in closed form with the words that explain them."""

from dataclasses import dataclass

from modeler.base import BaseParameters
from modeler.core.formulas import Formulas
from modeler.symbolic import SymbolicModel
from modeler.terms.regressor_form import regressor_form
from modeler.terms.sheet import Sheet
from modeler.terms.sheet_render import sheet_latex, sheet_lines, sheet_markdown
from modeler.terms.short_form import short_form


@dataclass(frozen=True, eq=False)
class Equation:
    """Formulas, and what they are.

    Attributes:
        words: sentences: the equation in which they stand.
        sheet: the formulas, with their abbreviations.
    """

    words: tuple[str, ...]
    sheet: Sheet

    def formulas(self) -> Formulas:
        """As text, LaTeX and Markdown."""
        text = "\n".join(sheet_lines(self.sheet))
        title = "; ".join(self.words)
        return Formulas(title, text, sheet_latex(self.sheet), sheet_markdown(self.sheet))


def motion_equation(model: SymbolicModel, base: BaseParameters) -> Equation:
    """J(q), S(q) and g(q) in closed form, abbreviated."""
    found = short_form(model, base)
    left = "t_u" if found.loops else "tau_i"
    words = [
        f"{left} = sum_j J_ij qdd_j + sum_{{j<=k}} S_ijk qd_j qd_k + g_i, without friction; "
        "what is not listed is 0"
    ]
    return Equation((*words, *(found.loops.lines if found.loops else ())), found.sheet)


def regressor_equation(model: SymbolicModel, base: BaseParameters) -> Equation:
    """The columns of the base parameters in closed form."""
    found = regressor_form(model, base)
    left = "t" if found.loops else "tau"
    words = [f"{left} = phi beta, phi<joint>_<parameter>; what is not listed is 0"]
    return Equation((*words, *(found.loops.lines if found.loops else ())), found.sheet)
