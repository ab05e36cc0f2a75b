"""`modeler derive ROBOT` and `modeler generate ROBOT|MODEL --out DIR`."""

import argparse
import dataclasses
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from modeler.cli.console import Json, complain, say, working
from modeler.cli.formula_output import Words, check_loops, check_request, forms_wanted
from modeler.cli.lists import robot_of, robot_with_effects
from modeler.cli.options import Form
from modeler.codegen.derivation import Derivation, derive, generate
from modeler.core.errors import DataError, RobotError
from modeler.core.manifest import Emitted, FittedSpec, FunctionSpec
from modeler.derivation.columns import LinkColumn
from modeler.derivation.model import SymbolicModel
from modeler.derivation.numeric_rank import random_states, regressor_values
from modeler.derivation.relations import (
    as_json,
    as_latex,
    as_markdown,
    as_text,
    proof_paragraphs,
    proof_text,
    relation_formula,
)
from modeler.derivation.result import BaseParameters
from modeler.robot.robot import Robot

if TYPE_CHECKING:
    from modeler.estimation.model_file import IdentifiedModel


_FORMS: dict[Form, Callable[[BaseParameters], str]] = {
    "text": as_text,
    "latex": as_latex,
    "markdown": as_markdown,
}


def run_derive(args: argparse.Namespace) -> Json:
    """Prints relations, proof, and for small robots the coefficients."""
    check_request(args)
    robot = _opened(args) if args.open else robot_of(args)
    with working(f"deriving {robot.name}"):
        derivation = derive(robot)
        check_loops(args, derivation)
        opinion = second_opinion(derivation)
    base = derivation.base
    result = as_json(robot.name, base) | {"newton_euler_against_lagrange": opinion}
    counts = ", ".join(f"{n} {kind}" for kind, n in base.counts().items() if n)
    words = Words(args.format, args.document)
    words.title(f"{robot.name}: {robot.title}")
    words.say(f"{len(base.columns)} standard parameters, {base.rank} base parameters ({counts})")
    for line in _tied_lines(derivation.model):
        words.say(line)
    words.say()
    words.formulas(_FORMS[args.format](base))
    words.say()
    words.say(proof_text(base.proof))
    words.say(_agreement(opinion))
    if forms_wanted(args, derivation):
        from modeler.cli.formula_output import say_closed_forms  # it takes long to load

        result |= say_closed_forms(args, derivation, words)
    if args.page is not None:
        words.say(f"written: {_page(args, derivation, opinion)}")
    words.end()
    return result


def _page(args: argparse.Namespace, derivation: Derivation, opinion: float) -> Path:
    from modeler.report.derivation import Derived, write_derivation

    base = derivation.base
    units = (base.columns[parameter.column].unit for parameter in base.parameters)
    relations = [relation_formula(parameter) for parameter in base.parameters]
    derived = Derived(
        relations=list(zip(relations, units, strict=True)),
        standard=len(base.columns),
        counts=base.counts(),
        unidentifiable=base.unidentifiable,
        tied=_tied_lines(derivation.model),
        proof=(base.proof.kind, [*proof_paragraphs(base.proof), _agreement(opinion)]),
    )
    return write_derivation(Path(args.page), derivation.robot, derived, args.robot)


def _agreement(opinion: float) -> str:
    return f"Newton-Euler against Lagrange: {opinion:.1e} of the largest torque"


def _opened(args: argparse.Namespace) -> Robot:
    """The tree of a robot whose loops are not closed: every joint of its table has a torque."""
    robot = robot_with_effects(args)
    if not robot.loops:
        raise RobotError(f"--open: {robot.name} has no loops to cut; leave --open out")
    title = f"{robot.title}, its loops cut open"
    return dataclasses.replace(robot.opened(), title=title)


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
    from modeler.derivation.lagrange import lagrange_torque  # casadi takes long to load

    other = lagrange_torque(model, *states, chi)
    largest = float(np.max(np.abs(other)))
    return float(np.max(np.abs(tau - other))) / largest if largest else 0.0


# `modeler generate ROBOT|MODEL --out DIR`.


def run_generate(args: argparse.Namespace) -> Json:
    """Writes the folder and says what is in it."""
    model = _model(args)
    emitted = _written(args, model)
    spec, fitted = emitted.spec, emitted.spec.fitted
    for line in () if model is None else model.warning:
        complain(line)
    single = ", single precision" if spec.precision == "single" else ""
    say(f"{spec.robot}: {len(spec.base)} base parameters{single}, written to {args.out}:")
    for name in sorted(emitted.files):
        say(f"  {name}")
    for function in spec.functions:
        say(_told(function))
    from modeler.codegen.package import leftovers  # jinja2, which `derive` has no use for

    for name in leftovers(emitted, args.out):
        complain(
            f"{args.out}: {name} is of an earlier generate and belongs to this code no more; it "
            "was edited since, so it stays: remove it, or keep it elsewhere"
        )
    result = {"robot": spec.robot, "folder": args.out, "files": sorted(emitted.files)}
    return result if fitted is None else result | _say_fitted(fitted)


def _model(args: argparse.Namespace) -> "IdentifiedModel | None":
    """None of a robot."""
    if not args.robot.endswith(".json"):
        return None
    if args.effects is not None:
        raise DataError(
            f"--effects: got it with {args.robot}, a model, which has the effects that it was "
            "fitted with; leave --effects out, or fit the robot with them"
        )
    from modeler.estimation.model_file import load_model  # a robot needs no fits

    return load_model(args.robot)


def _written(args: argparse.Namespace, model: "IdentifiedModel | None") -> Emitted:
    if model is not None:
        from modeler.api.workflow import generate as generate_of_model

        with working(f"deriving {model.spec.robot}"):
            return generate_of_model(model, args.out, args.force, **_kinds(args))
    robot = robot_of(args)
    with working(f"deriving {robot.name}"):
        return generate(derive(robot), args.out, args.force, **_kinds(args))


def _kinds(args: argparse.Namespace) -> dict[str, Any]:
    return {"precision": args.precision, "cuda": args.cuda}


def _say_fitted(fitted: FittedSpec) -> dict[str, Json]:
    """What has the values."""
    say(f"with the fitted values, signature {fitted.signature}:")
    for function in fitted.functions:
        say(_told(function))
    if fitted.widths:
        say(f"  widths of the Coulomb friction: {', '.join(fitted.widths)}")
    return {
        "fitted_signature": fitted.signature,
        "usable": fitted.usable,
        "doubts": list(fitted.doubts),
    }


def _told(function: FunctionSpec) -> str:
    return (
        f"  {function.name}: {function.equation} ({function.additions} additions, "
        f"{function.multiplications} multiplications)"
    )
