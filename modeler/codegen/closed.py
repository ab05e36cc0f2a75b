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
from modeler.codegen.block import Target
from modeler.codegen.elimination import (
    Elimination,
    SharedSines,
    SparsityPattern,
    build_fused_regressor,
    eliminate,
    find_pattern,
    find_shared_sines,
    list_base_entries,
    sample_jacobians,
)
from modeler.codegen.functions import Arguments, CFunction, Closed, read_catalogue
from modeler.core.errors import EmitError
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
        shared_sines: sines and cosines that closure and regressor share.
    """

    closure: Closure
    pattern: SparsityPattern
    sets: dict[str, tuple[int, ...]]
    eliminations: dict[str, Elimination]
    shared_sines: SharedSines

    @property
    def values(self) -> list[Expr]:
        """Returns what the function `closure` writes; see modeler_closure.h."""
        closure = self.closure
        closure, shared = self.closure, self.shared_sines.values
        loops = [*closure.equations, *closure.others, *closure.alignments]
        return [*loops, *self.pattern.entries, *shared]

    @property
    def equation_count(self) -> int:
        """Returns the number of different equations by which the loops close."""
        return len(self.closure.equations) + len(self.closure.others)

    @property
    def turned_from(self) -> int:
        """Returns the place of the first sine or cosine among the values."""
        return len(self.values) - len(self.shared_sines.values)

    @property
    def symbols(self) -> list[str]:
        """Returns names of the symbols that the functions read besides u."""
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
    """Returns how the loops of a robot are solved in C.

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
        head: eliminate(model, pattern, columns, values) for head, columns in sets.items()
    }
    turns = find_shared_sines(
        model.graph, [*closure.drift, *list_base_entries(model, base).values()]
    )  # those of the equations are among them, or nothing else reads them
    return LoopSolver(closure, pattern, sets, eliminations, turns)


def _build_solving_functions(
    solving: LoopSolver, model: SymbolicModel, base: BaseParameters
) -> list[CFunction]:
    """Returns those of the opened tree that solve the loops, of the free variables as q."""
    closure, turns = solving.closure, solving.shared_sines
    sizes = {"u": len(closure.home), "m": len(closure.equations), "g": len(closure.actuated)}
    sizes |= {"c": base.rank, "nonzeros": len(solving.pattern.entries)}
    sizes |= {"turns": len(turns.values), "values": len(solving.values)}

    def shared(each: Elimination) -> Arguments:
        words = sizes | {"factors": len(each.factors), "couplings": len(each.coupling)}
        return Arguments("", {}, words).extend("solving")

    given = shared(solving.eliminations[""])
    every = [("closure", given, solving.values), ("residual", given, closure.equations)]
    for head, each in solving.eliminations.items():
        values: dict[str, Sequence[Expr]] = {"factor": each.factors, "solve": each.solution}
        values |= {"coupling": [value for _, _, value in each.coupling]}
        values |= {"turned": each.change_bounds, "spread": [each.change_squares]}
        every += [(f"{head}{role}", shared(each), numbers) for role, numbers in values.items()]
    functions = [
        arguments.declare(f"tree_{role}", numbers, row=role.removeprefix(PLATFORM), internal=True)
        for role, arguments, numbers in every
    ]
    entries = build_fused_regressor(model, base, closure.actuated, solving.eliminations[""], turns)
    return [*functions, given.declare("tree_rows", row="rows", entries=entries, internal=True)]


def build_closure_tables(
    model: SymbolicModel, base: BaseParameters, solving: LoopSolver, target: Target
) -> dict[str, Any]:
    """Returns numbers of the closures, as C initialisers.

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
    """The functions of one set of given variables.

    Attributes:
        head: start of the functions' names: "" or "platform_".
        arguments: their arguments; q, qd, qdd are x, xd, xdd for the platform.
    """

    head: str
    arguments: Arguments

    def make_function(self, name: str, row: str = "", **made: Any) -> CFunction:
        """Returns one that closes the loops; `made` as `Closed` says."""
        entry = read_catalogue()["closed"][row or name]
        motion = [self.arguments.words.get(name, name) for name in entry.get("motion", "").split()]
        derivatives = dict(zip(("qd", "qdd"), motion, strict=False))
        made = {"kind": entry["kind"], "reads": entry.get("reads", ""), **derivatives, **made}
        if entry["kind"] not in ("posture", "coupling"):
            made = {"role": name, **made}
        closed = Closed(loops=f"{self.head}loops", q=self.arguments["q"].name, **made)
        return self.arguments.declare(self.head + name, row=row or name, closed=closed)


def build_closed_functions(
    model: SymbolicModel, base: BaseParameters, solving: LoopSolver
) -> tuple[CFunction, ...]:
    """Returns all functions of the module of a robot with loops.

    Internal ones, then the public ones.

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
    public = [*_build_regressors(frame, model, base), *_build_dynamics(frame, model)]
    public += [frame.make_function("inertia_matrix"), frame.make_function("forward_kinematics")]
    public += [
        *_build_postures(frame),
        layout.build_grouping_function(model, base, frame.arguments),
    ]
    for platform in platforms:
        public += [_build_regressors(platform, model, base)[1], _build_dynamics(platform, model)[0]]
        public += _build_postures(platform)
    # Of the opened tree, of u.
    trees = {f.role: f for f in layout.build_tree_functions(model, base)}
    for role in ("base_regressor_nonzeros", "base_parameters"):
        del trees[role]
    arguments = layout.make_arguments(model.robot.free_joints, model, base)
    drift = solving.closure.drift
    opened = arguments.extend("opened", drift=len(drift))
    trees["coriolis"] = _build_tree_coriolis(model, layout.make_beta_symbols(model, base), opened)
    trees["drift"] = opened.declare("drift", drift)
    tree = [dataclasses.replace(f, role=f"tree_{role}", internal=True) for role, f in trees.items()]
    return (*tree, *solving_functions, *public)


