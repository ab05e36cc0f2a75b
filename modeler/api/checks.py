"""Is a model true? Pages, free runs, several models on the same rows, steps through a model."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from string import ascii_uppercase

from modeler.api.long_logs import are_long, sources_of, too_long
from modeler.api.model import (
    AnyLog,
    Mapped,
    file_and_span,
    given_map,
    log_map,
    read_logs,
    recompile,
)
from modeler.codegen.derivation import Derivation, generate
from modeler.core.errors import DataError
from modeler.diagnosis.candidates import Known
from modeler.diagnosis.diagnosis import diagnose as find_missing
from modeler.diagnosis.result import Diagnosis
from modeler.estimation.model_file import IdentifiedModel
from modeler.estimation.side_by_side import SideBySide
from modeler.fleet.result import Fleet
from modeler.logs.blocks import blocks_of, windows_of
from modeler.logs.inspect import Look, look
from modeler.logs.table import Part, Table
from modeler.observation.log import FINGER, LONG, check_apart
from modeler.observation.observation import Observation
from modeler.observation.survey import WINDOW, WINDOWS, WholeNeeded
from modeler.report.comparison import write_contest
from modeler.report.comparison import write_report as write_comparison
from modeler.report.diagnosis import write_diagnosis
from modeler.report.estimators import write_estimators
from modeler.report.fit import write_fit
from modeler.report.fleet import write_fleet
from modeler.report.history import write_additions
from modeler.report.log import write_log_page
from modeler.report.showing import show
from modeler.robot.read import robot_from_text
from modeler.robot.robot import Robot
from modeler.runtime.gpu import GpuModel, load_gpu
from modeler.runtime.model import CompiledModel
from modeler.validation.comparison import Comparison
from modeler.validation.comparison import compare as compare_prediction
from modeler.validation.free_run import Asked
from modeler.validation.free_run import free_run as run_freely
from modeler.validation.free_run_result import FreeRun
from modeler.validation.models import Contest, predict_together
from modeler.validation.models import contest as judged
from modeler.validation.predict import compare_long, predict

Reported = Robot | Look | IdentifiedModel | Comparison | Contest | Diagnosis | SideBySide | Fleet
"""What has a page."""


def write_report(thing: Reported, path: str | Path, notes: Sequence[str] = ()) -> Path:
    """Write the page of a result; it needs no other file.

    Args:
        thing: a robot, a look at a log, a model (its fit; of one with additions, what they
            gained), a comparison, models side by side, a diagnosis, estimators side by side, or a
            fleet.
        path: of an .html file.
        notes: lines for the foot of the page: where the logs come from.

    Raises:
        DataError: no page shows it.
        ModelerError: the place cannot be written.
    """
    place = Path(path)
    if isinstance(thing, Robot):
        show(thing, place)
        return place
    if isinstance(thing, Look):
        return write_log_page(place, thing, thing.doubts, notes)
    if isinstance(thing, SideBySide):
        return write_estimators(place, thing.robot, thing.tried, [*thing.data, *notes])
    if isinstance(thing, IdentifiedModel):
        if thing.history:
            return write_additions(place, thing, notes)
        return write_fit(place, thing, notes)
    if isinstance(thing, Comparison):
        return write_comparison(place, thing, notes)
    if isinstance(thing, Contest):
        return write_contest(place, thing, notes)
    if isinstance(thing, Diagnosis):
        return write_diagnosis(place, thing, notes)
    if isinstance(thing, Fleet):
        return write_fleet(place, thing, notes)
    raise DataError(
        f"write_report: got {type(thing).__name__}; expected a robot, a model, a comparison, a "
        "diagnosis, models side by side, estimators side by side or a fleet"
    )


# What a model predicts against what was measured, and what it lacks.


def compare(model: IdentifiedModel, logs: Sequence[AnyLog], mapping: Mapped = ()) -> Comparison:
    """Measured against predicted torque on logs, after the processing of the fit."""
    return compared(model, logs, recompile(model), mapping)[0]


def compared(
    model: IdentifiedModel,
    logs: Sequence[AnyLog],
    compiled: CompiledModel,
    mapping: Mapped = (),
    progress: Callable[[float], None] = lambda share: None,
    tell: Callable[[str], None] = lambda line: None,
) -> tuple[Comparison, Observation]:
    """The same, and the observation behind it; long logs are read in chunks.

    Args:
        model: fitted.
        logs: that it predicts.
        compiled: its robot.
        mapping: as of `read_logs`.
        progress: is told the share of long logs that is done.
        tell: is told why long logs are read whole, if they must be.
    """
    if are_long(logs):
        try:
            sources = sources_of(compiled, logs, mapping)
            comparison, observation = compare_long(model, sources, compiled, progress)
            check_apart(observation.report.logs)
            return comparison, observation
        except WholeNeeded as error:
            if too_long(logs):
                raise
            tell(f"{error}; read as a whole instead")
    read = read_logs(compiled, logs, mapping)
    check_apart(read, places=[str(log) for log in logs])
    prediction, observation = predict(model, read, compiled)
    return compare_prediction(prediction), observation


def diagnose(
    model: IdentifiedModel,
    logs: Sequence[AnyLog],
    holdout: Sequence[AnyLog] = (),
    without: Sequence[str] = (),
    progress: Callable[[float], None] | None = None,
    mapping: Mapped = (),
) -> Diagnosis:
    """Which physical effect the model lacks on logs; errors from the held-out logs if given."""
    compiled = recompile(model)
    robot = robot_from_text(model.robot_text, "robot of the model")
    known = Known(robot.catalogue, robot.coupling)
    given, kept = (read_logs(compiled, places, mapping) for places in (logs, holdout))
    check_apart(given, kept)
    return find_missing(model, compiled, given, kept, without, progress=progress, known=known)


def contest(
    models: Mapping[str, IdentifiedModel] | Sequence[IdentifiedModel],
    logs: Sequence[AnyLog],
    mapping: Mapped = (),
) -> Contest:
    """Models side by side: the error of each by joint, and which is better beyond doubt.

    Args:
        models: by the name that they are to have; of a list they are called A, B, C ...
        logs: of motion that none was fitted on.
        mapping: as of `read_logs`.

    Raises:
        DataError: fewer than two models, or of different robots.
    """
    if len(models) < 2:
        raise DataError(f"contest: got {len(models)} models; expected two at least")
    named = models if isinstance(models, Mapping) else _lettered(models)
    compiled = [recompile(model) for model in named.values()]
    read = [read_logs(own, logs, mapping) for own in compiled]
    check_apart(read[0])
    names = list(named)
    predictions, _ = predict_together(list(named.values()), compiled, read, names)
    return judged(names, predictions)


def _lettered(models: Sequence[IdentifiedModel]) -> dict[str, IdentifiedModel]:
    if len(models) > len(ascii_uppercase):
        raise DataError(
            f"contest: got a list of {len(models)} models, more than there are letters; expected a "
            "mapping of names, each to a model"
        )
    return dict(zip(ascii_uppercase, models, strict=False))


def free_run(
    model: IdentifiedModel,
    logs: Sequence[AnyLog],
    asked: Asked | None = None,
    mapping: Mapped = (),
) -> FreeRun:
    """Positions of the fitted robot under the logged torques, beside the logged ones.

    Args:
        model: fitted.
        logs: of motion that it was not fitted on.
        asked: window in s, bound as a share of the range of motion, controller gains.
        mapping: as of `read_logs`.

    Raises:
        DataError: a log cannot be run; says why.
    """
    compiled = recompile(model)
    return run_freely(model, read_logs(compiled, logs, mapping), compiled, asked or Asked())


# What is in a log, before anything is fitted to it.


def look_at(place: str | Path, compiled: CompiledModel | None = None, mapping: Mapped = ()) -> Look:
    """Channels, clock, gaps and doubts of a log.

    Args:
        place: of any format of `modeler.logs`; with `@start:end` a piece of it.
        compiled: the robot that it may be of; None: the columns speak for themselves.
        mapping: whose column is which, as of `read_logs`; what it leaves open is guessed.

    Raises:
        DataError: the file cannot be read, or has no rows in that piece.
    """
    path, span = file_and_span(str(place))
    names = given_map(mapping) if compiled is None else log_map(compiled, mapping)
    joints = () if compiled is None else compiled.spec.joints
    blocks, span = blocks_of(Path(path)), span or (None, None)
    if blocks is None or blocks.rows <= LONG:
        table = Table(Path(path), names, joints, any_topic=True)
        return look(table, names, joints, span)
    seen = Part(windows_of(blocks, WINDOWS, WINDOW))
    every = (Table(Path(path), names, joints, part=Part(own)) for own in blocks.blocks(FINGER))
    return look(Table(Path(path), names, joints, part=seen), names, joints, span, every)


# How long work says what it is doing: nothing, unless somebody wants to hear it.


Steps = Callable[[str], AbstractContextManager[None]]
"""Called with the title of a step, which lasts as long as the context."""


def silent(title: str) -> AbstractContextManager[None]:
    """Says nothing."""
    return nullcontext()


# The base regressor on a graphics processor.


def on_gpu(derivation: Derivation) -> GpuModel:
    """The base regressor of a robot without loops on the graphics processor of this machine.

    It needs CuPy: `pip install '.[gpu]'`.

    Raises:
        BuildError: no CuPy, no graphics processor, or the compiler refused.
        EmitError: the robot has loops.
    """
    return load_gpu(generate(derivation, cuda=True))
