"""From a paper's names to ours."""

import re
from collections.abc import Callable

from modeler.papers.paper import Paper, PrintedLine
from modeler.papers.quotation import Sum, read_sum


def renamer(paper: Paper, line: PrintedLine, leg: str = "") -> Callable[[str], str]:
    """The function from a printed name to ours.

    `i` at the end is the leg; the index of a leg that follows R goes in front of it
    (`ZZ2R1` is our `ZZ21R`); letters that the paper's file names are exchanged, in quotations.
    """

    def rename(name: str) -> str:
        if name.endswith("i") and name != "pi":
            name = name[:-1] + leg
        name = name if line.ours else _exchanged(paper, name)
        name = re.sub(r"^([A-Za-z]+\d+)R(\d)$", r"\1\2R", name)
        if line.strip:
            name = re.sub(rf"^([A-Za-z]+\d){line.strip}(R?)$", r"\1\2", name)
        return name

    return rename


def _exchanged(paper: Paper, name: str) -> str:
    if name in paper.names:
        return paper.names[name]
    letters = re.match(r"[A-Za-z]*", name)
    assert letters is not None
    return paper.names.get(letters.group(), letters.group()) + name[letters.end() :]


def difference_of(line: PrintedLine) -> Sum:
    """Derived minus printed, as the paper's file states it in our names."""
    text = line.difference.replace("{i}", line.legs[0])
    return read_sum(text, str) if text else {}
