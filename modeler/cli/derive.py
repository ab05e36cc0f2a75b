"""`modeler derive ROBOT` and `modeler generate ROBOT|MODEL --out DIR`."""

import argparse
import dataclasses
import re
import shlex
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from modeler import formulas
from modeler.cli.console import Json, print_error, say, say_lines, show_next, working
from modeler.cli.lists import robot_of, robot_with_effects
from modeler.cli.options import FEW_JOINTS, Form
from modeler.codegen import Derivation, derive, generate
from modeler.core.errors import ALSO, Also, DataError, ModelerError, RobotError
from modeler.core.files import write_atomically
from modeler.core.formula import latex_text
from modeler.derivation import LinkColumn, SymbolicModel, random_states, regressor_values, relations

if TYPE_CHECKING:
    from modeler.core.manifest import FunctionSpec
    from modeler.estimation import IdentifiedModel
    from modeler.formulas import CoefficientTable, function_sheet

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
            if text:
                say(("\n" if self._paragraph else "") + _breakable(" ".join(text.split())))
            self._paragraph = self._paragraph or bool(text)
        elif self.form == "latex":
            for line in text.splitlines() or [""]:
                say(f"% {line}".rstrip())
        else:
            say(text)

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
    if args.nonzero and not (args.closed_form or args.regressor or args.blocks):
        raise ModelerError(
            "--nonzero changes nothing by itself; add --closed-form, --regressor or --blocks"
        )
    if args.expanded and not (args.closed_form or args.terms):
        raise ModelerError("--expanded changes nothing by itself; add --closed-form or --terms")
    if args.document and args.format != "latex":
        raise ModelerError("--document is a whole page of LaTeX; add --format latex")


