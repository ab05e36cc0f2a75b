"""From a robot and its logs to a model, in one call."""

import dataclasses
import warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

from modeler.api import fitting, workflow
from modeler.api.log_maps import Mapped, resolve_mapping
from modeler.api.long_logs import Reporter, fit_if_long
from modeler.api.model import Model
from modeler.api.steps import Steps, ignore_step
from modeler.api.workflow import AnyLog, Logs, convert_to_list, read_logs
from modeler.codegen import Derivation
from modeler.core.choices import GAIN_METHOD, Method
from modeler.core.errors import DataError, FitWarning
from modeler.core.manifest import EmittedModule
from modeler.derivation import complete_home
from modeler.regression import Log, Observation, Processing, check_no_overlap, observe
from modeler.robot import Robot, read_robot, replace_robot_effects
from modeler.runtime import CompiledModel

Effects = str | Sequence[str] | Mapping[str, Any]
"""Effects that every joint has, by their ids; or a table as [effects] of a robot file."""


def identify(
    robot: Robot | str | Path,
    logs: Logs,
    holdout: Logs = (),
    method: Method | Literal["two-step"] | None = None,
    *,
    mapping: Mapped = (),
    effects: Effects | None = None,
    load: fitting.Load | None = None,
    processing: Processing | None = None,
    steps: Steps = ignore_step,
) -> Model:
    """The model of a robot from its logs: all that `modeler fit` does.

    >>> run = simulate(open_robot("two-link"), duration=6.0, seed=1)
    >>> model = identify("two-link", {"time": run.time, "q": run.q, "tau": run.tau})
    >>> model["Fs2"].unit, model.fit.verdict.usable
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
        steps: is called with the title of each step.

    Warns:
        FitWarning: the fit is not usable; says why and what to do.

    Raises:
        RobotError: a mistake in the robot file, or an effect that there is not.
        DataError: a log cannot be read, rows are given twice, or cannot be fitted.
    """
    robot = prepare_robot(robot, effects)
    training_logs, held_out_logs = convert_to_list(logs), convert_to_list(holdout)
    stated = {**robot.fit, **({} if method is None else {"method": method})}
    with steps(f"deriving {robot.name}"):
        derivation = workflow.derive(robot)
        emitted = workflow.generate(derivation)
        compiled = workflow.compile_model(emitted)
    mapping, stored_mapping = resolve_mapping(compiled, training_logs, mapping)
    held_out_logs = _read_in_memory_logs(compiled, held_out_logs, mapping)
    training_logs, request = (
        _read_in_memory_logs(compiled, training_logs, mapping),
        fitting.read_fit_request(stated),
    )
    if request.method == GAIN_METHOD and load is None:
        raise DataError(
            f"identify: method {GAIN_METHOD} finds the gains of drives from a weighed load; "
            "give load=Load(logs, mass)"
        )

    def check_log_sets(bare: Sequence[Log], loaded: Sequence[Log]) -> None:
        others = (
            () if request.method == GAIN_METHOD else read_logs(compiled, held_out_logs, mapping)
        )
        check_no_overlap([*bare, *loaded], others)

    model, _, _, loaded = fit_logs(
        request, derivation, emitted, compiled, training_logs, load or fitting.Load((), None),
        processing or workflow.build_processing(stated), mapping, check_log_sets, Reporter(steps),
    )  # fmt: skip
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


def prepare_robot(robot: Robot | str | Path, effects: Effects | None = None) -> Robot:
    """A robot as fits take it: its [home] found if it has loops, with these effects.

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


def fit_logs(
    request: fitting.FitRequest,
    derivation: Derivation,
    emitted: EmittedModule,
    compiled: CompiledModel,
    logs: Sequence[AnyLog],
    load: fitting.Load,
    processing: Processing,
    mapping: Mapped,
    check: Callable[[Sequence[Log], Sequence[Log]], None],
    reporter: Reporter,
) -> tuple[Model, Observation, fitting.FitOutcome, list[Log]]:
    """The model of logs of any length, by any method.

    Args:
        request: how; the load comes to it.
        derivation: of the robot.
        emitted: its C.
        compiled: that, callable.
        logs: without load.
        load: and the logs that carry it, if any do.
        processing: of the logs.
        mapping: as of `read_logs`.
        check: refuses logs, bare and loaded, that do not belong together.
        reporter: what is told of it.

    Returns:
        The model, what it was fitted to, how, and the loaded logs.
    """
    if request.method == GAIN_METHOD:
        gain_fit = fitting.identify_gains(
            derivation, compiled, logs, load, processing, check, reporter.report_step, mapping
        )
        return *gain_fit, fitting.FitOutcome(gain_fit[0].fit), []
    long = fit_if_long(
        request, derivation, emitted, compiled, logs, load.logs, processing, mapping, reporter
    )
    if long is not None:
        return *long, fitting.FitOutcome(long[0].fit), []
    with reporter.report_step("building the observation matrix"):
        read, loaded = (read_logs(compiled, some, mapping) for some in (logs, load.logs))
        check(read, loaded)
        observation = observe(compiled, [*read, *loaded], processing)
    request = dataclasses.replace(
        request, payloads=tuple(load.build_payloads(loaded)) if loaded else ()
    )
    model, outcome = fitting.fit_observation(
        request, derivation, emitted, compiled, observation, reporter.report_step
    )
    return model, observation, outcome, loaded
