"""The command line: parse, call, print. The only place that prints.

Exit status: 0 done, 1 the input is at fault (one line on stderr), 2 wrong usage, 130 interrupted.
"""

import os
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse


def build_parser() -> "argparse.ArgumentParser":
    """Builds the parser of all commands."""
    from modeler.cli.parser import build_parser as all_commands

    return all_commands()


def main(argv: Sequence[str] | None = None) -> int:
    """Runs one command and returns the exit status; without `argv`, as the program itself."""
    # Our matrices are small: on a busy machine, waiting for a second thread of the linear algebra
    # tripled the time of `derive panda` (0.4 s to 1.2 s). Before numpy is loaded.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # What Arrow has read a log with is then free for arrays.
    os.environ.setdefault("ARROW_DEFAULT_MEMORY_POOL", "system")
    # Everything that takes time is loaded where an interrupt is expected.
    try:
        from modeler.cli.program import run_in_process, run_program

        return run_program(sys.argv[1:]) if argv is None else run_in_process(argv)
    except KeyboardInterrupt:
        sys.stderr.write("modeler: interrupted\n")
        return 130
    except Exception as error:
        from modeler.core.errors import is_out_of_memory

        if not is_out_of_memory(error):
            raise
        sys.stderr.write(
            "modeler: memory: this process may not have more of it; expected room for all that is "
            "read; raise its limit (ulimit -v), or give parts of the logs: FILE@START:END\n"
        )
        return 1
