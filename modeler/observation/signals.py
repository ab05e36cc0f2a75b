"""What effects of a model read besides the motion, over the samples of a segment."""

import numpy as np

from modeler.core.contract import ModuleSpec, SignalSpec
from modeler.core.errors import DataError
from modeler.observation.bristle import bristle
from modeler.observation.motion import Segment


def signals_of(spec: ModuleSpec, segment: Segment) -> np.ndarray | None:
    """(n, m) the input `s` of the model's functions; None if it has none.

    Raises:
        DataError: a temperature that an effect reads was not logged.
    """
    if not spec.signals:
        return None
    names = [joint.name for joint in spec.joints]
    return np.column_stack([_signal(signal, segment, names) for signal in spec.signals])


def _signal(signal: SignalSpec, segment: Segment, names: list[str]) -> np.ndarray:
    if signal.kind == "time":
        return segment.time
    if signal.kind == "slip":
        return bristle(segment.q[:, names.index(signal.joint)], signal.value)
    for name in (f"temperature{signal.joint}", "temperature"):
        if name in segment.extra:
            return segment.extra[name]
    raise DataError(
        f"no column temperature{signal.joint} or temperature: an effect of the model on joint "
        f"{signal.joint} depends on it; log it, or take that effect out of the robot file"
    )
