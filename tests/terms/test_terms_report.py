"""docs/robots/wrist.md is what the report says today, but for the list of all coefficients."""

import difflib
from pathlib import Path

from modeler.core.files import write_atomically
from modeler.derivation.base_parameters import base_parameters
from modeler.formulas.print_report import terms_report
from tests.terms.cases import model_of

PAGE = Path(__file__).resolve().parents[2] / "docs" / "robots" / "wrist.md"
FIRST, LAST = "## The functions\n", "## All coefficients\n"


def test_page_of_the_wrist_is_current(regenerate):
    model = model_of("wrist")
    report = terms_report(model, base_parameters(model))
    now = FIRST + report.split(FIRST)[1].split(LAST)[0].rstrip() + "\n"
    head, kept = PAGE.read_text(encoding="utf-8").split(FIRST)
    kept = FIRST + kept
    if regenerate:
        write_atomically(PAGE, head + now)
        return
    difference = "".join(
        difflib.unified_diff(
            kept.splitlines(True), now.splitlines(True), "docs/robots/wrist.md", "now"
        )
    )
    assert not difference, f"\n{difference}\nIf this change is meant: pytest --regenerate"
