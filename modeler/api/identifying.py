"""From a robot and its logs to a model, in one call."""

import dataclasses
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

from modeler.api import fitting, workflow
from modeler.api.arguments import Steps, silent
from modeler.api.log_maps import Mapped, settled
from modeler.api.long_logs import fit_long
from modeler.api.model import Model
from modeler.api.workflow import AnyLog, Logs, listed, read_logs
from modeler.codegen import Derivation
from modeler.core.errors import GAIN_METHOD, DataError, Method, RobotError
from modeler.core.manifest import Emitted
from modeler.derivation import with_home
from modeler.effects import effect_named
from modeler.estimation import OF_TRIANGLES
from modeler.observation import Log, Processing, WholeLogNeeded, check_apart, observe
from modeler.robot import Robot, near, read_robot, robot_from_text, with_effects, with_home_text
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
    steps: Steps = silent,
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

    Raises:
        RobotError: a mistake in the robot file, or an effect that there is not.
        DataError: a log cannot be read, rows are given twice, or cannot be fitted.
    """
    robot = robot_with(robot, effects)
    given, held = listed(logs), listed(holdout)
    stated = {**robot.fit, **({} if method is None else {"method": method})}
    with steps(f"deriving {robot.name}"):
        derivation = workflow.derive(robot)
        emitted = workflow.generate(derivation)
        compiled = workflow.compile_model(emitted)
    mapping, kept = settled(compiled, given, mapping)
    held = _in_memory(compiled, held, mapping)
    made, memory = _fitted(
        derivation, emitted, compiled, _in_memory(compiled, given, mapping), held,
        fitting.request_of(stated), mapping, load, processing or fitting.processing_of(stated),
        steps,
    )  # fmt: skip
    return dataclasses.replace(
        made, mapping=kept, given=tuple(memory), held_out=tuple(held), folder=str(Path.cwd())
    )


def robot_with(robot: Robot | str | Path, effects: Effects | None = None) -> Robot:
    """A robot as fits take it: its [home] found if it has loops, with these effects.

    Raises:
        RobotError: no such robot, or no such effect.
    """
    robot = robot if isinstance(robot, Robot) else read_robot(robot)
    if effects is not None:
        names = effects.split(",") if isinstance(effects, str) else effects
        wanted = effects if isinstance(effects, Mapping) else {n.strip(): "all" for n in names}
        known = [effect.id for effect in robot.catalogue]
        for name in wanted:
            if effect_named(name, robot.catalogue) is None:
                raise RobotError(
                    f"effects: got {name}{near(name, known)}; expected some of {', '.join(known)}"
                )
        text = with_effects(robot.text, dict(wanted))
        robot = robot_from_text(text, f"{robot.name} with effects")
    if not robot.loops:
        return robot
    home = with_home(robot)
    if not home.told:
        return robot
    try:
        text = with_home_text(robot.text, robot.home, home.robot.home)
    except RobotError:  # it is found again, the same
        return home.robot
    return robot_from_text(text, f"{robot.name} with its [home]")


def _in_memory(compiled: CompiledModel, logs: Sequence[AnyLog], mapping: Mapped) -> list[AnyLog]:
    """Paths as they are, and what else there is as it was read."""
    paths = (str, Path)
    others = read_logs(compiled, [log for log in logs if not isinstance(log, paths)], mapping)
    rest = iter(others)
    return [log if isinstance(log, paths) else next(rest) for log in logs]


def _fitted(
    derivation: Derivation, emitted: Emitted, compiled: CompiledModel, logs: Sequence[AnyLog],
    holdout: Sequence[AnyLog], asked: fitting.FitRequest, mapping: Mapped,
    load: fitting.Load | None, processing: Processing, steps: Steps,
) -> tuple[Model, list[Log]]:  # fmt: skip
    """The model; the logs of the fit that are in memory only."""
    if asked.method == GAIN_METHOD:
        if load is None:
            raise DataError(
                f"identify: method {GAIN_METHOD} finds the gains of drives from a weighed load; "
                "give load=Load(logs, mass)"
            )
        model, _ = fitting.found_with_gains(
            derivation, compiled, logs, load, processing, working=steps, mapping=mapping
        )
        return model, []
    memory = [log for log in logs if isinstance(log, Log)]
    if workflow.are_long(logs) and load is None:
        if asked.method in OF_TRIANGLES and asked == fitting.FitRequest(asked.method):
            try:
                sources = workflow.sources_of(compiled, logs, mapping)
                with steps("reading and reducing"):
                    long = fit_long(
                        derivation, emitted, compiled, sources, asked.method, processing
                    )
                return long[0], memory
            except WholeLogNeeded:
                if workflow.too_long(logs):
                    raise
        workflow.check_fits_memory(logs, f"method {asked.method}")
    with steps("building the observation matrix"):
        read = read_logs(compiled, logs, mapping)
        loaded = [] if load is None else read_logs(compiled, load.logs, mapping)
        check_apart([*read, *loaded], read_logs(compiled, holdout, mapping))
        observation = observe(compiled, [*read, *loaded], processing)
    payloads = () if load is None else tuple(load.payloads(loaded))
    asked = dataclasses.replace(asked, payloads=payloads)
    model, _ = fitting.fitted(asked, derivation, emitted, compiled, observation, steps)
    return model, memory + [log for log in loaded if not log.path]
