"""Pages of a fit, of effects added and of models side by side, from the command line."""

import dataclasses
import json
import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from modeler.estimation.model_file import IdentifiedModel, load_model
from modeler.views import history
from modeler.views.fit import find_correlated_pairs
from modeler.views.page import write_page
from tests.captions import assert_all_named
from tests.cli.inputs import folder_after
from tests.cli.running import answer, complaint
from tests.rotation import with_cases


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A demonstration arm with a spring that its file lacks, before (a) and after (b) adding it."""
    simulate = "simulate demo-arm --hide spring@3 --duration 10 --rate 250"
    return folder_after(
        tmp_path_factory.mktemp("models"),
        f"{simulate} --seed 4 --out {{0}}/train.parquet",
        f"{simulate} --seed 5 --out {{0}}/other.parquet",
        "fit demo-arm {0}/train.parquet --out {0}/a.json --report {0}/fit.html",
        "add {0}/a.json spring --joint 3 {0}/train.parquet --holdout {0}/other.parquet "
        "--out {0}/b.json --report {0}/improved.html",
        "compare {0}/a.json {0}/b.json {0}/other.parquet --report {0}/c.html --json {0}/c2.json",
    )


@pytest.fixture(scope="module")
def before(folder: Path) -> IdentifiedModel:
    return load_model(folder / "a.json")


@pytest.fixture(scope="module")
def after(folder: Path) -> IdentifiedModel:
    return load_model(folder / "b.json")


def words_of(page: Path) -> str:
    body = re.sub(r"<(script|style)\b.*?</\1>", " ", page.read_text("utf-8"), flags=re.DOTALL)
    return " ".join(re.sub(r"<[^>]*>", " ", body).split())


@pytest.mark.rotating("long tests of pages")
def test_two_models_are_told_apart_where_one_has_the_spring(folder: Path) -> None:
    result = json.loads((folder / "c2.json").read_text())
    first, second = result["models"]
    assert result["relative_error"] == first["relative_error"]  # the contract's fields: model one
    assert (first["model"], second["model"]) == ("a.json", "b.json")
    assert "3" in second["best_joints"] and first["best_joints"] == []
    for joint, item in result["joints"].items():
        assert item["relative_error"] == pytest.approx(first["joints"][joint]["relative_error"])
    text = words_of(folder / "c.html")
    assert "b.json predicts joint" in text and "2 models side by side" in text


@pytest.mark.rotating("long tests of pages")
def test_the_order_of_models_and_logs_is_free(folder: Path, tmp_path: Path, capsys) -> None:
    """A model by what stands in it, whatever its name; the table has a column for each."""
    other = shutil.copy(folder / "b.json", tmp_path / "copy.of_b")
    out = answer(capsys, "compare", folder / "a.json", folder / "other.parquet", other)
    assert out.split()[:4] == ["joint", "a", "copy.of_b", "unit"]


@pytest.fixture(scope="module")
def scara(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A log and a model of a robot of which three joints turn and one slides."""
    return folder_after(
        tmp_path_factory.mktemp("scara"),
        "simulate scara --duration 6 --rate 200 --out {0}/log.parquet",
        "fit scara {0}/log.parquet --out {0}/m.json --json {0}/fit.json",
    )


@with_cases(
    "words, message",
    ("a.json b.json", "got models only; expected a log too"),
    ("a.json a.json other.parquet", "got this model twice"),
    ("a.json {scara}/m.json other.parquet", "expected those of"),
    ("a.json b.json other.parquet other.parquet", "give each row once"),
)
def test_what_cannot_be_set_side_by_side(folder, scara, monkeypatch, capsys, words, message):
    monkeypatch.chdir(folder)
    assert message in complaint(capsys, "compare", *words.format(scara=scara).split())


def test_newtons_and_newton_metres_are_told_apart(scara: Path, capsys) -> None:
    """Each unit has an error of its own."""
    words = f"{scara}/m.json {scara}/log.parquet --report {scara}/c.html --json {scara}/c.json"
    out = answer(capsys, "compare", *words.split())
    assert "of the torques (N m)" in out and "of the forces (N)" in out
    assert "of the force is unexplained" in out
    compared, fitted = (json.loads((scara / f"{n}.json").read_text()) for n in ("c", "fit"))
    assert set(compared["by_unit"]) == {"N m", "N"} and "pools" in compared["relative_error_pools"]
    assert set(fitted["by_unit"]) == {"N m", "N"}
    for unit, error in fitted["by_unit"].items():
        items = [j for j in fitted["joints"].values() if j["unit"] == unit]
        left = sum(j["rows"] * j["rms"] ** 2 for j in items)
        size = sum(j["rows"] * (j["rms"] / j["relative_error"]) ** 2 for j in items)
        assert error == pytest.approx(np.sqrt(left / size))
    head = re.search(r'class="headline">(.*?)</p>', (scara / "c.html").read_text(), re.DOTALL)
    assert head is not None and "of the torque and" in head[1] and "of the force" in head[1]


