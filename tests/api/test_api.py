"""The Python API does what the commands do, and refuses in one line what cannot be."""

import hashlib
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import modeler.api as api
from modeler.cli import main
from modeler.core.errors import DataError, ModelerError
from modeler.core.files import compute_checksum
from modeler.estimation.payload import Payload


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("api")


@pytest.fixture(scope="module")
def logs(folder: Path) -> tuple[str, str]:
    """Two runs of a link with a load on it that the file lacks: its first joint has a spring."""
    places = []
    for seed in (1, 2):
        place = folder / f"run{seed}.parquet"
        api.simulate(api.load("two-link"), place, hide=["spring@1"], duration=8.0, seed=seed)
        places.append(str(place))
    return places[0], places[1]


@pytest.fixture(scope="module")
def chain(logs: tuple[str, str]) -> tuple[Any, Any, Any]:
    """Derivation, C and observation of the first run."""
    derivation = api.derive(api.load("two-link"))
    emitted = api.generate(derivation)
    return derivation, emitted, api.observe(api.compile_model(emitted), [logs[0]])


@pytest.fixture(scope="module")
def model(chain: tuple[Any, Any, Any]) -> Any:
    return api.fit(*chain)


@pytest.mark.rotating("long tests of api")
@pytest.mark.parametrize("options", ["--method robust", "--model energy", "--method consistent"])
def test_every_way_to_fit_is_that_of_the_command(tmp_path, chain, logs, options: str) -> None:
    words = options.split()
    method = words[1] if words[:1] == ["--method"] else "weighted"
    model = api.fit(*chain, method, energy="energy" in words)
    place = tmp_path / "c.json"
    assert main(["fit", "two-link", logs[0], "--out", str(place), *words]) == 0
    fitted = api.open_model(place)
    assert fitted.fit.method == model.fit.method
    assert_allclose(model.beta, fitted.beta, rtol=1e-9)
    assert model.fit.verdict == fitted.fit.verdict


def test_a_look_at_a_log(folder: Path, chain, logs) -> None:
    seen = api.inspect_log(logs[0])
    assert {"q1", "q2", "tau1", "tau2"} <= set(seen.table().column("channel"))
    assert "no warnings" in seen.summary() and len(repr(seen)) < 200
    assert seen.plot()._repr_png_().startswith(b"\x89PNG")
    assert api.write_report(seen, folder / "log.html").exists()
    piece = api.inspect_log(f"{logs[0]}@1:3", api.compile_model(chain[1]))
    assert piece.clock.duration == pytest.approx(2.0, abs=0.01)


def test_a_model_is_saved_opened_and_reduced(tmp_path: Path, model) -> None:
    again = api.open_model(api.save(model, tmp_path / "m.json"))
    np.testing.assert_array_equal(again.beta, model.beta)
    assert again.fit.to_json() == model.fit.to_json()
    small = api.reduced_model(model)
    assert np.count_nonzero(small.beta) == len(model.fit.essential.parameters)
    robot = api.load("two-link")
    assert api.load(api.save(robot, tmp_path / "r.toml")).text == robot.text


def test_a_model_says_where_its_logs_lay_and_what_they_were(tmp_path, chain, logs) -> None:
    derivation, emitted, _ = chain
    compiled = api.compile_model(emitted)
    read, piece = api.read_logs(compiled, [logs[0], f"{logs[1]}@1:7"])
    model = api.fit(derivation, emitted, api.observe(compiled, [read, piece]))
    bytes_ = [hashlib.sha256(Path(place).read_bytes()).hexdigest() for place in logs]
    assert [log.path for log in model.logs] == [logs[0], f"{logs[1]}@1:7"]
    assert [log.checksum for log in model.logs] == bytes_
    again = api.open_model(api.save(model, tmp_path / "m.json"))
    assert again.logs == model.logs
    run = api.simulate(api.load("two-link"), duration=4.0, seed=3)
    pathless = api.fit(derivation, emitted, api.observe(compiled, run))
    assert [(log.path, log.checksum) for log in pathless.logs] == [("", "")]
    texts = api.generate(model).code.values()  # the C says nothing of logs
    assert not any(logs[0] in text or Path(logs[0]).name in text for text in texts)


def test_a_folder_has_the_checksum_of_what_lies_in_it(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / name / "deep").mkdir(parents=True)
        (tmp_path / name / "x.csv").write_text("1")
        (tmp_path / name / "deep" / "y.csv").write_text("2")
    assert compute_checksum(tmp_path / "a") == compute_checksum(tmp_path / "b")
    (tmp_path / "b" / "deep" / "y.csv").rename(tmp_path / "b" / "y.csv")
    moved = compute_checksum(tmp_path / "b")
    assert moved != compute_checksum(tmp_path / "a")
    (tmp_path / "b" / "y.csv").write_text("changed")
    assert compute_checksum(tmp_path / "b") != moved


def test_add_and_undo(model, logs) -> None:
    better = api.add(model, "spring", [logs[0]], [logs[1]], joint="1")
    waterfall = better.table("waterfall")
    assert waterfall.column("effect") == ["as fitted", "spring"]
    assert waterfall.column("error")[1] < 0.8 * waterfall.column("error")[0]
    back = api.remove_last(better, [logs[0]])
    assert_allclose(back.beta, model.beta, rtol=1e-9)


