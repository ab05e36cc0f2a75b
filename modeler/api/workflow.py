"""The chain: from a robot to its C, from logs to a model."""

import dataclasses
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any, TypeVar

from modeler import observation
from modeler.api.log_maps import Mapped, file_and_span, log_maps, read_mapped
from modeler.codegen import (
    Derivation as Derivation,
    derive as derive,
    generate as generate_robot,
    load as load,
)
from modeler.core.builtin import builtin_names
from modeler.core.errors import ALSO, Also, DataError, Machine, ManifestError, Precision
from modeler.core.estimators import ABOUT
from modeler.core.files import write_atomically
from modeler.core.manifest import Emitted, ModuleSpec
from modeler.core.table import Table
from modeler.effects import CATALOGUE
from modeler.estimation import (
    OF_TRIANGLES,
    IdentifiedModel,
    check_currents,
    in_drive_units,
    model_file,
)
from modeler.logs import Frame, LogMap, blocks_of
from modeler.robot import (
    Robot,
    convert as convert,
    new_robot as new_robot,
    read_robot,
    robot_from_text,
    with_own_effect,
)
from modeler.runtime import CompiledModel, GpuModel, load as load_compiled, load_gpu
from modeler.simulation import SimulatedLog, write_log

AnyLog = str | Path | observation.Log | SimulatedLog | Mapping[str, Any] | Frame
"""A log: its file, a piece of it (`run.parquet@0:10`), one that was read, one just simulated.

Or columns in memory: a frame of pandas or Polars, a dict of arrays.
"""

Logs = AnyLog | Sequence[AnyLog]
"""Logs; one alone stands for a list of it."""


def listed(logs: Logs) -> Sequence[AnyLog]:
    """One log alone as a list of it."""
    if isinstance(logs, str | Mapping) or hasattr(logs, "__arrow_c_stream__"):
        return [logs]
    if isinstance(logs, Sequence):
        return logs
    return list(logs) if isinstance(logs, Iterable) else [logs]


M = TypeVar("M", bound=IdentifiedModel)


def own_effect(robot: Robot, name: str, **definition: Any) -> Robot:
    """The robot with the definition of an effect that the catalogue lacks.

    >>> robot = own_effect(load("emps"), "fan", columns={"Kf": "v*abs(v)"}, nonnegative=True)
    >>> robot.own_effects[0].id
    'fan'

    `diagnose` then tries it, and `modeler add` can add it: the definition stands in the robot
    file that the model keeps.

    Args:
        robot: as it is.
        name: id of the effect.
        definition: title, columns, shapes, unit, nonnegative, acts, lag, law;
            docs/reference/robot-file.md.

    Raises:
        RobotError: a mistake in the definition, or an id that the robot has already.
    """
    return robot_from_text(with_own_effect(robot.text, name, definition), robot.name)


def generate(
    source: Derivation | IdentifiedModel,
    folder: str | Path | None = None,
    force: bool = False,
    precision: Precision = "double",
    cuda: bool = False,
    frames: Sequence[str] = (),
    only: Sequence[str] = (),
    also: Sequence[Also] = (),
    measure: Machine | None = None,
) -> Emitted:
    """The C module of a robot; of a model, with functions that have its fitted values.

    >>> "two_link.h" in generate(derivation).files
    True

    Args:
        source: what was derived, or a fitted model.
        folder: the module is written there if it is given.
        force: write also over files that no earlier run wrote, or that were edited since.
        precision: `double`, or `single`: then all numbers of the C are `float`.
        cuda: add the base regressor in CUDA, of a robot without loops.
        frames: rows, or links of [frames], whose pose, Jacobian and twist a controller reads
            besides those of the tool.
        only: names of the functions that are wanted, without the robot's; empty: all.
        also: `vectors`, 50 states by which a port qualifies itself; `structured_text`, function
            blocks of a robot without loops; `a2l`, the parameter set for calibration tools.
        measure: add what calls cost on this machine or a Cortex-M: `cost.json`.

    Raises:
        BuildError: the compiler for that machine is missing.
        ManifestError: this version derives another manifest than the one that the values of the
            model belong to.
        ModelerError: the folder holds such files and `force` is not given; or it cannot be written.
    """
    if isinstance(source, Derivation):
        derivation, fitted = source, None
    else:
        derivation, fitted = emitted_anew(source)[0], model_file.fitted_spec(source)
    control = None
    if frames or only or also or measure:
        from modeler.codegen import Control  # who fits need not wait for it

        control = Control(tuple(frames), tuple(only), **{name: name in also for name in ALSO})
    return generate_robot(
        derivation, folder, force, fitted, precision, cuda, control, measure=measure
    )