def test_the_page_of_a_fit_has_values_sums_and_doubts(folder: Path, before) -> None:
    text = words_of(folder / "fit.html")
    for parameter in before.fit.parameters:
        assert f"{parameter.name} {parameter.value:.5g} {parameter.sigma:.2g}" in text
    for base in before.spec.base:
        assert history.format_relation(base) in text
    verdict = before.fit.verdict
    assert verdict is not None and verdict.line in text
    assert f"{before.fit.condition_number:.4g}" in text
    assert "modeler compare" in text
    lines = re.findall(
        r"<li>(.*?)</li>", (folder / "fit.html").read_text().partition("How this was made")[2]
    )
    assert "train.parquet" in lines[0] and all(len(line) > 20 for line in lines)


def test_a_sum_is_the_base_parameter(before) -> None:
    """Evaluated with random standard parameters it is what the numbers of the terms give."""
    random = np.random.default_rng(2)
    spec = before.spec
    values = {p.name: float(random.normal()) for p in spec.standard}
    values |= {symbol.name: symbol.value for symbol in spec.symbols}
    summed = 0
    for base in spec.base:
        if history.format_relation(base):
            by_terms = sum(term.value * values[term.parameter] for term in base.terms)
            assert eval(history.format_relation(base), {}, values) == pytest.approx(by_terms)
            summed += 1
    assert summed > 5


def test_tangled_parameters_are_those_of_the_covariance(after) -> None:
    for one, other, value in find_correlated_pairs(after):
        names = [p.name for p in after.fit.parameters]
        i, j = names.index(one), names.index(other)
        covariance = after.covariance
        actual = covariance[i, j] / np.sqrt(covariance[i, i] * covariance[j, j])
        assert value == pytest.approx(actual) and abs(actual) > 0.95


def test_the_page_of_additions_has_every_joint_and_value(folder, after, tmp_path) -> None:
    text = words_of(folder / "improved.html")
    last = after.history[-1]
    added = next(p for p in after.fit.parameters if p.name == "Ks3")
    assert f"Ks3 {added.value:.5g}" in text and "N m/rad" in text
    for name, (start, end) in last.joints.items():
        assert start == pytest.approx(after.history[0].joints[name][1])
        assert end <= 1.05 * start
    assert "as fitted + spring @3" in text
    refused = ["left out: backlash, joint 2 (the error does not fall (no joint changes))"]
    page = write_page(tmp_path / "page.html", history.build_history_page(after, refused))
    assert "backlash, joint 2: the error does not fall (no joint changes)" in words_of(page)


def test_captions_of_waterfalls_name_their_colours(after) -> None:
    units = {joint.name: joint.effort_unit for joint in after.spec.joints}
    assert_all_named(history.draw_waterfall_picture(after.history))
    picture = history.draw_joints_picture(after.history, units)
    assert_all_named(picture)
    drawn = {p.title: p for row in picture.panels for p in row}["Joint 3"]
    values = np.concatenate([s.values for s in drawn.series])
    errors = [100.0 * step.joints["3"][1] for step in after.history]
    np.testing.assert_allclose(sorted(values[np.isfinite(values)]), sorted(errors))


def test_a_joint_that_got_worse_has_another_colour(after) -> None:
    """A significant rise is no good news: it was drawn as a fall."""
    first, *_, last = after.history
    joints = {"1": (0.02, 0.03), "2": (0.03, 0.02), "3": (0.02, 0.0201)}
    step = dataclasses.replace(last, joints=joints, changed_joints=("1", "2"))
    picture = history.draw_joints_picture((first, step), dict.fromkeys("123", "N m"))
    table = {
        panel.title: {
            item.label: item.style for item in panel.series if np.isfinite(item.values[-1])
        }
        for row in picture.panels
        for panel in row
    }
    assert table == {
        "Joint 1": {"clearly higher": history.WORSE},
        "Joint 2": {"clearly lower": history.BETTER},
        "Joint 3": {"no clear change": history.SAME},
    }
    assert len({result.color for result in (history.SAME, history.BETTER, history.WORSE)}) == 3
    assert_all_named(picture)
