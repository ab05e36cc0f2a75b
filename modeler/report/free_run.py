"""Free runs."""

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from modeler.core.result import Figures, Presentation, Tables, present
from modeler.core.table import Table
from modeler.report.figures import picture_figure
from modeler.validation.free_run_result import FreeRun, free_run_picture

if TYPE_CHECKING:
    from modeler.report.figure_matplotlib import Drawing


def present_free_runs() -> None:
    """FreeRun."""
    present(FreeRun, Presentation("a free run", FreeRun.summary, _tables, _figures))


def _tables(found: FreeRun) -> Tables:
    return {"joints": lambda: _joints(found)}


def _joints(found: FreeRun) -> Table:
    columns = (("joint", ""), ("position", "%"), ("constant speed", "%"), ("whole run", "%"),
               ("horizon", "s"), ("largest error", ""), ("unit", ""))  # fmt: skip
    rows = tuple(
        (j.name, j.fit, j.constant_speed, j.whole, j.horizon, j.largest, j.unit)
        for j in found.joints
    )
    title = f"{found.robot}: free run in windows of {found.window:g} s"
    return Table(title, columns, rows, "position: 100 % is the logged one, 0 % its mean")


def _figures(found: FreeRun) -> Figures:
    drawn: dict[str, Callable[[], Drawing]] = {}
    for j, joint in enumerate(found.joints):
        drawn[f"joint {joint.name}"] = partial(_drawn, found, j)
    return drawn


def _drawn(found: FreeRun, j: int) -> "Drawing":
    return picture_figure(free_run_picture(found, j))
