"""`modeler physical` as a user types it: formulas, values, sets, CAD, and what is refused."""

import dataclasses
import json

import numpy as np
import pytest

from modeler.cli import main
from modeler.estimation.model_file import load_model, save_model
from tests.cli.running import answer, complaint, refusal
from tests.rotation import with_cases
from tests.terms.physical_cases import SEVEN, data_of, random_letters, system_of

SLIDE = """name = "pr"
gravity = [0, 0, "-g"]
[symbols]
g = 9.81
[mdh]
columns = ["j", "sigma", "alpha", "d", "theta", "r"]
rows = [["z", 1, 0, 0, 0, "qz"], ["e", 0, "pi/2", 0.2, "qe", 0]]
"""
EIGHT = (*SEVEN, "cm")


def physical(capsys, place, *words: object) -> tuple[str, dict]:
    """What the command prints and its JSON."""
    out = answer(capsys, "physical", *words, "--json", place / "physical.json")
    return out, json.loads((place / "physical.json").read_text())


@pytest.fixture(scope="module")
def wrist(tmp_path_factory):
    """A model of the wrist whose base parameters are those of a made-up robot, nearly; its truth.

    The fit is one of a simulated log, for its covariance; the values are put into its place.
    """
    folder = tmp_path_factory.mktemp("wrist")
    log, file = folder / "w.csv", folder / "w.json"
    assert main(["simulate", "wrist", "--duration", "4", "--rate", "200", "--out", str(log)]) == 0
    assert main(["fit", "wrist", str(log), "--out", str(file)]) == 0
    model, system = load_model(file), system_of("wrist")
    rng = np.random.default_rng(2)
    truth = random_letters(system, rng) | {"bl1": 0.1}
    data = data_of(system, truth)
    beta = np.linalg.solve(system.to_data, data)
    scale = 1e-3 * np.abs(beta) / np.sqrt(np.diag(model.covariance))
    covariance = model.covariance * np.outer(scale, scale)
    beta = beta + np.linalg.cholesky(covariance) @ rng.normal(size=len(beta))
    parameters = tuple(
        dataclasses.replace(p, value=float(v), sigma=float(s))
        for p, v, s in zip(model.fit.parameters, beta, np.sqrt(np.diag(covariance)), strict=True)
    )
    fit = dataclasses.replace(model.fit, parameters=parameters, covariance=covariance, verdict=None)
    save_model(file, dataclasses.replace(model, fit=fit))
    return file, truth


def listed(values: dict[str, float], names) -> str:
    return ",".join(f"{name}={values[name]!r}" for name in names)


def test_the_hint_is_what_can_be_typed(capsys, tmp_path, wrist):
    """A file by its path, and with a model a place for values; one parameter is no plural."""
    robot = tmp_path / "slide.toml"
    robot.write_text(SLIDE)
    out = answer(capsys, "physical", robot)
    assert f"formulas: modeler physical {robot} --known mz\n" in out
    assert "at least 1 parameter must be known" in out
    out = answer(capsys, "physical", wrist[0])
    assert f"values: modeler physical {wrist[0]} --known am=VALUE,at2=VALUE," in out


def test_a_moment_of_inertia_below_zero_is_not_told(capsys, tmp_path, two_link):
    """m2 far too large: Izz2 = ZZ2 - m2 cx2^2 or so comes out negative, and is not put down."""
    rows_by_mass = {}
    for m2 in (1e-3, 1e3):  # a light link of the same moments reaches far, and has none of its own
        _, raw = physical(capsys, tmp_path, two_link / "m.json", "--known", f"m1=1,m2={m2}")
        rows_by_mass[m2] = {row["parameter"]: row for row in raw["values"]["parameters"]}
    light = rows_by_mass[1e-3]["Izz2"]
    assert light["value"] is None
    assert "is not a possible moment of inertia: a known" in light["warning"]
    assert rows_by_mass[1e3]["Izz2"]["value"] > 0


def test_formulas_in_three_forms(capsys, tmp_path):
    known = ("wrist", "--known", ",".join(EIGHT))
    out, raw = physical(capsys, tmp_path, *known)
    assert "ct2 = -PG2/cm" in out and "PG1 = MY2R" in out
    assert "17 of 17 unknown parameters follow; each formula holds exactly for 20 of 20" in out
    assert raw["missing_count"] == raw["redundant_count"] == 0 and len(raw["formulas"]) == 17
    out = answer(capsys, "physical", *known, "--format", "latex")
    assert r"\mathit{ct}_{2} ={}& \frac{-\mathit{PG}_{2}}{\mathit{cm}} \\" in out


def test_values_from_a_model(capsys, tmp_path, wrist):
    """By base parameters the same as by the coefficients of the paper."""
    file, truth = wrist
    known = (file, "--known", listed(truth, EIGHT))
    out, raw = physical(capsys, tmp_path, *known)
    rows = raw["values"]["parameters"]
    assert "mostly from" in out
    z = [(row["value"] - truth[row["parameter"]]) / row["sigma"] for row in rows]
    assert len(z) == 17 and 0.5 < np.sqrt(np.mean(np.square(z))) < 1.7
    (ct2,) = [row for row in rows if row["parameter"] == "ct2"]
    assert ct2["sensitivity"]["cm"] == pytest.approx(-truth["ct2"] / truth["cm"], rel=0.02)
    both = []
    for source in ("base", "coefficients"):
        _, raw = physical(capsys, tmp_path, *known, "--from", source)
        rows = raw["values"]["parameters"]
        both.append({row["parameter"]: (row["value"], row["sigma"]) for row in rows})
    assert set(both[0]) == set(both[1])
    for x, pair in both[0].items():
        assert pair == pytest.approx(both[1][x], rel=1e-6), x


