"""Functions of a robot with loops: those of its opened tree, and what closes them around it.

The tree's functions take the free variables u; the public ones take the coordinates q, close the
loops, carry speeds and accelerations over (ud = G qd, udd = G qdd + gamma) and project the result,
tau_q = G^T tau_u.
"""

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from modeler.codegen import functions as layout
from modeler.codegen.elimination import (
    Elimination,
    Pattern,
    elimination,
    pattern_of,
    sampled_jacobians,
)
from modeler.codegen.functions import Arguments, CFunction, Closed, entries_of
from modeler.codegen.fused import Turns, base_columns, fused_regressor, turns_of
from modeler.codegen.targets import Target
from modeler.core.errors import EmitError
from modeler.core.manifest import ArgumentSpec
from modeler.derivation import BaseParameters, Closure, Expr, SymbolicModel

# What the emitted code solves the loops with: functions of the opened tree, and tables.


PLATFORM = "platform_"

_CLOSED = {"double": 1e-9, "single": 1e-5}
"""Residual of a closed loop, relative to the robot's size."""


@dataclass(frozen=True)
class Solving:
    """How the loops of a robot are solved.

    Attributes:
        closure: of the robot.
        pattern: of df/du.
        sets: {start of names: given variables}, "" of the coordinates, "platform_" of a platform.
        eliminations: of the others, by start of names.
        turns: sines and cosines that closure and regressor share.
    """

    closure: Closure
    pattern: Pattern
    sets: dict[str, tuple[int, ...]]
    eliminations: dict[str, Elimination]
    turns: Turns

    @property
    def values(self) -> list[Expr]:
        """What the function `closure` writes; see modeler_closure.h."""
        closure = self.closure
        return [
            *closure.equations, *closure.others, *closure.alignments,
            *self.pattern.entries, *self.turns.values,
        ]  # fmt: skip

    @property
    def equations(self) -> int:
        """How many different ones there are."""
        return len(self.closure.equations) + len(self.closure.others)

    @property
    def turned_from(self) -> int:
        """Place of the first sine or cosine there."""
        return len(self.values) - len(self.turns.values)

    @property
    def symbols(self) -> list[str]:
        """Names of the symbols that the functions read besides u."""
        factors = max(len(e.factors) for e in self.eliminations.values())
        couplings = max(len(e.coupling) for e in self.eliminations.values())
        lengths = {
            "J": len(self.pattern.entries), "K": len(self.pattern.entries), "lu": factors,
            "G": couplings, "t": len(self.turns.values), "right": len(self.closure.equations),
            "v": len(self.closure.given), "a": len(self.closure.given),
        }  # fmt: skip
        return [f"{name}[{k}]" for name, length in lengths.items() for k in range(length)]


def solving_of(model: SymbolicModel, base: BaseParameters) -> Solving:
    """How the loops of a robot are solved in C.

    Args:
        model: with loops.
        base: its base parameters.
    """
    closure = model.closure
    assert closure is not None
    pattern, values = pattern_of(model), sampled_jacobians(model)
    sets = {"": closure.given}
    if closure.platform is not None:
        sets[PLATFORM] = closure.platform
    found = {head: elimination(model, pattern, given, values) for head, given in sets.items()}
    turns = turns_of(
        model.graph, [*closure.drift, *base_columns(model, base).values()]
    )  # those of the equations are among them, or nothing else reads them
    return Solving(closure, pattern, sets, found, turns)


