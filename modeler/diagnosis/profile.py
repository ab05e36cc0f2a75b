"""How certain values are whose shapes were fitted too: the likelihood along all shapes.

For shapes theta of an effect, all parameters beside them are linear: least squares gives their
values g(theta) with deviations s(theta), and the weighted squared residual S(theta). With S* the
least of it,

    L(theta) = exp(-(S(theta) - S*) / (2 f^2))

is the profile likelihood (f^2: by how much autocorrelated residuals raise variances). A value is in
the interval if any shape with it is not refused:

    min_theta (S(theta) - S*) / f^2 + ((g - g(theta)) / s(theta))^2 <= 3.84, the 95 % quantile;

where two shapes do as well, it spans both (Venzon and Moolgavkar 1988, Applied Statistics 37(1);
Seber and Wild 1989, section 5.4). The standard deviation is that of the mixture of all shapes,
weighted by L, about the value that is reported; for a narrow L it is that of the delta method.
"""

import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from modeler.core.manifest import ModuleSpec
from modeler.diagnosis.candidates import (
    Candidate,
    JointScale,
    encode_parameter,
    list_body_parameters,
    to_dense,
)
from modeler.diagnosis.elastic_joints import describe_elastic_joint
from modeler.diagnosis.ranking import build_time_blocks
from modeler.diagnosis.signals import compute_tilt_axes
from modeler.diagnosis.state import State
from modeler.diagnosis.thresholds import THRESHOLDS
from modeler.effects import EffectTarget, NonlinearParameter
from modeler.estimation import estimate_autocorrelation, sum_lagged_products
from modeler.numerics.least_squares import compute_joint_whitening

# The fit of an effect with given shapes, beside all else that a model has.


_Shapes = Sequence[NonlinearParameter]


@dataclass(frozen=True, eq=False)
class ProfilePoint:
    """One set of shapes, and the fit with it.

    Attributes:
        nonlinear_parameters: values by name, SI.
        squares: S, weighted.
        values: (k,) parameters of the effect.
        deviations: (k,) theirs, for white residuals of variance 1.
        others: (c,) the other parameters.
        weight: of its cell among the shapes; not the likelihood.
    """

    nonlinear_parameters: Mapping[str, float]
    squares: float
    values: np.ndarray
    deviations: np.ndarray
    others: np.ndarray
    weight: float = 1.0


