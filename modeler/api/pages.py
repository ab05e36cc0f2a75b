"""Pages: one self-contained HTML file of whatever has one."""

from collections.abc import Sequence
from pathlib import Path

from modeler import views
from modeler.core.files import write_atomically
from modeler.core.result import find_presentation
from modeler.diagnosis import Diagnosis
from modeler.estimation import IdentifiedModel, MethodComparison
from modeler.logs import LogInspection
from modeler.robot import Robot
from modeler.validation import Comparison, Fleet, ModelComparison

Reported = (
    Robot
    | LogInspection
    | IdentifiedModel
    | Comparison
    | ModelComparison
    | Diagnosis
    | MethodComparison
    | Fleet
)
"""What has a page."""


def write_report(thing: Reported, path: str | Path, notes: Sequence[str] = ()) -> Path:
    """Write the page of a result; it needs no other file.

    >>> write_report(model, "fit.html").name
    'fit.html'

    Args:
        thing: a robot, a look at a log, a model (its fit; of one with additions, what they
            gained), a comparison, models side by side, a diagnosis, estimators side by side, or a
            fleet.
        path: of an .html file.
        notes: lines for the foot of the page: where the logs come from.

    Raises:
        ModelerError: the place cannot be written.
    """
    presentation = find_presentation(type(thing))
    if presentation is None or presentation.document is None:
        raise TypeError(f"write_report: got a {type(thing).__name__}, which has no page")
    sheet = presentation.document(thing, notes)
    if isinstance(sheet, views.Page):
        return views.write_page(Path(path), sheet)
    write_atomically(Path(path), sheet)
    return Path(path)
