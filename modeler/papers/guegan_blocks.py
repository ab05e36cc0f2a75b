"""Guegan, Khalil and Lemoine 2003, eqs. (1), (2), (23) to (30): their blocks beside the emitted C.

Every block is evaluated from its formulas, those of `modeler derive --blocks`, at random closed
states; so is what the scan prints in its place, letter by letter.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeler.codegen import Derivation
from modeler.derivation import random_states
from modeler.formulas import LegBlock, SheetWriter, leg_blocks
from modeler.papers.methods import MethodTable, Outcome, Row, judged
from modeler.runtime import CompiledModel

STATES, SEED = 20, 2003
SAME = 1e-12
"""Of the largest entry, what two computations of it may differ by."""
WRONG = 1e-2
"""Of the largest entry, from which a formula is another one."""


def block_table(*robots: tuple[Derivation, CompiledModel]) -> MethodTable:
    """The blocks of robots with three legs as printed, as derived, and in the emitted C.

    Args:
        robots: with legs of their own, and with legs alike.
    """
    setting = (
        f"at {STATES} random closed states, as a share of the largest entry: formulas of `modeler "
        "derive --blocks`",
        "against base regressor and coupling of the emitted C; with the scan's J_i^T in place of "
        "J_i^-T they are off",
    )
    rows = [row for derivation, compiled in robots for row in _rows(derivation, compiled)]
    return MethodTable("Blocks of eqs. (1), (2) and (23) to (30)", setting, tuple(rows))


@dataclass(frozen=True, eq=False)
class _Values:
    """Blocks at n states.

    Attributes:
        blocks: by name.
        of: (n, rows, columns) of each.
        phi: (n, 3, c) base regressor of the C.
        G: {joint: (n, 3)} rows of its coupling.
        names: (c,) of the base parameters.
        motors: names.
    """

    blocks: Mapping[str, LegBlock]
    of: Mapping[str, np.ndarray]
    phi: np.ndarray
    G: Mapping[str, np.ndarray]
    names: list[str]
    motors: list[str]

    def coupled(self, name: str) -> np.ndarray:
        """(n, rows, 3) what the C has for the speeds of the block's rows by those of the motors."""
        return np.stack([self.G[row] for row in self.blocks[name].rows], axis=1)

    def columns(self, *names: str) -> tuple[list[int], np.ndarray]:
        """Places of the parameters of blocks, in order, and their columns of the C."""
        at = [self.names.index(c) for name in names for c in self.blocks[name].columns]
        return at, self.phi[:, :, at]

    def carried(self, leg: str, scan: bool) -> np.ndarray:
        """(n, 3, ...) J_p^T J_i^-T D_Li, or with J_i^T."""
        J = self.of[f"J{leg}inv"]
        back = np.linalg.inv(J) if scan else J
        return _turned(self.of["Jp"]) @ _turned(back) @ self.of[f"DL{leg}"]

    def driven(self, leg: str) -> np.ndarray:
        """(n, 3, ...) D_mi on the motor's row."""
        D = self.of[f"Dm{leg}"]
        found = np.zeros((len(D), len(self.motors), D.shape[2]))
        found[:, [self.motors.index(row) for row in self.blocks[f"Dm{leg}"].rows]] = D
        return found


def _values(derivation: Derivation, compiled: CompiledModel) -> _Values:
    model, closure = derivation.model, derivation.model.closure
    assert closure is not None
    states = random_states(model, STATES, np.random.default_rng(SEED))
    read: dict[str, np.ndarray | float] = dict(model.geometry.values)
    for kind, numbers in zip(("q", "qd", "qdd"), states, strict=True):
        read |= {f"{kind}[{k}]": column for k, column in enumerate(numbers.T)}
    blocks = {b.name: b for b in leg_blocks(model, derivation.base, SheetWriter(model.graph, {}))}
    of = {name: np.zeros((STATES, len(b.rows), len(b.columns))) for name, b in blocks.items()}
    for name, b in blocks.items():
        found = model.graph.evaluate([*b.entries.values()], read)
        for (row, column), value in zip(b.entries, found, strict=True):
            of[name][:, b.rows.index(row), b.columns.index(column)] = value
    free, at = [joint.name for joint in model.robot.free], list(closure.given)
    q, qd, qdd = (numbers[:, at] for numbers in states)
    G = dict(zip(free, compiled.coupling(q).swapaxes(0, 1), strict=True))
    names = [p.name for p in derivation.base.parameters]
    phi = compiled.base_regressor(q, qd, qdd)
    return _Values(blocks, of, phi, G, names, [free[k] for k in at])