class ProfileProblem:
    """What a profile is made from: an effect in a state, and all columns but its own; J joints.

    Attributes:
        rows: where columns come from.
        observation: the rows' samples and segments.
        scale: what is large on its joint.
        y: (rows_j,) by joint.
        sigma: (J,) rms residual with the effect in.
        others: (rows_j, c) by joint: columns of all else.
        prior: (k, c + 1) rows of what is known beforehand of all else, of weight 1.
    """

    def __init__(self, state: State, pick: Candidate, effect_columns: slice | list[int]) -> None:
        self.rows, self.observation = state.rows, state.data.observation
        self.scale, self.y, self.sigma = state.joint_scales[pick.scale_index], state.y, state.sigma
        every = (np.delete(w, effect_columns, axis=1) for w in (*state.W, state.prior))
        *self.others, self.prior = every

    @cached_property
    def weighted_base(self) -> tuple[tuple[np.ndarray, ...], np.ndarray]:
        """Returns orthonormal weighted columns of all else by joint, and the transform (c, r)."""
        blocks, sigma = [*self.others, self.prior[:, :-1]], np.append(self.sigma, 1.0)
        turn = compute_joint_whitening(blocks, sigma)
        every = zip(self.others, self.sigma, strict=True)
        return tuple(w @ (turn / s) for w, s in every), turn

    @cached_property
    def weighted_target(self) -> tuple[tuple[np.ndarray, ...], np.ndarray, float]:
        """Returns weighted y by joint, its products with the base, and what the base leaves."""
        scaled = tuple(t / s for t, s in zip(self.y, self.sigma, strict=True))
        known = self.prior[:, -1]
        u = sum(q.T @ t for q, t in zip(self.weighted_base[0], scaled, strict=True))
        u = np.asarray(u + (self.prior[:, :-1] @ self.weighted_base[1]).T @ known)
        return scaled, u, float(sum(t @ t for t in scaled) + known @ known - u @ u)

    def fit_candidate(self, candidate: Candidate) -> ProfilePoint | None:
        """Fits these parameters; None where the columns are not identifiable beside all else."""
        columns = enumerate(self.rows.build_columns(candidate))
        made = {j: np.asarray(c) / self.sigma[j] for j, c in columns if c is not None}
        if not made or not all(np.isfinite(c).all() for c in made.values()):
            return None
        (y, u, left), base = self.weighted_target, self.weighted_base[0]
        T = sum(base[j].T @ c for j, c in made.items())
        M = sum(c.T @ c for c in made.values()) - T.T @ T
        h = sum(c.T @ y[j] for j, c in made.items()) - T.T @ u
        length = np.sqrt(sum(np.sum(c**2, axis=0) for c in made.values()))
        if not (length > 0.0).all():
            return None
        scale = np.outer(length, length)
        inverse = np.linalg.pinv(M / scale, rcond=1e-9, hermitian=True) / scale
        values = inverse @ h
        others = self.weighted_base[1] @ (u - T @ values)
        deviations = np.sqrt(np.maximum(np.diag(inverse), 0.0))
        parameters, squares = dict(candidate.nonlinear_parameters), left - float(h @ values)
        return ProfilePoint(parameters, squares, values, deviations, others)

    def compute_squares(self, candidate: Candidate, values: np.ndarray) -> float:
        """Computes S with these parameters and values (k,) of the effect; all else is fitted."""
        torque = self.compute_residual_columns(candidate) @ values
        scaled, _, left = self.weighted_target
        return left + float(torque @ torque - 2.0 * torque @ np.concatenate(scaled))

    def compute_residual(self, torque: np.ndarray) -> np.ndarray:
        """Computes what all else and a torque leave of y, over sigma, (rows of all joints,)."""
        y, u, _ = self.weighted_target
        pairs = zip(self.weighted_base[0], y, strict=True)
        return np.concatenate([t - q @ u for q, t in pairs]) - torque

    def compute_residual_columns(self, candidate: Candidate) -> np.ndarray:
        """Computes what all else leaves of the columns over sigma, (rows of all joints, k)."""
        columns = self.rows.build_columns(candidate)
        made = [to_dense(columns, j, len(t)) / self.sigma[j] for j, t in enumerate(self.y)]
        pairs = list(zip(self.weighted_base[0], made, strict=True))
        T = sum(q.T @ c for q, c in pairs)
        return np.concatenate([c - q @ T for q, c in pairs])


