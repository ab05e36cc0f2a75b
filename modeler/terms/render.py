"""A closed form as text, LaTeX, Markdown and JSON."""

import json

from modeler.core.json_text import nulled
from modeler.core.latex_lines import Equation, display
from modeler.terms.closed_form import ClosedForm, Function
from modeler.terms.sheet_render import sheet_json, sheet_latex, sheet_lines, sheet_markdown
from modeler.terms.text import LATEX, TEXT, Style, form_text, monomial_text

EQUATION = "tau_i = sum_j J_ij qdd_j + sum_{j<=k} S_ijk qd_j qd_k"


def closed_form_text(closed: ClosedForm) -> str:
    """Every function as a sum, one monomial per line."""
    lines = [f"{closed.robot.name}: {equation(closed)}"]
    for function in closed.functions:
        lines += ["", f"{function.name} ="]
        for sign, coefficient, monomial in _signed(closed, function, TEXT):
            lines.append(f"  {sign} {_product(coefficient, monomial, TEXT)}")
    return "\n".join([*lines, "", *sheet_lines(closed.effects)]).rstrip() + "\n"


def closed_form_latex(closed: ClosedForm) -> str:
    """Every function in an `align*` of LaTeX, each monomial on a line of its own."""
    out = []
    for function in closed.functions:
        lines = [
            f"{sign} {_product(coefficient, monomial, LATEX)}"
            for sign, coefficient, monomial in _signed(closed, function, LATEX)
        ]
        out.append(display([Equation(latex_function(function.name), tuple(lines))]) + "\n")
    return "".join(out) + sheet_latex(closed.effects)


def _signed(closed: ClosedForm, function: Function, style: Style) -> list[tuple[str, str, str]]:
    """(sign, coefficient, monomial); sums stand in brackets behind a plus."""
    found = []
    for form, monomial in _terms(closed, function, style):
        if " + " in form or " - " in form:
            bracket = rf"\left({form}\right)" if style.latex else f"({form})"
            found.append(("+", bracket, monomial))
        else:
            found.append(("-" if form.startswith("-") else "+", form.lstrip("-"), monomial))
    return found


def _product(coefficient: str, monomial: str, style: Style) -> str:
    return coefficient if monomial == "1" else f"{coefficient}{style.times}{monomial}"


def closed_form_markdown(closed: ClosedForm) -> str:
    """One table per function: monomial and its coefficient."""
    lines = [f"# Closed form of {closed.robot.title}", "", f"`{equation(closed)}`", ""]
    for function in closed.functions:
        lines += [f"## {function.name}", "", "| monomial | coefficient |", "|---|---|"]
        lines += [f"| `{m}` | `{form}` |" for form, m in _terms(closed, function, TEXT)] + [""]
    return "\n".join([*lines, sheet_markdown(closed.effects)])


def closed_form_json(closed: ClosedForm) -> str:
    """{"robot", "equation", "gravity_factor", "functions": [{"name", "kind", "terms"}]}."""
    functions = [
        {
            "name": function.name,
            "kind": function.kind,
            "terms": [
                {"monomial": monomial, "coefficient": form}
                for form, monomial in _terms(closed, function, TEXT)
            ],
        }
        for function in closed.functions
    ]
    content = {
        "robot": closed.robot.name,
        "equation": equation(closed),
        "gravity_factor": closed.gravity_factor,
        "functions": functions,
        "effects": sheet_json(closed.effects),
    }
    return json.dumps(nulled(content), indent=1, allow_nan=False) + "\n"


def equation(closed: ClosedForm) -> str:
    """What the functions mean: the equation of motion."""
    factor = f"{closed.gravity_factor}*" if closed.gravity_factor else ""
    return f"{EQUATION} + {factor}g_i" + (" + e_i" if closed.effects.definitions else "")


def _terms(closed: ClosedForm, function: Function, style: Style) -> list[tuple[str, str]]:
    algebra = closed.algebra
    motion, static = algebra.names[: algebra.moving], algebra.names[algebra.moving :]
    return [
        (form_text(form, closed.parameters, static, style), monomial_text(at, motion, style))
        for at, form in function.terms.items()
    ]


def latex_function(name: str) -> str:
    """`S1_12` as `S_{1,12}`."""
    return f"{name[0]}_{{{name[1:].strip('_').replace('_', ',')}}}"
