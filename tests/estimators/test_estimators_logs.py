"""Estimators on simulated logs: truth, an axis solved by other means, and what is refused."""

import dataclasses
import json

import numpy as np
import pyarrow.parquet as pq
import pytest
from scipy.integrate import solve_ivp

from modeler import api
from modeler.cli import main
from modeler.core.errors import DataError
from modeler.estimation import DirectModel, define_physical_parameters, project_parameters
from modeler.estimation.identify import METHODS, build_base_equations, identify
from modeler.estimation.least_squares import Problem
from modeler.estimation.payload import Payload, identify_with_payloads
from modeler.regression.log import Log
from modeler.regression.read import cut_rows
from tests.chain import chain_of
from tests.estimators.__main__ import main as suite
from tests.estimators.coverage import compiled, covered, measured, table
from tests.estimators.measured import tried
from tests.rotation import rotating, slow_rotating, with_cases

FOLLOWED = tuple(method for method in METHODS if method.startswith(("iv-direct", "didim")))


def rotating_but(first, methods):
    """The methods as parameters; those that simulate rotate, but for one."""
    turn = [method for method in methods if method in FOLLOWED and method != first]
    return [*(method for method in methods if method not in turn), *rotating(*turn)]


@pytest.fixture(scope="module")
def run():
    """A log of a two-link arm with a fine encoder, and its truth."""
    return measured(3, "torque")


@pytest.fixture(scope="module")
def observation(run):
    """Of that log with a tenth of a second without torques of a joint."""
    tau = run[0].tau.copy()
    tau[500:600, 0] = np.nan
    return api.observe(compiled(), [dataclasses.replace(run[0], tau=tau)])


@pytest.fixture(scope="module")
def few_rows(run):
    few = api.Processing(parallel_cutoff=5.0, decimation=100)
    return api.observe(compiled(), [cut_rows(run[0], slice(0, 400))], few)


@pytest.mark.parametrize("method", rotating_but("didim-consistent", METHODS))
def test_every_method_finds_the_values_of_a_well_measured_arm(observation, few_rows, run, method):
    fit = identify(observation, method, compiled())
    sigma = np.array([parameter.sigma for parameter in fit.parameters])
    assert fit.status == "ok" and fit.method == method and fit.relative_error < 0.01
    assert np.abs((fit.beta - run[1]) / sigma).max() < 5.0
    np.testing.assert_allclose(fit.beta, run[1], atol=0.03 * np.abs(run[1]).max())
    assert json.loads(json.dumps(fit.to_json()))["method"] == method
    if method in ("weighted", "consistent"):  # their prior makes up for rows
        assert np.isfinite(identify(few_rows, method, compiled()).beta).all()
    else:
        with pytest.raises(DataError, match=r"rows for 10 parameters"):
            identify(few_rows, method, compiled())


@slow_rotating("estimators on logs")
def test_the_noise_of_a_coarse_encoder_bends_weighted_values_and_not_those_of_iv():
    """1500 counts a turn: over machines the weighted values lie to one side, by many sigmas."""
    result = covered(range(1, 7), "coarse", ["weighted", "iv"])
    side = {name: np.linalg.norm(np.nanmean(item.z, axis=0)) for name, item in result.items()}
    assert side["iv"] < 0.7 * side["weighted"]
    near = {name: np.mean(np.abs(entry.z) < 2) for name, entry in result.items()}
    assert near["iv"] > near["weighted"] + 0.05
    text = table("coarse", result)
    assert "| weighted | " in text and "1500 counts" in text


@slow_rotating("estimators on logs")
def test_sensors_that_are_wrong_at_times_bend_didim_and_not_its_robust_steps():
    methods = ["robust", "didim", "didim-robust"]
    result = covered((11, 12), "bursts", methods)
    far = {name: np.nanmedian(np.abs(item.shift)) for name, item in result.items()}
    assert far["didim-robust"] < 0.15 * far["didim"] and far["didim"] > 0.03
    for name in ("robust", "didim-robust"):  # nor are the sigmas those of the rows left out
        assert 0.3 < np.sqrt(np.mean(result[name].z ** 2)) < 2.0


def test_where_the_values_are_those_of_a_machine_the_consistent_ones_are_the_same(observation):
    free, bound = (identify(observation, method, compiled()) for method in ("iv", "iv-consistent"))
    size = np.sqrt(np.diag(free.covariance))
    assert np.abs((bound.beta - free.beta) / size).max() < 0.05
    np.testing.assert_allclose(np.sqrt(np.diag(bound.covariance)), size, rtol=0.02)
    assert bound.standard and not free.standard


