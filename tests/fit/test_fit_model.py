"""Fits of simulated robots, payloads, the fit's JSON and the model file."""

import dataclasses
import json
import re

import numpy as np
import pytest
from stand_in import Row, StandIn, planar_arm
from test_observation_rows import exact_log, some_beta

from modeler.core.errors import DataError, ManifestError
from modeler.estimation.identify import identify
from modeler.estimation.model_file import (
    IdentifiedModel,
    checksums,
    load_model,
    provenance,
    save_model,
)
from modeler.estimation.payload import Payload, identify_with_payloads
from modeler.observation.observe import observe


def noisy(log, size, seed=0):
    noise = np.random.default_rng(seed).normal(0.0, size, log.tau.shape)
    return dataclasses.replace(log, tau=log.tau + noise)


@pytest.fixture(scope="module")
def arm():
    return planar_arm()


@pytest.fixture(scope="module")
def fitted(arm):
    beta = some_beta(arm)
    runs = (exact_log(arm, beta, "a.csv"), exact_log(arm, beta, "b.csv", seed=3))
    logs = [noisy(run, 0.2, seed) for seed, run in enumerate(runs)]
    seen = observe(arm, logs)
    return beta, seen, identify(seen)


@pytest.fixture(scope="module")
def model(arm, fitted):
    _, seen, fit = fitted
    return IdentifiedModel("name = 'arm'\n", arm.spec, {"arm.c": "/* C */\n"}, fit,
                           provenance(seen.report))  # fmt: skip


def test_a_simulated_arm_comes_back_within_its_sigmas(fitted):
    beta, seen, fit = fitted
    sigma = np.array([parameter.sigma for parameter in fit.parameters])
    assert np.all(np.abs(fit.beta - beta) < 4.0 * sigma) and np.all(sigma < 0.2 * beta)
    assert fit.status == "ok" and fit.method == "weighted"
    residual = seen.y - seen.W @ fit.beta
    assert fit.relative_error == pytest.approx(np.linalg.norm(residual) / np.linalg.norm(seen.y))
    for j, joint in enumerate(fit.joints):
        own = seen.row_joint == j
        assert joint.rms == pytest.approx(np.sqrt(np.mean(residual[own] ** 2)))
        expected = np.linalg.norm(residual[own]) / np.linalg.norm(seen.y[own])
        assert joint.relative_error == pytest.approx(expected)


def test_the_json_is_the_contracts(fitted):
    _, seen, fit = fitted
    raw = json.loads(json.dumps(fit.to_json(), allow_nan=False))
    assert {"robot", "method", "samples", "condition_number", "relative_error", "joints",
            "parameters"} <= set(raw)  # fmt: skip
    assert set(raw["joints"]) == {"1", "2"} and raw["samples"] == len(seen.time)
    assert {"relative_error", "rms"} <= set(raw["joints"]["1"])
    first = raw["parameters"][0]
    assert {"name", "value", "sigma", "relative_sigma_percent", "essential"} <= set(first)
    assert first["relative_sigma_percent"] == pytest.approx(
        100 * first["sigma"] / abs(first["value"])
    )
    text = "\n".join(fit.lines())
    assert "relative error" in text and "joint 2:" in text and fit.parameters[0].name in text


def test_a_joint_that_stands_still_is_set_aside_by_name():
    free = planar_arm(friction=False)
    log = exact_log(free, some_beta(free))
    still = {n: np.zeros_like(log.q) for n in ("q", "qd", "qdd")}
    for name, values in still.items():
        values[:, 0] = getattr(log, name)[:, 0]
    tau = free.base_regressor(still["q"], still["qd"], still["qdd"]) @ some_beta(free)
    fit = identify(observe(free, [dataclasses.replace(log, tau=tau, **still)]))
    aside = [p for p in fit.parameters if p.status == "set aside"]
    assert fit.status == "rank deficient" and aside and fit.relative_error < 1e-8
    for parameter in aside:
        assert parameter.value == 0.0 and parameter.sigma is None and not parameter.essential
        assert any(s.startswith(f"{parameter.name} ") for s in fit.sentences)
        assert any(s.startswith(parameter.name) and "set aside" in s for s in fit.lines())
    json.dumps(fit.to_json(), allow_nan=False)


