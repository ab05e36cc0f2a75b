"""Pages: one self-contained HTML file of whatever has one."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from modeler.core.errors import DataError
from modeler.diagnosis.result import Diagnosis
from modeler.estimation.model_file import IdentifiedModel
from modeler.estimation.side_by_side import SideBySide
from modeler.fleet.result import Fleet
from modeler.logs.inspect import Look
from modeler.report.comparison import comparison_page, contest_page
from modeler.report.diagnosis import diagnosis_page
from modeler.report.estimators import estimators_page
from modeler.report.fit import fit_page
from modeler.report.fleet import fleet_page
from modeler.report.history import additions_page
from modeler.report.log import log_page
from modeler.report.page import Page, write_page
from modeler.report.robot_page import show
from modeler.robot.robot import Robot
from modeler.validation.comparison import Comparison
from modeler.validation.models import Contest

Reported = Robot | Look | IdentifiedModel | Comparison | Contest | Diagnosis | SideBySide | Fleet
"""What has a page."""


def write_report(thing: Reported, path: str | Path, notes: Sequence[str] = ()) -> Path:
    """Write the page of a result; it needs no other file.

    Args:
        thing: a robot, a look at a log, a model (its fit; of one with additions, what they
            gained), a comparison, models side by side, a diagnosis, estimators side by side, or a
            fleet.
        path: of an .html file.
        notes: lines for the foot of the page: where the logs come from.

    Raises:
        DataError: no page shows it.
        ModelerError: the place cannot be written.
    """
    if isinstance(thing, Robot):
        show(thing, path)
        return Path(path)
    for kind, page_of in _PAGES.items():
        if isinstance(thing, kind):
            return write_page(Path(path), page_of(thing, notes))
    raise DataError(
        f"write_report: got {type(thing).__name__}; expected a robot, a model, a comparison, a "
        "diagnosis, models side by side, estimators side by side or a fleet"
    )


_PAGES: Mapping[type, Callable[[Any, Sequence[str]], Page]] = {
    Look: lambda look, notes: log_page(look, look.doubts, notes),
    SideBySide: lambda s, notes: estimators_page(s.robot, s.tried, [*s.data, *notes]),
    IdentifiedModel: lambda m, notes: (additions_page if m.history else fit_page)(m, notes),
    Comparison: comparison_page,
    Contest: contest_page,
    Diagnosis: diagnosis_page,
    Fleet: fleet_page,
}
