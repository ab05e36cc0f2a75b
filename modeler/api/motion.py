"""Motions that determine parameters or discriminate effects; simulated measurements; clearance."""

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from modeler import excitation, simulation
from modeler.api.log_maps import Mapped
from modeler.api.motion_bounds import Assignments, build_bounds
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
from modeler.core.jobs import SILENT, Reporter, ignore_progress
from modeler.core.json import Document
from modeler.core.options import ExciteOptions, OptionError, check_keywords
from modeler.effects import find_effect
from modeler.estimation import FitResult, IdentifiedModel, identify
from modeler.numerics.filters import BANDWIDTH
from modeler.regression import Log, Observation, Processing, check_no_overlap, observe
from modeler.robot import Robot, parse_robot_text, suggest_name
from modeler.runtime import CompiledModel
from modeler.simulation import HiddenEffect, SimulatedLog, SimulationSettings


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
        progress: Callable[[float], None] = ignore_progress,
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
            raise OptionError(
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
        logged = encoders.quantise_positions(q, [joint.unit for joint in spec.joints], rng)
        warm = {"temperature": np.zeros(len(q))}
        return Log("forecast", tuple(names), moves["time"], logged, tau, extra=warm)


@dataclass(frozen=True)
class Encoders:
    """What the positions of a log are known to.

    Attributes:
        counts: per turn of a revolute joint; 0: exact.
        noise: standard deviation of white noise besides, rad or m; (J,) if joints differ.
    """

    counts: int = 0
    noise: Any = 0.0

    @classmethod
    def from_options(cls, options: ExciteOptions) -> "Encoders":
        """Returns the encoders of a forecast."""
        return cls(options.encoder_counts or 0, options.position_noise or 0.0)

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
    """Returns what is known of a robot, or of a model with its fitted values.

    Elastic joints are rigid here: slopes along a motion know nothing of what winds up.
    """
    if isinstance(thing, Robot):
        thing = thing.rigid
        compiled = compile_model(generate(derive(thing)))
        values = [parameter.nominal for parameter in compiled.spec.standard]
        known = None not in values  # the robot file may leave some open
        return Subject(thing, compiled, beta=compiled.base_parameters(values) if known else None)
    robot = parse_robot_text(thing.robot_text, f"model of {thing.spec.robot}, robot")
    sigma = np.array([joint.sigma for joint in thing.fit.joints])
    known = bool(np.all(np.isfinite(sigma)) and np.all(sigma > 0.0))
    essential_columns = np.flatnonzero([parameter.essential for parameter in thing.fit.parameters])
    cutoff = thing.processing.parallel_cutoff or 0.0
    if thing.spec.windups:
        rigid = build_subject(robot)
        return dataclasses.replace(rigid, sigma=sigma if known else None, cutoff=cutoff)
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
        rows = observe(compiled, [*self.logs, log], self.processing, is_compared=False)
        both = identify(rows, "weighted", compiled)
        before, after = self.fit.parameters, both.parameters
        gain = excitation.InformationGain(
            *(tuple(p.name for p in before), tuple(p.unit for p in before)),
            *(tuple(p.sigma for p in before), tuple(p.sigma for p in after)),
            tuple(log.name for log in self.logs),
            (self.fit.condition_scaled, both.condition_scaled),
        )
        return dataclasses.replace(motion, information_gain=gain)


def fit_recorded_logs(subject: Subject, logs: Logs, mapping: Mapped = ()) -> RecordedLogs:
    """Fits existing logs as `modeler fit` does by default: all parameters, weighted.

    Raises:
        DataError: a log cannot be read or fitted, or rows are given twice.
    """
    compiled, read = subject.compiled, read_logs(subject.compiled, convert_to_list(logs), mapping)
    check_no_overlap(read)
    processing = build_processing(subject.robot.fit)
    observation = observe(compiled, read, processing, is_compared=False)
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
    limits: Assignments = (),
    boxes: Assignments = (),
    reporter: Reporter = SILENT,
    **options: Any,
) -> excitation.ExcitingMotion:
    """Searches a motion within limits that determines the parameters (docs/how-to/excitation.md).

    >>> excite(robot, duration=4.0, harmonics=2, starts=1).sample_motion(100.0)["q1"].shape
    (401,)

    Args:
        thing: a robot, or a model: then weighted as its fit, essential parameters only.
        logs: that there are: the motion adds most to what they determine, and its `gain` says what;
            all parameters, and objective "information" unless another one is requested.
        mapping: whose column of the logs is which, over [log] of the robot file.
        limits: joint -> lower, upper, speed, acceleration and, if wanted, torque, SI; in place of
            those of the robot file.
        boxes: frame -> x0, x1, y0, y1, z0, z1 in frame 0, m, that its origin stays in.
        reporter: of the progress.
        options: of `ExciteOptions`: duration [s], rate [Hz] of the next log, clearance [m] that
            links keep, harmonics, objective, starts, seed ...

    Raises:
        DataError: limits or options that cannot be.
        RobotError: an empty range.
    """
    stated = {"rate": THRESHOLDS.next_log_rate, **options}
    chosen = ExciteOptions.from_keywords("excite", stated)
    subject, bounds = prepare_search(thing, chosen, limits, boxes)
    return search_motion(subject, bounds, chosen, logs, mapping, reporter=reporter).motion


