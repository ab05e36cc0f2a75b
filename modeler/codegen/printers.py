"""The module in other languages: CUDA, Structured Text, A2L."""

import dataclasses
import re
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

from modeler.codegen import functions as layout
from modeler.codegen.block import CUDA, DOUBLE, Target, format_legend, make_block
from modeler.codegen.context import ModuleContext, build_law_tables, read_law_source
from modeler.codegen.control import SMOOTH, Width, find_widths, format_fitted_texts
from modeler.codegen.functions import CFunction
from modeler.core.errors import EmitError
from modeler.core.manifest import CUDA_THREADS, ModuleSpec
from modeler.derivation import Label

_SHARED = 48 * 1024
"""Bytes that the threads of a block may share on every device."""

_TILES = (32, 16, 8, 4)


def build_cuda_files(module: ModuleContext, labels: Mapping[int, Label]) -> dict[str, str]:
    """Returns {name: text} of the CUDA unit; `labels` are of the graph's nodes.

    Raises:
        EmitError: the robot has loops, or the module is in single precision.
    """
    spec, texts = module.spec, module.symbols.texts
    if spec.closure is not None:
        raise EmitError(
            f"{spec.robot} has loops, whose closing has no CUDA form; leave CUDA out, or open them"
        )
    if spec.precision == "single":
        raise EmitError("CUDA is emitted in double precision only; leave out one of the two")
    function = next(f for f in module.written if f.role == "base_regressor_nonzeros")
    outputs = [(f"values[{k}*stride]", value) for k, value in function.entries]
    block = make_block(outputs, module.places, target=CUDA, labels=labels)
    lines = [f"(void){name};" for name in layout.list_unread_inputs(function, block)]
    for part in (block.constants, block.calls, block.body):
        lines += ["", *part] if lines and part else part
    text = module.render(
        "kernel.cu",
        block=block,
        lines=lines,
        states=", ".join(f"const double *{argument.name}" for argument in function.inputs),
        constants=module.constants([block], texts),
        shape=_plan_products(spec),
        laws=build_law_tables([block], CUDA),
        law_source=read_law_source(),
    )
    return {f"{spec.prefix}.cu": text}


def _plan_products(spec: ModuleSpec) -> dict[str, Any]:
    """How the products of one robot are spread over a block.

    Its threads, the samples at hand (a tile), and C tables: of the first and second of each pair of
    entries, torques counted after them, and of whose row each entry and torque is.
    """
    entries, joints = spec.nonzeros, len(spec.joints)
    columns = len(entries) + joints
    products = []
    for joint in range(joints):
        places = [k for k, (row, _) in enumerate(entries) if row == joint] + [len(entries) + joint]
        products += [(a, b) for at, a in enumerate(places) for b in places[at:]]
    fitting = (tile for tile in _TILES if columns * (tile + 1) * 8 <= _SHARED)
    return {
        "threads": CUDA_THREADS,
        "tile": next(fitting, 1),
        "products": products,
        "first": layout.wrap_names([a for a, _ in products]),
        "second": layout.wrap_names([b for _, b in products]),
        "joints": layout.wrap_names([row for row, _ in entries] + list(range(joints))),
    }


# Structured Text (IEC 61131-3) of a robot without loops: its dynamics as function blocks.
#
# The statements come from the emitter of the C, in the words of another target. Names do not tell
# small letters from capital ones and have no two underscores in a row, as the standard needs it.


_DYNAMICS = ("inverse_dynamics", "inertia_matrix", "gravity", "coriolis", "friction")
_ROLES = (*_DYNAMICS, "base_parameters", "advance", "reset", "elastic_feedforward")
_OWN = ("sign", "tanh")
_STANDARD = {"abs": "ABS", "pow": "EXPT"}


def make_identifier(name: str) -> str:
    """Returns a name of C as one of the standard."""
    return re.sub("__+", "_", name).strip("_")


def _make_target(prefix: str) -> Target:
    """How a value is written for a robot, whose helpers have its name."""
    names = {name: _STANDARD.get(name, name.upper()) for name in DOUBLE.functions}
    names |= {name: f"{prefix}_{name}" for name in _OWN}
    return dataclasses.replace(
        DOUBLE,
        number="LREAL",
        functions=MappingProxyType(names),
        smooth_sign=f"{prefix}_smooth_sign",
        law=f"{prefix}_{{name}}({{arguments}})",
        point=True,
        temporary="{name} := {text};",
        stored="{place} := {text};",
        turn=("s{name} := SIN({angle});", "c{name} := COS({angle});"),
        remark="(* {} *)",
    )


