"""The functions of a robot for CasADi, from the expressions that are printed as C.

They stand here and not among the exports, since they are one more printer of the same list of
functions: what the C has they have, with its names, arguments and order of entries.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import casadi as ca

from modeler.codegen import control, functions as layout
from modeler.codegen.advance import build_advance_functions
from modeler.codegen.control import SMOOTH, Control, find_widths
from modeler.codegen.functions import CFunction
from modeler.codegen.thresholds import THRESHOLDS
from modeler.core.expression import BESIDE, LAW
from modeler.core.manifest import ArgumentSpec
from modeler.derivation import (
    Arithmetic,
    BaseParameters,
    Closure,
    Expr,
    Graph,
    Plan,
    SymbolicModel,
    Table,
)

_OPERATIONS = {x: getattr(ca, x) for x in ("sin", "cos", "tan", "sqrt", "exp", "sign", "tanh")}


def _build_law(table: Table, *x: ca.SX) -> ca.SX:
    """A law as a sum of coefficients times cardinal splines B, of truncated powers."""
    arguments = [ca.SX.sym(f"x{k}") for k in range(len(x))]
    total, law = ca.SX(0), table.law
    splines = [
        [
            _evaluate_spline(ca.fmax(0, ca.fmin((y - low) * scale, count)) - i + 3)
            for i in range(count + BESIDE)
        ]
        for y, low, scale, count in zip(arguments, law.low, law.scales, law.cells, strict=True)
    ]
    rows = law.coefficients.reshape(law.cells[0] + BESIDE, -1)
    for first, row in zip(splines[0], rows, strict=True):
        others = zip(row.tolist(), splines[1] if len(splines) > 1 else [1], strict=True)
        total += first * sum(c * second for c, second in others)
    if table.along is not None:
        total = ca.gradient(total, arguments[table.along])
    return ca.substitute([total], arguments, list(x))[0]


def _evaluate_spline(t: ca.SX) -> ca.SX:
    """B of [0, 4]."""
    s = ca.fabs(t - 2)
    return (ca.fmax(2 - s, 0) ** 3 - 4 * ca.fmax(1 - s, 0) ** 3) / 6


_SYMBOLIC = Arithmetic(
    float,
    lambda: ca.pi,
    {
        **_OPERATIONS,
        "abs": ca.fabs,
        "pow": ca.power,
        "add": ca.plus,
        "mul": ca.times,
        "div": ca.rdivide,
        LAW: _build_law,
    },
)


def write_casadi(
    model: SymbolicModel, base: BaseParameters, values: Sequence[float] | None = None
) -> tuple[bytes, dict[str, str], tuple[str, ...]]:
    """Returns what `ca.FileDeserializer(FILE).unpack()` reads: a list of functions.

    Args:
        model: as derived.
        base: the base parameters of the same model.
        values: of them, which take the place of the argument beta.

    Returns:
        The file; {function: its inputs and outputs}; what is not in it, a sentence each.
    """
    functions, missing = build_casadi_functions(model, base)
    if values is not None:
        functions = [_insert_values(each, values) for each in functions]
    packed = ca.StringSerializer()
    packed.pack(functions)
    signatures = {each.name(): str(each).partition(":")[2].rpartition(" ")[0] for each in functions}
    return packed.encode().encode(), signatures, missing


def build_casadi_functions(
    model: SymbolicModel, base: BaseParameters
) -> tuple[list[ca.Function], tuple[str, ...]]:
    """Returns the functions of a robot, and what is not among them.

    Loops are closed by Newton from home.

    `forward_dynamics` and `smooth_forward_dynamics` give qdd of M qdd = tau - c - g - f, by Newton
    where f reads qdd.
    """
    beta = layout.make_beta_symbols(model, base)
    arguments = layout.make_arguments(model.robot.free_joints, model, base)
    listed = [*layout.build_tree_functions(model, base)]
    if model.closure is not None:
        listed += control.build_smooth_functions(model, beta, arguments)
    else:
        listed += build_advance_functions(model, base, beta)
        listed += control.build_control_functions(model, base, Control())
    turning = control.list_turning_joints(model, base)
    public = (f for f in listed if not f.internal and f.composed is None)
    functions = {f.role: _build_function(model, f, turning) for f in public}
    missing: tuple[str, ...] = ()
    if model.closure is not None:
        functions = _close_functions(model, model.closure, functions)
        missing = ("not there: functions of the platform's coordinates, those for controllers",)
    composed = [f.role for f in listed if f.composed and f.role != "forward_dynamics"]
    if composed:
        missing = (f"not there: {', '.join(composed)}, which return a status in C",)
    if model.windups:
        more = "not there: forward_dynamics, to which elastic joints add motions of their own"
        return list(functions.values()), (*missing, more)
    is_implicit = control.build_efforts(model, beta).is_implicit
    solve = _build_forward_by_newton if is_implicit else _build_forward
    for head in ("", SMOOTH)[: 1 + bool(turning)]:
        functions[f"{head}forward_dynamics"] = solve(head, functions)
    return list(functions.values()), missing


def _build_function(model: SymbolicModel, f: CFunction, turning: Sequence[str] = ()) -> ca.Function:
    """One of the C; `turning` says whose speed each entry of an input `widths` is of."""
    inputs = {a.name: ca.SX.sym(a.name, a.size) for a in f.inputs}
    values = {f"{n}[{k}]": x[k] for n, x in inputs.items() for k in range(x.numel())}
    values |= {name: ca.SX(x) for name, x in model.geometry.values.items()}
    graph = f.entries[0][1].graph if f.entries else model.graph
    arithmetic = _SYMBOLIC
    if "widths" in inputs:
        speeds = find_widths("", model, [f]).items()
        places = {v: turning.index(control.get_turning_joint(width)) for v, width in speeds}
        over = {speed: inputs["widths"][place] for speed, place in places.items()}
        arithmetic = _smooth_signs(graph, values, over)
    numbers = [ca.SX(0)] * f.output.size
    outputs = Plan(graph, [value for _, value in f.entries], arithmetic)(values)
    for (place, _), x in zip(f.entries, outputs, strict=True):
        numbers[place] = x
    parts = _split_output(f.output, numbers)
    function_arguments = list(inputs.values()), list(parts.values()), list(inputs), list(parts)
    return ca.Function(f.role, *function_arguments)


def _close_functions(
    model: SymbolicModel, closure: Closure, tree: Mapping[str, ca.Function]
) -> dict[str, ca.Function]:
    """Functions of the coordinates: u(q) by Newton's method from home, ud = G qd, tau = G' tau_u.

    G and the accelerations of the solved variables follow from J ud = 0, J udd + drift = 0.
    """
    n, independent, solved = len(closure.home), list(closure.actuated), list(closure.solved)

    def make_tree_function(name: str, values: Sequence[Expr], *reads: str) -> ca.Function:
        inputs = tuple(ArgumentSpec(each, (n,), "", "") for each in reads)
        size = len(closure.equations)
        output = ArgumentSpec(name, (size, len(values) // size), "", "")
        function = CFunction("", name, "", "", inputs, output, layout.list_entries(values))
        return _build_function(model, function)

    residual = make_tree_function("residual", closure.equations, "q")
    J = make_tree_function("jacobian", [x for row in closure.jacobian for x in row], "q")
    drift = make_tree_function("drift", closure.drift, "q", "qd")

    def assemble(some: Any, others: Any) -> Any:
        parts = ca.vertsplit(ca.vertcat(some, others))
        rows = dict(zip([*independent, *solved], parts, strict=True))
        return ca.vertcat(*(rows[k] for k in range(n)))

    q, qd, qdd = (ca.MX.sym(name, len(independent)) for name in ("q", "qd", "qdd"))
    x, y = ca.SX.sym("x", len(solved)), ca.SX.sym("y", len(independent))
    problem = {"x": x, "p": y, "g": residual(assemble(y, x))}
    close = ca.rootfinder("closing", "newton", problem, {"abstol": 1e-12, "abstolStep": 1e-14})
    u = assemble(q, close(ca.DM([closure.home[k] for k in solved]), q))
    columns = J(u)[:, solved]
    G = assemble(ca.MX.eye(len(independent)), -ca.solve(columns, J(u)[:, independent]))
    ud = G @ qd
    rest = assemble(ca.MX.zeros(len(independent)), -ca.solve(columns, drift(u, ud)))
    motion = {"q": u, "qd": ud, "qdd": G @ qdd + rest}
    functions = {"base_parameters": tree["base_parameters"]}

    def add_public(
        name: str, values: Sequence[ca.MX], inputs: Mapping[str, ca.MX], outputs: Sequence[str]
    ) -> None:
        read = {"q", *(x.name() for value in values for x in ca.symvar(value))}
        reads = {n: x for n, x in inputs.items() if n in read}
        functions[name] = ca.Function(
            name, list(reads.values()), list(values), list(reads), list(outputs)
        )

    add_public("close", [u], {"q": q}, ["u"])
    add_public("coupling", [G], {"q": q}, ["G"])
    for role, function in tree.items():
        if role in ("base_parameters", "base_regressor_nonzeros"):
            continue
        names = function.name_in()
        more = {n: ca.MX.sym(n, function.size1_in(n)) for n in names if n not in motion}
        values = function.call([{**motion, **more}[n] for n in names])
        if role == "coriolis":  # the solved variables accelerate at qdd = 0 too
            values = [values[0] + tree["inertia_matrix"](u, more["beta"]) @ rest]
        if role != "forward_kinematics":
            values = [G.T @ value for value in values]
        if role == "inertia_matrix":
            values = [values[0] @ G]
        add_public(role, values, {"q": q, "qd": qd, "qdd": qdd, **more}, function.name_out())
    return functions


def _smooth_signs(
    graph: Graph, values: Mapping[str, ca.SX], over: Mapping[int, ca.SX]
) -> Arithmetic:
    """Arithmetic in which the signs of these speeds turn, each over its width."""
    speeds = Plan(graph, [Expr(graph, speed) for speed in over], _SYMBOLIC)(values)

    def sign(x: ca.SX) -> ca.SX:
        for speed, width in zip(speeds, over.values(), strict=True):
            if ca.is_equal(x, speed, THRESHOLDS.max_compared_depth):
                return ca.tanh(x / width)
        return ca.sign(x)

    return Arithmetic(_SYMBOLIC.number, _SYMBOLIC.pi, {**_SYMBOLIC.functions, "sign": sign})


def _split_output(output: ArgumentSpec, numbers: Sequence[ca.SX]) -> dict[str, ca.SX]:
    """{name: value}: a vector, a matrix, or of more dimensions a matrix for each first index."""
    *more, last = output.shape
    if not more:
        return {output.name: ca.vertcat(*numbers)}
    rows = more.pop()
    size, count = rows * last, len(numbers) // (rows * last)
    return {
        f"{output.name}_{k}" if more else output.name: ca.reshape(
            ca.vertcat(*numbers[k * size : (k + 1) * size]), last, rows
        ).T
        for k in range(count)
    }


def _build_forward(head: str, functions: Mapping[str, ca.Function]) -> ca.Function:
    """Qdd of tau, by the LDL' factors of M."""
    torques = functions[f"{head}inverse_dynamics"]
    symbols = _make_symbols(torques)
    qdd, kind = symbols["qdd"], type(symbols["qdd"])
    still = torques.call([*({**symbols, "qdd": kind.zeros(*qdd.shape)}.values())])[0]
    M = functions["inertia_matrix"].call([symbols["q"], symbols["beta"]])[0]
    tau = kind.sym("tau", *qdd.shape)
    solved = ca.ldl_solve(tau - still, *ca.ldl(M)) if kind is ca.SX else ca.solve(M, tau - still)
    names = ["q", "qd", "tau", *(n for n in symbols if n not in ("q", "qd", "qdd"))]
    inputs = [{**symbols, "tau": tau}[n] for n in names]
    return ca.Function(f"{head}forward_dynamics", inputs, [solved], names, ["qdd"])


