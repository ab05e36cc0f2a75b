"""States that the check of an emitted folder stores, and what every function gives there.

Evaluated in ball arithmetic from the expressions of the model, postures of loops proven to be
closed: nothing of the emitted C takes part, and the numbers are the same on every machine. Inputs
are multiples of powers of 2, so that they are the same in both precisions.
"""

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from contextlib import suppress
from functools import cache
from typing import Any

import numpy as np

from modeler.codegen.closed_control import AtState
from modeler.codegen.functions import CFunction, Closed, name_lines
from modeler.codegen.targets import Target
from modeler.core.errors import EmitError
from modeler.derivation import (
    Ball,
    Closure,
    EnclosedState,
    Enclosures,
    NotEnclosed,
    SymbolicModel,
    ball_function,
    exact_ball,
    flint,
    moved_postures,
)

STATES = 2
PRODUCTS = ("regressor", "base_regressor", "base_regressor_nonzeros", "platform_base_regressor")
"""Functions that are checked by their products with the parameters, which are the torques."""

TURNING = ("fitted_inverse_dynamics", "fitted_friction", "fitted_platform_inverse_dynamics")
"""Functions that read the widths of friction."""

_OTHERWISE = (*PRODUCTS, "base_parameters")
_ROWS = {"rows": "base_regressor"}
_DIRECT = Closed("poses", "", "q")
"""Stands for what a tree's functions are: no loops are closed."""

_BITS = 192
_MANY, _DIGITS, _MANY_BITS = 50, 50, 448
_FINE = 2.0**-14  # rad or m
_REACHES = (0.1, 0.02, 0.004)  # rad, or share of the robot's size; near a singularity, the last
_SEED = 5

Table = list[list[float]]
"""Numbers by state."""

Balls = list[list[Ball]]
"""The same before they are rounded."""


def stored_states(
    model: SymbolicModel, functions: Sequence[CFunction], target: Target, kept: Collection[str]
) -> dict[str, Any]:
    """What the template of the check stores: `tables` by name, and how many `states` they hold.

    Args:
        model: as derived.
        functions: all of the robot, those with fitted values too.
        target: the number type.
        kept: roles of those of the module.

    Raises:
        EmitError: a number is none of the target, or the loops do not close beside home.
    """
    with flint().ctx.workprec(_BITS):
        inputs, balls = _tables(model, functions, STATES)
    expected = {role: [_numbers(row) for row in rows] for role, rows in balls.items()}
    products = {role for role in kept if role in PRODUCTS}
    shown = {*kept} | {
        f"{'platform_' * role.startswith('platform_')}inverse_dynamics" for role in products
    }
    read = {a.name for f in functions if f.role in kept and not f.internal for a in f.inputs}
    read |= {"beta"} if products - {"regressor"} or "base_parameters" in kept else set()
    read |= {"chi"} if "regressor" in kept else set()
    tables = {name: table for name, table in inputs.items() if name in read}
    tables |= {f"at_{role}": table for role, table in expected.items() if role in shown}
    lines = {
        key: name_lines([target.literal(x) for row in rows for x in row])
        for key, rows in tables.items()
    }
    return {"states": STATES, "tables": lines}


def vectors_text(
    prefix: str, model: SymbolicModel, functions: Sequence[CFunction], kept: Collection[str]
) -> str:
    """`vectors.csv`: in each line name, state and numbers of an input, or of what a function gives.

    The last line says how many lines of outputs there are.

    Inputs are exact in both precisions, base parameters too; outputs have 50 digits.

    Args:
        prefix: of the module.
        model: as derived.
        functions: all of the robot, those with fitted values too.
        kept: roles of those of the module.

    Raises:
        EmitError: the loops do not close beside home, or a number has fewer digits.
    """
    lines = []
    with flint().ctx.workprec(_MANY_BITS):
        inputs, expected = _tables(model, functions, _MANY, exact=True)
        read = {a.name for f in functions if f.role in kept and not f.internal for a in f.inputs}
        for state in range(_MANY):
            for name, table in inputs.items():
                if name in read and state < len(table):
                    lines.append(",".join([name, str(state), *map(repr, table[state])]))
            for role, rows in expected.items():
                if role in kept and state < len(rows):
                    lines.append(
                        ",".join([f"{prefix}_{role}", str(state), *map(_digits, rows[state])])
                    )
    outputs = sum(line.startswith(f"{prefix}_") for line in lines)
    return "".join(f"{line}\n" for line in [*lines, f"outputs,{outputs}"])


