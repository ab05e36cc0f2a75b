"""Whole fleets with the truth known: quiet where nothing drifts, right where something does."""

import dataclasses

import numpy as np
import pytest

from modeler.core.errors import DataError
from modeler.validation.fleet import Fleet, analyse_fleet, describe_finding, format_fleet
from modeler.validation.fleet_logs import LogName, SkippedLog
from tests.fleet.machines import Planted, Scene, compiled, summaries
from tests.rotation import rotating, slow_rotating, with_cases


def fleet(scene: Scene, seed: int, robot: str = "two-link") -> Fleet:
    return analyse_fleet(compiled(robot).spec, summaries(scene, seed, robot))


def told(found: Fleet) -> list[tuple[str, str, str]]:
    return [(one.machine, one.quantity.parameter, one.shape) for one in found.findings]


@slow_rotating("fleets that drift")
@with_cases(
    "scene, seeds, most",
    (Scene(machines=2, periods=3, noise=0.05), range(300, 316), 3),
    (Scene(machines=1, periods=8, daily=0.03, apart=0.2), range(600, 620), 4),
)
def test_fleets_without_drift_are_quiet(scene: Scene, seeds: range, most: int) -> None:
    """5 % of them may show anything at all: 4 and more of 16: 1 %; 5 and more of 20: 0.3 %."""
    assert sum(bool(fleet(scene, seed).findings) for seed in seeds) <= most


DAYS = 8
PLANTED = {
    "Coulomb on one day": ("Fs2", (0.0,) * 4 + (0.5,) + (0.0,) * 3, "one period", 50.0),
    "gain 5 % at once": ("gain2", (0.0,) * 5 + (0.05,) * 3, "jump", 5.0),
    "viscous 30 % in 8 days": ("Fv2", tuple(0.3 * np.linspace(0.0, 1.0, DAYS)), "trend", 30.0),
    "Coulomb 40 % at once": ("Fs2", (0.0,) * 4 + (0.4,) * 4, "jump", 40.0),
    "gain of the first joint": ("gain1", tuple(-0.1 * np.linspace(0.0, 1.0, DAYS)), "trend", -10.0),
}


@pytest.mark.parametrize("case", ["Coulomb on one day", *rotating(*[*PLANTED][1:])])
def test_what_is_planted_is_found_and_nothing_else(case: str) -> None:
    name, plan, shape, percent = PLANTED[case]
    result = fleet(Scene(machines=2, periods=DAYS, planted=(Planted(1, name, plan),)), 901)
    parameter = name.replace("gain", "gain ")
    assert told(result) == [("r2", parameter, shape)]
    [one] = result.findings
    assert one.change_percent == pytest.approx(percent, rel=0.35)
    size = one.change if one.quantity.unit == "%" else one.change_percent / 100.0 * abs(one.before)
    assert abs(size - one.change) < 1e-9 and abs(one.score) > 4.0 and one.p_value < 0.025
    assert result.verdict == "drift" and result.to_json()["findings"][0]["machine"] == "r2"


def test_an_offset_that_leaps_is_found() -> None:
    plan = (0.0,) * 2 + (4.0,) * 2
    result = fleet(Scene(machines=2, periods=4, planted=(Planted(0, "Off1", plan),)), 7, "demo-arm")
    assert told(result) == [("r1", "Off1", "jump")]
    assert result.findings[0].change_percent is None  # an offset has no size of its own
    assert "joint 1: constant torque offset (Off1) leaps " in describe_finding(
        result.findings[0], "days"
    )


@pytest.mark.parametrize("robot", ["two-link", *rotating("demo-arm")])
def test_a_load_is_no_gain(robot: str) -> None:
    """0.8 kg on the last link weigh on several joints; a gain of one joint is not reported."""
    plan = (0.0,) * 2 + (0.8,) * 4
    result = fleet(Scene(planted=(Planted(2, "load", plan),)), 31, robot)
    assert told(result) == [("r3", "load", "jump")]
    [one] = result.findings
    assert one.change == pytest.approx(0.8, rel=0.2) and one.quantity.joint is None
    text = describe_finding(one, "periods")
    assert "machine r3: load on the last link leaps up by 0." in text
    assert "at day3 and stays, from" in text
    assert not any("too few to know how values scatter" in note for note in result.notes)


@slow_rotating("fleets that drift")
def test_a_gain_is_no_load_and_both_may_be_in_one_fleet() -> None:
    """Six joints: the load of r3 makes the scatter known, and r5's gain pretends to 0.04 kg."""
    plans = (
        Planted(4, "gain2", (0.0,) * 3 + (0.05,) * 3),
        Planted(2, "load", (0.0,) * 2 + (2.0,) * 4),
    )
    scene = Scene(machines=5, periods=6, daily=0.02, duration=15.0, planted=plans)
    result = fleet(scene, 5, "ur10e")
    assert set(told(result)) == {("r3", "load", "jump"), ("r5", "gain 2", "jump")}


