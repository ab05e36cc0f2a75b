"""Rank of the torque regressor in floating point and in ball arithmetic, at random states."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, partial
from typing import Any

import numpy as np
import sympy

from modeler.derivation import precise
from modeler.derivation.closure import select_spanning_rows
from modeler.derivation.model import SymbolicModel
from modeler.derivation.precise import Ball, build_ball, build_ball_function, load_flint
from modeler.derivation.relations import (
    BallRank,
    BaseParameter,
    ExactState,
    SampledRank,
    Term,
    build_named_parameters,
    sort_by_priority,
)
from modeler.derivation.thresholds import THRESHOLDS
from modeler.derivation.walks import Walk, compute_closed_motion, draw_closed_walk

States = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Positions, speeds and accelerations of the free variables, each (samples, len(u))."""


@dataclass(frozen=True)
class Sample:
    """The regressor at random states, ready for its rank.

    Attributes:
        matrix: (rows, columns); rows of a posture of a robot with loops are weighed by the inverse
            of their own rounding.
        rounding: how far the matrix is changed by closing the loops with rounding; None without.
        walk: the closed postures; None without loops.
    """

    matrix: np.ndarray
    rounding: np.ndarray | None = None
    walk: Walk | None = None


@dataclass(frozen=True)
class NumericRank:
    """Rank with what it rests on.

    Attributes:
        rank: number of singular values above tolerance * largest.
        gap: (last kept, first dropped) singular value of the matrix with columns of unit length.
        tolerance: relative.
        scale: how it was scaled.
    """

    rank: int
    gap: tuple[float, float]
    tolerance: float
    scale: str


def draw_random_states(model: SymbolicModel, samples: int, rng: np.random.Generator) -> States:
    """Returns positions over a turn (prismatic: +-1 m), speeds and accelerations of order 1.

    With loops: closed postures over the reachable range, not near singularities, and motions that
    the loops allow.
    """
    if model.closure is None:
        n = model.geometry.coordinate_count
        angular = np.array([joint.is_revolute for joint in model.robot.free_joints])
        q = rng.uniform(-1.0, 1.0, (samples, n)) * np.where(angular, np.pi, 1.0)
        return q, rng.normal(size=(samples, n)), rng.normal(size=(samples, n))
    u = draw_closed_walk(model, samples, rng, THRESHOLDS.min_distance_share).postures
    qd, qdd = rng.normal(size=(2, len(u), len(model.closure.actuated)))
    return expand_states(model, u, qd, qdd)


def expand_states(model: SymbolicModel, u: np.ndarray, qd: np.ndarray, qdd: np.ndarray) -> States:
    """Returns the motion of all free variables at closed postures from that of the coordinates."""
    motion = compute_closed_motion(model, u, qd)
    ud = np.einsum("nij,nj->ni", motion.coupling, qd)
    return u, ud, np.einsum("nij,nj->ni", motion.coupling, qdd) + motion.drift


def draw_sample(model: SymbolicModel, samples: int, seed: int) -> Sample:
    """Returns the standard regressor at random states, and its rounding.

    A closed posture is closed up to rounding r in the equations, hence wrong by J_s^-1 r in the
    passive joints. What such an error changes in the regressor is its rounding; it grows towards
    singularities, where regressor and rounding are both large. Rows are divided by the rounding of
    their posture, so that none drowns what the others show.
    """
    rng = np.random.default_rng(seed)
    if model.closure is None:
        phi = evaluate_regressor(model, draw_random_states(model, samples, rng))
        return Sample(phi.reshape(-1, phi.shape[2]))
    walk = draw_closed_walk(model, samples, rng)
    qd, qdd = rng.normal(size=(2, len(walk.postures), len(model.closure.actuated)))
    # Closed as another machine might have closed them: each equation wrong by rounding.
    closure, eps = model.closure, float(np.finfo(float).eps)
    error = eps * closure.size
    wrong = rng.choice([-error, error], (len(walk.postures), len(closure.equations)))
    rounded = walk.postures.copy()
    rounded[:, list(closure.solved)] += closure.solve_passive(walk.postures, wrong)
    postures = (walk.postures, rounded)
    phi, other = (evaluate_regressor(model, expand_states(model, u, qd, qdd)) for u in postures)
    lengths = np.linalg.norm(phi.reshape(-1, phi.shape[2]), axis=0)
    scale = np.where(lengths > THRESHOLDS.zero_column * lengths.max(initial=0.0), lengths, np.inf)
    error = np.linalg.norm((other - phi) / scale, axis=(1, 2))
    error = np.maximum(error, eps * np.linalg.norm(phi / scale, axis=(1, 2)))
    weight = (np.median(error) / error)[:, None, None]
    both = [(part * weight).reshape(-1, phi.shape[2]) for part in (phi, other - phi)]
    return Sample(both[0], both[1], walk)


