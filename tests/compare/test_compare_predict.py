"""From logs to shares, orders and coordinates: torques that are added to a log are found again."""

import numpy as np
import pytest

from modeler.api import compile_model, derive, fit, generate, load, observe
from modeler.regression.log import Log
from modeler.regression.motion import Processing, compute_travel_since_reversal
from modeler.validation.comparison import Comparison, compare
from modeler.validation.prediction import predict
from modeler.validation.verdict import classify_residual, write_joint_verdict
from tests.rotation import with_cases

RATE, CUTOFF, NOISE = 400.0, 8.0, 0.8  # Hz, Hz, N m


class Machine:
    """The built-in two-link arm with parameters of our own, and a model fitted without noise."""

    def __init__(self) -> None:
        derivation = derive(load("two-link"))
        emitted = generate(derivation)
        self.compiled = compile_model(emitted)
        self.beta = np.random.default_rng(1).uniform(0.5, 2.0, derivation.base.rank)
        self.names = tuple(joint.name for joint in self.compiled.spec.joints)
        clean = self.log("clean.csv", wandering(np.arange(0.0, 20.0, 1.0 / RATE)), None)
        processing = Processing(position_cutoff=60.0, parallel_cutoff=CUTOFF)
        self.model = fit(derivation, emitted, observe(self.compiled, [clean], processing))

    def log(self, name: str, motion: tuple[np.ndarray, ...], seed: int | None, **more) -> Log:
        """Torques of the machine, `added` (n, 2) on top, white noise."""
        time, q, qd, qdd = motion
        tau = self.compiled.inverse_dynamics(q, qd, qdd, self.beta) + more.pop("added", 0.0)
        if seed is not None:
            tau = tau + NOISE * np.random.default_rng(seed).normal(size=tau.shape)
        return Log(name=name, joints=self.names, time=time, q=q, tau=tau, **more)

    def compared(self, *logs: Log) -> Comparison:
        return compare(predict(self.model, logs, self.compiled)[0])


def waves(time: np.ndarray, terms: list[list[tuple[float, float, float]]]) -> tuple:
    """Time, q, qd, qdd of sums of a sin(w t + p), by joint."""
    q, qd, qdd = (np.zeros((time.size, len(terms))) for _ in range(3))
    for j, item in enumerate(terms):
        for a, w, p in item:
            q[:, j] += a * np.sin(w * time + p)
            qd[:, j] += a * w * np.cos(w * time + p)
            qdd[:, j] -= a * w**2 * np.sin(w * time + p)
    return time, q, qd, qdd


def wandering(time: np.ndarray) -> tuple:
    return waves(
        time,
        [
            [(1.0, 0.9, 0.0), (0.5, 2.3, 1.0), (0.2, 5.1, 0.3)],
            [(0.8, 1.21, 0.5), (0.6, 2.9, 0.0), (0.2, 4.7, 2.0)],
        ],
    )


@pytest.fixture(scope="module")
def machine() -> Machine:
    return Machine()


def filtered_noise() -> float:
    """Variance of the noise behind the filter: Gaussian weights of -3 dB at CUTOFF.

    exp(-(2 pi f s)^2 / 2) = sqrt(1/2) gives s = sqrt(ln 2) / (2 pi f), and the sum of the squared
    weights is h / (2 s sqrt(pi)).
    """
    spread = np.sqrt(np.log(2.0)) / (2 * np.pi * CUTOFF)
    return NOISE**2 / RATE / (2.0 * spread * np.sqrt(np.pi))


def check_shares(found: Comparison, method: str, known: np.ndarray, joint: int = 1) -> None:
    """`known` is slow beside the filter, so its variance passes."""
    item = found.joints[joint]
    p = found.prediction
    total = float(np.var(p.measured[p.used[:, joint], joint]))
    assert item.shares is not None and item.shares.method == method
    assert item.shares.systematic_share * total == pytest.approx(float(np.mean(known**2)), rel=0.15)
    assert item.shares.noise_share * total == pytest.approx(filtered_noise(), rel=0.15)


def added(q: np.ndarray, joint: int = 1) -> np.ndarray:
    """(n, 2) N m: three waves per turn on one joint."""
    torque = np.zeros_like(q)
    torque[:, joint] = 0.5 * np.sin(3.0 * q[:, joint] + 0.4)
    return torque


def test_shares_from_several_logs(machine: Machine) -> None:
    motion = wandering(np.arange(0.0, 25.0, 1.0 / RATE))
    later = tuple(part[333:] for part in motion)
    extra = added(motion[1])
    logs = [
        machine.log("one.csv", motion, 4, added=extra),
        machine.log("two.csv", later, 5, added=extra[333:]),
        machine.log("three.csv", motion, 6, added=extra),
    ]
    result = machine.compared(*logs)
    check_shares(result, "logs", extra[:, 1])
    assert [log.log for log in result.logs] == ["one.csv", "two.csv", "three.csv"]