@dataclass(frozen=True, eq=False)
class Profile:
    """The likelihood of an effect along its shapes.

    Attributes:
        points: shapes that were looked at.
        reported_point: shapes and values that are reported.
        factor: (k,) of the deviations: autocorrelated residuals.
        nonlinear_factor: f.
    """

    points: tuple[ProfilePoint, ...]
    reported_point: ProfilePoint
    factor: np.ndarray
    nonlinear_factor: float

    @cached_property
    def values(self) -> np.ndarray:
        """Returns the parameters, (points, k)."""
        return np.array([point.values for point in self.points])

    @cached_property
    def squares_rise(self) -> np.ndarray:
        """Returns (S - S*) / f^2, (points,)."""
        squares = np.array([point.squares for point in self.points])
        return (squares - squares.min()) / self.nonlinear_factor**2

    @cached_property
    def likelihood_share(self) -> np.ndarray:
        """Returns the shares of the likelihood, (points,), which sum to one."""
        weight = np.array([point.weight for point in self.points])
        weight = weight * np.exp(-0.5 * self.squares_rise)
        weight = np.where(self.squares_rise < THRESHOLDS.max_rise, weight, 0.0)
        return np.asarray(weight / weight.sum())

    def compute_deviations(self) -> np.ndarray:
        """Computes standard deviations of the parameters, (k,), over all nonlinear parameters.

        Never more than the interval reaches: where an effect all but vanishes from the rows, its
        parameter may be anything.
        """
        point_deviations = np.array([point.deviations for point in self.points]) * self.factor
        apart = self.values - self.reported_point.values
        reach = np.abs(self.compute_intervals() - self.reported_point.values[:, None]).max(axis=1)
        return np.minimum(np.sqrt(self.likelihood_share @ (point_deviations**2 + apart**2)), reach)

    def compute_intervals(self) -> np.ndarray:
        """Computes 95 % intervals of the parameters, (k, 2), over all nonlinear parameters."""
        every = [*self.points, self.reported_point]
        rise = np.append(self.squares_rise, 0.0)
        half = np.sqrt(np.maximum(THRESHOLDS.chi2_95 - rise, 0.0))[:, None] * self.factor
        values = np.vstack([self.values, self.reported_point.values])
        reach = half * np.array([point.deviations for point in every])
        allowed = rise < THRESHOLDS.chi2_95
        low, high = (values - reach)[allowed], (values + reach)[allowed]
        return np.column_stack([low.min(axis=0), high.max(axis=0)])

    def compute_nonlinear_deviations(self) -> dict[str, float]:
        """Computes standard deviations of the nonlinear parameters by name."""
        deviations = {}
        for name, value in self.reported_point.nonlinear_parameters.items():
            squares = [(p.nonlinear_parameters[name] - value) ** 2 for p in self.points]
            deviations[name] = float(np.sqrt(self.likelihood_share @ squares))
        return deviations

    def compute_nonlinear_intervals(self) -> dict[str, tuple[float, float]]:
        """Computes 95 % intervals of the nonlinear parameters by name."""
        pairs = zip(self.points, self.squares_rise, strict=True)
        allowed = [point for point, rise in pairs if rise < THRESHOLDS.chi2_95]
        sets = [point.nonlinear_parameters for point in (self.reported_point, *allowed)]
        ends, deviations = dict[str, tuple[float, float]](), self.compute_nonlinear_deviations()
        for name, value in self.reported_point.nonlinear_parameters.items():
            every = [point.nonlinear_parameters[name] for point in self.points]
            # a grid of several has few points: what it passes by, the deviation reaches
            half = np.array([-1.0, 1.0]) * np.sqrt(THRESHOLDS.chi2_95) * deviations[name]
            low, high = np.clip(value + half, min(every), max(every))
            values = [values[name] for values in sets]
            ends[name] = (min(float(low), *values), max(float(high), *values))
        return ends

    def compute_extra_covariance(self) -> np.ndarray:
        """Computes what nonlinear parameters add to the covariance, (c + k,) squared, own last."""
        every = np.array([np.concatenate([p.others, p.values]) for p in self.points])
        apart = every - np.concatenate([self.reported_point.others, self.reported_point.values])
        return np.asarray((apart * self.likelihood_share[:, None]).T @ apart)


def compute_profile(
    state: State, candidate: Candidate, effect_columns: slice | list[int]
) -> Profile | None:
    """Computes the likelihood along the nonlinear parameters of an effect; None without any.

    Args:
        state: the rows.
        candidate: the effect with the shapes that are reported.
        effect_columns: its columns in the state.
    """
    problem = ProfileProblem(state, candidate, effect_columns)
    smooth = [shape for shape in candidate.form.nonlinear_parameters if candidate.can_refine(shape)]
    values = candidate.nonlinear_parameters  # of the others only some values make sense
    others = [shape for shape in candidate.form.nonlinear_parameters if shape not in smooth]
    others = [s for s in others if len(s.grid) > 1 and values[s.name] in s.grid]
    fixed = {shape.name: shape.grid for shape in others}
    first = problem.fit_candidate(candidate)
    if first is None or not (smooth or fixed):
        return None
    factors = _compute_factors(problem, candidate, smooth, first)
    k = len(first.values)
    factor = float((factors[k:] if len(factors) > k else factors).max())
    points: list[ProfilePoint] = []
    for combination in itertools.product(*fixed.values()):
        chosen = dict(zip(fixed, combination, strict=True))
        here = replace(candidate, nonlinear_parameters={**candidate.nonlinear_parameters, **chosen})
        points += _scan_nonlinear(problem, here, smooth, first.squares, factor)
    points = [p for p in points if _is_possible(candidate, p)] or [first]
    return Profile(tuple(points), first, factors[:k], factor)


