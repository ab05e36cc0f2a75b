"""The catalogue of physical effects, each defined once; friction first."""

import dataclasses
import math
from collections.abc import Sequence

from modeler.core.expression import parse
from modeler.effects.effect import (
    Acts,
    Effect,
    EffectColumn,
    EnergyBlock,
    Form,
    Memory,
    Needs,
    Shape,
    column,
    form,
)

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


# Gears, motors and sensors.


_FREQUENCY = Shape(
    "f",
    "hertz",
    (3.0, 4.0, 5.0, 6.5, 8.0, 10.0, 12.5, 16.0, 20.0, 27.0, 40.0),
    (1.5, 60.0),
    "natural frequency, motor locked",
)
_MISREAD = 0.2  # rad or m: what an encoder that still controls its joint may be off
_DAMPING = Shape("zeta", "number", (0.2,), (0.01, 0.8), "damping ratio of the resonance")
_GAP = Shape("t0", "load", (0.03, 0.1), (0.0, 0.0), "load over which the gap closes")
_ORDER = Shape(
    "m", "waves", (), (0.0, 0.0), "waves per turn of the joint (rad), or waves per 2 pi m"
)
_MOTOR = 70.0  # waves per turn from which on it is the motor: teeth and rollers are fewer
_RIPPLE = (("c", "cos(m*q)"), ("s", "sin(m*q)"))

TRANSMISSION: tuple[Effect, ...] = (
    Effect(
        id="elasticity",
        aliases=("flexible_joint", "flexibility"),
        title="the gear gives way (elastic joint)",
        equation="links at q - C z, z the load through the resonance at f; C = 1/K",
        forms=(
            form(
                column("Cj", "-z", "compliance", "other", nonnegative=True),
                shapes=(_FREQUENCY, _DAMPING),
                memory=Memory("resonance", "f", "zeta"),
            ),
        ),
        acts=Acts.POSITION,
        family="transmission",
        timing=True,
        signature="residual spectrum: an anti-resonance and a resonance; residual against jerk",
        shows="itself",
        look_alikes="delay, rotor inertia; move fast, or sweep the frequency",
        needs=(Needs.INERTIA,),
        hindrance="the joint needs a second mass: identify its stiffness by simulation, or move "
        "slower than its resonance",
        range="K = 1/C 1e3 to 1e6 N m/rad, and about inertia times (2 pi f)^2",
        source="Spong 1987; Jubien, Gautier and Janot 2014",
    ),
    Effect(
        id="backlash",
        aliases=("play",),
        title="play in the gear",
        equation="links at q - (gap/2) sign(load), free travel between",
        forms=(form(column("gap", "-0.5*tanh(load/t0)", "angle", "other", True), shapes=(_GAP,)),),
        acts=Acts.POSITION,
        family="transmission",
        signature="bursts of the residual within 0.1 s after the load (not the speed) changes sign",
        shows="load",
        look_alikes="presliding, which bursts where the speed changes sign; pass the pose of zero "
        "load slowly and fast",
        knocks=True,
        hindrance="play has no smooth torque: mend the gear, or keep the load from changing sign",
        range="gap 0.1 to 5 mrad",
        source="Nordin and Gutman 2002",
    ),
    Effect(
        id="motor_ripple",
        aliases=("cogging",),
        title="ripple of the motor (cogging), or of its wave generator",
        equation="Rc cos(m q) + Rs sin(m q), m = n times the gear ratio",
        forms=(
            form(
                *(column(f"Rm{x}", text, "torque", "other") for x, text in _RIPPLE),
                shapes=(_ORDER,),
            ),
        ),
        acts=Acts.JOINT,
        family="transmission",
        same_as=("joint_ripple",),
        several=True,
        orders=(_MOTOR, math.inf),
        signature="order spectrum: a line at n times the gear ratio per turn",
        shows="waves",
        look_alikes="gear mesh at the joint, unless the gear ratio is known; move slowly, far",
        range="0.5 to 5 % of rated torque",
        source="Tuttle and Seering 1996",
    ),
    Effect(
        id="joint_ripple",
        aliases=("gear_mesh", "bearing_ripple"),
        title="ripple of gear teeth or bearings at the joint",
        equation="Rc cos(m q) + Rs sin(m q), m teeth or rollers",
        forms=(
            form(
                *(column(f"Rj{x}", text, "torque", "other") for x, text in _RIPPLE),
                shapes=(_ORDER,),
            ),
        ),
        acts=Acts.JOINT,
        family="transmission",
        same_as=("motor_ripple",),
        several=True,
        orders=(0.0, _MOTOR),
        signature="order spectrum: a line at m per turn",
        shows="waves",
        look_alikes="ripple of the motor, unless the gear ratio is known; gravity, for low m",
        range="0.2 to 3 % of rated torque",
        source="Tuttle and Seering 1996",
    ),
    Effect(
        id="encoder_eccentricity",
        aliases=(),
        title="the encoder disc runs out of centre",
        equation="links at q + Ec cos(k q) + Es sin(k q), k = 1, or the gear ratio",
        forms=(
            form(
                column("Ec", "cos(k*q)", "angle", "other", largest=_MISREAD),
                column("Es", "sin(k*q)", "angle", "other", largest=_MISREAD),
                shapes=(
                    Shape("k", "waves", (1.0,), (0.0, 0.0), "waves per turn: 1, or the gear ratio"),
                ),
            ),
        ),
        acts=Acts.POSITION,
        family="measurement",
        signature="waves per turn that grow with the square of the speed, and with gravity",
        shows="itself",
        look_alikes="first moment of the link; move fast at many poses",
        turns=True,
        whole_axis=True,
        orders=(0.0, math.inf),
        range="below 1 mrad to some mrad",
        source="Hanselman 1990",
    ),
    Effect(
        id="encoder_offset",
        aliases=("calibration_offset",),
        title="the zero of the encoder is off",
        equation="links at q - dq",
        forms=(form(column("dq", "-1", "angle", "other", largest=_MISREAD)),),
        acts=Acts.POSITION,
        family="measurement",
        signature="residuals shaped like the derivative of gravity, on joints beyond it too",
        shows="itself",
        look_alikes="last link's first moment on the last joint; a vertical first joint never "
        "shows it",
        whole_axis=True,
        range="below 5 degrees",
        source="Khalil and Dombre 2002, section 11.2",
    ),
    Effect(
        id="time_delay",
        aliases=("channel_delay",),
        title="torque and position are not of the same time",
        equation="tau(t) = model(q(t + dt)) = ... + dt d tau/dt",
        forms=(form(column("dt", "rate", "seconds", "other")),),
        acts=Acts.TORQUE,
        family="measurement",
        timing=True,
        signature="residual against d tau/dt: a line; correlation of the two peaks beside 0",
        shows="rate",
        look_alikes="elasticity, friction at reversals; move fast",
        range="below 10 ms; less than half a sample is a convention of the logger",
        source="Janot, Gautier and Brunot 2019; Brunot et al. 2018",
    ),
    Effect(
        id="drive_gain",
        aliases=("torque_constant",),
        title="the drive gain is wrong",
        equation="-eps * torque; true gain = gain / (1 - eps)",
        forms=(form(column("eps", "-torque", "ratio", "other")),),
        acts=Acts.JOINT,
        family="measurement",
        signature="residual against the predicted torque: a line",
        shows="torque",
        look_alikes="the joint's own parameters all scaled; needs other joints that share them, or "
        "a known load",
        needs=(Needs.GAIN,),
        range="mostly below 30 %, up to tenfold; beside the gains of the other joints",
        source="Gautier and Briot 2011, 2014",
    ),
    Effect(
        id="drift",
        aliases=("sensor_drift",),
        title="torque that drifts with time",
        equation="Dr * t",
        forms=(form(column("Dr", "t", "time", "other")),),
        acts=Acts.JOINT,
        family="measurement",
        signature="residual against time: a slope",
        shows="t",
        look_alikes="friction that warms up, which changes sign with the speed; record longer",
        range="a few percent of rated torque",
        source="manuals of torque sensors",
    ),
)


