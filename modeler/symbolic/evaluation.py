"""Values of expressions by steps that are listed once: closing loops asks hundreds of times."""

import operator
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from modeler.symbolic.graph import Node

_FUNCTIONS: dict[str, Callable[..., Any]] = {
    "sin": np.sin, "cos": np.cos, "tan": np.tan, "sqrt": np.sqrt,
    "exp": np.exp, "abs": np.abs, "sign": np.sign, "tanh": np.tanh, "pow": np.power,
    "add": operator.add, "mul": operator.mul, "div": operator.truediv,
}  # fmt: skip

_ALONE = -1
"""In place of the second argument of a function of one."""


class Plan:
    """Outputs as a function of numbers, or arrays of samples, for the symbols."""

    def __init__(self, nodes: Sequence["Node"], needed: Sequence[int], refs: Sequence[int]) -> None:
        """Steps for the references `refs` of a graph.

        Args:
            nodes: of the graph.
            needed: those that the references need, arguments first.
            refs: what is asked for.
        """
        place = {0: 0} | {index: k for k, index in enumerate(needed, start=1)}
        self._start: list[Any] = [0.0] * len(place)
        self._inputs: list[tuple[int, str]] = []
        self._steps: list[tuple[int, Callable[..., Any], int, int]] = []
        for index in needed:
            node, at = nodes[index], place[index]
            if node.op == "num":
                self._start[at] = float(node.args[0])
            elif node.op == "pi":
                self._start[at] = np.pi
            elif node.op == "sym":
                self._inputs.append((at, node.args[0]))
            else:
                a, b = (*node.args, None)[:2]
                second = _ALONE if b is None else place[abs(b)]
                self._steps.append((at, _signed(node.op, a, b), place[abs(a)], second))
        self._outputs = [(place[abs(ref)], ref < 0) for ref in refs]

    def __call__(self, values: Mapping[str, Any]) -> list[Any]:
        """The outputs; `values` by name."""
        found = self._start.copy()
        for at, name in self._inputs:
            found[at] = values[name]
        for at, step, a, b in self._steps:
            found[at] = step(found[a]) if b == _ALONE else step(found[a], found[b])
        return [-found[at] if negative else found[at] for at, negative in self._outputs]


def _signed(op: str, a: int, b: int | None) -> Callable[..., Any]:
    """The operation on the values of the nodes of a and b, with the signs that these have."""
    call = _FUNCTIONS[op]
    if b is None:
        return call if a >= 0 else lambda x: call(-x)
    if a >= 0 and b >= 0:
        return call
    if op == "add" and a >= 0:
        return operator.sub
    if op == "add" and b >= 0:
        return lambda x, y: y - x
    return lambda x, y: call(x if a >= 0 else -x, y if b >= 0 else -y)
