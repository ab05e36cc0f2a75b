"""Friction beyond viscous and Coulomb."""

from modeler.effects.effect import Acts, Effect, Memory, Needs, Shape
from modeler.effects.writing import column, form

_STRIBECK_SPEED = Shape(
    "vs", "speed", (0.01, 0.02, 0.04, 0.08, 0.15), (0.003, 0.4), "speed at which the dip has faded"
)
_STRIBECK_POWER = Shape("d", "number", (1.0, 2.0), (0.0, 0.0), "how sharply it fades")
_POWER = Shape("p", "number", (0.33, 0.5, 0.7, 1.5, 2.0, 3.0), (0.2, 4.0), "power of the speed")
_SHARE = Shape(
    "w", "number", (0.0, 1.0), (0.0, 1.0), "0: load of gravity alone; 1: of gravity and inertia"
)
_SLIP = Shape(
    "d",
    "travel",
    (0.0005, 0.002, 0.006, 0.02),
    (0.0001, 0.06),
    "travel over which the friction turns",
)
_WIDE_SLIP = Shape("d", "travel", (0.08, 0.16, 0.32), (0.06, 1.0), "travel over which it turns")
_WARM_UP = Shape(
    "tau", "seconds", (60.0, 150.0, 400.0, 1000.0, 3000.0), (60.0, 1e4), "warm-up time"
)

