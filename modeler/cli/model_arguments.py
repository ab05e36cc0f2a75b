"""What is typed after the commands about a robot: derive, generate, show, home, physical, lists."""

import argparse
from typing import Literal, get_args

from modeler.cli.options import (
    FEW_JOINTS,
    Commands,
    Form,
    Run,
    add_effects,
    add_force,
    add_json,
    add_number,
    add_robot,
)
from modeler.cli.places import DemoFolder, ModuleFolder, Output, RobotFile, RobotOrModel, Word
from modeler.core.builtin import paper_names
from modeler.core.errors import Precision


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
    from modeler.cli.derive import run_generate

    return run_generate


# `modeler show ROBOT`.


def add_show(commands: Commands) -> None:
    """`modeler show`."""
    parser = commands.add_parser(
        "show",
        help="the robot in 3-D: a page with sliders, a picture for papers",
        description="Draws the skeleton of ROBOT at home: frames, joint axes, links, loops, "
        "platform, gravity. The page stands alone, its sliders move the actuated joints and the "
        "loops follow. Loops that do not close are drawn open, with the gap.",
        epilog="example: modeler show orthoglide-2003 --png orthoglide.pdf",
    )
    parser.add_argument(
        "robot", metavar="ROBOT", type=RobotFile,
        help="a robot file, or the name of a built-in robot",
    )  # fmt: skip
    parser.add_argument(
        "--out", metavar="PAGE", type=Output,
        help="page to write (default NAME.html, if no picture is asked for)",
    )  # fmt: skip
    parser.add_argument(
        "--png", metavar="FILE", type=Output,
        help="write a picture one column wide: .png, .svg or .pdf",
    )  # fmt: skip
    add_json(parser, "write poses at home and gaps of loops for machines")
    parser.set_defaults(load=_show)


def _show() -> Run:
    from modeler.cli.show import run_show

    return run_show


# `modeler home ROBOT`.


def add_home(commands: Commands) -> None:
    """`modeler home`."""
    parser = commands.add_parser(
        "home",
        help="closed postures of a robot with loops, and its assembly modes",
        description="Finds the ways in which the loops of ROBOT can be put together with its "
        "actuated joints where [home] says, else in the middle of their [limits], else far from "
        "singularities; each gets a letter, A the best to start from. What [home] or --near say "
        "of passive joints ranks them: one near to it comes first.",
        epilog="example: modeler home crank.toml --pictures modes.html --mode B --write",
    )
    parser.add_argument(
        "robot", metavar="ROBOT", type=RobotFile,
        help="a robot file, or the name of a built-in robot",
    )  # fmt: skip
    parser.add_argument(
        "--near", metavar="q1=0.3,...", type=Word,
        help="values to stay near, rad and m, in place of the passive joints' in [home]",
    )  # fmt: skip
    parser.add_argument("--anew", action="store_true", help="as if the file had no [home]")
    parser.add_argument(
        "--mode", metavar="LETTER", type=Word, help="the mode that is meant (default A)"
    )
    parser.add_argument(
        "--write", action="store_true", help="write it into the robot file as [home]"
    )
    parser.add_argument(
        "--pictures", metavar="FILE", type=Output,
        help="a small picture of every mode: .png, .svg or .pdf, or a page (.html)",
    )  # fmt: skip
    add_json(parser, "write the modes for machines")
    parser.set_defaults(load=_home)


def _home() -> Run:
    from modeler.cli.home import run_home

    return run_home


# `modeler physical ROBOT|MODEL`.


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


# `modeler convert FILE --out ROBOT.toml`.