@pytest.fixture(scope="module")
def badly_known():
    """A wrist in noise: least squares and instruments make no machine of it."""
    observation = api.observe(compiled("wrist"), [measured(7, "bound")[0]])
    return problem_of(observation, build_base_equations(observation), compiled("wrist"))


def problem_of(observation, equations, model):
    alive = np.ones(len(equations.y), dtype=bool)
    data = equations.compress_rows(alive)
    return Problem(observation, equations.W, equations.y, alive, equations.names, data, model)


@pytest.mark.rotating("estimators on one log")
def test_instruments_end_in_the_machine_nearest_in_their_own_metric(badly_known):
    """By another formulation and another solver: the cone of all bodies, no logarithm in it."""
    free, bound = (METHODS[m].estimate(badly_known) for m in ("iv", "iv-consistent"))
    R, machine = free.whole[:, :-1], define_physical_parameters(compiled("wrist").spec)
    near = project_parameters(machine, free.beta, R)
    rise = np.linalg.norm(R @ (bound.beta - free.beta)) ** 2
    assert near.distance > 1.0 and near.distance**2 <= rise < 1.4 * near.distance**2
    (said,) = (said for said in bound.sentences if "at the bound of physical consistency" in said)
    assert "3" in said.partition(":")[0]


@pytest.mark.rotating("estimators on one log")
def test_a_row_that_moves_pulls_a_consistent_estimate_as_it_says():
    """d beta = pull_i e_i, against the estimate with that row moved."""
    log, _ = measured(3, "torque")
    observation = api.observe(compiled(), [log])
    equations = build_base_equations(observation)

    def estimate(y):
        moved = dataclasses.replace(equations, y=y)
        return METHODS["iv-consistent"].estimate(problem_of(observation, moved, compiled()))

    start, row = estimate(equations.y), 40
    e = 0.5 * start.sigma[observation.row_joint[row]]
    other = estimate(equations.y + e * (np.arange(len(equations.y)) == row))
    sigma = np.sqrt(np.diag(start.covariance))
    value, seen = e * start.influence[row] / sigma, (other.beta - start.beta) / sigma
    assert np.abs(value).max() > 0.01
    np.testing.assert_allclose(seen, value, atol=0.25 * np.abs(value).max())


AXIS = """
name = "axis"
gravity = [0, 0, 0]
effects = {viscous = "all", offset = "all"}
[mdh]
columns = ["j", "a", "sigma", "r"]
rows = [["1", "0", 1, "q1"]]
"""
MASS, VISCOUS, OFFSET = 80.0, 150.0, 4.0
SPEED_LOOP, RATIO = 60.0, 1.5  # rad/s, position loop over speed loop: a drive without integrator


@pytest.fixture(scope="module")
def axis():
    """A linear axis under proportional loops, its equation solved by Runge and Kutta."""
    model = chain_of(AXIS).compiled
    time = np.arange(0.0, 8.0, 0.002)

    def wanted(t):
        return 0.1 * np.sin(2 * np.pi * 0.7 * t) * np.sin(0.4 * t) + 0.03 * np.sin(9.0 * t)

    def force(t, q, v):
        return MASS * SPEED_LOOP * (RATIO * SPEED_LOOP * (wanted(t) - q) - v)

    def slope(t, x):
        return [x[1], (force(t, *x) - VISCOUS * x[1] - OFFSET) / MASS]

    x = solve_ivp(slope, (0, 8), [0, 0], t_eval=time, rtol=1e-10, atol=1e-12).y
    tau = force(time, *x)
    log = Log("axis", ("1",), time, x[0][:, None], tau[:, None], commanded=wanted(time)[:, None])
    return model, api.observe(model, [log])


@pytest.mark.rotating("long tests of estimators")
def test_the_loop_of_a_drive_is_found_and_its_motion_is_that_of_another_solver(axis):
    model, observation = axis
    robot = DirectModel(model, observation)
    beta = np.array([MASS, VISCOUS, OFFSET])
    loop = robot.choose_loop(beta)
    assert (loop.integral, loop.forward) == (0.0, 0.0) and loop.distance < 0.03
    assert loop.speed == pytest.approx(SPEED_LOOP, rel=0.05)
    assert loop.ratio == pytest.approx(RATIO, rel=0.05)
    (motion,) = robot.simulate_motions(beta, loop)
    (segment,) = robot.segments
    inside = segment.whole
    for simulated, logged in zip(motion, (segment.q, segment.qd, segment.qdd), strict=True):
        away = np.sqrt(np.mean((simulated - logged)[inside] ** 2))
        assert away < 0.02 * np.sqrt(np.mean(logged[inside] ** 2))


