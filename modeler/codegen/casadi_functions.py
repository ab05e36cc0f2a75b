"""The functions of a robot for CasADi, from the expressions that are printed as C.

They stand here and not among the exports, since they are one more printer of the same list of
functions: what the C has they have, with its names, arguments and order of entries.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import casadi

from modeler.codegen import functions as layout
from modeler.codegen.control import (
    SMOOTH,
    Control,
    build_control_functions,
    build_efforts,
    build_smooth_functions,
    get_turning_joint,
    list_turning_joints,
)
from modeler.codegen.fitted import find_widths
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

_OPERATIONS = {
    name: getattr(casadi, name) for name in ("sin", "cos", "tan", "sqrt", "exp", "sign", "tanh")
}


def _build_law(table: Table, *x: casadi.SX) -> casadi.SX:
    """A law as a sum of coefficients times cardinal splines B, of truncated powers."""
    arguments = [casadi.SX.sym(f"x{k}") for k in range(len(x))]
    total, law = casadi.SX(0), table.law
    splines = [
        [
            _evaluate_spline(casadi.fmax(0, casadi.fmin((y - low) * scale, count)) - i + 3)
            for i in range(count + BESIDE)
        ]
        for y, low, scale, count in zip(arguments, law.low, law.scales, law.cells, strict=True)
    ]
    rows = law.coefficients.reshape(law.cells[0] + BESIDE, -1)
    for first, row in zip(splines[0], rows, strict=True):
        others = zip(row.tolist(), splines[1] if len(splines) > 1 else [1], strict=True)
        total += first * sum(c * second for c, second in others)
    if table.along is not None:
        total = casadi.gradient(total, arguments[table.along])
    return casadi.substitute([total], arguments, list(x))[0]


def _evaluate_spline(t: casadi.SX) -> casadi.SX:
    """B of [0, 4]."""
    s = casadi.fabs(t - 2)
    return (casadi.fmax(2 - s, 0) ** 3 - 4 * casadi.fmax(1 - s, 0) ** 3) / 6


_SYMBOLIC = Arithmetic(
    float,
    lambda: casadi.pi,
    {
        **_OPERATIONS,
        "abs": casadi.fabs,
        "pow": casadi.power,
        "add": casadi.plus,
        "mul": casadi.times,
        "div": casadi.rdivide,
        LAW: _build_law,
    },
)


def write_casadi(
    model: SymbolicModel, base: BaseParameters, values: Sequence[float] | None = None
) -> tuple[bytes, dict[str, str], tuple[str, ...]]:
    """Returns what `casadi.FileDeserializer(FILE).unpack()` reads: a list of functions.

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
    packed = casadi.StringSerializer()
    packed.pack(functions)
    signatures = {each.name(): str(each).partition(":")[2].rpartition(" ")[0] for each in functions}
    return packed.encode().encode(), signatures, missing


def build_casadi_functions(
    model: SymbolicModel, base: BaseParameters
) -> tuple[list[casadi.Function], tuple[str, ...]]:
    """Returns the functions of a robot, and what is not among them.

    Loops are closed by Newton from home.

    `forward_dynamics` and `smooth_forward_dynamics` give qdd of M qdd = tau - c - g - f, by Newton
    where f reads qdd.
    """
    beta = layout.make_beta_symbols(model, base)
    arguments = layout.make_arguments(model.robot.free_joints, model, base)
    listed = [*layout.build_tree_functions(model, base)]
    if model.closure is not None:
        listed += build_smooth_functions(model, beta, arguments)
    else:
        listed += build_control_functions(model, base, Control())
    turning = list_turning_joints(model, base)
    functions = {
        f.role: _build_function(model, f, turning)
        for f in listed
        if not f.internal and f.composed is None
    }
    missing: tuple[str, ...] = ()
    if model.closure is not None:
        functions = _close_functions(model, model.closure, functions)
        missing = ("not there: functions of the platform's coordinates, those for controllers",)
    composed = [f.role for f in listed if f.composed and f.role != "forward_dynamics"]
    if composed:
        missing = (f"not there: {', '.join(composed)}, which return a status in C",)
    solve = _build_forward_by_newton if build_efforts(model, beta).is_implicit else _build_forward
    for head in ("", SMOOTH)[: 1 + bool(turning)]:
        functions[f"{head}forward_dynamics"] = solve(head, functions)
    return list(functions.values()), missing


