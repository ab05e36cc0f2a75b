"""Assembly modes: the ways in which the links can be put together with the actuated joints locked.

With the actuated joints at a common place, every closed posture that is not singular is a mode of
its own: none can be reached from another unless the motors move. Postures that differ only in how
they are written (`Linkage.shape`) are one.
"""

from dataclasses import dataclass

import numpy as np

from modeler.symbolic.closing import SINGULAR
from modeler.symbolic.copies import best_copy, lengthened, shapes_apart
from modeler.symbolic.linkage import Linkage
from modeler.symbolic.posture_search import at_rest, closed_from, starts
from modeler.symbolic.steady_ties import steady_ties

_GOOD = 0.2
"""Share of the best distance to a singularity that a posture to start from has to have."""
_KEPT = 1e-9
"""rad or sizes by which rounding may leave [limits]."""
_DIGITS = 5
"""Of numbers by which postures are ranked, so that rounding never ranks them."""
_STEPS = (0.1, 0.01, 1e-3, 1e-4, 1e-6, 1e-9)
"""rad or sizes (their power of ten), to which actuated joints are rounded."""


@dataclass(frozen=True)
class AssemblyMode:
    """One way to put the links together.

    Attributes:
        letter: A for the one that is best to start from, B, ...
        posture: (u,) values of the free joints, rad and m, loops closed.
        sigma: distance to a singularity, 0 at one; see `Closing.sigma`.
        kept: True within [limits].
        copies: number of ways in which the same was found written, itself included.
        away: from what was stated, rad and sizes, summed over the joints that were.
    """

    letter: str
    posture: np.ndarray
    sigma: float
    kept: bool
    copies: int
    away: float


_BEFORE_TIES = 4
"""Columns of `_ranks` that count more than steady ties."""
_COUNTED = 24


def assembly_modes(linkage: Linkage, hints: np.ndarray) -> tuple[AssemblyMode, ...]:
    """All assembly modes that are found where the actuated joints stand together; the best first.

    The actuated joints stand where hints say, else in the middle of [limits], else where a posture
    is far from singular; where the loops cannot close so, near there. The best mode keeps [limits],
    is no near neighbour of a singular one, is near to the hints, has no negative travels, ties
    joints by constant ratios (`steady_ties`), is far from singular and has small angles, in this
    order. Empty if nothing closes.

    Args:
        linkage: the robot.
        hints: (u,) values that are meant; NaN for joints of which nothing is said.
    """
    found = _together(linkage, hints)
    if not len(found):
        return ()
    groups = [found[group] for group in shapes_apart(linkage, found)]
    best = max(float(np.max(linkage.closing.sigma(group))) for group in groups)
    ranked = []
    for group in groups:
        u = best_copy(linkage, group, lambda some: _ranks(linkage, some, hints, best))
        copies = len(np.unique(np.round(group, _DIGITS - 1), axis=0))
        key = _ranks(linkage, u[None], hints, best)[0]
        ranked.append((_with_ties(key, int(steady_ties(linkage, u[None])[0])), u, copies))
    ranked.sort(key=lambda one: one[0])
    return tuple(
        AssemblyMode(
            letter=_letter(k),
            posture=u,
            sigma=float(linkage.closing.sigma(u[None])[0]),
            kept=bool(linkage.outside(u[None])[0] < _KEPT),
            copies=copies,
            away=float(np.sum(linkage.apart(u[None], hints))),
        )
        for k, (_, u, copies) in enumerate(ranked)
    )