def test_compare_in_free_run_is_free_run(model, logs) -> None:
    run = api.compare(model, logs[1:], free_run=True, window=0.2)
    assert run.window == 0.2
    assert run.to_json() == api.free_run(model, logs[1:], api.FreeRunSettings(window=0.2)).to_json()


def test_home_is_that_of_the_command(tmp_path: Path) -> None:
    robot = api.load("five-bar")
    found = api.home(robot)
    assert main(["home", "five-bar", "--json", str(tmp_path / "h.json")]) == 0
    result = json.loads((tmp_path / "h.json").read_text())["modes"]
    assert found.table().column("mode") == [mode["letter"] for mode in result]
    other = next(mode.letter for k, mode in enumerate(found.modes) if k != found.stated_index)
    turned = api.home_posture(robot, found, other)
    again = api.home(turned)
    assert again.stated_index is not None
    place = [mode.letter for mode in found.modes].index(other)
    assert_allclose(again.modes[again.stated_index].posture, found.modes[place].posture, atol=1e-6)
    one = api.home(robot, near={robot.coordinates[0].name: 1.2})
    given = found.linkage.loops.actuated[0]
    assert one.modes[0].posture[given] == pytest.approx(1.2)


def test_physical_values_are_those_of_the_command(tmp_path: Path, model) -> None:
    found = api.physical(model)
    known = ",".join(f"{letter}=0.1" for letter in found.find_known_sets().easiest_sets[0])
    values = found.compute_values(known)
    assert found.derive_formulas(",".join(found.find_known_sets().easiest_sets[0])).steps
    with pytest.raises(DataError, match="expected names alone"):
        api.physical(api.load("two-link")).compute_values(known)
    api.save(model, tmp_path / "m.json")
    words = ["--known", known, "--json", str(tmp_path / "p.json")]
    assert main(["physical", str(tmp_path / "m.json"), *words]) == 0
    result = json.loads((tmp_path / "p.json").read_text())["values"]["parameters"]
    assert values.table().column("parameter") == [row["parameter"] for row in result]
    assert values.table().column("value") == pytest.approx([row["value"] for row in result])
    assert values.table().column("sigma") == pytest.approx([row["sigma"] for row in result])


def fit(**options: Any) -> Callable[[Any, Any], object]:
    return lambda chain, logs: api.fit(*chain, **options)


def excite(**options: Any) -> Callable[[Any, Any], object]:
    return lambda chain, logs: api.excite(api.load("two-link"), **options)


LOADS = [Payload(("run1.parquet",), None, 1.0)]
REFUSED: dict[str, tuple[Callable[[Any, Any], object], str]] = {
    "method": (fit(method="best"), "got method best.*expected one of weighted"),
    "gains": (fit(method="tls"), "call fit_gains"),
    "energy": (fit(method="ridge", energy=True), "energy model does not take method ridge"),
    "window": (fit(window=0.1), "a window needs the energy model"),
    "loads": (fit(method="iv", payloads=LOADS), "method iv takes no logs with a load"),
    "loads and energy": (fit(energy=True, payloads=LOADS), "the energy model takes no logs"),
    "limits": (excite(limits={"1": (1.0, 2.0)}), "limits 1=.*: expected 1=LOWER,UPPER,SPEED"),
    "joint": (excite(boxes={"9": (0,) * 6}), "boxes 9=.*: no moving joint 9"),
    "wish": (excite(speed=3), "excite: got speed; expected some of .*duration"),
    "slip": (
        lambda chain, logs: api.add(api.fit(*chain), "spring", logs, joints="1"),
        r'add: got joints; expected some of joint, .*learned \(did you mean "joint"\?\)$',
    ),
    "option alone": (
        lambda chain, logs: api.compare(api.fit(*chain), logs, window=1.0),
        "window: needs free_run",
    ),
    "setting": (
        lambda chain, logs: api.simulate(api.load("emps"), colour="red"),
        "got colour; expected some of .*duration",
    ),
    "suffix": (
        lambda chain, logs: api.simulate(api.load("emps"), "run.txt", duration=1e6),
        "got suffix .txt",
    ),
    "apart": (
        lambda chain, logs: api.discriminating_motion(api.fit(*chain), "spring@1", "ghost@1"),
        "discriminating_motion: ghost@1: no such effect",
    ),
    "estimators": (
        lambda chain, logs: api.compare_methods(api.load("two-link"), logs, methods=["x"]),
        "methods: got x",
    ),
    "rows twice": (
        lambda chain, logs: api.compare_methods(api.load("two-link"), logs, logs[:1]),
        "shares rows",
    ),
    "one model": (lambda chain, logs: api.compare_models({}, logs), "got 0 models"),
    "home": (
        lambda chain, logs: api.home(api.load("five-bar"), near={"nine": 1.0}),
        "near names joint nine",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_is_refused_in_one_line(chain, logs, case: str) -> None:
    run, words = REFUSED[case]
    with pytest.raises(ModelerError, match=words) as caught:
        run(chain, logs)
    assert "\n" not in str(caught.value)
