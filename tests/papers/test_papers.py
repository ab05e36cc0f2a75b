"""The papers' printed lines beside the derived ones."""

import pytest

from modeler.cli import main
from modeler.papers import Verdict, check_paper, paper_names, read_paper
from modeler.papers.check import Derived, terms_of
from tests.modules import module

MISPRINTS = {"guegan-2003": 0, "briot-2012": 4, "houda": 2, "hanssen-2000": 1}


@pytest.mark.parametrize("name", paper_names())
def test_every_line_is_equal_or_a_known_misprint(name):
    paper = read_paper(name)
    derived = {n: Derived(module(n).base, module(n).model.geometry.values) for n in paper.robots}
    lines = check_paper(paper, derived)
    assert not [line for line in lines if line.verdict is Verdict.DIFFERENT]
    assert sum(line.verdict is Verdict.MISPRINT for line in lines) == MISPRINTS[name]


@pytest.mark.parametrize("name", paper_names())
def test_the_command_ends_well(name, capsys):
    assert main(["reproduce", name]) == 0
    assert "equal" in capsys.readouterr().out


def test_a_line_that_differs_ends_with_status_1(capsys, monkeypatch):
    paper = read_paper("houda")
    import dataclasses

    wrong = dataclasses.replace(paper.counts[1], printed=91)
    changed = dataclasses.replace(paper, counts=(wrong,), relations=())
    monkeypatch.setattr("modeler.cli.reproduce.read_paper", lambda name: changed)
    assert main(["reproduce", "houda"]) == 1
    assert "1 lines are different: 91 base parameters" in capsys.readouterr().err


def test_an_unknown_paper_is_told(capsys):
    assert main(["reproduce", "newton-1687"]) == 1
    assert 'no paper "newton-1687"; expected one of briot-2012' in capsys.readouterr().err


def test_terms_are_read_with_their_coefficients():
    names = {"ZZ2", "M4", "MX3"}
    assert terms_of("ZZ2 + D4**2*M4 - MX3/D4", names) == {
        "ZZ2": "1", "M4": "D4**2", "MX3": "-1/D4",
    }  # fmt: skip
    assert terms_of("ZZ2 - 3.23*MX3", names) == {"ZZ2": "1", "MX3": "-3.23"}
