"""`modeler generate MODEL --out DIR`: every kind of model, and what is refused."""

import html
import json
import re
import shlex
from dataclasses import replace

import numpy as np
import pytest

from modeler.api import compile, generate, load
from modeler.estimation.model_file import Addition, build_fitted_spec, load_model, save_model
from modeler.estimation.parameters import ParameterEstimate
from modeler.estimation.result import Verdict, VerdictWarning
from tests.cli.running import answer, complaint, run
from tests.codegen.fitted_library import Functions


@pytest.fixture(scope="module")
def place(two_link):
    """The file of the model of a fit."""
    return two_link / "m.json"


@pytest.fixture(scope="module")
def fitted(place):
    return load_model(place)


def changed(model, **more):
    """The model with another estimate."""
    return replace(model, fit=replace(model.fit, **more))


def test_the_robot_after_its_model_leaves_no_fitted_files(place, capsys, tmp_path):
    """But an example that somebody edited, which is reported."""
    answer(capsys, "generate", place, "--out", tmp_path)
    (tmp_path / "programs" / "example_computed_torque.c").write_text("mine")
    status, _, err = run(capsys, "generate", "two-link", "--out", tmp_path)
    assert status == 0 and len(err.splitlines()) == 1
    assert f"{tmp_path}: programs/example_computed_torque.c is of an earlier generate" in err
    left = {path.name for path in tmp_path.rglob("*")}
    assert "two_link.c" in left and not {name for name in left if "fitted" in name}
    # The learner needs no values.
    rest = {"example_computed_torque.c", "example_adaptive.c"}
    assert {name for name in left if "example" in name} == rest


def test_a_model_where_a_robot_is_expected_and_the_other_way(place, capsys, tmp_path):
    log, file = place.parent / "a.parquet", tmp_path / "arm.toml"
    file.write_text(load("two-link").text)
    for words, message in (
        (("fit", place, log, "--out", tmp_path / "m.json"), f"{place}: is a model file; expected"),
        (("diagnose", file, log), f"make one with `modeler fit {file} "),
        (("diagnose", "two-link", log), "which `modeler fit --out` writes, no robot"),
    ):
        assert message in complaint(capsys, *words)


@pytest.mark.rotating("long tests of cli")
def test_the_page_of_a_fit_names_a_file_with_a_blank(place, capsys, tmp_path):
    model, page = tmp_path / "my arm.json", tmp_path / "p.html"
    words = ("fit", "two-link", place.parent / "a.parquet", "--out", model, "--report", page)
    assert run(capsys, *words)[0] == 0
    commands = re.findall(r"modeler (?:compare|diagnose) [^<]*", html.unescape(page.read_text()))
    assert len(commands) >= 2
    assert {shlex.split(command)[2] for command in commands} == {str(model)}


def test_the_c_predicts_what_the_model_does(place, fitted, capsys, tmp_path):
    words = ("generate", place, "--out", tmp_path / "c", "--json", tmp_path / "c.json")
    out = answer(capsys, *words)
    result = json.loads((tmp_path / "c.json").read_text())
    emitted = generate(fitted, tmp_path / "c")
    assert {name: (tmp_path / "c" / name).read_text() for name in result["files"]} == emitted.files
    made = Functions(emitted)
    assert result["fitted_signature"] == made.text("fitted_signature")
    assert result["valid"] is True and result["warnings"] == []
    assert f"with the fitted values, signature {result['fitted_signature']}:" in out
    assert "two_link_fitted_gravity: g(q) = tau(q, 0, 0) without effects (5 additions" in out
    assert "TWO_LINK_COULOMB_WIDTH_1, TWO_LINK_COULOMB_WIDTH_2" in out
    q, qd, qdd = np.random.default_rng(1).normal(0.0, 2.0, (3, 20, 2))
    expected = compile(fitted).inverse_dynamics(q, qd, qdd, fitted.beta)
    got = made("fitted_inverse_dynamics", {"q": q, "qd": qd, "qdd": qdd})
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-12 * np.abs(expected).max())
    assert made.spec.compute_signature() == fitted.spec.compute_signature()


def test_a_model_that_is_not_usable_is_written_and_told(fitted, capsys, tmp_path):
    doubts = ("joint 2 is not described", "joint 1 is */ strange")
    entries = tuple(VerdictWarning("data", None, doubt) for doubt in doubts)
    verdict = Verdict(False, "nothing", "Not valid: joint 2 is not described", entries)
    err = {}
    for name, judged in (("bad", verdict), ("unjudged", None)):
        save_model(tmp_path / "m.json", changed(fitted, verdict=judged))
        code, _, err[name] = run(capsys, "generate", tmp_path / "m.json", "--out", tmp_path / name)
        assert code == 0
    bad, unjudged = ((tmp_path / n / "two_link_fitted.h").read_text() for n in err)
    assert err["bad"] == "modeler: the fit of this model is not valid: joint 2 is not described\n"
    assert "* WARNING. The fit of this model is not valid: joint 2 is not desc" in bad
    assert "* Doubt: joint 1 is * / strange" in bad
    assert "* WARNING. The fit of this model is one that nobody has judged" in unjudged


@pytest.mark.parametrize(("delay", "words"), [(0.0025, "2.5 ms before"), (-0.001, "1 ms after")])
def test_the_header_says_what_the_values_are_of(fitted, delay, words):
    load_ = ParameterEstimate("M2_load", "kg", 1.5, 0.01, True, "estimated")
    processing = replace(fitted.fit.processing, delay=delay)
    step = Addition("spring", "2", {}, 0.1, 0.1, (), fitted.robot_text)
    parameters = list(fitted.fit.parameters)
    parameters[2] = replace(parameters[2], value=0.0, sigma=None, status="set aside")
    model = changed(fitted, loads=(load_,), processing=processing, parameters=tuple(parameters))
    emitted = generate(replace(model, history=(step,)))
    text = " ".join(emitted.files["two_link_fitted.h"].replace("\n *", " ").split())
    assert "Values by the method weighted, " in text
    assert "Effects added since the first fit: spring (joint 2)." in text
    assert f"The torques of the logs stood {words} the motion that they belong to" in text
    assert "Without the load that some logs carried: M2_load 1.5 kg." in text
    table = emitted.files["two_link_fitted.c"]
    assert "0.0, /* TWO_LINK_BETA_MY1 [kg m], set aside: the logs do not identify it */" in table


def test_drive_gains_of_the_robot_file_go_along(fitted):
    joints = tuple(
        replace(j, drive_gain=k) for j, k in zip(fitted.spec.joints, (35.0, 12.0), strict=True)
    )
    spec = replace(fitted.spec, joints=joints)
    assert build_fitted_spec(replace(fitted, spec=spec)).gains == (35.0, 12.0)
    spec = replace(fitted.spec, joints=(joints[0], fitted.spec.joints[1]))
    assert build_fitted_spec(replace(fitted, spec=spec)).gains == ()
