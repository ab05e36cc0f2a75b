"""The same question in floating point: rank of the torque regressor at random states."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, partial
from typing import Any

import numpy as np
import sympy

from modeler.derivation.grouping import build_named_parameters, sort_by_priority
from modeler.derivation.model import SymbolicModel
from modeler.derivation.result import BaseParameter, Term
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
    their posture, so that none drowns what the others tell.
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
    phi, other = (
        evaluate_regressor(model, expand_states(model, u, qd, qdd))
        for u in (walk.postures, rounded)
    )
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
    inputs = {
        f"{kind}[{i}]": array[:, i]
        for kind, array in (("q", q), ("qd", qd), ("qdd", qdd))
        for i in range(q.shape[1])
    }
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

    Without loops singular values above `rank_tolerance` of the largest count. With loops those
    count that are ten times as large as the rounding of the closure and of the decomposition: a matrix
    of lower rank is as far away as the last singular value (Weyl).
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
    return NumericRank(
        rank, (float(singular[rank - 1]), dropped), tolerance,
        f"{W.shape[0]} rows, {W.shape[1]} columns (the others are 0), scaled to length 1{weighed}",
    )  # fmt: skip


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
    absent = {
        i
        for i, length in enumerate(lengths)
        if length <= THRESHOLDS.zero_column * lengths.max(initial=0.0)
    }
    order = [
        i for i in sort_by_priority(model.names, model.robot.priority_parameters) if i not in absent
    ]
    kept_columns, relations, bound = _select_first_columns(W, lengths, order, tolerance)
    balls = enclosed(kept_columns, list(relations))
    if balls is not None:
        relations = {
            column: {b: _convert_ball(row[k]) for b, row in zip(kept_columns, balls, strict=True)
                     if not row[k].contains(0)}
            for k, column in enumerate(relations)
        }  # fmt: skip
    terms = {b: [Term(sympy.Integer(1), model.names[b])] for b in sorted(kept_columns)}
    for column in sorted(relations):
        for b, factor in relations[column].items():
            terms[b].append(Term(factor, model.names[column]))
    return (
        build_named_parameters(model.columns, terms, model.robot.has_binary_fractions),
        tuple(model.names[i] for i in sorted(absent)),
        bound,
    )


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
        relations[column] = {
            b: _convert_number(float(s))
            for b, s, f in zip(kept_columns, scaled, factors, strict=True)
            if abs(f) > THRESHOLDS.zero_factor
        }
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
    return (
        float(np.max(np.abs(phi[:, :, base_columns] @ beta - standard))) / largest
        if largest
        else 0.0
    )


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
