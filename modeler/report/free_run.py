"""Free runs."""

from functools import partial

from modeler.core.result import Presentation, present
from modeler.core.table import Table
from modeler.report.figures import picture_figures
from modeler.validation.free_run_result import FreeRun, free_run_picture


def present_free_runs() -> None:
    """FreeRun."""
    present(FreeRun, Presentation(
        "a free run", FreeRun.summary,
        lambda found: {"joints": lambda: _joints(found)},
        lambda found: picture_figures({
            f"joint {joint.name}": partial(free_run_picture, found, j)
            for j, joint in enumerate(found.joints)
        }),
    ))  # fmt: skip


def _joints(found: FreeRun) -> Table:
    return Table.of(
        f"{found.robot}: free run in windows of {found.window:g} s",
        "joint, position [%], constant speed [%], whole run [%], horizon [s], largest error, unit",
        [(j.name, j.fit, j.constant_speed, j.whole, j.horizon, j.largest, j.unit)
         for j in found.joints],
        "position: 100 % is the logged one, 0 % its mean",
    )  # fmt: skip
