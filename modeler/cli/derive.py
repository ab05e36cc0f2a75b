"""`modeler derive ROBOT` and `modeler generate ROBOT|MODEL --out DIR`."""

import argparse
import dataclasses
import re
import shlex
import textwrap
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from modeler import formulas
from modeler.cli.console import (
    Json,
    print_error,
    print_lines,
    print_result,
    show_activity,
    show_next,
)
from modeler.cli.documents import DerivationReport, GeneratedFolder
from modeler.cli.lists import read_robot_or_model, read_robot_with_effects, resolve_robot
from modeler.cli.parser import FEW_JOINTS, Form
from modeler.cli.thresholds import THRESHOLDS
from modeler.codegen import Derivation, derive, generate
from modeler.core.errors import ModelerError, RobotError
from modeler.core.files import write_atomically
from modeler.core.formula import escape_latex
from modeler.core.json import select_attributes
from modeler.core.options import CONTROLLED, GenerateOptions
from modeler.derivation import (
    LinkColumn,
    SymbolicModel,
    draw_random_states,
    evaluate_regressor,
    relations,
)
from modeler.robot import Robot

if TYPE_CHECKING:
    from modeler.core.manifest import FunctionSpec
    from modeler.formulas import CoefficientTable

# Words around printed formulas: as they are, as comments of LaTeX, or as a whole document.


_BEGIN = r"""\documentclass{article}
\usepackage{amsmath}
\setlength{\parindent}{0pt}
\begin{document}
\raggedright"""
_END = r"\end{document}"


class FormulaPrinter:
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
            print_result(_BEGIN)
        if form == "latex":
            print_result(r"\begingroup\allowdisplaybreaks")

    def print_title(self, text: str) -> None:
        """Prints the title of the whole output."""
        print_result(rf"\section*{{{escape_latex(text)}}}") if self.document else self.print_text(
            text
        )

    def format_heading(self, text: str) -> str:
        """Returns the heading of a group of formulas in LaTeX."""
        return rf"\paragraph{{{_allow_breaks(text)}}}" if self.document else f"% {text}"

    def print_text(self, text: str = "") -> None:
        """Prints lines that are no formulas; in a document one paragraph."""
        if self.document:
            if text:
                print_result(
                    ("\n" if self._paragraph else "") + _allow_breaks(" ".join(text.split()))
                )
            self._paragraph = self._paragraph or bool(text)
        elif self.form == "latex":
            for line in text.splitlines() or [""]:
                print_result(f"% {line}".rstrip())
        else:
            print_result(text)

    def print_formulas(self, text: str) -> None:
        """Prints formulas that are already in the output format."""
        self._paragraph = False
        print_result(text.rstrip("\n") if self.form == "latex" else text)

    def finish(self) -> None:
        """Prints the end of the output."""
        if self.form == "latex":
            print_result(r"\endgroup")
        if self.document:
            print_result(_END)


def _allow_breaks(text: str) -> str:
    """Formulas in words have no spaces; a line may end behind their signs."""
    return re.sub(r"(\*+|\\_|/)", r"\1\\allowbreak{}", escape_latex(text))


# What `modeler derive` was requested besides relations and proof, and what it refuses.


def check_loops(args: argparse.Namespace, derivation: Derivation) -> None:
    """Refuses what has no meaning for loops.

    Raises:
        ModelerError: coefficients or expanded forms are requested.
    """
    looped = derivation.model.closure is not None
    if looped and (args.terms or args.coefficients_out is not None or args.expanded):
        raise ModelerError(
            f"{derivation.robot.name}: coefficients and expanded forms are written for robots "
            "whose loops, if any, follow linear relations; leave out --terms, "
            "--coefficients-out and --expanded, or ask for --closed-form, which has J_t and J_p"
        )
    if looped and args.kane:
        raise ModelerError(
            f"{derivation.robot.name}: --kane is written for robots without loops; leave it out, "
            "or add --cut-loops"
        )


MANY = 200
"""Coefficients up to which all are listed; of more, those from which the others follow."""
PAGE = 40
"""Coefficients that are listed unasked."""

