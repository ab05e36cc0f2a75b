"""The fitted robot left to itself under what was logged."""

from collections.abc import Sequence

from modeler.api.chain import AnyLog, Mapped, read_logs, recompile
from modeler.fit import IdentifiedModel
from modeler.freerun import Asked, FreeRun
from modeler.freerun import free_run as run_freely


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
