"""What each column of ours measures, so that a unit that cannot be is refused."""

from collections.abc import Sequence

from modeler.core.contract import JointSpec
from modeler.core.errors import DataError
from modeler.logs.mapping import Entry
from modeler.logs.units import (
    ANGLE,
    CURRENT,
    FORCE,
    HEAT,
    LENGTH,
    NONE,
    TIME,
    TORQUE,
    VOLTAGE,
    Powers,
    Unit,
)

_MOTION = {"q": 0, "qc": 0, "qd": 1, "qdd": 2}  # times that time is divided by


def si_unit(own: str, entry: Entry, unit: Unit, joints: Sequence[JointSpec]) -> Unit:
    """The unit of an entry as one of what our column measures.

    Raises:
        DataError: it measures something else; names the entry, the joint and what was expected.
    """
    wanted, what, example = _wanted(own, joints)
    if wanted is None:
        return unit
    if wanted == CURRENT and unit.powers in (NONE, VOLTAGE):
        return unit  # drive units: what the drive gain is of
    found = unit.as_quantity(wanted)
    if found is None:
        also = "; a current is called current<j>" if unit.powers == CURRENT else ""
        raise DataError(
            f'{entry.where or own}: got unit "{unit.text}", which is {unit.kind}; {own} is {what}: '
            f"expected a unit such as {example}{also}"
        )
    return found


def _wanted(own: str, joints: Sequence[JointSpec]) -> tuple[Powers | None, str, str]:
    """Powers, in words, and examples of units; None for a column that may measure anything."""
    if own == "time":
        return TIME, "a time", "s, ms, us, ns"
    if own.startswith("temperature"):
        return HEAT, "a temperature", "degC, K, degF"
    for joint in joints:
        turns = joint.unit == "rad"
        kind = f"of joint {joint.name}, which is {joint.kind}"
        if own == f"current{joint.name}":
            return CURRENT, f"a current {kind}", "mA, A, V, %"
        if own == f"tau{joint.name}" and joint.effort_unit == "N m":
            return TORQUE, f"a torque {kind}", "N m, mN m, kg cm, lb in"
        if own == f"tau{joint.name}":
            return FORCE, f"a force {kind}", "N, kN, kgf, lbf"
        for prefix, over in _MOTION.items():
            if own == f"{prefix}{joint.name}":
                return _motion(turns, over, kind)
    return None, "", ""


def _motion(turns: bool, over: int, kind: str) -> tuple[Powers, str, str]:
    m, kg, s, rad, A, K = ANGLE if turns else LENGTH
    what = ("a position", "a speed", "an acceleration")[over]
    units = ("deg", "rad", "rev") if turns else ("mm", "m", "in")
    written = ("", "/s", "/s^2")[over]
    example = ", ".join(unit + written for unit in units) + (", rpm" if turns and over == 1 else "")
    return (m, kg, s - over, rad, A, K), f"{what} {kind}", example
