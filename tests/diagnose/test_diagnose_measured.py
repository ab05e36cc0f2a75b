"""Real machines: the effects that others found on them by hand.

The logs are not part of the project; without them these tests are skipped.
"""

from pathlib import Path

import pytest

from modeler.api import compare, diagnose, read_logs
from modeler.core.builtin import builtin_text
from modeler.diagnosis.add import add_effect
from modeler.diagnosis.added_model import Logs
from modeler.estimation.model_file import IdentifiedModel
from modeler.runtime.model import load as load_compiled
from tests.chain import chain_of
from tests.rotation import rotating_with

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"

pytestmark = [
    pytest.mark.measured,
    pytest.mark.skipif(
        not DATA.is_dir(), reason=f"measured logs are not here: {DATA.parent.name}/{DATA.name}"
    ),
]


def logs(folder: str, *names: str) -> list[Path]:
    return [DATA / folder / f"{name}.parquet" for name in names]


def pieces(seconds: str, *logs: Path) -> list[Path]:
    """A part of every log."""
    return [Path(f"{log}@{seconds}") for log in logs]


def fitted(robot: str, training: list[Path]) -> IdentifiedModel:
    return chain_of(robot).fit(training)


def ur10e(*names: str) -> list[Path]:
    return logs("ur10e", *(f"ur-20_{name}" for name in names))


TRAINING = ur10e("02_19_14harm50sec", "02_12-50sec_12harm", "02_05-20sec_8harm")
HELD_OUT = ur10e("02_19_15harm50sec", "01_17-ptp_10_points")
PARTS = [*pieces(":865", TRAINING[0]), *pieces(":825", TRAINING[1]), TRAINING[2]]


@pytest.fixture(scope="module")
def ur10e_model() -> IdentifiedModel:
    return fitted("ur10e", TRAINING)


def test_emps_has_friction_that_differs_between_the_directions() -> None:
    """What the benchmark's authors found by hand, and the delay that others found."""
    model = fitted("emps", logs("emps", "train"))
    found = diagnose(model, logs("emps", "train"), logs("emps", "pulses"))
    assert [f.effect for f in found.effects[:2]] == ["asymmetric_viscous", "time_delay"]
    assert found.effects[0].parameters["Fva1"] == pytest.approx(-37.0, abs=3.0)
    assert found.joints["1"].error_after < 0.031


@rotating_with("measured logs are diagnosed")
def test_ur10e_rubs_with_its_load_on_joints_2_and_3() -> None:
    found = diagnose(fitted("ur10e", PARTS), PARTS, [*pieces(":1105", HELD_OUT[0]), HELD_OUT[1]])
    first = {(f.effect, f.joint) for f in found.effects[:2]}
    assert first == {("load_friction", "2"), ("load_friction", "3")}


@rotating_with("measured logs are diagnosed")
def test_ur10e_the_errors_fall_as_effects_are_added(ur10e_model: IdentifiedModel) -> None:
    model = ur10e_model
    compiled = load_compiled(model.spec, model.sources)
    data = Logs(read_logs(compiled, TRAINING), read_logs(compiled, HELD_OUT))
    for effect, joint in (("load_friction", "2"), ("load_friction", "3"),
                          ("nonlinear_viscous", "1")):  # fmt: skip
        model = add_effect(model, load_compiled(model.spec, model.sources), effect, joint, data)
    errors = {j.joint.name: j.relative_error for j in compare(model, HELD_OUT).joints}
    assert errors["1"] < 0.07 and errors["2"] < 0.018 and errors["3"] < 0.016


@rotating_with("measured logs are diagnosed")
def test_ur10e_a_load_is_found_first_with_its_mass(ur10e_model: IdentifiedModel) -> None:
    found = diagnose(ur10e_model, pieces(":1912", *ur10e("02_19_14harm50secLoad")))
    assert found.effects[0].effect == "payload"
    assert found.effects[0].parameters["mass"] == pytest.approx(2.805, rel=0.1)


@rotating_with("measured logs are diagnosed")
def test_tx40_the_motor_of_joint_6_turns_joint_5_too(tmp_path: Path) -> None:
    """From a robot file that couples nothing; errors below those of the published model."""
    text = builtin_text("tx40")
    text = text.replace('coupled_inertia = ["6"]\ncoupled_friction = ["6"]', "")
    alone = tmp_path / "tx40.toml"
    alone.write_text(text.partition("[coupling]")[0], encoding="utf-8")
    log = logs("tx40", "log_joint")[0]
    training, held_out = pieces("0:4.6", log), pieces("4.6:7.45", log)
    model = fitted(str(alone), training)
    found = diagnose(model, training, held_out)
    named = {(f.effect, f.joint) for f in found.effects if f.status != "perhaps"}
    assert ("coupled_friction", "6") in named
    assert found.joints["5"].error_before > 1.0
    after = {name: joint.error_after for name, joint in found.joints.items()}
    assert after["2"] < 0.066 and after["3"] < 0.091 and after["4"] < 0.09 and after["5"] < 0.23


@rotating_with("measured logs are diagnosed")
def test_odrive_the_orders_of_its_ripple() -> None:
    runs = logs("odrive_cogging", *(f"slow2__nocomp_{k}" for k in range(3)))
    model = fitted("odrive", runs[:2])
    found = diagnose(model, runs[:2], runs[2:])
    named = [*found.effects, *found.refinements]
    orders = [f.parameters["m"] for f in named if f.effect.endswith("ripple")]
    for order in (7.0, 14.0, 12.0, 28.0):
        assert any(abs(order - m) < 0.1 for m in orders), order
    assert any(35.0 <= m <= 36.0 for m in orders), "35 and 36, which the stroke hardly separates"
    assert found.joints["1"].error_after < 0.2


@rotating_with("measured logs are diagnosed")
def test_dvrk_the_spring_of_joint_4_and_friction_that_turns_gradually() -> None:
    """An instrument on cables behind two parallelograms.

    Friction of joints 4 and 5 is possible, no more: a lag of the torque says as much of joint 4.
    """
    training, held_out = logs("dvrk_psm", "one"), logs("dvrk_psm", "two")
    model = fitted("dvrk-psm", training)
    found = diagnose(model, training, held_out)
    told = {(f.effect, f.joint) for f in found.effects}
    springs = {("spring", "4"), ("constant_force_spring", "4")}
    assert springs & told and {("presliding", "4"), ("presliding", "5")} <= told
    after = {name: joint.error_after for name, joint in found.joints.items()}
    assert after["4"] < 0.131 and after["5"] < 0.118 and after["6"] < 0.164
