"""Motions that determine parameters or discriminate effects; simulated measurements; clearance."""

import dataclasses
import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from modeler import excitation, formats, simulation
from modeler.api.log_maps import Mapped
from modeler.api.thresholds import THRESHOLDS
from modeler.api.workflow import (
    Logs,
    build_processing,
    compile,
    compile_model,
    convert_to_list,
    derive,
    generate,
    read_logs,
)
from modeler.core.errors import DataError
from modeler.effects import find_effect
from modeler.estimation import FitResult, IdentifiedModel, identify
from modeler.numerics.filters import BANDWIDTH
from modeler.regression import Log, Observation, Processing, check_no_overlap, observe
from modeler.robot import Limits, Robot, parse_robot_text, suggest_name
from modeler.runtime import CompiledModel
from modeler.simulation import HiddenEffect, SimulatedLog, SimulationSettings


def add_clearance(
    robot: Robot, compiled: CompiledModel, bounds: excitation.MotionBounds, margin: float | None
) -> excitation.MotionBounds:
    """Adds the minimum distance between links to the bounds.

    Looked at are all links that share no joint and touch in some postures only.

    Args:
        robot: its [capsules]; without, as `capsules_on_links` draws them.
        compiled: the same.
        bounds: ranges, from which postures are drawn.
        margin: m; None: 0.01 if the robot file has [capsules], else links are not looked at.

    Raises:
        DataError: a margin below 0.
    """
    if margin is None:
        if not (robot.capsules or robot.planes):
            return bounds
        margin = THRESHOLDS.link_clearance
    if not 0.0 <= margin < math.inf:
        raise DataError(f"clearance: got {margin:g} m; expected 0 or more")
    ranges = np.stack([bounds.lower, bounds.upper])
    solids = _collect_solids(robot, compiled)
    clearance = excitation.exclude_neighbours(compiled, solids, margin, ranges, bounds.home)
    return dataclasses.replace(bounds, clearance=clearance)


def _collect_solids(robot: Robot, compiled: CompiledModel) -> excitation.CollisionGeometry:
    """All capsules, and all pairs of links that share no joint."""
    moving, closure = [joint.name for joint in robot.moving_joints], compiled.spec.closure
    at = {} if closure is None else dict(zip(closure.variables, closure.home, strict=True))
    shapes = formats.locate_capsules(robot, at)
    on, links = {row: carrier for row, carrier, _ in shapes}, [carrier for _, carrier, _ in shapes]
    joined = {frozenset((on.get(j.name), on.get(j.antecedent))) for j in robot.joints}
    joined |= {frozenset((on.get(loop.frame), on.get(loop.meets))) for loop in robot.loops}
    pairs = [
        (i, k)
        for i, k in itertools.combinations(range(len(links)), 2)
        if links[i] != links[k] and frozenset((links[i], links[k])) not in joined
    ]
    moves = [i for i, link in enumerate(links) if link in moving]
    pairs += [(i, len(links) + k) for i in moves for k in range(len(robot.planes))]
    planes = np.array([*robot.planes.values()]).reshape(-1, 4)
    planes /= np.linalg.norm(planes[:, :3], axis=1)[:, None]
    places = [moving.index(link) if link in moving else excitation.BASE for link in links]
    return excitation.CollisionGeometry(
        (*("base" if row == "0" else row for row, *_ in shapes), *robot.planes),
        np.array(places + [excitation.BASE] * len(planes)),
        np.array([(shape.start, shape.end) for *_, shape in shapes]),
        np.array([shape.radius for *_, shape in shapes] + [0.0] * len(planes)),
        planes[:, :3], planes[:, 3], np.array(pairs, dtype=int).reshape(-1, 2),
    )  # fmt: skip


def find_nearest_along(
    compiled: CompiledModel, clearance: excitation.Clearance, motion: simulation.Reference
) -> excitation.ClosestApproach | None:
    """Finds the two nearest links along a motion; None without pairs to check."""
    if not len(clearance.solids.pairs):
        return None
    curve, samples = (
        simulation.build_curve(motion),
        max(excitation.THRESHOLDS.clearance_samples, 2 * len(motion.time)),
    )
    return excitation.find_closest_approach(
        compiled, clearance.solids, curve, float(motion.time[-1]), samples
    )


Progress = Callable[[float], None]