def _solving_functions(
    solving: Solving, model: SymbolicModel, base: BaseParameters
) -> list[CFunction]:
    """Those of the opened tree that solve the loops, of the free variables as q."""
    closure, own = solving.closure, solving.eliminations[""]
    nonzeros, m, g = len(solving.pattern.entries), len(closure.equations), len(closure.given)

    def array(name: str, length: int, meaning: str) -> ArgumentSpec:
        return ArgumentSpec(name, (length,), "SI", meaning)

    def function(
        role: str, does: str, equation: str, inputs: Sequence[ArgumentSpec],
        output: ArgumentSpec, entries: Sequence[Expr],
    ) -> CFunction:  # fmt: skip
        return CFunction("", f"tree_{role}", does, equation, tuple(inputs), output,
                        entries_of(entries), internal=True)  # fmt: skip

    u = array("q", len(closure.home), "free variables of the opened tree")
    J = array("J", nonzeros, "nonzeros of df/du")
    K = array("K", nonzeros, "the same elsewhere")
    right, x = array("right", m, "right side"), array("x", m, "solved variables")
    found = [
        function("closure", "All equations of all loops, cosines, nonzeros of df/du, turns.",
                 "f(u) = 0", [u], array("values", len(solving.values), "as modeler_closure.h"),
                 solving.values),
        function("residual", "The independent equations.", "f(u) = 0", [u],
                 array("f", m, "equations"), closure.equations),
    ]  # fmt: skip
    for head, each in solving.eliminations.items():
        lu = array("lu", len(each.factors), "factors")
        G = array("G", len(each.coupling), "nonzeros of G in solved rows")
        found += [
            function(f"{head}factor",
                     "Factors of the solved columns of J: 1/pivots, then the rest.",
                     "J = L U", [J], lu, each.factors),
            function(f"{head}solve", "Solution with the factors.", "J x = right", [lu, right], x,
                     each.solution),
            function(f"{head}coupling", "G from the factors.", "J G = 0", [J, lu], G,
                     [value for _, _, value in each.coupling]),
            function(f"{head}turned", "Bounds of the rows of J^-1 (K - J).", "", [J, K, lu], x,
                     each.turned),
            function(f"{head}spread", "Sum of the squares of J^-1 (K - J).", "", [J, K, lu],
                     array("x", 1, "sum"), [each.spread]),
        ]  # fmt: skip
    inputs = (
        u,
        array("t", len(solving.turns.values), "sines and cosines"),
        array("G", len(own.coupling), "nonzeros of G in solved rows"),
        array("lu", len(own.factors), "factors"),
        array("v", g, "speeds of the given variables"),
        array("a", g, "their accelerations"),
    )
    rows = CFunction(
        "_base_regressor", "tree_rows", "Regressor of the base parameters, loops closed.",
        "tau = phi beta", inputs, ArgumentSpec("phi", (g, base.rank), "SI", "base regressor"),
        fused_regressor(model, base, closure.given, own, solving.turns), internal=True,
    )  # fmt: skip
    return [*found, rows]


def closure_tables(
    model: SymbolicModel, base: BaseParameters, solving: Solving, target: Target
) -> dict[str, Any]:
    """Numbers of the closures, as C initialisers.

    Args:
        model: with loops.
        base: its base parameters.
        solving: how they are solved.
        target: the number type.
    """
    closure, places, literal = solving.closure, solving.pattern.places, target.literal
    n, m, g = len(closure.home), len(closure.solved), len(closure.given)
    factors = max(len(own.factors) for own in solving.eliminations.values())
    scales = [closure.size if long else 1.0 for long in closure.lengths]
    return {
        "home": ", ".join(map(literal, closure.home)),
        "scale": ", ".join(map(literal, scales)),
        "unknowns": n,
        "solved": m,
        "given": g,
        "equations": solving.equations,
        "alignments": len(closure.alignments),
        # Where the robot is small, its directions are as exact as its lengths.
        "tolerance": literal(_CLOSED[target.precision] * min(1.0, closure.size)),
        "variables": ", ".join(joint.name for joint in model.robot.free),
        "nonzeros": len(places),
        "row": layout.name_lines([row for row, _ in places]),
        "column": layout.name_lines([column for _, column in places]),
        "length": len(solving.values),
        "turned_from": solving.turned_from,
        "factors": factors,
        # Sizes of a posture's arrays, as in modeler_closure.h, and of what functions work in.
        "places": 2 * m + n,
        "numbers": 2 * (len(solving.values) + factors + m * (m + 1)) + m * (n - m + 5) + 5 * n,
        "rows": n * max(base.rank, n + g),
        "sets": [
            {
                "head": head,
                "given": ", ".join(map(str, solving.sets[head])),
                "solved": ", ".join(
                    str(k) for k in range(len(closure.home)) if k not in solving.sets[head]
                ),
                "factors": len(own.factors),
                "limits": layout.name_lines(map(literal, own.limits)),
                "couplings": len(own.coupling),
                "coupling_row": layout.name_lines([k for k, _, _ in own.coupling]),
                "coupling_column": layout.name_lines([j for _, j, _ in own.coupling]),
            }
            for head, own in solving.eliminations.items()
        ],
    }


@dataclass(frozen=True)
class _Frame:
    """What the functions of one set of given variables share.

    Attributes:
        head: start of the functions' names: "" or "platform_".
        given: their arguments; q, qd, qdd are x, xd, xdd for the platform.
        unknowns: how many free variables there are.
    """

    head: str
    given: Arguments
    unknowns: int

    def function(
        self, name: str, does: str, equation: str, inputs: Sequence[ArgumentSpec],
        output: ArgumentSpec, kind: str, **made: Any,
    ) -> CFunction:  # fmt: skip
        """One that closes the loops; `made` as `Closed` says."""
        closed = Closed(kind, f"{self.head}loops", self.given.q.name, **made)
        return CFunction(
            "_loops", self.head + name, does, equation, tuple(inputs), output, (), closed
        )


