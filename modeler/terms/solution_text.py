"""A closed solution as text, LaTeX and Python, in an order that a person can check."""

from collections.abc import Mapping
from typing import Any, Literal

from modeler.core.latex import latex_name, latex_text
from modeler.core.latex_lines import Equation, display
from modeler.terms.known_sets import EASE
from modeler.terms.physical_system import PhysicalSystem
from modeler.terms.ring import Poly
from modeler.terms.solving import ClosedSolution, Step
from modeler.terms.text import LATEX, TEXT, Style, physical_text, polynomial_text

SolutionForm = Literal["text", "latex", "python"]
"""How formulas are printed."""


def formula(step: Step, system: PhysicalSystem, style: Style = TEXT) -> str:
    """The right side of a step's formula; the polynomial that is zero where there is none."""
    if step.equation is not None:
        return _by_powers(step, system, style)
    top = physical_text(step.numerator, system.names, system.masses, style)
    if step.denominator == system.ring.one:
        return top
    bottom = physical_text(step.denominator, system.names, system.masses, style)
    if style.latex:
        return rf"\frac{{{top}}}{{{bottom}}}"
    return f"{_bracketed(top)}/{_bracketed(bottom, factors=True)}"


def _bracketed(text: str, factors: bool = False) -> str:
    """In brackets if it is a sum, or, below a line, a product."""
    inside = text.removeprefix("-")
    plain = " + " not in inside and " - " not in inside
    if plain and not (factors and any(sign in text for sign in "*/-")):
        return text
    return f"({text})"


def _by_powers(step: Step, system: PhysicalSystem, style: Style) -> str:
    """A polynomial in one letter, highest power first."""
    assert step.equation is not None
    at = system.place[step.letter]
    by_power: dict[int, dict[tuple[int, ...], Any]] = {}
    for exponents, value in step.equation.items():
        rest = (*exponents[:at], 0, *exponents[at + 1 :])
        by_power.setdefault(exponents[at], {})[rest] = value
    parts = []
    for power in sorted(by_power, reverse=True):
        factor: Poly = step.equation.ring.zero.new(by_power[power])
        text = polynomial_text(factor, system.names, style)
        text = text if power == 0 else rf"\left({text}\right)" if style.latex else f"({text})"
        parts.append(text if power == 0 else text + style.times + style.power(step.letter, power))
    return " + ".join(parts)


def solution_lines(solution: ClosedSolution, form: SolutionForm = "text") -> list[str]:
    """All formulas, one a line, each from data, known parameters and those before."""
    return {"text": _text, "latex": _latex, "python": _python}[form](solution)


def _text(solution: ClosedSolution) -> list[str]:
    system = solution.system
    lines = [f"{name} = {text}" for name, text in system.abbreviations.items()]
    for step in solution.steps:
        right = formula(step, system)
        if step.equation is None:
            lines.append(f"{step.letter} = {right}")
        else:
            lines.append(f"{step.letter}: root of {right} = 0")
    return lines


def _latex(solution: ClosedSolution) -> list[str]:
    system = solution.system
    rows = [
        Equation(latex_name(name), (_latex_quotient(name, text, system),))
        for name, text in system.abbreviations.items()
    ]
    for step in solution.steps:
        left = latex_name(step.letter) if step.equation is None else "0"
        rows.append(Equation(left, (formula(step, system, LATEX),)))
    lines = display(rows).splitlines() if rows else []
    return [r"\begingroup\allowdisplaybreaks", *lines, r"\endgroup"]


def _latex_quotient(name: str, text: str, system: PhysicalSystem) -> str:
    if name not in system.inverse:
        return rf"\text{{{latex_text(text)}}}"
    return rf"\frac{{1}}{{{polynomial_text(system.inverse[name], system.names, LATEX)}}}"


_ROOTS = """def real_roots(factors, positive=False):
    found = [x for x in roots(factors) if abs(x.imag) <= 1e-6*abs(x)]
    return [float(x.real) for x in found if x.real > 0 or not positive]"""


