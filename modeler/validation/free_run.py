"""A free run: windows from measured states, whole logs, and what the robot's nature adds."""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from modeler.core.errors import DataError, LoopError
from modeler.core.manifest import JointSpec
from modeler.core.table import percent
from modeler.estimation import ControlLoop, DirectModel, IdentifiedModel
from modeler.observation import Log, Observation, Segment, observe, signals_of
from modeler.runtime import CompiledModel
from modeler.validation.forward_dynamics import FittedPlant, Forces
from modeler.validation.free_run_result import Controlled, FreeRun, JointFreeRun, Path
from modeler.validation.stability import (
    Along,
    Stability,
    fit_percentage,
    horizons,
    ranges_of,
    stability,
)

# The fitted robot under a controller that follows the logged commands.


Gains = tuple[float, float, float, float]
"""Speed loop, Hz; ratio of the position loop; integral action; feedforward."""


def controlled(
    model: CompiledModel, beta: np.ndarray, observation: Observation, gains: Gains | None
) -> tuple[Controlled | None, str]:
    """The robot under the given controller, or under one that comes nearest to the log.

    The controller of a log is not known; it is estimated as for `didim`, see `direct_model`.

    Returns:
        What became of it, and a doubt, "" without one. None: no commands were logged and none is
        asked for, or none that was tried holds the robot.

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
    if gains is None and not all(joint.actuated for joint in model.spec.joints):
        return None, "a joint has no motor, so no controller is looked for"
    try:
        loop = (
            robot.chosen(beta) if gains is None else ControlLoop(2 * np.pi * gains[0], *gains[1:])
        )
        if np.isinf(loop.speed):
            return None, (
                "no controller that was tried brings the robot nearer to the log than "
                "the command is"
            )
        return _measured(robot, observation, loop, beta, gains is not None), ""
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


def _measured(
    robot: DirectModel, observation: Observation, loop: ControlLoop, beta: np.ndarray, given: bool
) -> Controlled:
    motions = robot.followed(beta, loop)
    kept = [segment.whole for segment in robot.segments]
    q = np.concatenate([s.q[own] for s, own in zip(robot.segments, kept, strict=True)])
    simulated = np.concatenate([m[0][own] for m, own in zip(motions, kept, strict=True)])
    wanted = np.concatenate([r[0][own] for r, own in zip(robot.references, kept, strict=True)])
    rows, torque = observation.row_joint, robot.columns(motions) @ beta
    fit, tracking, effort = (dict[str, float | None]() for _ in range(3))
    for j, joint in enumerate(observation.joints):
        fit[joint.name] = fit_percentage(q[:, j], simulated[:, j])
        left = float(np.linalg.norm(q[:, j] - wanted[:, j]))
        error = float(np.linalg.norm(q[:, j] - simulated[:, j]))
        tracking[joint.name] = 100.0 * (1.0 - error / left) if left > 0.0 else None
        own = rows == j
        effort[joint.name] = fit_percentage(observation.y[own], torque[own]) if own.any() else None
    return Controlled(
        loop.speed / (2 * np.pi), loop.ratio, loop.integral, loop.forward, given,
        fit, tracking, effort,
    )  # fmt: skip


# Robots side by side under given torques: Adams and Bashforth, and dry friction that can hold.
#
# The smooth part goes by the rule of order 2. Dry friction is implicit, as Moreau's stepping has it
# (J. J. Moreau, "Unilateral contact and dry friction in finite freedom dynamics", 1988): the torque
# of a shaft at the end of a step is its bound against its speed there, or any value within the
# bounds if it stands. So a shaft that friction holds stays where it is, without chatter at any
# step.


_SWEEPS = 60  # of the relaxation over shafts that stick or turn
_SETTLED = 1e-10  # of the speed that dry friction takes in a step


@dataclass(frozen=True, eq=False)
class Lanes:
    """What b robots are given over the same number of samples.

    Attributes:
        q, qd: (b, n) state at the start.
        tau: (samples, b, n) torque at the samples, linear between them, N m or N.
        signals: (samples, b, m) what effects read, or None.
        step: s between samples.
        far: (n,) rad or m from `around`, at which a robot is lost.
        around: (samples, b, n) positions that were logged.
    """

    q: np.ndarray
    qd: np.ndarray
    tau: np.ndarray
    signals: np.ndarray | None
    step: float
    far: np.ndarray
    around: np.ndarray


def walk(
    plant: FittedPlant,
    lanes: Lanes,
    inner: int,
    ended: np.ndarray | None = None,
    tell: Callable[[float], None] | None = None,
) -> np.ndarray:
    """(samples, b, n) positions; NaN from where a robot is lost or its loops no longer close.

    Args:
        plant: the robot.
        lanes: what it is given.
        inner: steps between two samples.
        ended: (b,) sample after which a robot need not be followed.
        tell: called with the share done.
    """
    samples, b, n = lanes.tau.shape
    path = np.full((samples, b, n), np.nan)
    state = _State(
        lanes.q.copy(), lanes.qd.copy(), np.zeros((b, n)), np.full((b, n), np.nan),
        np.zeros((b, plant.shafts)), None if lanes.signals is None else lanes.signals[0].copy(),
    )  # fmt: skip
    ended = np.full(b, samples - 1) if ended is None else ended
    live = np.arange(b)
    for k in range(samples):
        path[k, live] = state.q[live]
        live = live[ended[live] > k]
        if k == samples - 1 or not len(live):
            break
        if tell is not None:
            tell(k / samples)
        state.read(plant, lanes.signals, k)
        dry = None
        for m in range(inner):
            sound = _sound(plant, state, live, lanes.around[k], lanes.far)
            live, dry = live[sound], None if dry is None else dry[sound]
            if not len(live):
                return path
            share = m / inner  # the rule looks half a step ahead by itself
            tau = (1.0 - share) * lanes.tau[k, live] + share * lanes.tau[k + 1, live]
            dry = state.step(plant, live, tau, lanes.step / inner, dry)
    return path


@dataclass(eq=False)
class _State:
    """Of b robots; changed in place, those that are lost stay as they were."""

    q: np.ndarray
    qd: np.ndarray
    qdd: np.ndarray
    smooth: np.ndarray  # the acceleration without dry friction one step before
    pull: np.ndarray  # dry friction as a share of its bounds
    s: np.ndarray | None

    def read(self, plant: FittedPlant, signals: np.ndarray | None, k: int) -> None:
        """Signals of sample k; inner states are part of the state and stay."""
        if self.s is not None and signals is not None:
            held = self.s[:, plant.inner].copy()
            self.s = signals[k].copy()
            self.s[:, plant.inner] = held

    def step(
        self,
        plant: FittedPlant,
        live: np.ndarray,
        tau: np.ndarray,
        h: float,
        dry: np.ndarray | None,
    ) -> np.ndarray:
        """One step of h s for those that live; the bounds of their dry friction."""
        q, qd = self.q[live], self.qd[live]
        own = None if self.s is None else self.s[live]
        forces = plant.forces(q, qd, self.qdd[live], own, dry)
        smooth = np.linalg.solve(forces.M, (tau - forces.smooth)[:, :, None])[:, :, 0]
        before = self.smooth[live]
        before = np.where(np.isnan(before), smooth, before)
        free = qd + h * (1.5 * smooth - 0.5 * before)
        speed, self.pull[live] = _rubbed(forces, free, self.pull[live], h)
        moved = 0.5 * h * (qd + speed)
        self.smooth[live], self.qdd[live] = smooth, (speed - qd) / h
        self.q[live], self.qd[live] = q + moved, speed
        if self.s is not None:
            now = (self.q[live], self.qd[live], self.qdd[live])
            self.s[live] = plant.stepped(self.s[live], moved, h, now)
        return forces.dry


def _sound(
    plant: FittedPlant, state: _State, live: np.ndarray, around: np.ndarray, far: np.ndarray
) -> np.ndarray:
    """(live,) True where the state is one that can be gone on from."""
    q, qd = state.q[live], state.qd[live]
    kept = np.isfinite(q).all(axis=1) & np.isfinite(qd).all(axis=1)
    kept &= (np.abs(np.where(np.isfinite(q), q, np.inf) - around[live]) < far).all(axis=1)
    if kept.any():
        kept[kept] = plant.reaches(q[kept])
    return np.asarray(kept)


def _rubbed(
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
    found = sliding
    if turns.any():
        found[turns] = _relaxed(speeds[turns], taken[turns], dry[turns] > 0.0, pull[turns])
    return free - np.einsum("bnk,bk->bn", way, found), found


def _relaxed(
    speeds: np.ndarray, taken: np.ndarray, rubs: np.ndarray, pull: np.ndarray
) -> np.ndarray:
    """(b, k) p in -1 ... 1: p = sign(u), or u = 0, u = speeds - taken p; one by one, repeated."""
    p = np.where(rubs, pull, 0.0)
    own = np.einsum("bkk->bk", taken)
    own = np.where(own > 0.0, own, 1.0)
    for _ in range(_SWEEPS):
        change = 0.0
        for k in range(p.shape[1]):
            left = speeds[:, k] - np.einsum("bl,bl->b", taken[:, k], p)
            new = np.where(rubs[:, k], np.clip(p[:, k] + left / own[:, k], -1.0, 1.0), 0.0)
            change = max(change, float(np.abs(new - p[:, k]).max(initial=0.0)))
            p[:, k] = new
        if change < _SETTLED:
            break
    return p


_LONGEST = 2e-3  # s, of a step
_STABLE = 0.4  # of a step times the fastest mode
_MOST_INNER = 200  # steps between two samples
_FOLLOWED = 5.0  # windows that a start is followed for the horizon
_MOST_WINDOWS = 100
_WHOLE = 60.0  # s of a log that are followed from its start
_LOST = 10.0  # ranges of motion from the log
_POINTS = 2000  # at which the motion is linearised, over all logs
_HALVED = 5  # windows that are run again at half the step
_DOUBTFUL = 0.01  # of the range: a numerical error that is told


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
class _Start:
    """A robot set off at sample `first` of a segment, until `stop` at most."""

    segment: int
    first: int
    stop: int


def free_run(
    model: IdentifiedModel,
    logs: Sequence[Log],
    compiled: CompiledModel,
    asked: FreeRunSettings | None = None,
    progress: Callable[[float], None] | None = None,
) -> FreeRun:
    """Positions that the fitted robot takes under the logged torques, beside the measured ones.

    Args:
        model: fitted.
        logs: read with its manifest; torques in N m or N, positions in rad or m.
        compiled: its robot.
        asked: window, bound and controller.
        progress: called with the share done.

    Raises:
        DataError: a number out of its range, logs shorter than a window, or values with which the
            robot has no inertia.
    """
    asked, tell = asked or FreeRunSettings(), progress or (lambda share: None)
    for name, value in (("--window", asked.window), ("--bound", asked.bound)):
        if not (math.isfinite(value) and value > 0.0):
            raise DataError(f"{name}: got {value:g}; expected a number above 0")
    observation = observe(compiled, logs, model.processing)
    segments = [part.segment for part in observation.stretches]
    starts = _starts(segments, asked.window)
    plant = FittedPlant(compiled, model.beta)
    every = np.concatenate([segment.q[segment.whole] for segment in segments])
    plant.check_inertia(every[:: max(1, len(every) // 500)])
    signals = [signals_of(compiled, segment) for segment in segments]
    nature = stability(plant, _along(observation, segments, signals))
    ranges = ranges_of(every, [joint.unit for joint in observation.joints])
    finest = min(_LONGEST, _STABLE / nature.fastest if nature.fastest > 0.0 else _LONGEST)
    field = _MotionField(plant, segments, signals, ranges, finest, asked)
    tell(0.1)
    runs = _windows(field, starts, tell)
    whole = _whole(field, lambda share: tell(0.5 + 0.3 * share))
    tell(0.8)
    under, doubt = controlled(compiled, model.beta, observation, asked.gains)
    tell(1.0)
    return FreeRun(
        robot=observation.robot,
        logs=observation.logs,
        window=asked.window,
        bound=asked.bound,
        ranges=ranges,
        windows=len(runs.paths),
        longest=_FOLLOWED * asked.window,
        joints=tuple(
            _joint(field, j, joint, runs, whole) for j, joint in enumerate(observation.joints)
        ),
        stability=nature,
        numerical=runs.numerical,
        controlled=under,
        paths=runs.paths,
        doubts=tuple(_doubts(field, runs.numerical, starts, nature, doubt)),
    )


def _seconds(segment: Segment) -> float:
    return float(np.count_nonzero(segment.whole) * segment.step)


def _inside(segment: Segment) -> tuple[int, int]:
    """First sample off the edges of the filter, and the one after the last."""
    whole = np.flatnonzero(segment.whole)
    return (int(whole[0]), int(whole[-1]) + 1) if len(whole) else (0, 0)


def _starts(segments: Sequence[Segment], window: float) -> list[_Start]:
    """One window after the other; of many, some that are evenly spread."""
    found = []
    for i, segment in enumerate(segments):
        first, stop = _inside(segment)
        length = max(2, round(window / segment.step) + 1)
        found += [_Start(i, k, stop) for k in range(first, stop - length + 1, length - 1)]
    if not found:
        longest = max(_seconds(segment) for segment in segments)
        raise DataError(
            f"--window {window:g}: the longest uninterrupted motion of these logs is "
            f"{longest:.3g} s; expected a window that fits into it"
        )
    kept = np.unique(np.linspace(0, len(found) - 1, min(len(found), _MOST_WINDOWS)).astype(int))
    return [found[k] for k in kept]


def _along(
    observation: Observation, segments: Sequence[Segment], signals: Sequence[np.ndarray | None]
) -> list[Along]:
    samples = sum(segment.samples for segment in segments)
    found = []
    for segment, read in zip(segments, signals, strict=True):
        first, stop = _inside(segment)
        thinned = slice(first, stop, max(1, samples // _POINTS))
        q, qd, tau = (values[thinned] for values in (segment.q, segment.qd, segment.tau))
        if len(time := segment.time[thinned]) > 1:
            log, s = observation.logs[segment.run], None if read is None else read[thinned]
            found.append(Along(log, time, q, qd, tau, s))
    return found


@dataclass(frozen=True, eq=False)
class _MotionField:
    """Where robots run: the logged torques, and how finely."""

    plant: FittedPlant
    segments: Sequence[Segment]
    signals: Sequence[np.ndarray | None]  # of each segment
    ranges: np.ndarray
    finest: float  # s, of a step
    asked: FreeRunSettings

    def run(
        self,
        starts: Sequence[_Start],
        seconds: float,
        halved: bool = False,
        tell: Callable[[float], None] | None = None,
    ) -> tuple[list[np.ndarray], list[np.ndarray]]:
        """Simulated and measured positions (p, n) of each start, p until its end or `seconds`."""
        simulated: list[np.ndarray] = [np.empty(0)] * len(starts)
        measured: list[np.ndarray] = [np.empty(0)] * len(starts)
        steps = [float(f"{self.segments[start.segment].step:.6g}") for start in starts]
        for step in sorted(set(steps)):
            own = [i for i, other in enumerate(steps) if other == step]
            length = round(seconds / step) + 1
            chosen = [starts[i] for i in own]
            counts = np.array([min(length, start.stop - start.first) for start in chosen])
            lanes = self._lanes(chosen, int(counts.max()), step)
            inner = min(_MOST_INNER, math.ceil(step / self.finest)) * (2 if halved else 1)
            path = walk(self.plant, lanes, inner, counts - 1, tell)
            for place, i in enumerate(own):
                simulated[i] = path[: counts[place], place]
                measured[i] = lanes.around[: counts[place], place]
        return simulated, measured

    def _lanes(self, starts: Sequence[_Start], length: int, step: float) -> Lanes:
        def stacked(of: Callable[[int], np.ndarray]) -> np.ndarray:
            rows = np.arange(length)
            parts = [of(s.segment)[np.minimum(s.first + rows, s.stop - 1)] for s in starts]
            return np.stack(parts, axis=1)

        signals = None
        if self.signals and self.signals[0] is not None:
            signals = stacked(lambda i: np.asarray(self.signals[i]))
        around = stacked(lambda i: self.segments[i].q)
        speeds = np.stack([self.segments[s.segment].qd[s.first] for s in starts])
        return Lanes(
            around[0], speeds, stacked(lambda i: self.segments[i].tau), signals, step,
            _LOST * np.where(np.isfinite(self.ranges), self.ranges, np.inf), around,
        )  # fmt: skip


@dataclass(frozen=True, eq=False)
class _RunWindows:
    """Runs from measured states: paths of a window, going on at constant speed, horizons."""

    paths: tuple[Path, ...]
    straight: np.ndarray  # (samples, n) over all windows
    longer: tuple[np.ndarray, ...]  # (p, n) errors as long as a start is followed
    steps: tuple[float, ...]
    numerical: float  # largest change by halving the step, in ranges


def _windows(
    field: _MotionField, starts: Sequence[_Start], tell: Callable[[float], None]
) -> _RunWindows:
    window = field.asked.window
    simulated, measured = field.run(
        starts, _FOLLOWED * window, tell=lambda share: tell(0.1 + 0.4 * share)
    )
    tell(0.5)
    few = [starts[i] for i in np.unique(np.linspace(0, len(starts) - 1, _HALVED).astype(int))]
    coarse, aside = field.run(few, window)
    fine, _ = field.run(few, window, halved=True)
    paths, straight = [], []
    for start, ours, theirs in zip(starts, simulated, measured, strict=True):
        segment = field.segments[start.segment]
        count = min(len(ours), round(window / segment.step) + 1)
        own = slice(start.first, start.first + count)
        paths.append(Path(str(segment.run), segment.time[own], theirs[:count], ours[:count]))
        gone = segment.time[own] - segment.time[start.first]
        straight.append(theirs[0] + gone[:, None] * segment.qd[start.first])
    return _RunWindows(
        tuple(paths),
        np.concatenate(straight),
        tuple(a - b for a, b in zip(simulated, measured, strict=True)),
        tuple(field.segments[start.segment].step for start in starts),
        _changed(field, zip(coarse, fine, aside, strict=True)),
    )


def _changed(field: _MotionField, runs: Iterable[tuple[np.ndarray, ...]]) -> float:
    """Largest change of a position by halving the step, in ranges, while its error is in bounds."""
    largest, ranges = 0.0, field.ranges
    for ours, halved, theirs in runs:
        near = np.logical_and.accumulate(np.abs(halved - theirs) <= field.asked.bound * ranges)
        change = np.abs(ours - halved)[near] / np.broadcast_to(ranges, near.shape)[near]
        largest = max(largest, float(change[np.isfinite(change)].max(initial=0.0)))
    return largest


def _whole(field: _MotionField, tell: Callable[[float], None]) -> tuple[np.ndarray, np.ndarray]:
    """Simulated and measured positions of each segment from its start, one after the other."""
    starts = [_Start(i, *_inside(segment)) for i, segment in enumerate(field.segments)]
    simulated, measured = field.run([s for s in starts if s.stop - s.first > 1], _WHOLE, tell=tell)
    return np.concatenate(simulated), np.concatenate(measured)


def _joint(
    field: _MotionField, j: int, joint: JointSpec, runs: _RunWindows, whole: tuple[np.ndarray, ...]
) -> JointFreeRun:
    measured = np.concatenate([path.measured[:, j] for path in runs.paths])
    simulated = np.concatenate([path.simulated[:, j] for path in runs.paths])
    error = np.abs(simulated - measured)
    largest = float(error[np.isfinite(error)].max(initial=0.0))
    if not np.isfinite(field.ranges[j]):
        return JointFreeRun(joint.name, joint.unit, None, None, None, None, 0, largest)
    bound = field.asked.bound * field.ranges[j : j + 1]
    pairs = zip(runs.longer, runs.steps, strict=True)
    until = np.array([horizons(e[:, None, j : j + 1], bound, step)[0, 0] for e, step in pairs])
    middle = float(np.quantile(until, 0.5, method="higher"))
    return JointFreeRun(
        joint.name,
        joint.unit,
        fit_percentage(measured, simulated),
        fit_percentage(measured, runs.straight[:, j]),
        fit_percentage(whole[1][:, j], whole[0][:, j]),
        middle if np.isfinite(middle) else None,
        int(np.isfinite(until).sum()),
        largest,
    )


def _doubts(
    field: _MotionField, numerical: float, starts: Sequence[_Start], nature: Stability, doubt: str
) -> list[str]:
    found, window = [doubt] if doubt else [], field.asked.window
    if numerical > _DOUBTFUL:
        found.append(
            "the integration is not exact: halving its step moves a joint by "
            f"{percent(numerical)} of its range within a window"
        )
    if nature.unstable and nature.rate * window > np.log(10.0):
        shorter = float(f"{1.0 / nature.rate:.1g}")
        found.append(
            f"within a window of {window:g} s an error grows tenfold and more by nature; "
            f"`--window {shorter:g}` judges the model"
        )
    if any(_seconds(segment) > _WHOLE for segment in field.segments):
        found.append(f"whole runs: the first {_WHOLE:g} s of each log")
    if len(starts) == _MOST_WINDOWS:
        found.append(f"{_MOST_WINDOWS} windows, evenly spread over the logs")
    return found
