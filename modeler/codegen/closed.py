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
from modeler.codegen.functions import (
    Arguments,
    CFunction,
    Closed,
    arguments_of,
    beta_symbols,
    dynamics_functions,
    entries_of,
    grouping_function,
    reads_more,
    tree_functions,
)
from modeler.codegen.fused import Turns, base_columns, fused_regressor, turns_of
from modeler.core.errors import EmitError
from modeler.core.manifest import ArgumentSpec
from modeler.derivation.closure import Closure
from modeler.derivation.graph import Expr
from modeler.derivation.model import SymbolicModel
from modeler.derivation.result import BaseParameters

# What the emitted code solves the loops with: functions of the opened tree, and tables.


PLATFORM = "platform_"


@dataclass(frozen=True)
class Solving:
    """How the loops of a robot are solved.

    Attributes:
        closure: of the robot.
        pattern: of df/du.
        sets: {start of names: given variables}, "" of the coordinates, "platform_" of a platform.
        eliminations: of the others, by start of names.
        turns: sines and cosines that closure and regressor share.
        functions: internal ones, of the free variables as q.
    """

    closure: Closure
    pattern: Pattern
    sets: dict[str, tuple[int, ...]]
    eliminations: dict[str, Elimination]
    turns: Turns
    functions: tuple[CFunction, ...]

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
    solving = Solving(closure, pattern, sets, found, turns, ())
    functions = [*_equations(solving)]
    for head, own in found.items():
        functions += _eliminations(solving, head, own)
    functions.append(_rows(solving, model, base))
    return Solving(closure, pattern, sets, found, turns, tuple(functions))


def _array(name: str, length: int, meaning: str) -> ArgumentSpec:
    return ArgumentSpec(name, (length,), "SI", meaning)


def _function(
    role: str, does: str, equation: str, inputs: Sequence[ArgumentSpec],
    output: ArgumentSpec, entries: Sequence[Expr],
) -> CFunction:  # fmt: skip
    return CFunction("", f"tree_{role}", does, equation, tuple(inputs), output,
                    entries_of(entries), internal=True)  # fmt: skip


def _equations(solving: Solving) -> list[CFunction]:
    closure = solving.closure
    u = _array("q", len(closure.home), "free variables of the opened tree")
    values, f = solving.values, closure.equations
    return [
        _function("closure", "All equations of all loops, cosines, nonzeros of df/du, turns.",
                  "f(u) = 0", [u], _array("values", len(values), "as modeler_closure.h"), values),
        _function("residual", "The independent equations.", "f(u) = 0", [u],
                  _array("f", len(f), "equations"), f),
    ]  # fmt: skip


def _eliminations(solving: Solving, head: str, own: Elimination) -> list[CFunction]:
    nonzeros, m = len(solving.pattern.entries), len(solving.closure.equations)
    J = _array("J", nonzeros, "nonzeros of df/du")
    K = _array("K", nonzeros, "the same elsewhere")
    lu = _array("lu", len(own.factors), "factors")
    right, x = _array("right", m, "right side"), _array("x", m, "solved variables")
    G = _array("G", len(own.coupling), "nonzeros of G in solved rows")
    return [
        _function(f"{head}factor", "Factors of the solved columns of J: 1/pivots, then the rest.",
                  "J = L U", [J], lu, own.factors),
        _function(f"{head}solve", "Solution with the factors.", "J x = right", [lu, right], x,
                  own.solution),
        _function(f"{head}coupling", "G from the factors.", "J G = 0", [J, lu], G,
                  [value for _, _, value in own.coupling]),
        _function(f"{head}turned", "Bounds of the rows of J^-1 (K - J).", "", [J, K, lu], x,
                  own.turned),
        _function(f"{head}spread", "Sum of the squares of J^-1 (K - J).", "", [J, K, lu],
                  _array("x", 1, "sum"), [own.spread]),
    ]  # fmt: skip


