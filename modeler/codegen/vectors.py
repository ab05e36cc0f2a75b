"""States that the check of an emitted folder stores, and what every function gives there.

Evaluated with 40 digits from the expressions of the model, loops closed by Newton on their
equations: nothing of the emitted C takes part, and the numbers are the same on every machine.
Inputs are multiples of powers of 2, so that they are the same in both precisions.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from modeler.base.result import BaseParameters
from modeler.codegen.functions import Function
from modeler.codegen.layout import name_lines, output_size
from modeler.core.errors import EmitError
from modeler.core.rounded import precise
from modeler.symbolic import Closure, SymbolicModel
from modeler.symbolic.precise import decimal, precise_values

STATES = 2
_REGRESSORS = ("regressor", "base_regressor", "base_regressor_nonzeros", "platform_base_regressor")
"""Checked by their products with the parameters, which are the torques."""
_TURNING = ("fitted_inverse_dynamics", "fitted_friction", "fitted_platform_inverse_dynamics")
"""Read the widths of friction."""

_ZERO = 1e-25  # below: cancelled
_FINE = 2.0**-14  # rad or m
_REACH = 0.1  # rad, or share of the robot's size

Values = Mapping[str, Any]
Table = list[list[Any]]
"""Numbers by state."""


def stored_states(
    model: SymbolicModel, base: BaseParameters, functions: Sequence[Function]
) -> dict[str, Any]:
    """What the template of the check stores: `inputs` and `expected` tables, and `calls`.

    Args:
        model: as derived.
        base: its base parameters.
        functions: of the module, those with fitted values too.
    """
    inputs = _inputs(model, functions)
    roles = {function.role: function for function in functions}
    constants = {**model.geometry.values}
    constants |= {f"chi[{k}]": x for k, x in enumerate(inputs["chi"][0])}
    beta = _outputs(model, roles["base_parameters"], constants)
    constants |= {f"beta[{k}]": x for k, x in enumerate(beta)}
    inputs["beta"] = [beta]
    given = _of_tree if model.closure is None else _of_loops
    expected = given(model, roles, inputs, constants)
    public = [f for f in functions if not f.internal]
    public.sort(key=lambda f: (f.role in _REGRESSORS, f.role != "base_parameters"))
    read = {argument.name for f in public for argument in f.inputs}
    return {
        "states": STATES,
        "inputs": [(name, _lines(table)) for name, table in inputs.items() if name in read],
        "expected": [(role, _lines(table)) for role, table in expected.items()],
        "largest": max(output_size(f.output) for f in public),
        "calls": [
            {
                "role": f.role,
                "inputs": [(a.name, (len(inputs[a.name]) > 1) * a.shape[0]) for a in f.inputs],
                "shape": f.output.shape[:2],
                "length": output_size(f.output),
                "states": 1 if f.role == "base_parameters" else STATES,
                "status": f.closed is not None,
                "taken": "WIDE" if f.role in _TURNING else "REPLACED",
                "product": f.role in _REGRESSORS,
                "parameters": "chi" if f.role == "regressor" else "beta",
                "head": "platform_" if f.role.startswith("platform_") else "",
            }
            for f in public
        ],
    }  # fmt: skip


def _lines(table: Table) -> list[str]:
    numbers = [float(x) for row in table for x in row]
    return name_lines([f"{x:.16g}" if "." in f"{x:.16g}" else repr(x) for x in numbers])


def _inputs(model: SymbolicModel, functions: Sequence[Function]) -> dict[str, Table]:
    """Numbers of order 1, none of them 0; then slow, where friction turns."""
    coordinates = len(model.robot.coordinates)

    def table(length: int, number: Callable[[int, int], float]) -> Table:
        return [[number(i, state) for i in range(length)] for state in range(STATES)]

    def spread(factor: int, per: float) -> Callable[[int, int], float]:
        return lambda i, state: ((factor * i + 7 * state + 3) % 23 - 11.5) * per

    def speed(i: int, state: int) -> float:
        return (-1) ** (i + state) * (1 + (5 * i + 3 * state) % 13 / 16) / 64**state

    return {
        "q": table(coordinates, spread(11, 1 / 8)),
        "qd": table(coordinates, speed),
        "qdd": table(coordinates, spread(5, 1 / 4)),
        "s": table(len(model.signals), lambda i, state: (i + 1 + 2 * state) / 16),
        "dq": table(coordinates, spread(3, 1 / 512)),
        "dt": table(1, lambda i, state: (state + 1) / 256),
        "chi": [[1 + (40503 * k + 977) % 4096 / 4096 for k in range(len(model.columns))]],
    }


def _outputs(model: SymbolicModel, function: Function, values: Values) -> list[Any]:
    """All entries of the output, row-major."""
    out = [precise().zero] * output_size(function.output)
    found = precise_values(model.graph, [value for _, value in function.entries], values)
    for (place, _), number in zip(function.entries, found, strict=True):
        out[place] = number if abs(number) > _ZERO else precise().zero
    return out


def _named(**arrays: Sequence[Any]) -> dict[str, Any]:
    return {f"{name}[{k}]": x for name, array in arrays.items() for k, x in enumerate(array)}


def _of_tree(
    model: SymbolicModel, roles: Mapping[str, Function], inputs: dict[str, Table], constants: Values
) -> dict[str, Table]:
    names = ("q", "qd", "qdd", "s", "dq", "dt")
    states = [
        {**constants, **_named(**{name: inputs[name][k] for name in names})} for k in range(STATES)
    ]
    return {
        role: [_outputs(model, function, state) for state in states]
        for role, function in roles.items()
        if role not in (*_REGRESSORS, "base_parameters")
    }


def _of_loops(
    model: SymbolicModel, roles: Mapping[str, Function], inputs: dict[str, Table], constants: Values
) -> dict[str, Table]:
    closure = model.closure
    assert closure is not None
    ways = {r: f.closed for r, f in roles.items() if f.closed and r not in _REGRESSORS}
    found: dict[str, Table] = {role: [] for role in ways}
    postures = [_near_home(model, closure, state) for state in range(STATES)]
    inputs["q"] = [[u[k] for k in closure.given] for u in postures]
    sets = {"q": closure.given}
    if closure.platform is not None:
        sets["x"] = closure.platform
        inputs["x"] = [[_fine(u[k]) for k in closure.platform] for u in postures]
        inputs["xd"], inputs["xdd"] = inputs["qd"], inputs["qdd"]
    inputs["start"] = postures[::-1]
    for name, places in sets.items():
        for state, near in enumerate(postures):
            u = _closed(model, closure, places, inputs[name][state], near)
            motion = _Motion(model, closure, places, u, constants)
            given: dict[str, Any] = {"": None, "standing": [0.0] * len(places)}
            given |= {key: table[state] for key, table in inputs.items() if len(table) > 1}
            for role, c in ways.items():
                if c.q == name:
                    tree = roles.get(f"{c.tree}_{c.role}")
                    found[role].append(motion.output(c.kind, tree, given[c.qd], given[c.qdd]))
    return found


def _fine(x: Any) -> float:
    return float(round(float(x) / _FINE) * _FINE)


def _near_home(model: SymbolicModel, closure: Closure, state: int) -> list[Any]:
    """A closed posture beside home, in its assembly mode."""
    scale = [closure.size if long else 1.0 for long in closure.lengths]
    for share in (1.0, 0.25, 0.0625, 2.0**-6, 2.0**-8):
        q = [
            _fine(closure.home[k] + share * _REACH * scale[k] * (0.5 + (5 * i + 2 * state) % 7 / 14)
                  * (-1) ** (i + i // 3 + state))
            for i, k in enumerate(closure.given)
        ]  # fmt: skip
        u = _closed(model, closure, closure.given, q, closure.home)
        moved = [abs(x - h) / s for x, h, s in zip(u, closure.home, scale, strict=True)]
        if max(moved) < 10 * share * _REACH:
            return u
    raise EmitError(f"{model.robot.name}: the loops do not close beside home; state another home")


def _slopes(closure: Closure, places: Sequence[int]) -> list[Any]:
    return [row[k] for row in closure.jacobian for k in places]


def _closed(
    model: SymbolicModel, closure: Closure, places: Sequence[int], given: Sequence[Any],
    start: Sequence[Any],
) -> list[Any]:  # fmt: skip
    """The closed posture next to `start` with these variables given; infinite if there is none."""
    mp, u = precise(), [decimal(x) for x in start]
    for k, x in zip(places, given, strict=True):
        u[k] = decimal(x)
    solved = [k for k in range(len(u)) if k not in places]
    for _ in range(40):
        values = {**model.geometry.values, **_named(q=u)}
        f = np.array(precise_values(model.graph, closure.equations, values), dtype=float)
        near = {name: float(x) for name, x in values.items()}
        J = np.array(model.graph.evaluate(_slopes(closure, solved), near), dtype=float)
        # The step is good to a double, what is left is known to 40 digits: so it goes on shrinking.
        try:
            step = np.linalg.solve(J.reshape(len(solved), len(solved)), f)
        except np.linalg.LinAlgError:
            break
        for k, change in zip(solved, step, strict=True):
            u[k] -= float(change)
        if not np.all(np.abs(step) < 1e3):
            break
        if np.max(np.abs(step)) < _ZERO:
            return u
    return [mp.inf] * len(u)


class _Motion:
    """What the loops make of the motion of the given variables, at one closed posture."""

    def __init__(
        self, model: SymbolicModel, closure: Closure, places: Sequence[int], u: Sequence[Any],
        constants: Values,
    ) -> None:  # fmt: skip
        self._model, self._drift, self.u = model, closure.drift, u
        self._solved = [k for k in range(len(u)) if k not in places]
        self._values = {**constants, **_named(q=u)}
        found = precise_values(model.graph, _slopes(closure, range(len(u))), self._values)
        J = [found[i : i + len(u)] for i in range(0, len(found), len(u))]
        self._inverse = _inverse([[row[k] for k in self._solved] for row in J])
        along = _product(self._inverse, [[-row[k] for k in places] for row in J])
        self.G = [[precise().mpf(k == p) for p in places] for k in range(len(u))]
        for k, row in zip(self._solved, along, strict=True):
            self.G[k] = row

    def output(
        self, kind: str, tree: Function | None, qd: Sequence[Any] | None, qdd: Sequence[Any] | None
    ) -> list[Any]:
        """What a function of that kind gives, row-major; see `functions.Closed`."""
        if kind == "posture":
            return list(self.u)
        if kind == "coupling":
            return _flat(self.G)
        assert tree is not None
        values = self._values
        if qd is not None and qdd is not None:
            ud, udd = (
                [x for [x] in _product(self.G, [[decimal(y)] for y in x])] for x in (qd, qdd)
            )
            values = {**values, **_named(qd=ud)}
            drift = precise_values(self._model.graph, self._drift, values)
            changes = _product(self._inverse, [[x] for x in drift])
            for k, [change] in zip(self._solved, changes, strict=True):
                udd[k] -= change
            values |= _named(qdd=udd)
        out = _outputs(self._model, tree, values)
        if kind == "poses":
            return out
        width, across = len(out) // len(self.u), list(zip(*self.G, strict=True))
        rows = _product(across, [out[i : i + width] for i in range(0, len(out), width)])
        return _flat(_product(rows, self.G) if kind == "inertia_matrix" else rows)


def _product(A: Sequence[Sequence[Any]], B: Sequence[Sequence[Any]]) -> Table:
    columns = list(zip(*B, strict=True))
    return [[precise().fdot(row, column) for column in columns] for row in A]


def _inverse(A: Table) -> Table:
    """By Gauss and Jordan, rows exchanged: mpmath's own takes fifty times as long."""
    n = len(A)
    rows = [[*row, *(precise().mpf(i == k) for k in range(n))] for i, row in enumerate(A)]
    for j in range(n):
        pivot = max(range(j, n), key=lambda i: abs(rows[i][j]))
        rows[j], rows[pivot] = rows[pivot], rows[j]
        rows[j] = [x / rows[j][j] for x in rows[j]]
        for i in range(n):
            share = rows[i][j]
            if i != j and share:
                rows[i] = [x - share * y for x, y in zip(rows[i], rows[j], strict=True)]
    return [row[n:] for row in rows]


def _flat(rows: Table) -> list[Any]:
    return [x if abs(x) > _ZERO else precise().zero for row in rows for x in row]
