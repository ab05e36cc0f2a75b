"""Logs of a fleet: their names, their summaries, and one fit of all."""

import csv
import dataclasses
import itertools
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from modeler.core.errors import DataError, LoopError
from modeler.core.files import read_text
from modeler.core.json import ShortRepr, parse_toml
from modeler.core.manifest import EmittedModule, ModuleSpec
from modeler.estimation import (
    build_load_columns,
    estimate_correlation,
    find_contradictions,
    find_disconnected_joints,
    find_log_faults,
    identify,
    solve_by_qr,
    solve_least_squares,
    sum_lagged_products,
    sum_observation,
)
from modeler.logs import LogMap
from modeler.numerics.least_squares import (
    CompressedRegression,
    compress_rows,
    compute_triangle,
    find_independent_columns,
)
from modeler.regression import (
    BlockSums,
    Log,
    Observation,
    Processing,
    cut_window,
    observe,
    read_log,
)
from modeler.runtime import CompiledModel, load_cached_model


@dataclass(frozen=True)
class FleetThresholds:
    """Holds the numbers that decide; a docstring below each gives unit and reason."""

    trimmed_share: float = 0.8
    """Share of the changes, the smaller ones, that estimate the scatter. No study."""
    degrees_per_change: float = 0.4
    """Degrees of freedom of a change of a trimmed series with shared periods. No study."""
    max_prior_degrees: float = 12.0
    """Degrees of freedom that other quantities may stand for. No study."""
    min_machines: int = 5
    """Machines from which an outlier can be identified."""
    machines_per_outlier: int = 5
    """Machines for each possible outlier."""
    max_outliers: int = 3
    """Outliers of a fleet."""
    max_sigma_ratio: float = 5.0
    """Sigma of a machine over that of the others, above which it is reported. No study."""
    min_changes: int = 5
    """Changes from period to period that determine a scatter. No study."""
    min_temperature_span: float = 2.0
    """K; a smaller span is no warming."""
    min_temperature_share: float = 0.8
    """Of what the shape of a finding explains, that the temperature must explain too. No study."""
    min_temperature_variance: float = 0.5
    """Share of the variance that the temperature must explain. No study."""
    min_warmed_machines: int = 3
    """Other machines that must warm up to confirm the cause."""
    min_shared_change: float = 0.5
    """Of the change per kelvin, that others must show. No study."""
    fit_rounds: int = 3
    """Iterations of common parameters and gains."""
    min_gain_t: float = 4.0
    """Standard deviations of a gain that is taken out of the common parameters. No study."""
    false_alarm: float = 0.05
    """Chance of any finding in a fleet without drift: half for drifts, half for outliers."""


FLEET_THRESHOLDS = FleetThresholds()


PATTERN = "{machine}/{period}.*"
"""How logs are named where nobody says it: the folder is the machine, the file the period."""

_FIELD = re.compile(r"(\{[^{}]*\}|\*)")
_COLUMNS = ("machine", "period", "log")


@dataclass(frozen=True)
class LogName:
    """A log with its names.

    Attributes:
        machine: which of the robots.
        period: when, as a day or a number; unique within the machine.
        place: as it was given, FILE or FILE@START:END.
    """

    machine: str
    period: str
    place: str


def name_logs(places: Sequence[tuple[str, str]], pattern: str | None = None) -> tuple[LogName, ...]:
    """Names logs by machine and period, those of one machine together, in natural order.

    A log that the pattern does not fit is an error: a log that is left out unsaid looks like a
    machine that is well.

    Args:
        places: (file, window) of each log; window "" or "0:10".
        pattern: of the end of the path, with {machine} and {period}; `*` is any text without a
            slash. None: the folder is the machine, the name of the file without ending the period.

    Raises:
        DataError: no such pattern, a path that it does not fit, or two logs of one machine and
            period.
    """
    expression = re.compile(_build_expression(PATTERN if pattern is None else pattern))
    log_names = []
    for place, window in places:
        at = f"@{window}" if window else ""
        path = Path(place)
        text = (path if path.parent.name else path.absolute()).as_posix()
        match = expression.search(text)
        if match is None:
            raise DataError(
                f"{place}: does not fit --name {pattern or PATTERN}; expected a path that ends so; "
                "give another pattern, or a --list"
            )
        parts = match.groupdict()
        machine = parts.get("machine") or path.absolute().parent.name
        log_names.append(LogName(machine, (parts.get("period") or path.stem) + at, place + at))
    return arrange_logs(log_names)


