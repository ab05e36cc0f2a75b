"""The table of estimators: complete, told, and refused by name."""

from typing import get_args

import pytest

from docsite.commands import command_pages
from docsite.markdown import cell
from modeler.core.errors import DataError, Method
from modeler.core.estimators import ABOUT, titled
from modeler.estimation.methods import METHODS, capable, method_of
from tests.repository import ROOT


def test_choices_words_and_functions_are_the_same_list():
    assert list(get_args(Method)) == list(ABOUT) == list(METHODS)
    for id, estimator in METHODS.items():
        assert estimator.about.id == id
        assert all(
            (
                estimator.about.law,
                estimator.about.source,
                estimator.about.avoid,
                estimator.about.motion,
            )
        )


def test_an_unknown_method_is_refused_by_name():
    with pytest.raises(DataError, match='method is "magic"; expected weighted'):
        method_of("magic")
    assert titled("weighted") == "weighted least squares" and titled("magic") == "magic"


@pytest.mark.parametrize(
    "of, sentence",
    [
        ("triangles", "method robust reads every row again .* expected weighted or ordinary, or"),
        ("windows", "--method robust: the energy model takes weighted or ordinary; leave out"),
    ],
)
def test_what_an_estimator_does_not_work_on_is_refused(of: str, sentence: str):
    assert capable(of) == ("weighted", "ordinary") and capable("rows") == tuple(METHODS)
    assert method_of("ordinary", of) is METHODS["ordinary"]
    with pytest.raises(DataError, match=sentence):
        method_of("robust", of)


def test_pages_say_what_the_table_says():
    page = (ROOT / "docs" / "explanation" / "estimators.md").read_text("utf-8")
    made = command_pages()["commands/estimators.md"]
    for about in ABOUT.values():
        assert f"`{about.id}`" in page.split("All hand back")[0], about.id
        told = (about.title, about.law, about.source, about.avoid, about.motion)
        assert f"| `{about.id}` | {' | '.join(map(cell, told))} |" in made, about.id
