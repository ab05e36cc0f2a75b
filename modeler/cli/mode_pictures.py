"""A small picture of every assembly mode, beside each other."""

import html

from modeler.show import PICTURE_KINDS, Posture, modes_bytes, size_of, skeleton_of
from modeler.symbolic import HomeModes

MODE_PICTURES = (*PICTURE_KINDS, ".html")


def modes_file(found: HomeModes, kind: str) -> bytes:
    """The modes as a file that needs no other.

    Args:
        found: the modes.
        kind: one of `MODE_PICTURES`.
    """
    if kind in PICTURE_KINDS:
        return _drawn(found, kind)
    robot, svg = found.linkage.robot, _drawn(found, ".svg").decode()
    name, title = html.escape(robot.name), html.escape(robot.title)
    return (
        f'<!DOCTYPE html>\n<html lang="en"><meta charset="utf-8"><title>{name}: assembly modes'
        "</title>\n<style>body{font:15px sans-serif;margin:2em}svg{width:100%;height:auto;"
        f"max-width:{_WIDE * min(4, len(found.modes))}px}}</style>\n<h1>{name}: assembly modes</h1>"
        f"\n<p>{title}</p>\n<p>All with the actuated joints (orange) at the same place. Write one "
        "into the robot file with <code>modeler home ROBOT --mode LETTER --write</code>.</p>\n"
        f"{svg[svg.index('<svg') :]}</html>\n"
    ).encode()


_WIDE = 300  # px, of one picture on the page


def _drawn(found: HomeModes, kind: str) -> bytes:
    skeleton = skeleton_of(found.linkage.robot)
    size = size_of(skeleton, found.modes[0].posture)
    postures = [Posture(mode.posture, size, closed=True, held=True) for mode in found.modes]
    titles = [
        mode.letter + (" (as in the file)" if k == found.own else "")
        for k, mode in enumerate(found.modes)
    ]
    return modes_bytes(skeleton, postures, titles, kind)
