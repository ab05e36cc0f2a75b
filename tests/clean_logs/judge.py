"""What `modeler` prints of a log without a fault, and which of its lines are wrong."""

import contextlib
import io
import re
import warnings
from pathlib import Path

from modeler.cli import main
from tests.clean_logs.machines import Truth

COMMANDS = (
    ("log", "train.parquet", "--robot", "robot.toml"),
    ("fit", "robot.toml", "train.parquet", "--out", "model.json"),
    ("compare", "model.json", "holdout.parquet"),
)

# What is said of a fault. None of these machines has one.
FAULTS = (
    r"clipped",
    r"\bleap|\bjumps\b",
    r"repeats one value",
    r"another zero",
    r"\bzero (?:of|seems|is off)",
    r"\brings?\b",
    r"frozen",
    r"(?:at|reaches) its limit",
    r"\bsign\b.*(?:wrong|opposite|turned)",
    r"\bunit\b",
    r"joined",
    r"swapped|exchanged",
    r"is off by a factor",
    r"clock (?:seems|is wrong)",
    r"spike|outlier",
    r"\blate by|comes late|\bdelayed by",
    r"is it connected",
    r"damaged",
    r"not the derivative",
    r"rows (?:were )?lost",
    r"never moves?",
    r"Traceback",
    r"RuntimeWarning",
    r"computed from|planned or",
)
HARMLESS = re.compile(
    r"^(?:channel|parameter|Not detectable)\b|no warnings|doubtful$|where the sign of the speed|"
    r"--keep-damaged uses"
)
"""Headings, what could not be seen, what an option would do."""


def print_all(folder: Path) -> list[str]:
    """Every line that the commands print of a machine, each with its command ahead."""
    lines = []
    for command in COMMANDS:
        said = io.StringIO()
        with (
            contextlib.chdir(folder),
            contextlib.redirect_stdout(said),
            contextlib.redirect_stderr(said),
            warnings.catch_warnings(record=True) as warned,
        ):
            warnings.simplefilter("always")
            status = main(command)
        lines += [f"{command[0]}: {line}" for line in said.getvalue().splitlines() if line.strip()]
        lines += [f"{command[0]}: {one.category.__name__}: {one.message}" for one in warned]
        if status not in (0, 3):
            lines.append(f"{command[0]}: exit status {status}")
    return lines


def find_wrong_lines(lines: list[str], truth: Truth) -> list[str]:
    """The lines that say what is not so."""
    wrong = []
    for line in lines:
        command, _, said = line.partition(": ")
        if command == "log" and re.match(r"^(?:q|qd|qc|tau)\d+ ", said):
            wrong += _wrong_row(said, truth, line)
        elif "gaps" in truth.ways and "clock time" in said:
            continue
        elif "holds each value" in said or "hold each value" in said:
            named = set(re.findall(r"\b(?:q|qd|qc|tau)\d+\b", said))
            wrong += [] if named <= truth.held.keys() else [line]
        elif not HARMLESS.search(said) and any(re.search(fault, said) for fault in FAULTS):
            wrong.append(line)
    return wrong


def _wrong_row(said: str, truth: Truth, line: str) -> list[str]:
    """A row of the table of channels: its resolution, if one is stated, is right."""
    cells = said.split()
    step = truth.steps.get(cells[0])
    stated = next((cell for cell in cells[4:5] if re.fullmatch(r"[\d.][\d.e-]*", cell)), None)
    if step and stated and not 0.5 < float(stated) / step < 2.1:
        return [line]
    return [line] if any(re.search(fault, said) for fault in FAULTS[:6]) else []
