"""Is a model true? Comparisons, free runs, several models on the same rows."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from string import ascii_uppercase
from typing import Any, Literal, overload

import numpy as np

import modeler.api.workflow as workflow
from modeler import estimation, regression, validation
from modeler.api.log_maps import Mapped, build_log_maps, parse_time_range
from modeler.api.workflow import AnyLog, Logs, are_long, are_too_long, compile_robot, open_sources
from modeler.core.choices import ABOUT, Method, find_estimator_title
from modeler.core.errors import DataError
from modeler.core.jobs import SILENT, Reporter
from modeler.core.json import Document
from modeler.core.manifest import JointSpec
from modeler.core.options import CompareOptions, OptionError
from modeler.core.table import label_values
from modeler.derivation import complete_home
from modeler.estimation import FitResult, IdentifiedModel, ParameterEstimate
from modeler.logs import LogTable, split_joints
from modeler.regression import (
    DataWarning,
    Log,
    Observation,
    Processing,
    WholeLogNeeded,
    check_no_overlap,
    observe,
)
from modeler.robot import Robot, suggest_name
from modeler.runtime import CompiledModel
from modeler.simulation import SimulatedLog


@overload
def compare(
    model: IdentifiedModel | Robot,
    logs: Logs,
    mapping: Mapped = (),
    *,
    free_run: Literal[False] = False,
    **options: Any,
) -> validation.Comparison: ...


@overload
def compare(
    model: IdentifiedModel | Robot,
    logs: Logs,
    mapping: Mapped = (),
    *,
    free_run: Literal[True],
    **options: Any,
) -> validation.FreeRun: ...


def compare(
    model: IdentifiedModel | Robot, logs: Logs, mapping: Mapped = (), **options: Any
) -> validation.Comparison | validation.FreeRun:
    """Compares measured with predicted torque on logs, after the processing of the fit.

    >>> [joint.joint.name for joint in compare(model, ["tue.parquet"]).joints]
    ['1', '2']

    Args:
        model: fitted; or a robot, with the values that its file states and 0 for all others.
        logs: that it predicts.
        mapping: as of `read_logs`.
        options: of `CompareOptions`: essential, run_embedded_c; payload_mass [kg], payload_centre
            ("X,Y,Z", m), payload_link; free_run (positions in place of torques), and with it
            window [s], bound [share of the range of motion], controller ("HZ,RATIO").

    Raises:
        DataError: an option that is none, or that cannot be.
    """
    chosen = CompareOptions.from_keywords("compare", options)
    if chosen.free_run:
        settings = build_free_run_settings(chosen)
        return simulate_positions(model, logs, chosen, settings, mapping)[0]
    (prepared,) = prepare_models([model], chosen)
    compiled = compile_for_comparison(prepared, chosen)
    return compare_logs(prepared, workflow.convert_to_list(logs), compiled, mapping)[0]


def prepare_models(
    things: Sequence[IdentifiedModel | Robot], options: CompareOptions
) -> list[IdentifiedModel]:
    """Returns models, as the options want them: reduced, or of the robot with a load.

    Of a robot its `stated_model`, processed as the first model is.

    Raises:
        DataError: a robot of which a fit is wanted, or a load that cannot be.
    """
    for thing in things:
        for name in ("essential", "run_embedded_c"):
            if isinstance(thing, Robot) and getattr(options, name):
                raise OptionError(
                    f"{{--{name}}}: {thing.name} is a robot; expected a model of `modeler fit`; "
                    f"leave {{--{name}}} out"
                )
    models = resolve_models(things)
    if options.essential:
        models = [estimation.keep_essential(m, f"model of {m.spec.robot}") for m in models]
    if options.payload_mass is None:
        return models
    text = options.payload_centre or "0,0,0"
    try:
        centre = [float(part) for part in text.split(",")]
    except ValueError:
        raise OptionError(
            f"{{--payload_centre}} {text}: expected x, y and z in m, as in 0,0,0.05"
        ) from None
    return [
        estimation.add_known_load(model, options.payload_mass, centre, options.payload_link)
        for model in models
    ]


def compile_for_comparison(model: IdentifiedModel, options: CompareOptions) -> CompiledModel:
    """Compiles the C of a model: emitted anew, or as the model has it."""
    return model.compile() if options.run_embedded_c else workflow.compile(model)


_TRAINING = "training only: "


@dataclass(frozen=True, eq=False)
class ComparisonRun(Document):
    """A comparison, and what it is worth.

    Attributes:
        model: that was compared, with its load if it has one.
        comparison: of it with the logs.
        lines: where the model and the logs come from.
        findings: faults of the logs.
        is_held_out: False if the model was fitted on some of the logs.
        beside: the same model without its load; None without one.
        machine: that of the logs, compared with that of the fit; None where it was fitted on them.
    """

    KEYS = """
        *comparison warnings machine_changed=machine.changes
        unexplained_change=machine.unexplained
    """

    model: IdentifiedModel
    comparison: validation.Comparison
    lines: Sequence[str]
    findings: Sequence[DataWarning]
    is_held_out: bool
    beside: validation.ModelComparison | None
    machine: estimation.MachineComparison | None

    @property
    def is_noise_like(self) -> bool:
        """Returns True if no joint's residual has structure, and nothing is wrong with the fit."""
        like = all(validation.is_noise_like(joint) for joint in self.comparison.joints)
        return like and not self.model.warning

    def format_lines(self) -> list[str]:
        """Returns the table, the verdict, and what is to be said of model and logs."""
        beside = validation.format_model_comparison(self.beside) if self.beside else []
        notes = [
            line for line in self.lines if line.startswith((_TRAINING, "long logs: ", "note: "))
        ]
        return [
            self.comparison.summary(),
            *(["", *beside] if beside else []),
            *([] if self.model.logs else self.model.fit.sentences),
            "",
            *validation.write_verdict(self.comparison),
            *(self.machine.describe("the logs of the fit and these") if self.machine else ()),
            *self.model.warning,
            *notes,
            *(fault.line for fault in self.findings),
        ]

    @property
    def warnings(self) -> list[str]:
        """Returns what the values of a robot file leave open, and faults of the logs."""
        stated = [] if self.model.logs else self.model.fit.sentences[1:]
        return [*stated, *(fault.line for fault in self.findings)]


