"""Smooth functions of all that was measured: how well do they predict a residual?"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import combinations_with_replacement

import numpy as np
from scipy.linalg.lapack import sposv
from scipy.sparse import csr_array, diags_array

from modeler.core.expression import BESIDE, Law
from modeler.numerics.thresholds import THRESHOLDS

LEAST = 100
"""Rows below which nothing is predicted."""


FunctionSet = np.ndarray | Sequence[np.ndarray]
"""Values (n, p) of p functions, or parts of them that stand beside each other."""

_RIDGES = (0.1, 2.0)  # times the number of columns: noise over signal, variances


@dataclass(frozen=True, eq=False)
class NonparametricBaseline:
    """What a fit without physics predicts of the residual of one joint.

    Attributes:
        prediction: (n,) of the residual, N m or N; each row by fits to other segments of time.
        share: of the residual's variance that it predicts, between 0 and 1.
        sigma: standard error of the share.
        alone: the share by each set of functions alone; without sets that are constant.
    """

    prediction: np.ndarray
    share: float
    sigma: float = 0.0
    share_by_set: dict[str, float] = field(default_factory=dict)

    @property
    def is_significant(self) -> bool:
        """Returns True if the share is significant, also in coloured noise."""
        return self.share > THRESHOLDS.min_share_t_ratio * self.sigma


def fit_nonparametric_baseline(
    sets: Iterable[tuple[str, FunctionSet]], residual: np.ndarray, fold: np.ndarray
) -> NonparametricBaseline:
    """Predicts the residual by sets of functions on folds that they were not fitted to.

    Each set is fitted by ridge regression; the sets and their ridges are added with weights that
    are not negative (stacking, Wolpert 1992; Breiman 1996). Rows of one fold are predicted by what
    the others say: fits, and weights, which come from fits without a second fold. So neither a
    ridge nor a set is chosen by the rows that judge it, and noise, white or coloured, gives a
    share near 0.

    Args:
        sets: names and values of functions; one at a time is in memory.
        residual: (n,), in order of time.
        fold: (n,) whole numbers; a fold is made of segments much longer than noise lasts.
    """
    mean = float(residual.mean()) if residual.size else 0.0
    y = residual - mean
    energy = float(y @ y)
    rows = [np.flatnonzero(fold == f) for f in np.unique(fold)]
    enough = y.size >= LEAST and len(rows) >= 3 and energy != 0.0
    every = ((name, _standardise_columns(values)) for name, values in sets) if enough else ()
    filled = ((name, values) for name, values in every if values.shape[1])
    predictions = {name: _cross_predict(values, y, rows) for name, values in filled}
    if not predictions:
        return NonparametricBaseline(np.full(y.size, mean), 0.0)
    separate = (_combine_predictions([columns], y, rows) for columns in predictions.values())
    left = [float(np.sum((y - prediction) ** 2)) for prediction in separate]
    alone = {name: max(0.0, 1.0 - e / energy) for name, e in zip(predictions, left, strict=True)}
    predicted = _combine_predictions([*predictions.values()], y, rows)
    gain = y**2 - (y - predicted) ** 2
    starts = np.arange(THRESHOLDS.share_parts) * y.size // THRESHOLDS.share_parts
    parts = np.add.reduceat(gain, starts)
    share, sigma = float(gain.sum()), float(np.sqrt(THRESHOLDS.share_parts) * parts.std(ddof=1))
    return NonparametricBaseline(predicted + mean, max(0.0, share / energy), sigma / energy, alone)


def assign_folds(run: np.ndarray) -> np.ndarray:
    """Assigns (n,) folds to rows in order of time: each log in eight parts."""
    fold = np.zeros(run.size, dtype=int)
    for log in np.unique(run):
        log_rows = np.flatnonzero(run == log)
        fold[log_rows] = (
            np.arange(log_rows.size) * THRESHOLDS.fold_count // log_rows.size + log
        ) % THRESHOLDS.fold_count
    return fold


def _cross_predict(X: np.ndarray, y: np.ndarray, rows: list[np.ndarray]) -> np.ndarray:
    """(folds, n, ridges): at [f], rows of fold g by fits to all but f and g; g may be f."""
    fold_columns = [X[r] for r in rows]
    grams = [x.T @ x for x in fold_columns]
    sides = [x.T @ y[r].astype(np.float32) for x, r in zip(fold_columns, rows, strict=True)]
    G, u = sum(grams), sum(sides)
    theta = np.zeros((len(rows), len(rows), len(_RIDGES), X.shape[1]), dtype=np.float32)
    for f, g in combinations_with_replacement(range(len(rows)), 2):
        gram, side = G - grams[f] - (f != g) * grams[g], u - sides[f] - (f != g) * sides[g]
        for k, ridge in enumerate(_RIDGES):
            theta[f, g, k] = theta[g, f, k] = _solve_ridge(gram, ridge * X.shape[1], side)
    predictions = np.zeros((len(rows), len(X), len(_RIDGES)), dtype=np.float32)
    for g, x in enumerate(fold_columns):
        fold_predictions = x @ theta[:, g].reshape(-1, X.shape[1]).T
        predictions[:, rows[g]] = fold_predictions.reshape(len(x), len(rows), -1).swapaxes(0, 1)
    return predictions


def _combine_predictions(
    columns: Sequence[np.ndarray], y: np.ndarray, rows: list[np.ndarray]
) -> np.ndarray:
    """(n,) sum of predictions (folds, n, ...), weights of a fold by what others say of others."""
    from scipy.optimize import nnls  # it takes long to load, and a fit has no use for it

    predicted = np.zeros(y.size)
    for f, fold_rows in enumerate(rows):
        fold_predictions = np.concatenate([part[f] for part in columns], axis=1, dtype=float)
        part = fold_predictions[fold_rows]
        gram = fold_predictions.T @ fold_predictions - part.T @ part
        side = fold_predictions.T @ y - fold_predictions[fold_rows].T @ y[fold_rows]
        scale = float(np.trace(gram)) / len(gram)
        if scale > 0.0:
            root = np.linalg.cholesky(gram + 1e-6 * scale * np.eye(len(gram)))
            weights, _ = nnls(root.T, np.linalg.solve(root, side))
            predicted[fold_rows] = fold_predictions[fold_rows] @ weights
    return predicted


def _solve_ridge(gram: np.ndarray, ridge: float, side: np.ndarray) -> np.ndarray:
    """x of (gram + ridge 1) x = side, for a symmetric gram."""
    matrix = gram.copy().T  # in the order of LAPACK, which then copies nothing
    matrix.flat[:: len(matrix) + 1] += ridge
    _, x, failed = sposv(matrix, side, lower=1, overwrite_a=1)
    assert failed == 0, "a ridge keeps the matrix positive"
    return np.asarray(x)


def _standardise_columns(values: FunctionSet) -> np.ndarray:
    """Mean 0 and standard deviation 1, in single precision; without what is constant."""
    parts = [values] if isinstance(values, np.ndarray) else values
    standard = np.empty((len(parts[0]), sum(part.shape[1] for part in parts)), np.float32)
    count, weights = 0, np.full(len(standard), 1.0 / max(1, len(standard)))
    for part in parts if len(standard) else ():
        centred = part - weights @ part
        size = np.sqrt(np.einsum("ij,ij->j", centred, centred) / len(centred))
        seen = size > 1e-9
        if not seen.all():
            centred, size = centred[:, seen], size[seen]
        out = standard[:, count : count + len(size)]
        np.divide(centred, size, out=out, casting="same_kind")
        count += len(size)
    return standard[:, :count]


# Splines of one coordinate, and of two: what laws that are learned are made of.


def extend_axis(low: float, high: float, cells: int) -> tuple[float, float]:
    """Returns the ends of an axis, a cell beyond what was measured on either side."""
    cell = (high - low) / (cells - 2)
    digits = 3 - math.floor(math.log10(cell))  # of the ends: a robot file shows them
    return round(low - cell, digits), round(high + cell, digits)


def build_flat_ends(cells: int) -> csr_array:
    """Builds (cells + 3, cells - 1) coefficients that hold the curve constant at either end."""
    place = np.clip(np.arange(cells + BESIDE) - 2, 0, cells - 2)
    return csr_array((np.ones(place.size), (np.arange(place.size), place)))


def build_second_differences(free: csr_array) -> csr_array:
    """Builds (p - 2, f) second differences of the coefficients (p, f) of one axis: roughness."""
    size = free.shape[0]
    return diags_array([1.0, -2.0, 1.0], offsets=[0, 1, 2], shape=(size - 2, size)).tocsr() @ free


def compute_spline_products(
    values: np.ndarray, ends: Sequence[tuple[float, float]], cells: Sequence[int]
) -> csr_array:
    """Returns (n, p) products of the axes' splines, times the last of values (n, axes + 1)."""
    low, high = zip(*ends, strict=True)
    law, size = Law(low, high, tuple(cells), ()), 1
    columns, weights = np.zeros((len(values), 1), dtype=int), values[:, -1:]
    for axis, x in enumerate(values.T[:-1]):
        count = cells[axis] + BESIDE
        k, w = law.locate_cells(axis, x)
        cell_columns = k[:, None] + np.arange(BESIDE + 1)
        columns = (columns[:, :, None] * count + cell_columns[:, None, :]).reshape(len(values), -1)
        weights = (weights[:, :, None] * np.column_stack(w)[:, None, :]).reshape(len(values), -1)
        size *= count
    starts = np.arange(len(values) + 1) * columns.shape[1]
    return csr_array((weights.ravel(), columns.ravel(), starts), shape=(len(values), size))


