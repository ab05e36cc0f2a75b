"""A free run: windows from measured states, whole logs, and what the robot's nature adds."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError, LoopError
from modeler.core.manifest import JointSpec
from modeler.core.table import format_percent
from modeler.estimation import ControlLoop, DirectModel, IdentifiedModel
from modeler.regression import Log, Observation, Segment, compute_signals, observe
from modeler.runtime import CompiledModel
from modeler.validation.forward_dynamics import (
    FittedPlant,
    Forces,
    LoggedMotion,
    Stability,
    analyse_stability,
    compute_fit_percentage,
    compute_horizons,
    compute_ranges,
)
from modeler.validation.free_run_result import ControlledRun, FreeRun, JointFreeRun, Path
from modeler.validation.thresholds import THRESHOLDS

# The fitted robot under a controller that follows the logged commands.


Gains = tuple[float, float, float, float]
"""Speed loop, Hz; ratio of the position loop; integral action; feedforward."""


def simulate_controlled_run(
    model: CompiledModel, beta: np.ndarray, observation: Observation, gains: Gains | None
) -> tuple[ControlledRun | None, str]:
    """Simulates the robot under the given controller, or under the one nearest to the log.

    The controller of a log is not known; it is estimated as for `didim`, see `direct_model`.

    Returns:
        What became of it, and a warning, "" without one. None: no commands were logged and none is
        requested, or none that was tried holds the robot.

    Raises:
        DataError: gains are given, and no commands were logged or the robot is lost.
    """
    robot = DirectModel(model, observation)
    if not robot.commanded:
        if gains is None:
            return None, ""
        raise DataError(
            f"--controller: {observation.logs[0]}: no complete columns "
            f"qc{observation.joints[0].name} ...; expected commanded positions of all joints, "
            "which the controller is to follow; log them, or leave --controller out"
        )
    if gains is None and model.spec.windups:
        return None, "joints are elastic, so no controller is looked for"
    if gains is None and not all(joint.actuated for joint in model.spec.joints):
        return None, "a joint has no motor, so no controller is looked for"
    try:
        loop = (
            robot.choose_loop(beta)
            if gains is None
            else ControlLoop(2 * np.pi * gains[0], *gains[1:])
        )
        if np.isinf(loop.speed):
            return None, (
                "no controller that was tried brings the robot nearer to the log than "
                "the command is"
            )
        return _evaluate_controlled_run(robot, observation, loop, beta, gains is not None), ""
    except (DataError, LoopError):
        if gains is not None:
            raise DataError(
                f"--controller: with these gains {model.spec.robot} is lost; expected those of a "
                "controller that holds it, as the speed loop in Hz and the ratio of the position "
                "loop; try slower loops, or leave --controller out"
            ) from None
        return None, (
            "no controller that was tried holds the robot with the fitted values all along the log"
        )


def _evaluate_controlled_run(
    robot: DirectModel,
    observation: Observation,
    loop: ControlLoop,
    beta: np.ndarray,
    has_given_gains: bool,
) -> ControlledRun:
    motions = robot.simulate_motions(beta, loop)
    whole = [segment.whole for segment in robot.segments]
    q = np.concatenate([s.q[mask] for s, mask in zip(robot.segments, whole, strict=True)])
    simulated = np.concatenate([m[0][mask] for m, mask in zip(motions, whole, strict=True)])
    wanted = np.concatenate([r[0][mask] for r, mask in zip(robot.references, whole, strict=True)])
    rows, torque = observation.row_joint, robot.evaluate_columns(motions) @ beta
    fit, tracking, effort = (dict[str, float | None]() for _ in range(3))
    for j, joint in enumerate(observation.joints):
        fit[joint.name] = compute_fit_percentage(q[:, j], simulated[:, j])
        left = float(np.linalg.norm(q[:, j] - wanted[:, j]))
        error = float(np.linalg.norm(q[:, j] - simulated[:, j]))
        tracking[joint.name] = 100.0 * (1.0 - error / left) if left > 0.0 else None
        mask = rows == j
        effort[joint.name] = (
            compute_fit_percentage(observation.y[mask], torque[mask]) if mask.any() else None
        )
    return ControlledRun(
        loop.speed / (2 * np.pi),
        loop.ratio,
        loop.integral,
        loop.forward,
        has_given_gains,
        fit,
        tracking,
        effort,
    )


# Robots side by side under given torques: Adams and Bashforth, and dry friction that can hold.
#
# The smooth part goes by the rule of order 2. Dry friction is implicit, as Moreau's stepping has it
# (J. J. Moreau, "Unilateral contact and dry friction in finite freedom dynamics", 1988): the torque
# of a shaft at the end of a step is its bound against its speed there, or any value within the
# bounds if it stands. So a shaft that friction holds stays where it is, without chatter at any
# step.


@dataclass(frozen=True, eq=False)
class RobotBatch:
    """What b robots are given over the same number of samples.

    Attributes:
        q, qd: (b, n) state at the start.
        tau: (samples, b, n) torque at the samples, linear between them, N m or N.
        signals: (samples, b, m) what effects read, or None.
        step: s between samples.
        far: (n,) rad or m from `logged_positions`, at which a robot is lost.
        around: (samples, b, n) positions that were logged.
    """

    q: np.ndarray
    qd: np.ndarray
    tau: np.ndarray
    signals: np.ndarray | None
    step: float
    lost_distance: np.ndarray
    logged_positions: np.ndarray


def simulate_batch(
    plant: FittedPlant,
    batch: RobotBatch,
    inner: int,
    last_samples: np.ndarray | None = None,
    report_progress: Callable[[float], None] | None = None,
) -> np.ndarray:
    """Returns (samples, b, n) positions; NaN from where a robot is lost or its loops do not close.

    Args:
        plant: the robot.
        batch: what it is given.
        inner: steps between two samples.
        last_samples: (b,) sample after which a robot need not be followed.
        report_progress: called with the share done.
    """
    samples, b, n = batch.tau.shape
    path = np.full((samples, b, n), np.nan)
    state = _BatchState(
        batch.q.copy(),
        batch.qd.copy(),
        np.zeros((b, n)),
        np.full((b, n), np.nan),
        np.zeros((b, plant.shafts)),
        None if batch.signals is None else batch.signals[0].copy(),
    )
    last_samples = np.full(b, samples - 1) if last_samples is None else last_samples
    live = np.arange(b)
    for k in range(samples):
        path[k, live] = state.q[live]
        live = live[last_samples[live] > k]
        if k == samples - 1 or not len(live):
            break
        if report_progress is not None:
            report_progress(k / samples)
        state.update_signals(plant, batch.signals, k)
        dry = None
        for m in range(inner):
            is_valid = _find_valid_robots(
                plant, state, live, batch.logged_positions[k], batch.lost_distance
            )
            live, dry = live[is_valid], None if dry is None else dry[is_valid]
            if not len(live):
                return path
            share = m / inner  # the rule looks half a step ahead by itself
            tau = (1.0 - share) * batch.tau[k, live] + share * batch.tau[k + 1, live]
            dry = state.advance(plant, live, tau, batch.step / inner, dry)
    return path


@dataclass(eq=False)
class _BatchState:
    """Of b robots; changed in place, those that are lost stay as they were."""

    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    smooth: np.ndarray  # the acceleration without dry friction one step before
    pull: np.ndarray  # dry friction as a share of its bounds
    s: np.ndarray | None

    def update_signals(self, plant: FittedPlant, signals: np.ndarray | None, k: int) -> None:
        """Reads the signals of sample k; inner states are part of the state and stay."""
        if self.s is not None and signals is not None:
            held = self.s[:, plant.inner].copy()
            self.s = signals[k].copy()
            self.s[:, plant.inner] = held

    def advance(
        self,
        plant: FittedPlant,
        live: np.ndarray,
        tau: np.ndarray,
        h: float,
        dry: np.ndarray | None,
    ) -> np.ndarray:
        """Advances the remaining robots by h s; returns the bounds of their dry friction."""
        q, qd = self.q[live], self.qd[live]
        signals = None if self.s is None else self.s[live]
        forces = plant.compute_forces(q, qd, self.qdd[live], signals, dry)
        smooth = np.linalg.solve(forces.M, (tau - forces.smooth)[:, :, None])[:, :, 0]
        before = self.smooth[live]
        before = np.where(np.isnan(before), smooth, before)
        free = qd + h * (1.5 * smooth - 0.5 * before)
        speed, self.pull[live] = _apply_dry_friction(forces, free, self.pull[live], h)
        moved = 0.5 * h * (qd + speed)
        self.smooth[live], self.qdd[live] = smooth, (speed - qd) / h
        self.q[live], self.qd[live] = q + moved, speed
        if self.s is not None:
            now = (self.q[live], self.qd[live], self.qdd[live])
            self.s[live] = plant.advance_signals(self.s[live], moved, h, now)
        return forces.dry


def _find_valid_robots(
    plant: FittedPlant, state: _BatchState, live: np.ndarray, around: np.ndarray, far: np.ndarray
) -> np.ndarray:
    """(live,) True where the state is one that can be gone on from."""
    q, qd = state.q[live], state.qd[live]
    is_valid = np.isfinite(q).all(axis=1) & np.isfinite(qd).all(axis=1)
    is_valid &= (np.abs(np.where(np.isfinite(q), q, np.inf) - around[live]) < far).all(axis=1)
    if is_valid.any():
        is_valid[is_valid] = plant.can_close(q[is_valid])
    return np.asarray(is_valid)


def _apply_dry_friction(
    forces: Forces, free: np.ndarray, pull: np.ndarray, h: float
) -> tuple[np.ndarray, np.ndarray]:
    """Speeds (b, n) after dry friction, and its share of its bound, (b, k) in -1 ... 1.

    Args:
        forces: at the beginning of the step.
        free: (b, n) speeds as they would be without it.
        pull: (b, k) the last share, to start from.
        h: s.
    """
    C, dry = forces.C, forces.dry
    if not dry.size or not dry.any():
        return free, np.zeros_like(pull)
    way = np.linalg.solve(forces.M, C.transpose(0, 2, 1)) * (h * dry)[:, None, :]  # (b, n, k)
    speeds = np.einsum("bkn,bn->bk", C, free)
    taken = np.einsum("bkn,bnl->bkl", C, way)
    sliding = np.sign(speeds) * (dry > 0.0)
    after = speeds - np.einsum("bkl,bl->bk", taken, sliding)
    turns = ((np.sign(after) != sliding) & (dry > 0.0)).any(axis=1)
    shares = sliding
    if turns.any():
        shares[turns] = _relax_friction(speeds[turns], taken[turns], dry[turns] > 0.0, pull[turns])
    return free - np.einsum("bnk,bk->bn", way, shares), shares


def _relax_friction(
    speeds: np.ndarray, taken: np.ndarray, rubs: np.ndarray, pull: np.ndarray
) -> np.ndarray:
    """(b, k) p in -1 ... 1: p = sign(u), or u = 0, u = speeds - taken p; one by one, repeated."""
    p = np.where(rubs, pull, 0.0)
    diagonal = np.einsum("bkk->bk", taken)
    diagonal = np.where(diagonal > 0.0, diagonal, 1.0)
    for _ in range(THRESHOLDS.max_friction_sweeps):
        change = 0.0
        for k in range(p.shape[1]):
            left = speeds[:, k] - np.einsum("bl,bl->b", taken[:, k], p)
            new = np.where(rubs[:, k], np.clip(p[:, k] + left / diagonal[:, k], -1.0, 1.0), 0.0)
            change = max(change, float(np.abs(new - p[:, k]).max(initial=0.0)))
            p[:, k] = new
        if change < THRESHOLDS.friction_tolerance:
            break
    return p


@dataclass(frozen=True)
class FreeRunSettings:
    """What is asked of a free run.

    Attributes:
        window: s.
        bound: share of a joint's range of motion, for the horizon.
        gains: of a controller, where one is given.
    """

    window: float = 1.0
    bound: float = 0.05
    gains: Gains | None = None


@dataclass(frozen=True)
class _RunStart:
    """A robot set off at sample `first` of a segment, until `stop` at most."""

    segment: int
    first: int
    stop: int


def simulate_free_run(
    model: IdentifiedModel,
    logs: Sequence[Log],
    compiled: CompiledModel,
    settings: FreeRunSettings | None = None,
    progress: Callable[[float], None] | None = None,
) -> FreeRun:
    """Simulates the positions of the fitted robot under the logged torques.

    Args:
        model: fitted.
        logs: read with its manifest; torques in N m or N, positions in rad or m.
        compiled: its robot.
        settings: window, bound and controller.
        progress: called with the share done.

    Raises:
        DataError: a number out of its range, logs shorter than a window, or values with which the
            robot has no inertia.
    """
    settings, report_progress = settings or FreeRunSettings(), progress or (lambda share: None)
    for name, value in (("--window", settings.window), ("--bound", settings.bound)):
        if not (math.isfinite(value) and value > 0.0):
            raise DataError(f"{name}: got {value:g}; expected a number above 0")
    observation = observe(compiled, logs, model.processing)
    segments = [part.segment for part in observation.stretches]
    starts = _choose_starts(segments, settings.window)
    plant = FittedPlant(compiled, model.beta)
    every = np.concatenate([segment.q[segment.whole] for segment in segments])
    plant.check_inertia(every[:: max(1, len(every) // 500)])
    signals = [compute_signals(compiled, segment) for segment in segments]
    motions = _collect_motions(plant, observation, segments, signals)
    motion_stability = analyse_stability(plant, motions)
    ranges = compute_ranges(every, [joint.unit for joint in observation.joints])
    finest = min(
        THRESHOLDS.max_step,
        THRESHOLDS.max_stiffness / motion_stability.fastest
        if motion_stability.fastest > 0.0
        else THRESHOLDS.max_step,
    )
    field = _RunSetup(plant, segments, signals, ranges, finest, settings)
    report_progress(0.1)
    runs = _simulate_windows(field, starts, report_progress)
    whole = _simulate_whole_logs(field, lambda share: report_progress(0.5 + 0.3 * share))
    report_progress(0.8)
    controlled_run, controller_warning = simulate_controlled_run(
        compiled, model.beta, observation, settings.gains
    )
    report_progress(1.0)
    numbered = enumerate(observation.joints)
    joints = tuple(_evaluate_joint(field, j, joint, runs, whole) for j, joint in numbered)
    doubts = _collect_warnings(field, runs.numerical, starts, motion_stability, controller_warning)
    return FreeRun(
        robot=observation.robot,
        logs=observation.logs,
        window=settings.window,
        bound=settings.bound,
        ranges=ranges,
        windows=len(runs.paths),
        longest=THRESHOLDS.followed_windows * settings.window,
        joints=joints,
        stability=motion_stability,
        numerical=runs.numerical,
        controlled=controlled_run,
        paths=runs.paths,
        warnings=tuple(doubts),
    )


def _compute_duration(segment: Segment) -> float:
    return float(np.count_nonzero(segment.whole) * segment.step)


def _find_whole_range(segment: Segment) -> tuple[int, int]:
    """First sample off the edges of the filter, and the one after the last."""
    whole = np.flatnonzero(segment.whole)
    return (int(whole[0]), int(whole[-1]) + 1) if len(whole) else (0, 0)


def _choose_starts(segments: Sequence[Segment], window: float) -> list[_RunStart]:
    """One window after the other; of many, some that are evenly spread."""
    starts = []
    for i, segment in enumerate(segments):
        first, stop = _find_whole_range(segment)
        length = max(2, round(window / segment.step) + 1)
        starts += [_RunStart(i, k, stop) for k in range(first, stop - length + 1, length - 1)]
    if not starts:
        longest = max(_compute_duration(segment) for segment in segments)
        raise DataError(
            f"--window {window:g}: the longest uninterrupted motion of these logs is "
            f"{longest:.3g} s; expected a window that fits into it"
        )
    places = np.unique(
        np.linspace(0, len(starts) - 1, min(len(starts), THRESHOLDS.max_windows)).astype(int)
    )
    return [starts[k] for k in places]


def _collect_motions(
    plant: FittedPlant,
    observation: Observation,
    segments: Sequence[Segment],
    signals: Sequence[np.ndarray | None],
) -> list[LoggedMotion]:
    samples = sum(segment.samples for segment in segments)
    motions = []
    for segment, read in zip(segments, signals, strict=True):
        first, stop = _find_whole_range(segment)
        thinned = slice(first, stop, max(1, samples // THRESHOLDS.linearisation_points))
        s = None if read is None else read[thinned]
        logged = enumerate((segment.q, segment.qd, segment.tau))
        q, qd, tau = (plant.extend(values[thinned], s, order) for order, values in logged)
        if len(time := segment.time[thinned]) > 1:
            log = observation.logs[segment.run]
            motions.append(LoggedMotion(log, time, q, qd, tau, s))
    return motions


@dataclass(frozen=True, eq=False)
class _RunSetup:
    """Where robots run: the logged torques, and how finely."""

    plant: FittedPlant
    segments: Sequence[Segment]
    signals: Sequence[np.ndarray | None]  # of each segment
    ranges: np.ndarray
    finest: float  # s, of a step
    settings: FreeRunSettings

    def simulate(
        self,
        starts: Sequence[_RunStart],
        seconds: float,
        halved: bool = False,
        report_progress: Callable[[float], None] | None = None,
    ) -> tuple[list[np.ndarray], list[np.ndarray]]:
        """Returns simulated and measured positions (p, n) of each start, p at most `seconds`."""
        simulated: list[np.ndarray] = [np.empty(0)] * len(starts)
        measured: list[np.ndarray] = [np.empty(0)] * len(starts)
        steps = [float(f"{self.segments[start.segment].step:.6g}") for start in starts]
        for step in sorted(set(steps)):
            group = [i for i, other in enumerate(steps) if other == step]
            length = round(seconds / step) + 1
            chosen = [starts[i] for i in group]
            counts = np.array([min(length, start.stop - start.first) for start in chosen])
            batch = self._build_batch(chosen, int(counts.max()), step)
            inner = min(THRESHOLDS.max_inner_steps, math.ceil(step / self.finest)) * (
                2 if halved else 1
            )
            path = simulate_batch(self.plant, batch, inner, counts - 1, report_progress)
            path = path[:, :, : len(self.ranges)]
            for place, i in enumerate(group):
                simulated[i] = path[: counts[place], place]
                logged = batch.logged_positions[: counts[place], place]
                measured[i] = logged[:, : len(self.ranges)]
        return simulated, measured

    def _build_batch(self, starts: Sequence[_RunStart], length: int, step: float) -> RobotBatch:
        def gather_samples(of: Callable[[int], np.ndarray]) -> np.ndarray:
            rows = np.arange(length)
            parts = [of(s.segment)[np.minimum(s.first + rows, s.stop - 1)] for s in starts]
            return np.stack(parts, axis=1)

        signals = None
        if self.signals and self.signals[0] is not None:
            signals = gather_samples(lambda i: np.asarray(self.signals[i]))
        around = gather_samples(lambda i: self.segments[i].q)
        speeds = np.stack([self.segments[s.segment].qd[s.first] for s in starts])
        extend, ranges = self.plant.extend, np.full(self.plant.joints, np.inf)
        ranges[: len(self.ranges)] = np.where(np.isfinite(self.ranges), self.ranges, np.inf)
        around = extend(around, signals, 0)
        return RobotBatch(
            around[0],
            extend(speeds, None if signals is None else signals[0], 1),
            extend(gather_samples(lambda i: self.segments[i].tau), signals, 2),
            signals,
            step,
            THRESHOLDS.max_distance_ranges * ranges,
            around,
        )


@dataclass(frozen=True, eq=False)
class _RunWindows:
    """Runs from measured states: paths of a window, going on at constant speed, horizons."""

    paths: tuple[Path, ...]
    straight: np.ndarray  # (samples, n) over all windows
    longer: tuple[np.ndarray, ...]  # (p, n) errors as long as a start is followed
    steps: tuple[float, ...]
    numerical: float  # largest change by halving the step, in ranges


def _simulate_windows(
    field: _RunSetup, starts: Sequence[_RunStart], report_progress: Callable[[float], None]
) -> _RunWindows:
    window = field.settings.window
    simulated, measured = field.simulate(
        starts,
        THRESHOLDS.followed_windows * window,
        report_progress=lambda share: report_progress(0.1 + 0.4 * share),
    )
    report_progress(0.5)
    few = [
        starts[i]
        for i in np.unique(np.linspace(0, len(starts) - 1, THRESHOLDS.halved_windows).astype(int))
    ]
    coarse, aside = field.simulate(few, window)
    fine, _ = field.simulate(few, window, halved=True)
    paths, straight = [], []
    for start, ours, theirs in zip(starts, simulated, measured, strict=True):
        segment = field.segments[start.segment]
        count = min(len(ours), round(window / segment.step) + 1)
        rows = slice(start.first, start.first + count)
        paths.append(Path(str(segment.run), segment.time[rows], theirs[:count], ours[:count]))
        gone = segment.time[rows] - segment.time[start.first]
        straight.append(theirs[0] + gone[:, None] * segment.qd[start.first])
    return _RunWindows(
        tuple(paths),
        np.concatenate(straight),
        tuple(a - b for a, b in zip(simulated, measured, strict=True)),
        tuple(field.segments[start.segment].step for start in starts),
        _compute_step_error(field, zip(coarse, fine, aside, strict=True)),
    )


def _compute_step_error(field: _RunSetup, runs: Iterable[tuple[np.ndarray, ...]]) -> float:
    """Largest change of a position by halving the step, in ranges, while its error is in bounds."""
    largest, ranges = 0.0, field.ranges
    for ours, halved, theirs in runs:
        near = np.logical_and.accumulate(np.abs(halved - theirs) <= field.settings.bound * ranges)
        change = np.abs(ours - halved)[near] / np.broadcast_to(ranges, near.shape)[near]
        largest = max(largest, float(change[np.isfinite(change)].max(initial=0.0)))
    return largest


def _simulate_whole_logs(
    field: _RunSetup, report_progress: Callable[[float], None]
) -> tuple[np.ndarray, np.ndarray]:
    """Simulated and measured positions of each segment from its start, one after the other."""
    starts = [_RunStart(i, *_find_whole_range(segment)) for i, segment in enumerate(field.segments)]
    simulated, measured = field.simulate(
        [s for s in starts if s.stop - s.first > 1],
        THRESHOLDS.max_whole_seconds,
        report_progress=report_progress,
    )
    return np.concatenate(simulated), np.concatenate(measured)


def _evaluate_joint(
    field: _RunSetup, j: int, joint: JointSpec, runs: _RunWindows, whole: tuple[np.ndarray, ...]
) -> JointFreeRun:
    measured = np.concatenate([path.measured[:, j] for path in runs.paths])
    simulated = np.concatenate([path.simulated[:, j] for path in runs.paths])
    error = np.abs(simulated - measured)
    largest = float(error[np.isfinite(error)].max(initial=0.0))
    if not np.isfinite(field.ranges[j]):
        return JointFreeRun(joint.name, joint.unit, None, None, None, None, 0, largest)
    bound = field.settings.bound * field.ranges[j : j + 1]
    pairs = zip(runs.longer, runs.steps, strict=True)
    until = np.array(
        [compute_horizons(e[:, None, j : j + 1], bound, step)[0, 0] for e, step in pairs]
    )
    middle = float(np.quantile(until, 0.5, method="higher"))
    return JointFreeRun(
        joint.name,
        joint.unit,
        compute_fit_percentage(measured, simulated),
        compute_fit_percentage(measured, runs.straight[:, j]),
        compute_fit_percentage(whole[1][:, j], whole[0][:, j]),
        middle if np.isfinite(middle) else None,
        int(np.isfinite(until).sum()),
        largest,
    )


def _collect_warnings(
    field: _RunSetup,
    numerical: float,
    starts: Sequence[_RunStart],
    motion_stability: Stability,
    controller_warning: str,
) -> list[str]:
    warnings, window = [controller_warning] if controller_warning else [], field.settings.window
    if numerical > THRESHOLDS.max_numerical_error:
        warnings.append(
            "the integration is not exact: halving its step moves a joint by "
            f"{format_percent(numerical)} of its range within a window"
        )
    if motion_stability.is_unstable and motion_stability.rate * window > np.log(10.0):
        shorter = float(f"{1.0 / motion_stability.rate:.1g}")
        warnings.append(
            f"within a window of {window:g} s an error grows tenfold and more by nature; "
            f"`--window {shorter:g}` judges the model"
        )
    if any(_compute_duration(segment) > THRESHOLDS.max_whole_seconds for segment in field.segments):
        warnings.append(f"whole runs: the first {THRESHOLDS.max_whole_seconds:g} s of each log")
    if len(starts) == THRESHOLDS.max_windows:
        warnings.append(f"{THRESHOLDS.max_windows} windows, evenly spread over the logs")
    return warnings