def build_structured_text(
    module: ModuleContext, fitted: Sequence[CFunction], labels: Mapping[int, Label]
) -> dict[str, str]:
    """Returns {name: text} of the function blocks; of a fitted model, those with its values.

    Args:
        module: with the functions of the robot.
        fitted: the functions with values; empty without.
        labels: of the graph's nodes.

    Raises:
        EmitError: the robot has loops, or the module is in single precision.
    """
    spec, model = module.spec, module.model
    if spec.closure is not None:
        raise EmitError(
            f"{spec.robot} has loops, whose closing has no form in Structured Text; leave "
            "--structured-text out, or open them"
        )
    if spec.precision == "single":
        raise EmitError(
            "Structured Text is emitted in LREAL, double precision, only; leave out one of the two"
        )
    steps = list(map(_remove_status, (*module.written, *fitted)))
    by_role = {f.role: f for f in steps if f is not None}
    fitted = [by_role[f.role] for f in fitted if f.role in by_role]
    functions = [*fitted, *(by_role[role] for role in _ROLES if role in by_role)]
    turning = find_widths(spec.prefix, model, fitted)
    prefix, known = make_identifier(spec.prefix), model.geometry.values
    lengths = {name: make_identifier(f"geo_{name}") for name in known}
    places = {**module.places, **lengths}
    places |= {f"s[{k}]": f"signals[{k}]" for k in range(len(spec.signals))}
    target = _make_target(prefix)
    made = [
        _build_function_block(f, prefix, places, turning if f in fitted else {}, target, labels)
        for f in functions
    ]
    for each in made:
        own_symbols = [name for name in known if name in each["block"].symbols]
        each["constants"] = [(lengths[n], target.format_literal(known[n])) for n in own_symbols]
    unit = {"remarks": []} if spec.fitted is None else format_fitted_texts(spec, spec.fitted, ())
    blocks = [each["block"] for each in made]
    texts = {
        **unit,
        "prefix": prefix,
        "made": made,
        "letters": format_legend(letter for block in blocks for letter in block.letters),
        "laws": build_law_tables(blocks, target),
    }
    text = module.render("structured_text.st", **texts)
    return {f"{spec.prefix}.st": text}


def _remove_status(function: CFunction) -> CFunction | None:
    """What a function does whose inputs another one checks, by that one's name; None of a check."""
    if function.composed is not None and function.composed.kind == "stepped":
        return None
    return dataclasses.replace(function, role=function.role.removesuffix("_step"))


def _build_function_block(
    function: CFunction,
    prefix: str,
    places: Mapping[str, str],
    turning: Mapping[int, Width],
    target: Target,
    labels: Mapping[int, Label],
) -> dict[str, Any]:
    """Finished strings of one."""
    widths = {speed: make_identifier(width.constant) for speed, width in turning.items()}
    output = function.output.name
    outputs = [(f"{output}[{index}]", value) for index, value in function.entries]
    block = make_block(outputs, places, widths, target, labels)
    written = {index for index, _ in function.entries}
    zeros = [f"{output}[{k}] := 0.0;" for k in range(function.output.size) if k not in written]
    lines = [*zeros, *block.constants, *block.calls, *block.body]
    arguments = [*function.inputs, function.output]
    names = ["signals" if each.name == "s" else each.name for each in arguments]
    return {
        "name": make_identifier(f"{prefix}_{function.role}"),
        "does": function.does.replace("*)", "* )"),
        "arguments": [
            (
                name,
                each.size - 1,
                f"{each.meaning}{', row-major' * (len(each.shape) > 1)}",
                each.unit,
            )
            for name, each in zip(names, arguments, strict=True)
        ],
        "widths": sorted({name for name in widths.values() if f", {name})" in "\n".join(lines)}),
        "declared": re.findall(r"^(\w+) :=", "\n".join(lines), re.MULTILINE),
        "lines": lines,
        "block": block,
    }


# A2L (ASAM MCD-2 MC 1.7) of the parameter set that a controller changes while it runs.
#
# A calibration tool finds the numbers of the variable `<prefix>_parameters`, a `<prefix>_set`, by
# its symbol: addresses are those of the linker, which such tools read from the program.


_WORD = 4  # bytes of uint32_t
_SIZE = {"double": 8, "single": 4}


def build_a2l_files(module: ModuleContext, functions: Sequence[CFunction]) -> dict[str, str]:
    """Returns {name: text} of the description; `functions` are all of the module."""
    spec, relations = module.spec, module.values["relations"]
    size, start = _SIZE[spec.precision], 2 * _WORD
    prefix = spec.prefix
    signed = {each.name for each in spec.standard if not each.nonnegative}
    rows = [
        {
            "name": f"{prefix}_beta_{base.name}",
            "about": relation,
            "unit": base.unit,
            "positive": base.kind == "friction" and base.column_of not in signed,
        }
        for base, relation in zip(spec.base, relations, strict=True)
    ]
    smooth = find_widths(prefix, module.model, [f for f in functions if f.role.startswith(SMOOTH)])
    about = "width over which dry friction turns, 0: none"
    rows += [
        {"name": width.constant, "about": about, "unit": width.unit, "positive": True}
        for width in dict.fromkeys(smooth.values())
    ]
    for at, row in enumerate(rows):
        row |= {"offset": start + size * at, "about": re.sub(r'["\\]', "'", row["about"])}
    units = list(dict.fromkeys(row["unit"] for row in rows))
    text = module.render(
        "a2l",
        rows=rows,
        units=units,
        number="FLOAT64_IEEE" if size == 8 else "FLOAT32_IEEE",
        checksum=start + size * len(rows),
    )
    return {f"{prefix}.a2l": text}
