"""Has a machine changed between two sets of logs? One rule for `diagnose`, `compare` and `fleet`.

The logs before give parameters beta_a with their information P; the logs after their rows, by joint
j and block of time. What may have changed is a few columns C_j more:

    y_j = W_j (beta + C_j theta),  beta ~ N(beta_a, P^-1),

friction of a joint (its base parameters), an offset (a constant), the drive gain (C_j = beta_a of
that joint alone), a load (the base parameters that a body on the last link changes). Q is the sum
of squares that such a hypothesis leaves, rows of joint j weighed by 1 / (sigma_j^2 kappa_j), with
kappa_j how much more the fits to single blocks differ from the fit to all of them than white noise
lets expect (Chow 1960, Econometrica 28(3)): colour of the residual and what the model lacks raise
it. A fit of all that could change leaves the least, Q_free. The hypothesis of least Q and fewest
numbers wins; a second one joins it only where the first leaves a significant difference.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from modeler.core.json import Document, ShortRepr
from modeler.core.manifest import ModuleSpec
from modeler.core.table import format_percent
from modeler.estimation.model_file import IdentifiedModel
from modeler.estimation.payload import ORDER, find_carrier
from modeler.estimation.thresholds import THRESHOLDS
from modeler.numerics.least_squares import compute_column_norms
from modeler.regression import (
    THRESHOLDS as REGRESSION,
    BlockSums,
    Observation,
    compute_prior_weights,
    evaluate_columns_at,
    sum_joint_rows,
)


@dataclass(frozen=True)
class ParameterChange(Document):
    """A quantity that differs between two sets of logs of a machine.

    Attributes:
        name: of the parameter; "gain 2" or "load", which are none of the robot file.
        effect: id of the catalogue.
        joint: name; None for a load.
        before, after: value in either set; of a load the change of mass, of a gain the ratio of
            the torques.
        sigma_before, sigma_after: standard deviations of the first, and of the change.
        unit: of all four.
        share: rms torque of the change over that of the joint where it is largest.
    """

    KEYS = "name effect joint before after sigma_before sigma_after unit share"

    name: str
    effect: str
    joint: str | None
    before: float
    after: float
    sigma_before: float
    sigma_after: float
    unit: str
    share: float

    @property
    def is_clear(self) -> bool:
        """Returns whether it is surely there, and more than is normal for one machine."""
        change, limits, least = abs(self.after - self.before), THRESHOLDS, 0.0
        share = limits.min_changed_share
        if self.effect not in ("offset", "drive_gain", "payload"):
            least, share = limits.min_friction_change, limits.min_changed_friction_share
        large = change >= least * abs(self.before) and self.share >= share
        return large and change >= limits.min_change_t * self.sigma_after

    def describe(self) -> str:
        """Returns what changed, with its size: "Coulomb friction +70 % (0.42 -> 0.71 N m)"."""
        change = self.after - self.before
        if self.effect == "payload":
            return f"a load of {abs(change):.2g} kg {'less ' * (change < 0.0)}on the last link"
        if self.effect == "drive_gain":
            return f"drive gain {self.after:.3g} of what it was"
        if self.effect == "offset":
            return f"offset {change:+.2g} {self.unit}"
        words = _FRICTIONS.get(self.effect, self.effect.replace("_", " "))
        size = f"({self.before:.3g} -> {self.after:.3g} {self.unit})"
        if abs(self.before) < THRESHOLDS.min_change_t * self.sigma_before:
            return f"{words} {size}"
        percent = format_percent(abs(change / self.before), 2)
        return f"{words} {'+' if change > 0.0 else '-'}{percent} {size}"


_FRICTIONS = {"coulomb": "Coulomb friction", "viscous": "viscous friction"}


@dataclass(frozen=True, eq=False)
class MachineComparison(ShortRepr):
    """What differs between two sets of logs.

    Attributes:
        changes: that explain the difference, largest first.
        unexplained: joints where the sets differ and no change of the known kinds explains it; then
            none is named.
        torque_columns: (J, c + 1) what the columns of each joint, and a constant, carry of the
            named changes in the logs after.
        likeliest: effect that alone explains most, however little it is.
    """

    changes: tuple[ParameterChange, ...]
    unexplained: tuple[str, ...]
    torque_columns: np.ndarray
    likeliest: str

    @property
    def differs(self) -> bool:
        """Returns whether the two sets are of different machines."""
        return bool(self.changes or self.unexplained)

    def describe(self, sets: str) -> list[str]:
        """Returns a sentence for each place that changed, or one where nothing explains it.

        Args:
            sets: which logs are compared: "A and B".
        """
        lines = []
        for place in dict.fromkeys(change.joint for change in self.changes):
            some = [each.describe() for each in self.changes if each.joint == place]
            where = "" if place is None else f"joint {place}: "
            lines.append(f"changed between {sets}: {where}{', '.join(some)}")
        if self.unexplained:
            joints = f"joint{'s' * (len(self.unexplained) > 1)} {', '.join(self.unexplained)}"
            lines.append(
                f"{joints}: {sets} differ, and no change of friction, offset, drive gain or load "
                "explains it"
            )
        return lines


# The two sets: a fit of their own, and rows by joint and block of time.


@dataclass(frozen=True, eq=False)
class SingleFit(ShortRepr):
    """A fit of one set of logs: beta (c,), its information (c, c), sigma (J,) of the rows."""

    beta: np.ndarray
    information: np.ndarray
    sigma: np.ndarray


def sum_observation(observation: Observation) -> BlockSums:
    """Returns the normal equations of an observation, with a constant of each joint as last column.

    Of long ones, evenly spread samples.
    """
    count = min(len(observation.time), THRESHOLDS.max_compared_samples)
    places = np.linspace(0, len(observation.time) - 1, count).astype(int)
    columns, used = evaluate_columns_at(observation, places), observation.used[places]
    used = used & np.isin(range(used.shape[1]), observation.driven)
    W = [columns[rows, j] for j, rows in enumerate(used.T)]
    y = [observation.torque[places][rows, j] for j, rows in enumerate(used.T)]
    return sum_machine_rows(W, y, used, compute_prior_weights(observation))


def sum_machine_rows(
    W: Sequence[np.ndarray], y: Sequence[np.ndarray], used: np.ndarray, prior: np.ndarray
) -> BlockSums:
    """Returns the normal equations of rows W_j (rows_j, c), y_j of the samples used (s, J)."""
    blocks = np.arange(len(used)) * REGRESSION.time_blocks // max(len(used), 1)
    both = [np.column_stack([w, np.ones(len(w))]) for w in W]
    wide = np.zeros(both[0].shape[1])
    wide[: len(prior)] = prior
    numbers = [blocks[rows] for rows in used.T]
    return sum_joint_rows(both, y, numbers, wide)


def merge_sums(parts: Sequence[BlockSums]) -> BlockSums:
    """Returns the normal equations of several logs together, block by block."""
    names = ("gram", "cross", "squares", "count")
    return replace(parts[0], **{n: sum(getattr(part, n) for part in parts) for n in names})


def fit_machine(sums: BlockSums) -> SingleFit:
    """Returns the fit of a set of logs, without the constants."""
    fit = _FreeFit(sums, [np.eye(sums.gram.shape[-1])[:, :-1]] * len(sums.gram))
    return SingleFit(fit.solution, fit.normal, fit.sigma)


def convert_model_fit(model: IdentifiedModel) -> SingleFit:
    """Returns the fit of a model as that of one set of logs, with the covariance that it states."""
    covariance = np.nan_to_num(model.covariance)
    known = np.diag(covariance) > 0.0
    information = np.where(np.outer(known, known), _invert(covariance), 0.0)
    sigmas = {joint.name: joint.sigma for joint in model.fit.joints}
    sigma = np.array([sigmas.get(joint.name, 0.0) for joint in model.spec.joints])
    return SingleFit(model.beta, information, sigma)


class _FreeFit:
    """A weighted fit y_j = W_j M_j x with M_j (c + 1, d) of each joint, weights iterated."""

    def __init__(self, sums: BlockSums, maps: Sequence[np.ndarray]) -> None:
        gram, cross = sums.gram.sum(axis=1), sums.cross.sum(axis=1)
        squares, count = sums.squares.sum(axis=1), sums.count.sum(axis=1)
        prior = np.zeros(maps[0].shape[1])
        base = min(len(prior), len(sums.prior))
        prior[:base] = sums.prior[:base] ** 2
        products = np.stack([m.T @ g @ m for m, g in zip(maps, gram, strict=True)])
        sides = np.stack([m.T @ x for m, x in zip(maps, cross, strict=True)])
        driven, left = squares > 0.0, squares
        for _ in range(REGRESSION.block_reweightings):
            weights = np.where(driven, count / np.maximum(left, 1e-300), 0.0)
            self.normal = np.diag(prior) + np.tensordot(weights, products, 1)
            self.solution = _invert(self.normal) @ (weights @ sides)
            columns = np.stack([m @ self.solution for m in maps])
            left = np.maximum(_sum_squares(squares, cross, gram, columns), 1e-12 * squares)
        self.sigma = np.sqrt(left / np.maximum(count, 1))
        excess = np.array([_compute_excess(sums, j, columns[j]) for j in range(len(gram))])
        variance = np.maximum(np.maximum(excess, self.sigma**2), 1e-300)
        self.weights = np.where(driven, 1.0 / variance, 0.0)
        self.normal = np.diag(prior) + np.tensordot(self.weights, products, 1)
        self.misfit = float(self.weights @ left)


def _invert(gram: np.ndarray) -> np.ndarray:
    """Returns the inverse of a Gram matrix, 0 along what it does not determine."""
    size = np.sqrt(np.maximum(np.diag(gram), 0.0))
    size[size == 0.0] = 1.0
    scale = np.outer(size, size)
    return np.linalg.pinv(gram / scale, rcond=THRESHOLDS.change_tolerance, hermitian=True) / scale


def _sum_squares(
    squares: np.ndarray, cross: np.ndarray, gram: np.ndarray, beta: np.ndarray
) -> np.ndarray:
    """Returns (J,) ||y_j - W_j beta_j||^2 of beta (J, c)."""
    linear = np.einsum("jc,jc->j", cross, beta)
    return np.asarray(squares - 2.0 * linear + np.einsum("jc,jcd,jd->j", beta, gram, beta))


def _compute_excess(sums: BlockSums, j: int, beta: np.ndarray) -> float:
    """Returns what fits to single blocks take off the squares, each number of theirs, N^2 m^2."""
    total, ranks = 0.0, []
    for gram, cross in zip(sums.gram[j], sums.cross[j], strict=True):
        size = compute_column_norms(np.sqrt(np.diag(gram))[None])
        values, vectors = np.linalg.eigh(gram / np.outer(size, size))
        clear = values > THRESHOLDS.min_block_eigenvalue * max(values[-1], 1e-300)
        part = vectors[:, clear].T @ ((cross - gram @ beta) / size)
        total += float(np.sum(part**2 / values[clear]))
        ranks.append(int(clear.sum()))
    return total / max(sum(ranks) - max(ranks), 1)


# What may have changed.


@dataclass(frozen=True, eq=False)
class _Hypothesis:
    """What may have changed: columns C_j (J, c + 1, d), and what they are, as it was before."""

    columns: np.ndarray
    parameters: tuple[ParameterChange, ...]


def _propose_changes(spec: ModuleSpec, before: SingleFit) -> list[_Hypothesis]:
    joints, unit = len(spec.joints), np.eye(len(before.beta) + 1)
    deviations = np.sqrt(np.diag(_invert(before.information)))
    standard = {p.name: p for p in spec.standard}
    bases: dict[tuple[str, str], dict[int, ParameterChange]] = {}
    for i, base in enumerate(spec.base):
        whose, ends = standard[base.column_of], (float(before.beta[i]),) * 2
        names = base.name, whose.effect, whose.joint
        change = ParameterChange(*names, *ends, float(deviations[i]), 0.0, base.unit, 0.0)
        bases.setdefault((base.kind, whose.joint), {})[i] = change
    proposed = [
        _Hypothesis(np.stack([unit[:, list(some)]] * joints), tuple(some.values()))
        for (kind, _), some in bases.items()
        if kind == "friction"
    ]
    for j, joint in enumerate(spec.joints):
        name, zero, one = joint.name, (0.0,) * 4, (1.0, 1.0, 0.0, 0.0)
        offset = ParameterChange(f"Off{name}", "offset", name, *zero, joint.effort_unit, 0.0)
        offset = next(iter(bases.get(("offset", name), {}).values()), offset)
        gain = ParameterChange(f"gain {name}", "drive_gain", name, *one, "1", 0.0)
        for change, column in ((offset, unit[-1]), (gain, np.append(before.beta, 0.0))):
            columns = np.zeros((joints, len(unit), 1))
            columns[j, :, 0] = column
            proposed.append(_Hypothesis(columns, (change,)))
    load = build_load_columns(spec)
    if load.shape[1]:
        load = np.pad(load, ((0, len(unit) - len(load)), (0, 0)))
        change = ParameterChange("load", "payload", None, 0.0, 0.0, 0.0, 0.0, "kg", 0.0)
        proposed.append(_Hypothesis(np.stack([load] * joints), (change,)))
    return proposed


def build_load_columns(spec: ModuleSpec) -> np.ndarray:
    """Returns (c, r) what a body on the last link changes of the base parameters, by its numbers.

    Mass first, then the others that change them otherwise; none if its mass changes none.
    """
    link, columns = find_carrier(spec), np.zeros((len(spec.base), 0))
    for letters in ORDER:
        terms = ([t.value for t in b.terms if t.parameter == f"{letters}{link}"] for b in spec.base)
        column = np.array([sum(values) for values in terms], dtype=float)
        if not column.any():
            if letters == "M":
                break
            continue
        rest = column - columns @ np.linalg.lstsq(columns, column)[0]
        if np.linalg.norm(rest) > THRESHOLDS.column_tolerance * np.linalg.norm(column):
            columns = np.column_stack([columns, column])
    return columns


@dataclass(frozen=True, eq=False)
class _Fit:
    """Hypotheses fitted together.

    Attributes:
        hypotheses: that may differ.
        misfit: Q.
        theta: (d,) their numbers; sigma (d,) of these.
        torque_columns: (J, c + 1) what they carry of the columns of each joint.
        squares: (J,) of the rows that beta and they leave.
    """

    hypotheses: tuple[_Hypothesis, ...]
    misfit: float
    theta: np.ndarray
    sigma: np.ndarray
    torque_columns: np.ndarray
    squares: np.ndarray


class _Evidence:
    """The logs after, with what a fit to those before expects of them."""

    def __init__(self, spec: ModuleSpec, before: SingleFit, after: BlockSums) -> None:
        self.spec, self.before, self.gram = spec, before, after.gram.sum(axis=1)
        cross, beta = after.cross.sum(axis=1), np.append(before.beta, 0.0)
        self.torque_squares, self.count = after.squares.sum(axis=1), after.count.sum(axis=1)
        joints, width = cross.shape
        maps = []
        for j in range(joints):  # every parameter, constant and gain may differ
            beside = np.zeros((width, 2 * joints))
            beside[-1, j], beside[:, joints + j] = 1.0, beta
            maps.append(np.column_stack([np.eye(width)[:, :-1], beside]))
        self.free = _FreeFit(after, maps)
        self.weights = self.free.weights
        self.cross = cross - self.gram @ beta
        at_beta = np.tile(beta, (joints, 1))
        squares = _sum_squares(self.torque_squares, cross, self.gram, at_beta)
        self.squares = np.maximum(squares, 0.0)
        normal = before.information + np.tensordot(self.weights, self.gram[:, :-1, :-1], 1)
        self.inverse = _invert(normal)
        self.side = self.weights @ self.cross[:, :-1]
        self.chance_misfit = THRESHOLDS.max_chance_misfit * len(before.beta)

    def measure(self, columns: np.ndarray) -> float:
        """Returns the largest `limit_shares` of columns (J, c + 1)."""
        square = np.einsum("jc,jcd,jd->j", columns, self.gram, columns)
        return float(np.max(self.limit_shares(square)))

    def limit_shares(self, squares: np.ndarray) -> np.ndarray:
        """Returns (J,) the rms torque over that of the joint; 0 where noise may look so.

        Noise of the motion makes fitted values smaller by about the square of the relative error.
        """
        size = np.maximum(self.torque_squares, 1e-300)
        share = np.sqrt(np.maximum(squares, 0.0) / size)
        noise = np.maximum(self.free.sigma, self.before.sigma) ** 2 * self.count / size
        return np.where(share >= THRESHOLDS.max_attenuation * noise, share, 0.0)

    def fit(self, hypotheses: Sequence[_Hypothesis]) -> _Fit:
        """Returns the fit of beta, and of what these hypotheses let differ."""
        joints, width = self.cross.shape
        empty = np.zeros((joints, width, 0))
        C = np.concatenate([empty, *(each.columns for each in hypotheses)], axis=2)
        products = self.gram @ C
        beside = np.tensordot(self.weights, products[:, :-1], 1)  # (c, d)
        within = np.einsum("j,jcd,jce->de", self.weights, C, products)
        inverse = _invert(within - beside.T @ self.inverse @ beside)
        step = self.inverse @ self.side
        side = np.einsum("j,jcd,jc->d", self.weights, C, self.cross) - beside.T @ step
        theta = inverse @ side
        moved = self.inverse @ (self.side - beside @ theta)
        changed = C @ theta
        misfit = float(self.weights @ self.squares - self.side @ step - side @ theta)
        left = _sum_squares(self.squares, self.cross, self.gram, changed + np.append(moved, 0.0))
        sigma = np.sqrt(np.maximum(np.diag(inverse), 0.0))
        return _Fit(tuple(hypotheses), misfit, theta, sigma, changed, left)

    def select_best(self, fits: Sequence[_Fit]) -> _Fit:
        """Returns the fit that leaves least, by the fewest numbers."""
        each = THRESHOLDS.misfit_per_number
        return min(fits, key=lambda fit: fit.misfit + each * len(fit.theta))


def compare_machines(spec: ModuleSpec, before: SingleFit, after: BlockSums) -> MachineComparison:
    """Decides whether a machine changed between two sets of logs, and what of it.

    Args:
        spec: of the robot; columns after its base parameters are common to both sets.
        before: the fit of one set.
        after: the other, of `sum_observation` or `sum_machine_rows`.
    """
    seen = _Evidence(spec, before, after)
    proposed = _propose_changes(spec, before)
    best = seen.select_best([seen.fit([each]) for each in proposed])
    likeliest = best.hypotheses[0].parameters[0].effect
    fit = _select_changes(seen, proposed)
    nothing = np.zeros_like(fit.torque_columns)
    torque = np.sqrt(after.squares.sum(axis=-1) / np.maximum(after.count.sum(axis=-1), 1))
    described = before.sigma <= THRESHOLDS.max_compared_error * torque
    if not described[seen.weights > 0.0].all():  # other motion differs as much
        return MachineComparison((), (), nothing, likeliest)
    if unexplained := _find_unexplained(seen, fit):
        return MachineComparison((), unexplained, nothing, likeliest)
    explains = seen.fit(()).misfit - fit.misfit >= THRESHOLDS.min_change_misfit
    changes = [each for each in _list_changes(seen, fit) if explains and each.is_clear]
    changes.sort(key=lambda change: -change.share)
    columns = fit.torque_columns if changes else nothing
    return MachineComparison(tuple(changes), (), columns, likeliest)


def _select_changes(seen: "_Evidence", proposed: Sequence[_Hypothesis]) -> _Fit:
    """Returns the fit of what changed, one hypothesis after the other; without any, of none."""
    best, limits = seen.fit(()), THRESHOLDS
    least = limits.min_explained_misfit * (best.misfit - seen.free.misfit)
    for _ in range(min(limits.max_changes, len(proposed))):
        if best.misfit <= seen.free.misfit + seen.chance_misfit:
            break
        others = [each for each in proposed if each not in best.hypotheses]
        next_fit = seen.select_best([seen.fit([*best.hypotheses, each]) for each in others])
        if best.misfit - next_fit.misfit < max(limits.min_further_misfit, least):
            break
        best = next_fit
    return best


def _find_unexplained(seen: _Evidence, fit: _Fit) -> tuple[str, ...]:
    """Returns the joints whose rows a fit leaves much larger than fits of the sets of their own."""
    if fit.misfit <= seen.free.misfit + 2.0 * seen.chance_misfit:
        return ()
    alone = np.maximum(seen.free.sigma, seen.before.sigma) ** 2 * seen.count
    large = fit.squares > THRESHOLDS.min_unexplained_ratio**2 * alone
    shares = seen.limit_shares(fit.squares - alone)
    large &= (seen.weights > 0.0) & (shares >= THRESHOLDS.min_changed_share)
    return tuple(seen.spec.joints[j].name for j in np.flatnonzero(large))


def _list_changes(seen: _Evidence, fit: _Fit) -> Iterator[ParameterChange]:
    """Yields the quantities that a fit lets differ."""
    first = 0
    for each in fit.hypotheses:
        count, alone = each.columns.shape[2], len(each.parameters) == 1
        theta, sigma = (x[first : first + count] for x in (fit.theta, fit.sigma))
        first += count
        for k, change in enumerate(each.parameters):
            part = slice(None) if alone else slice(k, k + 1)
            share = seen.measure(each.columns[:, :, part] @ theta[part])
            after = change.before + float(theta[k])
            yield replace(change, after=after, sigma_after=float(sigma[k]), share=share)
