"""Real machines: the effects that others found on them by hand; more in `docs/studies`.

The logs are not part of the project; without them these tests are skipped.
"""

from pathlib import Path

import pytest

from modeler.api import compare, diagnose, read_logs
from modeler.core.choices import read_builtin_robot
from modeler.diagnosis.add import add_effect
from modeler.diagnosis.added_model import LogSplit
from modeler.diagnosis.result import Diagnosis
from modeler.estimation.model_file import IdentifiedModel
from modeler.runtime.model import load_module as load_compiled
from tests.chain import chain_of
from tests.measured_sets.sets import DATA, SETS
from tests.rotation import slow_rotating

pytestmark = [
    pytest.mark.measured,
    pytest.mark.skipif(
        not DATA.is_dir(), reason=f"measured logs are not here: {DATA.parent.name}/{DATA.name}"
    ),
]


def logs(name: str) -> tuple[list[Path], list[Path]]:
    """What is fitted, and what is held out."""
    training, held_out = SETS[name].logs(DATA, "forward")
    return [*map(Path, training)], [*map(Path, held_out)]


def diagnosed(name: str, robot: str | None = None) -> Diagnosis:
    training, held_out = logs(name)
    return diagnose(chain_of(robot or SETS[name].robot()).fit(training), training, held_out)


@pytest.fixture(scope="module")
def ur10e_model() -> IdentifiedModel:
    return chain_of("ur10e").fit(logs("ur10e")[0])


def test_emps_has_friction_that_differs_between_the_directions() -> None:
    """What the benchmark's authors found by hand, and the delay that others found."""
    result = diagnosed("emps")
    assert [f.effect for f in result.effects[:2]] == ["asymmetric_viscous", "time_delay"]
    assert result.effects[0].parameters["Fva1"] == pytest.approx(-37.0, abs=3.0)
    assert result.joints["1"].error_after < 0.031


@slow_rotating("measured logs are diagnosed")
def test_ur10e_the_errors_fall_as_effects_are_added(ur10e_model: IdentifiedModel) -> None:
    model, (training, held_out) = ur10e_model, logs("ur10e")
    compiled = load_compiled(model.spec, model.sources)
    data = LogSplit(read_logs(compiled, training), read_logs(compiled, held_out))
    for law, joint in (("load_friction", "2"), ("load_friction", "3"), ("nonlinear_viscous", "1")):
        model = add_effect(model, load_compiled(model.spec, model.sources), law, joint, data)
    errors = {j.joint.name: j.relative_error for j in compare(model, held_out).joints}
    assert errors["1"] < 0.07 and errors["2"] < 0.018 and errors["3"] < 0.016


@slow_rotating("measured logs are diagnosed")
def test_ur10e_a_load_is_found_first_with_its_mass(ur10e_model: IdentifiedModel) -> None:
    result = diagnose(ur10e_model, [DATA / "ur10e" / "ur-20_02_19_14harm50secLoad.parquet@:1912"])
    assert result.effects[0].effect == "payload"
    assert result.effects[0].parameters["mass"] == pytest.approx(2.805, rel=0.1)


@slow_rotating("measured logs are diagnosed")
def test_tx40_the_motor_of_joint_6_turns_joint_5_too() -> None:
    """From a robot file that couples nothing; errors below those of the published model."""
    text = read_builtin_robot("tx40").partition("[coupling]")[0]
    coupled = 'coupled_inertia = ["6"]\ncoupled_friction = ["6"]'
    assert coupled in text
    result = diagnosed("tx40", text.replace(coupled, ""))
    named = {(f.effect, f.joint) for f in result.effects if f.status != "possible"}
    assert ("coupled_friction", "6") in named
    assert result.joints["5"].error_before > 1.0
    after = {name: joint.error_after for name, joint in result.joints.items()}
    assert after["2"] < 0.066 and after["3"] < 0.091 and after["4"] < 0.09 and after["5"] < 0.23
