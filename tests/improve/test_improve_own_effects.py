"""An effect that only the robot file knows: found on its joint, added, judged, taken out."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from modeler import api
from modeler.core.errors import DataError
from modeler.diagnosis.add import add_effect, remove_last_effect
from modeler.diagnosis.added_model import LogSplit
from modeler.estimation.model_file import load_model, save_model
from modeler.regression.log import Log
from modeler.robot.read import parse_robot_text
from modeler.runtime.model import load_module as load_compiled
from tests.chain import chain_of
from tests.diagnose.conftest import Case, Run, motion, on_joint
from tests.improve.conftest import BRAKE, CENTRE, DRAG, WIDTH, brake, long_runs

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

    logs = LogSplit([train], [holdout])
    better = add_effect(model, own.compiled, "eddy_brake", None, logs)
    assert better.history[1].error < 0.2 * better.history[0].error
    (use,) = [u for u in parse_robot_text(better.robot_text, "b").effects if u.stated_instances]
    assert (use.effect, use.joints) == ("eddy_brake", ("2",))
    assert use.instances[0].nonlinear_parameters["c"] == pytest.approx(CENTRE, abs=0.02)
    with pytest.raises(DataError, match="joint 2 has it in this model already"):
        compiled = load_compiled(better.spec, better.sources)
        add_effect(better, compiled, "eddy_brake", "2", logs)
    back = remove_last_effect(better, logs)
    assert back.robot_text == model.robot_text
    np.testing.assert_allclose(back.beta, model.beta, rtol=1e-9)


@pytest.fixture(scope="module")
def remembering(case: Case) -> Case:
    """The arm whose file defines effects that read other joints."""
    return dataclasses.replace(case, chain=chain_of(api.load("demo-arm").text + MEMORIES))


def leaning(log: Log) -> np.ndarray:
    q, v = motion(log)
    return on_joint(log, 1, 6.0 * v[:, 1] * (1.0 - np.cos(q[:, 2])))


def settling(log: Log) -> np.ndarray:
    _, v = motion(log)
    way = np.sign(np.convolve(v[:, 0], np.ones(31), mode="same"))  # commands have steps too
    turned = np.append(log.time[0], log.time[1:][way[1:] * way[:-1] < 0.0])
    since = log.time - turned[np.searchsorted(turned, log.time, side="right") - 1]
    return on_joint(log, 0, 3.0 * np.tanh(v[:, 0] / 0.002) * np.exp(-since / 0.33))


#            torque, joint requested, joint found, parameter, its value, shapes, signals
REMEMBERED = {
    "leaning": (leaning, None, "2", "Kl2", 6.0, {}, []),
    "settling": (settling, "1", "1", "Kt1", 3.0, {"w": 0.33}, ["direction", "since"]),
}


@pytest.mark.rotating("effects are added to simulated runs")
@pytest.mark.parametrize("effect", REMEMBERED)
def test_one_that_reads_another_joint_or_remembers_is_found_with_its_values(remembering, effect):
    torque, asked, joint, name, value, shapes, signals = REMEMBERED[effect]
    model, train, holdout = remembering.hidden(torque)
    logs = LogSplit([train], [holdout])
    better = add_effect(model, remembering.compiled, effect, asked, logs)
    last, parameter = better.history[1], {p.name: p for p in better.fit.parameters}[name]
    assert last.joint == joint and last.error < 0.2 * better.history[0].error
    assert parameter.sigma is not None and abs(parameter.value - value) < 3.0 * parameter.sigma
    for shape, true in shapes.items():
        assert abs(last.nonlinear_parameters[shape] - true) < 3.0 * last.nonlinear_sigmas[shape]
    assert [s.kind for s in better.spec.signals] == signals
    if effect == "leaning":
        with pytest.raises(DataError, match="--joint 3: leaning reads q3 of it as of another jo"):
            add_effect(model, remembering.compiled, "leaning", "3", logs)


@pytest.mark.rotating("effects are added to simulated runs")
def test_one_that_reads_a_temperature_is_added_where_one_is_logged(own: Case) -> None:
    def heat(log: Log) -> np.ndarray:
        return 30.0 + 20.0 * (1.0 - np.exp(-log.time / 12.0))

    def cold(log: Log) -> np.ndarray:
        return on_joint(log, 2, 0.1 * (heat(log) - mean) * motion(log)[1][:, 2] ** 3)

    mean = float(np.mean(heat(own.train)))  # of the logs that are fitted: there T is 0
    model, *logs = own.hidden(cold)
    with pytest.raises(DataError, match="cold: these logs show nothing of it"):
        add_effect(model, own.compiled, "cold", "3", LogSplit(logs[:1], logs[1:]))
    warm = [dataclasses.replace(log, extra={"temperature": heat(log)}) for log in logs]
    better = add_effect(model, own.compiled, "cold", "3", LogSplit(warm[:1], warm[1:]))
    values = {p.name: p.value for p in better.fit.parameters}
    assert values["Kc3"] == pytest.approx(0.1, rel=0.1)
    (use,) = [u for u in parse_robot_text(better.robot_text, "b").effects if u.stated_instances]
    assert use.instances[0].nonlinear_parameters["T0"] == pytest.approx(mean, abs=0.5)


def test_the_page_of_an_effect(tmp_path: Path, run: Run) -> None:
    place = tmp_path / "arm.toml"
    place.write_text(api.load("demo-arm").text + OWN, encoding="utf-8")
    _, out, _ = run("effects", "eddy_brake", "--robot", place)
    assert "drag of a magnet" in out and "N*m*s/rad" in out and "first tried at -1 0 1" in out
    assert "cold" in run("effects", "--robot", place)[1]
    status, _, err = run("effects", "eddy_brak", "--robot", place)
    assert status == 1 and 'did you mean "eddy_brake"' in err
    status, _, err = run("effects", "eddy_brake")
    assert status == 1 and "or one that the file of --robot defines" in err