def compile_model(emitted: Emitted) -> CompiledModel:
    """The C module made callable; compiled once for the same content.

    >>> compile_model(emitted).gravity([[0.0, 0.0]], model.beta).shape
    (1, 2)
    """
    return load_compiled(emitted.spec, emitted.code, emitted.log)


def read_logs(
    compiled: CompiledModel, logs: Logs, mapping: Mapped = (), spread: bool = False
) -> list[observation.Log]:
    """Logs by path, `path@start:end` for a piece of it in seconds, or as they are.

    >>> [log.rows for log in read_logs(compiled, ["mon.parquet", "tue.parquet@1:2"])]
    [6000, 1000]

    Args:
        compiled: the robot; its file's [log] says which columns are which.
        logs: of any format of `modeler.logs`.
        mapping: over [log]: a table like it, or texts as `--map` takes them; "auto" among them
            takes the guess of `look_at` for what is left open.
        spread: True if of a log of more than a million rows evenly spread stretches will do.
    """
    given = listed(logs)
    every = enumerate(zip(given, log_maps(compiled, given, mapping), strict=True))
    return [_log(*each, compiled.spec, spread) for each in every]


def read_currents(
    compiled: CompiledModel, logs: Logs, mapping: Mapped = ()
) -> list[observation.Log]:
    """Logs of currents; where the robot file states no drive gain, torques are in drive units.

    >>> run = simulate(robot, duration=2.0, seed=1)
    >>> read_currents(compiled, {"time": run.time, "q": run.q, "current": run.tau})[0].rows
    2000

    Raises:
        DataError: a log gives a torque instead.
    """
    spec, given = in_drive_units(compiled.spec), listed(logs)
    every = enumerate(zip(given, log_maps(compiled, given, mapping), strict=True))
    read = [_log(*each, spec) for each in every]
    check_currents(read, spec.joints)
    return read


def _log(
    number: int, named: tuple[AnyLog, LogMap], spec: ModuleSpec, spread: bool = False
) -> observation.Log:
    log, names = named
    if isinstance(log, observation.Log):
        return log
    if not isinstance(log, SimulatedLog):
        return read_mapped(log, spec, names, f"logs[{number}]", spread)
    with TemporaryDirectory() as folder:  # read as whoever gets the file will read it
        place = Path(folder) / f"{log.robot}-seed{log.settings.seed}.parquet"
        write_log(place, log)
        read = observation.read_log(place, spec)
    return dataclasses.replace(read, path="")


# Long logs: whether some are, and their rows in blocks.


def rows_of(places: Sequence[AnyLog]) -> int:
    """Rows of logs, as far as their files tell without being read; of CSV files about.

    Raises:
        DataError: a file is damaged.
    """
    rows = 0
    for place in places:
        if isinstance(place, observation.Log):
            rows += place.rows
        elif isinstance(place, str | Path):
            path, span = file_and_span(place)
            blocks = blocks_of(Path(path)) if span is None else None
            rows += 0 if blocks is None else blocks.rows
    return rows


def are_long(places: Sequence[AnyLog]) -> bool:
    """True of logs whose fit reads them in chunks."""
    return rows_of(places) > observation.LONG


def too_long(places: Sequence[AnyLog]) -> bool:
    """True of logs that are not read at once, whatever for."""
    return rows_of(places) > observation.MOST_WHOLE


def check_fits_memory(places: Sequence[AnyLog], what: str) -> None:
    """Refuse logs that are too long to be read at once.

    Raises:
        DataError: they have more rows than that.
    """
    if too_long(places):
        raise DataError(
            f"fit: {what} keeps all rows in memory; got {rows_of(places)} rows, expected "
            f"at most {observation.MOST_WHOLE}; give a part of the log, FILE@START:END, or take "
            f"--method {' or '.join(OF_TRIANGLES)}, which read logs of any length"
        )


def processing_of(options: Mapping[str, Any]) -> observation.Processing:
    """The processing by options of `modeler fit`, or by `[fit]` of a robot file."""
    names = {"cutoff": "position_cutoff", "decimate": "decimation"}
    own = {field.name for field in dataclasses.fields(observation.Processing)}
    known = {names.get(name, name): value for name, value in options.items()}
    return observation.Processing(**{name: value for name, value in known.items() if name in own})


def sources_of(
    compiled: CompiledModel, places: Sequence[AnyLog], mapping: Mapped = ()
) -> list[observation.Source]:
    """The rows of logs, in blocks where their format allows it.

    Raises:
        DataError: a log cannot be read.
    """
    found: list[observation.Source] = []
    for place, names in zip(places, log_maps(compiled, places, mapping), strict=True):
        source = None
        if isinstance(place, str | Path) and file_and_span(place)[1] is None:
            source = observation.source_of(Path(place), compiled.spec, names)
        found.append(source or observation.MemorySource(read_logs(compiled, [place], names)[0]))
    return found


