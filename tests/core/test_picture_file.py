"""Pictures as plain data: back as they were, read strictly, written by every command that draws."""

import dataclasses
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from modeler.cli import main
from modeler.core.errors import DataError
from modeler.core.figure import format_pictures, read_pictures
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
    place.write_text(format_pictures([EVERY_KIND, EVERY_KIND]))
    check_schema("pictures", json.loads(place.read_text()))
    result = read_pictures(place)
    assert len(result) == 2 and same(result[0], EVERY_KIND)


def panel(raw: dict[str, Any]) -> dict[str, Any]:
    return raw["pictures"][0]["panels"][0][0]


SPOILT = {
    "lacks schema": lambda raw: raw.pop("schema"),
    "panels[0][0].series[0].kind is 'pie'": lambda raw: panel(raw)["series"][0].update(kind="pie"),
    "series[0].x is not an array": lambda raw: panel(raw)["series"][0].update(x=["a"]),
    "style is missing": lambda raw: panel(raw)["series"][0].pop("style"),
    "'more' is unknown": lambda raw: panel(raw).update(more=1),
    "rows of different lengths": lambda raw: raw["pictures"][0]["panels"][1].pop(),
}


@pytest.mark.parametrize("text", SPOILT)
def test_what_is_no_such_file_is_refused_in_one_line(tmp_path, text: str) -> None:
    place, raw = tmp_path / "p.json", json.loads(format_pictures([EVERY_KIND]))
    SPOILT[text](raw)
    place.write_text(json.dumps(raw))
    with pytest.raises(DataError) as error:
        read_pictures(place)
    assert text in str(error.value) and str(place) in str(error.value)
    assert "\n" not in str(error.value)


def test_a_file_that_is_not_there_or_no_json_is_refused(tmp_path) -> None:
    (tmp_path / "half.json").write_text('{"schema": ')
    for name in ("none.json", "half.json"):
        with pytest.raises(DataError, match=r"run .* again"):
            read_pictures(tmp_path / name)


LINES = {  # in this order: some read what others write
    "log": "log a.csv --robot emps",
    "fit": "fit emps a.csv --out m.json",
    "compare": "compare m.json b.csv@0:3",
    "diagnose": "diagnose m.json a.csv --holdout b.csv",
    "add": "add m.json spring a.csv --out n.json",
    "free_run": "compare n.json b.csv@0:2 --free-run",
    "contest": "compare m.json n.json b.csv@0:3",
    "fleet": "fleet emps a.csv b.csv",
    "methods": "fit emps a.csv --method weighted,ordinary",
}


@pytest.mark.rotating("long tests of core")
def test_every_command_that_draws_writes_its_pictures(axis, tmp_path, monkeypatch) -> None:
    """Of a machine with a spring that its robot file lacks."""
    monkeypatch.chdir(tmp_path)
    for log in ("a.csv", "b.csv"):
        Path(log).write_bytes((axis / log).read_bytes())
    names = {}
    for what, line in LINES.items():
        place = Path(f"{what}.json")
        assert main([*line.split(), "--picture", str(place)]) == 0, what
        check_schema("pictures", json.loads(place.read_text()))
        names[what] = [picture.name for picture in read_pictures(place)]
        assert len({*names[what]}) == len(names[what])
    assert {"overview", "joint_1_time", "joint_1_residual"} <= {*names["compare"]}
    assert "evidence_spring_1" in names["diagnose"] and "waterfall" in names["add"]
    assert names["contest"] == ["joint_1_models"] and names["free_run"] == ["joint_1_free_run"]
    assert "clock" in names["log"]
