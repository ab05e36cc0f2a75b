"""The command line: parse, call, print. The only place that prints.

Exit status: 0 done, 1 the input is at fault (one line on stderr), 2 wrong usage.
"""

import argparse
import os
import sys
from collections.abc import Sequence

from modeler import __version__
from modeler.cli.console import run_command
from modeler.core.errors import ModelerError

_Commands = argparse._SubParsersAction


def _deriving(commands: _Commands) -> None:
    from modeler.cli.derive import add_derive, add_generate

    add_derive(commands)
    add_generate(commands)


def _fitting(commands: _Commands) -> None:
    from modeler.cli.fit import add_compare, add_fit

    add_fit(commands)
    add_compare(commands)


def _diagnosing(commands: _Commands) -> None:
    from modeler.cli.add import add_add
    from modeler.cli.diagnose import add_diagnose

    add_diagnose(commands)
    add_add(commands)


def _simulating(commands: _Commands) -> None:
    from modeler.cli.simulate import add_simulate

    add_simulate(commands)


def _listing(commands: _Commands) -> None:
    from modeler.cli.robots import add_effects, add_robots

    add_robots(commands)
    add_effects(commands)


def _reproducing(commands: _Commands) -> None:
    from modeler.cli.reproduce import add_reproduce

    add_reproduce(commands)


def _showing(commands: _Commands) -> None:
    from modeler.cli.demo import add_demo

    add_demo(commands)


_GROUPS = {
    ("derive", "generate"): _deriving,
    ("fit", "compare"): _fitting,
    ("diagnose", "add"): _diagnosing,
    ("simulate",): _simulating,
    ("robots", "effects"): _listing,
    ("reproduce",): _reproducing,
    ("demo",): _showing,
}


def parser(only: str | None = None) -> argparse.ArgumentParser:
    """The parser of all commands, or of those that stand with one: others load more stages."""
    top = argparse.ArgumentParser(
        prog="modeler",
        description="From the MDH table of a robot to exact base parameters, C, a fit and a "
        "comparison with measurements.",
        epilog="example: modeler derive wrist",
    )
    top.add_argument("--version", action="version", version=f"modeler {__version__}")
    commands = top.add_subparsers(metavar="COMMAND", required=True)
    wanted = [add for names, add in _GROUPS.items() if only in names]
    for add in wanted or _GROUPS.values():
        add(commands)
    return top


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; the exit status."""
    # Our matrices are small: on a busy machine, waiting for a second thread of the linear algebra
    # tripled the time of `derive panda` (0.4 s to 1.2 s). Before numpy is loaded, by parser().
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    words = sys.argv[1:] if argv is None else list(argv)
    args = parser(words[0] if words else None).parse_args(words)
    try:
        run_command(args)
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
