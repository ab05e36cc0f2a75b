"""Pages: one self-contained HTML file of whatever has one."""

from collections.abc import Sequence
from pathlib import Path

from modeler.compare import Comparison
from modeler.core.errors import DataError
from modeler.diagnose import Diagnosis
from modeler.fit import IdentifiedModel
from modeler.fit.side_by_side import SideBySide
from modeler.pages import write_additions, write_diagnosis
from modeler.pages import write_report as write_comparison
from modeler.pages.estimators import write_estimators
from modeler.robot import Robot
from modeler.showing import show

Reported = Robot | IdentifiedModel | Comparison | Diagnosis | SideBySide
"""What has a page."""


def write_report(thing: Reported, path: str | Path, notes: Sequence[str] = ()) -> Path:
    """Write the page of a robot, a comparison, a diagnosis, estimators, or of a model's history.

    Args:
        thing: it.
        path: of an .html file.
        notes: lines for the foot of the page: where the logs come from.

    Raises:
        DataError: no page shows it; a model without additions has none.
        ModelerError: the place cannot be written.
    """
    place = Path(path)
    if isinstance(thing, Comparison):
        return write_comparison(place, thing, notes)
    if isinstance(thing, Diagnosis):
        return write_diagnosis(place, thing, notes)
    if isinstance(thing, SideBySide):
        return write_estimators(place, thing.robot, thing.tried, [*thing.data, *notes])
    if isinstance(thing, Robot):
        show(thing, place)
        return place
    if isinstance(thing, IdentifiedModel) and thing.history:
        return write_additions(place, thing.spec.robot, thing.history, notes)
    what = "a model to which nothing was added"
    if not isinstance(thing, IdentifiedModel):
        what = type(thing).__name__
    raise DataError(
        f"write_report: got {what}; expected a robot, a comparison, a diagnosis, estimators side "
        "by side, or a model with additions"
    )
