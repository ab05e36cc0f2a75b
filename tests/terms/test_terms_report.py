"""docs/robots/wrist.md is what the report says today."""

import difflib
from pathlib import Path

from modeler.core.files import write_atomically
from modeler.derivation.base_parameters import base_parameters
from modeler.formulas.print_report import terms_report
from tests.terms.cases import model_of

PAGE = Path(__file__).resolve().parents[2] / "docs" / "robots" / "wrist.md"


def test_page_of_the_wrist_is_current(regenerate):
    model = model_of("wrist")
    page = terms_report(model, base_parameters(model))
    if regenerate:
        write_atomically(PAGE, page)
        return
    kept = PAGE.read_text(encoding="utf-8")
    difference = "".join(
        difflib.unified_diff(
            kept.splitlines(True), page.splitlines(True), "docs/robots/wrist.md", "now"
        )
    )
    assert not difference, f"\n{difference}\nIf this change is meant: pytest --regenerate"
