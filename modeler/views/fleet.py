"""Fleets: the page of what drifts where, tables of a notebook."""

from collections.abc import Callable, Sequence
from functools import partial
from operator import attrgetter

import numpy as np

from modeler.core.figure import BLUE, COLORS, GREY, Curve, Heat, Means, Panel, Picture, Style
from modeler.core.result import Figures, Presentation, Tables
from modeler.core.table import Table, format_percent
from modeler.validation import (
    QUANTITY_COLUMNS,
    Fleet,
    FleetFinding,
    QuantityHistory,
    QuantityValues,
    describe_finding,
    format_effect_title,
    format_fleet,
    format_headline,
    format_skipped,
)
from modeler.views import page
from modeler.views.figures import collect_figures
from modeler.views.thresholds import THRESHOLDS


def build_fleet_page(fleet: Fleet, provenance: Sequence[str] = ()) -> page.Page:
    """Builds the page of a fleet; `provenance` are lines on how the data came about."""
    return page.Page(
        title=f"{fleet.robot}: what drifts where",
        headline=format_headline(fleet),
        sections=_build_sections(fleet),
        origin=page.Origin(
            fleet.robot, [f"{name}: {len(p)}" for name, p in fleet.machines.items()]
        ),
        facts=[
            ("machines", str(len(fleet.machines))),
            ("logs", str(fleet.logs)),
            ("chance of any finding where nothing drifts", format_percent(fleet.false_alarm)),
        ],
        provenance=[*fleet.notes, *format_skipped(fleet), *provenance],
        command="fleet",
    )


def _build_sections(fleet: Fleet) -> list[page.Section]:
    drawn = fleet.findings[: THRESHOLDS.max_findings]
    sections = [page.Section("Verdict", [_build_verdict(fleet)])]
    sections += [
        page.Section(
            f"Machine {one.machine}, {one.quantity.parameter}",
            [
                page.Paragraph(f"{describe_finding(one, fleet.unit)}."),
                page.Figure(draw_finding_picture(fleet, one), False),
            ],
            _build_section_id(k),
        )
        for k, one in enumerate(drawn)
    ]
    if any(each.scores for each in fleet.histories):
        sections.append(
            page.Section("All machines", [page.Figure(map_) for map_ in draw_map_pictures(fleet)])
        )
    sections.append(page.Section("What was looked at", [_tabulate_followed(fleet)]))
    if fleet.warnings:
        sections.append(
            page.Section("Doubts", [page.Items([("", line) for line in fleet.warnings])])
        )
    return sections


def _build_section_id(k: int) -> str:
    return f"finding-{k + 1}"


def _build_verdict(fleet: Fleet) -> page.Verdict | page.Paragraph:
    if not fleet.findings:
        return page.Paragraph("No machine drifts and none differs from the others significantly.")
    lines = []
    for k, one in enumerate(fleet.findings):
        joint = "" if one.quantity.joint is None else f"joint {one.quantity.joint}, "
        head = f"{one.machine}, {joint}{format_effect_title(one.quantity)}"
        link = _build_section_id(k) if k < THRESHOLDS.max_findings else ""
        lines.append(
            page.JudgedLine("pattern", one.shape, head, describe_finding(one, fleet.unit), link)
        )
    return page.Verdict(lines)


def draw_finding_picture(fleet: Fleet, one: FleetFinding) -> Picture:
    """Draws the values of the finding's machine over its periods, before those of all others."""
    each = next(each for each in fleet.histories if each.quantity == one.quantity)
    others = [values for name, values in each.machines.items() if name != one.machine]
    series: list[Curve | Means] = []
    if others:
        series.append(_build_background(others))
    values = each.machines[one.machine]
    series.append(
        Means(
            f"machine {one.machine}",
            values.times,
            values.values,
            2.0 * values.sigmas,
            Style(BLUE, 1.6),
        )
    )
    label = f"{one.quantity.parameter} [{one.quantity.unit}]"
    panel = Panel("", f"time [{fleet.unit}]", label, tuple(series))
    caption = (
        f"{format_effect_title(one.quantity)} of {one.quantity.description}, log by log: blue the "
        "machine of this finding, with two standard deviations (scatter from period to period "
        "included), grey all others."
    )
    place = fleet.findings.index(one) + 1
    return Picture(f"finding_{place}", label, caption, ((panel,),), 320)


