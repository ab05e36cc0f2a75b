"""The effects, in the order in which their parameters stand after the link's own."""

import dataclasses

from modeler.core.expression import parse
from modeler.effects.effect import Effect, EffectColumn, EnergyBlock

_ROTOR_INERTIA = EffectColumn(
    "Ia", parse("a"), "kg m2", "kg", "rotor_inertia", EnergyBlock.KINETIC, True
)
_VISCOUS = EffectColumn(
    "Fv", parse("v"), "N m s/rad", "N s/m", "friction", EnergyBlock.RAYLEIGH, True
)
_COULOMB = EffectColumn("Fs", parse("sign(v)"), "N m", "N", "friction", EnergyBlock.COULOMB, True)
_OFFSET = EffectColumn("Off", parse("1"), "N m", "N", "offset", EnergyBlock.POWER, False)


def _motor(column: EffectColumn, prefix: str) -> EffectColumn:
    return dataclasses.replace(column, prefix=prefix)


CATALOGUE: tuple[Effect, ...] = (
    Effect(
        id="rotor_inertia",
        aliases=("armature",),
        title="inertia of the motor and gear, seen at the joint",
        equation="Ia * qdd",
        columns=(_ROTOR_INERTIA,),
        coupled=False,
        signature="residual against acceleration: a straight line through 0",
        look_alikes="inertia ZZ of the same link; they merge on the first moving joints",
        range="Ia > 0; gear ratio squared times rotor inertia",
        source="Khalil and Dombre 2002, section 9.2.6",
    ),
    Effect(
        id="viscous",
        aliases=("back_emf",),
        title="viscous friction",
        equation="Fv * qd",
        columns=(_VISCOUS,),
        coupled=False,
        signature="residual against velocity: a straight line through 0",
        look_alikes="back-EMF and eddy currents are the same column",
        range="Fv >= 0",
        source="Khalil and Dombre 2002, section 9.2.5",
    ),
    Effect(
        id="coulomb",
        aliases=("dry_friction",),
        title="Coulomb friction",
        equation="Fs * sign(qd)",
        columns=(_COULOMB,),
        coupled=False,
        signature="residual against velocity: a step at 0",
        look_alikes="offset, unless the joint moves both ways",
        range="Fs >= 0",
        source="Armstrong-Helouvry, Dupont and Canudas de Wit 1994",
    ),
    Effect(
        id="offset",
        aliases=("asymmetric_coulomb", "torque_bias"),
        title="constant torque offset",
        equation="Off",
        columns=(_OFFSET,),
        coupled=False,
        signature="residual: a constant bias, the same in both directions",
        look_alikes="asymmetric Coulomb friction and sensor bias are the same column; "
        "gravity, unless the joint moves over a wide range",
        range="either sign, a few percent of rated torque",
        source="Guegan, Khalil and Lemoine 2003, section 4",
    ),
    Effect(
        id="coupled_inertia",
        aliases=(),
        title="rotor inertia of a motor that turns with several joints",
        equation="E^T Iam (E qdd)",
        columns=(_motor(_ROTOR_INERTIA, "Iam"),),
        coupled=True,
        signature="residual of one joint against the acceleration of the other",
        look_alikes="link inertia, where the joint axes are parallel",
        range="Iam > 0",
        source="Khalil and Dombre 2002, section 9.2.6",
    ),
    Effect(
        id="coupled_friction",
        aliases=(),
        title="friction of a motor that turns with several joints",
        equation="E^T (Fvm (E qd) + Fsm sign(E qd))",
        columns=(_motor(_VISCOUS, "Fvm"), _motor(_COULOMB, "Fsm")),
        coupled=True,
        signature="residuals of both joints step where the motor speed changes sign",
        look_alikes="friction of the joints, unless they move separately and together",
        range="Fvm >= 0, Fsm >= 0",
        source="Hanssen, Hovland and Brogardh 2000, eq. (7), with the sign of the motor speed",
    ),
)


def effect_named(name: str) -> Effect | None:
    """The effect with that id or alias; None if there is none."""
    return next((e for e in CATALOGUE if name == e.id or name in e.aliases), None)
