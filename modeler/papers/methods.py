"""A paper's method run again: what its simulated machine logs, and its tables beside ours."""

import enum
import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import RobotError
from modeler.core.figure import Picture
from modeler.core.json import Document
from modeler.core.table import format_percent
from modeler.papers.paper import Paper
from modeler.papers.quotation import read_numbers
from modeler.regression import Log
from modeler.simulation import SimulatedLog

ZMAX = 4.0
"""A value further from the truth than so many of its sigmas is not the truth's."""

LARGEST = 0.5
"""Sigma over value, above which nothing is recovered: two sigmas reach zero."""


class Outcome(enum.Enum):
    """How a line of a method ends."""

    REPRODUCED = "reproduced"
    RECOVERED = "truth recovered"
    UNDETERMINED = "agrees, but not determined"
    HOLDS = "holds of both"
    DERIVED = "as derived"
    SHOWN = "beside each other"
    FAILED = "NOT reproduced"


@dataclass(frozen=True)
class MethodRow:
    """One line of a table that compares a paper's results with ours.

    Attributes:
        quantity: parameter or figure.
        printed_value: by the paper, or "-".
        computed_value: of the simulation.
        outcome: "truth recovered" where a simulated machine's value is found, whatever the paper
            measured on its own; "agrees, but not determined" where the truth lies within a sigma
            too large to say so; "holds of both" where a statement is true of two numbers that
            differ; "as derived" where we say what the paper does not, or deny what it says;
            "beside each other" where nothing says that the two must agree.
        reason: what was asked of the line, or a remark.
    """

    quantity: str
    printed_value: str
    computed_value: str
    outcome: Outcome
    reason: str = ""


@dataclass(frozen=True)
class MethodTable(Document):
    """One table that compares a paper's results with ours.

    Attributes:
        title: what it is.
        settings: what was simulated, one sentence each.
        rows: its lines.
        picture: a figure of the paper, drawn of the simulation.
    """

    KEYS = "title settings rows"

    title: str
    settings: tuple[str, ...]
    rows: tuple[MethodRow, ...]
    picture: Picture | None = None


def judge_outcome(holds: bool, well: Outcome = Outcome.REPRODUCED) -> Outcome:
    """Returns the outcome `success` if it holds, else FAILED."""
    return well if holds else Outcome.FAILED


def judge_recovery(name: str, printed: str, truth: float, value: float, sigma: float) -> MethodRow:
    """Judges a parameter of known truth: recovered within `ZMAX` of its sigmas.

    It is found only if its sigma is no more than `LARGEST` of the value: with a larger one nearly
    every truth would agree.
    """
    z = (value - truth) / sigma if sigma > 0.0 else float("inf")
    share = sigma / abs(value) if value else float("inf")
    text = f"{value:.5g} +- {sigma:.2g} ({format_percent(share)})"
    why = f"{truth:.5g}, {z:+.1f} sigma"
    if abs(z) >= ZMAX:
        return MethodRow(name, printed, text, Outcome.FAILED, why)
    if share > LARGEST:
        why = f"sigma {format_percent(share)}; {why}"
        return MethodRow(name, printed, text, Outcome.UNDETERMINED, why)
    return MethodRow(name, printed, text, Outcome.RECOVERED, why)


def read_table(paper: Paper, place: str) -> Mapping[str, tuple[float, ...]]:
    """Reads a printed table: {first word of a quotation: the numbers that follow}.

    Raises:
        RobotError: the paper's file quotes no such table.
    """
    rows = {}
    for line in paper.lines:
        word, _, rest = line.quote.partition(" ")
        if line.place == place and re.fullmatch(r"[A-Za-z]\w*", word):
            rows[word] = tuple(float(number.value) for number in read_numbers(rest))
    if not rows:
        raise RobotError(f"paper {paper.name}: its file quotes no {place}")
    return rows


def read_quotation(paper: Paper, start: str) -> tuple[float, ...]:
    """Reads the numbers of the quotation with this start, and of its assumptions.

    Raises:
        RobotError: the paper's file has none.
    """
    for line in paper.lines:
        if line.quote.startswith(start):
            return tuple(
                float(n.value) for n in read_numbers("; ".join((line.quote, *line.assumptions)))
            )
    raise RobotError(f'paper {paper.name}: its file quotes nothing that starts with "{start}"')


# A paper's machine in simulation: its compiled model, and what is logged of its runs.


def build_log(
    run: SimulatedLog, joints: tuple[str, ...], tau: np.ndarray, source: str = "tau{}"
) -> Log:
    """Builds a log of some joints of a simulated run, with torques (samples, joints)."""
    at = [run.joints.index(joint) for joint in joints]
    sources = tuple(source.format(joint) for joint in joints)
    name = f"run{run.settings.seed}"
    return Log(name, joints, run.time, run.q[:, at], tau, torque_source=sources)