def closed_functions(
    model: SymbolicModel, base: BaseParameters, solving: Solving
) -> tuple[CFunction, ...]:
    """All functions of the module of a robot with loops: internal ones, then the public ones.

    Args:
        model: as derived.
        base: the base parameters of the same model.
        solving: how the loops are solved.
    """
    if model.signals or layout.reads_torques(model):
        raise EmitError(
            f"{model.robot.name} has loops, and effects that read more than the motion of joints; "
            "these have no C there; leave them out of [effects]"
        )
    solving_functions = _solving_functions(solving, model, base)
    frame, *platforms = _frames(model, base)
    names = ", ".join(joint.name for joint in model.robot.moving)
    T = ArgumentSpec(
        "T", (len(model.robot.moving), 3, 4), "1 | m", f"poses [R | p] of rows {names} in frame 0"
    )
    kinematics = frame.function(
        "forward_kinematics", "Pose of the frame of every moving row of the table.",
        "x0 = R x + p with T = [R | p], for a point x of the frame", [frame.given.q], T, "poses",
        role="forward_kinematics",
    )  # fmt: skip
    public = [*_regressors(frame, model, base), *_dynamics(frame, model), _inertia_matrix(frame)]
    public += [kinematics, *_postures(frame), layout.grouping_function(model, base, frame.given)]
    for platform in platforms:
        public += [_regressors(platform, model, base)[1], _dynamics(platform, model)[0]]
        public += _postures(platform)
    # Of the opened tree, of u.
    found = {f.role: f for f in layout.tree_functions(model, base)}
    for role in ("base_regressor_nonzeros", "base_parameters"):
        del found[role]
    given, drift = layout.arguments_of(model.robot.free, model, base), solving.closure.drift
    found["coriolis"] = _tree_coriolis(model, layout.beta_symbols(model, base), given)
    found["drift"] = CFunction(
        "", "drift", "d/dt(df/du) ud.", "df/du udd + drift = 0", (given.q, given.qd),
        ArgumentSpec("values", (len(drift),), "m/s2 or 1/s2", "drift"), entries_of(drift),
    )  # fmt: skip
    tree = [dataclasses.replace(f, role=f"tree_{role}", internal=True) for role, f in found.items()]
    return (*tree, *solving_functions, *public)


def closed_dynamics(
    model: SymbolicModel, base: BaseParameters, beta: Mapping[int, Expr]
) -> tuple[tuple[CFunction, ...], tuple[CFunction, ...]]:
    """Those of the functions that read beta: of the opened tree, and public ones.

    Args:
        model: as derived.
        base: its base parameters.
        beta: {column: the base parameter that stands for it, or its value}.
    """
    frame, *platforms = _frames(model, base)
    given = layout.arguments_of(model.robot.free, model, base)
    tree = {f.role: f for f in layout.dynamics_functions(model, beta, given)}
    tree["coriolis"] = _tree_coriolis(model, beta, given)
    public = [*_dynamics(frame, model), _inertia_matrix(frame)]
    public += [_dynamics(platform, model)[0] for platform in platforms]
    return tuple(tree.values()), tuple(public)


def _frames(model: SymbolicModel, base: BaseParameters) -> list[_Frame]:
    """The coordinates, then those of the platform if there is one."""
    closure = model.closure
    assert closure is not None
    n = len(closure.home)
    frames = [_Frame("", layout.arguments_of(model.robot.coordinates, model, base), n)]
    if closure.platform is not None:
        joints = [model.robot.free[k] for k in closure.platform]
        x = layout.arguments_of(joints, model, base)
        positions = f"positions of the platform: {', '.join(joint.name for joint in joints)}"
        x = dataclasses.replace(
            x,
            q=dataclasses.replace(x.q, name="x", meaning=positions),
            qd=dataclasses.replace(x.qd, name="xd", meaning="their velocities"),
            qdd=dataclasses.replace(x.qdd, name="xdd", meaning="their accelerations"),
            tau=dataclasses.replace(x.tau, name="f", meaning="forces and torques along x"),
        )
        frames.append(_Frame(PLATFORM, x, n))
    return frames


