"""Units by name, as factors to SI (`deg`, `N m`, `rev/8192`), and which a column may be in."""

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from modeler.core.contract import JointSpec
from modeler.core.errors import DataError

GRAVITY = 9.80665
"""m/s2, standard: what makes a kg or a lb into a force (3rd CGPM, 1901)."""

Powers = tuple[int, ...]
"""Exponents of (m, kg, s, rad, A, K)."""

NONE: Powers = (0, 0, 0, 0, 0, 0)
LENGTH: Powers = (1, 0, 0, 0, 0, 0)
MASS: Powers = (0, 1, 0, 0, 0, 0)
TIME: Powers = (0, 0, 1, 0, 0, 0)
ANGLE: Powers = (0, 0, 0, 1, 0, 0)
CURRENT: Powers = (0, 0, 0, 0, 1, 0)
HEAT: Powers = (0, 0, 0, 0, 0, 1)
FORCE: Powers = (1, 1, -2, 0, 0, 0)
TORQUE: Powers = (2, 1, -2, 0, 0, 0)
VOLTAGE: Powers = (2, 1, -3, 0, -1, 0)

_KINDS: Mapping[Powers, str] = {
    NONE: "a plain number", LENGTH: "a length", MASS: "a mass", TIME: "a time", ANGLE: "an angle",
    CURRENT: "a current", HEAT: "a temperature", FORCE: "a force", TORQUE: "a torque",
    VOLTAGE: "a voltage",
}  # fmt: skip

_INCH, _POUND = 0.0254, 0.45359237  # m, kg; exact (international yard and pound, 1959)
_WORDS = {
    "degree": "deg", "degrees": "deg", "radian": "rad", "radians": "rad", "revolution": "rev",
    "revolutions": "rev", "turns": "rev", "second": "s", "seconds": "s", "minutes": "min",
    "millisecond": "ms", "milliseconds": "ms", "meter": "m", "meters": "m", "metre": "m",
    "metres": "m", "millimeter": "mm", "millimeters": "mm", "newton": "N", "newtons": "N",
    "ampere": "A", "amperes": "A", "amps": "A", "volt": "V", "volts": "V", "celsius": "degC",
}  # fmt: skip
_PREFIXES = {
    "n": 1e-9, "u": 1e-6, "µ": 1e-6, "μ": 1e-6, "m": 1e-3, "c": 1e-2, "k": 1e3, "M": 1e6,
}  # fmt: skip
_DECADES = 100  # that no unit is away from SI
_PREFIXED = {"m", "g", "s", "rad", "deg", "A", "V", "N", "Nm", "Hz"}
_FACTOR = re.compile(
    r"\s*([*/·.]?)\s*([A-Za-zµμ°%]+|\d+(?:\.\d*)?(?:[eE][+-]?\d+)?)(?:\^?(-?\d+))?"
)
EXAMPLES = "deg, rev, rpm, deg/s, mm, ms, us, N m, mN m, kN, kg cm, lb in, mA, A, rev/8192"
"""Units that a message names."""

_MOTION = {"q": 0, "qc": 0, "qd": 1, "qdd": 2}  # times that time is divided by


@dataclass(frozen=True)
class Unit:
    """A unit: SI value = factor * (value + zero).

    Attributes:
        text: as it was written.
        factor: to SI.
        powers: of the SI units that it is made of.
        zero: of a scale of temperature, whose SI value is in degrees Celsius; else 0.
    """

    text: str
    factor: float
    powers: Powers
    zero: float = 0.0

    @property
    def kind(self) -> str:
        """What it measures, in words."""
        if self.powers in _KINDS:
            return _KINDS[self.powers]
        return "a " + " ".join(
            name if power == 1 else f"{name}^{power}"
            for name, power in zip(("m", "kg", "s", "rad", "A", "K"), self.powers, strict=True)
            if power
        )

    def as_quantity(self, powers: Powers) -> "Unit | None":
        """The unit as one of that quantity; None if it measures something else.

        A kg or lb where a force is due means its weight.
        """
        if self.powers == powers:
            return self
        weighed = (self.powers[0] + 1, self.powers[1], self.powers[2] - 2, *self.powers[3:])
        if self.powers[1] == 1 and weighed == powers:
            return Unit(self.text, self.factor * GRAVITY, powers)
        return None


