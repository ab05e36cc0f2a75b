"""The papers' identifications, run again."""

import json
import re

import numpy as np
import pytest

from modeler.cli import main
from modeler.cli.demonstrations import METHODS
from modeler.core.choices import list_papers
from modeler.core.errors import RobotError
from modeler.papers import methods
from modeler.papers.paper import read_paper
from tests.json_schemas import check_schema
from tests.rotation import slow_rotating, with_cases

TITLES = {
    "guegan-2003": "Blocks; Table 2; The direction; Table 3; Condition; The exciting",
    "briot-2012": "Table 3; Figure 3; The second load",
    "houda": "Table 1; Table 1; The energy model",
    "hanssen-2000": "Eq. (3); Persistent excitation; Two steps; Figure 2; Physical",
}


def test_every_paper_has_its_method():
    assert set(METHODS) == set(list_papers())


@slow_rotating("identifications of papers")
@pytest.mark.parametrize("name", list_papers())
def test_every_identification_is_reproduced(name, capsys, tmp_path):
    place = tmp_path / "methods.json"
    drawn = ["--picture", str(tmp_path / "drawn.json")] if name == "hanssen-2000" else []
    assert main(["reproduce", name, "--section", "methods", "--json", str(place), *drawn]) == 0
    if drawn:
        check_figure_2(json.loads((tmp_path / "drawn.json").read_text()))
    assert "[truth recovered]" in capsys.readouterr().out
    result = json.loads(place.read_text())
    assert "lines" not in result
    titles = [table["title"] for table in result["methods"]]
    starts = TITLES[name].split("; ")
    assert all(t.startswith(s) for t, s in zip(titles, starts, strict=True))
    rows = [row for table in result["methods"] for row in table["rows"]]
    assert sum(row["outcome"] == "truth recovered" for row in rows) >= 7
    for row in rows:
        share = re.search(r"\(([\d.e+]+) %\)$", row["computed_value"])
        if row["outcome"] == "truth recovered":
            assert share is not None and float(share[1]) <= 50, row


def check_figure_2(result):
    """The measured torque is noisy about the modelled one, which is none where the axis stands."""
    check_schema("pictures", result)
    ((left, right),) = result["pictures"][0]["panels"]
    measured, modelled = ([np.nan if y is None else y for y in s["y"]] for s in left["series"])
    off = np.subtract(measured, modelled)
    known = ~np.isnan(off)
    assert 0.3 < known.mean() < 0.99 and np.std(off[known]) < 0.05 * np.std(measured)
    position, speed, acceleration = (np.array(s["y"]) for s in right["series"])
    time = np.array(right["series"][0]["x"])
    assert np.abs(speed[~known]).max() < 0.2 < np.abs(speed[known]).max()
    assert np.ptp(position) == pytest.approx(2.0, abs=0.05)
    slope = np.gradient(speed, time)[5:-5] - acceleration[5:-5]
    assert np.std(slope) < 0.1 * np.std(acceleration)


@with_cases(
    "words, message",
    (("hanssen-2000", "--section", "print"), "figures are of the methods"),
    (("guegan-2003", "--section", "methods"), "guegan-2003 has no figure to draw; leave it"),
)
def test_a_picture_that_is_not_there_is_refused(capsys, monkeypatch, tmp_path, words, message):
    monkeypatch.setitem(METHODS, "guegan-2003", lambda paper, report: [])
    assert main(["reproduce", *words, "--picture", str(tmp_path / "p")]) == 1
    assert message in capsys.readouterr().err


def test_a_method_that_fails_ends_with_status_1(capsys, monkeypatch):
    row = methods.MethodRow("MPR", "1.5", "2.5", methods.Outcome.FAILED)
    table = methods.MethodTable("Table 3", (), (row,))
    monkeypatch.setitem(METHODS, "guegan-2003", lambda paper, report: [table])
    assert main(["reproduce", "guegan-2003", "--section", "methods"]) == 1
    out, err = capsys.readouterr()
    assert "NOT reproduced" in out
    assert "1 line is different: Table 3: MPR" in err


def test_a_value_far_from_the_truth_is_not_recovered():
    assert methods.judge_recovery("M", "1", 1.0, 1.3, 0.1).outcome is methods.Outcome.RECOVERED
    assert methods.judge_recovery("M", "1", 1.0, 1.5, 0.1).outcome is methods.Outcome.FAILED
    assert methods.judge_recovery("M", "1", 1.0, 1.0, 0.0).outcome is methods.Outcome.FAILED
    assert methods.judge_recovery("M", "1", 9.0, 1.0, 0.63).outcome is methods.Outcome.FAILED
    # nor one whose sigma is more than half of it: one rule for all papers, for a truth of 0 too
    assert methods.judge_recovery("M", "1", 1.0, 1.0, 0.49).outcome is methods.Outcome.RECOVERED
    assert methods.judge_recovery("M", "1", 1.0, 1.0, 0.63).reason.startswith("sigma 63 %")
    for truth, value, sigma in ((1.0, 1.0, 0.63), (0.0, 0.0, 0.1), (0.0, 0.01, 0.01)):
        judged = methods.judge_recovery("M", "1", truth, value, sigma)
        assert judged.outcome is methods.Outcome.UNDETERMINED


def test_the_truth_of_a_simulation_is_read_from_the_quotations():
    paper = read_paper("guegan-2003")
    assert methods.read_table(paper, "Table 3")["MRP"] == (1.5993, 1.2601)
    assert methods.read_quotation(paper, "65814 x 13") == (65814.0, 13.0)
    with pytest.raises(RobotError, match="quotes no Table 9"):
        methods.read_table(paper, "Table 9")
    with pytest.raises(RobotError, match='quotes nothing that starts with "66"'):
        methods.read_quotation(paper, "66")