def prepare_search(
    thing: Robot | IdentifiedModel,
    options: ExciteOptions,
    limits: Assignments = (),
    boxes: Assignments = (),
) -> tuple[Subject, excitation.MotionBounds]:
    """Returns what is to be excited, and the bounds of its motion."""
    if not (math.isfinite(options.rate) and 0.0 < options.rate <= THRESHOLDS.max_rate):
        raise OptionError(
            f"{{--rate}}: got {options.rate:g}; expected more than 0, at most "
            f"{THRESHOLDS.max_rate:g}"
        )
    subject = build_subject(thing)
    if options.encoder_counts or options.position_noise:
        subject.check_known_noise("{--encoder_counts}, {--position_noise}: ")
    return subject, build_bounds(subject.robot, subject.compiled, limits, boxes, options.clearance)


@dataclass(frozen=True, eq=False)
class FoundMotion(Document):
    """A motion that was found, with what is expected of it.

    Attributes:
        motion: it.
        effects: of the robot.
        separation: of two effects along it, where these were asked for.
        forecast: of the sigmas of a log of it: a sentence, and values; None where none is known.
    """

    KEYS = "*motion effects discrimination=separation forecast=forecast_values"

    motion: excitation.ExcitingMotion
    effects: Sequence[str]
    separation: excitation.Discrimination | None = None
    forecast: tuple[str, dict[str, Any] | None] | None = None

    def format_lines(self) -> list[str]:
        """Returns the motion, the separation and the forecast as lines."""
        lines = self.motion.format_lines()
        if self.separation is not None:
            lines = [*self.separation.format_lines(), *lines[2:]]
        return lines if self.forecast is None else [*lines, self.forecast[0]]

    @property
    def forecast_values(self) -> Mapping[str, Any] | None:
        """Returns the forecast in numbers."""
        return None if self.forecast is None else self.forecast[1]


def search_motion(
    subject: Subject,
    bounds: excitation.MotionBounds,
    options: ExciteOptions,
    logs: Logs = (),
    mapping: Mapped = (),
    between: str | None = None,
    reporter: Reporter = SILENT,
) -> FoundMotion:
    """Searches as `excite` does, or as `discriminating_motion`, and forecasts sigmas."""
    recorded_logs = None
    if convert_to_list(logs):
        with reporter.report_step("fitting the logs that there are"):
            recorded_logs = fit_recorded_logs(subject, logs, mapping)
        subject = recorded_logs.subject
    request = _build_request(bounds, options, "information" if recorded_logs else "both")
    encoders, separation = Encoders.from_options(options), None
    effects = [use.effect for use in subject.robot.effects]
    with reporter.show_progress(f"looking for a motion of {subject.robot.name}") as bar:
        if between is not None:
            question = parse_question(subject, between, "{--between}")
            motion, separation = excitation.design_discriminating_motion(
                subject.compiled, bounds, request, question, bar
            )
        else:
            known = recorded_logs.known_information if recorded_logs else None
            motion = subject.search_motion(bounds, request, bar, known)
        if recorded_logs is not None:
            motion = recorded_logs.predict_gain(motion, options.rate, encoders)
    if recorded_logs is not None or subject.sigma is None:
        return FoundMotion(motion, effects, separation)
    with reporter.report_step("forecasting sigmas"):
        forecast = describe_expected_sigmas(subject, motion, options.rate, encoders)
    return FoundMotion(motion, effects, separation, forecast)


