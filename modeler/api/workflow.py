"""The chain: from a robot to its C, from logs to a model."""

import dataclasses
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import AbstractContextManager
from functools import lru_cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, TypeVar

from modeler import regression
from modeler.api.log_maps import Mapped, build_log_maps, parse_time_range, read_mapped_log
from modeler.codegen import Derivation as Derivation, derive as derive, generate as generate_robot
from modeler.core.choices import ABOUT, list_builtin_robots
from modeler.core.errors import ManifestError
from modeler.core.files import write_atomically
from modeler.core.json import select_attributes
from modeler.core.manifest import EmittedModule, ModuleSpec
from modeler.core.options import CONTROLLED, GenerateOptions, OptionError
from modeler.core.table import Table
from modeler.effects import CATALOGUE
from modeler.estimation import OF_TRIANGLES, IdentifiedModel, model_file
from modeler.formats import convert as convert, read_robot
from modeler.logs import Frame, LogMap, open_blocks
from modeler.robot import Robot, insert_own_effect, new_robot as new_robot, parse_robot_text
from modeler.runtime import CompiledModel, load_module as load_compiled
from modeler.simulation import SimulatedLog, write_log

if TYPE_CHECKING:
    from modeler.runtime import GpuModel

AnyLog = str | Path | regression.Log | SimulatedLog | Mapping[str, Any] | Frame
"""A log: its file, a piece of it (`run.parquet@0:10`), one that was read, one just simulated.

Or columns in memory: a frame of pandas or Polars, a dict of arrays.
"""

Logs = AnyLog | Sequence[AnyLog]
"""Logs; one alone stands for a list of it."""


def load(robot: str | Path) -> Robot:
    """Reads the robot of a file (TOML, URDF, MJCF, .par), or the built-in robot of that name.

    >>> load("two-link").table().column("theta")
    ['q1', 'q2', '0']
    """
    return read_robot(robot)


def convert_to_list(logs: Logs) -> Sequence[AnyLog]:
    """Returns logs as a list; one log stands for a list of it."""
    if isinstance(logs, str | Mapping) or hasattr(logs, "__arrow_c_stream__"):
        return [logs]
    if isinstance(logs, Sequence):
        return logs
    return list(logs) if isinstance(logs, Iterable) else [logs]


M = TypeVar("M", bound=IdentifiedModel)

Steps = Callable[[str], AbstractContextManager[None]]
"""Called with the title of a step, which lasts as long as the context."""


