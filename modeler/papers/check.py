"""Derived against printed, line by line."""

import enum
import zlib
from dataclasses import dataclass, replace

from modeler.core.errors import RobotError
from modeler.core.expression import ExpressionError
from modeler.papers.compared import Robots, same
from modeler.papers.paper import Paper, PrintedLine
from modeler.papers.quotation import QuotationError
from modeler.papers.readings import READINGS
from modeler.papers.wrist import coefficient_quotations


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
class Line:
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


def check_paper(paper: Paper, derived: Robots) -> list[Line]:
    """All lines with their verdicts.

    Args:
        paper: as read.
        derived: its robots, by name.
    """
    lines = [*paper.lines, *coefficient_quotations(paper, derived)]
    checked = [check_line(paper, one, derived) for line in lines for one in written_out(line)]
    return checked + [
        Line("", place, "", "", LineVerdict.UNCHECKED, "", why)
        for place, why in paper.unchecked.items()
    ]


def written_out(line: PrintedLine) -> list[PrintedLine]:
    """One line for each leg, but for what speaks of all legs together."""
    together = line.check in ("names", "closure")
    return [line] if together else [replace(line, legs=(leg,)) for leg in line.legs]


def check_line(paper: Paper, line: PrintedLine, derived: Robots) -> Line:
    """The verdict on one line of one leg."""
    try:
        if line.seal and seal_of(line) != line.seal:
            raise QuotationError("the numbers are not those that were read from the paper")
        found = READINGS[line.check](paper, line, derived)
        equal, exact = same(found, line)
        if equal and line.corrected:
            right = replace(line, quote=line.corrected, difference="")
            if not same(READINGS[line.check](paper, right, derived), right)[0]:
                raise QuotationError(f"the corrected form does not hold: {line.corrected}")
    except (QuotationError, ExpressionError, RobotError) as error:
        return _line(line, str(error), LineVerdict.DIFFERENT)
    return _line(line, found.text, _verdict(line, equal, exact, found.weak))


def _verdict(line: PrintedLine, equal: bool, exact: bool, weak: bool) -> LineVerdict:
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


def _line(line: PrintedLine, derived: str, verdict: LineVerdict) -> Line:
    leg = line.legs[0] if len(line.legs) == 1 else ""
    place = line.place + (f", i = {leg}" if leg else "")
    printed = "; ".join((line.text, *line.given))
    return Line(line.robot, place, printed, derived, verdict, line.slip, line.why, line.corrected)


def seal_of(line: PrintedLine) -> str:
    """Fingerprint of the quotation, spaces left out."""
    text = "".join("".join((line.quote, *line.given)).split())
    return f"{zlib.crc32(text.encode()):08x}"