def _rows(solving: Solving, model: SymbolicModel, base: BaseParameters) -> CFunction:
    closure, own = solving.closure, solving.eliminations[""]
    n, g = len(closure.home), len(closure.given)
    inputs = (
        _array("q", n, "free variables of the opened tree"),
        _array("t", len(solving.turns.values), "sines and cosines"),
        _array("G", len(own.coupling), "nonzeros of G in solved rows"),
        _array("lu", len(own.factors), "factors"),
        _array("v", g, "speeds of the given variables"),
        _array("a", g, "their accelerations"),
    )
    return CFunction(
        "_base_regressor", "tree_rows", "Regressor of the base parameters, loops closed.",
        "tau = phi beta", inputs, ArgumentSpec("phi", (g, base.rank), "SI", "base regressor"),
        fused_regressor(model, base, closure.given, own, solving.turns), internal=True,
    )  # fmt: skip


def closure_tables(model: SymbolicModel, solving: Solving, closed: float) -> dict[str, Any]:
    """Numbers of the closures, as C initialisers.

    Args:
        model: with loops.
        solving: how they are solved.
        closed: residual of a closed loop, relative to the robot's size.
    """
    closure, places = solving.closure, solving.pattern.places
    scales = [closure.size if long else 1.0 for long in closure.lengths]
    return {
        "home": ", ".join(repr(x) for x in closure.home),
        "scale": ", ".join(repr(x) for x in scales),
        "unknowns": len(closure.home),
        "solved": len(closure.solved),
        "given": len(closure.given),
        "equations": solving.equations,
        "alignments": len(closure.alignments),
        # Where the robot is small, its directions are as exact as its lengths.
        "tolerance": repr(closed * min(1.0, closure.size)),
        "variables": ", ".join(joint.name for joint in model.robot.free),
        "nonzeros": len(places),
        "row": layout.number_lines([row for row, _ in places]),
        "column": layout.number_lines([column for _, column in places]),
        "length": len(solving.values),
        "turned_from": solving.turned_from,
        "factors": max(len(own.factors) for own in solving.eliminations.values()),
        "sets": [
            _set_tables(head, solving.sets[head], own, len(closure.home))
            for head, own in solving.eliminations.items()
        ],
    }


def _set_tables(head: str, given: Sequence[int], own: Elimination, unknowns: int) -> dict[str, Any]:
    """Those of one set of given variables."""
    return {
        "head": head,
        "given": ", ".join(map(str, given)),
        "solved": ", ".join(str(k) for k in range(unknowns) if k not in given),
        "factors": len(own.factors),
        "limits": layout.name_lines([repr(limit) for limit in own.limits]),
        "couplings": len(own.coupling),
        "coupling_row": layout.number_lines([k for k, _, _ in own.coupling]),
        "coupling_column": layout.number_lines([j for _, j, _ in own.coupling]),
    }


@dataclass(frozen=True)
class _Frame:
    """What the functions of one set of given variables share.

    Attributes:
        head: start of the functions' names: "" or "platform_".
        given: their arguments; q, qd, qdd are x, xd, xdd for the platform.
        closure: of the robot.
    """

    head: str
    given: Arguments
    closure: Closure

    @property
    def sizes(self) -> tuple[int, int]:
        """(free variables, given)."""
        return len(self.closure.home), len(self.closure.given)

    def closed(self, kind: str, **more: Any) -> Closed:
        """How a function is made, with these variables given."""
        return Closed(kind, f"{self.head}loops", self.given.q.name, **more)

    def regressor(self) -> Closed:
        """The one of the base parameters, in one block where the elimination is sparse."""
        given = self.given
        return self.closed("rows", qd=given.qd.name, qdd=given.qdd.name, role="rows")

    def moving(self, role: str, reads: str, width: int = 1, qdd: str = "") -> Closed:
        """One that carries speeds and accelerations over; `qdd` stands for these."""
        qd = self.given.qd.name
        given = qdd or self.given.qdd.name
        return self.closed("projected", qd=qd, qdd=given, role=role, reads=reads, width=width)


