"""What every object of a session says of itself: short reprs, summaries, tables, figures, HTML."""

import csv
import dataclasses
import io
import json
import re
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

import modeler.core.result as presented_module
import modeler.views.notebook as notebook
from modeler.api import derive, load, read_logs, write_report
from modeler.core.errors import DataError
from modeler.core.result import Result, find_presentation
from modeler.robot.read import parse_robot_text
from tests.notebook.session import HIDDEN, reached, session
from tests.rotation import rotating, with_cases
from tests.texts import read_pairs

ALWAYS = ("log", "model")
NAMES = (
    *"""
        robot derivation emitted compiled simulated observation report fit better addition
        comparison diagnosis estimators modes contest
    """.split(),
    "free run",
    "motion",
    "physical",
)
EACH = [*ALWAYS, *rotating(*NAMES)]


@pytest.mark.slow
def test_every_object_that_is_reached_prints_one_short_line() -> None:
    values = list(reached(session()))
    assert len({type(thing) for _, thing in values}) > 80  # it went deep
    for way, thing in values:
        line = repr(thing)
        assert len(line) <= 200 and "\n" not in line, f"{way}: make it a Brief: {line[:99]}"


@pytest.mark.parametrize("name", EACH)
def test_a_result_has_a_summary_tables_figures_data_and_files(name: str, tmp_path: Path) -> None:
    thing = session()[name]
    shown = find_presentation(type(thing))
    assert isinstance(thing, Result) and shown is not None
    first, *_ = thing.summary().splitlines()
    assert 10 < len(first) < 250 and "object at 0x" not in thing.summary()
    for table_name in shown.tables(thing):
        table = thing.table(table_name)
        assert len(table.to_text().splitlines()) >= len(table) + 2
        assert table.to_markdown().count("\n") == len(table) + 1
        assert table.to_latex().count(r"\\") >= len(table) + 1
        assert rows_of(table.to_html()) <= 64
    for figure_name in list(shown.figures(thing))[1:2]:
        assert thing.plot(figure_name).axes
    if shown.figures(thing):
        figure = thing.plot()
        png = figure._repr_png_()
        assert figure.axes and png.startswith(b"\x89PNG") and len(png) > 5000
    data = thing.to_dict()
    assert data and json.loads(json.dumps(data, allow_nan=False)) == data
    page = thing.to_html()
    assert page.lower().startswith("<!doctype html>") and "<title>" in page
    assert not re.search(r"(?:src|href)=\"?https?:", page)  # it needs no other file
    assert thing.save(tmp_path / "a.txt").read_text().splitlines()[0] == first
    assert thing.save(str(tmp_path / "a.html")) == tmp_path / "a.html"
    if ".json" not in shown.files:
        assert json.loads(thing.save(tmp_path / "a.json").read_text()) == data
    if shown.tables(thing) and ".csv" not in shown.files:
        table = thing.table()
        written = list(csv.reader(io.StringIO(thing.save(tmp_path / "a.csv").read_text())))
        assert len(written) == len(table) + 1 and len(written[0]) == len(table.columns)
        assert thing.save(tmp_path / "a.md").read_text() == f"{table.to_markdown()}\n"
        assert thing.save(tmp_path / "a.tex").read_text() == f"{table.to_latex()}\n"
    if not shown.tables(thing):
        with pytest.raises(DataError, match="has none"):
            thing.save(tmp_path / "a.csv")
    if "" not in shown.files:
        with pytest.raises(DataError, match=r"a.xyz: got the ending .*; .* is saved as one of .*"):
            thing.save(tmp_path / "a.xyz")


@pytest.mark.rotating("results of the session")
def test_endings_of_their_own_and_figures(tmp_path: Path) -> None:
    made = session()
    assert load(made["robot"].save(tmp_path / "arm.toml")).text == made["robot"].text
    saved = made["model"].save(tmp_path / "arm.model")
    assert load(saved).params.equals(made["model"].params)
    assert load(made["model"].save(tmp_path / "arm.json")).logs == made["model"].logs
    run = made["simulated"].save(tmp_path / "run.parquet")
    assert read_logs(made["compiled"], [run])[0].content == made["log"].content
    for ending, start in ((".png", b"\x89PNG"), (".svg", b"<?xml"), (".pdf", b"%PDF")):
        assert made["model"].save(tmp_path / f"m{ending}").read_bytes().startswith(start)
    assert made["better"].to_dict()["waterfall"][1]["effect"] == HIDDEN.split("@")[0]
    assert made["better"].to_dict()["parameters"] == made["better"].fit.to_json()["parameters"]
    assert made["derivation"].to_dict()["rank"] == made["derivation"].base.rank
    assert write_report(made["robot"], tmp_path / "p.html").read_text() == made["robot"].to_html()
    with pytest.raises(TypeError, match="got a Log, which has no page"):
        write_report(made["log"], tmp_path / "p.html")