def define_effect(robot: Robot, name: str, **definition: Any) -> Robot:
    """Returns the robot with the definition of an effect that the catalogue lacks.

    >>> robot = define_effect(load("emps"), "fan", columns={"Kf": "v*abs(v)"}, nonnegative=True)
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
    return parse_robot_text(insert_own_effect(robot.text, name, definition), robot.name)


def generate(
    source: Derivation | IdentifiedModel,
    folder: str | Path | None = None,
    *,
    force: bool = False,
    **options: Any,
) -> EmittedModule:
    """Generates the C module of a robot; of a model with functions that have its values.

    >>> "two_link.h" in generate(derivation).files
    True

    Args:
        source: what was derived, or a fitted model.
        folder: the module is written there if it is given.
        force: write also over files that no earlier run wrote, or that were edited since.
        options: of `GenerateOptions`: precision ("double", "single"), cuda, structured_text, a2l,
            frames (names of rows or links), only (names of functions), vectors, measure (a machine,
            whose stack and flash [bytes] and instructions are counted).

    Raises:
        DataError: an option that is none.
        BuildError: the compiler for that machine is missing.
        ManifestError: this version derives another manifest than the one that the values of the
            model belong to.
        ModelerError: the folder holds such files and `force` is not given; or it cannot be written.
    """
    chosen = GenerateOptions.from_keywords("generate", options)
    if isinstance(source, Derivation):
        derivation, fitted = source, None
    else:
        derivation, fitted = emit_model(source)[0], model_file.build_fitted_spec(source)
    control = None
    if chosen != GenerateOptions(chosen.precision, chosen.cuda):
        from modeler.codegen import Control  # who fits need not wait for it

        control = Control(**select_attributes(chosen, CONTROLLED))
    return generate_robot(
        *(derivation, folder, force, fitted, chosen.precision, chosen.cuda, control),
        measure=chosen.measure,
    )


def compile_model(emitted: EmittedModule) -> CompiledModel:
    """Compiles the C module, once for the same content, and returns it callable.

    >>> compile_model(emitted).gravity([[0.0, 0.0]], model.beta).shape
    (1, 2)
    """
    return load_compiled(emitted.spec, emitted.code, emitted.log)


@dataclasses.dataclass(frozen=True, eq=False)
class CompiledRobot:
    """Holds the derivation of a robot, its C, and that compiled."""

    derivation: Derivation
    emitted: EmittedModule
    compiled: CompiledModel


def compile_robot(robot: Robot) -> CompiledRobot:
    """Derives a robot, emits its C and compiles it."""
    derivation = derive(robot)
    emitted = generate(derivation)
    return CompiledRobot(derivation, emitted, compile_model(emitted))


def read_logs(
    compiled: CompiledModel, logs: Logs, mapping: Mapped = (), spread: bool = False
) -> list[regression.Log]:
    """Reads logs by path, or by `path@start:end` in seconds; parsed logs are returned as they are.

    >>> [log.rows for log in read_logs(compiled, ["mon.parquet", "tue.parquet@1:2"])]
    [6000, 1000]

    Args:
        compiled: the robot; its file's [log] says which columns are which.
        logs: of any format of `modeler.logs`.
        mapping: over [log]: a table like it, or texts as `--map` takes them; "auto" among them
            takes the guess of `inspect_log` for what is left open.
        spread: True if of a log of more than a million rows evenly spread segments will do.
    """
    log_list = convert_to_list(logs)
    every = enumerate(zip(log_list, build_log_maps(compiled, log_list, mapping), strict=True))
    return [_read_log(*each, compiled.spec, spread) for each in every]


def read_currents(
    compiled: CompiledModel, logs: Logs, mapping: Mapped = ()
) -> list[regression.Log]:
    """Reads logs of currents; without a drive gain torques are in drive units.

    >>> run = simulate(robot, duration=2.0, seed=1)
    >>> read_currents(compiled, {"time": run.time, "q": run.q, "current": run.tau})[0].rows
    2000

    Raises:
        DataError: a log gives a torque instead.
    """
    from modeler.estimation import check_currents, set_unit_gains  # of drive gains alone

    spec, log_list = set_unit_gains(compiled.spec), convert_to_list(logs)
    every = enumerate(zip(log_list, build_log_maps(compiled, log_list, mapping), strict=True))
    read = [_read_log(*each, spec) for each in every]
    check_currents(read, spec.joints)
    return read


def _read_log(
    number: int, log_and_map: tuple[AnyLog, LogMap], spec: ModuleSpec, spread: bool = False
) -> regression.Log:
    log, names = log_and_map
    if isinstance(log, regression.Log):
        return log
    if not isinstance(log, SimulatedLog):
        return read_mapped_log(log, spec, names, f"logs[{number}]", spread)
    with TemporaryDirectory() as folder:  # read as whoever gets the file will read it
        place = Path(folder) / f"{log.robot}-seed{log.settings.seed}.parquet"
        write_log(place, log)
        read = regression.read_log(place, spec)
    return dataclasses.replace(read, path="")


# Long logs: whether some are, and their rows in blocks.


def count_rows(places: Sequence[AnyLog]) -> int:
    """Counts the rows of logs as far as their files state them; of CSV files approximately.

    Raises:
        DataError: a file is damaged.
    """
    rows = 0
    for place in places:
        if isinstance(place, regression.Log):
            rows += place.rows
        elif isinstance(place, str | Path):
            path, span = parse_time_range(place)
            blocks = open_blocks(Path(path)) if span is None else None
            rows += 0 if blocks is None else blocks.rows
    return rows


def are_long(places: Sequence[AnyLog]) -> bool:
    """Returns True for logs whose fit reads them in chunks."""
    return count_rows(places) > regression.LONG


def are_too_long(places: Sequence[AnyLog]) -> bool:
    """Returns True for logs that are never read at once."""
    return count_rows(places) > regression.MOST_WHOLE


def check_fits_memory(places: Sequence[AnyLog], what: str) -> None:
    """Raises an error for logs that are too long to be read at once.

    Raises:
        DataError: they have more rows than that.
    """
    if are_too_long(places):
        raise OptionError(
            f"fit: {what} keeps all rows in memory; got {count_rows(places)} rows, expected "
            f"at most {regression.MOST_WHOLE}; give a part of the log, FILE@START:END, or take "
            f"{{--method}} {' or '.join(OF_TRIANGLES)}, which read logs of any length"
        )


def build_processing(options: Mapping[str, Any]) -> regression.Processing:
    """Builds the processing from options of `modeler fit` or from `[fit]` of a robot file."""
    names = {"cutoff": "position_cutoff", "decimate": "decimation"}
    field_names = {field.name for field in dataclasses.fields(regression.Processing)}
    known = {names.get(name, name): value for name, value in options.items()}
    return regression.Processing(
        **{name: value for name, value in known.items() if name in field_names}
    )


def open_sources(
    compiled: CompiledModel, places: Sequence[AnyLog], mapping: Mapped = ()
) -> list[regression.Source]:
    """Opens the rows of logs, in blocks where their format allows it.

    Raises:
        DataError: a log cannot be read.
    """
    sources: list[regression.Source] = []
    for place, names in zip(places, build_log_maps(compiled, places, mapping), strict=True):
        source = None
        if isinstance(place, str | Path) and parse_time_range(place)[1] is None:
            source = regression.open_source(Path(place), compiled.spec, names)
        sources.append(source or regression.MemorySource(read_logs(compiled, [place], names)[0]))
    return sources


def observe(
    compiled: CompiledModel,
    logs: Logs,
    processing: regression.Processing | None = None,
    mapping: Mapped = (),
) -> regression.Observation:
    """Builds the observation y = W beta of logs.

    >>> observe(compiled, ["mon.parquet"]).W.shape[1]
    10
    """
    parsed_logs = read_logs(compiled, logs, mapping)
    regression.check_no_overlap(parsed_logs)
    return regression.observe(compiled, parsed_logs, processing)


def compile(model: IdentifiedModel) -> CompiledModel:
    """Compiles the robot of a model from its robot text.

    >>> compile(model).spec.robot
    'two-link'

    A model file may come from anybody; `model.compile()` would run the C that stands in it.

    Raises:
        ManifestError: this version derives another manifest than the one that the values belong to.
    """
    otherwise = ", or use --run-embedded-c to run the C in the file if you trust its source"
    emitted = emit_model(model, otherwise)[1]
    emitted = dataclasses.replace(emitted, log=model.mapping or emitted.log)
    return compile_model(emitted).set_windup(model.beta, model.fit.elastic_values)


def emit_model(model: IdentifiedModel, otherwise: str = "") -> tuple[Derivation, EmittedModule]:
    """Derives and emits the robot text of a model, and checks that its values belong to it."""
    derivation, emitted = derive_text(
        model.robot_text, f"robot {model.spec.robot} in the model file"
    )
    if emitted.spec.compute_signature() != model.spec.compute_signature():
        what = "manifest" if _remove_code(emitted.spec) != _remove_code(model.spec) else "C"
        raise ManifestError(
            f"model of {model.spec.robot}: its robot text gives another {what} than its values "
            "belong to: made by another version of modeler, or changed since; fit it again"
            f"{otherwise}"
        )
    return derivation, emitted


@lru_cache(maxsize=4)
def derive_text(text: str, where: str) -> tuple[Derivation, EmittedModule]:
    """Derives the text of a robot file; the last results are cached."""
    derivation = derive(parse_robot_text(text, where))
    return derivation, generate_robot(derivation)


def _remove_code(spec: ModuleSpec) -> ModuleSpec:
    return dataclasses.replace(spec, code="")


def reduced_model(model: M) -> M:
    """Returns the model with its essential parameters only, estimated again; others are 0.

    >>> len(reduced_model(model).beta) == len(model.beta)
    True

    Raises:
        DataError: the model was saved by a version that kept none.
    """
    essential_model = model_file.keep_essential(model, f"model of {model.spec.robot}")
    return dataclasses.replace(model, fit=essential_model.fit)


def save(thing: IdentifiedModel | Robot, path: str | Path) -> Path:
    """Writes a model or a robot file; an interrupted write leaves the old file.

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
    """Lists the built-in robots; `load(name)` reads one.

    >>> "ur10e" in robots().column("name")
    True
    """
    every = [read_robot(name) for name in list_builtin_robots()]
    rows = [
        (
            robot.name,
            robot.title,
            len(robot.coordinates),
            len(robot.moving_joints),
            len(robot.loops),
            ", ".join(use.effect for use in robot.effects),
        )
        for robot in every
    ]
    return Table.build("built-in robots", "name, title, coordinates, joints, loops, effects", rows)


