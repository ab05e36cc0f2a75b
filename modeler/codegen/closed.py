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
    SparsityPattern,
    eliminate,
    find_pattern,
    sample_jacobians,
)
from modeler.codegen.functions import Arguments, CFunction, Closed, list_entries
from modeler.codegen.fused import (
    SharedSines,
    build_fused_regressor,
    find_shared_sines,
    list_base_entries,
)
from modeler.codegen.targets import Target
from modeler.core.errors import EmitError
from modeler.core.manifest import ArgumentSpec
from modeler.derivation import BaseParameters, Closure, Expr, SymbolicModel

# What the emitted code solves the loops with: functions of the opened tree, and tables.


PLATFORM = "platform_"

_CLOSED = {"double": 1e-9, "single": 1e-5}
"""Residual of a closed loop, relative to the robot's size."""


@dataclass(frozen=True)
class LoopSolver:
    """How the loops of a robot are solved.

    Attributes:
        closure: of the robot.
        pattern: of df/du.
        sets: {start of names: given variables}, "" of the coordinates, "platform_" of a platform.
        eliminations: of the others, by start of names.
        turns: sines and cosines that closure and regressor share.
    """

    closure: Closure
    pattern: SparsityPattern
    sets: dict[str, tuple[int, ...]]
    eliminations: dict[str, Elimination]
    shared_sines: SharedSines

    @property
    def values(self) -> list[Expr]:
        """What the function `closure` writes; see modeler_closure.h."""
        closure = self.closure
        return [
            *closure.equations, *closure.others, *closure.alignments,
            *self.pattern.entries, *self.shared_sines.values,
        ]  # fmt: skip

    @property
    def equation_count(self) -> int:
        """How many different ones there are."""
        return len(self.closure.equations) + len(self.closure.others)

    @property
    def turned_from(self) -> int:
        """Place of the first sine or cosine there."""
        return len(self.values) - len(self.shared_sines.values)

    @property
    def symbols(self) -> list[str]:
        """Names of the symbols that the functions read besides u."""
        factors = max(len(e.factors) for e in self.eliminations.values())
        couplings = max(len(e.coupling) for e in self.eliminations.values())
        lengths = {
            "J": len(self.pattern.entries),
            "K": len(self.pattern.entries),
            "lu": factors,
            "G": couplings,
            "t": len(self.shared_sines.values),
            "right": len(self.closure.equations),
            "v": len(self.closure.actuated),
            "a": len(self.closure.actuated),
        }
        return [f"{name}[{k}]" for name, length in lengths.items() for k in range(length)]


def build_loop_solver(model: SymbolicModel, base: BaseParameters) -> LoopSolver:
    """How the loops of a robot are solved in C.

    Args:
        model: with loops.
        base: its base parameters.
    """
    closure = model.closure
    assert closure is not None
    pattern, values = find_pattern(model), sample_jacobians(model)
    sets = {"": closure.actuated}
    if closure.platform is not None:
        sets[PLATFORM] = closure.platform
    eliminations = {
        head: eliminate(model, pattern, independent, values) for head, independent in sets.items()
    }
    turns = find_shared_sines(
        model.graph, [*closure.drift, *list_base_entries(model, base).values()]
    )  # those of the equations are among them, or nothing else reads them
    return LoopSolver(closure, pattern, sets, eliminations, turns)


