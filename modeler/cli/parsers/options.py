"""What the parsers of several commands share."""

import argparse
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from modeler.cli.places import JsonFile, MapWord, Output, RobotFile, Word

if TYPE_CHECKING:
    Commands = argparse._SubParsersAction[argparse.ArgumentParser]
else:
    Commands = Any

Run = Callable[[argparse.Namespace], Any]
"""A command: from its arguments to what `--json` writes."""


def add_number(
    parser: argparse._ActionsContainer,
    option: str,
    metavar: str,
    kind: type[float] | type[int],
    text: str,
    default: float | None = None,
) -> None:
    """An option that takes a number; its help tells the default if there is one."""
    told = text if default is None else f"{text} (default %(default)s)"
    parser.add_argument(option, metavar=metavar, type=kind, default=default, help=told)


def add_several(
    parser: argparse._ActionsContainer,
    option: str,
    metavar: str,
    kind: type[str],
    text: str,
    dest: str | None = None,
) -> None:
    """An option that takes several words, and may be repeated; see `words` on where it ends."""
    parser.add_argument(
        option, metavar=metavar, nargs="+", action="extend", default=[], type=kind,
        dest=dest or option.lstrip("-").replace("-", "_"),
        help=f"{text}; all words up to the next option or --; may be repeated",
    )  # fmt: skip


def add_robot(parser: argparse.ArgumentParser) -> None:
    """The ROBOT argument and what changes it."""
    parser.add_argument(
        "robot", metavar="ROBOT", type=RobotFile,
        help="a robot file, or the name of a built-in robot",
    )  # fmt: skip
    add_effects(parser)


def add_effects(parser: argparse.ArgumentParser) -> None:
    """`--effects LIST`, which changes ROBOT."""
    parser.add_argument(
        "--effects",
        metavar="LIST",
        type=Word,
        help='effects instead of those of the file, for all joints: "viscous,coulomb"; "" for none',
    )


def add_json(parser: argparse.ArgumentParser, text: str) -> None:
    """`--json FILE`, which every command has."""
    parser.add_argument("--json", metavar="FILE", type=JsonFile, help=f"{text}; - for stdout")


def add_map(parser: argparse._ActionsContainer) -> None:
    """`--map`, which every command has that takes logs."""
    parser.add_argument(
        "--map", metavar="NAME=COLUMN[:UNIT]", action="append", default=[], type=MapWord,
        help="which column of the logs is ours, as 'q<j>=position_{j}:deg', or FILE.toml with such "
        "lines; may be given several times; over [log] of the robot file",
    )  # fmt: skip


def add_page(parser: argparse.ArgumentParser, kind: type[Output] = Output) -> None:
    """`--report PAGE.html`, which may be called `--page` as `derive` and `log` call it."""
    parser.add_argument(
        "--report", "--page", metavar="PAGE.html", type=kind, help="write one self-contained page"
    )


def add_dask(parser: argparse._ActionsContainer) -> None:
    """`--dask`, of commands that read much."""
    parser.add_argument(
        "--dask", metavar="ADDRESS", type=Word,
        help="a Dask scheduler whose workers read the logs, as tcp://host:8786; local: a cluster "
        "of this machine's processors",
    )  # fmt: skip


def add_force(parser: argparse.ArgumentParser) -> None:
    """`--force`, for commands that write folders of code."""
    parser.add_argument(
        "--force", action="store_true",
        help="write also over files of DIR that no earlier run wrote, or that were edited since",
    )  # fmt: skip
