"""`modeler derive ROBOT` and `modeler generate ROBOT|MODEL --out DIR`."""

import argparse
from typing import Literal, get_args

from modeler.cli.parsers.options import (
    Commands,
    Run,
    add_effects,
    add_force,
    add_json,
    add_robot,
)
from modeler.cli.places import ModuleFolder, Output, RobotOrModel
from modeler.core.choices import Precision

Form = Literal["text", "latex", "markdown"]
"""How relations are printed."""

FEW_JOINTS = 3
"""Robots of as many joints get their coefficients printed unasked."""


def add_derive(commands: Commands) -> None:
    """`modeler derive`."""
    parser = commands.add_parser(
        "derive",
        help="base parameters and grouping relations, with their proof",
        description="Derives the model of ROBOT, linear in the dynamic parameters: which base "
        "parameters it has, how the standard parameters group, and the proof. Robots of up to "
        f"{FEW_JOINTS} joints also get their PG/PJ/PS coefficients.",
        epilog="example: modeler derive puma560 --format latex --document > puma560.tex",
    )
    add_robot(parser)
    parser.add_argument(
        "--format", choices=sorted(get_args(Form)), default="text", help="of what is printed"
    )
    parser.add_argument(
        "--document", action="store_true",
        help="with --format latex: a whole document; without, what \\input takes beside amsmath",
    )  # fmt: skip
    _add_formulas(parser)
    parser.add_argument(
        "--report", metavar="FILE.md", type=Output, help="write the page of the coefficients"
    )
    parser.add_argument(
        "--page", metavar="FILE.html", type=Output, help="write a page: table, relations, proof"
    )
    parser.add_argument(
        "--open", action="store_true", help="cut the loops: the tree, as counted leg by leg"
    )
    add_json(parser, "write the result for machines")
    parser.set_defaults(load=_derive)


def _add_formulas(parser: argparse.ArgumentParser) -> None:
    """Which formulas are printed besides the relations."""
    parser.add_argument(
        "--terms", action=argparse.BooleanOptionalAction, help="PG/PJ/PS coefficients or not"
    )
    parser.add_argument(
        "--closed-form",
        action="store_true",
        help="M(q), Christoffel coefficients and gravity; of loops J_t and J_p too",
    )
    parser.add_argument(
        "--regressor", action="store_true", help="every base column, that of friction too"
    )
    parser.add_argument(
        "--expanded",
        action="store_true",
        help="with --closed-form: sums of monomials instead of named quantities; with --terms: all "
        "coefficients, those that follow from others too",
    )
    parser.add_argument(
        "--nonzero",
        action="store_true",
        help="with --closed-form and --regressor: leave out base parameters that are 0 at the "
        "values of [parameters]",
    )


def _derive() -> Run:
    from modeler.cli.derive import run_derive

    return run_derive


def add_generate(commands: Commands) -> None:
    """`modeler generate`."""
    parser = commands.add_parser(
        "generate",
        help="C source, header, manifest and build files",
        description="Writes dependency-free C99 for ROBOT: regressors, inverse dynamics, inertia "
        "matrix, gravity, Coriolis, and the batch observation matrix, in a folder that builds by "
        "itself with make or cmake. Of a MODEL also functions that have its fitted values: they "
        "take no parameters, and their Coulomb friction can be smoothed.",
        epilog="example: modeler generate panda --out panda_c; of a fitted model: "
        "modeler generate arm.model.json --out arm_c",
    )
    parser.add_argument(
        "robot", metavar="ROBOT|MODEL", type=RobotOrModel,
        help="a robot file, the name of a built-in robot, or a model file of `modeler fit`",
    )  # fmt: skip
    add_effects(parser)
    parser.add_argument(
        "--out", metavar="DIR", required=True, type=ModuleFolder, help="folder to write"
    )
    parser.add_argument(
        "--precision", choices=get_args(Precision), default="double",
        help="of all numbers of the C: double, or float for a microcontroller",
    )  # fmt: skip
    parser.add_argument(
        "--cuda", action="store_true", help="also the base regressor for graphics processors"
    )
    add_force(parser)
    add_json(parser, "write the manifest for machines")
    parser.set_defaults(load=_generate)


def _generate() -> Run:
    from modeler.cli.generate import run_generate

    return run_generate
