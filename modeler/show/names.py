"""Where names stand in a picture: beside what they name, on nothing else."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath

_SIZE, _HIGH, _BLANK = 7.0, 7.5, 4.0  # points
_FONT = FontProperties(weight="bold", size=_SIZE)
_SAME = 4.0  # points: names nearer to each other are written together


@dataclass(frozen=True)
class Name:
    """A text, and what it names.

    Attributes:
        text: as it is written.
        color: of the text.
        at: (2,) what it names, points.
        bulk: radius of what it names, points.
    """

    text: str
    color: str
    at: np.ndarray
    bulk: float = 0.0


def placed_names(
    names: Sequence[Name],
    lines: Sequence[np.ndarray],
    sleeves: Sequence[np.ndarray],
    paper: tuple[float, float],
) -> list[Name]:
    """The names where they are written: `at` is the left end of the text, at half its height.

    Names at one place come one after the other in one line. Each such line takes, of 36 places
    around it, the one that covers fewest names and lines.

    Args:
        names: with what they name.
        lines: (2, 2) straight lines in the picture, points.
        sleeves: the same of bars that are as thick as what is named.
        paper: width and height, points.
    """
    groups: list[list[Name]] = []
    for name in names:
        near = next((g for g in groups if np.hypot(*(g[0].at - name.at)) < _SAME), None)
        if near is None:
            groups.append([name])
        else:
            near.append(name)
    steps = np.linspace(0.0, 1.0, 60)[:, None]
    dense, bars = ([line[0] + steps * (line[1] - line[0]) for line in these]
                   for these in (lines, sleeves))  # fmt: skip
    taken: list[np.ndarray] = []
    found = []
    for group in groups:
        widths = [_wide(name.text) for name in group]
        width = sum(widths) + _BLANK * (len(group) - 1)
        others = [each[0] for each in groups if each is not group]
        box = _best(group, width, _Beside(taken, dense, bars, others), paper)
        taken.append(box)
        x = box[0, 0]
        for name, wide in zip(group, widths, strict=True):
            found.append(Name(name.text, name.color, np.array([x, box[:, 1].mean()])))
            x += wide + _BLANK
    return found


@dataclass(frozen=True)
class _Beside:
    """What names should not cover: names that stand, points of lines and bars, what is named."""

    taken: Sequence[np.ndarray]
    lines: Sequence[np.ndarray]
    bars: Sequence[np.ndarray]
    named: Sequence[Name]


def _wide(text: str) -> float:
    return float(TextPath((0, 0), text, prop=_FONT).get_extents().width)


def _best(
    group: Sequence[Name],
    width: float,
    beside: _Beside,
    paper: tuple[float, float],
) -> np.ndarray:
    """(2, 2) lower left and upper right corner of the text."""
    size, bulk = np.array([width, _HIGH]), max(name.bulk for name in group)
    best, best_cost = None, np.inf
    for ring in range(3):
        for k in range(12):
            angle = np.pi * (k - 1) / 6.0
            reach = 4.0 + 5.0 * ring + bulk
            way = np.array([np.cos(angle) * (reach + width / 2), np.sin(angle) * (reach + 2.0)])
            low = group[0].at + way - size / 2
            box = np.array([low, low + size])
            cost = 8.0 * sum(_overlap(box, other) for other in beside.taken) + 0.7 * ring
            cost += min(4, sum(_through(points, box) for points in beside.lines))
            cost += 2.0 * sum(_covers(box, name) for name in beside.named)
            wide = box + np.array([[-0.7], [0.7]]) * bulk
            cost += 2.0 * sum(_through(points, wide) for points in beside.bars)
            cost += 20.0 * (np.any(box[0] < 3.0) or np.any(box[1] > np.array(paper) - 3.0))
            if best is None or cost < best_cost - 1e-9:
                best, best_cost = box, cost
    assert best is not None
    return best


def _covers(box: np.ndarray, name: Name) -> bool:
    return bool(np.hypot(*(name.at - np.clip(name.at, box[0], box[1]))) < 0.7 * name.bulk)


def _overlap(a: np.ndarray, b: np.ndarray) -> bool:
    return bool(np.all(a[0] < b[1] + 0.8) and np.all(b[0] < a[1] + 0.8))


def _through(points: np.ndarray, box: np.ndarray) -> bool:
    return bool(np.any(np.all((points > box[0]) & (points < box[1]), axis=1)))