_WIDTH = 96
_COMMENT: dict[Form, str] = {"text": "# ", "latex": "", "markdown": "* "}
_FORMS = ("closed_form", "regressor", "blocks", "energy", "kane")


def run_derive(args: argparse.Namespace) -> DerivationReport:
    """Prints relations, proof, and for small robots the coefficients."""
    if args.document and args.format != "latex":
        raise ModelerError("--document is a whole page of LaTeX; add --format latex")
    robot = read_robot_with_effects(args) if args.cut_loops else None
    if robot is not None:
        # the tree of loops that are not closed: every joint has a torque
        if not robot.loops:
            raise RobotError(
                f"--cut-loops: {robot.name} has no loops to cut; leave --cut-loops out"
            )
        title = f"{robot.title}, its loops cut open"
        robot = dataclasses.replace(robot.open_loops(), title=title)
    else:
        robot = resolve_robot(args)
    with show_activity(f"deriving {robot.name}"):
        derivation = derive(robot)
        check_loops(args, derivation)
        opinion = compare_with_lagrange(derivation)
    base = derivation.base
    result: Json = relations.serialise_base_parameters(robot.name, base) | {
        "newton_euler_against_lagrange": opinion
    }
    counts = ", ".join(f"{n} {kind}" for kind, n in base.count_by_kind().items() if n)
    tied = _describe_ties(derivation.model)
    agreement = f"Newton-Euler against Lagrange: {opinion:.1e} of the largest torque"
    printer = FormulaPrinter(args.format, args.document)
    printer.print_title(robot.heading)
    printer.print_text(
        f"{len(base.columns)} standard parameters, {base.rank} base parameters ({counts})"
    )
    for line in tied:
        printer.print_text(line)
    printer.print_text()
    printer.print_formulas(relations.format_base_parameters(base, args.format))
    printer.print_text()
    printer.print_text(relations.format_proof(base.proof))
    printer.print_text(agreement)
    result |= print_closed_forms(args, derivation, printer)
    if args.report is not None:
        from modeler.views import build_derivation_page, write_page  # pages take long to load

        page = build_derivation_page(derivation, tied, agreement, args.robot)
        printer.print_text(f"written: {write_page(Path(args.report), page)}")
    printer.finish()
    return result


def _describe_ties(model: SymbolicModel) -> list[str]:
    """How the joints of a robot with relations or loops move each other."""
    robot = model.robot
    lines = []
    if robot.convention == "classical":
        lines.append("parameters of link j: in the frame behind Rz(theta) Tz(d) of its row")
    if not robot.relations and not robot.loops:
        return lines
    names = ", ".join(f"q{joint.name}" for joint in robot.coordinates)
    lines.append(f"coordinates: {names}")
    if robot.relations:
        tied = "; ".join(f"q{name} = {tie.text}" for name, tie in robot.relations.items())
        lines += textwrap.wrap(
            f"relations: {tied}", _WIDTH, subsequent_indent=" " * 11, break_long_words=False
        )
    closure = model.closure
    if closure is not None:
        lines.append(
            f"loops: {len(robot.loops)}, closed by {len(closure.equations)} equations for "
            f"{len(closure.solved)} joints"
            + (
                f" ({closure.redundant_count} more follow from these)"
                if closure.redundant_count
                else ""
            )
        )
    elif robot.loops:
        lines.append(f"loops: {len(robot.loops)}, which these relations close")
    return lines


def compare_with_lagrange(derivation: Derivation, samples: int = 50) -> float:
    """Returns the largest relative difference of Newton-Euler and Lagrange torques."""
    model = derivation.model.rigid
    rng = np.random.default_rng(derivation.base.proof.seed)
    states = draw_random_states(model, samples, rng)
    link = np.array([isinstance(column, LinkColumn) for column in model.columns])
    chi = np.where(link, rng.normal(size=len(link)), 0.0)
    tau = evaluate_regressor(model, states) @ chi
    from modeler.derivation import compute_lagrange_torque  # casadi takes long to load

    other = compute_lagrange_torque(model, *states, chi)
    largest = float(np.max(np.abs(other)))
    return float(np.max(np.abs(tau - other))) / largest if largest else 0.0


