"""What `modeler derive` prints on request: closed forms, base columns, coefficients."""

import argparse
import textwrap
from collections.abc import Callable
from pathlib import Path

from modeler.cli.console import Json
from modeler.cli.parsers.derive import Form
from modeler.cli.requested import coefficients_wanted
from modeler.cli.words import Words
from modeler.core.errors import ModelerError
from modeler.core.files import write_atomically
from modeler.derivation import Derivation
from modeler.terms import (
    ClosedForm,
    CoefficientTable,
    Sheet,
    backward_lines,
    closed_form,
    closed_form_latex,
    closed_form_markdown,
    closed_form_text,
    coefficient_table,
    coefficients_latex,
    coefficients_markdown,
    coefficients_text,
    determinant_text,
    independent_coefficients,
    nonzero_base,
    sheet_json,
    sheet_latex,
    sheet_lines,
    sheet_markdown,
    terms_report,
)
from modeler.terms.equations import Equation, equation_of
from modeler.terms.render import equation

MANY = 200
"""Coefficients up to which all are listed; of more, those from which the others follow."""

_CLOSED_FORMS: dict[Form, Callable[[ClosedForm], str]] = {
    "text": closed_form_text,
    "latex": closed_form_latex,
    "markdown": closed_form_markdown,
}
_SHEETS: dict[Form, Callable[[Sheet, Words], str]] = {
    "text": lambda sheet, _: "\n".join(sheet_lines(sheet)),
    "latex": lambda sheet, words: sheet_latex(sheet, words.heading),
    "markdown": lambda sheet, _: sheet_markdown(sheet),
}
_TABLES: dict[Form, Callable[[CoefficientTable], str]] = {
    "text": coefficients_text,
    "latex": coefficients_latex,
    "markdown": coefficients_markdown,
}
_WIDTH = 96
_COMMENT: dict[Form, str] = {"text": "# ", "latex": "", "markdown": "* "}


def say_closed_forms(args: argparse.Namespace, derivation: Derivation, words: Words) -> Json:
    """Prints what was asked for; for few joints the coefficients unasked.

    Returns:
        What is added to the JSON: "closed_form" and "regressor" as asked for.
    """
    model, base = derivation.model, derivation.base
    if args.nonzero:
        base = nonzero_base(model, base)
    added: Json = {}
    if args.closed_form and args.expanded:
        words.say()
        closed = closed_form(model, base)
        if args.format == "latex":
            words.say(equation(closed))
        words.formulas(_CLOSED_FORMS[args.format](closed))
    motion = args.closed_form and not args.expanded
    asked = {"closed_form": motion, "regressor": args.regressor}
    if any(asked.values()):
        found = equation_of(model, base, motion=motion, columns=args.regressor)
        told = _say_equation(words, found)
        added |= {key: told for key, wanted in asked.items() if wanted}
    if coefficients_wanted(args, derivation):
        _say_coefficients(args, derivation, words)
    if args.report is not None:
        write_atomically(Path(args.report), terms_report(model, derivation.base))
        words.say(f"written: {args.report}")
    return added


def _say_equation(words: Words, equation: Equation) -> Json:
    words.say()
    mark, lines, sheet = _COMMENT[words.form], equation.words, equation.sheet
    for line in lines:
        indent = mark + "  " if mark != "* " else "  "
        words.say(textwrap.fill(mark + line, _WIDTH, subsequent_indent=indent))
    words.say()
    words.formulas(_SHEETS[words.form](sheet, words))
    return {"equation": list(lines), **sheet_json(sheet)}


def _say_coefficients(args: argparse.Namespace, derivation: Derivation, words: Words) -> None:
    # What was not asked for must not take away what was.
    unasked = args.terms is None and args.report is None
    try:
        shown, lines = _coefficients(derivation, args.expanded)
    except ModelerError as error:
        if not unasked:
            raise
        words.say()
        words.say(f"no coefficients: {error}")
        return
    words.say()
    words.formulas(_TABLES[args.format](shown))
    words.say()
    for line in lines:
        words.say(line)


def _coefficients(derivation: Derivation, everything: bool) -> tuple[CoefficientTable, list[str]]:
    """The coefficients to list, and what there is to say of all of them."""
    table = coefficient_table(derivation.model, derivation.base)
    shown, note = table, []
    if len(table.coefficients) > MANY and not everything:
        shown = independent_coefficients(table)
        note = [
            f"listed: {len(shown.coefficients)} of {len(table.coefficients)} coefficients, from "
            "which the others follow; --expanded lists all"
        ]
    return shown, [*note, *_facts(table)]


def _facts(table: CoefficientTable) -> list[str]:
    """How many coefficients, what they tell, and what follows from what."""
    first = [coefficient.function[0] for coefficient in table.coefficients]
    counts = {"PG": first.count("g"), "PJ": first.count("J"), "PS": first.count("S")}
    found = table.identifiability
    lines = [
        f"{len(first)} coefficients ("
        + ", ".join(f"{n} {letter}" for letter, n in counts.items())
        + f"), rank {table.relations.rank}: {' '.join(table.relations.independent)}",
        f"{len(found.appearing)} of {len(found.letters)} physical parameters appear; without "
        f"effect: {' '.join(found.vanishing) or 'none'}",
    ]
    for group in found.sums:
        lines.append(f"only together: {' '.join(group)}")
    size, determinant = len(table.map.rows), determinant_text(table)
    if determinant is not None:
        lines += [f"map to the base parameters, {size} x {size}, determinant {determinant}:"]
        lines += [f"  {line}" for line in backward_lines(table)]
    return lines
