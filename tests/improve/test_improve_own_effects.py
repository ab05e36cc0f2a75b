"""An effect that only the robot file knows: found on its joint, added, judged, taken out."""

import dataclasses
import re
from pathlib import Path

import numpy as np
import pytest

from modeler import api
from modeler.cli import main
from modeler.core.errors import DataError
from modeler.diagnosis.add import add_effect, undone
from modeler.diagnosis.added_model import Logs
from modeler.estimation.model_file import load_model, save_model
from modeler.observation.log import Log
from modeler.robot.read import robot_from_text
from modeler.runtime.model import load as load_compiled
from tests.chain import chain_of
from tests.diagnose.conftest import Case, motion, on_joint, write_csv
from tests.improve.conftest import BRAKE, CENTRE, DRAG, WIDTH, brake, long_runs
from tests.rotation import rotating_with

OWN = f"""{BRAKE}
[own_effects.cold]
columns = {{Kc = "T*v**3"}}
"""

MEMORIES = """
[own_effects.leaning]
title = "drag that grows with the reach of joint 3"
columns = {Kl = "v*(1 - cos(q3))"}
unit = "N*m*s/rad"

[own_effects.settling]
title = "friction that is higher after a reversal"
columns = {Kt = "sign(v)*exp(-since/w)"}
shapes = {w = [0.05, 0.2, 0.8], back = [0.0003]}
unit = "N*m"

[own_effects.churning]
title = "drag that builds up while the joint moves"
columns = {Kc = "v*z"}
lag = "abs(v)"
shapes = {tau = [0.1, 0.4, 1.6]}
"""


@pytest.fixture(scope="module")
def case() -> Case:
    return long_runs()


@pytest.fixture(scope="module")
def own(case: Case) -> Case:
    """The demonstration arm whose file defines two effects that it has on no joint."""
    return dataclasses.replace(case, chain=chain_of(api.load("demo-arm").text + OWN))


@pytest.mark.rotating("long tests of improve")
def test_it_is_found_added_judged_and_taken_out(own: Case, tmp_path: Path) -> None:
    fitted, train, holdout = own.hidden(brake)
    save_model(tmp_path / "arm.json", fitted)
    model = load_model(tmp_path / "arm.json")  # what a colleague gets: nothing but this file
    diagnosis = api.diagnose(model, [train], [holdout])
    first = diagnosis.effects[0]
    assert (diagnosis.verdict, first.effect, first.joint) == ("missing", "eddy_brake", "2")
    assert len(diagnosis.effects) == 1
    assert first.parameters["Keb2"] == pytest.approx(DRAG, rel=0.04)
    assert first.parameters["c"] == pytest.approx(CENTRE, abs=0.02)
    assert first.parameters["w"] == pytest.approx(WIDTH, rel=0.04)
    assert first.error_after < 0.2 * first.error_before
    assert first.units["Keb2"] == "N*m*s/rad"
    assert "drag of a magnet (eddy_brake), joint 2" in diagnosis.sentences[0]

    logs = Logs([train], [holdout])
    better = add_effect(model, own.compiled, "eddy_brake", None, logs)
    values = {p.name: p.value for p in better.fit.parameters}
    assert values["Keb2"] == pytest.approx(DRAG, rel=0.04)
    assert better.history[1].error < 0.2 * better.history[0].error
    (use,) = [u for u in robot_from_text(better.robot_text, "b").effects if u.shaped]
    assert (use.effect, use.joints) == ("eddy_brake", ("2",))
    assert use.instances[0].shapes["c"] == pytest.approx(CENTRE, abs=0.02)

    with pytest.raises(DataError, match="joint 2 has it in this model already"):
        compiled = load_compiled(better.spec, better.sources)
        add_effect(better, compiled, "eddy_brake", "2", logs)
    back = undone(better, logs)
    assert back.robot_text == model.robot_text
    np.testing.assert_allclose(back.beta, model.beta, rtol=1e-9)


@pytest.fixture(scope="module")
def remembering(case: Case) -> Case:
    """The arm whose file defines effects that read other joints."""
    return dataclasses.replace(case, chain=chain_of(api.load("demo-arm").text + MEMORIES))