def _ignore_progress(share: float) -> None:
    """Nobody looks."""


@dataclass(frozen=True, eq=False)
class Subject:
    """What is to be excited, and what is known of it.

    Attributes:
        robot, compiled: it.
        sigma: (J,) standard deviation of the torque of each joint; None where unknown.
        kept: (k,) columns that matter; None: all.
        beta: (c,) base parameters; None where unknown.
        cutoff: of the parallel filter behind which sigma was found, Hz; 0: none.
    """

    robot: Robot
    compiled: CompiledModel
    sigma: np.ndarray | None = None
    essential_columns: np.ndarray | None = None
    beta: np.ndarray | None = None
    cutoff: float = 0.0

    def search_motion(
        self,
        bounds: excitation.MotionBounds,
        wish: excitation.MotionRequest,
        progress: Progress = _ignore_progress,
        known: excitation.PriorInformation | None = None,
    ) -> excitation.ExcitingMotion:
        """Searches the motion along which the parameters are best determined."""
        return excitation.design_motion(
            self.compiled,
            bounds,
            wish,
            self.sigma,
            self.essential_columns,
            self.beta,
            progress,
            known,
        )

    def check_known_noise(self, where: str = "") -> None:
        """Raises an error if parameters or torque noise are unknown; `where` begins the message."""
        if self.sigma is None or self.beta is None:
            raise DataError(
                f"{where}{self.robot.name}: sigmas follow from the values of its parameters and "
                "the noise of its torques, which are not known; expected a model of `modeler fit`"
            )

    def predict_fit(
        self, motion: excitation.ExcitingMotion, rate: float, encoders: "Encoders"
    ) -> FitResult:
        """Predicts the fit of a log of a motion; see `expected_sigmas`."""
        log = self.predict_log(motion, rate, encoders)
        return identify(observe(self.compiled, [log]), "weighted", self.compiled)

    def predict_log(
        self, motion: excitation.ExcitingMotion, rate: float, encoders: "Encoders"
    ) -> Log:
        """Predicts the log of a motion."""
        self.check_known_noise()
        assert self.sigma is not None and self.beta is not None
        spec, moves = self.compiled.spec, motion.sample_motion(rate)
        names = [joint.name for joint in spec.joints]
        q, qd, qdd = (np.column_stack([moves[p + j] for j in names]) for p in ("q", "qd", "qdd"))
        read = excitation.compute_signals(self.compiled, (q, qd, qdd), moves["time"])
        rng = np.random.default_rng(int(motion.request["seed"]))
        # White noise that leaves sigma behind the filter.
        power = 0.5 * rate / (BANDWIDTH * self.cutoff) if self.cutoff else 1.0
        driven = [joint.actuated for joint in spec.joints]
        tau = self.compiled.inverse_dynamics(q, qd, qdd, self.beta, read)
        tau = tau + driven * self.sigma * np.sqrt(power) * rng.normal(size=q.shape)
        return Log(
            "forecast", tuple(names), moves["time"],
            encoders.quantise_positions(q, [joint.unit for joint in spec.joints], rng), tau,
            extra={"temperature": np.zeros(len(q))},
        )  # fmt: skip


@dataclass(frozen=True)
class Encoders:
    """What the positions of a log are known to.

    Attributes:
        counts: per turn of a revolute joint; 0: exact.
        noise: standard deviation of white noise besides, rad or m; (J,) if joints differ.
    """

    counts: int = 0
    noise: Any = 0.0

    def quantise_positions(
        self, q: np.ndarray, units: Sequence[str], rng: np.random.Generator
    ) -> np.ndarray:
        """Returns (n, J) logged positions for exact ones (n, J)."""
        noise = np.asarray(self.noise, dtype=float)
        if self.counts < 0 or not np.all((noise >= 0.0) & np.isfinite(noise)):
            raise DataError(
                f"encoders of {self.counts} counts and noise {self.noise}: expected neither below 0"
            )
        noisy = q + noise * rng.normal(size=q.shape)
        step = np.array([2.0 * np.pi if unit == "rad" else 0.0 for unit in units])
        step = step / self.counts if self.counts else np.zeros(len(units))
        return np.where(step > 0.0, np.round(noisy / np.where(step > 0.0, step, 1.0)) * step, noisy)

    def describe(self) -> str:
        """Describes the encoders, as "positions of 4096 counts a turn"."""
        parts = [f"of {self.counts} counts a turn"] if self.counts else []
        parts += [f"with noise of {self.noise:g} rad (m)"] if self.noise else []
        return f"positions {' and '.join(parts) or 'exact'}"


