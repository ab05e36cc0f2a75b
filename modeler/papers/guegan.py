"""Guegan, Khalil and Lemoine 2003, eqs. (1), (2), (23) to (30): their blocks beside the emitted C.

Every block is evaluated from its formulas, those of `modeler derive --blocks`, at random closed
states; so is what the scan prints in its place, letter by letter.
"""

import math
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from modeler import simulation
from modeler.codegen import Derivation, derive, generate
from modeler.derivation import draw_random_states
from modeler.estimation import FitResult, identify
from modeler.excitation import MotionBounds, MotionRequest, design_motion
from modeler.formulas import SheetWriter, derive_leg_blocks
from modeler.papers.methods import (
    MethodRow,
    MethodTable,
    Outcome,
    judge_outcome,
    judge_recovery,
    read_quotation,
    read_table,
)
from modeler.papers.paper import Paper
from modeler.regression import Observation, observe, read_log
from modeler.robot import Limits, Robot, read_robot
from modeler.runtime import CompiledModel, load_cached_model

STATES, SEED = 20, 2003
SAME, WRONG = 1e-12, 1e-2
"""Shares of the largest entry: what two computations of a block may differ by; another block."""

_SETTING = (
    f"at {STATES} random closed states, as a share of the largest entry: formulas of `modeler "
    "derive --blocks`",
    "against base regressor and coupling of the emitted C; with the scan's J_i^T in place of "
    "J_i^-T they are off",
)


def build_block_table(*robots: tuple[Derivation, CompiledModel]) -> MethodTable:
    """Builds the blocks of robots with three legs as printed, as derived, and in the emitted C.

    Args:
        robots: with legs of their own, and with legs alike.
    """
    rows = [row for derivation, compiled in robots for row in _compare_blocks(derivation, compiled)]
    return MethodTable("Blocks of eqs. (1), (2) and (23) to (30)", _SETTING, tuple(rows))


def _compare_blocks(derivation: Derivation, compiled: CompiledModel) -> list[MethodRow]:
    model, closure = derivation.model, derivation.model.closure
    assert closure is not None
    states = draw_random_states(model, STATES, np.random.default_rng(SEED))
    at, free = list(closure.actuated), [joint.name for joint in model.robot.free_joints]
    q, qd, qdd = (numbers[:, at] for numbers in states)
    phi, G = compiled.base_regressor(q, qd, qdd), compiled.coupling(q)
    names = [p.name for p in derivation.base.parameters]
    read: dict[str, np.ndarray | float] = dict(model.geometry.values)
    for kind, numbers in zip(("q", "qd", "qdd"), states, strict=True):
        read |= {f"{kind}[{k}]": column for k, column in enumerate(numbers.T)}
    of, c = dict[str, np.ndarray](), dict[str, np.ndarray]()  # our block; the same of the C
    for block in derive_leg_blocks(model, derivation.base, SheetWriter(model.graph, {})):
        of[block.name] = np.zeros((STATES, len(block.rows), len(block.columns)))
        block_values = model.graph.evaluate_outputs([*block.entries.values()], read)
        for (row, column), value in zip(block.entries, block_values, strict=True):
            of[block.name][:, block.rows.index(row), block.columns.index(column)] = value
        known = block.columns[0] in names
        if known:
            c[block.name] = phi[:, :, [names.index(x) for x in block.columns]]
        else:
            c[block.name] = G[:, [free.index(x) for x in block.rows]]
    return _build_rows(of, c, [name[2:] for name in of if name.startswith("DL")], phi)


