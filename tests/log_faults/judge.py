"""What is said of a log, and whether it is its fault and nothing else."""

import re
from dataclasses import dataclass

import numpy as np

from modeler.api import observe
from modeler.core.errors import ModelerError
from modeler.estimation import find_log_faults, identify, judge_fit
from modeler.regression.log import Log
from tests.log_faults.machines import FaultyLog, open_machine

STATED = re.compile(
    r"end of its range|goes on from there|wraps|\bjumps|\bspike|(?:repeats|keeps) one value"
    r"|holds? each value|(?:late|early), by a fit|low-pass filter with|clock seems|its zero seems"
    r"|the measured torque|look exchanged|looks? like|counted the other way|gravity|clipped"
    r"|links would weigh"
)
"""What states a fault."""


@dataclass(frozen=True)
class Answer:
    """What was said of a log.

    Attributes:
        told: its fault is among what is said.
        false: other faults that are stated as certain, or by which data were changed.
        lines: all that is said of faults.
    """

    told: bool
    false: tuple[str, ...]
    lines: tuple[str, ...]


def ask(log: FaultyLog) -> Answer:
    """Asks what a fit says of a log: of its values, its channels, and what the fit is worth."""
    machine = open_machine(log.machine).compiled
    joints = tuple(joint.name for joint in machine.spec.joints)
    q, tau = (np.column_stack([log.columns[f"{x}{j}"] for j in joints]) for x in ("q", "tau"))
    try:
        seen = observe(machine, [Log("log.csv", joints, log.columns["time"], q, tau)])
        found = find_log_faults(machine, seen)
        verdict = judge_fit(machine, seen, identify(seen, "weighted", machine), found).verdict
    except ModelerError as error:
        return Answer(False, (str(error),), (str(error),))
    mended = seen.report.collect_warnings()
    certain = [w.line for w in found if w.is_certain and "; or: " not in w.line]
    notes = [*seen.report.collect_notes(), *verdict.undetectable_faults]
    warnings = [*(w.line for w in found), *(w.text for w in verdict.warnings)]
    lines = dict.fromkeys([*warnings, verdict.line, *notes])

    def is_true(line: str) -> bool:
        return any(re.search(pattern, line) for pattern in log.patterns)

    sure = [line for line in dict.fromkeys([*mended, *certain]) if STATED.search(line)]
    false = tuple(line for line in sure if not is_true(line))
    told = any(is_true(line) for line in lines)
    return Answer(told, false, tuple(line for line in lines if STATED.search(line)))