def check_loops(args: argparse.Namespace, derivation: Derivation) -> None:
    """Refuses what has no meaning for loops.

    Raises:
        ModelerError: coefficients or expanded forms are asked for.
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

_SHEETS: "dict[Form, Callable[[function_sheet.Sheet, Words], str]]" = {
    "text": lambda sheet, _: "\n".join(formulas.function_sheet.sheet_lines(sheet)),
    "latex": lambda sheet, words: formulas.function_sheet.sheet_latex(sheet, words.heading),
    "markdown": lambda sheet, _: formulas.function_sheet.sheet_markdown(sheet),
}
_WIDTH = 96
_COMMENT: dict[Form, str] = {"text": "# ", "latex": "", "markdown": "* "}
_FORMS = ("closed_form", "regressor", "blocks", "energy", "kane")


def run_derive(args: argparse.Namespace) -> Json:
    """Prints relations, proof, and for small robots the coefficients."""
    check_request(args)
    robot = robot_with_effects(args) if args.cut_loops else None
    if robot is not None:
        # the tree of loops that are not closed: every joint has a torque
        if not robot.loops:
            raise RobotError(
                f"--cut-loops: {robot.name} has no loops to cut; leave --cut-loops out"
            )
        title = f"{robot.title}, its loops cut open"
        robot = dataclasses.replace(robot.opened(), title=title)
    else:
        robot = robot_of(args)
    with working(f"deriving {robot.name}"):
        derivation = derive(robot)
        check_loops(args, derivation)
        opinion = second_opinion(derivation)
    base = derivation.base
    result = relations.as_json(robot.name, base) | {"newton_euler_against_lagrange": opinion}
    counts = ", ".join(f"{n} {kind}" for kind, n in base.counts().items() if n)
    tied = _tied_lines(derivation.model)
    agreement = f"Newton-Euler against Lagrange: {opinion:.1e} of the largest torque"
    words = Words(args.format, args.document)
    words.title(robot.heading)
    words.say(f"{len(base.columns)} standard parameters, {base.rank} base parameters ({counts})")
    for line in tied:
        words.say(line)
    words.say()
    words.formulas(getattr(relations, f"as_{args.format}")(base))
    words.say()
    words.say(relations.proof_text(base.proof))
    words.say(agreement)
    result |= print_closed_forms(args, derivation, words)
    if args.report is not None:
        from modeler.report import derivation_page, write_page  # pages take long to load

        page = derivation_page(derivation, tied, agreement, args.robot)
        words.say(f"written: {write_page(Path(args.report), page)}")
    words.end()
    return result


def _tied_lines(model: SymbolicModel) -> list[str]:
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
            + (f" ({closure.redundant} more follow from these)" if closure.redundant else "")
        )
    elif robot.loops:
        lines.append(f"loops: {len(robot.loops)}, which these relations close")
    return lines


def second_opinion(derivation: Derivation, samples: int = 50) -> float:
    """Largest difference of the torques of both derivations, relative to the largest torque."""
    model = derivation.model
    rng = np.random.default_rng(derivation.base.proof.seed)
    states = random_states(model, samples, rng)
    link = np.array([isinstance(column, LinkColumn) for column in model.columns])
    chi = np.where(link, rng.normal(size=len(link)), 0.0)
    tau = regressor_values(model, states) @ chi
    from modeler.derivation import lagrange_torque  # casadi takes long to load

    other = lagrange_torque(model, *states, chi)
    largest = float(np.max(np.abs(other)))
    return float(np.max(np.abs(tau - other))) / largest if largest else 0.0


def print_closed_forms(args: argparse.Namespace, derivation: Derivation, words: Words) -> Json:
    """Prints what was asked for; for few joints the coefficients unasked.

    Returns:
        What is added to the JSON: "closed_form" and "regressor" as asked for.
    """
    model, base = derivation.model, derivation.base
    if args.nonzero:
        base = formulas.nonzero_base(model, base)
    added: Json = _by_link(args, model, words)
    if args.closed_form and args.expanded:
        words.say()
        closed = formulas.closed_form(model, base)
        if args.format == "latex":
            words.say(formulas.render.equation(closed))
        words.formulas(getattr(formulas.render, f"closed_form_{args.format}")(closed))
    motion = args.closed_form and not args.expanded
    asked = {"closed_form": motion, "regressor": args.regressor}
    if any(asked.values()):
        found = formulas.equation_of(model, base, motion=motion, columns=args.regressor)
        told = _print_equation(found, args.format, words)
        added |= {key: told for key, wanted in asked.items() if wanted}
    if args.blocks:
        added["blocks"] = _print_equation(formulas.block_form(model, base), args.format, words)
    few = len(model.robot.coordinates) <= FEW_JOINTS and model.closure is None
    asked_else = any(vars(args)[key] for key in _FORMS)
    unasked = few and args.format == "text" and not asked_else
    wanted = unasked if args.terms is None else args.terms
    if wanted:
        _print_coefficients(args, derivation, words)
    if args.coefficients_out is not None:
        write_atomically(Path(args.coefficients_out), formulas.terms_report(model, derivation.base))
        words.say(f"written: {args.coefficients_out}")
    return added


def _by_link(args: argparse.Namespace, model: SymbolicModel, words: Words) -> Json:
    """Energy functions and Kane's form, each with its difference from the derivation."""
    added: Json = {}
    for key, form, what in (
        ("energy", "energy_functions", "d/dt h against the power of the torques"),
        ("kane", "kane_form", "torques of Kane's form against Newton-Euler"),
    ):
        if vars(args)[key]:
            states = random_states(model, 50, np.random.default_rng(1985))
            found, off = getattr(formulas, form)(model, states)
            added[key] = _print_equation(found, args.format, words) | {"difference": off}
            words.say(f"\n{what}: {off:.1e} of the largest")
    return added


def _print_equation(found: "formulas.Equation", form: Form, words: Words) -> Json:
    mark = _COMMENT[form]
    words.say()
    for line in found.words:
        indent = mark + "  " if mark != "* " else "  "
        words.say(textwrap.fill(mark + line, _WIDTH, subsequent_indent=indent))
    words.say()
    words.formulas(_SHEETS[form](found.sheet, words))
    return {"equation": list(found.words), **formulas.function_sheet.sheet_json(found.sheet)}