def polish_nonlinear_parameters(state: State, place: int) -> Candidate:
    """Returns an effect of a state at the least squares of its smooth shapes, by Gauss-Newton."""
    candidate = state.picks[place]
    problem = ProfileProblem(state, candidate, find_effect_columns(state, place))
    smooth = [shape for shape in candidate.form.nonlinear_parameters if candidate.can_refine(shape)]
    here = problem.fit_candidate(candidate)
    if here is None or not smooth:
        return candidate
    lines = [_build_line(problem.scale, candidate, shape) for shape in smooth]
    low, high = (np.array([line[end] for line in lines]) for end in (0, -1))
    for _ in range(THRESHOLDS.refinement_turns):
        columns, slopes = _compute_slopes(problem, candidate, smooth)
        step = np.linalg.lstsq(slopes, problem.compute_residual(columns @ here.values))[0]
        coded_values = np.clip(candidate.encode_parameters(smooth) + step, low, high)
        further = candidate.set_parameters(smooth, coded_values)
        there = problem.fit_candidate(further)
        if there is None or there.squares >= here.squares or not _is_possible(further, there):
            break
        candidate, here = further, there
    return candidate


def _is_possible(candidate: Candidate, point: ProfilePoint) -> bool:
    """False where physics forbids the sign of a value."""
    pairs = zip(point.values, candidate.form.columns, strict=False)
    return all(value >= 0.0 or not column.nonnegative for value, column in pairs)


def _scan_nonlinear(
    problem: ProfileProblem, start: Candidate, smooth: _Shapes, least: float, factor: float
) -> list[ProfilePoint]:
    """Points with weights, the smooth shapes over all that makes sense."""
    if not smooth:
        return [point for point in [problem.fit_candidate(start)] if point is not None]
    lines = [_build_line(problem.scale, start, shape) for shape in smooth]
    if len(smooth) == 1:

        def fit(x: float) -> ProfilePoint | None:
            return problem.fit_candidate(start.set_parameters(smooth, [x]))

        return _refine_line(fit, lines[0], least)
    return _scan_grid(problem, start, smooth, lines, THRESHOLDS.grid_reach * factor)


def _build_line(scale: JointScale, start: Candidate, shape: NonlinearParameter) -> list[float]:
    """Coded values of one shape to begin with, ascending; the reported one among them."""
    coded_value = encode_parameter(shape, start.nonlinear_parameters[shape.name])
    if shape.scale == "waves":
        count = THRESHOLDS.neighbouring_orders
        near = coded_value + np.pi / scale.range * np.linspace(-count, count, 4 * count + 1)
        return [float(m) for m in near if m > 0.0]
    entries = [scale.scale_value(shape, entry) for entry in (*shape.limits, *shape.grid)]
    low, high, *inner = (encode_parameter(shape, entry) for entry in entries)
    return sorted({low, high, *(x for x in (*inner, coded_value) if low < x < high)})


def _refine_line(
    at: Callable[[float], ProfilePoint | None], line: Sequence[float], least: float
) -> list[ProfilePoint]:
    """Points along one shape, closest where the likelihood is: the biggest cell is halved."""
    points_by_value = {x: at(x) for x in line}
    while len(points_by_value) < THRESHOLDS.max_line_points:
        x = np.array(sorted(points_by_value))
        points = [points_by_value[value] for value in x]
        squares = np.array([np.inf if point is None else point.squares for point in points])
        likely = np.exp(-0.5 * (squares - min(least, squares.min())))
        # a peak may hide between two points: cells count by their better end
        cells = np.diff(x) * np.maximum(likely[:-1], likely[1:])
        biggest = int(np.argmax(cells))
        ends = x[biggest], x[biggest + 1]
        middle = 0.5 * (ends[0] + ends[1])
        small = cells[biggest] < THRESHOLDS.max_cell_share * cells.sum()
        if not cells[biggest] > 0.0 or small or middle in ends:
            break
        points_by_value[middle] = at(middle)
    x = np.array(sorted(points_by_value))
    edges = np.concatenate([x[:1], 0.5 * (x[1:] + x[:-1]), x[-1:]])
    weighted_points = zip((points_by_value[value] for value in x), np.diff(edges), strict=True)
    return [replace(p, weight=float(w)) for p, w in weighted_points if p is not None]


