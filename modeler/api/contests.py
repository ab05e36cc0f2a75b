"""Several models on the same logs."""

from collections.abc import Mapping, Sequence
from string import ascii_uppercase

from modeler.api.chain import AnyLog, Mapped, read_logs, recompile
from modeler.compare.together import predict_together
from modeler.core.errors import DataError
from modeler.fit import IdentifiedModel
from modeler.observation.apart import check_apart
from modeler.scoring.contest import Contest
from modeler.scoring.contest import contest as judged


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
