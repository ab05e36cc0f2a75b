"""Derived against printed, line by line."""

import enum
import zlib
from dataclasses import dataclass, replace

from modeler.core.errors import RobotError
from modeler.core.expression import ExpressionError
from modeler.papers.compared import Robots, compare_line
from modeler.papers.paper import Paper, PrintedLine
from modeler.papers.quotation import QuotationError
from modeler.papers.readings import READINGS
from modeler.papers.wrist import collect_coefficient_quotations


class LineVerdict(enum.Enum):
    """How a line stands to what is derived."""

    EQUAL = "printed and equal"
    ROUNDED = "printed and equal to the printed digits"
    MISPRINT = "printed and different"
    CONSISTENT = "printed and consistent, no equality"
    MEASURED = "printed, measured: nothing derives it"
    OURS = "our consequence, not printed"
    UNCHECKED = "not checked"
    DIFFERENT = "DIFFERENT"


@dataclass(frozen=True)
class CheckedLine:
    """One statement and its verdict.

    Attributes:
        robot: that it is about.
        place: in the paper.
        printed: the quotation, or our consequence.
        derived: what is derived.
        verdict: how they stand to each other.
        slip: one of `modeler.papers.paper.SLIPS` where the print is known to differ, or "".
        why: reason of a difference, or a remark.
        corrected: how it should read, which holds; "" if nothing is stated.
    """

    robot: str
    place: str
    printed: str
    derived: str
    verdict: LineVerdict
    slip: str
    why: str
    corrected: str = ""


def check_paper(paper: Paper, derived: Robots) -> list[CheckedLine]:
    """All lines with their verdicts.

    Args:
        paper: as read.
        derived: its robots, by name.
    """
    lines = [*paper.lines, *collect_coefficient_quotations(paper, derived)]
    checked = [check_line(paper, one, derived) for line in lines for one in expand_legs(line)]
    return checked + [
        CheckedLine("", place, "", "", LineVerdict.UNCHECKED, "", why)
        for place, why in paper.unchecked.items()
    ]


def expand_legs(line: PrintedLine) -> list[PrintedLine]:
    """One line for each leg, but for what speaks of all legs together."""
    together = line.check in ("names", "closure")
    return [line] if together else [replace(line, legs=(leg,)) for leg in line.legs]


def check_line(paper: Paper, line: PrintedLine, derived: Robots) -> CheckedLine:
    """The verdict on one line of one leg."""
    try:
        if line.seal and compute_checksum(line) != line.seal:
            raise QuotationError("the numbers are not those that were read from the paper")
        comparison = READINGS[line.check](paper, line, derived)
        equal, exact = compare_line(comparison, line)
        if equal and line.corrected:
            right = replace(line, quote=line.corrected, difference="")
            if not compare_line(READINGS[line.check](paper, right, derived), right)[0]:
                raise QuotationError(f"the corrected form does not hold: {line.corrected}")
    except (QuotationError, ExpressionError, RobotError) as error:
        return _build_checked_line(line, str(error), LineVerdict.DIFFERENT)
    return _build_checked_line(
        line, comparison.text, _classify_line(line, equal, exact, comparison.is_inequality)
    )


def _classify_line(line: PrintedLine, equal: bool, exact: bool, weak: bool) -> LineVerdict:
    if not equal:
        return LineVerdict.DIFFERENT
    if line.ours:
        return LineVerdict.OURS
    if line.slip:
        return LineVerdict.MISPRINT
    if line.measured:
        return LineVerdict.MEASURED
    if weak:
        return LineVerdict.CONSISTENT
    return LineVerdict.EQUAL if exact else LineVerdict.ROUNDED


def _build_checked_line(line: PrintedLine, derived: str, verdict: LineVerdict) -> CheckedLine:
    leg = line.legs[0] if len(line.legs) == 1 else ""
    place = line.place + (f", i = {leg}" if leg else "")
    printed = "; ".join((line.text, *line.given))
    return CheckedLine(
        line.robot, place, printed, derived, verdict, line.slip, line.why, line.corrected
    )


def compute_checksum(line: PrintedLine) -> str:
    """Fingerprint of the quotation, spaces left out."""
    text = "".join("".join((line.quote, *line.given)).split())
    return f"{zlib.crc32(text.encode()):08x}"
