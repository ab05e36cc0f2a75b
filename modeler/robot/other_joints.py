"""Joints that close no loop under their name, and what to write in their place."""

_OTHER_NAME = {
    "revolute": ("pin", "hinge", "pivot", "bearing", "rotary", "rotational", "turning"),
    "spherical": ("ball", "socket", "ball joint", "point"),
    "rigid": ("fixed", "weld", "welded", "clamped", "same"),
    "prismatic": ("slider", "sliding", "slide", "linear", "guide"),
    "universal": ("cardan", "hooke", "cross", "u", "gimbal"),
    "planar": ("plane", "plane contact", "face"),
    "cylindrical": ("sleeve", "bushing"),
}

_INSTEAD = {
    "it ties directions alone; give the frame three passive prismatic rows along x, y, z without "
    "a body ([links]) and close by rigid": ("orientation", "parallel", "parallel axes", "rotation"),
    "it ties angles by a number, which no frame shows; write a relation such as [relations] "
    'q4 = "-2*q3"': ("gear", "gears", "belt", "chain", "rack", "pulley", "timing belt"),
    "it ties a turn to a travel; write a prismatic row after a revolute one and a relation such as "
    '[relations] q4 = "0.005*q3/(2*pi)"': ("screw", "helical", "spindle", "nut"),
    "rolling ties speeds, not positions, and is not supported; where a wheel rolls along a "
    'straight line it is a relation such as [relations] q2 = "-q1/0.3"': (
        "rolling", "wheel", "roll", "no slip", "nonholonomic",
    ),
    "a straight slot or rod is a passive prismatic row on the link that has it, with a fixed row "
    "whose z points along the pin; close that by revolute (in space by spherical)": (
        "slot", "pin in slot", "line", "point on line", "track",
    ),
    "contacts that slide along a shape are not supported; only the joints of this column close a "
    "loop": ("cam", "contact", "curve", "surface"),
    "a rod of constant length is a link: give it rows that turn (two; one in a plane), and close "
    "its far end by spherical (in a plane by revolute)": (
        "rod", "bar", "distance", "rope", "cable",
    ),
    "a point on a plane is two passive prismatic rows along the plane, without a body ([links]), "
    "and spherical": ("point on plane",),
    "several links on one pin are several loops: one revolute row for each link but one, all with "
    "the frame of that one": ("triple", "triple pin", "double pin", "multiple", "common pin"),
}  # fmt: skip


def other_joint(kind: str) -> str | None:
    """What to write instead of a joint of that name; None if the name says nothing."""
    name = kind.strip().lower().replace("_", " ").replace("-", " ").removesuffix(" joint")
    for known, names in _OTHER_NAME.items():
        if name in names or name == known:
            return f"write {known}"
    for told, names in _INSTEAD.items():
        if name in names:
            return told
    return None
