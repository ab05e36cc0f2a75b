"""Pictures as plain data: back as they were, read strictly, written by every command that draws."""

import dataclasses
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from modeler.cli import main
from modeler.core.errors import DataError
from modeler.core.picture_file import pictures_from_json, pictures_text
from tests.json_schemas import check_schema
from tests.studio.drawn import EVERY_KIND


def same(one: Any, other: Any) -> bool:
    """Alike to the last bit, NaN equal to NaN."""
    if isinstance(one, np.ndarray):
        return isinstance(other, np.ndarray) and np.array_equal(one, other, equal_nan=True)
    if dataclasses.is_dataclass(one):
        return type(one) is type(other) and same(vars(one), vars(other))
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(same(one[key], other[key]) for key in one)
    if isinstance(one, tuple | list):
        return len(one) == len(other) and all(map(same, one, other))
    return bool(one == other)


def test_pictures_come_back_as_they_were(tmp_path) -> None:
    place = tmp_path / "p.json"
    place.write_text(pictures_text([EVERY_KIND, EVERY_KIND]))
    check_schema("pictures", json.loads(place.read_text()))
    found = pictures_from_json(place)
    assert len(found) == 2 and same(found[0], EVERY_KIND)


def spoilt(change: str) -> str:
    raw = json.loads(pictures_text([EVERY_KIND]))
    panel = raw["pictures"][0]["panels"][0][0]
    if change == "schema":
        del raw["schema"]
    elif change == "kind":
        panel["series"][0]["kind"] = "pie"
    elif change == "array":
        panel["series"][0]["x"] = ["a"]
    elif change == "missing":
        del panel["series"][0]["style"]
    elif change == "unknown":
        panel["more"] = 1
    elif change == "ragged":
        raw["pictures"][0]["panels"][1].pop()
    return json.dumps(raw)


@pytest.mark.parametrize(
    ("change", "told"),
    [("schema", "lacks schema"), ("kind", "panels[0][0].series[0].kind is 'pie'"),
     ("array", "series[0].x is no array"), ("missing", "style is missing"),
     ("unknown", "'more' is unknown"), ("ragged", "rows of different lengths")],
)  # fmt: skip
def test_what_is_no_such_file_is_refused_in_one_line(tmp_path, change: str, told: str) -> None:
    place = tmp_path / "p.json"
    place.write_text(spoilt(change))
    with pytest.raises(DataError) as error:
        pictures_from_json(place)
    assert told in str(error.value) and str(place) in str(error.value)
    assert "\n" not in str(error.value)


def test_a_file_that_is_not_there_or_no_json_is_refused(tmp_path) -> None:
    for place, text in ((tmp_path / "none.json", None), (tmp_path / "half.json", '{"schema": ')):
        if text is not None:
            place.write_text(text)
        with pytest.raises(DataError, match=r"run .* again"):
            pictures_from_json(place)


def test_every_command_that_draws_writes_its_pictures(tmp_path, monkeypatch) -> None:
    """Of a machine with a spring that its robot file lacks."""
    monkeypatch.chdir(tmp_path)
    hidden = ("--hide", "spring:stiffness=40,rest=0.1", "--rate", "250", "--duration", "8")
    for log, seed in (("a.csv", "1"), ("b.csv", "2")):
        assert main(["simulate", "emps", *hidden, "--seed", seed, "--out", log]) == 0
    lines = {
        "log": ("log", "a.csv", "--robot", "emps"),
        "fit": ("fit", "emps", "a.csv", "--out", "m.json"),
        "compare": ("compare", "m.json", "b.csv"),
        "free_run": ("compare", "n.json", "b.csv", "--free-run"),
        "contest": ("compare", "m.json", "n.json", "b.csv"),
        "diagnose": ("diagnose", "m.json", "a.csv", "--holdout", "b.csv"),
        "add": ("add", "m.json", "spring", "a.csv", "--out", "n.json"),
        "fleet": ("fleet", "emps", "a.csv", "b.csv"),
        "methods": ("fit", "emps", "a.csv", "--method", "weighted,ordinary"),
    }  # fmt: skip
    names = {}
    for what in (
        "log",
        "fit",
        "compare",
        "diagnose",
        "add",
        "free_run",
        "contest",
        "fleet",
        "methods",
    ):
        place = Path(f"{what}.pictures.json")
        assert main([*lines[what], "--picture", str(place)]) == 0, what
        check_schema("pictures", json.loads(place.read_text()))
        found = [picture.name for picture in pictures_from_json(place)]
        assert len(set(found)) == len(found)
        names[what] = found
    assert {"overview", "joint_1_time", "joint_1_residual"} <= set(names["compare"])
    assert "evidence_spring_1" in names["diagnose"] and "waterfall" in names["add"]
    assert names["contest"] == ["joint_1_models"] and names["free_run"] == ["joint_1_free_run"]
    assert "clock" in names["log"]
    assert main(["fit", "emps", "a.csv", "--out", "m.json", "--picture", "drawn"]) == 0
    drawn = {place.stem for place in Path("drawn").iterdir()}
    assert drawn == set(names["fit"])


def test_no_model_is_replaced_by_its_pictures(tmp_path, monkeypatch, capsys) -> None:
    monkeypatch.chdir(tmp_path)
    Path("m.json").write_text("{}")
    Path("a.csv").write_text("time,q1,tau1\n")
    assert main(["compare", "m.json", "a.csv", "--picture", "m.json"]) == 1
    assert "--picture m.json: this is the model that is read" in capsys.readouterr().err
    assert Path("m.json").read_text() == "{}"
