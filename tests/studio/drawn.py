"""Pictures that hold every kind of series and every setting of a panel."""

import numpy as np

from modeler.core import figure

X = np.linspace(0.0, 6.0, 61)
Y = np.where(np.abs(X - 3.0) < 0.35, np.nan, np.sin(X) / 3.0)

MOTION = figure.Panel(
    "Torque <b>&</b>",
    "time [s]",
    "torque [N m]",
    (
        figure.Band("band", X, Y - 0.1, Y + 0.1, figure.Style(figure.SKY, opacity=0.4)),
        figure.Curve("measured", X, Y, figure.Style(figure.BLACK)),
        figure.Curve("predicted", X, Y * 1.1, figure.Style(figure.ORANGE, dash=True)),
    ),
    marks=((2.0, "second log"),),
    shade=(4.0, 4.5),
    zero=True,
    x_range=(0.0, 6.0),
    y_range=(-1.0, 1.0),
    spans=(figure.Span("low speed", np.array([[0.5, 1.0], [5.0, 5.5]]), figure.PALE["blue"]),),
)
CLOUD = figure.Panel(
    "Cloud",
    "speed [rad/s]",
    "residual [N m]",
    (
        figure.Points("samples", X, Y, figure.Style(figure.BLUE, 2.0, 0.5)),
        figure.Means("mean", X[::10], Y[::10], np.full(7, 0.05), figure.Style(figure.ORANGE)),
    ),
)
SHARES = figure.Panel(
    "Shares", "joint", "share [%]",
    (figure.Bars("explained", ("1", "two\nlines"), np.array([60.0, 80.0]), ("60", "80"),
                 figure.Style(figure.BLUE), np.zeros(2)),
     figure.Bars("left", ("1", "two\nlines"), np.array([40.0, 20.0]), ("40", "20"),
                 figure.Style(figure.ORANGE), np.array([60.0, 80.0]))),
)  # fmt: skip
SPECTRUM = figure.Panel(
    "Spectrum",
    "frequency [Hz]",
    "density",
    (figure.Curve("residual", X[1:], np.exp(-X[1:]), figure.Style(figure.BLUE)),),
    scale="log",
    x_range=(0.1, 10.0),
)
PERCENT = np.array([[10.0, np.nan], [0.0, 90.0], [55.0, 20.0]])
WRITTEN = (("10", ""), ("0", "90"), ("55", "20"))
HEAT = figure.Heat("share", ("speed", "position"), ("1", "2", "3"), PERCENT, WRITTEN, 100.0)
CELLS = figure.Panel("Cells", "coordinate", "joint", (HEAT,))
EVERY_KIND = figure.Picture(
    "every_kind",
    "Every kind of series",
    "What each looks like.",
    ((MOTION, CLOUD), (SHARES, SPECTRUM), (CELLS, figure.Panel("", "", "", ()))),
    900,
    heights=(0.4, 0.3, 0.3),
    widths=(0.6, 0.4),
)
ROWS = ((MOTION,), (MOTION,))
SHARED = figure.Picture("shared", "Two rows of one time", "", ROWS, 430, True, (0.6, 0.4))