def effects(robot: Robot | None = None) -> Table:
    """Lists the physical effects; with a robot, those that it defines too.

    `modeler effects ID` says more of each.

    >>> dict(zip(effects().column("effect"), effects().column("parameters")))["coulomb"]
    'Fs'
    """
    known = CATALOGUE if robot is None else robot.catalogue
    rows = []
    for effect in known:
        prefixes = ", ".join(column.prefix for column in effect.columns)
        aliases = ", ".join(effect.aliases)
        rows.append((effect.id, effect.title, effect.equation, prefixes, aliases))
    return Table.build("physical effects", "effect, title, equation, parameters, also called", rows)


def estimators() -> Table:
    """Lists the estimators that `fit` takes as `method`.

    >>> estimators().column("method")[:2]
    ['weighted', 'ordinary']
    """
    rows = [(a.id, a.title, a.law, a.source, a.limitations, a.motion) for a in ABOUT.values()]
    names = "method, title, law, source, when not to use it, noise of the motion"
    return Table.build("estimators", names, rows)


def load_on_gpu(derivation: Derivation) -> "GpuModel":
    """Loads the base regressor of a robot without loops on the graphics processor.

    It needs CuPy: `pip install "modeler-robotics[gpu]"`.

    Raises:
        BuildError: no CuPy, no graphics processor, or the compiler refused.
        EmitError: the robot has loops.
    """
    from modeler.runtime import load_gpu  # few have one

    return load_gpu(generate(derivation, cuda=True))
