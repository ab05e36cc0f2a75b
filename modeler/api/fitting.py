"""Fits: of either model, with loads or without, in one step or two; all estimators at once."""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal

import numpy as np

import modeler.api.workflow as workflow
from modeler import estimation
from modeler.api.log_maps import Mapped
from modeler.api.model import Model
from modeler.api.steps import Steps, ignore_step
from modeler.api.workflow import AnyLog, Logs
from modeler.codegen import Derivation
from modeler.core.choices import ABOUT, GAIN_METHOD, TWO_STEPS, Method
from modeler.core.errors import DataError
from modeler.core.manifest import EmittedModule
from modeler.numerics.least_squares import CompressedRegression
from modeler.regression import DataWarning, Log, Observation, Processing, check_no_overlap, observe
from modeler.robot import (
    Robot,
    compute_joint_directions,
    parse_robot_text,
    replace_drive_gains,
    suggest_name,
)
from modeler.runtime import CompiledModel

WITH_LOADS = ("weighted", "ordinary", "robust", "ridge")
WITHOUT_LOADS = (*(m for m in ABOUT if m not in WITH_LOADS), TWO_STEPS)
"""Methods that know no loads."""

BUILDABLE = tuple(method for method, about in ABOUT.items() if about.is_consistent)
"""Methods that end in all standard parameters."""

OF_WINDOWS = ("weighted", "ordinary")
"""Methods of the energy model."""


@dataclasses.dataclass(frozen=True)
class FitRequest:
    """How a fit is to be made.

    Attributes:
        method: an id of `core.choices`, or "two-step".
        energy: True for the energy model, whose rows are windows.
        window: its length, s; None: the spacing of the torque model's rows.
        payloads: loads that some logs carry.
        below: percent of sigma that essential parameters are below; None: an F-test finds them.
    """

    method: str = "weighted"
    energy: bool = False
    window: float | None = None
    payloads: tuple[estimation.Payload, ...] = ()
    below: float | None = None


def read_fit_request(options: Mapping[str, Any]) -> FitRequest:
    """The fit by `[fit]` of a robot file."""
    energy, below = options.get("model") == "energy", options.get("essential_below")
    return FitRequest(options.get("method", "weighted"), energy, options.get("window"), (), below)


@dataclasses.dataclass(frozen=True, eq=False)
class FitOutcome:
    """What a way to fit ends in.

    Attributes:
        result: not judged yet.
        told: doubts that it raises itself.
        refit: how to fit again without some rows; None: least squares.
        lines: printed above the result.
        further: fields of the JSON.
        equations: that were fitted; None: those of the bare robot.
    """

    result: estimation.FitResult
    warnings: Sequence[DataWarning] = ()
    refit: Callable[[np.ndarray], np.ndarray] | None = None
    lines: Sequence[str] = ()
    further: Mapping[str, Any] = dataclasses.field(default_factory=dict)
    equations: estimation.Equations | None = None


def run_estimator(
    request: FitRequest, robot: Robot, compiled: CompiledModel, observation: Observation
) -> FitOutcome:
    """The fit that is asked for.

    Raises:
        DataError: choices that do not go together, or what the estimator refuses.
    """
    _check_request(request)
    if request.energy or request.method == TWO_STEPS:
        what = "the energy model" if request.energy else f"method {request.method}"
        unused = estimation.describe_unused_prior(compiled.spec, what, _UNUSED)
    method: Any = request.method
    if request.energy:
        energy = estimation.identify_energy(
            compiled, observation, request.window, method, request.below
        )
        return FitOutcome(_append_sentences(energy.result, unused), refit=energy.fit_without)
    if request.method == TWO_STEPS:
        ways = estimation.JointDirections(compute_joint_directions(robot))
        steps = estimation.two_step_result.identify_in_two_steps(
            compiled, observation, ways, request.below
        )
        further = {"two_step": steps.to_json()}
        result = _append_sentences(steps.result, unused)
        return FitOutcome(
            result, steps.collect_warnings(), lines=steps.format_lines(), further=further
        )
    if request.payloads:
        result = estimation.identify_with_payloads(
            compiled, observation, request.payloads, method, request.below
        )
        current = estimation.are_currents(observation.report.logs)
        warnings = estimation.check_known_quantities(
            compiled, observation, request.payloads, current
        )
        equations = estimation.build_loaded_equations(
            compiled, observation, request.payloads
        ).equations
        return FitOutcome(result, warnings, equations=equations)
    return FitOutcome(estimation.identify(observation, method, compiled, request.below))


