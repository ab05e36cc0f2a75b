"""One fit of a whole fleet: inertial parameters in common, friction, offset and gains by log.

Log k, joint j:  y_kj = W_j (theta + D phi_k) + gamma_kj W_j theta,  theta common to all logs.

phi_k are friction and offset in the log's own units of torque, gamma_kj the part by which its
torques exceed those of the fleet. theta comes from all logs with phi_k eliminated, by QR of
triangles; then each log is linear in phi_k and gamma_k. Torques of logs whose gain stands out are
scaled back, and theta is found again.
"""

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.brief import ShortRepr
from modeler.core.errors import DataError
from modeler.core.manifest import ModuleSpec
from modeler.estimation import solve_by_qr, solve_least_squares
from modeler.fleet.summary import LogSummary
from modeler.numerics.least_squares import compute_triangle, find_independent_columns

# What of a robot may drift, and what a fleet has in common.


GAIN, LOAD = "drive_gain", "payload"
"""Ids of the catalogue: what scales the torques of a joint, and what a link carries."""

_LOAD_ORDER = ("M", "MX", "MY", "MZ", "ZZ", "XX", "YY", "XY", "XZ", "YZ")
_SAME = 1e-8  # what is left of a column, as a share of its length, counts as zero


@dataclass(frozen=True)
class Quantity(ShortRepr):
    """What may drift.

    Attributes:
        effect: id of the catalogue.
        joint: name; None for a load.
        parameter: "Fv2"; "gain 2" and "load" are no parameters of the robot file.
        unit: of its value.
        column: base parameter; -1 for a gain or a load.
        place: index of the joint; -1 for a load.
        own: its column enters the torque of its joint only.
    """

    effect: str
    joint: str | None
    parameter: str
    unit: str
    column: int
    place: int
    is_of_joint: bool = True

    @property
    def description(self) -> str:
        """In words: "joint 2"."""
        return "the load" if self.joint is None else f"joint {self.joint}"


_LOAD = Quantity(LOAD, None, "load", "kg", -1, -1, is_of_joint=False)


@dataclass(frozen=True, eq=False)
class FleetLayout:
    """Columns of a fleet's equations; c base parameters, n joints.

    Attributes:
        drifting: friction and offsets, each its base parameter, then one gain per motor.
        common: (c,) True for base parameters that all machines share.
        load: (c, r) change of the base parameters by what the last link carries: mass first, then
            the other inertial parameters of that link that change it otherwise. r = 0 without.
    """

    drifting: tuple[Quantity, ...]
    common: np.ndarray
    load: np.ndarray

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """All that is looked at: what may drift, and a load if one can be told."""
        return (*self.drifting, _LOAD) if self.load.shape[1] else self.drifting

    @property
    def drift_columns(self) -> list[int]:
        """Base parameters that may drift."""
        return [q.column for q in self.drifting if q.column >= 0]

    @property
    def gain_joints(self) -> list[int]:
        """Joints that have a gain, in the order in which these stand."""
        return [q.place for q in self.drifting if q.effect == GAIN]


def build_layout(spec: ModuleSpec) -> FleetLayout:
    """What may drift of a robot."""
    joints = {joint.name: j for j, joint in enumerate(spec.joints)}
    standard = {parameter.name: parameter for parameter in spec.standard}
    drifting = []
    common = np.ones(len(spec.base), dtype=bool)
    for column, base in enumerate(spec.base):
        if base.kind not in ("friction", "offset"):
            continue
        common[column] = False
        whose = standard[base.column_of]
        place = joints.get(whose.joint, -1)
        drifting.append(
            Quantity(
                whose.effect,
                whose.joint,
                base.name,
                base.unit,
                column,
                place,
                is_of_joint=base.rows == (place,),
            )
        )
    if common.any():
        drifting += [
            Quantity(GAIN, joint.name, f"gain {joint.name}", "%", -1, j)
            for j, joint in enumerate(spec.joints)
            if joint.actuated
        ]
    return FleetLayout(tuple(drifting), common, _build_load_columns(spec))


