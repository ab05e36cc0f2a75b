"""Fits of simulated robots, payloads, the fit's JSON and the model file, also changed at random."""

import copy
import dataclasses
import json
import math
import random
import re
from functools import cache, reduce
from operator import getitem

import numpy as np
import pytest
from test_observation_rows import exact_log, some_beta

from modeler.api import compile
from modeler.core.errors import DataError, ManifestError, ModelerError
from modeler.estimation import Payload, identify, identify_with_payloads, load_model, save_model
from modeler.estimation.model_file import IdentifiedModel, collect_provenance, compute_checksums
from modeler.regression.observe import observe
from tests.bad_input.mutants import NUMBERS, VALUES_DRAWN, edited_bytes
from tests.chain import chain_of
from tests.modules import compiled
from tests.oracles.numpy_model import planar_arm


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
    return IdentifiedModel(
        "name = 'arm'\n", arm.spec, {"arm.c": "/* C */\n"}, fit, collect_provenance(seen.report)
    )


def test_a_simulated_arm_comes_back_within_its_sigmas(fitted):
    beta, seen, fit = fitted
    sigma = np.array([parameter.sigma for parameter in fit.parameters])
    assert np.all(np.abs(fit.beta - beta) < 4.0 * sigma) and np.all(sigma < 0.2 * beta)
    assert fit.status == "ok" and fit.method == "weighted"
    residual = seen.y - seen.W @ fit.beta
    assert fit.relative_error == pytest.approx(np.linalg.norm(residual) / np.linalg.norm(seen.y))
    for j, joint in enumerate(fit.joints):
        mask = seen.row_joint == j
        assert joint.rms == pytest.approx(np.sqrt(np.mean(residual[mask] ** 2)))
        expected = np.linalg.norm(residual[mask]) / np.linalg.norm(seen.y[mask])
        assert joint.relative_error == pytest.approx(expected)
    raw = json.loads(json.dumps(fit.to_json(), allow_nan=False))
    text = "\n".join(fit.format_lines())
    assert set(raw["joints"]) == {"1", "2"} and raw["samples"] == len(seen.time)
    assert "relative error" in text and "joint 2:" in text


LOAD = {"M": 2.8, "MX": 0.3, "MY": -0.1, "MZ": 0.2, "ZZ": 0.05, "XX": 0.03, "YY": 0.02}


@cache
def loaded_robot():
    """An arm, bare and with a load on link 3; (model, bare log, loaded log)."""
    robot = compiled("demo-arm")
    beta = some_beta(robot)
    bare = exact_log(robot, beta, "bare", seconds=15)
    log = exact_log(robot, beta, "loaded", seconds=15, seed=8)
    names = [parameter.name for parameter in robot.spec.standard]
    chi = [LOAD.get(name[:-1], 0.0) if name[-1] == "3" else 0.0 for name in names]
    more = robot.regressor(log.q, log.qd, log.qdd) @ chi
    return robot, bare, dataclasses.replace(log, tau=log.tau + more)


def test_an_unknown_load_is_weighed_and_a_known_mass_goes_to_the_measurement():
    robot, bare, loaded = loaded_robot()
    seen = observe(robot, [noisy(bare, 0.05), noisy(loaded, 0.05, 1)])
    fit = identify_with_payloads(robot, seen, [Payload(("loaded",))])
    loads = {parameter.name: parameter for parameter in fit.loads}
    for letters in ("M", "MX", "MY"):
        result = loads[f"{letters}3_load"]
        assert abs(result.value - LOAD[letters]) < 4.0 * result.sigma and result.sigma < 0.05
    assert len(fit.parameters) == len(robot.spec.base) == len(fit.covariance)
    # Only differences of the axial inertias of a link show: at least one letter is grouped.
    assert 0 < len(fit.loads) < 11 and "M3_load" in "\n".join(fit.format_lines())
    seen = observe(robot, [bare, loaded])
    fit = identify_with_payloads(robot, seen, [Payload(("loaded",), "3", 2.8, "tool")])
    values = {parameter.name: parameter.value for parameter in fit.loads}
    assert "M3_tool" not in values
    assert values["MX3_tool"] == pytest.approx(0.3, abs=1e-6)
    np.testing.assert_allclose(fit.beta, some_beta(robot), rtol=1e-5)
    assert fit.relative_error < 1e-8


