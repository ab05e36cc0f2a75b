"""The chain as seven steps: load, derive, generate, compile_model, observe, fit, compare.

    from modeler.api import compare, compile_model, derive, fit, generate, load, observe

    robot = load("emps")                               # a file, or the name of a built-in robot
    derivation = derive(robot)                         # base parameters, exactly
    emitted = generate(derivation, "emps_c")           # C, header, manifest, build files
    compiled = compile_model(emitted)
    observation = observe(compiled, ["train.parquet"])
    model = fit(derivation, emitted, observation)
    print(compare(model, ["pulses.parquet"]).summary())

Each step is a function of the stage of that name; use the stages directly for more choices. `show`
draws the robot that was loaded.
"""

import dataclasses
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from modeler.compare import Comparison
from modeler.compare import compare as compare_prediction
from modeler.compare.predict import predict
from modeler.compiled import CompiledModel
from modeler.compiled import load as load_compiled
from modeler.core.choices import Method
from modeler.core.contract import Emitted, ModuleSpec
from modeler.core.errors import DataError, ManifestError
from modeler.core.window import file_and_window
from modeler.derivation import Derivation as Derivation
from modeler.derivation import derive as derive
from modeler.derivation import generate as generate_robot
from modeler.derivation import load as load
from modeler.diagnose import Diagnosis, Known
from modeler.diagnose import diagnose as find_missing
from modeler.fit import (
    FitResult,
    IdentifiedModel,
    check_currents,
    fitted_spec,
    identify,
    in_drive_units,
    provenance,
    with_verdict,
)
from modeler.logs import LogMap, map_from_table, map_from_words
from modeler.observation import Log, Observation, Processing, read_log
from modeler.observation import observe as observe_logs
from modeler.observation.apart import check_apart
from modeler.observation.findings import findings_of_fit
from modeler.observation.window import window
from modeler.robot import Robot, robot_from_text
from modeler.robot.edit import with_own_effect
from modeler.showing import show as show

Mapped = Mapping[str, Any] | Sequence[str]
"""Whose column is which: a table as [log] of a robot file, or texts as `--map` takes them."""


def own_effect(robot: Robot, name: str, **definition: Any) -> Robot:
    """The robot with the definition of an effect that the catalogue lacks.

        own_effect(load("emps"), "fan", columns={"Kf": "v*abs(v)"}, nonnegative=True)

    `diagnose` then tries it, and `modeler add` can add it: the definition stands in the robot
    file that the model keeps.

    Args:
        robot: as it is.
        name: id of the effect.
        definition: title, columns, shapes, unit, nonnegative, acts; see docs/robot-file.md.

    Raises:
        RobotError: a mistake in the definition, or an id that the robot has already.
    """
    return robot_from_text(with_own_effect(robot.text, name, definition), robot.name)


def generate(
    source: Derivation | IdentifiedModel,
    folder: str | Path | None = None,
    force: bool = False,
) -> Emitted:
    """The C module of a robot; of a model, with functions that have its fitted values.

    Args:
        source: what was derived, or a fitted model.
        folder: the module is written there if it is given.
        force: write also over files that no earlier run wrote, or that were edited since.

    Raises:
        ManifestError: this version derives another manifest than the one that the values of the
            model belong to.
        ModelerError: the folder holds such files and `force` is not given; or it cannot be written.
    """
    if isinstance(source, Derivation):
        return generate_robot(source, folder, force)
    derivation, _ = _emitted_anew(source)
    return generate_robot(derivation, folder, force, fitted_spec(source))


def compile_model(emitted: Emitted) -> CompiledModel:
    """The C module made callable; compiled once for the same content."""
    return load_compiled(emitted.spec, emitted.files, emitted.log)


def read_logs(
    compiled: CompiledModel, logs: Sequence[str | Path | Log], mapping: Mapped = ()
) -> list[Log]:
    """Logs by path, `path@start:end` for a piece of it in seconds, or as they are.

    Args:
        compiled: the robot; its file's [log] says which columns are which.
        logs: of any format of `modeler.logs`.
        mapping: over [log]: a table like it, or texts as `--map` takes them.
    """
    names = log_map(compiled, mapping)
    return [log if isinstance(log, Log) else _read(log, compiled.spec, names) for log in logs]


def read_currents(
    compiled: CompiledModel, logs: Sequence[str | Path | Log], mapping: Mapped = ()
) -> list[Log]:
    """Logs of currents; where the robot file states no drive gain, torques are in drive units.

    Raises:
        DataError: a log gives a torque instead.
    """
    spec, names = in_drive_units(compiled.spec), log_map(compiled, mapping)
    read = [log if isinstance(log, Log) else _read(log, spec, names) for log in logs]
    check_currents(read, spec.joints)
    return read