def build_subject(thing: Robot | IdentifiedModel) -> Subject:
    """Returns what is known of a robot, or of a model with its fitted values."""
    if isinstance(thing, Robot):
        compiled = compile_model(generate(derive(thing)))
        values = [parameter.nominal for parameter in compiled.spec.standard]
        known = None not in values  # the robot file may leave some open
        return Subject(thing, compiled, beta=compiled.base_parameters(values) if known else None)
    robot = parse_robot_text(thing.robot_text, f"model of {thing.spec.robot}, robot")
    sigma = np.array([joint.sigma for joint in thing.fit.joints])
    known = bool(np.all(np.isfinite(sigma)) and np.all(sigma > 0.0))
    essential_columns = np.flatnonzero([parameter.essential for parameter in thing.fit.parameters])
    cutoff = thing.processing.parallel_cutoff or 0.0
    return Subject(
        robot, compile(thing), sigma if known else None, essential_columns, thing.beta, cutoff
    )


@dataclass(frozen=True, eq=False)
class RecordedLogs:
    """Logs that there are, and what their fit says.

    Attributes:
        subject: the robot, with the noise and values of that fit.
        logs: as read.
        observation, fit: of them.
        processing: that a fit of more logs begins with.
    """

    subject: Subject
    logs: list[Log]
    observation: Observation
    fit: FitResult
    processing: Processing

    @property
    def known_information(self) -> excitation.PriorInformation:
        """Returns the information W'S^-1 W as a triangle, and the rows a second."""
        observation = self.observation
        sigma = np.array([joint.sigma for joint in self.fit.joints])[observation.row_joint]
        used = sigma > 0.0
        steps = np.diff(observation.time)[np.diff(observation.segment) == 0]
        R = np.asarray(np.linalg.qr(observation.W[used] / sigma[used, None], mode="r"))
        return excitation.PriorInformation(R, 1.0 / float(np.median(steps)))

    def predict_gain(
        self, motion: excitation.ExcitingMotion, rate: float, encoders: Encoders
    ) -> excitation.ExcitingMotion:
        """Predicts what the log of a motion adds to the fit of these logs."""
        compiled = self.subject.compiled
        if encoders == Encoders():  # as those of the logs
            noise_estimates = self.observation.report.bands.noise
            noise_by_joint = {
                n.joint: n.deviation for n in noise_estimates if n.quantity == "positions"
            }
            noise = [noise_by_joint.get(joint.name, 0.0) for joint in compiled.spec.joints]
            encoders = Encoders(0, np.array(noise))
        log = self.subject.predict_log(motion, rate, encoders)
        both = identify(observe(compiled, [*self.logs, log], self.processing), "weighted", compiled)
        before, after = self.fit.parameters, both.parameters
        gain = excitation.InformationGain(
            tuple(p.name for p in before), tuple(p.unit for p in before),
            tuple(p.sigma for p in before), tuple(p.sigma for p in after),
            tuple(log.name for log in self.logs),
            (self.fit.condition_scaled, both.condition_scaled),
        )  # fmt: skip
        return dataclasses.replace(motion, information_gain=gain)


def fit_recorded_logs(subject: Subject, logs: Logs, mapping: Mapped = ()) -> RecordedLogs:
    """Fits existing logs as `modeler fit` does by default: all parameters, weighted.

    Raises:
        DataError: a log cannot be read or fitted, or rows are given twice.
    """
    compiled, read = subject.compiled, read_logs(subject.compiled, convert_to_list(logs), mapping)
    check_no_overlap(read)
    processing = build_processing(subject.robot.fit)
    observation = observe(compiled, read, processing)
    fit = identify(observation, "weighted", compiled)
    sigma = np.array([joint.sigma for joint in fit.joints])
    subject = dataclasses.replace(
        subject,
        sigma=np.where(sigma > 0.0, sigma, sigma.max()),
        essential_columns=None,
        beta=fit.beta,
        cutoff=fit.processing.parallel_cutoff or 0.0,
    )
    return RecordedLogs(subject, read, observation, fit, processing)


