"""What the emitted code solves the loops with: functions of the opened tree, and tables."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from modeler.base.result import BaseParameters
from modeler.codegen import layout
from modeler.codegen.elimination import (
    Elimination,
    Pattern,
    elimination,
    pattern_of,
    sampled_jacobians,
)
from modeler.codegen.functions import Function, entries_of
from modeler.codegen.fused import Turns, base_columns, fused_regressor, turns_of
from modeler.core.contract import ArgumentSpec
from modeler.symbolic import Closure, Expr, SymbolicModel

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
    functions: tuple[Function, ...]

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
) -> Function:  # fmt: skip
    return Function("", f"tree_{role}", does, equation, tuple(inputs), output,
                    entries_of(entries), internal=True)  # fmt: skip


def _equations(solving: Solving) -> list[Function]:
    closure = solving.closure
    u = _array("q", len(closure.home), "free variables of the opened tree")
    values, f = solving.values, closure.equations
    return [
        _function("closure", "All equations of all loops, cosines, nonzeros of df/du, turns.",
                  "f(u) = 0", [u], _array("values", len(values), "as modeler_closure.h"), values),
        _function("residual", "The independent equations.", "f(u) = 0", [u],
                  _array("f", len(f), "equations"), f),
    ]  # fmt: skip


def _eliminations(solving: Solving, head: str, own: Elimination) -> list[Function]:
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


def _rows(solving: Solving, model: SymbolicModel, base: BaseParameters) -> Function:
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
    return Function(
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
