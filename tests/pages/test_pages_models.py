"""Pages of a fit, of effects added and of models side by side, from the command line."""

import dataclasses
import json
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from modeler.cli import main
from modeler.estimation.model_file import IdentifiedModel, load_model
from modeler.report.fit import correlated_pairs
from modeler.report.history import (
    BETTER,
    SAME,
    WORSE,
    additions_page,
    joints_picture,
    waterfall_picture,
)
from modeler.report.page import write_page
from modeler.report.values import relation
from tests.captions import assert_all_named


@dataclass(frozen=True)
class Made:
    """A demonstration arm with a spring that its file lacks, before and after it is added."""

    folder: Path
    before: IdentifiedModel
    after: IdentifiedModel

    def place(self, name: str) -> str:
        return str(self.folder / name)

    def page(self, name: str) -> str:
        return (self.folder / name).read_text(encoding="utf-8")

    def json(self, name: str) -> dict[str, Any]:
        found: dict[str, Any] = json.loads(self.page(name))
        return found


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Made:
    folder = tmp_path_factory.mktemp("models")

    def run(*words: str) -> None:
        assert main([str(folder / w) if "." in w and "=" not in w else w for w in words]) == 0

    for seed, name in (("4", "train.parquet"), ("5", "other.parquet")):
        run("simulate", "demo-arm", "--hide", "spring@3", "--duration", "10", "--rate", "250",
            "--seed", seed, "--out", name)  # fmt: skip
    run("fit", "demo-arm", "train.parquet", "--out", "a.json", "--report", "fit.html")
    run("add", "a.json", "spring", "--joint", "3", "train.parquet", "--holdout", "other.parquet",
        "--out", "b.json", "--report", "improved.html")  # fmt: skip
    run("compare", "a.json", "b.json", "other.parquet", "--report", "c.html", "--json", "c2.json")
    return Made(folder, *(load_model(folder / name) for name in ("a.json", "b.json")))


def plain(page: str) -> str:
    """The words of a page."""
    body = re.sub(r"<(script|style)\b.*?</\1>", " ", page, flags=re.DOTALL)
    return " ".join(re.sub(r"<[^>]*>", " ", body).split())


@pytest.mark.rotating("long tests of pages")
def test_two_models_are_told_apart_where_one_has_the_spring(made: Made) -> None:
    found = made.json("c2.json")
    first, second = found["models"]
    assert found["relative_error"] == first["relative_error"]  # the contract's fields: model one
    assert (first["model"], second["model"]) == ("a.json", "b.json")
    assert "3" in second["best_on"] and first["best_on"] == []
    for joint, own in found["joints"].items():
        assert own["relative_error"] == pytest.approx(first["joints"][joint]["relative_error"])
    text = plain(made.page("c.html"))
    assert "b.json predicts joint" in text and "2 models side by side" in text


