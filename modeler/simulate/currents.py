"""Logs of currents: which joints log theirs, and the torque that a unit of it makes."""

import math
from collections.abc import Sequence

from modeler.core.errors import DataError
from modeler.robot import Robot


def drive_gains(texts: Sequence[str], robot: Robot) -> dict[str, float]:
    """Torque per drive unit by joint, N m or N, from texts such as "11=2110".

    Raises:
        DataError: another form, no such joint or one without a motor, a joint twice, a gain that
            is no number or 0.
    """
    motors = [joint.name for joint in robot.coordinates if joint.actuated]
    found: dict[str, float] = {}
    for text in texts:
        joint, equals, number = (part.strip() for part in text.partition("="))
        if not equals or joint in found:
            raise DataError(
                f"--drive-gain {text}: expected each joint once as JOINT=VALUE, as in "
                f"{motors[0] if motors else 1}=12.5"
            )
        if joint not in motors:
            raise DataError(
                f"--drive-gain {text}: {robot.name} has no joint {joint} with a motor; expected "
                f"one of {', '.join(motors)}"
            )
        found[joint] = _gain(text, number)
    return found


def _gain(text: str, number: str) -> float:
    try:
        value = float(number)
    except ValueError:
        value = math.nan
    if not math.isfinite(value) or value == 0.0:
        raise DataError(
            f"--drive-gain {text}: got {number or 'nothing'}; expected torque per drive unit, a "
            "number other than 0"
        )
    return value