def draw_signal_values(model: SymbolicModel, samples: int) -> np.ndarray:
    """Returns (signals, samples) random values of signals, positive and of order 1."""
    shape = (len(model.signals), samples)
    return np.random.default_rng(samples).uniform(0.1, 1.0, shape)


def evaluate_regressor(model: SymbolicModel, states: States) -> np.ndarray:
    """Returns (samples, coordinates, columns): the standard regressor at the nominal geometry."""
    q, qd, qdd = states
    values = dict(model.geometry.values)
    kinds = (("q", q), ("qd", qd), ("qdd", qdd))
    inputs = {f"{kind}[{i}]": x[:, i] for kind, x in kinds for i in range(q.shape[1])}
    inputs |= {f"s[{k}]": values for k, values in enumerate(draw_signal_values(model, len(q)))}
    entries = model.regressor
    phi = np.zeros((*q.shape, len(model.columns)))
    entry_values = model.graph.evaluate_outputs(list(entries.values()), {**values, **inputs})
    for (joint, column), value in zip(entries, entry_values, strict=True):
        phi[:, joint, column] = value
    if model.closure is None:
        return phi
    none = np.zeros((len(q), len(model.closure.actuated)))
    return np.einsum("nij,nic->njc", compute_closed_motion(model, q, none).coupling, phi)


def compute_numeric_rank(sample: Sample, columns: Sequence[int]) -> NumericRank:
    """Returns the rank of the sampled regressor in the given columns.

    Without loops singular values above `rank_tolerance` of the largest count. With loops
    those count that are ten times as large as the rounding of the closure and of the decomposition:
    a matrix of lower rank is as far away as the last singular value (Weyl).
    """
    W = sample.matrix[:, list(columns)]
    lengths = np.linalg.norm(W, axis=0)
    having = lengths > THRESHOLDS.zero_column * lengths.max(initial=0.0)
    W, lengths = W[:, having], lengths[having]
    if W.shape[1] == 0:
        return NumericRank(0, (0.0, 0.0), THRESHOLDS.rank_tolerance, "no column has an effect")
    singular = np.linalg.svd(W / lengths, compute_uv=False)
    tolerance = THRESHOLDS.rank_tolerance
    if sample.rounding is not None:
        error = float(np.linalg.norm(sample.rounding[:, list(columns)][:, having] / lengths))
        rounding = max(W.shape) * float(np.finfo(float).eps)
        tolerance = THRESHOLDS.rounding_margin * max(error / float(singular[0]), rounding)
    rank = int(np.sum(singular > tolerance * singular[0]))
    dropped = float(singular[rank]) if rank < len(singular) else 0.0
    weighed = ", rows weighed by their rounding" if sample.rounding is not None else ""
    sides = f"{W.shape[0]} rows, {W.shape[1]} columns (the others are 0)"
    gap = (float(singular[rank - 1]), dropped)
    return NumericRank(rank, gap, tolerance, f"{sides}, scaled to length 1{weighed}")


# Base parameters in floating point, where exact symbols cannot be had.
#
# For robots whose constants obey a relation that the exact field does not know (an angle of pi/3
# and a gravity with sqrt(3), say), or whose exact coefficients would fill pages. The coefficients
# are then numbers with an error bound, never symbols that might be wrong.


Enclosed = Callable[[Sequence[int], Sequence[int]], list[list[Any]] | None]
"""From kept and dropped columns to the (kept, dropped) factors as balls; None without proof."""


