"""Gears, motors and sensors."""

import math

from modeler.effects.effect import Acts, Effect, Memory, Needs, Shape
from modeler.effects.writing import column, form

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
