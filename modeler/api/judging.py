"""What a model predicts against what was measured, and what it lacks."""

from collections.abc import Callable, Sequence

from modeler.api.chain import AnyLog, Mapped, read_logs, recompile
from modeler.compare import Comparison
from modeler.compare import compare as compare_prediction
from modeler.compare.predict import predict
from modeler.diagnose import Diagnosis, Known
from modeler.diagnose import diagnose as find_missing
from modeler.fit import IdentifiedModel
from modeler.observation.apart import check_apart
from modeler.robot import robot_from_text


def compare(model: IdentifiedModel, logs: Sequence[AnyLog], mapping: Mapped = ()) -> Comparison:
    """Measured against predicted torque on logs, after the processing of the fit."""
    compiled = recompile(model)
    prediction, _ = predict(model, read_logs(compiled, logs, mapping), compiled)
    return compare_prediction(prediction)


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