def _build_forward_by_newton(head: str, functions: Mapping[str, ca.Function]) -> ca.Function:
    """Qdd of tau where friction reads accelerations, or expressions that cancel do."""
    torques = functions[f"{head}inverse_dynamics"]
    symbols = _make_symbols(torques)
    qdd = symbols.pop("qdd")
    tau = ca.SX.sym("tau", qdd.numel())
    symbols = {"q": symbols.pop("q"), "qd": symbols.pop("qd"), "tau": tau, **symbols}
    tau = torques.call([{**symbols, "qdd": qdd}[name] for name in torques.name_in()])[0]
    problem = {"x": qdd, "p": ca.vertcat(*symbols.values()), "g": tau - symbols["tau"]}
    solver = ca.rootfinder(f"{head}accelerations", "newton", problem, {"abstol": 1e-11})
    inputs = {name: ca.MX.sym(name, x.numel()) for name, x in symbols.items()}
    start = ca.DM.zeros(qdd.numel())
    solved = solver(start, ca.vertcat(*inputs.values()))
    names = list(inputs)
    return ca.Function(f"{head}forward_dynamics", [*inputs.values()], [solved], names, ["qdd"])


def _insert_values(function: ca.Function, values: Sequence[float]) -> ca.Function:
    """The function without its argument beta."""
    symbols = _make_symbols(function)
    if "beta" not in symbols:
        return function
    beta = ca.DM(list(map(float, values)))
    out = function.call([*{**symbols, "beta": type(symbols["beta"])(beta)}.values()])
    del symbols["beta"]
    return ca.Function(function.name(), [*symbols.values()], out, [*symbols], function.name_out())


def _make_symbols(function: ca.Function) -> dict[str, Any]:
    """{input: a symbol of its size}, of SX or MX as the function is."""
    kind = ca.SX if function.is_a("SXFunction") else ca.MX
    return {name: kind.sym(name, *function.size_in(name)) for name in function.name_in()}
