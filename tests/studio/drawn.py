"""Pictures that hold every kind of series and every setting of a panel."""

import numpy as np

from modeler.core.figure import (
    BLACK,
    BLUE,
    ORANGE,
    PALE,
    SKY,
    Band,
    Bars,
    Curve,
    Heat,
    Means,
    Panel,
    Picture,
    Points,
    Span,
    Style,
)

X = np.linspace(0.0, 6.0, 61)
Y = np.where(np.abs(X - 3.0) < 0.35, np.nan, np.sin(X) / 3.0)

MOTION = Panel(
    "Torque <b>&</b>", "time [s]", "torque [N m]",
    (Band("band", X, Y - 0.1, Y + 0.1, Style(SKY, opacity=0.4)),
     Curve("measured", X, Y, Style(BLACK)),
     Curve("predicted", X, Y * 1.1, Style(ORANGE, dash=True))),
    marks=((2.0, "second log"),), shade=(4.0, 4.5), zero=True, x_range=(0.0, 6.0),
    y_range=(-1.0, 1.0),
    spans=(Span("low speed", np.array([[0.5, 1.0], [5.0, 5.5]]), PALE["blue"]),),
)  # fmt: skip
CLOUD = Panel(
    "Cloud", "speed [rad/s]", "residual [N m]",
    (Points("samples", X, Y, Style(BLUE, 2.0, 0.5)),
     Means("mean", X[::10], Y[::10], np.full(7, 0.05), Style(ORANGE))),
)  # fmt: skip
SHARES = Panel(
    "Shares", "joint", "share [%]",
    (Bars("explained", ("1", "two\nlines"), np.array([60.0, 80.0]), ("60", "80"), Style(BLUE),
          np.zeros(2)),
     Bars("left", ("1", "two\nlines"), np.array([40.0, 20.0]), ("40", "20"), Style(ORANGE),
          np.array([60.0, 80.0]))),
)  # fmt: skip
SPECTRUM = Panel(
    "Spectrum", "frequency [Hz]", "density",
    (Curve("residual", X[1:], np.exp(-X[1:]), Style(BLUE)),), scale="log", x_range=(0.1, 10.0),
)  # fmt: skip
CELLS = Panel(
    "Cells", "coordinate", "joint",
    (Heat("share", ("speed", "position"), ("1", "2", "3"),
          np.array([[10.0, np.nan], [0.0, 90.0], [55.0, 20.0]]),
          (("10", ""), ("0", "90"), ("55", "20")), 100.0),),
)  # fmt: skip
EVERY_KIND = Picture(
    "every_kind", "Every kind of series", "What each looks like.",
    ((MOTION, CLOUD), (SHARES, SPECTRUM), (CELLS, Panel("", "", "", ()))), 900,
    heights=(0.4, 0.3, 0.3), widths=(0.6, 0.4),
)  # fmt: skip
SHARED = Picture(
    "shared", "Two rows of one time", "", ((MOTION,), (MOTION,)), 430, True, (0.6, 0.4)
)
