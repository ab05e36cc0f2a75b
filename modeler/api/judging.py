"""What a model predicts against what was measured, and what it lacks."""

from collections.abc import Callable, Mapping, Sequence
from string import ascii_uppercase

from modeler.api.chain import AnyLog, Mapped, read_logs, recompile
from modeler.api.long_logs import are_long, sources_of, too_long
from modeler.compare import Comparison
from modeler.compare import compare as compare_prediction
from modeler.compare.predict import compare_long, predict
from modeler.compare.together import predict_together
from modeler.compiled import CompiledModel
from modeler.core.errors import DataError
from modeler.diagnose import Diagnosis, Known
from modeler.diagnose import diagnose as find_missing
from modeler.fit import IdentifiedModel
from modeler.freerun import Asked, FreeRun
from modeler.freerun import free_run as run_freely
from modeler.observation import Observation
from modeler.observation.apart import check_apart
from modeler.observation.survey import WholeNeeded
from modeler.robot import robot_from_text
from modeler.scoring.contest import Contest
from modeler.scoring.contest import contest as judged


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