def arrange_logs(log_names: Iterable[LogName]) -> tuple[LogName, ...]:
    """Arranges logs by machine and period; numbers within names count as numbers.

    Raises:
        DataError: two logs of one machine and period.
    """
    ordered = sorted(
        log_names, key=lambda log: list(map(make_natural_key, (log.machine, log.period)))
    )
    for one, other in itertools.pairwise(ordered):
        if (one.machine, one.period) == (other.machine, other.period):
            raise DataError(
                f"{other.place}: machine {one.machine}, period {one.period}, which {one.place} is "
                "too; expected one log each; rename one, or name the periods apart with --name or "
                "--list"
            )
    return tuple(ordered)


def make_natural_key(text: str) -> list[tuple[int, int, str]]:
    """Makes a key that sorts day2 before day10."""
    parts = filter(None, re.split(r"(\d+)", text))
    return [(0, int(part), part) if part.isdecimal() else (1, 0, part) for part in parts]


def _build_expression(pattern: str) -> str:
    """The regular expression of a pattern, for the end of a path."""
    parts, fields = [], set()
    for piece in _FIELD.split(pattern):
        if piece in ("{machine}", "{period}") and piece not in fields:
            fields.add(piece)
            parts.append(f"(?P<{piece[1:-1]}>[^/]+)")
        elif piece == "*":
            parts.append("[^/]*")
        elif "{" in piece or "}" in piece:
            what = "twice" if piece in fields else "which says nothing"
            raise DataError(
                f"--name {pattern}: got {piece}, {what}; expected {{machine}} and {{period}}, each "
                f"once at most, as in {PATTERN}"
            )
        else:
            parts.append(re.escape(piece))
    if not fields:
        raise DataError(
            f"--name {pattern}: neither {{machine}} nor {{period}} stands in it; expected a "
            f"pattern such as {PATTERN}"
        )
    if "{period}" not in fields:
        raise DataError(
            f"--name {pattern}: no {{period}} stands in it; expected one, as in {PATTERN}"
        )
    return f"(?:^|/){''.join(parts)}$" if not pattern.startswith("/") else f"^{''.join(parts)}$"


def read_log_list(path: Path) -> tuple[LogName, ...]:
    """Reads a list of logs: CSV with machine, period, log; or TOML with [[log]] tables.

    Places are relative to the folder of the list.

    Raises:
        DataError: it cannot be read, or an entry is missing; says where.
    """
    try:
        text = read_text(path)
    except OSError as error:
        raise DataError(
            f"{path}: cannot be read ({error.strerror}); expected a list of logs"
        ) from None
    except UnicodeDecodeError:
        raise DataError(f"{path}: no text; expected a list of logs, .csv or .toml") from None
    read_rows = _read_toml_rows if path.suffix.lower() == ".toml" else _read_csv_rows
    rows = read_rows(path, text)
    if not rows:
        raise DataError(f"{path}: no logs in it; expected rows of machine, period, log")
    places = ((machine, period, str(path.parent / log)) for machine, period, log in rows)
    return arrange_logs(LogName(*row) for row in places)


def _read_csv_rows(path: Path, text: str) -> list[tuple[str, ...]]:
    reader = csv.DictReader(text.splitlines(), skipinitialspace=True)
    missing = [name for name in _COLUMNS if name not in (reader.fieldnames or ())]
    if missing:
        raise DataError(
            f"{path}: no column {missing[0]} in its first line; expected {', '.join(_COLUMNS)}"
        )
    return [_check_row(path, f"line {reader.line_num}", row) for row in reader]


