"""Captions name colours that are there."""

import re

from modeler.core.figure import COLOR_NAMES, SHADE, Heat, Picture


def colours_said(picture: Picture) -> set[str]:
    """Every colour word of a caption."""
    names = sorted(COLOR_NAMES.values(), key=len, reverse=True)
    others = "red|yellow|purple|brown|cyan|white"
    return set(re.findall(rf"\b({'|'.join(names)}|{others})\b", picture.caption.lower()))


def colours_drawn(picture: Picture) -> set[str]:
    """Of series, of shaded segments, of the interval that a panel points out."""
    panels = [panel for row in picture.panels for panel in row]
    drawn = {s.style.color for panel in panels for s in panel.series if not isinstance(s, Heat)}
    drawn |= {span.color for panel in panels for span in panel.spans}
    drawn |= {SHADE for panel in panels if panel.shade is not None}
    return {COLOR_NAMES[color] for color in drawn}


def assert_named(picture: Picture) -> None:
    """Every colour that a caption names is drawn."""
    assert colours_said(picture) <= colours_drawn(picture), picture.name


def assert_all_named(picture: Picture) -> None:
    """And every colour that is drawn is named."""
    shaded = {COLOR_NAMES[SHADE]}
    assert colours_said(picture) - shaded == colours_drawn(picture) - shaded, picture.name
    assert_named(picture)