def compare_with_provenance(
    thing: IdentifiedModel | Robot,
    logs: Sequence[AnyLog],
    options: CompareOptions = CompareOptions(),
    mapping: Mapped = (),
    reporter: Reporter = SILENT,
) -> ComparisonRun:
    """Compares as `compare` does; says where all comes from, and what is wrong with the logs."""
    (model,) = prepare_models([thing], options)
    with reporter.report_step("predicting"):
        compiled = compile_for_comparison(model, options)
    with reporter.show_progress("predicting") as bar:
        comparison, observation = compare_logs(
            model, logs, compiled, mapping, bar, reporter.print_note
        )
    lines, training = _describe_model(model), _describe_training(model, observation)
    findings = estimation.find_log_faults(compiled, observation, model)
    report, beside = observation.report, None
    if options.payload_mass is not None and not are_long(logs):
        unloaded = CompareOptions(options.essential, options.run_embedded_c)
        (bare,) = prepare_models([thing], unloaded)
        both = {f"with {options.payload_mass:g} kg": model, "without the load": bare}
        beside = compare_compiled_models(both, [compiled] * 2, logs, mapping, logs)[0]
    lines += [*model.warning, *training, *report.format_lines(), *report.collect_notes()]
    lines += [fault.line for fault in findings if fault.is_certain]
    machine = None
    if model.logs and not training and not any(fault.is_certain for fault in findings):
        fit, rows = estimation.convert_model_fit(model), estimation.sum_observation(observation)
        machine = estimation.compare_machines(model.spec, fit, rows)
    return ComparisonRun(model, comparison, lines, findings, not training, beside, machine)


def _describe_model(model: IdentifiedModel) -> list[str]:
    if not model.logs:
        return [*model.fit.sentences]
    what = "" if model.fit.energy is None else "energy model, "
    fitted = ", ".join(log.name for log in model.logs)
    return [
        f"model: {model.spec.robot}, {len(model.beta)} base parameters, "
        f"{what}{find_estimator_title(model.fit.method)} on {fitted}; relative error there "
        f"{model.fit.format_error()}"
    ]