def excite(
    thing: Robot | IdentifiedModel,
    logs: Logs = (),
    *,
    mapping: Mapped = (),
    rate: float = 1000.0,
    limits: Mapping[str, Sequence[float]] | None = None,
    boxes: Mapping[str, Sequence[float]] | None = None,
    clearance: float | None = None,
    progress: Progress = _ignore_progress,
    **wish: Any,
) -> excitation.ExcitingMotion:
    """Searches a motion within limits that determines the parameters (docs/how-to/excitation.md).

    >>> excite(robot, duration=4.0, harmonics=2, starts=1).sample_motion(100.0)["q1"].shape
    (401,)

    Args:
        thing: a robot, or a model: then weighted as its fit, essential parameters only.
        logs: that there are: the motion adds most to what they determine, and its `gain` says what;
            all parameters, and criterion "information" unless another one is requested.
        mapping: whose column of the logs is which, over [log] of the robot file.
        rate: samples of the next log per second.
        limits: joint -> lower, upper, speed, acceleration and, if wanted, torque, SI; in place of
            those of the robot file.
        boxes: frame -> x0, x1, y0, y1, z0, z1 in frame 0, m, that its origin stays in.
        clearance: m that links keep from each other and from planes; None: 0.01 if the robot file
            has [capsules], else they are not looked at.
        progress: called with the share done, 0 to 1.
        wish: of `excite.search.Wish`: duration [s], harmonics, criterion, starts, seed ...

    Raises:
        DataError: limits or a wish that cannot be.
        RobotError: an empty range.
    """
    subject = build_subject(thing)
    bounds = build_bounds(subject.robot, subject.compiled, limits or {}, boxes or {}, clearance)
    if not convert_to_list(logs):
        return subject.search_motion(bounds, _build_wish(bounds, wish), progress)
    recorded_logs = fit_recorded_logs(subject, logs, mapping)
    request = _build_wish(bounds, {"criterion": "information", **wish})
    motion = recorded_logs.subject.search_motion(
        bounds, request, progress, recorded_logs.known_information
    )
    return recorded_logs.predict_gain(motion, rate, Encoders())


def expected_sigmas(
    model: IdentifiedModel,
    motion: excitation.ExcitingMotion,
    *,
    rate: float = 1000.0,
    counts: int = 0,
    noise: float = 0.0,
) -> FitResult:
    """Predicts standard deviations and cut-offs of a fit before the motion is run.

    >>> motion = excite(robot, duration=4.0, harmonics=2, starts=1)
    >>> expected_sigmas(model, motion, rate=200.0).parameters[0].name
    'ZZ1R'

    The log is made of the motion, the torques of the model along it, and noise of both; what
    `observe` and `identify` make of it is the forecast, with the cut-offs that they choose.

    Args:
        model: with values, and with the residuals as the noise of its torques, taken to be white.
        motion: of `excite`.
        rate: samples of the log per second.
        counts: of the encoders, per turn of a revolute joint; 0: positions are exact.
        noise: standard deviation of white noise of the positions besides, rad or m.

    Raises:
        DataError: no noise of torques is known, or such a log could not be fitted.
    """
    return build_subject(model).predict_fit(motion, rate, Encoders(counts, noise))


def discriminating_motion(
    model: IdentifiedModel,
    first: str,
    second: str,
    *,
    limits: Mapping[str, Sequence[float]] | None = None,
    boxes: Mapping[str, Sequence[float]] | None = None,
    progress: Progress = _ignore_progress,
    **wish: Any,
) -> tuple[excitation.ExcitingMotion, excitation.Discrimination]:
    """Searches the motion along which two missing effects differ most.

    Args:
        model: fitted.
        first: one of them, as "stribeck@2".
        second: the other.
        limits: as of `excite`.
        boxes: as of `excite`.
        progress: called with the share done, 0 to 1.
        wish: as of `excite`.

    Raises:
        DataError: an effect or joint that is not there, or that the model has.
    """
    subject = build_subject(model)
    bounds = build_bounds(subject.robot, subject.compiled, limits or {}, boxes or {})
    question = parse_question(subject, f"{first},{second}", "tell_apart:")
    return excitation.design_discriminating_motion(
        subject.compiled, bounds, _build_wish(bounds, wish), question, progress
    )


