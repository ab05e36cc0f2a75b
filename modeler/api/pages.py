"""Pages: one self-contained HTML file of whatever has one."""

from collections.abc import Sequence
from pathlib import Path

from modeler.core.errors import DataError
from modeler.diagnosis.result import Diagnosis
from modeler.estimation.model_file import IdentifiedModel
from modeler.estimation.side_by_side import SideBySide
from modeler.fleet.result import Fleet
from modeler.logs.inspect import Look
from modeler.report.comparison import write_contest
from modeler.report.comparison import write_report as write_comparison
from modeler.report.diagnosis import write_diagnosis
from modeler.report.estimators import write_estimators
from modeler.report.fit import write_fit
from modeler.report.fleet import write_fleet
from modeler.report.history import write_additions
from modeler.report.log import write_log_page
from modeler.report.showing import show
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
    place = Path(path)
    if isinstance(thing, Robot):
        show(thing, place)
        return place
    if isinstance(thing, Look):
        return write_log_page(place, thing, thing.doubts, notes)
    if isinstance(thing, SideBySide):
        return write_estimators(place, thing.robot, thing.tried, [*thing.data, *notes])
    if isinstance(thing, IdentifiedModel):
        if thing.history:
            return write_additions(place, thing, notes)
        return write_fit(place, thing, notes)
    if isinstance(thing, Comparison):
        return write_comparison(place, thing, notes)
    if isinstance(thing, Contest):
        return write_contest(place, thing, notes)
    if isinstance(thing, Diagnosis):
        return write_diagnosis(place, thing, notes)
    if isinstance(thing, Fleet):
        return write_fleet(place, thing, notes)
    raise DataError(
        f"write_report: got {type(thing).__name__}; expected a robot, a model, a comparison, a "
        "diagnosis, models side by side, estimators side by side or a fleet"
    )
