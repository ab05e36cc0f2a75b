"""The effects of every textbook model: rotor inertia, viscous and Coulomb friction, offset."""

import dataclasses

from modeler.core.expression import parse
from modeler.effects.effect import Acts, Effect, EffectColumn, EnergyBlock, Form

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


STANDARD: tuple[Effect, ...] = (
    Effect(
        id="rotor_inertia",
        aliases=("armature",),
        title="inertia of the motor and gear, seen at the joint",
        equation="Ia * qdd",
        forms=(Form((_ROTOR_INERTIA,)),),
        acts=Acts.JOINT,
        family="inertia",
        timing=True,
        signature="residual against acceleration: a straight line through 0",
        shows="a",
        look_alikes="inertia ZZ of the same link; they merge on the first moving joints",
        range="Ia > 0; gear ratio squared times rotor inertia",
        source="Khalil and Dombre 2002, section 9.2.6",
    ),
    Effect(
        id="viscous",
        aliases=("back_emf",),
        title="viscous friction",
        equation="Fv * qd",
        forms=(Form((_VISCOUS,)),),
        acts=Acts.JOINT,
        family="friction",
        signature="residual against velocity: a straight line through 0",
        shows="v",
        look_alikes="back-EMF and eddy currents are the same column",
        range="Fv >= 0",
        source="Khalil and Dombre 2002, section 9.2.5",
    ),
    Effect(
        id="coulomb",
        aliases=("dry_friction",),
        title="Coulomb friction",
        equation="Fs * sign(qd)",
        forms=(Form((_COULOMB,)),),
        acts=Acts.JOINT,
        family="friction",
        signature="residual against velocity: a step at 0",
        shows="v",
        look_alikes="offset, unless the joint moves both ways",
        range="Fs >= 0",
        source="Armstrong-Helouvry, Dupont and Canudas de Wit 1994",
    ),
    Effect(
        id="offset",
        aliases=("asymmetric_coulomb", "torque_bias"),
        title="constant torque offset",
        equation="Off",
        forms=(Form((_OFFSET,)),),
        acts=Acts.JOINT,
        family="measurement",
        signature="residual: a constant bias, the same in both directions",
        shows="v",
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
        forms=(Form((_motor(_ROTOR_INERTIA, "Iam"),)),),
        acts=Acts.MOTOR,
        family="inertia",
        timing=True,
        signature="residual of one joint against the acceleration of the other",
        shows="a",
        look_alikes="link inertia, where the joint axes are parallel; move the joints one by one",
        range="Iam > 0",
        source="Khalil and Dombre 2002, section 9.2.6",
    ),
    Effect(
        id="coupled_friction",
        aliases=(),
        title="friction of a motor that turns with several joints",
        equation="E^T (Fvm (E qd) + Fsm sign(E qd))",
        forms=(Form((_motor(_VISCOUS, "Fvm"), _motor(_COULOMB, "Fsm"))),),
        acts=Acts.MOTOR,
        family="friction",
        signature="residuals of both joints step where the motor speed changes sign",
        shows="v",
        look_alikes="friction of the joints, unless they move separately and together",
        range="Fvm >= 0, Fsm >= 0",
        source="Hanssen, Hovland and Brogardh 2000, eq. (7), with the sign of the motor speed",
    ),
)
