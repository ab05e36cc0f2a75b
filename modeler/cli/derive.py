"""`modeler derive ROBOT` and `modeler generate ROBOT --out DIR`."""

import argparse
import dataclasses
import textwrap
from collections.abc import Callable
from pathlib import Path

import numpy as np

from modeler.base import BaseParameters
from modeler.base.numeric import random_states, regressor_values
from modeler.base.render import as_json, as_latex, as_markdown, as_text, proof_text
from modeler.cli.console import Json, say, working
from modeler.cli.parsers.derive import FEW_JOINTS, Form
from modeler.cli.robots import robot_of, robot_with_effects
from modeler.core.errors import ModelerError, RobotError
from modeler.core.files import write_atomically
from modeler.derivation import Derivation, derive, generate
from modeler.robot import Robot
from modeler.symbolic import LinkColumn, SymbolicModel
from modeler.symbolic.second_opinion import lagrange_torque
from modeler.terms import (
    ClosedForm,
    CoefficientTable,
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
    terms_report,
)

_FORMS: dict[Form, Callable[[BaseParameters], str]] = {
    "text": as_text,
    "latex": as_latex,
    "markdown": as_markdown,
}
_CLOSED_FORMS: dict[Form, Callable[[ClosedForm], str]] = {
    "text": closed_form_text,
    "latex": closed_form_latex,
    "markdown": closed_form_markdown,
}
_TABLES: dict[Form, Callable[[CoefficientTable], str]] = {
    "text": coefficients_text,
    "latex": coefficients_latex,
    "markdown": coefficients_markdown,
}


def run_derive(args: argparse.Namespace) -> Json:
    """Prints relations, proof, and for small robots the coefficients."""
    robot = _opened(args) if args.open else robot_of(args)
    with working(f"deriving {robot.name}"):
        derivation = derive(robot)
        opinion = second_opinion(derivation)
    base = derivation.base
    result = as_json(robot.name, base) | {"newton_euler_against_lagrange": opinion}
    counts = ", ".join(f"{n} {kind}" for kind, n in base.counts().items() if n)
    say(f"{robot.name}: {robot.title}")
    say(f"{len(base.columns)} standard parameters, {base.rank} base parameters ({counts})")
    for line in _tied_lines(derivation.model):
        say(line)
    say()
    say(_FORMS[args.format](base))
    say()
    say(proof_text(base.proof))
    say(f"Newton-Euler against Lagrange: {opinion:.1e} of the largest torque")
    _closed_forms(args, derivation)
    return result


def _opened(args: argparse.Namespace) -> Robot:
    """The tree of a robot whose loops are not closed: every row of its table moves freely."""
    robot = robot_with_effects(args)
    if not robot.loops:
        raise RobotError(f"--open: {robot.name} has no loops to cut; leave --open out")
    title = f"{robot.title}, its loops cut open"
    return dataclasses.replace(robot, title=title, loops=())


def _tied_lines(model: SymbolicModel) -> list[str]:
    """How the joints of a robot with relations or loops move each other."""
    robot = model.robot
    if not robot.relations and not robot.loops:
        return []
    names = ", ".join(f"q{joint.name}" for joint in robot.coordinates)
    lines = [f"coordinates: {names}"]
    if robot.relations:
        relations = [f"q{name} = {relation.text}" for name, relation in robot.relations.items()]
        lines += textwrap.wrap(
            "relations: " + "; ".join(relations), 96, subsequent_indent=" " * 11,
            break_long_words=False,
        )  # fmt: skip
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
    other = lagrange_torque(model, *states, chi)
    largest = float(np.max(np.abs(other)))
    return float(np.max(np.abs(tau - other))) / largest if largest else 0.0


def _closed_forms(args: argparse.Namespace, derivation: Derivation) -> None:
    model, base = derivation.model, derivation.base
    if model.robot.relations or model.robot.loops:
        if args.closed_form or args.terms or args.report is not None:
            raise ModelerError(
                f"{model.robot.name}: closed forms and coefficients are written for serial and "
                "tree robots; leave out --closed-form, --terms and --report"
            )
        return
    small = len(model.robot.coordinates) <= FEW_JOINTS
    if args.closed_form:
        say()
        say(_CLOSED_FORMS[args.format](closed_form(model, base)))
    if args.terms or (args.terms is None and small and args.format == "text"):
        # What was not asked for must not take away what was.
        unasked = args.terms is None and args.report is None
        try:
            lines = _coefficients(derivation, args.format)
        except ModelerError as error:
            if not unasked:
                raise
            lines = ["", f"no coefficients: {error}"]
        for line in lines:
            say(line)
    if args.report is not None:
        write_atomically(Path(args.report), terms_report(model, base))
        say(f"written: {args.report}")


def _coefficients(derivation: Derivation, form: Form) -> list[str]:
    table = coefficient_table(derivation.model, derivation.base)
    return ["", _TABLES[form](table), "", *_facts(table)]


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


def run_generate(args: argparse.Namespace) -> Json:
    """Writes the folder and says what is in it."""
    robot = robot_of(args)
    with working(f"deriving {robot.name}"):
        derivation = derive(robot)
        emitted = generate(derivation, args.out, args.force)
    say(f"{robot.name}: {derivation.base.rank} base parameters, written to {args.out}:")
    for name in sorted(emitted.files):
        say(f"  {name}")
    for function in emitted.spec.functions:
        say(
            f"  {function.name}: {function.equation} ({function.additions} additions, "
            f"{function.multiplications} multiplications)"
        )
    return {"robot": robot.name, "folder": args.out, "files": sorted(emitted.files)}