def _describe_training(model: IdentifiedModel, observation: Observation) -> list[str]:
    """A line on the logs whose rows the model was fitted on, whatever the files are called."""
    training_logs = []
    for log in observation.report.logs:
        fitted = sorted({used.name for used in model.logs if used.has_rows_of(log)})
        if fitted == [log.name]:
            training_logs.append(log.name)
        elif fitted:
            training_logs.append(f"{', '.join(fitted)}, which shares rows with {log.name}")
    if not training_logs:
        return []
    return [f"{_TRAINING}the model was fitted on {'; '.join(training_logs)}"]


def resolve_models(things: Sequence[IdentifiedModel | Robot]) -> list[IdentifiedModel]:
    """Returns models; of a robot its `stated_model`, processed as the first model is."""
    fitted = (thing.processing for thing in things if isinstance(thing, IdentifiedModel))
    first = next(fitted, None)
    return [
        build_stated_model(model_or_robot, first)
        if isinstance(model_or_robot, Robot)
        else model_or_robot
        for model_or_robot in things
    ]


def build_stated_model(robot: Robot, processing: Processing | None = None) -> IdentifiedModel:
    """Builds a model of the parameter values in a robot file; missing values are 0.

    Args:
        robot: as loaded.
        processing: of logs; None: by [fit] of the robot file, or chosen from the logs.

    Raises:
        DataError: the file states no value.
    """
    robot = complete_home(robot).write_to_text(robot) if robot.loops else robot
    emitted = workflow.derive_text(robot.text, f"robot {robot.name} in the model file")[1]
    spec, missing = emitted.spec, dict[str, dict[str, None]]()
    used = {term.parameter for base in spec.base for term in base.terms}
    for p in spec.standard:
        if p.nominal is None and p.name in used:
            missing.setdefault(p.effect, {})[p.joint] = None
    if all(p.nominal is None for p in spec.standard):
        raise DataError(
            f"{robot.name}: its file states no parameter values; expected [parameters], or a model "
            "of `modeler fit`"
        )
    value = {p.name: p.nominal or 0.0 for p in spec.standard}
    chi = [sum(term.value * value[term.parameter] for term in base.terms) for base in spec.base]
    places = {", ".join(joints): "" for joints in missing.values()}
    listed = "; ".join(
        f"{', '.join(effect for effect, entry in missing.items() if ', '.join(entry) == place)} of "
        f"joint {place}"
        for place in places
    )
    source_sentence = f"predicted with the values that the robot file of {robot.name} states"
    none = float("nan")
    fit = FitResult(
        robot=robot.name,
        method="stated",
        status="ok",
        samples=0,
        rows=0,
        condition_number=none,
        condition_scaled=none,
        relative_error=none,
        essential_error=none,
        joints=(),
        loads=(),
        parameters=tuple(
            ParameterEstimate(base.name, base.unit, entry, None, True, "stated")
            for base, entry in zip(spec.base, chi, strict=True)
        ),
        covariance=np.zeros((len(chi), len(chi))),
        sentences=(
            source_sentence,
            *([f"not stated there and taken as 0: {listed}"] if listed else []),
        ),
        processing=processing or workflow.build_processing(robot.fit),
    )
    return IdentifiedModel(robot.text, spec, emitted.code, fit, ())


def compare_logs(
    model: IdentifiedModel,
    logs: Sequence[AnyLog],
    compiled: CompiledModel,
    mapping: Mapped = (),
    progress: Callable[[float], None] = lambda share: None,
    tell: Callable[[str], None] = lambda line: None,
) -> tuple[validation.Comparison, Observation]:
    """Compares as `compare` does, and returns the observation too; reads long logs in chunks.

    Args:
        model: fitted.
        logs: that it predicts.
        compiled: its robot.
        mapping: as of `read_logs`.
        progress: receives the share of long logs that is done.
        tell: receives why long logs are read whole, if they must be.
    """
    if are_long(logs):
        try:
            sources = open_sources(compiled, logs, mapping)
            comparison, observation = validation.compare_long_logs(
                model, sources, compiled, progress
            )
            check_no_overlap(observation.report.logs)
            return comparison, observation
        except WholeLogNeeded as error:
            if are_too_long(logs):
                raise
            tell(f"{error}; read as a whole instead")
    read = workflow.read_logs(compiled, logs, mapping)
    check_no_overlap(read, places=[str(log) for log in logs])
    prediction, observation = validation.predict(model, read, compiled)
    return validation.compare(prediction), observation