def test_fewer_rows_than_parameters_is_refused(arm):
    log = exact_log(arm, some_beta(arm), seconds=0.2)
    seen = observe(arm, [log])
    with pytest.raises(DataError, match=f"run: {len(seen.y)} rows for .* parameters; record more"):
        identify(seen)


LOAD = {"M": 2.8, "MX": 0.3, "MY": -0.1, "MZ": 0.2, "ZZ": 0.05, "XX": 0.03, "YY": 0.02}


def loaded_robot():
    """A 3R arm, bare and with a load on link 3; (model, bare log, loaded log)."""
    robot = StandIn([Row(), Row(-np.pi / 2), Row(0.0, 0.4)])
    beta = some_beta(robot)
    bare = exact_log(robot, beta, "bare", seconds=30)
    log = exact_log(robot, beta, "loaded", seconds=30, seed=8)
    chi = np.zeros(len(robot.names))
    for letters, value in LOAD.items():
        chi[robot.names.index(f"{letters}3")] = value
    return (
        robot,
        bare,
        dataclasses.replace(log, tau=log.tau + robot.regressor(log.q, log.qd, log.qdd) @ chi),
    )


def test_an_unknown_load_is_weighed():
    robot, bare, loaded = loaded_robot()
    seen = observe(robot, [noisy(bare, 0.05), noisy(loaded, 0.05, 1)])
    fit = identify_with_payloads(robot, seen, [Payload(("loaded",))])
    loads = {parameter.name: parameter for parameter in fit.loads}
    for letters in ("M", "MX", "MY"):
        found = loads[f"{letters}3_load"]
        assert abs(found.value - LOAD[letters]) < 4.0 * found.sigma and found.sigma < 0.05
    sigma = np.array([parameter.sigma for parameter in fit.parameters])
    assert np.all(np.abs(fit.beta - some_beta(robot)) < 4.5 * sigma)
    assert len(fit.parameters) == len(robot.spec.base) == len(fit.covariance)
    # Only differences of the axial inertias of a link show: at least one letter is grouped.
    assert 0 < len(fit.loads) < 11
    assert "M3_load" in "\n".join(fit.lines()) and fit.to_json()["loads"][0]["name"] == "M3_load"


def test_a_known_mass_goes_to_the_measurement():
    robot, bare, loaded = loaded_robot()
    seen = observe(robot, [bare, loaded])
    fit = identify_with_payloads(robot, seen, [Payload(("loaded",), "3", 2.8, "tool")])
    values = {parameter.name: parameter.value for parameter in fit.loads}
    assert "M3_tool" not in values
    assert values["MX3_tool"] == pytest.approx(0.3, abs=1e-6)
    np.testing.assert_allclose(fit.beta, some_beta(robot), rtol=1e-5)
    assert fit.relative_error < 1e-8
    wrong = identify_with_payloads(robot, seen, [Payload(("loaded",), "3", 1.0)])
    assert wrong.relative_error > 1e-3


def test_impossible_payloads():
    robot, bare, loaded = loaded_robot()
    seen = observe(robot, [bare, loaded])
    for payloads, words in (
        ([Payload(("other",))], "payload load: no log other; there are bare, loaded"),
        ([Payload(())], "no log is named"),
        ([Payload(("loaded",), "7")], "no link 7; stand_in has 1, 2, 3"),
        ([Payload(("loaded",), mass=-1.0)], "mass -1.0 kg; expected above 0"),
        ([Payload(("bare",)), Payload(("loaded",))], "same name"),
        ([Payload(("bare",)), Payload(("loaded",), name="b")], "every log carries a load"),
    ):
        with pytest.raises(DataError, match=words):
            identify_with_payloads(robot, seen, payloads)