def _build_wish(
    bounds: excitation.MotionBounds, options: Mapping[str, Any]
) -> excitation.MotionRequest:
    known = [field.name for field in dataclasses.fields(excitation.MotionRequest)]
    for name in options:
        if name not in known:
            raise DataError(f"excite: got {name}; expected some of {', '.join(known)}")
    duration = options.get("duration", excitation.MotionRequest().duration)
    return excitation.MotionRequest(
        **{"harmonics": excitation.choose_harmonics(bounds, duration), **options}
    )


def parse_question(
    subject: Subject, texts: str, where: str = "--between"
) -> excitation.DiscriminationProblem:
    """Parses the two effects that a motion has to discriminate.

    Args:
        subject: with values.
        texts: "stribeck@2,spring@2".
        where: begins the message.

    Raises:
        DataError: not two, or one that is not there or that the model has.
    """
    joints = [joint.name for joint in subject.compiled.spec.joints]
    catalogue = subject.robot.catalogue
    ids = [effect.id for effect in catalogue]
    effect_pair = []
    for text in texts.split(","):
        name, _, joint = text.strip().partition("@")
        effect = find_effect(name, catalogue)
        if effect is None:
            raise DataError(
                f"{where} {text}: no such effect{suggest_name(name, ids)}; expected some of "
                f"{', '.join(ids)}"
            )
        if joint not in joints:
            raise DataError(
                f"{where} {text}: got joint {joint or '(none)'}; expected EFFECT@J with one of "
                f"{', '.join(joints)}"
            )
        if subject.robot.has_effect(effect.id, joint):
            raise DataError(
                f"{where} {text}: the model has {effect.id} on joint {joint} already; expected "
                "effects that it lacks"
            )
        effect_pair.append((effect, joint))
    if len(effect_pair) != 2 or effect_pair[0] == effect_pair[1]:
        raise DataError(f"{where} {texts}: expected two effects, as stribeck@2,spring@2")
    assert subject.beta is not None
    return excitation.DiscriminationProblem(
        (effect_pair[0], effect_pair[1]), subject.beta, subject.sigma
    )


def build_bounds(
    robot: Robot,
    compiled: CompiledModel,
    limits: Mapping[str, Sequence[float]],
    boxes: Mapping[str, Sequence[float]],
    clearance: float | None = None,
) -> excitation.MotionBounds:
    """Returns the limits of the robot file, replaced by given ones.

    Args:
        robot: as loaded.
        compiled: the same.
        limits: as of `excite`.
        boxes: as of `excite`.
        clearance: as of `excite`.

    Raises:
        DataError: another number of values, or no number; a joint or frame that is not there.
        RobotError: an empty range.
    """
    coordinates = [joint.name for joint in compiled.spec.joints]
    moving = [joint.name for joint in robot.moving_joints]
    form = "lower, upper, speed, acceleration"
    changes, torques = {}, {}
    for name, numbers in limits.items():
        values = _check_numbers("limits", name, numbers, moving, (4, 5), form)
        changes[name] = Limits(*values[:4])
        if len(values) == 5:
            torques[name] = values[4]
    every = simulation.collect_motion_limits(robot, changes)
    of = {name: every[moving.index(name)] for name in moving}
    lower, upper, speed, acceleration = np.array(
        [dataclasses.astuple(of[name])[:4] for name in coordinates]
    ).T
    closure, home = compiled.spec.closure, None
    passive: list[tuple[int, float, float]] = []
    if closure is not None:
        home = np.array(closure.home)[list(closure.actuated)]
        stated = {**robot.limits, **changes}
        passive = [
            (place, stated[name].lower, stated[name].upper)
            for place, name in enumerate(closure.variables)
            if place not in closure.actuated and name in stated
        ]
    corners = {
        name: _check_numbers("boxes", name, numbers, moving, (6,), "x0, x1, y0, y1, z0, z1")
        for name, numbers in boxes.items()
    }
    bounds = excitation.MotionBounds(
        tuple(coordinates), lower, upper, speed, acceleration,
        torque=np.array([torques.get(name, np.inf) for name in coordinates]),
        boxes=tuple(
            excitation.Box(name, moving.index(name), (x[0], x[2], x[4]), (x[1], x[3], x[5]))
            for name, x in corners.items()
        ),
        passive=tuple(passive), home=home,
        assumed=tuple(name for name in coordinates if name not in {**robot.limits, **changes}),
    )  # fmt: skip
    return add_clearance(robot, compiled, bounds, clearance)


