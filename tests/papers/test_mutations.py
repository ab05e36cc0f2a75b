"""Every number and every relation that is quoted, altered one at a time, must not pass."""

import re
from collections.abc import Iterator
from dataclasses import replace
from itertools import islice

from modeler.papers.paper import read_paper
from modeler.papers.readings import LineVerdict, check_line, expand_legs
from modeler.papers.wrist import collect_coefficient_quotations
from tests.papers.derived_papers import each_paper, robots_of

EVERY = 9
"""Of how many alterations one is tried; which, changes from line to line."""

NUMBERS_ONLY = ("numbers", "arithmetic")
"""Kinds whose quotations are words around numbers."""


def altered(text: str, kind: str) -> Iterator[str]:
    """The text with one thing changed: a digit, a letter's index, a sign, a term left out."""
    for match in re.finditer(r"\d", text):
        if kind in NUMBERS_ONLY and re.search(r"[A-Za-z]\d*$", text[: match.start()]):
            continue
        digit = str((int(match.group()) + 1) % 10)
        yield text[: match.start()] + digit + text[match.end() :]
    if kind in NUMBERS_ONLY:
        return
    for match in re.finditer(r"[+-]", text):
        other = "-" if match.group() == "+" else "+"
        yield text[: match.start()] + other + text[match.end() :]
    for match in re.finditer(r"[A-Z]+", text):
        yield text[: match.start()] + "Q" + text[match.start() + 1 :]
    for match in re.finditer(r" [+-] [^-+=()\[\]]+(?= [+-] |$)", text):
        yield text[: match.start()] + text[match.end() :]


def all_lines(name):
    paper = read_paper(name)
    lines = [*paper.lines, *collect_coefficient_quotations(paper, robots_of(name))]
    return paper, [one for line in lines for one in expand_legs(line)]


@each_paper("hanssen-2000")
def test_every_alteration_of_a_line_is_noticed(name):
    paper, lines = all_lines(name)
    robots, survivors, tried = robots_of(name), [], 0
    for line in lines:
        for text in islice(altered(line.text, line.check), tried % EVERY, None, EVERY):
            changed = replace(line, **{"quote" if line.quote else "consequence": text})
            tried += 1
            if check_line(paper, changed, robots).verdict is not LineVerdict.DIFFERENT:
                survivors.append(f"{line.place}: {text}")
        for index, entry in enumerate(line.assumptions):
            for text in islice(altered(entry, line.check), tried % EVERY, None, EVERY):
                others = (*line.assumptions[:index], text, *line.assumptions[index + 1 :])
                tried += 1
                out = check_line(paper, replace(line, assumptions=others), robots)
                if out.verdict is not LineVerdict.DIFFERENT:
                    survivors.append(f"{line.place}: {line.text}; {text}")
    assert not survivors, "\n".join(survivors)
    assert tried > 5 * len(lines) // EVERY
