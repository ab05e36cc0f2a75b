"""The command line: parse, call, print. The only place that prints.

Exit status: 0 done, 1 the input is at fault (one line on stderr), 2 wrong usage.
"""

import argparse
import sys
from collections.abc import Sequence

from modeler import __version__
from modeler.core.errors import ModelerError


def parser() -> argparse.ArgumentParser:
    """The parser of all commands."""
    # Here and not above: `modeler --version` and wrong usage need not load every stage.
    from modeler.cli.demo import add_demo
    from modeler.cli.derive import add_derive, add_generate
    from modeler.cli.fit import add_compare, add_fit
    from modeler.cli.robots import add_effects, add_robots
    from modeler.cli.simulate import add_simulate

    top = argparse.ArgumentParser(
        prog="modeler",
        description="From the MDH table of a robot to exact base parameters, C, a fit and a "
        "comparison with measurements.",
        epilog="example: modeler derive wrist",
    )
    top.add_argument("--version", action="version", version=f"modeler {__version__}")
    commands = top.add_subparsers(metavar="COMMAND", required=True)
    for add in (
        add_derive, add_generate, add_fit, add_compare, add_simulate, add_robots, add_effects,
        add_demo,
    ):  # fmt: skip
        add(commands)
    return top


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; the exit status."""
    args = parser().parse_args(argv)
    try:
        args.run(args)
    except ModelerError as error:
        print(f"modeler: {error}", file=sys.stderr)
        return 1
    except BrokenPipeError:
        # The reader of our output has gone (`modeler ... | head`): nothing is wrong.
        sys.stderr.close()
        return 0
    except KeyboardInterrupt:
        print("modeler: interrupted", file=sys.stderr)
        return 130
    return 0