def compare_models(
    models: Mapping[str, IdentifiedModel | Robot] | Sequence[IdentifiedModel | Robot],
    logs: Logs,
    mapping: Mapped = (),
) -> validation.ModelComparison:
    """Compares models on the same logs: error by joint, and significant differences.

    >>> compare_models({"all": model, "few": reduced_model(model)}, ["tue.parquet"]).names
    ('all', 'few')

    Args:
        models: by the name that they are to have; of a list they are called A, B, C ...; a robot
            has the values that its file states.
        logs: of motion that none was fitted on.
        mapping: as of `read_logs`.

    Raises:
        DataError: fewer than two models, or of different robots.
    """
    if len(models) < 2:
        raise DataError(f"compare_models: got {len(models)} models; expected two at least")
    if isinstance(models, Mapping):
        models_by_name = models
    elif len(models) <= len(ascii_uppercase):
        models_by_name = dict(zip(ascii_uppercase, models, strict=False))
    else:
        raise DataError(
            f"compare_models: got a list of {len(models)} models, more than there are letters; "
            "expected a mapping of names, each to a model"
        )
    return compare_named_models(models_by_name, logs, mapping=mapping)[0]


def choose_names(places: Sequence[str]) -> list[str]:
    """Returns the names of files of models, or their paths where two are alike.

    Raises:
        DataError: one file is given twice.
    """
    for k, place in enumerate(places):
        if Path(place).resolve() in {Path(other).resolve() for other in places[:k]}:
            raise DataError(f"{place}: got this model twice; expected each model once")
    short = [Path(place).name for place in places]
    return short if len(set(short)) == len(short) else [str(place) for place in places]


def compare_named_models(
    things: Mapping[str, IdentifiedModel | Robot],
    logs: Logs,
    options: CompareOptions = CompareOptions(),
    mapping: Mapped = (),
    reporter: Reporter = SILENT,
) -> tuple[validation.ModelComparison, list[str], list[IdentifiedModel], bool]:
    """Compares as `compare_models` does; says where all comes from.

    Returns:
        The comparison, lines on models and logs, the models, and True if none was fitted on these
        logs.
    """
    names = list(things)
    models = dict(zip(names, prepare_models([*things.values()], options), strict=True))
    validation.check_joints([*models.values()], names)
    compiled, places = [], workflow.convert_to_list(logs)
    with reporter.show_progress("predicting") as bar:
        for k, model in enumerate(models.values(), 1):
            compiled.append(compile_for_comparison(model, options))
            bar(k / (len(models) + 1))
        comparison, read = compare_compiled_models(models, compiled, logs, mapping, places)
    lines = []
    for name, model in models.items():
        sources = "; ".join(model.fit.sentences)
        if model.logs:
            sources = f"fitted on {', '.join(log.name for log in model.logs)}"
        lines.append(f"{name}: {model.spec.robot}, {len(model.beta)} base parameters, {sources}")
    lines.append(f"logs: {', '.join(log.name for log in read)}, processed as those of {names[0]}")
    trained = [
        f"{_TRAINING}{name} was fitted on rows of {log.name}, which flatters it"
        for name, model in models.items()
        for log in read
        if any(used.has_rows_of(log) for used in model.logs)
    ]
    return comparison, [*lines, *trained], [*models.values()], not trained


def compare_compiled_models(
    models: Mapping[str, IdentifiedModel],
    compiled: Sequence[CompiledModel],
    logs: Logs,
    mapping: Mapped = (),
    places: Sequence[AnyLog] = (),
) -> tuple[validation.ModelComparison, list[Log]]:
    """Compares compiled models, and returns the logs too.

    Args:
        models: by name.
        compiled: they.
        logs: of motion that none was fitted on.
        mapping: as of `read_logs`.
        places: what messages call the logs.
    """
    read = [workflow.read_logs(compiled_model, logs, mapping) for compiled_model in compiled]
    check_no_overlap(read[0], places=[str(place) for place in places])
    names = list(models)
    predictions, _ = validation.predict_together(list(models.values()), compiled, read, names)
    return validation.compare_models(names, predictions), read[0]