def print_closed_forms(
    args: argparse.Namespace, derivation: Derivation, printer: FormulaPrinter
) -> Json:
    """Prints what was requested; for few joints the coefficients unasked.

    Returns:
        What is added to the JSON: "closed_form" and "regressor" as requested.
    """
    model, base = derivation.model, derivation.base
    if args.nonzero:
        base = formulas.drop_zero_parameters(model, base)
    added: Json = _print_link_forms(args, model, printer)
    if args.closed_form and args.expanded:
        printer.print_text()
        closed = formulas.derive_closed_form(model, base)
        if args.format == "latex":
            printer.print_text(formulas.coefficients.format_equation(closed))
        printer.print_formulas(formulas.coefficients.format_closed_form(closed, args.format))
    motion = args.closed_form and not args.expanded
    is_requested = {"closed_form": motion, "regressor": args.regressor}
    if any(is_requested.values()):
        equation = formulas.derive_equation(model, base, motion=motion, columns=args.regressor)
        equation_json = _print_equation(equation, args.format, printer)
        added |= {key: equation_json for key, wanted in is_requested.items() if wanted}
    if args.blocks:
        added["blocks"] = _print_equation(
            formulas.derive_block_form(model, base), args.format, printer
        )
    few = len(model.robot.coordinates) <= FEW_JOINTS and model.closure is None
    asked_else = any(vars(args)[key] for key in _FORMS)
    unasked = few and args.format == "text" and not asked_else
    wanted = unasked if args.terms is None else args.terms
    if wanted:
        _print_coefficients(args, derivation, printer)
    if args.coefficients_out is not None:
        write_atomically(
            Path(args.coefficients_out), formulas.write_terms_report(model, derivation.base)
        )
        printer.print_text(f"written: {args.coefficients_out}")
    return added


def _print_link_forms(
    args: argparse.Namespace, model: SymbolicModel, printer: FormulaPrinter
) -> Json:
    """Energy functions and Kane's form, each with its difference from the derivation."""
    added: Json = {}
    for key, form, what in (
        ("energy", "energy_functions", "d/dt h against the power of the torques"),
        ("kane", "kane_form", "torques of Kane's form against Newton-Euler"),
    ):
        if vars(args)[key]:
            states = draw_random_states(model, 50, np.random.default_rng(1985))
            equation, off = getattr(formulas, form)(model, states)
            added[key] = _print_equation(equation, args.format, printer) | {"difference": off}
            printer.print_text(f"\n{what}: {off:.1e} of the largest")
    return added


def _print_equation(equation: "formulas.Equation", form: Form, printer: FormulaPrinter) -> Json:
    mark = _COMMENT[form]
    printer.print_text()
    for line in equation.words:
        indent = mark + "  " if mark != "* " else "  "
        printer.print_text(textwrap.fill(mark + line, _WIDTH, subsequent_indent=indent))
    printer.print_text()
    printer.print_formulas(
        formulas.function_sheet.format_sheet(equation.sheet, form, printer.format_heading)
    )
    return {
        "equation": list(equation.words),
        **formulas.function_sheet.serialise_sheet(equation.sheet),
    }


def _print_coefficients(
    args: argparse.Namespace, derivation: Derivation, printer: FormulaPrinter
) -> None:
    # What was not requested must not take away what was.
    unasked = args.terms is None and args.coefficients_out is None
    try:
        table = formulas.coefficients.build_coefficient_table(derivation.model, derivation.base)
        if unasked and len(table.coefficients) > THRESHOLDS.max_unrequested_coefficients:
            printer.print_text()
            printer.print_text(
                f"{len(table.coefficients)} PG/PJ/PS coefficients: --terms lists them"
            )
            return
        shown, lines = table, _describe_coefficients(table)
        if not args.expanded and len(table.coefficients) > THRESHOLDS.max_listed_coefficients:
            shown = formulas.coefficients.select_independent_coefficients(table)
            lines.insert(
                0,
                f"listed: {len(shown.coefficients)} of {len(table.coefficients)} coefficients, "
                "from which the others follow; --expanded lists all",
            )
    except ModelerError as error:
        if not unasked:
            raise
        printer.print_text()
        printer.print_text(f"no coefficients: {error}")
        return
    printer.print_text()
    printer.print_formulas(formulas.coefficients.format_coefficients(shown, args.format))
    printer.print_text()
    for line in lines:
        printer.print_text(line)


