"""The table of estimators: complete, reported, and refused by name."""

from typing import get_args

import pytest

from modeler.core.choices import ABOUT, Method, find_estimator_title
from modeler.core.errors import DataError
from modeler.estimation.identify import METHODS, find_method, find_methods
from tests.repository import ROOT
from tests.rotation import with_cases


def test_choices_words_and_functions_are_the_same_list():
    assert list(get_args(Method)) == list(ABOUT) == list(METHODS)
    for id, estimator in METHODS.items():
        assert estimator.about.id == id
        about = estimator.about
        assert all((about.law, about.source, about.limitations, about.motion))


@with_cases(
    "method, of, sentence",
    ("magic", "rows", 'method is "magic"; expected weighted'),
    ("robust", "triangles", "method robust reads every row again .* expected weighted or or"),
    ("robust", "windows", "--method robust: the energy model takes weighted or ordinary; leav"),
)
def test_what_an_estimator_does_not_work_on_is_refused(method, of, sentence):
    assert find_estimator_title("weighted") == "weighted least squares"
    assert find_estimator_title("magic") == "magic"
    assert find_methods(of) == (tuple(METHODS) if of == "rows" else ("weighted", "ordinary"))
    assert find_method("ordinary", of) is METHODS["ordinary"]
    with pytest.raises(DataError, match=sentence):
        find_method(method, of)


def test_the_page_has_a_row_for_each():
    page = (ROOT / "docs" / "explanation" / "estimators.md").read_text("utf-8")
    for id in ABOUT:
        assert f"`{id}`" in page.split("All hand back")[0], id
