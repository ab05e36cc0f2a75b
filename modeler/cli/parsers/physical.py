"""`modeler physical ROBOT|MODEL`."""

import argparse
from typing import Literal, get_args

from modeler.cli.parsers.options import Commands, Run, add_json
from modeler.cli.places import RobotOrModel, Word

SolutionForm = Literal["text", "latex", "python"]
Source = Literal["base", "coefficients"]

NOMINAL = ""
"""`--cad` without a file: the values of the robot file."""


def add_physical(commands: Commands) -> None:
    """`modeler physical`."""
    parser = commands.add_parser(
        "physical",
        help="masses, mass centres and inertias that follow from a fit and from known ones",
        description="Which physical parameters follow from the base parameters if some are known: "
        "formulas in an order that can be checked, with a MODEL values and sigma; which sets of "
        "known parameters suffice; a fit against CAD values. Without options: what there is to "
        "know, and the easiest set that suffices.",
        epilog="example: modeler physical wrist --known am,bm,bl1,bt2,ct1,bJ33,cJ33,cm",
    )
    parser.add_argument(
        "source", metavar="ROBOT|MODEL", type=RobotOrModel,
        help="a robot file, the name of a built-in robot, or a model file of `modeler fit`",
    )  # fmt: skip
    _add_options(parser)
    add_json(parser, "write the result for machines")
    parser.set_defaults(load=_physical)


def _add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--known", metavar="LIST", type=Word,
        help='parameters that are known, "am,bm"; with a MODEL their values in SI units, and '
        'standard deviations where they have one: "am=12+-0.1,bm=6"',
    )  # fmt: skip
    parser.add_argument(
        "--near", metavar="LIST", type=Word,
        help='about what a parameter is, "cm=4": chooses between roots where several fit',
    )  # fmt: skip
    parser.add_argument(
        "--sets", metavar="N", nargs="?", type=int, const=True,
        help="count and rank the sets of N known parameters that suffice; the smallest without N",
    )  # fmt: skip
    parser.add_argument(
        "--cad", metavar="FILE.toml", nargs="?", type=Word, const=Word(NOMINAL),
        help="with a MODEL: the fit against these values, am = 12.0 or am = [12.0, 0.1]; without "
        "FILE against those of the robot file. With --sets: where errors are compared",
    )  # fmt: skip
    parser.add_argument(
        "--format", choices=get_args(SolutionForm), default="text", help="of the formulas"
    )
    parser.add_argument(
        "--from", dest="of", choices=get_args(Source),
        help="formulas from base parameters, or from the coefficients PG, PJ of the closed form; "
        "default: coefficients where a fit leaves a length free",
    )  # fmt: skip


def _physical() -> Run:
    from modeler.cli.physical import run_physical

    return run_physical
