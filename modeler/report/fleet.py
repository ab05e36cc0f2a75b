"""Fleets: the page of what drifts where, tables of a notebook."""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from modeler.core.figure import Curve, Heat, Means, Panel, Picture
from modeler.core.result import Figures, Presentation, Tables
from modeler.core.style import BLUE, COLORS, GREY, Style
from modeler.core.table import Table, percent
from modeler.fleet import Fleet, FleetFinding, Followed, Values, result
from modeler.report.blocks import Figure, Items, JudgedLine, PageTable, Paragraph, Verdict
from modeler.report.figures import picture_figures
from modeler.report.page import Origin, Page, Section

_PICTURES = 12  # findings that are drawn
_COLUMNS = 24  # machines of one map
_TOP = 10.0  # sigmas at which cells are darkest


def fleet_page(found: Fleet, provenance: Sequence[str] = ()) -> Page:
    """The page of a fleet; `provenance` are lines on how the data came about."""
    return Page(
        title=f"{found.robot}: what drifts where",
        headline=result.headline_of(found),
        sections=_sections(found),
        origin=Origin(found.robot, [f"{name}: {len(p)}" for name, p in found.machines.items()]),
        facts=[
            ("machines", str(len(found.machines))),
            ("logs", str(found.logs)),
            ("chance of any finding where nothing drifts", percent(found.false_alarm)),
        ],
        provenance=[*found.notes, *result.skipped_lines(found), *provenance],
        command="fleet",
    )


def _sections(found: Fleet) -> list[Section]:
    drawn = found.findings[:_PICTURES]
    sections = [Section("Verdict", [_verdict(found)])]
    sections += [
        Section(
            f"Machine {one.machine}, {one.quantity.parameter}",
            [
                Paragraph(f"{result.sentence(one, found.unit)}."),
                Figure(finding_picture(found, one), False),
            ],
            _id(k),
        )
        for k, one in enumerate(drawn)
    ]
    if any(each.scores for each in found.followed):
        sections.append(Section("All machines", [Figure(map_) for map_ in map_pictures(found)]))
    sections.append(Section("What was looked at", [_followed(found)]))
    if found.doubts:
        sections.append(Section("Doubts", [Items([("", line) for line in found.doubts])]))
    return sections


def _id(k: int) -> str:
    return f"finding-{k + 1}"


def _verdict(found: Fleet) -> Verdict | Paragraph:
    if not found.findings:
        return Paragraph("No machine drifts and none is apart from the others, beyond doubt.")
    lines = []
    for k, one in enumerate(found.findings):
        joint = "" if one.quantity.joint is None else f"joint {one.quantity.joint}, "
        head = f"{one.machine}, {joint}{result.effect_title(one.quantity)}"
        link = _id(k) if k < _PICTURES else ""
        lines.append(JudgedLine("pattern", one.shape, head, result.sentence(one, found.unit), link))
    return Verdict(lines)


def finding_picture(found: Fleet, one: FleetFinding) -> Picture:
    """The values of that machine over its periods, before those of all others."""
    each = next(each for each in found.followed if each.quantity == one.quantity)
    others = [own for name, own in each.machines.items() if name != one.machine]
    series: list[Curve | Means] = []
    if others:
        series.append(_background(others))
    own = each.machines[one.machine]
    series.append(
        Means(f"machine {one.machine}", own.at, own.values, 2.0 * own.sigmas, Style(BLUE, 1.6))
    )
    label = f"{one.quantity.parameter} [{one.quantity.unit}]"
    panel = Panel("", f"time [{found.unit}]", label, tuple(series))
    caption = (
        f"{result.effect_title(one.quantity)} of {one.quantity.whose}, log by log: blue the "
        "machine of this finding, with two standard deviations (scatter from period to period "
        "included), grey all others."
    )
    place = found.findings.index(one) + 1
    return Picture(f"finding_{place}", label, caption, ((panel,),), 320)


def quantity_picture(found: Fleet, each: Followed) -> Picture:
    """One quantity of all machines over their periods."""
    series = tuple(
        Means(name, own.at, own.values, 2.0 * own.sigmas, Style(COLORS[k % len(COLORS)], 1.3))
        for k, (name, own) in enumerate(each.machines.items())
    )
    label = f"{each.quantity.parameter} [{each.quantity.unit}]"
    panel = Panel("", f"time [{found.unit}]", label, series)
    caption = (
        f"{result.effect_title(each.quantity)} of {each.quantity.whose}, log by log, one line a "
        "machine; whiskers: two standard deviations, scatter from period to period included."
    )
    return Picture("quantity", label, caption, ((panel,),), 320)