def test_impossible_payloads():
    robot, bare, loaded = loaded_robot()
    seen = observe(robot, [bare, loaded])
    for payloads, words in (
        ([Payload(("other",))], "payload load: no log other; there are bare, loaded"),
        ([Payload(())], "no log is named"),
        ([Payload(("loaded",), "7")], "no link 7; demo-arm has 1, 2, 3"),
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


def damaged(raw, *changes):
    """The content with entries replaced: (path, value or function of the old one), or left out."""
    for path, *value in changes:
        *above, last = path
        holder = reduce(getitem, above, raw)
        if value:
            holder[last] = value[0](holder[last]) if callable(value[0]) else value[0]
        else:
            del holder[last]
    return raw


SIGMA = ("fit", "parameters", 1, "sigma")
VALUE = ("fit", "parameters", 0, "value")


def enlarged(value):
    return 1e4 * value + 1e-9


# Changes, and what is said of them.
DAMAGE = {
    "format": ([(("format",), 99)], "model format 99, this version opens 4; install a newer"),
    "formatless": ([(("format",),)], "no model format, this version opens 4; fit"),
    "before": ([(("format",), 3)], "opens 4; fit the model again"),
    "manifest": ([(("manifest",),)], "damaged, manifest is missing"),
    "sources": ([(("sources",), 3)], "sources is 3, expected an object"),
    "source": ([(("sources", "arm.c"), 3)], "'arm.c' is 3, expected text"),
    "robot": ([(("robot_text",), [])], r"robot_text is \[\], expected text"),
    "edited": ([(("manifest", "robot"), "x")], "wrong signature"),
    "old manifest": ([(("manifest", "format"), 0)], "manifest format 0"),
    "covariance": ([(("covariance",), [[1.0]])], "values are not those"),
    "ragged": ([(("covariance",), [[1.0], [1, 2]])], "is not square"),
    "nested": ([(("covariance",), [[[1.0]]])], "expected a number"),
    "truth": ([(("covariance", 0, 0), True)], r"covariance\[0\]\[0\] is True, expected a number"),
    "variance": ([(("covariance", 2, 2), -1.0)], "the variance of .* is -.*; expected 0 or more"),
    "other sigma": ([(SIGMA, 0.123)], "the sigma of .* is 0.123, the root of its variance"),
    "minus sigma": ([(SIGMA, -1.0)], "is -1; expected 0 or more"),
    "uneven": ([(("covariance", 0, 1), enlarged)], "is not symmetric"),
    "indefinite": (
        [(("covariance", *at), enlarged) for at in ((0, 1), (1, 0))],
        "a sum of parameters a negative variance",
    ),
    "still": ([(("covariance", 1, 1), 0.0), (SIGMA, 0.0)], "varies with others, but its variance"),
    "logs": ([(("logs",), [{"path": "x"}])], "logs.0..name is missing"),
    "log content": ([(("logs", 0, "checksum"), 3)], "expected text"),
    "log times": ([(("logs", 1, "end"), "x")], "expected a number"),
    "history": ([(("history",), [{"effect": "x"}])], "joint is missing"),
    "fit": ([(("fit", "parameters"),)], "the fit is damaged"),
    "joint": ([(("fit", "joints", "1", "rms"), "x")], "expected a number"),
    "processing": ([(("fit", "processing", "low_speed"), 7.0)], "damaged .*low_speed is 7.0"),
    "text": ([(VALUE, "x")], "value is 'x', expected a number"),
    "short": ([(VALUE[:-1],)], "values are not those of the"),
    "mapping": ([(("mapping",), ["q1=a"])], "expected an object"),
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
    changes, words = DAMAGE[case]
    raw = damaged(raw, *changes)
    assert re.search(words, refusal(path, {**raw, "checksums": compute_checksums(raw)}))


EDITED = {
    "value": (("fit", "parameters", 0, "value"), "fit (the values"),
    "covariance": (("covariance", 0, 0), "covariance (uncertainty"),
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
    line = refusal(path, damaged(raw, (keys, changed_a_little)))
    assert f"changed since it was saved, the checksum does not fit: {words}" in line
    assert line.endswith("take the file as it was saved, or fit the model again")


def changed_a_little(value):
    return f"{value} " if isinstance(value, str) else float(np.nextafter(value, 9e9))


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
    assert "JSON, but not a model file" in refusal(path, {"hello": 1})
    text = json.dumps(dict(reversed(raw.items())), indent=1)  # what has no meaning may differ
    path.write_bytes(b"\xef\xbb\xbf" + text.encode().replace(b"\n", b"\r\n"))
    assert load_model(path).beta.tolist() == model.beta.tolist()


TEXTS = {
    "none": (b"", "it is empty"),
    "blank": (b" \n ", "it is blank"),
    "binary": (b"PAR1\x15\x04\xff\x00", "not valid UTF-8 (byte 7"),
    "UTF-16": ('{"kind": 1}'.encode("utf-16"), "UTF-16, UTF-32 or binary"),
    "Latin": ('{"kind": "\u00e9"}'.encode("latin-1"), "not valid UTF-8 (byte 11"),
    "lists": (b"[" * 100_000, "nested too deep"),
    "closed": (b'{"kind":' + b"[" * 100_000 + b"]" * 100_000 + b"}", "nested too deep"),
    "digits": (b'{"format": -' + b"9" * 10_000 + b"}", "a whole number of 10000 digits"),
    "integer": (b'{"format": 99999999999999999999}', "a whole number of 20 digits"),
    "decimals": (b'{"format": 1e999}', "'1e999', too large for double precision"),
    "NaN": (b'{"format": NaN}', "has NaN, which is not a JSON number"),
    "twice": (b'{"format": {"a": 1, "b": 2, "a": 3}}', "has the entry 'a' twice"),
    "half": (b'{"kind": "\\ud800"}', "half a character"),
    "TOML": (b'name = "arm"', "is not JSON, or cut off: Expecting value, line 1, column 1"),
}


@pytest.mark.parametrize("case", TEXTS)
def test_what_is_no_json_is_refused_in_one_line(tmp_path, case):
    content, words = TEXTS[case]
    line = refusal(tmp_path / "arm.model", content)
    assert words in line and "not a model file: it " in line


@pytest.fixture(scope="module")
def saved_text(tmp_path_factory) -> str:
    """The text of a fitted two-link arm's model file."""
    two_link, place = compiled("two-link"), tmp_path_factory.mktemp("model") / "arm.json"
    log = noisy(exact_log(two_link, some_beta(two_link), seconds=10), 0.1)
    save_model(place, chain_of("two-link").fit([log]))
    return place.read_text()


@pytest.mark.digits
def test_a_saved_model_compiles_and_predicts_the_same(saved_text, tmp_path):
    again, item = read(tmp_path / "m.json", saved_text.encode()), compiled("two-link")
    log = exact_log(item, some_beta(item), seconds=1)
    motion = log.q, log.qd, log.qdd
    torque = again.compile().inverse_dynamics(*motion, again.beta)
    np.testing.assert_allclose(torque, item.inverse_dynamics(*motion, again.beta), atol=1e-9)
    np.testing.assert_allclose(torque, log.tau, atol=0.2)


def moved(value, draw: random.Random):
    """The value, a little different."""
    if isinstance(value, bool) or value is None:
        return not value
    if isinstance(value, int):
        return value + draw.choice((-1, 1))
    if isinstance(value, float):
        return draw.choice((float(np.nextafter(value, math.inf)), -value - 1e-9, value * 10 + 1))
    if isinstance(value, str):
        place = draw.randrange(len(value) + 1)
        return value[:place] + draw.choice('0x \n"\\{}é') + value[place:]
    return list(value)[:-1] if isinstance(value, list) else {**value, "more": 1}


def changed_entry(text: str, draw: random.Random, how: str) -> dict:
    """The file's content with one entry replaced, moved a little, left out or repeated."""
    raw = json.loads(text)
    holder, key = raw, draw.choice(sorted(raw))  # every part as often, however long it is
    while isinstance(holder[key], dict | list) and holder[key] and draw.random() < 0.9:
        holder = holder[key]
        key = draw.choice(list(holder) if isinstance(holder, dict) else range(len(holder)))
    if how == "strange":
        holder[key] = copy.deepcopy(draw.choice(VALUES_DRAWN))
    elif how == "moved":
        holder[key] = moved(holder[key], draw)
    elif isinstance(holder, list) and draw.random() < 0.5:
        holder.append(holder[key])
    else:
        del holder[key]
    return raw


def read(place, content: bytes) -> IdentifiedModel | None:
    """The model, or None where it was refused in one line that names the file."""
    place.write_bytes(content)
    try:
        return load_model(place)
    except ModelerError as error:
        line = str(error)
        assert line.startswith(str(place)) and "\n" not in line and len(line) < 700, line
        return None


def resaved(place, model: IdentifiedModel) -> str:
    save_model(place, model)
    return place.read_text()


@pytest.mark.parametrize("how", ["strange", "moved", "number of entries"])
def test_a_changed_entry_is_told(how, saved_text, tmp_path):
    refused = 0
    for seed in range(40):
        raw = changed_entry(saved_text, random.Random(f"{how} {seed}"), how)
        model = read(tmp_path / "m.json", json.dumps(raw).encode())
        if model is None:
            refused += 1
        else:  # what stood there before, an empty list made shorter
            assert json.dumps(raw) == json.dumps(json.loads(saved_text)), seed
    assert refused > 34


BYTES = ("cut", "repeat", "replace", "insert", "flip", "exchange")
TOKENS = (*NUMBERS, "[" * 100_000, "9" * 10_000, "\x00", "\u00e9", " ", "{", '"')


def test_changed_bytes_are_told(saved_text, tmp_path):
    refused = 0
    for seed in range(50):
        draw = random.Random(seed)
        kind, *numbers = draw.choice(BYTES), draw.randrange(10**6), draw.choice((1, 2, 30, 3000))
        edit = (kind, *numbers, draw.randrange(10**6))
        content = edited_bytes(saved_text.encode(), [edit], TOKENS)
        model = read(tmp_path / "m.json", content)
        if model is None:
            refused += 1
        else:  # more white space, 1.50 for 1.5
            assert resaved(tmp_path / "again.json", model) == saved_text, seed
    assert refused > 38


@pytest.mark.parametrize("how", ["strange", "moved", "number of entries"])
def test_whoever_makes_the_checksums_fit_gets_a_line_or_a_model_that_can_be_used(
    how, saved_text, tmp_path
):
    for seed in range(20):
        raw = changed_entry(saved_text, random.Random(f"sealed {how} {seed}"), how)
        try:
            raw["checksums"] = compute_checksums(raw)
        except (ValueError, TypeError):
            continue  # NaN and the like: no checksum makes them fit
        model = read(tmp_path / "m.json", json.dumps(raw).encode())
        if model is not None:
            again = read(tmp_path / "n.json", resaved(tmp_path / "s.json", model).encode())
            assert again is not None and again.beta.tolist() == model.beta.tolist()
            assert model.fit.format_lines() and np.all(np.isfinite(model.covariance))
            assert np.all(np.diag(model.covariance) >= 0.0)


def test_a_changed_robot_text_never_gives_another_robot(saved_text, tmp_path):
    """With checksums that fit: it gives the same C, no robot, or it is reported."""
    message = 0
    for seed in range(16):
        raw, draw = json.loads(saved_text), random.Random(f"robot {seed}")
        text = raw["robot_text"]
        place = draw.choice([i for i, letter in enumerate(text) if letter in "0123456789.-q"])
        raw["robot_text"] = text[:place] + draw.choice("0123456789.-") + text[place + 1 :]
        raw["checksums"] = compute_checksums(raw)
        model = read(tmp_path / "m.json", json.dumps(raw).encode())
        assert model is not None
        try:
            assert compile(model).spec == model.spec
        except ModelerError as error:
            assert "\n" not in str(error)
            message += 1
    assert message > 5
