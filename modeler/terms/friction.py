"""Coulomb friction of motors that turn with several joints: a printed term and virtual work."""

from dataclasses import dataclass
from fractions import Fraction

from modeler.terms.printed import Coupling


@dataclass(frozen=True)
class FrictionCheck:
    """Coulomb friction of coupled motors at one motion, joint side.

    Attributes:
        printed: (joints,) G_ii C_i sign(qd_i), N m.
        derived: (joints,) (G^T C sign(G qd))_i, N m.
        printed_power: qd' printed, W.
        dissipated: sum C_i |motor speed_i|, W: what friction must take.
        derived_power: qd' derived, W.
    """

    printed: tuple[Fraction, ...]
    derived: tuple[Fraction, ...]
    printed_power: Fraction
    dissipated: Fraction
    derived_power: Fraction


def check_friction(coupling: Coupling) -> FrictionCheck:
    """The printed friction term and the one that follows from virtual work, at one motion."""
    G, C, qd = coupling.motor_from_joint, coupling.coulomb, coupling.speed
    motor = [sum((g * v for g, v in zip(row, qd, strict=True)), Fraction(0)) for row in G]
    force = [c * _sign(v) for c, v in zip(C, motor, strict=True)]
    count = range(len(qd))
    printed = tuple(G[i][i] * C[i] * _sign(qd[i]) for i in count)
    derived = tuple(sum((G[j][i] * force[j] for j in count), Fraction(0)) for i in count)
    powers = [
        sum((v * f for v, f in zip(qd, each, strict=True)), Fraction(0))
        for each in (printed, derived)
    ]
    dissipated = sum((c * abs(v) for c, v in zip(C, motor, strict=True)), Fraction(0))
    return FrictionCheck(printed, derived, powers[0], dissipated, powers[1])


def _sign(value: Fraction) -> int:
    return (value > 0) - (value < 0)
