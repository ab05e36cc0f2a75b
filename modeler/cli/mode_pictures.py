"""A small picture of every assembly mode, beside each other."""

from modeler.pages.robot import modes_html
from modeler.show import PICTURE_KINDS, Posture, size_of, skeleton_of
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
    return modes_html(robot.name, robot.title, len(found.modes), svg).encode()


def _drawn(found: HomeModes, kind: str) -> bytes:
    from modeler.show import modes_bytes

    skeleton = skeleton_of(found.linkage.robot)
    size = size_of(skeleton, found.modes[0].posture)
    postures = [Posture(mode.posture, size, closed=True, held=True) for mode in found.modes]
    titles = [
        mode.letter + (" (as in the file)" if k == found.own else "")
        for k, mode in enumerate(found.modes)
    ]
    return modes_bytes(skeleton, postures, titles, kind)
