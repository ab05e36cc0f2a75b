"""Functions of a robot with loops: those of its opened tree, and what closes them around it.

The tree's functions take the free variables u; the public ones take the coordinates q, close the
loops, carry speeds and accelerations over (ud = G qd, udd = G qdd + gamma) and project the result,
tau_q = G^T tau_u.
"""

import dataclasses
from dataclasses import dataclass

from modeler.base.result import BaseParameters
from modeler.codegen.functions import (
    Arguments,
    Function,
    arguments_of,
    beta_symbols,
    entries_of,
    grouping_function,
    reads_more,
    tree_functions,
)
from modeler.core.contract import ArgumentSpec
from modeler.core.errors import EmitError
from modeler.symbolic import Closure, SymbolicModel


@dataclass(frozen=True)
class _Frame:
    """What the wrappers of one set of given variables share.

    Attributes:
        head: start of the functions' names: "" or "platform_".
        loops: C name of the closure.
        given: their arguments; q, qd, qdd are x, xd, xdd for the platform.
        closure: of the robot.
        prefix: of C names.
    """

    head: str
    loops: str
    given: Arguments
    closure: Closure
    prefix: str

    @property
    def sizes(self) -> tuple[int, int, int]:
        """(free variables, given, solved)."""
        return len(self.closure.home), len(self.closure.given), len(self.closure.solved)

    def locals(self, rows: int, speeds: bool) -> list[str]:
        """Declarations of arrays."""
        n, g, m = self.sizes
        moving = f", ud[{n}], udd[{n}]" if speeds else ""
        return [
            f"double u[{n}], G[{n * g}]{moving}, rows[{rows}];",
            f"double work[MODELER_CLOSURE_WORK({n}, {m})];",
        ]

    def closing(self, speeds: bool) -> list[str]:
        """Statements that close the loops and carry the motion over."""
        q, qd, qdd = (a.name for a in (self.given.q, self.given.qd, self.given.qdd))
        follow = (
            f"modeler_follow(&{self.loops}, {self.prefix}_tree_drift, u, {qd}, {qdd}, G, ud, udd, "
            "work)"
            if speeds
            else f"modeler_coupling(&{self.loops}, u, G, work)"
        )
        return [
            f"int status = modeler_close(&{self.loops}, {q}, home, u, work);",
            "",
            "if (status == MODELER_CLOSED)",
            f"    status = {follow};",
        ]

    def wrapped(
        self, call: str, width: int, output: ArgumentSpec, speeds: bool, first: tuple[str, ...] = ()
    ) -> tuple[str, ...]:
        """The body of a function whose rows are projected; `first` are further declarations."""
        n, g, _ = self.sizes
        return (
            *self.locals(n * width, speeds),
            *first,
            *self.closing(speeds),
            "if (status != MODELER_CLOSED) {",
            f"    modeler_nothing({output.name}, {g * width});",
            "    return status;",
            "}",
            f"{self.prefix}_tree_{call};",
            f"modeler_project(&{self.loops}, G, rows, {width}, {output.name});",
            "return MODELER_CLOSED;",
        )


def closed_functions(
    model: SymbolicModel, base: BaseParameters, prefix: str
) -> tuple[Function, ...]:
    """All functions of the module of a robot with loops: internal ones, then the public ones."""
    closure = model.closure
    assert closure is not None
    given = arguments_of(model.robot.coordinates, model, base)
    frame = _Frame("", "loops", given, closure, prefix)
    if model.signals or reads_more(model):
        raise EmitError(
            f"{model.robot.name} has loops, and effects that read more than speeds and "
            "accelerations; these have no C there; leave them out of [effects]"
        )
    public = [
        *_regressors(frame, model, base), *_dynamics(frame, base),
        _inertia_matrix(frame), _kinematics(frame, model), *_postures(frame),
        grouping_function(model, base, given),
    ]  # fmt: skip
    if closure.platform is not None:
        free = model.robot.free
        joints = [free[k] for k in closure.platform]
        names = ", ".join(joint.name for joint in joints)
        x = _renamed(arguments_of(joints, model, base), names)
        platform = _Frame("platform_", "platform_loops", x, closure, prefix)
        public += [
            _regressors(platform, model, base)[1],
            _dynamics(platform, base)[0],
            *_postures(platform),
        ]
    return (*_internal(model, base), *public)


