"""Kinds of picture that a robot can be drawn as."""

PICTURE_KINDS = (".png", ".svg", ".pdf")