def _build_solving_functions(
    solving: LoopSolver, model: SymbolicModel, base: BaseParameters
) -> list[CFunction]:
    """Those of the opened tree that solve the loops, of the free variables as q."""
    closure, elimination = solving.closure, solving.eliminations[""]
    nonzeros, m, g = len(solving.pattern.entries), len(closure.equations), len(closure.actuated)

    def make_array(name: str, length: int, meaning: str) -> ArgumentSpec:
        return ArgumentSpec(name, (length,), "SI", meaning)

    def make_function(
        role: str, does: str, equation: str, inputs: Sequence[ArgumentSpec],
        output: ArgumentSpec, entries: Sequence[Expr],
    ) -> CFunction:  # fmt: skip
        return CFunction("", f"tree_{role}", does, equation, tuple(inputs), output,
                        list_entries(entries), internal=True)  # fmt: skip

    u = make_array("q", len(closure.home), "free variables of the opened tree")
    J = make_array("J", nonzeros, "nonzeros of df/du")
    K = make_array("K", nonzeros, "the same elsewhere")
    right, x = make_array("right", m, "right side"), make_array("x", m, "solved variables")
    functions = [
        make_function("closure", "All equations of all loops, cosines, nonzeros of df/du, turns.",
                 "f(u) = 0", [u], make_array("values", len(solving.values), "as modeler_closure.h"),
                 solving.values),
        make_function("residual", "The independent equations.", "f(u) = 0", [u],
                 make_array("f", m, "equations"), closure.equations),
    ]  # fmt: skip
    for head, each in solving.eliminations.items():
        lu = make_array("lu", len(each.factors), "factors")
        G = make_array("G", len(each.coupling), "nonzeros of G in solved rows")
        functions += [
            make_function(
                f"{head}factor",
                "Factors of the solved columns of J: 1/pivots, then the rest.",
                "J = L U",
                [J],
                lu,
                each.factors,
            ),
            make_function(
                f"{head}solve",
                "Solution with the factors.",
                "J x = right",
                [lu, right],
                x,
                each.solution,
            ),
            make_function(
                f"{head}coupling",
                "G from the factors.",
                "J G = 0",
                [J, lu],
                G,
                [value for _, _, value in each.coupling],
            ),
            make_function(
                f"{head}turned",
                "Bounds of the rows of J^-1 (K - J).",
                "",
                [J, K, lu],
                x,
                each.change_bounds,
            ),
            make_function(
                f"{head}spread",
                "Sum of the squares of J^-1 (K - J).",
                "",
                [J, K, lu],
                make_array("x", 1, "sum"),
                [each.change_squares],
            ),
        ]
    inputs = (
        u,
        make_array("t", len(solving.shared_sines.values), "sines and cosines"),
        make_array("G", len(elimination.coupling), "nonzeros of G in solved rows"),
        make_array("lu", len(elimination.factors), "factors"),
        make_array("v", g, "speeds of the given variables"),
        make_array("a", g, "their accelerations"),
    )
    rows = CFunction(
        "_base_regressor",
        "tree_rows",
        "Regressor of the base parameters, loops closed.",
        "tau = phi beta",
        inputs,
        ArgumentSpec("phi", (g, base.rank), "SI", "base regressor"),
        build_fused_regressor(model, base, closure.actuated, elimination, solving.shared_sines),
        internal=True,
    )
    return [*functions, rows]


def build_closure_tables(
    model: SymbolicModel, base: BaseParameters, solving: LoopSolver, target: Target
) -> dict[str, Any]:
    """Numbers of the closures, as C initialisers.

    Args:
        model: with loops.
        base: its base parameters.
        solving: how they are solved.
        target: the number type.
    """
    closure, places, literal = solving.closure, solving.pattern.places, target.format_literal
    n, m, g = len(closure.home), len(closure.solved), len(closure.actuated)
    factors = max(len(elimination.factors) for elimination in solving.eliminations.values())
    scales = [closure.size if long else 1.0 for long in closure.is_travel]
    return {
        "home": ", ".join(map(literal, closure.home)),
        "scale": ", ".join(map(literal, scales)),
        "unknowns": n,
        "solved": m,
        "given": g,
        "equations": solving.equation_count,
        "alignments": len(closure.alignments),
        # Where the robot is small, its directions are as exact as its lengths.
        "tolerance": literal(_CLOSED[target.precision] * min(1.0, closure.size)),
        "variables": ", ".join(joint.name for joint in model.robot.free_joints),
        "nonzeros": len(places),
        "row": layout.wrap_names([row for row, _ in places]),
        "column": layout.wrap_names([column for _, column in places]),
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
                "factors": len(elimination.factors),
                "limits": layout.wrap_names(map(literal, elimination.limits)),
                "couplings": len(elimination.coupling),
                "coupling_row": layout.wrap_names([k for k, _, _ in elimination.coupling]),
                "coupling_column": layout.wrap_names([j for _, j, _ in elimination.coupling]),
            }
            for head, elimination in solving.eliminations.items()
        ],
    }


@dataclass(frozen=True)
class _CoordinateSet:
    """What the functions of one set of given variables share.

    Attributes:
        head: start of the functions' names: "" or "platform_".
        given: their arguments; q, qd, qdd are x, xd, xdd for the platform.
        unknowns: how many free variables there are.
    """

    head: str
    arguments: Arguments
    unknowns: int

    def make_function(
        self, name: str, does: str, equation: str, inputs: Sequence[ArgumentSpec],
        output: ArgumentSpec, kind: str, **made: Any,
    ) -> CFunction:  # fmt: skip
        """One that closes the loops; `made` as `Closed` says."""
        closed = Closed(kind, f"{self.head}loops", self.arguments.q.name, **made)
        return CFunction(
            "_loops", self.head + name, does, equation, tuple(inputs), output, (), closed
        )