def _renamed(given: Arguments, names: str) -> Arguments:
    meaning = f"of the platform: {names}"
    return dataclasses.replace(
        given,
        q=dataclasses.replace(given.q, name="x", meaning=f"positions {meaning}"),
        qd=dataclasses.replace(given.qd, name="xd", meaning="their velocities"),
        qdd=dataclasses.replace(given.qdd, name="xdd", meaning="their accelerations"),
        tau=dataclasses.replace(given.tau, name="f", meaning="forces and torques along x"),
    )


def _internal(model: SymbolicModel, base: BaseParameters) -> list[Function]:
    """Functions of the opened tree, of u."""
    closure = model.closure
    assert closure is not None
    found = {f.role: f for f in tree_functions(model, base)}
    for role in ("base_regressor_nonzeros", "base_parameters"):
        del found[role]
    given = arguments_of(model.robot.free, model, base)
    beta = beta_symbols(model, base)
    rotors = {
        k: v for k, v in beta.items() if model.columns[k].kind in ("inertial", "rotor_inertia")
    }
    # The passive joints accelerate at qdd = 0 too: rotors on them belong to it.
    found["coriolis"] = Function(
        "", "coriolis", "Torques without gravity and friction.", "M(u) udd + c(u, ud)",
        (given.q, given.qd, given.qdd, given.beta), given.tau,
        entries_of(model.torque(rotors, gravity=False)),
    )  # fmt: skip
    values = [*closure.equations, *(entry for line in closure.jacobian for entry in line)]
    found["closure"] = Function(
        "", "closure", "Closure equations f(u) and their derivatives by u.", "f(u) = 0",
        (given.q,), ArgumentSpec("values", (len(values),), "m or 1", "f, then df/du"),
        entries_of(values),
    )  # fmt: skip
    found["drift"] = Function(
        "", "drift", "d/dt(df/du) ud.", "df/du udd + drift = 0", (given.q, given.qd),
        ArgumentSpec("values", (len(closure.drift),), "m/s2 or 1/s2", "drift"),
        entries_of(closure.drift),
    )  # fmt: skip
    return [dataclasses.replace(f, role=f"tree_{role}", internal=True) for role, f in found.items()]


def _regressors(
    frame: _Frame, model: SymbolicModel, base: BaseParameters
) -> tuple[Function, Function]:
    x, g = frame.given, len(frame.closure.given)
    inputs = (x.q, x.qd, x.qdd)
    found = []
    for role, width, kind in (
        ("regressor", len(model.columns), "standard"),
        ("base_regressor", base.rank, "base"),
    ):
        phi = ArgumentSpec("phi", (g, width), "SI", f"torque per unit of each {kind} parameter")
        found.append(
            Function(
                "_loops",
                frame.head + role,
                f"Regressor of the {kind} parameters.",
                f"{x.tau.name} = phi {'chi' if kind == 'standard' else 'beta'}",
                inputs,
                phi,
                (),
                frame.wrapped(f"{role}(u, ud, udd, rows)", width, phi, speeds=True),
            )
        )
    return found[0], found[1]


def _dynamics(frame: _Frame, base: BaseParameters) -> tuple[Function, ...]:
    x, g = frame.given, len(frame.closure.given)
    q, qd, qdd, b, tau = x.q, x.qd, x.qdd, x.beta, x.tau
    still = (f"static const double standing[{g}] = {{0.0}};",)

    def function(role: str, does: str, equation: str, inputs: tuple[ArgumentSpec, ...],
                 body: tuple[str, ...]) -> Function:  # fmt: skip
        return Function("_loops", frame.head + role, does, equation, inputs, tau, (), body)

    coriolis = tuple(
        line.replace(f"u, {qd.name}, {qdd.name}, G", f"u, {qd.name}, standing, G")
        for line in frame.wrapped("coriolis(u, ud, udd, beta, rows)", 1, tau, True, still)
    )
    friction = tuple(
        line.replace(f"u, {qd.name}, {qdd.name}, G", f"u, {qd.name}, standing, G")
        for line in frame.wrapped("friction(ud, beta, rows)", 1, tau, True, still)
    )
    return (
        function(
            "inverse_dynamics", "Torques that move the closed robot so.",
            f"{tau.name} = M {qdd.name} + c + g + f", (q, qd, qdd, b),
            frame.wrapped("inverse_dynamics(u, ud, udd, beta, rows)", 1, tau, True),
        ),
        function("gravity", "Torques that hold the robot still, without friction.",
                 "g(q) = tau(q, 0, 0) without effects", (q, b),
                 frame.wrapped("gravity(u, beta, rows)", 1, tau, False)),
        function("coriolis", "Coriolis and centripetal torques.",
                 "c(q, qd) = tau(q, qd, 0) without gravity, friction and offsets", (q, qd, b),
                 coriolis),
        function("friction", "Torques of all effects but rotor inertias: friction, offsets.",
                 "f(q, qd)", (q, qd, b), friction),
    )  # fmt: skip


