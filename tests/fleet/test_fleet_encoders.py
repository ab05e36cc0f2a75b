"""A coarser encoder is no drift, and hides none that is large."""

import dataclasses

import numpy as np
import pytest

from modeler.api import fleet, load
from modeler.fleet.fleet import fleet_of
from modeler.observation.log import Log
from tests.fleet.machines import Planted, Scene, compiled, logs, summaries


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
    found = fleet(load("two-link"), machines)
    told = {(one.machine, one.quantity.parameter, one.begin) for one in found.findings}
    assert told == {("r2", "Fv2", "day2"), ("r5", "Fs2", "day2")}
    assert any("each log is filtered as its noise asks: positions below" in n for n in found.notes)


def test_logs_that_are_given_one_filter_are_said_to_be_alike() -> None:
    found = fleet_of(compiled().spec, summaries(Scene(machines=2, periods=3), 1))
    [told] = [note for note in found.notes if "filtered" in note]
    assert told == (
        "all logs are filtered alike: positions below 20 Hz, torques and columns below 5 Hz"
    )