def _python(solution: ClosedSolution) -> list[str]:
    """A function of data and known parameters that returns a dict, with roots a list of them."""
    system = solution.system
    rooted = any(step.equation is not None for step in solution.steps)
    arguments = [*_used_data(solution), *solution.known, *_lengths(system)]
    where = "base parameters" if system.source == "base" else "coefficients PG, PJ"
    more = ": a list, every robot that fits" if rooted else ""
    lines = [f"def physical_parameters({', '.join(arguments)}):"]
    lines += [f'    """Physical parameters of {system.robot} from {where}, SI units{more}."""']
    lines += [f"    {name} = {text}" for name, text in system.abbreviations.items()]
    lines += ["    found = []"] if rooted else []
    indent = "    "
    for step in solution.steps:
        if step.equation is None:
            lines.append(f"{indent}{step.letter} = {formula(step, system)}")
        else:
            lines.append(f"{indent}for {step.letter} in {_python_roots(step, system)}:")
            indent += "    "
    told = "{" + ", ".join(f'"{x}": {x}' for x in solution.follows) + "}"
    lines += [f"{indent}found.append({told})", "    return found"] if rooted else [
        f"    return {told}"
    ]  # fmt: skip
    used = set(_letters_of("\n".join(lines), functions=True))
    some = [name for name in ("cos", "pi", "sin", "sqrt") if name in used]
    head = [f"from math import {', '.join(some)}"] if some else []
    head += ["from numpy import roots", "", "", _ROOTS] if rooted else []
    return [*head, "", "", *lines] if head else lines


def _python_roots(step: Step, system: PhysicalSystem) -> str:
    assert step.equation is not None
    at = system.place[step.letter]
    top = max(exponents[at] for exponents in step.equation)
    factors = []
    for power in range(top, -1, -1):
        part = {(*e[:at], 0, *e[at + 1 :]): v for e, v in step.equation.items() if e[at] == power}
        factors.append(polynomial_text(step.equation.ring.zero.new(part), system.names))
    positive = ", positive=True" if step.letter in system.masses else ""
    return f"real_roots([{', '.join(factors)}]{positive})"


def _used_data(solution: ClosedSolution) -> list[str]:
    """Data that some formula reads."""
    system = solution.system
    polys = [p for s in solution.steps for p in (s.numerator, s.denominator, s.equation) if p]
    used = {i for poly in polys for at in poly for i, e in enumerate(at) if e}
    return [name for name in system.data if system.place[name] in used]


def _lengths(system: PhysicalSystem) -> list[str]:
    """Letters that the constants are made of."""
    found: dict[str, None] = {}
    for name in [*system.constants, *system.abbreviations.values()]:
        for letter in _letters_of(name):
            if letter not in system.abbreviations:
                found.setdefault(letter)
    return list(found)


def _letters_of(text: str, functions: bool = False) -> list[str]:
    """Names in a text, those of functions and of pi only if they are wanted."""
    word = "".join(c if c.isalnum() or c == "_" else " " for c in text).split()
    known = () if functions else ("cos", "sin", "sqrt", "pi")
    return [w for w in word if not w[0].isdigit() and w not in known]


def definition_lines(system: PhysicalSystem) -> list[str]:
    """What the data are made of."""
    return [
        f"{name} = {physical_text(poly, system.names, system.masses)}"
        for name, poly in system.definitions.items()
    ]


def missing_lines(solution: ClosedSolution) -> list[str]:
    """What does not follow, and what to add; empty if all follows."""
    lines = []
    if solution.undetermined:
        easy = sorted(solution.undetermined, key=lambda x: EASE[solution.system.kinds[x]])
        lines = [
            f"undetermined: {', '.join(solution.undetermined)}",
            f"to determine them, {solution.missing} more must be known: one of "
            f"{', '.join(easy)} (easiest first)"
            + ("" if solution.missing == 1 else ", then one of those that are left"),
        ]
    if solution.without_formula:
        lines.append(
            f"determined, but in equations of high degree, without a formula: "
            f"{', '.join(solution.without_formula)}; add one of them to the known parameters"
        )
    return lines


def solution_json(solution: ClosedSolution, verified: Mapping[str, int] | None = None) -> Any:
    """Plain data: formulas as text, what is known, what does not follow."""
    system = solution.system
    return {
        "robot": system.robot,
        "from": system.source,
        "coefficients": list(system.map_lines),
        "known": list(solution.known),
        "lengths": dict(system.constants),
        "abbreviations": dict(system.abbreviations),
        "formulas": [
            {
                "parameter": step.letter,
                "kind": system.kinds[step.letter],
                "quotient" if step.equation is None else "zero": formula(step, system),
            }
            for step in solution.steps
        ],
        "undetermined": list(solution.undetermined),
        "without_formula": list(solution.without_formula),
        "missing": solution.missing,
        "surplus": solution.surplus,
        "without_effect": list(system.vanishing),
        "verified": dict(verified) if verified else None,
    }
