"""What a fleet must not say of logs that do not fit, and of what it cannot see."""

import dataclasses

import numpy as np
import pytest

from modeler.api import fleet, load
from modeler.core.errors import DataError
from modeler.regression.log import Log
from modeler.regression.motion import Processing
from modeler.runtime.model import CompiledModel
from modeler.validation.fleet import Fleet, analyse_fleet, format_fleet
from modeler.validation.fleet_logs import LogName, LogSummary, SkippedLog, summarise_log
from tests.fleet.machines import Planted, Scene, compiled, logs, motion, parameters
from tests.rotation import rotating, with_cases

GIVEN = Processing(position_cutoff=20.0, parallel_cutoff=8.0)


def reduced(pairs, robot="two-link"):
    values: list[LogSummary | SkippedLog] = []
    for named, log in pairs:
        try:
            values.append(summarise_log(compiled(robot), log, named, GIVEN))
        except DataError as error:
            values.append(SkippedLog(named, str(error)))
    return values


def judged(pairs: list[tuple[LogName, Log]], robot: str = "two-link") -> Fleet:
    return analyse_fleet(compiled(robot).spec, reduced(pairs, robot))


def exchanged(log: Log) -> Log:
    return dataclasses.replace(log, tau=log.tau[:, [1, 0, *range(2, log.tau.shape[1])]])


@pytest.mark.rotating("long tests of fleet")
@pytest.mark.parametrize("robot", ["two-link", *rotating("demo-arm")])
def test_logs_with_exchanged_torques_are_left_out_with_the_reason(robot: str) -> None:
    """A whole machine, and one day of another: neither drifts, nor is it well."""
    pairs = logs(Scene(machines=3, periods=3), 41, robot)
    wrong = [
        (named, exchanged(log) if named.machine == "r2" or named.place == "r1/day3.csv" else log)
        for named, log in pairs
    ]
    result = judged(wrong, robot)
    assert result.findings == ()
    assert [place for place, _ in result.skipped_logs] == [
        *"r1/day3.csv r2/day1.csv r2/day2.csv r2/day3.csv".split()
    ]
    text = "\n".join(format_fleet(result))
    assert "on 2 machines in 5 logs; 4 logs left out" in text
    value = f"left out: r2/day1.csv: does not fit {robot}: joints 1 and 2: their torques look exch"
    assert value in text and "r2: none of its logs could be used: nothing is known" in text


@pytest.mark.rotating("long tests of fleet")
def test_short_logs_are_still_compared() -> None:
    """Too short for a fit of their own, by far: the fleet's inertia is that of all logs."""
    result = judged(logs(Scene(machines=2, periods=3, duration=2.0), 5))
    assert result.skipped_logs == () and result.logs == 6


@with_cases(
    "seed, plan",
    (71, ("gain1", -0.5)),
    *rotating((74, ("load", 5.0)), (72, ("Fv1", -0.9)), (73, ("Fs2", 4.0))),
)
def test_great_drifts_are_no_wrong_logs(seed: int, plan: tuple[str, float]) -> None:
    name, size = plan
    scene = Scene(machines=2, periods=4, planted=(Planted(0, name, (0.0, 0.0, size, size)),))
    result = judged(logs(scene, seed))
    assert result.skipped_logs == ()
    first = result.findings[0]
    assert (first.machine, first.shape, first.begin) == ("r1", "jump", "day3")


def test_logs_of_more_joints_are_of_another_robot() -> None:
    """One among others without is left out; where all have them, it is reported."""
    pairs = logs(Scene(machines=1, periods=3, duration=6.0), 8)

    def wider(log: Log) -> Log:
        more = {name: np.zeros(len(log.time)) for name in ("q3", "tau3", "q4", "tau4", "q5")}
        return dataclasses.replace(log, extra=more)

    plain, wide = reduced(pairs), reduced([(named, wider(log)) for named, log in pairs])
    [(place, why)] = analyse_fleet(compiled().spec, [plain[0], wide[1], *plain[2:]]).skipped_logs
    assert place == "r1/day2.csv" and "has joints 3, 4 besides, which most logs have not" in why
    every = analyse_fleet(compiled().spec, wide)
    assert every.skipped_logs == ()
    [line] = [note for note in every.notes if "of joints besides those of the robot (3, 4)" in note]
    assert line.startswith("r1/day1.csv and 2 more: ")


@pytest.mark.rotating("long tests of fleet")
def test_a_machine_that_hides_a_parameter_is_told() -> None:
    """Joint 2 of r2 hardly moves: its friction may have risen or not."""
    pairs, rng = logs(Scene(machines=3, periods=4, noise=0.02), 4), np.random.default_rng(4)
    plain = reduced(pairs)
    resting = [(named, still(log, compiled(), rng)) for named, log in pairs[4:8]]
    fleet = analyse_fleet(compiled().spec, [*plain[:4], *reduced(resting), *plain[8:]])
    [line] = [note for note in fleet.notes if note.startswith("machine ")]
    assert line.startswith("machine r2: its logs determine ") and "Fv2 (" in line
    notes = analyse_fleet(compiled().spec, plain).notes
    assert not [note for note in notes if note.startswith("machine ")]


def still(log: Log, model: CompiledModel, rng: np.random.Generator) -> Log:
    """The same with joint 2 held still but for a tenth of a degree."""
    _, q, qd, qdd = motion(rng, 2, 12.0)
    for items in (q, qd, qdd):
        items[:, 1] *= 2e-3
    exact = model.base_regressor(q, qd, qdd) @ parameters(4, model)
    noise = 0.1 * rng.normal(size=exact.shape)
    return dataclasses.replace(log, q=q + 1e-5 * rng.normal(size=q.shape), tau=exact + noise)


def coarser(log: Log, counts: int) -> Log:
    step = 2.0 * np.pi / counts
    return dataclasses.replace(log, q=np.floor(log.q / step) * step)


@pytest.mark.rotating("long tests of fleet")
def test_a_coarse_encoder_is_no_drift_and_hides_none() -> None:
    """Machine 5 of 5 has 1000 counts a turn; its friction drifts, and so does that of machine 2."""
    planted = tuple(Planted(m, name, (0.0, 0.4, 0.4)) for m, name in ((1, "Fv2"), (4, "Fs2")))
    scene = Scene(machines=5, periods=3, apart=0.03, noise=0.01, planted=planted)
    machines: dict[str, dict[str, Log]] = {}
    for named, log in logs(scene, 90):
        seen = coarser(log, 1000) if named.machine == "r5" else log
        machines.setdefault(named.machine, {})[named.period] = seen
    result = fleet(load("two-link"), machines)
    lines = {(one.machine, one.quantity.parameter, one.begin) for one in result.findings}
    assert lines == {("r2", "Fv2", "day2"), ("r5", "Fs2", "day2")}
    assert any("each log is filtered as its noise asks: positions below" in n for n in result.notes)