def free_run(
    model: IdentifiedModel,
    logs: Logs,
    settings: validation.FreeRunSettings | None = None,
    mapping: Mapped = (),
) -> validation.FreeRun:
    """Simulates the fitted robot under the logged torques and compares the positions.

    >>> found = free_run(model, ["tue.parquet@0:0.5"], FreeRunSettings(window=0.2))
    >>> [joint.name for joint in found.joints]
    ['1', '2']

    Args:
        model: fitted.
        logs: of motion that it was not fitted on.
        settings: window in s, bound as a share of the range of motion, controller gains.
        mapping: as of `read_logs`.

    Raises:
        DataError: a log cannot be run; says why.
    """
    described = settings or validation.FreeRunSettings()
    return simulate_positions(model, logs, CompareOptions(), described, mapping)[0]


def simulate_positions(
    thing: IdentifiedModel | Robot,
    logs: Logs,
    options: CompareOptions,
    settings: validation.FreeRunSettings,
    mapping: Mapped = (),
    reporter: Reporter = SILENT,
) -> tuple[validation.FreeRun, IdentifiedModel]:
    """Simulates as `free_run` does a model as the options want it, and returns that too."""
    (model,) = prepare_models([thing], options)
    with reporter.report_step("deriving the robot of the model"):
        compiled = compile_for_comparison(model, options)
        read = workflow.read_logs(compiled, logs, mapping)
    check_no_overlap(read, places=[str(log) for log in workflow.convert_to_list(logs)])
    with reporter.show_progress("simulating") as bar:
        return validation.simulate_free_run(model, read, compiled, settings, bar), model


def build_free_run_settings(options: CompareOptions) -> validation.FreeRunSettings:
    """Builds the settings of a free run; what is not stated is as usual.

    Raises:
        DataError: a controller that cannot be.
    """
    stated = {"window": options.window, "bound": options.bound}
    return validation.FreeRunSettings(
        gains=None if options.controller is None else _parse_gains(options.controller),
        **{name: value for name, value in stated.items() if value is not None},
    )


def _parse_gains(text: str) -> validation.Gains:
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if not 2 <= len(values) <= 4 or not all(math.isfinite(v) and v >= 0.0 for v in values):
        raise OptionError(
            f"{{--controller}} {text}: expected two to four numbers that are not negative, as in "
            "20,0.25 or 20,0.25,1,1: speed loop in Hz, ratio of the position loop, integral, "
            "feedforward"
        )
    if values[0] == 0.0 or values[1] == 0.0:
        raise OptionError(
            f"{{--controller}} {text}: a loop of 0 holds nothing; expected a speed loop and a "
            "ratio above 0"
        )
    speed, ratio, integral, forward = [*values, 0.0, 0.0][:4]
    return speed, ratio, integral, forward


def predict_torque(
    model: IdentifiedModel, compiled: CompiledModel, log: AnyLog, mapping: Mapped
) -> Any:
    """Predicts the torque at every row; see `Model.predict`."""
    spec = compiled.spec
    if isinstance(log, SimulatedLog):
        log = {"time": log.time, "q": log.q, **log.further}
    if isinstance(log, regression.Log):
        read, names = log, {f"tau{joint.name}": joint.name for joint in spec.joints}
        values = _predict_reliable_rows(model, compiled, read)
        columns = {name: values[:, k] for k, name in enumerate(names)}
    else:
        read, columns = _predict_table(model, compiled, log, mapping)
    if isinstance(log, Mapping):
        return _gather_arrays(columns, log, spec.joints)
    if isinstance(log, str | Path | regression.Log):
        return label_values(
            np.column_stack([*columns.values()]), {"time": read.time}, list(columns)
        )
    kind: Any = type(log)
    if kind.__module__.startswith("pandas"):
        return kind(columns, index=log.index)  # type: ignore[attr-defined]
    return getattr(kind, "from_pydict", kind)(columns)  # of Arrow, and of Polars


