"""The functions of a robot for CasADi, from the expressions that are printed as C.

They stand here and not among the exports, since they are one more printer of the same list of
functions: what the C has they have, with its names, arguments and order of entries.
"""

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction

import casadi

from modeler.codegen import functions as layout
from modeler.codegen.control import Control, control_functions
from modeler.codegen.fitted import widths
from modeler.codegen.functions import CFunction
from modeler.core.errors import DataError
from modeler.core.manifest import ArgumentSpec
from modeler.derivation import Arithmetic, BaseParameters, Plan, SymbolicModel

_OPERATIONS = {
    name: getattr(casadi, name) for name in ("sin", "cos", "tan", "sqrt", "exp", "sign", "tanh")
}
_SYMBOLIC = Arithmetic(
    float,
    lambda: casadi.pi,
    {
        **_OPERATIONS, "abs": casadi.fabs, "pow": casadi.power, "add": casadi.plus,
        "mul": casadi.times, "div": casadi.rdivide,
    },
)  # fmt: skip

_DEEP = 1000  # nodes to which two speeds are compared


def casadi_file(
    model: SymbolicModel, base: BaseParameters, values: Sequence[float] | None = None
) -> tuple[bytes, dict[str, str], tuple[str, ...]]:
    """What `casadi.FileDeserializer(FILE).unpack()` reads: a list of functions.

    Args:
        model: without loops.
        base: the base parameters of the same model.
        values: of them, which take the place of the argument beta.

    Returns:
        The file; {function: its inputs and outputs}; what is not in it, a sentence each.

    Raises:
        DataError: a robot with loops.
    """
    if model.closure is not None:
        raise DataError(
            f"{model.robot.name} has loops: CasADi's functions are those of trees, without "
            "closing; cut the loops in the robot file, and state them as constraints"
        )
    found, missing = casadi_functions(model, base)
    if values is not None:
        found = [_with_values(each, values) for each in found]
    packed = casadi.StringSerializer()
    packed.pack(found)
    signatures = {each.name(): str(each).partition(":")[2].rpartition(" SX")[0] for each in found}
    return packed.encode().encode(), signatures, missing


def casadi_functions(
    model: SymbolicModel, base: BaseParameters
) -> tuple[list[casadi.Function], tuple[str, ...]]:
    """The functions of a robot without loops, and what is not among them.

    Besides those of the C: `forward_dynamics(q, qd, tau, beta)`, qdd of M qdd = tau - c - g - f,
    and of each function that reads the sign of a speed one named `smooth_`, with the input
    `widths`, over which sign(v) turns as tanh(v/width).
    """
    listed = (*layout.tree_functions(model, base), *control_functions(model, base, Control()))
    functions = {f.role: f for f in listed}
    turning = widths("", model, [functions["inverse_dynamics"]])
    names = [width.constant for width in turning.values()]
    places = {speed: names.index(width.constant) for speed, width in turning.items()}
    found = {role: _function(model, f, role) for role, f in functions.items()}
    if turning:
        for role in ("inverse_dynamics", "friction"):
            smooth = f"smooth_{role}"
            found[smooth] = _function(model, functions[role], smooth, places)
    missing: tuple[str, ...] = ()
    qdd = functions["friction"].inputs
    if any(argument.name == "qdd" for argument in qdd):
        missing = ("forward_dynamics: friction reads accelerations here; solve inverse_dynamics",)
    else:
        for head in ("", "smooth_")[: 1 + bool(turning)]:
            found[f"{head}forward_dynamics"] = _forward(head, found)
    return list(found.values()), missing


def _function(
    model: SymbolicModel, f: CFunction, name: str, places: Mapping[int, int] | None = None
) -> casadi.Function:
    """One of the C; `places` says which entry of an input `widths` each speed turns over."""
    inputs = {a.name: casadi.SX.sym(a.name, a.size) for a in f.inputs}
    values = {f"{n}[{k}]": x[k] for n, x in inputs.items() for k in range(x.numel())}
    values |= {name: casadi.SX(x) for name, x in model.geometry.values.items()}
    arithmetic = _SYMBOLIC
    if places is not None:
        inputs["widths"] = casadi.SX.sym("widths", 1 + max(places.values()))
        arithmetic = _turning(model, values, places, inputs["widths"])
    numbers = [casadi.SX(0)] * f.output.size
    outputs = Plan(model.graph, [value for _, value in f.entries], arithmetic)(values)
    for (place, _), x in zip(f.entries, outputs, strict=True):
        numbers[place] = x
    parts = _parts(f.output, numbers)
    given = list(inputs.values()), list(parts.values()), list(inputs), list(parts)
    return casadi.Function(name, *given)


def _turning(
    model: SymbolicModel, values: Mapping[str, casadi.SX], places: Mapping[int, int],
    over: casadi.SX,
) -> Arithmetic:  # fmt: skip
    """Arithmetic in which the signs of these speeds turn."""
    exprs = [type(model.graph.constant(0))(model.graph, speed) for speed in places]
    speeds = Plan(model.graph, exprs, _SYMBOLIC)(values)

    def sign(x: casadi.SX) -> casadi.SX:
        for speed, place in zip(speeds, places.values(), strict=True):
            if casadi.is_equal(x, speed, _DEEP):
                return casadi.tanh(x / over[place])
        return casadi.sign(x)

    return Arithmetic(_SYMBOLIC.number, _SYMBOLIC.pi, {**_SYMBOLIC.functions, "sign": sign})


def _parts(output: ArgumentSpec, numbers: Sequence[casadi.SX]) -> dict[str, casadi.SX]:
    """{name: value}: a vector, a matrix, or of more dimensions a matrix for each first index."""
    *more, last = output.shape
    if not more:
        return {output.name: casadi.vertcat(*numbers)}
    rows = more.pop()
    size, count = rows * last, len(numbers) // (rows * last)
    return {
        f"{output.name}_{k}" if more else output.name:
            casadi.reshape(casadi.vertcat(*numbers[k * size : (k + 1) * size]), last, rows).T
        for k in range(count)
    }  # fmt: skip


def _forward(head: str, found: Mapping[str, casadi.Function]) -> casadi.Function:
    """Qdd of tau, by the LDL' factors of M."""
    torques = found[f"{head}inverse_dynamics"]
    given = {n: casadi.SX.sym(n, *torques.size_in(n)) for n in torques.name_in()}
    qdd = given.pop("qdd")
    tau = casadi.SX.sym("tau", *qdd.shape)
    still = torques(*({**given, "qdd": casadi.SX(*qdd.shape)}[n] for n in torques.name_in()))
    M = found["inertia_matrix"](given["q"], given["beta"])
    given = {n: x for n, x in given.items() if n != "beta"} | {"tau": tau, "beta": given["beta"]}
    if "widths" in given:
        given["widths"] = given.pop("widths")  # last
    solved = casadi.ldl_solve(tau - still, *casadi.ldl(M))
    name = f"{head}forward_dynamics"
    return casadi.Function(name, list(given.values()), [solved], list(given), ["qdd"])


def _with_values(function: casadi.Function, values: Sequence[float]) -> casadi.Function:
    """The function without its argument beta."""
    names = function.name_in()
    if "beta" not in names:
        return function
    given = {n: casadi.SX.sym(n, *function.size_in(n)) for n in names}
    beta = casadi.SX(list(map(float, values)))
    out = function.call([{**given, "beta": beta}[n] for n in names])
    kept = {n: x for n, x in given.items() if n != "beta"}
    return casadi.Function(
        function.name(), list(kept.values()), out, list(kept), function.name_out()
    )