def _build_rows(
    of: dict[str, np.ndarray], c: dict[str, np.ndarray], legs: list[str], phi: np.ndarray
) -> list[MethodRow]:
    Jp = of["Jp"].swapaxes(1, 2)  # J_p^T
    DP, drives, ends, scans = Jp @ of["WP"], list[np.ndarray](), [], []
    for i, k in enumerate(legs):
        inverse, D = of[f"J{k}inv"], of[f"DL{k}"]
        drives.append(of[f"Dm{k}"] * np.eye(len(legs))[i][:, None])  # on the motor's row
        ends.append(Jp @ inverse.swapaxes(1, 2) @ D)
        scans.append(Jp @ np.linalg.inv(inverse).swapaxes(1, 2) @ D)
    if c["DL1"].shape[2] * len(legs) > phi.shape[2]:  # shared: legs alike
        printed, right = "Jp^T sum_i [Ji^T DLi]", np.sum(ends, axis=0)
        blocks = np.dstack([c["WP"], *(c[f"Dm{k}"] for k in legs), c["DL1"]])
        first = _build_row("(30) DLS", printed, right, c["DL1"], np.sum(scans, axis=0))
        return [
            first,
            _build_row("(30) Dsym", "its blocks", np.dstack([DP, *drives, right]), blocks),
        ]
    rows = [_build_row("(1) Jp^-1", "Ld = Jp^-1 V", of["Jpinv"] @ of["Jp"], c["Jpinv"])]
    for k in legs:
        name, ours = f"(2) J{k}^-1", of[f"J{k}inv"] @ of["Jp"]
        rows.append(_build_row(name, f"qd{k} = J{k}^-1 V", ours, c[f"J{k}inv"]))
    for k, drive in zip(legs, drives, strict=True):
        columns = "ddotq1i, dotq1i, sign(dotq1i), 1"
        rows.append(_build_row(f"(25) Dm{k}", columns, drive, c[f"Dm{k}"]))
    rows.append(_build_row("(26) DP", "Jp^T (dotVP - g)", DP, c["WP"]))
    parts, wanted = [DP], [c["WP"]]
    for n, k in enumerate(legs):
        parts.append(np.dstack([drives[n], ends[n]]))
        wanted.append(np.dstack([c[f"Dm{k}"], c[f"DL{k}"]]))
        scan = np.dstack([drives[n], scans[n]])
        rows.append(
            _build_row(f"({27 + n}) DB{k}", f"Jp^T J{k}^T DL{k}", parts[-1], wanted[-1], scan)
        )
    return [*rows, _build_row("(23) DBrob", "its blocks", np.dstack(parts), np.dstack(wanted))]


def _build_row(
    what: str, printed: str, ours: np.ndarray, c: np.ndarray, scan: np.ndarray | None = None
) -> MethodRow:
    error, size = _compute_relative_error(ours, c), " x ".join(map(str, c.shape[1:]))
    if scan is None:
        return MethodRow(f"{what}, {size}", printed, f"{error:.1e}", judge_outcome(error < SAME))
    well = judge_outcome(error < SAME and _compute_relative_error(scan, c) > WRONG, Outcome.DERIVED)
    printed_text = f"{printed}: {_compute_relative_error(scan, c):.2g}"
    why = "with the inverse of J_i that equal power demands"
    return MethodRow(f"{what}, {size}", printed_text, f"{error:.1e}", well, why)


def _compute_relative_error(block: np.ndarray, c: np.ndarray) -> float:
    return float(np.max(np.abs(block - c)) / np.max(np.abs(c)))


# Guegan, Khalil and Lemoine 2003, section 5.1: what condition numbers ten trajectories can have.
#
# The paper selects "10 random trajectories giving a good condition number", between random joint
# positions, 65814 rows of three motors at 2.5 ms in all. It prints no range, speed or acceleration.
# The Orthoglide is built for the cube in which its platform is half to twice as fast as its motors
# (Chablat and Wenger 2003); that this is a cube of 0.2 m follows from D4 = 0.31 m.


MOTION_RATE, MOTION_RUNS, TRIED, DRAWN, STARTS = 400.0, 10, 60, 30, 3
"""Hz; motions together; of which they are chosen; tens at random; choices that are begun."""
SPEEDS = (0.4, 0.8, 1.2)  # m/s, with ten times as much in m/s^2
ESSENTIAL = 13  # first columns: platform and motors
SEARCH = MotionRequest(duration=10.0, harmonics=6, criterion="condition", starts=2)
_BETTER = 1e-4


