"""What the base stage hands on: the minimal parameters, as exact symbolic statements."""

from collections.abc import Mapping
from dataclasses import dataclass

import sympy

from modeler.core.brief import ShortRepr
from modeler.derivation.columns import StandardColumn


@dataclass(frozen=True)
class Term:
    """coefficient * parameter of a base parameter; the coefficient is exact."""

    coefficient: sympy.Expr
    parameter: str


@dataclass(frozen=True)
class BaseParameter(ShortRepr):
    """One base parameter: name = sum of terms; its regressor column is that of `column`.

    The first term is the parameter itself with coefficient 1. A parameter into which others group
    ends in R. Where `halves`, 1/2 is printed as 0.5: so the robot file writes its numbers.
    """

    name: str
    column: int  # index among the standard columns
    terms: tuple[Term, ...]
    halves: bool = False


@dataclass(frozen=True)
class Sampling:
    """The closed postures at which the torques of a robot with loops were sampled.

    Attributes:
        postures: their number.
        ranges: (lowest, highest) position of each actuated joint, rad or m, by name.
        distance: to the nearest singularity: least singular value of the loops' Jacobian by the
            passive joints, rows of usual length 1, travels in sizes of the robot.
    """

    postures: int
    ranges: Mapping[str, tuple[float, float]]
    distance: float


@dataclass(frozen=True)
class ModularRank:
    """Independence proven modulo a prime: a minor that is not 0 there is not 0.

    Attributes:
        rank: of the energy rows of the base columns.
        prime: modulus.
        points: random states and geometries, over all checks of the relations.
        seed: of these.
    """

    rank: int
    prime: int
    points: int
    seed: int


@dataclass(frozen=True)
class ExactState:
    """A state of a ball certificate: doubles that are meant to the last digit.

    Attributes:
        positions: of all free joints, rad or m, by name. With loops those of the actuated joints
            are exact; the passive ones are near to the posture that is meant.
        speeds: of the actuated joints, rad/s or m/s.
        accelerations: of the actuated joints, rad/s2 or m/s2.
        signals: what effects read besides the motion.
    """

    positions: Mapping[str, float]
    speeds: Mapping[str, float]
    accelerations: Mapping[str, float]
    signals: tuple[float, ...] = ()


@dataclass(frozen=True)
class BallRank(ShortRepr):
    """Independence proven in ball arithmetic: a minor of the torques whose ball excludes 0.

    Attributes:
        rank: of the torques of the base columns.
        bits: precision of the balls.
        seed: of the states.
        states: at which the rows are taken.
        rows: (number of the state, actuated joint) of every row of the minor.
    """

    rank: int
    bits: int
    seed: int
    states: tuple[ExactState, ...]
    rows: tuple[tuple[int, str], ...]


@dataclass(frozen=True)
class SampledRank:
    """Independence seen at random states in floating point, not proven.

    Attributes:
        rank: of the torques in floating point.
        seed: of the states.
        why: what a proof lacks.
    """

    rank: int
    seed: int
    why: str


Certificate = ModularRank | BallRank | SampledRank
"""Why the base columns are independent."""


@dataclass(frozen=True)
class Proof(ShortRepr):
    """Why the base parameters are right, and what anyone needs to check it again.

    Attributes:
        kind: "exact" if relations and independence are both proved.
        statement: the argument in one or two sentences.
        certificate: of the independence.
        seed: of all random states.
        numeric_rank: rank of the torque regressor in floating point at the nominal geometry.
        gap: (last kept, first dropped) singular value, columns scaled to unit length; the second is
            0.0 if nothing was dropped.
        tolerance: singular values above tolerance * largest are kept.
        scale: how rows and columns were scaled before.
        agreement: largest relative difference of standard and base torque at random states.
        sampling: how far the postures of the numeric rank went; None without loops.
    """

    kind: str
    statement: str
    certificate: Certificate
    seed: int
    numeric_rank: int
    gap: tuple[float, float]
    tolerance: float
    scale: str
    agreement: float
    sampling: Sampling | None = None


@dataclass(frozen=True)
class BaseParameters(ShortRepr):
    """The base parameters of a robot.

    Attributes:
        columns: all standard columns, in order.
        parameters: base parameters, in column order.
        unidentifiable: standard parameters without any effect on the torques.
        proof: certificate.
    """

    columns: tuple[StandardColumn, ...]
    parameters: tuple[BaseParameter, ...]
    unidentifiable: tuple[str, ...]
    proof: Proof

    @property
    def rank(self) -> int:
        """Returns number of base parameters."""
        return len(self.parameters)

    def count_by_kind(self) -> Mapping[str, int]:
        """Counts base parameters by the kind of the standard parameter of their column."""
        counts = dict.fromkeys(("inertial", "rotor_inertia", "friction", "offset"), 0)
        for parameter in self.parameters:
            kind = self.columns[parameter.column].kind
            counts[kind] = counts.get(kind, 0) + 1
        return counts
