"""Signs, units and exchanged channels in logs to which the model itself is fitted."""

import json
from collections import Counter
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from modeler.api import observe
from modeler.cli import main
from modeler.estimation.findings import log_findings
from modeler.estimation.identify import identify
from modeler.estimation.verdict import with_verdict
from modeler.observation.read import read_log
from modeler.simulation import SimulationSettings, simulate, write_log
from tests.modules import compiled, module

ROBOTS = ("demo-arm", "puma560", "scara")


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Compiled robots, each with two simulated logs."""
    folder, found = tmp_path_factory.mktemp("channels"), {}
    for name in ROBOTS:
        logs = []
        for seed in (1, 2):
            settings = SimulationSettings(
                duration=12.0, rate=250.0, seed=seed, torque_noise=0.01 * seed
            )
            place = folder / f"{name}{seed}.parquet"
            write_log(place, simulate(module(name).model.robot, settings))
            logs.append(read_log(place, compiled(name).spec))
        found[name] = compiled(name), logs
    return found


def unit(machine, j):
    return 180.0 / np.pi if machine.spec.joints[j].unit == "rad" else 1e3


MISTAKES = {
    "all units": (lambda c, q, tau, j, k: q.__imul__([unit(c, i) for i in range(len(q[0]))]),
                  "the positions look like degrees"),
    "unit": (lambda c, q, tau, j, k: q[:, j].__imul__(unit(c, j)), "its position looks like"),
    "position sign": (lambda c, q, tau, j, k: q[:, j].__imul__(-1.0), "sign"),
    "positions": (lambda c, q, tau, j, k: q.__setitem__(np.s_[:, [j, k]], q[:, [k, j]]),
                  "positions look exchanged"),
    "torques": (lambda c, q, tau, j, k: tau.__setitem__(np.s_[:, [j, k]], tau[:, [k, j]]),
                "torques look exchanged"),
    "zero": (lambda c, q, tau, j, k: q[:, j].__iadd__(np.pi / 2), "its zero seems to be off by 90"),
    "turns": (lambda c, q, tau, j, k: q.__imul__([1 / (2 * np.pi) if unit(c, i) != 1e3 else 100.0
                                                  for i in range(len(q[0]))]), "look like turns"),
    "twice": (lambda c, q, tau, j, k: tau[:, j].__imul__(2.0), "the measured torque is "),
    "two signs": (lambda c, q, tau, j, k: tau.__setitem__(np.s_[:, [j, k]], -tau[:, [j, k]]),
                  "the measured torques have the other sign"),
    "torque sign": (lambda c, q, tau, j, k: tau[:, j].__imul__(-1.0), "sign"),
    "all signs": (lambda c, q, tau, j, k: tau.__imul__(-1.0),
                  "all measured torques have the other sign"),
}  # fmt: skip


UNSEEN = {"zero": "90 degrees", "twice": "scale error of 2", "torque sign": "wrong sign"}


@pytest.mark.parametrize("name", ROBOTS)
def test_a_fit_to_sound_channels_is_not_doubted(runs, name):
    machine, logs = runs[name]
    for log in logs:
        observation = observe(machine, [log])
        assert all(found.unseen for found in log_findings(machine, observation))


@pytest.mark.rotating
@pytest.mark.parametrize("mistake", MISTAKES)
def test_mistakes_drawn_at_random_are_named_although_the_fit_adapts(runs, mistake):
    """Of two for each robot one is missed, in words that name the joint or the swap.

    What these logs cannot show is said too.
    """
    change, words = MISTAKES[mistake]
    random, seen = np.random.default_rng(list(MISTAKES).index(mistake)), Counter()
    for name in ROBOTS:
        machine, logs = runs[name]
        for _ in range(2):
            log = logs[int(random.integers(2))]
            j, k = random.permutation(len(log.joints))[:2]
            if mistake == "zero" and machine.spec.joints[j].unit != "rad":
                continue
            q, tau = log.q.copy(), log.tau.copy()
            change(machine, q, tau, j, k)
            observation = observe(machine, [replace(log, q=q, tau=tau)])
            (first, *_) = log_findings(machine, observation)
            named = words in first.line
            if named and mistake in ("unit", "position sign", "torque sign", "zero", "twice"):
                named = f"joint {log.joints[j]}:" in first.line
            named |= any(
                UNSEEN.get(mistake, "?") in part
                and log.joints[j] in part.partition(" of joint ")[2].split(", ")
                for part in (first.line.split("; ") if first.unseen else ())
            )
            seen[named] += 1
    assert seen[False] <= 1, seen


def test_the_torque_in_another_unit_is_named_where_joints_are_coupled(runs):
    machine, (log, _) = runs["demo-arm"]
    observation = observe(machine, [replace(log, tau=log.tau * [1.0, 1.0, 1000.0])])
    (found, *_) = log_findings(machine, observation)
    assert found.certain
    head, _, tail = found.line.partition(" times what it should be (is it in mN m?)")
    assert head.startswith("joint 3: the measured torque is ") and tail
    assert float(head.split()[-1]) == pytest.approx(1000.0, rel=0.05)


@pytest.mark.parametrize("name", ROBOTS)
def test_torques_in_mN_m_make_no_machine(runs, name):
    machine, (log, _) = runs[name]
    observation = observe(machine, [replace(log, tau=1e3 * log.tau)])
    fit = with_verdict(machine, observation, identify(observation, "weighted", machine))
    assert fit.verdict.line.startswith("Not valid: the links would weigh ")
    assert "mN m" in fit.verdict.line


PAN_TILT = """
name = "pan-tilt"
gravity = [0, 0, -9.81]