def compute_cube_range(length: float, straight: float) -> tuple[float, float]:
    """Returns the motors' range over the cube where the platform is 1/2 to 2 times as fast.

    On its diagonal p = t (1, 1, 1), from where the bars of length D are straight, rows of J_p^-1
    are 1 and twice e = t / sqrt(D^2 - 2 t^2), with singular values 1 + 2 e, 1 - e and 1 - e. They
    are 1/2 to 2 for -1/4 <= e <= 1/2. A motor is where it is there, plus t_i + D - sqrt(D^2 - t_j^2
    - t_k^2).

    Args:
        length: D, m.
        straight: place of the motors where all bars are straight, m.
    """
    low, high = (e * length / math.sqrt(1.0 + 2.0 * e * e) for e in (-0.25, 0.5))
    return straight + low, straight + high + length - math.sqrt(length**2 - 2.0 * high**2)


def compute_condition_numbers(
    compiled: CompiledModel, limits: Limits, lasts: float
) -> tuple[np.ndarray, float, float]:
    """Computes condition numbers of W without noise, unscaled columns, SI units.

    Args:
        compiled: the robot.
        limits: of every motor.
        lasts: s, of each of the motions between random joint positions.

    Returns:
        of tens at random, ascending; of the best ten that were found; the median of tens at random
        for the columns of platform and motors.
    """
    grams = []
    for seed in range(TRIED):
        motion = simulation.build_point_to_point_reference(
            (limits,) * len(compiled.spec.joints), lasts, MOTION_RATE, seed
        )
        if not compiled.closing_status(motion.q).any():
            W = compiled.observation(motion.q, motion.qd, motion.qdd)
            grams.append(W.T @ W)
    every, rng = np.stack(grams), np.random.default_rng(0)
    tens = [rng.permutation(len(every))[:MOTION_RUNS] for _ in range(DRAWN)]
    sums = [every[ten].sum(axis=0) for ten in tens]
    few = [_compute_condition_number(gram[:ESSENTIAL, :ESSENTIAL]) for gram in sums]
    chosen = min(_exchange_motions(every, ten) for ten in tens[:STARTS])
    conditions = np.sort([_compute_condition_number(gram) for gram in sums])
    return conditions, chosen, float(np.median(few))


def _exchange_motions(every: np.ndarray, ten: np.ndarray) -> float:
    """The condition number when no exchange of one motion makes it smaller."""
    motions, least, better = list(ten), _compute_condition_number(every[ten].sum(axis=0)), True
    while better:
        better = False
        for place in range(MOTION_RUNS):
            rest = every[np.delete(motions, place)].sum(axis=0)
            for other in set(range(len(every))) - {*motions}:
                tried = _compute_condition_number(rest + every[other])
                if tried < (1.0 - _BETTER) * least:
                    motions[place], least, better = other, tried, True
    return least


def _compute_condition_number(gram: np.ndarray) -> float:
    sizes = np.linalg.eigvalsh(gram)
    return float(np.sqrt(sizes[-1] / sizes[0]))