@pytest.mark.rotating("long tests of estimators")
@pytest.mark.parametrize("method", rotating_but("didim-robust", FOLLOWED))
def test_the_axis_comes_back_from_its_force_alone(axis, method):
    model, observation = axis
    fit = identify(observation, method, model)
    assert fit.status == "ok" and fit.beta == pytest.approx([MASS, VISCOUS, OFFSET], rel=0.02)
    assert any("no integral action and no feedforward" in said for said in fit.estimator_notes)


@pytest.mark.rotating("estimators on one log")
def test_methods_that_simulate_say_what_they_lack_without_commands(run):
    log, truth = run
    bare = dataclasses.replace(log, name="bare", commanded=None)
    observation = api.observe(compiled(), [bare])
    for method in ("iv", "iv-consistent"):
        words = f'^bare: method "{method}" needs commanded.*columns qc1'
        with pytest.raises(DataError, match=words):
            identify(observation, method, compiled())
    fit = identify(observation, "iv-direct", compiled())
    assert any("no commanded positions in these logs" in said for said in fit.estimator_notes)
    np.testing.assert_allclose(fit.beta, truth, atol=0.03 * np.abs(truth).max())


def test_a_command_that_does_not_move_is_refused(run):
    still = dataclasses.replace(run[0], commanded=0.0 * run[0].q)
    with pytest.raises(DataError, match="is not identifiable by the instruments"):
        identify(api.observe(compiled(), [still]), "iv", compiled())


@pytest.mark.rotating("estimators on one log")
def test_a_joint_without_a_motor_cannot_be_followed(run):
    text = AXIS.replace('"a", "sigma"', '"a", "mu", "sigma"').replace(
        'rows = [["1", "0", 1, "q1"]]', 'rows = [["1", "0", 1, 1, "q1"], ["2", "1", 0, 1, "q2"]]'
    )
    model = chain_of(text).compiled
    time = np.arange(0.0, 4.0, 0.002)
    q = np.column_stack([np.sin(3 * time), np.sin(5 * time + 1)])
    log = Log("cart", ("1", "2"), time, q, np.column_stack([np.cos(3 * time), 0 * time]))
    for method in FOLLOWED:
        with pytest.raises(DataError, match=f'method "{method}": joint 2 of axis has no motor'):
            identify(api.observe(model, [log]), method, model)


def test_loads_and_missing_robots_are_refused_in_a_line(run, observation):
    log, _ = run
    for method in ("iv", "didim-robust", "iv-direct-consistent"):
        with pytest.raises(DataError, match=f'method "{method}" evaluates the robot; got no comp'):
            identify(observation, method)
    loaded = dataclasses.replace(log, name="loaded", q=log.q + 0.1)
    both = api.observe(compiled(), [log, loaded])
    with pytest.raises(DataError, match=r'method "didim" knows the columns of the bare robot only'):
        identify_with_payloads(compiled(), both, [Payload(("loaded",))], "didim")
    assert identify_with_payloads(compiled(), both, [Payload(("loaded",))], "robust").loads


def pieces(seed):
    """A log in pieces of half a second, 100 Hz, q noisier than the logged qd and qdd."""
    log, _ = measured(seed, "torque")
    (part,) = api.observe(compiled(), [log]).stretches
    clean, random = part.segment, np.random.default_rng(seed)
    rows = np.arange(100, clean.samples - 100, 5)
    rows = rows[np.arange(len(rows)) % 60 < 47]
    q = clean.q[rows] + 1e-3 * random.normal(size=(len(rows), 2))
    t, qd, qdd, tau = (x[rows] for x in (clean.time, clean.qd, clean.qdd, log.tau))
    return Log("pieces", log.joints, t, q, tau, qd=qd, qdd=qdd)


@slow_rotating("estimators on logs")
def test_short_pieces_with_derivatives_of_their_own_are_followed_by_these():
    """Differentiating q again, and a controller that follows its noise: 4.0 % in the mean."""
    error = [
        identify(api.observe(compiled(), [pieces(seed)]), "didim", compiled()).relative_error
        for seed in (3, 4)
    ]
    assert np.mean(error) < 0.026