def _read_toml_rows(path: Path, text: str) -> list[tuple[str, ...]]:
    try:
        entries = parse_toml(text).get("log", [])
    except ValueError as error:
        raise DataError(f"{path}: {error}; expected TOML with [[log]] tables") from None
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise DataError(f"{path}: log is no list of tables; expected [[log]] before each log")
    return [_check_row(path, f"log {k}", entry) for k, entry in enumerate(entries, start=1)]


def _check_row(path: Path, where: str, row: dict) -> tuple[str, ...]:
    values = tuple("" if row.get(name) is None else str(row[name]).strip() for name in _COLUMNS)
    for name, value in zip(_COLUMNS, values, strict=True):
        if not value:
            raise DataError(f"{path}, {where}: no {name}; expected machine, period and log")
    return values


TEMPERATURE = "temperature"
"""How the names of columns of temperatures begin; the rest is the joint, or nothing."""


@dataclass(frozen=True, eq=False)
class LogJob:
    """What a worker needs to reduce a log; it can be sent to another process or machine.

    Attributes:
        log_name: machine, period and place.
        path: the file.
        span: seconds of it that count; None: all.
        processing: None: chosen from this log.
        mapping: which column of the logs is which quantity.
    """

    log_name: LogName
    path: str
    span: tuple[float | None, float | None] | None
    processing: Processing | None = None
    mapping: LogMap | None = None


@dataclass(frozen=True, eq=False)
class LogSummary:
    """A log, reduced; n joints, c base parameters.

    Attributes:
        log_name: machine, period and place.
        content: fingerprint of the file's measurements.
        span: first and last time, s.
        samples: after decimation.
        data: triangles of [W_j y_j], joint by joint; those of a dead joint are 0.
        sums: normal equations by block of time, of `compare_machines`.
        repeats: (n, c, c) sum_k r_j(k) sum_t w_j(t) w_j(t + k)^T + transpose, see `coloured`.
        temperatures: mean of each column, by the joint that its name ends in; "" for all.
        processing: with all choices filled in.
        doubts: what is wrong with the measurements.
        extra_joints: joints with a position and a torque that the robot has not.
    """

    log_name: LogName
    content: str
    span: tuple[float, float]
    samples: int
    data: CompressedRegression
    sums: BlockSums
    repeats: np.ndarray
    temperatures: Mapping[str, float] = field(default_factory=dict)
    processing: Processing | None = None
    doubts: tuple[str, ...] = ()
    extra_joints: tuple[str, ...] = ()


@dataclass(frozen=True)
class SkippedLog:
    """A log that could not be used, and why."""

    log_name: LogName
    reason: str


def reduce_log(emitted: EmittedModule, job: LogJob) -> LogSummary | SkippedLog:
    """Reduces one log to its summary; it can run anywhere and be run again.

    Args:
        emitted: the C of the robot, which is compiled here, or taken from the cache.
        job: of the log.
    """
    model = load_cached_model(emitted)
    try:
        log = read_log(job.path, model.spec, job.mapping)
        if job.span is not None:
            log = cut_window(log, *job.span)
        return summarise_log(model, log, job.log_name, job.processing)
    except (DataError, LoopError) as error:
        return SkippedLog(job.log_name, str(error))


