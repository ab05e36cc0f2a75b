"""A law that is learned: a smooth function of what was measured, of what a model leaves.

With e the residual of joint j, W the columns of the model and B splines of one or two coordinates,

    minimise |(y - W beta - B c) / sigma|^2 + s |D c|^2 + r |c|^2

over all joints' rows, beta and c together; D are second differences along each axis (Eilers and
Marx 1996). The smoothness s, and the coordinates where none are requested, are those that lose
least on folds of time that were not fitted. A little r gives to physics what both could explain.
"""

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, reduce
from typing import Any

import numpy as np
from scipy.linalg import LinAlgError, cho_factor, cho_solve
from scipy.sparse import csr_array, eye_array, kron, vstack

from modeler.core.errors import DataError, RobotError
from modeler.core.expression import Law
from modeler.core.json import ShortRepr
from modeler.core.toml_cells import TomlCell
from modeler.diagnosis.candidates import Candidate, evaluate_equations
from modeler.diagnosis.generation import compute_joint_order_spectrum, smooth_rows
from modeler.diagnosis.scoring import compute_t_ratio
from modeler.diagnosis.state import State
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import TURN, read_definition
from modeler.numerics.splines import (
    build_flat_ends,
    build_second_differences,
    compute_spline_products,
    extend_axis,
)

CELLS = (40, 14)
"""Of one axis alone, and of each of two."""


_TRAVELS = (0.003, 0.03)
"""After a reversal, of the range of motion: over which z turns, and what is a reversal at all."""

_LAGS = (0.1, 0.4, 1.6)  # s

_SMOOTH = tuple(10.0**power for power in range(-5, 4))
_FIRST = (1e-2, 1.0)  # smoothness in which coordinates are compared


@dataclass(frozen=True)
class LawCoordinates(ShortRepr):
    """The quantities of which a law is a function.

    Attributes:
        arguments: one or two equations in the variables of effects.
        factor: equation that it is multiplied with; "" none.
        further: what else its definition needs: shapes of z, lag.
        cells: along each axis; empty: as is usual.
    """

    arguments: tuple[str, ...]
    factor: str = ""
    further: Mapping[str, Any] = field(default_factory=dict)
    cells: tuple[int, ...] = ()

    @property
    def equation(self) -> str:
        """Returns the column of the effect."""
        law = f"law({', '.join(self.arguments)})"
        return f"{self.factor}*{law}" if self.factor else law

    @property
    def description(self) -> str:
        """Describes the arguments: "abs(v) and q, times sign(v)"."""
        return " and ".join(self.arguments) + (", times " + self.factor if self.factor else "")

    @property
    def cell_counts(self) -> tuple[int, ...]:
        """Returns the cells along each axis."""
        return self.cells or (CELLS[len(self.arguments) - 1],) * len(self.arguments)

    def scale_parameter(self, name: str, factor: float) -> "LawCoordinates":
        """Returns the coordinates with a parameter of what the law reads multiplied."""
        (value,) = self.further["shapes"][name]
        shapes = self.further["shapes"] | {name: [float(f"{value * factor:.4g}")]}
        return replace(self, further=dict(self.further) | {"shapes": shapes})

    def evaluate_samples(self, state: State, j: int) -> list[np.ndarray]:
        """Evaluates arguments, then the factor, (samples, arguments + 1) by segment.

        Of the smooth motion: what the noise of positions makes of the columns of the model is in
        the residual, and the measured motion would seem to predict it.

        Raises:
            RobotError: an equation that cannot be read.
        """
        columns = {f"x{chr(97 + k)}": text for k, text in enumerate(self.arguments)}
        table = {"columns": columns | {"by": self.factor or "1"}, **self.further}
        cell = TomlCell("law").with_value(table)
        effect = read_definition("law", cell, {}, joints=state.joint_names)
        shapes = {shape.name: shape.grid[0] for shape in effect.forms[0].nonlinear_parameters}
        candidate = Candidate(effect, effect.forms[0], state.joint_names[j], j, shapes)
        return [evaluate_equations([candidate], signals) for signals in smooth_rows(state).signals]


