"""What `modeler derive` prints on request: closed forms, base columns, coefficients."""

import argparse
import re
import textwrap
from collections.abc import Callable
from pathlib import Path

from modeler.cli.console import Json, say
from modeler.cli.options import FEW_JOINTS, Form
from modeler.codegen.derivation import Derivation
from modeler.core.errors import ModelerError
from modeler.core.files import write_atomically
from modeler.core.formula import latex_text
from modeler.formulas.closed_form import ClosedForm, closed_form
from modeler.formulas.coefficients import (
    CoefficientTable,
    coefficient_table,
    independent_coefficients,
)
from modeler.formulas.function_sheet import (
    Sheet,
    sheet_json,
    sheet_latex,
    sheet_lines,
    sheet_markdown,
)
from modeler.formulas.print_report import terms_report
from modeler.formulas.regressor_form import Equation, equation_of, nonzero_base
from modeler.formulas.render import (
    backward_lines,
    closed_form_latex,
    closed_form_markdown,
    closed_form_text,
    coefficients_latex,
    coefficients_markdown,
    coefficients_text,
    determinant_text,
    equation,
)

# Words around printed formulas: as they are, as comments of LaTeX, or as a whole document.


_BEGIN = r"""\documentclass{article}
\usepackage{amsmath}
\setlength{\parindent}{0pt}
\begin{document}
\raggedright"""
_END = r"\end{document}"


class Words:
    """Prints what is said and the formulas between, so that LaTeX takes all of it.

    A fragment has its words as comments, a document as text. In both, displays may go on over the
    end of a page.
    """

    def __init__(self, form: Form, document: bool = False) -> None:
        """Begins to print.

        Args:
            form: of the formulas.
            document: with LaTeX: a whole document instead of a fragment.
        """
        self.form, self.document = form, document
        self._paragraph = False
        if document:
            say(_BEGIN)
        if form == "latex":
            say(r"\begingroup\allowdisplaybreaks")

    def title(self, text: str) -> None:
        """What all of it is about."""
        say(rf"\section*{{{latex_text(text)}}}") if self.document else self.say(text)

    def heading(self, text: str) -> str:
        """The title of a group of formulas in LaTeX."""
        return rf"\paragraph{{{_breakable(text)}}}" if self.document else f"% {text}"

    def say(self, text: str = "") -> None:
        """Lines that are no formulas; in a document one paragraph."""
        if self.document:
            self._say_paragraph(text)
        elif self.form == "latex":
            for line in text.splitlines() or [""]:
                say(f"% {line}".rstrip())
        else:
            say(text)

    def _say_paragraph(self, text: str) -> None:
        if text:
            say(("\n" if self._paragraph else "") + _breakable(" ".join(text.split())))
        self._paragraph = self._paragraph or bool(text)

    def formulas(self, text: str) -> None:
        """What is already written in the form."""
        self._paragraph = False
        say(text.rstrip("\n") if self.form == "latex" else text)

    def end(self) -> None:
        """Nothing more follows."""
        if self.form == "latex":
            say(r"\endgroup")
        if self.document:
            say(_END)


def _breakable(text: str) -> str:
    """Formulas in words have no spaces; a line may end behind their signs."""
    return re.sub(r"(\*+|\\_|/)", r"\1\\allowbreak{}", latex_text(text))


# What `modeler derive` was asked for besides relations and proof, and what it refuses.


def check_request(args: argparse.Namespace) -> None:
    """Refuses options that would do nothing.

    Raises:
        ModelerError: they stand without what they change.
    """
    if args.nonzero and not (args.closed_form or args.regressor):
        raise ModelerError("--nonzero changes nothing by itself; add --closed-form or --regressor")
    if args.expanded and not (args.closed_form or args.terms):
        raise ModelerError("--expanded changes nothing by itself; add --closed-form or --terms")
    if args.document and args.format != "latex":
        raise ModelerError("--document is a whole page of LaTeX; add --format latex")


def check_loops(args: argparse.Namespace, derivation: Derivation) -> None:
    """Refuses what has no meaning for loops.

    Raises:
        ModelerError: coefficients or expanded forms are asked for.
    """
    if derivation.model.closure is None:
        return
    if args.terms or args.report is not None or args.expanded:
        raise ModelerError(
            f"{derivation.robot.name}: coefficients and expanded forms are written for robots "
            "whose loops, if any, follow linear relations; leave out --terms, --report and "
            "--expanded, or ask for --closed-form, which has J_t and J_p"
        )


def coefficients_wanted(args: argparse.Namespace, derivation: Derivation) -> bool:
    """Whether the coefficients are listed: on request, and for few joints unasked."""
    if args.terms is not None:
        return bool(args.terms)
    few = len(derivation.model.robot.coordinates) <= FEW_JOINTS
    asked = args.closed_form or args.regressor
    return derivation.model.closure is None and few and args.format == "text" and not asked


def forms_wanted(args: argparse.Namespace, derivation: Derivation) -> bool:
    """Whether anything is listed besides relations and proof."""
    asked = args.closed_form or args.regressor or args.report is not None
    return asked or coefficients_wanted(args, derivation)


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