def _build_request(
    bounds: excitation.MotionBounds, options: ExciteOptions, objective: str
) -> excitation.MotionRequest:
    harmonics = options.harmonics
    if harmonics is None:
        harmonics = excitation.choose_harmonics(bounds, options.duration)
    return excitation.MotionRequest(
        duration=options.duration,
        harmonics=harmonics,
        criterion=options.objective or objective,
        starts=options.starts,
        seed=options.seed,
        time_limit=options.time_limit,
        laps=options.laps,
        family=options.family,
    )


def describe_expected_sigmas(
    subject: Subject, motion: excitation.ExcitingMotion, rate: float, encoders: Encoders
) -> tuple[str, dict[str, Any] | None]:
    """Describes the expected sigmas of a motion: a sentence, and values for JSON."""
    about = (
        f"forecast of a log at {rate:g} Hz, {encoders.describe()}, torques as noisy as the model's"
    )
    try:
        fit = subject.predict_fit(motion, rate, encoders)
    except DataError as error:
        return f"{about}: it cannot be fitted: {error}", None
    shares = {p.name: p.relative_sigma_percent for p in fit.parameters}
    limit, chosen = THRESHOLDS.max_determined_sigma, fit.processing
    sure = [name for name, share in shares.items() if share is not None and share < limit]
    worse = sorted(set(shares) - set(sure), key=lambda name: -(shares[name] or math.inf))
    uncertain = [
        f"{name} ({'not determined' if shares[name] is None else f'{shares[name]:.3g} %'})"
        for name in worse[: THRESHOLDS.named_parameters]
    ]
    sentence = (
        f"{about}: the fit filters positions at {chosen.position_cutoff:g} Hz and torques at "
        f"{chosen.parallel_cutoff:g} Hz; sigma is below {limit:g} % for "
        f"{len(sure)} of {len(shares)} parameters"
        f"{'; least sure: ' * bool(uncertain)}{', '.join(uncertain)}"
    )
    return sentence, {
        "rate": rate,
        "encoder_counts": encoders.counts,
        "position_noise": encoders.noise,
        "position_cutoff": chosen.position_cutoff,
        "parallel_cutoff": chosen.parallel_cutoff,
        "sigmas": {p.name: p.sigma for p in fit.parameters},
    }


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
    limits: Assignments = (),
    boxes: Assignments = (),
    reporter: Reporter = SILENT,
    **options: Any,
) -> tuple[excitation.ExcitingMotion, excitation.Discrimination]:
    """Searches the motion along which two missing effects differ most.

    Args:
        model: fitted.
        first: one of them, as "stribeck@2".
        second: the other.
        limits: as of `excite`.
        boxes: as of `excite`.
        reporter: of the progress.
        options: as of `excite`.

    Raises:
        DataError: an effect or joint that is not there, or that the model has.
    """
    chosen = ExciteOptions.from_keywords("discriminating_motion", options)
    subject, bounds = prepare_search(model, chosen, limits, boxes)
    question = parse_question(subject, f"{first},{second}", "discriminating_motion:")
    with reporter.show_progress(f"looking for a motion of {subject.robot.name}") as bar:
        return excitation.design_discriminating_motion(
            subject.compiled, bounds, _build_request(bounds, chosen, "both"), question, bar
        )


def parse_question(
    subject: Subject, texts: str, where: str = "{--between}"
) -> excitation.DiscriminationProblem:
    """Parses the two effects that a motion has to discriminate.

    Args:
        subject: with values.
        texts: "stribeck@2,spring@2".
        where: begins the message.

    Raises:
        DataError: not two, or one that is not there or that the model has.
    """
    if subject.beta is None or subject.essential_columns is None:  # a robot
        raise OptionError(
            f"{where}: {subject.robot.name} has no values; expected a model file of `modeler fit`"
        )
    joints = [joint.name for joint in subject.compiled.spec.joints]
    catalogue = subject.robot.catalogue
    ids = [effect.id for effect in catalogue]
    effect_pair = []
    for text in texts.split(","):
        name, _, joint = text.strip().partition("@")
        effect = find_effect(name, catalogue)
        if effect is None:
            raise OptionError(
                f"{where} {text}: no such effect{suggest_name(name, ids)}; expected some of "
                f"{', '.join(ids)}"
            )
        if joint not in joints:
            raise OptionError(
                f"{where} {text}: got joint {joint or '(none)'}; expected EFFECT@J with one of "
                f"{', '.join(joints)}"
            )
        if subject.robot.has_effect(effect.id, joint):
            raise OptionError(
                f"{where} {text}: the model has {effect.id} on joint {joint} already; expected "
                "effects that it lacks"
            )
        effect_pair.append((effect, joint))
    if len(effect_pair) != 2 or effect_pair[0] == effect_pair[1]:
        raise OptionError(f"{where} {texts}: expected two effects, as stribeck@2,spring@2")
    return excitation.DiscriminationProblem(
        (effect_pair[0], effect_pair[1]), subject.beta, subject.sigma
    )