def build_motion_table(
    compiled: CompiledModel, robot_limits: Limits, rows: float, printed: Sequence[float]
) -> MethodTable:
    """Builds the table of what motions within several limits reach, beside the print.

    Args:
        compiled: with legs alike, 23 columns.
        robot_limits: limits of the robot file.
        rows: of the printed W.
        printed: condition numbers of 23 and of 13 columns.
    """
    spec = compiled.spec
    assert spec.closure is not None
    home = np.array(spec.closure.home)[list(spec.closure.actuated)]  # where the bars are straight
    (D,) = (symbol.value for symbol in spec.symbols if symbol.name == "D4")
    lasts = rows / len(spec.joints) / MOTION_RATE / MOTION_RUNS
    cube = [Limits(*compute_cube_range(D, home[0]), v, 10.0 * v) for v in SPEEDS]
    table, all_, few = list[MethodRow](), f"{printed[0]:.5g}", f"{printed[1]:.4g}"
    reached = list[float]()
    for limits in (robot_limits, *cube):
        drawn, chosen, essential = compute_condition_numbers(compiled, limits, lasts)
        ours = f"{np.median(drawn):.4g} ({drawn[0]:.4g} to {drawn[-1]:.4g}); {essential:.3g}"
        why = f"ten chosen of {TRIED}: {chosen:.4g}"
        table.append(MethodRow(_format_limits(limits), f"{all_}; {few}", ours, Outcome.SHOWN, why))
        reached += [chosen, drawn[-1]] if limits is not robot_limits else []
    for limits in (robot_limits, cube[1]):
        what = f"Fourier series, {_format_limits(limits)}"
        condition = _search_condition_number(compiled, limits, home)
        ours = f"{condition:.4g}"
        table.append(MethodRow(what, all_, ours, Outcome.SHOWN, "`modeler excite`, 10 s"))
    least, most = min(reached), max(reached)
    outcome = judge_outcome(least < printed[0] < most, Outcome.HOLDS)
    why, ours = "between ten chosen motions and ten slow ones", f"{least:.4g} to {most:.4g}"
    table.append(MethodRow("in reach over the cube", all_, ours, outcome, why))
    setting = (
        f"the paper prints no limits, only {rows:g} rows: ten motions of {lasts:.2f} s at 2.5 ms "
        "between random joint positions",
        "first range: of the robot file; the other: of the cube where the platform is half to "
        "twice as fast as the motors",
    )
    title = "The exciting motion: condition numbers in reach, 23 columns; 13 columns"
    return MethodTable(title, setting, tuple(table))


def _format_limits(limits: Limits) -> str:
    reach = f"{limits.lower:.3f} to {limits.upper:.3f} m"
    return f"{reach}, {limits.speed:g} m/s, {limits.acceleration:g} m/s2"


def _search_condition_number(compiled: CompiledModel, limits: Limits, home: np.ndarray) -> float:
    """The same of the Fourier series that the search for an exciting motion finds."""
    joints, one = tuple(joint.name for joint in compiled.spec.joints), np.ones(len(home))
    low, high, speed, more = (
        getattr(limits, name) * one for name in ("lower", "upper", "speed", "acceleration")
    )
    bounds = MotionBounds(joints, low, high, speed, more, np.inf * one, home=home)
    samples = design_motion(compiled, bounds, SEARCH).sample_motion(MOTION_RATE)
    motion = (np.stack([samples[k + j] for j in joints], axis=1) for k in ("q", "qd", "qdd"))
    W = compiled.observation(*motion)
    return _compute_condition_number(W.T @ W)


# Guegan, Khalil and Lemoine 2003, section 5: ten motions, least squares with 23 and 13 parameters.
#
# The simulated Orthoglide is as the paper concludes: the values of its Table 3, links of the
# parallelograms too light to be seen. 2.5 ms, encoders of 1 um, 10 % torque noise.


WHOLE, ROBOT = "orthoglide-2003", "orthoglide-2003-similar-legs"
RUNS, SECONDS, RATE, NOISE = 10, 4.0, 400.0, 0.1
LIMITS = Limits(0.02, 0.32, 0.8, 8.0)
WEAK = ("ZZ2R", "MX2", "XX3R", "MX4")
DIRECTION = {"ZZ2R": 0.62, "MX2": 1.0, "XX3R": -0.31, "MX4": -1.0}
BAD = 15.0
"""Percent, of the paper: "a parameter with sigma >= 15 is not good identified"."""
FALL = 10.0
SETTING = (
    "simulated: the values of Table 3, links of the parallelograms without mass;",
    "ten motions between random points, 4 s at 2.5 ms, encoders of 1 um, 10 % torque noise",
)
SLIDE = 0.8
"""kg, of the slide of leg 3: M1R3, which gravity makes a part of Off3."""

LETTERS = {"MRP": "MPR", "Ma1R1": "Ia11R", "Ma1R2": "Ia12R", "Ma13": "Ia13R", "MX4R": "MX4"}
LETTERS |= {"Off1": "Off11", "Off2": "Off12", "Off3": "Off13R"}
"""Names of Tables 2 and 3 that are not ours with small letters."""