def log_map(compiled: CompiledModel, mapping: Mapped = ()) -> LogMap:
    """Which columns of logs are ours: [log] of the robot file, and `mapping` over it."""
    stated = map_from_table(compiled.log, f"{compiled.spec.robot}: [log]")
    given = (
        map_from_table(mapping, "mapping", strict=True)
        if isinstance(mapping, Mapping)
        else map_from_words(mapping)
    )
    return given.over(stated)


def _read(place: str | Path, spec: ModuleSpec, names: LogMap) -> Log:
    path, times = file_and_window(str(place))
    if times is None:
        return read_log(place, spec, names)
    start, colon, end = times.partition(":")
    try:
        span = tuple(float(side) if side else None for side in (start, end))
    except ValueError:
        span = ()
    if not (colon and span):
        raise DataError(
            f"{place}: got @{times} after the file; expected @START:END in seconds, as in "
            f"{path}@0:10, {path}@5: or {path}@:5"
        )
    return window(read_log(path, spec, names), *span)


def observe(
    compiled: CompiledModel,
    logs: Sequence[str | Path | Log],
    processing: Processing | None = None,
    mapping: Mapped = (),
) -> Observation:
    """The rows y = W beta of logs."""
    given = read_logs(compiled, logs, mapping)
    check_apart(given)
    return observe_logs(compiled, given, processing)


def fit(
    derivation: Derivation,
    emitted: Emitted,
    observation: Observation,
    method: Method = "weighted",
) -> IdentifiedModel:
    """The base parameters from an observation, with all that a model file holds.

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
    compiled = compile_model(emitted)
    result = identify(observation, method, compiled)
    told = findings_of_fit(compiled, observation, result.beta)
    result = with_verdict(compiled, observation, result, told)
    return identified(derivation, emitted, observation, result)


def identified(
    derivation: Derivation, emitted: Emitted, observation: Observation, result: FitResult
) -> IdentifiedModel:
    """A fit with all that a model file holds."""
    return IdentifiedModel(
        robot_text=derivation.robot.text,
        spec=emitted.spec,
        sources=emitted.files,
        fit=result,
        logs=provenance(observation.report),
    )


def recompile(model: IdentifiedModel) -> CompiledModel:
    """The compiled robot of a model, its C emitted anew from the robot text in the model.

    A model file may come from anybody; `model.compile()` would run the C that stands in it.

    Raises:
        ManifestError: this version derives another manifest than the one that the values belong to.
    """
    otherwise = ", or use --run-embedded-c to run the C in the file if you trust its source"
    return compile_model(_emitted_anew(model, otherwise)[1])


def _emitted_anew(model: IdentifiedModel, otherwise: str = "") -> tuple[Derivation, Emitted]:
    """What the robot text of a model gives, if that is what its values belong to."""
    robot = robot_from_text(model.robot_text, f"robot {model.spec.robot} in the model file")
    derivation = derive(robot)
    emitted = generate_robot(derivation)
    if emitted.spec.signature() != model.spec.signature():
        what = "manifest" if _uncoded(emitted.spec) != _uncoded(model.spec) else "C"
        raise ManifestError(
            f"model of {model.spec.robot}: its robot text gives another {what} than its values "
            "belong to: made by another version of modeler, or changed since; fit it again"
            f"{otherwise}"
        )
    return derivation, emitted


def _uncoded(spec: ModuleSpec) -> ModuleSpec:
    return dataclasses.replace(spec, code="")


def compare(model: IdentifiedModel, logs: Sequence[str | Path | Log]) -> Comparison:
    """Measured against predicted torque on logs, after the processing of the fit."""
    compiled = recompile(model)
    prediction, _ = predict(model, read_logs(compiled, logs), compiled)
    return compare_prediction(prediction)


def diagnose(
    model: IdentifiedModel,
    logs: Sequence[str | Path | Log],
    holdout: Sequence[str | Path | Log] = (),
    without: Sequence[str] = (),
) -> Diagnosis:
    """Which physical effect the model lacks on logs; errors from the held-out logs if given."""
    compiled = recompile(model)
    robot = robot_from_text(model.robot_text, "robot of the model")
    known = Known(robot.catalogue, robot.coupling)
    given, kept = read_logs(compiled, logs), read_logs(compiled, holdout)
    check_apart(given, kept)
    return find_missing(model, compiled, given, kept, without, known=known)