def _build_load_columns(spec: ModuleSpec) -> np.ndarray:
    """(c, r), independent columns; none if the load's mass changes no base parameter."""
    closure = spec.closure
    link = spec.joints[-1].name if closure is None else closure.carrier or closure.variables[-1]
    columns: list[np.ndarray] = []
    basis = np.zeros((len(spec.base), 0))
    for letters in _LOAD_ORDER:
        column = np.array(
            [
                sum(term.value for term in base.terms if term.parameter == f"{letters}{link}")
                for base in spec.base
            ],
            dtype=float,
        )
        length = float(np.linalg.norm(column))
        if length == 0.0 and letters == "M":
            break
        rest = column / length if length > 0.0 else column
        for _ in range(2):
            rest = rest - basis @ (basis.T @ rest)
        if np.linalg.norm(rest) > _SAME:
            columns.append(column)
            basis = np.column_stack([basis, rest / np.linalg.norm(rest)])
    return np.column_stack(columns) if columns else np.zeros((len(spec.base), 0))


_ROUNDS = 3  # of theta and gains
_STANDS_OUT = 4.0  # sigmas, of a gain that is taken out of theta


@dataclass(frozen=True, eq=False)
class LogFit:
    """What a log deviates by; d unknowns, of which those that it cannot tell are NaN.

    Attributes:
        values: (d,) friction and offset in SI units, then gains as a share (0.05: 5 % more torque)
            or the load, mass in kg first.
        sigmas: (d,) their standard deviations, with what the residuals remember.
        misfit: sum over the joints of ||r_j||^2 / sigma_j^2, sigma of the log's own fit, and over
            the unknowns of what each takes off it by chance.
    """

    values: np.ndarray
    sigmas: np.ndarray
    misfit: float


@dataclass(frozen=True, eq=False)
class FleetFit:
    """The fit of the fleet.

    Attributes:
        theta: (c,) common parameters; 0 where a base parameter may drift.
        aside: names of common parameters that the logs cannot tell; 0.
        logs: with friction, offset and gains.
        loaded: with friction, offset and a load in place of gains; empty if none can be told.
    """

    theta: np.ndarray
    unidentified: tuple[str, ...]
    logs: tuple[LogFit, ...]
    load_fits: tuple[LogFit, ...]


def fit_fleet(layout: FleetLayout, summaries: Sequence[LogSummary]) -> FleetFit:
    """The fit of all logs together.

    Raises:
        DataError: the logs tell no common parameter, or nothing that may drift.
    """
    if not layout.drifting:
        raise DataError(
            "the robot file has no friction and no offset, and no torque that a gain could scale: "
            "nothing can drift; name viscous, coulomb and offset under [effects], or --effects"
        )
    sigmas = [solve_least_squares(each.data).sigma for each in summaries]
    scale = np.ones((len(summaries), len(summaries[0].data.rows)))
    for _ in range(_ROUNDS):
        theta, unidentified = _fit_common(layout, summaries, sigmas, scale)
        blocks = _build_gain_blocks(layout, theta, scale.shape[1])
        logs = _fit_logs(summaries, sigmas, theta, blocks)
        updated = _compute_scales(layout, logs, scale.shape)
        if np.allclose(updated, scale, rtol=0.0, atol=1e-6):
            break
        scale = updated
    load_fits: tuple[LogFit, ...] = ()
    if layout.load.shape[1]:  # every log with a load in place of gains
        blocks = [np.column_stack([_build_unit_columns(layout), layout.load])] * scale.shape[1]
        load_fits = _fit_logs(summaries, sigmas, theta, blocks)
    return FleetFit(theta, unidentified, logs, load_fits)


def _fit_common(
    layout: FleetLayout,
    summaries: Sequence[LogSummary],
    sigmas: Sequence[np.ndarray],
    scale: np.ndarray,
) -> tuple[np.ndarray, tuple[str, ...]]:
    """Theta (c,) of all logs with their friction and offsets eliminated, and what is set aside."""
    if not layout.common.any():
        return np.zeros(len(layout.common)), ()
    width, common = len(layout.common), np.flatnonzero(layout.common)
    order = [*layout.drift_columns, *common, width]
    whole = np.zeros((0, len(common) + 1))
    for each, sigma, log_scale in zip(summaries, sigmas, scale, strict=True):
        data = dataclasses.replace(each.data, triangles=each.data.triangles.copy())
        data.triangles[:, :, -1] /= log_scale[:, None]
        below = compute_triangle(data.combine_joints(sigma)[:, order])[len(layout.drift_columns) :]
        whole = compute_triangle(np.vstack([whole, below[:, len(layout.drift_columns) :]]))
    names = [summaries[0].data.names[i] for i in common]
    rank = find_independent_columns(whole[:, :-1], names)
    used_columns = list(rank.kept_columns)
    theta = np.zeros(width)
    if used_columns:
        theta[common[used_columns]] = solve_by_qr(whole[:, used_columns], whole[:, -1])[0]
    return theta, tuple(tangle.name for tangle in rank.dropped_columns)