def reproduce_guegan(paper: Paper, report: Callable[[float], None]) -> list[MethodTable]:
    """Reproduces Tables 2 and 3, the condition numbers, and the weak direction of Table 2."""
    table_2, table_3 = (
        {
            LETTERS.get(word, word.replace("FV", "Fv").replace("FS", "Fs")): values
            for word, values in read_table(paper, place).items()
        }
        for place in ("Table 2", "Table 3")
    )
    truth = {name: values[0] for name, values in table_3.items()}
    each, derivation = (derive(read_robot(name)) for name in (WHOLE, ROBOT))
    compiled = load_cached_model(generate(derivation))
    blocks = build_block_table((each, load_cached_model(generate(each))), (derivation, compiled))
    observation, exact = _simulate_logs(derivation.robot, truth, compiled, report)
    full, reduced = identify(observation), identify(_select_parameters(observation, truth))
    places = ("Table 2, condition number", "Table 3, condition number")
    printed = [read_table(paper, place)["Condition"][0] for place in places]
    robot_limits, rows = derivation.robot.limits["11"], read_quotation(paper, "65814 x 23")[0]
    return [
        blocks,
        _build_all_parameters_table(table_2, truth, full),
        _build_weak_direction_table(table_2, observation.names, exact),
        _build_essential_table(table_3, full, reduced),
        _build_condition_table(printed, full, reduced),
        build_motion_table(compiled, robot_limits, rows, printed),
    ]


def _build_machine(robot: Robot, truth: Mapping[str, float]) -> Robot:
    """Slides and platform alone, with the values of Table 3."""
    parameters = {"MP": truth["MPR"]}
    for leg in "123":
        third = leg == "3"
        parameters |= {f"{name}1{leg}": truth[f"{name}1{leg}"] for name in ("Fv", "Fs")}
        parameters[f"M1{leg}"] = SLIDE
        parameters[f"Ia1{leg}"] = truth[f"Ia1{leg}R"] - SLIDE
        parameters[f"Off1{leg}"] = truth["Off13R"] + 9.81 * SLIDE if third else truth[f"Off1{leg}"]
    empty = {f"{row}{leg}": () for row in "23457" for leg in "123"}
    return replace(robot, shared=(), links={**robot.links, **empty}, parameters=parameters)


def _simulate_logs(
    robot: Robot,
    truth: Mapping[str, float],
    compiled: CompiledModel,
    report: Callable[[float], None],
) -> tuple[Observation, np.ndarray]:
    """What is measured on all motions, and the regressor along the motions as they were."""
    machine, logs, exact = _build_machine(robot, truth), [], []
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(RUNS):
            settings = simulation.SimulationSettings(
                duration=SECONDS,
                rate=RATE,
                seed=seed,
                torque_noise=NOISE,
                linear_resolution=1e-6,
                motion="point-to-point",
                limits={f"1{leg}": LIMITS for leg in "123"},
            )
            log = simulation.simulate(machine, settings)
            place = Path(folder) / f"run{seed}.parquet"
            simulation.write_log(place, log)
            logs.append(read_log(place, compiled.spec))
            exact.append(compiled.observation(log.truth.q, log.truth.qd, log.truth.qdd))
            report((seed + 1) / RUNS)
    return observe(compiled, logs), np.concatenate(exact)


def _select_parameters(observation: Observation, names: Mapping[str, float]) -> Observation:
    """The same rows with the columns of these parameters only."""
    columns = [i for i, name in enumerate(observation.names) if name in names]
    return replace(
        observation,
        regressor=lambda segment, window: observation.regressor(segment, window)[..., columns],
        names=tuple(observation.names[i] for i in columns),
        units=tuple(observation.units[i] for i in columns),
    )