def summarise_log(
    model: CompiledModel, log: Log, log_name: LogName, processing: Processing | None = None
) -> LogSummary:
    """Summarises a log that was read.

    Raises:
        ModelerError: it has no usable rows, or significantly contradicts the robot.
    """
    observation = observe(model, [log], processing)
    dead = find_disconnected_joints(observation)
    alive = ~np.isin(observation.row_joint, dead)
    W, y, joint = observation.W[alive], observation.y[alive], observation.row_joint[alive]
    if len(y) < W.shape[1]:
        raise DataError(f"{log.name}: {len(y)} rows for {W.shape[1]} parameters; record more")
    free = [j for j, each in enumerate(observation.joints) if not each.actuated]
    data = compress_rows(W, y, joint, len(observation.joints), observation.names, free)
    result = identify(observation, "weighted", model)
    findings = find_log_faults(model, observation)
    against = find_contradictions(model, observation, result, findings, data)
    if against:  # certainly not usable: its deviations would say anything
        raise DataError(f"{log_name.place}: does not fit {model.spec.robot}: {against[0]}")
    residual = y - W @ solve_least_squares(data).beta
    doubts = [f"joint {observation.joints[j].name}: its torque is 0 throughout" for j in dead]
    return LogSummary(
        log_name=log_name,
        content=log.content,
        span=(float(log.time[0]), float(log.time[-1])),
        samples=len(observation.time),
        data=data,
        sums=sum_observation(observation),
        repeats=_compute_repeats(observation, W, joint, observation.row_sample[alive], residual),
        temperatures={
            name.removeprefix(TEMPERATURE): float(np.mean(values))
            for name, values in log.extra.items()
            if name.startswith(TEMPERATURE)
        },
        processing=observation.report.processing,
        doubts=(*observation.report.collect_warnings(), *doubts),
        extra_joints=_find_extra_joints(log.extra),
    )


def _compute_repeats(
    observation: Observation,
    W: np.ndarray,
    joint: np.ndarray,
    sample: np.ndarray,
    residual: np.ndarray,
) -> np.ndarray:
    repeats = np.zeros((len(observation.joints), W.shape[1], W.shape[1]))
    for j in range(len(observation.joints)):
        is_of_joint = joint == j
        if is_of_joint.any():
            r = estimate_correlation(observation, residual[is_of_joint], sample[is_of_joint])
            samples = sample[is_of_joint]
            repeats[j] = sum_lagged_products(W[is_of_joint], r, samples, observation.segment)
    return repeats


def _find_extra_joints(columns: Iterable[str]) -> tuple[str, ...]:
    """Joints with a position and a torque among columns that are none of the robot's."""
    names = set(columns)
    return tuple(sorted(name[1:] for name in names if name[0] == "q" and f"tau{name[1:]}" in names))


# Logs that hold channels of joints which the robot has not: of another robot, it seems.


def separate_foreign_logs(
    used: Sequence[LogSummary],
) -> tuple[list[LogSummary], list[SkippedLog], list[str]]:
    """Separates the logs to compare from those of another robot; describes doubtful ones.

    A log with positions and torques of more joints than the robot has is left out where more than
    half of all logs have other joints than it; where no such half is, or it has them too, it is
    reported.
    """
    kinds = Counter(each.extra_joints for each in used)
    usable, left, places_by_joints = [], [], dict[tuple[str, ...], list[str]]()
    for each in used:
        others = max((n for joints, n in kinds.items() if joints != each.extra_joints), default=0)
        if each.extra_joints and 2 * others > len(used):
            why = (
                f"has joint{'s' * (len(each.extra_joints) > 1)} {', '.join(each.extra_joints)} "
                "besides, which most logs have not; a log of another robot? name the right one"
            )
            left.append(SkippedLog(each.log_name, f"{each.log_name.place}: {why}"))
            continue
        usable.append(each)
        if each.extra_joints:
            places_by_joints.setdefault(each.extra_joints, []).append(each.log_name.place)
    notes = [
        f"{places[0]}{f' and {len(places) - 1} more' * (len(places) > 1)}: positions and torques "
        f"of joints besides those of the robot ({', '.join(joints)}) are not read; is the robot "
        "file that of these machines?"
        for joints, places in places_by_joints.items()
    ]
    return usable, left, notes


# What of a robot may drift, and what a fleet has in common.


GAIN, LOAD = "drive_gain", "payload"
"""Ids of the catalogue: what scales the torques of a joint, and what a link carries."""


