"""Measured logs through the whole chain: robot file, emitted C, fit, held-out errors, verdict.

The limits are the held-out residuals that the README of each data folder says a plain script
reached (a numpy regressor, one Butterworth filter, weights per joint). Joints where we are above
them stand in EXCEPTIONS. Verdicts are those of an expert.
"""

from dataclasses import dataclass
from functools import cache

import pytest

from modeler import api
from modeler.regression.motion import Processing
from modeler.robot.read import parse_robot_text
from tests.chain import chain_of
from tests.measured_sets.sets import DATA, SETS
from tests.rotation import ROTATING, slow_rotating, with_cases
from tests.texts import read_pairs

pytestmark = [
    pytest.mark.measured,
    pytest.mark.skipif(not DATA.is_dir(), reason=f"NOT CHECKED: no measured logs in {DATA}"),
]


LIKE_MOTION = ("prediction", "a residual that is no noise")
HALVES = ("prediction", "differs significantly")


@dataclass(frozen=True)
class Published:
    """The README's held-out residual per joint of a measured set, %, and the verdict of a fit."""

    residuals: tuple[float, ...]
    verdict: tuple[str, str] = LIKE_MOTION
    processing: Processing | None = None


PUBLISHED = {
    "emps": Published((5.63,), HALVES),
    "odrive_cogging": Published((93.5,), ("prediction", "joint 1: ")),
    "tx40": Published((7.3, 6.6, 12.9, 11.5, 22.1, 16.3)),
    "ur10e": Published((10.4, 3.3, 3.4, 7.2, 11.3, 18.3)),
    "kinova_gen3": Published((28.8, 16.0, 15.0, 9.2, 12.5, 15.7, 6.9)),
    # Near the README's filter of 5.4 Hz. Automatic: 5.1 15.0 13.2 14.7 19.5 19.3 21.2 %.
    "dvrk_psm": Published(
        (4.9, 14.8, 13.8, 15.9, 22.1, 21.6, 23.5),
        processing=Processing(position_cutoff=8.0, parallel_cutoff=5.4),
    ),
}

QUICK = ("emps", "odrive_cogging", "tx40")

EXCEPTIONS = {("kinova_gen3", 3): 15.7, ("kinova_gen3", 4): 11.7}
"""(robot, joint) -> %, above the README.

Why the README's script does better on these two joints is not known. It is not their torque
offsets (with them 16.4 and 11.3 %). No cut-off, decimation or mask that was tried brings joint 4
below 11 %; a parallel filter of 2 Hz brings joint 3 to 14.8 % and joint 4 to 14 %. Joints 1, 2 and
5 to 7 are below the README.
"""


@cache
def results(name: str) -> tuple[api.IdentifiedModel, api.Comparison]:
    """Fit and comparison of a set."""
    training, held_out = SETS[name].logs(DATA, "forward")
    robot = parse_robot_text(SETS[name].robot(), name)
    model = chain_of(robot).fit(training, PUBLISHED[name].processing)
    return model, api.compare(model, held_out)


@pytest.mark.rotating("long tests of fit")
@pytest.mark.parametrize(
    "robot", [r if r in QUICK else pytest.param(r, marks=ROTATING) for r in PUBLISHED]
)
def test_held_out_errors_are_below_the_published_ones(robot):
    model, comparison = results(robot)
    table = {item.joint.name: 100 * item.relative_error for item in comparison.joints}
    limits = {str(j): limit for j, limit in enumerate(PUBLISHED[robot].residuals, start=1)}
    limits |= {str(j): limit for (name, j), limit in EXCEPTIONS.items() if name == robot}
    assert table.keys() == limits.keys()
    assert {joint: error for joint, error in table.items() if error >= limits[joint]} == {}
    verdict, (valid_for, words) = model.fit.verdict, PUBLISHED[robot].verdict
    assert verdict.valid_for == valid_for and words in verdict.line, verdict.line
    assert verdict.valid is (valid_for != "nothing")


@slow_rotating("fits of measured logs")
@with_cases(
    "robot, log, joint",  # the built-in robot has no friction; the other log is of joint 5
    ("panda", "panda/excitation.parquet", "7"),
    ("ur10e", "ur10e/ur-20_01_22-joint_5.parquet", "1"),
)
def test_other_measured_logs_make_no_model_of_every_joint(robot, log, joint):
    verdict = chain_of(robot).fit([str(DATA / log)]).fit.verdict
    assert verdict.valid_for != "parameters" and verdict.by_joint[joint].state != "good"


@slow_rotating("fits of measured logs")
def test_every_exception_is_still_needed():
    for (robot, joint), limit in EXCEPTIONS.items():
        actual = 100 * results(robot)[1].joints[joint - 1].relative_error
        assert PUBLISHED[robot].residuals[joint - 1] < actual < limit


def test_emps_published_values():
    """Janot, Gautier, Brunot 2019: M 95.1, Fv 203.5, Fc 20.4, offset -3.16, error 4.08 %.

    They filter at 100 Hz and decimate to 40 Hz, a parallel cut-off of 16 Hz.
    """
    model, _ = results("emps")
    table = {parameter.name: parameter.value for parameter in model.fit.parameters}
    assert table["M1"] == pytest.approx(95.1089, rel=0.005)
    assert table["Fv1"] == pytest.approx(203.5034, rel=0.01)
    assert table["Fs1"] == pytest.approx(20.3935, rel=0.01)
    assert table["Off1"] == pytest.approx(-3.1648, rel=0.02)
    assert all(parameter.essential for parameter in model.fit.parameters)
    assert 100 * model.fit.relative_error < 3.96
    assert model.fit.processing.position_cutoff == pytest.approx(100.0, rel=0.2)
    assert model.fit.processing.parallel_cutoff == pytest.approx(16.0, rel=0.2)


@pytest.mark.rotating("long tests of fit")
def test_tx40_published_values():
    """Janot, Vandanjon, Gautier 2014, of the same robot and log: the columns that are excited."""
    parameters = results("tx40")[0].fit.parameters
    table = {parameter.name: parameter.value for parameter in parameters}
    published = read_pairs("""
        Fv1 8.05 Fv2 5.53 Fv3 1.97 Fv4 1.11 Fs1 7.14 Fs2 8.26 Fs3 6.34 Fs4 2.48 Ia3 0.0988
        Ia4 0.0313 ZZ1R 1.248 ZZ2R 1.080 MX2R 2.241 Iam6 0.00964 Fvm6 0.616 Fsm6 1.95
    """)
    for name, value in published.items():
        assert table[name] == pytest.approx(value, rel=0.1), name
