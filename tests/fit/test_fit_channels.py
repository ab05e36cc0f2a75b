"""Signs, units, exchanged channels in logs to which the model itself is fitted; channels of another
time: named with their delay, physics is not called late.
"""

import json
import re
from collections import Counter
from dataclasses import replace
from functools import cache
from types import SimpleNamespace

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from scipy.signal import lfilter

from modeler.api import identify as identify_robot, load, observe, simulate as simulate_log
from modeler.cli import main
from modeler.estimation import find_log_faults, identify, judge_fit, log_faults
from modeler.estimation.evidence import gather_evidence
from modeler.regression.log import Log
from modeler.robot.read import parse_robot_text
from modeler.simulation import SimulationSettings, parse_hidden_effect, simulate
from tests.link_data import compiled as compiled_text
from tests.modules import compiled, module
from tests.rotation import ROTATING, rotating

ROBOTS = ["demo-arm", *rotating("puma560", "scara")]


def log_of(name, **settings):
    made = simulate(module(name).model.robot, SimulationSettings(**settings))
    return Log(f"{name}.csv", made.joints, made.time, made.q, made.tau)


@cache
def runs(name):
    """A compiled robot and two simulated logs."""
    kinds = ({"seed": seed, "torque_noise": 0.01 * seed} for seed in (1, 2))
    return compiled(name), [log_of(name, duration=12.0, rate=250.0, **item) for item in kinds]


def unit(machine, j):
    return 180.0 / np.pi if machine.spec.joints[j].unit == "rad" else 1e3


MISTAKES = {
    "all units": (
        lambda c, q, tau, j, k: q.__imul__([unit(c, i) for i in range(len(q[0]))]),
        "the positions look like degrees",
    ),
    "unit": (lambda c, q, tau, j, k: q[:, j].__imul__(unit(c, j)), "its position looks like"),
    "position sign": (lambda c, q, tau, j, k: q[:, j].__imul__(-1.0), "sign"),
    "positions": (
        lambda c, q, tau, j, k: q.__setitem__(np.s_[:, [j, k]], q[:, [k, j]]),
        "positions look exchanged",
    ),
    "torques": (
        lambda c, q, tau, j, k: tau.__setitem__(np.s_[:, [j, k]], tau[:, [k, j]]),
        "torques look exchanged",
    ),
    "zero": (lambda c, q, tau, j, k: q[:, j].__iadd__(np.pi / 2), "its zero seems to be off by 90"),
    "turns": (
        lambda c, q, tau, j, k: q.__imul__(
            [1 / (2 * np.pi) if unit(c, i) != 1e3 else 100.0 for i in range(len(q[0]))]
        ),
        "look like turns",
    ),
    "twice": (lambda c, q, tau, j, k: tau[:, j].__imul__(2.0), "the measured torque is "),
    "two signs": (
        lambda c, q, tau, j, k: tau.__setitem__(np.s_[:, [j, k]], -tau[:, [j, k]]),
        "the measured torques have the wrong sign",
    ),
    "torque sign": (lambda c, q, tau, j, k: tau[:, j].__imul__(-1.0), "sign"),
    "all signs": (
        lambda c, q, tau, j, k: tau.__imul__(-1.0),
        "all measured torques have the wrong sign",
    ),
}


UNSEEN = {"zero": "zero errors", "twice": "scale errors", "torque sign": "scale errors"}


@pytest.mark.rotating("long tests of fit")
@pytest.mark.parametrize("name", ROBOTS)
def test_a_fit_to_sound_channels_is_not_doubted(name):
    machine, logs = runs(name)
    for log in logs:
        observation = observe(machine, [log])
        assert all(matches.is_undetectable for matches in find_log_faults(machine, observation))


