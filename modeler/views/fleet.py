"""Fleets: the page of what drifts where, tables of a notebook."""

from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from modeler.core.figure import Curve, Heat, Means, Panel, Picture
from modeler.core.result import Figures, Presentation, Tables
from modeler.core.style import BLUE, COLORS, GREY, Style
from modeler.core.table import Table, format_percent
from modeler.validation import (
    HEAD,
    Fleet,
    FleetFinding,
    QuantityHistory,
    QuantityValues,
    build_table_rows,
    describe_finding,
    format_effect_title,
    format_fleet,
    format_headline,
    format_skipped,
)
from modeler.views.blocks import Figure, Items, JudgedLine, PageTable, Paragraph, Verdict
from modeler.views.figures import collect_figures
from modeler.views.page import Origin, Page, Section

_PICTURES = 12  # findings that are drawn
_COLUMNS = 24  # machines of one map
_TOP = 10.0  # sigmas at which cells are darkest


def build_fleet_page(fleet: Fleet, provenance: Sequence[str] = ()) -> Page:
    """The page of a fleet; `provenance` are lines on how the data came about."""
    return Page(
        title=f"{fleet.robot}: what drifts where",
        headline=format_headline(fleet),
        sections=_build_sections(fleet),
        origin=Origin(fleet.robot, [f"{name}: {len(p)}" for name, p in fleet.machines.items()]),
        facts=[
            ("machines", str(len(fleet.machines))),
            ("logs", str(fleet.logs)),
            ("chance of any finding where nothing drifts", format_percent(fleet.false_alarm)),
        ],
        provenance=[*fleet.notes, *format_skipped(fleet), *provenance],
        command="fleet",
    )


def _build_sections(fleet: Fleet) -> list[Section]:
    drawn = fleet.findings[:_PICTURES]
    sections = [Section("Verdict", [_build_verdict(fleet)])]
    sections += [
        Section(
            f"Machine {one.machine}, {one.quantity.parameter}",
            [
                Paragraph(f"{describe_finding(one, fleet.unit)}."),
                Figure(draw_finding_picture(fleet, one), False),
            ],
            _build_section_id(k),
        )
        for k, one in enumerate(drawn)
    ]
    if any(each.scores for each in fleet.histories):
        sections.append(
            Section("All machines", [Figure(map_) for map_ in draw_map_pictures(fleet)])
        )
    sections.append(Section("What was looked at", [_tabulate_followed(fleet)]))
    if fleet.doubts:
        sections.append(Section("Doubts", [Items([("", line) for line in fleet.doubts])]))
    return sections


def _build_section_id(k: int) -> str:
    return f"finding-{k + 1}"


def _build_verdict(fleet: Fleet) -> Verdict | Paragraph:
    if not fleet.findings:
        return Paragraph("No machine drifts and none is apart from the others, beyond doubt.")
    lines = []
    for k, one in enumerate(fleet.findings):
        joint = "" if one.quantity.joint is None else f"joint {one.quantity.joint}, "
        head = f"{one.machine}, {joint}{format_effect_title(one.quantity)}"
        link = _build_section_id(k) if k < _PICTURES else ""
        lines.append(
            JudgedLine("pattern", one.shape, head, describe_finding(one, fleet.unit), link)
        )
    return Verdict(lines)


def draw_finding_picture(fleet: Fleet, one: FleetFinding) -> Picture:
    """The values of that machine over its periods, before those of all others."""
    each = next(each for each in fleet.histories if each.quantity == one.quantity)
    others = [
        machine_values for name, machine_values in each.machines.items() if name != one.machine
    ]
    series: list[Curve | Means] = []
    if others:
        series.append(_build_background(others))
    machine_values = each.machines[one.machine]
    series.append(
        Means(
            f"machine {one.machine}",
            machine_values.at,
            machine_values.values,
            2.0 * machine_values.sigmas,
            Style(BLUE, 1.6),
        )
    )
    label = f"{one.quantity.parameter} [{one.quantity.unit}]"
    panel = Panel("", f"time [{fleet.unit}]", label, tuple(series))
    caption = (
        f"{format_effect_title(one.quantity)} of {one.quantity.description}, log by log: "
        "blue the "
        "machine of this finding, with two standard deviations (scatter from period to period "
        "included), grey all others."
    )
    place = fleet.findings.index(one) + 1
    return Picture(f"finding_{place}", label, caption, ((panel,),), 320)


