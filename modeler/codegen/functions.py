"""Which functions a module has: equation, arguments and the expression of every output."""

import re
import textwrap
import tomllib
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

from modeler.codegen.block import Block, Target
from modeler.codegen.thresholds import THRESHOLDS
from modeler.core.errors import EmitError
from modeler.core.manifest import ArgumentSpec, ModuleSpec
from modeler.derivation import (
    BaseParameter,
    BaseParameters,
    Expr,
    ShaftColumn,
    SymbolicModel,
    format_relation,
)
from modeler.effects import EffectTarget
from modeler.robot import Joint


@dataclass(frozen=True)
class CFunction:
    """One function, still as expressions.

    Attributes:
        unit: C file it stands in, without the robot's name and `.c`.
        role: name without the robot's.
        does: what it computes, one sentence.
        equation: of the manifest.
        inputs: arguments read.
        output: argument written.
        entries: (index into the row-major output, value) of everything that is not zero.
        closed: how it is made from one of the opened tree; None if `entries` say all.
        composed: how it is made of others and can fail; None if `entries` say all.
        internal: True for a function that others call, which the header does not show.
    """

    unit: str
    role: str
    does: str
    equation: str
    inputs: tuple[ArgumentSpec, ...]
    output: ArgumentSpec
    entries: tuple[tuple[int, Expr], ...]
    closed: "Closed | None" = None
    composed: "Composed | None" = None
    internal: bool = False

    @property
    def status(self) -> bool:
        """Returns True if it can fail, and returns a status."""
        return self.closed is not None or self.composed is not None


@dataclass(frozen=True)
class Composed:
    """How a function that can fail is made of others.

    Attributes:
        kind: which macro of the template writes it.
        roles: {word of the macro: role of a function that it calls}.
        turns: how often it calls at most, where it goes on until it has converged.
    """

    kind: str
    roles: Mapping[str, str]
    turns: int = 1

    @property
    def calls(self) -> tuple[str, ...]:
        """Returns the roles of the functions that it calls."""
        return tuple(self.roles.values())


@dataclass(frozen=True)
class Closed:
    """How a function of the closed robot closes the loops and uses one of the opened tree.

    Attributes:
        kind: which macro of the template writes it: "rows" | "projected" | "inertia_matrix" |
            "poses" | "posture" | "coupling".
        loops: C name of the closure.
        q, qd, qdd: C names of the motion that is given; empty where none is.
        start: C name of the closed posture from which the loops are closed.
        role: of the tree's function.
        reads: its further inputs, as C.
        width: columns that are projected.
        tree: start of the names of the tree's functions.
    """

    kind: str
    loops: str
    q: str
    qd: str = ""
    qdd: str = ""
    start: str = "home"
    role: str = ""
    reads: str = ""
    width: int = 1
    tree: str = "tree"

    @property
    def at(self) -> bool:
        """Returns True if it exists at a state too, of which the coordinates are given."""
        return self.loops == "loops" and self.kind != "posture" and self.role != "regressor"

    @property
    def reads_accelerations(self) -> bool:
        """Returns True if it reads accelerations that are given."""
        return "udd" in self.reads.split(", ") and self.qdd != "standing"

    @property
    def calls(self) -> tuple[str, ...]:
        """Returns the roles of the tree's functions that it calls."""
        head = self.loops.removesuffix("loops")
        closing = [f"tree_{head}{part}" for part in ("factor", "solve", "turned")]
        if self.kind not in ("posture", "poses"):
            closing.append(f"tree_{head}coupling")
        if self.qd and self.kind != "rows":
            closing.append("tree_drift")
        return ("tree_closure", "tree_residual", *closing, f"{self.tree}_{self.role}")