@slow_rotating("estimators on logs")
def test_didim_says_where_it_ends_worse_than_it_began(run, observation):
    """Commands that come late are not the ones that the robot followed."""
    log, _ = run
    wrong = dataclasses.replace(log, commanded=np.roll(log.commanded, 100, axis=0))
    fit = identify(api.observe(compiled(), [wrong]), "didim", compiled())
    start = identify(observation, "weighted", compiled())
    assert fit.relative_error > 10.0 * start.relative_error
    assert (
        'times the error of "weighted", from which method "didim" starts' in fit.estimator_notes[0]
    )
    honest = identify(observation, "didim", compiled())
    assert not any("times the error" in said for said in honest.estimator_notes)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("logs")
    for name, seed in (("a", 1), ("held", 2)):
        words = (
            f"simulate two-link --duration 5 --rate 500 --seed {seed} --out {made}/{name}.parquet"
        )
        assert main(words.split()) == 0
    return made


@pytest.mark.rotating("estimators on one log")
def test_the_command_compares_on_the_same_data(folder, capsys):
    page, raw = folder / "page.html", folder / "all.json"
    words = f"fit two-link {folder}/a.parquet --holdout {folder}/held.parquet --method weighted,iv"
    assert main([*words.split(), "--report", str(page), "--json", str(raw)]) == 0
    out = capsys.readouterr().out
    said = json.loads(raw.read_text())
    assert [entry["method"] for entry in said["methods"]] == ["weighted", "iv"]
    for item in said["methods"]:
        assert item["fit"]["relative_error"] < 0.02 and item["held_out_error"] < 0.02
        assert item["seconds"] > 0.0 and item["notes"] and item["limitations"]
        assert f"\n{item['method']}: " in out
    text = page.read_text()
    assert "Values and standard deviations" in text and "weighted" in text


@pytest.mark.rotating("estimators on one log")
def test_the_command_shows_a_refusal_in_its_row(folder, capsys, tmp_path):
    table = pq.read_table(folder / "a.parquet", columns=["time", "q1", "q2", "tau1", "tau2"])
    pq.write_table(table, tmp_path / "bare.parquet")
    argv = ["fit", "two-link", str(tmp_path / "bare.parquet"), "--method", "weighted,iv"]
    assert main(argv) == 0
    out = capsys.readouterr().out
    assert any(line.split()[:2] == ["iv", "refused"] for line in out.splitlines())
    assert "\niv: bare.parquet: method" in out


ROBUST = "fit emps a.csv --method didim-robust --out m"


@with_cases(
    "words, line",
    ("estimators magic", "estimators: got magic; expected one of weighted"),
    ("fit emps a.csv --method all --out m", "--out: got it with --method"),
    ("fit emps a.csv --method iv,ridge --model energy", "--model: got it"),
    (f"{ROBUST} --model energy", "energy model does not take method didim-robust"),
    (f"{ROBUST} --robot-out r", "--robot-out: --method didim-robust ends in base parameters"),
    ("fit emps a.csv --out m --holdout b.csv", "--holdout: got it with"),
    (f"{ROBUST} --payload-log a.csv", "method didim-robust takes no logs with a load"),
    (
        "fit emps a.csv --method two-step --payload-log a.csv --out m",
        "method two-step takes no logs with a load",
    ),
)
def test_bad_input_is_one_line(words, line, capsys):
    assert main(words.split()) == 1
    err = capsys.readouterr().err
    assert line in err and err.count("\n") == 1


@slow_rotating("estimators on logs")
def test_real_axis_and_every_method(measured_folder, capsys):
    """EMPS has published loops: 14 Hz of speed, 1.8 times that of position, nothing else."""
    assert suite(["measured", "--sets", "emps"]) == 0
    out = capsys.readouterr().out
    assert "refused" not in out and out.count("| emps |") == len(METHODS)
    assert out.count("no integral action and no feedforward") == len(FOLLOWED)


@slow_rotating("estimators on logs")
@pytest.mark.parametrize("name", ["kinova_gen3", "panda"])
def test_real_arms_without_commands_are_simulated_as_well_as_fitted(measured_folder, name):
    """Pieces of half a second; and a wrist whose fitted inertia is negative."""
    weighted, simulated = tried(name, measured_folder, ["weighted", "didim"])
    assert simulated.fit is not None, simulated.refusal
    assert simulated.fit.relative_error < 1.05 * weighted.fit.relative_error
    assert simulated.held_out_error < 1.05 * weighted.held_out_error
