"""The page of several models side by side."""

from collections.abc import Callable, Sequence
from pathlib import Path

from modeler.compare.overlay_picture import overlay_picture
from modeler.pages.sheet import (
    Cell,
    Figure,
    Items,
    Origin,
    Section,
    Sheet,
    Table,
    write_page,
)
from modeler.pictures.files import write_files
from modeler.pictures.picture import Picture
from modeler.scoring.contest import DOUBT, Contest, JointContest
from modeler.scoring.contest_text import contest_sentences, headline_of
from modeler.scoring.score import percent


def write_contest(
    path: Path,
    found: Contest,
    provenance: Sequence[str] = (),
    held_out: bool | None = None,
    following: Sequence[str] = (),
) -> Path:
    """Write the page; returns the path of the file written.

    Args:
        path: an `.html` file, or a folder, which then gets `compare.html`.
        found: from `contest`.
        provenance: lines on how the data came about.
        held_out: False if a model was fitted on rows of these logs.
        following: commands to go on with.

    Raises:
        ModelerError: the place cannot be written.
    """
    first = found.predictions[0]
    sheet = Sheet(
        title=f"{first.robot}: {len(found.names)} models side by side",
        headline=headline_of(found),
        sections=_sections(found),
        origin=Origin(", ".join(found.names), first.logs, held_out),
        facts=[(name, _fact(found, k)) for k, name in enumerate(found.names)],
        next=following,
        provenance=provenance,
        command="compare",
    )
    return write_page(path, sheet, "compare.html")


def write_overlays(
    folder: Path, found: Contest, progress: Callable[[float], None] | None = None
) -> tuple[Path, ...]:
    """Write the pictures as PNG and SVG and their numbers as CSV; the paths written.

    Args:
        folder: made if it is not there.
        found: from `contest`.
        progress: called with the share done, 0 to 1.

    Raises:
        ModelerError: the folder cannot be written.
    """
    return write_files(folder, [_picture(found, item) for item in found.joints], progress)


def _fact(found: Contest, k: int) -> str:
    errors = ", ".join(
        f"{percent(error)} of the {unit}" if len(found.by_unit[k]) > 1 else percent(error)
        for unit, error in found.by_unit[k].items()
    )
    won = found.wins(k)
    best = f"joint {', '.join(won)}" if won else "no joint"
    return f"error {errors}; best beyond doubt on {best}"


def _sections(found: Contest) -> list[Section]:
    sections = [
        Section(
            "Verdict",
            [
                Items([("", line) for line in contest_sentences(found)]),
                _errors(found),
                _sizes(found),
            ],
        )
    ]
    sections += [
        Section(f"Joint {item.joint.name}", [Figure(_picture(found, item), titled=False)],
                f"joint-{item.joint.name}")
        for item in found.joints
    ]  # fmt: skip
    return sections


def _picture(found: Contest, item: JointContest) -> Picture:
    joints = [info.name for info in found.predictions[0].joints]
    return overlay_picture(found.names, found.predictions, joints.index(item.joint.name))


def _errors(found: Contest) -> Table:
    top = max((e for item in found.joints for e in item.errors), default=0.0) or 1.0
    rows: list[list[str | Cell]] = [
        [
            Cell(item.joint.name, "text", link=f"joint-{item.joint.name}"),
            *(Cell(percent(e), "bar", e / top) for e in item.errors),
            Cell("-" if item.best is None else found.names[item.best], "text"),
            f"{item.chance:.2g}" if item.chance >= 1e-6 else "under 1e-6",
        ]
        for item in found.joints
    ]
    return Table(
        ["joint", *(Cell(name, "bar") for name in found.names), Cell("best beyond doubt", "text"),
         "chance"],
        rows,
        "Relative error: norm of measured minus predicted torque (force) over the norm of what was "
        "measured, each joint by itself, on the rows that count for every model. Chance: that the "
        "best and its nearest rival are equally good, from the spread of the difference between "
        f"blocks of time; beyond doubt is less than {100 * DOUBT:.2g} %, shared among the rivals.",
    )  # fmt: skip


def _sizes(found: Contest) -> Table:
    rows: list[list[str | Cell]] = [
        [item.joint.name, *(f"{rms:.3g} {item.joint.effort_unit}" for rms in item.rms)]
        for item in found.joints
    ]
    return Table(["joint", *found.names], rows, "Root mean square of what each model leaves.")