@dataclass(frozen=True)
class Arguments:
    """The arguments that functions of a section of functions.toml share.

    Attributes:
        section: of the catalogue.
        specs: {name: argument}; "s" only where effects read signals.
        words: of texts and of shapes: names, units, sizes.
    """

    section: str
    specs: Mapping[str, ArgumentSpec]
    words: Mapping[str, Any]

    def __getitem__(self, name: str) -> ArgumentSpec:
        return self.specs[name]

    def extend(self, section: str, **words: Any) -> "Arguments":
        """Returns these arguments and those of another section."""
        every = {**self.words, **words}
        rows = read_catalogue()[section].get("arguments", {})
        more = {name: _make_argument(every, name, *row) for name, row in rows.items()}
        return Arguments(section, {**self.specs, **more}, every)

    def declare(
        self,
        role: str,
        values: Sequence[Expr] = (),
        words: Mapping[str, Any] = MappingProxyType({}),
        row: str = "",
        **more: Any,
    ) -> CFunction:
        """Returns a function as the catalogue has it.

        Args:
            role: of it, and its row.
            values: of its output, in order; or `entries` among `more`.
            words: of this function's texts and shapes.
            row: another row of the catalogue.
            more: fields of `CFunction`.
        """
        entry, every = read_catalogue()[self.section][row or role], {**self.words, **words}
        output, inputs = entry["output"], entry["inputs"].format(**every).split()
        texts = {
            "unit": entry.get("unit", _UNITS.get(self.section, "")),
            "role": role,
            "does": format_comment(entry["does"].format(**every)),
            "equation": entry["equation"].format(**every),
        }
        fields = {
            **texts,
            "inputs": tuple(self.specs[name] for name in inputs if name in self.specs),
            "output": self.specs[output]
            if isinstance(output, str)
            else _make_argument(every, *output),
            "entries": list_entries(values),
        }
        return CFunction(**fields | more)


_UNITS = {"closed": "_loops", "control": "_control"}
"""C files of the functions of a section, where a row names no other."""


@cache
def read_catalogue() -> Mapping[str, Any]:
    """Returns the rows of functions.toml, by section and role."""
    return tomllib.loads(Path(__file__).with_name("functions.toml").read_text("utf-8"))


def _make_argument(
    words: Mapping[str, Any], name: str, shape: str, unit: str, meaning: str
) -> ArgumentSpec:
    sizes = tuple(int(size) if size.isdigit() else words[size] for size in shape.split())
    return ArgumentSpec(name, sizes, unit.format(**words), meaning.format(**words))


def make_beta_symbols(model: SymbolicModel, base: BaseParameters) -> dict[int, Expr]:
    """Returns {standard column: the base parameter that stands for it}."""
    parameters = enumerate(base.parameters)
    return {p.column: model.graph.symbol(f"beta[{i}]") for i, p in parameters}


def build_tree_functions(model: SymbolicModel, base: BaseParameters) -> tuple[CFunction, ...]:
    """Returns all functions of a module without loops, in the order of the header."""
    arguments = make_arguments(model.robot.free_joints, model, base)
    functions = [*_build_regressors(model, base, arguments)]
    beta = make_beta_symbols(model, base)
    functions += build_dynamics_functions(model, beta, arguments)
    functions.append(build_grouping_function(model, base, arguments))
    poses = model.rigid.derive_forward_kinematics()
    numbers = [value for pose in poses for row in pose for value in row]
    kinematics = arguments.declare("forward_kinematics", numbers, {"rows": len(poses)})
    return (*functions, kinematics)


def make_arguments(
    joints: Sequence[Joint], model: SymbolicModel, base: BaseParameters
) -> Arguments:
    """Returns the arguments of functions whose positions are those of `joints`."""
    units = ([getattr(joint, unit) for joint in joints] for unit in ("unit", "effort_unit"))
    angle, effort = (" or ".join(dict.fromkeys(each)) for each in units)
    rate, acceleration = (" or ".join(u + s for u in angle.split(" or ")) for s in ("/s", "/s2"))
    words: dict[str, Any] = {"angle": angle, "rate": rate, "effort": effort}
    words |= {"acceleration": acceleration}
    words |= {"n": len(joints), "p": len(model.columns), "c": base.rank}
    words |= {"elastic": 2 * len(model.windups)}
    shared = Arguments("", {}, words).extend("shared", signals=len(model.signals))
    if not model.signals:
        shared = replace(shared, specs={k: x for k, x in shared.specs.items() if k != "s"})
    return shared.extend("tree")