def build_closed_functions(
    model: SymbolicModel, base: BaseParameters, solving: LoopSolver
) -> tuple[CFunction, ...]:
    """All functions of the module of a robot with loops: internal ones, then the public ones.

    Args:
        model: as derived.
        base: the base parameters of the same model.
        solving: how the loops are solved.
    """
    if model.signals or layout.needs_torques(model):
        raise EmitError(
            f"{model.robot.name} has loops, and effects that read more than the motion of joints; "
            "these have no C there; leave them out of [effects]"
        )
    solving_functions = _build_solving_functions(solving, model, base)
    frame, *platforms = _build_coordinate_sets(model, base)
    names = ", ".join(joint.name for joint in model.robot.moving_joints)
    T = ArgumentSpec(
        "T",
        (len(model.robot.moving_joints), 3, 4),
        "1 | m",
        f"poses [R | p] of rows {names} in frame 0",
    )
    kinematics = frame.make_function(
        "forward_kinematics",
        "Pose of the frame of every moving row of the table.",
        "x0 = R x + p with T = [R | p], for a point x of the frame",
        [frame.arguments.q],
        T,
        "poses",
        role="forward_kinematics",
    )
    public = [
        *_build_regressors(frame, model, base),
        *_build_dynamics(frame, model),
        _build_inertia_matrix(frame),
    ]
    public += [
        kinematics,
        *_build_postures(frame),
        layout.build_grouping_function(model, base, frame.arguments),
    ]
    for platform in platforms:
        public += [_build_regressors(platform, model, base)[1], _build_dynamics(platform, model)[0]]
        public += _build_postures(platform)
    # Of the opened tree, of u.
    tree_by_role = {f.role: f for f in layout.build_tree_functions(model, base)}
    for role in ("base_regressor_nonzeros", "base_parameters"):
        del tree_by_role[role]
    arguments, drift = (
        layout.make_arguments(model.robot.free_joints, model, base),
        solving.closure.drift,
    )
    tree_by_role["coriolis"] = _build_tree_coriolis(
        model, layout.make_beta_symbols(model, base), arguments
    )
    tree_by_role["drift"] = CFunction(
        "", "drift", "d/dt(df/du) ud.", "df/du udd + drift = 0", (arguments.q, arguments.qd),
        ArgumentSpec("values", (len(drift),), "m/s2 or 1/s2", "drift"), list_entries(drift),
    )  # fmt: skip
    tree = [
        dataclasses.replace(f, role=f"tree_{role}", internal=True)
        for role, f in tree_by_role.items()
    ]
    return (*tree, *solving_functions, *public)


def build_closed_dynamics(
    model: SymbolicModel, base: BaseParameters, beta: Mapping[int, Expr]
) -> tuple[tuple[CFunction, ...], tuple[CFunction, ...]]:
    """Those of the functions that read beta: of the opened tree, and public ones.

    Args:
        model: as derived.
        base: its base parameters.
        beta: {column: the base parameter that stands for it, or its value}.
    """
    frame, *platforms = _build_coordinate_sets(model, base)
    arguments = layout.make_arguments(model.robot.free_joints, model, base)
    tree = {f.role: f for f in layout.build_dynamics_functions(model, beta, arguments)}
    tree["coriolis"] = _build_tree_coriolis(model, beta, arguments)
    public = [*_build_dynamics(frame, model), _build_inertia_matrix(frame)]
    public += [_build_dynamics(platform, model)[0] for platform in platforms]
    return tuple(tree.values()), tuple(public)


def _build_coordinate_sets(model: SymbolicModel, base: BaseParameters) -> list[_CoordinateSet]:
    """The coordinates, then those of the platform if there is one."""
    closure = model.closure
    assert closure is not None
    n = len(closure.home)
    frames = [_CoordinateSet("", layout.make_arguments(model.robot.coordinates, model, base), n)]
    if closure.platform is not None:
        joints = [model.robot.free_joints[k] for k in closure.platform]
        x = layout.make_arguments(joints, model, base)
        positions = f"positions of the platform: {', '.join(joint.name for joint in joints)}"
        x = dataclasses.replace(
            x,
            q=dataclasses.replace(x.q, name="x", meaning=positions),
            qd=dataclasses.replace(x.qd, name="xd", meaning="their velocities"),
            qdd=dataclasses.replace(x.qdd, name="xdd", meaning="their accelerations"),
            tau=dataclasses.replace(x.tau, name="f", meaning="forces and torques along x"),
        )
        frames.append(_CoordinateSet(PLATFORM, x, n))
    return frames