def _describe_coefficients(table: "CoefficientTable") -> list[str]:
    """How many coefficients, what they determine, and what follows from what."""
    first = [coefficient.function[0] for coefficient in table.coefficients]
    counts = {"PG": first.count("g"), "PJ": first.count("J"), "PS": first.count("S")}
    identifiability = table.identifiability
    lines = [
        f"{len(first)} coefficients ("
        + ", ".join(f"{n} {letter}" for letter, n in counts.items())
        + f"), rank {table.relations.rank}: {' '.join(table.relations.independent)}",
        f"{len(identifiability.appearing)} of {len(identifiability.letters)} physical parameters "
        "appear; without "
        f"effect: {' '.join(identifiability.vanishing) or 'none'}",
    ]
    lines += [f"only together: {' '.join(group)}" for group in identifiability.sums]
    size, determinant = len(table.map.rows), formulas.coefficients.format_determinant(table)
    if determinant is not None:
        lines += [f"map to the base parameters, {size} x {size}, determinant {determinant}:"]
        lines += [f"  {line}" for line in formulas.coefficients.format_backward_map(table)]
    return lines


# `modeler generate ROBOT|MODEL --out DIR`.


def run_generate(args: argparse.Namespace) -> GeneratedFolder:
    """Writes the folder and says what is in it."""
    options = GenerateOptions.from_names(vars(args))
    thing = read_robot_or_model(args)
    if isinstance(thing, Robot):
        from modeler.codegen import Control

        with show_activity(f"deriving {thing.name}"):
            control = Control(**select_attributes(options, CONTROLLED))
            kinds = select_attributes(options, "precision cuda measure")
            emitted = generate(derive(thing), args.out, args.force, control=control, **kinds)
    else:
        from modeler.api.workflow import generate as generate_of_model

        with show_activity(f"deriving {thing.spec.robot}"):
            emitted = generate_of_model(thing, args.out, force=args.force, **vars(options))
        for line in thing.warning:
            print_error(line)
    spec, fitted = emitted.spec, emitted.spec.fitted
    single = ", single precision" if spec.precision == "single" else ""
    print_result(f"{spec.robot}: {len(spec.base)} base parameters{single}, written to {args.out}:")
    print_lines([*sorted(emitted.files), *map(_describe_function, spec.functions)], "  ")
    from modeler.codegen import list_leftovers  # jinja2, which `derive` has no use for

    for name in list_leftovers(emitted, args.out):
        print_error(
            f"{args.out}: {name} is of an earlier generate and belongs to this code no more; it "
            "was edited since, so it stays: remove it, or keep it elsewhere"
        )
    result: GeneratedFolder = {
        "robot": spec.robot,
        "folder": args.out,
        "files": sorted(emitted.files),
    }
    if spec.control is not None and spec.control.functions:
        print_result(f"for controllers, in {spec.prefix}_control.h:")
        print_lines(map(_describe_function, spec.control.functions), "  ")
    if fitted is not None:
        print_result(f"with the fitted values, signature {fitted.signature}:")
        print_lines(map(_describe_function, fitted.functions), "  ")
        if fitted.widths:
            print_result(f"  widths of the Coulomb friction: {', '.join(fitted.widths)}")
        result |= {
            "fitted_signature": fitted.signature,
            "valid": fitted.valid,
            "warnings": list(fitted.warnings),
        }
    show_next([f"make -C {shlex.quote(args.out)} check"])
    return result


def _describe_function(function: "FunctionSpec") -> str:
    return (
        f"{function.name}: {function.equation} ({function.additions} additions, "
        f"{function.multiplications} multiplications)"
    )