def _build_regressors(
    model: SymbolicModel, base: BaseParameters, arguments: Arguments
) -> tuple[CFunction, ...]:
    p, place = len(model.columns), {each.column: i for i, each in enumerate(base.parameters)}
    regressor = model.regressor.items()
    values = {(joint, place[k]): value for (joint, k), value in regressor if k in place}
    order = {at: number for number, at in enumerate(sorted(values))}
    standard, based = sort_by_column(model.regressor), sort_by_column(values)
    return (
        arguments.declare("regressor", entries=tuple((j * p + k, x) for (j, k), x in standard)),
        arguments.declare(
            "base_regressor", entries=tuple((j * base.rank + i, x) for (j, i), x in based)
        ),
        arguments.declare(
            "base_regressor_nonzeros",
            words={"nonzeros": len(based)},
            entries=tuple((order[at], x) for at, x in based),
        ),
    )


def sort_by_column(values: Mapping[tuple[int, int], Expr]) -> list[tuple[tuple[int, int], Expr]]:
    """Returns entries of {(joint, column): value} column after column.

    So what the columns of a link read is computed, read and done with before the next link: row
    after row it would have to be kept for all rows. Most of what does not fit into registers goes:
    a quarter of the code for a microcontroller, and its loads and stores.
    """
    return sorted(values.items(), key=lambda item: (item[0][1], item[0][0]))


def build_dynamics_functions(
    model: SymbolicModel, beta: Mapping[int, Expr], arguments: Arguments
) -> tuple[CFunction, ...]:
    """Returns torques and their parts, without loops; `beta` has the parameter of each column."""
    arguments, held = arguments.extend("tree"), _describe_friction_holds(model)
    words = {
        "also": f", {held}" * bool(held),
        "apart": f", offsets and {held}, which the friction function holds" * bool(held),
        "friction": f"f(q, qd) with {held}" if held else "f(qd)",
        "losing": "q qd qdd s beta" if needs_more_than_speed(model) else "qd beta",
    }
    losses = {k: v for k, v in beta.items() if model.columns[k].kind != "rotor_inertia"}
    torque, still = model.derive_torque, {"accelerations": False, "effects": False}
    values = {  # in this order: it is that of the names in the C
        "inertia_matrix": [x for row in model.rigid.derive_inertia_matrix(beta) for x in row],
        "gravity": model.rigid.derive_torque(beta, speeds=False, **still),
        "coriolis": model.rigid.derive_torque(beta, gravity=False, **still),
        "friction": torque(losses, links=False),
    }
    values = {"inverse_dynamics": torque(beta), **values}
    return tuple(arguments.declare(role, each, words) for role, each in values.items())


def _describe_friction_holds(model: SymbolicModel) -> str:
    """What acts at rest too and is no offset, as "the counterbalance of joint 2"; "" if nothing."""
    joints: dict[str, dict[str, None]] = {}
    for column in model.columns:
        for part in column.parts if isinstance(column, ShaftColumn) else ():
            letters = part.equation.names - part.nonlinear_parameters.keys()
            moved = any(name[0] in "vaz" for name in letters)
            still = part.acts is EffectTarget.POSITION or not moved
            if still and part.kind != "offset":
                joints.setdefault(part.effect, {})[model.robot.joints[part.row].name] = None
    texts = {effect.replace("_", " "): names for effect, names in joints.items()}
    pairs = ((effect, f"joint{'s' * (len(n) > 1)} {', '.join(n)}") for effect, n in texts.items())
    return " and ".join(f"the {effect} of {names}" for effect, names in pairs)