def test_what_is_known_and_contradicts_is_refused(capsys, wrist):
    file, truth = wrist
    known = (*EIGHT, "ct2")
    out = answer(capsys, "physical", file, "--known", listed(truth, known))
    assert "each known parameter against" in out
    wrong = listed(truth | {"ct2": 1.05 * truth["ct2"]}, known)
    err = complaint(capsys, "physical", file, "--known", wrong)
    assert err.startswith("modeler: --known contradicts the fit: ") and "ct2 = " in err


@pytest.mark.rotating("long tests of cli")
def test_a_fit_against_cad(capsys, tmp_path, wrist):
    file, truth = wrist
    cad = tmp_path / "cad.toml"
    cad.write_text("".join(f"{x} = {v!r}\n" for x, v in truth.items()))
    assert "all 17 agree with CAD" in answer(capsys, "physical", file, "--cad", cad)
    cad.write_text(cad.read_text().replace(f"cm = {truth['cm']!r}", f"cm = {1.1 * truth['cm']!r}"))
    out, raw = physical(capsys, tmp_path, file, "--cad", cad)
    assert "suspicious" in out and "all agree if cm = " in out
    best = raw["cad"]["explanations"][0]
    assert best["letters"] == ["cm"]
    assert best["fitted_values"][0] == pytest.approx(truth["cm"], rel=0.01)


def test_parameters_that_a_fit_set_aside_are_not_told(capsys, tmp_path, wrist):
    file, truth = wrist
    model = load_model(file)
    names = [p.name for p in model.fit.parameters]
    k, covariance = names.index("MX2"), model.covariance.copy()
    covariance[k], covariance[:, k] = 0.0, 0.0
    parameters = [*model.fit.parameters]
    parameters[k] = dataclasses.replace(
        parameters[k], value=0.0, sigma=None, status="set aside", essential=False
    )
    fit = dataclasses.replace(model.fit, parameters=tuple(parameters), covariance=covariance)
    save_model(tmp_path / "m.json", dataclasses.replace(model, fit=fit))
    out = answer(capsys, "physical", tmp_path / "m.json", "--known", listed(truth, EIGHT))
    assert "not determined: bt3 needs PG4, and the fit set MX2 aside" in out


def test_sets_of_a_robot(capsys, tmp_path):
    out = answer(capsys, "physical", "wrist", "--sets", 7)
    assert "0 of 480700 sets of 7 known parameters suffice" in out
    out, raw = physical(capsys, tmp_path, "two-link", "--sets")
    assert "two-link: 21 of 28 sets of 2 known parameters suffice" in out
    assert raw["sets"]["count"] == 21 and raw["sets"]["easiest_sets"] == [["m1", "m2"]]


@pytest.mark.rotating("long tests of cli")
def test_sets_rated_at_the_values_of_the_robot_file(capsys):
    out = answer(capsys, "physical", "wrist", "--sets", "--cad")
    assert "61879 of 1081575 sets of 8" in out
    assert "the 44 with the fewest inertias" in out and "the least error first" in out


@with_cases(
    "words, message",
    ("wrist --known an,bm", '--known: got "an"'),
    ("two-link --cad", "--cad, robot two-link: the robot file has no values"),
    ("two-link --cad none.toml", "none.toml: cannot be read"),
    ("two-link --known m1=-1,m2", "--known, m1: got the mass -1 kg; expected"),
    ("two-link --known m1=0,m2", "--known, m1: got the mass 0 kg; expected mo"),
    ("two-link --known Izz2=-1", "--known, Izz2: got the moment -1 kg m^2; ex"),
    ("wrist --cad", "--cad: wrist is a robot, with no identified values"),
    ("two-link --known m1=1,m2", "--known: got values, but two-link is a robo"),
    ("wrist --known cm --near cm=4", "--near: got values, but wrist is"),
    ("wrist --near cm=4", "--near: needs --known; give both"),
    ("two-link --sets -1", "--sets: got -1; expected 1 or more, or --sets al"),
    ("two-link --sets 0", "--sets: got 0; expected 1 or more, or --sets alon"),
    ("five-bar --from coefficients", "five-bar: coefficients are written for ser"),
    ("none.json", "none.json: cannot be read"),
)
def test_what_is_refused_in_one_line(capsys, tmp_path, monkeypatch, words, message):
    monkeypatch.chdir(tmp_path)
    assert refusal(capsys, "physical", *words.split()).startswith(f"modeler: {message}")


def test_a_model_needs_values(capsys, wrist):
    err = complaint(capsys, "physical", wrist[0], "--known", "am,bm=3")
    assert err.startswith("modeler: --known: no value of am; expected am=VALUE")
