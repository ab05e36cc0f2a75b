"""Guegan, Khalil and Lemoine 2003, eqs. (1), (2), (23) to (30): their blocks beside the emitted C.

Every block is evaluated from its formulas, those of `modeler derive --blocks`, at random closed
states; so is what the scan prints in its place, letter by letter.
"""

import numpy as np

from modeler.codegen import Derivation
from modeler.derivation import draw_random_states
from modeler.formulas import SheetWriter, derive_leg_blocks
from modeler.papers.methods import MethodRow, MethodTable, Outcome, judge_outcome
from modeler.runtime import CompiledModel

STATES, SEED = 20, 2003
SAME, WRONG = 1e-12, 1e-2
"""Shares of the largest entry: what two computations of a block may differ by; another block."""

_SETTING = (
    f"at {STATES} random closed states, as a share of the largest entry: formulas of `modeler "
    "derive --blocks`",
    "against base regressor and coupling of the emitted C; with the scan's J_i^T in place of "
    "J_i^-T they are off",
)


def build_block_table(*robots: tuple[Derivation, CompiledModel]) -> MethodTable:
    """The blocks of robots with three legs as printed, as derived, and in the emitted C.

    Args:
        robots: with legs of their own, and with legs alike.
    """
    rows = [row for derivation, compiled in robots for row in _compare_blocks(derivation, compiled)]
    return MethodTable("Blocks of eqs. (1), (2) and (23) to (30)", _SETTING, tuple(rows))


def _compare_blocks(derivation: Derivation, compiled: CompiledModel) -> list[MethodRow]:
    model, closure = derivation.model, derivation.model.closure
    assert closure is not None
    states = draw_random_states(model, STATES, np.random.default_rng(SEED))
    at, free = list(closure.actuated), [joint.name for joint in model.robot.free_joints]
    q, qd, qdd = (numbers[:, at] for numbers in states)
    phi, G = compiled.base_regressor(q, qd, qdd), compiled.coupling(q)
    names = [p.name for p in derivation.base.parameters]
    read: dict[str, np.ndarray | float] = dict(model.geometry.values)
    for kind, numbers in zip(("q", "qd", "qdd"), states, strict=True):
        read |= {f"{kind}[{k}]": column for k, column in enumerate(numbers.T)}
    of, c = dict[str, np.ndarray](), dict[str, np.ndarray]()  # our block; the same of the C
    for block in derive_leg_blocks(model, derivation.base, SheetWriter(model.graph, {})):
        of[block.name] = np.zeros((STATES, len(block.rows), len(block.columns)))
        block_values = model.graph.evaluate_outputs([*block.entries.values()], read)
        for (row, column), value in zip(block.entries, block_values, strict=True):
            of[block.name][:, block.rows.index(row), block.columns.index(column)] = value
        known = block.columns[0] in names
        c[block.name] = (
            phi[:, :, [names.index(x) for x in block.columns]] if known
            else G[:, [free.index(x) for x in block.rows]]
        )  # fmt: skip
    return _build_rows(of, c, [name[2:] for name in of if name.startswith("DL")], phi)


def _build_rows(
    of: dict[str, np.ndarray], c: dict[str, np.ndarray], legs: list[str], phi: np.ndarray
) -> list[MethodRow]:
    Jp = of["Jp"].swapaxes(1, 2)  # J_p^T
    DP, drives, ends, scans = Jp @ of["WP"], list[np.ndarray](), [], []
    for i, k in enumerate(legs):
        inverse, D = of[f"J{k}inv"], of[f"DL{k}"]
        drives.append(of[f"Dm{k}"] * np.eye(len(legs))[i][:, None])  # on the motor's row
        ends.append(Jp @ inverse.swapaxes(1, 2) @ D)
        scans.append(Jp @ np.linalg.inv(inverse).swapaxes(1, 2) @ D)
    if c["DL1"].shape[2] * len(legs) > phi.shape[2]:  # shared: legs alike
        printed, right = "Jp^T sum_i [Ji^T DLi]", np.sum(ends, axis=0)
        return [_build_row("(30) DLS", printed, right, c["DL1"], np.sum(scans, axis=0)),
                _build_row("(30) Dsym", "its blocks", np.dstack([DP, *drives, right]),
                     np.dstack([c["WP"], *(c[f"Dm{k}"] for k in legs), c["DL1"]]))]  # fmt: skip
    rows = [_build_row("(1) Jp^-1", "Ld = Jp^-1 V", of["Jpinv"] @ of["Jp"], c["Jpinv"])]
    rows += [
        _build_row(f"(2) J{k}^-1", f"qd{k} = J{k}^-1 V", of[f"J{k}inv"] @ of["Jp"], c[f"J{k}inv"])
        for k in legs
    ]
    rows += [_build_row(f"(25) Dm{k}", "ddotq1i, dotq1i, sign(dotq1i), 1", drive, c[f"Dm{k}"])
             for k, drive in zip(legs, drives, strict=True)]  # fmt: skip
    rows.append(_build_row("(26) DP", "Jp^T (dotVP - g)", DP, c["WP"]))
    parts, wanted = [DP], [c["WP"]]
    for n, k in enumerate(legs):
        parts.append(np.dstack([drives[n], ends[n]]))
        wanted.append(np.dstack([c[f"Dm{k}"], c[f"DL{k}"]]))
        scan = np.dstack([drives[n], scans[n]])
        rows.append(
            _build_row(f"({27 + n}) DB{k}", f"Jp^T J{k}^T DL{k}", parts[-1], wanted[-1], scan)
        )
    return [*rows, _build_row("(23) DBrob", "its blocks", np.dstack(parts), np.dstack(wanted))]


def _build_row(
    what: str, printed: str, ours: np.ndarray, c: np.ndarray, scan: np.ndarray | None = None
) -> MethodRow:
    error, size = _compute_relative_error(ours, c), " x ".join(map(str, c.shape[1:]))
    if scan is None:
        return MethodRow(f"{what}, {size}", printed, f"{error:.1e}", judge_outcome(error < SAME))
    well = judge_outcome(error < SAME and _compute_relative_error(scan, c) > WRONG, Outcome.DERIVED)
    printed_text, why = (
        f"{printed}: {_compute_relative_error(scan, c):.2g}",
        "with the inverse of J_i that equal power demands",
    )
    return MethodRow(f"{what}, {size}", printed_text, f"{error:.1e}", well, why)


def _compute_relative_error(block: np.ndarray, c: np.ndarray) -> float:
    return float(np.max(np.abs(block - c)) / np.max(np.abs(c)))