def _build_function(
    model: SymbolicModel, f: CFunction, turning: Sequence[str] = ()
) -> casadi.Function:
    """One of the C; `turning` says whose speed each entry of an input `widths` is of."""
    inputs = {a.name: casadi.SX.sym(a.name, a.size) for a in f.inputs}
    values = {f"{n}[{k}]": x[k] for n, x in inputs.items() for k in range(x.numel())}
    values |= {name: casadi.SX(x) for name, x in model.geometry.values.items()}
    graph = f.entries[0][1].graph if f.entries else model.graph
    arithmetic = _SYMBOLIC
    if "widths" in inputs:
        over = {
            speed: inputs["widths"][turning.index(get_turning_joint(width))]
            for speed, width in find_widths("", model, [f]).items()
        }
        arithmetic = _smooth_signs(graph, values, over)
    numbers = [casadi.SX(0)] * f.output.size
    outputs = Plan(graph, [value for _, value in f.entries], arithmetic)(values)
    for (place, _), x in zip(f.entries, outputs, strict=True):
        numbers[place] = x
    parts = _split_output(f.output, numbers)
    function_arguments = list(inputs.values()), list(parts.values()), list(inputs), list(parts)
    return casadi.Function(f.role, *function_arguments)


def _close_functions(
    model: SymbolicModel, closure: Closure, tree: Mapping[str, casadi.Function]
) -> dict[str, casadi.Function]:
    """Functions of the coordinates: u(q) by Newton's method from home, ud = G qd, tau = G' tau_u.

    G and the accelerations of the solved variables follow from J ud = 0, J udd + drift = 0.
    """
    n, independent, solved = len(closure.home), list(closure.actuated), list(closure.solved)

    def make_tree_function(name: str, values: Sequence[Expr], *reads: str) -> casadi.Function:
        inputs = tuple(ArgumentSpec(each, (n,), "", "") for each in reads)
        output = ArgumentSpec(
            name, (len(closure.equations), len(values) // len(closure.equations)), "", ""
        )
        function = CFunction("", name, "", "", inputs, output, layout.list_entries(values))
        return _build_function(model, function)

    residual = make_tree_function("residual", closure.equations, "q")
    J = make_tree_function("jacobian", [x for row in closure.jacobian for x in row], "q")
    drift = make_tree_function("drift", closure.drift, "q", "qd")

    def assemble(some: Any, others: Any) -> Any:
        rows = dict(
            zip(
                [*independent, *solved], casadi.vertsplit(casadi.vertcat(some, others)), strict=True
            )
        )
        return casadi.vertcat(*(rows[k] for k in range(n)))

    q, qd, qdd = (casadi.MX.sym(name, len(independent)) for name in ("q", "qd", "qdd"))
    x, y = casadi.SX.sym("x", len(solved)), casadi.SX.sym("y", len(independent))
    problem = {"x": x, "p": y, "g": residual(assemble(y, x))}
    close = casadi.rootfinder("closing", "newton", problem, {"abstol": 1e-12, "abstolStep": 1e-14})
    u = assemble(q, close(casadi.DM([closure.home[k] for k in solved]), q))
    solved_columns = J(u)[:, solved]
    G = assemble(
        casadi.MX.eye(len(independent)), -casadi.solve(solved_columns, J(u)[:, independent])
    )
    ud = G @ qd
    rest = assemble(casadi.MX.zeros(len(independent)), -casadi.solve(solved_columns, drift(u, ud)))
    motion = {"q": u, "qd": ud, "qdd": G @ qdd + rest}
    functions = {"base_parameters": tree["base_parameters"]}

    def add_public(
        name: str,
        values: Sequence[casadi.MX],
        inputs: Mapping[str, casadi.MX],
        outputs: Sequence[str],
    ) -> None:
        read = {"q", *(x.name() for value in values for x in casadi.symvar(value))}
        reads = {n: x for n, x in inputs.items() if n in read}
        functions[name] = casadi.Function(
            name, list(reads.values()), list(values), list(reads), list(outputs)
        )

    add_public("close", [u], {"q": q}, ["u"])
    add_public("coupling", [G], {"q": q}, ["G"])
    for role, function in tree.items():
        if role in ("base_parameters", "base_regressor_nonzeros"):
            continue
        names = function.name_in()
        more = {n: casadi.MX.sym(n, function.size1_in(n)) for n in names if n not in motion}
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
    graph: Graph, values: Mapping[str, casadi.SX], over: Mapping[int, casadi.SX]
) -> Arithmetic:
    """Arithmetic in which the signs of these speeds turn, each over its width."""
    speeds = Plan(graph, [Expr(graph, speed) for speed in over], _SYMBOLIC)(values)

    def sign(x: casadi.SX) -> casadi.SX:
        for speed, width in zip(speeds, over.values(), strict=True):
            if casadi.is_equal(x, speed, THRESHOLDS.max_compared_depth):
                return casadi.tanh(x / width)
        return casadi.sign(x)

    return Arithmetic(_SYMBOLIC.number, _SYMBOLIC.pi, {**_SYMBOLIC.functions, "sign": sign})