def derive_numeric_grouping(
    model: SymbolicModel, sample: Sample, numeric: NumericRank, enclosed: Enclosed
) -> tuple[tuple[BaseParameter, ...], tuple[str, ...], float]:
    """Groups columns of the sampled regressor in floating point, first come first kept.

    A column is dependent if the columns before it leave less of it than lies in the middle of the
    gap of the singular values: what is left of an independent one is no less than the last kept
    value, of a dependent one it is rounding.

    Args:
        model: of the robot.
        sample: its regressor.
        numeric: the rank of that.
        enclosed: the factors with all digits.

    Returns:
        Base parameters, parameters without effect, and the error bound of the coefficients.

    Raises:
        DerivationError: a priority pattern matches nothing.
    """
    W = sample.matrix
    last, first = numeric.gap
    tolerance = math.sqrt(last * max(first, float(np.finfo(float).eps)))
    lengths = np.linalg.norm(W, axis=0)
    nothing = THRESHOLDS.zero_column * lengths.max(initial=0.0)
    absent = {i for i, length in enumerate(lengths) if length <= nothing}
    order = sort_by_priority(model.names, model.robot.priority_parameters)
    order = [i for i in order if i not in absent]
    kept_columns, relations, bound = _select_first_columns(W, lengths, order, tolerance)
    balls = enclosed(kept_columns, list(relations))
    if balls is not None:
        for k, column in enumerate(relations):
            factors = {b: row[k] for b, row in zip(kept_columns, balls, strict=True)}
            nonzero = {b: x for b, x in factors.items() if not x.contains(0)}
            relations[column] = {b: _convert_ball(x) for b, x in nonzero.items()}
    terms = {b: [Term(sympy.Integer(1), model.names[b])] for b in sorted(kept_columns)}
    for column in sorted(relations):
        for b, factor in relations[column].items():
            terms[b].append(Term(factor, model.names[column]))
    parameters = build_named_parameters(model.columns, terms, model.robot.has_binary_fractions)
    return parameters, tuple(model.names[i] for i in sorted(absent)), bound


def _select_first_columns(
    W: np.ndarray, lengths: np.ndarray, order: Sequence[int], tolerance: float
) -> tuple[list[int], dict[int, dict[int, sympy.Expr]], float]:
    """Columns kept, {dropped column: {kept column: factor}}, and the error of the factors."""
    kept_columns: list[int] = []
    Q = np.zeros((W.shape[0], 0))
    relations: dict[int, dict[int, sympy.Expr]] = {}
    worst = 0.0
    for column in order:
        unit = W[:, column] / lengths[column]
        rest = unit - Q @ (Q.T @ unit)
        rest -= Q @ (Q.T @ rest)  # twice is enough (Kahan, Parlett)
        if np.linalg.norm(rest) > tolerance:
            Q = np.column_stack([Q, rest / np.linalg.norm(rest)])
            kept_columns.append(column)
            continue
        factors, *_ = np.linalg.lstsq(W[:, kept_columns] / lengths[kept_columns], unit, rcond=None)
        left = unit - (W[:, kept_columns] / lengths[kept_columns]) @ factors
        worst = max(worst, float(np.linalg.norm(left)))
        scaled = factors * lengths[column] / lengths[kept_columns]
        clear = (np.abs(factors) > THRESHOLDS.zero_factor).tolist()
        pairs = zip(kept_columns, scaled, clear, strict=True)
        relations[column] = {b: _convert_number(float(s)) for b, s, is_clear in pairs if is_clear}
    return kept_columns, relations, worst


def _convert_number(value: float) -> sympy.Expr:
    if abs(value - round(value)) < THRESHOLDS.zero_factor and round(value):
        return sympy.Integer(round(value))
    # Its decimals are its value: what is printed is what is computed with.
    return sympy.Float(repr(value), THRESHOLDS.double_digits)


def _convert_ball(factor: Any) -> sympy.Expr:
    """A factor in a ball: the whole number that it holds, else its double."""
    near = round(float(factor.mid()))
    if factor.contains(near):
        return sympy.Integer(near)
    return sympy.Float(repr(float(factor.mid())), THRESHOLDS.double_digits)


# Base torque against standard torque at random states.


def compare_torques(
    model: SymbolicModel, parameters: tuple[BaseParameter, ...], seed: int
) -> float:
    """Returns max |tau_base - tau_standard| / max |tau_standard| at random states."""
    rng = np.random.default_rng(seed)
    phi = evaluate_regressor(model, draw_random_states(model, 50, rng))
    chi = rng.normal(size=len(model.columns))
    beta = build_grouping_matrix(model, parameters) @ chi
    base_columns = [parameter.column for parameter in parameters]
    standard = phi @ chi
    largest = float(np.max(np.abs(standard)))
    difference = float(np.max(np.abs(phi[:, :, base_columns] @ beta - standard)))
    return difference / largest if largest else 0.0