def _scan_grid(
    problem: ProfileProblem,
    start: Candidate,
    smooth: _Shapes,
    lines: Sequence[Sequence[float]],
    reach: float,
) -> list[ProfilePoint]:
    """Points on a grid about the reported shapes, along the axes of the likelihood there."""
    middle = start.encode_parameters(smooth)
    low, high = (np.array([line[end] for line in lines]) for end in (0, -1))
    # a root of the covariance of the coded shapes, by the slopes of the columns
    _, slopes = _compute_slopes(problem, start, smooth)
    values, vectors = np.linalg.eigh(slopes.T @ slopes)
    floor = 1e-9 * max(float(values.max(initial=0.0)), 1e-300)
    axes = vectors / np.sqrt(np.maximum(values, floor)) * reach
    steps = np.linspace(-1.0, 1.0, THRESHOLDS.grid_points)
    places = [middle + axes @ np.array(z) for z in itertools.product(steps, repeat=len(smooth))]
    inside = [x for x in places if np.all((low <= x) & (x <= high))]
    points = [problem.fit_candidate(start.set_parameters(smooth, x)) for x in inside]
    return [point for point in points if point is not None]


def _compute_slopes(
    problem: ProfileProblem, candidate: Candidate, smooth: _Shapes
) -> tuple[np.ndarray, np.ndarray]:
    """Own columns, and slopes of the effect by its coded shapes, off all else; rows of all joints.

    The slopes are off the own columns too.
    """
    here = problem.fit_candidate(candidate)
    assert here is not None
    columns = problem.compute_residual_columns(candidate)
    middle, slope = candidate.encode_parameters(smooth), np.zeros((len(columns), len(smooth)))
    for i, step in enumerate(THRESHOLDS.slope_step * np.eye(len(smooth))):
        ends = (candidate.set_parameters(smooth, x) for x in (middle - step, middle + step))
        low, high = (problem.compute_residual_columns(end) @ here.values for end in ends)
        slope[:, i] = (high - low) / (2.0 * THRESHOLDS.slope_step)
    return columns, slope - columns @ np.linalg.lstsq(columns, slope, rcond=1e-9)[0]


def _compute_factors(
    problem: ProfileProblem, candidate: Candidate, smooth: _Shapes, first: ProfilePoint
) -> np.ndarray:
    """(k + s,) on the deviations of parameters and smooth shapes, 1 and more.

    Residuals are autocorrelated, and they are largest where an effect acts, in a few reversals,
    say. The
    larger of two estimates: by the autocorrelation of the residuals, and by their own sums over
    blocks of time, V = sum_b g_b g_b^T with g_b = sum_t u_t e_t, u_t the influence of a row on the
    parameters (White 1980, Econometrica 48(4); Arellano 1987).
    """
    columns, slopes = _compute_slopes(problem, candidate, smooth)
    left = problem.compute_residual(columns @ first.values)
    both = np.column_stack([columns, slopes])
    influence = both @ np.linalg.pinv(both.T @ both, rcond=1e-12, hermitian=True)
    white = np.sum(influence**2, axis=0)
    extra, segment = np.zeros(len(white)), problem.observation.segment
    joint, every = np.nonzero(problem.observation.used.T)
    for j in np.unique(joint):
        rows, sample = joint == j, every[joint == j]
        r = estimate_autocorrelation(left[rows], sample, segment)
        extra += np.diag(sum_lagged_products(influence[rows], r, sample, segment))
    number = build_time_blocks(problem.observation).number
    sums = np.zeros((number.max() + 1, len(white)))
    np.add.at(sums, number[every], influence * left[:, None])
    safe = np.where(white > 0.0, white, 1.0)
    ratio = np.maximum(1.0 + extra / safe, np.sum(sums**2, axis=0) / safe)
    return np.sqrt(np.maximum(ratio, 1.0))


# What people read of an effect that was found: names, values, deviations, units.


@dataclass(frozen=True)
class EffectEstimate:
    """The parameters of an effect by name, SI; nonlinear ones behind the others.

    Attributes:
        parameters: values.
        sigmas: standard deviations.
        intervals: 95 %; empty without nonlinear parameters.
        units: of all.
    """

    parameters: dict[str, float]
    sigmas: dict[str, float]
    intervals: dict[str, tuple[float, float]]
    units: dict[str, str]


