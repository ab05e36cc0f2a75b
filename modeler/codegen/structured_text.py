"""Structured Text (IEC 61131-3) of a robot without loops: its dynamics as function blocks.

The statements come from the emitter of the C, in the words of another target. Names do not tell
small letters from capital ones and have no two underscores in a row, as the standard wants it.
"""

import dataclasses
import re
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

from modeler.codegen.block import make_block
from modeler.codegen.fitted import Width, find_widths, format_fitted_texts
from modeler.codegen.functions import CFunction
from modeler.codegen.law_tables import build_law_tables
from modeler.codegen.naming import format_legend
from modeler.codegen.package import render
from modeler.codegen.targets import DOUBLE, Target
from modeler.core.errors import EmitError
from modeler.core.manifest import ModuleSpec
from modeler.derivation import SymbolicModel

_ROLES = (
    "inverse_dynamics", "inertia_matrix", "gravity", "coriolis", "friction", "base_parameters",
    "advance",
)  # fmt: skip
_OWN = ("sign", "tanh")
_STANDARD = {"abs": "ABS", "pow": "EXPT"}


def make_identifier(name: str) -> str:
    """A name of C as one of the standard."""
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
    model: SymbolicModel, spec: ModuleSpec, values: Mapping[str, Any], fitted: Sequence[CFunction]
) -> dict[str, str]:
    """{name: text} of the function blocks; of a fitted model, those with its values.

    Args:
        model: as derived.
        spec: the manifest of the module.
        values: what all templates of the module are given.
        fitted: the functions with values; empty without.

    Raises:
        EmitError: the robot has loops, or the module is in single precision.
    """
    if spec.closure is not None:
        raise EmitError(
            f"{spec.robot} has loops, whose closing has no form in Structured Text; leave "
            "--structured-text out, or open them"
        )
    if spec.precision == "single":
        raise EmitError(
            "Structured Text is emitted in LREAL, double precision, only; leave out one of the two"
        )
    by_role = {function.role: function for function, _ in values["blocks"]}
    functions = [*fitted, *(by_role[role] for role in _ROLES if role in by_role)]
    turning = find_widths(spec.prefix, model, fitted)
    prefix, known = make_identifier(spec.prefix), model.geometry.values
    lengths = {name: make_identifier(f"geo_{name}") for name in known}
    places = values["places"] | lengths
    places |= {f"s[{k}]": f"signals[{k}]" for k in range(len(spec.signals))}
    target = _make_target(prefix)
    made = [
        _build_function_block(
            function, prefix, places, turning if function in fitted else {}, target
        )
        for function in functions
    ]
    for each in made:
        own_symbols = [name for name in known if name in each["symbols"]]
        each["constants"] = [(lengths[n], target.format_literal(known[n])) for n in own_symbols]
    unit = (
        format_fitted_texts(spec, spec.fitted, ()) if spec.fitted is not None else {"remarks": []}
    )
    letters = format_legend(letter for each in made for letter in each["letters"])
    text = render(
        "structured_text.st", **{**values, **unit, "spec": spec, "prefix": prefix, "made": made,
         "letters": letters, "laws": build_law_tables([each["block"] for each in made], target)},
    )  # fmt: skip
    return {f"{spec.prefix}.st": text}


def _build_function_block(
    function: CFunction, prefix: str, places: Mapping[str, str], turning: Mapping[int, Width],
    target: Target,
) -> dict[str, Any]:  # fmt: skip
    """Finished strings of one."""
    widths = {speed: make_identifier(width.constant) for speed, width in turning.items()}
    output = function.output.name
    outputs = [(f"{output}[{index}]", value) for index, value in function.entries]
    block = make_block(outputs, places, widths, target)
    written = {index for index, _ in function.entries}
    zeros = [f"{output}[{k}] := 0.0;" for k in range(function.output.size) if k not in written]
    lines = [*zeros, *block.constants, *block.calls, *block.body]
    arguments = [*function.inputs, function.output]
    names = ["signals" if each.name == "s" else each.name for each in arguments]
    return {
        "name": make_identifier(f"{prefix}_{function.role}"),
        "does": function.does.replace("*)", "* )"),
        "arguments": [
            (name, each.size - 1, f"{each.meaning}{', row-major' * (len(each.shape) > 1)}",
             each.unit)
            for name, each in zip(names, arguments, strict=True)
        ],
        "widths": sorted({name for name in widths.values() if f", {name})" in "\n".join(lines)}),
        "declared": re.findall(r"^(\w+) :=", "\n".join(lines), re.MULTILINE),
        "lines": lines,
        "symbols": block.symbols,
        "letters": block.letters,
        "block": block,
    }  # fmt: skip