def test_the_same_log_twice_is_no_repetition(machine: Machine) -> None:
    """Its noise would be called repeatable."""
    motion = wandering(np.arange(0.0, 25.0, 1.0 / RATE))
    log = machine.log("one.csv", motion, 4)
    again = Log("again.csv", log.joints, log.time[2000:], log.q[2000:], log.tau[2000:])
    for other in (again, log):
        item = machine.compared(log, other).joints[1]
        assert item.shares is not None and item.shares.method == "smooth"


def test_an_order_far_above_the_filter_is_seen(machine: Machine) -> None:
    """60 waves per rad at 2 rad/s are 19 Hz; the rows end at 8 Hz."""
    motion = wandering(np.arange(0.0, 25.0, 1.0 / RATE))
    extra = np.zeros_like(motion[1])
    extra[:, 0] = 0.7 * np.cos(60.0 * motion[1][:, 0])
    item = machine.compared(machine.log("a.csv", motion, 8, added=extra)).joints[0]
    assert item.orders is not None
    assert item.orders.peaks[0] == pytest.approx(60.0, rel=0.01)
    at = np.argmin(np.abs(item.orders.order - item.orders.peaks[0]))
    assert item.orders.amplitude[at] == pytest.approx(0.7, rel=0.15)


def test_temperature_and_travel_come_from_the_log(machine: Machine) -> None:
    motion = wandering(np.arange(0.0, 40.0, 1.0 / RATE))
    heat = 25.0 + 0.25 * motion[0]
    extra = np.zeros_like(motion[1])
    extra[:, 1] = 0.2 * (heat - 30.0) * np.sign(motion[2][:, 1])
    log = machine.log("a.csv", motion, 9, added=extra, extra={"temperature2": heat})
    result = machine.compared(log)
    p = result.prediction
    assert p.temperature is not None and p.travel is not None
    np.testing.assert_allclose(p.temperature[:, 1], 25.0 + 0.25 * p.time, atol=1e-6)
    assert np.isnan(p.temperature[:, 0]).all()
    exact = np.interp(p.time, motion[0], compute_travel_since_reversal(motion[1][:, 1]))
    assert np.quantile(np.abs(p.travel[:, 1] - exact), 0.95) < 0.01
    shares = [item.structure for item in result.joints]
    assert shares[0] is not None and np.isnan(shares[0].get_share("temperature"))
    assert shares[1] is not None and shares[1].get_share("temperature") > 0.6


def test_the_full_rate_is_that_of_the_rows(machine: Machine) -> None:
    """Filtered at every sample, it meets the rows at their times."""
    motion = wandering(np.arange(0.0, 10.0, 1.0 / RATE))
    p, _ = predict(machine.model, [machine.log("a.csv", motion, 2)], machine.compiled)
    assert p.full is not None
    for joint in (0, 1):
        rows = p.used[:, joint]
        e = (p.measured - p.predicted)[rows, joint]
        there = np.interp(p.time[rows], p.full.time, np.nan_to_num(p.full.filtered[:, joint]))
        close = np.abs(there - e) < 1e-6 * np.abs(e).max()
        assert close.mean() > 0.9  # rows at the edge of a masked segment may differ


def test_an_automatic_cutoff_suits_the_slowest_log(machine: Machine) -> None:
    """What `fit` chooses, `compare` takes on the same logs: 25 samples per second hold 10 Hz."""
    fast = machine.log("fast.csv", wandering(np.arange(0.0, 10.0, 1.0 / RATE)), 2)
    slow = machine.log("slow.csv", wandering(np.arange(0.0, 10.0, 0.04)), 2)
    chosen = observe(machine.compiled, [fast, slow]).report.processing
    assert chosen.position_cutoff == pytest.approx(10.0)
    observe(machine.compiled, [slow], chosen)


@with_cases(
    "words, torque",
    ("follows the position of joint 2", lambda q, qd: np.sin(6.0 * q + 0.4)),
    ("follows the motion of joint 2", lambda q, qd: np.sin(3.0 * q) * qd),
)
def test_what_follows_another_joint_is_no_noise(machine, words, torque):
    motion = wandering(np.arange(0.0, 20.0, 1.0 / RATE))
    added = np.zeros_like(motion[1])
    added[:, 0] = 0.3 * torque(motion[1][:, 1], motion[2][:, 1])
    compared = machine.compared(machine.log("x.csv", motion, 3, added=added))
    first, second = compared.joints
    text = write_joint_verdict(first)
    assert words in text and "noise" not in text
    assert classify_residual(first) == "pattern"
    known = float(np.var(added[:, 0]))
    share = known / (known + filtered_noise())
    assert first.structure is not None
    assert first.structure.best_predictor.share == pytest.approx(share, abs=0.25)
    assert "the residual looks like noise" in write_joint_verdict(second)
