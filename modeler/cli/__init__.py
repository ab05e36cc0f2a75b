"""The command line: parse, call, print. The only place that prints.

Exit status: 0 done, 1 the input is at fault (one line on stderr), 2 wrong usage.
"""

import argparse
import importlib
import os
import sys
from collections.abc import Sequence

from modeler import __version__
from modeler.core.errors import ModelerError

_COMMANDS = {
    "derive": "derive",
    "generate": "derive",
    "fit": "fit",
    "compare": "fit",
    "simulate": "simulate",
    "robots": "robots",
    "effects": "robots",
    "demo": "demo",
}
"""Command -> the module that has its add_<command>."""


def parser(only: str | None = None) -> argparse.ArgumentParser:
    """The parser of all commands, or of one: a command loads only the stages that it uses."""
    top = argparse.ArgumentParser(
        prog="modeler",
        description="From the MDH table of a robot to exact base parameters, C, a fit and a "
        "comparison with measurements.",
        epilog="example: modeler derive wrist",
    )
    top.add_argument("--version", action="version", version=f"modeler {__version__}")
    commands = top.add_subparsers(metavar="COMMAND", required=True)
    for command in [only] if only in _COMMANDS else _COMMANDS:
        module = importlib.import_module(f"modeler.cli.{_COMMANDS[command]}")
        getattr(module, f"add_{command}")(commands)
    return top


def main(argv: Sequence[str] | None = None) -> int:
    """Run one command; the exit status."""
    # Our matrices are small: on a busy machine, waiting for a second thread of the linear algebra
    # tripled the time of `derive panda` (0.4 s to 1.2 s). Before numpy is loaded, by parser().
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    words = sys.argv[1:] if argv is None else list(argv)
    args = parser(words[0] if words else None).parse_args(words)
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