[mdh]
columns = ["j", "alpha", "d", "theta"]
rows = [["1", 0, 0, "q1"], ["2", "pi/2", 0.05, "q2"]]

[effects]
viscous = "all"

[parameters]
ZZ1 = 0.02
XX2 = 0.02
YY2 = 0.05
ZZ2 = 0.06
MX2 = 0.36
M2 = 3.0
Fv1 = 0.5
Fv2 = 0.5
"""


def test_links_that_reach_beyond_their_frames_are_a_machine(capsys, tmp_path):
    """A camera of 3 kg in 0.12 m from the tilting axis; the frames are 0.05 m apart."""
    robot, log = tmp_path / "pan.toml", tmp_path / "pan.parquet"
    robot.write_text(PAN_TILT)
    assert main(["simulate", str(robot), "--duration", "10", "--seed", "3", "--out", str(log)]) == 0
    for factor, usable in ((1.0, True), (1e3, False)):
        table = pq.read_table(log).to_pydict()
        scaled = {n: factor * np.array(v) if n[:3] == "tau" else v for n, v in table.items()}
        pq.write_table(pa.table(scaled), log)
        capsys.readouterr()
        out = str(tmp_path / "model.json")
        assert main(["fit", str(robot), str(log), "--out", out, "--json", "-"]) == 0
        found = json.loads(capsys.readouterr().out)
        assert found["usable"] == usable, found["doubts"]


@pytest.mark.parametrize("name", ROBOTS)
def test_a_clock_that_is_wrong_is_named_without_speeds(runs, name):
    """By the rule, or, where rotors of any inertia would do, by inertias beyond all measure."""
    machine, (log, _) = runs[name]
    observation = observe(machine, [replace(log, time=20.0 * log.time)])
    told = log_findings(machine, observation)
    fit = with_verdict(machine, observation, identify(observation, "weighted", machine), told)
    assert fit.verdict.line.startswith("Not valid: the clock seems to be wrong: ")
    assert not any(
        "clock" in found.line for found in log_findings(machine, observe(machine, [log]))
    )


def test_compare_says_what_diagnose_says(runs):
    machine, (train, other) = runs["demo-arm"]
    model = SimpleNamespace(beta=identify(observe(machine, [train])).beta, logs=())
    swapped = observe(machine, [replace(other, tau=other.tau[:, [1, 0, 2]])])
    lines = [found.line for found in log_findings(machine, swapped, model)]
    assert any("joints 1 and 2: their torques look exchanged" in line for line in lines)
    assert log_findings(machine, observe(machine, [other]), model) == ()


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    """A folder with a simulated log, one in degrees with a spike, and a model of the first."""
    tmp_path = tmp_path_factory.mktemp("arm")
    for name, seed in (("run", "1"), ("other", "2")):
        main(["simulate", "demo-arm", "--duration", "10", "--rate", "250", "--seed", seed,
              "--out", str(tmp_path / f"{name}.parquet")])  # fmt: skip
    table = pq.read_table(tmp_path / "other.parquet")
    columns = {name: table[name].to_numpy().copy() for name in table.column_names}
    columns["q2"] = np.degrees(columns["q2"])
    columns["tau1"][1000] += 2000.0
    pq.write_table(pa.table(columns), tmp_path / "bad.parquet")
    words = ["fit", "demo-arm", tmp_path / "run.parquet", "--out", tmp_path / "m.json"]
    assert main([str(word) for word in words]) == 0
    return tmp_path


@pytest.mark.parametrize("command", ["fit", "compare"])
def test_the_commands_print_and_write_the_doubts(arm, capsys, command):
    words = {
        "fit": ["fit", "demo-arm", arm / "bad.parquet", "--out", arm / "b.json"],
        "compare": ["compare", arm / "m.json", arm / "bad.parquet"],
    }[command]
    assert main([str(word) for word in (*words, "--json", arm / "out.json")]) == 0
    out = capsys.readouterr().out
    content = json.loads((arm / "out.json").read_text())
    said = "joint 2: its position looks like degrees"
    assert said in out and any(said in line for line in content["doubts"])
    confirmed = any(line.startswith("bad.parquet: tau1: spike") for line in content["doubts"])
    assert confirmed == (command == "fit")  # compare mends nothing that the fit did not try


@pytest.mark.parametrize("mistake", ["late", "turns", "sign"])
def test_every_command_says_the_same(arm, capsys, mistake):
    """Of a log beside a model of another one, and of a log beside its own model."""
    table = pq.read_table(arm / "other.parquet")
    columns = {name: table[name].to_numpy().copy() for name in table.column_names}
    columns["q2"] = {
        "late": np.interp(columns["time"] - 0.03, columns["time"], columns["q2"]),
        "turns": columns["q2"] / (2.0 * np.pi),
        "sign": columns["q2"],
    }[mistake]
    columns["tau1"] *= -1.0 if mistake == "sign" else 1.0
    log, own = arm / f"{mistake}.parquet", arm / f"{mistake}.json"
    pq.write_table(pa.table(columns), log)
    said = {
        "late": "joint 2: its position comes ",
        "turns": "joint 2: its position looks like turns",
        "sign": "joint 1: the measured torque has the other sign of what a machine",
    }[mistake]
    for words in (
        ["fit", "demo-arm", log, "--out", own],
        ["log", log, "--robot", "demo-arm"],
        *([command, model, log] for command in ("compare", "diagnose")
          for model in (arm / "m.json", own)),
    ):  # fmt: skip
        assert main([str(word) for word in words]) == 0
        assert said in capsys.readouterr().out, words


def test_sound_logs_leave_the_doubts_empty(arm, capsys):
    words = ["compare", arm / "m.json", arm / "other.parquet", "--json", arm / "out.json"]
    assert main([str(word) for word in words]) == 0
    assert json.loads((arm / "out.json").read_text())["doubts"] == []


def test_damaged_values_are_used_when_asked_for(arm, capsys):
    words = ["fit", "demo-arm", arm / "bad.parquet", "--out", arm / "b.json", "--keep-damaged"]
    assert main([str(word) for word in words]) == 0
    assert "all values are used as logged" in capsys.readouterr().out


def test_the_delay_that_is_not_detectable_raises_the_error_by_a_third(runs, monkeypatch):
    """Told per joint, far below the longest that is looked for where a robot moves well."""
    from modeler.estimation import findings

    machine, (log, _) = runs["demo-arm"]
    monkeypatch.setattr(findings, "_DELAY", 0.0)
    noisy = np.random.default_rng(3).normal(size=log.tau.shape) * log.tau.std(axis=0)
    observation = observe(machine, [replace(log, tau=log.tau + noisy)])
    (found, *_) = log_findings(machine, observation)
    assert found.unseen and found.line.startswith("Not detectable in these logs: ")
    stated = found.line.partition("a delay below ")[2].split(";")[0].split(", ")
    delays = {text.split()[-1]: 1e-3 * float(text.split()[0]) for text in stated}
    assert delays and max(delays.values()) < findings.LONGEST
    seen = findings._evidence(machine, observation)
    beta = seen.judge.possible(seen.data, *seen.judge.solved(seen.data))
    for name, delay in delays.items():
        place = [seen.name(k) for k in range(len(seen.joints))].index(name)
        shift = delay * np.eye(len(log.joints))[seen.joints[place]]
        late = findings._machine_data(seen, seen.rows.shifted(machine, shift), beta)
        made = np.hypot(seen.judge.errors(late, False)[place], seen.errors[place])
        assert made / seen.errors[place] == pytest.approx(4.0 / 3.0, rel=0.1)
