"""Guegan, Khalil and Lemoine 2003, section 5.1: what condition numbers ten trajectories can have.

The paper selects "10 random trajectories giving a good condition number", between random joint
positions, 65814 rows of three motors at 2.5 ms in all. It prints no range, speed or acceleration.
The Orthoglide is built for the cube in which its platform is half to twice as fast as its motors
(Chablat and Wenger 2003); that this is a cube of 0.2 m follows from D4 = 0.31 m.
"""

import math
from collections.abc import Sequence

import numpy as np

from modeler.excitation import MotionBounds, MotionRequest, design_motion
from modeler.papers.methods import MethodRow, MethodTable, Outcome, judge_outcome
from modeler.robot import Limits
from modeler.runtime import CompiledModel
from modeler.simulation import build_point_to_point_reference

RATE, RUNS, TRIED, DRAWN, STARTS = 400.0, 10, 60, 30, 3
"""Hz; motions together; of which they are chosen; tens at random; choices that are begun."""
SPEEDS = (0.4, 0.8, 1.2)  # m/s, with ten times as much in m/s^2
ESSENTIAL = 13  # first columns: platform and motors
SEARCH = MotionRequest(duration=10.0, harmonics=6, criterion="condition", starts=2)
_BETTER = 1e-4


def compute_cube_range(length: float, straight: float) -> tuple[float, float]:
    """Range of the motors over the cube where the platform is 1/2 to 2 times as fast as they.

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
    """Condition numbers of W without noise, columns as they are, in SI units.

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
        motion = build_point_to_point_reference(
            (limits,) * len(compiled.spec.joints), lasts, RATE, seed
        )
        if not compiled.closing_status(motion.q).any():
            W = compiled.observation(motion.q, motion.qd, motion.qdd)
            grams.append(W.T @ W)
    every, rng = np.stack(grams), np.random.default_rng(0)
    tens = [rng.permutation(len(every))[:RUNS] for _ in range(DRAWN)]
    sums = [every[ten].sum(axis=0) for ten in tens]
    few = [_compute_condition_number(gram[:ESSENTIAL, :ESSENTIAL]) for gram in sums]
    chosen = min(_exchange_motions(every, ten) for ten in tens[:STARTS])
    return (
        np.sort([_compute_condition_number(gram) for gram in sums]),
        chosen,
        float(np.median(few)),
    )


def _exchange_motions(every: np.ndarray, ten: np.ndarray) -> float:
    """The condition number when no exchange of one motion makes it smaller."""
    motions, least, better = list(ten), _compute_condition_number(every[ten].sum(axis=0)), True
    while better:
        better = False
        for place in range(RUNS):
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
    """What motions within several limits reach, beside the printed numbers.

    Args:
        compiled: with legs alike, 23 columns.
        robot_limits: limits of the robot file.
        rows: of the printed W.
        printed: condition numbers of 23 and of 13 columns.
    """
    spec = compiled.spec
    assert spec.closure is not None
    home = np.array(spec.closure.home)[list(spec.closure.given)]  # where the bars are straight
    (D,) = (symbol.value for symbol in spec.symbols if symbol.name == "D4")
    lasts = rows / len(spec.joints) / RATE / RUNS
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
        what, condition = (
            f"Fourier series, {_format_limits(limits)}",
            _search_condition_number(compiled, limits, home),
        )
        table.append(
            MethodRow(what, all_, f"{condition:.4g}", Outcome.SHOWN, "`modeler excite`, 10 s")
        )
    least, most = min(reached), max(reached)
    table.append(MethodRow("in reach over the cube", all_, f"{least:.4g} to {most:.4g}",
                     judge_outcome(least < printed[0] < most, Outcome.HOLDS),
                     "between ten chosen motions and ten slow ones"))  # fmt: skip
    setting = (
        f"the paper prints no limits, only {rows:g} rows: ten motions of {lasts:.2f} s at 2.5 ms "
        "between random joint positions",
        "first range: of the robot file; the other: of the cube where the platform is half to "
        "twice as fast as the motors",
    )
    title = "The exciting motion: condition numbers in reach, 23 columns; 13 columns"
    return MethodTable(title, setting, tuple(table))


def _format_limits(limits: Limits) -> str:
    return (f"{limits.lower:.3f} to {limits.upper:.3f} m, {limits.speed:g} m/s, "
            f"{limits.acceleration:g} m/s2")  # fmt: skip


def _search_condition_number(compiled: CompiledModel, limits: Limits, home: np.ndarray) -> float:
    """The same of the Fourier series that the search for an exciting motion finds."""
    joints, one = tuple(joint.name for joint in compiled.spec.joints), np.ones(len(home))
    low, high, speed, more = (getattr(limits, name) * one
                              for name in ("lower", "upper", "speed", "acceleration"))  # fmt: skip
    bounds = MotionBounds(joints, low, high, speed, more, np.inf * one, home=home)
    samples = design_motion(compiled, bounds, SEARCH).sample_motion(RATE)
    motion = (np.stack([samples[k + j] for j in joints], axis=1) for k in ("q", "qd", "qdd"))
    W = compiled.observation(*motion)
    return _compute_condition_number(W.T @ W)