# Springs, loads, gravity: what acts on the links.


_LEVER = Shape("b", "number", (0.2, 0.4, 0.6, 0.8), (0.1, 0.9), "lever over distance of the anchor")
_MOUNT = Shape(
    "q0",
    "angle",
    tuple(0.39269908169872414 * k for k in range(16)),
    (-10.0, 10.0),
    "where it is in line",
)
_MOMENT = Shape(
    "m", "moment", (1.0,), (0.0, 0.0), "0 where the link's first moment has the part without lever"
)
_REST = Shape("q0", "place", (-1.0, -0.4, 0.0, 0.4, 1.0), (-2.0, 2.0), "rest position")
_HARDENING = Shape("h", "bend", (0.0, 0.1, 0.4), (0.0, 3.0), "how much stiffer, per square travel")
_LEVER_FORCE = "sin(q - q0)/sqrt(1 + b**2 - 2*b*cos(q - q0))"

BODIES: tuple[Effect, ...] = (
    Effect(
        id="spring",
        aliases=("cable_drag",),
        title="spring at the joint (cable drag)",
        equation="Ks * (q - q0) * (1 + h * (q - q0)^2)",
        forms=(
            form(
                column("Ks", "(q - q0)*(1 + h*(q - q0)**2)", "position", "other"),
                shapes=(_REST, _HARDENING),
            ),
        ),
        acts=Acts.JOINT,
        family="load",
        signature="residual against position: a line, the same at every speed",
        shows="q",
        look_alikes="gravity and offset, unless the joint moves over more than 2 rad",
        range="Ks >= 0 for a spring, either sign for cables; h >= 0: springs "
        "harden, and what softens like a sine hangs on a lever",
        source="Wang et al. 2019 (da Vinci arms)",
        rarely_negative=True,
        needs=(Needs.REST,),
    ),
    Effect(
        id="counterbalance",
        aliases=("balancer",),
        title="helical spring with a lever that balances gravity",
        equation="Kbs sin(q-q0) + Kbl sin(q-q0) / sqrt(1 + b^2 - 2 b cos(q-q0))",
        forms=(
            form(
                column("Kbs", "m*sin(q - q0)", "torque", "other"),
                column("Kbl", _LEVER_FORCE, "torque", "other"),
                shapes=(_LEVER, _MOUNT, _MOMENT),
            ),
        ),
        acts=Acts.JOINT,
        family="load",
        same_as=("constant_force_spring",),
        twin="constant_force_spring",
        needs=(Needs.GRAVITY, Needs.CURVE),
        turns=True,
        signature="residual against position: smooth, usually on the second joint, at every speed",
        shows="q",
        look_alikes="first moment of the link: the part sin(q-q0) is its column; gas springs; use "
        "the whole range of the joint",
        range="pull, 20 to 80 % of gravity at the joint",
        source="Chung and Cho 2015; manuals of balanced industrial arms",
    ),
    Effect(
        id="constant_force_spring",
        aliases=("gas_spring",),
        title="spring of constant force with a lever (gas spring)",
        equation="Kg sin(q-q0) / sqrt(1 + b^2 - 2 b cos(q-q0))",
        forms=(form(column("Kgl", _LEVER_FORCE, "torque", "other"), shapes=(_LEVER, _MOUNT)),),
        acts=Acts.JOINT,
        family="load",
        same_as=("counterbalance",),
        needs=(Needs.GRAVITY, Needs.CURVE),
        turns=True,
        signature="residual against position: smooth, at every speed; drifts with temperature",
        shows="q",
        look_alikes="a helical counterbalance, whose other part is the link's first moment; "
        "compare a cold and a warm run",
        range="force > 0",
        source="manuals of balanced industrial arms",
    ),
    Effect(
        id="payload",
        aliases=("tool",),
        title="a load on the last link",
        equation="W_n chi_load, ten inertial parameters",
        forms=(form(column("load", "1", "ratio", "other")),),
        acts=Acts.LINK,
        family="load",
        signature="residuals of all joints, larger towards the base",
        shows="itself",
        look_alikes="the last link's own parameters: invisible while these are fitted to the same "
        "logs; fit the model without load first",
        range="M > 0, inertia of a real body",
        source="Khalil, Gautier and Lemoine 2007",
        needs=(Needs.MASS,),
        last_link=True,
    ),
    Effect(
        id="link_inertia",
        aliases=("fixture", "link_imbalance"),
        title="a body on another link than the last",
        equation="W_k chi, ten inertial parameters of link k",
        forms=(form(column("body", "1", "ratio", "other")),),
        acts=Acts.LINK,
        family="load",
        signature="like a load, but joints beyond the link do not feel it",
        shows="itself",
        look_alikes="the link's own parameters, while these are fitted to the same logs",
        range="M > 0, inertia of a real body",
        source="Wensing, Kim and Slotine 2018",
        needs=(Needs.MASS,),
        rare=True,
    ),
    Effect(
        id="base_tilt",
        aliases=("gravity_direction",),
        title="the base does not stand level",
        equation="gx G_x + gy G_y, gravity torques for gravity along x and y",
        forms=(form(column("g", "1", "ratio", "other")),),
        acts=Acts.GRAVITY,
        family="load",
        signature="residual of a vertical joint against its own position, larger with the arm out",
        shows="itself",
        look_alikes="a spring or cable on the first joint; turn it with the arm out and in",
        range="up to 10 degrees",
        source="Khalil and Dombre 2002, section 9.3",
    ),
    Effect(
        id="external_force",
        aliases=("contact",),
        title="something pushed on the robot for a while",
        equation="J^T f from t0 to t1",
        forms=(form(column("f", "1", "ratio", "other")),),
        acts=Acts.WINDOW,
        family="load",
        signature="residuals of several joints: one burst in time",
        shows="t",
        look_alikes="none that repeats: play the motion again without contact",
        range="an event, no parameter",
        source="De Luca and Mattone 2005",
        hindrance="a contact is an event, not a parameter: leave its window out of the logs",
    ),
)


# The effects of every textbook model: rotor inertia, viscous and Coulomb friction, offset.

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


# The effects, in the order in which their parameters stand after the link's own.


CATALOGUE: tuple[Effect, ...] = (*STANDARD, *FRICTION, *BODIES, *TRANSMISSION)


ENCODERS = tuple(effect.id for effect in CATALOGUE if effect.whole_axis)
"""What moves the position of the whole axis, motor and links: the encoder shows it wrongly."""

PASSIVE_FRICTION = "passive_friction"
PASSIVE_FRICTION_IS = ("viscous", "coulomb")
"""What friction of a joint without motor is made of: a robot file that names it has these two."""


def effect_named(name: str, among: Sequence[Effect] = CATALOGUE) -> Effect | None:
    """The effect with that id or alias; None if there is none.

    Args:
        name: as in robot files.
        among: the catalogue, or that of a robot with effects of its own (`Robot.catalogue`).
    """
    return next((e for e in among if name == e.id or name in e.aliases), None)
