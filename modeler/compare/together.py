"""Several models on the same rows of the same logs."""

import dataclasses
from collections.abc import Sequence

import numpy as np

from modeler.compare.predict import predict
from modeler.compare.prediction import Prediction
from modeler.compiled import CompiledModel
from modeler.core.errors import DataError
from modeler.fit import IdentifiedModel
from modeler.observation import Log, Observation, Processing


def predict_together(
    models: Sequence[IdentifiedModel],
    compiled: Sequence[CompiledModel],
    logs: Sequence[Sequence[Log]],
    names: Sequence[str],
) -> tuple[list[Prediction], list[Observation]]:
    """What each model says of the same rows.

    All are processed as the first model's logs were, but for a delay, which belongs to its model; a
    row counts if it counts for every model.

    Args:
        models: two or more, of robots with the same joints.
        compiled: their robots.
        logs: the same logs, as each robot reads them.
        names: of the models, for errors.

    Raises:
        DataError: other joints, no usable row, or none that counts for every model.
    """
    check_joints(models, names)
    first = models[0].processing
    made = [
        predict(_processed_as(model, first), read, own)
        for model, own, read in zip(models, compiled, logs, strict=True)
    ]
    predictions = [prediction for prediction, _ in made]
    used = np.logical_and.reduce(_used_of(predictions, names))
    if not used.any():
        raise DataError(
            f"{', '.join(names)}: no row of these logs counts for every model; compare them one by "
            "one to see why"
        )
    found = [_on(prediction, used) for prediction in predictions]
    return found, [observation for _, observation in made]


def _used_of(predictions: Sequence[Prediction], names: Sequence[str]) -> list[np.ndarray]:
    """Rows that count for each model, if they are the same rows."""
    for prediction, name in zip(predictions[1:], names[1:], strict=True):
        if not _same_rows(predictions[0], prediction):
            raise DataError(
                f"{name}: its rows of these logs are not those of {names[0]}, so errors cannot be "
                "set side by side; expected robots that read the same columns; compare them one "
                "by one"
            )
    return [prediction.used for prediction in predictions]


def _processed_as(model: IdentifiedModel, other: Processing) -> IdentifiedModel:
    processing = dataclasses.replace(other, delay=model.processing.delay)
    return dataclasses.replace(model, fit=dataclasses.replace(model.fit, processing=processing))


def _on(prediction: Prediction, used: np.ndarray) -> Prediction:
    """On the rows that count for every model; what counts for this one alone is masked unnamed."""
    return dataclasses.replace(prediction, used=used, full=None)


def _same_rows(one: Prediction, other: Prediction) -> bool:
    return (
        one.time.shape == other.time.shape
        and np.array_equal(one.run, other.run)
        and np.array_equal(one.time, other.time)
    )


def check_joints(models: Sequence[IdentifiedModel], names: Sequence[str]) -> None:
    """Refuse models of robots whose joints differ.

    Raises:
        DataError: names the first of them.
    """

    def joints(model: IdentifiedModel) -> list[tuple[str, str]]:
        return [(joint.name, joint.effort_unit) for joint in model.spec.joints]

    for model, name in zip(models[1:], names[1:], strict=True):
        if joints(model) != joints(models[0]):
            said = [", ".join(f"{j} [{u}]" for j, u in joints(m)) for m in (models[0], model)]
            raise DataError(
                f"{name}: joints {said[1]}; expected those of {names[0]}, {said[0]}; only models "
                "of robots with the same joints are set side by side"
            )