def _split_output(output: ArgumentSpec, numbers: Sequence[casadi.SX]) -> dict[str, casadi.SX]:
    """{name: value}: a vector, a matrix, or of more dimensions a matrix for each first index."""
    *more, last = output.shape
    if not more:
        return {output.name: casadi.vertcat(*numbers)}
    rows = more.pop()
    size, count = rows * last, len(numbers) // (rows * last)
    return {
        f"{output.name}_{k}" if more else output.name: casadi.reshape(
            casadi.vertcat(*numbers[k * size : (k + 1) * size]), last, rows
        ).T
        for k in range(count)
    }


def _build_forward(head: str, functions: Mapping[str, casadi.Function]) -> casadi.Function:
    """Qdd of tau, by the LDL' factors of M."""
    torques = functions[f"{head}inverse_dynamics"]
    symbols = _make_symbols(torques)
    qdd, kind = symbols["qdd"], type(symbols["qdd"])
    still = torques.call([*({**symbols, "qdd": kind.zeros(*qdd.shape)}.values())])[0]
    M = functions["inertia_matrix"].call([symbols["q"], symbols["beta"]])[0]
    tau = kind.sym("tau", *qdd.shape)
    if kind is casadi.SX:
        solved = casadi.ldl_solve(tau - still, *casadi.ldl(M))
    else:
        solved = casadi.solve(M, tau - still)
    names = ["q", "qd", "tau", *(n for n in symbols if n not in ("q", "qd", "qdd"))]
    inputs = [{**symbols, "tau": tau}[n] for n in names]
    return casadi.Function(f"{head}forward_dynamics", inputs, [solved], names, ["qdd"])


def _build_forward_by_newton(
    head: str, functions: Mapping[str, casadi.Function]
) -> casadi.Function:
    """Qdd of tau where friction reads accelerations, or expressions that cancel do."""
    torques = functions[f"{head}inverse_dynamics"]
    symbols = _make_symbols(torques)
    qdd = symbols.pop("qdd")
    symbols = {
        "q": symbols.pop("q"),
        "qd": symbols.pop("qd"),
        "tau": casadi.SX.sym("tau", qdd.numel()),
        **symbols,
    }
    tau = torques.call([{**symbols, "qdd": qdd}[name] for name in torques.name_in()])[0]
    problem = {"x": qdd, "p": casadi.vertcat(*symbols.values()), "g": tau - symbols["tau"]}
    solver = casadi.rootfinder(f"{head}accelerations", "newton", problem, {"abstol": 1e-11})
    inputs = {name: casadi.MX.sym(name, x.numel()) for name, x in symbols.items()}
    start = casadi.DM.zeros(qdd.numel())
    solved = solver(start, casadi.vertcat(*inputs.values()))
    names = list(inputs)
    return casadi.Function(f"{head}forward_dynamics", [*inputs.values()], [solved], names, ["qdd"])


def _insert_values(function: casadi.Function, values: Sequence[float]) -> casadi.Function:
    """The function without its argument beta."""
    symbols = _make_symbols(function)
    if "beta" not in symbols:
        return function
    beta = casadi.DM(list(map(float, values)))
    out = function.call([*{**symbols, "beta": type(symbols["beta"])(beta)}.values()])
    del symbols["beta"]
    return casadi.Function(
        function.name(), [*symbols.values()], out, [*symbols], function.name_out()
    )


def _make_symbols(function: casadi.Function) -> dict[str, Any]:
    """{input: a symbol of its size}, of SX or MX as the function is."""
    kind = casadi.SX if function.is_a("SXFunction") else casadi.MX
    return {name: kind.sym(name, *function.size_in(name)) for name in function.name_in()}
