"""Fits: of either model, with loads or without, of logs of any length; all estimators at once."""

import dataclasses
import warnings
from collections.abc import Callable, Mapping, Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Any, Literal

import numpy as np

from modeler import estimation, regression
from modeler.api import workflow
from modeler.api.chunk_workers import can_read_from_middle, make_worker_reducer
from modeler.api.log_maps import Mapped, resolve_mapping
from modeler.api.model import Model
from modeler.api.workflow import (
    AnyLog,
    CompiledRobot,
    Logs,
    Steps,
    compile_robot,
    convert_to_list,
    read_logs,
)
from modeler.codegen import Derivation
from modeler.core.choices import GAIN_METHOD, TWO_STEPS, Method
from modeler.core.errors import DataError, FitWarning
from modeler.core.jobs import SILENT, Reporter, open_workers
from modeler.core.manifest import EmittedModule
from modeler.core.options import METHODS, FitOptions, OptionError
from modeler.derivation import complete_home
from modeler.estimation import OF_TRIANGLES, long_logs as chunked
from modeler.formats import read_robot
from modeler.numerics.least_squares import CompressedRegression
from modeler.regression import (
    DataWarning,
    Log,
    Observation,
    Processing,
    check_no_overlap,
    observe,
    rebuild_observation,
)
from modeler.robot import (
    Robot,
    compute_joint_directions,
    parse_robot_text,
    replace_drive_gains,
    replace_robot_effects,
    suggest_name,
)
from modeler.runtime import CompiledModel


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
        object.__setattr__(self, "logs", convert_to_list(self.logs))

    def build_payloads(self, loaded: Sequence[Log]) -> list[estimation.Payload]:
        """Returns the payloads of the fit: one, or one for each log if it was remounted."""
        payload = estimation.Payload(tuple(log.name for log in loaded), self.link, self.mass)
        return estimation.separate_payload(payload) if self.moved else [payload]


def check_options(options: FitOptions, load: Load | None = None) -> None:
    """Raises an error for options of a fit that do not go together.

    Args:
        options: of the fit.
        load: that some logs carry; None: none.

    Raises:
        DataError: names the options, and says what to do.
    """
    method, energy, gains = options.method, options.model == "energy", options.method == GAIN_METHOD
    loads, windows = (", ".join(estimation.find_methods(of)) for of in ("loads", "windows"))
    loaded, moved = bool(load and load.logs), load is not None and load.moved
    refusals = {
        f"got method {method}{suggest_name(str(method), METHODS)}; expected one of "
        f"{', '.join(METHODS)}": method not in METHODS,
        "{--payload_mass}, {--payload_link} and {--payload_moved} need a log with the load; name "
        "it with {--payload_log} LOG, in Python load=Load(logs)": (
            load is not None and not loaded and (moved or {load.mass, load.link} != {None})
        ),
        f"method {method} takes no logs with a load; expected {loads} or {GAIN_METHOD}": (
            loaded and not gains and method not in loads.split(", ")
        ),
        f"method {method} has no reduced model; leave {{--essential_below}} out": (
            gains and options.essential_below is not None
        ),
        "a window needs the energy model; add {--model} energy, or leave {--window} out": (
            options.window is not None and not energy
        ),
        f"the energy model does not take method {method}; expected {windows}": (
            energy and method not in windows.split(", ")
        ),
        "the energy model takes no logs with a load; leave out one of them": energy and loaded,
        f"method {method} needs a log with a load of known mass; give {{--payload_log}} LOG "
        "{--payload_mass} KG, in Python load=Load(logs, mass)": gains and not loaded,
        f"method {method} needs the mass of the load, which fixes the scale of all gains; add "
        "{--payload_mass} KG": gains and load is not None and load.mass is None,
    }
    for why, refused in refusals.items():
        if refused:
            raise OptionError(f"fit: {why}")