def _inertia_matrix(frame: _Frame) -> Function:
    n, g, _ = frame.sizes
    M = ArgumentSpec("M", (g, g), "kg m2, kg m or kg", "inertia matrix")
    body = (
        *frame.locals(n * n, False), f"double half[{g * n}];",
        *frame.closing(False),
        "if (status != MODELER_CLOSED) {",
        f"    modeler_nothing(M, {g * g});",
        "    return status;",
        "}",
        f"{frame.prefix}_tree_inertia_matrix(u, beta, rows);",
        f"modeler_project(&{frame.loops}, G, rows, {n}, half);",
        f"for (int i = 0; i < {g}; i++)",
        f"    for (int k = 0; k < {n}; k++)",
        f"        rows[k * {g} + i] = half[i * {n} + k];",
        f"modeler_project(&{frame.loops}, G, rows, {g}, M);",
        "return MODELER_CLOSED;",
    )  # fmt: skip
    return Function(
        "_loops", "inertia_matrix", "Inertia matrix, rotor inertias included; symmetric.",
        "tau = M(q) qdd + ...", (frame.given.q, frame.given.beta), M, (), body,
    )  # fmt: skip


def _kinematics(frame: _Frame, model: SymbolicModel) -> Function:
    n, _, m = frame.sizes
    names = ", ".join(joint.name for joint in model.robot.moving)
    count = len(model.robot.moving)
    T = ArgumentSpec("T", (count, 3, 4), "1 | m", f"poses [R | p] of rows {names} in frame 0")
    body = (
        f"double u[{n}], work[MODELER_CLOSURE_WORK({n}, {m})];",
        f"const int status = modeler_close(&{frame.loops}, q, home, u, work);",
        "",
        "if (status == MODELER_CLOSED)",
        f"    {frame.prefix}_tree_forward_kinematics(u, T);",
        "else",
        f"    modeler_nothing(T, {count * 12});",
        "return status;",
    )
    return Function(
        "_loops", "forward_kinematics", "Pose of the frame of every moving row of the table.",
        "x0 = R x + p with T = [R | p], for a point x of the frame", (frame.given.q,), T, (), body,
    )  # fmt: skip


def _postures(frame: _Frame) -> tuple[Function, ...]:
    """Closing alone, and G."""
    n, g, m = frame.sizes
    q, loops = frame.given.q, frame.loops
    u = ArgumentSpec("u", (n,), "rad or m", "free variables of the opened tree")
    start = ArgumentSpec("start", (n,), "rad or m", "a closed posture to start from")
    G = ArgumentSpec("G", (n, g), "SI", f"d u / d {q.name}")

    def closing(origin: str) -> tuple[str, ...]:
        return (
            f"double work[MODELER_CLOSURE_WORK({n}, {m})];",
            f"const int status = modeler_close(&{loops}, {q.name}, {origin}, u, work);",
            "",
            "if (status != MODELER_CLOSED)",
            f"    modeler_nothing(u, {n});",
            "return status;",
        )

    coupling = (
        f"double u[{n}], work[MODELER_CLOSURE_WORK({n}, {m})];",
        *frame.closing(False),
        "if (status != MODELER_CLOSED)",
        f"    modeler_nothing(G, {n * g});",
        "return status;",
    )
    return (
        Function("_loops", f"{frame.head}close", "Closed posture, on a straight way from home.",
                 "f(u) = 0", (q,), u, (), closing("home")),
        Function("_loops", f"{frame.head}close_from",
                 "Closed posture, on a straight way from another one, such as the last.",
                 "f(u) = 0", (q, start), u, (), closing("start")),
        Function("_loops", f"{frame.head}coupling",
                 "Speeds of the free variables; rows of the platform are its Jacobian.",
                 f"ud = G {frame.given.qd.name}", (q,), G, (), coupling),
    )  # fmt: skip
