"""What effects read besides the motion, one sample later: `advance`; and elastic joints.

With e = q_motor - q_link of elastic joints E, and the motion of the motors measured,

    M_EE e'' + D e' + K e = [links(q - e, qd - e', qdd)]_E,

where `links` is the inverse dynamics of the links: what accelerates them behind rigid joints. A
step is Newmark's with beta 1/4, gamma 1/2, implicit in K and D; the links are evaluated where e and
e' would be if e'' ended in 0, which needs no iteration.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction

from modeler.codegen.functions import CFunction, Composed, make_arguments
from modeler.codegen.thresholds import THRESHOLDS
from modeler.derivation import (
    MOTOR_MOTION,
    BaseParameters,
    Expr,
    Graph,
    Signal,
    SymbolicModel,
    combine_linearly,
    evaluate_followed,
    get_signal_symbol,
)


def build_advance_functions(
    model: SymbolicModel,
    base: BaseParameters,
    beta: Mapping[int, Expr],
    elastic: Sequence[Expr] = (),
) -> list[CFunction]:
    """Returns the signals one sample later; of elastic joints also reset and feed-forward.

    Args:
        model: as derived, without loops.
        base: its base parameters.
        beta: the parameter of each column.
        elastic: stiffness, then damping of elastic joints; empty: the argument of that name.
    """
    if not model.signals:
        return []
    arguments, count = make_arguments(model.robot.free_joints, model, base), 2 * len(model.windups)
    elastic = elastic or [model.graph.symbol(f"elastic[{k}]") for k in range(count)]
    after = dict[Signal, Expr]()
    moved = _step_windups(model, beta, elastic) if model.windups else {}
    for signal in model.signals:
        after[signal] = moved.get(signal) or _advance_signal(model, signal, after)
    values = list(after.values())
    motion = "q qd qdd" if any(s.follows for s in model.signals) else ""
    words = {"first": "", "dq": "dq", "motion": motion}
    if not model.windups:
        return [arguments.declare("advance", values, words)]
    travels = any(s.kind in ("slip", "bouc_wen", "direction") for s in model.signals)
    sizes = {"command": 3 * arguments.words["n"] + len(model.signals)}
    words = {"first": "q qd qdd", "dq": "dq" * travels, "motion": "beta elastic"} | sizes
    reset = _rest_windups(model, beta, elastic)
    rest = [reset.get(signal, model.graph.constant(0)) for signal in model.signals]
    functions = []
    outputs = {
        "advance": values,
        "reset": rest,
        "elastic_feedforward": _plan_command(model, beta, elastic),
    }
    for role, each in outputs.items():
        step = arguments.declare(f"{role}_step", each, words, row=role, internal=True)
        made = Composed("stepped", {"step": step.role})
        functions += [step, arguments.declare(role, words=words, composed=made)]
    return functions


def _advance_signal(model: SymbolicModel, signal: Signal, now: Mapping[Signal, Expr]) -> Expr:
    """A signal one sample later, from those before it now."""
    graph = model.graph

    s, dt = get_signal_symbol(model, signal), graph.symbol("dt[0]")
    one, two = graph.constant(1), graph.constant(2)
    if signal.kind == "time":
        return s + dt
    if signal.kind == "temperature":
        return s
    if signal.kind == "followed":
        return evaluate_followed(model, signal, now)
    if signal.kind == "lag":  # the mean of what it follows at both ends of the step
        (other,) = signal.prerequisites
        mean = (get_signal_symbol(model, other) + now[other]) / two
        tau = graph.constant(Fraction(repr(signal.value)))
        return mean + (s - mean) * graph.call("exp", -(dt / tau))
    index = model.geometry.rows[signal.row].index
    assert index is not None
    way = combine_linearly(graph, model.geometry.forms[index], model.get_inputs("dq"))
    share = way / graph.constant(Fraction(repr(signal.value)))
    if signal.kind == "slip":  # Dahl's bristle, exact where the direction is constant
        toward = graph.call("sign", way)
        return toward + (s - toward) * graph.call("exp", -graph.call("abs", share))
    if signal.kind == "bouc_wen":
        return _advance_loop(graph, s, share, signal.share)
    direction = (
        s if signal.kind == "direction" else get_signal_symbol(model, signal.prerequisites[0])
    )
    moved = direction + share
    both = graph.call("sign", direction) * graph.call("sign", moved)
    turned = (graph.call("abs", both) - both) / two  # 1 where it has come back far enough, else 0
    if signal.kind == "direction":
        held = (graph.call("abs", moved + one) - graph.call("abs", moved - one)) / two
        return held + turned * (graph.call("sign", moved) - held)
    # That way took twice as long, at constant acceleration, as at the speed that it ended with.
    size = graph.call("abs", share) + graph.constant(Fraction(1, 10**30))  # it may be 0
    longer = s + dt - two * (one + graph.call("abs", moved)) * dt / size
    return s + dt - turned * (longer + graph.call("abs", longer)) / two


def _advance_loop(graph: Graph, z: Expr, travel: Expr, share: float) -> Expr:
    """Bouc and Wen's z after a signed travel in units of d, exact where the direction is constant.

    With w = z sign(v), k = 1 - 2 b and x = |travel|: w' = 1 + k w where w < 0, else 1 - w. So with
    n = min(w, 0) and r = exp(-x) (1 + k n)^(-1/k), which is 1 where w passes 0, w is
    (r^-k - 1)/k before (-ln r for k = 0), and 1 - (1 - max(w, 0)) r from there on.
    """
    one, half, k = graph.constant(1), graph.constant(Fraction(1, 2)), 1 - 2 * Fraction(repr(share))

    def split(x: Expr, at: Expr) -> tuple[Expr, Expr]:
        """The lower and the higher of both."""
        apart = graph.call("abs", x - at)
        return half * (x + at - apart), half * (x + at + apart)

    way = graph.call("sign", travel)
    zero = one - one
    below, above = split(way * z, zero)
    if k == 0:
        negative, positive = split(below + graph.call("abs", travel), zero)
        w = negative + one - (one - above) * graph.call("exp", -positive)
    else:
        factor = graph.constant(k)
        rest = graph.call("exp", -graph.call("abs", travel))
        rest = rest * graph.power(one + factor * below, graph.constant(-1 / k))
        low, high = split(rest, one)
        w = (graph.power(high, -factor) - one) / factor + one - (one - above) * low
    return way * w + (one - way * way) * z  # at rest nothing changes


# Elastic joints.


def _step_windups(
    model: SymbolicModel, beta: Mapping[int, Expr], elastic: Sequence[Expr]
) -> dict[Signal, Expr]:
    """e, e', e'' one sample later."""
    h, E = model.graph.symbol("dt[0]"), list(model.windups)
    half, quarter = h * Fraction(1, 2), h * h * Fraction(1, 4)
    near, zero = {}, model.graph.constant(0)
    for k, signals in model.windups.items():
        e, rate, acceleration = (get_signal_symbol(model, signal) for signal in signals)
        near[k] = (e + h * rate + quarter * acceleration, rate + half * acceleration, zero)
    moved = replace(model, deflections=near)
    torques = moved.derive_torque(beta, effects=False)
    M = moved.derive_inertia_matrix(beta, rotors=False)
    matrix = [[M[i][j] for j in E] for i in E]
    right = []
    for i, k in enumerate(E):
        K, D = elastic[i], elastic[len(E) + i]
        matrix[i][i] = matrix[i][i] + half * D + quarter * K
        right.append(torques[k] - D * near[k][1] - K * near[k][0])
    after = dict[Signal, Expr]()
    for k, acceleration in zip(E, solve_linear(matrix, right)[0], strict=True):
        e, rate, _ = near[k]
        parts = (e + quarter * acceleration, rate + half * acceleration, acceleration)
        after |= dict(zip(model.windups[k], parts, strict=True))
    return after