@dataclass(frozen=True)
class Quantity(ShortRepr):
    """A quantity that may drift: a parameter, a gain or a load.

    Attributes:
        effect: id of the catalogue.
        joint: name; None for a load.
        parameter: "Fv2"; "gain 2" and "load" are no parameters of the robot file.
        unit: of its value.
        column: base parameter; -1 for a gain or a load.
        place: index of the joint; -1 for a load.
        is_of_joint: its column enters the torque of its joint only.
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
        """Returns where it is: "joint 2"."""
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
        """Returns all quantities: what may drift, and an identifiable load."""
        return (*self.drifting, _LOAD) if self.load.shape[1] else self.drifting

    @property
    def drift_columns(self) -> list[int]:
        """Returns the base parameters that may drift."""
        return [q.column for q in self.drifting if q.column >= 0]

    @property
    def gain_joints(self) -> list[int]:
        """Returns the joints that have a gain, in order."""
        return [q.place for q in self.drifting if q.effect == GAIN]


def build_layout(spec: ModuleSpec) -> FleetLayout:
    """Builds what may drift of a robot."""
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
        alone, names = base.rows == (place,), (whose.effect, whose.joint, base.name, base.unit)
        drifting.append(Quantity(*names, column, place, is_of_joint=alone))
    if common.any():
        motors = [(j, joint.name) for j, joint in enumerate(spec.joints) if joint.actuated]
        drifting += [Quantity(GAIN, name, f"gain {name}", "%", -1, j) for j, name in motors]
    return FleetLayout(tuple(drifting), common, build_load_columns(spec))


@dataclass(frozen=True, eq=False)
class LogFit:
    """What a log deviates by; d unknowns, of which those that it cannot identify are NaN.

    Attributes:
        values: (d,) friction and offset in SI units, then gains as a share (0.05: 5 % more torque)
            or the load, mass in kg first.
        sigmas: (d,) their standard deviations, with what the residuals are autocorrelated.
    """

    values: np.ndarray
    sigmas: np.ndarray


@dataclass(frozen=True, eq=False)
class FleetFit:
    """The fit of the fleet.

    Attributes:
        theta: (c,) common parameters; 0 where a base parameter may drift.
        unidentified: names of common parameters that the logs cannot identify; 0.
        logs: with friction, offset and gains.
        load_fits: with friction, offset and a load in place of gains; empty if none can be
            identified.
    """

    theta: np.ndarray
    unidentified: tuple[str, ...]
    logs: tuple[LogFit, ...]
    load_fits: tuple[LogFit, ...]


def fit_fleet(layout: FleetLayout, summaries: Sequence[LogSummary]) -> FleetFit:
    """Fits all logs together.

    Raises:
        DataError: the logs identify no common parameter, or nothing that may drift.
    """
    if not layout.drifting:
        raise DataError(
            "the robot file has no friction and no offset, and no torque that a gain could scale: "
            "nothing can drift; name viscous, coulomb and offset under [effects], or --effects"
        )
    sigmas = [solve_least_squares(each.data).sigma for each in summaries]
    scale = np.ones((len(summaries), len(summaries[0].data.rows)))
    for _ in range(FLEET_THRESHOLDS.fit_rounds):
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
    gains = (
        [theta if place == j else nothing for place in layout.gain_joints] for j in range(joints)
    )
    return [np.column_stack([unit_columns, *columns]) for columns in gains]


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
    return LogFit(all_values, sigmas)


def _solve_log(
    each: LogSummary, sigma: np.ndarray, theta: np.ndarray, blocks: Blocks
) -> tuple[list[int], np.ndarray, np.ndarray, np.ndarray]:
    """Columns that can be identified, their values, a root of (Z^T Z)^-1, and (n,) ||r_j||."""
    pairs = [
        (R[:, :-1], R[:, -1], block) for R, block in zip(each.data.triangles, blocks, strict=True)
    ]
    parts = [np.column_stack([W @ block, y - W @ theta]) for W, y, block in pairs]
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
        out = is_known & (np.abs(apart) > FLEET_THRESHOLDS.min_gain_t * sigma[:, i])
        scale[out, place] = np.maximum(1.0 + apart[out], 0.1)
    return scale
