"""What a model predicts against what was measured, and what it lacks."""

from collections.abc import Callable, Sequence

from modeler.api.chain import AnyLog, Mapped, read_logs, recompile
from modeler.api.long_logs import are_long, sources_of, too_long
from modeler.compare import Comparison
from modeler.compare import compare as compare_prediction
from modeler.compare.predict import compare_long, predict
from modeler.compiled import CompiledModel
from modeler.diagnose import Diagnosis, Known
from modeler.diagnose import diagnose as find_missing
from modeler.fit import IdentifiedModel
from modeler.observation import Observation
from modeler.observation.apart import check_apart
from modeler.observation.survey import WholeNeeded
from modeler.robot import robot_from_text


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