def _rows(derivation: Derivation, compiled: CompiledModel) -> list[Row]:
    found = _values(derivation, compiled)
    legs = [name[2:] for name in found.of if name.startswith("DL")]
    each = [c for k in legs for c in found.blocks[f"DL{k}"].columns]
    alike = len({*each}) < len(each)
    DP = _turned(found.of["Jp"]) @ found.of["WP"]
    drives = [found.driven(k) for k in legs]
    if alike:
        right, scan = (np.sum([found.carried(k, s) for k in legs], axis=0) for s in (False, True))
        ends = ["DL1"]
        rows = [_row("(30) DLS", "Jp^T sum_i [Ji^T DLi]", right, found.columns("DL1")[1], scan)]
        whole, parts = "(30) Dsym", [DP, *drives, right]
    else:
        ends, parts, rows = [], [DP], _plain_rows(found, legs, DP)
        for number, k in enumerate(legs, 27):
            right, scan = (np.dstack([found.driven(k), found.carried(k, s)]) for s in (False, True))
            wanted = found.columns(f"Dm{k}", f"DL{k}")[1]
            rows.append(_row(f"({number}) DB{k}", f"Jp^T J{k}^T DL{k}", right, wanted, scan))
            ends, parts = [*ends, f"Dm{k}", f"DL{k}"], [*parts, right]
        whole = "(23) DBrob"
    order = ["WP", *(f"Dm{k}" for k in legs if alike), *ends]
    return [*rows, _row(whole, "its blocks", np.dstack(parts), found.columns(*order)[1])]


def _plain_rows(found: _Values, legs: list[str], DP: np.ndarray) -> list[Row]:
    """What is printed as it is derived."""
    Jp = found.of["Jp"]
    rows = [_row("(1) Jp^-1", "Ld = Jp^-1 V", found.of["Jpinv"] @ Jp, found.coupled("Jpinv"))]
    for k in legs:
        name = f"J{k}inv"
        moved = found.of[name] @ Jp
        rows.append(_row(f"(2) J{k}^-1", f"qd{k} = J{k}^-1 V", moved, found.coupled(name)))
    for k in legs:
        printed = "ddotq1i, dotq1i, sign(dotq1i), 1"
        rows.append(_row(f"(25) Dm{k}", printed, found.driven(k), found.columns(f"Dm{k}")[1]))
    return [*rows, _row("(26) DP", "Jp^T (dotVP - g)", DP, found.columns("WP")[1])]


def _row(
    what: str, printed: str, ours: np.ndarray, c: np.ndarray, scan: np.ndarray | None = None
) -> Row:
    def off(block: np.ndarray) -> float:
        return float(np.max(np.abs(block - c)) / np.max(np.abs(c)))

    size = " x ".join(map(str, c.shape[1:]))
    if scan is None:
        return Row(f"{what}, {size}", printed, f"{off(ours):.1e}", judged(off(ours) < SAME))
    well = judged(off(ours) < SAME and off(scan) > WRONG, Outcome.DERIVED)
    why = "with the inverse of J_i that equal power demands"
    return Row(f"{what}, {size}", f"{printed}: {off(scan):.2g}", f"{off(ours):.1e}", well, why)


def _turned(J: np.ndarray) -> np.ndarray:
    return J.swapaxes(1, 2)
