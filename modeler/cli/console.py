"""What every command shares: results on stdout, JSON for machines, progress on stderr."""

import argparse
import io
import json
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext, redirect_stdout
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from modeler.core.files import write_atomically

Json = Any
"""What a command returns for `--json`: dicts, lists, texts, numbers."""


def say(text: str = "") -> None:
    """One result, on stdout."""
    print(text)


def run_command(args: argparse.Namespace) -> None:
    """Run the command of `args`, and write what it returns to the file that `--json` names.

    `args.after`, if there is one, judges the result when all is written.

    "-" is stdout, which then carries the JSON alone.
    """
    with redirect_stdout(io.StringIO()) if args.json == "-" else nullcontext():
        content = args.run(args)
    if args.json is not None:
        text = json.dumps(content, indent=1, allow_nan=False) + "\n"
        if args.json == "-":
            sys.stdout.write(text)
        else:
            write_atomically(Path(args.json), text)
    if hasattr(args, "after"):
        args.after(args)


@contextmanager
def progress(title: str) -> Iterator[Callable[[float], None]]:
    """A bar on stderr while something runs, if stderr is a terminal; call with the share done."""
    console = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    with Progress(
        *columns, console=console, transient=True, disable=not console.is_terminal
    ) as bar:
        task = bar.add_task(title, total=1.0)
        yield lambda share: bar.update(task, completed=share)


@contextmanager
def working(title: str) -> Iterator[None]:
    """A spinner on stderr, if stderr is a terminal."""
    console = Console(stderr=True)
    if not console.is_terminal:
        yield
        return
    with console.status(title):
        yield