def _name_values(
    state: State, pick: Candidate, values: np.ndarray, deviations: np.ndarray
) -> tuple[dict[str, float], dict[str, float], dict[str, str]]:
    """Values, deviations and units by name.

    A body on a link has its mass and the inertial parameters that have an effect on the robot; a
    tilted base the change of gravity in frame 0, m/s^2.
    """
    if pick.effect.acts is EffectTarget.GRAVITY:
        axes = compute_tilt_axes(state.reference)
        values, deviations = (x[: len(axes)] for x in (values, deviations))
        values, deviations = values @ axes, np.sqrt(deviations**2 @ axes**2)
        units = dict.fromkeys(("gx", "gy", "gz"), "m/s^2")
    elif pick.effect.acts is EffectTarget.LINK:
        specs = list_body_parameters(pick, state.rows.signals[0])
        names = (p.name.removesuffix(p.joint) for p in specs)
        units = {"mass" if n == "M" else n: p.unit for n, p in zip(names, specs, strict=True)}
    else:
        unit = "unit_prismatic" if is_prismatic(state.spec, pick.joint) else "unit_revolute"
        columns = zip(pick.list_parameter_names(), pick.form.columns, strict=True)
        units = {name: getattr(column, unit) for name, column in columns}
    value = dict(zip(units, map(float, values), strict=pick.elastic is None))
    return value, dict(zip(units, map(float, deviations), strict=False)), units


def name_parameters(state: State, pick: Candidate, values: np.ndarray) -> dict[str, float]:
    """Names the parameters of an effect of a state, values (k,) and nonlinear ones."""
    return _name_values(state, pick, values, 0.0 * values)[0] | dict(pick.nonlinear_parameters)


def estimate_effect(
    state: State, place: int, pick: Candidate, values: np.ndarray, deviations: np.ndarray
) -> EffectEstimate:
    """Estimates the parameters of an effect of a state, the nonlinear ones included.

    Args:
        state: with the effect.
        place: of it among the effects of the state.
        pick: it.
        values: of its columns.
        deviations: theirs, if it has no nonlinear parameters.
    """
    if pick.elastic is not None:
        value, sigmas = describe_elastic_joint(state.picks, pick)
        linear = is_prismatic(state.spec, pick.joint)
        units = {s.name: s.get_unit(linear) for s in pick.form.nonlinear_parameters}
        return EffectEstimate(value, sigmas, {}, units)
    along = compute_effect_profile(state, place)
    if along is not None:
        deviations = along.compute_deviations()
    value, sigmas, units = _name_values(state, pick, values, deviations)
    linear, intervals = is_prismatic(state.spec, pick.joint), {}
    if along is not None:
        ends = zip(value, along.compute_intervals().tolist(), strict=False)
        intervals = {name: (low, high) for name, (low, high) in ends}
        intervals |= along.compute_nonlinear_intervals()
        sigmas |= along.compute_nonlinear_deviations()
    units |= {shape.name: shape.get_unit(linear) for shape in pick.form.nonlinear_parameters}
    return EffectEstimate(value | dict(pick.nonlinear_parameters), sigmas, intervals, units)


def compute_effect_profile(state: State, place: int) -> Profile | None:
    """Computes the likelihood along the nonlinear parameters of an effect of a state.

    Args:
        state: with the effect.
        place: of it among the effects of the state.
    """
    return compute_profile(state, state.picks[place], find_effect_columns(state, place))


def find_effect_columns(state: State, place: int) -> slice:
    """Returns the columns of an effect of the state."""
    sizes = [len(values) for values in state.values]
    first = state.column_count - sum(sizes[place:])
    return slice(first, first + sizes[place])


def build_reduction_function(state: State, place: int) -> Callable[[Candidate], float]:
    """Builds the function from a candidate to the fall of S; 0 where physics forbids it."""
    problem = ProfileProblem(state, state.picks[place], find_effect_columns(state, place))

    def compute_reduction(candidate: Candidate) -> float:
        point = problem.fit_candidate(candidate)
        possible = point is not None and _is_possible(candidate, point)
        return problem.weighted_target[2] - point.squares if point is not None and possible else 0.0

    return compute_reduction


def is_prismatic(spec: ModuleSpec, joint: str | None) -> bool:
    """Returns whether a joint is prismatic."""
    return any(joint_spec.name == joint and joint_spec.unit == "m" for joint_spec in spec.joints)