@pytest.mark.rotating("effects are added to simulated runs")
def test_one_that_reads_another_joint_is_added_where_it_acts(remembering: Case) -> None:
    def leaning(log: Log) -> np.ndarray:
        q, v = motion(log)
        return on_joint(log, 1, 6.0 * v[:, 1] * (1.0 - np.cos(q[:, 2])))

    model, train, holdout = remembering.hidden(leaning)
    logs = Logs([train], [holdout])
    better = add_effect(model, remembering.compiled, "leaning", None, logs)
    assert better.history[1].joint == "2"
    found = {p.name: p for p in better.fit.parameters}["Kl2"]
    assert found.sigma is not None and abs(found.value - 6.0) < 3.0 * found.sigma
    assert better.history[1].error < 0.2 * better.history[0].error
    with pytest.raises(DataError, match="--joint 3: leaning reads q3 of it as of another joint"):
        add_effect(model, remembering.compiled, "leaning", "3", logs)


@pytest.mark.rotating("effects are added to simulated runs")
def test_one_that_reads_the_time_since_a_reversal_is_found_with_its_shape(
    remembering: Case,
) -> None:
    def settling(log: Log) -> np.ndarray:
        _, v = motion(log)
        way = np.sign(np.convolve(v[:, 0], np.ones(31), mode="same"))  # commands have steps too
        turned = np.append(log.time[0], log.time[1:][way[1:] * way[:-1] < 0.0])
        since = log.time - turned[np.searchsorted(turned, log.time, side="right") - 1]
        return on_joint(log, 0, 3.0 * np.tanh(v[:, 0] / 0.002) * np.exp(-since / 0.33))

    model, train, holdout = remembering.hidden(settling)
    logs = Logs([train], [holdout])
    better = add_effect(model, remembering.compiled, "settling", "1", logs)
    found, last = {p.name: p for p in better.fit.parameters}["Kt1"], better.history[1]
    assert found.sigma is not None and abs(found.value - 3.0) < 3.0 * found.sigma
    assert abs(last.shapes["w"] - 0.33) < 3.0 * last.shape_sigmas["w"]
    assert last.error < 0.2 * better.history[0].error
    assert [s.kind for s in better.spec.signals] == ["direction", "since"]


@pytest.mark.rotating("effects are added to simulated runs")
def test_a_lag_is_found_with_its_time(remembering: Case) -> None:
    def churning(log: Log) -> np.ndarray:
        v = motion(log)[1][:, 1]
        z, step = np.full(len(v), abs(v[0])), log.time[1] - log.time[0]
        for k, x in enumerate(0.5 * (np.abs(v[1:]) + np.abs(v[:-1]))):
            z[k + 1] = z[k] + (x - z[k]) * step / (0.7 + 0.5 * step)
        return on_joint(log, 1, 4.0 * v * z)

    model, train, holdout = remembering.hidden(churning)
    logs = Logs([train], [holdout])
    better = add_effect(model, remembering.compiled, "churning", "2", logs)
    found, last = {p.name: p for p in better.fit.parameters}["Kc2"], better.history[1]
    assert found.sigma is not None and abs(found.value - 4.0) < 3.0 * found.sigma
    assert abs(last.shapes["tau"] - 0.7) < 3.0 * last.shape_sigmas["tau"] < 0.15
    assert last.error < 0.2 * better.history[0].error
    (effect,) = [e for e in remembering.derivation.robot.own_effects if e.id == "churning"]
    assert effect.equation == "Kc * (v*z), z' = (abs(v) - z)/tau"


@pytest.mark.rotating("effects are added to simulated runs")
def test_without_the_definition_the_catalogue_is_all_there_is(own: Case) -> None:
    model, train, holdout = own.hidden(brake)
    bare = dataclasses.replace(model, robot_text=model.robot_text.replace(OWN, ""))
    diagnosis = api.diagnose(bare, [train], [holdout])
    assert "eddy_brake" not in {f.effect for f in (*diagnosis.effects, *diagnosis.refinements)}
    with pytest.raises(DataError, match="eddy_brake: no such effect"):
        add_effect(bare, own.compiled, "eddy_brake", "2", Logs([train]))


@pytest.mark.rotating("effects are added to simulated runs")
def test_nothing_is_named_where_nothing_is_hidden(own: Case) -> None:
    diagnosis = api.diagnose(own.fitted(own.train), [own.train], [own.holdout])
    assert diagnosis.verdict == "nothing significant" and not diagnosis.effects