def test_a_model_file_returns_what_was_saved(tmp_path, model):
    path = tmp_path / "arm.model"
    save_model(path, model)
    again = load_model(path)
    np.testing.assert_array_equal(again.beta, model.beta)
    np.testing.assert_array_equal(again.covariance, model.covariance)
    assert again.fit.to_json() == model.fit.to_json()
    assert again.spec == model.spec and dict(again.sources) == dict(model.sources)
    assert again.robot_text == model.robot_text and again.logs == model.logs
    assert again.processing == model.processing
    assert [log.name for log in again.logs] == ["a.csv", "b.csv"] and again.logs[0].rows == 4000
    second = tmp_path / "again.model"
    save_model(second, again)
    assert second.read_bytes() == path.read_bytes()
    assert str(tmp_path) not in path.read_text()


def damaged(raw, *keys, value=None):
    inner = raw
    for key in keys[:-1]:
        inner = inner[key]
    if value is None:
        del inner[keys[-1]]
    else:
        inner[keys[-1]] = value
    return raw


def with_covariance(change):
    def changed(raw):
        change(raw["covariance"])
        return raw

    return changed


def scaled(C, i, j, factor):
    C[i][j] = C[i][j] * factor + 1e-9


DAMAGE = {
    "foreign": (lambda r: {"hello": 1}, "JSON, but not a model file"),
    "list": (lambda r: [1], "JSON, but not a model file"),
    "format": (
        lambda r: damaged(r, "format", value=99),
        "model format 99, this version opens 3 to 4; install a newer modeler",
    ),
    "formatless": (
        lambda r: damaged(r, "format"),
        "no model format, this version opens 3 to 4; fit",
    ),
    "before": (lambda r: damaged(r, "format", value=2), "opens 3 to 4; fit the model again"),
    "manifest": (lambda r: damaged(r, "manifest"), "damaged, manifest is missing"),
    "sources": (lambda r: damaged(r, "sources", value=3), "sources is 3, expected an object"),
    "source": (lambda r: damaged(r, "sources", "arm.c", value=3), "'arm.c' is 3, expected text"),
    "robot": (lambda r: damaged(r, "robot_text", value=[]), r"robot_text is \[\], expected text"),
    "edited": (
        lambda r: damaged(r, "manifest", "robot", value="x"),
        "does not match its signature",
    ),
    "old manifest": (lambda r: damaged(r, "manifest", "format", value=0), "manifest format 0"),
    "covariance": (lambda r: damaged(r, "covariance", value=[[1.0]]), "values are not those"),
    "ragged": (lambda r: damaged(r, "covariance", value=[[1.0], [1, 2]]), "is not square"),
    "nested": (lambda r: damaged(r, "covariance", value=[[[1.0]]]), "expected a number"),
    "truth": (
        with_covariance(lambda C: C[0].__setitem__(0, True)),
        r"covariance\[0\]\[0\] is True, expected a number",
    ),
    "variance": (
        with_covariance(lambda C: C[2].__setitem__(2, -C[2][2])),
        "the variance of .* is -.*; expected 0 or more; fit the model again",
    ),
    "other sigma": (
        lambda r: damaged(r, "fit", "parameters", 1, "sigma", value=0.123),
        "the sigma of .* is 0.123, the root of its variance",
    ),
    "minus sigma": (
        lambda r: damaged(r, "fit", "parameters", 1, "sigma", value=-1.0),
        "is -1; expected 0 or more",
    ),
    "uneven": (with_covariance(lambda C: scaled(C, 0, 1, 0.5)), "is not symmetric"),
    "indefinite": (
        with_covariance(lambda C: [scaled(C, *place, 1e4) for place in ((0, 1), (1, 0))]),
        "a sum of parameters a negative variance",
    ),
    "still": (
        lambda r: damaged(
            damaged(r, "covariance", 1, 1, value=0.0), "fit", "parameters", 1, "sigma", value=0.0
        ),
        "varies with others, but its variance is 0",
    ),
    "logs": (lambda r: damaged(r, "logs", value=[{"path": "x"}]), "logs.0..name is missing"),
    "log content": (lambda r: damaged(r, "logs", 0, "content", value=3), "expected text"),
    "log times": (lambda r: damaged(r, "logs", 1, "end", value="x"), "expected a number"),
    "history": (lambda r: damaged(r, "history", value=[{"effect": "x"}]), "joint is missing"),
    "fit": (lambda r: damaged(r, "fit", "parameters"), "the fit is damaged"),
    "joint": (lambda r: damaged(r, "fit", "joints", "1", "rms", value="x"), "expected a number"),
    "processing": (
        lambda r: damaged(r, "fit", "processing", "low_speed", value=7.0),
        "the fit is damaged .*low_speed is 7.0",
    ),
    "value": (lambda r: damaged(r, "fit", "relative_error", value="x"), "the fit is damaged"),
    "text": (
        lambda r: damaged(r, "fit", "parameters", 0, "value", value="x"),
        "value is 'x', expected a number",
    ),
    "short": (lambda r: damaged(r, "fit", "parameters", 0), "values are not those of the"),
    "mapping": (lambda r: damaged(r, "mapping"), "damaged, mapping is missing"),
    "list as mapping": (lambda r: damaged(r, "mapping", value=["q1=a"]), "expected an object"),
}