def _check_numbers(
    what: str, name: str, numbers: Sequence[float], names: list[str], counts: tuple[int, ...],
    form: str,
) -> list[float]:  # fmt: skip
    """The numbers, if they are as many as expected and the row is there."""
    if name not in names:
        raise DataError(
            f"{what}: no moving joint {name}{suggest_name(name, names)}; expected one of "
            f"{', '.join(names)}"
        )
    values = [float(value) for value in numbers]
    if len(values) not in counts or any(math.isnan(value) for value in values):
        raise DataError(f"{what} of {name}: got {numbers}; expected {form}, numbers in SI units")
    return values


def check_motion(
    robot: Robot, motion: str | Path, *, clearance: float = THRESHOLDS.link_clearance
) -> excitation.ClosestApproach | None:
    """Finds where a motion brings two links, or a link and a plane, closest together.

    >>> check_motion(robot, "mon.parquet").pair  # its two links share a joint
    ('base', '2')

    Args:
        robot: its [capsules] are what links fill; without, as `modeler excite` takes them.
        motion: file of a motion or log, .csv or .parquet; commanded positions, if it has them.
        clearance: m; pairs that are nearer in nearly all postures are left out.

    Returns:
        None if no two are left to look at.

    Raises:
        DataError: the file has no motion of this robot.
    """
    compiled = compile_model(generate(derive(robot)))
    bounds = build_bounds(robot, compiled, {}, {}, clearance)
    assert bounds.clearance is not None
    names = [joint.name for joint in compiled.spec.joints]
    return find_nearest_along(compiled, bounds.clearance, simulation.read_motion(motion, names))


# Measurements by simulation.


def simulate(
    robot: Robot,
    path: str | Path | None = None,
    *,
    hide: Sequence[str | HiddenEffect] = (),
    motion: str | Path = "exciting",
    progress: Callable[[float], None] | None = None,
    **settings: Any,
) -> SimulatedLog:
    """Simulates a measurement of a robot under its controller; the result is used as a log.

    >>> simulate(robot, duration=2.0, seed=1).q.shape
    (2000, 2)

        simulate(load("demo-arm"), "run.parquet", hide=["load_friction@2"], duration=20, seed=1)

    Args:
        robot: parameters that its file leaves open are drawn from `parameter_seed`.
        path: .parquet or .csv file to write; None: none.
        hide: physics that the machine has and the robot file lacks, as "stribeck@2:extra=3".
        motion: "exciting", "point-to-point", "one-joint", or a file of a motion or log.
        progress: called with the share done, 0 to 1.
        settings: of `SimulationSettings`: duration [s], rate [Hz], seed, parameter_seed,
            torque_noise [share of rms], encoder_counts, process_noise, controller, drive_gains ...

    Raises:
        DataError: a setting that is none, or that cannot be; what the simulation refuses.
    """
    if path is not None:
        simulation.check_suffix(Path(path))
    log = simulation.simulate(robot, build_settings(robot, hide, motion, settings), progress)
    if path is not None:
        simulation.write_log(Path(path), log)
    return log


def build_settings(
    robot: Robot, hide: Sequence[str | HiddenEffect], motion: str | Path, options: Mapping[str, Any]
) -> SimulationSettings:
    """Builds the settings of a simulation; see `simulate`.

    Raises:
        DataError: one that is none, or that cannot be.
    """
    known = {field.name for field in dataclasses.fields(SimulationSettings)}
    for name in options:
        if name not in known:
            raise DataError(f"simulate: got {name}; expected some of {', '.join(sorted(known))}")
    hidden = tuple(
        simulation.parse_hidden_effect(each) if isinstance(each, str) else each for each in hide
    )
    if not str(motion).endswith((".csv", ".parquet")):
        return SimulationSettings(hidden=hidden, motion=str(motion), **options)
    rate = options.get("rate", SimulationSettings().rate)
    joints = [joint.name for joint in robot.coordinates]
    commanded = simulation.resample_motion(simulation.read_motion(motion, joints), rate)
    return SimulationSettings(hidden=hidden, commanded=commanded, **options)
