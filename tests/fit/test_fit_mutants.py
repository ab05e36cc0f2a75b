"""A real model file, changed in hundreds of ways: read as it was saved, or refused in one line."""

import copy
import dataclasses
import json
import math
import random

import numpy as np
import pytest
from test_observation_rows import exact_log, some_beta

from modeler.api import recompile
from modeler.core.errors import ModelerError
from modeler.estimation.identify import identify
from modeler.estimation.model_file import (
    IdentifiedModel,
    checksums,
    load_model,
    provenance,
    save_model,
)
from modeler.observation.observe import observe
from tests.modules import compiled, module

MANY_DIGITS = "a whole number of 10 000 digits"
STRANGE = [
    None, True, False, 0, -1, 1e-300, -7.5, 2**62, 10**40, MANY_DIGITS, "", "x", "1.0", "\x00",
    "\ud800", "../../x", "\u202e", "é" * 3000, [], [[]], {}, {"": None}, [1e308] * 3,
    math.nan, math.inf, -math.inf,
]  # fmt: skip


@pytest.fixture(scope="module")
def saved(tmp_path_factory) -> str:
    """The text of a fitted two-link arm's model file."""
    model, two_link = module("two-link"), compiled("two-link")
    log = exact_log(two_link, some_beta(two_link), seconds=10)
    noise = np.random.default_rng(0).normal(0.0, 0.1, log.tau.shape)
    seen = observe(two_link, [dataclasses.replace(log, tau=log.tau + noise)])
    place = tmp_path_factory.mktemp("model") / "arm.json"
    text, emitted = model.model.robot.text, model.emitted
    save_model(place, IdentifiedModel(text, emitted.spec, emitted.files, identify(seen),
                                      provenance(seen.report)))  # fmt: skip
    return place.read_text()


def test_a_saved_model_compiles_and_predicts_the_same(saved, tmp_path):
    again, own = read(tmp_path / "m.json", saved.encode()), compiled("two-link")
    log = exact_log(own, some_beta(own), seconds=1)
    motion = log.q, log.qd, log.qdd
    torque = again.compile().inverse_dynamics(*motion, again.beta)
    np.testing.assert_allclose(torque, own.inverse_dynamics(*motion, again.beta), atol=1e-9)
    np.testing.assert_allclose(torque, log.tau, atol=0.2)


def entries(raw, above=()):
    """Paths to everything in it."""
    for key in raw if isinstance(raw, dict) else range(len(raw)):
        yield (*above, key)
        if isinstance(raw[key], dict | list):
            yield from entries(raw[key], (*above, key))


def inner(raw, path):
    for key in path[:-1]:
        raw = raw[key]
    return raw, path[-1]


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
    top = draw.choice(sorted(raw))  # every part as often, however long it is
    paths = [path for path in entries(raw) if path[0] == top]
    holder, key = inner(raw, draw.choice(paths))
    if how == "strange":
        holder[key] = copy.deepcopy(draw.choice(STRANGE))
    elif how == "moved":
        holder[key] = moved(holder[key], draw)
    elif isinstance(holder, list) and draw.random() < 0.5:
        holder.append(holder[key])
    else:
        del holder[key]
    return raw


def text_of(raw) -> bytes:
    return json.dumps(raw).replace(f'"{MANY_DIGITS}"', "9" * 10_000).encode()


def changed_bytes(data: bytes, draw: random.Random) -> bytes:
    """Bits turned, bytes put in or taken out, the file cut off, or a piece of it repeated."""
    place, size = draw.randrange(len(data)), draw.choice((1, 1, 2, 30, 3000))
    kind = draw.randrange(6)
    if kind == 0:
        turned = bytes([data[place] ^ (1 << draw.randrange(8))])
        return data[:place] + turned + data[place + 1 :]
    if kind == 1:
        return data[:place] + draw.randbytes(size) + data[place:]
    if kind == 2:
        return data[:place] + data[place + size :]
    if kind == 3:
        return data[:place]
    if kind == 4:
        return data[:place] + data[place : place + size] + data[place:]
    return data[:place] + draw.choice((b"[" * 100_000, b"9" * 10_000, b"\xff\xfe")) + data[place:]


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
def test_a_changed_entry_is_told(how, saved, tmp_path):
    refused = 0
    for seed in range(40):
        raw = changed_entry(saved, random.Random(f"{how} {seed}"), how)
        model = read(tmp_path / "m.json", text_of(raw))
        if model is None:
            refused += 1
        else:  # what stood there before, an empty list made shorter
            assert json.dumps(raw) == json.dumps(json.loads(saved)), seed
    assert refused > 34


def test_changed_bytes_are_told(saved, tmp_path):
    refused = 0
    for seed in range(50):
        content = changed_bytes(saved.encode(), random.Random(seed))
        model = read(tmp_path / "m.json", content)
        if model is None:
            refused += 1
        else:  # more white space, 1.50 for 1.5
            assert resaved(tmp_path / "again.json", model) == saved, seed
    assert refused > 38


@pytest.mark.parametrize("how", ["strange", "moved", "number of entries"])
def test_whoever_makes_the_checksums_fit_gets_a_line_or_a_model_that_can_be_used(
    how, saved, tmp_path
):
    for seed in range(40):
        raw = changed_entry(saved, random.Random(f"sealed {how} {seed}"), how)
        try:
            raw["checksums"] = checksums(raw)
        except (ValueError, TypeError):
            continue  # NaN and the like: no checksum makes them fit
        model = read(tmp_path / "m.json", text_of(raw))
        if model is not None:
            again = read(tmp_path / "n.json", resaved(tmp_path / "s.json", model).encode())
            assert again is not None and again.beta.tolist() == model.beta.tolist()
            assert model.fit.lines() and np.all(np.isfinite(model.covariance))
            assert np.all(np.diag(model.covariance) >= 0.0)


def test_a_changed_robot_text_never_gives_another_robot(saved, tmp_path):
    """With checksums that fit: it gives the same C, no robot, or it is told."""
    told = 0
    for seed in range(16):
        raw, draw = json.loads(saved), random.Random(f"robot {seed}")
        text = raw["robot_text"]
        place = draw.choice([i for i, letter in enumerate(text) if letter in "0123456789.-q"])
        raw["robot_text"] = text[:place] + draw.choice("0123456789.-") + text[place + 1 :]
        raw["checksums"] = checksums(raw)
        model = read(tmp_path / "m.json", json.dumps(raw).encode())
        assert model is not None
        try:
            assert recompile(model).spec == model.spec
        except ModelerError as error:
            assert "\n" not in str(error)
            told += 1
    assert told > 5