def saved(folder, model):
    path = folder / "arm.model"
    save_model(path, model)
    return path, json.loads(path.read_text())


def refusal(path, content):
    """The line with which the file is refused once `content` (a value, text or bytes) is in it."""
    if not isinstance(content, str | bytes):
        content = json.dumps(content)
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    with pytest.raises(ManifestError) as error:
        load_model(path)
    line = str(error.value)
    assert line.startswith(str(path)) and "\n" not in line and len(line) < len(str(path)) + 350
    return line


@pytest.mark.parametrize("case", DAMAGE)
def test_wrong_model_files_say_where_and_what_to_do(tmp_path, model, case):
    """Their checksums fit: somebody wrote them so."""
    path, raw = saved(tmp_path, model)
    change, words = DAMAGE[case]
    raw = change(raw)
    if "checksums" in raw:
        raw["checksums"] = checksums(raw)
    assert re.search(words, refusal(path, raw))


def test_a_file_of_the_format_before_is_opened(tmp_path, model):
    """It has no mapping, and of its logs neither paths nor checksums."""
    path, raw = saved(tmp_path, dataclasses.replace(model, mapping={"columns": {"q1": "a"}}))
    assert load_model(path).mapping == {"columns": {"q1": "a"}}
    raw["format"] = 3
    del raw["mapping"]
    raw["logs"] = [{k: v for k, v in log.items() if k not in ("path", "checksum")}
                   for log in raw["logs"]]  # fmt: skip
    raw["checksums"] = checksums({k: v for k, v in raw.items() if k != "checksums"})
    path.write_text(json.dumps(raw))
    again = load_model(path)
    assert again.mapping == {} and [log.name for log in again.logs] == ["a.csv", "b.csv"]
    assert {(log.path, log.checksum) for log in again.logs} == {("", "")}
    np.testing.assert_array_equal(again.beta, model.beta)
    save_model(path, again)
    assert json.loads(path.read_text())["format"] == 4


EDITED = {
    "value": (("fit", "parameters", 0, "value"), "fit (the values"),
    "sigma": (("fit", "parameters", 3, "sigma"), "fit (the values"),
    "cut-off": (("fit", "processing", "parallel_cutoff"), "fit (the values"),
    "covariance": (("covariance", 0, 0), "covariance (how sure"),
    "robot": (("robot_text",), "robot_text (the robot file; to change the robot, fit the changed"),
    "C": (("sources", "arm.c"), "sources (the C)"),
    "manifest": (("manifest", "base", 0, "unit"), "manifest (what"),
    "log": (("logs", 1, "end"), "logs (what was fitted)"),
    "signature": (("signature",), "'signature'"),
    "checksum": (("checksums", "fit"), "fit (the values"),
}