def _print_coefficients(args: argparse.Namespace, derivation: Derivation, words: Words) -> None:
    # What was not asked for must not take away what was.
    unasked = args.terms is None and args.coefficients_out is None
    try:
        table = formulas.coefficients.coefficient_table(derivation.model, derivation.base)
        if unasked and len(table.coefficients) > PAGE:
            words.say()
            words.say(f"{len(table.coefficients)} PG/PJ/PS coefficients: --terms lists them")
            return
        shown, lines = table, _facts(table)
        if not args.expanded and len(table.coefficients) > MANY:
            shown = formulas.coefficients.independent_coefficients(table)
            lines.insert(
                0,
                f"listed: {len(shown.coefficients)} of {len(table.coefficients)} coefficients, "
                "from which the others follow; --expanded lists all",
            )
    except ModelerError as error:
        if not unasked:
            raise
        words.say()
        words.say(f"no coefficients: {error}")
        return
    words.say()
    words.formulas(getattr(formulas.render, f"coefficients_{args.format}")(shown))
    words.say()
    for line in lines:
        words.say(line)


def _facts(table: "CoefficientTable") -> list[str]:
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
    lines += [f"only together: {' '.join(group)}" for group in found.sums]
    size, determinant = len(table.map.rows), formulas.render.determinant_text(table)
    if determinant is not None:
        lines += [f"map to the base parameters, {size} x {size}, determinant {determinant}:"]
        lines += [f"  {line}" for line in formulas.render.backward_lines(table)]
    return lines


# `modeler generate ROBOT|MODEL --out DIR`.


def run_generate(args: argparse.Namespace) -> Json:
    """Writes the folder and says what is in it."""
    kinds = {name: vars(args)[name] for name in ("precision", "cuda", "measure")}
    also: dict[Also, bool] = {name: vars(args)[name] for name in ALSO}
    only = tuple(name.strip() for name in args.only.split(",")) if args.only else ()
    model = _model(args)
    if model is not None:
        from modeler.api.workflow import generate as generate_of_model

        with working(f"deriving {model.spec.robot}"):
            emitted = generate_of_model(
                model, args.out, args.force, frames=args.frame, only=only,
                also=[name for name in ALSO if also[name]], **kinds,
            )  # fmt: skip
        for line in model.warning:
            print_error(line)
    else:
        from modeler.codegen import Control

        robot = robot_of(args)
        with working(f"deriving {robot.name}"):
            control = Control(tuple(args.frame), only, **also)
            emitted = generate(derive(robot), args.out, args.force, control=control, **kinds)
    spec, fitted = emitted.spec, emitted.spec.fitted
    single = ", single precision" if spec.precision == "single" else ""
    say(f"{spec.robot}: {len(spec.base)} base parameters{single}, written to {args.out}:")
    say_lines([*sorted(emitted.files), *map(_function_line, spec.functions)], "  ")
    from modeler.codegen import leftovers  # jinja2, which `derive` has no use for

    for name in leftovers(emitted, args.out):
        print_error(
            f"{args.out}: {name} is of an earlier generate and belongs to this code no more; it "
            "was edited since, so it stays: remove it, or keep it elsewhere"
        )
    result: Json = {"robot": spec.robot, "folder": args.out, "files": sorted(emitted.files)}
    if spec.control is not None and spec.control.functions:
        say(f"for controllers, in {spec.prefix}_control.h:")
        say_lines(map(_function_line, spec.control.functions), "  ")
    if fitted is not None:
        say(f"with the fitted values, signature {fitted.signature}:")
        say_lines(map(_function_line, fitted.functions), "  ")
        if fitted.widths:
            say(f"  widths of the Coulomb friction: {', '.join(fitted.widths)}")
        result |= {
            "fitted_signature": fitted.signature,
            "usable": fitted.usable,
            "doubts": list(fitted.doubts),
        }
    show_next([f"make -C {shlex.quote(args.out)} check"])
    return result


def _model(args: argparse.Namespace) -> "IdentifiedModel | None":
    """None of a robot."""
    if not args.robot.endswith(".json"):
        return None
    if args.effects is not None:
        raise DataError(
            f"--effects: got it with {args.robot}, a model, which has the effects that it was "
            "fitted with; leave --effects out, or fit the robot with them"
        )
    from modeler.estimation import load_model  # a robot needs no fits

    return load_model(args.robot)


def _function_line(function: "FunctionSpec") -> str:
    return (
        f"{function.name}: {function.equation} ({function.additions} additions, "
        f"{function.multiplications} multiplications)"
    )
