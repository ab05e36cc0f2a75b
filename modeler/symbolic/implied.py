"""Linear relations between joints that loops imply, as a parallelogram does.

A variable that the loops tie to others by constant rational coefficients (q7 = q3, q5 = -q2 -
pi/2) is better stated than solved for: the model gets simpler, its C faster and its grouping exact.
Found as combinations of speeds that vanish at many closed postures; what is wrongly taken for a
relation could not close the loops, which are checked with the relations in place.
"""

import dataclasses
import math
from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from modeler.core.expression import parse
from modeler.robot import Robot
from modeler.symbolic.closed_states import closed_motion, closed_postures
from modeler.symbolic.model import SymbolicModel

_POSTURES = 16
_SEED = 31
_TOLERANCE = 1e-9
_LARGEST_DENOMINATOR = 24
_SAME = 1e-7


def with_implied_relations(model: SymbolicModel) -> Robot:
    """The robot with the relations that its loops imply; itself if there are none."""
    closure = model.closure
    assert closure is not None
    rng = np.random.default_rng(_SEED)
    u = closed_postures(model, _POSTURES, rng, reach=0.2)
    G = closed_motion(model, u, np.zeros((len(u), len(closure.given)))).coupling
    speeds = np.concatenate(list(G), axis=1)  # (len(u), postures * len(q))
    vanishing = _left_null_space(speeds)
    robot, found = model.robot, {}
    for row, pivot in _reduced(vanishing, closure.solved, len(speeds)):
        text = _relation_text(robot, row, pivot, u)
        if text is not None:
            found[robot.free[pivot].name] = parse(text)
    if not found:
        return robot
    return dataclasses.replace(robot, relations={**robot.relations, **found})


def _left_null_space(matrix: np.ndarray) -> np.ndarray:
    left, singular, _ = np.linalg.svd(matrix, full_matrices=True)
    rank = int(np.sum(singular > _TOLERANCE * singular[0]))
    return left[:, rank:].T


def _reduced(rows: np.ndarray, solved: Sequence[int], count: int) -> list[tuple[np.ndarray, int]]:
    """Reduced rows with their pivots: late variables follow early ones, never the actuated."""
    rows = rows.copy()
    pivots: list[int] = []
    for column in sorted(solved, reverse=True):
        done = len(pivots)
        if done == len(rows):
            break
        best = done + int(np.argmax(np.abs(rows[done:, column])))
        if abs(rows[best, column]) < 1e-6:
            continue
        rows[[done, best]] = rows[[best, done]]
        rows[done] /= rows[done, column]
        for other in range(len(rows)):
            if other != done:
                rows[other] -= rows[other, column] * rows[done]
        pivots.append(column)
    return [(rows[i], pivot) for i, pivot in enumerate(pivots)]


def _relation_text(robot: Robot, row: np.ndarray, pivot: int, u: np.ndarray) -> str | None:
    """The relation as an expression, None where it is not one of simple numbers."""
    free = robot.free
    terms, rest = [], u[:, pivot].copy()
    for k, value in enumerate(row):
        if k == pivot or abs(value) < _TOLERANCE:
            continue
        factor = Fraction(-value).limit_denominator(_LARGEST_DENOMINATOR)
        if abs(float(factor) + value) > _TOLERANCE or free[k].angular != free[pivot].angular:
            return None
        terms.append((factor, free[k].variable))
        rest -= float(factor) * u[:, k]
    twelfths = float(np.mean(rest)) / (math.pi / 12)
    if np.ptp(rest) > _SAME or abs(twelfths - round(twelfths)) > _SAME:
        return None
    if round(twelfths) and not free[pivot].angular:
        return None  # a length that is not 0 has no exact value here
    return _sum_text([*terms, (Fraction(round(twelfths), 12), "pi")])


def _sum_text(terms: Sequence[tuple[Fraction, str]]) -> str:
    """`-q2 + q7 + pi/2`."""
    text = ""
    for factor, name in terms:
        size = abs(factor)
        if size:
            over = f"/{size.denominator}" if size.denominator > 1 else ""
            times = f"{size.numerator}*" if size.numerator > 1 else ""
            sign = ("-" if factor < 0 else "") if not text else (" - " if factor < 0 else " + ")
            text += f"{sign}{times}{name}{over}"
    return text or "0"