@pytest.mark.parametrize("case", EDITED)
def test_an_edited_model_file_is_refused_and_says_which_part(tmp_path, model, case):
    path, raw = saved(tmp_path, model)
    keys, words = EDITED[case]
    inner = raw
    for key in keys[:-1]:
        inner = inner[key]
    old = inner[keys[-1]]
    inner[keys[-1]] = f"{old} " if isinstance(old, str) else float(np.nextafter(old, 9e9))
    line = refusal(path, raw)
    assert f"changed since it was saved, the checksum does not fit: {words}" in line
    assert line.endswith("take the file as it was saved, or fit the model again")


def test_entries_may_not_be_added_taken_away_or_put_in_another_order(tmp_path, model):
    path, raw = saved(tmp_path, model)
    assert "'remark'" in refusal(path, {**raw, "remark": "better"})
    assert "history (the effects added)" in refusal(
        path, {k: raw[k] for k in raw if k != "history"}
    )
    assert "checksums is missing" in refusal(path, {k: raw[k] for k in raw if k != "checksums"})
    assert "checksums is not as saved" in refusal(path, {**raw, "checksums": 3})
    many = {**raw, **{f"x{i}": i for i in range(9)}}
    assert "'x0', 'x1', 'x2' and 6 more" in refusal(path, many)
    joints = dict(reversed(raw["fit"]["joints"].items()))
    assert "fit (the values" in refusal(path, {**raw, "fit": {**raw["fit"], "joints": joints}})
    path.write_text(json.dumps(dict(reversed(raw.items()))))  # what has no meaning may differ
    assert load_model(path).beta.tolist() == model.beta.tolist()


TEXTS = {
    "none": (b"", "it is empty"),
    "blank": (b" \n ", "it is blank"),
    "binary": (b"PAR1\x15\x04\xff\x00", "no text in UTF-8 from byte 7"),
    "UTF-16": ('{"kind": 1}'.encode("utf-16"), "UTF-16, UTF-32 or binary"),
    "UTF-32": ('{"kind": 1}'.encode("utf-32-be"), "UTF-16, UTF-32 or binary"),
    "Latin": ('{"kind": "\u00e9"}'.encode("latin-1"), "no text in UTF-8 from byte 11"),
    "lists": (b"[" * 100_000, "nested too deep"),
    "objects": (b'{"a":' * 100_000, "nested too deep"),
    "closed": (b'{"kind":' + b"[" * 100_000 + b"]" * 100_000 + b"}", "nested too deep"),
    "digits": (b'{"format": -' + b"9" * 10_000 + b"}", "a whole number of 10000 digits"),
    "integer": (b'{"format": 99999999999999999999}', "a whole number of 20 digits"),
    "decimals": (b'{"format": 1e999}', "'1e999', too large for double precision"),
    "NaN": (b'{"format": NaN}', "has NaN, which is no number of JSON"),
    "infinity": (b'{"format": -Infinity}', "has -Infinity, which is no number"),
    "twice": (b'{"format": {"a": 1, "b": 2, "a": 3}}', "has the entry 'a' twice"),
    "half": (b'{"kind": "\\ud800"}', "half a character"),
    "comma": (b'{"kind": 1,}', "is not JSON, or cut off"),
    "TOML": (b'name = "arm"', "is not JSON, or cut off: Expecting value, line 1, column 1"),
}


@pytest.mark.parametrize("case", TEXTS)
def test_what_is_no_json_is_refused_in_one_line(tmp_path, case):
    content, words = TEXTS[case]
    line = refusal(tmp_path / "arm.model", content)
    assert words in line and "not a model file: it " in line


def test_unreadable_model_files(tmp_path, model):
    with pytest.raises(ManifestError, match="cannot be read"):
        load_model(tmp_path / "none.model")
    with pytest.raises(ManifestError, match="cannot be read"):
        load_model(tmp_path)
    path, _ = saved(tmp_path, model)
    assert "not a model file: it is not JSON, or cut off" in refusal(path, path.read_bytes()[:500])


def test_a_byte_order_mark_and_other_line_ends_change_nothing(tmp_path, model):
    path, _ = saved(tmp_path, model)
    path.write_bytes(b"\xef\xbb\xbf" + path.read_bytes().replace(b"\n", b"\r\n"))
    assert load_model(path).beta.tolist() == model.beta.tolist()