def needs_more_than_speed(model: SymbolicModel) -> bool:
    """Returns True if an effect reads more than the speed of its joint, and is no rotor inertia."""
    return any(
        part.kind != "rotor_inertia"
        and (
            part.acts is EffectTarget.POSITION
            or not part.equation.names <= {"v", *part.nonlinear_parameters}
        )
        for column in model.columns
        if isinstance(column, ShaftColumn)
        for part in column.parts
    )


def needs_torques(model: SymbolicModel) -> bool:
    """Returns True if an effect reads more than the motion of joints."""
    shafts = (column for column in model.columns if isinstance(column, ShaftColumn))
    parts = (part for column in shafts for part in column.parts)
    read = {*_TORQUES}
    return any(p.acts is EffectTarget.POSITION or read & p.equation.names for p in parts)


_TORQUES = ("load", "static", "torque")


def build_grouping_function(
    model: SymbolicModel, base: BaseParameters, arguments: Arguments
) -> CFunction:
    """Returns the grouping relations as a function of the standard parameters."""
    place = {name: model.graph.symbol(f"chi[{k}]") for k, name in enumerate(model.names)}
    values = []
    for parameter in base.parameters:
        total = model.graph.constant(0)
        for term in parameter.terms:
            total = total + model.algebra.static(term.coefficient) * place[term.parameter]
        values.append(total)
    return arguments.extend("tree").declare("base_parameters", values)


def list_entries(values: Sequence[Expr]) -> tuple[tuple[int, Expr], ...]:
    """Returns (place, value) of all values that are not zero."""
    return tuple((k, value) for k, value in enumerate(values) if not value.is_zero)


# Finished strings that the templates lay out: relations, comments, argument lists, bodies.


_WIDTH = 100
_PLAIN = str.maketrans(read_catalogue()["names"]["letters"])


def format_grouping_relation(parameter: BaseParameter) -> str:
    """Returns `ZZ2R = ZZ2 + YY3 + D4**2*M4`; a name alone where nothing is grouped."""
    name, text = parameter.name, format_relation(parameter)
    return name if text == f"{name} = {name}" else text


def format_comment(text: str) -> str:
    """Returns `text` such that it can stand in a C comment.

    No end of comment, ASCII only, short lines.
    """
    text = " ".join(text.replace("*/", "* /").replace("/*", "/ *").split())
    plain = unicodedata.normalize("NFC", text).translate(_PLAIN)
    letters = (c for c in unicodedata.normalize("NFKD", plain) if not unicodedata.combining(c))
    text = "".join(letters).encode("ascii", "replace").decode()
    return "\n * ".join(textwrap.wrap(text, _WIDTH - 4))


def format_comment_lines(sentences: Iterable[str]) -> list[str]:
    """Returns sentences as lines for the inside of a C comment."""
    return [line for each in sentences for line in format_comment(each).split("\n * ")]


def format_parameter_lines(
    spec: ModuleSpec, relations: Sequence[str]
) -> tuple[list[str], list[str]]:
    """Returns comment lines that say which column is which parameter: (standard, base).

    Args:
        spec: of the module.
        relations: what `relation` writes of each base parameter.
    """
    lines = enumerate(spec.standard)
    standard = [f"{i:4d}  {parameter.name:<8} {parameter.unit}" for i, parameter in lines]
    base = []
    for i, (parameter, text) in enumerate(zip(spec.base, relations, strict=True)):
        base += textwrap.wrap(
            f"{i:4d}  {text}  [{parameter.unit}]",
            _WIDTH - 4,
            subsequent_indent=" " * 8,
            break_long_words=False,
            break_on_hyphens=False,
        )
    return [format_comment_line(line) for line in standard], [
        line.replace("*/", "* /") for line in base
    ]


def format_comment_line(text: str) -> str:
    """Returns one line for the inside of a C comment, spaces kept."""
    return text.rstrip().replace("*/", "* /")


