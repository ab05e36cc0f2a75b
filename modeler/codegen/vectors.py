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

from modeler.codegen.block import Target
from modeler.codegen.control import AtState
from modeler.codegen.functions import CFunction, Closed, wrap_names
from modeler.codegen.thresholds import THRESHOLDS
from modeler.core.errors import EmitError
from modeler.derivation import (
    Ball,
    Closure,
    EnclosedState,
    EnclosureError,
    Enclosures,
    SymbolicModel,
    build_ball,
    build_ball_function,
    draw_nearby_postures,
    load_flint,
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

_MANY, _DIGITS, _MANY_BITS = 50, 50, 448
_SEED = 5

Table = list[list[float]]
"""Numbers by state."""

Balls = list[list[Ball]]
"""The same before they are rounded."""


def build_stored_states(
    model: SymbolicModel, functions: Sequence[CFunction], target: Target, roles: Collection[str]
) -> dict[str, Any]:
    """Returns what the template of the check stores.

    `tables` by name, and how many `states` they hold.

    Args:
        model: as derived.
        functions: all of the robot, those with fitted values too.
        target: the number type.
        roles: roles of those of the module.

    Raises:
        EmitError: a number is none of the target, or the loops do not close beside home.
    """
    with load_flint().ctx.workprec(THRESHOLDS.state_bits):
        inputs, balls = _evaluate_tables(model, functions, STATES)
    expected = {role: [_round_balls(row) for row in rows] for role, rows in balls.items()}
    products = {role for role in roles if role in PRODUCTS}
    heads = (f"{'platform_' * role.startswith('platform_')}" for role in products)
    shown = {*roles, *(f"{head}inverse_dynamics" for head in heads)}
    read = {a.name for f in functions if f.role in roles and not f.internal for a in f.inputs}
    read |= {"beta"} if products - {"regressor"} or "base_parameters" in roles else set()
    read |= {"chi"} if "regressor" in roles else set()
    tables = {name: table for name, table in inputs.items() if name in read}
    tables |= {f"at_{role}": table for role, table in expected.items() if role in shown}
    lines = {
        key: wrap_names([target.format_literal(x) for row in rows for x in row])
        for key, rows in tables.items()
    }
    return {"states": STATES, "tables": lines}


def format_vectors(
    prefix: str, model: SymbolicModel, functions: Sequence[CFunction], roles: Collection[str]
) -> str:
    """Returns `vectors.csv`.

    In each line name, state and numbers of an input, or of what a function gives.

    The last line says how many lines of outputs there are.

    Inputs are exact in both precisions, base parameters too; outputs have 50 digits.

    Args:
        prefix: of the module.
        model: as derived.
        functions: all of the robot, those with fitted values too.
        roles: roles of those of the module.

    Raises:
        EmitError: the loops do not close beside home, or a number has fewer digits.
    """
    lines = []
    with load_flint().ctx.workprec(_MANY_BITS):
        inputs, expected = _evaluate_tables(model, functions, _MANY, exact=True)
        read = {a.name for f in functions if f.role in roles and not f.internal for a in f.inputs}
        for state in range(_MANY):
            for name, table in inputs.items():
                if name in read and state < len(table):
                    lines.append(",".join([name, str(state), *map(repr, table[state])]))
            for role, rows in expected.items():
                if role in roles and state < len(rows):
                    numbers = map(_format_digits, rows[state])
                    lines.append(",".join([f"{prefix}_{role}", str(state), *numbers]))
    outputs = sum(line.startswith(f"{prefix}_") for line in lines)
    return "".join(f"{line}\n" for line in [*lines, f"outputs,{outputs}"])


def _format_digits(x: Ball) -> str:
    if x.contains(0):
        return "0"
    if x.rel_accuracy_bits() < _DIGITS / math.log10(2) + 1:
        raise EmitError(
            f"a number of the vectors is known as {x} only; fewer than {_DIGITS} digits"
        )
    return str(x.str(_DIGITS, radius=False))


def _make_inputs(model: SymbolicModel, states: int) -> dict[str, Table]:
    """Numbers of order 1, none of them 0; then slow, where friction turns."""
    coordinates = len(model.robot.coordinates)

    def make_table(length: int, number: Callable[[int, int], float]) -> Table:
        return [[number(i, state) for i in range(length)] for state in range(states)]

    def spread(factor: int, per: float) -> Callable[[int, int], float]:
        return lambda i, state: ((factor * i + 7 * state + 3) % 23 - 11.5 + state // 23 / 4) * per

    def make_speed(i: int, state: int) -> float:
        return (-1) ** (i + state) * (1 + (5 * i + 3 * state) % 13 / 16) / 64 ** (state % 3)

    return {
        "q": make_table(coordinates, spread(11, 1 / 8)),
        "qd": make_table(coordinates, make_speed),
        "qdd": make_table(coordinates, spread(5, 1 / 4)),
        "v": make_table(coordinates, lambda i, state: make_speed(i + 2, state)),
        "a": make_table(coordinates, spread(9, 1 / 4)),
        "tau": make_table(coordinates, spread(13, 2.0)),
        "damping": make_table(1, lambda i, state: (state % 7 + 1) / 8),
        "s": make_table(len(model.signals), lambda i, state: (i + 1 + 2 * state) / 16),
        "dq": make_table(coordinates, spread(3, 1 / 512)),
        "dt": make_table(1, lambda i, state: (state + 1) / 256),
        "elastic": make_table(
            2 * len(model.windups), lambda i, state: 512.0 if i < len(model.windups) else 1.0
        ),
        # Inertias of bodies that can be: their matrix is positive definite.
        "chi": [
            [
                1 + (40503 * k + 977) % 4096 / 4096 + 32 * name.startswith(("XX", "YY", "ZZ"))
                for k, name in enumerate(model.names)
            ]
        ],
    }


def _evaluate_tables(
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
    symbols = {name: load_flint().arb(repr(x)) for name, x in model.geometry.values.items()}

    @cache
    def get_steps(role: str) -> Callable[[Mapping[str, Ball]], list[Ball]]:
        values = [value for _, value in roles[role].entries]
        return build_ball_function(values[0].graph if values else model.graph, values, symbols)

    def evaluate_outputs(role: str, values: Mapping[str, Ball]) -> list[Ball]:
        out = [build_ball(0)] * roles[role].output.size
        for (place, _), x in zip(roles[role].entries, get_steps(role)(values), strict=True):
            out[place] = x
        return out

    inputs, closure = _make_inputs(model, states), model.closure
    smooth = [a.size for f in functions for a in f.inputs if a.name == "widths"]
    inputs["widths"] = [[0.0] * size for size in smooth[:1]] * states  # then signs leap
    chi = _name_entries(chi=inputs["chi"][0])
    base_values = evaluate_outputs("base_parameters", chi)
    beta = [build_ball(_round_fine(float(x))) for x in base_values] if exact else base_values
    constants = chi | {f"beta[{i}]": x for i, x in enumerate(beta)}
    inputs["beta"] = [_round_balls(beta)]
    sets: dict[str, tuple[int, ...]] = {"q": ()}
    postures = [np.array(q) for q in inputs["q"]]
    if closure is not None:
        postures = _sample_postures(model, closure, symbols, states)
        sets = {"q": closure.actuated} | ({"x": closure.platform} if closure.platform else {})
        for name, places in sets.items():
            inputs[name] = [[_round_fine(x) for x in u[list(places)]] for u in postures]
        inputs["xd"], inputs["xdd"] = inputs["qd"], inputs["qdd"]
        inputs["start"] = [u.tolist() for u in postures[::-1]]
    expected: dict[str, Balls] = {"base_parameters": [base_values]} if exact else {}
    left = ("base_parameters",) if exact else _OTHERWISE
    for name, places in sets.items():
        enclosures = Enclosures(model, symbols, places)
        for k, near in enumerate(postures):
            u = near if closure is None else _close_posture(closure, near, places, inputs[name][k])
            qd, qdd = np.array(inputs["qd"][k]), np.array(inputs["qdd"][k])
            moving, standing = (enclosures.enclose_state(u, qd, a) for a in (qdd, 0.0 * qdd))
            signals = _name_entries(
                **{each: inputs[each][k] for each in ("s", "dq", "dt", "v", "a", "elastic")}
            )
            for role, f in roles.items():
                c = f.closed or _DIRECT
                if f.internal or role in left or c.q != name:
                    continue
                if f.composed:
                    known = {
                        **constants,
                        **signals,
                        **_name_entries(tau=inputs["tau"][k]),
                        **moving.inputs,
                    }
                    if isinstance(f.composed, AtState):
                        made = _carry_over(
                            f.composed, known, _TreeMotion(enclosures, u, qd), evaluate_outputs
                        )
                    else:
                        made = _solve_composed(
                            f, known, _name_entries(damping=inputs["damping"][k]), evaluate_outputs
                        )
                    expected.setdefault(role, []).extend([made] if made else [])
                    continue
                state = standing if c.qdd == "standing" else moving
                tree = role if not f.closed else f"{c.tree}_{_ROWS.get(c.kind, c.role)}"
                tree_inputs = {**constants, **signals, **state.inputs}
                out = evaluate_outputs(tree, tree_inputs) if tree in roles else []
                expected.setdefault(role, []).append(_project_output(c.kind, state, out))
    # Where a matrix is not positive definite, its functions have no number.
    lengths = {role: 1 if role == "base_parameters" else states for role in expected}
    return inputs, {role: rows for role, rows in expected.items() if len(rows) == lengths[role]}


def _solve_composed(
    f: CFunction,
    inputs: Mapping[str, Ball],
    damping: Mapping[str, Ball],
    outputs: Callable[[str, Mapping[str, Ball]], list[Ball]],
) -> list[Ball]:
    """Output of a function with a status; [] where the inertia matrix gives it no meaning."""
    assert f.composed is not None
    if f.composed.kind == "stepped":
        return outputs(f.composed.roles["step"], inputs)
    head = "fitted_" * f.role.startswith("fitted_")
    M = outputs(f"{head}inertia_matrix", inputs)
    n, matrix = math.isqrt(len(M)), load_flint().arb_mat
    pivots = np.linalg.eigvalsh(np.reshape(_round_balls(M), (n, n)))
    if f.composed.turns > 1 or pivots[0] < 1e-6 * pivots[-1]:
        return []
    inverse = matrix(n, n, M).inv()
    if f.composed.kind.startswith("operational"):
        J = matrix(6, n, outputs("jacobian", inputs))
        square = damping["damping[0]"] * damping["damping[0]"]
        add = matrix(6, 6, [square if i % 7 == 0 else build_ball(0) for i in range(36)])
        L = (J * inverse * J.transpose() + add).inv()
        return list((L if f.output.name == "L" else inverse * J.transpose() * L).entries())
    still = {**inputs, **{f"qdd[{j}]": build_ball(0) for j in range(n)}}
    rest = outputs(f"{head}inverse_dynamics", still)
    qdd = (inverse * matrix(n, 1, [inputs[f"tau[{j}]"] - x for j, x in enumerate(rest)])).entries()
    if f.composed.kind == "forward_dynamics":
        return list(qdd)
    moving = {**inputs, **{f"qdd[{j}]": x for j, x in enumerate(qdd)}}
    slopes = outputs(f"{head}derivatives", moving)
    parts = [matrix(n, n, [-x for x in slopes[k : k + n * n]]) for k in (0, n * n)]
    return [x for part in parts for x in (inverse * part).entries()] + list(inverse.entries())


class _TreeMotion:
    """What a state of the opened tree is made of: G, its rate, and gamma, udd at qdd = 0."""

    def __init__(self, enclosures: Enclosures, u: np.ndarray, qd: np.ndarray) -> None:
        matrix, n, g = load_flint().arb_mat, len(u), len(qd)
        states = [enclosures.enclose_state(u, speed, 0.0 * qd) for speed in _list_speeds(qd)]
        self.G = matrix(states[0].coupling)
        # gamma is a square of the speeds, dG/dt v a product of two of them.
        accelerations, *others = [[state.inputs[f"qdd[{k}]"] for k in range(n)] for state in states]
        self.gamma = matrix(n, 1, accelerations)
        ahead, behind = others[:g], others[g:]
        rate = [(ahead[j][k] - behind[j][k]) / 4 for k in range(n) for j in range(g)]
        self.rate = matrix(n, g, rate)


def _list_speeds(qd: np.ndarray) -> Iterable[np.ndarray]:
    return (qd, *(qd + unit for unit in np.eye(len(qd))), *(qd - unit for unit in np.eye(len(qd))))


def _carry_over(
    made: AtState,
    inputs: Mapping[str, Ball],
    by: _TreeMotion,
    outputs: Callable[[str, Mapping[str, Ball]], list[Ball]],
) -> list[Ball]:
    """Output of a controller's function of closed loops; [] where that has no number here."""
    n, g, matrix = by.G.nrows(), by.G.ncols(), load_flint().arb_mat

    def make_tree_matrix(role: str, rows: int, values: Mapping[str, Ball] = inputs) -> Ball:
        out = outputs(role, values)
        return matrix(rows, len(out) // rows, out)

    def make_column(name: str, rows: int = g) -> Ball:
        return matrix(rows, 1, [inputs[f"{name}[{k}]"] for k in range(rows)])

    back, form, role = by.G.transpose(), made.form, made.roles.get("made", "")
    beside = made.roles.get("beside", "")
    if form == "fitted":
        return []
    if form == "rate":
        return list(by.rate.entries())
    if form == "direct":
        return outputs(role, inputs)
    if form.startswith("jacobian"):
        J = make_tree_matrix(beside, 6)
        product = J * by.G if form == "jacobian" else make_tree_matrix(role, 6) + J * by.gamma
    elif form == "forward_dynamics":
        head = "fitted_" * made.roles["matrix"].startswith("fitted_")
        M = back * make_tree_matrix(f"{head}tree_inertia_matrix", n) * by.G
        pivots = np.linalg.eigvalsh(np.reshape(_round_balls(M.entries()), (g, g)))
        if pivots[0] < 1e-6 * pivots[-1]:
            return []
        still = {f"qdd[{k}]": x for k, x in enumerate(by.gamma.entries())}
        bias = back * make_tree_matrix(f"{head}tree_inverse_dynamics", n, {**inputs, **still})
        product = M.inv() * (make_column("tau") - bias)
    elif form == "slotine_li":
        v, a = by.G * make_column("v"), by.G * make_column("a") + by.rate * make_column("v")
        known = {
            f"{x}[{k}]": y for x, ys in (("v", v), ("a", a)) for k, y in enumerate(ys.entries())
        }
        product = back * make_tree_matrix(role, n, {**inputs, **known})
    elif form == "coriolis_matrix":
        product = back * (make_tree_matrix(role, n) * by.G + make_tree_matrix(beside, n) * by.rate)
    else:
        product = back * make_tree_matrix(role, n)
        if form == "coriolis_transpose":
            product += by.rate.transpose() * make_tree_matrix(beside, n)
        elif form == "momentum_rest":
            product -= by.rate.transpose() * make_tree_matrix(beside, n)
    return list(product.entries())


def _project_output(kind: str, state: EnclosedState, out: list[Ball]) -> list[Ball]:
    """Output of a function of that kind, row-major, from that of the tree; see `Closed`."""
    G = load_flint().arb_mat(state.coupling)
    if kind == "posture":
        return [state.inputs[f"q[{k}]"] for k in range(G.nrows())]
    if kind == "coupling":
        return list(G.entries())
    if kind == "poses":
        return out
    rows = G.transpose() * load_flint().arb_mat(G.nrows(), len(out) // G.nrows(), out)
    return list((rows * G if kind == "inertia_matrix" else rows).entries())


def _sample_postures(
    model: SymbolicModel, closure: Closure, symbols: Mapping[str, Ball], states: int
) -> list[np.ndarray]:
    """Closed postures around home, their coordinates rounded."""
    enclosures = Enclosures(model, symbols)
    home, independent = np.array(closure.home), list(closure.actuated)
    for reach in THRESHOLDS.posture_reaches:
        random = np.random.default_rng(_SEED)
        near = draw_nearby_postures(closure, home, random, states, reach)
        with suppress(EnclosureError):
            pairs = ((u, [_round_fine(x) for x in u[independent]]) for u in near)
            postures = [_close_posture(closure, u, independent, values) for u, values in pairs]
            return [np.array([float(x) for x in enclosures.enclose_posture(u)]) for u in postures]
    raise EmitError(f"{model.robot.name}: the loops do not close beside home; state another home")


def _close_posture(
    closure: Closure, near: np.ndarray, places: Sequence[int], values: Sequence[float]
) -> np.ndarray:
    """The closed posture next to `near` with these variables given; NaN if there is none."""
    u = near.copy()
    u[list(places)] = values
    solved = [k for k in range(len(u)) if k not in places]
    return closure.close_loops(u[None], solved)[0]


def _name_entries(**arrays: Sequence[float]) -> dict[str, Ball]:
    return {f"{name}[{k}]": build_ball(x) for name, xs in arrays.items() for k, x in enumerate(xs)}


def _round_fine(x: float) -> float:
    return float(round(x / THRESHOLDS.posture_grid) * THRESHOLDS.posture_grid)


def _round_balls(balls: Sequence[Ball]) -> list[float]:
    return [0.0 if x.contains(0) else float(x) for x in balls]