@dataclasses.dataclass(frozen=True, eq=False)
class FitOutcome:
    """Holds the result of an estimator before it is judged.

    Attributes:
        result: without verdict.
        warnings: of the estimator itself.
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
    options: FitOptions,
    robot: Robot,
    compiled: CompiledModel,
    observation: Observation,
    payloads: Sequence[estimation.Payload] = (),
) -> FitOutcome:
    """Runs the requested estimator.

    Raises:
        DataError: choices that do not go together, or what the estimator refuses.
    """
    energy = options.model == "energy"
    if energy or options.method == TWO_STEPS:
        what = "the energy model" if energy else f"method {options.method}"
        unused = estimation.describe_unused_prior(compiled.spec, what, _UNUSED)
    method: Any = options.method
    below = options.essential_below
    if energy:
        fit = estimation.identify_energy(compiled, observation, options.window, method, below)
        return FitOutcome(_append_sentences(fit.result, unused), refit=fit.fit_without)
    if options.method == TWO_STEPS:
        ways = estimation.JointDirections(compute_joint_directions(robot))
        steps = estimation.identify_in_two_steps(compiled, observation, ways, below)
        further = {"two_step": steps.to_json()}
        result = _append_sentences(steps.result, unused)
        return FitOutcome(
            result, steps.collect_warnings(), lines=steps.format_lines(), further=further
        )
    if payloads:
        result = estimation.identify_with_payloads(compiled, observation, payloads, method, below)
        current = estimation.are_currents(observation.report.logs)
        faults = estimation.check_known_quantities(compiled, observation, payloads, current)
        equations = estimation.build_loaded_equations(compiled, observation, payloads).equations
        return FitOutcome(result, faults, equations=equations)
    if compiled.spec.windups:
        result, equations = estimation.identify_elastic(observation, method, compiled, below)
        return FitOutcome(result, equations=equations)
    return FitOutcome(estimation.identify(observation, method, compiled, below))


_UNUSED = ", nor the values of the robot file"


def _append_sentences(fit: estimation.FitResult, sentences: Sequence[str]) -> estimation.FitResult:
    return dataclasses.replace(fit, sentences=(*fit.sentences, *sentences))


def add_verdict(
    compiled: CompiledModel,
    observation: Observation,
    outcome: FitOutcome,
    data: CompressedRegression | None = None,
) -> estimation.FitResult:
    """Adds the verdict to a result, with all warnings that the logs give.

    Args:
        compiled: the robot.
        observation: that was fitted.
        outcome: how.
        data: all rows that were fitted, where the observation has a part of them only.
    """
    faults = [*outcome.warnings, *estimation.find_log_faults(compiled, observation)]
    return estimation.judge_fit(
        compiled, observation, outcome.result, faults, outcome.equations, outcome.refit, data
    )


def fit_observation(
    options: FitOptions,
    robot: CompiledRobot,
    observation: Observation,
    payloads: Sequence[estimation.Payload] = (),
    report_step: Steps = SILENT.report_step,
) -> tuple[Model, FitOutcome]:
    """Estimates the base parameters and returns the model with the outcome of the estimator."""
    with report_step("estimating"):
        outcome = run_estimator(
            options, robot.derivation.robot, robot.compiled, observation, payloads
        )
    with report_step("judging the fit"):
        fit = outcome.result
        compiled = robot.compiled.set_windup(fit.beta, fit.elastic_values)
        if fit.elastic:
            observation = rebuild_observation(compiled, observation)
        result = add_verdict(compiled, observation, outcome)
    return assemble_model(robot.derivation, robot.emitted, observation, result), outcome


def assemble_model(
    derivation: Derivation,
    emitted: EmittedModule,
    observation: Observation,
    result: estimation.FitResult,
) -> Model:
    """Assembles a model from a derivation, its C, an observation and a fit.

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


# From a robot and its logs to a model.


Effects = str | Sequence[str] | Mapping[str, Any]
"""Effects that every joint has, by their ids; or a table as [effects] of a robot file."""


def prepare_robot(robot: Robot | str | Path, effects: Effects | None = None) -> Robot:
    """Reads a robot, sets its effects, and finds [home] if it has loops.

    Raises:
        RobotError: no such robot, or no such effect.
    """
    robot = robot if isinstance(robot, Robot) else read_robot(robot)
    if effects is not None:
        robot = replace_robot_effects(robot, effects, "effects")
    return complete_home(robot).write_to_text(robot) if robot.loops else robot


def _read_in_memory_logs(
    compiled: CompiledModel, logs: Sequence[AnyLog], mapping: Mapped
) -> list[AnyLog]:
    """Paths as they are, and what else there is as it was read."""
    paths = (str, Path)
    others = read_logs(compiled, [log for log in logs if not isinstance(log, paths)], mapping)
    rest = iter(others)
    return [log if isinstance(log, paths) else next(rest) for log in logs]