def draw_quantity_picture(fleet: Fleet, each: QuantityHistory) -> Picture:
    """Draws one quantity of all machines over their periods."""
    series = tuple(
        Means(
            name,
            values.times,
            values.values,
            2.0 * values.sigmas,
            Style(COLORS[k % len(COLORS)], 1.3),
        )
        for k, (name, values) in enumerate(each.machines.items())
    )
    label = f"{each.quantity.parameter} [{each.quantity.unit}]"
    panel = Panel("", f"time [{fleet.unit}]", label, series)
    caption = (
        f"{format_effect_title(each.quantity)} of {each.quantity.description}, log by log, one "
        "line a machine; whiskers: two standard deviations, scatter from period to period included."
    )
    return Picture("quantity", label, caption, ((panel,),), 320)


def _build_background(others: Sequence[QuantityValues]) -> Curve:
    """All other machines as one broken line."""
    x = np.concatenate([[*values.times, np.nan] for values in others])
    y = np.concatenate([[*values.values, np.nan] for values in others])
    return Curve("the others", x, y, Style(GREY, 1.0, 0.7))


def draw_map_pictures(fleet: Fleet) -> list[Picture]:
    """Draws the greatest change of every quantity and machine, in sigmas."""
    return [_draw_map(fleet, names, k) for k, names in enumerate(_group_machines(fleet), start=1)]


def _group_machines(fleet: Fleet) -> list[list[str]]:
    """Machines that may drift, as many at a time as one map shows."""
    names = [name for name, periods in fleet.machines.items() if len(periods) > 1]
    return [
        names[k : k + THRESHOLDS.max_map_machines]
        for k in range(0, len(names), THRESHOLDS.max_map_machines)
    ]


def _draw_map(fleet: Fleet, machines: Sequence[str], number: int) -> Picture:
    followed = fleet.histories
    values = np.array([[each.scores.get(name, np.nan) for name in machines] for each in followed])
    texts = tuple(tuple("" if np.isnan(v) else f"{v:.1f}" for v in row) for row in values)
    rows = tuple(each.quantity.parameter for each in followed)
    heat = Heat(
        "greatest change [sigma]", tuple(machines), rows, values, texts, THRESHOLDS.darkest_sigmas
    )
    caption = (
        "The greatest change of each quantity in each machine, in sigmas: a straight line, a leap, "
        "or one period apart, whichever is surest. The greatest of many is 2 to 4 by chance."
    )
    panel = Panel("", "machine", "", (heat,))
    height = 60 + 28 * len(rows)
    return Picture(f"map_{number}", "Changes", caption, ((panel,),), height)


def _tabulate_followed(fleet: Fleet) -> page.PageTable:
    return page.tabulate(
        QUANTITY_COLUMNS,
        fleet.histories,
        "Level: median of all machines and periods. Scatter: by which values change from one "
        "period to the next more than the noise of their logs explains. Detectable: the smallest "
        "straight drift over all periods that would be a finding.",
    )


# Fleets.


def _collect_tables(fleet: Fleet) -> Tables:
    tables = (_tabulate_findings, _tabulate_values, _tabulate_quantities)
    names = ("findings", "values", "quantities")
    return {name: partial(table, fleet) for name, table in zip(names, tables, strict=True)}


def _tabulate_findings(fleet: Fleet) -> Table:
    names = "machine quantity.joint quantity.effect shape begin end before change quantity.unit"
    read = attrgetter(*names.split(), "change_percent", "score", "p_value")
    return Table.build(
        f"{fleet.robot}: {fleet.verdict}",
        "machine, joint, effect, shape, from, to, before, change, unit, change of it [%], sigmas, "
        "chance",
        [read(finding) for finding in fleet.findings],
    )


def _tabulate_values(fleet: Fleet) -> Table:
    read = attrgetter("periods", "times", "values", "sigmas")
    rows = [
        (name, period, at, each.quantity.parameter, value, sigma, each.quantity.unit)
        for each in fleet.histories
        for name, values in each.machines.items()
        for period, at, value, sigma in zip(*read(values), strict=True)
    ]
    head = f"machine, period, at [{fleet.unit}], parameter, value, sigma, unit"
    return Table.build("what was followed, log by log", head, rows)


def _tabulate_quantities(fleet: Fleet) -> Table:
    return Table.of_rows("what may drift", QUANTITY_COLUMNS, fleet.histories)


def _collect_figures(fleet: Fleet) -> Figures:
    drawn: dict[str, Callable[[], Picture]] = {}
    for k, names in enumerate(_group_machines(fleet)):
        drawn["changes" if not k else f"changes {k + 1}"] = partial(_draw_map, fleet, names, k + 1)
    for k, each in enumerate(fleet.histories, start=1):
        drawn[f"quantity {k}"] = partial(draw_quantity_picture, fleet, each)
    return collect_figures(drawn)


PRESENTATIONS = {
    Fleet: Presentation(
        "a fleet",
        lambda f: "\n".join(format_fleet(f)),
        _collect_tables,
        _collect_figures,
        document=build_fleet_page,
    )
}