@pytest.mark.rotating
@pytest.mark.parametrize("mistake", MISTAKES)
def test_mistakes_drawn_at_random_are_named_although_the_fit_adapts(mistake):
    """Of two for each of two robots one is missed, in words that name the joint or the swap.

    What these logs cannot show is said too.
    """
    change, words = MISTAKES[mistake]
    random, seen = np.random.default_rng(list(MISTAKES).index(mistake)), Counter()
    for name in ("demo-arm", "scara"):
        machine, logs = runs(name)
        for _ in range(2):
            log = logs[int(random.integers(2))]
            j, k = random.permutation(len(log.joints))[:2]
            if mistake == "zero" and machine.spec.joints[j].unit != "rad":
                continue
            q, tau = log.q.copy(), log.tau.copy()
            change(machine, q, tau, j, k)
            observation = observe(machine, [replace(log, q=q, tau=tau)])
            (first, *_) = find_log_faults(machine, observation)
            named = words in first.line
            if named and mistake in ("unit", "position sign", "torque sign", "zero", "twice"):
                named = f"joint {log.joints[j]}:" in first.line
            named |= any(
                UNSEEN.get(mistake, "?") in part and log.joints[j] in re.findall(r"\w+", sizes)
                for part in (first.line.split("; ") if first.is_undetectable else ())
                for sizes in re.findall(r"of any size \(joints? (.*?)\)", part)
            )
            seen[named] += 1
    assert seen[False] <= 1, seen


PAN_TILT = """
name = "pan-tilt"
gravity = [0, 0, -9.81]
parameters = {ZZ1 = 0.02, XX2 = 0.02, YY2 = 0.05, ZZ2 = 0.06, MX2 = 0.36, M2 = 3.0}
[mdh]
columns = ["j", "alpha", "d", "theta"]
rows = [["1", 0, 0, "q1"], ["2", "pi/2", 0.05, "q2"]]
"""


def test_links_that_reach_beyond_their_frames_are_a_machine():
    """A camera of 3 kg in 0.12 m from the tilting axis; the frames are 0.05 m apart."""
    robot, machine = parse_robot_text(PAN_TILT, "pan"), compiled_text(PAN_TILT)
    made = simulate(robot, SimulationSettings(duration=10.0, seed=3))
    for factor, usable in ((1.0, True), (1e3, False)):
        log = Log("pan.csv", made.joints, made.time, made.q, factor * made.tau)
        observation = observe(machine, [log])
        fit = judge_fit(machine, observation, identify(observation, "weighted", machine))
        assert fit.verdict.valid == usable, fit.verdict.warnings
        assert usable or "mN m" in fit.verdict.line


@pytest.mark.parametrize("name", ROBOTS)
def test_a_clock_that_is_wrong_is_named_without_speeds(name):
    """By the rule, or, where rotors of any inertia would do, by inertias beyond all measure."""
    machine, (log, _) = runs(name)
    observation = observe(machine, [replace(log, time=20.0 * log.time)])
    findings_of_log = find_log_faults(machine, observation)
    fit = identify(observation, "weighted", machine)
    fit = judge_fit(machine, observation, fit, findings_of_log)
    assert fit.verdict.line.startswith("Not valid: the clock seems to be wrong: ")
    sound = find_log_faults(machine, observe(machine, [log]))
    assert not any("clock" in finding.line for finding in sound)


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    """A folder with two simulated logs and a model of the first."""
    place = tmp_path_factory.mktemp("arm")
    for name, seed in (("run", "1"), ("other", "2")):
        words = f"simulate demo-arm --duration 8 --rate 200 --seed {seed}"
        assert main([*words.split(), "--out", str(place / f"{name}.parquet")]) == 0
    assert main(f"fit demo-arm {place}/run.parquet --out {place}/m.json".split()) == 0
    return place


SAID = {
    "turns": "joint 2: its position looks like turns",
    "late": "joint 2: its position comes ",
    "sign": "joint 1: the measured torque has the wrong sign for physically consistent",
}