def identify(
    robot: Robot | str | Path,
    logs: Logs,
    holdout: Logs = (),
    method: Method | Literal["two-step"] | None = None,
    *,
    mapping: Mapped = (),
    effects: Effects | None = None,
    load: Load | None = None,
    processing: Processing | None = None,
    reporter: Reporter = SILENT,
) -> Model:
    """Identifies a robot from its logs, as `modeler fit` does, and returns the model.

    >>> run = simulate(open_robot("two-link"), duration=6.0, seed=1)
    >>> model = identify("two-link", {"time": run.time, "q": run.q, "tau": run.tau})
    >>> model["Fs2"].unit, model.fit.verdict.valid
    ('N m', True)

    Args:
        robot: as loaded; its file, or the name of a built-in one.
        logs: to fit: paths, pieces of files (`run.parquet@0:10`), frames, dicts of arrays.
        holdout: logs of other motion that are not fitted; `error`, `missing`, `add` judge on them.
        method: one of `estimators()`, or "two-step"; None: that of [fit] of the robot file, whose
            other options hold too, or "weighted".
        mapping: whose column is which, over [log] of the robot file; "auto" takes the guess. It is
            kept in the model.
        effects: instead of those of the robot file.
        load: that some logs carry.
        processing: of the logs; None: by [fit] of the robot file, or chosen from them.
        reporter: of the progress.

    Warns:
        FitWarning: the fit is not usable; says why and what to do.

    Raises:
        RobotError: a mistake in the robot file, or an effect that there is not.
        DataError: a log cannot be read, rows are given twice, or cannot be fitted.
    """
    robot = prepare_robot(robot, effects)
    training_logs, held_out_logs = convert_to_list(logs), convert_to_list(holdout)
    stated = {**robot.fit, **({} if method is None else {"method": method})}
    options = FitOptions.from_names(stated)
    check_options(options, load)
    with reporter.report_step(f"deriving {robot.name}"):
        compiled_robot = compile_robot(robot)
    compiled = compiled_robot.compiled
    mapping, stored_mapping = resolve_mapping(compiled, training_logs, mapping)
    held_out_logs = _read_in_memory_logs(compiled, held_out_logs, mapping)
    training_logs = _read_in_memory_logs(compiled, training_logs, mapping)
    gains = options.method == GAIN_METHOD
    others = () if gains else read_logs(compiled, held_out_logs, mapping)
    model, _, _, loaded = fit_logs(
        *(options, compiled_robot, training_logs, load or Load((), None)),
        *(processing or workflow.build_processing(stated), mapping, others, reporter),
    )
    for line in model.warning:
        warnings.warn(line, FitWarning, stacklevel=2)  # of who called
    memory = [log for log in training_logs if isinstance(log, Log)]
    memory += [log for log in loaded if not log.path]
    return dataclasses.replace(
        model,
        mapping=stored_mapping,
        in_memory_logs=tuple(memory),
        held_out=tuple(held_out_logs),
        folder=str(Path.cwd()),
    )


def fit_logs(
    options: FitOptions,
    robot: CompiledRobot,
    logs: Sequence[AnyLog],
    load: Load,
    processing: Processing,
    mapping: Mapped,
    held_out: Sequence[Log] = (),
    reporter: Reporter = SILENT,
    dask: str | None = None,
) -> tuple[Model, Observation, FitOutcome, list[Log]]:
    """Fits logs of any length by any method.

    Args:
        options: of the fit.
        robot: compiled.
        logs: without load.
        load: and the logs that carry it, if any do.
        processing: of the logs.
        mapping: as of `read_logs`.
        held_out: logs that must share no rows with the others.
        reporter: of its progress.
        dask: address of a scheduler whose workers read long logs, or "local".

    Returns:
        The model, the observation it was fitted to, the outcome, and the loaded logs.

    Raises:
        DataError: logs that do not belong together, or such as no worker can read.
    """
    if options.method == GAIN_METHOD:
        gain_fit = _fit_gains(
            *(robot.derivation, robot.compiled, logs, load, processing),
            *(held_out, reporter.report_step, mapping),
        )
        return *gain_fit, FitOutcome(gain_fit[0].fit), []
    check_dask(options, load, dask)
    long = _fit_if_long(options, robot, logs, load.logs, processing, mapping, reporter, dask)
    if long is not None:
        return *long, FitOutcome(long[0].fit), []
    with reporter.report_step("building the observation matrix"):
        bare, loaded = (read_logs(robot.compiled, some, mapping) for some in (logs, load.logs))
        _check_logs(logs, bare, load.logs, loaded, held_out)
        # blocks of time are compared for one machine, and a load makes it another
        observation = observe(robot.compiled, [*bare, *loaded], processing, not loaded)
    payloads = load.build_payloads(loaded) if loaded else ()
    model, outcome = fit_observation(options, robot, observation, payloads, reporter.report_step)
    return model, observation, outcome, loaded


