"""From a robot to its symbolic model; constant ratios between joints that its loops imply.

u_p = sum c_k u_k + constant. How the constant depends on a symbol is seen by closing the loops anew
with a slightly different value of it: the derivative is a rational number, of a length also a
rational multiple of the cosine or sine of an angle. What is left is a multiple of pi/12, a short
decimal number of the table, or both. This only proposes; `modeler.derivation.derive` proves.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from itertools import combinations
from typing import Any

import numpy as np

from modeler.core.expression import Expression, get_precise_context, parse_expression
from modeler.derivation import precise
from modeler.derivation.assembly_modes import _build_model, resolve_home
from modeler.derivation.closure import Closure
from modeler.derivation.model import SymbolicModel
from modeler.derivation.precise import Number, convert_to_precise
from modeler.derivation.thresholds import THRESHOLDS
from modeler.derivation.walks import compute_closed_motion, draw_closed_walk
from modeler.robot import Robot

Term = tuple[Fraction, str]
"""factor * text."""

_SHARES = [Fraction(sign * n, d) for n, d in ((1, 1), (2, 1), (1, 2)) for sign in (1, -1)]


class RelationConstants:
    """Constants of relations of one robot at its home."""

    def __init__(self, closure: Closure, derived: Mapping[str, float]) -> None:
        """Constants of loops at home; `derived` symbols are given by expressions of others."""
        self.loops, self.home, self.derived = closure, np.array(closure.home), derived

    def find_terms(self, coefficients: np.ndarray, angular: bool) -> list[Term] | None:
        """Returns the constant of a relation, coefficients . home, as a sum of terms, or None.

        Args:
            coefficients: by variable: 1 for the one that follows, -c_k for the others.
            angular: True for an angle, False for a travel.
        """
        value = float(coefficients @ self.home)
        terms = list(self._find_symbol_terms(coefficients, angular))
        left = value - sum(float(c) * self._evaluate_text(text) for c, text in terms)
        rest = _find_pi_multiple(left, angular)
        if rest is not None:
            return [*terms, *rest]
        for name, size in self.derived.items():  # no combination of the others: w = sqrt(v)
            for share in _SHARES:
                rest = _find_pi_multiple(value - float(share) * size, angular)
                if rest is not None:
                    return [(share, name), *rest]
        rest = _find_decimal(left, angular)
        return None if rest is None else [*terms, *rest]

    def _find_symbol_terms(self, coefficients: np.ndarray, angular: bool) -> Iterator[Term]:
        """The symbols on which the constant depends."""
        for name, moved in self._perturbed_homes.items():
            change = float(coefficients @ (moved - self.home)) / THRESHOLDS.perturbation
            for factor, size in self._enumerate_factors(name, angular):
                if abs(size) > THRESHOLDS.perturbation:
                    limit = THRESHOLDS.max_constant_denominator
                    share = Fraction(change / size).limit_denominator(limit)
                    if abs(float(share) * size - change) < THRESHOLDS.slope_tolerance:
                        if share:
                            yield share, f"{name}{factor}"
                        break

    def _enumerate_factors(self, name: str, angular: bool) -> Iterator[tuple[str, float]]:
        """What a symbol may be multiplied by: text and value."""
        yield "", 1.0
        if not angular:
            for other, value in self.loops.values.items():
                if other not in (name, "g"):
                    yield f"*cos({other})", math.cos(value)
                    yield f"*sin({other})", math.sin(value)

    def _evaluate_text(self, text: str) -> float:
        name, _, factor = text.partition("*")
        value = float(self.loops.values[name])
        if not factor:
            return value
        function, other = factor[:3], factor[4:-1]
        return value * getattr(math, function)(self.loops.values[other])

    @cached_property
    def _perturbed_homes(self) -> Mapping[str, np.ndarray]:
        """By symbol, home closed anew with another value of it; where it does not, left out."""
        names = list(self.loops.values)
        with np.errstate(all="ignore"):  # the root of a length that became negative
            moved = self._close_perturbed(names)
        far = np.abs(moved - self.home) / self.loops.scale
        near = np.max(far, axis=1, initial=0.0) < THRESHOLDS.max_perturbed_move
        return {name: u for name, u, good in zip(names, moved, near, strict=True) if good}

    def _close_perturbed(self, names: Sequence[str]) -> np.ndarray:
        """(names, unknowns): Newton from home, one sample for each symbol."""
        loops, count = self.loops, len(names)
        values: dict[str, Any] = {n: np.full(count, self.loops.values[n]) for n in names}
        for i, name in enumerate(names):
            values[name][i] += THRESHOLDS.perturbation
        moved = replace(loops, values=values)
        u = np.tile(self.home, (count, 1))
        for _ in range(THRESHOLDS.perturbed_iterations):
            u[:, list(loops.solved)] -= moved.solve_passive(u, moved.compute_residuals(u))
        return u


def _find_pi_multiple(value: float, angular: bool) -> list[Term] | None:
    """A multiple of pi/12 for an angle, nothing for a travel."""
    twelfths = round(value / (math.pi / 12)) if angular else 0
    if abs(value - twelfths * math.pi / 12) > THRESHOLDS.constant_tolerance:
        return None
    return [(Fraction(twelfths, 12), "pi")]


def _find_decimal(value: float, angular: bool) -> list[Term] | None:
    """A short decimal number, with a multiple of pi/12 for an angle."""
    most = THRESHOLDS.max_pi_twelfths if angular else 0
    for size in sorted(range(-most, most + 1), key=abs):
        rest = value - size * math.pi / 12
        short = round(rest, THRESHOLDS.constant_decimals)
        if abs(rest - short) < THRESHOLDS.decimal_tolerance:
            return [(Fraction(size, 12), "pi"), (Fraction(repr(short)), "")]
    return None


# Whether loops imply linear relations: a proof, in letters or at the given values.
#
# Let f(u) = 0 be r independent closure equations with a regular home u0, so that the closed
# postures near u0 are a manifold V of dimension n - r. Let L be the postures that fulfil k linear
# relations, u0 among them. If the functions f restricted to L span a space of dimension r - k only,
# then r - k of them cut out of L (dimension n - k) a set of dimension n - r or more through u0, on
# which the others vanish too: it lies in V and has the dimension of V, so the two coincide near u0,
# and, both being analytic, on the whole branch of closed postures that is connected with u0. So
# every relation holds there. (A parallelogram: both equations vanish identically, r - k = 0.)
#
# The dimension of the span is a rank of exact functions: values with 40 digits at random postures
# of L, and at random lengths and angles where the relations are to hold in letters. What is of
# lower rank there to 25 digits is so identically.


@dataclass(frozen=True)
class CandidateRelation:
    """A relation to be proven: the variable `pivot` of u equals `expression` of the others."""

    pivot: int
    expression: Expression


class Prover:
    """Returns which relations the loops of a robot imply on the branch of home."""

    def __init__(self, closure: Closure, robot: Robot) -> None:
        self.closure, self.robot = closure, robot

    def can_prove(self, relations: Sequence[CandidateRelation], letters: bool) -> bool:
        """Returns True if the loops imply all these relations together.

        Args:
            relations: that home fulfils.
            letters: True for all lengths and angles, False for the given ones only.
        """
        rng = np.random.default_rng(THRESHOLDS.implied_seed)
        geometry = self._draw_symbols(rng, letters)
        left = len(self.closure.equations) - len(relations)
        rows = []
        for _ in range(left + THRESHOLDS.spare_rows):
            at = {**geometry, **self._draw_posture(relations, rng, geometry)}
            rows.append(precise.evaluate_precisely(self.closure.graph, self.closure.equations, at))
        return _compute_rank(rows) <= left

    def _draw_symbols(self, rng: np.random.Generator, letters: bool) -> dict[str, Number]:
        """Numbers for all symbols: as given, or random near that."""
        known: dict[str, Number] = {}
        for name, expression in self.robot.symbols.items():
            if name in self.closure.values:
                most = THRESHOLDS.symbol_change
                change = float(rng.uniform(-most, most)) if letters else 0.0
                value = convert_to_precise(self.closure.values[name])
                known[name] = value * (1 + convert_to_precise(change))
            else:
                known[name] = _fold_precise(expression, known)
        return known

    def _draw_posture(
        self,
        relations: Sequence[CandidateRelation],
        rng: np.random.Generator,
        geometry: Mapping[str, Number],
    ) -> dict[str, Number]:
        """Random values of `q[k]` that fulfil the relations."""
        u = [
            convert_to_precise(
                float(at + rng.uniform(-1.0, 1.0) * (self.closure.size if length else 1.0))
            )
            for at, length in zip(self.closure.home, self.closure.is_travel, strict=True)
        ]
        names = [joint.variable for joint in self.robot.free_joints]
        known = {**geometry, **dict(zip(names, u, strict=True))}
        for relation in relations:
            u[relation.pivot] = _fold_precise(relation.expression, known)
        return {f"q[{k}]": value for k, value in enumerate(u)}


def _fold_precise(expression: Expression, known: Mapping[str, Number]) -> Number:
    functions, pi = precise.get_precise_functions(), +get_precise_context().pi
    return expression.fold(known, functions, pi, precise.convert_fraction, functions["pow"])


def _compute_rank(rows: Sequence[Sequence[Number]]) -> int:
    """Rank of a matrix of numbers of 40 digits, each column counted relative to its largest."""
    mp = get_precise_context()
    matrix = [list(row) for row in rows]
    nothing = mp.mpf(10) ** -THRESHOLDS.proof_digits
    rank = 0
    for column in range(len(matrix[0])):
        below = matrix[rank:]
        if not below:
            break
        best = max(range(len(below)), key=lambda i: abs(below[i][column]))
        if abs(below[best][column]) < nothing:
            continue
        matrix[rank], matrix[rank + best] = matrix[rank + best], matrix[rank]
        pivot = matrix[rank]
        for i in range(rank + 1, len(matrix)):
            factor = matrix[i][column] / pivot[column]
            matrix[i] = [x - factor * y for x, y in zip(matrix[i], pivot, strict=True)]
        rank += 1
    return rank


def find_largest_proven(
    prover: Prover, relations: Sequence[CandidateRelation], letters: bool
) -> tuple[CandidateRelation, ...]:
    """Returns the largest proven set of the relations; sets are tried from the largest down."""
    tries = 0
    for size in range(len(relations), 0, -1):
        for chosen in combinations(relations, size):
            if prover.can_prove(chosen, letters):
                return chosen
            tries += 1
            if tries == THRESHOLDS.max_proof_tries:
                return ()
    return ()


# Linear relations between joints that loops imply, as a parallelogram does.
#
# A variable that the loops tie to others by constant rational coefficients (q7 = q3, q5 = -q2 -
# pi/2) is better stated than solved for: the model gets simpler, its C faster and its grouping
# exact. Found as combinations of speeds that vanish at many closed postures over the reachable
# range; their constants as combinations of the robot's symbols; used only where they are proven
# (`modeler.derivation.derive`): in letters, or at the given values where only these make the
# loops close (two bars of the same length by two symbols).


@dataclass(frozen=True)
class ImpliedRelations:
    """Relations that the loops of a robot imply.

    Attributes:
        relations: joint -> its variable, proven.
        special: joints among them whose relations hold at the given lengths and angles only.
        unproven: joints that seemed to follow others by a relation that was not proven; not used.
    """

    relations: Mapping[str, Expression] = field(default_factory=dict)
    special: tuple[str, ...] = ()
    unproven: tuple[str, ...] = ()


def find_implied_relations(model: SymbolicModel) -> ImpliedRelations:
    """Returns the relations that the loops of a robot imply."""
    closure, robot = model.closure, model.robot
    assert closure is not None
    names = [joint.name for joint in robot.free_joints]
    seen, proposals = [], []
    derived = {n: x for n, x in robot.evaluate_symbols().items() if n not in closure.values}
    constants = RelationConstants(closure, derived)
    for row, pivot in _find_vanishing_rows(model):
        seen.append(names[pivot])
        terms = _build_terms(robot, row, pivot, constants)
        if terms is not None:
            proposals.append(CandidateRelation(pivot, parse_expression(_format_sum(terms))))
    if not seen:
        return ImpliedRelations()
    prover = Prover(closure, robot)
    proven = general = find_largest_proven(prover, proposals, letters=True)
    if len(general) < len(proposals):
        at_values = find_largest_proven(prover, proposals, letters=False)
        proven = at_values if len(at_values) > len(general) else general
    proven_relations = {names[relation.pivot]: relation.expression for relation in proven}
    special = tuple(names[r.pivot] for r in proven if r not in general)
    unproven = tuple(name for name in seen if name not in proven_relations)
    return ImpliedRelations(proven_relations, special, unproven)


def _find_vanishing_rows(model: SymbolicModel) -> list[tuple[np.ndarray, int]]:
    """Combinations of speeds that vanish, each with the variable that it is solved for."""
    closure = model.closure
    assert closure is not None
    u = draw_closed_walk(
        model, THRESHOLDS.relation_postures, np.random.default_rng(THRESHOLDS.relation_seed)
    ).postures
    G = compute_closed_motion(model, u, np.zeros((len(u), len(closure.actuated)))).coupling
    speeds = np.concatenate(list(G), axis=1)  # (len(u), postures * len(q))
    left, singular, _ = np.linalg.svd(speeds, full_matrices=True)
    rank = int(np.sum(singular > THRESHOLDS.relation_rank * singular[0]))
    rows = _reduce_rows(left[:, rank:].T, closure.solved)
    home = np.array(closure.home)
    errors = (np.max(np.abs((u - home) @ row)) for row, _ in rows)
    return [at for at, e in zip(rows, errors, strict=True) if e < THRESHOLDS.relation_residual]


def _reduce_rows(rows: np.ndarray, solved: Sequence[int]) -> list[tuple[np.ndarray, int]]:
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


def _build_terms(
    robot: Robot, row: np.ndarray, pivot: int, constants: RelationConstants
) -> list[Term] | None:
    """The right side of the relation, None where it is not one of simple numbers."""
    free = robot.free_joints
    terms: list[Term] = []
    exact = np.zeros(len(row))
    exact[pivot] = 1.0
    for k, value in enumerate(row):
        if k == pivot or abs(value) < THRESHOLDS.relation_rank:
            continue
        factor = Fraction(-value).limit_denominator(THRESHOLDS.max_ratio_denominator)
        differs = free[k].is_revolute != free[pivot].is_revolute
        if differs or abs(float(factor) + value) > THRESHOLDS.relation_rank:
            return None
        terms.append((factor, free[k].variable))
        exact[k] = -float(factor)
    constant = constants.find_terms(exact, free[pivot].is_revolute)
    return None if constant is None else [*terms, *constant]


def _format_sum(terms: Sequence[Term]) -> str:
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


# From a robot to its symbolic model.


# [home]: taken as stated where it is good, else found; refused where it is singular.
#
# Singular postures: which joints could move there although the actuated ones are locked.


def derive_model(robot: Robot) -> SymbolicModel:
    """Returns the symbolic model of a robot.

    The robot of the model has a [home] that is found where it is missing or poor, and states the
    relations that its loops imply.

    Raises:
        DerivationError: an entry of the table has no exact value.
        LoopError: the loops leave more or less free than is actuated, are singular at home, or
            cannot close.
    """
    model = _build_model(robot)
    home = resolve_home(model)
    if home.robot is not robot:
        robot = home.robot
        model = _build_model(robot)
    if model.closure is None:
        return model
    implied = find_implied_relations(model)
    if implied.relations:
        model = _build_model(replace(robot, relations={**robot.relations, **implied.relations}))
    return replace(model, special=implied.special, unproven=implied.unproven)