def closed_functions(
    model: SymbolicModel, base: BaseParameters, solving: Solving
) -> tuple[CFunction, ...]:
    """All functions of the module of a robot with loops: internal ones, then the public ones.

    Args:
        model: as derived.
        base: the base parameters of the same model.
        solving: how the loops are solved.
    """
    frames = _frames(model, base)
    frame = frames[0]
    if model.signals or reads_more(model):
        raise EmitError(
            f"{model.robot.name} has loops, and effects that read more than speeds and "
            "accelerations; these have no C there; leave them out of [effects]"
        )
    public = [
        *_regressors(frame, model, base), *_dynamics(frame),
        _inertia_matrix(frame), _kinematics(frame, model), *_postures(frame),
        grouping_function(model, base, frame.given),
    ]  # fmt: skip
    for platform in frames[1:]:
        public += [
            _regressors(platform, model, base)[1],
            _dynamics(platform)[0],
            *_postures(platform),
        ]
    return (*_internal(model, base, solving), *public)


def closed_dynamics(
    model: SymbolicModel, base: BaseParameters, beta: Mapping[int, Expr]
) -> tuple[tuple[CFunction, ...], tuple[CFunction, ...]]:
    """Those of the functions that read beta: of the opened tree, and public ones.

    Args:
        model: as derived.
        base: its base parameters.
        beta: {column: the base parameter that stands for it, or its value}.
    """
    frames = _frames(model, base)
    given = arguments_of(model.robot.free, model, base)
    tree = {f.role: f for f in dynamics_functions(model, beta, given)}
    tree["coriolis"] = _tree_coriolis(model, beta, given)
    public = [*_dynamics(frames[0]), _inertia_matrix(frames[0])]
    public += [_dynamics(platform)[0] for platform in frames[1:]]
    return tuple(tree.values()), tuple(public)


def _frames(model: SymbolicModel, base: BaseParameters) -> list[_Frame]:
    """The coordinates, then those of the platform if there is one."""
    closure = model.closure
    assert closure is not None
    frames = [_Frame("", arguments_of(model.robot.coordinates, model, base), closure)]
    if closure.platform is not None:
        joints = [model.robot.free[k] for k in closure.platform]
        names = ", ".join(joint.name for joint in joints)
        x = _renamed(arguments_of(joints, model, base), names)
        frames.append(_Frame(PLATFORM, x, closure))
    return frames


def _renamed(given: Arguments, names: str) -> Arguments:
    meaning = f"of the platform: {names}"
    return dataclasses.replace(
        given,
        q=dataclasses.replace(given.q, name="x", meaning=f"positions {meaning}"),
        qd=dataclasses.replace(given.qd, name="xd", meaning="their velocities"),
        qdd=dataclasses.replace(given.qdd, name="xdd", meaning="their accelerations"),
        tau=dataclasses.replace(given.tau, name="f", meaning="forces and torques along x"),
    )


def _internal(model: SymbolicModel, base: BaseParameters, solving: Solving) -> list[CFunction]:
    """Functions of the opened tree, of u."""
    closure = model.closure
    assert closure is not None
    found = {f.role: f for f in tree_functions(model, base)}
    for role in ("base_regressor_nonzeros", "base_parameters"):
        del found[role]
    given = arguments_of(model.robot.free, model, base)
    found["coriolis"] = _tree_coriolis(model, beta_symbols(model, base), given)
    found["drift"] = CFunction(
        "", "drift", "d/dt(df/du) ud.", "df/du udd + drift = 0", (given.q, given.qd),
        ArgumentSpec("values", (len(closure.drift),), "m/s2 or 1/s2", "drift"),
        entries_of(closure.drift),
    )  # fmt: skip
    tree = [dataclasses.replace(f, role=f"tree_{role}", internal=True) for role, f in found.items()]
    return [*tree, *solving.functions]


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