@dataclass(frozen=True, eq=False)
class MotionChoice(Document):
    """The best of some motions.

    Attributes:
        robot: name.
        candidates: places of the motions.
        choice: which, and how well each determines the parameters.
    """

    KEYS = """
        robot chosen_motions condition_scaled=choice.condition condition_scaled_of_all=choice.whole
        single_conditions=choice.single_conditions is_exhaustive=choice.is_exhaustive
    """

    robot: str
    candidates: Sequence[str]
    choice: excitation.MotionSubset

    def format_lines(self) -> list[str]:
        """Returns every motion with its condition number, then that of those chosen together."""
        choice, lines = self.choice, []
        for k, place in enumerate(self.candidates):
            mark = "chosen  " if k in choice.places else "        "
            lines.append(
                f"{mark}{place}: condition number {choice.single_conditions[k]:.4g} by itself"
            )
        return [
            *lines,
            f"{len(choice.places)} chosen: condition number {choice.condition:.4g} together, all "
            f"{len(self.candidates)} {choice.whole:.4g}, columns of length one",
        ]

    @property
    def chosen_motions(self) -> list[str]:
        """Returns the places of those chosen."""
        return [str(self.candidates[k]) for k in self.choice.places]


def choose_motions(subject: Subject, candidates: Sequence[str], count: int) -> MotionChoice:
    """Chooses the motions that together determine the parameters best."""
    compiled, columns = subject.compiled, subject.essential_columns
    names = [joint.name for joint in compiled.spec.joints]
    essential = slice(None) if columns is None else columns
    weights = 1.0 if subject.sigma is None else 1.0 / subject.sigma[:, None]
    rows = []
    for place in candidates:
        motion = simulation.read_motion(place, names)
        states = (motion.q, motion.qd, motion.qdd)
        signals = excitation.compute_signals(compiled, states, motion.time)
        phi = compiled.base_regressor(*states, signals)[:, :, essential]
        rows.append((phi * weights).reshape(-1, phi.shape[2]))
    return MotionChoice(subject.robot.name, candidates, excitation.choose_motions(rows, count))


# Measurements by simulation.


def simulate(
    robot: Robot,
    path: str | Path | None = None,
    *,
    hide: Sequence[str | HiddenEffect] = (),
    motion: str | Path = "exciting",
    reporter: Reporter = SILENT,
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
        reporter: of the progress.
        settings: of `SimulationSettings`: duration [s], rate [Hz], seed, parameter_seed,
            torque_noise [share of rms], encoder_counts, process_noise, controller, drive_gains,
            also as texts "2=1.5" ...

    Raises:
        DataError: a setting that is none, or that cannot be; what the simulation refuses.
    """
    if path is not None:
        simulation.check_suffix(Path(path))
    described = build_settings(robot, hide, motion, settings)
    try:
        with reporter.show_progress(f"simulating {robot.name}") as bar:
            log = simulation.simulate(robot, described, bar)
    except DataError as error:
        if described.commanded is None:
            raise
        raise DataError(f"{motion}: {error}") from None
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
    known = sorted(field.name for field in dataclasses.fields(SimulationSettings))
    check_keywords("simulate", options, known)
    hidden = tuple(
        simulation.parse_hidden_effect(each) if isinstance(each, str) else each for each in hide
    )
    gains = options.get("drive_gains", {})
    if not isinstance(gains, Mapping):
        options = {**options, "drive_gains": simulation.parse_drive_gains(gains, robot)}
    if not str(motion).endswith((".csv", ".parquet")):
        return SimulationSettings(hidden=hidden, motion=str(motion), **options)
    if "duration" in options:
        raise OptionError(
            f"{{--duration}}: got {options['duration']:g} s with {{--motion}} {motion}, which is "
            "as long as it is; leave {--duration} out"
        )
    rate = options.get("rate", SimulationSettings().rate)
    if not (math.isfinite(rate) and rate > 0.0):
        raise OptionError(f"{{--rate}}: got {rate:g}; expected a number above 0")
    joints = [joint.name for joint in robot.coordinates]
    commanded = simulation.resample_motion(simulation.read_motion(motion, joints), rate)
    return SimulationSettings(hidden=hidden, commanded=commanded, **options)