def _rest_windups(
    model: SymbolicModel, beta: Mapping[int, Expr], elastic: Sequence[Expr]
) -> dict[Signal, Expr]:
    """e that holds the links along the motion, without speed of its own."""
    zero = model.graph.constant(0)
    held = dict.fromkeys(model.windups, zero)
    for _ in range(THRESHOLDS.reset_turns if held else 0):
        still = replace(model, deflections={k: (e, zero, zero) for k, e in held.items()})
        torques = still.derive_torque(beta, effects=False)
        held = {k: torques[k] / K for k, K in zip(held, elastic, strict=False)}
    return {model.windups[k][0]: e for k, e in held.items()}


def _plan_command(
    model: SymbolicModel, beta: Mapping[int, Expr], elastic: Sequence[Expr]
) -> list[Expr]:
    """What motors do where the links are on the command: D e' + K e = links(q, qd, qdd).

    Torques, positions and speeds of the motors, and the signals planned; e' is the difference
    since the last sample, and e'' that of e'.
    """
    h, E = model.graph.symbol("dt[0]"), list(model.windups)
    tau = model.rigid.derive_torque(beta, effects=False)
    plan = dict[Signal, Expr]()
    motors = [model.get_inputs(kind) for kind in MOTOR_MOTION]
    for i, k in enumerate(E):
        K, D = elastic[i], elastic[len(E) + i]
        before, rate_before, _ = (get_signal_symbol(model, s) for s in model.windups[k])
        e = (tau[k] * h + D * before) / (K * h + D)
        rate = (e - before) / h
        parts = (e, rate, (rate - rate_before) / h)
        plan |= dict(zip(model.windups[k], parts, strict=True))
        for inputs, part in zip(motors, parts, strict=True):
            inputs[k] = inputs[k] + part
    moved = replace(model, motors=dict(zip(MOTOR_MOTION, motors, strict=True)))
    losses = moved.derive_torque(beta, links=False)
    tau = [link + motor for link, motor in zip(tau, losses, strict=True)]
    rest = [plan.get(signal, get_signal_symbol(model, signal)) for signal in model.signals]
    return [*tau, *motors[0], *motors[1], *rest]


def solve_linear(
    matrix: Sequence[Sequence[Expr]], right: Sequence[Expr]
) -> tuple[list[Expr], list[Expr]]:
    """Returns x of matrix x = right, and the pivots; one that is always 0 counts as 1 in x.

    Gauss's elimination from the last row to the first. Equal expressions are one node of the graph,
    so that a symmetric matrix costs half of one that is not.
    """
    n, one = len(right), right[0].graph.constant(1)
    A, x = [list(row) for row in matrix], list(right)
    inverse = [one] * n
    for k in reversed(range(n)):
        inverse[k] = one if A[k][k].is_zero else 1 / A[k][k]
        for i in range(k):
            if not A[i][k].is_zero:
                share = A[i][k] * inverse[k]
                A[i][:k] = [A[i][j] - share * A[k][j] for j in range(k)]
                x[i] = x[i] - share * x[k]
    for k in range(n):
        for j in range(k):
            x[k] = x[k] - A[k][j] * x[j]
        x[k] = x[k] * inverse[k]
    return x, [A[k][k] for k in range(n)]
