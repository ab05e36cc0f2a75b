"""Quotations against the papers' own text, letter by letter.

The papers are not part of the project; without them this is skipped.
"""

import re
from pathlib import Path

import pytest

from modeler.core.choices import list_papers
from modeler.papers.paper import read_paper
from modeler.papers.wrist import collect_coefficient_quotations
from tests.papers.derived_papers import robots_of

PAPERS = Path(__file__).resolve().parents[3] / "shared" / "papers"
FILES = {
    "guegan-2003": "guegan-2003-orthoglide-identification.txt",
    "briot-2012": "briot-2012-orthoglide-drive-gains.txt",
    "houda": "houda-evra-simulator.txt",
    "hanssen-2000": "hanssen-abb-wrist.txt",
}
LARGEST = 420
"""Letters of the longest quotation: the longest relation of a paper, never a passage."""


def squeezed(text: str) -> str:
    """Letters, digits and signs alone; what typesetting adds is gone."""
    text = re.sub(r"</?sub>", "", text).replace("₃", "3").replace("×", "x").replace("±", "pm")
    text = text.replace("g_{ au", "g_{tau")  # the text has lost the t of \tau
    text = re.sub(r"\\(?:left|right|mathbf|mathbb|text|hat|cdot|begin|end|split)", "", text)
    text = text.replace(r"\times", "x").replace("bmatrix", "").replace(r"\quad", "")
    group = r"\{((?:[^{}]|\{[^{}]*\})*)\}"
    for _ in range(3):
        text = re.sub(rf"\\frac{group}{group}", r"\1/\2", text)
    text = re.sub(r"\\dot\{(\w)\}", r"\1d", text)
    text = text.replace("sum_i=1^3", "sumi").replace(",k}", "}")
    text = text.replace(r"\sum_{i=1}^3", "sumi").replace("sum_i", "sumi")
    text = re.sub(r"[\s\\{}_$&|;]", "", text.replace("**", "^")).replace("*", "")
    return re.sub(r"\^(?=[abc][A-Za-z])", "", text)  # raised in front: the body of a letter


@pytest.mark.parametrize("name", list_papers())
def test_every_quotation_stands_in_the_paper(name):
    if not PAPERS.is_dir():
        pytest.skip(f"NOT CHECKED: the papers are not here: {PAPERS.parent.name}/{PAPERS.name}")
    text = squeezed((PAPERS / FILES[name]).read_text(encoding="utf-8"))
    paper = read_paper(name)
    quotes = [q for line in paper.lines if line.quote for q in (line.quote, *line.assumptions)]
    assert [q for q in quotes if squeezed(q) not in text] == []


def test_coefficient_functions_stand_in_the_paper():
    """Fractions are typeset otherwise and S223 is in a list of zeros: these are left out."""
    if not PAPERS.is_dir():
        pytest.skip(f"NOT CHECKED: the papers are not here: {PAPERS.parent.name}/{PAPERS.name}")
    name = "hanssen-2000"
    text = unbracketed((PAPERS / FILES[name]).read_text(encoding="utf-8"))
    lines = collect_coefficient_quotations(read_paper(name), robots_of(name))
    quotes = [line.quote for line in lines if line.check in ("definition", "function", "solution")]
    lost = [q for q in quotes if unbracketed(q) not in text and " over " not in q and "/2" not in q]
    assert lost == ["S223 = 0"]


def unbracketed(text):
    return re.sub(r"[()]", "", squeezed(text))


def test_every_quotation_is_short():
    lines = [line for name in list_papers() for line in read_paper(name).lines]
    lines += collect_coefficient_quotations(read_paper("hanssen-2000"), robots_of("hanssen-2000"))
    assert [line.quote for line in lines if len(line.quote) > LARGEST] == []
