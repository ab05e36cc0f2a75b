"""In robots with loops a law reads the motion of its own joint: said before anything is fitted."""

from pathlib import Path

import pytest

from modeler import api
from modeler.cli import main
from modeler.core.errors import DataError
from modeler.diagnosis import LawAsked


def test_a_law_of_the_load_is_refused_in_loops(tmp_path: Path) -> None:
    log = tmp_path / "run.csv"
    words = ["--duration", "3", "--rate", "100", "--seed", "1", "--out", str(log)]
    assert main(["simulate", "five-bar", *words]) == 0
    model = api.identify(api.load("five-bar"), [log])
    told = "of load: five-bar has loops, and there a law reads the q, v and a of its joint"
    with pytest.raises(DataError, match=told):
        api.add(model, "learned", [log], joint="11", law=LawAsked(("load",)))