def _digits(x: Ball) -> str:
    if x.contains(0):
        return "0"
    if x.rel_accuracy_bits() < _DIGITS / math.log10(2) + 1:
        raise EmitError(
            f"a number of the vectors is known as {x} only; fewer than {_DIGITS} digits"
        )
    return str(x.str(_DIGITS, radius=False))


def _inputs(model: SymbolicModel, states: int) -> dict[str, Table]:
    """Numbers of order 1, none of them 0; then slow, where friction turns."""
    coordinates = len(model.robot.coordinates)

    def table(length: int, number: Callable[[int, int], float]) -> Table:
        return [[number(i, state) for i in range(length)] for state in range(states)]

    def spread(factor: int, per: float) -> Callable[[int, int], float]:
        return lambda i, state: ((factor * i + 7 * state + 3) % 23 - 11.5 + state // 23 / 4) * per

    def speed(i: int, state: int) -> float:
        return (-1) ** (i + state) * (1 + (5 * i + 3 * state) % 13 / 16) / 64 ** (state % 3)

    return {
        "q": table(coordinates, spread(11, 1 / 8)),
        "qd": table(coordinates, speed),
        "qdd": table(coordinates, spread(5, 1 / 4)),
        "v": table(coordinates, lambda i, state: speed(i + 2, state)),
        "a": table(coordinates, spread(9, 1 / 4)),
        "tau": table(coordinates, spread(13, 2.0)),
        "damping": table(1, lambda i, state: (state % 7 + 1) / 8),
        "s": table(len(model.signals), lambda i, state: (i + 1 + 2 * state) / 16),
        "dq": table(coordinates, spread(3, 1 / 512)),
        "dt": table(1, lambda i, state: (state + 1) / 256),
        # Inertias of bodies that can be: their matrix is positive definite.
        "chi": [
            [
                1 + (40503 * k + 977) % 4096 / 4096 + 32 * name.startswith(("XX", "YY", "ZZ"))
                for k, name in enumerate(model.names)
            ]
        ],
    }


def _tables(
    model: SymbolicModel, functions: Iterable[CFunction], states: int, exact: bool = False
) -> tuple[dict[str, Table], dict[str, Balls]]:
    """Inputs by name, and by role what the functions give there.

    Args:
        model: as derived.
        functions: of the module.
        states: how many.
        exact: base parameters have few digits, and every function is evaluated; else they follow
            from `chi`, and those that are checked by their products are left out.
    """
    roles = {f.role: f for f in functions}
    # A double counts as the decimal that it prints, which is what was written.
    symbols = {name: flint().arb(repr(x)) for name, x in model.geometry.values.items()}

    @cache
    def steps(role: str) -> Callable[[Mapping[str, Ball]], list[Ball]]:
        values = [value for _, value in roles[role].entries]
        return ball_function(values[0].graph if values else model.graph, values, symbols)

    def outputs(role: str, values: Mapping[str, Ball]) -> list[Ball]:
        out = [exact_ball(0)] * roles[role].output.size
        for (place, _), x in zip(roles[role].entries, steps(role)(values), strict=True):
            out[place] = x
        return out

    inputs, closure = _inputs(model, states), model.closure
    smooth = [a.size for f in functions for a in f.inputs if a.name == "widths"]
    inputs["widths"] = [[0.0] * size for size in smooth[:1]] * states  # then signs leap
    chi = _named(chi=inputs["chi"][0])
    found = outputs("base_parameters", chi)
    beta = [exact_ball(_fine(float(x))) for x in found] if exact else found
    constants = chi | {f"beta[{i}]": x for i, x in enumerate(beta)}
    inputs["beta"] = [_numbers(beta)]
    sets: dict[str, tuple[int, ...]] = {"q": ()}
    postures = [np.array(q) for q in inputs["q"]]
    if closure is not None:
        postures = _postures(model, closure, symbols, states)
        sets = {"q": closure.given} | ({"x": closure.platform} if closure.platform else {})
        for name, places in sets.items():
            inputs[name] = [[_fine(x) for x in u[list(places)]] for u in postures]
        inputs["xd"], inputs["xdd"] = inputs["qd"], inputs["qdd"]
        inputs["start"] = [u.tolist() for u in postures[::-1]]
    expected: dict[str, Balls] = {"base_parameters": [found]} if exact else {}
    left = ("base_parameters",) if exact else _OTHERWISE
    for name, places in sets.items():
        enclosures = Enclosures(model, symbols, places)
        for k, near in enumerate(postures):
            u = near if closure is None else _closed(closure, near, places, inputs[name][k])
            qd, qdd = np.array(inputs["qd"][k]), np.array(inputs["qdd"][k])
            moving, standing = (enclosures.state(u, qd, a) for a in (qdd, 0.0 * qdd))
            signals = _named(**{each: inputs[each][k] for each in ("s", "dq", "dt", "v", "a")})
            for role, f in roles.items():
                c = f.closed or _DIRECT
                if f.internal or role in left or c.q != name:
                    continue
                if f.composed:
                    own = {**constants, **signals, **_named(tau=inputs["tau"][k]), **moving.inputs}
                    if isinstance(f.composed, AtState):
                        made = _carried(f.composed, own, _Carrying(enclosures, u, qd), outputs)
                    else:
                        made = _solved(f, own, _named(damping=inputs["damping"][k]), outputs)
                    expected.setdefault(role, []).extend([made] if made else [])
                    continue
                state = standing if c.qdd == "standing" else moving
                tree = role if not f.closed else f"{c.tree}_{_ROWS.get(c.kind, c.role)}"
                given = {**constants, **signals, **state.inputs}
                out = outputs(tree, given) if tree in roles else []
                expected.setdefault(role, []).append(_made(c.kind, state, out))
    # Where a matrix is not positive definite, its functions have no number.
    return inputs, {
        role: rows
        for role, rows in expected.items()
        if len(rows) == (1 if role == "base_parameters" else states)
    }


def _solved(
    f: CFunction,
    given: Mapping[str, Ball],
    damping: Mapping[str, Ball],
    outputs: Callable[[str, Mapping[str, Ball]], list[Ball]],
) -> list[Ball]:
    """Output of a function that solves with the inertia matrix; [] where that has no meaning."""
    assert f.composed is not None
    head = "fitted_" * f.role.startswith("fitted_")
    M = outputs(f"{head}inertia_matrix", given)
    n, matrix = math.isqrt(len(M)), flint().arb_mat
    pivots = np.linalg.eigvalsh(np.reshape(_numbers(M), (n, n)))
    if f.composed.turns > 1 or pivots[0] < 1e-6 * pivots[-1]:
        return []
    inverse = matrix(n, n, M).inv()
    if f.composed.kind.startswith("operational"):
        J = matrix(6, n, outputs("jacobian", given))
        square = damping["damping[0]"] * damping["damping[0]"]
        add = matrix(6, 6, [square if i % 7 == 0 else exact_ball(0) for i in range(36)])
        L = (J * inverse * J.transpose() + add).inv()
        return list((L if f.output.name == "L" else inverse * J.transpose() * L).entries())
    still = {**given, **{f"qdd[{j}]": exact_ball(0) for j in range(n)}}
    rest = outputs(f"{head}inverse_dynamics", still)
    qdd = (inverse * matrix(n, 1, [given[f"tau[{j}]"] - x for j, x in enumerate(rest)])).entries()
    if f.composed.kind == "forward_dynamics":
        return list(qdd)
    moving = {**given, **{f"qdd[{j}]": x for j, x in enumerate(qdd)}}
    slopes = outputs(f"{head}derivatives", moving)
    parts = [matrix(n, n, [-x for x in slopes[k : k + n * n]]) for k in (0, n * n)]
    return [x for part in parts for x in (inverse * part).entries()] + list(inverse.entries())


class _Carrying:
    """What a state of the opened tree is made of: G, its rate, and gamma, udd at qdd = 0."""

    def __init__(self, enclosures: Enclosures, u: np.ndarray, qd: np.ndarray) -> None:
        matrix, n, g = flint().arb_mat, len(u), len(qd)
        states = [enclosures.state(u, speed, 0.0 * qd) for speed in _polar(qd)]
        self.G = matrix(states[0].coupling)
        # gamma is a square of the speeds, dG/dt v a product of two of them.
        own, *others = [[state.inputs[f"qdd[{k}]"] for k in range(n)] for state in states]
        self.gamma = matrix(n, 1, own)
        ahead, behind = others[:g], others[g:]
        rate = [(ahead[j][k] - behind[j][k]) / 4 for k in range(n) for j in range(g)]
        self.rate = matrix(n, g, rate)


def _polar(qd: np.ndarray) -> Iterable[np.ndarray]:
    return (qd, *(qd + unit for unit in np.eye(len(qd))), *(qd - unit for unit in np.eye(len(qd))))


def _carried(
    made: AtState,
    given: Mapping[str, Ball],
    by: _Carrying,
    outputs: Callable[[str, Mapping[str, Ball]], list[Ball]],
) -> list[Ball]:
    """Output of a controller's function of closed loops; [] where that has no number here."""
    n, g, matrix = by.G.nrows(), by.G.ncols(), flint().arb_mat

    def tree(role: str, rows: int, values: Mapping[str, Ball] = given) -> Ball:
        out = outputs(role, values)
        return matrix(rows, len(out) // rows, out)

    def column(name: str, rows: int = g) -> Ball:
        return matrix(rows, 1, [given[f"{name}[{k}]"] for k in range(rows)])

    back, form, role = by.G.transpose(), made.form, made.roles.get("made", "")
    beside = made.roles.get("beside", "")
    if form == "fitted":
        return []
    if form == "rate":
        return list(by.rate.entries())
    if form == "direct":
        return outputs(role, given)
    if form.startswith("jacobian"):
        J = tree(beside, 6)
        found = J * by.G if form == "jacobian" else tree(role, 6) + J * by.gamma
    elif form == "forward_dynamics":
        head = "fitted_" * made.roles["matrix"].startswith("fitted_")
        M = back * tree(f"{head}tree_inertia_matrix", n) * by.G
        pivots = np.linalg.eigvalsh(np.reshape(_numbers(M.entries()), (g, g)))
        if pivots[0] < 1e-6 * pivots[-1]:
            return []
        still = {f"qdd[{k}]": x for k, x in enumerate(by.gamma.entries())}
        bias = back * tree(f"{head}tree_inverse_dynamics", n, {**given, **still})
        found = M.inv() * (column("tau") - bias)
    elif form == "slotine_li":
        v, a = by.G * column("v"), by.G * column("a") + by.rate * column("v")
        own = {f"{x}[{k}]": y for x, ys in (("v", v), ("a", a)) for k, y in enumerate(ys.entries())}
        found = back * tree(role, n, {**given, **own})
    elif form == "coriolis_matrix":
        found = back * (tree(role, n) * by.G + tree(beside, n) * by.rate)
    else:
        found = back * tree(role, n)
        if form == "coriolis_transpose":
            found += by.rate.transpose() * tree(beside, n)
        elif form == "momentum_rest":
            found -= by.rate.transpose() * tree(beside, n)
    return list(found.entries())


def _made(kind: str, state: EnclosedState, out: list[Ball]) -> list[Ball]:
    """Output of a function of that kind, row-major, from that of the tree; see `Closed`."""
    G = flint().arb_mat(state.coupling)
    if kind == "posture":
        return [state.inputs[f"q[{k}]"] for k in range(G.nrows())]
    if kind == "coupling":
        return list(G.entries())
    if kind == "poses":
        return out
    rows = G.transpose() * flint().arb_mat(G.nrows(), len(out) // G.nrows(), out)
    return list((rows * G if kind == "inertia_matrix" else rows).entries())


def _postures(
    model: SymbolicModel, closure: Closure, symbols: Mapping[str, Ball], states: int
) -> list[np.ndarray]:
    """Closed postures around home, their coordinates rounded."""
    enclosures = Enclosures(model, symbols)
    home, given = np.array(closure.home), list(closure.given)
    for reach in _REACHES:
        random = np.random.default_rng(_SEED)
        near = moved_postures(closure, home, random, states, reach)
        with suppress(NotEnclosed):
            found = [_closed(closure, u, given, [_fine(x) for x in u[given]]) for u in near]
            return [np.array([float(x) for x in enclosures.posture(u)]) for u in found]
    raise EmitError(f"{model.robot.name}: the loops do not close beside home; state another home")


def _closed(
    closure: Closure, near: np.ndarray, places: Sequence[int], given: Sequence[float]
) -> np.ndarray:
    """The closed posture next to `near` with these variables given; NaN if there is none."""
    u = near.copy()
    u[list(places)] = given
    solved = [k for k in range(len(u)) if k not in places]
    return closure.closed(u[None], solved)[0]


def _named(**arrays: Sequence[float]) -> dict[str, Ball]:
    return {f"{name}[{k}]": exact_ball(x) for name, xs in arrays.items() for k, x in enumerate(xs)}


def _fine(x: float) -> float:
    return float(round(x / _FINE) * _FINE)


def _numbers(balls: Sequence[Ball]) -> list[float]:
    return [0.0 if x.contains(0) else float(x) for x in balls]