def build_grouping_matrix(model: SymbolicModel, parameters: Sequence[BaseParameter]) -> np.ndarray:
    """Returns (rank, columns): beta = K chi at the nominal geometry."""
    place = {name: i for i, name in enumerate(model.names)}
    known = cache(partial(evaluate_coefficient, values=model.geometry.values))
    K = np.zeros((len(parameters), len(model.columns)))
    for i, parameter in enumerate(parameters):
        for term in parameter.terms:
            K[i, place[term.parameter]] = known(term.coefficient)
    return K


def evaluate_coefficient(coefficient: sympy.Expr, values: Mapping[str, float]) -> float:
    """Returns a coefficient at the nominal geometry."""
    at = {s: sympy.Float(values[s.name]) for s in coefficient.free_symbols}
    return float(coefficient.xreplace(at))


# Closed states in ball arithmetic: postures that exist for certain, and motions of the loops.
#
# The actuated joints of a posture are exact numbers. That the passive joints x can close the loops
# f(x) = 0 there is Krawczyk's theorem: with x0 near the solution, any matrix Y and a box X around
# x0,
#
#     K = x0 - Y f(x0) + (1 - Y f'(X)) (X - x0),
#
# if K lies in the interior of X, there is one solution in X, and it lies in K (Krawczyk 1969;
# Neumaier 1990, 5.1). Y is the inverse of f'(x0) in floating point. Speeds and accelerations follow
# by solving the linear equations of `modeler.derivation.closure` in balls.


@dataclass(frozen=True)
class EnclosedState:
    """Balls of a state of the free variables u.

    Attributes:
        inputs: positions, speeds and accelerations by name, as `q[0]`, `qd[0]`, `qdd[0]`.
        coupling: G of ud = G qd, (len(u), len(q)).
    """

    inputs: Mapping[str, Ball]
    coupling: Sequence[Sequence[Ball]]


class EnclosureError(Exception):
    """No closed posture is proven near a posture; says why."""