@pytest.mark.rotating("long tests of fit")
@pytest.mark.parametrize("mistake", ["turns", *rotating("late", "sign")])
def test_every_command_says_the_same(arm, capsys, mistake):
    """Of a log beside a model of another one, and of a log beside its own model."""
    table = pq.read_table(arm / "other.parquet")
    columns = {name: table[name].to_numpy().copy() for name in table.column_names}
    if mistake == "sign":
        columns["tau1"] *= -1.0
    elif mistake == "turns":
        columns["q2"] /= 2.0 * np.pi
    else:
        columns["q2"] = np.interp(columns["time"] - 0.03, columns["time"], columns["q2"])
    log, items, result = arm / f"{mistake}.parquet", arm / f"{mistake}.json", arm / "told.json"
    pq.write_table(pa.table(columns), log)
    for words in (
        f"fit demo-arm {log} --out {items} --json {result}",
        f"log {log} --robot demo-arm",
        f"compare {arm}/m.json {log} --json {result}",
        f"diagnose {arm}/m.json {log}",
        f"compare {items} {log} --json {result}",
    ):
        assert main(words.split()) == 0
        assert SAID[mistake] in capsys.readouterr().out, words
        warnings = json.loads(result.read_text())["warnings"]
        assert any(SAID[mistake] in str(one) for one in warnings)


def test_a_log_beside_a_model_of_another_is_judged_by_its_values():
    machine, (train, other) = runs("demo-arm")
    model = SimpleNamespace(beta=identify(observe(machine, [train])).beta, logs=())
    swapped = observe(machine, [replace(other, tau=other.tau[:, [1, 0, 2]])])
    lines = [matches.line for matches in find_log_faults(machine, swapped, model)]
    assert any("joints 1 and 2: their torques look exchanged" in line for line in lines)
    assert find_log_faults(machine, observe(machine, [other]), model) == ()


def test_faults_of_the_stated_sizes_raise_the_error_by_a_third():
    """Delays, scale errors and zeros, per joint, below the largest where a robot moves well."""
    machine, (log, _) = runs("demo-arm")
    noisy = 0.2 * np.random.default_rng(3).normal(size=log.tau.shape) * log.tau.std(axis=0)
    observation = observe(machine, [replace(log, tau=log.tau + noisy)])
    (said, *_) = find_log_faults(machine, observation)
    assert said.is_undetectable and said.line.startswith("Not detectable in these logs: ")
    seen = gather_evidence(machine, observation)
    beta, _ = seen.judge.solve(seen.data)
    torque, every = seen.rows.W @ beta, np.eye(3)
    checked = set()
    for (kind, place), size in log_faults._compute_undetectable_sizes(seen).items():
        name = seen.get_joint_name(place)
        stated = {
            j: text
            for what, text, names in SIZES.findall(said.line)
            for j in re.findall(r"\w+", names)
            if what == kind.what
        }
        if size >= kind.largest:
            assert stated[name] == "of any size"
            continue
        assert name not in stated or float(stated[name].split()[1]) == pytest.approx(size, rel=0.6)
        if kind.what == "torque delays":
            faulty = seen.rows.shift_columns(machine, np.full(3, -1e-3 * size), beta)
            faulty = np.where(every[place] > 0, faulty, torque)
        elif kind.what == "zero errors":
            zero = log_faults.propose_zero(observation, place, size)
            faulty = seen.rows.transform_columns(machine, zero, beta)
        else:
            faulty = torque * (1.0 + 0.01 * size * every[place])
        made = seen.judge.compute_errors(seen.build_equations(seen.rows.W, faulty), False)
        ratio = np.hypot(made / seen.errors, 1.0).max()
        tolerance = 0.25 if kind.what.startswith("scale") else 0.12  # it is taken as linear
        assert ratio == pytest.approx(4.0 / 3.0, rel=tolerance), (kind, name)
        checked.add(kind.what)
    assert {"torque delays", "zero errors"} <= checked


SIZES = re.compile(r"([a-z][a-z ]+) (of any size|below [\d.]+ \S+) \(joints? (.*?)\)")


LATE_RATE = 200.0