def format_argument_lines(function: CFunction) -> list[str]:
    """Returns comment lines that say of every argument its length, order and unit."""
    arguments = (*function.inputs, function.output)
    lengths = [" x ".join(str(size) for size in argument.shape) for argument in arguments]
    width = max(9, *(len(length) + 1 for length in lengths))
    name = max(7, *(len(argument.name) + 1 for argument in arguments))
    lines = []
    for argument, length in zip(arguments, lengths, strict=True):
        order = ", row-major" if len(argument.shape) > 1 else ""
        text = f"{argument.meaning}{order} [{argument.unit}]"
        start = f"{argument.name:<{name}}{length:<{width}}"
        lines += textwrap.wrap(
            start + text,
            _WIDTH - 4,
            subsequent_indent=" " * len(start),
            break_long_words=False,
            break_on_hyphens=False,
        )
    return lines


_LENGTHS = {
    name: macro for macro, x in read_catalogue()["names"]["lengths"].items() for name in x.split()
}
"""Macros of the lengths of arguments, after the robot's name."""


def format_arguments(
    function: CFunction, number: str, prefix: str, defined: bool = False
) -> list[str]:
    """Returns C parameters of that type with their bounds, inputs const.

    Args:
        function: whose they are.
        number: C type.
        prefix: of the module.
        defined: where the function is defined, nothing else points to its output.
    """

    def format_bound(argument: ArgumentSpec) -> str:
        macro = _LENGTHS.get(argument.name)
        other = argument is function.output and argument.name == "a"  # no acceleration of joints
        if macro is None or function.internal or other:
            return " * ".join(map(str, argument.shape))
        return f"{prefix}_{macro}".upper()

    inputs = [f"const {number} {a.name}[{format_bound(a)}]" for a in function.inputs]
    name, length = function.output.name, format_bound(function.output)
    out = f"MODELER_OUT({name}, {length})" if defined else f"{name}[{length}]"
    return [*inputs, f"{number} {out}"]


def format_prototype(name: str, parameters: Sequence[str], returns: str = "void") -> str:
    """Returns `void name(...)`, in lines of readable length."""
    indent = " " * (len(returns) + len(name) + 2)
    if len(indent) + max(map(len, parameters)) > _WIDTH - 3:
        indent = " " * 8
    return "\n".join(
        textwrap.wrap(
            f"{returns} {name}({', '.join(p.replace(' ', chr(160)) for p in parameters)})",
            _WIDTH - 1,  # and a semicolon
            subsequent_indent=indent,
            break_long_words=False,
            break_on_hyphens=False,
        )
    ).replace(chr(160), " ")


def format_signal_lines(spec: ModuleSpec) -> list[str]:
    """Returns comment lines that say what each entry of the input s is."""
    meaning = read_catalogue()["signals"]
    texts = ((s, meaning[s.kind].format(joint=s.joint, value=s.value)) for s in spec.signals)
    return [f"{k:4d}  {text} [{s.unit}]" for k, (s, text) in enumerate(texts)]