@dataclass(frozen=True, eq=False)
class LearnedLaw(ShortRepr):
    """A law of one joint.

    Attributes:
        coordinates: of what.
        law: the table; the rms of its column over the rows is 1.
        size: N m or N, times which it is the torque.
        torque: (rows_j,) N m or N, with the columns of the model fitted beside it.
        reductions: (blocks,) fall of the squared residuals, weighted, on folds not fitted.
        t_ratio: fall of the error over its standard error, paired over blocks (see
            `score.score_change`).
        variance_reduction: fall of the squared residual, as a share of that of its joint.
        torque_share: rms of what it explains over the rms torque of its joint.
    """

    coordinates: LawCoordinates
    law: Law
    size: float
    torque: np.ndarray
    reductions: np.ndarray
    t_ratio: float
    variance_reduction: float
    torque_share: float

    @property
    def is_significant(self) -> bool:
        """Returns whether it is significant."""
        large = self.variance_reduction > THRESHOLDS.min_variance_reduction
        large = large and self.torque_share > THRESHOLDS.min_torque_share
        return large and self.t_ratio > THRESHOLDS.min_law_t_ratio


@dataclass(frozen=True)
class LawRequest(ShortRepr):
    """What a user asks of a law.

    Attributes:
        of: one or two variables of equations, such as ("q", "v"); empty: those that predict best.
        odd: True for a function of |v| times the sign of v.
        rising: 1 or -1 for a law that never falls, or never rises, along its first variable.
    """

    of: tuple[str, ...] = ()
    odd: bool = False
    rising: int = 0

    @property
    def description(self) -> str:
        """Describes the request behind "law": " of q and v"; empty without one."""
        return f" of {' and '.join(self.of)}" if self.of else ""

    def list_coordinates(self, state: State, j: int) -> list[LawCoordinates]:
        """Lists the coordinates to choose from.

        Raises:
            DataError: more than two variables, or such as laws cannot read in loops.
        """
        if not self.of:
            every = generate_coordinates(state, j)
            return [c for c in every if c.factor or not self.odd]
        if len(self.of) > 2:
            raise DataError(f"--of {','.join(self.of)}: expected one or two quantities, as in q,v")
        if state.spec.closure is not None and not {*self.of} <= {"q", "v", "a"}:
            raise DataError(
                f"--of {','.join(self.of)}: {state.spec.robot} has loops, and there a law reads "
                "the q, v and a of its joint; expected one or two of these"
            )
        arguments, factor = self.of, ""
        if self.odd:
            arguments, factor = tuple("abs(v)" if x == "v" else x for x in self.of), "sign(v)"
        if "z" not in self.of:
            return [LawCoordinates(arguments, factor)]
        definitions = _list_bristle_definitions(state, j)
        return [LawCoordinates(arguments, factor, further) for further in definitions]


ANY_LAW = LawRequest()
"""A law of whatever predicts best."""

LEARNED = "learned"
"""What a law is called where effects have their ids."""


def make_effect_id(stem: str, joint: str, taken: Collection[str]) -> str:
    """Makes an id of an effect of a joint that no other has: learned_2."""
    return choose_free_name(f"{stem}_{re.sub(r'[^a-z0-9]', '_', joint.lower())}", taken)


def choose_free_name(stem: str, taken: Collection[str]) -> str:
    """Returns the stem, with a letter behind it if it is taken."""
    names = (stem, *(f"{stem}{letter}" for letter in "bcdefghijklmnopqrstuvwxyz"))
    return next(name for name in names if name not in taken)


def learn_law(state: State, j: int, request: LawRequest = ANY_LAW) -> LearnedLaw | None:
    """Learns the law of joint j with the least cross-validated error; None without any.

    Args:
        state: what is in the model.
        j: index of the joint.
        request: of what, and its form.

    Raises:
        DataError: a quantity that cannot be read.
    """
    ranked = []
    for option in request.list_coordinates(state, j):
        try:
            splines = _build_splines(state, j, option)  # of one at a time: they fill memory
        except RobotError as error:
            raise DataError(f"--of {','.join(request.of)}: {error}") from None
        if splines is not None:
            fit = _SplineProblem(state, j, splines).fit_smoothness(_FIRST)
            ranked.append((float(fit.reductions.sum()), option))
    ranked.sort(key=lambda item: -item[0])
    leading = [option for _, option in ranked[: THRESHOLDS.max_refined_coordinates]]
    near = [s for c in leading if (s := _build_splines(state, j, c)) is not None]
    if not near:
        return None
    fits = [_SplineProblem(state, j, s).fit_smoothness(_SMOOTH, request.rising) for s in near]
    closely = list(zip(fits, near, strict=True))
    fit, splines = _refine_coordinates(state, j, *_select_simplest(closely), request.rising)
    return _build_law(state, j, splines, fit)


