"""From a fitted model and logs to measured and predicted torque."""

from collections.abc import Sequence
from typing import Literal, cast

from modeler.compare.prediction import JointInfo, Prediction
from modeler.compiled import CompiledModel
from modeler.fit import IdentifiedModel
from modeler.observation import Log, Observation, observe


def predict(
    model: IdentifiedModel, logs: Sequence[Log], compiled: CompiledModel
) -> tuple[Prediction, Observation]:
    """What the model says of logs, processed as the logs it was fitted on.

    Args:
        model: fitted.
        logs: read with its manifest.
        compiled: its robot.

    Raises:
        DataError: no usable row.
    """
    observation = observe(compiled, logs, model.processing)
    prediction = Prediction(
        robot=model.spec.robot,
        joints=tuple(
            JointInfo(
                joint.name,
                cast(Literal["rad", "m"], joint.unit),
                cast(Literal["N m", "N"], joint.effort_unit),
            )
            for joint in observation.joints
        ),
        logs=observation.logs,
        run=observation.run,
        segment=observation.segment,
        time=observation.time,
        q=observation.q,
        qd=observation.qd,
        qdd=observation.qdd,
        measured=observation.torque,
        predicted=observation.predicted(model.beta),
        used=observation.used,
    )
    return prediction, observation
