"""CUDA of a robot without loops: its base regressor, many samples at once, from the same emitter.

A thread computes the entries of one sample, as the scalar C does. There are two kernels: all
entries into columns, so that neighbouring threads write neighbouring numbers; and, per joint, the
products [W_j tau_j]' [W_j tau_j] of its own columns, summed over samples without a W.
"""

from collections.abc import Mapping
from typing import Any

from modeler.codegen import functions as layout
from modeler.codegen.block import make_block
from modeler.codegen.law_tables import build_law_tables, read_law_source
from modeler.codegen.package import render
from modeler.codegen.targets import CUDA
from modeler.core.errors import EmitError
from modeler.core.manifest import CUDA_THREADS, ModuleSpec

_SHARED = 48 * 1024
"""Bytes that the threads of a block may share on every device."""

_TILES = (32, 16, 8, 4)


def build_cuda_files(values: Mapping[str, Any]) -> dict[str, str]:
    """{name: text} of the CUDA unit, from what all templates of the module are given.

    Raises:
        EmitError: the robot has loops, or the module is in single precision.
    """
    spec: ModuleSpec = values["spec"]
    if spec.closure is not None:
        raise EmitError(
            f"{spec.robot} has loops, whose closing has no CUDA form; leave CUDA out, or open them"
        )
    if spec.precision == "single":
        raise EmitError("CUDA is emitted in double precision only; leave out one of the two")
    function = next(f for f, _ in values["blocks"] if f.role == "base_regressor_nonzeros")
    block = make_block(
        [(f"values[{k}*stride]", value) for k, value in function.entries],
        values["places"],
        target=CUDA,
    )
    names = [argument.name for argument in function.inputs]
    lines = [f"(void){name};" for name in layout.list_unread_inputs(function, block)]
    for part in (block.constants, block.calls, block.body):
        lines += ["", *part] if lines and part else part
    texts = values["symbols"].texts
    text = render(
        "kernel.cu",
        **values,
        block=block,
        lines=lines,
        states=", ".join(f"const double *{name}" for name in names),
        constants=[(values["names"][n], texts[n]) for n in texts if n in block.symbols],
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
        joint_entries = [k for k, (row, _) in enumerate(entries) if row == joint] + [
            len(entries) + joint
        ]
        products += [(a, b) for at, a in enumerate(joint_entries) for b in joint_entries[at:]]
    fitting = (tile for tile in _TILES if columns * (tile + 1) * 8 <= _SHARED)
    return {
        "threads": CUDA_THREADS,
        "tile": next(fitting, 1),
        "products": products,
        "first": layout.wrap_names([a for a, _ in products]),
        "second": layout.wrap_names([b for _, b in products]),
        "joints": layout.wrap_names([row for row, _ in entries] + list(range(joints))),
    }
