"""No print is called wrong, and none equal, on the word of one derivation."""

from dataclasses import replace
from itertools import islice

import pytest

from modeler.core.choices import list_papers
from modeler.papers.paper import read_paper
from modeler.papers.readings import LineVerdict, check_line, expand_legs
from modeler.papers.wrist import collect_coefficient_quotations
from tests.papers.derived_papers import each_paper, robots_of
from tests.papers.oracles import holds
from tests.papers.test_mutations import altered

LEAST = {"guegan-2003": 75, "briot-2012": 16, "houda": 45, "hanssen-2000": 87}
"""Lines that the oracles judge."""


@pytest.mark.rotating("long tests of papers")
@each_paper("briot-2012")
def test_every_charge_and_every_equality_is_found_by_other_means(name):
    """About 20 s for all papers."""
    paper, robots = read_paper(name), robots_of(name)
    lines = [*paper.lines, *collect_coefficient_quotations(paper, robots)]
    unproved, refuted, judged = [], [], 0
    for line in (one for quoted in lines for one in expand_legs(quoted)):
        verdict, values = check_line(paper, line, robots).verdict, holds(name, line)
        judged += values is not None
        if verdict is LineVerdict.MISPRINT and values is not False:
            unproved.append(f"{line.place}: {line.text}")
        if verdict not in (LineVerdict.MISPRINT, LineVerdict.DIFFERENT) and values is False:
            refuted.append(f"{line.place}: {line.text}")
        right = replace(line, quote=line.correction, correction="", slip="")
        if line.correction and holds(name, right) is False:
            refuted.append(f"{line.place}: {line.correction}")
    assert unproved == []
    assert refuted == []
    assert judged >= LEAST[name]


UNREADABLE = (ArithmeticError, LookupError, NameError, SyntaxError, TypeError, ValueError)
FORMULAS = tuple(
    """
    closure platform energy rotation element column recursion body velocity applied friction
""".split()
)


@pytest.mark.parametrize("name", list_papers())
def test_the_oracles_notice_what_is_altered(name):
    """An oracle that says yes to everything proves nothing; about 5 s."""
    survivors = []
    for line in read_paper(name).lines:
        if line.check in FORMULAS and holds(name, line):
            every = islice(altered(line.quote, line.check), len(line.quote) % 3, None, 3)
            for text in every:
                try:
                    result = holds(name, replace(line, quote=text))
                except UNREADABLE:
                    result = False
                if result:
                    survivors.append(f"{line.place}: {text}")
    assert survivors == []