def _tree_coriolis(model: SymbolicModel, beta: Mapping[int, Expr], given: Arguments) -> CFunction:
    """The passive joints accelerate at qdd = 0 too: rotors on them belong to it."""
    rotors = {
        k: v for k, v in beta.items() if model.columns[k].kind in ("inertial", "rotor_inertia")
    }
    return CFunction(
        "", "coriolis", "Torques without gravity and friction.", "M(u) udd + c(u, ud)",
        (given.q, given.qd, given.qdd, given.beta), given.tau,
        entries_of(model.torque(rotors, gravity=False)),
    )  # fmt: skip


def _regressors(frame: _Frame, model: SymbolicModel, base: BaseParameters) -> list[CFunction]:
    x, found = frame.given, []
    for role, width, kind, beta in (
        ("regressor", len(model.columns), "standard", "chi"),
        ("base_regressor", base.rank, "base", "beta"),
    ):
        phi = ArgumentSpec(
            "phi", (*x.tau.shape, width), "SI", f"torque per unit of each {kind} parameter"
        )
        made: dict[str, Any] = {"role": role, "reads": "u, ud, udd", "width": width}
        if kind == "base" and not frame.head:  # in one block, where the elimination is sparse
            made = {"role": "rows"}
        found.append(
            frame.function(
                role, f"Regressor of the {kind} parameters.", f"{x.tau.name} = phi {beta}",
                [x.q, x.qd, x.qdd], phi, "projected" if "width" in made else "rows",
                qd=x.qd.name, qdd=x.qdd.name, **made,
            )
        )  # fmt: skip
    return found


def _dynamics(frame: _Frame, model: SymbolicModel) -> list[CFunction]:
    x = frame.given
    q, qd, qdd, b, tau = x.q, x.qd, x.qdd, x.beta, x.tau

    def torque(
        role: str, does: str, equation: str, inputs: Sequence[ArgumentSpec], reads: str,
        **motion: str,
    ) -> CFunction:  # fmt: skip
        return frame.function(
            role, does, equation, inputs, tau, "projected", role=role, reads=reads, **motion
        )

    return [
        torque("inverse_dynamics", "Torques that move the closed robot so.",
               f"{tau.name} = M {qdd.name} + c + g + f", (q, qd, qdd, b), "u, ud, udd, beta",
               qd=qd.name, qdd=qdd.name),
        torque("gravity", "Torques that hold the robot still, without friction.",
               "g(q) = tau(q, 0, 0) without effects", (q, b), "u, beta"),
        torque("coriolis", "Coriolis and centripetal torques.",
               "c(q, qd) = tau(q, qd, 0) without gravity, friction and offsets", (q, qd, b),
               "u, ud, udd, beta", qd=qd.name, qdd="standing"),
        torque("friction", "Torques of all effects but rotor inertias: friction, offsets.",
               "f(q, qd)", (q, qd, qdd, b), "u, ud, udd, beta", qd=qd.name, qdd=qdd.name)
        if layout.reads_more(model) else
        torque("friction", "Torques of all effects but rotor inertias: friction, offsets.",
               "f(q, qd)", (q, qd, b), "ud, beta", qd=qd.name, qdd="standing"),
    ]  # fmt: skip


def _inertia_matrix(frame: _Frame) -> CFunction:
    x = frame.given
    M = ArgumentSpec("M", (*x.q.shape, *x.q.shape), "kg m2, kg m or kg", "inertia matrix")
    return frame.function(
        "inertia_matrix", "Inertia matrix, rotor inertias included; symmetric.",
        "tau = M(q) qdd + ...", (x.q, x.beta), M, "inertia_matrix", role="inertia_matrix",
        reads="u, beta",
    )  # fmt: skip


def _postures(frame: _Frame) -> list[CFunction]:
    """Closing alone, and G."""
    q, n = frame.given.q, (frame.unknowns,)
    u = ArgumentSpec("u", n, "rad or m", "free variables of the opened tree")
    start = ArgumentSpec("start", n, "rad or m", "a closed posture to start from")
    G = ArgumentSpec("G", (*n, *q.shape), "SI", f"d u / d {q.name}")
    return [
        frame.function("close", "Closed posture, on a straight way from home.", "f(u) = 0", [q], u,
                       "posture"),
        frame.function("close_from",
                       "Closed posture, on a straight way from another one, such as the last.",
                       "f(u) = 0", [q, start], u, "posture", start="start"),
        frame.function("coupling",
                       "Speeds of the free variables; rows of the platform are its Jacobian.",
                       f"ud = G {frame.given.qd.name}", [q], G, "coupling"),
    ]  # fmt: skip