def _refine_coordinates(
    state: State, j: int, fit: "_SplineFit", splines: "_SplineBasis", rising: int
) -> "_FittedBasis":
    """At a travel or a time of what has memory that loses less: steps by factors, ever smaller."""
    for name in splines.coordinates.further.get("shapes", {}):
        factor = 2.0
        while factor > THRESHOLDS.min_refinement_factor:
            for times in (factor, 1.0 / factor):
                scaled = splines.coordinates.scale_parameter(name, times)
                scaled_splines = _build_splines(state, j, scaled)
                if scaled_splines is not None:
                    other = _SplineProblem(state, j, scaled_splines).fit_smoothness(_SMOOTH, rising)
                    if other.after.sum() < fit.after.sum():
                        fit, splines = other, scaled_splines
                        break
            else:
                factor = factor**0.5
    return fit, splines


def generate_coordinates(state: State, j: int) -> Iterator[LawCoordinates]:
    """Generates the coordinates that make sense on a joint.

    Odd in v, and not.
    """
    peaks = [] if (spectrum := compute_joint_order_spectrum(state, j)) is None else spectrum.peaks
    turns = state.joint_scales[j].range / (2.0 * np.pi)
    fine = round(THRESHOLDS.cells_per_wave * max(peaks, default=0.0) * turns)
    fine = min(THRESHOLDS.max_cells, fine)
    waves = [0, THRESHOLDS.fine_cells] + ([fine] if fine > THRESHOLDS.fine_cells else [])
    quantities = _list_quantities(state, j)
    for x, further in quantities:
        for cells in waves if x == "q" else [0]:
            yield LawCoordinates((x,), "", further, (cells,) if cells else ())
            odd = "abs(v)" if x == "v" else x
            yield LawCoordinates((odd,), "sign(v)", further, (cells,) if cells else ())
        if x != "v":
            yield LawCoordinates(("v", x), "", further)
            yield LawCoordinates(("abs(v)", x), "sign(v)", further)
        if x not in ("q", "v") and not further:
            yield LawCoordinates(("q", x))
        for cells in waves[1:] if x in ("load", "T") else []:
            yield LawCoordinates(("q", x), cells=(cells, THRESHOLDS.few_cells))


def _list_quantities(state: State, j: int) -> list[tuple[str, Mapping[str, Any]]]:
    """What a law may depend on, with what else its definition needs."""
    quantities: list[tuple[str, Mapping[str, Any]]] = [("q", {}), ("v", {}), ("a", {})]
    if state.joint_names[j] in state.reference.temperature:
        quantities.append(("T", {}))
    if state.spec.closure is not None:  # in loops laws read the motion of their own joint
        return quantities
    others = [name for name in state.joint_names if name != state.joint_names[j]]
    quantities += [("load", {}), *((f"{letter}{name}", {}) for name in others for letter in "qv")]
    quantities += [("z", further) for further in _list_bristle_definitions(state, j)]
    quantities += [("sqrt(since)", {"shapes": {TURN: [x]}}) for x in _list_travels(state, j)]
    for tau in _LAGS:
        quantities += [("z", {"lag": x, "shapes": {"tau": [tau]}}) for x in ("v", "abs(v)")]
    return quantities


def _list_travels(state: State, j: int) -> list[float]:
    return [float(f"{share * state.joint_scales[j].range:.3g}") for share in _TRAVELS]


def _list_bristle_definitions(state: State, j: int) -> list[Mapping[str, Any]]:
    """What a definition that reads z needs."""
    return [{"shapes": {"d": [travel]}} for travel in _list_travels(state, j)]


def _select_simplest(fits: Sequence["_FittedBasis"]) -> "_FittedBasis":
    """Of those that the data do not distinguish from the best, the one with the fewest axes."""
    best = max(fits, key=lambda item: float(item[0].reductions.sum()))
    total = float(best[0].reductions.sum())
    least, most = THRESHOLDS.parsimony_share * total, THRESHOLDS.max_chance_t
    near = [item for item in fits if item is best or item[0].reductions.sum() > least]
    apart = [(item, compute_t_ratio(item[0].after - best[0].after)) for item in near]
    near = [item for item, t_ratio in apart if item is best or t_ratio <= most]
    return min(near, key=lambda x: (len(x[1].coordinates.arguments), -float(x[0].reductions.sum())))


