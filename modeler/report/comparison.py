"""Comparisons: the page of one model, of several, of a free run, and the pictures."""

import math
import statistics
from collections.abc import Sequence

from modeler import validation
from modeler.core.figure import Picture
from modeler.core.table import percent
from modeler.report.blocks import (
    Code,
    Figure,
    Items,
    JudgedLine,
    PageCell,
    PageTable,
    Paragraph,
    Verdict,
)
from modeler.report.page import Origin, Page, Section

# The page of a free run.


def free_run_page(found: validation.FreeRun, origin: Origin) -> Page:
    """The table of a free run, what is said of it, measured and simulated positions by joint."""
    fits = [joint.fit for joint in found.joints if joint.fit is not None]
    worst = f"{min(fits):.3g} %" if fits and min(fits) > 0.0 else "nothing"
    return Page(
        title=f"{found.robot}: free run in windows of {found.window:g} s",
        headline=(worst, "of the position is simulated right, on the joint that is worst"),
        sections=[
            Section("Positions", [Code(found.summary())]),
            *(Section(p.title, [Figure(p, False)]) for p in validation.free_run_pictures(found)),
        ],
        origin=origin,
        command="compare",
    )


# The page of several models side by side.


def contest_page(
    found: validation.Contest, provenance: Sequence[str] = (), held_out: bool | None = None
) -> Page:
    """The page of models side by side.

    Args:
        found: from `contest`.
        provenance: lines on how the data came about.
        held_out: False if a model was fitted on rows of these logs.
    """
    first = found.predictions[0]
    return Page(
        title=f"{first.robot}: {len(found.names)} models side by side",
        headline=validation.headline_of(found),
        sections=_model_sections(found),
        origin=Origin(", ".join(found.names), first.logs, held_out),
        facts=[(name, _fact(found, k)) for k, name in enumerate(found.names)],
        provenance=provenance,
        command="compare",
    )


def contest_pictures(found: validation.Contest) -> list[Picture]:
    """Measured torque and that of every model, joint by joint."""
    return [_picture(found, item) for item in found.joints]


def _fact(found: validation.Contest, k: int) -> str:
    errors = ", ".join(
        f"{percent(error)} of the {unit}" if len(found.by_unit[k]) > 1 else percent(error)
        for unit, error in found.by_unit[k].items()
    )
    won = found.wins(k)
    best = f"joint {', '.join(won)}" if won else "no joint"
    return f"error {errors}; best beyond doubt on {best}"


def _model_sections(found: validation.Contest) -> list[Section]:
    said = Items([("", line) for line in validation.contest_sentences(found)])
    return [Section("Verdict", [said, _errors(found), _sizes(found)])] + [
        Section(f"Joint {item.joint.name}", [Figure(_picture(found, item), titled=False)],
                f"joint-{item.joint.name}")
        for item in found.joints
    ]  # fmt: skip


def _picture(found: validation.Contest, item: validation.JointContest) -> Picture:
    joints = [info.name for info in found.predictions[0].joints]
    return validation.overlay_picture(found.names, found.predictions, joints.index(item.joint.name))


def _errors(found: validation.Contest) -> PageTable:
    top = max((e for item in found.joints for e in item.errors), default=0.0) or 1.0
    rows: list[list[str | PageCell]] = [
        [
            PageCell(item.joint.name, link=f"joint-{item.joint.name}"),
            *(PageCell(percent(e), e / top) for e in item.errors),
            "-" if item.best is None else found.names[item.best],
            f"{item.chance:.2g}" if item.chance >= 1e-6 else "under 1e-6",
        ]
        for item in found.joints
    ]
    return PageTable(
        ["joint", *found.names, "best beyond doubt", "chance"],
        rows,
        "Relative error: norm of measured minus predicted torque (force) over the norm of what was "
        "measured, each joint by itself, on the rows that count for every model. Chance: that the "
        "best and its nearest rival are equally good, from the spread of the difference between "
        f"blocks of time; beyond doubt is less than {percent(validation.DOUBT)}, shared among the "
        "rivals.",
        dict.fromkeys(found.names, "bar") | {"best beyond doubt": "text"},
    )


