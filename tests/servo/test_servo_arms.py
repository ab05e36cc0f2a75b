"""Position servos of 12 bits at 30 and 50 Hz: armature, friction and damping from a data set."""

import dataclasses

import numpy as np
import pytest

from modeler.api import compile_model, derive, generate, inspect_log, load, read_logs
from modeler.api.log_maps import build_log_maps, read_mapped_log
from modeler.core.errors import DataError
from modeler.estimation import identify
from modeler.logs import EITHER
from modeler.regression import observe
from tests.rotation import ROTATING

from .servos import Servo, recorded, write_dataset

pytest.importorskip("mujoco", reason="NOT CHECKED: servo arms, for mujoco-core is not installed")

MOTORS = ["shoulder_pan", "shoulder_lift", "elbow_flex", "wrist_flex", "wrist_roll", "gripper"]
TRUTH = Servo(12.0, 4.4, 2.4, 1.1, armature=0.028, damping=0.06, friction=0.12)
MAPPING = [
    "time=timestamp",
    "q<j>=observation.state[{name}.pos]:deg",
    "duty<j>=observation.load[{name}.load]:0.1 %",
]
"""What `auto` finds, by some fits."""
VALUES = {"Ia": TRUTH.armature, "Fv": TRUTH.damping, "Fs": TRUTH.friction}


@pytest.fixture(scope="module")
def arm():
    return compile_model(generate(derive(load("so101"))))


def episodes(fps, count=3, seconds=15.0):
    """Frames of free motion of all joints."""
    robot = load("so101")
    rng = np.random.default_rng()
    limits = [robot.limits[joint.name] for joint in robot.joints]
    middle = np.array([(item.lower + item.upper) / 2 for item in limits])
    reach = np.array([(entry.upper - entry.lower) / 2 for entry in limits]) * 0.75
    t = np.arange(int(seconds * fps)) / fps
    for _ in range(count):
        w = 2 * np.pi * rng.uniform(0.08, 0.13) * np.arange(1, 6)
        sines = np.sin(w * t[:, None, None] + rng.uniform(0, 6.3, (6, 5))) @ rng.normal(size=5)
        sines *= np.minimum(
            1.0 / np.abs(sines).max(axis=0),
            2.5 / np.abs(np.gradient(sines, 1 / fps, axis=0)).max(axis=0) / reach,
        )
        yield recorded(robot, TRUTH, middle + reach * sines, fps)


def fitted(compiled, folder, mapping=MAPPING):
    rows = observe(compiled, read_logs(compiled, [folder], mapping))
    return identify(rows, "weighted", compiled)


def in_sigmas(result):
    """(value - truth) / sigma of what moves a joint, and sigma over the truth."""
    items = [(p, VALUES[p.name[:2]]) for p in result.parameters if p.name[:2] in VALUES]
    assert len(items) == 16  # the rotors of the first two joints group
    return {p.name: ((p.value - true) / p.sigma, p.sigma / true) for p, true in items}


@pytest.mark.rotating("long tests of servo")
@pytest.mark.parametrize("fps", [30.0, pytest.param(50.0, marks=ROTATING)])
def test_a_data_set_tells_armature_friction_and_damping(arm, tmp_path, fps):
    folder = write_dataset(tmp_path / "set", list(episodes(fps)), MOTORS, fps)
    result = in_sigmas(fitted(arm, folder))
    off, sure = np.array(list(result.values())).T
    assert np.abs(off).max() < 5.0, result
    assert np.sqrt(np.mean(off**2)) < 2.0, result
    assert sure.max() < 0.15


def test_without_k_e_what_the_motor_induces_is_damping(arm, tmp_path):
    folder = write_dataset(tmp_path / "set", list(episodes(50.0, 1)), MOTORS, 50.0)
    replace = dataclasses.replace
    joints = (replace(j, drive=replace(j.drive, k_e=0.0)) for j in arm.spec.joints)
    spec = dataclasses.replace(arm.spec, joints=tuple(joints))
    log = read_mapped_log(str(folder), spec, build_log_maps(arm, [folder], MAPPING)[0])
    result = identify(observe(arm, [log]), "weighted", arm)
    induced = TRUTH.gain * TRUTH.k_e / TRUTH.resistance
    values = [p.value for p in result.parameters if p.name.startswith("Fv")]
    assert np.allclose(values, TRUTH.damping + induced, rtol=0.02)


def test_a_data_set_without_loads_is_refused(arm, tmp_path):
    frames = list(episodes(50.0, 1, 4.0))
    folder = write_dataset(tmp_path / "set", frames, MOTORS, 50.0, load=False)
    with pytest.raises(DataError, match="no column tau1 or current1 or duty1"):
        fitted(arm, folder, ["auto"])


def test_the_table_places_links_as_the_file_does():
    """Lengths and zero angles of the arms, by plain trigonometry."""
    so101, vx300s = (load(name).evaluate_symbols() for name in ("so101", "vx300s"))
    stated = [so101["D3"], so101["phi"], so101["psi"], vx300s["psi"]]
    sides = [(0.028, 0.11257), (0.0052, 0.1349), (0.05955, 0.3)]
    angles = [np.arctan2(*each) for each in sides]
    assert stated == pytest.approx([np.hypot(*sides[0]), *angles], abs=1e-9)
    near = [so101["D3"], so101["D4"], vx300s["D3"]]
    assert near == pytest.approx([0.11600, 0.13500, 0.30585], abs=2e-5)


@pytest.mark.rotating("long tests of servo")
@pytest.mark.parametrize(
    ("reach", "doubted"), [(95.0, True), pytest.param(130.0, False, marks=pytest.mark.rotating)]
)
def test_degrees_that_may_be_parts_of_a_range_are_told(arm, reach, doubted):
    t = np.arange(500) / 50
    names = [f"observation.state[{motor}.pos]" for motor in MOTORS]
    columns = {"timestamp": t} | {name: reach * np.sin(t + k) for k, name in enumerate(names)}
    columns |= {f"observation.load[{motor}.load]": 300 * np.cos(t) for motor in MOTORS}
    lines = inspect_log(columns, arm).warnings
    assert any(EITHER in line for line in lines) == doubted
    (result,) = build_log_maps(arm, [columns], ["auto"])
    notes = result.guess_notes
    assert any(EITHER in line for line in notes) == (doubted and "[deg]" in notes[0])
    inputs = {"time": t} | {f"q{j}": columns[name] for j, name in enumerate(names, 1)}
    assert not any(EITHER in line for line in inspect_log(inputs, arm).warnings)