@dataclass(frozen=True, eq=False)
class _SplineBasis(ShortRepr):
    """Splines of some coordinates on the rows of a joint; p coefficients, f of them free.

    Attributes:
        coordinates: they.
        ends: (low, high) of each axis.
        free: (p, f) coefficients of what is free: three are one at each end of each axis.
        rows: (rows_j, f) the splines through the filter of the rows.
        rough: (f, f) square of the second differences.
    """

    coordinates: LawCoordinates
    ends: tuple[tuple[float, float], ...]
    free: csr_array
    rows: np.ndarray
    rough: np.ndarray


def _build_splines(state: State, j: int, coordinates: LawCoordinates) -> _SplineBasis | None:
    """None where a coordinate has no value, or always the same."""
    values, rows = coordinates.evaluate_samples(state, j), state.rows
    used = [v[s.usable[:, j]] for v, s in zip(values, rows.signals, strict=True)]
    every = np.concatenate(used)[:, :-1]
    if not len(every) or not np.isfinite(np.concatenate(values)).all():
        return None
    ends = []
    for x, count in zip(every.T, coordinates.cell_counts, strict=True):
        low, high = np.quantile(x, [THRESHOLDS.outlying_share, 1.0 - THRESHOLDS.outlying_share])
        if not high > low:
            return None
        ends.append(extend_axis(float(low), float(high), count))
    flat = [build_flat_ends(count) for count in coordinates.cell_counts]
    free = reduce(kron, flat).tocsr()
    filtered = []
    for i, blocks in enumerate(rows.blocks):
        splines = compute_spline_products(values[i], ends, coordinates.cell_counts) @ free
        filtered += [block.filters[j] @ splines[block.window] for block in blocks]
    rough = [(d.T @ d) for d in (build_second_differences(t) for t in flat)]
    eyes = [eye_array(t.shape[1]) for t in flat]
    total = rough[0] if len(flat) == 1 else kron(rough[0], eyes[1]) + kron(eyes[0], rough[1])
    return _SplineBasis(coordinates, tuple(ends), free, vstack(filtered).toarray(), total.toarray())


@dataclass(frozen=True, eq=False)
class _SplineFit(ShortRepr):
    """Coefficients (f,), and squared residuals (blocks,) where they were not fitted."""

    c: np.ndarray
    before: np.ndarray
    after: np.ndarray

    @property
    def reductions(self) -> np.ndarray:
        """Returns the fall of the squared residuals, (blocks,)."""
        return self.before - self.after

    @property
    def t_ratio(self) -> float:
        """Returns the fall of the error over its standard error."""
        return compute_t_ratio(np.sqrt(self.before) - np.sqrt(self.after))


_Solution = tuple[np.ndarray, np.ndarray]
_FittedBasis = tuple[_SplineFit, _SplineBasis]