def _build_all_parameters_table(
    printed: Mapping[str, tuple[float, ...]], truth: Mapping[str, float], full: FitResult
) -> MethodTable:
    """Table 2; the truth of what Table 3 leaves out is 0."""
    rows = _compare_parameters(printed, truth, full)
    theirs = [abs(printed[name][1]) for name in WEAK]
    ours = [p.relative_sigma_percent or 0.0 for p in full.parameters if p.name in WEAK]
    what, why = "%sigma of " + ", ".join(WEAK), f"{BAD:g} % and more: not well identified"
    outcome = judge_outcome(min(*theirs, *ours) >= BAD, Outcome.HOLDS)
    rows.append(MethodRow(what, _format_range(theirs), _format_range(ours), outcome, why))
    return MethodTable("Table 2: all base parameters", SETTING, tuple(rows))


def _compare_parameters(
    printed: Mapping[str, tuple[float, ...]], truth: Mapping[str, float], fit: FitResult
) -> list[MethodRow]:
    rows = []
    for p in fit.parameters:
        value, percent = printed[p.name]
        text = f"{value:.5g} ({abs(percent):.3g} %)"
        rows.append(judge_recovery(p.name, text, truth.get(p.name, 0.0), p.value, p.sigma or 0.0))
    return rows


def _format_range(values: list[float]) -> str:
    return f"{min(values):.3g} % to {max(values):.3g} %"


def _build_weak_direction_table(
    printed: Mapping[str, tuple[float, ...]], names: tuple[str, ...], exact: np.ndarray
) -> MethodTable:
    """The right singular vector of the smallest singular value: Table 2 is noise along it."""
    weakest = np.linalg.svd(exact, full_matrices=False)[2][-1]
    ours = {name: weakest[i] / weakest[names.index("MX2")] for i, name in enumerate(names)}
    theirs = {name: printed[name][0] / printed["MX2"][0] for name in WEAK}
    rows = []
    for name in WEAK:
        if name != "MX2":
            texts = f"{name}/MX2", f"{theirs[name]:.3f}", f"{ours[name]:.3f}"
            outcome = judge_outcome(abs(theirs[name] - ours[name]) < 0.05)
            why = f"within 0.05; derived {DIRECTION[name]:.3g}"
            rows.append(MethodRow(*texts, outcome, why))
    rest = max(abs(value) for name, value in ours.items() if name not in WEAK)
    outcome = judge_outcome(rest < 0.1, Outcome.DERIVED)
    rows.append(MethodRow("all others", "-", f"{rest:.2g}", outcome, "less than 0.1"))
    return MethodTable(
        "The direction that noise follows in Table 2",
        (
            "values of Table 2 divided by its MX2, beside the weakest singular vector of W;",
            "derived: (ZZ2R, MX2, XX3R, MX4) = (2 D4, 1, -D4, -1)",
        ),
        tuple(rows),
    )


def _build_essential_table(
    printed: Mapping[str, tuple[float, ...]], full: FitResult, reduced: FitResult
) -> MethodTable:
    """Table 3, its selection, and both condition numbers."""
    plain = {name: value for name, (value, _) in printed.items()}
    rows = _compare_parameters(printed, plain, reduced)
    left = [p.name for p in full.parameters if not p.essential]
    theirs, ours = str(len(full.parameters) - len(printed)), f"{len(left)} by the F-test"
    rows.append(MethodRow("left out", theirs, ours, Outcome.SHOWN, ", ".join(left)))
    return MethodTable("Table 3: essential parameters", SETTING[:1], tuple(rows))


def _build_condition_table(
    printed: list[float], full: FitResult, reduced: FitResult
) -> MethodTable:
    """Condition numbers, each of its own motions; what must agree is what leaving ten out does."""
    rows = []
    for theirs, fit in zip(printed, (full, reduced), strict=True):
        what, number = f"{len(fit.parameters)} columns", f"{fit.condition_number:.4g}"
        why = "of other motions: see the next table"
        rows.append(MethodRow(what, f"{theirs:g}", number, Outcome.SHOWN, why))
    fall, ours = printed[0] / printed[1], full.condition_number / reduced.condition_number
    outcome = judge_outcome(min(fall, ours) > FALL, Outcome.HOLDS)
    bound = f"more than {FALL:g}"
    rows.append(MethodRow("their ratio", f"{fall:.3g}", f"{ours:.3g}", outcome, bound))
    return MethodTable("Condition numbers of W", (), tuple(rows))