def _unit(factor: float, powers: Powers, zero: float = 0.0) -> Unit:
    return Unit("", factor, powers, zero)


_TABLE: Mapping[str, Unit] = MappingProxyType({
    "m": _unit(1.0, LENGTH), "in": _unit(_INCH, LENGTH), "inch": _unit(_INCH, LENGTH),
    "ft": _unit(12.0 * _INCH, LENGTH),
    "g": _unit(1e-3, MASS), "lb": _unit(_POUND, MASS), "oz": _unit(_POUND / 16.0, MASS),
    "s": _unit(1.0, TIME), "sec": _unit(1.0, TIME), "min": _unit(60.0, TIME),
    "h": _unit(3600.0, TIME), "Hz": _unit(1.0, (0, 0, -1, 0, 0, 0)),
    "rad": _unit(1.0, ANGLE), "deg": _unit(math.pi / 180.0, ANGLE),
    "°": _unit(math.pi / 180.0, ANGLE),
    "rev": _unit(2.0 * math.pi, ANGLE), "turn": _unit(2.0 * math.pi, ANGLE),
    "arcmin": _unit(math.pi / 10800.0, ANGLE), "arcsec": _unit(math.pi / 648000.0, ANGLE),
    "rpm": _unit(math.pi / 30.0, (0, 0, -1, 1, 0, 0)),
    "A": _unit(1.0, CURRENT), "V": _unit(1.0, VOLTAGE),
    "N": _unit(1.0, FORCE), "Nm": _unit(1.0, TORQUE), "kgf": _unit(GRAVITY, FORCE),
    "kp": _unit(GRAVITY, FORCE), "lbf": _unit(_POUND * GRAVITY, FORCE),
    "ozf": _unit(_POUND / 16.0 * GRAVITY, FORCE),
    "degC": _unit(1.0, HEAT), "°C": _unit(1.0, HEAT), "K": _unit(1.0, HEAT, -273.15),
    "degF": _unit(5.0 / 9.0, HEAT, -32.0), "°F": _unit(5.0 / 9.0, HEAT, -32.0),
    "percent": _unit(0.01, NONE), "%": _unit(0.01, NONE),
})  # fmt: skip


def unit_named(text: str) -> Unit:
    """The unit of that text: names with products, quotients and powers, `deg/s^2`, `rev/8192`.

    Raises:
        DataError: a name that is unknown; says which units there are.
    """
    unit = find_unit(text)
    if unit is None:
        raise DataError(f'got unit "{text}"; expected a unit such as {EXAMPLES}')
    return unit


def find_unit(text: str) -> Unit | None:
    """The same; None if it is no unit."""
    at, factor, powers, zero = 0, 1.0, NONE, 0.0
    text, count = text.strip().replace("²", "^2"), 0
    while at < len(text):
        match = _FACTOR.match(text, at)
        one = None if match is None else _simple(match[2])
        if match is None or one is None or (match[1] and count == 0):
            return None
        if len(match[3] or "") > len("-9") or abs(int(match[3] or 1)) > 9:
            return None
        power = int(match[3] or 1) * (-1 if match[1] == "/" else 1)
        if abs(power * math.log10(one.factor)) > _DECADES:
            return None
        factor *= one.factor**power
        powers = tuple(a + power * b for a, b in zip(powers, one.powers, strict=True))
        zero = one.zero
        at, count = match.end(), count + 1
    if count == 0 or not 0.0 < factor < math.inf:
        return None
    return Unit(text, factor, powers, zero if count == 1 and powers == HEAT else 0.0)


def _simple(name: str) -> Unit | None:
    """A number, a unit of the table, or one with a prefix."""
    if name[0].isdigit():
        return _unit(float(name), NONE) if float(name) > 0.0 else None
    name = _WORDS.get(name.lower(), name)
    if name in _TABLE:
        return _TABLE[name]
    prefix, rest = name[0], name[1:]
    if prefix in _PREFIXES and rest in _PREFIXED:
        base = _TABLE[rest]
        return _unit(_PREFIXES[prefix] * base.factor, base.powers)
    return None


def si_unit(own: str, where: str, unit: Unit, joints: Sequence[JointSpec]) -> Unit:
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
            f'{where}: got unit "{unit.text}", which is {unit.kind}; {own} is {what}: '
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