class Enclosures:
    """States of a model in balls, at the precision of the caller."""

    def __init__(
        self,
        model: SymbolicModel,
        symbols: Mapping[str, Ball],
        independent: tuple[int, ...] | None = None,
    ) -> None:
        """For a model, with or without loops.

        Args:
            model: of the robot.
            symbols: balls of its symbols.
            independent: places in u of the variables that move the loops; None for the coordinates
                q.
        """
        self.model, self.closure = model, model.closure
        self.symbols = symbols
        self.bits = int(load_flint().ctx.prec)
        if self.closure is not None:
            if independent is not None:
                solved = tuple(k for k in range(len(self.closure.home)) if k not in independent)
                self.closure = replace(self.closure, actuated=independent, solved=solved)
            slopes = [entry for line in self.closure.jacobian for entry in line]
            closure = self.closure
            functions = (closure.equations, slopes, closure.drift, closure.alignments)
            self.equations, self.slopes, self.drift, self.alignments = (
                build_ball_function(model.graph, expressions, symbols) for expressions in functions
            )

    def enclose_state(self, u: np.ndarray, qd: np.ndarray, qdd: np.ndarray) -> EnclosedState:
        """Returns the motion of all free variables.

        Args:
            u: (len(u),) a posture closed in floating point; its actuated joints are exact.
            qd: (len(q),) speeds of the coordinates, exact.
            qdd: (len(q),) their accelerations, exact.

        Raises:
            NotEnclosed: there may be no closed posture at these u.
        """
        if self.closure is None:
            n = len(u)
            unit = [[build_ball(int(i == k)) for k in range(n)] for i in range(n)]
            q, v, a = (_convert_to_balls(x) for x in (u, qd, qdd))
            return EnclosedState(_collect_inputs(q=q, qd=v, qdd=a), unit)
        q = self.enclose_posture(u)
        return self._enclose_motion(q, _convert_to_balls(qd), _convert_to_balls(qdd))

    def enclose_posture(self, u: np.ndarray) -> list[Ball]:
        """Returns balls of the closed posture next to `u` with the same actuated joints.

        Raises:
            NotEnclosed: there may be none.
        """
        assert self.closure is not None
        solved = list(self.closure.solved)
        try:
            inner = self.closure.compute_jacobians(u[None])[0][:, solved]
            Y = _build_matrix(np.linalg.inv(inner).tolist())
        except np.linalg.LinAlgError:
            raise EnclosureError("the loops are singular at a posture") from None
        q = self._solve_midpoints(_convert_to_balls(u), Y)
        if not all(abs(q[k] - float(u[k])) < THRESHOLDS.max_enclosure_shift for k in solved):
            raise EnclosureError(
                f"the loops do not close within {THRESHOLDS.max_enclosure_shift:g} of a posture"
            )
        radius = build_ball(2.0 ** -(self.bits // 2))
        wide = _replace_entries(q, solved, [q[k] + load_flint().arb(0, radius) for k in solved])
        step = Y * _build_column(self.equations(_collect_inputs(q=q)))
        rest = _build_matrix(np.eye(len(solved)).tolist()) - Y * self._evaluate_slopes(wide, solved)
        turned = rest * _build_column([wide[k] - q[k] for k in solved])
        image = [q[k] - step[i, 0] + turned[i, 0] for i, k in enumerate(solved)]
        if not all(wide[k].contains_interior(x) for k, x in zip(solved, image, strict=True)):
            raise EnclosureError("the box of a posture is not mapped into itself")
        q = _replace_entries(q, solved, image)
        if not all(x > 0 for x in self.alignments(_collect_inputs(q=q))):
            raise EnclosureError("a loop may be closed with axes opposite")
        return q

    def _solve_midpoints(self, q: list[Ball], Y: Ball) -> list[Ball]:
        """Newton with the same slope all the way, on the midpoints."""
        assert self.closure is not None
        solved = list(self.closure.solved)
        enough = build_ball(2.0 ** -(self.bits * 3 // 4))
        for _ in range(THRESHOLDS.enclosure_iterations):
            step = (Y * _build_column(self.equations(_collect_inputs(q=q)))).mid()
            middles = [(q[k] - step[i, 0]).mid() for i, k in enumerate(solved)]
            q = _replace_entries(q, solved, middles)
            if all(abs(x) < enough for x in step.entries()):
                return q
        raise EnclosureError("the loops do not close at a posture")

    def _evaluate_slopes(self, q: Sequence[Ball], places: Sequence[int]) -> Ball:
        """The columns of the Jacobian that `places` names, at a box."""
        flat, n = self.slopes(_collect_inputs(q=q)), len(q)
        return _build_matrix([[flat[i + k] for k in places] for i in range(0, len(flat), n)])

    def _enclose_motion(self, q: list[Ball], qd: list[Ball], qdd: list[Ball]) -> EnclosedState:
        assert self.closure is not None
        actuated, solved = list(self.closure.actuated), list(self.closure.solved)
        try:
            inner = self._evaluate_slopes(q, solved)
            follow = -inner.solve(self._evaluate_slopes(q, actuated))
            G = [[build_ball(0)] * len(actuated) for _ in q]
            for place, k in enumerate(actuated):
                G[k][place] = build_ball(1)
            for place, k in enumerate(solved):
                G[k] = [follow[place, i] for i in range(len(actuated))]
            ud, udd = _multiply_vector(G, qd), _multiply_vector(G, qdd)
            drift = inner.solve(_build_column(self.drift(_collect_inputs(q=q, qd=ud))))
        except ZeroDivisionError:
            raise EnclosureError("the loops may be singular at a posture") from None
        for place, k in enumerate(solved):
            udd[k] = udd[k] - drift[place, 0]
        return EnclosedState(_collect_inputs(q=q, qd=ud, qdd=udd), G)


def _convert_to_balls(values: np.ndarray) -> list[Ball]:
    return [build_ball(float(value)) for value in values]


def _collect_inputs(**kinds: Sequence[Ball]) -> dict[str, Ball]:
    return {f"{kind}[{k}]": x for kind, values in kinds.items() for k, x in enumerate(values)}


def _replace_entries(q: Sequence[Ball], at: Sequence[int], values: Sequence[Ball]) -> list[Ball]:
    changed = list(q)
    for k, value in zip(at, values, strict=True):
        changed[k] = value
    return changed


def _build_matrix(rows: Sequence[Sequence[Ball]]) -> Ball:
    return load_flint().arb_mat(rows)


def _build_column(values: Sequence[Ball]) -> Ball:
    return load_flint().arb_mat([[value] for value in values])


def _multiply_vector(matrix: Sequence[Sequence[Ball]], vector: Sequence[Ball]) -> list[Ball]:
    rows = (zip(line, vector, strict=True) for line in matrix)
    return [sum((x * y for x, y in row), build_ball(0)) for row in rows]


# A lower bound of the rank of the torques, proven in ball arithmetic.
#
# At closed states in balls some rows of the torque regressor of the base columns make a square
# matrix; if it is regular for all numbers in its balls, these columns are independent. States are
# chosen in floating point and are written into the proof with few digits: whoever checks it needs
# nothing else.


def prove_rank(
    model: SymbolicModel, kept_columns: Sequence[int], sample: Sample, seed: int
) -> BallRank | SampledRank:
    """Proves in ball arithmetic that the columns are independent, or says why it cannot.

    Args:
        model: of the robot, at its given lengths and angles.
        kept_columns: numbers of columns.
        sample: whose closed postures are used.
        seed: of the states.
    """
    over = model.closure.others if model.closure else ()
    count = sum(not precise.is_surely_zero(equation, model.robot) for equation in over)
    if count:
        why = f"{count} closure equations seem to follow from the others, unproven"
        return SampledRank(len(kept_columns), seed, why)
    choice = _RowSelection(model, kept_columns, sample, seed)
    if len(choice.rows) < len(kept_columns):
        why = f"the states tried span {len(choice.rows)} of {len(kept_columns)} columns"
        return SampledRank(len(kept_columns), seed, why)
    for bits in THRESHOLDS.ball_bits:
        with load_flint().ctx.workprec(bits):
            try:
                matrix = choice.enclose_matrix(choice.kept_columns)
            except EnclosureError as error:
                why = str(error)
                continue
            if precise.is_proven_regular(matrix):
                states, rows = choice.collect_exact_states(), choice.locate_rows()
                return BallRank(len(kept_columns), bits, seed, states, rows)
            why = f"the balls of a minor of {len(kept_columns)} rows hold a singular matrix"
    return SampledRank(len(kept_columns), seed, f"{why} ({THRESHOLDS.ball_bits[-1]} bits)")


def enclose_factors(
    model: SymbolicModel,
    sample: Sample,
    seed: int,
    kept_columns: Sequence[int],
    dropped_columns: Sequence[int],
) -> list[list[Ball]] | None:
    """Returns (kept, dropped) factors of the dependent columns as balls.

    Args:
        model: of the robot, at its given lengths and angles.
        sample: whose closed postures are used.
        seed: of the states.
        kept_columns: numbers of independent columns.
        dropped_columns: numbers of columns that are sums of these.

    Returns:
        None where a posture is not proven to exist, or the states do not span the columns.
    """
    choice = _RowSelection(model, kept_columns, sample, seed)
    if len(choice.rows) < len(kept_columns) or not dropped_columns:
        return None
    with load_flint().ctx.workprec(THRESHOLDS.ball_bits[-1]):
        try:
            matrix = choice.enclose_matrix([*kept_columns, *dropped_columns])
            rows = load_flint().arb_mat(matrix).tolist()
            n = len(kept_columns)
            scaled, right = [row[:n] for row in rows], [row[n:] for row in rows]
            factors = load_flint().arb_mat(scaled).solve(load_flint().arb_mat(right)).tolist()
        except (EnclosureError, ZeroDivisionError):
            return None
        scale = [build_ball(float(x)) for x in choice.scale]
        return [[x * by for x in row] for row, by in zip(factors, scale, strict=True)]


class _RowSelection:
    """Rows of the regressor at exact states that are as independent as can be."""

    def __init__(
        self, model: SymbolicModel, kept_columns: Sequence[int], sample: Sample, seed: int
    ) -> None:
        self.model, self.kept_columns = model, list(kept_columns)
        self.closure = model.closure
        rng = np.random.default_rng(seed)
        width = len(model.robot.coordinates)
        count = THRESHOLDS.spare_states + -(-3 * len(kept_columns) // (2 * max(1, width)))
        self.u = self._draw_postures(sample, count, rng)
        shape = (2, len(self.u), width)
        speeds = rng.integers(1, THRESHOLDS.speed_eighths + 1, shape)
        self.qd, self.qdd = speeds * rng.choice([-1, 1], shape) / 8
        self.signals = draw_signal_values(model, len(self.u))
        states: States = self.u, self.qd, self.qdd
        if self.closure is not None:
            states = expand_states(model, *states)
        phi = evaluate_regressor(model, states)[:, :, self.kept_columns]
        self.rows, self.scale = _select_independent_rows(phi.reshape(-1, len(self.kept_columns)))
        self.width = phi.shape[1]

    def _draw_postures(self, sample: Sample, count: int, rng: np.random.Generator) -> np.ndarray:
        """(n, len(u)) exact in the actuated joints, closed in floating point."""
        if sample.walk is None:
            angular = np.array([joint.is_revolute for joint in self.model.robot.free_joints])
            reach = np.where(angular, np.pi, 1.0)
            drawn = rng.uniform(-reach, reach, (count, len(reach)))
            return np.asarray(np.round(drawn, THRESHOLDS.enclosed_decimals))
        assert self.closure is not None
        rounded = np.round(sample.walk.postures[:count], THRESHOLDS.enclosed_decimals)
        u = self.closure.close_loops(rounded)
        return np.asarray(u[np.all(np.isfinite(u), axis=1)])

    @property
    def used_states(self) -> list[int]:
        """Returns the numbers of the states whose rows are chosen."""
        return sorted({row // self.width for row in self.rows})

    def locate_rows(self) -> tuple[tuple[int, str], ...]:
        """Returns (number among the used states, joint) of every row."""
        order = {state: place for place, state in enumerate(self.used_states)}
        names = [joint.name for joint in self.model.robot.coordinates]
        return tuple((order[row // self.width], names[row % self.width]) for row in self.rows)

    def collect_exact_states(self) -> tuple[ExactState, ...]:
        """Collects the states whose rows are chosen, exactly as they are to be read."""
        free = [joint.name for joint in self.model.robot.free_joints]
        names = [joint.name for joint in self.model.robot.coordinates]
        rounded = np.round(self.u, THRESHOLDS.enclosed_decimals)
        return tuple(
            ExactState(
                dict(zip(free, rounded[i].tolist(), strict=True)),
                dict(zip(names, self.qd[i].tolist(), strict=True)),
                dict(zip(names, self.qdd[i].tolist(), strict=True)),
                tuple(self.signals[:, i].tolist()),
            )
            for i in self.used_states
        )

    def enclose_matrix(self, columns: Sequence[int]) -> list[list[Any]]:
        """Returns the chosen rows of these columns in balls; those of the base columns are scaled.

        Raises:
            NotEnclosed: a posture is not proven to exist.
        """
        model = self.model
        symbols = precise.enclose_symbols(model.robot)
        enclosures = Enclosures(model, symbols)
        place = {column: i for i, column in enumerate(columns)}
        entries = {at: x for at, x in model.regressor.items() if at[1] in place}
        regressor = build_ball_function(model.graph, list(entries.values()), symbols)
        ball_rows = {}
        for i in self.used_states:
            state = enclosures.enclose_state(self.u[i], self.qd[i], self.qdd[i])
            signals = {f"s[{k}]": build_ball(float(x)) for k, x in enumerate(self.signals[:, i])}
            values = regressor({**state.inputs, **signals})
            for k in range(self.width):
                row = [build_ball(0)] * len(place)
                for (joint, column), value in zip(entries, values, strict=True):
                    row[place[column]] += state.coupling[joint][k] * value
                ball_rows[i * self.width + k] = row
        known = dict(zip(self.kept_columns, self.scale.tolist(), strict=True))
        scale = [build_ball(known.get(column, 1.0)) for column in columns]
        return [[x * y for x, y in zip(ball_rows[row], scale, strict=True)] for row in self.rows]


def _select_independent_rows(matrix: np.ndarray) -> tuple[list[int], np.ndarray]:
    """Rows, each the longest of what those before leave, and the factors of the columns."""
    lengths = np.linalg.norm(matrix, axis=0)
    scale = 1.0 / np.where(lengths > 0.0, lengths, 1.0)
    rest = matrix * scale
    sizes = np.linalg.norm(rest, axis=1)
    rest = rest / np.where(sizes > 0.0, sizes, 1.0)[:, None]
    return select_spanning_rows(rest, matrix.shape[1]), scale