FRICTION: tuple[Effect, ...] = (
    Effect(
        id="asymmetric_viscous",
        aliases=(),
        title="viscous friction that differs between the directions",
        equation="Fva * |qd|; Fv+ = Fv + Fva, Fv- = Fv - Fva",
        forms=(form(column("Fva", "abs(v)", "speed")),),
        acts=Acts.JOINT,
        family="friction",
        signature="residual against velocity: a V",
        shows="v",
        look_alikes="offset; move fast both ways, at several speeds",
        range="|Fva| <= Fv: both slopes positive",
        source="Janot, Gautier and Brunot 2019 (EMPS)",
    ),
    Effect(
        id="stribeck",
        aliases=("stiction",),
        title="friction that rises towards standstill (Stribeck)",
        equation="Fst * exp(-(|qd|/vs)^d) * sign(qd)",
        forms=(
            form(
                column("Fst", "exp(-(abs(v)/vs)**d)*sign(v)", "torque"),
                shapes=(_STRIBECK_SPEED, _STRIBECK_POWER),
            ),
        ),
        acts=Acts.JOINT,
        family="friction",
        signature="residual against velocity: a bump at low speed, odd in the speed",
        shows="v",
        look_alikes="presliding, friction with a power below 1; move slowly at several constant "
        "speeds of 0.2 to 3 vs",
        range="Fst >= 0 and below the Coulomb friction; vs 0.005 to 0.3 rad/s; a negative Fst is "
        "friction that has not yet built up near standstill, or that vibration smooths",
        negative="dry friction has not yet built up near standstill, or vibration smooths it",
        source="Bo and Pavelescu 1982; Armstrong-Helouvry, Dupont and Canudas de Wit 1994",
    ),
    Effect(
        id="nonlinear_viscous",
        aliases=("power_friction", "sublinear_friction"),
        title="friction that is curved in the speed",
        equation="Fp * |qd|^p * sign(qd)",
        forms=(form(column("Fp", "abs(v)**p*sign(v)", "torque"), shapes=(_POWER,)),),
        acts=Acts.JOINT,
        family="friction",
        signature="residual against velocity: an odd curve",
        shows="v",
        look_alikes="Stribeck, for p below 1 and without slow motion; move at five speeds or more",
        range="the whole friction stays positive; p 0.3 to 3",
        source="Waiboer, Aarts and Jonker 2005",
    ),
    Effect(
        id="load_friction",
        aliases=("load_dependent_friction",),
        title="friction that grows with the load on the gear",
        equation="mu * |load| * sign(qd)",
        forms=(
            form(
                column(
                    "mu",
                    "abs(static + w*(load - static))*sign(v)",
                    "ratio",
                    nonnegative=True,
                    largest=0.5,
                ),
                shapes=(_SHARE,),
            ),
        ),
        acts=Acts.JOINT,
        family="friction",
        signature="residual times sign(qd) against |load|: a straight line",
        shows="load",
        look_alikes="friction that depends on position; pass the same poses with another load, or "
        "move other joints meanwhile",
        range="mu 0.01 to 0.15, not negative; half the load is no friction of a gear",
        source="Bittencourt and Gunnarsson 2012; Hamon, Gautier and Garrec 2010",
    ),
    Effect(
        id="position_friction",
        aliases=(),
        title="friction that depends on the position",
        equation="sign(qd) * (Fpc cos q + Fps sin q)",
        forms=(
            form(
                column("Fpc", "cos(k*q)*sign(v)", "torque"),
                column("Fps", "sin(k*q)*sign(v)", "torque"),
                shapes=(
                    Shape("k", "turn", (1.0,), (0.0, 0.0), "waves per turn, or 2 pi per stroke"),
                ),
            ),
        ),
        acts=Acts.JOINT,
        family="friction",
        signature="residual times sign(qd) against position: a wave",
        shows="q",
        look_alikes="friction that depends on the load, where gravity is a function of the same "
        "angle; make full strokes both ways under several loads",
        range="the whole Coulomb friction stays positive",
        source="Armstrong-Helouvry 1991, Control of Machines with Friction",
    ),
    Effect(
        id="presliding",
        aliases=("dahl", "lugre"),
        title="friction that turns gradually after a reversal (presliding)",
        equation="Fz * (z - sign(qd)), z' = (qd/d)(1 - z sign(qd))",
        forms=(
            form(
                column("Fz", "z - sign(v)", "torque", nonnegative=True),
                shapes=(_SLIP,),
                memory=Memory("slip", "d"),
            ),
        ),
        acts=Acts.JOINT,
        family="friction",
        signature="residual against the travel since the last reversal: fades exponentially",
        shows="travel",
        look_alikes="Stribeck, backlash; make many small reversals, slowly",
        needs=(Needs.FRICTION,),
        range="0 < Fz <= Fs; d 1e-4 to 2e-2 rad",
        source="Dahl 1968; Canudas de Wit, Olsson, Astrom and Lischinsky 1995 (LuGre)",
    ),
    Effect(
        id="cable_hysteresis",
        aliases=("hose_hysteresis",),
        title="hysteresis of cables and hoses",
        equation="Fh * z, z' = (qd/d)(1 - z sign(qd)), d of a good part of the stroke",
        forms=(
            form(
                column("Fh", "z", "torque", nonnegative=True),
                shapes=(_WIDE_SLIP,),
                memory=Memory("slip", "d"),
            ),
        ),
        acts=Acts.JOINT,
        family="friction",
        signature="residual against position: a fat loop whose width depends on the stroke",
        shows="travel",
        look_alikes="Coulomb friction with a spring; make strokes of several lengths",
        range="Fh >= 0, 1 to 10 % of rated torque; d 0.05 to 0.5 rad",
        source="Bouc 1967, Wen 1976; Dahl 1968",
    ),
    Effect(
        id="temperature_friction",
        aliases=("thermal_friction",),
        title="friction that changes with temperature",
        equation="(Fvt qd + Fct sign(qd)) (T - mean T); without a sensor exp(-t/tau) for T",
        forms=(
            form(
                column("Fvt", "T*v", "heat_speed"),
                column("Fct", "T*sign(v)", "heat"),
            ),
            form(
                column("Fvw", "exp(-t/tau)*v", "speed"),
                column("Fcw", "exp(-t/tau)*sign(v)", "torque"),
                shapes=(_WARM_UP,),
            ),
        ),
        acts=Acts.JOINT,
        family="friction",
        signature="residual times sign(qd) against temperature, or against time since the start",
        shows="T",
        look_alikes="drift; log a temperature, start cold and run warm",
        range="viscous friction falls with temperature in the range of greases",
        source="Bittencourt, Wernholt, Sander-Tavallaey and Brogardh 2010; Simoni et al. 2019",
    ),
    Effect(
        id="passive_friction",
        aliases=(),
        title="friction in joints without motor (parallel robots)",
        equation="G_p^T (Fv qd_p + Fs sign(qd_p)), qd_p = G_p qd",
        forms=(
            form(
                column("Fvp", "v", "speed", nonnegative=True),
                column("Fsp", "sign(v)", "torque", nonnegative=True),
            ),
        ),
        acts=Acts.PASSIVE,
        family="friction",
        signature="residuals of all motors against the speed of the passive joint",
        shows="itself",
        look_alikes="friction of the motors; move through poses where passive joints turn much "
        "faster than motors, and slower",
        range="Fv >= 0, Fs >= 0",
        source="Khalil and Ibrahim 2007; Briot and Gautier 2012",
    ),
)
