"""Linear relations between joints that loops imply, as a parallelogram does.

A variable that the loops tie to others by constant rational coefficients (q7 = q3, q5 = -q2 -
pi/2) is better stated than solved for: the model gets simpler, its C faster and its grouping exact.
Found as combinations of speeds that vanish at many closed postures over the reachable range; their
constants as combinations of the robot's symbols; used only where they are proven
(`modeler.symbolic.relation_proof`): in letters, or at the given values where only these make the
loops close (two bars of the same length by two symbols).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np

from modeler.core.expression import Expression, parse
from modeler.robot import Robot
from modeler.symbolic.closed_states import closed_motion, closed_walk, closing_of
from modeler.symbolic.model import SymbolicModel
from modeler.symbolic.relation_constants import Constants, Term
from modeler.symbolic.relation_proof import Proposal, Prover, largest_proven

_POSTURES = 16
_SEED = 31
_TOLERANCE = 1e-9
_LARGEST_DENOMINATOR = 24
_SAME = 1e-7


@dataclass(frozen=True)
class Implied:
    """Relations that the loops of a robot imply.

    Attributes:
        relations: joint -> its variable, proven.
        special: joints among them whose relations hold at the given lengths and angles only.
        unproven: joints that seemed to follow others by a relation that was not proven; not used.
    """

    relations: Mapping[str, Expression] = field(default_factory=dict)
    special: tuple[str, ...] = ()
    unproven: tuple[str, ...] = ()


def implied_relations(model: SymbolicModel) -> Implied:
    """The relations that the loops of a robot imply."""
    closure, robot = model.closure, model.robot
    assert closure is not None
    names = [joint.name for joint in robot.free]
    seen, proposals = [], []
    values = model.geometry.values
    derived = {n: x for n, x in robot.symbol_values().items() if n not in values}
    constants = Constants(closing_of(model), np.array(closure.home), derived)
    for row, pivot in _vanishing_rows(model):
        seen.append(names[pivot])
        terms = _terms(robot, row, pivot, constants)
        if terms is not None:
            proposals.append(Proposal(pivot, parse(_sum_text(terms))))
    if not seen:
        return Implied()
    prover = Prover(closure, model.graph, robot, values)
    proven = general = largest_proven(prover, proposals, letters=True)
    if len(general) < len(proposals):
        at_values = largest_proven(prover, proposals, letters=False)
        proven = at_values if len(at_values) > len(general) else general
    found = {names[relation.pivot]: relation.expression for relation in proven}
    special = tuple(names[r.pivot] for r in proven if r not in general)
    return Implied(found, special, tuple(name for name in seen if name not in found))


def _vanishing_rows(model: SymbolicModel) -> list[tuple[np.ndarray, int]]:
    """Combinations of speeds that vanish, each with the variable that it is solved for."""
    closure = model.closure
    assert closure is not None
    u = closed_walk(model, _POSTURES, np.random.default_rng(_SEED)).postures
    G = closed_motion(model, u, np.zeros((len(u), len(closure.given)))).coupling
    speeds = np.concatenate(list(G), axis=1)  # (len(u), postures * len(q))
    rows = _reduced(_left_null_space(speeds), closure.solved)
    home = np.array(closure.home)
    return [(row, pivot) for row, pivot in rows if np.max(np.abs((u - home) @ row)) < _SAME]


def _left_null_space(matrix: np.ndarray) -> np.ndarray:
    left, singular, _ = np.linalg.svd(matrix, full_matrices=True)
    rank = int(np.sum(singular > _TOLERANCE * singular[0]))
    return left[:, rank:].T


def _reduced(rows: np.ndarray, solved: Sequence[int]) -> list[tuple[np.ndarray, int]]:
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


def _terms(robot: Robot, row: np.ndarray, pivot: int, constants: Constants) -> list[Term] | None:
    """The right side of the relation, None where it is not one of simple numbers."""
    free = robot.free
    terms: list[Term] = []
    exact = np.zeros(len(row))
    exact[pivot] = 1.0
    for k, value in enumerate(row):
        if k == pivot or abs(value) < _TOLERANCE:
            continue
        factor = Fraction(-value).limit_denominator(_LARGEST_DENOMINATOR)
        if abs(float(factor) + value) > _TOLERANCE or free[k].angular != free[pivot].angular:
            return None
        terms.append((factor, free[k].variable))
        exact[k] = -float(factor)
    constant = constants.terms(exact, free[pivot].angular)
    return None if constant is None else [*terms, *constant]


def _sum_text(terms: Sequence[Term]) -> str:
    """`-q2 + q7 + pi/2`; a term without name is a number."""
    text = ""
    for factor, name in terms:
        size = abs(factor)
        if size:
            over = f"/{size.denominator}" if size.denominator > 1 else ""
            times = f"{size.numerator}*" if size.numerator > 1 and name else ""
            sign = ("-" if factor < 0 else "") if not text else (" - " if factor < 0 else " + ")
            text += f"{sign}{times}{name}{over}" if name else f"{sign}{size.numerator}{over}"
    return text or "0"