def _sizes(found: validation.Contest) -> PageTable:
    rows = [
        [item.joint.name, *(f"{rms:.3g} {item.joint.effort_unit}" for rms in item.rms)]
        for item in found.joints
    ]
    return PageTable(["joint", *found.names], rows, "Root mean square of what each model leaves.")


# All pictures of a comparison, and as files.


def joint_pictures(
    comparison: validation.Comparison, item: validation.JointComparison
) -> tuple[Picture, ...]:
    """The pictures of one joint: against time, then against each coordinate."""
    found = comparison.prediction
    return validation.time_picture(found, item), validation.residual_picture(found, item)


def all_pictures(comparison: validation.Comparison) -> tuple[Picture, ...]:
    """The overview, then the pictures of each judged joint."""
    drawn = [picture for item in comparison.joints for picture in joint_pictures(comparison, item)]
    return (validation.overview_picture(comparison), *drawn)


_TAGS = {"pattern": "pattern left", "noise": "noise only", "other": "unclear"}
_REGION_PHRASES = {
    "fast -": "fast in the negative direction",
    "slow -": "slow in the negative direction",
    "around zero": "around zero speed",
    "slow +": "slow in the positive direction",
    "fast +": "fast in the positive direction",
}
_HEAD = (
    "joint", "relative error", "rms residual", "sigma", "rms measured", "largest residual", "at",
    "R\u00b2", "repeatable", "noise", "mean residual", "samples",
)  # fmt: skip


def comparison_page(
    comparison: validation.Comparison, provenance: Sequence[str] = (), origin: Origin | None = None
) -> Page:
    """The page of a comparison.

    Args:
        comparison: from `compare`.
        provenance: lines on how the data came about (filtering, model, versions), as they are.
        origin: model, logs, and whether they were held out; robot and logs if it is left out.
    """
    prediction = comparison.prediction
    figure, _, rest = validation.headline(comparison).partition(" of ")
    return Page(
        title=f"{prediction.robot}: measured against predicted torque",
        headline=(figure, f"of {rest}" if rest else ""),
        sections=_sections(comparison),
        origin=origin or Origin(prediction.robot, prediction.logs),
        facts=_facts(comparison),
        provenance=(
            f"Robot: {prediction.robot}.",
            f"Logs: {', '.join(prediction.logs)}.",
            f"Samples: {comparison.samples} of {prediction.time.size} count for at least one "
            "joint; filtered alike on both sides, never differenced across a gap.",
            *provenance,
        ),
        command="compare",
    )


def _sections(comparison: validation.Comparison) -> list[Section]:
    method = " ".join(f"{line}." for line in validation.method_lines(comparison))
    table = PageTable(
        _HEAD,
        [_table_row(item, comparison) for item in comparison.joints],
        "Relative error is the norm of measured minus predicted torque (force) over the norm of "
        "what was measured, each joint by itself, over the samples that count. R\u00b2 compares "
        "with the best constant. Sigma is the rms standard deviation of the prediction by the "
        "covariance of the fit. " + method,
        {"relative error": "bar", "at": "text"},
    )
    found = [Section("Verdict", [Verdict(_judged(comparison)), table, *_log_table(comparison)])]
    if comparison.joints:
        found.append(
            Section("All joints", [Figure(validation.overview_picture(comparison), titled=False)])
        )
    for item in comparison.joints:
        pictures = [Figure(picture) for picture in joint_pictures(comparison, item)]
        name, said = item.joint.name, Paragraph(validation.joint_verdict(item))
        found.append(Section(f"Joint {name}", [said, *pictures], f"joint-{name}"))
    return found


def _facts(comparison: validation.Comparison) -> list[tuple[str, str]]:
    """The three answers of the first screen."""
    if not comparison.joints:
        return []
    return [
        ("How good?", _how_good(comparison.joints)),
        ("Where does it fail?", _where(comparison.joints)),
        ("Does the residual still have structure?", _what_is_left(comparison.joints)),
    ]