_UNUSED = ", nor the values of the robot file"


def _append_sentences(fit: estimation.FitResult, sentences: Sequence[str]) -> estimation.FitResult:
    return dataclasses.replace(fit, sentences=(*fit.sentences, *sentences))


def add_verdict(
    compiled: CompiledModel,
    observation: Observation,
    outcome: FitOutcome,
    data: CompressedRegression | None = None,
) -> estimation.FitResult:
    """Its result with the verdict, to which all that is found in the logs counts.

    Args:
        compiled: the robot.
        observation: that was fitted.
        outcome: how.
        data: all rows that were fitted, where the observation has a part of them only.
    """
    warnings = [*outcome.warnings, *estimation.find_log_faults(compiled, observation)]
    return estimation.judge_fit(
        compiled, observation, outcome.result, warnings, outcome.equations, outcome.refit, data
    )


def _check_request(request: FitRequest) -> None:
    """Refuse choices that do not go together."""
    if request.method == GAIN_METHOD:
        raise DataError(
            f"fit: got method {GAIN_METHOD}, which reads the logs itself; call fit_gains with "
            "them and the mass of the load"
        )
    known = [*ABOUT, TWO_STEPS]
    if request.method not in known:
        raise DataError(
            f"fit: got method {request.method}{suggest_name(str(request.method), known)}; expected "
            "one of "
            f"{', '.join(known)}"
        )
    if request.payloads and (request.energy or request.method in WITHOUT_LOADS):
        what = "the energy model" if request.energy else f"method {request.method}"
        raise DataError(f"fit: got payloads with {what}, which knows no loads; leave them out")
    if request.energy and request.method not in OF_WINDOWS:
        raise DataError(
            f"fit: got method {request.method} for the energy model, whose rows are windows; "
            f"expected {' or '.join(OF_WINDOWS)}"
        )
    if request.window is not None and not request.energy:
        raise DataError("fit: got a window; only those of the energy model have a length")


def fit(
    derivation: Derivation,
    emitted: EmittedModule,
    observation: Observation,
    method: Method | Literal["two-step"] = "weighted",
    *,
    energy: bool = False,
    window: float | None = None,
    payloads: Sequence[estimation.Payload] = (),
    essential_below: float | None = None,
) -> Model:
    """The base parameters from an observation, with all that a model file holds.

    >>> fit(derivation, emitted, observe(compiled, ["mon.parquet"]), "robust").fit.method
    'robust'

    Args:
        derivation: of the robot.
        emitted: its C.
        observation: of its logs.
        method: one of `estimators()`, or "two-step"; for "tls" see `fit_gains`.
        energy: True for the energy model, whose rows are windows (docs/how-to/energy-model.md).
        window: their length, s; None: the spacing of the torque model's rows.
        payloads: loads, each with the names of the logs that carry it.
        essential_below: percent; parameters whose sigma, in percent of the value, cannot be kept
            below are left out of the reduced model; None: those that an F-test does not miss.

    Raises:
        DataError: the derivation, the C and the observation are not of one robot; or see
            `identify`.
    """
    names = tuple(base.name for base in emitted.spec.base)
    for what, other in (("derivation", derivation.robot.name), ("observation", observation.robot)):
        if other != emitted.spec.robot:
            raise DataError(
                f"fit: the {what} is of {other} and the C of {emitted.spec.robot}; expected one "
                "robot; derive, generate and observe it again"
            )
    if observation.names != names:
        raise DataError(
            f"fit: the observation has the base parameters {', '.join(observation.names)}, the C "
            f"{', '.join(names)}; expected the same; observe with this C"
        )
    request = FitRequest(method, energy, window, tuple(payloads), essential_below)
    return fit_observation(
        request, derivation, emitted, workflow.compile_model(emitted), observation
    )[0]