def format_body(function: CFunction, block: Block, target: Target) -> list[str]:
    """Returns all statements of a function."""
    name, size = function.output.name, function.output.size
    written = {index for index, _ in function.entries}
    zeros = [index for index in range(size) if index not in written]
    lines = [f"(void){name};" for name in list_unread_inputs(function, block)]
    body = list(block.body)
    if len(zeros) > THRESHOLDS.max_single_zeros:
        lines.append(f"MODELER_ALL_ZEROS({name}, {size});")
        runs: list[tuple[int, int]] = []  # (first, length) of neighbouring places
        for place in zeros:
            first, length = runs[-1] if runs else (place, 0)
            if place == first + length and 0 < length < THRESHOLDS.zeros_per_statement:
                runs[-1] = (first, length + 1)
            else:
                runs.append((place, 1))
        # Evenly between the statements: stores that wait for no arithmetic.
        stores = [f"MODELER_ZEROS({name} + {first}, {length});" for first, length in runs]
        due = [k * len(stores) // len(body) for k in range(len(body))] + [len(stores)]
        statements, body, done = body, [], 0
        for k, end in enumerate(due):
            body += [*stores[done:end], *statements[k : k + 1]]
            done = end
    else:
        lines += [f"{name}[{index}] = {target.format_literal(0.0)};" for index in zeros]
    for part in (block.constants, block.calls, body):
        lines += ["", *part] if lines and part else part
    return lines


def list_unread_inputs(function: CFunction, block: Block) -> Iterable[str]:
    """Returns names of the inputs of which no entry is read."""
    for argument in function.inputs:
        if argument.name == "widths":  # of signs, which are no symbols
            continue
        if block.symbols.isdisjoint(f"{argument.name}[{i}]" for i in range(argument.shape[0])):
            yield argument.name


def wrap_names(names: Iterable[object]) -> list[str]:
    """Returns words or numbers of a C table or enum, in lines of readable length."""
    options: Any = {"break_long_words": False, "break_on_hyphens": False}
    return textwrap.wrap(", ".join(map(str, names)), _WIDTH - 4, **options)


# C names: of the module, of geometric symbols, of arrays.


_HEADERS = read_catalogue()["names"]["headers"]["c99"].split()  # of C99: theirs would be ours


def make_prefix(robot: str) -> str:
    """Returns start of all C names of a robot.

    `sr400-tree` -> `sr400_tree`, `3rrr` -> `robot_3rrr`.

    Raises:
        EmitError: the name would clash with the runtime's or a header of C.
    """
    prefix = re.sub(r"[^A-Za-z0-9_]+", "_", robot).strip("_").lower() or "robot"
    if prefix[0].isdigit():
        prefix = f"robot_{prefix}"
    if prefix == "modeler" or prefix.startswith("modeler_"):
        raise EmitError(f'name "{robot}": names that start with modeler_ are taken; choose another')
    if prefix in _HEADERS:
        raise EmitError(f'name "{robot}": {prefix}.h is a header of C; choose another')
    return prefix


def name_macros(prefix: str, symbols: Iterable[str]) -> dict[str, str]:
    """Returns {geometric symbol: macro}, spelled as in the table: D4 -> PUMA560_GEO_D4.

    The `GEO` keeps them apart from macros of the header (PUMA560_JOINTS) and of <math.h>: robot
    `fp` with a symbol `NAN` would define FP_NAN.

    Raises:
        EmitError: a symbol is not a C name.
    """
    macros: dict[str, str] = {}
    for symbol in symbols:
        if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", symbol):
            raise EmitError(
                f"symbol {symbol} has letters that C names cannot have; use a-z, A-Z, 0-9 and _"
            )
        macros[symbol] = f"{prefix.upper()}_GEO_{symbol}"
    return macros


def name_enumerators(prefix: str, kind: str, names: Iterable[str]) -> list[str]:
    """Returns C constants of places in a list of parameters.

    PUMA560_BETA_ZZ1R, spelled as it is printed.

    `BETA` and `CHI` keep them apart from the header's other names, as GEO does symbols. The reader
    of robot files sees to it that parameters have different names of letters, digits and `_`.

    Args:
        prefix: of the module.
        kind: "beta" or "chi".
        names: of the parameters, in order.
    """
    return [f"{prefix}_{kind}_".upper() + name for name in names]


def name_constants(prefix: str, symbols: Iterable[str]) -> dict[str, str]:
    """Returns {geometric symbol: C constant that the functions read}: D4 -> puma560_geo_D4.

    What stands in a macro is text, and may be any expression: `-0.613-0.01` squared would be no
    square. As the initialiser of a `const double` it is one number.
    """
    return {symbol: f"{prefix}_geo_{symbol}" for symbol in symbols}


def map_graph_symbols(
    joints: int, symbols: dict[str, str], arrays: Iterable[str]
) -> dict[str, str]:
    """Returns C text of every graph symbol.

    Entries of arrays as they are named, geometric symbols.
    """
    kinds = ("q", "qd", "qdd", "dq", "v", "a", "tau")
    inputs = [f"{kind}[{i}]" for kind in kinds for i in range(joints)]
    return {**symbols, **{name: name for name in (*inputs, *arrays)}}
