"""The page of a diagnosis: one HTML file, no network."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from modeler.core.figure import Picture
from modeler.core.result import Figures, Presentation, Tables
from modeler.core.table import Column, Table, format_error_pair, format_percent
from modeler.diagnosis import (
    Diagnosis,
    Finding,
    SearchStep,
    describe_equivalents,
    describe_undetectable,
    format_equivalents,
    format_lines,
    format_location,
    format_unit,
)
from modeler.effects import find_effect
from modeler.views import evidence, page
from modeler.views.effect_evidence import collect_evidence, describe_residuals
from modeler.views.figures import collect_figures, draw_errors_picture


def build_diagnosis_page(
    diagnosis: Diagnosis, provenance: Sequence[str] = (), origin: page.Origin | None = None
) -> page.Page:
    """Builds the page of a diagnosis.

    Args:
        diagnosis: what it shows.
        provenance: lines on how the data came about.
        origin: model, logs, and whether some were held out; what the diagnosis knows of them if it
            is left out.
    """
    return page.Page(
        title=f"{diagnosis.robot}: which effect is missing",
        headline=_write_headline(diagnosis),
        sections=_build_sections(diagnosis),
        origin=origin
        or page.Origin(diagnosis.robot, diagnosis.held_out_logs, bool(diagnosis.held_out_logs)),
        facts=_collect_facts(diagnosis),
        provenance=[*diagnosis.sentences, *provenance],
        command="diagnose",
    )


def _write_headline(diagnosis: Diagnosis) -> tuple[str, str]:
    """The size of the prize, and what wins it."""
    if not diagnosis.effects:
        verdict, _, reason = diagnosis.sentences[0].partition(": ")
        return verdict, reason
    first = diagnosis.effects[0]
    effect = find_effect(first.effect, diagnosis.search.start.data.stated_effects.catalogue)
    assert effect is not None
    size = " \u2192 ".join(format_error_pair(first.error_before, first.error_after))
    return (
        size,
        f"{diagnosis.verdict}: {effect.title}, "
        f"{format_location(first.joint)}{describe_equivalents(first)}",
    )


def _collect_facts(diagnosis: Diagnosis) -> list[tuple[str, str]]:
    facts = []
    if diagnosis.effects:
        first = diagnosis.effects[0]
        facts.append(
            (
                "What the data do not distinguish",
                format_equivalents(first) or _describe_runner_up(diagnosis),
            )
        )
    left = [
        f"joint {name}: {format_percent(j.systematic_share / (j.systematic_share + j.noise_share))}"
        " systematic"
        for name, j in diagnosis.joints.items()
        if j.is_unexplained
    ]
    facts.append(("What is still systematic", ", ".join(left) or "nothing worth a word"))
    if diagnosis.data_warnings:
        facts.append(("Warnings about the logs", "; ".join(diagnosis.data_warnings)))
    held = ", ".join(diagnosis.held_out_logs) or "none: errors are cross-validated within the logs"
    facts.append(("Held-out motion", held))
    return facts


def _describe_runner_up(diagnosis: Diagnosis) -> str:
    """Of the same joint: an effect on another one is no alternative."""
    first = diagnosis.effects[0]
    rivals = [gain_of for gain_of in diagnosis.alternatives if gain_of[1] == first.joint]
    if not rivals:
        return "nothing"
    effect, joint, gain = rivals[0]
    share = format_percent(max(0.0, gain))
    return (
        f"nothing; the runner-up is {effect} on {format_location(joint)}, {share} within these logs"
    )


def sort_by_error(diagnosis: Diagnosis) -> list[Finding]:
    """Returns all findings, refinements too, the largest error before first."""
    findings = [*diagnosis.effects, *diagnosis.refinements]
    return sorted(findings, key=lambda finding: -finding.error_before)


def _build_sections(diagnosis: Diagnosis) -> list[page.Section]:
    sections = [
        page.Section("Effects", _tabulate_findings(diagnosis)),
        page.Section("Joints", [_tabulate_joints(diagnosis)]),
    ]
    order = [(finding.effect, finding.joint) for finding in sort_by_error(diagnosis)]
    steps = sorted(
        diagnosis.search.steps,
        key=lambda step: (
            order.index(step.candidate.key) if step.candidate.key in order else len(order)
        ),
    )
    ids: list[str] = []
    for step in steps:
        section_id = _build_section_id(*step.candidate.key)
        ids.append(section_id)  # two ripples of a joint differ by their orders only
        again = ids.count(section_id)
        sections.append(
            _build_effect_section(
                diagnosis, step, section_id if again == 1 else f"{section_id}-{again}"
            )
        )
    sections += [*_build_event_sections(diagnosis), *_build_proposal_sections(diagnosis)]
    blind = [(f"{what}:", why) for what, why in describe_undetectable(diagnosis)]
    listed = page.Items(blind) if blind else page.Paragraph("Nothing of the catalogue.")
    return [*sections, page.Section("What these logs cannot tell", [listed])]


def _build_effect_section(diagnosis: Diagnosis, step: SearchStep, section_id: str) -> page.Section:
    """One effect: what it explains, before and after, and what else could stand for it."""
    item = collect_evidence(diagnosis.search, step)
    effect, joint = step.candidate.effect.id, step.candidate.joint
    alone = page.Paragraph(
        f"No other effect of the catalogue explains anything of {format_location(joint)}."
    )
    return page.Section(
        _format_effect_name(effect, joint),
        [
            page.Paragraph(describe_residuals(item)),
            page.Figure(evidence.draw_torque_picture(item)),
            page.Figure(evidence.draw_evidence_picture(item)),
            evidence.tabulate_alternatives(step) if evidence.select_alternatives(step) else alone,
        ],
        section_id,
    )


def _build_section_id(effect: str, joint: str | None) -> str:
    return f"effect-{effect}-{joint or 'robot'}"


def _build_event_sections(diagnosis: Diagnosis) -> list[page.Section]:
    """Play and pushes, which are no columns."""
    end = diagnosis.search.end
    names = [joint.name for joint in end.data.compiled.spec.joints]
    sections = []
    for finding in diagnosis.effects:
        if finding.pick is None and finding.joint is not None:
            picture = evidence.draw_play_picture(end, names.index(finding.joint))
            sections.append(
                page.Section(
                    _format_effect_name(finding.effect, finding.joint), [page.Figure(picture)]
                )
            )
    if diagnosis.window is not None:
        picture = evidence.draw_push_picture(end, diagnosis.window)
        sections += [
            page.Section(f.effect, [page.Figure(picture)]) for f in diagnosis.effects if f.is_event
        ]
    return sections


def _build_proposal_sections(diagnosis: Diagnosis) -> list[page.Section]:
    """Equations for what has no name."""
    sections = []
    for discovery in diagnosis.discoveries or ():
        name = f"Equations proposed, {format_location(discovery.joint)}"
        if not discovery.proposals:
            sections.append(page.Section(name, [page.Paragraph(f"{discovery.reason}.")]))
        for proposal in discovery.proposals:
            item = collect_evidence(proposal.final_search, proposal.final_search.steps[-1])
            sections.append(
                page.Section(
                    f"{proposal.equation}, {format_location(discovery.joint)}",
                    [
                        *(page.Paragraph(line) for line in proposal.summary_lines),
                        page.Code(proposal.text),
                        page.Figure(evidence.draw_torque_picture(item)),
                        page.Figure(evidence.draw_evidence_picture(item)),
                    ],
                    _build_section_id(proposal.finding.effect, discovery.joint),
                )
            )
    return sections


def _format_effect_name(effect: str, joint: str | None) -> str:
    return f"{effect}, {format_location(joint)}"


def _tabulate_findings(diagnosis: Diagnosis) -> list[page.Block]:
    findings = sort_by_error(diagnosis)
    if not findings:
        return [page.Paragraph(diagnosis.sentences[0])]
    head = ("effect", "joint", "values", "error before", "error after", "gain", "why")
    kinds = {"joint": "text", "values": "values", "gain": "bar", "why": "why"}
    drawn = {step.candidate.key for step in diagnosis.search.steps}
    rows = [_build_finding_row(f, (f.effect, f.joint) in drawn) for f in findings]
    return [page.PageTable(head, rows, _ERRORS, kinds)]


_ERRORS = (
    "The largest error first. Errors are those of the joint that is named, in parts of its own rms "
    "torque or force; of an effect on several joints, of all of them, each in units of what "
    "is left of it, so that N m and N are never added. Before and after: without the effect and "
    "with it, all others that were named before it in the model. Gain: share of the residual's "
    "variance that is gone."
)


def _build_finding_row(finding: Finding, drawn: bool) -> list[str | page.PageCell]:
    status = "refinement" if finding.is_refinement else finding.status
    link = _build_section_id(finding.effect, finding.joint) if drawn else ""
    return [
        page.PageCell(f"{finding.effect} ({status})", link=link),
        finding.joint or "all",
        _format_values(finding),
        *format_error_pair(finding.error_before, finding.error_after),
        page.PageCell(format_percent(finding.gain), max(0.0, finding.gain)),
        "; ".join(text for text in (finding.evidence, finding.warning) if text),
    ]


def _format_values(finding: Finding) -> str:
    sigmas = {name: f" \u00b1 {sigma:.2g}" for name, sigma in finding.sigmas.items()}
    return "; ".join(
        f"{name} = {value:.4g}{sigmas.get(name, '')}{format_unit(finding, name)}"
        for name, value in finding.parameters.items()
    )


def _format_error(pair: tuple[str, Any], k: int) -> str:
    return format_error_pair(pair[1].error_before, pair[1].error_after)[k]


def _format_share(pair: tuple[str, Any], name: str) -> str:
    return format_percent(getattr(pair[1], f"{name}_share"), 5)


_JOINT_COLUMNS = (
    Column("joint", "0"),
    Column("error", "1.error_before", partial(_format_error, k=0)),
    Column("with effects", "1.error_after", partial(_format_error, k=1)),
    Column("rms", "1.rms_before", None),
    Column("rms with effects", "1.rms_after", None),
    Column("unit", "1.unit", None),
    *(
        Column(name, f"1.{name}_share", partial(_format_share, name=name))
        for name in ("explained", "systematic", "noise")
    ),
)
"""Of names and joints."""


def _tabulate_joints(diagnosis: Diagnosis) -> page.PageTable:
    """Share of each joint's torque: explained, systematic, noise."""
    return page.tabulate(
        _JOINT_COLUMNS,
        [*diagnosis.joints.items()],
        "Errors of each joint in parts of its own rms torque or force. Shares of its variance with "
        "the effects in. Systematic is what smooth functions of the motion predict, what returns "
        "in the next lap, what lasts, and bursts.",
    )