def fit_observation(
    request: FitRequest,
    derivation: Derivation,
    emitted: EmittedModule,
    compiled: CompiledModel,
    observation: Observation,
    report_step: Steps = ignore_step,
) -> tuple[Model, FitOutcome]:
    """The same, and the way that was taken."""
    with report_step("estimating"):
        outcome = run_estimator(request, derivation.robot, compiled, observation)
    with report_step("judging the fit"):
        result = add_verdict(compiled, observation, outcome)
    return assemble_model(derivation, emitted, observation, result), outcome


def assemble_model(
    derivation: Derivation,
    emitted: EmittedModule,
    observation: Observation,
    result: estimation.FitResult,
) -> Model:
    """A fit with all that a model file holds.

    >>> seen = observe(compiled, ["mon.parquet"])
    >>> assemble_model(derivation, emitted, seen, model.fit)["ZZ1R"].unit
    'kg m2'
    """
    return Model(
        robot_text=derivation.robot.text,
        spec=emitted.spec,
        sources=emitted.code,
        fit=result,
        logs=estimation.collect_provenance(observation.report),
    )


# Drive gains from a weighed load.


@dataclasses.dataclass(frozen=True)
class Load:
    """A load of known mass that some logs carry.

    >>> Load("tue.parquet", mass=1.5).logs
    ['tue.parquet']

    Attributes:
        logs: the loaded logs.
        mass: kg.
        link: row of the table; None: the platform, or the last joint's link.
        moved: True if it was taken off between these logs.
    """

    logs: Sequence[AnyLog]
    mass: float | None
    link: str | None = None
    moved: bool = False

    def __post_init__(self) -> None:
        """One log alone stands for a list of it."""
        object.__setattr__(self, "logs", workflow.convert_to_list(self.logs))

    def build_payloads(self, loaded: Sequence[Log]) -> list[estimation.Payload]:
        """It, as the fit knows it; one for each log if it was taken off in between."""
        payload = estimation.Payload(tuple(log.name for log in loaded), self.link, self.mass)
        return estimation.separate_payload(payload) if self.moved else [payload]


def fit_gains(
    derivation: Derivation, logs: Logs, load: Load, processing: Processing | None = None
) -> Model:
    """The model whose robot file has the drive gains that logs tell (docs/how-to/drive-gains.md).

    Args:
        derivation: of the robot; its file states no gains, or starts for them.
        logs: of currents, without load.
        load: that was weighed, and the logs that carry it.
        processing: None: chosen from the logs.

    Raises:
        DataError: logs of torques, rows given twice, or gains that the logs do not tell.
    """
    compiled = workflow.compile_model(workflow.generate(derivation))
    return identify_gains(
        derivation, compiled, workflow.convert_to_list(logs), load, processing or Processing()
    )[0]