def observe(
    compiled: CompiledModel,
    logs: Logs,
    processing: observation.Processing | None = None,
    mapping: Mapped = (),
) -> observation.Observation:
    """The rows y = W beta of logs.

    >>> observe(compiled, ["mon.parquet"]).W.shape[1]
    10
    """
    given = read_logs(compiled, logs, mapping)
    observation.check_apart(given)
    return observation.observe(compiled, given, processing)


def recompile(model: IdentifiedModel) -> CompiledModel:
    """The compiled robot of a model, its C emitted anew from the robot text in the model.

    >>> recompile(model).spec.robot
    'two-link'

    A model file may come from anybody; `model.compile()` would run the C that stands in it.

    Raises:
        ManifestError: this version derives another manifest than the one that the values belong to.
    """
    otherwise = ", or use --run-embedded-c to run the C in the file if you trust its source"
    emitted = emitted_anew(model, otherwise)[1]
    return compile_model(dataclasses.replace(emitted, log=model.mapping or emitted.log))


def emitted_anew(model: IdentifiedModel, otherwise: str = "") -> tuple[Derivation, Emitted]:
    """What the robot text of a model gives, if that is what its values belong to."""
    derivation, emitted = derived(model.robot_text, f"robot {model.spec.robot} in the model file")
    if emitted.spec.signature() != model.spec.signature():
        what = "manifest" if _uncoded(emitted.spec) != _uncoded(model.spec) else "C"
        raise ManifestError(
            f"model of {model.spec.robot}: its robot text gives another {what} than its values "
            "belong to: made by another version of modeler, or changed since; fit it again"
            f"{otherwise}"
        )
    return derivation, emitted


@lru_cache(maxsize=4)
def derived(text: str, where: str) -> tuple[Derivation, Emitted]:
    """Of a robot file's text; the last ones are kept, for who asks again."""
    derivation = derive(robot_from_text(text, where))
    return derivation, generate_robot(derivation)


def _uncoded(spec: ModuleSpec) -> ModuleSpec:
    return dataclasses.replace(spec, code="")


def reduced(model: M) -> M:
    """The model with its essential parameters only, estimated anew; all others are 0.

    >>> len(reduced(model).beta) == len(model.beta)
    True

    Raises:
        DataError: the model was saved by a version that kept none.
    """
    found = model_file.with_essential_only(model, f"model of {model.spec.robot}")
    return dataclasses.replace(model, fit=found.fit)


def save(thing: IdentifiedModel | Robot, path: str | Path) -> Path:
    """Write a model file, or the file of a robot; an interrupted write leaves the old file.

    >>> save(robot, "arm.toml").name, save(model, "arm.json").name
    ('arm.toml', 'arm.json')

    Raises:
        ModelerError: the folder cannot be written.
    """
    if isinstance(thing, Robot):
        write_atomically(Path(path), thing.text)
    else:
        model_file.save_model(path, thing)
    return Path(path)


# What is built in: robots, effects, estimators; each as a table.


def robots() -> Table:
    """The built-in robots; `load(name)` gives one.

    >>> "ur10e" in robots().column("name")
    True
    """
    every = [read_robot(name) for name in builtin_names()]
    rows = [
        (robot.name, robot.title, len(robot.coordinates), len(robot.moving), len(robot.loops),
         ", ".join(use.effect for use in robot.effects))
        for robot in every
    ]  # fmt: skip
    return Table.of("built-in robots", "name, title, coordinates, joints, loops, effects", rows)


def effects(robot: Robot | None = None) -> Table:
    """The catalogue of physical effects; with a robot, its own ones too.

    `modeler effects ID` says more of each.

    >>> dict(zip(effects().column("effect"), effects().column("parameters")))["coulomb"]
    'Fs'
    """
    known = CATALOGUE if robot is None else robot.catalogue
    rows = [
        (effect.id, effect.title, effect.equation,
         ", ".join(column.prefix for column in effect.columns), ", ".join(effect.aliases))
        for effect in known
    ]  # fmt: skip
    return Table.of("physical effects", "effect, title, equation, parameters, also called", rows)


def estimators() -> Table:
    """The estimators that `fit` takes as `method`.

    >>> estimators().column("method")[:2]
    ['weighted', 'ordinary']
    """
    rows = [(a.id, a.title, a.law, a.source, a.avoid, a.motion) for a in ABOUT.values()]
    names = "method, title, law, source, when not to use it, noise of the motion"
    return Table.of("estimators", names, rows)


def on_gpu(derivation: Derivation) -> GpuModel:
    """The base regressor of a robot without loops on the graphics processor of this machine.

    It needs CuPy: `pip install "modeler-robotics[gpu]"`.

    Raises:
        BuildError: no CuPy, no graphics processor, or the compiler refused.
        EmitError: the robot has loops.
    """
    return load_gpu(generate(derivation, cuda=True))