def test_friction_in_units_of_a_drifting_gain_does_not_drift() -> None:
    """A gain that falls by 40 % takes the logged friction with it: one cause, one finding."""
    plan = (0.0,) * 3 + (-0.4,) * 3
    result = fleet(Scene(machines=2, planted=(Planted(0, "gain2", plan),)), 12)
    assert told(result) == [("r1", "gain 2", "jump")]


def test_an_odd_machine_is_found() -> None:
    """One of eight rubs three times as much, another pulls 10 % more; all days alike."""
    plans = (Planted(3, "Fv2", (2.0, 2.0)), Planted(5, "gain1", (0.1, 0.1)))
    result = fleet(Scene(machines=8, periods=2, apart=0.05, planted=plans), 5)
    assert set(told(result)) == {("r4", "Fv2", "odd machine"), ("r6", "gain 1", "odd machine")}
    assert result.verdict == "odd machine"
    assert any(
        "above that of the other machines" in describe_finding(f, "days") for f in result.findings
    )


def test_a_temperature_that_moves_along_is_told() -> None:
    spec, plan = compiled().spec, tuple(0.3 * np.linspace(0.0, 1.0, 5))
    scene = Scene(machines=4, periods=5, planted=(Planted(0, "Fv2", plan),), warm=True)
    warm = summaries(scene, 3)
    cold = [dataclasses.replace(each, temperatures={}) for each in warm[5:]]
    [both], [alone] = (analyse_fleet(spec, logs).findings for logs in (warm, [*warm[:5], *cold]))
    assert alone.temperature is not None
    assert alone.temperature.is_correlated and alone.temperature.is_shared is None
    assert "may be the cause: compare periods of one temperature" in describe_finding(alone, "days")
    assert both.temperature is not None and both.temperature.is_shared is False
    assert "but machines that warm alike do not change so" in describe_finding(both, "days")
    leap = dataclasses.replace(scene, machines=1, planted=(Planted(0, "Fv2", (0.0,) * 4 + (0.4,)),))
    [sudden] = analyse_fleet(spec, summaries(leap, 3)).findings
    assert (
        sudden.temperature is not None and not sudden.temperature.is_correlated
    )  # a line is no leap
    assert "at day5, the last period (whether it stays is not known), from" in describe_finding(
        sudden, "days"
    )
    everywhere = [
        dataclasses.replace(each, log_name=LogName(m, each.log_name.period, m), content=f"{m} {k}")
        for m in ("r1", "r2", "r3", "r4")
        for k, each in enumerate(warm[:5])
    ]
    findings = analyse_fleet(spec, everywhere).findings
    assert findings and all(f.temperature is not None and f.temperature.is_shared for f in findings)


def test_what_cannot_be_compared_is_refused() -> None:
    scene = Scene(machines=2, periods=3)
    first, second, *_ = summaries(scene, 1)
    other = dataclasses.replace(first, log_name=LogName("r2", "day1", "r2/day1.csv"), content="x")
    gone = SkippedLog(LogName("r1", "b", "r1/b.csv"), "r1/b.csv: there is no such file; check it")
    twice = [dataclasses.replace(log, content="x") for log in (first, second)]
    for logs, text in (
        ([first, other], "got one log each of r1, r2; expected two periods of a machine"),
        ([gone], "none of 1 logs can be used; the first: r1/b.csv: there is no such file"),
        ([first, gone], "left out: 1, the first: r1/b.csv: there is no such file"),
        (twice, "r1/day2.csv: got rows of r1/day1.csv again; expected each"),
    ):
        with pytest.raises(DataError, match=text):
            analyse_fleet(compiled().spec, logs)


def test_a_log_that_is_left_out_and_a_short_fleet_are_told() -> None:
    inputs = summaries(Scene(machines=2, periods=3), 1)
    late = dataclasses.replace(inputs[0], log_name=LogName("r9", "day1", "r9/day1.csv"))
    left = SkippedLog(LogName("r1", "day9", "r1/day9.csv"), "r1/day9.csv: damaged")
    fleet = analyse_fleet(compiled().spec, [*inputs, late, left])
    lines = "\n".join(format_fleet(fleet))
    assert fleet.skipped_logs == (("r1/day9.csv", "r1/day9.csv: damaged"),)
    assert "left out: r1/day9" in lines
    assert "r9: one period, so a drift of its own cannot be seen" in lines
    assert "3 machines: an outlier among fewer than 5 is not reported" in lines
    assert fleet.verdict == "nothing drifts" and fleet.logs == 7
    assert fleet.to_json()["skipped_logs"] == [
        {"log": "r1/day9.csv", "reason": "r1/day9.csv: damaged"}
    ]
    alike = "filtered alike: positions below 20 Hz, torques and columns below 5 Hz"
    assert f"all logs are {alike}" in analyse_fleet(compiled().spec, inputs).notes
    few = analyse_fleet(compiled().spec, summaries(Scene(machines=1, periods=3), 2)).notes
    assert any("too few to know how values scatter" in note for note in few)