def _predict_table(
    model: IdentifiedModel, compiled: CompiledModel, log: Any, mapping: Mapped
) -> tuple[regression.Log, dict[str, np.ndarray]]:
    """The motion of a log, and the torque under the names of its columns, in their units."""
    spec, names, span = compiled.spec, build_log_maps(compiled, [log], mapping)[0], None
    if isinstance(log, str | Path):
        path, span = parse_time_range(log)
        table = LogTable(Path(path), names, spec.joints)
    else:
        table = regression.build_table(log, spec.joints, names, "log")
    read = regression.build_log(table, spec, measured=False)
    if span is not None:
        read = regression.cut_window(read, *span)
    values, columns = _predict_reliable_rows(model, compiled, read), {}
    for k, joint in enumerate(spec.joints):
        tau, current = f"tau{joint.name}", f"current{joint.name}"
        if not joint.actuated and tau not in table:
            continue
        by_current = tau not in table and current in table
        name, gain = (current, joint.drive_gain or 1.0) if by_current else (tau, 1.0)
        torque_column = values[:, k] / gain
        columns[table.find_file_column(name)] = (
            table.convert_to_logged(name, torque_column) if name in table else torque_column
        )
    return read, columns


def _predict_reliable_rows(
    model: IdentifiedModel, compiled: CompiledModel, log: regression.Log
) -> np.ndarray:
    torque, sure = validation.predict_every_row(model, log, compiled)
    return np.where(sure[:, None], torque, np.nan)


def _gather_arrays(
    columns: Mapping[str, np.ndarray], log: Mapping[str, Any], joints: tuple[JointSpec, ...]
) -> dict[str, np.ndarray]:
    """Columns of one array of the dict in an array of its shape; as they are if it has none."""
    arrays = dict(columns)
    rows = len(next(iter(columns.values())))
    for name, like in (("tau", "tau"), ("current", "current"), ("tau", "q")):
        column_names = split_joints(name, np.shape(log.get(like, ())), joints)
        if column_names and set(column_names) & set(arrays):
            none = np.zeros(rows)
            arrays[name] = np.column_stack([arrays.pop(each, none) for each in column_names])
    return arrays


def compare_methods(
    robot: Robot | CompiledModel,
    logs: Logs,
    holdout: Logs = (),
    methods: Sequence[str] | None = None,
    *,
    mapping: Mapped = (),
    processing: Processing | None = None,
    reporter: Reporter = SILENT,
) -> estimation.MethodComparison:
    """Compares all estimators on the same logs: values, errors, run time, remarks.

    >>> result = compare_methods(compiled, ["mon.parquet"], methods=["weighted", "ridge"])
    >>> [each.method for each in result.results]
    ['weighted', 'ridge']

    Args:
        robot: as loaded, or compiled.
        logs: to fit.
        holdout: logs of other motion, not fitted: their error.
        methods: some of `estimators()`; None: all.
        mapping: as of `read_logs`.
        processing: of the logs; None: chosen from them.
        reporter: of the progress.

    Raises:
        DataError: an unknown method, rows given twice, or what the weighted fit raises.
    """
    chosen = select_methods(methods)
    if isinstance(robot, Robot):
        with reporter.report_step(f"deriving {robot.name}"):
            robot = compile_robot(robot).compiled
    compiled = robot
    with reporter.report_step("building the observation matrix"):
        observation, held_out = observe_held_out(compiled, logs, holdout, mapping, processing)
    with reporter.show_progress("fitting") as bar:
        tried = estimation.compare_methods(observation, compiled, held_out, chosen, bar)
    lines = tuple(observation.report.format_lines())
    return estimation.MethodComparison(compiled.spec.robot, tried, lines)


def observe_held_out(
    compiled: CompiledModel,
    logs: Logs,
    holdout: Logs,
    mapping: Mapped = (),
    processing: Processing | None = None,
) -> tuple[Observation, Observation | None]:
    """Builds the observations of fitted and held-out logs with the same processing."""
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
    """Returns the estimators of these names, each once; all for None."""
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
