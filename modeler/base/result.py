"""What the base stage hands on: the minimal parameters, as exact symbolic statements."""

from collections.abc import Mapping
from dataclasses import dataclass

import sympy

from modeler.symbolic import StandardColumn


@dataclass(frozen=True)
class Term:
    """coefficient * parameter of a base parameter; the coefficient is exact."""

    coefficient: sympy.Expr
    parameter: str


@dataclass(frozen=True)
class BaseParameter:
    """One base parameter: name = sum of terms; its regressor column is that of `column`.

    The first term is the parameter itself with coefficient 1. A parameter into which others group
    ends in R.
    """

    name: str
    column: int  # index among the standard columns
    terms: tuple[Term, ...]


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
class Proof:
    """Why the base parameters are right, and what anyone needs to check it again.

    Attributes:
        kind: "exact" if relations and independence are both proved.
        statement: the argument in one or two sentences.
        prime: modulus of the certificate.
        points: number of random states of the certificate.
        seed: of all random states.
        exact_rank: rank of the energy rows modulo the prime at generic geometry.
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
    prime: int
    points: int
    seed: int
    exact_rank: int
    numeric_rank: int
    gap: tuple[float, float]
    tolerance: float
    scale: str
    agreement: float
    sampling: Sampling | None = None


@dataclass(frozen=True)
class BaseParameters:
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
        """Number of base parameters."""
        return len(self.parameters)

    def counts(self) -> Mapping[str, int]:
        """Base parameters by the kind of the standard parameter whose column they are."""
        found = dict.fromkeys(("inertial", "rotor_inertia", "friction", "offset"), 0)
        for parameter in self.parameters:
            kind = self.columns[parameter.column].kind
            found[kind] = found.get(kind, 0) + 1
        return found
