"""Springs, loads, gravity: what acts on the links."""

from modeler.effects.effect import Acts, Effect, Needs, Shape
from modeler.effects.writing import column, form

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
