"""Colours of pictures, and what captions call them."""

from dataclasses import dataclass

# Okabe and Ito, "Color Universal Design" (2008): told apart by colour-blind readers.
BLACK, ORANGE, BLUE, VERMILLION = "#000000", "#E69F00", "#0072B2", "#D55E00"
GREEN, PINK, SKY = "#009E73", "#CC79A7", "#56B4E9"
GREY, SLATE = "#9A9A9A", "#6F6F6F"
PALE = {"blue": "#CFE4F3", "orange": "#FBE3B0", "green": "#C3EADD", "pink": "#F3D9E7",
        "yellow": "#F7F3B5", "brown": "#E6D5C3"}  # fmt: skip
"""Of shaded stretches, by what captions call them after "pale"."""

SHADE = "#D0D0D0"
"""Of the interval that a panel points out."""

COLORS = (BLUE, VERMILLION, GREEN, ORANGE, PINK, SKY, BLACK)
"""Seven that colour-blind people tell apart (Okabe and Ito), for curves of many joints."""

COLOR_NAMES = {
    BLACK: "black", ORANGE: "orange", BLUE: "blue", VERMILLION: "dark orange", GREEN: "green",
    PINK: "pink", SKY: "light blue", GREY: "grey", SLATE: "dark grey", SHADE: "light grey",
} | {color: f"pale {name}" for name, color in PALE.items()}  # fmt: skip
"""How captions call the colours."""


@dataclass(frozen=True)
class Style:
    """Colour and size of a series."""

    color: str
    width: float = 1.3  # points, of a line; diameter of a dot
    opacity: float = 1.0
    dash: bool = False

    @property
    def description(self) -> str:
        """Its colour in a caption, and whether the line is dashed."""
        return f"dashed {COLOR_NAMES[self.color]}" if self.dash else COLOR_NAMES[self.color]