def add_convert(commands: Commands) -> None:
    """`modeler convert`."""
    parser = commands.add_parser(
        "convert",
        help="another program's robot file as ours",
        description="Writes the robot of a SYMORO file (.par) as a robot file, and says what was "
        "decided and what has no place there. Every command reads a .par as well; converted, it "
        "can be edited.",
        epilog="example: modeler convert rx90.par --out rx90.toml",
    )
    parser.add_argument("file", metavar="FILE", type=RobotFile, help="a SYMORO file (.par)")
    parser.add_argument(
        "--out", metavar="ROBOT.toml", required=True, type=Output, help="robot file to write"
    )
    parser.add_argument("--force", action="store_true", help="write over a file that is there")
    add_json(parser, "write what was converted for machines")
    parser.set_defaults(load=_convert)


def _convert() -> Run:
    from modeler.cli.show import run_convert

    return run_convert


# `modeler robots` and `modeler effects`.


def add_robots(commands: Commands) -> None:
    """`modeler robots`."""
    parser = commands.add_parser(
        "robots",
        help="the built-in robots",
        description="Lists the built-in robots: names to use wherever a command asks for ROBOT.",
        epilog="example: modeler robots --json robots.json",
    )
    parser.add_argument(
        "--show", metavar="NAME", type=RobotFile, help="print that robot's file, to start your own"
    )
    add_json(parser, "write the list for machines")
    parser.set_defaults(load=_robots)


def _robots() -> Run:
    from modeler.cli.lists import run_robots

    return run_robots


def add_effects_command(commands: Commands) -> None:
    """`modeler effects`."""
    parser = commands.add_parser(
        "effects",
        help="the catalogue of physical effects",
        description="Lists the physical effects that a robot file may name under [effects].",
        epilog="example: modeler effects coulomb",
    )
    parser.add_argument(
        "effect", metavar="EFFECT", nargs="?", type=Word, help="one effect, in full"
    )
    parser.add_argument(
        "--robot", metavar="ROBOT", type=RobotFile,
        help="with the effects that this robot file defines",
    )  # fmt: skip
    add_json(parser, "write the catalogue for machines")
    parser.set_defaults(load=_effects)


def _effects() -> Run:
    from modeler.cli.lists import run_effects

    return run_effects


# `modeler reproduce PAPER`.


SECTIONS = ("print", "methods")


def add_reproduce(commands: Commands) -> None:
    """`modeler reproduce`."""
    parser = commands.add_parser(
        "reproduce",
        help="what a paper prints beside what is derived, its identification run again",
        description="Quotes what a paper prints, derives it, and says of every line: printed and "
        "equal, printed and different (a misprint, an omission, an error, or perhaps the scan), or "
        "our consequence, not printed. Then runs the paper's identification again in simulation "
        "and sets its tables beside ours. Exit status 1 if a line differs unexpectedly.",
        epilog="example: modeler reproduce guegan-2003 --section methods",
    )
    parser.add_argument(
        "paper", metavar="PAPER", type=Word, help=f"one of {', '.join(paper_names())}"
    )
    parser.add_argument(
        "--section", choices=SECTIONS, help="what is printed, or the methods; both by default"
    )
    add_json(parser, "write the lines for machines")
    parser.set_defaults(load=_reproduce)


def _reproduce() -> Run:
    from modeler.cli.reproduce import run_reproduce

    return run_reproduce


# `modeler demo`.


def add_demo(commands: Commands) -> None:
    """`modeler demo`."""
    parser = commands.add_parser(
        "demo",
        help="the whole story on built-in robots with a hidden effect",
        description="Simulates an arm, then a robot with closed loops, each with a physical effect "
        "that its robot file lacks: derives, emits C, fits, compares, finds out which effect is "
        "missing, adds it, and shows the error falling on motion that was never fitted.",
        epilog="example: modeler demo --out demo",
    )
    parser.add_argument(
        "--out", metavar="DIR", default="demo", type=DemoFolder, help="folder (default %(default)s)"
    )
    add_force(parser)
    add_number(parser, "--duration", "S", float, "seconds of each simulated run", default=20.0)
    add_json(parser, "write the diagnoses for machines")
    parser.set_defaults(load=_demo)


def _demo() -> Run:
    from modeler.cli.demo import run_demo

    return run_demo
