"""Several postures of a robot side by side, as the assembly modes of its loops."""

from collections.abc import Sequence
from typing import Any

import matplotlib
import numpy as np

from modeler.show.closing import Posture
from modeler.show.paper import SETTINGS, Sheet, draw_parts, outline, paper, saved
from modeler.show.pose import poses
from modeler.show.scene import scene_of
from modeler.show.skeleton import Skeleton
from modeler.show.view import good_view

_WIDE, _LEAST, _MOST = 126.0, 60.0, 150.0  # points, of one posture: half a column, and heights
_MARGIN, _TITLE = 8.0, 14.0
_ACROSS = 4
_HIDDEN = ("frames", "masses", "names", "fixed names", "loop names")


def modes_bytes(
    skeleton: Skeleton, postures: Sequence[Posture], titles: Sequence[str], suffix: str
) -> bytes:
    """The postures as one picture, all seen from one place and to one scale.

    Two are as wide as a column of a paper (3.5 inches), four as wide as its page.

    Args:
        skeleton: the robot.
        postures: at least one.
        titles: what stands above each.
        suffix: one of `PICTURE_KINDS`; ".png" has 400 dots per inch.
    """
    rotation = good_view(skeleton, postures[0]).rotation
    scenes = [scene_of(skeleton, posture).without(_HIDDEN) for posture in postures]
    frames = [poses(skeleton, posture.u) for posture in postures]
    plain = [Sheet(each, rotation, 1.0, np.zeros(2), (0.0, 0.0)) for each in frames]
    points = np.concatenate([outline(*pair) for pair in zip(scenes, plain, strict=True)])
    low, high = np.min(points, axis=0), np.max(points, axis=0)
    span = np.maximum(high - low, 1e-6 * postures[0].size)
    room = np.array([_WIDE, _MOST]) - 2.0 * _MARGIN - [0.0, _TITLE]
    scale = float(np.min(room / span))
    high_one = float(np.clip(scale * span[1] + 2.0 * _MARGIN + _TITLE, _LEAST, _MOST))
    across = min(_ACROSS, len(postures))
    down = -(-len(postures) // across)
    size = (_WIDE * across, high_one * down)
    with matplotlib.rc_context(SETTINGS):
        axes = paper(size)
        for k, (scene, each) in enumerate(zip(scenes, frames, strict=True)):
            corner = np.array([_WIDE * (k % across), high_one * (down - 1 - k // across)])
            middle = corner + np.array([_WIDE, high_one - _TITLE]) / 2.0
            sheet = Sheet(each, rotation, scale, middle - scale * (low + high) / 2.0, size)
            draw_parts(axes, scene, sheet, postures[k].size)
            _title(axes, titles[k], corner + np.array([_MARGIN, high_one - _TITLE]))
        return saved(axes, suffix)


def _title(axes: Any, text: str, at: np.ndarray) -> None:
    axes.text(*at, text, fontsize=8, fontweight="bold", va="bottom", ha="left", zorder=9.0)
