"""A2L (ASAM MCD-2 MC 1.7) of the parameter set that a controller changes while it runs.

A calibration tool finds the numbers of the variable `<prefix>_parameters`, a `<prefix>_set`, by its
symbol: addresses are those of the linker, which such tools read from the program.
"""

import re
from collections.abc import Mapping, Sequence
from typing import Any

from modeler.codegen.fitted import find_widths
from modeler.codegen.functions import CFunction
from modeler.codegen.package import render
from modeler.codegen.parameter_set import SMOOTH
from modeler.core.manifest import ModuleSpec
from modeler.derivation import SymbolicModel

_WORD = 4  # bytes of uint32_t
_SIZE = {"double": 8, "single": 4}


def build_a2l_files(
    model: SymbolicModel, spec: ModuleSpec, values: Mapping[str, Any],
    functions: Sequence[CFunction],
) -> dict[str, str]:  # fmt: skip
    """{name: text} of the description.

    Args:
        model: as derived.
        spec: of the module, with the controller's unit.
        values: what all templates of the module are given.
        functions: of the module, those of the controller's unit too.
    """
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
        for base, relation in zip(spec.base, values["relations"], strict=True)
    ]
    smooth = find_widths(prefix, model, [f for f in functions if f.role.startswith(SMOOTH)])
    about = "width over which dry friction turns, 0: none"
    rows += [
        {"name": width.constant, "about": about, "unit": width.unit, "positive": True}
        for width in dict.fromkeys(smooth.values())
    ]
    for at, row in enumerate(rows):
        row |= {"offset": start + size * at, "about": re.sub(r'["\\]', "'", row["about"])}
    units = list(dict.fromkeys(row["unit"] for row in rows))
    text = render(
        "a2l", **{**values, "spec": spec, "rows": rows, "units": units,
        "number": "FLOAT64_IEEE" if size == 8 else "FLOAT32_IEEE",
        "checksum": start + size * len(rows)},
    )  # fmt: skip
    return {f"{prefix}.a2l": text}