def _letter(k: int) -> str:
    """A, B, ... Z, AA, AB, ..."""
    return ("" if k < 26 else _letter(k // 26 - 1)) + chr(ord("A") + k % 26)


def _ranks(
    linkage: Linkage, u: np.ndarray, hints: np.ndarray, best: float
) -> list[tuple[float, ...]]:
    """By posture, what sorts the better one first."""
    sigma = linkage.closing.sigma(u)
    own = np.array([joint.name not in linkage.robot.platform for joint in linkage.free])
    negative = np.sum(
        (u < -1e-9 * linkage.closing.size) & linkage.lengths & linkage.tied & own, axis=1
    )
    angles = np.sum(np.abs(np.where(linkage.lengths, 0.0, u)), axis=1)
    columns = np.column_stack([
        np.round(linkage.outside(u), _DIGITS),
        sigma < _GOOD * best,
        np.round(np.sum(linkage.apart(u, hints), axis=1), _DIGITS),
        negative,
        np.round(np.log2(best / sigma)),
        np.round(angles, _DIGITS),
        -np.round(u, _DIGITS),  # mirrored: the positive one first
    ])  # fmt: skip
    return [tuple(line) for line in columns.tolist()]


def _with_ties(key: tuple[float, ...], ties: int) -> tuple[float, ...]:
    return (*key[:_BEFORE_TIES], -ties, *key[_BEFORE_TIES:])


def _place(linkage: Linkage, u: np.ndarray, hints: np.ndarray) -> np.ndarray:
    """(u,) the closed posture at whose actuated joints the modes are compared: the best one.

    Ties take long to count: they are for the best postures, and some others down to the worst.
    """
    keys = _ranks(linkage, u, hints, float(np.max(linkage.closing.sigma(u))))
    order = sorted((k for k, key in enumerate(keys) if not key[1]), key=keys.__getitem__)
    spread = np.linspace(0, len(order) - 1, _COUNTED).astype(int)
    some = [order[k] for k in sorted({*range(min(_COUNTED, len(order))), *spread.tolist()})]
    ties = steady_ties(linkage, u[some])
    return u[min(zip(some, ties, strict=True), key=lambda one: _with_ties(keys[one[0]], one[1]))[0]]


def _together(linkage: Linkage, hints: np.ndarray) -> np.ndarray:
    """(n, u) regular closed postures that all have the actuated joints at the same place."""
    given = np.array(linkage.closing.given)
    wanted = np.full(len(hints), np.nan)
    wanted[given] = np.where(np.isfinite(hints), hints, linkage.middles)[given]
    wanted = np.where(linkage.tied, wanted, np.nan)
    every = np.arange(len(hints))
    meant = np.where(np.isfinite(hints), hints, wanted)
    for held in (np.isfinite(wanted), np.isfinite(wanted) & np.isfinite(hints), wanted > np.inf):
        u = starts(linkage, meant)
        u[:, held] = wanted[held]
        around = _regular(linkage, closed_from(linkage, u, every[~held & linkage.tied]), hints)
        if not len(around):
            continue
        around = at_rest(linkage, around, meant)
        place = _place(linkage, around, hints)
        place = _rounded(linkage, place, every[~held & linkage.tied & np.isin(every, given)])
        u = np.concatenate([starts(linkage, meant), around, place[None]])
        u = at_rest(linkage, u, meant, around)
        u[:, given] = place[given]
        found = closed_from(linkage, u, np.array(linkage.closing.solved))
        return _regular(linkage, np.concatenate([place[None], found]), hints)
    return np.empty((0, len(hints)))


def _regular(linkage: Linkage, u: np.ndarray, hints: np.ndarray) -> np.ndarray:
    """Those that are not singular, cylinders longer than zero."""
    if not len(u):
        return u
    return lengthened(linkage, u[linkage.closing.sigma(u) > SINGULAR], hints)


def _rounded(linkage: Linkage, u: np.ndarray, places: np.ndarray) -> np.ndarray:
    """The posture with actuated joints at short numbers, as short as leaves it where it is."""
    before = float(linkage.closing.sigma(u[None])[0])
    unit = np.where(linkage.lengths, 10.0 ** np.floor(np.log10(linkage.closing.size)), 1.0)
    for step in _STEPS:
        trial = u.copy()
        trial[places] = [
            float(f"{round(x / (step * one)) * step * one:.10g}")
            for x, one in zip(u[places], unit[places], strict=True)
        ]
        closed = linkage.closing.closed(trial[None])
        if np.all(np.isfinite(closed)) and linkage.closing.aligned(closed)[0]:
            near = np.max(linkage.apart(closed, u)) < 5 * step
            if near and linkage.closing.sigma(closed)[0] > 0.5 * before:
                return closed[0]
    return u
