"""Figures: matplotlib's, made without its global state, drawn by a notebook and saved by `savefig`.

A figure of matplotlib stands in a notebook as a picture, works without a network, and goes into a
paper; the pages that commands write have the ones that can be zoomed.
"""

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from modeler.core import figure as fig
from modeler.core.files import write_atomically
from modeler.core.result import Figures
from modeler.estimation import FitResult
from modeler.robot import Robot
from modeler.views.thresholds import THRESHOLDS

if TYPE_CHECKING:
    from modeler.diagnosis import Diagnosis
    from modeler.views.figure_matplotlib import Drawing


def draw_picture(picture: fig.Picture) -> "Drawing":
    """Draws the picture as a figure."""
    from modeler.views.figure_matplotlib import draw_figure  # it takes long to load

    return draw_figure(picture)


def collect_figures(drawn: Mapping[str, Callable[[], fig.Picture]]) -> Figures:
    """Returns figures by name, each drawn when it is requested."""
    return {name: partial(_draw_deferred, draw) for name, draw in drawn.items()}


def _draw_deferred(draw: Callable[[], fig.Picture]) -> "Drawing":
    return draw_picture(draw())


def draw_robot(robot: Robot) -> "Drawing":
    """Draws the robot at its [home], as wide as a column of a paper."""
    from modeler.views.figure_matplotlib import Drawing
    from modeler.views.robot_drawing import draw_skeleton as skeleton_figure
    from modeler.views.robot_page import show

    shown_robot = show(robot)
    return skeleton_figure(shown_robot.skeleton, shown_robot.posture, Drawing)


def draw_parameters(fit: FitResult) -> "Drawing":
    """Draws the standard deviation of each parameter in percent of its value."""
    known = [p for p in fit.parameters if p.relative_sigma_percent is not None][
        : THRESHOLDS.max_bars
    ]
    shares = np.array([min(p.relative_sigma_percent or 0.0, 100.0) for p in known])
    # two digits, all of those before the point
    texts = tuple(
        f"{share:.2g}" if share < 100.0 else f"{share:.0f}" if share < 1e4 else ">10000"
        for share in (p.relative_sigma_percent or 0.0 for p in known)
    )
    names = tuple(p.name for p in known)
    bars = fig.Bars("relative sigma", names, shares, texts, fig.Style(fig.BLUE))
    label = "sigma [% of the value], at most 100 drawn"
    panel = fig.Panel(f"{len(known)} of {len(fit.parameters)} base parameters", "", label, (bars,))
    title = f"{fit.robot}: uncertainty of the parameters"
    return draw_picture(fig.Picture("parameters", title, "", ((panel,),), 380))


def draw_errors_picture(diagnosis: "Diagnosis") -> fig.Picture:
    """Draws the relative error of every joint, without and with the effects."""
    panels, names = [], tuple(diagnosis.joints)
    for title, entry, color in (
        ("as fitted", "error_before", fig.BLUE),
        ("with the effects", "error_after", fig.ORANGE),
    ):
        values = np.array([100.0 * getattr(joint, entry) for joint in diagnosis.joints.values()])
        texts = tuple("" if np.isnan(value) else f"{value:.2f}" for value in values)
        bars = fig.Bars("error", names, values, texts, fig.Style(color))
        panels.append(fig.Panel(title, "joint", "relative error [%]", (bars,)))
    title = f"{diagnosis.robot}: {diagnosis.verdict}"
    return fig.Picture("errors", title, "", (tuple(panels),), 380)


def draw_log(
    title: str, joints: Sequence[str], time: np.ndarray, q: np.ndarray, tau: np.ndarray
) -> "Drawing":
    """Draws positions and torques of all joints against time."""
    panels = tuple(
        (fig.Panel(what, "time [s]", label, build_curves(joints, time, list(values.T)), zero=True),)
        for what, label, values in (
            ("positions", "q [rad, m]", q),
            ("torques", "tau [N m, N]", tau),
        )
    )
    return draw_picture(
        fig.Picture(
            name="channels", title=title, caption="", panels=panels, height=620, shared_time=True
        )
    )


def build_curves(
    names: Sequence[str], time: np.ndarray, columns: Sequence[np.ndarray], limit: int = fig.LIMIT
) -> tuple[fig.Curve, ...]:
    """Builds columns against time, each in a colour of its own, of at most `limit` points."""
    curves = []
    for k, (name, values) in enumerate(zip(names, columns, strict=True)):
        rows = fig.thin_curves((values,), limit)
        style = fig.Style(fig.COLORS[k % len(fig.COLORS)], dash=k >= len(fig.COLORS))
        curves.append(fig.Curve(name, time[rows], values[rows], style))
    return tuple(curves)


# Pictures as files: PNG, SVG, and their numbers.


def write_files(
    folder: Path, pictures: Sequence[fig.Picture], progress: Callable[[float], None] | None = None
) -> tuple[Path, ...]:
    """Writes every picture; returns the paths written.

    Args:
        folder: made if it is not there.
        pictures: what to draw.
        progress: called with the share done, 0 to 1.

    Raises:
        ModelerError: the folder cannot be written.
    """
    from modeler.views.figure_matplotlib import render_images  # matplotlib takes long to load

    written = []
    for number, picture in enumerate(pictures, start=1):
        files = {**render_images(picture), "csv": format_csv(picture).encode()}
        for kind, content in files.items():
            place = Path(folder) / f"{picture.name}.{kind}"
            write_atomically(place, content)
            written.append(place)
        if progress is not None:
            progress(number / len(pictures))
    return tuple(written)


def format_csv(picture: fig.Picture) -> str:
    """Formats the numbers of a picture: panel, series, x, y, error; five significant digits."""
    lines = ["panel,series,x,y,error"]
    for panel in (panel for row in picture.panels for panel in row):
        for series in panel.series:
            lines += [
                f"{_quote_label(panel.title)},{_quote_label(series.label)},{row}"
                for row in _format_rows(series)
            ]
    return "\n".join(lines) + "\n"


def _format_rows(series: fig.Series) -> list[str]:
    if isinstance(series, fig.Heat):
        return [
            f"{_quote_label(column)} / {_quote_label(row)},{series.values[i, j]:.5g},"
            for i, row in enumerate(series.rows)
            for j, column in enumerate(series.columns)
        ]
    if isinstance(series, fig.Bars):
        pairs = zip(series.names, series.values, strict=True)
        return [f"{_quote_label(name)},{value:.5g}," for name, value in pairs]
    if isinstance(series, fig.Means):
        triples = zip(series.x, series.y, series.error, strict=True)
        return [f"{x:.5g},{y:.5g},{error:.5g}".replace("nan", "") for x, y, error in triples]
    if isinstance(series, fig.Band):
        middle, half = 0.5 * (series.low + series.high), 0.5 * (series.high - series.low)
        triples = zip(series.x, middle, half, strict=True)
        return [f"{x:.7g},{y:.5g},{error:.5g}" for x, y, error in triples if np.isfinite(y)]
    both = zip(series.x, series.y, strict=True)
    return [f"{x:.7g},{y:.5g}," for x, y in both if np.isfinite(y)]


def _quote_label(text: str) -> str:
    """Commas would shift the columns; line breaks of labels are no part of a name."""
    return text.replace(",", ";").replace("\n", " ")