def build_closed_dynamics(
    model: SymbolicModel, base: BaseParameters, beta: Mapping[int, Expr]
) -> tuple[tuple[CFunction, ...], tuple[CFunction, ...]]:
    """Returns the functions that read beta: those of the opened tree, and the public ones.

    Args:
        model: as derived.
        base: its base parameters.
        beta: {column: the base parameter that stands for it, or its value}.
    """
    frame, *platforms = _build_coordinate_sets(model, base)
    arguments = layout.make_arguments(model.robot.free_joints, model, base)
    tree = {f.role: f for f in layout.build_dynamics_functions(model, beta, arguments)}
    tree["coriolis"] = _build_tree_coriolis(model, beta, arguments.extend("opened"))
    public = [*_build_dynamics(frame, model), frame.make_function("inertia_matrix")]
    public += [_build_dynamics(platform, model)[0] for platform in platforms]
    return tuple(tree.values()), tuple(public)


def _build_coordinate_sets(model: SymbolicModel, base: BaseParameters) -> list[_CoordinateSet]:
    """The coordinates, then those of the platform if there is one."""
    closure = model.closure
    assert closure is not None
    names = ", ".join(joint.name for joint in model.robot.moving_joints)
    words = {"u": len(closure.home), "rows": len(model.robot.moving_joints), "names": names}
    words |= {name: name for name in ("q", "qd", "qdd", "tau")}
    coordinates = layout.make_arguments(model.robot.coordinates, model, base)
    frames = [_CoordinateSet("", coordinates.extend("closed", **words))]
    if closure.platform is not None:
        joints = [model.robot.free_joints[k] for k in closure.platform]
        words["joints"] = ", ".join(joint.name for joint in joints)
        platform = layout.make_arguments(joints, model, base).extend("platform", **words)
        letters = {"q": "x", "qd": "xd", "qdd": "xdd", "tau": "f"}
        moved = {name: platform[letter] for name, letter in letters.items()}
        forces = dataclasses.replace(platform, specs={**platform.specs, **moved})
        wrench = {name: argument.name for name, argument in moved.items()}
        frames.append(_CoordinateSet(PLATFORM, forces.extend("closed", **wrench)))
    return frames


def _build_tree_coriolis(
    model: SymbolicModel, beta: Mapping[int, Expr], arguments: Arguments
) -> CFunction:
    """Torques of the tree: the passive joints accelerate at qdd = 0 too, their shafts with them."""
    shafts = {
        k: v for k, v in beta.items() if model.columns[k].kind in ("inertial", "rotor_inertia")
    }
    return arguments.declare("coriolis", model.derive_torque(shafts, gravity=False))


def _build_regressors(
    frame: _CoordinateSet, model: SymbolicModel, base: BaseParameters
) -> list[CFunction]:
    standard = frame.make_function("regressor", width=len(model.columns))
    if not frame.head:  # in one block, where the elimination is sparse
        return [standard, frame.make_function("base_regressor", kind="rows", role="rows", reads="")]
    return [standard, frame.make_function("base_regressor", width=base.rank)]


def _build_dynamics(frame: _CoordinateSet, model: SymbolicModel) -> list[CFunction]:
    friction = "friction_of_motion" if layout.needs_more_than_speed(model) else "friction"
    roles = ("inverse_dynamics", "gravity", "coriolis")
    return [*map(frame.make_function, roles), frame.make_function("friction", friction)]


def _build_postures(frame: _CoordinateSet) -> list[CFunction]:
    """Returns closing alone, and G."""
    start = frame.make_function("close_from", start="start")
    return [frame.make_function("close"), start, frame.make_function("coupling")]
