"""Rows of energy differences: what the motors did over a window, and where it went."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from modeler.core.errors import DataError
from modeler.core.table import percent
from modeler.observation.low_speed import signals_of
from modeler.observation.motion import Segment
from modeler.observation.observation import Observation
from modeler.observation.segments import runs
from modeler.runtime.model import CompiledModel

Rule = Literal["simpson", "trapezoid"]
"""How powers are integrated."""

_ENERGY = ("inertial", "rotor_inertia")
"""Kinds of base parameters whose work is a difference of energies."""

_BLOCK = 4000  # samples evaluated at a time: 4000 x 8 joints x 122 columns is 31 MB
_STILL = 1e-9  # of the largest: work below it is rounding


@dataclass(frozen=True, eq=False)
class EnergyRows:
    """y = W beta of r windows; n joints, c base parameters.

    Attributes:
        W: (r, c) work of each base parameter at value one over the window; W beta in J.
        y: (r,) work of the motors, J.
        balance: (r, c) the same as W with the difference of kinetic energy replaced by the
            integral of its power, which needs accelerations: W and it differ by the quadrature.
        spread: (r, n) variance of y for white torque noise of variance one on a joint, m2 or rad2.
        stretch: (r,) number of the uninterrupted stretch, unique over the logs; the windows of
            one follow each other.
        time: (r, 2) s, first and last sample.
        run: (r,) index of the log.
        window: s, length of a window.
    """

    W: np.ndarray
    y: np.ndarray
    balance: np.ndarray
    spread: np.ndarray
    stretch: np.ndarray
    time: np.ndarray
    run: np.ndarray
    window: float


@dataclass(frozen=True)
class _Tiles:
    """Windows of one segment: first samples, intervals of each, and their stretches."""

    segment: Segment
    starts: np.ndarray
    intervals: int
    stretch: np.ndarray


def energy_rows(
    model: CompiledModel,
    observation: Observation,
    window: float | None = None,
    rule: Rule = "simpson",
) -> EnergyRows:
    """The rows of the energy model of Houda, Amouri, Beji and Mallem, eqs. (13) to (17).

        y = int tau^T qd dt = (Delta h) beta + int of the power of all other parameters,

    over windows that follow each other. A parameter of inertia has the power of its kinetic energy
    E = qd^T M(q) qd / 2, whose integral is E(t2) - E(t1) without any acceleration, and that of
    gravity, qd^T g(q); all others the power qd^T phi. One rule integrates y and all powers over the
    same samples: the kinks of |qd| cancel. Rows at low speed stay, for the power of dry friction
    has no leap. A window counts if every sample of every joint does: the energy is the machine's.

    Args:
        model: the compiled robot.
        observation: of the logs; full-rate motion and torque are taken from its stretches.
        window: s, rounded to an even number of samples; None: the spacing of the observation's
            rows, so that both models see the same band.
        rule: Simpson's rule, or the trapezoid, whose error is of order h^2 and not h^4.

    Raises:
        DataError: a window longer than any motion, no window without a missing sample, or a robot
            that stands still.
    """
    tiles = _tiles(observation, window)
    count = sum(len(part.starts) for part in tiles)
    if not count:
        valid = np.concatenate([part.segment.valid for part in observation.stretches])
        bad = [
            f"joint {joint.name} has {percent(share)} of its samples"
            for joint, share in zip(observation.joints, valid.mean(axis=0), strict=True)
        ]
        raise DataError(
            f"{', '.join(observation.logs)}: no window in which every sample of every joint is a "
            f"measurement ({', '.join(bad)}); the energy is that of the whole machine: mend the "
            "log, give a shorter --window, or take --model torque"
        )
    rows = [_rows(model, part, rule) for part in tiles if len(part.starts)]
    W, y, balance, spread, time = (np.concatenate(group) for group in zip(*rows, strict=True))
    # J are compared with the largest torque over a unit of travel:
    least = _STILL * float(np.abs(observation.torque).max(initial=0.0))
    if not np.abs(W).max() > 0.0 or not np.abs(y).max() > least:
        raise DataError(
            f"{', '.join(observation.logs)}: the motors do no work in any window: no joint with a "
            "torque moves; the energy model needs velocity, record a motion of every joint"
        )
    return EnergyRows(
        W=W, y=y, balance=balance, spread=spread, time=time,
        stretch=np.concatenate([part.stretch for part in tiles]),
        run=np.repeat([part.segment.run for part in tiles], [len(part.starts) for part in tiles]),
        window=tiles[0].intervals * tiles[0].segment.step,
    )  # fmt: skip


def _tiles(observation: Observation, window: float | None) -> list[_Tiles]:
    """Windows of all segments, laid into the uninterrupted stretches of good samples."""
    found, number = [], 0
    _check_window(observation, window)
    for part in observation.stretches:
        s = part.segment
        centres = part.rows.centres
        spacing = int(centres[1] - centres[0]) if len(centres) > 1 else 2
        wanted = spacing if window is None else window / s.step
        intervals = 2 * max(1, round(wanted / 2))
        starts: list[np.ndarray] = [np.zeros(0, dtype=int)]
        stretch = [np.zeros(0, dtype=int)]
        for first, stop in runs(s.whole & s.valid.all(axis=1)):
            fitting = (stop - first - 1) // intervals
            if fitting < 1:
                continue
            rest = (stop - first - 1 - fitting * intervals) // 2
            starts.append(first + rest + intervals * np.arange(fitting))
            stretch.append(np.full(fitting, number))
            number += 1
        found.append(_Tiles(s, np.concatenate(starts), intervals, np.concatenate(stretch)))
    return found


def _check_window(observation: Observation, window: float | None) -> None:
    if window is None:
        return
    parts = observation.stretches
    step = min(part.segment.step for part in parts)
    longest = max(part.segment.step * max(0, int(part.segment.whole.sum()) - 1) for part in parts)
    where = ", ".join(observation.logs)
    if not window >= 2.0 * step * (1.0 - 1e-6):
        raise DataError(
            f"{where}: --window of {window:g} s; expected two samples or more, {2.0 * step:.4g} s"
        )
    if window > longest:
        raise DataError(
            f"{where}: --window of {window:g} s is longer than the longest motion without a gap, "
            f"{longest:.4g} s; give a shorter one, or leave it out"
        )


def weights(intervals: int, step: float, rule: Rule) -> np.ndarray:
    """(intervals + 1,) s, of the samples of a window; intervals is even."""
    inner, unit = np.where(np.arange(intervals + 1) % 2, 4.0, 2.0), step / 3.0
    if rule == "trapezoid":
        inner, unit = np.ones(intervals + 1), step
    inner[[0, -1]] *= 0.5
    return inner * unit


def _rows(model: CompiledModel, tiles: _Tiles, rule: Rule) -> tuple[np.ndarray, ...]:
    """W, y, balance, spread and times of the windows of one segment."""
    s, n = tiles.segment, tiles.intervals
    w = weights(n, s.step, rule)
    signals = signals_of(model.spec, s)
    per_block = max(1, _BLOCK // (n + 1))
    blocks = []
    for first in range(0, len(tiles.starts), per_block):
        at = tiles.starts[first : first + per_block, None] + np.arange(n + 1)
        flat = at.ravel()
        read = None if signals is None else signals[flat]
        total, power, energy = _powers(model, s.q[flat], s.qd[flat], s.qdd[flat], read)
        integral, whole = (
            np.einsum("k,rkc->rc", w, values.reshape(*at.shape, -1)) for values in (power, total)
        )
        energy = energy.reshape(*at.shape, -1)
        work = np.sum(s.tau[at] * s.qd[at], axis=2) @ w
        spread = np.einsum("k,rkj->rj", w**2, s.qd[at] ** 2)
        change = energy[:, -1] - energy[:, 0]
        blocks.append((integral + change, work, whole, spread, s.time[at[:, [0, -1]]]))
    return tuple(np.concatenate(group) for group in zip(*blocks, strict=True))


def _powers(
    model: CompiledModel, q: np.ndarray, qd: np.ndarray, qdd: np.ndarray, read: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """All power; power that is no change of kinetic energy; kinetic energy: (samples, c) each.

    The regressor gives them all: E_c = qd^T (phi_c(q, 0, qd) - phi_c(q, 0, 0)) / 2.
    """
    still = np.zeros_like(qd)
    total, gravity, moved = (
        np.einsum("sj,sjc->sc", qd, model.base_regressor(q, v, a, read))
        for v, a in ((qd, qdd), (still, still), (still, qd))
    )
    inertial = kinetic_columns(model)
    energy = np.where(inertial, 0.5 * (moved - gravity), 0.0)
    return total, np.where(inertial, gravity, total), energy


def kinetic_columns(model: CompiledModel) -> np.ndarray:
    """(c,) True for base parameters of bodies and rotors."""
    kinds: Sequence[str] = [base.kind for base in model.spec.base]
    return np.array([kind in _ENERGY for kind in kinds])