@pytest.mark.rotating("results of the session")
def test_what_a_result_does_not_have_is_refused_with_what_it_has() -> None:
    made = session()
    assert "waterfall" in find_presentation(type(made["better"])).figures(made["better"])
    with pytest.raises(DataError, match="a model has no waterfall; expected one of parameters"):
        made["model"].plot("waterfall")
    with pytest.raises(DataError, match="an addition has none"):
        made["addition"].plot()
    with pytest.raises(DataError, match="a comparison has no errrors; expected one of er"):
        made["comparison"].table("errrors")


SHOWN = read_pairs("robot <table derivation $ comparison <table diagnosis mu2 better load_friction")


@with_cases("name", "robot", "derivation", *rotating("better", "comparison", "diagnosis"))
def test_the_html_of_a_notebook_is_small_and_well_formed(name: str) -> None:
    text = session()[name]._repr_html_()
    assert len(text) < 100_000 and rows_of(text) > 0 and SHOWN[name] in text
    assert "http" not in text  # no network


EVIL = '<script>alert("x")</script> & "more"'


def test_what_a_user_wrote_is_escaped() -> None:
    text = load("two-link").text
    title = next(line for line in text.splitlines() if line.startswith("title"))
    robot = parse_robot_text(text.replace(title, f"title = '{EVIL}'"), "evil")
    assert robot.title == EVIL
    for thing in (robot, derive(robot)):
        html = thing._repr_html_()
        assert "<script" not in html and rows_of(html)
    assert "&lt;script&gt;" in robot._repr_html_()


@pytest.mark.rotating("results of the session")
def test_tables_hold_the_numbers_of_the_results() -> None:
    made = session()
    model, comparison, better = made["model"], made["comparison"], made["better"]
    np.testing.assert_array_equal(made["log"].table("data").column("q2"), made["log"].q[:, 1])
    np.testing.assert_array_equal(model.table("parameters").column("value"), model.beta)
    e = np.array(comparison.table("residuals").rows, dtype=object)[:, 2:].astype(float)
    rms = np.sqrt(np.nanmean(e**2, axis=0))
    np.testing.assert_allclose(rms, [item.rms for item in comparison.joints], rtol=1e-12)
    torques = comparison.table("torques")
    for joint in "123":
        measured, predicted = (
            np.array(torques.column(f"{what} {joint}"), dtype=float)
            for what in ("measured", "predicted")
        )
        left = np.array(comparison.table("residuals").column(joint), dtype=float)
        used = np.isfinite(left)
        np.testing.assert_allclose((measured - predicted)[used], left[used])
    errors = better.table("waterfall").column("error")
    assert errors[-1] < 0.3 * errors[0]
    assert better.table("waterfall").column("effect") == ["as fitted", HIDDEN.split("@")[0]]


def test_relations_and_closed_forms_are_latex() -> None:
    derivation = session()["derivation"]
    relations = derivation.relations._repr_latex_()
    assert relations.count("&=") == derivation.base.rank
    assert relations.startswith(r"\begin{align}") and relations.endswith(r"\end{align}")
    for formulas in (derivation.closed_form(), derivation.regressor()):
        latex = formulas._repr_latex_()
        assert latex.count(r"\begin") == latex.count(r"\end") > 0
        assert str(formulas) and formulas.markdown
    base = derivation.table("base")
    assert "| $\\mathit{ZZ}_{1R}$ |" in base.to_markdown()


def test_without_the_room_a_result_says_what_to_import() -> None:
    class Stray(Result):
        """Nobody has said how it is shown."""

    assert Stray()._repr_html_() is None and repr(Stray()) == "Stray()"
    with pytest.raises(DataError, match=r"import modeler\.api"):
        Stray().summary()


def test_every_class_of_a_presentation_prints_short_by_itself() -> None:
    @dataclasses.dataclass(frozen=True)
    class Long(Result):
        values: np.ndarray
        words: tuple[str, ...]
        text: str

    line = repr(Long(np.zeros((7, 3)), ("word",) * 900, "a\nb" * 900))
    assert line.startswith("Long(values=array(7, 3), words=<900 items>, text='a\\nb")
    assert len(line) < 200 and "\n" not in line


def rows_of(text: str) -> int:
    """Rows of all tables of well-formed HTML, which has no tags but those of tables and text."""
    tags = [element.tag for element in ElementTree.fromstring(f"<html>{text}</html>").iter()][1:]
    assert {*tags} <= {"p", "b", "table", "caption", "thead", "tbody", "tr", "th", "td"}
    return tags.count("tr")


def test_what_is_shown_later_is_loaded_under_its_name(monkeypatch: pytest.MonkeyPatch) -> None:
    """A name that no class has would never be looked up."""
    later: dict[str, Callable[[], None]] = {}
    monkeypatch.setattr(presented_module, "_LATER", later)
    monkeypatch.setattr(presented_module, "_PRESENTATIONS", table := {})
    notebook.register_report_modules()
    assert later and not table
    for say in {*later.values()}:
        say()
    assert {kind.__name__ for kind in table} == later.keys()
