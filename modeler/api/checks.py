"""Is a model true? Comparisons, free runs, several models on the same rows."""

from __future__ import annotations  # what a signature names is loaded when it is checked

from collections.abc import Callable, Mapping, Sequence
from string import ascii_uppercase

import modeler.api.workflow as workflow
from modeler import validation
from modeler.api.log_maps import Mapped
from modeler.api.workflow import AnyLog, are_long, sources_of, too_long
from modeler.core.errors import DataError
from modeler.estimation import IdentifiedModel
from modeler.observation import Log, Observation, WholeLogNeeded, check_apart
from modeler.runtime import CompiledModel


def compare(
    model: IdentifiedModel, logs: Sequence[AnyLog], mapping: Mapped = ()
) -> validation.Comparison:
    """Measured against predicted torque on logs, after the processing of the fit.

    >>> [joint.joint.name for joint in compare(model, ["tue.parquet"]).joints]
    ['1', '2']
    """
    return compared(model, logs, workflow.recompile(model), mapping)[0]


def compared(
    model: IdentifiedModel,
    logs: Sequence[AnyLog],
    compiled: CompiledModel,
    mapping: Mapped = (),
    progress: Callable[[float], None] = lambda share: None,
    tell: Callable[[str], None] = lambda line: None,
) -> tuple[validation.Comparison, Observation]:
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
            comparison, observation = validation.compare_long(model, sources, compiled, progress)
            check_apart(observation.report.logs)
            return comparison, observation
        except WholeLogNeeded as error:
            if too_long(logs):
                raise
            tell(f"{error}; read as a whole instead")
    read = workflow.read_logs(compiled, logs, mapping)
    check_apart(read, places=[str(log) for log in logs])
    prediction, observation = validation.predict(model, read, compiled)
    return validation.compare(prediction), observation


def contest(
    models: Mapping[str, IdentifiedModel] | Sequence[IdentifiedModel],
    logs: Sequence[AnyLog],
    mapping: Mapped = (),
) -> validation.Contest:
    """Models side by side: the error of each by joint, and which is better beyond doubt.

    >>> contest({"all": model, "few": reduced(model)}, ["tue.parquet"]).names
    ('all', 'few')

    Args:
        models: by the name that they are to have; of a list they are called A, B, C ...
        logs: of motion that none was fitted on.
        mapping: as of `read_logs`.

    Raises:
        DataError: fewer than two models, or of different robots.
    """
    if len(models) < 2:
        raise DataError(f"contest: got {len(models)} models; expected two at least")
    if isinstance(models, Mapping):
        named = models
    elif len(models) <= len(ascii_uppercase):
        named = dict(zip(ascii_uppercase, models, strict=False))
    else:
        raise DataError(
            f"contest: got a list of {len(models)} models, more than there are letters; expected a "
            "mapping of names, each to a model"
        )
    return contested(named, [workflow.recompile(model) for model in named.values()], logs, mapping)[
        0
    ]


def contested(
    models: Mapping[str, IdentifiedModel],
    compiled: Sequence[CompiledModel],
    logs: Sequence[AnyLog],
    mapping: Mapped = (),
    places: Sequence[str] = (),
) -> tuple[validation.Contest, list[Log]]:
    """The same of compiled models, and the logs.

    Args:
        models: by name.
        compiled: they.
        logs: of motion that none was fitted on.
        mapping: as of `read_logs`.
        places: what messages call the logs.
    """
    read = [workflow.read_logs(own, logs, mapping) for own in compiled]
    check_apart(read[0], places=places)
    names = list(models)
    predictions, _ = validation.predict_together(list(models.values()), compiled, read, names)
    return validation.contest(names, predictions), read[0]


def free_run(
    model: IdentifiedModel,
    logs: Sequence[AnyLog],
    asked: validation.FreeRunSettings | None = None,
    mapping: Mapped = (),
) -> validation.FreeRun:
    """Positions of the fitted robot under the logged torques, beside the logged ones.

    >>> found = free_run(model, ["tue.parquet@0:0.5"], FreeRunSettings(window=0.2))
    >>> [joint.name for joint in found.joints]
    ['1', '2']

    Args:
        model: fitted.
        logs: of motion that it was not fitted on.
        asked: window in s, bound as a share of the range of motion, controller gains.
        mapping: as of `read_logs`.

    Raises:
        DataError: a log cannot be run; says why.
    """
    compiled = workflow.recompile(model)
    return validation.free_run(
        model,
        workflow.read_logs(compiled, logs, mapping),
        compiled,
        asked or validation.FreeRunSettings(),
    )