def draw_quantity_picture(fleet: Fleet, each: QuantityHistory) -> Picture:
    """One quantity of all machines over their periods."""
    series = tuple(
        Means(
            name,
            machine_values.at,
            machine_values.values,
            2.0 * machine_values.sigmas,
            Style(COLORS[k % len(COLORS)], 1.3),
        )
        for k, (name, machine_values) in enumerate(each.machines.items())
    )
    label = f"{each.quantity.parameter} [{each.quantity.unit}]"
    panel = Panel("", f"time [{fleet.unit}]", label, series)
    caption = (
        f"{format_effect_title(each.quantity)} of {each.quantity.description}, log by log, "
        "one line a "
        "machine; whiskers: two standard deviations, scatter from period to period included."
    )
    return Picture("quantity", label, caption, ((panel,),), 320)


def _build_background(others: Sequence[QuantityValues]) -> Curve:
    """All other machines as one broken line."""
    x = np.concatenate([[*machine_values.at, np.nan] for machine_values in others])
    y = np.concatenate([[*machine_values.values, np.nan] for machine_values in others])
    return Curve("the others", x, y, Style(GREY, 1.0, 0.7))


def draw_map_pictures(fleet: Fleet) -> list[Picture]:
    """The greatest change of every quantity and machine, in sigmas; machines in portions."""
    return [
        _draw_map(fleet, machines, k) for k, machines in enumerate(_group_machines(fleet), start=1)
    ]


def _group_machines(fleet: Fleet) -> list[list[str]]:
    """Machines that may drift, as many at a time as one map shows."""
    names = [name for name, periods in fleet.machines.items() if len(periods) > 1]
    return [names[k : k + _COLUMNS] for k in range(0, len(names), _COLUMNS)]


def _draw_map(fleet: Fleet, machines: Sequence[str], number: int) -> Picture:
    followed = fleet.histories
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


def _tabulate_followed(fleet: Fleet) -> PageTable:
    head, *rows = build_table_rows(fleet)
    return PageTable(
        head,
        rows,
        "Level: median of all machines and periods. Scatter: by which values change from one "
        "period to the next more than the noise of their logs explains. Told: the smallest "
        "straight drift over all periods that would be a finding.",
        dict.fromkeys(("effect", "parameter", "unit"), "text"),
    )


# Fleets.


def _collect_tables(fleet: Fleet) -> Tables:
    return {
        "findings": lambda: _tabulate_findings(fleet),
        "values": lambda: _tabulate_values(fleet),
        "quantities": lambda: _tabulate_quantities(fleet),
    }


def _tabulate_findings(fleet: Fleet) -> Table:
    rows = [
        (f.machine, f.quantity.joint, f.quantity.effect, f.shape, f.begin, f.end, f.before,
         f.change, f.quantity.unit, f.change_percent, f.score, f.chance)
        for f in fleet.findings
    ]  # fmt: skip
    return Table.build(
        f"{fleet.robot}: {fleet.verdict}",
        "machine, joint, effect, shape, from, to, before, change, unit, change of it [%], sigmas, "
        "chance", rows,
    )  # fmt: skip


def _tabulate_values(fleet: Fleet) -> Table:
    rows = [
        (name, period, at, each.quantity.parameter, value, sigma, each.quantity.unit)
        for each in fleet.histories
        for name, machine_values in each.machines.items()
        for period, at, value, sigma in zip(
            machine_values.periods,
            machine_values.at,
            machine_values.values,
            machine_values.sigmas,
            strict=True,
        )
    ]
    head = f"machine, period, at [{fleet.unit}], parameter, value, sigma, unit"
    return Table.build("what was followed, log by log", head, rows)


def _tabulate_quantities(fleet: Fleet) -> Table:
    rows = [
        (each.quantity.joint, format_effect_title(each.quantity), each.quantity.parameter,
         each.level, each.quantity.unit, each.factor, each.smallest_detectable)
        for each in fleet.histories
    ]  # fmt: skip
    return Table.build("what may drift", HEAD, rows)


def _collect_figures(fleet: Fleet) -> Figures:
    drawn: dict[str, Callable[[], Picture]] = {}
    for k, portion in enumerate(_group_machines(fleet)):
        drawn["changes" if not k else f"changes {k + 1}"] = partial(
            _draw_map, fleet, portion, k + 1
        )
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
