"""A2L (ASAM MCD-2 MC 1.7) of the parameter set that a controller changes while it runs.

A calibration tool finds the numbers of the variable `<prefix>_parameters`, a `<prefix>_set`, by its
symbol: addresses are those of the linker, which such tools read from the program.
"""

import re
from collections.abc import Mapping, Sequence
from typing import Any

from modeler.codegen.fitted import Width
from modeler.codegen.package import render
from modeler.core.errors import EmitError
from modeler.core.manifest import ModuleSpec

_WORD = 4  # bytes of uint32_t
_SIZE = {"double": 8, "single": 4}


def a2l_files(
    spec: ModuleSpec, values: Mapping[str, Any], smooth: Sequence[Width]
) -> dict[str, str]:
    """{name: text} of the description.

    Args:
        spec: of the module, with the controller's unit.
        values: what all templates of the module are given.
        smooth: the widths of the set.

    Raises:
        EmitError: without the controller's unit there is no set.
    """
    if spec.control is None:
        raise EmitError(f"{spec.robot}: A2L is of the controller's unit; write a folder with it")
    size, start = _SIZE[spec.precision], 2 * _WORD
    prefix = spec.prefix
    rows = [
        {
            "name": f"{prefix}_beta_{base.name}",
            "about": relation,
            "unit": base.unit,
            "least": 0 if base.kind in ("viscous", "coulomb") else -1,
        }
        for base, relation in zip(spec.base, values["relations"], strict=True)
    ]
    rows += [
        {"name": width.constant, "about": "width over which dry friction turns, 0: none",
         "unit": width.unit, "least": 0}
        for width in smooth
    ]  # fmt: skip
    for at, row in enumerate(rows):
        row |= {"offset": start + size * at, "about": re.sub(r'["\\]', "'", row["about"])}
    units = list(dict.fromkeys(row["unit"] for row in rows))
    text = render(
        "a2l", **{**values, "spec": spec, "rows": rows, "units": units,
        "number": "FLOAT64_IEEE" if size == 8 else "FLOAT32_IEEE",
        "largest": "1000000000000.0", "checksum": start + size * len(rows)},
    )  # fmt: skip
    return {f"{prefix}.a2l": text}
