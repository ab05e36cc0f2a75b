"""A small picture of every assembly mode: links as lines, joints as dots, beside each other."""

import html

import numpy as np

from modeler.symbolic import HomeModes, Linkage

_WIDE, _HIGH, _ROOM = 250, 230, 26  # of one picture, px
_AZIMUTH, _ELEVATION = np.radians(-55.0), np.radians(22.0)
_FLAT = 1e-6
_ACTUATED, _PASSIVE, _LINK, _PLATFORM = "#d55e00", "#ffffff", "#3b5b7a", "#56b4e9"


def modes_page(found: HomeModes) -> str:
    """One HTML page that needs no other file."""
    name = html.escape(found.linkage.robot.name)
    return (
        f'<!DOCTYPE html>\n<html lang="en"><meta charset="utf-8"><title>{name}: assembly modes'
        "</title>\n<style>body{font:15px sans-serif;margin:2em}svg{max-width:100%;height:auto}"
        f"</style>\n<h1>{name}: assembly modes</h1>\n<p>{html.escape(found.linkage.robot.title)}"
        "</p>\n<p>All with the actuated joints (orange) at the same place. Write one into the "
        f"robot file with <code>modeler home ROBOT --mode LETTER --write</code>.</p>\n"
        f"{modes_drawing(found)}</html>\n"
    )


def modes_drawing(found: HomeModes) -> str:
    """The pictures as SVG."""
    linkage = found.linkage
    u = np.array([mode.posture for mode in found.modes])
    points = np.concatenate([np.zeros((len(u), 1, 3)), linkage.origins(u)], axis=1)
    flat = _projected(points)
    low, high = flat.min(axis=(0, 1)), flat.max(axis=(0, 1))
    room = np.array([_WIDE, _HIGH]) - 2.0 * _ROOM
    scale = float(np.min(room / np.maximum(high - low, 1e-9 * linkage.closing.size)))
    flat = (flat - 0.5 * (low + high)) * scale * [1.0, -1.0] + 0.5 * np.array([_WIDE, _HIGH])
    across = min(4, len(u))
    lines = []
    for k, (mode, places) in enumerate(zip(found.modes, flat, strict=True)):
        x, y = _WIDE * (k % across), _HIGH * (k // across)
        told = f"{mode.letter}" + (" (as in the file)" if k == found.own else "")
        lines += [
            f'<g transform="translate({x} {y})">',
            f'<text x="8" y="18" font-weight="bold">{told}</text>',
            *_skeleton(linkage, places),
            "</g>",
        ]
    width, height = _WIDE * across, _HIGH * -(-len(u) // across)
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="14">',
        *lines, "</svg>\n",
    ])  # fmt: skip


def _projected(points: np.ndarray) -> np.ndarray:
    """(..., 2) as seen: straight on if all lie in a plane of frame 0, else from the side above."""
    spread = np.ptp(points.reshape(-1, 3), axis=0)
    thin = np.flatnonzero(spread < _FLAT * max(float(spread.max()), 1e-300))
    if len(thin):
        normal = int(thin[-1])
        return np.asarray(points[..., [k for k in range(3) if k != normal]])
    c, s = np.cos(_AZIMUTH), np.sin(_AZIMUTH)
    right = np.array([-s, c, 0.0])
    up = np.array([-np.sin(_ELEVATION) * c, -np.sin(_ELEVATION) * s, np.cos(_ELEVATION)])
    return np.asarray(points @ np.array([right, up]).T)


def _skeleton(linkage: Linkage, places: np.ndarray) -> list[str]:
    """Lines from every frame to its antecedent's, dots at joints; the base is place 0."""
    rows, platform = linkage.geometry.rows, linkage.robot.platform
    lines, dots = [], []
    for place, row in enumerate(rows, start=1):
        joint = row.joint
        if joint.name in platform:  # moved freely: nothing is there
            continue
        parent = 0 if row.parent is None else row.parent + 1
        (x, y), (a, b) = places[place], places[parent]
        color = _PLATFORM if platform and joint.antecedent == platform[-1] else _LINK
        if parent == 0:
            color = "#bbbbbb"
        lines.append(
            f'<line x1="{a:.1f}" y1="{b:.1f}" x2="{x:.1f}" y2="{y:.1f}" stroke="{color}" '
            'stroke-width="3" stroke-linecap="round"/>'
        )
        if joint.moves:
            fill = _ACTUATED if joint.actuated else _PASSIVE
            dots.append(
                f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{fill}" stroke="#333333">'
                f"<title>{html.escape(joint.name)}</title></circle>"
            )
    return lines + dots