def identify_gains(
    derivation: Derivation,
    compiled: CompiledModel,
    logs: Sequence[AnyLog],
    load: Load,
    processing: Processing,
    check: Callable[[Sequence[Log], Sequence[Log]], None] | None = None,
    report_step: Steps = ignore_step,
    mapping: Mapped = (),
) -> tuple[Model, Observation]:
    """The same, and the observation that the model was fitted to.

    The gains are found first. Then the logs are read once more with them, as whoever uses the model
    will: all that is told of the fit is told of those torques. `check` refuses logs, bare and
    loaded, that do not belong together; None: those that share rows.
    """
    unused = estimation.describe_unused_prior(compiled.spec, f"method {GAIN_METHOD}", _UNUSED)

    def observe_logs(
        model: CompiledModel, processing: Processing
    ) -> tuple[Observation, list[estimation.Payload]]:
        bare, loaded = (workflow.read_currents(model, some, mapping) for some in (logs, load.logs))
        if check is None:
            check_no_overlap([*bare, *loaded])
        else:
            check(bare, loaded)
        return observe(model, [*bare, *loaded], processing), load.build_payloads(loaded)

    with report_step("finding the drive gains"):
        observation, payloads = observe_logs(compiled, processing)
        gain_estimates = estimation.identify_gains(compiled, observation, payloads)
    choices = observation.report.choices
    with report_step("reading the currents with these gains"):
        gains = {joint: float(f"{gain:.7g}") for joint, gain in gain_estimates.gains.items()}
        text = replace_drive_gains(derivation.robot.text, gains)
        robot = parse_robot_text(text, derivation.robot.name)
        symbolic = dataclasses.replace(derivation.model, robot=robot)
        derivation = dataclasses.replace(derivation, robot=robot, model=symbolic)
        emitted = workflow.generate(derivation)
        again = workflow.compile_model(emitted)
        bands = observation.report.bands
        observation, payloads = observe_logs(again, observation.report.processing)
        report = dataclasses.replace(observation.report, choices=choices, lowered=bands)
        observation = dataclasses.replace(observation, report=report)
        result = estimation.identify_gains(again, observation, payloads).result
    with report_step("judging the fit"):
        unseparated = estimation.find_heterogeneous_logs(again, observation, payloads)
        warnings = [DataWarning(line, affects_values=True) for line in unseparated]
        equations = estimation.build_loaded_equations(again, observation, payloads).equations
        result = add_verdict(again, observation, FitOutcome(result, warnings, equations=equations))
    if lines := estimation.describe_deviations(compiled.spec, gain_estimates):
        unused += (f"against the robot file: {'; '.join(lines)}",)
    result = _append_sentences(result, unused)
    return assemble_model(derivation, emitted, observation, result), observation


# All estimators on the same logs, side by side.


def compare_methods(
    robot: Robot | CompiledModel,
    logs: Logs,
    holdout: Logs = (),
    methods: Sequence[str] | None = None,
    progress: Callable[[float], None] | None = None,
) -> estimation.MethodComparison:
    """Every estimator on the same logs: values, errors, seconds, and what each says of itself.

    >>> found = compare_methods(compiled, ["mon.parquet"], methods=["weighted", "ridge"])
    >>> [result.method for result in found.results]
    ['weighted', 'ridge']

    Args:
        robot: as loaded, or compiled.
        logs: to fit.
        holdout: logs of other motion, not fitted: their error.
        methods: some of `estimators()`; None: all.
        progress: called with the share done, 0 to 1.

    Raises:
        DataError: an unknown method, rows given twice, or what the weighted fit raises.
    """
    chosen = select_methods(methods)
    compiled = (
        workflow.compile_model(workflow.generate(workflow.derive(robot)))
        if isinstance(robot, Robot)
        else robot
    )
    observation, held_out = observe_held_out(compiled, logs, holdout)
    tried = estimation.compare_methods(observation, compiled, held_out, chosen, progress)
    return estimation.MethodComparison(
        compiled.spec.robot, tried, tuple(observation.report.format_lines())
    )


def observe_held_out(
    compiled: CompiledModel,
    logs: Logs,
    holdout: Logs,
    mapping: Mapped = (),
    processing: Processing | None = None,
) -> tuple[Observation, Observation | None]:
    """Logs to fit, and held-out ones processed alike; None without any."""
    training_logs, held_out_logs = (
        workflow.read_logs(compiled, some, mapping) for some in (logs, holdout)
    )
    check_no_overlap(training_logs, held_out_logs)
    observation = observe(compiled, training_logs, processing)
    held_out = (
        observe(compiled, held_out_logs, observation.report.processing) if held_out_logs else None
    )
    return observation, held_out


def select_methods(names: Sequence[str] | None, where: str = "methods") -> list[Method]:
    """The estimators of these names, each once; all for None."""
    if names is None:
        return list(ABOUT)
    chosen = [id for name in names for id in ABOUT if id == name]
    unknown = [name for name in names if name not in chosen]
    if unknown or not names:
        got = unknown[0] if unknown else "nothing"
        raise DataError(
            f"{where}: got {got}{suggest_name(got, list(ABOUT))}; expected some of "
            f"{', '.join(ABOUT)}, with commas between"
        )
    return [*dict.fromkeys(chosen)]
