"""One row of a modified Denavit-Hartenberg table."""

import enum
from dataclasses import dataclass

from modeler.core.brief import Brief
from modeler.core.expression import Expression


class JointKind(enum.IntEnum):
    """sigma of the table."""

    REVOLUTE = 0
    PRISMATIC = 1
    FIXED = 2


@dataclass(frozen=True)
class Joint(Brief):
    """Frame j on link j, placed from its antecedent frame a(j).

    T(a -> j) = Rz(gamma) Tz(b) Rx(alpha) Tx(d) Rz(theta) Tz(r) (Khalil and Kleinfinger 1986);
    the joint axis is z_j. Lengths in m, angles in rad.

    Attributes:
        name: row name; q<name> is its variable, in `theta` (revolute) or `r` (prismatic).
        antecedent: name of the antecedent row, "0" for the base.
        actuated: mu = 1.
    """

    name: str
    antecedent: str
    actuated: bool
    kind: JointKind
    gamma: Expression
    b: Expression
    alpha: Expression
    d: Expression
    theta: Expression
    r: Expression

    @property
    def variable(self) -> str:
        """Name of the joint variable."""
        return f"q{self.name}"

    @property
    def moves(self) -> bool:
        """False for a frame fixed on its antecedent (sigma = 2), which carries no link."""
        return self.kind is not JointKind.FIXED

    @property
    def angular(self) -> bool:
        """True for a revolute joint."""
        return self.kind is JointKind.REVOLUTE

    @property
    def unit(self) -> str:
        """Unit of the joint variable."""
        return "rad" if self.angular else "m"

    @property
    def effort_unit(self) -> str:
        """Unit of the joint torque or force."""
        return "N m" if self.angular else "N"
