"""The page of a diagnosis: one HTML file, no network."""

from collections.abc import Callable, Sequence
from functools import partial
from operator import attrgetter

from modeler.core.figure import Picture
from modeler.core.result import Figures, Presentation, Tables
from modeler.core.table import Cell, Table, format_error_pair, format_percent
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
    nothing = page.Paragraph("Nothing of the catalogue.")
    sections.append(
        page.Section("What these logs cannot tell", [page.Items(blind) if blind else nothing])
    )
    return sections


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
    rows = [
        _build_finding_row(finding, (finding.effect, finding.joint) in drawn)
        for finding in findings
    ]
    return [page.PageTable(head, rows, _ERRORS, kinds)]


_ERRORS = (
    "The largest error first. Errors are those of the joint that is named, in parts of its own rms "
    "torque or force; of an effect on several joints, of all of them, each in units of what "
    "is left of it, so that N m and N are never added. Before and after: without the effect and "
    "with it, all others that were named before it in the model. Gain: share of the residual's "
    "variance that is gone."
)


def _build_finding_row(finding: Finding, drawn: bool) -> list[str | page.PageCell]:
    values = "; ".join(
        f"{name} = {value:.4g}"
        + (f" \u00b1 {finding.sigmas[name]:.2g}" if name in finding.sigmas else "")
        + format_unit(finding, name)
        for name, value in finding.parameters.items()
    )
    status = "refinement" if finding.is_refinement else finding.status
    return [
        page.PageCell(
            f"{finding.effect} ({status})",
            link=_build_section_id(finding.effect, finding.joint) if drawn else "",
        ),
        finding.joint or "all",
        values,
        *format_error_pair(finding.error_before, finding.error_after),
        page.PageCell(format_percent(finding.gain), max(0.0, finding.gain)),
        "; ".join(text for text in (finding.evidence, finding.warning) if text),
    ]


def _tabulate_joints(diagnosis: Diagnosis) -> page.PageTable:
    """Share of each joint's torque: explained, systematic, noise."""
    rows = [
        [
            name,
            *format_error_pair(j.error_before, j.error_after),
            *(
                format_percent(share, 5)
                for share in (j.explained_share, j.systematic_share, j.noise_share)
            ),
        ]
        for name, j in diagnosis.joints.items()
    ]
    return page.PageTable(
        ("joint", "error", "with the effects", "explained", "systematic, unexplained", "noise"),
        rows,
        "Errors of each joint in parts of its own rms torque or force. Shares of its variance with "
        "the effects in. Systematic is what smooth functions "
        "of the motion predict, what returns in the next lap, what lasts, and bursts.",
    )


# Diagnoses as tables and figures of a notebook.


def _collect_diagnosis_tables(diagnosis: Diagnosis) -> Tables:
    blind = "what these logs cannot tell", "effect, why"
    return {
        "effects": lambda: _tabulate_effects(diagnosis),
        "joints": lambda: _build_joint_table(diagnosis),
        "alternatives": lambda: Table.build(
            "alternatives to the first effect", "effect, joint, gain", diagnosis.alternatives
        ),
        "undetectable": lambda: Table.build(*blind, describe_undetectable(diagnosis)),
    }


def _tabulate_effects(diagnosis: Diagnosis) -> Table:
    rows = [
        _build_effect_row(f, "missing" if f.status == "confirmed" else f.status)
        for f in diagnosis.effects
    ]
    rows += [_build_effect_row(f, "refines the model") for f in diagnosis.refinements]
    return Table.build(
        f"{diagnosis.robot}: {diagnosis.verdict}",
        "effect, joint, error before, error after, gain, values [SI], what, evidence",
        rows,
        diagnosis.sentences[0],
    )


def _build_effect_row(finding: Finding, what: str) -> tuple[Cell, ...]:
    values = ", ".join(
        f"{name} = {value:.4g} {finding.units.get(name, '')}".rstrip()
        for name, value in finding.parameters.items()
    )
    errors = finding.error_before, finding.error_after
    return finding.effect, finding.joint, *errors, finding.gain, values, what, finding.evidence


def _build_joint_table(diagnosis: Diagnosis) -> Table:
    names = (
        "error_before error_after rms_before rms_after unit "
        "explained_share systematic_share noise_share"
    )
    read = attrgetter(*names.split())
    rows = [(name, *read(joint)) for name, joint in diagnosis.joints.items()]
    return Table.build(
        "errors without and with the effects",
        "joint, error, with effects, rms, rms with effects, unit, explained, systematic, noise",
        rows,
    )


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