def _build_tree_coriolis(
    model: SymbolicModel, beta: Mapping[int, Expr], arguments: Arguments
) -> CFunction:
    """The passive joints accelerate at qdd = 0 too: rotors on them belong to it."""
    rotors = {
        k: v for k, v in beta.items() if model.columns[k].kind in ("inertial", "rotor_inertia")
    }
    return CFunction(
        "", "coriolis", "Torques without gravity and friction.", "M(u) udd + c(u, ud)",
        (arguments.q, arguments.qd, arguments.qdd, arguments.beta), arguments.tau,
        list_entries(model.derive_torque(rotors, gravity=False)),
    )  # fmt: skip


def _build_regressors(
    frame: _CoordinateSet, model: SymbolicModel, base: BaseParameters
) -> list[CFunction]:
    x, functions = frame.arguments, []
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
        functions.append(
            frame.make_function(
                role, f"Regressor of the {kind} parameters.", f"{x.tau.name} = phi {beta}",
                [x.q, x.qd, x.qdd], phi, "projected" if "width" in made else "rows",
                qd=x.qd.name, qdd=x.qdd.name, **made,
            )
        )  # fmt: skip
    return functions


def _build_dynamics(frame: _CoordinateSet, model: SymbolicModel) -> list[CFunction]:
    x = frame.arguments
    q, qd, qdd, b, tau = x.q, x.qd, x.qdd, x.beta, x.tau

    def make_torque(
        role: str, does: str, equation: str, inputs: Sequence[ArgumentSpec], reads: str,
        **motion: str,
    ) -> CFunction:  # fmt: skip
        return frame.make_function(
            role, does, equation, inputs, tau, "projected", role=role, reads=reads, **motion
        )

    return [
        make_torque("inverse_dynamics", "Torques that move the closed robot so.",
               f"{tau.name} = M {qdd.name} + c + g + f", (q, qd, qdd, b), "u, ud, udd, beta",
               qd=qd.name, qdd=qdd.name),
        make_torque("gravity", "Torques that hold the robot still, without friction.",
               "g(q) = tau(q, 0, 0) without effects", (q, b), "u, beta"),
        make_torque("coriolis", "Coriolis and centripetal torques.",
               "c(q, qd) = tau(q, qd, 0) without gravity, friction and offsets", (q, qd, b),
               "u, ud, udd, beta", qd=qd.name, qdd="standing"),
        make_torque("friction", "Torques of all effects but rotor inertias: friction, offsets.",
               "f(q, qd)", (q, qd, qdd, b), "u, ud, udd, beta", qd=qd.name, qdd=qdd.name)
        if layout.needs_more_than_speed(model) else
        make_torque("friction", "Torques of all effects but rotor inertias: friction, offsets.",
               "f(q, qd)", (q, qd, b), "ud, beta", qd=qd.name, qdd="standing"),
    ]  # fmt: skip


def _build_inertia_matrix(frame: _CoordinateSet) -> CFunction:
    x = frame.arguments
    M = ArgumentSpec("M", (*x.q.shape, *x.q.shape), "kg m2, kg m or kg", "inertia matrix")
    return frame.make_function(
        "inertia_matrix", "Inertia matrix, rotor inertias included; symmetric.",
        "tau = M(q) qdd + ...", (x.q, x.beta), M, "inertia_matrix", role="inertia_matrix",
        reads="u, beta",
    )  # fmt: skip


def _build_postures(frame: _CoordinateSet) -> list[CFunction]:
    """Closing alone, and G."""
    q, n = frame.arguments.q, (frame.unknowns,)
    u = ArgumentSpec("u", n, "rad or m", "free variables of the opened tree")
    start = ArgumentSpec("start", n, "rad or m", "a closed posture to start from")
    G = ArgumentSpec("G", (*n, *q.shape), "SI", f"d u / d {q.name}")
    return [
        frame.make_function(
            "close", "Closed posture, on a straight way from home.", "f(u) = 0", [q], u, "posture"
        ),
        frame.make_function(
            "close_from",
            "Closed posture, on a straight way from another one, such as the last.",
            "f(u) = 0",
            [q, start],
            u,
            "posture",
            start="start",
        ),
        frame.make_function(
            "coupling",
            "Speeds of the free variables; rows of the platform are its Jacobian.",
            f"ud = G {frame.arguments.qd.name}",
            [q],
            G,
            "coupling",
        ),
    ]
