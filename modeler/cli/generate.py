"""`modeler generate ROBOT|MODEL --out DIR`."""

import argparse
from typing import TYPE_CHECKING, Any

from modeler.cli.console import Json, complain, say, working
from modeler.cli.robots import robot_of
from modeler.codegen import leftovers
from modeler.core.contract import Emitted, FittedSpec, FunctionSpec
from modeler.core.errors import DataError
from modeler.derivation import derive, generate

if TYPE_CHECKING:
    from modeler.fit import IdentifiedModel


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
    from modeler.fit import load_model  # a robot needs no fits

    return load_model(args.robot)


def _written(args: argparse.Namespace, model: "IdentifiedModel | None") -> Emitted:
    if model is not None:
        from modeler.api.chain import generate as generate_of_model

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