# Diagnoses as tables and figures of a notebook.


def _collect_diagnosis_tables(diagnosis: Diagnosis) -> Tables:
    blind = "what these logs cannot tell", "effect, why"
    return {
        "effects": lambda: _tabulate_effects(diagnosis),
        "joints": lambda: Table.of_rows(
            "errors without and with the effects", _JOINT_COLUMNS, diagnosis.joints.items()
        ),
        "alternatives": lambda: Table.build(
            "alternatives to the first effect", "effect, joint, gain", diagnosis.alternatives
        ),
        "undetectable effects": lambda: Table.build(*blind, describe_undetectable(diagnosis)),
    }


def _describe_status(finding: Finding) -> str:
    if finding.is_refinement:
        return "refines the model"
    return "missing" if finding.status == "confirmed" else finding.status


_EFFECT_COLUMNS = (
    Column("effect", "effect"),
    Column("joint", "joint"),
    Column("error before", "error_before"),
    Column("error after", "error_after"),
    Column("gain", "gain"),
    Column("values [SI]", _format_values),
    Column("what", _describe_status),
    Column("evidence", "evidence"),
)


def _tabulate_effects(diagnosis: Diagnosis) -> Table:
    findings = [*diagnosis.effects, *diagnosis.refinements]
    title = f"{diagnosis.robot}: {diagnosis.verdict}"
    return Table.of_rows(title, _EFFECT_COLUMNS, findings, diagnosis.sentences[0])


def _collect_diagnosis_figures(diagnosis: Diagnosis) -> Figures:
    drawn: dict[str, Callable[[], Picture]] = {}
    for step in diagnosis.search.steps:
        name = step.candidate.effect.id + (
            f"@{step.candidate.joint}" if step.candidate.joint else ""
        )
        drawn[name] = partial(_draw_evidence, diagnosis, step)
    return collect_figures(drawn | {"errors": partial(draw_errors_picture, diagnosis)})


def _draw_evidence(diagnosis: Diagnosis, step: SearchStep) -> Picture:
    return evidence.draw_evidence_picture(collect_evidence(diagnosis.search, step))


PRESENTATIONS = {
    Diagnosis: Presentation(
        "a diagnosis",
        lambda diagnosis: "\n".join(format_lines(diagnosis)),
        _collect_diagnosis_tables,
        _collect_diagnosis_figures,
        ("effects", "joints"),
        build_diagnosis_page,
    )
}
