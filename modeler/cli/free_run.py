"""`modeler free-run MODEL LOG...`."""

import argparse
import math
from pathlib import Path

from modeler.api.workflow import read_logs, recompile
from modeler.cli.console import Json, progress, say, working
from modeler.core.errors import DataError
from modeler.estimation.model_file import load_model
from modeler.observation.log import check_apart
from modeler.report.figure_page import write_files
from modeler.validation.controlled import Gains
from modeler.validation.free_run import FreeRunSettings, free_run
from modeler.validation.free_run_result import free_run_pictures


def run_free_run(args: argparse.Namespace) -> Json:
    """Prints the table and the verdict; writes the pictures."""
    asked = FreeRunSettings(args.window, args.bound, _gains(args.controller))
    model = load_model(args.model)
    with working("deriving the robot of the model"):
        compiled = recompile(model)
        logs = read_logs(compiled, args.logs, args.map)
    check_apart(logs, places=args.logs)
    with progress("simulating") as bar:
        found = free_run(model, logs, compiled, asked, bar)
    for line in (*found.summary().splitlines(), *model.warning):
        say(line)
    if args.pictures is not None:
        with progress("drawing pictures") as bar:
            written = write_files(Path(args.pictures), free_run_pictures(found), bar)
        say(f"written: {len(written)} files in {args.pictures}")
    return found.to_json()


def _gains(text: str | None) -> Gains | None:
    """Of `--controller`."""
    if text is None:
        return None
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if not 2 <= len(values) <= 4 or not all(math.isfinite(v) and v >= 0.0 for v in values):
        raise DataError(
            f"--controller {text}: expected two to four numbers that are not negative, as in "
            "20,0.25 or 20,0.25,1,1: speed loop in Hz, ratio of the position loop, integral, "
            "feedforward"
        )
    if values[0] == 0.0 or values[1] == 0.0:
        raise DataError(
            f"--controller {text}: a loop of 0 holds nothing; expected a speed loop and a ratio "
            "above 0"
        )
    speed, ratio, integral, forward = [*values, 0.0, 0.0][:4]
    return speed, ratio, integral, forward