def _how_good(joints: tuple[validation.JointComparison, ...]) -> str:
    below = sum(item.relative_error < 0.1 for item in joints)
    middle = percent(statistics.median(item.relative_error for item in joints))
    text = f"{below} of {len(joints)} joints are within 10 %; the middle one is at {middle}."
    defined = [item for item in joints if not math.isnan(item.r2)]
    if defined:
        worst = min(defined, key=lambda item: item.r2)
        text += f" Lowest R\u00b2: {worst.r2:.3f} (joint {worst.joint.name})."
    return text


def _where(joints: tuple[validation.JointComparison, ...]) -> str:
    worst = max(joints, key=lambda item: item.relative_error)
    window = worst.worst
    region = max(worst.regions, key=lambda part: part.energy_share - part.time_share)
    return (
        f"Most on joint {worst.joint.name} ({percent(worst.relative_error)}): "
        f"{percent(region.energy_share)} of its squared residual while "
        f"{_REGION_PHRASES[region.name]} ({percent(region.time_share)} of the samples); "
        f"worst at {window.start:.2f}-{window.end:.2f} s of {window.log}."
    )


def _what_is_left(joints: tuple[validation.JointComparison, ...]) -> str:
    named = []
    for item in joints:
        pattern, other = validation.best_pattern(item), validation.best_other(item)
        if validation.wrong_scale(item) is not None and item.scale is not None:
            named.append((item.scale.mended, f"joint {item.joint.name} has a wrong sign or scale"))
        elif other is not None:
            named.append((other[1], f"joint {item.joint.name} follows the velocity of {other[0]}"))
        elif pattern is not None:
            named.append((pattern[1], f"joint {item.joint.name} follows {pattern[0].phrase}"))
    if named:
        named.sort(reverse=True)
        listed = "; ".join(f"{text} ({percent(share)})" for share, text in named[:3])
        return f"Yes, on {len(named)} of {len(joints)} joints: {listed}."
    if all(validation.looks_like_noise(item) for item in joints):
        return "No: the residual of every joint looks like noise."
    return "No pattern in the joints' motion, but not all of it is noise: see below."


def _judged(comparison: validation.Comparison) -> list[JudgedLine]:
    lines = []
    for item in comparison.joints:
        kind, text = validation.kind_of_residual(item), validation.joint_verdict(item)
        first, _, rest = text.partition(": ")
        lines.append(JudgedLine(kind, _TAGS[kind], first, rest, f"joint-{item.joint.name}"))
    lines += [
        JudgedLine("", "not judged", f"Joint {name}", f"{reason}.")
        for name, reason in comparison.unjudged
    ]
    return lines


def _table_row(
    item: validation.JointComparison, comparison: validation.Comparison
) -> list[str | PageCell]:
    unit = item.joint.effort_unit
    top = max(other.relative_error for other in comparison.joints)
    share = item.relative_error / top if top else 0.0
    return [
        PageCell(item.joint.name, link=f"joint-{item.joint.name}"),
        PageCell(percent(item.relative_error), share),
        f"{item.rms:.3g} {unit}",
        "-" if item.predicted_sigma is None else f"{item.predicted_sigma:.2g} {unit}",
        f"{item.measured_rms:.3g} {unit}",
        f"{item.largest.value:.3g} {unit}",
        f"{item.largest.time:.2f} s of {item.largest.log}",
        validation.or_dash(item.r2, ".4f"),
        percent(None if item.shares is None else item.shares.systematic),
        percent(None if item.shares is None else item.shares.floor),
        f"{item.bias:+.2g} {unit}",
        str(item.samples),
    ]


def _log_table(comparison: validation.Comparison) -> list[PageTable]:
    """Relative error of each log and joint; nothing for a single log."""
    if len(comparison.logs) < 2:
        return []
    head, *rows = validation.by_log(comparison, "all")
    caption = "Relative error by log: of all joints together (rows stacked), and of each by itself."
    return [PageTable(head, rows, caption)]