def check_dask(options: FitOptions, load: Load, dask: str | None) -> None:
    """Raises an error for workers where the fit needs all rows in one memory."""
    why = describe_whole_fit(options, load.logs)
    if dask is not None and why:
        raise OptionError(
            f"{{--dask}} {dask}: got {why}, which needs all rows in one memory; expected "
            f"{{--method}} {' or '.join(OF_TRIANGLES)} of the torque model; leave {{--dask}} out"
        )


def _check_logs(
    bare_places: Sequence[AnyLog],
    bare: Sequence[Log],
    loaded_places: Sequence[AnyLog],
    loaded: Sequence[Log],
    held_out: Sequence[Log],
) -> None:
    """Refuses rows given twice, and a loaded log by the name of one without load."""
    logs = [*bare, *loaded]
    places = [
        str(place) if isinstance(place, str | Path) else log.name
        for place, log in zip([*bare_places, *loaded_places], logs, strict=True)
    ]
    check_no_overlap(logs, held_out, places)
    place_by_name = {log.name: place for place, log in zip(places, bare, strict=False)}
    for place, log in zip(places[len(bare) :], loaded, strict=True):
        if log.name in place_by_name:
            raise DataError(
                f"{place}: carries the load, and {place_by_name[log.name]} has the same file "
                "name; rename one, loads are assigned by name"
            )


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
    """Estimates the base parameters from an observation and returns the model.

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
    if method == GAIN_METHOD:  # for callers without a type checker
        raise DataError(f"fit: method {method} reads the logs itself; call fit_gains")
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
    options = FitOptions(method, "energy" if energy else "torque", window, essential_below)
    loaded = [name for payload in payloads for name in payload.logs]
    check_options(options, Load(loaded, 1.0) if loaded else None)
    robot = CompiledRobot(derivation, emitted, workflow.compile_model(emitted))
    return fit_observation(options, robot, observation, payloads)[0]


# Drive gains from a weighed load.


def fit_gains(
    derivation: Derivation, logs: Logs, load: Load, processing: Processing | None = None
) -> Model:
    """Estimates drive gains and returns the model with them (docs/how-to/drive-gains.md).

    Args:
        derivation: of the robot; its file states no gains, or starts for them.
        logs: of currents, without load.
        load: that was weighed, and the logs that carry it.
        processing: None: chosen from the logs.

    Raises:
        DataError: logs of torques, rows given twice, or gains that the logs do not identify.
    """
    compiled = workflow.compile_model(workflow.generate(derivation))
    processing = processing or Processing()
    return _fit_gains(derivation, compiled, convert_to_list(logs), load, processing)[0]


def _fit_gains(
    derivation: Derivation,
    compiled: CompiledModel,
    logs: Sequence[AnyLog],
    load: Load,
    processing: Processing,
    held_out: Sequence[Log] = (),
    report_step: Steps = SILENT.report_step,
    mapping: Mapped = (),
) -> tuple[Model, Observation]:
    """Estimates drive gains, and returns the model and the observation it was fitted to.

    The gains are found first. Then the logs are read once more with them, as whoever uses the model
    will: all that is told of the fit is told of those torques.
    """
    unused = estimation.describe_unused_prior(compiled.spec, f"method {GAIN_METHOD}", _UNUSED)

    def observe_logs(
        model: CompiledModel, processing: Processing
    ) -> tuple[Observation, list[estimation.Payload]]:
        bare, loaded = (workflow.read_currents(model, some, mapping) for some in (logs, load.logs))
        _check_logs(logs, bare, load.logs, loaded, held_out)
        rows = observe(model, [*bare, *loaded], processing, is_compared=False)
        return rows, load.build_payloads(loaded)

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
        faults = [
            DataWarning(line, affects_values=True, code="known_quantity") for line in unseparated
        ]
        equations = estimation.build_loaded_equations(again, observation, payloads).equations
        result = add_verdict(again, observation, FitOutcome(result, faults, equations=equations))
    if lines := estimation.describe_deviations(compiled.spec, gain_estimates):
        unused += (f"against the robot file: {'; '.join(lines)}",)
    result = _append_sentences(result, unused)
    return assemble_model(derivation, emitted, observation, result), observation


# Long logs, which never have all rows in memory.


def fit_long(
    derivation: Derivation,
    emitted: EmittedModule,
    compiled: CompiledModel,
    sources: Sequence[regression.Source],
    method: Method = "weighted",
    processing: Processing | None = None,
    progress: Callable[[float], None] = lambda share: None,
    reducer: chunked.Reducer | None = None,
) -> tuple[Model, chunked.StreamedLogs]:
    """Fits logs of any length in constant memory; see `estimation.long_logs.stream_logs`.

    Args:
        derivation: of the robot.
        emitted: its C.
        compiled: that, callable.
        sources: of the logs.
        method: "weighted" or "ordinary".
        processing: None: automatic.
        progress: receives the share of the rows that are done.
        reducer: of one log; None: threads of this process. See `make_worker_reducer`.

    Raises:
        DataError: see `stream` and `identify_long`.
    """
    streamed = chunked.stream_logs(compiled, sources, processing, progress, reducer=reducer)
    check_no_overlap(streamed.observation.report.logs)
    result = add_long_verdict(compiled, streamed, method)
    return assemble_model(derivation, emitted, streamed.observation, result), streamed


def _fit_if_long(
    options: FitOptions,
    robot: CompiledRobot,
    logs: Sequence[AnyLog],
    loaded: Sequence[AnyLog],
    processing: Processing,
    mapping: Mapped,
    reporter: Reporter,
    dask: str | None,
) -> tuple[Model, Observation] | None:
    """Fits long logs in chunks; returns None where all rows must be in memory.

    Raises:
        DataError: they have more rows than an estimator may have that needs all of them.
    """
    every = [*logs, *loaded]
    if dask is None and not workflow.are_long(every):
        return None
    if why := describe_whole_fit(options, loaded):
        workflow.check_fits_memory(every, why)
        return None
    try:
        with (
            reporter.show_progress("reading and reducing") as bar,
            nullcontext() if dask is None else open_workers(dask) as workers,
        ):
            sources = workflow.open_sources(robot.compiled, logs, mapping)
            reducer = None if workers is None else make_worker_reducer(workers, robot.emitted)
            here = [each.name for each in sources if not can_read_from_middle(each)]
            if workers is not None and here:
                reporter.print_note(
                    f"{', '.join(here)}: read and reduced by this process; workers of dask can "
                    "begin in the middle of Parquet files only"
                )
            method: Any = options.method
            model, streamed = fit_long(
                *(robot.derivation, robot.emitted, robot.compiled, sources),
                *(method, processing, bar, reducer),
            )
    except regression.WholeLogNeeded as error:
        if workflow.are_too_long(every):
            raise
        reporter.print_note(f"{error}; read as a whole instead")
        return None
    return model, streamed.observation


def describe_whole_fit(options: FitOptions, loaded: Sequence[AnyLog]) -> str:
    """Returns the option for which a fit needs all rows in memory; "" for none."""
    if loaded:
        return "{--payload_log}"
    if options.essential_below is not None:
        return "{--essential_below}"
    if options.model == "energy":
        return "{--model} energy"
    return "" if options.method in OF_TRIANGLES else f"{{--method}} {options.method}"


def add_long_verdict(
    compiled: CompiledModel, streamed: chunked.StreamedLogs, method: Method
) -> estimation.FitResult:
    """Estimates the parameters of long logs and adds the verdict."""
    outcome = FitOutcome(chunked.identify_long(streamed, method, compiled))
    return add_verdict(compiled, streamed.observation, outcome, streamed.data)