Blocks = Sequence[np.ndarray]
"""(c, d) for each joint: what of its columns each of the d unknowns is."""


def _build_gain_blocks(layout: FleetLayout, theta: np.ndarray, joints: int) -> Blocks:
    """Friction, offset and gains."""
    unit_columns, nothing = _build_unit_columns(layout), np.zeros(len(theta))
    return [
        np.column_stack(
            [unit_columns, *(theta if place == j else nothing for place in layout.gain_joints)]
        )
        for j in range(joints)
    ]


def _build_unit_columns(layout: FleetLayout) -> np.ndarray:
    return np.eye(len(layout.common))[:, layout.drift_columns]


def _fit_logs(
    summaries: Sequence[LogSummary], sigmas: Sequence[np.ndarray], theta: np.ndarray, blocks: Blocks
) -> tuple[LogFit, ...]:
    pairs = zip(summaries, sigmas, strict=True)
    return tuple(_fit_log(each, sigma, theta, blocks) for each, sigma in pairs)


def _fit_log(each: LogSummary, sigma: np.ndarray, theta: np.ndarray, blocks: Blocks) -> LogFit:
    """Least squares of one log beside theta."""
    joint_sigma = sigma
    for _ in range(2):  # weights from the residuals of this very fit
        used_columns, values, root, left = _solve_log(each, joint_sigma, theta, blocks)
        spread = left / np.sqrt(np.maximum(each.data.rows - 1, 1))
        joint_sigma = np.maximum(spread, sigma)
    bread = root @ root.T
    middle = np.zeros_like(bread)
    for j, block in enumerate(blocks):
        z = block[:, used_columns]
        middle += z.T @ each.repeats[j] @ z / joint_sigma[j] ** 2
    white = np.diag(bread)
    ratio = np.maximum(1.0 + np.diag(bread @ middle @ bread) / white, 1.0)
    all_values, sigmas = (np.full(blocks[0].shape[1], np.nan) for _ in range(2))
    all_values[used_columns], sigmas[used_columns] = values, np.sqrt(white * ratio)
    return LogFit(all_values, sigmas, float(np.sum((left / sigma) ** 2) + ratio.sum()))


def _solve_log(
    each: LogSummary, sigma: np.ndarray, theta: np.ndarray, blocks: Blocks
) -> tuple[list[int], np.ndarray, np.ndarray, np.ndarray]:
    """Columns that can be told, their values, a root of (Z^T Z)^-1, and (n,) ||r_j||."""
    parts = [
        np.column_stack([R[:, :-1] @ block, R[:, -1] - R[:, :-1] @ theta])
        for R, block in zip(each.data.triangles, blocks, strict=True)
    ]
    whole = compute_triangle(np.vstack([part / s for part, s in zip(parts, sigma, strict=True)]))
    names = [str(i) for i in range(whole.shape[1] - 1)]
    used_columns = list(find_independent_columns(whole[:, :-1], names).kept_columns)
    if not used_columns:
        left = np.array([np.linalg.norm(part[:, -1]) for part in parts])
        return used_columns, np.zeros(0), np.zeros((0, 0)), left
    values, root = solve_by_qr(whole[:, used_columns], whole[:, -1])
    left = np.array([np.linalg.norm(p[:, -1] - p[:, used_columns] @ values) for p in parts])
    return used_columns, values, root, left


def _compute_scales(
    layout: FleetLayout, logs: Sequence[LogFit], shape: tuple[int, int]
) -> np.ndarray:
    """(logs, n) 1 + gain, of gains that stand out from the fleet."""
    scale = np.ones(shape)
    first = len(layout.drift_columns)
    gain = np.array([log.values[first:] for log in logs])
    sigma = np.array([log.sigmas[first:] for log in logs])
    for i, place in enumerate(layout.gain_joints):
        is_known = np.isfinite(gain[:, i])
        if not is_known.any():
            continue
        apart = gain[:, i] - np.median(gain[is_known, i])
        out = is_known & (np.abs(apart) > _STANDS_OUT * sigma[:, i])
        scale[out, place] = np.maximum(1.0 + apart[out], 0.1)
    return scale