def told_late(name, rng, hidden=(), lagged=((), 0.0), **late):
    """What is said of the time of channels; late: {column of `Log`: (joints, samples)}.

    lagged: joints whose torque passes a filter, and its time constant, s.
    """
    seed, effects = int(rng.integers(1000)), tuple(map(parse_hidden_effect, hidden))
    log = log_of(name, duration=10.0, rate=LATE_RATE, seed=seed, hidden=effects)
    tau = log.tau.copy()
    for j in lagged[0]:
        late_by = lagged[1] * LATE_RATE + 0.5  # samples; of the bilinear filter
        b, a = np.full(2, 0.5 / late_by), [1.0, 1.0 / late_by - 1.0]
        tau[:, j] = lfilter(b, a, tau[:, j], zi=[tau[0, j] * (1.0 - b[0])])[0]
    log = replace(log, tau=tau)
    for column, (joints, samples) in late.items():
        values = getattr(log, column).copy()
        for j in joints:
            values[samples:, j] = values[:-samples, j]
        log = replace(log, **{column: values})
    matches = find_log_faults(compiled(name), observe(compiled(name), [log]))
    return [one.line for one in matches if "late" in one.line or "filter" in one.line]


@pytest.mark.rotating("long tests of fit")
@pytest.mark.parametrize("name", ["demo-arm", pytest.param("puma560", marks=ROTATING)])
def test_whose_time_and_by_how_much(name):
    rng, names = np.random.default_rng([8, *name.encode()]), runs(name)[1][0].joints
    for column, what in (("q", "position"), ("tau", "torque"), ("tau", "all")):
        joints = range(len(names)) if what == "all" else [int(rng.integers(3))]
        samples = int(rng.integers(5, 17))
        (line,) = told_late(name, rng, **{column: (joints, samples)})
        whose = "all torques" if what == "all" else f"joint {names[joints[0]]}: its"
        assert line.startswith(whose) and what in line and " late, by" in line
        assert milliseconds(line) == pytest.approx(1e3 * samples / LATE_RATE, abs=5.0)


def milliseconds(line):
    return float(line.partition(" ms")[0].split()[-1])


@pytest.mark.parametrize("seeds", ["2", *rotating("31", "32", "31 32", "71", "72 73")])
def test_inertia_that_a_model_lacks_is_no_other_clock(seeds):
    """Without the rotor of joint 3 a slower motion fits better, and the slower the better."""
    robot = load("demo-arm")
    logs = [
        simulate_log(robot, hide=["load_friction@2"], duration=6.0, rate=250.0, seed=int(seed))
        for seed in seeds.split()
    ]
    verdict = identify_robot(robot, logs, effects="viscous,coulomb").fit.verdict
    assert verdict.valid, verdict.lines


@pytest.mark.rotating("long tests of fit")
def test_a_filtered_torque_is_told_with_its_time_and_not_as_late():
    rng = np.random.default_rng(10)
    for joints, whose in (([1], "joint 2: its torque comes"), (range(3), "all torques come")):
        seconds = float(rng.uniform(0.03, 0.05))
        (line,) = told_late("demo-arm", rng, lagged=(joints, seconds))
        assert line.startswith(f"{whose} through a first-order low-pass filter"), line
        # behind plain filters of 5 Hz a lag of 47 ms is seen as one of 39 ms
        assert milliseconds(line) == pytest.approx(1e3 * seconds, rel=0.2)


EFFECTS = ("", "elasticity", "backlash", "cable_hysteresis", "counterbalance", "external_force")
MORE = ("stribeck", "presliding", "load_friction", "asymmetric_viscous", "payload", "motor_ripple")


@pytest.mark.parametrize(
    ("name", "hidden"),
    [("demo-arm", "elasticity")]
    + rotating(*(("demo-arm", hidden) for hidden in EFFECTS if hidden != "elasticity"))
    + [pytest.param("ur10e", hidden, marks=ROTATING) for hidden in EFFECTS[1::2] + MORE[::2]],
)
def test_physics_is_not_late(name, hidden):
    rng = np.random.default_rng([9, *name.encode(), *hidden.encode()])
    assert told_late(name, rng, hidden=[hidden] if hidden else []) == []