@pytest.mark.rotating("long tests of pages")
def test_the_order_of_models_and_logs_is_free(
    made: Made, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A model by what stands in it, whatever its name; the table has a column for each."""
    other = tmp_path / "copy.of_b"
    other.write_bytes((made.folder / "b.json").read_bytes())
    log = made.place("other.parquet")
    assert main(["compare", made.place("a.json"), log, str(other)]) == 0
    said = capsys.readouterr().out.splitlines()[0].split()
    assert said[:4] == ["joint", "a", "copy.of_b", "unit"]


@pytest.fixture(scope="module")
def scara(made: Made) -> tuple[str, str]:
    """A log and a model of a robot of which three joints turn and one slides."""
    log, model = made.place("mixed.parquet"), made.place("scara.json")
    assert main(["simulate", "scara", "--duration", "6", "--rate", "200", "--out", log]) == 0
    assert main(["fit", "scara", log, "--out", model, "--json", made.place("mixed_fit.json")]) == 0
    return log, model


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["a.json", "b.json"], "got models only; expected a log too"),
        (["a.json", "a.json", "other.parquet"], "got this model twice"),
        (["a.json", "scara.json", "other.parquet"], "expected those of"),
        (["a.json", "b.json", "other.parquet", "other.parquet"], "give each row once"),
    ],
)
@pytest.mark.usefixtures("scara")
def test_what_cannot_be_set_side_by_side(
    made: Made, words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["compare", *(made.place(word) for word in words)]) == 1
    error = capsys.readouterr().err
    assert said in error and len(error.strip().splitlines()) == 1


def test_newtons_and_newton_metres_are_told_apart(
    made: Made, scara: tuple[str, str], capsys: pytest.CaptureFixture[str]
) -> None:
    """Each unit has an error of its own."""
    (log, model), page = scara, made.place("mixed.html")
    words = ["compare", model, log, "--report", page, "--json", made.place("mixed_compare.json")]
    assert main(words) == 0
    said = capsys.readouterr().out
    assert "of the torques (N m)" in said and "of the forces (N)" in said
    assert "of the force is unexplained" in said
    found = made.json("mixed_compare.json")
    assert set(found["by_unit"]) == {"N m", "N"} and "pools" in found["relative_error_pools"]
    fitted = made.json("mixed_fit.json")
    assert set(fitted["by_unit"]) == {"N m", "N"}
    for unit, error in fitted["by_unit"].items():
        own = [j for j in fitted["joints"].values() if j["unit"] == unit]
        left = sum(j["rows"] * j["rms"] ** 2 for j in own)
        size = sum(j["rows"] * (j["rms"] / j["relative_error"]) ** 2 for j in own)
        assert error == pytest.approx(np.sqrt(left / size))
    head = re.search(r'class="headline">(.*?)</p>', made.page("mixed.html"), re.DOTALL)
    assert head is not None and "of the torque and" in head[1] and "of the force" in head[1]


def test_the_page_of_a_fit_has_values_sums_and_doubts(made: Made) -> None:
    text = plain(made.page("fit.html"))
    for parameter in made.before.fit.parameters:
        assert f"{parameter.name} {parameter.value:.5g} {parameter.sigma:.2g}" in text
    for base in made.before.spec.base:
        assert relation(base) in text
    verdict = made.before.fit.verdict
    assert verdict is not None and verdict.line in text
    assert f"{made.before.fit.condition_number:.4g}" in text
    assert "modeler compare" in text
    told = made.page("fit.html").partition("How this was made")[2]
    lines = re.findall(r"<li>(.*?)</li>", told)
    assert "train.parquet" in lines[0] and all(len(line) > 20 for line in lines)


def test_a_sum_is_the_base_parameter(made: Made) -> None:
    """Evaluated with random standard parameters it is what the numbers of the terms give."""
    random = np.random.default_rng(2)
    spec = made.before.spec
    values = {p.name: float(random.normal()) for p in spec.standard}
    values |= {symbol.name: symbol.value for symbol in spec.symbols}
    summed = 0
    for base in spec.base:
        if relation(base):
            by_terms = sum(term.value * values[term.parameter] for term in base.terms)
            assert eval(relation(base), {}, values) == pytest.approx(by_terms)
            summed += 1
    assert summed > 5


def test_tangled_parameters_are_those_of_the_covariance(made: Made) -> None:
    for one, other, value in correlated_pairs(made.after):
        names = [p.name for p in made.after.fit.parameters]
        i, j = names.index(one), names.index(other)
        covariance = made.after.covariance
        own = covariance[i, j] / np.sqrt(covariance[i, i] * covariance[j, j])
        assert value == pytest.approx(own) and abs(own) > 0.95


def test_the_page_of_additions_has_every_joint_and_value(made: Made, tmp_path: Path) -> None:
    text = plain(made.page("improved.html"))
    last = made.after.history[-1]
    added = next(p for p in made.after.fit.parameters if p.name == "Ks3")
    assert f"Ks3 {added.value:.5g}" in text and "N m/rad" in text
    for name, (before, after) in last.joints.items():
        start = made.after.history[0].joints[name][1]
        assert before == pytest.approx(start)
        assert after <= 1.05 * before
    assert "as fitted + spring @3" in text
    refused = ["left out: backlash, joint 2 (the error does not fall (no joint changes))"]
    page = write_page(tmp_path / "page.html", additions_page(made.after, refused)).read_text()
    assert "backlash, joint 2: the error does not fall (no joint changes)" in plain(page)


def test_captions_of_waterfalls_name_their_colours(made: Made) -> None:
    units = {joint.name: joint.effort_unit for joint in made.after.spec.joints}
    assert_all_named(waterfall_picture(made.after.history))
    picture = joints_picture(made.after.history, units)
    assert_all_named(picture)
    drawn = {p.title: p for row in picture.panels for p in row}["Joint 3"]
    values = np.concatenate([s.values for s in drawn.series])
    errors = [100.0 * step.joints["3"][1] for step in made.after.history]
    np.testing.assert_allclose(sorted(values[np.isfinite(values)]), sorted(errors))


def test_a_joint_that_got_worse_has_another_colour(made: Made) -> None:
    """A significant rise is no good news: it was drawn as a fall."""
    first, *_, last = made.after.history
    joints = {"1": (0.02, 0.03), "2": (0.03, 0.02), "3": (0.02, 0.0201)}
    step = dataclasses.replace(last, joints=joints, changed=("1", "2"))
    picture = joints_picture((first, step), dict.fromkeys("123", "N m"))
    found = {
        panel.title: {own.label: own.style for own in panel.series if np.isfinite(own.values[-1])}
        for row in picture.panels
        for panel in row
    }
    assert found == {
        "Joint 1": {"clearly higher": WORSE},
        "Joint 2": {"clearly lower": BETTER},
        "Joint 3": {"no clear change": SAME},
    }
    assert len({own.color for own in (SAME, BETTER, WORSE)}) == 3
    assert_all_named(picture)