def _background(others: Sequence[Values]) -> Curve:
    """All other machines as one broken line."""
    x = np.concatenate([[*own.at, np.nan] for own in others])
    y = np.concatenate([[*own.values, np.nan] for own in others])
    return Curve("the others", x, y, Style(GREY, 1.0, 0.7))


def map_pictures(found: Fleet) -> list[Picture]:
    """The greatest change of every quantity and machine, in sigmas; machines in portions."""
    return [_map(found, own, k) for k, own in enumerate(_portions(found), start=1)]


def _portions(found: Fleet) -> list[list[str]]:
    """Machines that may drift, as many at a time as one map shows."""
    names = [name for name, periods in found.machines.items() if len(periods) > 1]
    return [names[k : k + _COLUMNS] for k in range(0, len(names), _COLUMNS)]


def _map(found: Fleet, machines: Sequence[str], number: int) -> Picture:
    followed = found.followed
    values = np.array([[each.scores.get(name, np.nan) for name in machines] for each in followed])
    texts = tuple(
        tuple("" if np.isnan(value) else f"{value:.1f}" for value in row) for row in values
    )
    rows = tuple(each.quantity.parameter for each in followed)
    heat = Heat("greatest change [sigma]", tuple(machines), rows, values, texts, _TOP)
    caption = (
        "The greatest change of each quantity in each machine, in sigmas: a straight line, a leap, "
        "or one period apart, whichever is surest. The greatest of many is 2 to 4 by chance."
    )
    panel = Panel("", "machine", "", (heat,))
    height = 60 + 28 * len(rows)
    return Picture(f"map_{number}", "Changes", caption, ((panel,),), height)


def _followed(found: Fleet) -> PageTable:
    head, *rows = result.rows_of(found)
    return PageTable(
        head,
        rows,
        "Level: median of all machines and periods. Scatter: by which values change from one "
        "period to the next more than the noise of their logs explains. Told: the smallest "
        "straight drift over all periods that would be a finding.",
        dict.fromkeys(("effect", "parameter", "unit"), "text"),
    )


# Fleets.


def _tables(found: Fleet) -> Tables:
    return {
        "findings": lambda: _findings(found),
        "values": lambda: _values(found),
        "quantities": lambda: _quantities(found),
    }


def _findings(found: Fleet) -> Table:
    rows = [
        (f.machine, f.quantity.joint, f.quantity.effect, f.shape, f.begin, f.end, f.before,
         f.change, f.quantity.unit, f.percent, f.score, f.chance)
        for f in found.findings
    ]  # fmt: skip
    return Table.of(
        f"{found.robot}: {found.verdict}",
        "machine, joint, effect, shape, from, to, before, change, unit, change of it [%], sigmas, "
        "chance", rows,
    )  # fmt: skip


def _values(found: Fleet) -> Table:
    rows = [
        (name, period, at, each.quantity.parameter, value, sigma, each.quantity.unit)
        for each in found.followed
        for name, own in each.machines.items()
        for period, at, value, sigma in zip(
            own.periods, own.at, own.values, own.sigmas, strict=True
        )
    ]
    head = f"machine, period, at [{found.unit}], parameter, value, sigma, unit"
    return Table.of("what was followed, log by log", head, rows)


def _quantities(found: Fleet) -> Table:
    rows = [
        (each.quantity.joint, result.effect_title(each.quantity), each.quantity.parameter,
         each.level, each.quantity.unit, each.factor, each.told)
        for each in found.followed
    ]  # fmt: skip
    return Table.of("what may drift", result.HEAD, rows)


def _figures(found: Fleet) -> Figures:
    drawn: dict[str, Callable[[], Picture]] = {}
    for k, portion in enumerate(_portions(found)):
        drawn["changes" if not k else f"changes {k + 1}"] = partial(_map, found, portion, k + 1)
    for k, each in enumerate(found.followed, start=1):
        drawn[f"quantity {k}"] = partial(quantity_picture, found, each)
    return picture_figures(drawn)


PRESENTATIONS = {
    Fleet: Presentation(
        "a fleet",
        lambda f: "\n".join(result.fleet_lines(f)),
        _tables,
        _figures,
        document=fleet_page,
    )
}