# Curves: columns whose sums are any smooth function of one coordinate.


def build_hat_functions(x: np.ndarray, knots: int = 16) -> np.ndarray:
    """Builds (n, p) hat functions over x (n,), half of the knots at quantiles, half even.

    Quantiles put resolution where the data are (around zero velocity), even spacing covers the
    sparse ends. The hats sum to one.
    """
    spread = np.linspace(x.min(), x.max(), knots - knots // 2)
    dense = np.quantile(x, np.linspace(0.0, 1.0, knots // 2 + 2)[1:-1])
    places = np.unique(np.concatenate((spread, dense)))
    span = float(places[-1] - places[0])
    if span <= 0.0:
        return np.ones((x.size, 1))
    # knots closer than 1 % of the range would be one column split in two
    places = places[np.concatenate(([True], np.diff(places) > 0.01 * span))]
    right = np.clip(np.searchsorted(places, x, side="right"), 1, places.size - 1)
    weight = np.clip((x - places[right - 1]) / (places[right] - places[right - 1]), 0.0, 1.0)
    columns = np.zeros((x.size, places.size))
    rows = np.arange(x.size)
    columns[rows, right - 1] = 1.0 - weight
    columns[rows, right] = weight
    return columns


def build_friction_functions(v: np.ndarray) -> np.ndarray:
    """Builds (n, p) functions of a speed: smooth on either side of zero, with a step there."""
    return np.column_stack((build_hat_functions(v), np.sign(v)))


def build_drift_functions(time: np.ndarray, run: np.ndarray, knots: int = 5) -> np.ndarray:
    """Builds (n, knots * logs) slow functions of time, separate for each log."""
    is_of_log = run[:, None] == np.unique(run)
    return np.hstack([build_hat_functions(time, knots) * rows[:, None] for rows in is_of_log.T])


# What the nonparametric baseline reads: functions of all that was measured, whatever their cause.


SLIPS = (0.001, 0.01, 0.1)
"""Ways in which the friction of a joint turns round, of its range of motion."""

OWN = ("own", "surface")
"""Sets of functions of the motion of the joint itself."""

_KNOTS = {"q": 16, "v": 20, "a": 10, "load": 12, "torque": 12}
_OTHER = {"q": 14, "v": 12, "a": 6}
_OWN, _BENT, _PAIR, _WIDE, _PAIRS = 60, 30, 30, 60, 150  # random features


@dataclass(frozen=True, eq=False)
class Measurements:
    """What was measured beside the residual of a joint; n rows, J joints.

    Attributes:
        joint: index of the joint.
        q, v, a: (n, J) motion.
        load: (n, J) torque of the links, inertia and gravity, N m or N.
        torque: (n, J) torque of the whole model.
        direction: (n,) sign of the joint's speed, through the filter of the rows.
        slips: (n, ...) bristle states of the joint.
        further: (n, ...) sets of columns besides, by name: waves, what rings.
    """

    joint: int
    q: np.ndarray
    v: np.ndarray
    a: np.ndarray
    load: np.ndarray
    torque: np.ndarray
    direction: np.ndarray
    bristle_states: np.ndarray
    extra_sets: dict[str, np.ndarray]


def generate_function_sets(measured: Measurements) -> Iterator[tuple[str, FunctionSet]]:
    """Yields sets of functions by name: "own", "surface" of the joint, "0", ... of others, "wide".

    Curves are sums of hats over one coordinate, with and without the direction of the joint:
    friction and other torques of any shape. Surfaces are random Fourier features (Rahimi and Recht
    2007) of several coordinates.
    """
    generator = np.random.default_rng(5)
    m, j = measured, measured.joint
    way = m.direction[:, None]
    joint_motion = np.column_stack([x[:, j] for x in (m.q, m.v, m.a, m.load)])
    yield "own", _build_joint_functions(m, way)
    bent = (
        _draw_fourier_features(joint_motion, _OWN, generator),
        _draw_fourier_features(joint_motion[:, :2], _BENT, generator) * way,
    )
    yield "surface", bent
    for k in range(m.q.shape[1]):
        if k != j:
            yield str(k), _build_other_joint_functions(m, k, way, generator)
    near = np.column_stack([m.q, m.v])
    yield "sum", [build_hat_functions(x, THRESHOLDS.sum_knots) for x in (*m.q.T, *m.v.T)]
    features = _draw_fourier_features(near, _WIDE, generator)
    yield "wide", (near, m.a, m.load, m.torque, features)
    yield "pairs", _draw_fourier_features(near, _PAIRS, generator, few=2)
    yield from m.extra_sets.items()


def _build_joint_functions(m: Measurements, way: np.ndarray) -> FunctionSet:
    parts = [m.bristle_states, way]
    for name, knots in _KNOTS.items():
        hats = build_hat_functions(getattr(m, name)[:, m.joint], knots)
        parts += [hats] if name == "v" else [hats, hats * way]
    return parts


def _build_other_joint_functions(
    m: Measurements, k: int, way: np.ndarray, generator: np.random.Generator
) -> FunctionSet:
    curves = [build_hat_functions(getattr(m, name)[:, k], knots) for name, knots in _OTHER.items()]
    plain = np.column_stack([x[:, k] for x in (m.v, m.a, m.load, m.torque)])
    both = np.column_stack([m.q[:, k], m.v[:, k]])
    features = _draw_fourier_features(both, _PAIR, generator)
    turned = [curves[0][:, ::2] * way, plain, np.abs(plain) * way, np.sign(m.v[:, [k]])]
    return [*curves, *turned, features]


def _draw_fourier_features(
    x: np.ndarray, count: int, generator: np.random.Generator, few: int = 0
) -> np.ndarray:
    """(n, count) cosines of random directions, lengths of order one in standard deviations.

    Args:
        x: (n, d) coordinates.
        count: of features.
        generator: of directions.
        few: coordinates that each feature reads; 0: all.
    """
    spread = x.std(axis=0)
    scaled = x / np.where(spread > 0.0, spread, 1.0)
    turn = generator.normal(size=(x.shape[1], count))
    if few:
        order = np.argsort(generator.uniform(size=turn.shape), axis=0)
        turn = np.where(order < few, turn, 0.0)
    width = generator.uniform(0.5, 3.0, count) / np.sqrt(few or x.shape[1])
    turns = scaled @ (turn * width / (2.0 * np.pi))
    turns += generator.uniform(0.0, 1.0, count)
    turns -= np.rint(turns)
    phase = (2.0 * np.pi) * turns.astype(np.float32)  # ten times as fast
    return np.cos(phase, out=phase)