@rotating_with("effects are added")
def test_one_that_reads_a_temperature_is_tried_where_one_is_logged(own: Case) -> None:
    def heat(log: Log) -> np.ndarray:
        return 30.0 + 20.0 * (1.0 - np.exp(-log.time / 12.0))

    def cold(log: Log) -> np.ndarray:
        _, v = motion(log)
        return on_joint(log, 2, 0.1 * (heat(log) - mean) * v[:, 2] ** 3)

    mean = float(np.mean(heat(own.train)))  # of the logs that are fitted: there T is 0
    model, train, holdout = own.hidden(cold)
    logs = Logs([train], [holdout])
    with pytest.raises(DataError, match="cold: these logs show nothing of it"):
        add_effect(model, own.compiled, "cold", "3", logs)
    warm = [dataclasses.replace(log, extra={"temperature": heat(log)}) for log in (train, holdout)]
    first = api.diagnose(model, warm[:1], warm[1:]).effects[0]
    assert (first.effect, first.joint) == ("cold", "3")
    better = add_effect(model, own.compiled, "cold", "3", Logs(warm[:1], warm[1:]))
    values = {p.name: p.value for p in better.fit.parameters}
    assert values["Kc3"] == pytest.approx(0.1, rel=0.1)
    (use,) = [u for u in robot_from_text(better.robot_text, "b").effects if u.shaped]
    assert use.instances[0].shapes["T0"] == pytest.approx(mean, abs=0.5)


@pytest.mark.rotating("long tests of improve")
def test_commands(own: Case, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """fit, diagnose, add, undo and the page of the effect, as a user types them."""
    _, train, holdout = own.hidden(brake)
    place = {name: str(tmp_path / name) for name in ("arm.toml", "r.toml", "m", "m2", "m1")}
    Path(place["arm.toml"]).write_text(own.derivation.robot.text, encoding="utf-8")
    logs = [
        str(write_csv(tmp_path / f"{name}.csv", log))
        for name, log in (("train", train), ("holdout", holdout))
    ]
    assert main(["effects", "eddy_brake", "--robot", place["arm.toml"]]) == 0
    out = capsys.readouterr().out
    assert "drag of a magnet" in out and "N*m*s/rad" in out and "first tried at -1 0 1" in out
    assert "*****" in out and "torque against position" in out  # the picture
    assert main(["effects", "--robot", place["arm.toml"]]) == 0
    assert "cold" in capsys.readouterr().out
    assert main(["effects", "eddy_brak", "--robot", place["arm.toml"]]) == 1
    assert 'did you mean "eddy_brake"' in capsys.readouterr().err
    assert main(["effects", "eddy_brake"]) == 1
    assert "or one that the file of --robot defines" in capsys.readouterr().err

    assert main(["fit", place["arm.toml"], logs[0], "--out", place["m"]]) == 0
    words = [place["m"], logs[0], "--holdout", logs[1]]
    capsys.readouterr()
    assert main(["diagnose", *words, "--report", str(tmp_path / "d.html")]) == 0
    assert "missing: drag of a magnet (eddy_brake), joint 2" in capsys.readouterr().out
    page = (tmp_path / "d.html").read_text(encoding="utf-8")
    assert "drag of a magnet" in page and "Why not another effect" in page
    assert "http://" not in page.split("<script>")[0]
    assert main(["diagnose", *words, "--without", "eddy_brak"]) == 1
    assert re.search(r'no such effect \(did you mean "eddy_brake"\?\)', capsys.readouterr().err)

    words = [logs[0], "--holdout", logs[1], "--robot-out", place["r.toml"], "--out"]
    assert main(["add", place["m"], "eddy_brake", "--joint", "2", *words, place["m2"]]) == 0
    assert "+ eddy_brake @2" in capsys.readouterr().out
    assert "eddy_brake = [{joint" in Path(place["r.toml"]).read_text(encoding="utf-8")
    assert main(["derive", place["r.toml"], "--no-terms"]) == 0
    assert "Keb2 = Keb2" in capsys.readouterr().out
    assert main(["add", place["m2"], "undo", *words, place["m1"]]) == 0
    assert "eddy_brake = [" not in Path(place["r.toml"]).read_text(encoding="utf-8")
