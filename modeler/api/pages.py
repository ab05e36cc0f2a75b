"""Pages: one self-contained HTML file of whatever has one."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from modeler import report
from modeler.core.errors import DataError
from modeler.diagnosis import Diagnosis
from modeler.estimation import IdentifiedModel, SideBySide
from modeler.fleet import Fleet
from modeler.logs import LogInspection
from modeler.robot import Robot
from modeler.validation import Comparison, Contest

Reported = (
    Robot | LogInspection | IdentifiedModel | Comparison | Contest | Diagnosis | SideBySide | Fleet
)
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
        report.show(thing, path)
        return Path(path)
    for kind, page_of in _PAGES.items():
        if isinstance(thing, kind):
            return report.write_page(Path(path), page_of(thing, notes))
    raise DataError(
        f"write_report: got {type(thing).__name__}; expected a robot, a model, a comparison, a "
        "diagnosis, models side by side, estimators side by side or a fleet"
    )


_PAGES: Mapping[type, Callable[[Any, Sequence[str]], report.Page]] = {
    LogInspection: lambda look, notes: report.log_page(look, look.doubts, notes),
    SideBySide: lambda s, notes: report.estimators_page(s.robot, s.tried, [*s.data, *notes]),
    IdentifiedModel: lambda m, notes: (report.additions_page if m.history else report.fit_page)(
        m, notes
    ),
    Comparison: report.comparison_page,
    Contest: report.contest_page,
    Diagnosis: report.diagnosis_page,
    Fleet: report.fleet_page,
}