def _regressors(
    frame: _Frame, model: SymbolicModel, base: BaseParameters
) -> tuple[CFunction, CFunction]:
    x, g = frame.given, len(frame.closure.given)
    found = []
    for role, width, kind in (
        ("regressor", len(model.columns), "standard"),
        ("base_regressor", base.rank, "base"),
    ):
        phi = ArgumentSpec("phi", (g, width), "SI", f"torque per unit of each {kind} parameter")
        found.append(
            CFunction(
                "_loops",
                frame.head + role,
                f"Regressor of the {kind} parameters.",
                f"{x.tau.name} = phi {'chi' if kind == 'standard' else 'beta'}",
                (x.q, x.qd, x.qdd),
                phi,
                (),
                frame.regressor()
                if kind == "base" and not frame.head
                else frame.moving(role, "u, ud, udd", width),
            )
        )
    return found[0], found[1]


def _dynamics(frame: _Frame) -> tuple[CFunction, ...]:
    x = frame.given
    q, qd, qdd, b, tau = x.q, x.qd, x.qdd, x.beta, x.tau

    def function(role: str, does: str, equation: str, inputs: tuple[ArgumentSpec, ...],
                 closed: Closed) -> CFunction:  # fmt: skip
        return CFunction("_loops", frame.head + role, does, equation, inputs, tau, (), closed)

    return (
        function(
            "inverse_dynamics", "Torques that move the closed robot so.",
            f"{tau.name} = M {qdd.name} + c + g + f", (q, qd, qdd, b),
            frame.moving("inverse_dynamics", "u, ud, udd, beta"),
        ),
        function("gravity", "Torques that hold the robot still, without friction.",
                 "g(q) = tau(q, 0, 0) without effects", (q, b),
                 frame.closed("projected", role="gravity", reads="u, beta")),
        function("coriolis", "Coriolis and centripetal torques.",
                 "c(q, qd) = tau(q, qd, 0) without gravity, friction and offsets", (q, qd, b),
                 frame.moving("coriolis", "u, ud, udd, beta", qdd="standing")),
        function("friction", "Torques of all effects but rotor inertias: friction, offsets.",
                 "f(q, qd)", (q, qd, b),
                 frame.moving("friction", "ud, beta", qdd="standing")),
    )  # fmt: skip


def _inertia_matrix(frame: _Frame) -> CFunction:
    _, g = frame.sizes
    M = ArgumentSpec("M", (g, g), "kg m2, kg m or kg", "inertia matrix")
    return CFunction(
        "_loops", "inertia_matrix", "Inertia matrix, rotor inertias included; symmetric.",
        "tau = M(q) qdd + ...", (frame.given.q, frame.given.beta), M, (),
        frame.closed("inertia_matrix", role="inertia_matrix", reads="u, beta"),
    )  # fmt: skip


def _kinematics(frame: _Frame, model: SymbolicModel) -> CFunction:
    names = ", ".join(joint.name for joint in model.robot.moving)
    count = len(model.robot.moving)
    T = ArgumentSpec("T", (count, 3, 4), "1 | m", f"poses [R | p] of rows {names} in frame 0")
    return CFunction(
        "_loops", "forward_kinematics", "Pose of the frame of every moving row of the table.",
        "x0 = R x + p with T = [R | p], for a point x of the frame", (frame.given.q,), T, (),
        frame.closed("poses", role="forward_kinematics"),
    )  # fmt: skip


def _postures(frame: _Frame) -> tuple[CFunction, ...]:
    """Closing alone, and G."""
    n, g = frame.sizes
    q = frame.given.q
    u = ArgumentSpec("u", (n,), "rad or m", "free variables of the opened tree")
    start = ArgumentSpec("start", (n,), "rad or m", "a closed posture to start from")
    G = ArgumentSpec("G", (n, g), "SI", f"d u / d {q.name}")
    return (
        CFunction("_loops", f"{frame.head}close", "Closed posture, on a straight way from home.",
                 "f(u) = 0", (q,), u, (), frame.closed("posture")),
        CFunction("_loops", f"{frame.head}close_from",
                 "Closed posture, on a straight way from another one, such as the last.",
                 "f(u) = 0", (q, start), u, (), frame.closed("posture", start="start")),
        CFunction("_loops", f"{frame.head}coupling",
                 "Speeds of the free variables; rows of the platform are its Jacobian.",
                 f"ud = G {frame.given.qd.name}", (q,), G, (), frame.closed("coupling")),
    )  # fmt: skip
