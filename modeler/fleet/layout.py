"""What of a robot may drift, and what a fleet has in common."""

from dataclasses import dataclass

import numpy as np

from modeler.core.brief import Brief
from modeler.core.contract import ModuleSpec

GAIN, LOAD = "drive_gain", "payload"
"""Ids of the catalogue: what scales the torques of a joint, and what a link carries."""

_LOAD_ORDER = ("M", "MX", "MY", "MZ", "ZZ", "XX", "YY", "XY", "XZ", "YZ")
_SAME = 1e-8  # what is left of a column, as a share of its length, counts as zero


@dataclass(frozen=True)
class Quantity(Brief):
    """What may drift.

    Attributes:
        effect: id of the catalogue.
        joint: name; None for a load.
        parameter: "Fv2"; "gain 2" and "load" are no parameters of the robot file.
        unit: of its value.
        column: base parameter; -1 for a gain or a load.
        place: index of the joint; -1 for a load.
        own: its column enters the torque of its joint only.
    """

    effect: str
    joint: str | None
    parameter: str
    unit: str
    column: int
    place: int
    own: bool = True

    @property
    def whose(self) -> str:
        """In words: "joint 2"."""
        return "the load" if self.joint is None else f"joint {self.joint}"


_LOAD = Quantity(LOAD, None, "load", "kg", -1, -1, own=False)


@dataclass(frozen=True, eq=False)
class Layout:
    """Columns of a fleet's equations; c base parameters, n joints.

    Attributes:
        drifting: friction and offsets, each its base parameter, then one gain per motor.
        common: (c,) True for base parameters that all machines share.
        load: (c, r) change of the base parameters by what the last link carries: mass first, then
            the other inertial parameters of that link that change it otherwise. r = 0 without.
    """

    drifting: tuple[Quantity, ...]
    common: np.ndarray
    load: np.ndarray

    @property
    def quantities(self) -> tuple[Quantity, ...]:
        """All that is looked at: what may drift, and a load if one can be told."""
        return (*self.drifting, _LOAD) if self.load.shape[1] else self.drifting

    @property
    def columns(self) -> list[int]:
        """Base parameters that may drift."""
        return [q.column for q in self.drifting if q.column >= 0]

    @property
    def gains(self) -> list[int]:
        """Joints that have a gain, in the order in which these stand."""
        return [q.place for q in self.drifting if q.effect == GAIN]


def layout_of(spec: ModuleSpec) -> Layout:
    """What may drift of a robot."""
    joints = {joint.name: j for j, joint in enumerate(spec.joints)}
    standard = {parameter.name: parameter for parameter in spec.standard}
    drifting = []
    common = np.ones(len(spec.base), dtype=bool)
    for column, base in enumerate(spec.base):
        if base.kind not in ("friction", "offset"):
            continue
        common[column] = False
        whose = standard[base.column_of]
        place = joints.get(whose.joint, -1)
        drifting.append(
            Quantity(whose.effect, whose.joint, base.name, base.unit, column, place,
                     own=base.rows == (place,))
        )  # fmt: skip
    if common.any():
        drifting += [
            Quantity(GAIN, joint.name, f"gain {joint.name}", "%", -1, j)
            for j, joint in enumerate(spec.joints)
            if joint.actuated
        ]
    return Layout(tuple(drifting), common, _load(spec))


def _load(spec: ModuleSpec) -> np.ndarray:
    """(c, r), independent columns; none if the load's mass changes no base parameter."""
    closure = spec.closure
    link = spec.joints[-1].name if closure is None else closure.carrier or closure.variables[-1]
    kept: list[np.ndarray] = []
    basis = np.zeros((len(spec.base), 0))
    for letters in _LOAD_ORDER:
        column = np.array([
            sum(term.value for term in base.terms if term.parameter == f"{letters}{link}")
            for base in spec.base
        ], dtype=float)  # fmt: skip
        length = float(np.linalg.norm(column))
        if length == 0.0 and letters == "M":
            break
        rest = column / length if length > 0.0 else column
        for _ in range(2):
            rest = rest - basis @ (basis.T @ rest)
        if np.linalg.norm(rest) > _SAME:
            kept.append(column)
            basis = np.column_stack([basis, rest / np.linalg.norm(rest)])
    return np.column_stack(kept) if kept else np.zeros((len(spec.base), 0))