class _SplineProblem:
    """Normal equations of the splines beside the model, by fold."""

    def __init__(self, state: State, j: int, splines: _SplineBasis) -> None:
        self.state, self.j, self.splines = state, j, splines
        base = state.gram_blocks
        self.place, self.inverse = base.fold_fits.fold_index, base.fold_fits.inverse
        self.fold = self.place[base.block[j]]
        B, X, y = splines.rows / state.sigma[j], base.whitened_columns[j], base.y[j]
        folds = range(len(self.inverse))
        parts = [np.flatnonzero(self.fold == f) for f in folds]
        self.BB = np.stack([B[r].T @ B[r] for r in parts])
        self.XB = np.stack([X[r].T @ B[r] for r in parts])
        self.By = np.stack([B[r].T @ y[r] for r in parts])
        self.B, self.parts = B, parts
        mean = float(np.trace(self.BB.sum(axis=0))) / B.shape[1]
        self.rough = splines.rough * (mean * B.shape[1] / max(float(np.trace(splines.rough)), 1e-9))
        self.ridge = THRESHOLDS.spline_ridge * mean * np.eye(B.shape[1])

    @cached_property
    def full_fit(self) -> tuple[np.ndarray, np.ndarray]:
        """Returns the inverse Gram matrix (r, r) of the model and its parameters (r,), all rows."""
        base = self.state.gram_blocks
        G = base.G.sum(axis=0) + base.prior[:, :-1]
        inverse = np.linalg.inv(G + 1e-10 * np.eye(len(G)))
        return inverse, inverse @ (base.u.sum(axis=0) + base.prior[:, -1])

    def solve(self, f: int | None, smooth: float, rising: int = 0) -> _Solution | None:
        """Solves for coefficients and parameters (r,) by all folds but f; None: by all."""
        sums = self.BB, self.XB, self.By
        BB, XB, By = (x.sum(axis=0) - (x[f] if f is not None else 0.0) for x in sums)
        crossed = self.state.gram_blocks.fold_fits
        inverse, beta = self.full_fit if f is None else (crossed.inverse[f], crossed.beta[f])
        moved = inverse @ XB
        S = BB - XB.T @ moved + smooth * self.rough + self.ridge
        side = By - XB.T @ beta
        try:
            factor = cho_factor(S, lower=True)
        except LinAlgError:
            return None
        c = cho_solve(factor, side) if not rising else self._solve_monotone(factor[0], side, rising)
        return c, beta - moved @ c

    def _solve_monotone(self, factor: np.ndarray, side: np.ndarray, rising: int) -> np.ndarray:
        """The same with coefficients that never fall, or rise, along the first axis."""
        from scipy.optimize import nnls  # it takes long to load

        first, *others = (count - 1 for count in self.splines.coordinates.cell_counts)
        steps = np.tril(np.ones((first, first)))
        steps[:, 1:] *= rising
        turn = np.kron(steps, np.eye(others[0] if others else 1))
        rest = others[0] if others else 1
        turn = np.column_stack([turn, -turn[:, :rest]])  # where it begins may have either sign
        root = np.tril(factor)
        target, most = np.linalg.solve(root, side), 100 * turn.shape[1]
        coefficients, _ = nnls(root.T @ turn, target, maxiter=most)
        return np.asarray(turn @ coefficients)

    def fit_smoothness(self, grid: Sequence[float], rising: int = 0) -> _SplineFit:
        """Fits with the smoothness of least cross-validated error."""
        every = [(*self._cross_validate(smooth, rising), smooth) for smooth in grid]
        before, after, smooth = min(every, key=lambda item: float(item[1].sum()))
        solution = self.solve(None, smooth, rising)
        c = np.zeros(self.B.shape[1]) if solution is None else solution[0]
        return _SplineFit(c, before, after)

    def _cross_validate(self, smooth: float, rising: int) -> tuple[np.ndarray, np.ndarray]:
        """(blocks,) squared residuals of all joints, without and with, of folds not fitted."""
        base = self.state.gram_blocks
        before, after = np.zeros((2, base.block_count))
        fits = [self.solve(f, smooth, rising) for f in range(len(self.parts))]
        data = zip(base.whitened_columns, base.y, base.block, base.out_of_fold, strict=True)
        for k, (X, y, block, left) in enumerate(data):
            e = left.copy()
            for f, fold_fit in enumerate(fits):
                if fold_fit is None:
                    continue
                rows = np.flatnonzero(self.place[block] == f)
                e[rows] = y[rows] - X[rows] @ fold_fit[1]
                if k == self.j:
                    e[rows] -= self.B[rows] @ fold_fit[0]
            before += np.bincount(block, left**2, base.block_count)
            after += np.bincount(block, e**2, base.block_count)
        return before, after


def _build_law(state: State, j: int, splines: _SplineBasis, fit: _SplineFit) -> LearnedLaw | None:
    torque = splines.rows @ fit.c
    size = float(np.sqrt(np.mean(torque**2)))
    if not size > 0.0:
        return None
    values = splines.free @ fit.c / size
    low, high = zip(*splines.ends, strict=True)
    rounded = tuple(float(f"{v:.{THRESHOLDS.law_digits}g}") for v in values)
    law = Law(low, high, splines.coordinates.cell_counts, rounded)
    before = float(np.sum(state.gram_blocks.out_of_fold[j] ** 2))
    torque_square = float(np.sum((state.rows.y[j] / state.sigma[j]) ** 2))
    fall = float(fit.reductions.sum())
    reduction = min(1.0, fall / max(before, 1e-300))
    share = float(np.sqrt(max(0.0, fall) / (torque_square + 1e-300)))
    place = splines.coordinates
    return LearnedLaw(place, law, size, torque, fit.reductions, fit.t_ratio, reduction, share)
